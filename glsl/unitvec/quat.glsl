// unitvec: rotations, unit quaternions up to their sign, in 24, 32, 48 and 64 bits.
//
// Source: ours; the body-centred lattice is Bambah's covering (1954).
//
//   quat32_encode(q)       code as uint; q is x, y, z, w, w the real part
//   quat32_decode(code)    the same, of unit length, the largest component positive; also 24
//   quat48_encode(q), quat48_decode(code), quat64_...    codes as uvec2, low word first
//
// Any q will do: length and sign do not matter, and the identity stands in for one without a direction. Layout: the low
// bits of the three coordinates; above them a + r (b + r (c + r (2 chart + grid))), with what is above these bits of each.
// The chart is the largest component, its coordinates those of the next three, in cyclic order. A coordinate i stands for
// u = (2 i + grid) / n - 1, and u for the component u (23 + 9 u^2) / 32 beside a largest one of 1.

#ifndef UNITVEC_QUAT_GLSL
#define UNITVEC_QUAT_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// x = u (a + b u^2), with a sum of 1, so that the faces of the cube are exact.
const float UNITVEC_QUAT_WARP_0 = 0.71875;
const float UNITVEC_QUAT_WARP_1 = 0.28125;

// The inverse, x (a + z (b + z c)) / (1 + z (d + z e)) with z = x^2: within 1.4e-5.
const float UNITVEC_QUAT_UNWARP_0 = 1.3910723;
const float UNITVEC_QUAT_UNWARP_1 = 3.3822532;
const float UNITVEC_QUAT_UNWARP_2 = 0.6980923;
const float UNITVEC_QUAT_UNDER_1 = 3.18098;
const float UNITVEC_QUAT_UNDER_2 = 1.2904377;

vec3 unitvec_quat_warp(vec3 u) {
    UNITVEC_PRECISE vec3 x = u * (UNITVEC_QUAT_WARP_0 + (u * u) * UNITVEC_QUAT_WARP_1);
    return x;
}

// The inverse of unitvec_quat_warp; for more than 32 bits, with a step of Newton's method.
float unitvec_quat_unwarp(float x, uint bits) {
    UNITVEC_PRECISE float z = x * x;
    UNITVEC_PRECISE float over = UNITVEC_QUAT_UNWARP_0 + z * (UNITVEC_QUAT_UNWARP_1 + z * UNITVEC_QUAT_UNWARP_2);
    UNITVEC_PRECISE float under = 1.0 + z * (UNITVEC_QUAT_UNDER_1 + z * UNITVEC_QUAT_UNDER_2);
    UNITVEC_PRECISE float u = x * unitvec_quotient(over, under);
    if (bits <= 32u) return u;
    UNITVEC_PRECISE float slope = UNITVEC_QUAT_WARP_0 + (u * u) * 0.84375;
    UNITVEC_PRECISE float missing = x - u * (UNITVEC_QUAT_WARP_0 + (u * u) * UNITVEC_QUAT_WARP_1);
    UNITVEC_PRECISE float nearer = u + unitvec_signed_quotient(missing, slope);
    return nearer;
}

// The low bits of a coordinate, and the number of values above them.
uvec2 unitvec_quat_layout(uint bits) {
    if (bits == 24u) return uvec2(7u, 1u);
    if (bits == 32u) return uvec2(2u, 203u);
    if (bits == 48u) return uvec2(15u, 1u);
    return uvec2(18u, 5u);
}

// Half the number n of steps from face to face, and its reciprocal.
vec2 unitvec_quat_half_steps(uint bits) {
    if (bits == 24u) return vec2(63.0, 0.015873017);
    if (bits == 32u) return vec2(405.0, 0.002469136);
    if (bits == 48u) return vec2(16383.0, 6.103888e-5);
    return vec2(655359.0, 1.5258812e-6);
}

// q, each component in the place of the one `by` places before.
vec4 unitvec_quat_turn(vec4 q, uint by) {
    vec4 by_one = (by & 1u) != 0u ? q.yzwx : q;
    return (by & 2u) != 0u ? by_one.zwxy : by_one;
}

// The number of the component of largest magnitude; of equal ones the last, and then the first.
uint unitvec_quat_chart(vec4 q) {
    vec4 a = abs(q);
    uint chart = 3u;
    float largest = a.w;
    if (a.x > largest) {
        chart = 0u;
        largest = a.x;
    }
    if (a.y > largest) {
        chart = 1u;
        largest = a.y;
    }
    return a.z > largest ? 2u : chart;
}

// q, scaled to a sum of magnitudes from 1 to 2, or the identity.
vec4 unitvec_quat_or_identity(vec4 q) {
    UNITVEC_PRECISE float norm = (abs(q.x) + abs(q.y)) + (abs(q.z) + abs(q.w));
    vec4 flushed = vec4(unitvec_without_denormals(q.xyz), unitvec_without_denormal(q.w));
    UNITVEC_PRECISE vec4 scaled = flushed * unitvec_scale_to_one(norm);
    return unitvec_is_usable(norm) ? scaled : vec4(0.0, 0.0, 0.0, 1.0);
}

// The point of a chart that is at these coordinates, in steps from the middle.
vec3 unitvec_quat_in_chart(vec3 steps, uint bits) {
    UNITVEC_PRECISE vec3 u = steps * unitvec_quat_half_steps(bits).y;
    return unitvec_quat_warp(u);
}

// The square of the length, on the sphere, of the short way from the point x of a chart to the point at these coordinates,
// times (1 + x . x)^2.
float unitvec_quat_square(vec3 x, vec3 steps, uint bits) {
    UNITVEC_PRECISE vec3 e = x - unitvec_quat_in_chart(steps, bits);
    float along = unitvec_dot(x, e);
    UNITVEC_PRECISE float square = (1.0 + unitvec_dot(x, x)) * unitvec_dot(e, e) - along * along;
    return square;
}

// The coordinates of the lattice point nearest to the point x of a chart, and 1 where it is a middle of cells.
uvec4 unitvec_quat_nearest(vec3 x, uint bits) {
    float steps = unitvec_quat_half_steps(bits).x;
    vec3 u = vec3(unitvec_quat_unwarp(x.x, bits), unitvec_quat_unwarp(x.y, bits), unitvec_quat_unwarp(x.z, bits));
    UNITVEC_PRECISE vec3 place = u * steps;
    UNITVEC_PRECISE vec3 rounded = place + 0.5;
    vec3 corner = floor(rounded);
    UNITVEC_PRECISE float last = steps - 1.0;
    vec3 cell = clamp(floor(place), -steps, last);
    UNITVEC_PRECISE vec3 mirrored = ((corner + corner) - 1.0) - cell;
    vec3 beyond = clamp(mirrored, -steps, last);

    UNITVEC_PRECISE vec3 d = abs(place - corner);
    bool is_x = d.x < d.y && d.x < d.z;
    bool is_y = !is_x && d.y < d.z;
    vec3 next = vec3(is_x ? beyond.x : cell.x, is_y ? beyond.y : cell.y, is_x || is_y ? cell.z : beyond.z);

    UNITVEC_PRECISE vec3 middle = cell + 0.5;
    UNITVEC_PRECISE vec3 next_middle = next + 0.5;
    float to_cell = unitvec_quat_square(x, middle, bits);
    float to_next = unitvec_quat_square(x, next_middle, bits);
    if (to_next < to_cell) {
        cell = next;
        to_cell = to_next;
    }
    bool is_cell = to_cell < unitvec_quat_square(x, corner, bits);
    UNITVEC_PRECISE vec3 whole = (is_cell ? cell : corner) + steps;
    return uvec4(
        unitvec_whole_to_u32(whole.x), unitvec_whole_to_u32(whole.y), unitvec_whole_to_u32(whole.z), is_cell ? 1u : 0u
    );
}

// A code with a field from bit `at` on.
uvec2 unitvec_quat_place(uvec2 code, uint field, uint at) {
    if (at >= 32u) return uvec2(code.x, code.y | (field << (at - 32u)));
    return uvec2(code.x | (field << at), at == 0u ? code.y : code.y | (field >> (32u - at)));
}

// The field of `bits` bits from bit `at` on.
uint unitvec_quat_field(uvec2 code, uint at, uint bits) {
    if (at >= 32u) return (code.y >> (at - 32u)) & unitvec_mask(bits);
    uint high = at == 0u ? 0u : code.y << (32u - at);
    return ((code.x >> at) | high) & unitvec_mask(bits);
}

float unitvec_quat_kept(float x) {
    return abs(x) < UNITVEC_NEGLIGIBLE ? 0.0 : x;
}

uvec2 unitvec_quat_encode(vec4 q, uint bits) {
    q = unitvec_quat_or_identity(q);
    uint chart = unitvec_quat_chart(q);
    vec4 turned = unitvec_quat_turn(q, chart);
    float scale = unitvec_negate_if(unitvec_is_negative(turned.x), unitvec_reciprocal(abs(turned.x)));
    UNITVEC_PRECISE vec3 all = turned.yzw * scale;
    // No denormals, which devices may flush, tell one side of a cell from the other.
    vec3 x = vec3(unitvec_quat_kept(all.x), unitvec_quat_kept(all.y), unitvec_quat_kept(all.z));
    uvec4 nearest = unitvec_quat_nearest(x, bits);

    uint low = unitvec_quat_layout(bits).x;
    uint radix = unitvec_quat_layout(bits).y;
    uint above_c = (nearest.z >> low) + radix * (2u * chart + nearest.w);
    uint above = (nearest.x >> low) + radix * ((nearest.y >> low) + radix * above_c);
    uvec2 code = unitvec_quat_place(uvec2(0u, 0u), nearest.x & unitvec_mask(low), 0u);
    code = unitvec_quat_place(code, nearest.y & unitvec_mask(low), low);
    code = unitvec_quat_place(code, nearest.z & unitvec_mask(low), 2u * low);
    return unitvec_quat_place(code, above, 3u * low);
}

// A coordinate, in steps from the middle, from what is above its low bits and the bit of the code where those are.
float unitvec_quat_steps(uvec2 code, uint above, uint at, float middle, uint bits) {
    uint low = unitvec_quat_layout(bits).x;
    uint whole = ((above % unitvec_quat_layout(bits).y) << low) | unitvec_quat_field(code, at, low);
    float half_steps = unitvec_quat_half_steps(bits).x;
    UNITVEC_PRECISE float from_middle = (float(whole) - half_steps) + middle;
    UNITVEC_PRECISE float last = half_steps - middle;
    return min(from_middle, last);
}

vec4 unitvec_quat_decode(uvec2 code, uint bits) {
    uint low = unitvec_quat_layout(bits).x;
    uint radix = unitvec_quat_layout(bits).y;
    uint above = unitvec_quat_field(code, 3u * low, bits - 3u * low);
    uint of_chart = min(above / (radix * radix * radix), 7u);

    float middle = (of_chart & 1u) != 0u ? 0.5 : 0.0;
    vec3 steps = vec3(
        unitvec_quat_steps(code, above, 0u, middle, bits),
        unitvec_quat_steps(code, above / radix, low, middle, bits),
        unitvec_quat_steps(code, above / (radix * radix), 2u * low, middle, bits)
    );
    vec4 q = unitvec_quat_turn(vec4(1.0, unitvec_quat_in_chart(steps, bits)), 4u - (of_chart >> 1u));
    UNITVEC_PRECISE float square = (q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w);
    UNITVEC_PRECISE vec4 unit = q * unitvec_inverse_root(square);
    return unit;
}

uint quat24_encode(vec4 q) { return unitvec_quat_encode(q, 24u).x; }
uint quat32_encode(vec4 q) { return unitvec_quat_encode(q, 32u).x; }
uvec2 quat48_encode(vec4 q) { return unitvec_quat_encode(q, 48u); }
uvec2 quat64_encode(vec4 q) { return unitvec_quat_encode(q, 64u); }

vec4 quat24_decode(uint code) { return unitvec_quat_decode(uvec2(code, 0u), 24u); }
vec4 quat32_decode(uint code) { return unitvec_quat_decode(uvec2(code, 0u), 32u); }
vec4 quat48_decode(uvec2 code) { return unitvec_quat_decode(code, 48u); }
vec4 quat64_decode(uvec2 code) { return unitvec_quat_decode(code, 64u); }

#endif
