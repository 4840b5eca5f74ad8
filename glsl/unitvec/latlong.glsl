// unitvec: numbered patches between circles of latitude, in 16, 24 and 32 bits.
//
// Source: Cigolle et al. 2014, sections 2 and 2.3; Smith et al. 2012. Formulas stand in for their table.
//
//   latlong16_encode(v), latlong16_decode(code)      plain grid; also latlong24, 32
//   latlong16d_encode(v), latlong16d_decode(code)    nearly square patches; also latlong24d, 32d
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. Layout of the
// grid: the patch in the low half, from +X towards +Y; the ring in the high half, from +Z. Layout of the others:
// the index in the low b - 3 bits, the quarter turn from +X in the next two, the hemisphere (1 for z < 0) in the
// highest.

#ifndef UNITVEC_LATLONG_GLSL
#define UNITVEC_LATLONG_GLSL

#ifndef UNITVEC_SPHERICAL_GLSL
#include "spherical.glsl"
#endif

uint latlong_grid_encode(vec3 v, uint half_bits) {
    v = spherical_scaled(v);
    float rings = float(1u << half_bits);
    UNITVEC_PRECISE float colatitude = unitvec_atan2_half_turns(spherical_horizontal_length(v), v.z) * rings;
    UNITVEC_PRECISE float azimuth = unitvec_atan2_half_turns(v.y, v.x) * (0.5 * rings);
    float ring = floor(colatitude);
    float last = rings - 1.0;
    return unitvec_signed_code(floor(azimuth), half_bits) | (uint(ring < last ? ring : last) << half_bits);
}

vec3 latlong_grid_decode(uint code, uint half_bits) {
    float step_size = 1.0 / float(1u << half_bits);
    float ring = float((code >> half_bits) & ((1u << half_bits) - 1u));
    UNITVEC_PRECISE float colatitude = (ring + 0.5) * step_size;
    UNITVEC_PRECISE float azimuth = (spherical_signed_integer(code, half_bits) + 0.5) * (2.0 * step_size);
    vec2 meridian = unitvec_sin_cos_half_turns(colatitude);
    return spherical_around_z(meridian.y, meridian.x, azimuth);
}

// Rings 0 (the pole) to n (the equator): S, which gives their first patch, and its inverse, lowest power first.
struct LatlongRings {
    float n;
    vec3 a;
    float unit;
    vec4 q;
    float q4;
    float offset;
};

const LatlongRings LATLONG_RINGS_16 = LatlongRings(
    113.0, vec3(0.7756357, -1.244649e-5, 7.392083e-11), 1.0 / 8192.0,
    vec4(104.36025, -10.2527895, 67.22143, -85.247475), 38.234226, -0.17366897);
const LatlongRings LATLONG_RINGS_24 = LatlongRings(
    1782.0, vec3(0.81366533, -5.2502063e-8, 1.2538275e-15), 1.0 / 2097152.0,
    vec4(1607.1187, 112.42228, 105.19552, -92.46996), 51.018177, -0.13045794);
const LatlongRings LATLONG_RINGS_32 = LatlongRings(
    29225.0, vec3(0.7753543, -1.8601036e-10, 1.6516002e-20), 1.0 / 536870912.0,
    vec4(26315.662, 2157.9614, 622.8445, -66.86007), 196.69493, -0.15143372);

// S(i): index of the first patch of ring i, 0 to n + 1, in an eighth of the sphere.
uint latlong_start(LatlongRings rings, float i) {
    UNITVEC_PRECISE float u = (i - 0.5) * (i - 0.5);
    UNITVEC_PRECISE float s = u * (rings.a.x + u * (rings.a.y + u * rings.a.z)) + (0.95 * i + 0.25);
    return uint(floor(s));
}

// About where between the starts of the rings an index lies: from i - 1/2 to i + 3/2 for those of ring i.
float latlong_inverse(LatlongRings rings, uint index) {
    UNITVEC_PRECISE float t = (float(index) + 0.5) * rings.unit;
    UNITVEC_PRECISE float high = rings.q.z + t * (rings.q.w + t * rings.q4);
    UNITVEC_PRECISE float i = sqrt(t) * (rings.q.x + t * (rings.q.y + t * high)) + rings.offset;
    return i;
}

uint latlong_patch_encode(vec3 v, LatlongRings rings, uint index_bits) {
    v = spherical_scaled(v);
    float colatitude = unitvec_atan2_half_turns(spherical_horizontal_length(v), abs(v.z));
    UNITVEC_PRECISE float ring = colatitude * (2.0 * rings.n) + 0.5;
    float i = floor(ring);
    uint start = latlong_start(rings, i);
    uint count = latlong_start(rings, i + 1.0) - start;
    float angle = unitvec_atan2_half_turns(abs(v.y), abs(v.x));
    UNITVEC_PRECISE float position = angle * (2.0 * float(count)) + 0.5;
    uint j = uint(floor(position));

    // In quarters 1 and 3 the angle from the x axis runs against j, and the last j is the next quarter's first.
    bool left = unitvec_is_negative(v.x);
    bool back = unitvec_is_negative(v.y);
    uint along = left != back ? count - j : j;
    uint front_quarter = left ? 1u : 0u;
    uint back_quarter = left ? 2u : 3u;
    uint quarter = back ? back_quarter : front_quarter;
    uint carried = along == count ? (quarter + 1u) & 3u : quarter;
    uint from_start = along == count ? 0u : along;

    uint place = start + from_start + (carried << index_bits);
    uint below = unitvec_is_negative(v.z) ? 4u << index_bits : 0u;
    return below | (i > 0.0 ? place : 0u);
}

vec3 latlong_patch_decode(uint code, LatlongRings rings, uint index_bits) {
    uint index = code & ((1u << index_bits) - 1u);
    UNITVEC_PRECISE float nearest = latlong_inverse(rings, index) + 0.5;
    float border = floor(nearest);
    uint border_start = latlong_start(rings, border);
    bool before = index < border_start;
    uint other_start = latlong_start(rings, before ? border - 1.0 : border + 1.0);
    float i = before ? border - 1.0 : border;
    uint start = before ? other_start : border_start;
    uint count = (before ? border_start : other_start) - start;

    uint quarter = (code >> index_bits) & 3u;
    uint along = index - start;
    uint j = (quarter & 1u) != 0u ? count - along : along;
    UNITVEC_PRECISE float divided = 0.5 * (float(j) / float(count));
    vec2 equator = unitvec_sin_cos_half_turns(j < count ? divided : 0.5);
    // The product of n is 1/2 exactly.
    UNITVEC_PRECISE float colatitude = i * (0.5 / rings.n);
    vec2 meridian = unitvec_sin_cos_half_turns(colatitude);

    UNITVEC_PRECISE vec2 p = meridian.y * equator;
    return vec3(
        unitvec_negate_if(((quarter + 1u) & 2u) != 0u && p.x > 0.0, p.x),
        unitvec_negate_if((quarter & 2u) != 0u && p.y > 0.0, p.y),
        unitvec_negate_if(((code >> index_bits) & 4u) != 0u && meridian.x > 0.0, meridian.x));
}

uint latlong16_encode(vec3 v) { return latlong_grid_encode(v, 8u); }
uint latlong24_encode(vec3 v) { return latlong_grid_encode(v, 12u); }
uint latlong32_encode(vec3 v) { return latlong_grid_encode(v, 16u); }

vec3 latlong16_decode(uint code) { return latlong_grid_decode(code, 8u); }
vec3 latlong24_decode(uint code) { return latlong_grid_decode(code, 12u); }
vec3 latlong32_decode(uint code) { return latlong_grid_decode(code, 16u); }

uint latlong16d_encode(vec3 v) { return latlong_patch_encode(v, LATLONG_RINGS_16, 13u); }
uint latlong24d_encode(vec3 v) { return latlong_patch_encode(v, LATLONG_RINGS_24, 21u); }
uint latlong32d_encode(vec3 v) { return latlong_patch_encode(v, LATLONG_RINGS_32, 29u); }

vec3 latlong16d_decode(uint code) { return latlong_patch_decode(code, LATLONG_RINGS_16, 13u); }
vec3 latlong24d_decode(uint code) { return latlong_patch_decode(code, LATLONG_RINGS_24, 21u); }
vec3 latlong32d_decode(uint code) { return latlong_patch_decode(code, LATLONG_RINGS_32, 29u); }

#endif
