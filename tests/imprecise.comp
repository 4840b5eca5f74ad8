#version 450
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Input { uint words[]; } source;
layout(std430, set = 0, binding = 1) writeonly buffer Output { float values[]; } results;
layout(push_constant) uniform Constants { uint count; };

void main() {
    for (uint k = 0u; k < 4u; ++k) {
        uint i = 4u * gl_GlobalInvocationID.x + k;
        if (i >= count) return;
        float a = uintBitsToFloat(source.words[3u * i]);
        float b = uintBitsToFloat(source.words[3u * i + 1u]);
        uint c = source.words[3u * i + 2u];
        precise vec2 quotients = vec2(a, b) / vec2(b, a);
        precise vec2 products = vec2(a, b) * b;
        precise float root = sqrt(a);
        precise float difference = a - b;
        results.values[7u * i] = quotients.x;
        results.values[7u * i + 1u] = quotients.y;
        results.values[7u * i + 2u] = root;
        results.values[7u * i + 3u] = difference;
        results.values[7u * i + 4u] = products.x;
        precise vec2 integers = vec2(ivec2(int(c), int(b)));
        results.values[7u * i + 5u] = integers.x;
        results.values[7u * i + 6u] = float(c);
    }
}
