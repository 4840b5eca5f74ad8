// Encodes four vectors an invocation. The compiler is given ENCODE, the codec's function, BYTES, its code's size, and
// TABLE where the codec encodes by the table of best_fit.glsl.
#version 450
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
#include "table.glsl"
#include "../unitvec/unitvec.glsl"
#include "words.glsl"

layout(push_constant) uniform Count { uint vectors; };
layout(set = 0, binding = 0) readonly buffer Input { Vectors vector_groups[]; };
layout(set = 0, binding = 1) writeonly buffer Output { Codes code_groups[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i * 4u >= vectors) return;
    CODE c[4];
    for (int n = 0; n < 4; ++n) {
        c[n] = ENCODE(vec3(vector_groups[i].f[3 * n], vector_groups[i].f[3 * n + 1], vector_groups[i].f[3 * n + 2]));
    }
    code_groups[i] = pack(c);
}
