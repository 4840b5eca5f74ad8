// unitvec: cube codes of 16, 24, 32 and 48 bits, and warped cube codes of 16, 24 and 32.
//
// Source: Cigolle et al. 2014, section 2; Meyer et al. 2010, eq. 8.
//
//   cube16_encode(v), cube16_decode(code), warpedcube16_encode(v), warpedcube16_decode(code); also 24 and 32
//   cube48_encode(v), cube48_decode(code)      codes as uvec2, low word first
//
// Any v will do: length does not matter, and +Z stands in for vectors without a direction. Layout: u in the low
// ceil((b - 3) / 2) bits, then v, two's complement, over (m + 1/2); the face in the high three: twice the axis, and 1
// if negative. (u, v) is (y, z), (z, x), (x, y) on the faces of x, y, z. The warped cube stores 4/pi atan(u) in place
// of u.

#ifndef UNITVEC_CUBE_GLSL
#define UNITVEC_CUBE_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

float unitvec_cube_round(bool negative, float magnitude, float m) {
    UNITVEC_PRECISE float position = magnitude * (m + 0.5) + 0.5;
    float rounded = floor(position);
    return unitvec_negate_if(negative, rounded > m ? m : rounded);
}

// The bits of u and of v in a code of `bits` bits.
uvec2 unitvec_cube_widths(uint bits) {
    return uvec2((bits - 2u) / 2u, (bits - 3u) / 2u);
}

uint unitvec_cube_encode_on_face(vec3 v, uint bits, bool warped) {
    v = unitvec_or_z(v);
    uint face = unitvec_face_of(v);
    vec3 p = unitvec_to_face(v, face);
    float scale = unitvec_reciprocal(abs(p.z));
    UNITVEC_PRECISE vec2 t = abs(p.xy) * scale;
    if (warped) t = vec2(unitvec_atan_octant(t.x), unitvec_atan_octant(t.y));
    uvec2 widths = unitvec_cube_widths(bits);
    float x = unitvec_cube_round(unitvec_is_negative(p.x), t.x, unitvec_snorm_max(widths.x));
    float y = unitvec_cube_round(unitvec_is_negative(p.y), t.y, unitvec_snorm_max(widths.y));
    return unitvec_signed_code(x, widths.x) | (unitvec_signed_code(y, widths.y) << widths.x) | (face << (bits - 3u));
}

uint unitvec_cube_unpack_face(uint code, uint bits) {
    return (code >> (bits - 3u)) & 7u;
}

vec2 unitvec_cube_unpack(uint code, uint bits) {
    uvec2 widths = unitvec_cube_widths(bits);
    return vec2(unitvec_snorm_field(code, 0u, widths.x), unitvec_snorm_field(code, widths.x, widths.y));
}

uint unitvec_cube_encode(vec3 v, uint bits) {
    return unitvec_cube_encode_on_face(v, bits, false);
}

vec3 unitvec_cube_decode(uint code, uint bits) {
    uint face = unitvec_cube_unpack_face(code, bits);
    vec2 e = unitvec_cube_unpack(code, bits);
    uvec2 widths = unitvec_cube_widths(bits);
    // In steps of u, so that only v is rounded before the normalisation.
    UNITVEC_PRECISE float side = unitvec_snorm_max(widths.x) + 0.5;
    float v_step = unitvec_over(side, unitvec_snorm_max(widths.y) + 0.5);
    UNITVEC_PRECISE float y = e.y * v_step;
    return unitvec_from_face(unitvec_normalize(vec3(e.x, y, unitvec_negate_if((face & 1u) != 0u, side))), face);
}

uint unitvec_warpedcube_encode(vec3 v, uint bits) {
    return unitvec_cube_encode_on_face(v, bits, true);
}

vec3 unitvec_warpedcube_decode(uint code, uint bits) {
    uint face = unitvec_cube_unpack_face(code, bits);
    vec2 e = unitvec_cube_unpack(code, bits);
    uvec2 widths = unitvec_cube_widths(bits);
    // Both over m + 1/2: twice that is the largest integer of an snorm with one bit more.
    UNITVEC_PRECISE vec2 doubled = 2.0 * abs(e);
    float s = unitvec_snorm_quotient(doubled.x, widths.x + 1u);
    float t = unitvec_snorm_quotient(doubled.y, widths.y + 1u);
    vec3 p = vec3(unitvec_negate_if(unitvec_is_negative(e.x), unitvec_tan_octant(s)),
        unitvec_negate_if(unitvec_is_negative(e.y), unitvec_tan_octant(t)),
        unitvec_negate_if((face & 1u) != 0u, 1.0));
    return unitvec_from_face(unitvec_normalize(p), face);
}

// Whole number nearest to (2^(bits-1) - 1/2) x / side, at most 2^(bits-1) - 1, 0 <= x <= side. Twice the factor of
// x / side is 2^bits - 1.
int unitvec_cube_round_wide(float x, float side, uint bits) {
    float reciprocal = unitvec_reciprocal(side);
    int doubled;
    float fraction;
    unitvec_coordinate(x, vec2(side, 0.0), reciprocal, bits + 1u, doubled, fraction);
    return min((doubled + 1) >> 1, int(unitvec_mask(bits - 1u)));
}

// Integer of the low `bits` bits of a code, in two's complement; the least counts as the next.
int unitvec_cube_integer(uint code, uint bits) {
    return max(int(code << (32u - bits)) >> int(32u - bits), -int(unitvec_mask(bits - 1u)));
}

uvec2 cube48_encode(vec3 v) {
    v = unitvec_or_z(v);
    uint face = unitvec_face_of(v);
    vec3 p = unitvec_to_face(unitvec_scaled_to_one(v, unitvec_l1_norm(v)), face);
    int i = unitvec_cube_round_wide(abs(p.x), abs(p.z), 23u);
    int j = unitvec_cube_round_wide(abs(p.y), abs(p.z), 22u);
    uint low = uint(unitvec_is_negative(p.x) ? -i : i) & unitvec_mask(23u);
    uint high = uint(unitvec_is_negative(p.y) ? -j : j) & unitvec_mask(22u);
    return uvec2(low | (high << 23u), (high >> 9u) | (face << 13u));
}

vec3 cube48_decode(uvec2 code) {
    int i = unitvec_cube_integer(code.x, 23u);
    int j = unitvec_cube_integer((code.x >> 23u) | (code.y << 9u), 22u);
    uint face = (code.y >> 13u) & 7u;
    // Half a side is 2^23 - 1; then a step of u is 2, and one of v 4 + 2 / (2^22 - 1).
    ivec2 steps = ivec2(2, 4) * abs(ivec2(i, j));
    UNITVEC_PRECISE float rest = float(abs(j)) * 4.768373e-7;
    UNITVEC_PRECISE vec3 lower =
        vec3(float(steps.x & 4095), float(steps.y & 4095) + rest, 4095.0) * unitvec_exp2(-12);
    vec3 p = unitvec_normalize_parts(vec3(vec2(steps >> 12), 2047.0), lower);
    p = vec3(unitvec_negate_positive(i < 0, p.x), unitvec_negate_positive(j < 0, p.y),
        unitvec_negate_if((face & 1u) != 0u, p.z));
    return unitvec_from_face(p, face);
}

uint cube16_encode(vec3 v) { return unitvec_cube_encode(v, 16u); }
uint cube24_encode(vec3 v) { return unitvec_cube_encode(v, 24u); }
uint cube32_encode(vec3 v) { return unitvec_cube_encode(v, 32u); }

vec3 cube16_decode(uint code) { return unitvec_cube_decode(code, 16u); }
vec3 cube24_decode(uint code) { return unitvec_cube_decode(code, 24u); }
vec3 cube32_decode(uint code) { return unitvec_cube_decode(code, 32u); }

uint warpedcube16_encode(vec3 v) { return unitvec_warpedcube_encode(v, 16u); }
uint warpedcube24_encode(vec3 v) { return unitvec_warpedcube_encode(v, 24u); }
uint warpedcube32_encode(vec3 v) { return unitvec_warpedcube_encode(v, 32u); }

vec3 warpedcube16_decode(uint code) { return unitvec_warpedcube_decode(code, 16u); }
vec3 warpedcube24_decode(uint code) { return unitvec_warpedcube_decode(code, 24u); }
vec3 warpedcube32_decode(uint code) { return unitvec_warpedcube_decode(code, 32u); }

#endif
