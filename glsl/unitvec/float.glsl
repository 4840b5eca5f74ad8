// unitvec: raw components as half floats: float16x3.
//
// Source: Cigolle et al. 2014, section 2; IEEE 754 binary16.
//
//   float16x3_encode(v), float16x3_decode(code)      codes as uvec2, low word first
//
// Components are stored as they are, at most 65504, and not normalised. Infinity and NaN decode to +-65504. Three zeros
// have no direction: they decode to +Z and are never written. Layout: x in bits 0 to 15, y 16 to 31, z 32 to 47.

#ifndef UNITVEC_FLOAT_GLSL
#define UNITVEC_FLOAT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

uvec2 float16x3_encode(vec3 v) {
    v = unitvec_or_z(v);
    uint low = unitvec_half_encode(v.x) | (unitvec_half_encode(v.y) << 16u);
    uint z = unitvec_half_encode(v.z);
    return uvec2(low, (low | z) == 0u ? UNITVEC_HALF_ONE : z);
}

vec3 float16x3_decode(uvec2 code) {
    bool is_zero = ((code.x & 0x7fff7fffu) | (code.y & 0x7fffu)) == 0u;
    uint z = is_zero ? UNITVEC_HALF_ONE : code.y;
    return vec3(unitvec_half_decode(code.x), unitvec_half_decode(code.x >> 16u), unitvec_half_decode(z));
}

#endif
