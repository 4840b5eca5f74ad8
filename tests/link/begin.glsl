
layout(local_size_x = 64) in;
layout(push_constant) uniform Count { uint count; };
layout(set = 0, binding = 0) readonly buffer In { uint words_in[]; };
layout(set = 0, binding = 1) writeonly buffer Out { uint words_out[]; };
void main() {
    uint n = gl_GlobalInvocationID.x;
