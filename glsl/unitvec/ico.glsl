// unitvec: a triangular lattice on the faces of an icosahedron, warped to be even on the sphere, in 16, 24 and 32 bits.
//
// Source: class I geodesic grids, Coxeter 1971; the warp, its inverse and the layout are this library's own.
//
//   ico16_encode(v), ico16_decode(code)      integer codes; also ico24, ico32
//
// The code functions take any v: length does not matter, and +Z stands in for vectors without a direction. A lattice
// point has a whole number i for each vertex of a face, of the sum n, and is the sum of i (N - i) times the vertex.
// Layout: the Rust crate's module `ico` says which face, row and column a code is of; past the last code all decode
// like the last.
//
// A vec3 of numbers for a face's vertices has: in z that of the apex, in x that of the base's end on the straddled
// coordinate's positive side, in y that of the other end. On the face of the positive octant they are (0, 1, p),
// (1, p, 0) and (p, 0, 1) for x, y and z; the face that straddles y = 0 has (0, -1, p) for y.

#ifndef UNITVEC_ICO_GLSL
#define UNITVEC_ICO_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The golden ratio and its reciprocal.
const float UNITVEC_ICO_GOLDEN = 1.618034;
const float UNITVEC_ICO_GOLDEN_LESS_1 = 0.618034;
// The number that reflection adds to the sum of the flat coordinates, for a coordinate of -1.
const float UNITVEC_ICO_ADDED_BY_REFLECTION = 0.763932;

// Coefficients of the cubic that approximates the inverse warp.
const float UNITVEC_ICO_INVERSE_0 = 0.214316;
const float UNITVEC_ICO_INVERSE_1 = -0.121124;
const float UNITVEC_ICO_INVERSE_2 = 0.117389;
// 1 + i / 2, 3/2 i and 3 i, where i is UNITVEC_ICO_INVERSE_2.
const float UNITVEC_ICO_INVERSE_3 = 1.0586945;
const float UNITVEC_ICO_INVERSE_4 = 0.1760835;
const float UNITVEC_ICO_INVERSE_5 = 0.352167;

// Steps along an edge, n, N of the weights i (N - i), and factors of the squares of the distances between neighbours.
struct UnitvecIcoLattice {
    uint n;
    float warp;
    float squares_s;
    float squares_t;
    float squares_ts;
    float squares_tt;
};

const UnitvecIcoLattice UNITVEC_ICO_LATTICE_16 =
    UnitvecIcoLattice(80u, 400.0, 1.2906223, 0.9165209, 0.07669952, -0.11949905);
const UnitvecIcoLattice UNITVEC_ICO_LATTICE_24 =
    UnitvecIcoLattice(1294u, 6019.0, 1.7887541, 1.2950615, 0.13716104, -0.368954);
const UnitvecIcoLattice UNITVEC_ICO_LATTICE_32 =
    UnitvecIcoLattice(20724u, 96391.0, 1.7887541, 1.2950615, 0.13716104, -0.368954);

// The first code of the faces in octants.
uint unitvec_ico_octants(UnitvecIcoLattice lattice) {
    return 6u * lattice.n * (lattice.n + 2u);
}

// The last code that encoding writes.
uint unitvec_ico_last(UnitvecIcoLattice lattice) {
    return unitvec_ico_octants(lattice) + 4u * (lattice.n - 2u) * (lattice.n - 1u) - 1u;
}

// The lattice point of the numbers x and z.
vec3 unitvec_ico_point(UnitvecIcoLattice lattice, float x, float z) {
    UNITVEC_PRECISE float y = (float(lattice.n) - x) - z;
    return vec3(x, y, z);
}

// The weights of a lattice point.
vec3 unitvec_ico_weights(UnitvecIcoLattice lattice, vec3 i) {
    UNITVEC_PRECISE vec3 w = i * (lattice.warp - i);
    return w;
}

// The components in cyclic order so that those of the face that straddles y = 0 come to stand for those of the face
// that straddles z = 0 or x = 0, if marked.
vec3 unitvec_ico_turn(vec3 v, bool of_z, bool of_x) {
    vec3 turned = of_x ? v.yzx : v;
    return of_z ? v.zxy : turned;
}

float unitvec_ico_sum(vec3 v) {
    UNITVEC_PRECISE float s = (v.x + v.y) + v.z;
    return s;
}

// The lattice point nearest in angle to the direction of the weights p, of the sum p_sum, to rounding.
vec3 unitvec_ico_nearest(vec3 p, float p_sum, UnitvecIcoLattice lattice) {
    float n = float(lattice.n);
    UNITVEC_PRECISE vec3 t = p * unitvec_reciprocal(p_sum);
    UNITVEC_PRECISE vec3 t_squared = t * t;
    float squares = unitvec_ico_sum(t_squared);
    // The sum is 1, so that the cubes' sum is 3 times the product and 3/2 of the squares' sum, less 1/2.
    UNITVEC_PRECISE float b_1 = UNITVEC_ICO_INVERSE_0 * n + (UNITVEC_ICO_INVERSE_1 * n) * squares;
    UNITVEC_PRECISE float b_0 = (UNITVEC_ICO_INVERSE_3 * n - squares * (b_1 + UNITVEC_ICO_INVERSE_4 * n))
        - (UNITVEC_ICO_INVERSE_5 * n) * ((t.x * t.y) * t.z);
    UNITVEC_PRECISE float b_2 = UNITVEC_ICO_INVERSE_2 * n;
    UNITVEC_PRECISE float start_x = t.x * (b_0 + t.x * (b_1 + b_2 * t.x));
    UNITVEC_PRECISE float start_z = t.z * (b_0 + t.z * (b_1 + b_2 * t.z));
    vec3 start = unitvec_ico_point(lattice, start_x, start_z);

    // Newton's method for i and the factor of t, where the i keep their sum.
    UNITVEC_PRECISE vec3 rest = lattice.warp - start;
    UNITVEC_PRECISE vec3 w = start * rest;
    UNITVEC_PRECISE vec3 d = rest - start;
    UNITVEC_PRECISE vec3 turned = d * vec3(t.y * w.z - t.z * w.y, t.z * w.x - t.x * w.z, t.x * w.y - t.y * w.x);
    UNITVEC_PRECISE float determinant = d.z * (t.x * d.y + t.y * d.x) + t.z * (d.x * d.y);
    float factor = unitvec_reciprocal(determinant);
    UNITVEC_PRECISE float x = start.x + (turned.z - turned.y) * factor;
    UNITVEC_PRECISE float z = start.z + (turned.y - turned.x) * factor;

    // Two triangles share the cell between whole x and z: one has the lower corner, the other, turned by half, the upper.
    float whole_x = floor(x);
    float whole_z = floor(z);
    UNITVEC_PRECISE float lower_x = x - whole_x;
    UNITVEC_PRECISE float lower_z = z - whole_z;
    UNITVEC_PRECISE float upper_x = 1.0 - lower_x;
    UNITVEC_PRECISE float upper_z = 1.0 - lower_z;
    UNITVEC_PRECISE float lower_y = upper_x - lower_z;
    bool is_upper = lower_y < 0.0;
    float in_x = is_upper ? upper_x : lower_x;
    float in_z = is_upper ? upper_z : lower_z;
    float in_corner = abs(lower_y);
    // The squares of the distances between neighbours along the sides opposite to the vertices.
    UNITVEC_PRECISE float s_0 = 1.0 + lattice.squares_s * squares;
    UNITVEC_PRECISE float s_1 = lattice.squares_t + lattice.squares_ts * squares;
    UNITVEC_PRECISE vec3 square = s_0 + (s_1 * t + lattice.squares_tt * t_squared);

    // The squares of the distances from the corners, each less the same number.
    UNITVEC_PRECISE float from_corner = in_x * square.z + in_z * square.x;
    UNITVEC_PRECISE float from_x = in_corner * square.z + in_z * square.y;
    UNITVEC_PRECISE float from_z = in_corner * square.x + in_x * square.y;
    bool is_x = from_x < from_corner;
    bool is_z = from_z < (is_x ? from_x : from_corner);
    bool is_next_x = (is_x && !is_z) != is_upper;
    bool is_next_z = is_z != is_upper;
    UNITVEC_PRECISE float nearest_x = whole_x + (is_next_x ? 1.0 : 0.0);
    UNITVEC_PRECISE float nearest_z = whole_z + (is_next_z ? 1.0 : 0.0);
    return unitvec_ico_point(lattice, nearest_x, nearest_z);
}

uint unitvec_ico_encode(vec3 v, UnitvecIcoLattice lattice) {
    float norm = unitvec_l1_norm(v);
    bool usable = unitvec_is_usable(norm);
    float n = float(lattice.n);
    vec3 a = abs(v);
    // Scaled so that a vertex such as (0, 1, p) has the coordinate 2 p.
    UNITVEC_PRECISE float norm_part = UNITVEC_ICO_GOLDEN_LESS_1 * norm;
    UNITVEC_PRECISE vec3 flat_part = (norm_part + a.zyx) - UNITVEC_ICO_GOLDEN * a.xzy;
    // By reflection: the vertices across a side have the sum of the side's two vertices, divided by p.
    float beyond = min(min(flat_part.z, min(flat_part.x, flat_part.y)), 0.0);
    UNITVEC_PRECISE float shared_part = UNITVEC_ICO_GOLDEN_LESS_1 * beyond;
    UNITVEC_PRECISE float sum = 2.0 * norm_part - UNITVEC_ICO_ADDED_BY_REFLECTION * beyond;
    UNITVEC_PRECISE vec3 on_side = flat_part + shared_part;
    vec3 i = unitvec_ico_nearest(max(on_side, -flat_part), sum, lattice);

    // The face that has the point: the one across the least number's side, unless the least is more than 0. Where two
    // are equal, it is the face whose base ends there.
    float x = unitvec_with_sign(i.x, flat_part.x);
    float y = unitvec_with_sign(i.y, flat_part.y);
    float z = unitvec_with_sign(i.z, flat_part.z);
    bool is_octant = min(min(x, y), z) > 0.5;
    bool x_less = x < z;
    bool of_z = !is_octant && x <= y && x_less;
    bool of_x = !is_octant && z < y && !x_less;
    bool of_y = !of_z && !of_x;

    // The sides of the coordinate planes on which the straddled coordinate, the base and the apex lie.
    bool x_side = unitvec_is_negative(v.x);
    bool y_side = unitvec_is_negative(v.y);
    bool z_side = unitvec_is_negative(v.z);
    bool straddled_side = of_z ? z_side : (of_x ? x_side : y_side);
    bool base_side = of_z ? x_side : (of_x ? y_side : z_side);
    bool apex_side = of_z ? y_side : (of_x ? z_side : x_side);

    // All of these are whole.
    float depth = of_z ? i.y : (of_x ? i.x : i.z);
    bool is_other = straddled_side && !is_octant;
    bool has_x = is_other ? of_z : of_y;
    bool has_y = is_other ? of_y : of_x;
    float across = has_x ? i.x : (has_y ? i.y : i.z);
    bool is_second = apex_side && depth > 0.5;
    // The numbers of lines and columns have 2^23 added. Lines of octants, which are shorter, begin where 18 codes of
    // their line 6 n + 18 are left.
    float octant_rows = straddled_side ? UNITVEC_2_23 + (7.0 * n + 15.0) : UNITVEC_2_23 + (6.0 * n + 17.0);
    float first_row = is_octant ? octant_rows : UNITVEC_2_23;
    first_row = of_x ? UNITVEC_2_23 + 4.0 * n : first_row;
    first_row = of_z ? UNITVEC_2_23 + 2.0 * n : first_row;
    float rows_before = is_octant ? 2.0 * (n - 2.0) : n;
    UNITVEC_PRECISE float from_end = (is_octant ? n - 1.0 : n) - depth;
    UNITVEC_PRECISE float line_number = (first_row + (base_side ? rows_before : 0.0)) + (is_second ? from_end : depth);
    float first_column = is_second ? UNITVEC_2_23 + 1.0 : UNITVEC_2_23;
    first_column = is_octant ? UNITVEC_2_23 + 17.0 : first_column;
    UNITVEC_PRECISE float column = (across + (is_second ? depth : 0.0)) + first_column;
    uint row_length = is_octant ? lattice.n - 1u : lattice.n + 2u;
    uint code = (floatBitsToUint(line_number) & 0x7fffffu) * row_length + (floatBitsToUint(column) & 0x7fffffu);
    // +Z is in the middle of the first row.
    return usable ? code : lattice.n / 2u;
}

// Unit length to within 2 ULP.
vec3 unitvec_ico_decode(uint code, UnitvecIcoLattice lattice) {
    float n = float(lattice.n);
    code = min(code, unitvec_ico_last(lattice));
    bool is_octant = code >= unitvec_ico_octants(lattice);
    uint first = is_octant ? unitvec_ico_octants(lattice) : 0u;
    uint row_length = is_octant ? lattice.n - 1u : lattice.n + 2u;
    float per_length = is_octant ? unitvec_reciprocal(n - 1.0) : unitvec_reciprocal(n + 2.0);
    float rows = is_octant ? n - 2.0 : n;
    // A little more than 1 / rows, so that a block's first line, which is a multiple, counts to it.
    float per_rows = is_octant ? unitvec_reciprocal(n - 2.1) : unitvec_reciprocal(n - 0.1);

    // The quotient is between 0.04 less and 0.03 more than the exact one: so `near_line` is it or the next; then the
    // remainder wraps.
    uint index = code - first;
    UNITVEC_PRECISE float counted = float(index) * per_length + UNITVEC_2_23;
    uint near_line = floatBitsToUint(counted) & 0x7fffffu;
    uint rest = index - near_line * row_length;
    bool is_next = rest >= row_length;
    float column = float(int(is_next ? rest + row_length : rest));
    float line_number = float(int(near_line - (is_next ? 1u : 0u)));
    UNITVEC_PRECISE float part = line_number * per_rows;
    float block_number = floor(part);
    UNITVEC_PRECISE float row = line_number - block_number * rows;

    // All of these are whole.
    float least = is_octant ? 1.0 : 0.0;
    UNITVEC_PRECISE float second_depth = (is_octant ? n - 3.0 : n) - row;
    UNITVEC_PRECISE float second_across = (column - second_depth) - 1.0;
    bool is_second = column > second_depth;
    UNITVEC_PRECISE float x = (is_second ? second_across : column) + least;
    UNITVEC_PRECISE float z = (is_second ? second_depth : row) + least;
    vec3 w = unitvec_ico_weights(lattice, unitvec_ico_point(lattice, x, z));
    float to_x = is_octant ? w.y : 0.0;
    float to_z = is_octant ? 0.0 : w.y;
    float y_of_y = is_octant ? UNITVEC_ICO_GOLDEN : -1.0;
    UNITVEC_PRECISE vec3 v =
        vec3(UNITVEC_ICO_GOLDEN * w.z + to_x, w.x + y_of_y * w.y, UNITVEC_ICO_GOLDEN * (w.x + to_z) + w.z);
    bool is_odd = (unitvec_whole_to_u32(block_number) & 1u) != 0u;
    bool is_upper = part >= 2.0;
    v = unitvec_normalize(v);
    v = vec3(
        unitvec_negate_if(is_second, v.x),
        unitvec_negate_if(is_octant && is_odd, v.y),
        unitvec_negate_if(is_octant ? is_upper : is_odd, v.z));
    bool of_x = !is_octant && part >= 4.0;
    return unitvec_ico_turn(v, !is_octant && is_upper && !of_x, of_x);
}

uint ico16_encode(vec3 v) { return unitvec_ico_encode(v, UNITVEC_ICO_LATTICE_16); }
uint ico24_encode(vec3 v) { return unitvec_ico_encode(v, UNITVEC_ICO_LATTICE_24); }
uint ico32_encode(vec3 v) { return unitvec_ico_encode(v, UNITVEC_ICO_LATTICE_32); }

vec3 ico16_decode(uint code) { return unitvec_ico_decode(code & unitvec_mask(16u), UNITVEC_ICO_LATTICE_16); }
vec3 ico24_decode(uint code) { return unitvec_ico_decode(code & unitvec_mask(24u), UNITVEC_ICO_LATTICE_24); }
vec3 ico32_decode(uint code) { return unitvec_ico_decode(code, UNITVEC_ICO_LATTICE_32); }

#endif
