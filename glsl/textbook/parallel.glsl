// Textbook, only to measure against: x and y of normal maps, from which z >= 0 is worked out.

#ifndef TEXTBOOK_PARALLEL_GLSL
#define TEXTBOOK_PARALLEL_GLSL

#include "oct.glsl"

vec3 textbook_from_xyonly(vec2 e) {
    return vec3(e, sqrt(clamp(1.0 - dot(e, e), 0.0, 1.0)));
}

uint textbook_xyonly16_encode(vec3 v) { return textbook_pack_snorm2x8(v.xy); }
uint textbook_xyonly32_encode(vec3 v) { return packSnorm2x16(v.xy); }

vec3 textbook_xyonly16_decode(uint code) { return textbook_from_xyonly(textbook_unpack_snorm2x8(code)); }
vec3 textbook_xyonly32_decode(uint code) { return textbook_from_xyonly(unpackSnorm2x16(code)); }

#endif
