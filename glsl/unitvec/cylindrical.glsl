// unitvec: cylindrical coordinates in 16, 24 and 32 bits.
//
// Source: the pair (atan2(y, x) / pi, z) of K. Narkowicz's article on octahedron normals.
//
//   cylindrical16_encode(v), cylindrical16_decode(code)      also cylindrical24, 32
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. Layout: phi /
// pi in the low half, z in the high half, two's complement snorm.

#ifndef UNITVEC_CYLINDRICAL_GLSL
#define UNITVEC_CYLINDRICAL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The snorm integers of the direction of v: phi / pi and z. m is the snorm's largest.
vec2 unitvec_cylindrical_lattice(vec3 v, float m) {
    v = unitvec_angles_scaled(v);
    UNITVEC_PRECISE float height = v.z * (1.0 / sqrt(unitvec_dot(v, v))) * m;
    UNITVEC_PRECISE float angle = unitvec_atan2_half_turns(v.y, v.x) * m;
    float z = unitvec_round_symmetric(height);
    // An inexact reciprocal could take z beyond m.
    vec2 pole = vec2(0.0, unitvec_negate_if(unitvec_is_negative(z), m));
    return abs(z) < m ? vec2(unitvec_round_symmetric(angle), z) : pole;
}

// Direction of a pair of snorm integers, unit length to within 2 ULP.
vec3 unitvec_cylindrical_from_lattice(vec2 e, float m) {
    UNITVEC_PRECISE float step_size = 1.0 / m;
    UNITVEC_PRECISE float radius = sqrt((m - e.y) * (m + e.y)) * step_size;
    UNITVEC_PRECISE vec2 values = e * step_size;
    return unitvec_angles_around_z(radius, values.y, values.x);
}

uint unitvec_cylindrical_encode(vec3 v, uint bits) {
    vec2 e = unitvec_cylindrical_lattice(v, unitvec_snorm_max(bits / 2u));
    return unitvec_signed_code(e.x, bits / 2u) | (unitvec_signed_code(e.y, bits / 2u) << (bits / 2u));
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
