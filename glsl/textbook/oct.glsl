// Textbook, only to measure against: octahedral codes of Cigolle et al. 2014. Fast by listings 1 and 2, precise by
// listing 3, with GLSL's packing, and that of listing 5 for 24 bits. Then the two variants that are pasted most.

#ifndef TEXTBOOK_OCT_GLSL
#define TEXTBOOK_OCT_GLSL

vec2 textbook_sign_not_zero(vec2 v) {
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

// Listing 1.
vec2 textbook_oct(vec3 v) {
    vec2 p = v.xy * (1.0 / (abs(v.x) + abs(v.y) + abs(v.z)));
    return v.z <= 0.0 ? (1.0 - abs(p.yx)) * textbook_sign_not_zero(p) : p;
}

// Listing 2.
vec3 textbook_from_oct(vec2 e) {
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * textbook_sign_not_zero(v.xy);
    return normalize(v);
}

// Listing 3: the best of the four lattice points around the position; m steps from 0 to 1.
vec2 textbook_oct_precise(vec3 v, float m) {
    vec2 low = floor(clamp(textbook_oct(v), -1.0, 1.0) * m) / m;
    vec2 best = low;
    float highest = dot(textbook_from_oct(low), v);
    for (int i = 0; i <= 1; ++i) {
        for (int j = 0; j <= 1; ++j) {
            if (i != 0 || j != 0) {
                vec2 candidate = low + vec2(i, j) / m;
                float cosine = dot(textbook_from_oct(candidate), v);
                if (cosine > highest) {
                    best = candidate;
                    highest = cosine;
                }
            }
        }
    }
    return best;
}

// On [0, 1], for unorm formats: Narkowicz 2014. The way back, after Stubbe, takes what lies beyond the fold off both
// components.
vec2 textbook_oct_biased(vec3 v) {
    vec3 p = v / (abs(v.x) + abs(v.y) + abs(v.z));
    vec2 e = p.z >= 0.0 ? p.xy : (1.0 - abs(p.yx)) * textbook_sign_not_zero(p.xy);
    return e * 0.5 + 0.5;
}

vec3 textbook_from_oct_biased(vec2 e) {
    vec2 p = e * 2.0 - 1.0;
    float z = 1.0 - abs(p.x) - abs(p.y);
    return normalize(vec3(p - clamp(-z, 0.0, 1.0) * textbook_sign_not_zero(p), z));
}

// Listings 1 and 2 with the language's sign, which is 0 for 0.
vec2 textbook_oct_sign(vec3 v) {
    vec2 p = v.xy * (1.0 / (abs(v.x) + abs(v.y) + abs(v.z)));
    return v.z <= 0.0 ? (1.0 - abs(p.yx)) * sign(p) : p;
}

vec3 textbook_from_oct_sign(vec2 e) {
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * sign(v.xy);
    return normalize(v);
}

// Two bytes of snorm.
uint textbook_pack_snorm2x8(vec2 e) {
    return packSnorm4x8(vec4(e, 0.0, 0.0)) & 0xffffu;
}

vec2 textbook_unpack_snorm2x8(uint code) {
    return unpackSnorm4x8(code).xy;
}

// Listing 5: two snorm of 12 bits as three bytes.
uint textbook_pack_snorm2x12(vec2 e) {
    vec2 u = floor(clamp(e, -1.0, 1.0) * 2047.0 + 2047.5);
    float t = floor(u.y / 256.0);
    ivec3 bytes = ivec3(floor(vec3(u.x / 16.0, fract(u.x / 16.0) * 256.0 + t, u.y - t * 256.0)));
    return uint(bytes.x | (bytes.y << 8) | (bytes.z << 16));
}

vec2 textbook_unpack_snorm2x12(uint code) {
    vec3 bytes = unpackUnorm4x8(code).xyz * 255.0;
    float t = floor(bytes.y / 16.0);
    vec2 u = vec2(bytes.x * 16.0 + t, (bytes.y - t * 16.0) * 256.0 + bytes.z);
    return clamp((u - 2047.0) / 2047.0, -1.0, 1.0);
}

uint textbook_oct16_encode(vec3 v) { return textbook_pack_snorm2x8(textbook_oct(v)); }
uint textbook_oct24_encode(vec3 v) { return textbook_pack_snorm2x12(textbook_oct(v)); }
uint textbook_oct32_encode(vec3 v) { return packSnorm2x16(textbook_oct(v)); }

uint textbook_oct16p_encode(vec3 v) { return textbook_pack_snorm2x8(textbook_oct_precise(v, 127.0)); }
uint textbook_oct24p_encode(vec3 v) { return textbook_pack_snorm2x12(textbook_oct_precise(v, 2047.0)); }
uint textbook_oct32p_encode(vec3 v) { return packSnorm2x16(textbook_oct_precise(v, 32767.0)); }

vec3 textbook_oct16_decode(uint code) { return textbook_from_oct(textbook_unpack_snorm2x8(code)); }
vec3 textbook_oct24_decode(uint code) { return textbook_from_oct(textbook_unpack_snorm2x12(code)); }
vec3 textbook_oct32_decode(uint code) { return textbook_from_oct(unpackSnorm2x16(code)); }

vec3 textbook_oct16p_decode(uint code) { return textbook_oct16_decode(code); }
vec3 textbook_oct24p_decode(uint code) { return textbook_oct24_decode(code); }
vec3 textbook_oct32p_decode(uint code) { return textbook_oct32_decode(code); }

uint textbook_oct_biased16_encode(vec3 v) { return packUnorm4x8(vec4(textbook_oct_biased(v), 0.0, 0.0)); }
uint textbook_oct_biased20_encode(vec3 v) {
    uvec2 u = uvec2(round(clamp(textbook_oct_biased(v), 0.0, 1.0) * 1023.0));
    return u.x | (u.y << 10u);
}
uint textbook_oct_biased32_encode(vec3 v) { return packUnorm2x16(textbook_oct_biased(v)); }
uint textbook_oct_sign32_encode(vec3 v) { return packSnorm2x16(textbook_oct_sign(v)); }

vec3 textbook_oct_biased16_decode(uint code) { return textbook_from_oct_biased(unpackUnorm4x8(code).xy); }
vec3 textbook_oct_biased20_decode(uint code) {
    return textbook_from_oct_biased(vec2(code & 1023u, (code >> 10u) & 1023u) / 1023.0);
}
vec3 textbook_oct_biased32_decode(uint code) { return textbook_from_oct_biased(unpackUnorm2x16(code)); }
vec3 textbook_oct_sign32_decode(uint code) { return textbook_from_oct_sign(unpackSnorm2x16(code)); }

#endif
