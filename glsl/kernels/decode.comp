// Decodes four codes an invocation. The compiler is given DECODE, the codec's function, and BYTES, its code's size.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "../unitvec/unitvec.glsl"
#include "words.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Count { uint vectors; };
layout(set = 0, binding = 0) readonly buffer Input { Codes code_groups[]; };
layout(set = 0, binding = 1) writeonly buffer Output { Vectors vector_groups[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i * 4u >= vectors) return;
    CODE c[4] = unpack(code_groups[i]);
    for (int n = 0; n < 4; ++n) {
        vec3 v = DECODE(c[n]);
        vector_groups[i].f[3 * n] = v.x;
        vector_groups[i].f[3 * n + 1] = v.y;
        vector_groups[i].f[3 * n + 2] = v.z;
    }
}
