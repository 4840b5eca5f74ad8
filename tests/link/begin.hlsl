
[[vk::push_constant]] cbuffer Count { uint count; };
[[vk::binding(0)]] StructuredBuffer<uint> words_in;
[[vk::binding(1)]] RWStructuredBuffer<uint> words_out;
[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint n = id.x;
