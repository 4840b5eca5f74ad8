// Decodes four codes of two bytes an invocation by looking their vectors up. The compiler is given BYTES, 2.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "words.glsl"

layout(set = 0, binding = 2) readonly buffer Table { uint decoded[]; };
// With a table of fewer vectors the kernel does nothing.
#define HAS_TABLE (decoded.length() >= 3 << 16)

uint[WRITTEN] convert(uint r[READ]) {
    uint c[4] = unpack(r);
    uint w[WRITTEN];
    for (int n = 0; n < 4; ++n) {
        uint first = 3u * (c[n] & 0xffffu);
        for (int k = 0; k < 3; ++k) w[3 * n + k] = decoded[first + k];
    }
    return w;
}

#include "group.glsl"
