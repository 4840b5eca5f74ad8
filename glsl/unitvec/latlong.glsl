// unitvec: numbered patches between circles of latitude, in 16, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, sections 2 and 2.3; Smith et al. 2012. Formulas stand in for their table.
//
//   latlong16_encode(v), latlong16_decode(code)      plain grid; also latlong24, 32
//   latlong16d_encode(v), latlong16d_decode(code)    nearly square patches; also latlong24d, 32d
//
// The code functions take any v: length does not matter, and +Z stands in for vectors without a direction. Layout of
// the grid: the patch in the low half, from +X towards +Y; the ring in the high half, from +Z. Layout of the others:
// the index in the low b - 3 bits, the quarter turn from +X in the next two, the hemisphere (1 for z < 0) in the
// highest.

#ifndef UNITVEC_LATLONG_GLSL
#define UNITVEC_LATLONG_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

uint unitvec_latlong_grid_encode(vec3 v, uint half_bits) {
    float norm = unitvec_l1_norm(v);
    vec3 p = unitvec_angles_scaled(v, norm);
    float rings = float(1u << half_bits);
    UNITVEC_PRECISE float colatitude =
        unitvec_angles_half_turn(unitvec_horizontal_length(p), p.z, unitvec_is_negative(v.z)) * (0.5 * rings);
    UNITVEC_PRECISE float azimuth = unitvec_angles_half_turn(p.y, p.x, unitvec_is_negative(v.x)) * (0.25 * rings);
    // Patches at y < 0 are those at y > 0, mirrored: the number of one is the other's complement.
    uint patch_number = unitvec_whole_to_u32(floor(azimuth));
    patch_number = unitvec_is_negative(v.y) ? ~patch_number : patch_number;
    uint ring = unitvec_whole_to_u32(floor(min(colatitude, rings - 1.0)));
    uint code = (patch_number & unitvec_mask(half_bits)) | (ring << half_bits);
    return unitvec_is_usable(norm) ? code : 0u;
}

vec3 unitvec_latlong_grid_decode(uint code, uint half_bits) {
    float step_size = unitvec_exp2(-int(half_bits));
    float ring = float(int((code >> half_bits) & unitvec_mask(half_bits)));
    UNITVEC_PRECISE float above = 1.0 - (ring + 0.5) * (2.0 * step_size);
    UNITVEC_PRECISE float diagonal = 0.5 - abs(above);
    vec2 meridian = unitvec_from_diagonal(diagonal);
    UNITVEC_PRECISE float z = meridian.x - meridian.y;
    UNITVEC_PRECISE float radius = meridian.x + meridian.y;
    UNITVEC_PRECISE float quarters = (unitvec_signed_integer(code, half_bits) + 0.5) * (4.0 * step_size);
    return unitvec_angles_around_z(radius, unitvec_with_sign(z, above), quarters);
}

// Rings 0 (the pole) to n (the equator): S, which gives their first patch, and its inverse, lowest power first.
struct UnitvecLatlongRings {
    float n;
    vec3 a;
    vec4 q;
    float q_last;
    float offset;
};

const UnitvecLatlongRings UNITVEC_LATLONG_RINGS_16 = UnitvecLatlongRings(
    113.0, vec3(0.7756357, -1.244649e-5, 7.392083e-11), vec4(1.1121525, 1.7299868e-5, 0.0, 0.0), 0.0, 0.7887458);
const UnitvecLatlongRings UNITVEC_LATLONG_RINGS_24 = UnitvecLatlongRings(
    1782.0, vec3(0.81366533, -5.2502063e-8, 1.2538275e-15),
    vec4(1.1107166, 3.7894093e-8, 9.317108e-15, 0.0), 0.0, 0.23774427);
const UnitvecLatlongRings UNITVEC_LATLONG_RINGS_32 = UnitvecLatlongRings(
    29225.0, vec3(0.7753543, -1.8601036e-10, 1.6516002e-20),
    vec4(1.135677, 1.7468939e-10, 8.533958e-20, 1.2860357e-30), 8.5294734e-38, 0.4510315);

// The start of ring i, 0 to n + 1, given h = i - 1/2: S(i) is the whole part.
float unitvec_latlong_border(UnitvecLatlongRings rings, float h) {
    UNITVEC_PRECISE float u = h * h;
    UNITVEC_PRECISE float s = u * (rings.a.x + u * (rings.a.y + u * rings.a.z)) + (0.95 * h + 0.72515);
    return s;
}

// A number from i to i + 2 for the indices of ring i.
float unitvec_latlong_inverse(UnitvecLatlongRings rings, float index) {
    UNITVEC_PRECISE float low = rings.q.x + index * rings.q.y;
    UNITVEC_PRECISE float both_high = (rings.q.z + index * rings.q.w) + (index * index) * rings.q_last;
    float high = rings.q_last != 0.0 ? both_high : rings.q.z;
    UNITVEC_PRECISE float whole_factor = low + (index * index) * high;
    float factor = rings.q.z != 0.0 ? whole_factor : low;
    UNITVEC_PRECISE float i = unitvec_root(index) * factor + rings.offset;
    return i;
}

// An index as the sum of two floats: from 25 bits on a single one need not hold it.
vec2 unitvec_latlong_in_parts(uint index, uint bits) {
    uint low = bits <= 24u ? 0u : index & unitvec_mask(12u);
    return vec2(float(int(index - low)), float(int(low)));
}

uint unitvec_latlong_patch_encode(vec3 v, UnitvecLatlongRings rings, uint index_bits) {
    float norm = unitvec_l1_norm(v);
    bool usable = unitvec_is_usable(norm);
    vec3 p = unitvec_angles_scaled(v, norm);
    float colatitude = unitvec_angles_quarter(unitvec_horizontal_length(p), p.z);
    UNITVEC_PRECISE float ring = (usable ? colatitude : 0.0) * rings.n + 0.5;
    float i = floor(ring);
    UNITVEC_PRECISE vec2 h = vec2(i - 0.5, i + 0.5);
    float start = floor(unitvec_latlong_border(rings, h.x));
    UNITVEC_PRECISE float count = floor(unitvec_latlong_border(rings, h.y)) - start;
    UNITVEC_PRECISE float position = unitvec_angles_quarter(p.y, p.x) * count + 0.5;
    float j = floor(position);

    // In quarters 1 and 3 the angle from the x axis runs against j, and the last j is the next quarter's first.
    bool left = unitvec_is_negative(v.x);
    bool back = unitvec_is_negative(v.y);
    UNITVEC_PRECISE float against = count - j;
    float along = left != back ? against : j;
    uint quarter = (back ? 2u : 0u) + (left != back ? 1u : 0u);
    bool carries = along >= count;
    uint carried = (quarter + (carries ? 1u : 0u)) & 3u;
    float from_start = carries ? 0.0 : along;

    uint place = unitvec_whole_to_u32(start) + unitvec_whole_to_u32(from_start) + (carried << index_bits);
    uint below = usable && unitvec_is_negative(v.z) ? 4u << index_bits : 0u;
    return below | (i > 0.0 ? place : 0u);
}

vec3 unitvec_latlong_patch_decode(uint code, UnitvecLatlongRings rings, uint index_bits) {
    uint index = code & unitvec_mask(index_bits);
    vec2 parts = unitvec_latlong_in_parts(index, index_bits);

    float nearest = floor(unitvec_latlong_inverse(rings, float(int(index))));
    UNITVEC_PRECISE vec3 h = nearest - vec3(1.5, 0.5, -0.5);
    float border = unitvec_latlong_border(rings, h.y);
    UNITVEC_PRECISE float from_index = border - parts.x;
    UNITVEC_PRECISE float to_next = parts.y + 1.0;
    bool before = from_index >= to_next;
    float other = unitvec_latlong_border(rings, before ? h.x : h.z);
    UNITVEC_PRECISE float ring_before = nearest - 1.0;
    float ring = before ? ring_before : nearest;
    float start = floor(min(border, other));
    UNITVEC_PRECISE float count = floor(max(border, other)) - start;
    // Exact: start is near.
    UNITVEC_PRECISE float from_high = parts.x - start;
    UNITVEC_PRECISE float from_both = from_high + parts.y;
    float along = index_bits <= 24u ? from_high : from_both;

    // Both angles are taken from the middles of their quarter turns, about which the patches are symmetric.
    UNITVEC_PRECISE float beside = along - 0.5 * count;
    float divided = unitvec_signed_quotient(beside, count);
    vec2 equator = unitvec_from_diagonal(along > 0.0 ? divided : -0.5);
    // At either end the product is 1/2 exactly.
    UNITVEC_PRECISE float latitude = (ring - 0.5 * rings.n) * unitvec_reciprocal(rings.n);
    vec2 meridian = unitvec_from_diagonal(latitude);
    UNITVEC_PRECISE float radius = meridian.x + meridian.y;

    // Turns by quarters, but for the pole, where a turned 0 would become -0: from quarter to quarter (a, b) goes to
    // (-b, a).
    uint quarter = index > 0u ? code : 0u;
    bool odd = (quarter & (1u << index_bits)) != 0u;
    float a = odd ? equator.y : equator.x;
    float b = odd ? equator.x : equator.y;
    uint to_sign = 30u - index_bits;
    a = unitvec_flip_sign(a, ((quarter + (1u << index_bits)) << to_sign) & UNITVEC_SIGN_BIT);
    b = unitvec_flip_sign(b, (quarter << to_sign) & UNITVEC_SIGN_BIT);
    uint below = (code << (29u - index_bits)) & UNITVEC_SIGN_BIT;
    UNITVEC_PRECISE float z = unitvec_flip_sign(meridian.x, below) - unitvec_flip_sign(meridian.y, below);
    UNITVEC_PRECISE vec2 p = vec2(a - b, a + b) * radius;
    return vec3(p, z);
}

uint latlong16_encode(vec3 v) { return unitvec_latlong_grid_encode(v, 8u); }
uint latlong24_encode(vec3 v) { return unitvec_latlong_grid_encode(v, 12u); }
uint latlong32_encode(vec3 v) { return unitvec_latlong_grid_encode(v, 16u); }

vec3 latlong16_decode(uint code) { return unitvec_latlong_grid_decode(code, 8u); }
vec3 latlong24_decode(uint code) { return unitvec_latlong_grid_decode(code, 12u); }
vec3 latlong32_decode(uint code) { return unitvec_latlong_grid_decode(code, 16u); }

uint latlong16d_encode(vec3 v) { return unitvec_latlong_patch_encode(v, UNITVEC_LATLONG_RINGS_16, 13u); }
uint latlong24d_encode(vec3 v) { return unitvec_latlong_patch_encode(v, UNITVEC_LATLONG_RINGS_24, 21u); }
uint latlong32d_encode(vec3 v) { return unitvec_latlong_patch_encode(v, UNITVEC_LATLONG_RINGS_32, 29u); }

vec3 latlong16d_decode(uint code) { return unitvec_latlong_patch_decode(code, UNITVEC_LATLONG_RINGS_16, 13u); }
vec3 latlong24d_decode(uint code) { return unitvec_latlong_patch_decode(code, UNITVEC_LATLONG_RINGS_24, 21u); }
vec3 latlong32d_decode(uint code) { return unitvec_latlong_patch_decode(code, UNITVEC_LATLONG_RINGS_32, 29u); }

#endif
