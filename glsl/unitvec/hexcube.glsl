// unitvec: a hexagonal lattice on each face of a cube, warped to be even on the sphere, in 16, 24 and 32 bits.
//
// Source: this library's own; the cube is that of `cube.glsl`, with other coordinates on its faces.
//
//   hexcube16_encode(v), hexcube16_decode(code)      integer codes; also hexcube24, hexcube32
//
// The code functions take any v: length does not matter, and +Z stands in for vectors without a direction. Layout: the
// points of the faces +X, -X, +Y, -Y, +Z, -Z one after another, each by rows from the least v, and within a row from
// the least u. (u, v) is (y, z), (x, z), (x, y) on the faces of x, y, z. Every other row has a point less. Past the
// last code all decode like the last.

#ifndef UNITVEC_HEXCUBE_GLSL
#define UNITVEC_HEXCUBE_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The warp's weight: u = X / (17/8 + |X|).
const float UNITVEC_HEXCUBE_WEIGHT = 2.125;

// Coefficients of the shear, and of the square of a pair of rows' distance, in columns.
const float UNITVEC_HEXCUBE_SHEAR = 9.19;
const float UNITVEC_HEXCUBE_HEIGHT_0 = 0.5332;
const float UNITVEC_HEXCUBE_HEIGHT_1 = 5.082;
const float UNITVEC_HEXCUBE_HEIGHT_2 = 17.14;

// Its sums with numbers of up to 2^20 count in halves.
const float UNITVEC_HEXCUBE_COUNTING_HALVES = 6291456.0;

// Half columns from a face's first point to its last, rows from its middle to the last row, both even; half columns and
// rows from u = 0 to 1 and from v = 0 to 1, beyond the edges at 8/25.
struct UnitvecHexcubeLattice {
    int columns;
    int rows;
    float across;
    float along;
};

const UnitvecHexcubeLattice UNITVEC_HEXCUBE_LATTICE_16 = UnitvecHexcubeLattice(96, 56, 300.25, 176.65625);
const UnitvecHexcubeLattice UNITVEC_HEXCUBE_LATTICE_24 = UnitvecHexcubeLattice(1552, 900, 4850.015625, 2814.0625);
const UnitvecHexcubeLattice UNITVEC_HEXCUBE_LATTICE_32 =
    UnitvecHexcubeLattice(24778, 14444, 77431.328125, 45139.0625);

// Half columns in two rows, which have together as many points.
int unitvec_hexcube_line(UnitvecHexcubeLattice lattice) {
    return 2 * lattice.columns + 1;
}

// The number of the middle within a face's codes.
int unitvec_hexcube_middle(UnitvecHexcubeLattice lattice) {
    return (lattice.rows * unitvec_hexcube_line(lattice) + lattice.columns) / 2;
}

// Codes of a face.
uint unitvec_hexcube_face(UnitvecHexcubeLattice lattice) {
    return uint(2 * unitvec_hexcube_middle(lattice) + 1);
}

// The nearest whole number, the even one of two, for magnitudes up to 2^21. It converts integers: where compilers may, they
// join the two constants of the sum with 1.5 2^23 and back.
float unitvec_hexcube_rounded(float x) {
    UNITVEC_PRECISE float sum = x + UNITVEC_ONE_AND_A_HALF_2_23;
    return float(int(floatBitsToUint(sum) - floatBitsToUint(UNITVEC_ONE_AND_A_HALF_2_23)));
}

// The point of the quarter face u, v >= 0 for X and Y: p over side. Its column, from the middle on, and its row in
// pairs: whole numbers, or both halves.
vec2 unitvec_hexcube_nearest(vec2 p, float side, UnitvecHexcubeLattice lattice) {
    UNITVEC_PRECISE float weight = UNITVEC_HEXCUBE_WEIGHT * side;
    UNITVEC_PRECISE vec2 warped = weight + p;
    UNITVEC_PRECISE float u = p.x * unitvec_reciprocal(warped.x);
    UNITVEC_PRECISE float v = p.y * unitvec_reciprocal(warped.y);
    UNITVEC_PRECISE float x = u * (0.5 * lattice.across);
    UNITVEC_PRECISE float y = v * (0.5 * lattice.along);
    float last_x = 0.5 * float(lattice.columns);
    float last_y = 0.5 * float(lattice.rows);

    float whole_y = unitvec_hexcube_rounded(y);
    UNITVEC_PRECISE float from_whole = y - whole_y;
    float half_row = unitvec_with_sign(0.5, from_whole);
    UNITVEC_PRECISE float shear = (u * v) * UNITVEC_HEXCUBE_SHEAR;
    UNITVEC_PRECISE float x_of_whole = x - shear * from_whole;
    UNITVEC_PRECISE float x_of_half = x_of_whole + shear * half_row;
    float whole_x = min(unitvec_hexcube_rounded(x_of_whole), last_x);
    UNITVEC_PRECISE float nearest_half_x = floor(x_of_half) + 0.5;
    float half_x = min(nearest_half_x, last_x - 0.5);
    UNITVEC_PRECISE float off_whole = x_of_whole - whole_x;
    UNITVEC_PRECISE float off_half = x_of_half - half_x;

    // The squares of the distances from the rows differ by |from_whole| - 1/4.
    UNITVEC_PRECISE float height =
        (UNITVEC_HEXCUBE_HEIGHT_0 - u) * (UNITVEC_HEXCUBE_HEIGHT_1 + UNITVEC_HEXCUBE_HEIGHT_2 * v);
    UNITVEC_PRECISE float beyond = off_whole * off_whole + height * (abs(from_whole) - 0.25);
    UNITVEC_PRECISE float half_square = off_half * off_half;
    // There is no row beyond the last.
    bool is_half = half_square < beyond && y < last_y;
    UNITVEC_PRECISE float half_y = whole_y + half_row;
    return is_half ? vec2(half_x, half_y) : vec2(whole_x, whole_y);
}

// A place of whole numbers or halves, with the sign of a coordinate, as a number of halves from the first, which is as
// many before the middle.
uint unitvec_hexcube_halves(float place, float coordinate, int first) {
    float from_first = UNITVEC_HEXCUBE_COUNTING_HALVES + 0.5 * float(first);
    UNITVEC_PRECISE float sum = unitvec_negate_if(unitvec_is_negative(coordinate), place) + from_first;
    return floatBitsToUint(sum) & 0xffffu;
}

uint unitvec_hexcube_encode(vec3 v, UnitvecHexcubeLattice lattice) {
    bool usable = unitvec_is_usable(unitvec_l1_norm(v));
    vec3 a = abs(v);
    bool is_z = a.z >= max(a.x, a.y);
    bool y_above = a.y >= a.x;
    float x_or_y = y_above ? v.y : v.x;
    float front = is_z ? v.z : x_or_y;
    float p_x = is_z || y_above ? v.x : v.y;
    float p_y = is_z ? v.y : v.z;
    vec2 found = unitvec_hexcube_nearest(vec2(abs(p_x), abs(p_y)), abs(front), lattice);
    uint column = unitvec_hexcube_halves(found.x, p_x, lattice.columns);
    uint row = unitvec_hexcube_halves(found.y, p_y, lattice.rows);
    uint number = (row * uint(unitvec_hexcube_line(lattice)) + column) >> 1u;

    uint face = unitvec_hexcube_face(lattice);
    uint x_or_y_face = y_above ? 2u * face : 0u;
    uint first = is_z ? 4u * face : x_or_y_face;
    uint code = number + first + (unitvec_is_negative(front) ? face : 0u);
    return usable ? code : 4u * face + uint(unitvec_hexcube_middle(lattice));
}

// Unit length to within 2 ULP.
vec3 unitvec_hexcube_decode(uint code, UnitvecHexcubeLattice lattice) {
    uint points = unitvec_hexcube_face(lattice);
    code = min(code, 6u * points - 1u);
    bool is_x = code < 2u * points;
    bool is_z = code >= 4u * points;
    // Comparisons, which take less than another division.
    uint on_axis = code - (is_z ? 4u * points : (is_x ? 0u : 2u * points));
    bool is_back = on_axis >= points;
    uint doubled = 2u * (on_axis - (is_back ? points : 0u));
    uint line_length = uint(unitvec_hexcube_line(lattice));
    uint line_number = doubled / line_length;
    float column = float(int(doubled - line_number * line_length) - lattice.columns);
    float row = float(int(line_number) - lattice.rows);

    // X and Y over a common denominator, without the weight.
    UNITVEC_PRECISE float across = lattice.across - abs(column);
    UNITVEC_PRECISE float along = lattice.along - abs(row);
    UNITVEC_PRECISE vec3 scaled = vec3((UNITVEC_HEXCUBE_WEIGHT * column) * along,
        (UNITVEC_HEXCUBE_WEIGHT * row) * across, across * along);
    vec3 p = unitvec_normalize(scaled);
    float front = unitvec_negate_if(is_back, p.z);
    float y_of_yz = is_z ? p.y : front;
    return vec3(is_x ? front : p.x, is_x ? p.x : y_of_yz, is_z ? front : p.y);
}

uint hexcube16_encode(vec3 v) { return unitvec_hexcube_encode(v, UNITVEC_HEXCUBE_LATTICE_16); }
uint hexcube24_encode(vec3 v) { return unitvec_hexcube_encode(v, UNITVEC_HEXCUBE_LATTICE_24); }
uint hexcube32_encode(vec3 v) { return unitvec_hexcube_encode(v, UNITVEC_HEXCUBE_LATTICE_32); }

vec3 hexcube16_decode(uint code) {
    return unitvec_hexcube_decode(code & unitvec_mask(16u), UNITVEC_HEXCUBE_LATTICE_16);
}

vec3 hexcube24_decode(uint code) {
    return unitvec_hexcube_decode(code & unitvec_mask(24u), UNITVEC_HEXCUBE_LATTICE_24);
}

vec3 hexcube32_decode(uint code) { return unitvec_hexcube_decode(code, UNITVEC_HEXCUBE_LATTICE_32); }

#endif
