// unitvec: raw components, scaled and biased to unorm8: v * 0.5 + 0.5.
//
// Source: Cigolle et al. 2014, section 1.2.
//
//   unorm8x3_encode(v), unorm8x3_decode(code)
//
// Components are stored as they are, clamped to [-1, 1], and not normalised. 0 becomes 1/255. Layout: x in the low byte.

#ifndef UNITVEC_UNORM_GLSL
#define UNITVEC_UNORM_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The code of +Z: 0 becomes 128.
const uint UNITVEC_UNORM8X3_Z = 0xff8080u;

uint unitvec_unorm8x3_encode_component(float r) {
    UNITVEC_PRECISE float biased = r * 0.5 + 0.5;
    return unitvec_unorm_code(biased, 8u);
}

// 255 times the component of the low byte of a code.
float unitvec_unorm8x3_decode_component(uint code) {
    UNITVEC_PRECISE float whole = 2.0 * float(code & unitvec_mask(8u)) - 255.0;
    return whole;
}

uint unorm8x3_encode(vec3 v) {
    uint code = unitvec_unorm8x3_encode_component(v.x) | (unitvec_unorm8x3_encode_component(v.y) << 8u)
        | (unitvec_unorm8x3_encode_component(v.z) << 16u);
    return unitvec_is_usable(unitvec_l1_norm(v)) ? code : UNITVEC_UNORM8X3_Z;
}

vec3 unorm8x3_decode(uint code) {
    vec3 e = vec3(unitvec_unorm8x3_decode_component(code), unitvec_unorm8x3_decode_component(code >> 8u),
        unitvec_unorm8x3_decode_component(code >> 16u));
    // 255 is the largest integer of an snorm of 9 bits.
    return unitvec_snorm_quotients(e, 9u, 9u);
}

#endif
