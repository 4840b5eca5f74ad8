// unitvec: GLSL's vectors and functions as far as the codecs use them, in C++11, for CPUs, CUDA and HIP.
//
// Everything is in the namespace `unitvec`, so that its float3 and CUDA's are two types: unitvec::float3(v.x, v.y, v.z)
// converts. On GPUs all functions are __host__ __device__ (UNITVEC_FN; define it before this file for other attributes).
//
// The results are the CPU library's, to the bit, by the default options of g++, clang, nvcc and hipcc. These fuse a product
// and a sum into one rounding: g++ and clang where the target has such an instruction, and so do nvcc (-fmad=true) and hipcc.
// unitvec_rounded keeps both roundings. Elsewhere it costs nothing; on CPUs with fused instructions it keeps loops from being
// vectorised, on GPUs it is one more instruction. With -ffp-contract=off (nvcc: -fmad=false) define UNITVEC_UNFUSED, and it
// does nothing. Fast math changes results, and is refused.

#ifndef UNITVEC_VECTORS_HPP
#define UNITVEC_VECTORS_HPP

#include <float.h>
#include <math.h>
#include <string.h>

// clang defines __USE_FAST_MATH__ as 0.
#if defined(__FAST_MATH__) || (defined(__USE_FAST_MATH__) && __USE_FAST_MATH__ + 0) || defined(_M_FP_FAST)
#error "unitvec: fast math changes codes: compile without -ffast-math, -use_fast_math and /fp:fast"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "unitvec: floats are evaluated in more bits, which changes codes: compile with -msse2 -mfpmath=sse"
#endif
#if defined(min) || defined(max)
#error "unitvec: `min` and `max` are macros: define NOMINMAX before windows.h"
#endif

#ifndef UNITVEC_FN
#if defined(__CUDACC__) || defined(__HIPCC__)
#define UNITVEC_FN __host__ __device__ inline
#else
#define UNITVEC_FN inline
#endif
#endif

#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
#define UNITVEC_ON_GPU
#elif defined(_MSC_VER) && !defined(__clang__)
#pragma fp_contract(off)
#define UNITVEC_UNFUSED
#elif (defined(__x86_64__) || defined(__i386__)) && !defined(__FMA__) && !defined(__FMA4__)
#define UNITVEC_UNFUSED
#endif

namespace unitvec {

typedef unsigned int uint;

// A sum or product, rounded: what uses it is not fused with it.
UNITVEC_FN float unitvec_rounded(float x) {
#if defined(UNITVEC_UNFUSED)
    return x;
#elif defined(UNITVEC_ON_GPU)
    // No result is larger, but compilers cannot know.
    return x > 3e38f ? 3e38f : x;
#else
#if defined(__x86_64__) || defined(__i386__)
    __asm__("" : "+x"(x));
#elif defined(__aarch64__)
    __asm__("" : "+w"(x));
#else
    __asm__("" : "+r"(x));
#endif
    return x;
#endif
}

UNITVEC_FN uint floatBitsToUint(float x) {
#ifdef UNITVEC_ON_GPU
    return __float_as_uint(x);
#else
    uint bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
#endif
}

UNITVEC_FN float uintBitsToFloat(uint bits) {
#ifdef UNITVEC_ON_GPU
    return __uint_as_float(bits);
#else
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
#endif
}

UNITVEC_FN float abs(float x) { return ::fabsf(x); }
UNITVEC_FN int abs(int x) { return x < 0 ? -x : x; }
UNITVEC_FN float floor(float x) { return ::floorf(x); }
UNITVEC_FN float sqrt(float x) { return ::sqrtf(x); }
UNITVEC_FN float inversesqrt(float x) { return 1.0f / ::sqrtf(x); }
UNITVEC_FN float min(float a, float b) { return b < a ? b : a; }
UNITVEC_FN float max(float a, float b) { return a < b ? b : a; }
UNITVEC_FN int min(int a, int b) { return b < a ? b : a; }
UNITVEC_FN int max(int a, int b) { return a < b ? b : a; }
UNITVEC_FN uint min(uint a, uint b) { return b < a ? b : a; }
UNITVEC_FN uint max(uint a, uint b) { return a < b ? b : a; }
UNITVEC_FN float clamp(float x, float low, float high) { return min(max(x, low), high); }
UNITVEC_FN int clamp(int x, int low, int high) { return min(max(x, low), high); }
UNITVEC_FN uint clamp(uint x, uint low, uint high) { return min(max(x, low), high); }

// Operators and functions by component. A scalar beside a vector becomes one. UNITVEC_EACH(f) is f of each component's name.
#define UNITVEC_OF_ONE(V, name, f) friend UNITVEC_FN V name(V a) { return V(UNITVEC_EACH(f)); }
#define UNITVEC_OF_TWO(V, name, f) friend UNITVEC_FN V name(V a, V b) { return V(UNITVEC_EACH(f)); }
#define UNITVEC_BINARY(V, sign, f) \
    UNITVEC_OF_TWO(V, operator sign, f) \
    UNITVEC_FN V& operator sign##=(V b) { return *this = *this sign b; }
#define UNITVEC_FUNCTIONS(V) \
    UNITVEC_BINARY(V, +, UNITVEC_SUM) \
    UNITVEC_BINARY(V, -, UNITVEC_DIFFERENCE) \
    UNITVEC_BINARY(V, *, UNITVEC_PRODUCT) \
    UNITVEC_BINARY(V, /, UNITVEC_QUOTIENT) \
    UNITVEC_BINARY(V, &, UNITVEC_AND) \
    UNITVEC_BINARY(V, |, UNITVEC_OR) \
    UNITVEC_BINARY(V, ^, UNITVEC_XOR) \
    UNITVEC_BINARY(V, <<, UNITVEC_LEFT) \
    UNITVEC_BINARY(V, >>, UNITVEC_RIGHT) \
    UNITVEC_OF_TWO(V, min, UNITVEC_MIN) \
    UNITVEC_OF_TWO(V, max, UNITVEC_MAX) \
    UNITVEC_OF_ONE(V, operator-, UNITVEC_MINUS) \
    UNITVEC_OF_ONE(V, operator~, UNITVEC_NOT) \
    UNITVEC_OF_ONE(V, abs, UNITVEC_ABS) \
    UNITVEC_OF_ONE(V, floor, UNITVEC_FLOOR) \
    UNITVEC_OF_ONE(V, sqrt, UNITVEC_SQRT) \
    UNITVEC_OF_ONE(V, unitvec_rounded, UNITVEC_ROUNDED) \
    friend UNITVEC_FN V clamp(V x, V low, V high) { return min(max(x, low), high); } \
    friend UNITVEC_FN V<uint> floatBitsToUint(V a) { return V<uint>(UNITVEC_EACH(UNITVEC_TO_BITS)); } \
    friend UNITVEC_FN V<float> uintBitsToFloat(V a) { return V<float>(UNITVEC_EACH(UNITVEC_FROM_BITS)); } \
    friend UNITVEC_FN bool operator!=(V a, V b) { return !(a == b); }
#define UNITVEC_SUM(c) a.c + b.c
#define UNITVEC_DIFFERENCE(c) a.c - b.c
#define UNITVEC_PRODUCT(c) a.c * b.c
#define UNITVEC_QUOTIENT(c) a.c / b.c
#define UNITVEC_AND(c) a.c & b.c
#define UNITVEC_OR(c) a.c | b.c
#define UNITVEC_XOR(c) a.c ^ b.c
#define UNITVEC_LEFT(c) a.c << b.c
#define UNITVEC_RIGHT(c) a.c >> b.c
#define UNITVEC_MIN(c) min(a.c, b.c)
#define UNITVEC_MAX(c) max(a.c, b.c)
#define UNITVEC_MINUS(c) -a.c
#define UNITVEC_NOT(c) ~a.c
#define UNITVEC_ABS(c) abs(a.c)
#define UNITVEC_FLOOR(c) floor(a.c)
#define UNITVEC_SQRT(c) sqrt(a.c)
#define UNITVEC_ROUNDED(c) unitvec_rounded(a.c)
#define UNITVEC_TO_BITS(c) floatBitsToUint(a.c)
#define UNITVEC_FROM_BITS(c) uintBitsToFloat(a.c)

#define UNITVEC_EACH(f) f(x), f(y)
template <class T> struct vec2 {
    T x, y;
    vec2() = default;
    UNITVEC_FN vec2(T all) : x(all), y(all) {}
    UNITVEC_FN vec2(T first, T second) : x(first), y(second) {}
    template <class U> UNITVEC_FN explicit vec2(vec2<U> v) : x(T(v.x)), y(T(v.y)) {}
    UNITVEC_FN vec2 xy() const { return *this; }
    UNITVEC_FN vec2 yx() const { return vec2(y, x); }
    friend UNITVEC_FN bool operator==(vec2 a, vec2 b) { return a.x == b.x && a.y == b.y; }
    UNITVEC_FUNCTIONS(vec2)
};
#undef UNITVEC_EACH

#define UNITVEC_EACH(f) f(x), f(y), f(z)
template <class T> struct vec3 {
    T x, y, z;
    vec3() = default;
    UNITVEC_FN vec3(T all) : x(all), y(all), z(all) {}
    UNITVEC_FN vec3(T first, T second, T third) : x(first), y(second), z(third) {}
    UNITVEC_FN vec3(vec2<T> two, T third) : x(two.x), y(two.y), z(third) {}
    UNITVEC_FN vec3(T first, vec2<T> two) : x(first), y(two.x), z(two.y) {}
    template <class U> UNITVEC_FN explicit vec3(vec3<U> v) : x(T(v.x)), y(T(v.y)), z(T(v.z)) {}
    UNITVEC_FN vec2<T> xy() const { return vec2<T>(x, y); }
    UNITVEC_FN vec2<T> yx() const { return vec2<T>(y, x); }
    UNITVEC_FN vec3 xyz() const { return *this; }
    UNITVEC_FN vec3 xzy() const { return vec3(x, z, y); }
    UNITVEC_FN vec3 yzx() const { return vec3(y, z, x); }
    UNITVEC_FN vec3 zxy() const { return vec3(z, x, y); }
    UNITVEC_FN vec3 zyx() const { return vec3(z, y, x); }
    friend UNITVEC_FN bool operator==(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
    UNITVEC_FUNCTIONS(vec3)
};
#undef UNITVEC_EACH

#define UNITVEC_EACH(f) f(x), f(y), f(z), f(w)
template <class T> struct vec4 {
    T x, y, z, w;
    vec4() = default;
    UNITVEC_FN vec4(T all) : x(all), y(all), z(all), w(all) {}
    UNITVEC_FN vec4(T first, T second, T third, T fourth) : x(first), y(second), z(third), w(fourth) {}
    UNITVEC_FN vec4(vec3<T> three, T fourth) : x(three.x), y(three.y), z(three.z), w(fourth) {}
    UNITVEC_FN vec4(T first, vec3<T> three) : x(first), y(three.x), z(three.y), w(three.z) {}
    UNITVEC_FN vec4(vec2<T> a, vec2<T> b) : x(a.x), y(a.y), z(b.x), w(b.y) {}
    UNITVEC_FN vec4(vec2<T> a, T third, T fourth) : x(a.x), y(a.y), z(third), w(fourth) {}
    template <class U> UNITVEC_FN explicit vec4(vec4<U> v) : x(T(v.x)), y(T(v.y)), z(T(v.z)), w(T(v.w)) {}
    UNITVEC_FN vec2<T> xy() const { return vec2<T>(x, y); }
    UNITVEC_FN vec3<T> xyz() const { return vec3<T>(x, y, z); }
    UNITVEC_FN vec3<T> yzw() const { return vec3<T>(y, z, w); }
    UNITVEC_FN vec4 yzwx() const { return vec4(y, z, w, x); }
    UNITVEC_FN vec4 zwxy() const { return vec4(z, w, x, y); }
    friend UNITVEC_FN bool operator==(vec4 a, vec4 b) { return a.xy() == b.xy() && a.z == b.z && a.w == b.w; }
    UNITVEC_FN T& operator[](int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
    UNITVEC_FUNCTIONS(vec4)
};
#undef UNITVEC_EACH

typedef vec2<float> float2;
typedef vec3<float> float3;
typedef vec4<float> float4;
typedef vec2<uint> uint2;
typedef vec3<uint> uint3;
typedef vec4<uint> uint4;
typedef vec2<int> int2;
typedef vec3<int> int3;
typedef vec4<int> int4;

}

#endif
