// Textbook, only to measure against: hemi-oct by listing 6 of Cigolle et al. 2014, z >= 0.

#ifndef TEXTBOOK_HEMIOCT_GLSL
#define TEXTBOOK_HEMIOCT_GLSL

#include "oct.glsl"

vec2 textbook_hemioct(vec3 v) {
    vec2 p = v.xy * (1.0 / (abs(v.x) + abs(v.y) + v.z));
    return vec2(p.x + p.y, p.x - p.y);
}

vec3 textbook_from_hemioct(vec2 e) {
    vec2 p = vec2(e.x + e.y, e.x - e.y) * 0.5;
    return normalize(vec3(p, 1.0 - abs(p.x) - abs(p.y)));
}

uint textbook_hemioct16_encode(vec3 v) { return textbook_pack_snorm2x8(textbook_hemioct(v)); }
uint textbook_hemioct32_encode(vec3 v) { return packSnorm2x16(textbook_hemioct(v)); }

vec3 textbook_hemioct16_decode(uint code) { return textbook_from_hemioct(textbook_unpack_snorm2x8(code)); }
vec3 textbook_hemioct32_decode(uint code) { return textbook_from_hemioct(unpackSnorm2x16(code)); }

#endif
