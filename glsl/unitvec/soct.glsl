// unitvec: signed octahedral codes of 17, 25 and 33 bits.
//
// Source: White 2017, "Signed Octahedron Normal Encoding"; Cigolle et al. 2014, listing 6.
//
//   soct17_encode(v), soct17_decode(code)      also soct25, and soct33, whose codes are a uvec2
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. Layout: u = x + y
// and v = x - y of (x, y, |z|) in two's complement snorm as in hemioct.glsl, u lowest, and above them 1 for z < 0. Of
// the 33 bits the sign is bit 0 of the second word.

#ifndef UNITVEC_SOCT_GLSL
#define UNITVEC_SOCT_GLSL

#ifndef UNITVEC_HEMIOCT_GLSL
#include "hemioct.glsl"
#endif

precision highp float;
precision highp int;

// The codes of u and v, of `bits` bits each, and the sign, of the direction of v.
uvec3 unitvec_soct_parts(vec3 v, uint bits) {
    v = unitvec_or_z(v);
    vec2 e = unitvec_hemioct_project(vec3(v.xy, abs(v.z)), unitvec_l1_norm(v), unitvec_snorm_max(bits));
    uint negative = unitvec_is_negative(v.z) ? 1u : 0u;
    return uvec3(unitvec_signed_code(e.x, bits), unitvec_signed_code(e.y, bits), negative);
}

// The direction of the codes of u and v, of `bits` bits each, and the sign: unit length to within 2 ULP.
vec3 unitvec_soct_from_parts(uint u, uint v, uint negative, uint bits) {
    vec2 e = vec2(unitvec_snorm_integer(u, bits), unitvec_snorm_integer(v, bits));
    vec3 up = unitvec_hemioct_from_lattice(e, unitvec_snorm_max(bits));
    return vec3(up.xy, unitvec_negate_positive((negative & 1u) != 0u, up.z));
}

uint unitvec_soct_encode(vec3 v, uint bits) {
    uvec3 parts = unitvec_soct_parts(v, bits / 2u);
    return parts.x | (parts.y << (bits / 2u)) | (parts.z << (bits - 1u));
}

vec3 unitvec_soct_decode(uint code, uint bits) {
    uint half_mask = unitvec_mask(bits / 2u);
    return unitvec_soct_from_parts(
        code & half_mask, (code >> (bits / 2u)) & half_mask, code >> (bits - 1u), bits / 2u);
}

uint soct17_encode(vec3 v) { return unitvec_soct_encode(v, 17u); }
uint soct25_encode(vec3 v) { return unitvec_soct_encode(v, 25u); }

uvec2 soct33_encode(vec3 v) {
    uvec3 parts = unitvec_soct_parts(v, 16u);
    return uvec2(parts.x | (parts.y << 16u), parts.z);
}

vec3 soct17_decode(uint code) { return unitvec_soct_decode(code, 17u); }
vec3 soct25_decode(uint code) { return unitvec_soct_decode(code, 25u); }
vec3 soct33_decode(uvec2 code) {
    return unitvec_soct_from_parts(code.x & unitvec_mask(16u), code.x >> 16u, code.y, 16u);
}

#endif
