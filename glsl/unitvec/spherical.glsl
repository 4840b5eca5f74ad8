// unitvec: spherical coordinates in 16, 20, 22, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, section 2, "spherical".
//
//   spherical16_encode(v), spherical16_decode(code)      also spherical20, 22, 24, 32
//   float32x3_to_spherical(v)                            (2 theta / pi - 1, phi / pi), on [-1, 1]
//   spherical_to_float32x3(e)                            the direction of such a pair
//   float32x3_to_spherical_unorm(v), spherical_unorm_to_float32x3(e)      the same on [0, 1], for a unorm format
//
// All take any input. Of v the length does not matter, and +Z stands in for vectors without a direction. A pair is
// clamped to [-1, 1], and (0, 0) where one is NaN. An snorm format that holds such a pair has another code than these:
// its phi has a step less. Layout, with b half the bits and m = 2^(b-1) - 1: round((2 theta / pi - 1) m) in the low
// half, theta from +Z; round(phi / pi 2^(b-1)) in the high half, periodic; both in two's complement.

#ifndef UNITVEC_SPHERICAL_GLSL
#define UNITVEC_SPHERICAL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The latitude and the azimuth of the direction of v in quarter turns.
vec2 unitvec_spherical_angles(vec3 v) {
    float norm = unitvec_l1_norm(v);
    vec3 p = unitvec_angles_scaled(v, norm);
    float latitude = unitvec_with_sign(unitvec_angles_quarter(p.z, unitvec_horizontal_length(p)), v.z);
    return vec2(unitvec_is_usable(norm) ? latitude : 1.0, unitvec_angles_azimuth(v, p));
}

// The integers of the direction of v, before rounding: m is the largest of theta, half_turn the one of phi = pi.
vec2 unitvec_spherical_lattice(vec3 v, float m, float half_turn) {
    vec2 angles = unitvec_spherical_angles(v);
    UNITVEC_PRECISE float i = angles.x * -m;
    UNITVEC_PRECISE float j = angles.y * (0.5 * half_turn);
    // Half a step from a pole, i rounds to the even integer, which is not the pole's.
    return vec2(i, abs(i) > m - 0.5 ? 0.0 : j);
}

// Direction of a pair of integers, unit length to within 2 ULP.
vec3 unitvec_spherical_from_lattice(vec2 e, float m, float half_turn) {
    // The product of m is 1 exactly.
    UNITVEC_PRECISE float latitude = abs(e.x) * unitvec_reciprocal(m);
    UNITVEC_PRECISE float diagonal = latitude - 0.5;
    vec2 meridian = unitvec_from_diagonal(diagonal);
    UNITVEC_PRECISE float radius = meridian.x - meridian.y;
    UNITVEC_PRECISE float z = meridian.x + meridian.y;
    UNITVEC_PRECISE float quarters = e.y * unitvec_over(2.0, half_turn);
    return unitvec_angles_around_z(radius, unitvec_negate_if(e.x > 0.0, z), latitude < 1.0 ? quarters : 0.0);
}

// The unquantised angles: 2 theta / pi - 1 and phi / pi, both on [-1, 1].
vec2 float32x3_to_spherical(vec3 v) {
    vec2 angles = unitvec_spherical_angles(v);
    UNITVEC_PRECISE float turn = 0.5 * angles.y;
    return vec2(-angles.x, abs(angles.x) < 1.0 ? turn : 0.0);
}

// 2^-26. An angle of theta that is less differs from the equator by less than the decoder rounds, and counts as 0: else
// a zero of z could get a sign.
const float UNITVEC_SPHERICAL_LEAST = 1.4901161193847656e-8;

// The direction of 2 theta / pi - 1 and phi / pi, both on [-1, 1].
vec3 spherical_to_float32x3(vec2 e) {
    vec2 angles = unitvec_snorm_clamp(e);
    float theta = abs(angles.x) > UNITVEC_SPHERICAL_LEAST ? angles.x : 0.0;
    return unitvec_spherical_from_lattice(vec2(theta, angles.y), 1.0, 1.0);
}

// Variants with values on [0, 1], for a UNORM format, which cannot hold the middle exactly.
vec2 float32x3_to_spherical_unorm(vec3 v) { return unitvec_biased(float32x3_to_spherical(v)); }
vec3 spherical_unorm_to_float32x3(vec2 e) { return spherical_to_float32x3(unitvec_unbiased(e)); }

uint unitvec_spherical_encode(vec3 v, uint bits) {
    float m = unitvec_snorm_max(bits / 2u);
    vec2 e = unitvec_spherical_lattice(v, m, m + 1.0);
    return unitvec_nearest_code(e.x, bits / 2u) | (unitvec_nearest_code(e.y, bits / 2u) << (bits / 2u));
}

vec3 unitvec_spherical_decode(uint code, uint bits) {
    float m = unitvec_snorm_max(bits / 2u);
    float i = unitvec_snorm_integer(code, bits / 2u);
    float j = unitvec_signed_integer(code >> (bits / 2u), bits / 2u);
    return unitvec_spherical_from_lattice(vec2(i, j), m, m + 1.0);
}

uint spherical16_encode(vec3 v) { return unitvec_spherical_encode(v, 16u); }
uint spherical20_encode(vec3 v) { return unitvec_spherical_encode(v, 20u); }
uint spherical22_encode(vec3 v) { return unitvec_spherical_encode(v, 22u); }
uint spherical24_encode(vec3 v) { return unitvec_spherical_encode(v, 24u); }
uint spherical32_encode(vec3 v) { return unitvec_spherical_encode(v, 32u); }

vec3 spherical16_decode(uint code) { return unitvec_spherical_decode(code, 16u); }
vec3 spherical20_decode(uint code) { return unitvec_spherical_decode(code, 20u); }
vec3 spherical22_decode(uint code) { return unitvec_spherical_decode(code, 22u); }
vec3 spherical24_decode(uint code) { return unitvec_spherical_decode(code, 24u); }
vec3 spherical32_decode(uint code) { return unitvec_spherical_decode(code, 32u); }

#endif
