// Textbook, only to measure against: a normal, a tangent and a handedness. The tangent by Ong 2023, "Tangent spaces and
// diamond encoding", about the normal by listings 1 and 2 of Cigolle et al. 2014: 11 bits each of the normal's x and y,
// 9 bits of diamond, a bit of handedness.

#ifndef TEXTBOOK_FRAME_GLSL
#define TEXTBOOK_FRAME_GLSL

#include "oct.glsl"

// Place on the diamond |x| + |y| = 1, from 0 to 1.
float textbook_diamond(vec2 p) {
    float x = p.x / (abs(p.x) + abs(p.y));
    float side = sign(p.y);
    return 0.5 + 0.25 * side * (1.0 - x);
}

vec2 textbook_from_diamond(float d) {
    float side = sign(d - 0.5);
    float x = 1.0 - side * (4.0 * d - 2.0);
    return normalize(vec2(x, side * (1.0 - abs(x))));
}

// The first of two vectors that make a basis with the normal; the other is its cross product with the normal.
vec3 textbook_first_tangent(vec3 normal) {
    return normalize(abs(normal.y) > abs(normal.z) ? vec3(normal.y, -normal.x, 0.0) : vec3(normal.z, 0.0, -normal.x));
}

uint textbook_snorm11(float x) {
    return uint(int(round(clamp(x, -1.0, 1.0) * 1023.0))) & 2047u;
}

float textbook_from_snorm11(uint code, int first) {
    return max(float(bitfieldExtract(int(code), first, 11)) / 1023.0, -1.0);
}

uint textbook_frame32_encode(vec3 normal, vec4 tangent) {
    vec2 e = textbook_oct(normal);
    vec3 first = textbook_first_tangent(normal);
    float d = textbook_diamond(vec2(dot(tangent.xyz, first), dot(tangent.xyz, cross(first, normal))));
    return textbook_snorm11(e.x) | (textbook_snorm11(e.y) << 11u) | (uint(round(d * 511.0)) << 22u)
        | (tangent.w < 0.0 ? 0x80000000u : 0u);
}

void textbook_frame32_decode(uint code, out vec3 normal, out vec4 tangent) {
    normal = textbook_from_oct(vec2(textbook_from_snorm11(code, 0), textbook_from_snorm11(code, 11)));
    vec3 first = textbook_first_tangent(normal);
    vec2 p = textbook_from_diamond(float((code >> 22u) & 511u) / 511.0);
    tangent = vec4(p.x * first + p.y * cross(first, normal), (code >> 31u) != 0u ? -1.0 : 1.0);
}

#endif
