// unitvec: hemi-octahedral codes of 16, 24 and 32 bits, for directions with z >= 0.
//
// Source: Cigolle et al. 2014, listing 6.
//
//   hemioct16_encode(v), hemioct16_decode(code)      integer codes; also hemioct24, hemioct32
//   hemioct16p_encode(v), ...                        the nearest codes of the same formats
//   float32x3_to_hemioctn_precise(v, n)              the nearest code as a pair on [-1, 1], for a format of n bits (even, to 32)
//   float32x3_to_hemioct(v)                          a pair on [-1, 1], for an snorm format that the hardware converts
//   hemioct_to_float32x3(e)                          the direction of such a pair
//   float32x3_to_hemioct_unorm(v), hemioct_unorm_to_float32x3(e)      the same on [0, 1], for a unorm format
//
// All take any input. Below the equator z counts as 0, and +Z stands in for vectors without a direction or with NaN; a
// pair is clamped to [-1, 1]. Layout: u = x + y in the low half, v = x - y in the high half, two's complement snorm.

#ifndef UNITVEC_HEMIOCT_GLSL
#define UNITVEC_HEMIOCT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The place of (v.x, v.y) on the square [-m, m]^2 (listing 6); `norm` is the L1 norm of the vector with z >= 0.
vec2 unitvec_hemioct_position(vec3 v, float norm, float m) {
    UNITVEC_PRECISE vec2 e = vec2(v.x + v.y, v.x - v.y) * unitvec_over(m, norm);
    return e;
}

// The L1 norms of v, and of v moved up to the equator if below it.
vec2 unitvec_hemioct_norms(vec3 v) {
    UNITVEC_PRECISE float across = abs(v.x) + abs(v.y);
    UNITVEC_PRECISE vec2 norms = vec2(across + abs(v.z), across + max(v.z, 0.0));
    return norms;
}

// True where both norms give a direction: the first, not the smaller one, is not too large, the second not too small.
bool unitvec_hemioct_is_usable(vec2 norms) {
    return floatBitsToUint(norms.x) < floatBitsToUint(UNITVEC_MAX_NORM) &&
        floatBitsToUint(norms.y) >= floatBitsToUint(UNITVEC_MIN_NORM);
}

// Direction of a lattice point (listing 6), unit length to within 2 ULP. |p.x| + |p.y| is twice the larger of |e.x| and
// |e.y|, so that z is not negative.
vec3 unitvec_hemioct_from_lattice(vec2 e, float m) {
    UNITVEC_PRECISE vec2 p = vec2(e.x + e.y, e.x - e.y);
    UNITVEC_PRECISE float z = 2.0 * (m - max(abs(e.x), abs(e.y)));
    return unitvec_normalize_octahedral(vec3(p, z), m, m + 1.0);
}

// Listing 6: the projection, unquantised, on [-1, 1]^2. +Z stands in for vectors without a direction, or without one
// above the equator.
vec2 float32x3_to_hemioct(vec3 v) {
    vec2 norms = unitvec_hemioct_norms(v);
    vec2 e = unitvec_hemioct_position(v, norms.y, 1.0);
    return unitvec_hemioct_is_usable(norms) ? e : vec2(0.0);
}

// Listing 6: the direction of a pair of snorm values on [-1, 1].
vec3 hemioct_to_float32x3(vec2 e) {
    return unitvec_hemioct_from_lattice(unitvec_snorm_clamp(e), 1.0);
}

// Variants with values on [0, 1], for a UNORM format, which cannot hold the middle exactly.
vec2 float32x3_to_hemioct_unorm(vec3 v) { return unitvec_biased(float32x3_to_hemioct(v)); }
vec3 hemioct_unorm_to_float32x3(vec2 e) { return hemioct_to_float32x3(unitvec_unbiased(e)); }

// The corner (u, v) of a lattice cell, as p sees it, of an L1 norm of 2 m: unitvec_beside.
vec4 unitvec_hemioct_corner(vec2 e, vec3 p, float m, float len) {
    UNITVEC_PRECISE vec3 c = vec3(e.x + e.y, e.x - e.y, 2.0 * (m - max(abs(e.x), abs(e.y))));
    UNITVEC_PRECISE vec3 d = c - p;
    return unitvec_beside(e, unitvec_dot(d, d), unitvec_dot(d, p), len);
}

// Lattice point that is nearest in angle to v, which has z >= 0 and this L1 norm.
vec2 unitvec_hemioct_precise_point(vec3 v, float norm, float m) {
    vec2 e = unitvec_hemioct_position(v, norm, m);
    UNITVEC_PRECISE vec3 p = v * unitvec_over(2.0 * m, norm);
    vec2 low = floor(e);
    UNITVEC_PRECISE vec2 high = low + 1.0;
    float len = unitvec_dot(p, p);
    vec4 near = unitvec_hemioct_corner(low, p, m, len);
    vec4 right = unitvec_hemioct_corner(vec2(high.x, low.y), p, m, len);
    vec4 up = unitvec_hemioct_corner(vec2(low.x, high.y), p, m, len);
    vec4 far = unitvec_hemioct_corner(high, p, m, len);
    return unitvec_nearer(unitvec_nearer(unitvec_nearer(near, right), up), far).xy;
}

// Lattice point that is nearest to any v; (0, 0) where it has no direction above the equator or on it.
vec2 unitvec_hemioct_lattice_precise(vec3 v, float m) {
    vec2 norms = unitvec_hemioct_norms(v);
    vec2 e = unitvec_hemioct_precise_point(vec3(v.xy, max(v.z, 0.0)), norms.y, m);
    return unitvec_hemioct_is_usable(norms) ? e : vec2(0.0);
}

// The nearest code of n bits (even, up to 32) as a pair of snorm values on [-1, 1].
vec2 float32x3_to_hemioctn_precise(vec3 v, int n) {
    uint bits = uint(n / 2);
    vec2 e = unitvec_hemioct_lattice_precise(v, unitvec_snorm_max(bits));
    return vec2(unitvec_snorm_quotient(e.x, bits), unitvec_snorm_quotient(e.y, bits));
}

uint unitvec_hemioct_encode_precise(vec3 v, uint bits) {
    return unitvec_nearest_pair(unitvec_hemioct_lattice_precise(v, unitvec_snorm_max(bits / 2u)), bits / 2u);
}

uint unitvec_hemioct_encode(vec3 v, uint bits) {
    vec2 norms = unitvec_hemioct_norms(v);
    vec2 e = unitvec_hemioct_position(v, norms.y, unitvec_snorm_max(bits / 2u));
    uint code = unitvec_nearest_pair(e, bits / 2u);
    return unitvec_hemioct_is_usable(norms) ? code : 0u;
}

vec3 unitvec_hemioct_decode(uint code, uint bits) {
    return unitvec_hemioct_from_lattice(unitvec_snorm_integers(code, bits / 2u), unitvec_snorm_max(bits / 2u));
}

uint hemioct16_encode(vec3 v) { return unitvec_hemioct_encode(v, 16u); }
uint hemioct24_encode(vec3 v) { return unitvec_hemioct_encode(v, 24u); }
uint hemioct32_encode(vec3 v) { return unitvec_hemioct_encode(v, 32u); }

vec3 hemioct16_decode(uint code) { return unitvec_hemioct_decode(code, 16u); }
vec3 hemioct24_decode(uint code) { return unitvec_hemioct_decode(code, 24u); }
vec3 hemioct32_decode(uint code) { return unitvec_hemioct_decode(code, 32u); }

uint hemioct16p_encode(vec3 v) { return unitvec_hemioct_encode_precise(v, 16u); }
uint hemioct24p_encode(vec3 v) { return unitvec_hemioct_encode_precise(v, 24u); }
uint hemioct32p_encode(vec3 v) { return unitvec_hemioct_encode_precise(v, 32u); }

vec3 hemioct16p_decode(uint code) { return hemioct16_decode(code); }
vec3 hemioct24p_decode(uint code) { return hemioct24_decode(code); }
vec3 hemioct32p_decode(uint code) { return hemioct32_decode(code); }

#endif
