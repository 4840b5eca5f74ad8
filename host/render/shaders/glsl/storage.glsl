// The codec that the compiler is given, and how the value of an attribute or a texel holds its code.
//
//   ENCODE, DECODE     the codec's functions; without them the normal itself is stored
//   FRAME              the codec is one of tangent frames
//   DITHERED           the functions take an offset
//   PRECISE_BITS       ENCODE takes the bits of both components
//   STORAGE_...        what holds the code, or the numbers that the hardware rounds; the value's other components are 0

#include "unitvec/unitvec.glsl"
#include "unitvec/formats.glsl"
#ifdef DITHERED
#include "unitvec/dither.glsl"
#endif

// VALUE is a value, ATTRIBUTE that of a vertex attribute, CODE a code.
#if defined(STORAGE_UINT) || defined(STORAGE_UINT2)
#define VALUE uvec4
#define TEXTURE utexture2D
#elif defined(STORAGE_SINT8X2) || defined(STORAGE_SINT16X2)
#define VALUE ivec4
#define TEXTURE itexture2D
#else
#define VALUE vec4
#define TEXTURE texture2D
#endif
#if defined(STORAGE_UINT)
#define ATTRIBUTE uint
#elif defined(STORAGE_UINT2)
#define ATTRIBUTE uvec2
#elif defined(STORAGE_SINT8X2) || defined(STORAGE_SINT16X2)
#define ATTRIBUTE ivec2
#else
#define ATTRIBUTE vec4
#endif
#if defined(STORAGE_UINT2) || defined(STORAGE_SNORM16X3) || defined(STORAGE_FLOAT16X3)
#define CODE uvec2
#elif defined(STORAGE_PAIR)
#define CODE vec2
#elif defined(STORAGE_PAIRANDBIT)
#define CODE vec3
#else
#define CODE uint
#endif

#if defined(STORAGE_UINT)
#define TO_VALUE(code) uvec4(code, 0u, 0u, 0u)
#define TO_CODE(value) value.x
#elif defined(STORAGE_UINT2)
#define TO_VALUE(code) uvec4(code, 0u, 0u)
#define TO_CODE(value) value.xy
#elif defined(STORAGE_SINT8X2)
#define TO_VALUE(code) ivec4(code_to_sint8x2(code), 0, 0)
#define TO_CODE(value) sint8x2_to_code(value.xy)
#elif defined(STORAGE_SINT16X2)
#define TO_VALUE(code) ivec4(code_to_sint16x2(code), 0, 0)
#define TO_CODE(value) sint16x2_to_code(value.xy)
#elif defined(STORAGE_SNORM8X2)
#define TO_VALUE(code) vec4(code_to_snorm8x2(code), 0.0, 0.0)
#define TO_CODE(value) snorm8x2_to_code(value.xy)
#elif defined(STORAGE_SNORM16X2)
#define TO_VALUE(code) vec4(code_to_snorm16x2(code), 0.0, 0.0)
#define TO_CODE(value) snorm16x2_to_code(value.xy)
#elif defined(STORAGE_FLOAT16X2)
#define TO_VALUE(code) vec4(code_to_float16x2(code), 0.0, 0.0)
#define TO_CODE(value) float16x2_to_code(value.xy)
#elif defined(STORAGE_SNORM8X3)
#define TO_VALUE(code) vec4(code_to_snorm8x3(code), 0.0)
#define TO_CODE(value) snorm8x3_to_code(value.xyz)
#elif defined(STORAGE_SNORM10X3)
#define TO_VALUE(code) vec4(code_to_snorm10x3(code), 0.0)
#define TO_CODE(value) snorm10x3_to_code(value.xyz)
#elif defined(STORAGE_SNORM16X3)
#define TO_VALUE(code) vec4(code_to_snorm16x3(code), 0.0)
#define TO_CODE(value) snorm16x3_to_code(value.xyz)
#elif defined(STORAGE_UNORM8X2)
#define TO_VALUE(code) vec4(code_to_unorm8x2(code), 0.0, 0.0)
#define TO_CODE(value) unorm8x2_to_code(value.xy)
#elif defined(STORAGE_UNORM16X2)
#define TO_VALUE(code) vec4(code_to_unorm16x2(code), 0.0, 0.0)
#define TO_CODE(value) unorm16x2_to_code(value.xy)
#elif defined(STORAGE_UNORM8X3)
#define TO_VALUE(code) vec4(code_to_unorm8x3(code), 0.0)
#define TO_CODE(value) unorm8x3_to_code(value.xyz)
#elif defined(STORAGE_FLOAT16X3)
#define TO_VALUE(code) vec4(code_to_float16x3(code), 0.0)
#define TO_CODE(value) float16x3_to_code(value.xyz)
#elif defined(STORAGE_PAIR)
#define TO_VALUE(pair) vec4(pair, 0.0, 0.0)
#define TO_CODE(value) value.xy
#elif defined(STORAGE_PAIRANDBIT)
// Evaluates its argument once.
vec4 unitvec_pair_and_bit(vec3 e) { return vec4(e.xy, 0.0, e.z); }
#define TO_VALUE(e) unitvec_pair_and_bit(e)
#define TO_CODE(value) value.xyw
#elif !defined(STORAGE_FLOAT)
#error "no STORAGE_... is defined"
#endif

#ifdef ENCODE
// The value to store for the normal n.
VALUE value_of(vec3 n, vec2 offset) {
#if defined(PRECISE_BITS)
    return TO_VALUE(ENCODE(n, PRECISE_BITS));
#elif defined(DITHERED)
    return TO_VALUE(ENCODE(n, offset));
#elif defined(FRAME)
    return TO_VALUE(ENCODE(n, vec4(n.y, n.z, n.x, 1.0)));
#else
    return TO_VALUE(ENCODE(n));
#endif
}
#else
VALUE value_of(vec3 n, vec2 offset) {
    return vec4(n, 0.0);
}
#endif

#ifdef DECODE
vec3 decoded(CODE code, vec2 offset) {
#if defined(DITHERED)
    return DECODE(code, offset);
#elif defined(FRAME)
    vec3 n;
    vec4 tangent;
    DECODE(code, n, tangent);
    return n;
#else
    return DECODE(code);
#endif
}

// The normal that a stored value stands for.
#define NORMAL_OF(value, offset) decoded(TO_CODE(value), offset)
#else
#define NORMAL_OF(value, offset) value.xyz
#endif
