// unitvec: spherical coordinates in 48 bits, finer than a float.
//
// Source: Meyer et al. 2010, table 1; Cigolle et al. 2014, section 2, "spherical". The mapping is that of spherical.glsl.
//
//   spherical48_encode(v), spherical48_decode(code)      codes as uvec2, low word first
//
// Any v will do: length does not matter, and +Z stands in for vectors without a direction. Layout:
// round((2 theta / pi - 1) m) in the low 24 bits, m = 2^23 - 1, theta from +Z; round(phi / pi 2^23) in the next 24,
// periodic; both in two's complement. Sines and cosines are sums of two floats, since one is too coarse. Without
// `precise` (see arith.glsl) a compiler may undo that.

#ifndef UNITVEC_SPHERICAL_WIDE_GLSL
#define UNITVEC_SPHERICAL_WIDE_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The unit of an angle: steps in a quarter turn; the size of a step in half turns, cut down to a power of two; the part
// that was cut off, relative to that.
struct UnitvecSphericalWideSteps {
    int in_quarter;
    float size;
    float excess;
};

// Half a turn has 2^24 - 2 steps of theta and 2^23 of phi.
const UnitvecSphericalWideSteps UNITVEC_SPHERICAL_WIDE_THETA =
    UnitvecSphericalWideSteps(8388607, 5.9604644775390625e-8, 1.1920928955078125e-7);
const UnitvecSphericalWideSteps UNITVEC_SPHERICAL_WIDE_PHI =
    UnitvecSphericalWideSteps(4194304, 1.1920928955078125e-7, 0.0);

// 2^-40: a vector of about unit length that is nearer to the z axis counts as a pole.
const float UNITVEC_SPHERICAL_WIDE_POLAR = 9.094947017729282e-13;

// Numbers as sums of two floats are vec2: the second is the part that the first lacks. This one is a + b + low, where a
// is 0 or no less than b in magnitude, and low is far less.
vec2 unitvec_spherical_wide_sum(float a, float b, float low) {
    UNITVEC_PRECISE float high = a + b;
    UNITVEC_PRECISE float rest = (b - (high - a)) + low;
    return vec2(high, rest);
}

vec2 unitvec_spherical_wide_product(vec2 a, vec2 b) {
    UNITVEC_PRECISE float high = a.x * b.x;
    UNITVEC_PRECISE float crosswise = a.x * b.y + a.y * b.x;
    UNITVEC_PRECISE float low = unitvec_product_rest(a.x, b.x, high) + crosswise;
    return vec2(high, low);
}

// base + low + linear u + rest, in order of magnitude: base, linear u, rest, low.
vec2 unitvec_spherical_wide_polynomial(float base, float low, float slope, float u, float rest) {
    UNITVEC_PRECISE float product = slope * u;
    vec2 sum = unitvec_spherical_wide_sum(product, rest, unitvec_product_rest(slope, u, product));
    UNITVEC_PRECISE float lows = sum.y + low;
    return unitvec_spherical_wide_sum(base, sum.x, lows);
}

// Cosine and sine of n steps, up to an eighth of a turn.
void unitvec_spherical_wide_octant(int n, UnitvecSphericalWideSteps steps, out vec2 cosine, out vec2 sine) {
    // Two products, both exact: Microsoft's FXC takes a whole number times 1e-6 or less for a whole number, and where it
    // is at most 1, its square for itself.
    UNITVEC_PRECISE float scaled = float(n) * (steps.size * 4096.0);
    UNITVEC_PRECISE float r = scaled * 0.000244140625;
    UNITVEC_PRECISE float u = r * r;
    UNITVEC_PRECISE float cosine_rest =
        (u * u) * (UNITVEC_COS_1 + u * (UNITVEC_COS_2 + u * UNITVEC_COS_3));
    UNITVEC_PRECISE float sine_rest = (u * u) * (UNITVEC_SIN_2 + u * UNITVEC_SIN_3);
    vec2 c = unitvec_spherical_wide_polynomial(1.0, 0.0, UNITVEC_COS_0, u, cosine_rest);
    vec2 sine_over_r = unitvec_spherical_wide_polynomial(UNITVEC_PI, UNITVEC_SIN_0, UNITVEC_SIN_1, u, sine_rest);
    vec2 s = unitvec_spherical_wide_product(vec2(r, 0.0), sine_over_r);

    // The rest of the angle is so small that it is its own sine, and its cosine is 1.
    UNITVEC_PRECISE float turn = r * (UNITVEC_PI * steps.excess);
    UNITVEC_PRECISE float along = -(turn * s.x);
    UNITVEC_PRECISE float across = turn * c.x;
    cosine = unitvec_spherical_wide_sum(c.x, c.y, along);
    sine = unitvec_spherical_wide_sum(s.x, s.y, across);
}

// Cosine and sine of n steps, up to a quarter turn.
void unitvec_spherical_wide_quarter(int n, UnitvecSphericalWideSteps steps, out vec2 x, out vec2 y) {
    int rest = steps.in_quarter - n;
    bool steep = n > rest;
    vec2 cosine;
    vec2 sine;
    unitvec_spherical_wide_octant(steep ? rest : n, steps, cosine, sine);
    x = steep ? sine : cosine;
    y = steep ? cosine : sine;
}

// Number of steps nearest to the angle of (x, y) from +X; neither is negative. An estimate in single precision is put
// right by how far (x, y) lies from its direction.
int unitvec_spherical_wide_nearest(vec2 x, vec2 y, UnitvecSphericalWideSteps steps) {
    bool steep = y.x > x.x;
    vec2 longer = steep ? y : x;
    vec2 shorter = steep ? x : y;
    UNITVEC_PRECISE float part = unitvec_atan_octant_ratio(shorter.x, longer.x) * unitvec_over(0.25, steps.size) + 0.5;
    int estimate = int(part);

    vec2 cosine;
    vec2 sine;
    unitvec_spherical_wide_octant(estimate, steps, cosine, sine);
    vec2 forth = unitvec_spherical_wide_product(shorter, cosine);
    vec2 back = unitvec_spherical_wide_product(longer, sine);
    UNITVEC_PRECISE float across = (forth.x - back.x) + (forth.y - back.y);
    UNITVEC_PRECISE float square = longer.x * longer.x + shorter.x * shorter.x;
    float root = unitvec_root(square);
    UNITVEC_PRECISE float radians = max(root, UNITVEC_SPHERICAL_WIDE_POLAR) * (UNITVEC_PI * steps.size);
    UNITVEC_PRECISE float off = unitvec_signed_quotient(across, radians) + 0.5;
    int n = estimate + int(floor(off));
    return steep ? steps.in_quarter - n : n;
}

// Length of (x, y), neither of which is negative.
vec2 unitvec_spherical_wide_length(float x, float y) {
    float longer = y > x ? y : x;
    float shorter = y > x ? x : y;
    UNITVEC_PRECISE float a = longer * longer;
    UNITVEC_PRECISE float b = shorter * shorter;
    UNITVEC_PRECISE float squares = a + b;
    float first = unitvec_root(squares);
    float root = max(first, UNITVEC_SPHERICAL_WIDE_POLAR);
    UNITVEC_PRECISE float square = root * root;
    UNITVEC_PRECISE float rests =
        (unitvec_product_rest(longer, longer, a) - unitvec_product_rest(root, root, square))
        + unitvec_product_rest(shorter, shorter, b);
    UNITVEC_PRECISE float left = ((a - square) + b) + rests;
    UNITVEC_PRECISE float doubled = 2.0 * root;
    return vec2(root, unitvec_signed_quotient(left, doubled));
}

uvec2 spherical48_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 p = abs(unitvec_scaled_to_one(v, unitvec_l1_norm(v)));
    vec2 radius = unitvec_spherical_wide_length(p.x, p.y);
    int latitude = unitvec_spherical_wide_nearest(radius, vec2(p.z, 0.0), UNITVEC_SPHERICAL_WIDE_THETA);
    int turned = unitvec_spherical_wide_nearest(vec2(p.x, 0.0), vec2(p.y, 0.0), UNITVEC_SPHERICAL_WIDE_PHI);
    turned = unitvec_is_negative(v.x) ? 8388608 - turned : turned;
    int longitude = latitude < 8388607 ? turned : 0;

    uint i = uint(unitvec_is_negative(v.z) ? latitude : -latitude) & unitvec_mask(24u);
    uint j = uint(unitvec_is_negative(v.y) ? -longitude : longitude) & unitvec_mask(24u);
    return uvec2(i | (j << 24u), j >> 8u);
}

vec3 spherical48_decode(uvec2 code) {
    int i = int(code.x << 8u) >> 8;
    int j = int(((code.x >> 24u) | (code.y << 8u)) << 8u) >> 8;
    int latitude = min(abs(i), 8388607);
    int longitude = latitude < 8388607 ? abs(j) : 0;

    bool left = longitude > 4194304;
    vec2 radius;
    vec2 z;
    unitvec_spherical_wide_quarter(latitude, UNITVEC_SPHERICAL_WIDE_THETA, radius, z);
    vec2 x;
    vec2 y;
    unitvec_spherical_wide_quarter(left ? 8388608 - longitude : longitude, UNITVEC_SPHERICAL_WIDE_PHI, x, y);
    x = unitvec_spherical_wide_product(radius, x);
    y = unitvec_spherical_wide_product(radius, y);
    UNITVEC_PRECISE vec3 v = vec3(x.x + x.y, y.x + y.y, z.x + z.y);
    return vec3(unitvec_negate_positive(left, v.x), unitvec_negate_positive(j < 0, v.y), unitvec_negate_if(i > 0, v.z));
}

#endif
