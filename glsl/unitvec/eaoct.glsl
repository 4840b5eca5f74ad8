// unitvec: equal-area octahedral codes of 16, 20, 22, 24 and 32 bits.
//
// Source: Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD" (the map).
//
//   eaoct16_encode(v), eaoct16_decode(code)      integer codes; also eaoct20, eaoct22, eaoct24, eaoct32
//   eaoct16p_encode(v), ...                      precise encoders of the same formats
//   float32x3_to_eaoct(v)                        a pair on [-1, 1], for an snorm format that the hardware converts
//   float32x3_to_eaoctn_precise(v, n)            the precise code as such a pair, for a format of n bits (even, 16 to 32)
//   eaoct_to_float32x3(e)                        the direction of such a pair
//   float32x3_to_eaoct_unorm(v), eaoct_unorm_to_float32x3(e)      the same on [0, 1], for a unorm format
//
// All take any input. Of v the length does not matter, and +Z stands in for vectors without a direction or with NaN; a
// pair is clamped to [-1, 1]. Layout: that of oct.glsl. With m the snorm's largest integer, the lattice points of an
// octant lie on circles of latitude, the rings: ring s, 0 (the pole) to m (the equator), at r = sqrt(1 - |z|) = s / m,
// has the points 0 to s at equal distances.

#ifndef UNITVEC_EAOCT_GLSL
#define UNITVEC_EAOCT_GLSL

#ifndef UNITVEC_OCT_GLSL
#include "oct.glsl"
#endif

precision highp float;
precision highp int;

// 2^-26, the least value that x and y count as, beside an L1 norm of 1 to 2: no scaled denormal is more.
const float UNITVEC_EAOCT_LEAST = 1.4901161193847656e-8;

// A direction of the positive octant, mirrored so that phi is at most 1/2.
struct UnitvecEaoctPolar {
    float radius;
    float turn;
    bool swapped;
};

// r and phi (in quarter turns) of the direction of v, scaled by a power of two, exactly, to an L1 norm of 1 to 2.
// Unspecified without a usable direction.
UnitvecEaoctPolar unitvec_eaoct_polar(vec3 v, float norm) {
    UNITVEC_PRECISE vec3 p = abs(v) * unitvec_scale_to_one(norm);
    float x = max(p.x, UNITVEC_EAOCT_LEAST);
    float y = max(p.y, UNITVEC_EAOCT_LEAST);
    float a = max(x, y);
    float b = min(x, y);

    UNITVEC_PRECISE float horizontal = a * a + b * b;
    UNITVEC_PRECISE float square = horizontal + p.z * p.z;
    float len = unitvec_root(square);
    UNITVEC_PRECISE float product = len * (len + p.z);
    float radius = unitvec_root(unitvec_quotient(horizontal, product));
    float q = unitvec_quotient(b, a);
    UnitvecEaoctPolar polar = UnitvecEaoctPolar(radius, unitvec_atan_quarter(q), y > x);
    return polar;
}

// Moves a lattice point of that half octant to the half octant of the direction of v. With m the largest coordinate,
// (x, y) is folded out to (m - y, m - x), which is as far away along both axes.
vec2 unitvec_eaoct_unfolded(vec3 v, bool swapped, float ring, float place, float m) {
    UNITVEC_PRECISE float other = ring - place;
    float x = swapped ? place : other;
    float y = swapped ? other : place;
    UNITVEC_PRECISE float rest = m - ring;
    float folded = unitvec_is_negative(v.z) ? rest : 0.0;
    UNITVEC_PRECISE vec2 e = vec2(x, y) + folded;
    return vec2(unitvec_with_sign(e.x, v.x), unitvec_with_sign(e.y, v.y));
}

// Lattice point of the direction of v: on the nearest ring the nearest point. Unspecified without a usable direction.
vec2 unitvec_eaoct_lattice(vec3 v, float norm, float m) {
    UnitvecEaoctPolar p = unitvec_eaoct_polar(v, norm);
    UNITVEC_PRECISE float steps = p.radius * m + 0.5;
    float ring = floor(steps);
    UNITVEC_PRECISE float along = p.turn * ring + 0.5;
    return unitvec_eaoct_unfolded(v, p.swapped, ring, floor(along), m);
}

// The nearest point on a ring that is at most a step from p: the ring, the point's number, and a measure of the
// chord's square, (r C - R c)^2 + 4 r R c C sin^2(pi q / 4) with c^2 = 2 - r^2 and C^2 = 2 - R^2, times c^4 m^2 / 4.
vec3 unitvec_eaoct_candidate(UnitvecEaoctPolar p, float ring, float m) {
    const float PI_2_16 = 0.61685026;
    const float PI_2_16_TIMES_PI_2_48 = 0.12683475;
    UNITVEC_PRECISE float steps = p.radius * m;
    UNITVEC_PRECISE float along = p.turn * ring;
    UNITVEC_PRECISE float place = floor(along + 0.5);
    UNITVEC_PRECISE float across = ring - steps;
    UNITVEC_PRECISE float beside = along - place;
    float q = unitvec_signed_quotient(beside, max(ring, 1.0));

    UNITVEC_PRECISE float c_squared = 2.0 - p.radius * p.radius;
    UNITVEC_PRECISE float change = across * (p.radius * unitvec_reciprocal(m));
    UNITVEC_PRECISE float turned = (steps * ring) * (q * q) * (PI_2_16 - PI_2_16_TIMES_PI_2_48 * (q * q));
    UNITVEC_PRECISE float cost =
        across * across * (c_squared + change) + turned * ((c_squared * c_squared) * (c_squared - change));
    return vec3(ring, place, cost);
}

// Lattice point of the direction of v that is nearest in angle: the nearest one of the ring below or above.
vec2 unitvec_eaoct_lattice_precise(vec3 v, float norm, float m) {
    UnitvecEaoctPolar p = unitvec_eaoct_polar(v, norm);
    UNITVEC_PRECISE float below = floor(p.radius * m);
    UNITVEC_PRECISE float above = below + 1.0;
    vec3 inner = unitvec_eaoct_candidate(p, below, m);
    vec3 outer = unitvec_eaoct_candidate(p, above, m);
    vec3 nearest = outer.z < inner.z ? outer : inner;
    return unitvec_eaoct_unfolded(v, p.swapped, nearest.x, nearest.y, m);
}

// The place of a lattice point: number `place` on ring `ring`, mirrored so that this is at most half of `ring`. `above`
// is negative below the equator.
struct UnitvecEaoctRing {
    float ring;
    float place;
    float above;
    bool swapped;
};

UnitvecEaoctRing unitvec_eaoct_ring_of(vec2 e, float m) {
    vec2 a = abs(e);
    UNITVEC_PRECISE float sum = a.x + a.y;
    UNITVEC_PRECISE float above = m - sum;
    UNITVEC_PRECISE float folded_ring = 2.0 * m - sum;
    float ring = min(sum, folded_ring);
    UNITVEC_PRECISE float folded_place = m - max(a.x, a.y);
    UnitvecEaoctRing at = UnitvecEaoctRing(ring, min(min(a.x, a.y), folded_place), above, a.y > a.x);
    return at;
}

// Direction at phi = `turn`, 0 to 1/2, on a ring, with the signs of e: unit length to within 2 ULP.
vec3 unitvec_eaoct_from_ring(vec2 e, float ring, float turn, bool swapped, float above, float m) {
    UNITVEC_PRECISE float eighth = 0.5 * turn;
    float sine = unitvec_sin_eighth(eighth);
    float cosine = unitvec_cos_eighth(eighth);
    UNITVEC_PRECISE float radius = ring * unitvec_reciprocal(m);
    UNITVEC_PRECISE float z = (1.0 - radius) * (1.0 + radius);
    UNITVEC_PRECISE float from_below = 1.0 + z;
    UNITVEC_PRECISE float horizontal = radius * unitvec_root(from_below);
    UNITVEC_PRECISE float near_axis = horizontal * cosine;
    UNITVEC_PRECISE float off_axis = horizontal * sine;
    float x = swapped ? off_axis : near_axis;
    float y = swapped ? near_axis : off_axis;
    return vec3(
        unitvec_negate_positive(e.x < 0.0, x), unitvec_negate_positive(e.y < 0.0, y), unitvec_with_sign(z, above));
}

// Direction of a lattice point.
vec3 unitvec_eaoct_from_lattice(vec2 e, float m) {
    UnitvecEaoctRing at = unitvec_eaoct_ring_of(e, m);
    float turn = unitvec_quotient(at.place, max(at.ring, UNITVEC_MIN_POSITIVE));
    return unitvec_eaoct_from_ring(e, at.ring, turn, at.swapped, at.above, m);
}

// The projection, unquantised, on [-1, 1]^2, for an snorm target that the hardware rounds: a mean error 8 % and a
// maximum 43 % above those of unitvec_eaoct_lattice.
vec2 float32x3_to_eaoct(vec3 v) {
    float norm = unitvec_l1_norm(v);
    UnitvecEaoctPolar p = unitvec_eaoct_polar(v, norm);
    UNITVEC_PRECISE float place = p.radius * p.turn;
    vec2 e = unitvec_eaoct_unfolded(v, p.swapped, p.radius, place, 1.0);
    return unitvec_is_usable(norm) ? e : vec2(0.0);
}

// The direction of a pair of snorm values on [-1, 1].
vec3 eaoct_to_float32x3(vec2 e) {
    return unitvec_eaoct_from_lattice(unitvec_snorm_clamp(e), 1.0);
}

// Variants with values on [0, 1], for a UNORM format, which cannot hold the middle exactly.
vec2 float32x3_to_eaoct_unorm(vec3 v) { return unitvec_biased(float32x3_to_eaoct(v)); }
vec3 eaoct_unorm_to_float32x3(vec2 e) { return eaoct_to_float32x3(unitvec_unbiased(e)); }

// The precise code of n bits (even, 16 to 32) as a pair of snorm values on [-1, 1].
vec2 float32x3_to_eaoctn_precise(vec3 v, int n) {
    float norm = unitvec_l1_norm(v);
    uint bits = uint(n / 2);
    vec2 e = unitvec_eaoct_lattice_precise(v, norm, unitvec_snorm_max(bits));
    e = vec2(unitvec_snorm_quotient(e.x, bits), unitvec_snorm_quotient(e.y, bits));
    return unitvec_is_usable(norm) ? e : vec2(0.0);
}

uint unitvec_eaoct_encode(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_eaoct_lattice(v, norm, unitvec_snorm_max(bits / 2u));
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(e, bits), bits);
}

uint unitvec_eaoct_encode_precise(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_eaoct_lattice_precise(v, norm, unitvec_snorm_max(bits / 2u));
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(e, bits), bits);
}

vec3 unitvec_eaoct_decode(uint code, uint bits) {
    return unitvec_eaoct_from_lattice(unitvec_oct_unpack(code, bits), unitvec_snorm_max(bits / 2u));
}

uint eaoct16_encode(vec3 v) { return unitvec_eaoct_encode(v, 16u); }
uint eaoct20_encode(vec3 v) { return unitvec_eaoct_encode(v, 20u); }
uint eaoct22_encode(vec3 v) { return unitvec_eaoct_encode(v, 22u); }
uint eaoct24_encode(vec3 v) { return unitvec_eaoct_encode(v, 24u); }
uint eaoct32_encode(vec3 v) { return unitvec_eaoct_encode(v, 32u); }

uint eaoct16p_encode(vec3 v) { return unitvec_eaoct_encode_precise(v, 16u); }
uint eaoct20p_encode(vec3 v) { return unitvec_eaoct_encode_precise(v, 20u); }
uint eaoct22p_encode(vec3 v) { return unitvec_eaoct_encode_precise(v, 22u); }
uint eaoct24p_encode(vec3 v) { return unitvec_eaoct_encode_precise(v, 24u); }
uint eaoct32p_encode(vec3 v) { return unitvec_eaoct_encode_precise(v, 32u); }

vec3 eaoct16_decode(uint code) { return unitvec_eaoct_decode(code, 16u); }
vec3 eaoct20_decode(uint code) { return unitvec_eaoct_decode(code, 20u); }
vec3 eaoct22_decode(uint code) { return unitvec_eaoct_decode(code, 22u); }
vec3 eaoct24_decode(uint code) { return unitvec_eaoct_decode(code, 24u); }
vec3 eaoct32_decode(uint code) { return unitvec_eaoct_decode(code, 32u); }

vec3 eaoct16p_decode(uint code) { return eaoct16_decode(code); }
vec3 eaoct20p_decode(uint code) { return eaoct20_decode(code); }
vec3 eaoct22p_decode(uint code) { return eaoct22_decode(code); }
vec3 eaoct24p_decode(uint code) { return eaoct24_decode(code); }
vec3 eaoct32p_decode(uint code) { return eaoct32_decode(code); }

#endif
