// Encodes four vectors, frames or rotations an invocation. Macros for the compiler: ENCODE, the codec's function; BYTES, its
// code's size; FRAME for codecs of frames (normal, tangent, handedness), ROTATION for
// those of rotations; TABLE where the codec encodes by the table of
// best_fit.glsl. With TEXTBOOK the function is one of textbook.glsl.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "table.glsl"
#ifdef TEXTBOOK
#include "../textbook/textbook.glsl"
#else
#include "../unitvec/unitvec.glsl"
#endif
#include "words.glsl"

vec3 vector(uint w[READ], int first) {
    return uintBitsToFloat(uvec3(w[first], w[first + 1], w[first + 2]));
}

CODE code(uint w[READ], int n) {
#ifdef FRAME
    return ENCODE(vector(w, 7 * n), vec4(vector(w, 7 * n + 3), uintBitsToFloat(w[7 * n + 6])));
#elif defined(ROTATION)
    return ENCODE(vec4(vector(w, 4 * n), uintBitsToFloat(w[4 * n + 3])));
#else
    return ENCODE(vector(w, 3 * n));
#endif
}

// No loop: one around an encoder's own loop would stay, with words that are found by a variable index.
uint[WRITTEN] convert(uint w[READ]) {
    return pack(CODE[4](code(w, 0), code(w, 1), code(w, 2), code(w, 3)));
}

#include "group.glsl"
