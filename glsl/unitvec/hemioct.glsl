// unitvec: hemi-octahedral codes of 16, 24 and 32 bits, for directions with z >= 0.
//
// Source: Cigolle et al. 2014, listing 6.
//
//   hemioct16_encode(v), hemioct16_decode(code)      integer codes; also hemioct24, hemioct32
//   float32x3_to_hemioct(v)                          a pair on [-1, 1], for an snorm format that the hardware converts
//   hemioct_to_float32x3(e)                          the direction of such a pair
//
// All take any input. Below the equator z counts as 0, and +Z stands in for what has no direction, or NaN in it; a pair
// is clamped to [-1, 1]. Layout: u = x + y in the low half, v = x - y in the high half, two's complement snorm.

#ifndef UNITVEC_HEMIOCT_GLSL
#define UNITVEC_HEMIOCT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// Lattice point of a vector with z >= 0 and an L1 norm of `norm`, m the snorm's largest integer.
vec2 unitvec_hemioct_project(vec3 v, float norm, float m) {
    float x = unitvec_without_denormal(v.x), y = unitvec_without_denormal(v.y);
    UNITVEC_PRECISE vec2 p = vec2(x + y, x - y) * (m / norm);
    return vec2(unitvec_round_symmetric(p.x), unitvec_round_symmetric(p.y));
}

// Lattice point of the direction of v (listing 6, then snorm rounding), m the snorm's largest integer.
vec2 unitvec_hemioct_lattice(vec3 v, float m) {
    v = unitvec_upper_or_z(v);
    return unitvec_hemioct_project(v, unitvec_l1_norm(v), m);
}

// Direction of a lattice point (listing 6), unit length to within 2 ULP. |p.x| + |p.y| is twice the larger of |e.x| and
// |e.y|, so that z is not negative.
vec3 unitvec_hemioct_from_lattice(vec2 e, float m) {
    UNITVEC_PRECISE vec2 p = vec2(e.x + e.y, e.x - e.y);
    UNITVEC_PRECISE float z = 2.0 * (m - max(abs(e.x), abs(e.y)));
    return unitvec_normalize(vec3(p, z));
}

// Listing 6: the projection, unquantised, on [-1, 1]^2. +Z stands in for what unitvec_upper_or_z takes for it.
vec2 float32x3_to_hemioct(vec3 v) {
    float norm = unitvec_l1_norm(vec3(v.xy, max(v.z, 0.0)));
    UNITVEC_PRECISE vec2 p = v.xy * (1.0 / norm);
    UNITVEC_PRECISE vec2 e = vec2(p.x + p.y, p.x - p.y);
    return unitvec_is_usable(unitvec_l1_norm(v)) && unitvec_is_usable(norm) ? e : vec2(0.0);
}

// Listing 6: the direction of a pair of snorm values on [-1, 1].
vec3 hemioct_to_float32x3(vec2 e) {
    return unitvec_hemioct_from_lattice(unitvec_snorm_clamp(e), 1.0);
}

uint unitvec_hemioct_encode(vec3 v, uint bits) {
    vec2 e = unitvec_hemioct_lattice(v, unitvec_snorm_max(bits / 2u));
    return unitvec_signed_code(e.x, bits / 2u) | (unitvec_signed_code(e.y, bits / 2u) << (bits / 2u));
}

vec3 unitvec_hemioct_decode(uint code, uint bits) {
    vec2 e = vec2(unitvec_snorm_integer(code, bits / 2u), unitvec_snorm_integer(code >> (bits / 2u), bits / 2u));
    return unitvec_hemioct_from_lattice(e, unitvec_snorm_max(bits / 2u));
}

uint hemioct16_encode(vec3 v) { return unitvec_hemioct_encode(v, 16u); }
uint hemioct24_encode(vec3 v) { return unitvec_hemioct_encode(v, 24u); }
uint hemioct32_encode(vec3 v) { return unitvec_hemioct_encode(v, 32u); }

vec3 hemioct16_decode(uint code) { return unitvec_hemioct_decode(code, 16u); }
vec3 hemioct24_decode(uint code) { return unitvec_hemioct_decode(code, 24u); }
vec3 hemioct32_decode(uint code) { return unitvec_hemioct_decode(code, 32u); }

#endif
