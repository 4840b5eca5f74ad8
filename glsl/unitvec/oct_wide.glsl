// unitvec: octahedral codes of 48 and 52 bits, finer than a float.
//
// Source: Meyer et al. 2010, section 5 and table 1. The mapping is that of oct.glsl.
//
//   oct48_encode(v), oct48_decode(code)      codes as uvec2, low word first
//   oct48p_encode(v), oct52p_encode(v), ...  precise encoders
//
// Any v will do: length does not matter, and +Z stands in for vectors without a direction. Layout: x in the low 24 or
// 26 bits, y in those above, two's complement snorm. Positions are sums of two floats, since one does not hold them;
// decoded components are the floats nearest to the exact ones. Without `precise` (see arith.glsl) a compiler may undo
// that.

#ifndef UNITVEC_OCT_WIDE_GLSL
#define UNITVEC_OCT_WIDE_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// A direction in the positive octant, on the octahedron x + y + z = m: the whole numbers of its x and y, how far it
// lies beyond them, itself as a part of m, and the vector without signs, scaled by a power of two to an L1 norm of 1
// to 2.
struct UnitvecOctWidePosition {
    ivec2 whole;
    vec2 fraction;
    vec3 part;
    vec3 scaled_vector;
};

// Largest integer of an snorm of `bits` bits (2 to 31).
int unitvec_oct_wide_max(uint bits) {
    return int(unitvec_mask(bits - 1u));
}

// The place of v, which has a direction, in the positive octant, after mirroring.
UnitvecOctWidePosition unitvec_oct_wide_position(vec3 v, uint bits) {
    vec3 scaled = abs(unitvec_scaled_to_one(v, unitvec_l1_norm(v)));
    vec2 sum_xy = unitvec_two_sum(scaled.x, scaled.y);
    vec2 sum_z = unitvec_two_sum(sum_xy.x, scaled.z);
    UNITVEC_PRECISE vec2 sum = vec2(sum_z.x, sum_xy.y + sum_z.y);
    float reciprocal = unitvec_reciprocal(sum.x);

    UnitvecOctWidePosition p;
    int x;
    int y;
    float fraction_x;
    float fraction_y;
    float part_x = unitvec_coordinate(scaled.x, sum, reciprocal, bits, x, fraction_x);
    float part_y = unitvec_coordinate(scaled.y, sum, reciprocal, bits, y, fraction_y);
    UNITVEC_PRECISE float part_z = scaled.z * reciprocal;
    p.whole = ivec2(x, y);
    p.fraction = vec2(fraction_x, fraction_y);
    p.part = vec3(part_x, part_y, part_z);
    p.scaled_vector = scaled;
    return p;
}

// Unit vector of the lattice point p of the positive octant.
vec3 unitvec_oct_wide_decode_octant(ivec3 p, uint bits) {
    uint low_bits = bits - 13u;
    UNITVEC_PRECISE vec3 lower = vec3(p & int(unitvec_mask(low_bits))) * unitvec_exp2(-int(low_bits));
    return unitvec_normalize_parts(vec3(p >> low_bits), lower);
}

// Measure of the angle of p's corner at `corner`, (0, 0) to (1, 1), from p. At 52 bits a corner that decodes to the
// vector itself costs least, so that a decoded vector keeps its code's vector.
float unitvec_oct_wide_cost(UnitvecOctWidePosition p, ivec2 corner, uint bits) {
    UNITVEC_PRECISE vec2 d = vec2(corner) - p.fraction;
    UNITVEC_PRECISE float along = d.x * (p.part.x - p.part.z) + d.y * (p.part.y - p.part.z);
    UNITVEC_PRECISE float squared = 2.0 * ((d.x * d.x + d.x * d.y) + d.y * d.y);
    UNITVEC_PRECISE float cost = squared * unitvec_dot(p.part, p.part) - along * along;
    if (bits != 26u) return cost;

    ivec2 e = p.whole + corner;
    vec3 decoded = unitvec_oct_wide_decode_octant(ivec3(e, unitvec_oct_wide_max(bits) - e.x - e.y), bits);
    return decoded == p.scaled_vector ? -1.0 : cost;
}

// Lattice point nearest to p in angle, of the four corners of its cell. The far corner of a cell that the octant's edge
// z = 0 cuts is no candidate: the octahedron folds there.
ivec2 unitvec_oct_wide_nearest_corner(UnitvecOctWidePosition p, uint bits) {
    float near = unitvec_oct_wide_cost(p, ivec2(0, 0), bits);
    float right = unitvec_oct_wide_cost(p, ivec2(1, 0), bits);
    float up = unitvec_oct_wide_cost(p, ivec2(0, 1), bits);
    float far = unitvec_oct_wide_cost(p, ivec2(1, 1), bits);

    ivec2 best = right < near ? ivec2(1, 0) : ivec2(0, 0);
    float least = right < near ? right : near;
    best = up < least ? ivec2(0, 1) : best;
    least = up < least ? up : least;
    best = far < least && unitvec_oct_wide_max(bits) - p.whole.x - p.whole.y >= 2 ? ivec2(1, 1) : best;
    return p.whole + best;
}

// Moves a lattice point of the positive octant to where the lower half of the octahedron is folded out if v.z is
// negative, gives it the signs of v.x and v.y, and packs it.
uvec2 unitvec_oct_wide_pack(vec3 v, ivec2 p, uint bits) {
    ivec2 e = unitvec_is_negative(v.z) ? unitvec_oct_wide_max(bits) - p.yx : p;
    uint x = uint(unitvec_is_negative(v.x) ? -e.x : e.x) & unitvec_mask(bits);
    uint y = uint(unitvec_is_negative(v.y) ? -e.y : e.y) & unitvec_mask(bits);
    return uvec2(x | (y << bits), y >> (32u - bits));
}

// Integer of an snorm code, with -2^(bits-1) taken as -(2^(bits-1) - 1). Bits above `bits` are ignored.
int unitvec_oct_wide_snorm_integer(uint code, uint bits) {
    int integer = int(code << (32u - bits)) >> int(32u - bits);
    return max(integer, -unitvec_oct_wide_max(bits));
}

// Code of two components of `bits` bits; the nearest point along each axis, rounded before the fold.
uvec2 unitvec_oct_wide_encode(vec3 v, uint bits) {
    v = unitvec_or_z(v);
    UnitvecOctWidePosition p = unitvec_oct_wide_position(v, bits);
    ivec2 up = ivec2(p.fraction.x < 0.5 ? 0 : 1, p.fraction.y < 0.5 ? 0 : 1);
    return unitvec_oct_wide_pack(v, p.whole + up, bits);
}

// Code of two components of `bits` bits, nearest in angle.
uvec2 unitvec_oct_wide_encode_precise(vec3 v, uint bits) {
    v = unitvec_or_z(v);
    return unitvec_oct_wide_pack(v, unitvec_oct_wide_nearest_corner(unitvec_oct_wide_position(v, bits), bits), bits);
}

vec3 unitvec_oct_wide_decode(uvec2 code, uint bits) {
    int x = unitvec_oct_wide_snorm_integer(code.x, bits);
    int y = unitvec_oct_wide_snorm_integer((code.x >> bits) | (code.y << (32u - bits)), bits);
    int m = unitvec_oct_wide_max(bits);
    ivec2 p = abs(ivec2(x, y));
    int z = m - p.x - p.y;
    p = z < 0 ? m - p.yx : p;
    vec3 v = unitvec_oct_wide_decode_octant(ivec3(p, abs(z)), bits);
    // Components of 0 are not negated: they would become -0.
    bool left = x < 0 && p.x > 0;
    bool down = y < 0 && p.y > 0;
    return vec3(unitvec_negate_if(left, v.x), unitvec_negate_if(down, v.y), unitvec_negate_if(z < 0, v.z));
}

uvec2 oct48_encode(vec3 v) { return unitvec_oct_wide_encode(v, 24u); }
uvec2 oct48p_encode(vec3 v) { return unitvec_oct_wide_encode_precise(v, 24u); }
uvec2 oct52p_encode(vec3 v) { return unitvec_oct_wide_encode_precise(v, 26u); }

vec3 oct48_decode(uvec2 code) { return unitvec_oct_wide_decode(code, 24u); }
vec3 oct48p_decode(uvec2 code) { return oct48_decode(code); }
vec3 oct52p_decode(uvec2 code) { return unitvec_oct_wide_decode(code, 26u); }

#endif
