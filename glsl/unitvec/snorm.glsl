// unitvec: raw snorm components: snorm5x3, snorm8x3, snorm10x3, snorm11_11_10, snorm16x3.
//
// Source: Cigolle et al. 2014, section 1.2.
//
//   snorm8x3_encode(v), snorm8x3_decode(code)      integer codes, uvec2 (low word first) for snorm16x3
//
// Components are stored as they are, clamped to [-1, 1], and not normalised. Layout: x in the low bits, then y, then z,
// two's complement. Three zeros have no direction: they decode to +Z and are never written.

#ifndef UNITVEC_SNORM_GLSL
#define UNITVEC_SNORM_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

uint unitvec_snorm3_encode(vec3 v, uint xy_bits, uint z_bits) {
    uint code = unitvec_snorm_code(v.x, xy_bits) | (unitvec_snorm_code(v.y, xy_bits) << xy_bits)
        | (unitvec_snorm_code(v.z, z_bits) << (2u * xy_bits));
    code = unitvec_is_usable(unitvec_l1_norm(v)) ? code : 0u;
    return code == 0u ? unitvec_mask(z_bits - 1u) << (2u * xy_bits) : code;
}

vec3 unitvec_snorm3_decode(uint code, uint xy_bits, uint z_bits) {
    uint used = code << (32u - 2u * xy_bits - z_bits);
    code = used == 0u ? unitvec_mask(z_bits - 1u) << (2u * xy_bits) : code;
    vec3 e = vec3(unitvec_snorm_field(code, 0u, xy_bits), unitvec_snorm_field(code, xy_bits, xy_bits),
        unitvec_snorm_field(code, 2u * xy_bits, z_bits));
    return unitvec_snorm_quotients(e, xy_bits, z_bits);
}

uvec2 snorm16x3_encode(vec3 v) {
    uint low = unitvec_snorm_code(v.x, 16u) | (unitvec_snorm_code(v.y, 16u) << 16u);
    uvec2 code = uvec2(low, unitvec_snorm_code(v.z, 16u));
    code = unitvec_is_usable(unitvec_l1_norm(v)) ? code : uvec2(0u);
    return uvec2(code.x, (code.x | code.y) == 0u ? unitvec_mask(15u) : code.y);
}

vec3 snorm16x3_decode(uvec2 code) {
    uint z = code.y & unitvec_mask(16u);
    z = (code.x | z) == 0u ? unitvec_mask(15u) : z;
    vec3 e = vec3(unitvec_snorm_field(code.x, 0u, 16u), unitvec_snorm_field(code.x, 16u, 16u),
        unitvec_snorm_field(z, 0u, 16u));
    return unitvec_snorm_quotients(e, 16u, 16u);
}

uint snorm5x3_encode(vec3 v) { return unitvec_snorm3_encode(v, 5u, 5u); }
uint snorm8x3_encode(vec3 v) { return unitvec_snorm3_encode(v, 8u, 8u); }
uint snorm10x3_encode(vec3 v) { return unitvec_snorm3_encode(v, 10u, 10u); }
uint snorm11_11_10_encode(vec3 v) { return unitvec_snorm3_encode(v, 11u, 10u); }

vec3 snorm5x3_decode(uint code) { return unitvec_snorm3_decode(code, 5u, 5u); }
vec3 snorm8x3_decode(uint code) { return unitvec_snorm3_decode(code, 8u, 8u); }
vec3 snorm10x3_decode(uint code) { return unitvec_snorm3_decode(code, 10u, 10u); }
vec3 snorm11_11_10_decode(uint code) { return unitvec_snorm3_decode(code, 11u, 10u); }

#endif
