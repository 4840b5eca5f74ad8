// unitvec: octahedral codes of 8, 12, 16, 18, 20, 22, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, listings 1 to 5; Meyer et al. 2010, section 5.
//
//   oct16_encode(v), oct16_decode(code)      integer codes; also oct8, oct12, oct18, oct20, oct22, oct24, oct32
//   oct16p_encode(v), ...                    precise encoders of the same formats
//   float32x3_to_oct(v)                      a pair on [-1, 1], for an snorm format to which the hardware converts
//   float32x3_to_octn_precise(v, n)          the precise code as such a pair, for a format of n bits (even, 4 to 32)
//   oct_to_float32x3(e)                      the direction of such a pair
//   float32x3_to_oct_unorm(v), oct_unorm_to_float32x3(e)      the same on [0, 1], for a unorm format
//   octn_to_unorm(e, n), unorm_to_octn(u, n)      the pair of a precise code of n bits on [0, 1], for a unorm format of as many:
//                                                 its values 0 to 2^b - 2; the axes stay exact
//   snorm12x2_to_unorm8x3(f), unorm8x3_to_snorm12x2(u)      a pair of 12 bits each as three unorm8 values, and back
//
//   snorm12x2_to_uint8x3(f), uint8x3_to_snorm12x2(u)         the same as three bytes, for an integer format
//
// To an attachment of RG16_SNORM, float32x3_to_octn_precise(v, 32) stores the code of oct32p, exactly, and
// float32x3_to_oct(v) that of oct32 but for at most 3 codes in 1000, which are a step off: it rounds, and the hardware
// again.
//
// All take any input. Of v the length does not matter, and +Z stands in for vectors without a direction or with NaN;
// other floats are clamped to their range. Layout: x in the low half, y in the high half, two's complement snorm; oct24
// has the three bytes of listing 5 instead, first byte lowest. With m the snorm's largest integer, codes are the whole
// points of the square [-m, m]^2: its lattice.

#ifndef UNITVEC_OCT_GLSL
#define UNITVEC_OCT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// Moves a point of the positive octant, scaled to x + y + z = m, to where the lower half of the octahedron is folded
// out if z is negative.
vec2 unitvec_oct_fold(float z, vec2 p, float m) {
    UNITVEC_PRECISE vec2 folded = m - p.yx;
    return unitvec_is_negative(z) ? folded : p;
}

// Gives p, from the positive octant, the signs of v.
vec2 unitvec_oct_mirror(vec3 v, vec2 p) {
    return vec2(unitvec_with_sign(p.x, v.x), unitvec_with_sign(p.y, v.y));
}

// The place of v, of this L1 norm, on the square [-m, m]^2 (listing 1). Below the equator x is folded to m - |y| s,
// with s = m / norm, which is (|x| + |z|) s.
vec2 unitvec_oct_position(vec3 v, float norm, float m) {
    float below = max(-v.z, 0.0);
    UNITVEC_PRECISE vec2 p = (abs(v.xy) + below) * unitvec_over(m, norm);
    return unitvec_oct_mirror(v, p);
}

// q at the point where the ray of p hits the plane x + y + z = m.
vec2 unitvec_oct_projected(vec2 q, vec3 p, vec2 middle, float m) {
    UNITVEC_PRECISE float missing = (((m - middle.x) - middle.y) - p.z) - (q.x + q.y);
    UNITVEC_PRECISE float stretch = missing * unitvec_reciprocal(m);
    UNITVEC_PRECISE vec2 moved = q + stretch * p.xy;
    return moved;
}

// A and B with the denominators (c . p)^2 taken into account: as if q were q + u (X, Y), with u = 3 / m N /
// (3 + X^2 + Y^2 + Z^2), Z = -X - Y, and N that of two corners where they tie.
vec2 unitvec_oct_weighed(vec2 ab, float cross_term, vec2 q, vec2 at, float m) {
    UNITVEC_PRECISE float minus_z = at.x + at.y;
    UNITVEC_PRECISE float z_squared = minus_z * minus_z;
    UNITVEC_PRECISE float over = max(abs(ab.x + ab.y) - cross_term, 0.0);
    UNITVEC_PRECISE float n = ((ab.x * q.x + ab.y * q.y) + (0.25 * z_squared + 0.5)) - over;
    UNITVEC_PRECISE float half_s = z_squared + (0.5 + cross_term);
    UNITVEC_PRECISE float u = n * unitvec_quotient(unitvec_over(1.5, m), half_s);
    UNITVEC_PRECISE vec2 moved = ab + u * (at + minus_z);
    return moved;
}

// q with the denominators taken into account for the most part: 0.1265 in place of N / (3 + X^2 + Y^2 + Z^2), which
// leaves at most 0.2 / m of a step: for 20 bits and more.
vec2 unitvec_oct_approached(vec2 q, vec2 at, float m) {
    UNITVEC_PRECISE vec2 moved = q + at * unitvec_over(0.3795, m);
    return moved;
}

// Corner of the lattice cell around p that is nearest to it in angle, for p in the positive octant with
// x + y + z = m.
//
// With (X, Y) = at, 0 in the octant's middle, a corner c and d = c - p seen along z, 3 / m^2 |c x p|^2 is
// (2 + Y^2) dx^2 + 2 (1 - X Y) dx dy + (2 + X^2) dy^2. With q = p from the cell's middle, A = (2 + Y^2) q.x +
// (1 - X Y) q.y, B = (1 - X Y) q.x + (2 + X^2) q.y and H = (1 - X Y) / 2, the right corner is nearer than the upper one
// where A > B; then the near one loses to it where A > -H, the far one wins where B > H. Else likewise.
vec2 unitvec_oct_nearest_corner(vec3 p, float m) {
    UNITVEC_PRECISE vec2 middle = floor(p.xy) + 0.5;
    UNITVEC_PRECISE vec2 q = p.xy - middle;
    UNITVEC_PRECISE vec2 at = p.xy * unitvec_over(3.0, m) - 1.0;
    if (m >= 256.0 && m < 4096.0) q = unitvec_oct_approached(q, at, m);
    if (m >= 65536.0) q = unitvec_oct_projected(q, p, middle, m);

    UNITVEC_PRECISE float turn = at.y * q.x - at.x * q.y;
    UNITVEC_PRECISE float sum = q.x + q.y;
    UNITVEC_PRECISE float a = (q.x + sum) + at.y * turn;
    UNITVEC_PRECISE float b = (q.y + sum) - at.x * turn;
    UNITVEC_PRECISE float cross_term = 1.0 - at.x * at.y;
    vec2 ab = vec2(a, b);
    if (m < 256.0) ab = unitvec_oct_weighed(ab, cross_term, q, at, m);

    float half_cross = 0.5 * cross_term;
    float least_b = ab.x >= ab.y ? half_cross : -half_cross;
    UNITVEC_PRECISE vec2 corner = middle + vec2(ab.x > -least_b ? 0.5 : -0.5, ab.y > least_b ? 0.5 : -0.5);
    return corner;
}

// A corner of a lattice cell: x, y, and the square of the tangent of its angle from p as a fraction, z / w. One beyond the
// edge z = 0 of the octant is farther than any.
vec4 unitvec_oct_corner(float x, float y, vec3 p, float m) {
    UNITVEC_PRECISE float z = m - x - y;
    UNITVEC_PRECISE float a = y * p.z - z * p.y;
    UNITVEC_PRECISE float b = z * p.x - x * p.z;
    UNITVEC_PRECISE float c = x * p.y - y * p.x;
    UNITVEC_PRECISE float across = (a * a + b * b) + c * c;
    UNITVEC_PRECISE float along = (x * p.x + y * p.y) + z * p.z;
    UNITVEC_PRECISE float squared = along * along;
    return vec4(x, y, across, z < 0.0 ? 0.0 : squared);
}

// unitvec_oct_nearest_corner for any m: the best of the four corners, as listing 3 finds it.
vec2 unitvec_oct_searched_corner(vec3 p, float m) {
    vec2 low = floor(p.xy);
    UNITVEC_PRECISE vec2 high = low + 1.0;
    vec4 near = unitvec_oct_corner(low.x, low.y, p, m);
    vec4 right = unitvec_oct_corner(high.x, low.y, p, m);
    vec4 up = unitvec_oct_corner(low.x, high.y, p, m);
    vec4 far = unitvec_oct_corner(high.x, high.y, p, m);
    return unitvec_nearer(unitvec_nearer(unitvec_nearer(near, right), up), far).xy;
}

// Lattice point that is nearest in angle to the direction of v, of this L1 norm.
vec2 unitvec_oct_precise_point(vec3 v, float norm, float m) {
    UNITVEC_PRECISE vec3 p = abs(v) * unitvec_over(m, norm);
    // 2^-26 of the norm, more than any denormal. Some devices flush denormals, whose effect in unitvec_oct_projected
    // would break ties.
    if (m >= 65536.0) p = max(p, m * 1.490116119384765625e-8);
    // Squares of fewer steps than 63 (up to 12 bits) are too coarse for unitvec_oct_weighed.
    vec2 corner = m < 63.0 ? unitvec_oct_searched_corner(p, m) : unitvec_oct_nearest_corner(p, m);
    return unitvec_oct_mirror(v, unitvec_oct_fold(v.z, corner, m));
}

// Lattice point that is nearest in angle to the direction of any v; (0, 0) where it has no direction.
vec2 unitvec_oct_lattice_precise(vec3 v, float m) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_oct_precise_point(v, norm, m);
    return unitvec_is_usable(norm) ? e : vec2(0.0);
}

// Direction of a lattice point (listing 2, in Stubbe's branch-light form), unit length to within 2 ULP.
vec3 unitvec_oct_from_lattice(vec2 e, float m) {
    UNITVEC_PRECISE float z = m - abs(e.x) - abs(e.y);
    float below = max(-z, 0.0);
    UNITVEC_PRECISE float x = e.x - unitvec_with_sign(below, e.x);
    UNITVEC_PRECISE float y = e.y - unitvec_with_sign(below, e.y);
    return unitvec_normalize_octahedral(vec3(x, y, z), m, 0.5 * (m + 1.0));
}

// Listing 1: the octahedral projection, unquantised, on [-1, 1]^2.
vec2 float32x3_to_oct(vec3 v) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_oct_position(v, norm, 1.0);
    return unitvec_is_usable(norm) ? e : vec2(0.0);
}

// Listing 2: the direction of a pair of snorm values on [-1, 1].
vec3 oct_to_float32x3(vec2 e) {
    return unitvec_oct_from_lattice(unitvec_snorm_clamp(e), 1.0);
}

// Variants with values on [0, 1], for a UNORM format, which cannot hold the middle exactly.
vec2 float32x3_to_oct_unorm(vec3 v) { return unitvec_biased(float32x3_to_oct(v)); }
vec3 oct_unorm_to_float32x3(vec2 e) { return oct_to_float32x3(unitvec_unbiased(e)); }

// Listing 3: the precise code of n bits (even, up to 32) as a pair of snorm values on [-1, 1].
vec2 float32x3_to_octn_precise(vec3 v, int n) {
    uint bits = uint(n / 2);
    vec2 e = unitvec_oct_lattice_precise(v, unitvec_snorm_max(bits));
    return vec2(unitvec_snorm_quotient(e.x, bits), unitvec_snorm_quotient(e.y, bits));
}

// A pair of snorm values of n / 2 bits, rounded to the values 0 to 2^b - 2 of a unorm format.
vec2 octn_to_unorm(vec2 e, int n) {
    uint bits = uint(n / 2);
    float m = unitvec_snorm_max(bits);
    UNITVEC_PRECISE vec2 i = floor(unitvec_snorm_clamp(e) * m + (m + 0.5));
    return vec2(unitvec_snorm_quotient(i.x, bits + 1u), unitvec_snorm_quotient(i.y, bits + 1u));
}

// The inverse of octn_to_unorm, from values of a texture fetch.
vec2 unorm_to_octn(vec2 u, int n) {
    uint bits = uint(n / 2);
    float m = unitvec_snorm_max(bits);
    UNITVEC_PRECISE vec2 i = floor(clamp(u, 0.0, 1.0) * unitvec_snorm_max(bits + 1u) + 0.5) - m;
    vec2 e = vec2(unitvec_snorm_quotient(min(i.x, m), bits), unitvec_snorm_quotient(min(i.y, m), bits));
    return unitvec_is_nan(abs(u.x) + abs(u.y)) ? vec2(0.0) : e;
}

// The three bytes of a pair of snorm12 values, whole numbers. Ties go up.
vec3 unitvec_oct_bytes(vec2 f) {
    UNITVEC_PRECISE vec2 u = floor(unitvec_snorm_clamp(f) * 2047.0 + 2047.5);
    float high = floor(u.x * 0.0625);
    float carry = floor(u.y * 0.00390625);
    UNITVEC_PRECISE vec3 bytes = vec3(high, (u.x - high * 16.0) * 16.0 + carry, u.y - carry * 256.0);
    return bytes;
}

// The inverse of unitvec_oct_bytes, for whole numbers up to 255.
vec2 unitvec_oct_from_bytes(vec3 bytes) {
    float high = floor(bytes.y * 0.0625);
    UNITVEC_PRECISE vec2 biased = vec2(bytes.x * 16.0 + high, (bytes.y - high * 16.0) * 256.0 + bytes.z);
    UNITVEC_PRECISE vec2 e = biased - 2047.0;
    return min(vec2(unitvec_snorm_quotient(e.x, 12u), unitvec_snorm_quotient(e.y, 12u)), 1.0);
}

// Listing 5: a pair of snorm12 values on [-1, 1] as three unorm8 values on [0, 1], for an RGB8 target.
vec3 snorm12x2_to_unorm8x3(vec2 f) {
    return unitvec_snorm_quotients(unitvec_oct_bytes(f), 9u, 9u);
}

// Listing 5: the inverse, from unorm8 values as a texture fetch gives them.
vec2 unorm8x3_to_snorm12x2(vec3 u) {
    UNITVEC_PRECISE vec3 bytes = floor(clamp(u, 0.0, 1.0) * 255.0 + 0.5);
    return unitvec_is_nan(unitvec_l1_norm(u)) ? vec2(0.0) : unitvec_oct_from_bytes(bytes);
}

// Listing 5 for an integer target such as RGB8UI: the bytes themselves.
uvec3 snorm12x2_to_uint8x3(vec2 f) {
    vec3 bytes = unitvec_oct_bytes(f);
    return uvec3(unitvec_whole_to_u32(bytes.x), unitvec_whole_to_u32(bytes.y), unitvec_whole_to_u32(bytes.z));
}

// The inverse of snorm12x2_to_uint8x3. Numbers above 255 count as 255.
vec2 uint8x3_to_snorm12x2(uvec3 u) {
    uvec3 bytes = min(u, 255u);
    return unitvec_oct_from_bytes(vec3(float(bytes.x), float(bytes.y), float(bytes.z)));
}

// 2^23 + 2047: the low 12 bits of its sum with x from -2047 to 2047 are x + 2047, rounded to the nearest.
const float UNITVEC_OCT_BIAS = 8390655.0;

// Code of the lattice point nearest to e, with m = 2047: the bytes of listing 5, the first in the low bits.
uint unitvec_oct_pack_unorm8x3(vec2 e) {
    UNITVEC_PRECISE vec2 sum = e + UNITVEC_OCT_BIAS;
    uint both = (floatBitsToUint(sum.x) << 12u) + floatBitsToUint(sum.y);
    return ((both >> 16u) & 255u) | (both & 0xff00u) | ((both & 255u) << 16u);
}

// The pattern 4095 of a component, which encoding never writes, counts as 4094.
vec2 unitvec_oct_unpack_unorm8x3(uint code) {
    uint both = ((code & 255u) << 16u) | (code & 0xff00u) | ((code >> 16u) & 255u);
    uvec2 sum = uvec2(both >> 12u, both & 0xfffu) | floatBitsToUint(UNITVEC_2_23);
    UNITVEC_PRECISE vec2 e = uintBitsToFloat(sum) - UNITVEC_OCT_BIAS;
    return min(e, 2047.0);
}

// Code of the lattice point nearest to e; ties go to even components (odd for 24 bits); `bits` bits in all.
uint unitvec_oct_pack(vec2 e, uint bits) {
    return bits == 24u ? unitvec_oct_pack_unorm8x3(e) : unitvec_nearest_pair(e, bits / 2u);
}

vec2 unitvec_oct_unpack(uint code, uint bits) {
    return bits == 24u ? unitvec_oct_unpack_unorm8x3(code) : unitvec_snorm_integers(code, bits / 2u);
}

// `code`, or the code of +Z where this L1 norm gives no direction: selecting here takes the fewest operations.
uint unitvec_oct_usable_code(float norm, uint code, uint bits) {
    return unitvec_is_usable(norm) ? code : unitvec_oct_pack(vec2(0.0), bits);
}

uint unitvec_oct_encode(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_oct_position(v, norm, unitvec_snorm_max(bits / 2u));
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(e, bits), bits);
}

uint unitvec_oct_encode_precise(vec3 v, uint bits) {
    float norm = unitvec_l1_norm(v);
    vec2 e = unitvec_oct_precise_point(v, norm, unitvec_snorm_max(bits / 2u));
    return unitvec_oct_usable_code(norm, unitvec_oct_pack(e, bits), bits);
}

vec3 unitvec_oct_decode(uint code, uint bits) {
    return unitvec_oct_from_lattice(unitvec_oct_unpack(code, bits), unitvec_snorm_max(bits / 2u));
}

uint oct8_encode(vec3 v) { return unitvec_oct_encode(v, 8u); }
uint oct12_encode(vec3 v) { return unitvec_oct_encode(v, 12u); }
uint oct16_encode(vec3 v) { return unitvec_oct_encode(v, 16u); }
uint oct18_encode(vec3 v) { return unitvec_oct_encode(v, 18u); }
uint oct20_encode(vec3 v) { return unitvec_oct_encode(v, 20u); }
uint oct22_encode(vec3 v) { return unitvec_oct_encode(v, 22u); }
uint oct24_encode(vec3 v) { return unitvec_oct_encode(v, 24u); }
uint oct32_encode(vec3 v) { return unitvec_oct_encode(v, 32u); }

uint oct8p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 8u); }
uint oct12p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 12u); }
uint oct16p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 16u); }
uint oct18p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 18u); }
uint oct20p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 20u); }
uint oct22p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 22u); }
uint oct24p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 24u); }
uint oct32p_encode(vec3 v) { return unitvec_oct_encode_precise(v, 32u); }

vec3 oct8_decode(uint code) { return unitvec_oct_decode(code, 8u); }
vec3 oct12_decode(uint code) { return unitvec_oct_decode(code, 12u); }
vec3 oct16_decode(uint code) { return unitvec_oct_decode(code, 16u); }
vec3 oct18_decode(uint code) { return unitvec_oct_decode(code, 18u); }
vec3 oct20_decode(uint code) { return unitvec_oct_decode(code, 20u); }
vec3 oct22_decode(uint code) { return unitvec_oct_decode(code, 22u); }
vec3 oct24_decode(uint code) { return unitvec_oct_decode(code, 24u); }
vec3 oct32_decode(uint code) { return unitvec_oct_decode(code, 32u); }

vec3 oct8p_decode(uint code) { return oct8_decode(code); }
vec3 oct12p_decode(uint code) { return oct12_decode(code); }
vec3 oct16p_decode(uint code) { return oct16_decode(code); }
vec3 oct18p_decode(uint code) { return oct18_decode(code); }
vec3 oct20p_decode(uint code) { return oct20_decode(code); }
vec3 oct22p_decode(uint code) { return oct22_decode(code); }
vec3 oct24p_decode(uint code) { return oct24_decode(code); }
vec3 oct32p_decode(uint code) { return oct32_decode(code); }

#endif
