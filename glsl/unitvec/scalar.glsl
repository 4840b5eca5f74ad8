// unitvec: what all codecs share: normalised fixed point, and what counts as a direction.
//
// Needs GLSL 4.50 or GLSL ES 3.00 (highp float and int). Use it by #include (GL_GOOGLE_include_directive) or paste it.
// Source: Cigolle et al. 2014, section 1.2.

#ifndef UNITVEC_SCALAR_GLSL
#define UNITVEC_SCALAR_GLSL

// `precise` keeps compilers from fusing and reordering, so that all devices agree on the codes. GLSL ES 3.00 lacks it.
#ifndef UNITVEC_PRECISE
#ifdef GL_ES
#define UNITVEC_PRECISE
#else
#define UNITVEC_PRECISE precise
#endif
#endif

// Largest integer of a unorm of `bits` bits (1 to 23).
float unorm_max(uint bits) {
    return float((1u << bits) - 1u);
}

// Largest integer of an snorm of `bits` bits (2 to 22).
float snorm_max(uint bits) {
    return float((1u << (bits - 1u)) - 1u);
}

// True where x is below zero by at least the least normal number, 2^-126. A comparison with zero would depend on
// whether the device flushes denormals.
bool unitvec_is_negative(float x) {
    return x <= -1.1754943508222875e-38;
}

float unitvec_negate_if(bool negative, float x) {
    return negative ? -x : x;
}

// Two's complement, in `bits` bits, of a whole number.
uint unitvec_signed_code(float whole, uint bits) {
    return uint(int(whole)) & ((1u << bits) - 1u);
}

// Integer of an snorm code as a float, with -2^(bits-1) taken as -(2^(bits-1) - 1). Bits above `bits` are ignored.
float unitvec_snorm_integer(uint code, uint bits) {
    float integer = float(int(code << (32u - bits)) >> int(32u - bits));
    return max(integer, -snorm_max(bits));
}

// Eq. 1. Ties go up. NaN gives 0 where the device compares as IEEE 754 says.
uint unorm_encode(float r, uint bits) {
    float positive = r > 0.0 ? r : 0.0;
    float clamped = positive < 1.0 ? positive : 1.0;
    UNITVEC_PRECISE float position = clamped * unorm_max(bits) + 0.5;
    // By way of int, for which more processors have an instruction. Truncates.
    return uint(int(position));
}

// Eq. 2. Bits above `bits` are ignored.
float unorm_decode(uint code, uint bits) {
    UNITVEC_PRECISE float r = float(code & ((1u << bits) - 1u)) / unorm_max(bits);
    return r;
}

// round(clamp(r, -1, 1) (2^(bits-1) - 1)) in two's complement. Ties go away from zero.
uint snorm_encode(float r, uint bits) {
    float magnitude = abs(r) > 0.0 ? abs(r) : 0.0;
    float clamped = magnitude < 1.0 ? magnitude : 1.0;
    UNITVEC_PRECISE float position = clamped * snorm_max(bits) + 0.5;
    return unitvec_signed_code(unitvec_negate_if(unitvec_is_negative(r), floor(position)), bits);
}

// clamp(i / (2^(bits-1) - 1), -1, 1). Bits above `bits` are ignored.
float snorm_decode(uint code, uint bits) {
    UNITVEC_PRECISE float r = unitvec_snorm_integer(code, bits) / snorm_max(bits);
    return r;
}

float unitvec_l1_norm(vec3 v) {
    UNITVEC_PRECISE float norm = (abs(v.x) + abs(v.y)) + abs(v.z);
    return norm;
}

// True for norms from 2^-100 to 2^100; false for zero, infinity and NaN, by a comparison of integers, since a GPU
// need not compare NaN as IEEE 754 says.
bool unitvec_is_usable(float l1_norm) {
    return floatBitsToUint(l1_norm) - 0x0d800000u < 0x64000000u;
}

// v, or +Z where v has no usable direction.
vec3 unitvec_or_z(vec3 v) {
    return unitvec_is_usable(unitvec_l1_norm(v)) ? v : vec3(0.0, 0.0, 1.0);
}

float unitvec_dot(vec3 a, vec3 b) {
    UNITVEC_PRECISE float d = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return d;
}

// v at unit length, to within 2 ULP.
vec3 unitvec_normalize(vec3 v) {
    UNITVEC_PRECISE vec3 n = v * (1.0 / sqrt(unitvec_dot(v, v)));
    return n;
}

#endif
