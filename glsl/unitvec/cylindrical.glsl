// unitvec: cylindrical coordinates in 16, 24 and 32 bits.
//
// Source: the pair (atan2(y, x) / pi, z) of K. Narkowicz's article on octahedron normals.
//
//   cylindrical16_encode(v), cylindrical16_decode(code)      also cylindrical24, 32
//   float32x3_to_cylindrical(v)                              (phi / pi, z), on [-1, 1], for an snorm format
//   cylindrical_to_float32x3(e)                              the direction of such a pair
//   float32x3_to_cylindrical_unorm(v), cylindrical_unorm_to_float32x3(e)      the same on [0, 1], for a unorm format
//
// All take any input. Of v the length does not matter, and +Z stands in for vectors without a direction. A pair is
// clamped to [-1, 1], and (0, 0) where one is NaN. Layout: phi / pi in the low half, z in the high half, two's
// complement snorm.

#ifndef UNITVEC_CYLINDRICAL_GLSL
#define UNITVEC_CYLINDRICAL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The z of the direction of v, which an inexact reciprocal may take beyond 1, and its azimuth in quarter turns.
vec2 unitvec_cylindrical_height(vec3 v) {
    float norm = unitvec_l1_norm(v);
    vec3 p = unitvec_angles_scaled(v, norm);
    UNITVEC_PRECISE float magnitude = p.z * unitvec_inverse_root(unitvec_dot(p, p));
    float height = unitvec_with_sign(magnitude, v.z);
    return vec2(unitvec_is_usable(norm) ? height : 1.0, unitvec_angles_azimuth(v, p));
}

// The snorm integers of the direction of v, before rounding: phi / pi and z. m is the snorm's largest.
vec2 unitvec_cylindrical_lattice(vec3 v, float m) {
    vec2 height = unitvec_cylindrical_height(v);
    UNITVEC_PRECISE float steps = height.x * m;
    // An inexact reciprocal could take z beyond m.
    float z = max(min(steps, m), -m);
    UNITVEC_PRECISE float phi = height.y * (0.5 * m);
    return vec2(abs(z) > m - 0.5 ? 0.0 : phi, z);
}

// Direction of a pair of snorm integers, unit length to within 2 ULP.
vec3 unitvec_cylindrical_from_lattice(vec2 e, float m) {
    float step_size = unitvec_reciprocal(m);
    UNITVEC_PRECISE float square = (m - e.y) * (m + e.y);
    UNITVEC_PRECISE float radius = unitvec_root(square) * step_size;
    UNITVEC_PRECISE float z = e.y * step_size;
    UNITVEC_PRECISE float quarters = e.x * (2.0 * step_size);
    return unitvec_angles_around_z(radius, z, radius > 0.0 ? quarters : 0.0);
}

// The unquantised phi / pi and z, both on [-1, 1].
vec2 float32x3_to_cylindrical(vec3 v) {
    vec2 height = unitvec_cylindrical_height(v);
    float z = max(min(height.x, 1.0), -1.0);
    UNITVEC_PRECISE float turn = 0.5 * height.y;
    return vec2(abs(z) < 1.0 ? turn : 0.0, z);
}

// The direction of phi / pi and z, both on [-1, 1].
vec3 cylindrical_to_float32x3(vec2 e) {
    return unitvec_cylindrical_from_lattice(unitvec_snorm_clamp(e), 1.0);
}

// Variants with values on [0, 1], for a UNORM format, which cannot hold the middle exactly.
vec2 float32x3_to_cylindrical_unorm(vec3 v) { return unitvec_biased(float32x3_to_cylindrical(v)); }
vec3 cylindrical_unorm_to_float32x3(vec2 e) { return cylindrical_to_float32x3(unitvec_unbiased(e)); }

uint unitvec_cylindrical_encode(vec3 v, uint bits) {
    vec2 e = unitvec_cylindrical_lattice(v, unitvec_snorm_max(bits / 2u));
    return unitvec_nearest_code(e.x, bits / 2u) | (unitvec_nearest_code(e.y, bits / 2u) << (bits / 2u));
}

vec3 unitvec_cylindrical_decode(uint code, uint bits) {
    float phi = unitvec_snorm_integer(code, bits / 2u);
    float z = unitvec_snorm_integer(code >> (bits / 2u), bits / 2u);
    return unitvec_cylindrical_from_lattice(vec2(phi, z), unitvec_snorm_max(bits / 2u));
}

uint cylindrical16_encode(vec3 v) { return unitvec_cylindrical_encode(v, 16u); }
uint cylindrical24_encode(vec3 v) { return unitvec_cylindrical_encode(v, 24u); }
uint cylindrical32_encode(vec3 v) { return unitvec_cylindrical_encode(v, 32u); }

vec3 cylindrical16_decode(uint code) { return unitvec_cylindrical_decode(code, 16u); }
vec3 cylindrical24_decode(uint code) { return unitvec_cylindrical_decode(code, 24u); }
vec3 cylindrical32_decode(uint code) { return unitvec_cylindrical_decode(code, 32u); }

#endif
