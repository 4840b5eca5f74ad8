// An invocation's work, a group of four: from buffers of at least the words that the vectors and codes fill, of which the
// last group may have fewer than four. To be included after words.glsl and the function `convert`, which makes a group's
// words to write of those that were read.

layout(local_size_x = 64) in;
layout(push_constant) uniform Count { uint vectors; };
layout(set = 0, binding = 0) readonly buffer Input { uint words_in[]; };
layout(set = 0, binding = 1) writeonly buffer Output { uint words_out[]; };

#ifndef HAS_TABLE
#define HAS_TABLE true
#endif

// The words of a group of which there are `count`; words that it lacks repeat the last one that it has.
uint[READ] load(uint group, uint count) {
    uint first = group * READ;
    uint w[READ];
    if (count >= 4u) {
        for (uint k = 0u; k < READ; ++k) w[k] = words_in[first + k];
    } else {
        uint last = (count * READ - 1u) / 4u;
        for (uint k = 0u; k < READ; ++k) w[k] = words_in[first + min(k, last)];
    }
    return w;
}

// Writes those words of a group that `count` of the four fill; what is left of the last of them is 0.
void store(uint w[WRITTEN], uint group, uint count) {
    uint first = group * WRITTEN;
    if (count >= 4u) {
        for (uint k = 0u; k < WRITTEN; ++k) words_out[first + k] = w[k];
    } else {
        uint bytes = count * WRITTEN;
        for (uint k = 0u; k < WRITTEN; ++k) {
            uint left = bytes - 4u * k;
            if (4u * k < bytes) words_out[first + k] = left < 4u ? w[k] & ((1u << (8u * left)) - 1u) : w[k];
        }
    }
}

void main() {
    uint group = gl_GlobalInvocationID.x;
    uint held = min(uint(words_in.length()) * 4u / READ, uint(words_out.length()) * 4u / WRITTEN);
    uint number = min(vectors, held);
    if (group * 4u < number && HAS_TABLE) {
        uint here = number - group * 4u;
        store(convert(load(group, here)), group, here);
    }
}
