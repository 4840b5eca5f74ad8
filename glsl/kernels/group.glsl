// An invocation's work, a group of four. The buffers hold at least the words that the vectors and codes fill; the last
// group may have fewer than four. Include this after words.glsl and the function `convert`, which turns the words that
// a group reads into those that it writes.

layout(local_size_x = 64) in;
// Not 0: the caller promises buffers of whole groups that hold at least `vectors` elements, so that neither the group
// nor a buffer is checked.
layout(constant_id = 0) const uint whole_groups = 0u;
layout(push_constant) uniform Count { uint vectors; };
layout(set = 0, binding = 0) readonly buffer Input { uint words_in[]; };
layout(set = 0, binding = 1) writeonly buffer Output { uint words_out[]; };

// The vectors that the host asks for: none, where a table is too short.
uint asked() {
#ifdef HAS_TABLE
    return HAS_TABLE ? vectors : 0u;
#else
    return vectors;
#endif
}

// The words of a group that has `count` elements; some of its words stand in for those that it lacks.
uint[READ] load(uint group, uint count) {
    uint first = group * READ;
    uint w[READ];
    if (count >= 4u) {
        for (uint k = 0u; k < READ; ++k) w[k] = words_in[first + k];
    } else {
#if READ % 4 == 0
        // Each of the four has whole words. The last one's words stand in for missing ones.
        const uint each = READ / 4;
        for (uint k = 0u; k < READ; ++k) w[k] = words_in[first + each * min(k / each, count - 1u) + k % each];
#else
        uint last = (count * READ - 1u) / 4u;
        for (uint k = 0u; k < READ; ++k) w[k] = words_in[first + min(k, last)];
#endif
    }
    return w;
}

// Writes the words of a group that `count` of the four fill; the rest of the last word is 0.
void store(uint w[WRITTEN], uint group, uint count) {
    uint first = group * WRITTEN;
    if (count >= 4u) {
        for (uint k = 0u; k < WRITTEN; ++k) words_out[first + k] = w[k];
    } else {
#if WRITTEN % 4 == 0
        // Each of the four has whole words: these have no more than three conditions.
        const uint each = WRITTEN / 4;
        for (uint k = 0u; k < WRITTEN; ++k) {
            if (k / each < count) words_out[first + k] = w[k];
        }
#else
        uint bytes = count * WRITTEN;
        for (uint k = 0u; k < WRITTEN; ++k) {
            uint left = bytes - 4u * k;
            if (4u * k < bytes) words_out[first + k] = left < 4u ? w[k] & ((1u << (8u * left)) - 1u) : w[k];
        }
#endif
    }
}

// The number of vectors from a group on, four or more for a whole group, that both buffers hold and the host asks for:
// none, where there is nothing to do.
uint here(uint group) {
    uint first = group * 4u;
    if (whole_groups != 0u) return first < asked() ? 4u : 0u;
    uint held = min(uint(words_in.length()) * 4u / READ, uint(words_out.length()) * 4u / WRITTEN);
    uint number = min(asked(), held);
    return first < number ? number - first : 0u;
}

void main() {
    uint group = gl_GlobalInvocationID.x;
    uint count = here(group);
    if (count > 0u) store(convert(load(group, count)), group, count);
}
