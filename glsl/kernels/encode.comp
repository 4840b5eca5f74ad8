// Encodes four vectors or frames an invocation. The compiler is given ENCODE, the codec's function, BYTES, its code's size,
// FRAME for codecs of frames (normal, tangent, handedness), and TABLE where the codec encodes by the table of
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

uint[WRITTEN] convert(uint w[READ]) {
    CODE c[4];
    for (int n = 0; n < 4; ++n) {
#ifdef FRAME
        c[n] = ENCODE(vector(w, 7 * n), vec4(vector(w, 7 * n + 3), uintBitsToFloat(w[7 * n + 6])));
#else
        c[n] = ENCODE(vector(w, 3 * n));
#endif
    }
    return pack(c);
}

#include "group.glsl"
