// Textbook, only to measure against: signed octahedral codes, White 2017: hemi-oct of (x, y, |z|) and a bit of z's sign.

#ifndef TEXTBOOK_SOCT_GLSL
#define TEXTBOOK_SOCT_GLSL

#include "hemioct.glsl"

vec2 textbook_soct(vec3 v) {
    return textbook_hemioct(vec3(v.xy, abs(v.z)));
}

vec3 textbook_with_sign(vec3 v, uint negative) {
    return vec3(v.xy, negative != 0u ? -v.z : v.z);
}

uint textbook_soct17_encode(vec3 v) {
    return textbook_pack_snorm2x8(textbook_soct(v)) | (v.z < 0.0 ? 0x10000u : 0u);
}

uvec2 textbook_soct33_encode(vec3 v) {
    return uvec2(packSnorm2x16(textbook_soct(v)), v.z < 0.0 ? 1u : 0u);
}

vec3 textbook_soct17_decode(uint code) {
    return textbook_with_sign(textbook_hemioct16_decode(code), code & 0x10000u);
}

vec3 textbook_soct33_decode(uvec2 code) {
    return textbook_with_sign(textbook_hemioct32_decode(code.x), code.y & 1u);
}

#endif
