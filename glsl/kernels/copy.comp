// Reads and writes as many bytes as a codec's kernel, and does no more with them than it takes to read them all: this
// measures the limit of the memory. It skips an incomplete last group. Macros for the compiler: BYTES, ENCODE or
// DECODE, and FRAME where frames are encoded, ROTATION where rotations are.
#version 450

#ifdef FRAME
#define ELEMENT 28
#elif defined(ROTATION)
#define ELEMENT 16
#else
#define ELEMENT 12
#endif
#ifdef ENCODE
#define READ ELEMENT
#define WRITTEN BYTES
#else
#define READ BYTES
#define WRITTEN ELEMENT
#endif

struct Read { uint w[READ]; };
struct Written { uint w[WRITTEN]; };

layout(local_size_x = 64) in;
layout(push_constant) uniform Count { uint vectors; };
layout(set = 0, binding = 0) readonly buffer Input { Read read[]; };
layout(set = 0, binding = 1) writeonly buffer Output { Written written[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i * 4u + 4u > vectors) return;
    for (int n = 0; n < WRITTEN; ++n) {
        uint w = 0u;
        for (int k = n; k < READ; k += WRITTEN) w ^= read[i].w[k];
#if READ < WRITTEN
        w = read[i].w[n % READ];
#endif
        written[i].w[n] = w;
    }
}
