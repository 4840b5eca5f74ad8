// As encode.comp and decode.comp, of a dithered function: four vectors an invocation. The compiler is given ENCODE or DECODE,
// the function; BYTES, its code's size; and KEY, which of the functions below makes an offset.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "../unitvec/unitvec.glsl"
#include "words.glsl"

// Three words for each vector, as many as the vector itself has: so a group's keys take no address of their own.
layout(set = 0, binding = 2) readonly buffer Keys { uint keys[]; };

vec2 given(uvec3 words) { return uintBitsToFloat(words.xy); }
vec2 key(uvec3 words) { return dither_from_key(words.x); }
vec2 pixel(uvec3 words) { return dither_from_pixel(words.xy); }
vec2 texel(uvec3 words) { return dither_from_texel(uintBitsToFloat(words.xy)); }
vec2 position(uvec3 words) { return dither_from_position(uintBitsToFloat(words)); }

vec2 offset(uint n) {
    uint first = 12u * gl_GlobalInvocationID.x + 3u * n;
    return KEY(uvec3(keys[first], keys[first + 1u], keys[first + 2u]));
}

#ifdef ENCODE
uint code(uint w[READ], uint n) {
    return ENCODE(uintBitsToFloat(uvec3(w[3u * n], w[3u * n + 1u], w[3u * n + 2u])), offset(n));
}

uint[WRITTEN] convert(uint w[READ]) {
    return pack(uint[4](code(w, 0u), code(w, 1u), code(w, 2u), code(w, 3u)));
}
#else
uint[WRITTEN] convert(uint r[READ]) {
    uint c[4] = unpack(r);
    uint w[WRITTEN];
    for (uint n = 0u; n < 4u; ++n) {
        vec3 v = DECODE(c[n], offset(n));
        for (uint k = 0u; k < 3u; ++k) w[3u * n + k] = floatBitsToUint(v[k]);
    }
    return w;
}
#endif

#include "group.glsl"
