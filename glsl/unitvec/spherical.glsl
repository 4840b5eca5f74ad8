// unitvec: spherical coordinates in 16, 20, 22, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, section 2, "spherical".
//
//   spherical16_encode(v), spherical16_decode(code)      also spherical20, 22, 24, 32
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. Layout, with b
// half the bits and m = 2^(b-1) - 1: round((2 theta / pi - 1) m) in the low half, theta from +Z; round(phi / pi
// 2^(b-1)) in the high half, periodic; both in two's complement.

#ifndef UNITVEC_SPHERICAL_GLSL
#define UNITVEC_SPHERICAL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The integers of the direction of v, before rounding: m is the largest of theta, half_turn the one of phi = pi.
vec2 unitvec_spherical_lattice(vec3 v, float m, float half_turn) {
    float norm = unitvec_l1_norm(v);
    vec3 p = unitvec_angles_scaled(v, norm);
    float latitude = unitvec_with_sign(unitvec_angles_quarter(p.z, unitvec_horizontal_length(p)), v.z);
    UNITVEC_PRECISE float i = (unitvec_is_usable(norm) ? latitude : 1.0) * -m;
    UNITVEC_PRECISE float j = unitvec_angles_azimuth(v, p) * (0.5 * half_turn);
    // Half a step from a pole, i rounds to the even integer, which is not the pole's.
    return vec2(i, abs(i) > m - 0.5 ? 0.0 : j);
}

// Direction of a pair of integers, unit length to within 2 ULP.
vec3 unitvec_spherical_from_lattice(vec2 e, float m, float half_turn) {
    // The product of m is 1 exactly.
    UNITVEC_PRECISE float latitude = abs(e.x) * (1.0 / m);
    UNITVEC_PRECISE float diagonal = latitude - 0.5;
    vec2 meridian = unitvec_from_diagonal(diagonal);
    UNITVEC_PRECISE float radius = meridian.x - meridian.y;
    UNITVEC_PRECISE float z = meridian.x + meridian.y;
    UNITVEC_PRECISE float quarters = e.y * (2.0 / half_turn);
    return unitvec_angles_around_z(radius, unitvec_negate_if(e.x > 0.0, z), latitude < 1.0 ? quarters : 0.0);
}

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
