// Decodes four codes of two bytes an invocation by looking their vectors up. The macro BYTES is 2.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "words.glsl"

struct Vector { uint w[3]; };

layout(set = 0, binding = 2) readonly buffer Table { Vector decoded[]; };
// With a table of fewer vectors the kernel does nothing.
#define HAS_TABLE (decoded.length() >= 1 << 16)

uint[WRITTEN] convert(uint r[READ]) {
    uint c[4] = unpack(r);
    uint w[WRITTEN];
    for (int n = 0; n < 4; ++n) {
        for (int k = 0; k < 3; ++k) w[3 * n + k] = decoded[c[n] & 0xffffu].w[k];
    }
    return w;
}

#include "group.glsl"
