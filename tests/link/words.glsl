#version 450
#define uint2 uvec2
#define float3 vec3
#define float4 vec4
#define asuint floatBitsToUint
#define asfloat uintBitsToFloat
