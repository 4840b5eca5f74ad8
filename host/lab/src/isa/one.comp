// Encodes or decodes one element an invocation, with aligned reads and writes and no branch, so that a compiler's count of
// its instructions is the codec's, once that of the same kernel without a codec is subtracted. Macros for the compiler:
// those of glsl/kernels/encode.comp and decode.comp; IDLE for the kernel without a codec, which adds the components that
// it reads; LINKED for the functions of spirv/unitvec.spv. Another text stands before this one, with the include of the
// codec's family or with stubs.

layout(local_size_x = 64) in;

#if BYTES > 4
#define CODE uvec2
#else
#define CODE uint
#endif

#ifdef FRAME
struct Value { vec4 v; vec4 tangent; };
#else
struct Value { vec4 v; };
#endif

#ifdef ENCODE
layout(set = 0, binding = 0) readonly buffer Input { Value values[]; };
layout(set = 0, binding = 1) writeonly buffer Output { CODE codes[]; };

CODE code(Value value) {
#ifdef IDLE
    float sum = value.v.x + value.v.y + value.v.z;
#ifdef FRAME
    sum += value.tangent.x + value.tangent.y + value.tangent.z + value.tangent.w;
#elif defined(ROTATION)
    sum += value.v.w;
#endif
    return CODE(floatBitsToUint(sum));
#elif defined(FRAME)
    return ENCODE(value.v.xyz, value.tangent);
#elif defined(ROTATION)
    return ENCODE(value.v);
#else
    return ENCODE(value.v.xyz);
#endif
}

void main() {
    codes[gl_GlobalInvocationID.x] = code(values[gl_GlobalInvocationID.x]);
}
#else
layout(set = 0, binding = 0) readonly buffer Input { CODE codes[]; };
layout(set = 0, binding = 1) writeonly buffer Output { Value values[]; };

Value value(CODE code) {
#ifdef IDLE
#if BYTES > 4
    vec4 v = vec4(uintBitsToFloat(code.x) + uintBitsToFloat(code.y));
#else
    vec4 v = vec4(uintBitsToFloat(code));
#endif
#ifdef FRAME
    return Value(v, v);
#else
    return Value(v);
#endif
#elif defined(FRAME) && defined(LINKED)
    UnitvecFrame frame = DECODE(code);
    return Value(vec4(frame.normal, 0.0), frame.tangent);
#elif defined(FRAME)
    vec3 v;
    vec4 tangent;
    DECODE(code, v, tangent);
    return Value(vec4(v, 0.0), tangent);
#elif defined(ROTATION)
    return Value(DECODE(code));
#else
    return Value(vec4(DECODE(code), 0.0));
#endif
}

void main() {
    values[gl_GlobalInvocationID.x] = value(codes[gl_GlobalInvocationID.x]);
}
#endif
