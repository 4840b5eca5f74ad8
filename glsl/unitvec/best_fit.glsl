// unitvec: best fit codes: three snorm components of a vector whose length is chosen so that it points as it should.
//
// Source: Kaplanyan 2010, "CryENGINE 3: Reaching the speed of light"; Cigolle et al. 2014, section 2.2.
//
//   snorm8x3p_encode(v), snorm8x3p_decode(code)                 24 bits: the best of a cell's four lengths
//   snorm8x3_nearest_encode(v), snorm8x3_nearest_decode(code)   24 bits: no whole vector points nearer
//   crytek_bfn24_encode(v), crytek_bfn24_decode(code)           24 bits: one length for the directions of a cell
//   snorm16x3p_encode(v), snorm16x3p_decode(code)               48 bits, uvec2, low word first: the best of 65 lengths
//   unitvec_best_fit_table_word(index)                          word of the table of lengths
//
// snorm8x3p_encode and crytek_bfn24_encode work the lengths of cells out, at some 300 times the cost of looking them up in
// the table. They round by adding 1.5 2^23; without `precise` (see arith.glsl) a compiler may undo that in the choice of a
// length, which then is a cell's first.
//
// They look the lengths up, with the same result, where a macro UNITVEC_BEST_FIT_TABLE(i) is defined before this file is
// included, as an expression that gives word i of the table, i below 206080, such as table.words[i].
//
// The code functions take any v: length does not matter, and +Z stands in for vectors without a direction. Decoding
// gives the components as stored, NOT NORMALISED. Layout: x in the low component, two's complement. "Length" here means
// the largest component of a whole vector.

#ifndef UNITVEC_BEST_FIT_GLSL
#define UNITVEC_BEST_FIT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// Cells from 0 to 1: a little less than the table's 640 columns, so that 1 itself is in the last.
const float UNITVEC_BEST_FIT_CELLS = 639.9990234375;
// A length counts as better than a longer one where it leaves less than this part of the error.
const float UNITVEC_BEST_FIT_CLEARLY_LESS = 0.99993896484375;
// Lengths that a scan tries.
const float UNITVEC_BEST_FIT_SCANNED = 64.0;
// Directions whose least component is a larger part of the largest one are near the middle of an octant.
const float UNITVEC_BEST_FIT_MIDDLE_OF_OCTANT = 0.75;
// 2^-24: smaller parts of the largest component count as 0.
const float UNITVEC_BEST_FIT_LEAST_PART = 5.9604644775390625e-8;

float unitvec_best_fit_part(float a, float largest) {
    float part = unitvec_quotient(a, largest);
    return part < UNITVEC_BEST_FIT_LEAST_PART ? 0.0 : part;
}

// Magnitudes of the components of v, which has a direction, over that of the largest one.
vec3 unitvec_best_fit_on_cube(vec3 v) {
    vec3 a = abs(v);
    float largest = max(max(a.x, a.y), a.z);
    return vec3(unitvec_best_fit_part(a.x, largest), unitvec_best_fit_part(a.y, largest),
        unitvec_best_fit_part(a.z, largest));
}

// The middle (x) and the least (y) of the magnitudes; the largest is 1.
vec2 unitvec_best_fit_by_size(vec3 u) {
    float low = min(u.x, u.y);
    float high = max(u.x, u.y);
    return vec2(max(low, min(high, u.z)), min(low, u.z));
}

// A candidate is a scale (x) and the squared sine of its angle to the direction, up to a factor, as a fraction (y / z).

// The vector whose largest component is k, a whole number. It is off by d = (0, dy, dz), and its angle to u has the
// sine |d x u| / (|q| |u|).
vec3 unitvec_best_fit_of_length(vec2 u, float k) {
    UNITVEC_PRECISE vec2 p = u * k;
    UNITVEC_PRECISE vec2 q = floor(p + 0.5);
    UNITVEC_PRECISE vec2 d = q - p;
    UNITVEC_PRECISE float cx = d.x * u.y - d.y * u.x;
    UNITVEC_PRECISE float numerator = (cx * cx + d.x * d.x) + d.y * d.y;
    UNITVEC_PRECISE float denominator = (k * k + q.x * q.x) + q.y * q.y;
    return vec3(k, numerator, denominator);
}

// The vector u times `scale`, rounded; any scale.
vec3 unitvec_best_fit_of_scale(vec2 u, float scale) {
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
vec3 unitvec_best_fit_nearer(vec3 a, vec3 b) {
    UNITVEC_PRECISE float cost_a = a.y * b.z;
    UNITVEC_PRECISE float cost_b = b.y * a.z;
    return cost_b < cost_a ? b : a;
}

// The best of `best` and the 64 lengths from `longest` down; of equals the first.
vec3 unitvec_best_fit_scan(vec3 best, vec2 u, float longest) {
    for (UNITVEC_PRECISE float k = longest; k > longest - UNITVEC_BEST_FIT_SCANNED; k -= 1.0) {
        best = unitvec_best_fit_nearer(best, unitvec_best_fit_of_length(u, k));
    }
    return best;
}

// The scale that fits best of all, up to 127.25. The rounding at a length is the nearest in its plane, which need not
// be the nearest in angle, least so near the middle of an octant; scales between whole numbers find the nearer vectors.
float unitvec_best_fit_best_scale(vec2 u) {
    vec3 best = unitvec_best_fit_scan(unitvec_best_fit_of_length(u, 127.0), u, 127.0);
    float end = u.y > UNITVEC_BEST_FIT_MIDDLE_OF_OCTANT ? 111.5 : 123.5;
    for (UNITVEC_PRECISE float scale = 127.25; scale > end; scale -= 0.5) {
        best = unitvec_best_fit_nearer(best, unitvec_best_fit_of_scale(u, scale));
    }
    return best.x;
}

// Whole vector of a scale: magnitudes rounded, with the signs of v.
vec3 unitvec_best_fit_at_scale(vec3 v, vec3 u, float scale) {
    UNITVEC_PRECISE vec3 q = floor(u * scale + 0.5);
    return vec3(
        unitvec_negate_if(unitvec_is_negative(v.x), q.x),
        unitvec_negate_if(unitvec_is_negative(v.y), q.y),
        unitvec_negate_if(unitvec_is_negative(v.z), q.z));
}

uint unitvec_best_fit_pack8(vec3 q) {
    return unitvec_signed_code(q.x, 8u) | (unitvec_signed_code(q.y, 8u) << 8u) | (unitvec_signed_code(q.z, 8u) << 16u);
}

// The low byte of the two's complement of the nearest whole number; ties go to the even one.
uint unitvec_best_fit_nearest_byte(float x) {
    UNITVEC_PRECISE float sum = x + UNITVEC_ONE_AND_A_HALF_2_23;
    return floatBitsToUint(sum) & unitvec_mask(8u);
}

// The parts of v as in unitvec_best_fit_by_size, and the reciprocal of its largest magnitude (z).
vec3 unitvec_best_fit_parts_and_reciprocal(vec3 v) {
    vec3 a = abs(v);
    float low = min(a.x, a.y);
    float high = max(a.x, a.y);
    float reciprocal = unitvec_reciprocal(max(high, a.z));
    UNITVEC_PRECISE float mid = max(low, min(high, a.z)) * reciprocal;
    UNITVEC_PRECISE float least = min(low, a.z) * reciprocal;
    return vec3(mid < UNITVEC_BEST_FIT_LEAST_PART ? 0.0 : mid, least < UNITVEC_BEST_FIT_LEAST_PART ? 0.0 : least,
        reciprocal);
}

// The code of v scaled to a largest component of `size` and rounded.
uint unitvec_best_fit_code_at_length(vec3 v, float reciprocal, float size) {
    UNITVEC_PRECISE float scale = size * reciprocal;
    UNITVEC_PRECISE vec3 p = v * scale;
    return unitvec_best_fit_nearest_byte(p.x) | (unitvec_best_fit_nearest_byte(p.y) << 8u)
        | (unitvec_best_fit_nearest_byte(p.z) << 16u);
}

// A length (x), and how far from the direction it ends, squared and up to a factor (y). As in
// unitvec_best_fit_of_length, but the vector counts as `size` long, and the square of d x u as
// dy^2 - least dy dz + (1 + mid - least) dz^2, times a factor.
vec2 unitvec_best_fit_candidate(vec2 u, float weight, float size) {
    UNITVEC_PRECISE vec2 p = u * size;
    UNITVEC_PRECISE vec2 d = unitvec_nearest_whole(p) - p;
    UNITVEC_PRECISE float cost = (d.x - u.y * d.y) * d.x + weight * (d.y * d.y);
    return vec2(size, cost);
}

// b where it points nearer, else a.
vec2 unitvec_best_fit_nearer_candidate(vec2 a, vec2 b) {
    UNITVEC_PRECISE float cost_a = a.y * (b.x * b.x);
    UNITVEC_PRECISE float cost_b = b.y * (a.x * a.x);
    return cost_b < cost_a ? b : a;
}

// The one of a cell's lengths that fits best.
float unitvec_best_fit_best_of(vec2 u, vec4 lengths) {
    UNITVEC_PRECISE float weight = 1.0 + (u.x - u.y);
    vec2 first = unitvec_best_fit_nearer_candidate(
        unitvec_best_fit_candidate(u, weight, lengths.x), unitvec_best_fit_candidate(u, weight, lengths.y));
    vec2 second = unitvec_best_fit_nearer_candidate(
        unitvec_best_fit_candidate(u, weight, lengths.z), unitvec_best_fit_candidate(u, weight, lengths.w));
    return unitvec_best_fit_nearer_candidate(first, second).x;
}

// The column and the row of a direction's cell.
uvec2 unitvec_best_fit_cell_of(vec2 u) {
    UNITVEC_PRECISE vec2 cell = u * UNITVEC_BEST_FIT_CELLS;
    return uvec2(unitvec_whole_to_u32(cell.x), unitvec_whole_to_u32(cell.y));
}

// The sine of the error that a length leaves, up to a factor that is nearly the same for all lengths.
float unitvec_best_fit_sine(vec2 u, float size) {
    UNITVEC_PRECISE vec2 p = u * size;
    UNITVEC_PRECISE vec2 d = unitvec_nearest_whole(p) - p;
    UNITVEC_PRECISE float cx = d.x * u.y - d.y * u.x;
    UNITVEC_PRECISE float size_squared = size * size;
    UNITVEC_PRECISE float square =
        ((cx * cx + d.x * d.x) + d.y * d.y) * unitvec_reciprocal(size_squared);
    return unitvec_root(square);
}

// `max` with a number that is always less hides the constant divisor, which some compilers turn into a product.
float unitvec_best_fit_sample_part(uint cell, int i) {
    float third = float(i);
    UNITVEC_PRECISE float middle = third + 0.5;
    UNITVEC_PRECISE float columns = float(cell) + unitvec_quotient(middle, max(third, 3.0));
    return unitvec_quotient(columns, max(columns, UNITVEC_BEST_FIT_CELLS));
}

// One of the nine directions of a cell.
vec2 unitvec_best_fit_sample(uvec2 cell, int i) {
    return vec2(unitvec_best_fit_sample_part(cell.x, i / 3), unitvec_best_fit_sample_part(cell.y, i % 3));
}

// The lengths of a cell, each the one that leaves least of the mean error of those before it; the longest of equals.
vec4 unitvec_best_fit_cell_lengths(uvec2 cell) {
    // The errors that the lengths so far leave: with no length, more than any.
    float left[9];
    for (int i = 0; i < 9; i += 1) {
        left[i] = 1.0;
    }
    vec4 lengths = vec4(0.0);
    for (int n = 0; n < 4; n += 1) {
        float best = 0.0;
        float least = 0.0;
        for (UNITVEC_PRECISE float size = 127.0; size > 127.0 - UNITVEC_BEST_FIT_SCANNED; size -= 1.0) {
            UNITVEC_PRECISE float total = 0.0;
            for (int i = 0; i < 9; i += 1) {
                total += min(unitvec_best_fit_sine(unitvec_best_fit_sample(cell, i), size), left[i]);
            }
            UNITVEC_PRECISE float limit = least * UNITVEC_BEST_FIT_CLEARLY_LESS;
            if (size == 127.0 || total < limit) {
                best = size;
                least = total;
            }
        }
        lengths[n] = best;
        for (int i = 0; i < 9; i += 1) {
            left[i] = min(unitvec_best_fit_sine(unitvec_best_fit_sample(cell, i), best), left[i]);
        }
    }
    return lengths;
}

// The lengths in a word of the table, in the low six bits of each byte: 64 to 127, whatever the word.
vec4 unitvec_best_fit_lengths_in(uint word) {
    uint bytes = (word & 0x3f3f3f3fu) | 0x40404040u;
    return vec4(float(bytes & 255u), float((bytes >> 8u) & 255u), float((bytes >> 16u) & 255u), float(bytes >> 24u));
}

// Number of a cell's word: four columns side by side have their rows, of which they need no more than there are
// columns to their right end, one after the other.
uint unitvec_best_fit_table_index(uvec2 cell) {
    uint group = cell.x / 4u;
    return 4u * (group * (2u * group + 1u) + cell.y) + cell.x;
}

// Word `index` of the table, below 206080: the lengths of a cell, the best alone in the low byte. Column and row are
// mid / max and min / max of the magnitudes in order of size, times 640.
uint unitvec_best_fit_table_word(uint index) {
    uint group = 0u;
    while (8u * (group + 1u) * (group + 2u) <= index) {
        group += 1u;
    }
    uint within = index - 8u * group * (group + 1u);
    uvec4 lengths = uvec4(unitvec_best_fit_cell_lengths(uvec2(4u * group + within % 4u, within / 4u)));
    return lengths.x | (lengths.y << 8u) | (lengths.z << 16u) | (lengths.w << 24u);
}

// The lengths of a direction's cell.
vec4 unitvec_best_fit_lengths(vec2 u) {
    uvec2 cell = unitvec_best_fit_cell_of(u);
#ifdef UNITVEC_BEST_FIT_TABLE
    return unitvec_best_fit_lengths_in(UNITVEC_BEST_FIT_TABLE(unitvec_best_fit_table_index(cell)));
#else
    return unitvec_best_fit_cell_lengths(cell);
#endif
}

uint snorm8x3p_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = unitvec_best_fit_parts_and_reciprocal(v);
    return unitvec_best_fit_code_at_length(v, u.z, unitvec_best_fit_best_of(u.xy, unitvec_best_fit_lengths(u.xy)));
}

uint snorm8x3_nearest_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = unitvec_best_fit_on_cube(v);
    float scale = unitvec_best_fit_best_scale(unitvec_best_fit_by_size(u));
    return unitvec_best_fit_pack8(unitvec_best_fit_at_scale(v, u, scale));
}

uint crytek_bfn24_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = unitvec_best_fit_parts_and_reciprocal(v);
    return unitvec_best_fit_code_at_length(v, u.z, unitvec_best_fit_lengths(u.xy).x);
}

uvec2 snorm16x3p_encode(vec3 v) {
    v = unitvec_or_z(v);
    vec3 u = unitvec_best_fit_on_cube(v);
    vec2 parts = unitvec_best_fit_by_size(u);
    float longest = unitvec_snorm_max(16u);
    UNITVEC_PRECISE float square = (1.0 + parts.x * parts.x) + parts.y * parts.y;
    float unit = unitvec_quotient(longest, unitvec_root(square));
    vec3 best = unitvec_best_fit_scan(unitvec_best_fit_of_scale(parts, unit), parts, longest);
    vec3 q = unitvec_best_fit_at_scale(v, u, best.x);
    return uvec2(unitvec_signed_code(q.x, 16u) | (unitvec_signed_code(q.y, 16u) << 16u), unitvec_signed_code(q.z, 16u));
}

vec3 snorm8x3p_decode(uint code) {
    vec3 e = vec3(unitvec_snorm_field(code, 0u, 8u), unitvec_snorm_field(code, 8u, 8u),
        unitvec_snorm_field(code, 16u, 8u));
    return unitvec_snorm_quotients(e, 8u, 8u);
}

vec3 snorm8x3_nearest_decode(uint code) {
    return snorm8x3p_decode(code);
}

vec3 crytek_bfn24_decode(uint code) {
    return snorm8x3p_decode(code);
}

vec3 snorm16x3p_decode(uvec2 code) {
    vec3 e = vec3(unitvec_snorm_field(code.x, 0u, 16u), unitvec_snorm_field(code.x, 16u, 16u),
        unitvec_snorm_field(code.y, 0u, 16u));
    return unitvec_snorm_quotients(e, 16u, 16u);
}

#endif
