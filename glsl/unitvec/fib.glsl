// unitvec: spherical Fibonacci points, numbered, in 16, 24 and 32 bits.
//
// Source: Keinert, Innmann, Sänger and Stamminger 2015, "Spherical Fibonacci Mapping".
//
//   fib16_encode(v), fib16_decode(code)      also fib24, 32
//
// The code functions take any v: length does not matter, and +Z stands in for vectors without a direction. Layout: the
// code is the number i of a point, counted from +Z to -Z: with N = 2^bits, its height is 1 - (2i + 1) / N and its
// azimuth frac(0.618... i) of a turn. The encoder finds the nearest point. No axis is a point.

#ifndef UNITVEC_FIB_GLSL
#define UNITVEC_FIB_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// (sqrt(5) - 1) / 2 in 64 bits, rounded.
const uint UNITVEC_FIB_GOLDEN_HIGH = 0x9e3779b9u;
const uint UNITVEC_FIB_GOLDEN_LOW = 0x7f4a7c16u;

// 2 sin(pi d)^2, d in [-1/2, 1/2], in d^2, lowest power first.
const float UNITVEC_CHORD_0 = 19.73919;
const float UNITVEC_CHORD_1 = -64.93598;
const float UNITVEC_CHORD_2 = 85.35731;
const float UNITVEC_CHORD_3 = -59.191452;
const float UNITVEC_CHORD_4 = 21.72156;

// Added to the numbers of points so that those of a cell beside a pole are not negative; the azimuth that this adds.
const uint UNITVEC_FIB_SHIFT = 64u;
const uint UNITVEC_FIB_SHIFT_TURN = 0x8dde6e5fu;

// A direction beside the points, in the hemisphere z >= 0: 1 - z, z, 1 - z^2, and its place among the numbers of the
// points: a whole number, and a fraction to add.
struct UnitvecFibPlace {
    float depth;
    float height;
    float radius_squared;
    uint whole;
    float fraction;
};

// Two steps of the lattice, by the k-th Fibonacci number and the next: the numbers, their turns, and whether k is even.
struct UnitvecFibBasis {
    float step_size;
    float next_step;
    float turn;
    float next_turn;
    bool is_even;
};

// A point, and a measure of its distance from the place sought.
struct UnitvecFibCandidate {
    uint i;
    float cost;
};

// Number of the last point.
uint unitvec_fib_last(uint bits) {
    return 0xffffffffu >> (32u - bits);
}

// Azimuth of point i in turns, a fraction of 32 bits: bits 32 to 63 of the product of i and the golden ratio.
uint unitvec_fib_turn(uint i) {
    uint i_low = i & 0xffffu;
    uint i_high = i >> 16u;
    uint low = i_low * (UNITVEC_FIB_GOLDEN_LOW & 0xffffu);
    uint middle = i_high * (UNITVEC_FIB_GOLDEN_LOW & 0xffffu) + (low >> 16u);
    uint other_middle = i_low * (UNITVEC_FIB_GOLDEN_LOW >> 16u) + (middle & 0xffffu);
    uint high = i_high * (UNITVEC_FIB_GOLDEN_LOW >> 16u) + (middle >> 16u) + (other_middle >> 16u);
    return i * UNITVEC_FIB_GOLDEN_HIGH + high;
}

// unitvec_fib_turn for i below 2^17.
uint unitvec_fib_turn_of_step(uint i) {
    return i * UNITVEC_FIB_GOLDEN_HIGH + (((i & 0x1ffffu) * (UNITVEC_FIB_GOLDEN_LOW >> 17u)) >> 15u);
}

float unitvec_fib_signed_turn(uint turn) {
    UNITVEC_PRECISE float signed_turn = float(int(turn)) * unitvec_exp2(-32);
    return signed_turn;
}

// Integer part of a number from 0 to 2^31, and the rest.
uint unitvec_fib_split(float x, out float rest) {
    int whole = int(x);
    UNITVEC_PRECISE float left = x - float(whole);
    rest = left;
    return uint(whole);
}

// Azimuth of v in turns, a fraction of 32 bits: anything beside the z axis. `scaled` is v at an L1 norm of 1 to 2.
uint unitvec_fib_azimuth(vec3 v, vec3 scaled) {
    float x = max(abs(scaled.x), UNITVEC_ANGLES_LEAST_X);
    float y = max(abs(scaled.y), UNITVEC_ANGLES_LEAST_Y);
    float quotient = unitvec_quotient(min(x, y), max(x, y));
    UNITVEC_PRECISE float part = unitvec_atan_octant_of_normal(quotient) * unitvec_exp2(29);
    uint octant = uint(int(part));
    uint quarter = y > x ? 0x40000000u - octant : octant;
    uint half_turn = unitvec_is_negative(v.x) ? 0x80000000u - quarter : quarter;
    return unitvec_is_negative(v.y) ? 0u - half_turn : half_turn;
}

// Golden ratio, 1.618..., to the power k, below 32.
float unitvec_fib_golden_power(uint k) {
    float one = (k & 1u) != 0u ? 1.618034 : 1.0;
    float two = (k & 2u) != 0u ? 2.618034 : 1.0;
    float four = (k & 4u) != 0u ? 6.854102 : 1.0;
    float eight = (k & 8u) != 0u ? 46.978714 : 1.0;
    float sixteen = (k & 16u) != 0u ? 2206.9995 : 1.0;
    UNITVEC_PRECISE float power = ((one * two) * (four * eight)) * sixteen;
    return power;
}

// Place of a vector with an L1 norm of 1 to 2.
UnitvecFibPlace unitvec_fib_place(vec3 v, uint bits) {
    UNITVEC_PRECISE float horizontal = v.x * v.x + v.y * v.y;
    UNITVEC_PRECISE float square = horizontal + v.z * v.z;
    float reciprocal = unitvec_inverse_root(square);
    UNITVEC_PRECISE float height = abs(v.z) * reciprocal;
    UNITVEC_PRECISE float radius_squared = (horizontal * reciprocal) * reciprocal;
    UNITVEC_PRECISE float from_below = 1.0 + height;
    float from_pole = unitvec_quotient(radius_squared, from_below);
    UNITVEC_PRECISE float from_top = 1.0 - height;
    bool is_polar = height > 0.5;

    UNITVEC_PRECISE float position = (is_polar ? from_pole : height) * unitvec_exp2(int(bits) - 1);
    float rest;
    uint whole = unitvec_fib_split(position, rest);
    UNITVEC_PRECISE float fraction = unitvec_negate_if(!is_polar, rest) - 0.5;
    UnitvecFibPlace place = UnitvecFibPlace(is_polar ? from_pole : from_top, height, radius_squared,
        is_polar ? whole : (1u << (bits - 1u)) - whole, fraction);
    return place;
}

// Basis that is reduced where a horizontal circle has this radius. k is 2 to 25.
UnitvecFibBasis unitvec_fib_basis(float radius_squared, uint bits) {
    // The bits of a float, taken as a number, are about its logarithm.
    UNITVEC_PRECISE float offset = float(bits) + -124.125;
    UNITVEC_PRECISE float logarithm = float(floatBitsToUint(radius_squared) >> 8u) * unitvec_exp2(-15) + offset;
    UNITVEC_PRECISE float zone = 0.7202101 * logarithm;
    float lower = floor(zone);
    uint k = unitvec_whole_to_u32(max(lower, 2.0));
    float power = unitvec_fib_golden_power(k);
    float turn = unitvec_reciprocal(power);
    UNITVEC_PRECISE float next_turn = turn * 0.618034;
    UNITVEC_PRECISE float step_size = power * 0.4472136 + 0.5;
    UNITVEC_PRECISE float next_step = power * 0.7236068 + 0.5;
    UnitvecFibBasis basis =
        UnitvecFibBasis(floor(step_size), floor(next_step), turn, next_turn, (k & 1u) == 0u);
    return basis;
}

// Point i, which the place is `turn` around from. The cost is half the square of the distance, without cancellation.
UnitvecFibCandidate unitvec_fib_candidate(UnitvecFibPlace place, uint i, uint turn, uint bits) {
    UNITVEC_PRECISE float steps = float(int(place.whole - i)) + place.fraction;
    UNITVEC_PRECISE float difference = steps * unitvec_exp2(1 - int(bits));
    UNITVEC_PRECISE float signed_depth = place.depth - difference;
    bool is_point = signed_depth > 0.0;
    float depth = abs(signed_depth);
    UNITVEC_PRECISE float squares = place.radius_squared * (depth * (2.0 - depth));
    float radii = unitvec_root(squares);

    float d = unitvec_fib_signed_turn(turn);
    UNITVEC_PRECISE float u = d * d;
    UNITVEC_PRECISE float chord =
        u * (UNITVEC_CHORD_0
            + u * (UNITVEC_CHORD_1 + u * (UNITVEC_CHORD_2 + u * (UNITVEC_CHORD_3 + u * UNITVEC_CHORD_4))));
    UNITVEC_PRECISE float sum = (place.depth + depth * place.height) + radii;
    UNITVEC_PRECISE float square = difference * difference;
    UNITVEC_PRECISE float cost = unitvec_quotient(square, sum) + radii * chord;
    // More than any distance.
    UnitvecFibCandidate candidate = UnitvecFibCandidate(i, is_point ? cost : 4.0);
    return candidate;
}

// b where it costs less, else a.
UnitvecFibCandidate unitvec_fib_cheaper(UnitvecFibCandidate a, UnitvecFibCandidate b) {
    bool is_b = b.cost < a.cost;
    UnitvecFibCandidate cheaper = UnitvecFibCandidate(is_b ? b.i : a.i, is_b ? b.cost : a.cost);
    return cheaper;
}

// Number of the point of 2^bits that is nearest to the direction of v.
uint unitvec_fib_nearest(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    UNITVEC_PRECISE vec3 scaled = v * unitvec_scale_to_one(norm);
    bool is_mirrored = unitvec_is_negative(v.z);
    uint azimuth = unitvec_fib_azimuth(v, scaled);
    uint turn_to = is_mirrored ? unitvec_fib_turn(unitvec_fib_last(bits)) - azimuth : azimuth;
    UnitvecFibPlace place = unitvec_fib_place(scaled, bits);
    UnitvecFibBasis basis = unitvec_fib_basis(place.radius_squared, bits);

    // The coordinates of the place in the basis, whose determinant is 1 or -1.
    float across = unitvec_negate_if(basis.is_even, unitvec_fib_signed_turn(turn_to));
    UNITVEC_PRECISE float number = place.depth * unitvec_exp2(int(bits) - 1) - 0.5;
    UNITVEC_PRECISE float a = across * basis.next_step + number * basis.next_turn;
    UNITVEC_PRECISE float b = number * basis.turn - across * basis.step_size;

    uint step_size = unitvec_whole_to_u32(basis.step_size);
    uint next_step = unitvec_whole_to_u32(basis.next_step);
    uint turn_step = unitvec_fib_turn_of_step(step_size);
    uint next_turn_step = unitvec_fib_turn_of_step(next_step);
    uint i = uint(int(floor(a))) * step_size + uint(int(floor(b))) * next_step;
    uint off = turn_to + UNITVEC_FIB_SHIFT_TURN - unitvec_fib_turn(i + UNITVEC_FIB_SHIFT);
    uint i_next = i + next_step;
    uint off_next = off - next_turn_step;

    UnitvecFibCandidate near = unitvec_fib_candidate(place, i, off, bits);
    UnitvecFibCandidate right = unitvec_fib_candidate(place, i + step_size, off - turn_step, bits);
    UnitvecFibCandidate up = unitvec_fib_candidate(place, i_next, off_next, bits);
    UnitvecFibCandidate far = unitvec_fib_candidate(place, i_next + step_size, off_next - turn_step, bits);
    UnitvecFibCandidate best = unitvec_fib_cheaper(unitvec_fib_cheaper(unitvec_fib_cheaper(near, right), up), far);
    uint code = (is_mirrored ? ~best.i : best.i) & unitvec_fib_last(bits);
    // The point nearest to +Z is the first.
    return unitvec_is_usable(norm) ? code : 0u;
}

// Point i of 2^bits, of unit length to within 2 ULP. Higher bits of i are ignored.
vec3 unitvec_fib_point(uint i, uint bits) {
    i = i & unitvec_fib_last(bits);
    bool is_mirrored = (i >> (bits - 1u)) != 0u;
    uint from_pole = is_mirrored ? unitvec_fib_last(bits) - i : i;
    float unit = unitvec_exp2(1 - int(bits));
    UNITVEC_PRECISE float depth = (float(int(from_pole)) + 0.5) * unit;
    UNITVEC_PRECISE float height = (float(int(unitvec_fib_last(bits - 1u) - from_pole)) + 0.5) * unit;
    UNITVEC_PRECISE float square = depth * (2.0 - depth);
    float radius = unitvec_root(square);

    uint azimuth = unitvec_fib_turn(i);
    uint quarter = (azimuth + 0x20000000u) >> 30u;
    UNITVEC_PRECISE float half_turns = float(2 * int(azimuth - (quarter << 30u)) + 1) * unitvec_exp2(-32);
    UNITVEC_PRECISE float sine = radius * unitvec_sin_eighth(half_turns);
    UNITVEC_PRECISE float cosine = radius * unitvec_cos_eighth(half_turns);
    bool is_odd = (quarter & 1u) != 0u;
    bool is_turned = (quarter & 2u) != 0u;
    return vec3(
        unitvec_negate_if(is_turned, is_odd ? -sine : cosine),
        unitvec_negate_if(is_turned, is_odd ? cosine : sine),
        unitvec_negate_if(is_mirrored, height));
}

uint fib16_encode(vec3 v) { return unitvec_fib_nearest(v, 16u); }
uint fib24_encode(vec3 v) { return unitvec_fib_nearest(v, 24u); }
uint fib32_encode(vec3 v) { return unitvec_fib_nearest(v, 32u); }

vec3 fib16_decode(uint code) { return unitvec_fib_point(code, 16u); }
vec3 fib24_decode(uint code) { return unitvec_fib_point(code, 24u); }
vec3 fib32_decode(uint code) { return unitvec_fib_point(code, 32u); }

#endif
