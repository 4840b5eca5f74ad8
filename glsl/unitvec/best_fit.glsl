// unitvec: best fit codes: three snorm components of a vector whose length is chosen so that it points as it should.
//
// Source: Kaplanyan 2010, "CryENGINE 3: Reaching the speed of light"; Cigolle et al. 2014, section 2.2.
//
//   snorm8x3p_encode(v), snorm8x3p_decode(code)                 24 bits: the best of the four closest texels, and of 127
//   snorm8x3_nearest_encode(v), snorm8x3_nearest_decode(code)   24 bits: no whole vector points nearer
//   crytek_bfn24_encode(v), crytek_bfn24_decode(code)           24 bits: one length for the directions of a texel
//   snorm16x3p_encode(v), snorm16x3p_decode(code)               48 bits, uvec2, low word first: the best of 65 lengths
//   best_fit_table_word(index)                                  word of the table of lengths
//
// snorm8x3p_encode and crytek_bfn24_encode look the lengths of texels up if UNITVEC_BEST_FIT_TABLE(i) is defined before
// this file is included, as an expression that gives word i of the table, i below 262144:
// `#define UNITVEC_BEST_FIT_TABLE(i) table.words[i]`. Else they work them out, at 20 to 30 times the cost and with the
// same result.
//
// The code functions take any v: length does not matter, and +Z stands in for what has no direction. Decoding gives
// the components as stored, NOT NORMALISED. Layout: x in the low component, two's complement. "Length" here means
// the largest component of a whole vector.

#ifndef UNITVEC_BEST_FIT_GLSL
#define UNITVEC_BEST_FIT_GLSL

#ifndef UNITVEC_SCALAR_GLSL
#include "scalar.glsl"
#endif

// Texels along a side of the table.
const float BEST_FIT_TABLE_SIDE = 1024.0;
// Lengths that a scan tries.
const float BEST_FIT_SCANNED = 64.0;
// Directions whose least component is a larger part of the largest one are near the middle of an octant.
const float BEST_FIT_MIDDLE_OF_OCTANT = 0.75;
// 2^-24: smaller parts of the largest component count as 0.
const float BEST_FIT_LEAST_PART = 5.9604644775390625e-8;

float best_fit_lesser(float a, float b) {
    return a < b ? a : b;
}

float best_fit_greater(float a, float b) {
    return a < b ? b : a;
}

float best_fit_part(float a, float largest) {
    UNITVEC_PRECISE float part = a / largest;
    return part < BEST_FIT_LEAST_PART ? 0.0 : part;
}

// Magnitudes of the components of v, which has a direction, over that of the largest one.
vec3 best_fit_on_cube(vec3 v) {
    vec3 a = abs(v);
    float largest = best_fit_greater(best_fit_greater(a.x, a.y), a.z);
    return vec3(best_fit_part(a.x, largest), best_fit_part(a.y, largest), best_fit_part(a.z, largest));
}

// The middle (x) and the least (y) of the magnitudes; the largest is 1.
vec2 best_fit_by_size(vec3 u) {
    float low = best_fit_lesser(u.x, u.y);
    float high = best_fit_greater(u.x, u.y);
    return vec2(best_fit_greater(low, best_fit_lesser(high, u.z)), best_fit_lesser(low, u.z));
}

// A candidate is a scale (x) and the squared sine of its angle to the direction, up to a factor, as a fraction (y / z).

// The vector whose largest component is k, a whole number. It is off by d = (0, dy, dz), and its angle to u has the
// sine |d x u| / (|q| |u|).
vec3 best_fit_of_length(vec2 u, float k) {
    UNITVEC_PRECISE vec2 p = u * k;
    UNITVEC_PRECISE vec2 q = floor(p + 0.5);
    UNITVEC_PRECISE vec2 d = q - p;
    UNITVEC_PRECISE float cx = d.x * u.y - d.y * u.x;
    UNITVEC_PRECISE float numerator = (cx * cx + d.x * d.x) + d.y * d.y;
    UNITVEC_PRECISE float denominator = (k * k + q.x * q.x) + q.y * q.y;
    return vec3(k, numerator, denominator);
}

// The vector u times `scale`, rounded; any scale.
vec3 best_fit_of_scale(vec2 u, float scale) {
    UNITVEC_PRECISE vec3 p = vec3(scale, u.x * scale, u.y * scale);
    UNITVEC_PRECISE vec3 q = floor(p + 0.5);
    UNITVEC_PRECISE vec3 d = q - p;
    UNITVEC_PRECISE float cx = d.y * u.y - d.z * u.x;
    UNITVEC_PRECISE float cy = d.z - d.x * u.y;
    UNITVEC_PRECISE float cz = d.x * u.x - d.y;
    UNITVEC_PRECISE float numerator = (cx * cx + cy * cy) + cz * cz;
    UNITVEC_PRECISE float denominator = (q.x * q.x + q.y * q.y) + q.z * q.z;
    return vec3(scale, numerator, denominator);
}

// b where it points nearer, else a.
vec3 best_fit_nearer(vec3 a, vec3 b) {
    UNITVEC_PRECISE float cost_a = a.y * b.z;
    UNITVEC_PRECISE float cost_b = b.y * a.z;
    return cost_b < cost_a ? b : a;
}

// The best of `best` and the 64 lengths from `longest` down; of equals the first.
vec3 best_fit_scan(vec3 best, vec2 u, float longest) {
    for (float k = longest; k > longest - BEST_FIT_SCANNED; k -= 1.0) {
        best = best_fit_nearer(best, best_fit_of_length(u, k));
    }
    return best;
}

// The length of the 64 from 127 down that fits best.
float best_fit_best_length(vec2 u) {
    return best_fit_scan(best_fit_of_length(u, 127.0), u, 127.0).x;
}

// The scale that fits best of all, up to 127.25. The rounding at a length is the nearest in its plane, which need not
// be the nearest in angle, least so near the middle of an octant; scales between whole numbers find what is left.
float best_fit_best_scale(vec2 u) {
    vec3 best = best_fit_scan(best_fit_of_length(u, 127.0), u, 127.0);
    float end = u.y > BEST_FIT_MIDDLE_OF_OCTANT ? 111.5 : 123.5;
    for (float scale = 127.25; scale > end; scale -= 0.5) {
        best = best_fit_nearer(best, best_fit_of_scale(u, scale));
    }
    return best.x;
}

// Whole vector of a scale: magnitudes rounded, with the signs of v.
vec3 best_fit_at_scale(vec3 v, vec3 u, float scale) {
    UNITVEC_PRECISE vec3 q = floor(u * scale + 0.5);
    return vec3(
        unitvec_negate_if(unitvec_is_negative(v.x), q.x),
        unitvec_negate_if(unitvec_is_negative(v.y), q.y),
        unitvec_negate_if(unitvec_is_negative(v.z), q.z));
}

uint best_fit_pack8(vec3 q) {
    return unitvec_signed_code(q.x, 8u) | (unitvec_signed_code(q.y, 8u) << 8u) | (unitvec_signed_code(q.z, 8u) << 16u);
}

// Where a direction lies in the table, as column and row; whole numbers are the edges of texels.
vec2 best_fit_table_position(vec2 u) {
    UNITVEC_PRECISE float x = u.x * BEST_FIT_TABLE_SIDE;
    UNITVEC_PRECISE float y = u.y / u.x * BEST_FIT_TABLE_SIDE;
    return vec2(x, u.x > 0.0 ? y : 0.0);
}

// i, or the nearest column or row of the table.
float best_fit_in_table(float i) {
    return best_fit_greater(0.0, best_fit_lesser(i, BEST_FIT_TABLE_SIDE - 1.0));
}

// The length of a texel: the one that fits its middle best.
float best_fit_texel_length(float column, float row) {
    UNITVEC_PRECISE float x = (column + 0.5) / BEST_FIT_TABLE_SIDE;
    UNITVEC_PRECISE float y = x * ((row + 0.5) / BEST_FIT_TABLE_SIDE);
    return best_fit_best_length(vec2(x, y));
}

// Word `index` of the table, below 262144: texels 4 index to 4 index + 3, row by row, the first in the low byte. Column
// and row are mid / max and min / mid of the magnitudes in order of size, times 1024.
uint best_fit_table_word(uint index) {
    uint first = 4u * (index % 256u);
    float row = float(index / 256u);
    uint word = 0u;
    for (uint i = 0u; i < 4u; i += 1u) {
        word |= uint(best_fit_texel_length(float(first + i), row)) << (8u * i);
    }
    return word;
}

// The length of a texel of the table, or of the nearest one; 127 where a table of other making has none.
float best_fit_length_at(float column, float row) {
    column = best_fit_in_table(column);
    row = best_fit_in_table(row);
#ifdef UNITVEC_BEST_FIT_TABLE
    uint index = uint(row) * 1024u + uint(column);
    uint texels = UNITVEC_BEST_FIT_TABLE(index / 4u);
    uint texel = (texels >> (8u * (index % 4u))) & 255u;
    return texel - 64u < 64u ? float(texel) : 127.0;
#else
    return best_fit_texel_length(column, row);
#endif
}

uint snorm8x3p_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = best_fit_on_cube(v);
    vec2 parts = best_fit_by_size(u);
    UNITVEC_PRECISE vec2 corner = best_fit_table_position(parts) - 0.5;
    vec2 t = floor(corner);
    vec3 best = best_fit_of_length(parts, 127.0);
    best = best_fit_nearer(best, best_fit_of_length(parts, best_fit_length_at(t.x, t.y)));
    best = best_fit_nearer(best, best_fit_of_length(parts, best_fit_length_at(t.x + 1.0, t.y)));
    best = best_fit_nearer(best, best_fit_of_length(parts, best_fit_length_at(t.x, t.y + 1.0)));
    best = best_fit_nearer(best, best_fit_of_length(parts, best_fit_length_at(t.x + 1.0, t.y + 1.0)));
    return best_fit_pack8(best_fit_at_scale(v, u, best.x));
}

uint snorm8x3_nearest_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = best_fit_on_cube(v);
    return best_fit_pack8(best_fit_at_scale(v, u, best_fit_best_scale(best_fit_by_size(u))));
}

uint crytek_bfn24_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = best_fit_on_cube(v);
    vec2 t = floor(best_fit_table_position(best_fit_by_size(u)));
    return best_fit_pack8(best_fit_at_scale(v, u, best_fit_length_at(t.x, t.y)));
}

uvec2 snorm16x3p_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = best_fit_on_cube(v);
    vec2 parts = best_fit_by_size(u);
    float longest = snorm_max(16u);
    UNITVEC_PRECISE float unit = longest / sqrt((1.0 + parts.x * parts.x) + parts.y * parts.y);
    vec3 best = best_fit_scan(best_fit_of_scale(parts, unit), parts, longest);
    vec3 q = best_fit_at_scale(v, u, best.x);
    return uvec2(unitvec_signed_code(q.x, 16u) | (unitvec_signed_code(q.y, 16u) << 16u), unitvec_signed_code(q.z, 16u));
}

vec3 snorm8x3p_decode(uint code) {
    return vec3(snorm_decode(code, 8u), snorm_decode(code >> 8u, 8u), snorm_decode(code >> 16u, 8u));
}

vec3 snorm8x3_nearest_decode(uint code) {
    return snorm8x3p_decode(code);
}

vec3 crytek_bfn24_decode(uint code) {
    return snorm8x3p_decode(code);
}

vec3 snorm16x3p_decode(uvec2 code) {
    return vec3(snorm_decode(code.x, 16u), snorm_decode(code.x >> 16u, 16u), snorm_decode(code.y, 16u));
}

#endif
