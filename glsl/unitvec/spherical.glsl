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

#ifndef UNITVEC_SCALAR_GLSL
#include "scalar.glsl"
#endif
#ifndef UNITVEC_MATH_GLSL
#include "math.glsl"
#endif

float spherical_without_denormal(float x) {
    return abs(x) < UNITVEC_MIN_POSITIVE ? 0.0 : x;
}

// v at an L1 norm of 1, denormals taken as 0, or +Z where it has no direction.
vec3 spherical_scaled(vec3 v) {
    v = unitvec_or_z(v);
    UNITVEC_PRECISE float scale = 1.0 / unitvec_l1_norm(v);
    vec3 normal = vec3(
        spherical_without_denormal(v.x), spherical_without_denormal(v.y), spherical_without_denormal(v.z));
    UNITVEC_PRECISE vec3 scaled = normal * scale;
    return scaled;
}

// Distance of v from the z axis.
float spherical_horizontal_length(vec3 v) {
    UNITVEC_PRECISE float distance_from_z = sqrt(v.x * v.x + v.y * v.y);
    return distance_from_z;
}

// Unit vector of a cylinder's radius and height at the angle phi, in half turns, about +Z.
vec3 spherical_around_z(float radius, float z, float phi) {
    vec2 turned = unitvec_sin_cos_half_turns(radius > 0.0 ? phi : 0.0);
    UNITVEC_PRECISE vec2 horizontal = radius * turned;
    return vec3(horizontal, z);
}

// Nearest whole number, ties away from zero.
float spherical_round(float x) {
    UNITVEC_PRECISE float position = abs(x) + 0.5;
    return unitvec_negate_if(unitvec_is_negative(x), floor(position));
}

// Integer of the low `bits` bits of a code, in two's complement.
float spherical_signed_integer(uint code, uint bits) {
    return float(int(code << (32u - bits)) >> int(32u - bits));
}

// The integers of the direction of v: m is the largest of theta, half_turn the one of phi = pi.
vec2 spherical_lattice(vec3 v, float m, float half_turn) {
    v = spherical_scaled(v);
    UNITVEC_PRECISE float latitude = unitvec_atan2_half_turns(v.z, spherical_horizontal_length(v)) * (-2.0 * m);
    UNITVEC_PRECISE float azimuth = unitvec_atan2_half_turns(v.y, v.x) * half_turn;
    float i = spherical_round(latitude);
    return vec2(i, abs(i) < m ? spherical_round(azimuth) : 0.0);
}

// Direction of a pair of integers, unit length to within 2 ULP.
vec3 spherical_from_lattice(vec2 e, float m, float half_turn) {
    // The product of m is 1/2 exactly.
    UNITVEC_PRECISE vec2 angles = vec2(e.x * (-0.5 / m), e.y * (1.0 / half_turn));
    vec2 meridian = unitvec_sin_cos_half_turns(angles.x);
    return spherical_around_z(meridian.x, meridian.y, angles.y);
}

uint spherical_encode(vec3 v, uint bits, float m) {
    vec2 e = spherical_lattice(v, m, m + 1.0);
    return unitvec_signed_code(e.x, bits / 2u) | (unitvec_signed_code(e.y, bits / 2u) << (bits / 2u));
}

vec3 spherical_decode(uint code, uint bits, float m) {
    float i = unitvec_snorm_integer(code, bits / 2u);
    float j = spherical_signed_integer(code >> (bits / 2u), bits / 2u);
    return spherical_from_lattice(vec2(i, j), m, m + 1.0);
}

uint spherical16_encode(vec3 v) { return spherical_encode(v, 16u, 127.0); }
uint spherical20_encode(vec3 v) { return spherical_encode(v, 20u, 511.0); }
uint spherical22_encode(vec3 v) { return spherical_encode(v, 22u, 1023.0); }
uint spherical24_encode(vec3 v) { return spherical_encode(v, 24u, 2047.0); }
uint spherical32_encode(vec3 v) { return spherical_encode(v, 32u, 32767.0); }

vec3 spherical16_decode(uint code) { return spherical_decode(code, 16u, 127.0); }
vec3 spherical20_decode(uint code) { return spherical_decode(code, 20u, 511.0); }
vec3 spherical22_decode(uint code) { return spherical_decode(code, 22u, 1023.0); }
vec3 spherical24_decode(uint code) { return spherical_decode(code, 24u, 2047.0); }
vec3 spherical32_decode(uint code) { return spherical_decode(code, 32u, 32767.0); }

#endif
