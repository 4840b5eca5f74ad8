// Decodes four codes an invocation. Macros for the compiler: DECODE, the codec's function; BYTES, its code's size;
// FRAME for codecs of frames (normal, tangent, handedness), ROTATION for those of rotations. With TEXTBOOK the function is one of textbook.glsl.
#version 450
#extension GL_GOOGLE_include_directive : require

#ifdef TEXTBOOK
#include "../textbook/textbook.glsl"
#else
#include "../unitvec/unitvec.glsl"
#endif
#include "words.glsl"

uint[WRITTEN] convert(uint r[READ]) {
    CODE c[4] = unpack(r);
    uint w[WRITTEN];
    for (int n = 0; n < 4; ++n) {
#ifdef FRAME
        vec3 v;
        vec4 tangent;
        DECODE(c[n], v, tangent);
        for (int k = 0; k < 4; ++k) w[7 * n + 3 + k] = floatBitsToUint(tangent[k]);
#elif defined(ROTATION)
        vec4 v = DECODE(c[n]);
        w[4 * n + 3] = floatBitsToUint(v.w);
#else
        vec3 v = DECODE(c[n]);
#endif
        for (int k = 0; k < 3; ++k) w[FLOATS * n + k] = floatBitsToUint(v[k]);
    }
    return w;
}

#include "group.glsl"
