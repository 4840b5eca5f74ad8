// Textbook, only to measure against: the three components as they are, in snorm or unorm; decoders normalise.

#ifndef TEXTBOOK_COMPONENTS_GLSL
#define TEXTBOOK_COMPONENTS_GLSL

uint textbook_snorm8x3_encode(vec3 v) { return packSnorm4x8(vec4(v, 0.0)); }
vec3 textbook_snorm8x3_decode(uint code) { return normalize(unpackSnorm4x8(code).xyz); }

uint textbook_unorm8x3_encode(vec3 v) { return packUnorm4x8(vec4(v * 0.5 + 0.5, 0.0)); }
vec3 textbook_unorm8x3_decode(uint code) { return normalize(unpackUnorm4x8(code).xyz * 2.0 - 1.0); }

// The layout of the format A2B10G10R10_SNORM_PACK32.
uint textbook_snorm10x3_encode(vec3 v) {
    ivec3 i = ivec3(round(clamp(v, -1.0, 1.0) * 511.0)) & 1023;
    return uint(i.x | (i.y << 10) | (i.z << 20));
}

vec3 textbook_snorm10x3_decode(uint code) {
    int i = int(code);
    ivec3 components = ivec3(bitfieldExtract(i, 0, 10), bitfieldExtract(i, 10, 10), bitfieldExtract(i, 20, 10));
    return normalize(max(vec3(components) / 511.0, -1.0));
}

uvec2 textbook_snorm16x3_encode(vec3 v) { return uvec2(packSnorm2x16(v.xy), packSnorm2x16(vec2(v.z, 0.0))); }
vec3 textbook_snorm16x3_decode(uvec2 code) {
    return normalize(vec3(unpackSnorm2x16(code.x), unpackSnorm2x16(code.y).x));
}

#endif
