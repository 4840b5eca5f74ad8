// unitvec: parallel projections: xyonly16, 24, 32, 32f (z >= 0), pp16, 24, 32, 48 (with the sign of z), spp16, 24, 32,
// 48 (sextants: the largest component reconstructed).
//
// Source: Cigolle et al. 2014, section 5; Meyer et al. 2010, eqs. 6 and 7.
//
//   xyonly16_encode(v), xyonly16_decode(code), ...      uint codes; uvec2, low word first, at 48 bits
//
// Any v will do: length does not matter, below the equator z counts as 0 for xyonly, and +Z stands in for vectors
// without a direction. Layout: the first component in the low bits, then the second, snorm in two's complement, then
// the sign of z, or the sextant: twice the axis, and 1 if negative. Points outside the disk or sextant: see the Rust
// crate's module `parallel`, whose every operation these repeat.

#ifndef UNITVEC_PARALLEL_GLSL
#define UNITVEC_PARALLEL_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

const float UNITVEC_PARALLEL_INSET = 0.4375;
// 1 - 2^-21: the extent of a sextant, which leaves room for the rounding of the largest component.
const float UNITVEC_PARALLEL_SEXTANT_LIMIT = 0.9999995;

// The plane that the components are stored in. half_unit is half an extent of 1. in_steps: extents are those of points in
// steps; only for two components of 8 bits, where they tell the same points outside.
struct UnitvecParallelPlane {
    uvec2 bits;
    vec2 m;
    vec2 steps;
    float limit;
    float half_unit;
    float inset;
    bool sextant;
    bool in_steps;
};

UnitvecParallelPlane unitvec_parallel_disk(uint x_bits, uint y_bits) {
    vec2 m = vec2(unitvec_snorm_max(x_bits), unitvec_snorm_max(y_bits));
    bool fine = x_bits > 22u;
    bool in_steps = x_bits == 8u && y_bits == 8u;
    UNITVEC_PRECISE float square = m.x * m.x;
    UnitvecParallelPlane plane = UnitvecParallelPlane(uvec2(x_bits, y_bits), m, m,
        in_steps ? square : (fine ? 1.0000004 : 1.0), in_steps ? unitvec_over(0.5, square) : 0.5,
        fine ? 0.0 : UNITVEC_PARALLEL_INSET, false, in_steps);
    return plane;
}

UnitvecParallelPlane unitvec_parallel_sextant(uint u_bits, uint v_bits) {
    vec2 m = vec2(unitvec_snorm_max(u_bits), unitvec_snorm_max(v_bits));
    UNITVEC_PRECISE vec2 steps = m * 1.4142135;
    UnitvecParallelPlane plane = UnitvecParallelPlane(uvec2(u_bits, v_bits), m, steps, UNITVEC_PARALLEL_SEXTANT_LIMIT, 0.5,
        u_bits > 22u ? 0.0 : UNITVEC_PARALLEL_INSET, true, false);
    return plane;
}

// e in units of the plane, without a division of floats, so that all devices agree on which points are inside.
vec2 unitvec_parallel_parts(UnitvecParallelPlane plane, vec2 e) {
    vec2 reciprocal = vec2(unitvec_snorm_reciprocal(plane.bits.x), unitvec_snorm_reciprocal(plane.bits.y));
    UNITVEC_PRECISE vec2 in_sextant = e * (reciprocal * 0.70710677);
    vec2 on_disk = vec2(unitvec_snorm_part(e.x, plane.bits.x), unitvec_snorm_part(e.y, plane.bits.y));
    return plane.sextant ? in_sextant : on_disk;
}

// The limit on the border.
float unitvec_parallel_extent(UnitvecParallelPlane plane, vec2 e) {
    vec2 p = plane.in_steps ? e : unitvec_parallel_parts(plane, e);
    float larger = max(p.x, p.y);
    UNITVEC_PRECISE float disk = p.x * p.x + p.y * p.y;
    UNITVEC_PRECISE float sextant = disk + larger * larger;
    return plane.sextant ? sextant : disk;
}

// Whether the border is reached sooner along the first component.
bool unitvec_parallel_is_along_x(UnitvecParallelPlane plane, vec2 e) {
    vec2 p = unitvec_parallel_parts(plane, e);
    UNITVEC_PRECISE float x = p.x * plane.steps.y;
    UNITVEC_PRECISE float y = p.y * plane.steps.x;
    UNITVEC_PRECISE float weighed_x = (p.x >= p.y ? 2.0 : 0.5) * x;
    bool along_x = plane.sextant ? weighed_x >= y : x >= y;
    return plane.bits.x == plane.bits.y ? e.x >= e.y : along_x;
}

// e with `by` steps less in the component along which the border is reached sooner, if it moves.
vec2 unitvec_parallel_inwards(vec2 e, bool moves, bool along_x, float by) {
    UNITVEC_PRECISE vec2 inner = e - vec2(moves && along_x ? by : 0.0, moves && !along_x ? by : 0.0);
    return inner;
}

// The factor that takes a point of this extent, from 1 on, inside, by 2^-21: the tangent of 1 / sqrt(extent) at 1,
// which nowhere is above it.
float unitvec_parallel_onto_border(float extent, float half_unit) {
    UNITVEC_PRECISE float factor = 1.4999995 - half_unit * extent;
    return factor;
}

// Whole numbers of a point of the positive quadrant.
vec2 unitvec_parallel_round(UnitvecParallelPlane plane, vec2 p) {
    UNITVEC_PRECISE vec2 position = p * plane.steps + 0.5;
    // Rounding exceeds m only where the steps are as fine as that of the length.
    vec2 e = plane.inset > 0.0 ? floor(position) : min(floor(position), plane.m);
    bool along_x = unitvec_parallel_is_along_x(plane, e);
    // Points outside when moved are outside as they are.
    bool outside = unitvec_parallel_extent(plane, unitvec_parallel_inwards(e, true, along_x, plane.inset)) > plane.limit;
    return unitvec_parallel_inwards(e, outside, along_x, 1.0);
}

// Point that whole numbers, not negative, stand for: not outside.
vec2 unitvec_parallel_point(UnitvecParallelPlane plane, vec2 e) {
    float extent = unitvec_parallel_extent(plane, e);
    bool along_x = unitvec_parallel_is_along_x(plane, e);
    vec2 inset = unitvec_parallel_inwards(e, extent > plane.limit, along_x, plane.inset);
    UNITVEC_PRECISE vec2 projected = e * unitvec_parallel_onto_border(extent, plane.half_unit);
    bool outside = unitvec_parallel_extent(plane, inset) > plane.limit;
    return unitvec_parallel_parts(plane, outside ? floor(projected) : inset);
}

// v, which has a direction, at unit length; only scaled by a power of two, or not at all, where that is of unit length
// to within 2^-21.
vec3 unitvec_parallel_unit(vec3 v) {
    UNITVEC_PRECISE float raised = unitvec_l1_norm(v) * 1.1;
    UNITVEC_PRECISE vec3 scaled = v * unitvec_scale_to_one(raised);
    float square = unitvec_dot(scaled, scaled);
    UNITVEC_PRECISE float off = square - 1.0;
    float inverse = unitvec_inverse_root(square);
    UNITVEC_PRECISE vec3 n = scaled * (abs(off) <= 9.536743e-7 ? 1.0 : inverse);
    return n;
}

float unitvec_parallel_third(vec2 p) {
    UNITVEC_PRECISE float square = 1.0 - (p.x * p.x + p.y * p.y);
    return unitvec_root(max(square, 0.0));
}

uvec2 unitvec_parallel_pack(vec3 p, vec2 e, uint top, uint x_bits, uint y_bits) {
    uint x = unitvec_signed_code(unitvec_negate_if(unitvec_is_negative(p.x), e.x), x_bits);
    uint y = unitvec_signed_code(unitvec_negate_if(unitvec_is_negative(p.y), e.y), y_bits);
    uint low = x | (y << x_bits);
    uint components = x_bits + y_bits;
    if (components < 32u) {
        return uvec2(low | (top << components), 0u);
    }
    return uvec2(low, (y >> (32u - x_bits)) | (top << (components - 32u)));
}

// The integers in xy; the bits above them are taken by unitvec_parallel_top.
vec2 unitvec_parallel_unpack(uvec2 code, uint x_bits, uint y_bits) {
    uint y = code.x >> x_bits;
    if (x_bits + y_bits >= 32u) {
        y |= code.y << (32u - x_bits);
    }
    return vec2(unitvec_snorm_integer(code.x, x_bits), unitvec_snorm_integer(y, y_bits));
}

uint unitvec_parallel_top(uvec2 code, uint components) {
    if (components < 32u) {
        return code.x >> components;
    }
    return code.y >> (components - 32u);
}

// A part with the sign of its whole number e. With 23 bits and more, whose points have no inset, a number other than 0 may
// have become 0, which stays +0.
float unitvec_parallel_signed(UnitvecParallelPlane plane, float part, float e) {
    return plane.inset > 0.0 ? unitvec_with_sign(part, e) : unitvec_negate_positive(e < 0.0, part);
}

vec3 unitvec_parallel_from_plane(UnitvecParallelPlane plane, vec2 e, bool negative) {
    vec2 p = unitvec_parallel_point(plane, abs(e));
    return vec3(unitvec_parallel_signed(plane, p.x, e.x), unitvec_parallel_signed(plane, p.y, e.y),
        unitvec_negate_positive(negative, unitvec_parallel_third(p)));
}

uint unitvec_xyonly_encode(vec3 v, uint bits) {
    vec3 n = unitvec_parallel_unit(unitvec_upper(v));
    vec2 e = unitvec_parallel_round(unitvec_parallel_disk(bits, bits), abs(n.xy));
    uint code = unitvec_parallel_pack(n, e, 0u, bits, bits).x;
    return unitvec_is_upper_usable(v) ? code : 0u;
}

vec3 unitvec_xyonly_decode(uint code, uint bits) {
    vec2 e = unitvec_parallel_unpack(uvec2(code, 0u), bits, bits);
    return unitvec_parallel_from_plane(unitvec_parallel_disk(bits, bits), e, false);
}

uvec2 unitvec_pp_encode(vec3 v, uint x_bits, uint y_bits) {
    v = unitvec_or_z(v);
    vec3 n = unitvec_parallel_unit(v);
    vec2 e = unitvec_parallel_round(unitvec_parallel_disk(x_bits, y_bits), abs(n.xy));
    // The sign of v, not of n: n may have made a normal number of a denormal that another device flushes to zero.
    return unitvec_parallel_pack(n, e, unitvec_is_negative(v.z) ? 1u : 0u, x_bits, y_bits);
}

vec3 unitvec_pp_decode(uvec2 code, uint x_bits, uint y_bits) {
    vec2 e = unitvec_parallel_unpack(code, x_bits, y_bits);
    uint top = unitvec_parallel_top(code, x_bits + y_bits);
    return unitvec_parallel_from_plane(unitvec_parallel_disk(x_bits, y_bits), e, (top & 1u) != 0u);
}

uvec2 unitvec_spp_encode(vec3 v, uint u_bits, uint v_bits) {
    v = unitvec_or_z(v);
    uint face = unitvec_face_of(v);
    vec3 n = unitvec_to_face(unitvec_parallel_unit(v), face);
    vec2 e = unitvec_parallel_round(unitvec_parallel_sextant(u_bits, v_bits), abs(n.xy));
    return unitvec_parallel_pack(n, e, face, u_bits, v_bits);
}

vec3 unitvec_spp_decode(uvec2 code, uint u_bits, uint v_bits) {
    vec2 e = unitvec_parallel_unpack(code, u_bits, v_bits);
    uint top = unitvec_parallel_top(code, u_bits + v_bits);
    vec3 n = unitvec_parallel_from_plane(unitvec_parallel_sextant(u_bits, v_bits), e, (top & 1u) != 0u);
    return unitvec_from_face(n, top & 7u);
}

vec2 unitvec_xyonly32f_halves(uint a, uint b) {
    return vec2(unitvec_half_decode_magnitude(a), unitvec_half_decode_magnitude(b));
}

bool unitvec_xyonly32f_is_off_disk(vec2 p) {
    UNITVEC_PRECISE float square = p.x * p.x + p.y * p.y;
    return square > 1.0;
}

// Numbers of two halves without signs, the larger one moved towards the next smaller half.
vec2 unitvec_xyonly32f_halves_inset(uint a, uint b) {
    vec2 p = unitvec_xyonly32f_halves(a, b);
    vec2 inner = unitvec_xyonly32f_halves(a > 0u ? a - 1u : 0u, b > 0u ? b - 1u : 0u);
    UNITVEC_PRECISE vec2 q = p - UNITVEC_PARALLEL_INSET * (p - inner);
    return p.x >= p.y ? vec2(q.x, p.y) : vec2(p.x, q.y);
}

// A half not above x: the next one, or 0 in place of those below 2^-14.
float unitvec_xyonly32f_half_below(float x) {
    uint bits = floatBitsToUint(x);
    return uintBitsToFloat(bits < 0x38800000u ? 0u : bits & 0xffffe000u);
}

uint xyonly32f_encode(vec3 v) {
    vec3 n = unitvec_parallel_unit(unitvec_upper(v));
    uint a = unitvec_half_encode_magnitude(n.x);
    uint b = unitvec_half_encode_magnitude(n.y);
    bool off_disk = unitvec_xyonly32f_is_off_disk(unitvec_xyonly32f_halves(a, b));
    bool inset_off_disk = unitvec_xyonly32f_is_off_disk(unitvec_xyonly32f_halves_inset(a, b));
    bool unwritten = off_disk && inset_off_disk;
    uint x = a - (unwritten && a >= b ? 1u : 0u);
    uint y = b - (unwritten && a < b ? 1u : 0u);
    uint x_sign = unitvec_is_negative(n.x) && x != 0u ? 0x8000u : 0u;
    uint y_sign = unitvec_is_negative(n.y) && y != 0u ? 0x8000u : 0u;
    return unitvec_is_upper_usable(v) ? (x | x_sign) | ((y | y_sign) << 16u) : 0u;
}

vec3 xyonly32f_decode(uint code) {
    uint a = code & 0x7fffu;
    uint b = (code >> 16u) & 0x7fffu;
    vec2 p = unitvec_xyonly32f_halves(a, b);
    vec2 inner = unitvec_xyonly32f_halves_inset(a, b);
    vec2 inset = unitvec_xyonly32f_is_off_disk(p) ? inner : p;
    vec2 unit = min(p, 1.0);
    UNITVEC_PRECISE float square = unit.x * unit.x + unit.y * unit.y;
    UNITVEC_PRECISE vec2 projected = unit * unitvec_parallel_onto_border(square, 0.5);
    vec2 below = vec2(unitvec_xyonly32f_half_below(projected.x), unitvec_xyonly32f_half_below(projected.y));
    vec2 q = unitvec_xyonly32f_is_off_disk(inset) ? below : inset;
    return vec3(unitvec_negate_positive((code & 0x8000u) != 0u, q.x), unitvec_negate_positive((code >> 31u) != 0u, q.y),
        unitvec_parallel_third(q));
}

uint xyonly16_encode(vec3 v) { return unitvec_xyonly_encode(v, 8u); }
vec3 xyonly16_decode(uint code) { return unitvec_xyonly_decode(code, 8u); }
uint xyonly24_encode(vec3 v) { return unitvec_xyonly_encode(v, 12u); }
vec3 xyonly24_decode(uint code) { return unitvec_xyonly_decode(code, 12u); }
uint xyonly32_encode(vec3 v) { return unitvec_xyonly_encode(v, 16u); }
vec3 xyonly32_decode(uint code) { return unitvec_xyonly_decode(code, 16u); }

uint pp16_encode(vec3 v) { return unitvec_pp_encode(v, 8u, 7u).x; }
vec3 pp16_decode(uint code) { return unitvec_pp_decode(uvec2(code, 0u), 8u, 7u); }
uint pp24_encode(vec3 v) { return unitvec_pp_encode(v, 12u, 11u).x; }
vec3 pp24_decode(uint code) { return unitvec_pp_decode(uvec2(code, 0u), 12u, 11u); }
uint pp32_encode(vec3 v) { return unitvec_pp_encode(v, 16u, 15u).x; }
vec3 pp32_decode(uint code) { return unitvec_pp_decode(uvec2(code, 0u), 16u, 15u); }
uvec2 pp48_encode(vec3 v) { return unitvec_pp_encode(v, 24u, 23u); }
vec3 pp48_decode(uvec2 code) { return unitvec_pp_decode(code, 24u, 23u); }

uint spp16_encode(vec3 v) { return unitvec_spp_encode(v, 7u, 6u).x; }
vec3 spp16_decode(uint code) { return unitvec_spp_decode(uvec2(code, 0u), 7u, 6u); }
uint spp24_encode(vec3 v) { return unitvec_spp_encode(v, 11u, 10u).x; }
vec3 spp24_decode(uint code) { return unitvec_spp_decode(uvec2(code, 0u), 11u, 10u); }
uint spp32_encode(vec3 v) { return unitvec_spp_encode(v, 15u, 14u).x; }
vec3 spp32_decode(uint code) { return unitvec_spp_decode(uvec2(code, 0u), 15u, 14u); }
uvec2 spp48_encode(vec3 v) { return unitvec_spp_encode(v, 23u, 22u); }
vec3 spp48_decode(uvec2 code) { return unitvec_spp_decode(code, 23u, 22u); }

#endif
