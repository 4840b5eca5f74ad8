// unitvec: octahedral codes of two unorms, of 16, 20, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, listings 1 to 3, with 2^b values of equal distance from -1 to 1.
//
//   uoct16p_encode(v), uoct16p_decode(code)     the nearest integer codes; also uoct20p, uoct24p, uoct32p
//   float32x3_to_uoctn_precise(v, n)            the nearest code as a pair on [0, 1], for a unorm format of n bits (even, 4 to
//                                               32); oct_unorm_to_float32x3 of oct.glsl decodes it
//
// All take any input. Of v the length does not matter, and +Z stands in for vectors without a direction or with NaN.
// Layout: x in the low half, y in the high half, i = e + m, with m = (2^b - 1) / 2 and e an odd multiple of 1/2. Code 0, one
// of four corners that are -Z, is never written. Of the axes -Z alone comes back exactly.

#ifndef UNITVEC_UOCT_GLSL
#define UNITVEC_UOCT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The largest coordinate of the lattice of unorms of `bits` bits.
float unitvec_uoct_max(uint bits) {
    return float((1u << bits) - 1u) * 0.5;
}

// Lattice point that is nearest in angle to the direction of v, of this L1 norm, on the square [-m, m]^2 with points at odd
// multiples of 1/2. On the unfolded octahedron the right and the upper corner of a cell are the closest to each other: they
// divide it into two triangles, and the nearest point is a corner of the triangle.
vec2 unitvec_uoct_nearest(vec3 v, float norm, float m) {
    float scale = unitvec_over(m, norm);
    UNITVEC_PRECISE vec3 p = vec3(abs(v.xy), v.z) * scale;
    float below = max(-p.z, 0.0);
    UNITVEC_PRECISE vec2 e = p.xy + below;
    UNITVEC_PRECISE vec2 low = max(floor(e - 0.5) + 0.5, 0.5);
    UNITVEC_PRECISE vec2 high = low + 1.0;
    UNITVEC_PRECISE float depth = m - low.x - low.y;
    float len = unitvec_dot(p, p);

    UNITVEC_PRECISE float folded = max(1.0 - depth, 0.0);
    UNITVEC_PRECISE vec3 d = vec3(low - folded - p.xy, depth - 1.0 - p.z);
    float square = unitvec_dot(d, d);
    float part = unitvec_dot(d, p);
    UNITVEC_PRECISE vec2 squares = square + (2.0 * d.xy + 1.0);
    UNITVEC_PRECISE vec2 parts = part + p.xy;
    vec4 right = unitvec_beside(vec2(high.x, low.y), squares.x, parts.x, len);
    vec4 up = unitvec_beside(vec2(low.x, high.y), squares.y, parts.y, len);

    UNITVEC_PRECISE float sum = e.x + e.y;
    UNITVEC_PRECISE float diagonal = low.x + low.y + 1.0;
    bool is_far = sum >= diagonal;
    float step = is_far ? 1.0 : 0.0;
    float z = is_far ? -1.0 : 1.0;
    UNITVEC_PRECISE float moved = (step + folded) - max((step + step) - depth, 0.0);
    UNITVEC_PRECISE float squared = square + 2.0 * ((moved * (d.x + d.y) + moved * moved) + z * d.z) + 1.0;
    UNITVEC_PRECISE float along = part + moved * (p.x + p.y) + z * p.z;
    vec4 at = unitvec_beside(is_far ? high : low, squared, along, len);
    vec2 nearest = unitvec_nearer(unitvec_nearer(at, right), up).xy;
    // Denormals and -0 count as 0: there is no point between the signs.
    float x = unitvec_is_negative(v.x) ? -nearest.x : nearest.x;
    float y = unitvec_is_negative(v.y) ? -nearest.y : nearest.y;
    return vec2(x, y);
}

// The integers of a lattice point. Another constant in the sum, for rounding, would be joined with the first where compilers
// may do that.
uvec2 unitvec_uoct_integers(vec2 e, uint bits) {
    UNITVEC_PRECISE vec2 i = e + unitvec_uoct_max(bits);
    return uvec2(i);
}

// The integers of the nearest point of any v. The corner of the code 0 becomes the opposite one.
uvec2 unitvec_uoct_precise(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_uoct_nearest(v, norm, unitvec_uoct_max(bits));
    uvec2 i = unitvec_uoct_integers(unitvec_is_usable(norm) ? e : vec2(0.5), bits);
    return (i.x | i.y) == 0u ? uvec2((1u << bits) - 1u) : i;
}

// Direction of a lattice point: unit length to within 2 ULP.
vec3 unitvec_uoct_from_lattice(vec2 e, float m) {
    UNITVEC_PRECISE float z = m - abs(e.x) - abs(e.y);
    float below = max(-z, 0.0);
    UNITVEC_PRECISE float x = e.x - unitvec_with_sign(below, e.x);
    UNITVEC_PRECISE float y = e.y - unitvec_with_sign(below, e.y);
    return unitvec_normalize_octahedral(vec3(x, y, z), m, 0.5 * (m + 0.5));
}

// The precise code of n bits (even, up to 32) as a pair of unorm values on [0, 1].
vec2 float32x3_to_uoctn_precise(vec3 v, int n) {
    uint bits = uint(n / 2);
    uvec2 i = unitvec_uoct_precise(v, bits);
    return vec2(unitvec_snorm_quotient(float(i.x), bits + 1u), unitvec_snorm_quotient(float(i.y), bits + 1u));
}

uint unitvec_uoct_encode(vec3 v, uint bits) {
    uvec2 i = unitvec_uoct_precise(v, bits / 2u);
    return i.x | (i.y << (bits / 2u));
}

vec3 unitvec_uoct_decode(uint code, uint bits) {
    uint low = (1u << (bits / 2u)) - 1u;
    float m = unitvec_uoct_max(bits / 2u);
    UNITVEC_PRECISE vec2 e = vec2(float(code & low), float((code >> (bits / 2u)) & low)) - m;
    return unitvec_uoct_from_lattice(e, m);
}

uint uoct16p_encode(vec3 v) { return unitvec_uoct_encode(v, 16u); }
uint uoct20p_encode(vec3 v) { return unitvec_uoct_encode(v, 20u); }
uint uoct24p_encode(vec3 v) { return unitvec_uoct_encode(v, 24u); }
uint uoct32p_encode(vec3 v) { return unitvec_uoct_encode(v, 32u); }

vec3 uoct16p_decode(uint code) { return unitvec_uoct_decode(code, 16u); }
vec3 uoct20p_decode(uint code) { return unitvec_uoct_decode(code, 20u); }
vec3 uoct24p_decode(uint code) { return unitvec_uoct_decode(code, 24u); }
vec3 uoct32p_decode(uint code) { return unitvec_uoct_decode(code, 32u); }

#endif
