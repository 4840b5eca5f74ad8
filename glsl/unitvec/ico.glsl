// unitvec: a triangular lattice on the faces of an icosahedron, warped to be even on the sphere, in 16, 24 and 32 bits.
//
// Source: class I geodesic grids, Coxeter 1971; the warp, its inverse and the layout are this library's own.
//
//   ico16_encode(v), ico16_decode(code)      integer codes; also ico24, ico32
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. A lattice point has
// a whole number i for each vertex of a face, of the sum n, and is the sum of i (N - i) times the vertex. Layout: the Rust
// crate's module `ico` says which face, row and column a code is of; past the last code all decode as that does.
//
// A vec3 of numbers for a face's vertices has: in z that of the apex, in x that of the base's end on the straddled
// coordinate's positive side, in y that of the other end. On the face of the positive octant they are (0, 1, p),
// (1, p, 0) and (p, 0, 1) for x, y and z; the face that straddles y = 0 has (0, -1, p) for y.

#ifndef UNITVEC_ICO_GLSL
#define UNITVEC_ICO_GLSL

#ifndef UNITVEC_SCALAR_GLSL
#include "scalar.glsl"
#endif

// The golden ratio and its reciprocal.
const float ICO_GOLDEN = 1.618034;
const float ICO_GOLDEN_LESS_1 = 0.618034;

// Of the cubic that the inverse of the warp starts from.
const float ICO_INVERSE_0 = 0.214316;
const float ICO_INVERSE_1 = -0.121124;
const float ICO_INVERSE_2 = 0.117389;

// Stands for the faces in octants where a number tells what plane a face straddles: 0 is y = 0, 1 is z = 0, 2 is x = 0.
const uint ICO_OCTANT = 3u;

// Steps along an edge, n, and N of the weights i (N - i).
struct IcoLattice {
    uint n;
    float warp;
};

const IcoLattice ICO_LATTICE_16 = IcoLattice(80u, 400.0);
const IcoLattice ICO_LATTICE_24 = IcoLattice(1294u, 6019.0);
const IcoLattice ICO_LATTICE_32 = IcoLattice(20724u, 96391.0);

// The first code of the faces in octants.
uint ico_octants(IcoLattice lattice) {
    return 6u * lattice.n * (lattice.n + 2u);
}

// The last code that encoding writes.
uint ico_last(IcoLattice lattice) {
    return ico_octants(lattice) + 4u * (lattice.n - 2u) * (lattice.n - 1u) - 1u;
}

// The lattice point of the numbers x and z.
vec3 ico_point(IcoLattice lattice, float x, float z) {
    UNITVEC_PRECISE float y = (float(lattice.n) - x) - z;
    return vec3(x, y, z);
}

// The weights of a lattice point.
vec3 ico_weights(IcoLattice lattice, vec3 i) {
    UNITVEC_PRECISE vec3 w = i * (lattice.warp - i);
    return w;
}

// The derivatives of the weights.
vec3 ico_slopes(IcoLattice lattice, vec3 i) {
    UNITVEC_PRECISE vec3 d = lattice.warp - 2.0 * i;
    return d;
}

// The components in cyclic order so that those of the face that straddles y = 0 come to stand for those of the face
// that straddles the plane; as they are for ICO_OCTANT.
vec3 ico_turn(vec3 v, uint plane) {
    vec3 turned = plane == 2u ? v.yzx : v;
    return plane == 1u ? v.zxy : turned;
}

// The plane that the neighbour of the positive octant's face straddles on the side opposite to the first vertex that is
// marked; ICO_OCTANT if none is.
uint ico_neighbour(bool x, bool y, bool z) {
    uint of_z = z ? 2u : ICO_OCTANT;
    uint of_x = x ? 1u : of_z;
    return y ? 0u : of_x;
}

float ico_sum(vec3 v) {
    UNITVEC_PRECISE float s = (v.x + v.y) + v.z;
    return s;
}

// The inverse of the warp, for a coordinate t on the flat face and the sums of all three's squares and cubes: good to 1e-4.
float ico_unwarped(float t, float squares, float cubes) {
    UNITVEC_PRECISE float b =
        t + t * ((t - squares) * (ICO_INVERSE_0 + ICO_INVERSE_1 * squares) + ICO_INVERSE_2 * (t * t - cubes));
    return b;
}

// The lattice point nearest in angle to the direction of the weights p, which may be of any sum.
vec3 ico_nearest(vec3 p, IcoLattice lattice) {
    float n = float(lattice.n);
    UNITVEC_PRECISE vec3 t = p * (1.0 / ico_sum(p));
    UNITVEC_PRECISE vec3 t_squared = t * t;
    float squares = ico_sum(t_squared);
    float cubes = unitvec_dot(t_squared, t);
    UNITVEC_PRECISE float start_x = floor(ico_unwarped(t.x, squares, cubes) * n + 0.5);
    UNITVEC_PRECISE float start_z = floor(ico_unwarped(t.z, squares, cubes) * n + 0.5);
    vec3 start = ico_point(lattice, start_x, start_z);

    // Newton's method for i and the factor of p, where the i keep their sum; with one division for those by the slopes
    // and by their sum.
    vec3 w = ico_weights(lattice, start);
    UNITVEC_PRECISE vec3 q = t * ico_sum(w);
    UNITVEC_PRECISE vec3 r = q - w;
    vec3 d = ico_slopes(lattice, start);
    UNITVEC_PRECISE vec3 others = vec3(d.y * d.z, d.z * d.x, d.x * d.y);
    float r_sum = unitvec_dot(r, others);
    float q_sum = unitvec_dot(q, others);
    UNITVEC_PRECISE float per_all = 1.0 / (q_sum * (d.x * others.x));
    UNITVEC_PRECISE float off_x = (r.x * q_sum - q.x * r_sum) * (others.x * per_all);
    UNITVEC_PRECISE float off_z = (r.z * q_sum - q.z * r_sum) * (others.z * per_all);

    // Two triangles share the cell between whole x and z: one has the lower corner, the other, turned by half, the upper.
    float whole_x = floor(off_x);
    float whole_z = floor(off_z);
    UNITVEC_PRECISE float lower_x = off_x - whole_x;
    UNITVEC_PRECISE float lower_z = off_z - whole_z;
    UNITVEC_PRECISE float upper_x = 1.0 - lower_x;
    UNITVEC_PRECISE float upper_z = 1.0 - lower_z;
    UNITVEC_PRECISE float both = lower_x + lower_z;
    bool is_upper = both > 1.0;
    float to_corner = is_upper ? 1.0 : 0.0;
    float to_end = is_upper ? -1.0 : 1.0;
    UNITVEC_PRECISE float corner_x = start.x + (whole_x + to_corner);
    UNITVEC_PRECISE float corner_z = start.z + (whole_z + to_corner);
    float in_x = is_upper ? upper_x : lower_x;
    float in_z = is_upper ? upper_z : lower_z;

    // The products of a step along x and one along z, with themselves, each other and q, then without their parts
    // along q: vertices have the products 2 + p with themselves and p with each other.
    UNITVEC_PRECISE float sum_x = d.x - d.y;
    UNITVEC_PRECISE float sum_z = d.z - d.y;
    UNITVEC_PRECISE float y_squared = d.y * d.y;
    UNITVEC_PRECISE float sum_q = ICO_GOLDEN * ico_sum(q);
    UNITVEC_PRECISE float along_x = 2.0 * (d.x * q.x - d.y * q.y) + sum_x * sum_q;
    UNITVEC_PRECISE float along_z = 2.0 * (d.z * q.z - d.y * q.y) + sum_z * sum_q;
    UNITVEC_PRECISE float per_square = 1.0 / (2.0 * unitvec_dot(q, q) + ico_sum(q) * sum_q);
    UNITVEC_PRECISE float part_x = along_x * per_square;
    UNITVEC_PRECISE float part_z = along_z * per_square;
    UNITVEC_PRECISE float xx =
        (2.0 * (d.x * d.x + y_squared) + ICO_GOLDEN * (sum_x * sum_x)) - along_x * part_x;
    UNITVEC_PRECISE float zz =
        (2.0 * (d.z * d.z + y_squared) + ICO_GOLDEN * (sum_z * sum_z)) - along_z * part_z;
    UNITVEC_PRECISE float xz = (2.0 * y_squared + ICO_GOLDEN * (sum_x * sum_z)) - along_x * part_z;

    // By how much the square of the distance grows from the corner to the ends of both steps.
    UNITVEC_PRECISE float growth_x = xx - 2.0 * (in_x * xx + in_z * xz);
    UNITVEC_PRECISE float growth_z = zz - 2.0 * (in_x * xz + in_z * zz);
    bool is_x = growth_x < 0.0;
    bool is_z = growth_z < (is_x ? growth_x : 0.0);
    float x = is_x && !is_z ? corner_x + to_end : corner_x;
    float z = is_z ? corner_z + to_end : corner_z;
    return ico_point(lattice, x, z);
}

uint ico_encode(vec3 v, IcoLattice lattice) {
    v = unitvec_or_z(v);
    float n = float(lattice.n);
    vec3 a = abs(v);
    // Scaled so that a vertex such as (0, 1, p) has the coordinate 2 p.
    UNITVEC_PRECISE vec3 flat_part = vec3(
        ICO_GOLDEN_LESS_1 * (a.y + a.z) + (a.z - a.x),
        ICO_GOLDEN_LESS_1 * (a.x + a.y) + (a.y - a.z),
        ICO_GOLDEN_LESS_1 * (a.z + a.x) + (a.x - a.y));
    uint plane = ico_neighbour(
        unitvec_is_negative(flat_part.x), unitvec_is_negative(flat_part.y), unitvec_is_negative(flat_part.z));
    // By reflection: the vertices across a side have the sum of the side's two, divided by p.
    vec3 p = ico_turn(flat_part, plane);
    UNITVEC_PRECISE float reflected = ICO_GOLDEN_LESS_1 * p.y;
    float to_both = unitvec_is_negative(p.y) ? reflected : 0.0;
    UNITVEC_PRECISE vec3 weights = vec3(p.x + to_both, abs(p.y), p.z + to_both);
    vec3 i = ico_nearest(weights, lattice);

    // The sides of octants' faces are their neighbours', and apices are of the next plane's base.
    uint side = ico_neighbour(i.x < 0.5, i.y < 0.5, i.z < 0.5);
    uint owner = plane == ICO_OCTANT ? side : plane;
    i = plane == ICO_OCTANT ? ico_turn(i, side) : i;
    bool is_apex = i.z > n - 0.5;
    uint next = owner == 2u ? 0u : owner + 1u;
    plane = is_apex ? next : owner;
    i = is_apex ? vec3(n, 0.0, 0.0) : i;

    bool x = unitvec_is_negative(v.x);
    bool y = unitvec_is_negative(v.y);
    bool z = unitvec_is_negative(v.z);
    bool apex_side = plane == 1u ? y : (plane == 2u ? z : x);
    bool straddled_side = plane == 1u ? z : (plane == 2u ? x : y);
    bool base_side = plane == 1u ? x : (plane == 2u ? y : z);
    bool is_octant = plane == ICO_OCTANT;
    float across = !is_octant && straddled_side ? i.y : i.x;
    bool is_second = apex_side && i.z > 0.5;
    // All of these are whole.
    float octant_row = is_second ? (n - 3.0) - (i.z - 1.0) : i.z - 1.0;
    float octant_column = is_second ? i.z + (across - 1.0) : across - 1.0;
    float straddling_row = is_second ? n - i.z : i.z;
    float straddling_column = is_second ? (i.z + 1.0) + across : across;
    uint row = uint(int(is_octant ? octant_row : straddling_row));
    uint column = uint(int(is_octant ? octant_column : straddling_column));

    uint straddled_bit = straddled_side ? 1u : 0u;
    uint base_bit = base_side ? 1u : 0u;
    uint block = is_octant ? straddled_bit + 2u * base_bit : 2u * plane + base_bit;
    uint first = is_octant ? ico_octants(lattice) : 0u;
    uint rows = is_octant ? lattice.n - 2u : lattice.n;
    uint row_length = is_octant ? lattice.n - 1u : lattice.n + 2u;
    return first + (block * rows + row) * row_length + column;
}

// Unit length to within 2 ULP.
vec3 ico_decode(uint code, IcoLattice lattice) {
    float n = float(lattice.n);
    code = code < ico_last(lattice) ? code : ico_last(lattice);
    bool is_octant = code >= ico_octants(lattice);
    uint first = is_octant ? ico_octants(lattice) : 0u;
    uint row_length = is_octant ? lattice.n - 1u : lattice.n + 2u;
    float per_length = is_octant ? 2.0 / (n - 1.0) : 2.0 / (n + 2.0);
    float rows = is_octant ? n - 2.0 : n;
    float per_rows = is_octant ? 1.0 / (n - 2.0) : 1.0 / n;

    // index / 2 fits a signed integer, which processors convert faster. The quotient is between 0.04 less and 0.03 more
    // than the exact one: so `line` is it or the next, and then the remainder wraps.
    uint index = code - first;
    UNITVEC_PRECISE float quotient = float(int(index >> 1u)) * per_length + 0.05;
    float line = floor(quotient);
    uint rest = index - uint(int(line)) * row_length;
    bool is_next = rest >= row_length;
    line = is_next ? line - 1.0 : line;
    float column = float(int(is_next ? rest + row_length : rest));
    UNITVEC_PRECISE float part = (line + 0.5) * per_rows;
    float block_number = floor(part);
    UNITVEC_PRECISE float row = line - block_number * rows;

    // All of these are whole.
    bool is_second = column > (rows - row) - (is_octant ? 1.0 : 0.0);
    float octant_x = is_second ? (column + row) - (n - 3.0) : column + 1.0;
    float octant_z = is_second ? (n - 2.0) - row : row + 1.0;
    float straddling_x = is_second ? (column + row) - (n + 1.0) : column;
    float straddling_z = is_second ? n - row : row;
    float x = is_octant ? octant_x : straddling_x;
    float z = is_octant ? octant_z : straddling_z;
    vec3 w = ico_weights(lattice, ico_point(lattice, x, z));
    UNITVEC_PRECISE float golden_y = ICO_GOLDEN * w.y;
    float to_x = is_octant ? w.y : 0.0;
    float to_y = is_octant ? golden_y : -w.y;
    float to_z = is_octant ? 0.0 : w.y;
    UNITVEC_PRECISE vec3 v = vec3(ICO_GOLDEN * w.z + to_x, w.x + to_y, ICO_GOLDEN * (w.x + to_z) + w.z);
    uint block = uint(int(block_number));
    uint plane = is_octant ? ICO_OCTANT : block >> 1u;
    uint base_bit = is_octant ? block >> 1u : block & 1u;
    v = vec3(
        unitvec_negate_if(is_second, v.x),
        unitvec_negate_if(is_octant && (block & 1u) != 0u, v.y),
        unitvec_negate_if(base_bit != 0u, v.z));
    return ico_turn(unitvec_normalize(v), plane);
}

uint ico16_encode(vec3 v) { return ico_encode(v, ICO_LATTICE_16); }
uint ico24_encode(vec3 v) { return ico_encode(v, ICO_LATTICE_24); }
uint ico32_encode(vec3 v) { return ico_encode(v, ICO_LATTICE_32); }

vec3 ico16_decode(uint code) { return ico_decode(code & 0xffffu, ICO_LATTICE_16); }
vec3 ico24_decode(uint code) { return ico_decode(code & 0xffffffu, ICO_LATTICE_24); }
vec3 ico32_decode(uint code) { return ico_decode(code, ICO_LATTICE_32); }

#endif
