// The operations of SPIR-V on floats, words and truth values, and on vectors of them, as functions of their names, for the
// kernels that cuda.rs prints. A word is unsigned; operations on signed integers see it so. FAddRounded and its like are
// operations with NoContraction: the compiler does not fuse them.

typedef unsigned int uint;

#define FN __device__ __forceinline__

template <class T, int N> struct alignas(N == 2 ? 2 * sizeof(T) : N == 4 ? 4 * sizeof(T) : sizeof(T)) vec { T c[N]; };
template <class T, int N> struct array { T c[N]; };

#define ONE(name, R, A, result) \
    FN R name(A a) { return result; } \
    template <int N> FN vec<R, N> name(vec<A, N> a) { \
        vec<R, N> r; \
        for (int i = 0; i < N; ++i) r.c[i] = name(a.c[i]); \
        return r; \
    }
#define TWO(name, R, A, result) \
    FN R name(A a, A b) { return result; } \
    template <int N> FN vec<R, N> name(vec<A, N> a, vec<A, N> b) { \
        vec<R, N> r; \
        for (int i = 0; i < N; ++i) r.c[i] = name(a.c[i], b.c[i]); \
        return r; \
    }
#define THREE(name, R, A, result) \
    FN R name(A a, A b, A c) { return result; } \
    template <int N> FN vec<R, N> name(vec<A, N> a, vec<A, N> b, vec<A, N> c) { \
        vec<R, N> r; \
        for (int i = 0; i < N; ++i) r.c[i] = name(a.c[i], b.c[i], c.c[i]); \
        return r; \
    }

TWO(FAdd, float, float, a + b)
TWO(FSub, float, float, a - b)
TWO(FMul, float, float, a * b)
TWO(FDiv, float, float, a / b)
TWO(FAddRounded, float, float, __fadd_rn(a, b))
TWO(FSubRounded, float, float, __fsub_rn(a, b))
TWO(FMulRounded, float, float, __fmul_rn(a, b))
ONE(FNegate, float, float, -a)
ONE(FAbs, float, float, fabsf(a))
ONE(FSign, float, float, a > 0.0f ? 1.0f : a < 0.0f ? -1.0f : 0.0f)
TWO(FMax, float, float, fmaxf(a, b))
TWO(FMin, float, float, fminf(a, b))
THREE(FClamp, float, float, fminf(fmaxf(a, b), c))
ONE(Floor, float, float, floorf(a))
ONE(Fract, float, float, a - floorf(a))
ONE(Round, float, float, rintf(a))
ONE(Sqrt, float, float, sqrtf(a))
ONE(InverseSqrt, float, float, rsqrtf(a))
THREE(Fma, float, float, fmaf(a, b, c))
ONE(Sin, float, float, __sinf(a))
ONE(Cos, float, float, __cosf(a))
ONE(Acos, float, float, acosf(a))
TWO(Atan2, float, float, atan2f(a, b))
TWO(FOrdEqual, bool, float, a == b)
TWO(FOrdLessThan, bool, float, a < b)
TWO(FOrdGreaterThan, bool, float, a > b)
TWO(FOrdLessThanEqual, bool, float, a <= b)
TWO(FOrdGreaterThanEqual, bool, float, a >= b)

TWO(IAdd, uint, uint, a + b)
TWO(ISub, uint, uint, a - b)
TWO(IMul, uint, uint, a * b)
TWO(UDiv, uint, uint, a / b)
TWO(UMod, uint, uint, a % b)
ONE(SNegate, uint, uint, 0u - a)
ONE(SAbs, uint, uint, uint(abs(int(a))))
TWO(SMax, uint, uint, uint(max(int(a), int(b))))
TWO(SMin, uint, uint, uint(min(int(a), int(b))))
TWO(UMax, uint, uint, max(a, b))
TWO(UMin, uint, uint, min(a, b))
TWO(BitwiseAnd, uint, uint, a & b)
TWO(BitwiseOr, uint, uint, a | b)
TWO(BitwiseXor, uint, uint, a ^ b)
ONE(Not, uint, uint, ~a)
TWO(ShiftLeftLogical, uint, uint, a << b)
TWO(ShiftRightLogical, uint, uint, a >> b)
TWO(ShiftRightArithmetic, uint, uint, uint(int(a) >> b))
THREE(BitFieldUExtract, uint, uint, a << (32u - b - c) >> (32u - c))
THREE(BitFieldSExtract, uint, uint, uint(int(a << (32u - b - c)) >> (32u - c)))
TWO(IEqual, bool, uint, a == b)
TWO(INotEqual, bool, uint, a != b)
TWO(ULessThan, bool, uint, a < b)
TWO(UGreaterThan, bool, uint, a > b)
TWO(UGreaterThanEqual, bool, uint, a >= b)
TWO(ULessThanEqual, bool, uint, a <= b)
TWO(SLessThan, bool, uint, int(a) < int(b))
TWO(SGreaterThan, bool, uint, int(a) > int(b))
TWO(SLessThanEqual, bool, uint, int(a) <= int(b))
TWO(SGreaterThanEqual, bool, uint, int(a) >= int(b))
ONE(ConvertFToS, uint, float, uint(int(a)))
ONE(ConvertFToU, uint, float, uint(a))
ONE(ConvertSToF, float, uint, float(int(a)))
ONE(ConvertUToF, float, uint, float(a))

TWO(LogicalAnd, bool, bool, a && b)
TWO(LogicalOr, bool, bool, a || b)
TWO(LogicalNotEqual, bool, bool, a != b)
TWO(LogicalEqual, bool, bool, a == b)
ONE(LogicalNot, bool, bool, !a)

template <int N> FN bool All(vec<bool, N> a) {
    bool all = true;
    for (int i = 0; i < N; ++i) all = all && a.c[i];
    return all;
}

template <class T> FN T Select(bool chosen, T a, T b) { return chosen ? a : b; }
template <class T, int N> FN vec<T, N> Select(vec<bool, N> chosen, vec<T, N> a, vec<T, N> b) {
    for (int i = 0; i < N; ++i) a.c[i] = chosen.c[i] ? a.c[i] : b.c[i];
    return a;
}

template <class T, class A> FN T Bitcast(A a) {
    T bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

template <int N> FN vec<float, N> VectorTimesScalar(vec<float, N> a, float b) {
    for (int i = 0; i < N; ++i) a.c[i] = a.c[i] * b;
    return a;
}
template <int N> FN vec<float, N> VectorTimesScalarRounded(vec<float, N> a, float b) {
    for (int i = 0; i < N; ++i) a.c[i] = __fmul_rn(a.c[i], b);
    return a;
}
template <int N> FN float Dot(vec<float, N> a, vec<float, N> b) {
    float sum = a.c[0] * b.c[0];
    for (int i = 1; i < N; ++i) sum += a.c[i] * b.c[i];
    return sum;
}
template <int N> FN float Length(vec<float, N> a) { return sqrtf(Dot(a, a)); }
template <int N> FN vec<float, N> Normalize(vec<float, N> a) { return VectorTimesScalar(a, rsqrtf(Dot(a, a))); }
FN vec<float, 3> Cross(vec<float, 3> a, vec<float, 3> b) {
    return {a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2], a.c[0] * b.c[1] - a.c[1] * b.c[0]};
}

// N components of 32 / N bits, `most` the greatest; from 0 or from -1.
template <int N> FN uint packed(vec<float, N> a, float low, float most) {
    uint code = 0;
    for (int i = 0; i < N; ++i) {
        uint bits = uint(__float2int_rn(fminf(fmaxf(a.c[i], low), 1.0f) * most));
        code |= (bits & (0xffffffffu >> (32 - 32 / N))) << (32 / N * i);
    }
    return code;
}
template <int N> FN vec<float, N> snorm(uint code, float most) {
    vec<float, N> r;
    for (int i = 0; i < N; ++i) r.c[i] = fmaxf(float(int(code << (32 - 32 / N * (i + 1))) >> (32 - 32 / N)) / most, -1.0f);
    return r;
}
template <int N> FN vec<float, N> unorm(uint code, float most) {
    vec<float, N> r;
    for (int i = 0; i < N; ++i) r.c[i] = float(code << (32 - 32 / N * (i + 1)) >> (32 - 32 / N)) / most;
    return r;
}
FN uint PackSnorm2x16(vec<float, 2> a) { return packed(a, -1.0f, 32767.0f); }
FN uint PackSnorm4x8(vec<float, 4> a) { return packed(a, -1.0f, 127.0f); }
FN uint PackUnorm2x16(vec<float, 2> a) { return packed(a, 0.0f, 65535.0f); }
FN uint PackUnorm4x8(vec<float, 4> a) { return packed(a, 0.0f, 255.0f); }
FN vec<float, 2> UnpackSnorm2x16(uint code) { return snorm<2>(code, 32767.0f); }
FN vec<float, 4> UnpackSnorm4x8(uint code) { return snorm<4>(code, 127.0f); }
FN vec<float, 2> UnpackUnorm2x16(uint code) { return unorm<2>(code, 65535.0f); }
FN vec<float, 4> UnpackUnorm4x8(uint code) { return unorm<4>(code, 255.0f); }
