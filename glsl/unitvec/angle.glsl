// unitvec: directions of the plane in 8 and 16 bits.
//
//   angle8_encode(v), angle8_decode(code)        v is a vec2 of any length; also angle16; without trigonometry
//   eqangle8_encode(v), eqangle8_decode(code)    the same by steps of equal angle; also eqangle16
//
// A code is the number of steps from +X towards +Y, of 2^bits to a turn; those of angle8 and angle16 are equal but for
// 0.26 %. Axes are exact. +X stands in for vectors without a direction.

#ifndef UNITVEC_ANGLE_GLSL
#define UNITVEC_ANGLE_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

uint unitvec_angle_encode(vec2 v, uint bits, bool equal) {
    UNITVEC_PRECISE float sum = abs(v.x) + abs(v.y);
    // Half a turn and its opposite, the largest number and the least, have the same low bits.
    UNITVEC_PRECISE float place = unitvec_atan2_half_turns(v.y, v.x) * unitvec_exp2(int(bits) - 1);
    uint code = equal ? unitvec_nearest_code(place, bits) : unitvec_diamond_code(v.x, v.y, sum, bits);
    return unitvec_is_usable(sum) ? code : 0u;
}

vec2 unitvec_angle_decode(uint code, uint bits) {
    vec2 p = unitvec_diamond_point(code, bits);
    UNITVEC_PRECISE float square = p.x * p.x + p.y * p.y;
    UNITVEC_PRECISE vec2 v = p * unitvec_inverse_root(square);
    // -0 becomes 0.
    return vec2(abs(v.x) > 0.0 ? v.x : 0.0, abs(v.y) > 0.0 ? v.y : 0.0);
}

vec2 unitvec_eqangle_decode(uint code, uint bits) {
    UNITVEC_PRECISE float half_turns = float(code & unitvec_mask(bits)) * unitvec_exp2(1 - int(bits));
    return unitvec_sin_cos_half_turns(half_turns);
}

uint angle8_encode(vec2 v) { return unitvec_angle_encode(v, 8u, false); }
uint angle16_encode(vec2 v) { return unitvec_angle_encode(v, 16u, false); }
uint eqangle8_encode(vec2 v) { return unitvec_angle_encode(v, 8u, true); }
uint eqangle16_encode(vec2 v) { return unitvec_angle_encode(v, 16u, true); }

vec2 angle8_decode(uint code) { return unitvec_angle_decode(code, 8u); }
vec2 angle16_decode(uint code) { return unitvec_angle_decode(code, 16u); }
vec2 eqangle8_decode(uint code) { return unitvec_eqangle_decode(code, 8u); }
vec2 eqangle16_decode(uint code) { return unitvec_eqangle_decode(code, 16u); }

#endif
