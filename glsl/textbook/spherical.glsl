// Textbook, only to measure against: angles by the language's own trigonometry, stored as two snorm. Spherical as in
// Cigolle et al. 2014, theta of 0 to pi and phi; cylindrical has z in the place of theta.

#ifndef TEXTBOOK_SPHERICAL_GLSL
#define TEXTBOOK_SPHERICAL_GLSL

#include "oct.glsl"

const float TEXTBOOK_PI = 3.14159265358979;

vec2 textbook_spherical(vec3 v) {
    return vec2(2.0 * acos(v.z) / TEXTBOOK_PI - 1.0, atan(v.y, v.x) / TEXTBOOK_PI);
}

vec3 textbook_from_spherical(vec2 e) {
    float theta = (e.x + 1.0) * TEXTBOOK_PI / 2.0;
    float phi = e.y * TEXTBOOK_PI;
    return vec3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

vec2 textbook_cylindrical(vec3 v) {
    return vec2(atan(v.y, v.x) / TEXTBOOK_PI, v.z);
}

vec3 textbook_from_cylindrical(vec2 e) {
    float phi = e.x * TEXTBOOK_PI;
    return vec3(sqrt(1.0 - e.y * e.y) * vec2(cos(phi), sin(phi)), e.y);
}

uint textbook_spherical16_encode(vec3 v) { return textbook_pack_snorm2x8(textbook_spherical(v)); }
uint textbook_spherical32_encode(vec3 v) { return packSnorm2x16(textbook_spherical(v)); }
uint textbook_cylindrical16_encode(vec3 v) { return textbook_pack_snorm2x8(textbook_cylindrical(v)); }
uint textbook_cylindrical32_encode(vec3 v) { return packSnorm2x16(textbook_cylindrical(v)); }

vec3 textbook_spherical16_decode(uint code) { return textbook_from_spherical(textbook_unpack_snorm2x8(code)); }
vec3 textbook_spherical32_decode(uint code) { return textbook_from_spherical(unpackSnorm2x16(code)); }
vec3 textbook_cylindrical16_decode(uint code) { return textbook_from_cylindrical(textbook_unpack_snorm2x8(code)); }
vec3 textbook_cylindrical32_decode(uint code) { return textbook_from_cylindrical(unpackSnorm2x16(code)); }

#endif
