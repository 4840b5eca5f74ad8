// The survey's measure of an encoder's arithmetic (section 4.2): an invocation encodes one vector `repetitions` times,
// each time a little changed so that nothing can be moved out of the loop, and sums the codes. Four go at a time, so
// that the loop takes little and each can start before the one before it is done. It takes the macros of encode.comp;
// without ENCODE this is the baseline to subtract, which sums the components' bits.
#version 450
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
#include "table.glsl"
#include "../unitvec/unitvec.glsl"

struct Vector { float f[3]; };

layout(push_constant) uniform Work { uint vectors; uint repetitions; };
layout(set = 0, binding = 0) readonly buffer Input { Vector input_vectors[]; };
layout(set = 0, binding = 1) writeonly buffer Output { uint sums[]; };

// 2^-12 and two other small steps: the sizes and signs of components change now and then, as from pixel to pixel.
const vec3 NUDGE = vec3(1.0 / 4096.0, -1.0 / 8192.0, 1.0 / 6144.0);

// The vector is the normal of a frame, and its turn about (1, 1, 1) the tangent; of a quaternion it is all but w, which is y.
#ifdef FRAME
#define CODE_OF(v) ENCODE(v, v.yzxx)
#elif defined(ROTATION)
#define CODE_OF(v) ENCODE(v.xyzy)
#else
#define CODE_OF(v) ENCODE(v)
#endif

uint encoded(vec3 v) {
#ifndef ENCODE
    return floatBitsToUint(v.x) + floatBitsToUint(v.y) + floatBitsToUint(v.z);
#elif BYTES > 4
    uvec2 code = CODE_OF(v);
    return code.x + code.y;
#else
    return CODE_OF(v);
#endif
}

// The loop's test is at its end, as in the Rust kernels, and nothing returns early: writing it otherwise can cost more
// than a cheap codec.
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < vectors) {
        UNITVEC_PRECISE vec3 v = vec3(input_vectors[i].f[0], input_vectors[i].f[1], input_vectors[i].f[2]);
        uint sum = 0u, repetition = 0u, end = repetitions;
        do {
            UNITVEC_PRECISE vec3 v1 = v + NUDGE, v2 = v + 2.0 * NUDGE, v3 = v + 3.0 * NUDGE;
            sum += encoded(v) + encoded(v1) + encoded(v2) + encoded(v3);
            v += 4.0 * NUDGE;
            repetition += 4u;
        } while (repetition < end);
        sums[i] = sum;
    }
}
