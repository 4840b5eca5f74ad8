// unitvec: axes, for which v and -v are the same, in 16, 24 and 32 bits.
//
//   axial16_encode(v), axial16_decode(code)   also axial24, axial32
//
// The formats of hemioct.glsl, with the nearest codes. v and -v have the same code. In decoded vectors the first
// component that is not 0, of z, x and y in this order, is positive. Z stands in for vectors without a direction.

#ifndef UNITVEC_AXIAL_GLSL
#define UNITVEC_AXIAL_GLSL

#ifndef UNITVEC_HEMIOCT_GLSL
#include "hemioct.glsl"
#endif

precision highp float;
precision highp int;

// The end of the axis of v whose first component that is not 0, of z, x and y, is positive. Denormals count as 0.
vec3 unitvec_axial_end(vec3 v) {
    float horizontal = abs(v.x) >= UNITVEC_MIN_POSITIVE ? v.x : v.y;
    float first = abs(v.z) >= UNITVEC_MIN_POSITIVE ? v.z : horizontal;
    return unitvec_is_negative(first) ? -v : v;
}

// The code, or that of the opposite direction if it is one of the equator, the square's border, with x < 0, or with
// x = 0 and y < 0.
uint unitvec_axial_one_of_two(uint code, uint bits) {
    uint part_bits = bits / 2u;
    uint most = unitvec_mask(part_bits - 1u);
    uint whole = unitvec_mask(part_bits);
    uint least = whole - most + 1u;
    uint u = code & whole;
    uint v = code >> part_bits;
    uint opposite = ((0u - u) & whole) | (((0u - v) & whole) << part_bits);
    return u == least || (v == least && u != most) ? opposite : code;
}

uint unitvec_axial_encode(vec3 v, uint bits) {
    return unitvec_axial_one_of_two(unitvec_hemioct_encode_precise(unitvec_axial_end(v), bits), bits);
}

uint axial16_encode(vec3 v) { return unitvec_axial_encode(v, 16u); }
uint axial24_encode(vec3 v) { return unitvec_axial_encode(v, 24u); }
uint axial32_encode(vec3 v) { return unitvec_axial_encode(v, 32u); }

vec3 axial16_decode(uint code) { return hemioct16_decode(code); }
vec3 axial24_decode(uint code) { return hemioct24_decode(code); }
vec3 axial32_decode(uint code) { return hemioct32_decode(code); }

#endif
