// unitvec: raw components as half floats, and the conversion to and from them, the same on every device.
//
// Source: Cigolle et al. 2014, section 3; IEEE 754 binary16.
//
//   float16x3_encode(v), float16x3_decode(code)          code: uvec2, low word first
//   unitvec_half_encode(x), unitvec_half_decode(code)    one half: nearest, ties to even
//
// Components are stored as they are, at most 65504, and not normalised. Infinity and NaN decode to +-65504. Three zeros
// have no direction: they decode to +Z and are never written. Layout: x in bits 0 to 15, y 16 to 31, z 32 to 47.

#ifndef UNITVEC_FLOAT_GLSL
#define UNITVEC_FLOAT_GLSL

#ifndef UNITVEC_SCALAR_GLSL
#include "scalar.glsl"
#endif

// Half nearest to |x|, ties to even.
uint unitvec_half_encode_magnitude(float x) {
    uint bits = floatBitsToUint(x) & 0x7fffffffu;
    uint exponent = bits >> 23u;

    // From 2^-14 on: 13 bits less of the significand, 112 less of the exponent; a carry is right in both.
    uint normal = (bits - 0x38000000u + 0xfffu + ((bits >> 13u) & 1u)) >> 13u;

    // From 2^-25 to 2^-14: whole multiples of 2^-24. Below, `shift` stands in for one that is larger.
    uint shift = exponent >= 102u ? (126u - exponent) & 31u : 25u;
    uint significand = (bits & 0x007fffffu) | 0x00800000u;
    uint whole = significand >> shift;
    uint rest = significand & ((1u << shift) - 1u);
    uint middle = (1u << shift) >> 1u;
    uint subnormal = whole + (rest + (whole & 1u) > middle ? 1u : 0u);

    uint rounded = bits >= 0x38800000u ? normal : subnormal;
    return bits >= 0x477ff000u ? 0x7bffu : rounded;
}

uint unitvec_half_encode(float x) {
    uint magnitude = unitvec_half_encode_magnitude(x);
    return magnitude | (unitvec_is_negative(x) && magnitude != 0u ? 0x8000u : 0u);
}

// Number of a half without its sign.
float unitvec_half_decode_magnitude(uint code) {
    uint finite = code > 0x7bffu ? 0x7bffu : code;
    UNITVEC_PRECISE float subnormal = float(finite) * 5.9604645e-8;
    float normal = uintBitsToFloat((finite << 13u) + 0x38000000u);
    return finite < 0x400u ? subnormal : normal;
}

float unitvec_half_decode(uint code) {
    float magnitude = unitvec_half_decode_magnitude(code & 0x7fffu);
    return unitvec_negate_if((code & 0x8000u) != 0u && magnitude > 0.0, magnitude);
}

uvec2 float16x3_encode(vec3 v) {
    v = unitvec_or_z(v);
    uint low = unitvec_half_encode(v.x) | (unitvec_half_encode(v.y) << 16u);
    uint z = unitvec_half_encode(v.z);
    return uvec2(low, (low | z) == 0u ? 0x3c00u : z);
}

vec3 float16x3_decode(uvec2 code) {
    bool none = ((code.x & 0x7fff7fffu) | (code.y & 0x7fffu)) == 0u;
    uint z = none ? 0x3c00u : code.y;
    return vec3(unitvec_half_decode(code.x), unitvec_half_decode(code.x >> 16u), unitvec_half_decode(z));
}

#endif
