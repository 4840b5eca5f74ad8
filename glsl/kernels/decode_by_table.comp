// Decodes four codes of two bytes an invocation by looking their vectors up. The compiler is given BYTES, 2.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "words.glsl"

struct Vector { float f[3]; };

layout(local_size_x = 64) in;
layout(push_constant) uniform Count { uint vectors; };
layout(set = 0, binding = 0) readonly buffer Input { Codes code_groups[]; };
layout(set = 0, binding = 1) writeonly buffer Output { Vectors vector_groups[]; };
layout(set = 0, binding = 2) readonly buffer Table { Vector decoded[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i * 4u >= vectors) return;
    uint c[4] = unpack(code_groups[i]);
    for (int n = 0; n < 4; ++n) {
        Vector v = decoded[c[n] & 0xffffu];
        vector_groups[i].f[3 * n] = v.f[0];
        vector_groups[i].f[3 * n + 1] = v.f[1];
        vector_groups[i].f[3 * n + 2] = v.f[2];
    }
}
