// Decodes four codes an invocation. The compiler is given DECODE, the codec's function, and BYTES, its code's size.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "../unitvec/unitvec.glsl"
#include "words.glsl"

// Of each frame the normal, the tangent, the handedness.
struct Frames { float f[28]; };

layout(local_size_x = 64) in;
layout(push_constant) uniform Count { uint frames; };
layout(set = 0, binding = 0) readonly buffer Input { Codes code_groups[]; };
layout(set = 0, binding = 1) writeonly buffer Output { Frames frame_groups[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i * 4u >= frames) return;
    CODE c[4] = unpack(code_groups[i]);
    for (int n = 0; n < 4; ++n) {
        vec3 normal;
        vec4 tangent;
        DECODE(c[n], normal, tangent);
        for (int k = 0; k < 3; ++k) frame_groups[i].f[7 * n + k] = normal[k];
        for (int k = 0; k < 4; ++k) frame_groups[i].f[7 * n + 3 + k] = tangent[k];
    }
}
