// unitvec: codes as the float or integer values that a Vulkan format stores exactly, and back.
//
// Source: the Vulkan specification, "Fixed-Point Data Conversions"; IEEE 754 binary16.
//
//   code_to_snorm8x2(code), snorm8x2_to_code(f)          R8G8_SNORM
//   code_to_snorm16x2(code), snorm16x2_to_code(f)        R16G16_SNORM
//   code_to_snorm8x3(code), snorm8x3_to_code(f)          R8G8B8_SNORM, R8G8B8A8_SNORM
//   code_to_snorm10x3(code), snorm10x3_to_code(f)        A2B10G10R10_SNORM_PACK32
//   code_to_snorm16x3(code), snorm16x3_to_code(f)        R16G16B16_SNORM, R16G16B16A16_SNORM; the code is a uvec2
//   code_to_unorm8x3(code), unorm8x3_to_code(f)          R8G8B8_UNORM, R8G8B8A8_UNORM
//   code_to_unorm8x2(code), unorm8x2_to_code(f)          R8G8_UNORM
//   code_to_unorm10x2(code), unorm10x2_to_code(f)        the first two of A2B10G10R10_UNORM_PACK32
//   code_to_unorm16x2(code), unorm16x2_to_code(f)        R16G16_UNORM
//   code_to_sint8x2(code), sint8x2_to_code(i)            R8G8_SINT, as ivec2
//   code_to_sint16x2(code), sint16x2_to_code(i)          R16G16_SINT, as ivec2
//   code_to_float16x2(code), float16x2_to_code(f)        R16G16_SFLOAT
//   code_to_float16x3(code), float16x3_to_code(f)        R16G16B16_SFLOAT, R16G16B16A16_SFLOAT; the code is a uvec2
//
// To store a codec's code in its format: write code_to_snorm16x2(oct32_encode(v)) to the attachment. To read it: fetch the texel
// and take oct32_decode(snorm16x2_to_code(texel.xy)). Nothing is rounded on the way. Layout: the first component in the low
// bits.
//
// All take any input. NaN counts as 0, others are clamped; the nearest integer is taken, so that a value that is off by some
// units in the last place gives its code. Patterns that no encoder writes (the lowest integer of an snorm; -0, infinity
// and NaN of a half) give the code that decodes alike.

#ifndef UNITVEC_FORMATS_GLSL
#define UNITVEC_FORMATS_GLSL

#ifndef UNITVEC_ARITH_GLSL
#include "arith.glsl"
#endif

precision highp float;
precision highp int;

// The snorm in the `bits` bits of a code from bit `first` on, rounded correctly on every device.
float unitvec_formats_snorm(uint code, uint first, uint bits) {
    return unitvec_snorm_part(unitvec_snorm_field(code, first, bits), bits);
}

// The unorm in the byte of a code from bit `first` on, likewise: 255 is the largest integer of an snorm of 9 bits.
float unitvec_formats_unorm8(uint code, uint first) {
    return unitvec_snorm_part(float((code >> first) & 255u), 9u);
}

// The unorms in the two lowest groups of `bits` bits of a code, and the code of two.
vec2 unitvec_formats_unorm_pair(uint code, uint bits) {
    float x = unitvec_snorm_part(float(code & unitvec_mask(bits)), bits + 1u);
    return vec2(x, unitvec_snorm_part(float((code >> bits) & unitvec_mask(bits)), bits + 1u));
}

uint unitvec_formats_unorm_code(vec2 f, uint bits) {
    return unitvec_unorm_encode(f.x, bits) | (unitvec_unorm_encode(f.y, bits) << bits);
}

// The half nearest to x.
uint unitvec_formats_half(float x) {
    return unitvec_is_nan(x) ? 0u : unitvec_half_encode(x);
}

vec2 unitvec_formats_snorm_pair(uint code, uint bits) {
    return vec2(unitvec_formats_snorm(code, 0u, bits), unitvec_formats_snorm(code, bits, bits));
}

uint unitvec_formats_pair_code(vec2 f, uint bits) {
    return unitvec_snorm_encode(f.x, bits) | (unitvec_snorm_encode(f.y, bits) << bits);
}

ivec2 unitvec_formats_sint_pair(uint code, uint bits) {
    return ivec2(unitvec_signed_field(code, 0u, bits), unitvec_signed_field(code, bits, bits));
}

// `most` is the largest integer of half of the code.
uint unitvec_formats_sint_code(ivec2 i, int most, uint bits) {
    int least = -most - 1;
    uint x = uint(min(max(i.x, least), most)) & unitvec_mask(bits);
    uint y = uint(min(max(i.y, least), most)) & unitvec_mask(bits);
    return x | (y << bits);
}

vec2 code_to_snorm8x2(uint code) { return unitvec_formats_snorm_pair(code, 8u); }
vec2 code_to_snorm16x2(uint code) { return unitvec_formats_snorm_pair(code, 16u); }

uint snorm8x2_to_code(vec2 f) { return unitvec_formats_pair_code(f, 8u); }
uint snorm16x2_to_code(vec2 f) { return unitvec_formats_pair_code(f, 16u); }

vec3 code_to_snorm8x3(uint code) {
    return vec3(unitvec_formats_snorm_pair(code, 8u), unitvec_formats_snorm(code, 16u, 8u));
}

uint snorm8x3_to_code(vec3 f) {
    return unitvec_formats_pair_code(f.xy, 8u) | (unitvec_snorm_encode(f.z, 8u) << 16u);
}

vec3 code_to_snorm10x3(uint code) {
    return vec3(unitvec_formats_snorm_pair(code, 10u), unitvec_formats_snorm(code, 20u, 10u));
}

uint snorm10x3_to_code(vec3 f) {
    return unitvec_formats_pair_code(f.xy, 10u) | (unitvec_snorm_encode(f.z, 10u) << 20u);
}

vec3 code_to_snorm16x3(uvec2 code) {
    return vec3(unitvec_formats_snorm_pair(code.x, 16u), unitvec_formats_snorm(code.y, 0u, 16u));
}

uvec2 snorm16x3_to_code(vec3 f) {
    return uvec2(unitvec_formats_pair_code(f.xy, 16u), unitvec_snorm_encode(f.z, 16u));
}

vec3 code_to_unorm8x3(uint code) {
    return vec3(unitvec_formats_unorm8(code, 0u), unitvec_formats_unorm8(code, 8u), unitvec_formats_unorm8(code, 16u));
}

uint unorm8x3_to_code(vec3 f) {
    uint low = unitvec_unorm_encode(f.x, 8u) | (unitvec_unorm_encode(f.y, 8u) << 8u);
    return low | (unitvec_unorm_encode(f.z, 8u) << 16u);
}

vec2 code_to_unorm8x2(uint code) { return unitvec_formats_unorm_pair(code, 8u); }
vec2 code_to_unorm10x2(uint code) { return unitvec_formats_unorm_pair(code, 10u); }
vec2 code_to_unorm16x2(uint code) { return unitvec_formats_unorm_pair(code, 16u); }

uint unorm8x2_to_code(vec2 f) { return unitvec_formats_unorm_code(f, 8u); }
uint unorm10x2_to_code(vec2 f) { return unitvec_formats_unorm_code(f, 10u); }
uint unorm16x2_to_code(vec2 f) { return unitvec_formats_unorm_code(f, 16u); }

ivec2 code_to_sint8x2(uint code) { return unitvec_formats_sint_pair(code, 8u); }
ivec2 code_to_sint16x2(uint code) { return unitvec_formats_sint_pair(code, 16u); }

uint sint8x2_to_code(ivec2 i) { return unitvec_formats_sint_code(i, 127, 8u); }
uint sint16x2_to_code(ivec2 i) { return unitvec_formats_sint_code(i, 32767, 16u); }

vec2 code_to_float16x2(uint code) {
    return vec2(unitvec_half_decode(code), unitvec_half_decode(code >> 16u));
}

uint float16x2_to_code(vec2 f) {
    return unitvec_formats_half(f.x) | (unitvec_formats_half(f.y) << 16u);
}

vec3 code_to_float16x3(uvec2 code) {
    return vec3(code_to_float16x2(code.x), unitvec_half_decode(code.y));
}

uvec2 float16x3_to_code(vec3 f) {
    return uvec2(float16x2_to_code(f.xy), unitvec_formats_half(f.z));
}

#endif
