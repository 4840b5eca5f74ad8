// The measure of encode_cost.comp for a decoder: an invocation decodes a code and its successors and sums the
// components. It takes the macros of decode.comp; without DECODE this is the baseline, which sums numbers from 1 to 2
// made of the code's bits. Bare bits might be denormals, which some processors add slowly.
#version 450
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
#include "../unitvec/unitvec.glsl"

struct Words { uint w[3]; };

layout(push_constant) uniform Work { uint vectors; uint repetitions; };
layout(set = 0, binding = 0) readonly buffer Input { Words input_codes[]; };
layout(set = 0, binding = 1) writeonly buffer Output { uint sums[]; };

// Odd, so that all bits change; the fraction of the golden ratio, so that codes spread evenly.
const uint STEP = 0x9e3779b9u;

#if BYTES > 4
#define CODE(words) words
#else
#define CODE(words) words.x
#endif

vec3 decoded(uvec2 code) {
#ifndef DECODE
    return vec3(uintBitsToFloat((code.x >> 9u) | 0x3f800000u));
#elif defined(FRAME)
    vec3 normal;
    vec4 tangent;
    DECODE(CODE(code), normal, tangent);
    return normal + tangent.xyz * tangent.w;
#elif defined(ROTATION)
    vec4 q = DECODE(CODE(code));
    return q.xyz * q.w;
#else
    return DECODE(CODE(code));
#endif
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < vectors) {
        uvec2 code = uvec2(input_codes[i].w[0], input_codes[i].w[1]);
        UNITVEC_PRECISE float sum = 0.0;
        uint repetition = 0u, end = repetitions;
        do {
            vec3 a = decoded(code), b = decoded(code + STEP);
            vec3 c = decoded(code + 2u * STEP), d = decoded(code + 3u * STEP);
            UNITVEC_PRECISE vec3 v = (a + b) + (c + d);
            sum += (v.x + v.y) + v.z;
            code += 4u * STEP;
            repetition += 4u;
        } while (repetition < end);
        sums[i] = floatBitsToUint(sum);
    }
}
