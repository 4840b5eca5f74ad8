// unitvec: vectors with a length, a direction's code beside the logarithm of the length.
//
//   vector32_encode(v), vector32_decode(code)   oct20p and 12 bits of length, 128 steps an octave: 2^-16 to 2^15.98
//   vector48_encode(v), vector48_decode(code)   oct32p and 16 bits, 2048 steps; codes are uvec2, low word first
//
// Beside any other codec of directions, with lengths near 2^(low + i / steps):
//
//   code_of_length(v, bits, steps, low)      0 for the zero vector, else i + 1, of i from 0
//   length_of_code(code, bits, steps, low)   that length; steps is a power of two to 2048, low from -62, 2^62 the most
//   with_reach(v)                            the vector to encode: v or, if its components are huge, a shorter one
//
// Zero is exact, and so are powers of two along the axes. Greater lengths, infinite ones too, count as the greatest,
// lesser ones as the least or, below half of it, as 0. A vector with NaN is 0.

#ifndef UNITVEC_WITH_LENGTH_GLSL
#define UNITVEC_WITH_LENGTH_GLSL

#ifndef UNITVEC_OCT_GLSL
#include "oct.glsl"
#endif

precision highp float;
precision highp int;

// With f the part beyond a power of two, log2(1 + f) = f + f (1 - f) (a + f (b + ...)), within 2.3e-6.
const float UNITVEC_LOG_0 = 0.44254494;
const float UNITVEC_LOG_1 = -0.2756003;
const float UNITVEC_LOG_2 = 0.18194889;
const float UNITVEC_LOG_3 = -0.09595646;
const float UNITVEC_LOG_4 = 0.02584145;

// 2^g = 1 + g - g (1 - g) (a + g (b + ...)), g in [0, 1], within 9.3e-8.
const float UNITVEC_EXP_0 = 0.30684826;
const float UNITVEC_EXP_1 = 0.06668899;
const float UNITVEC_EXP_2 = 0.010870314;
const float UNITVEC_EXP_3 = 0.0018793186;

// Vectors of an L1 norm from here on, 2^64, are longer than any range.
const float UNITVEC_FAR = 18446744073709551616.0;

// The logarithm of x to the base of two, for positive normal x.
float unitvec_log2(float x) {
    uint bits = floatBitsToUint(x);
    float whole = float(int(bits >> 23u) - 127);
    UNITVEC_PRECISE float f = uintBitsToFloat((bits & 0x7fffffu) | 0x3f800000u) - 1.0;
    UNITVEC_PRECISE float polynomial =
        UNITVEC_LOG_0 + f * (UNITVEC_LOG_1 + f * (UNITVEC_LOG_2 + f * (UNITVEC_LOG_3 + f * UNITVEC_LOG_4)));
    UNITVEC_PRECISE float logarithm = whole + (f + (f * (1.0 - f)) * polynomial);
    return logarithm;
}

uint code_of_length(vec3 v, uint bits, uint steps, int low) {
    float norm = unitvec_l1_norm(v);
    vec3 scaled = unitvec_scaled_to_one(v, norm);
    // Half the logarithm of the square.
    UNITVEC_PRECISE float rest = unitvec_log2(unitvec_dot(scaled, scaled)) * (0.5 * float(steps));
    UNITVEC_PRECISE float sum = rest + UNITVEC_ONE_AND_A_HALF_2_23;
    int nearest = int(floatBitsToUint(sum) - floatBitsToUint(UNITVEC_ONE_AND_A_HALF_2_23));
    int octaves = int(floatBitsToUint(norm) >> 23u) - 127 - low;
    int i = octaves * int(steps) + nearest;

    int most = int(unitvec_mask(bits)) - 1;
    int reached = i > most || floatBitsToUint(norm) >= floatBitsToUint(UNITVEC_FAR) ? most : i;
    bool is_zero = reached < -int(steps) || floatBitsToUint(norm) < floatBitsToUint(UNITVEC_MIN_NORM) ||
        unitvec_is_nan(norm);
    int inside = reached < 0 ? 0 : reached;
    return is_zero ? 0u : uint(inside) + 1u;
}

float length_of_code(uint code, uint bits, uint steps, int low) {
    uint field = code & unitvec_mask(bits);
    uint i = field - 1u;
    int octave_bits = int(floatBitsToUint(float(steps)) >> 23u) - 127;
    UNITVEC_PRECISE float g = float(i & (steps - 1u)) * unitvec_exp2(-octave_bits);
    UNITVEC_PRECISE float polynomial =
        UNITVEC_EXP_0 + g * (UNITVEC_EXP_1 + g * (UNITVEC_EXP_2 + g * UNITVEC_EXP_3));
    UNITVEC_PRECISE float part = (1.0 + g) - (g * (1.0 - g)) * polynomial;
    UNITVEC_PRECISE float found = part * unitvec_exp2(low + int(i >> uint(octave_bits)));
    return field == 0u ? 0.0 : found;
}

// x, or the largest float of its sign for infinity.
float unitvec_finite(float x) {
    uint magnitude = min(floatBitsToUint(x) & ~UNITVEC_SIGN_BIT, 0x7f7fffffu);
    return unitvec_with_sign(uintBitsToFloat(magnitude), x);
}

vec3 with_reach(vec3 v) {
    vec3 finite = vec3(unitvec_finite(v.x), unitvec_finite(v.y), unitvec_finite(v.z));
    UNITVEC_PRECISE vec3 shorter = finite * 5.421010862427522e-20;
    return floatBitsToUint(unitvec_l1_norm(v)) < floatBitsToUint(UNITVEC_FAR) ? v : shorter;
}

// A decoded direction with its length: +0 for the zero vector.
vec3 unitvec_lengthened(vec3 direction, float len) {
    UNITVEC_PRECISE vec3 v = direction * len;
    return len > 0.0 ? v : vec3(0.0);
}

uint vector32_encode(vec3 v) {
    uint len = code_of_length(v, 12u, 128u, -16);
    uint code = oct20p_encode(with_reach(v)) | (len << 20u);
    return len == 0u ? 0u : code;
}

uvec2 vector48_encode(vec3 v) {
    uint len = code_of_length(v, 16u, 2048u, -16);
    uint code = oct32p_encode(with_reach(v));
    return uvec2(len == 0u ? 0u : code, len);
}

vec3 vector32_decode(uint code) {
    return unitvec_lengthened(oct20_decode(code), length_of_code(code >> 20u, 12u, 128u, -16));
}

vec3 vector48_decode(uvec2 code) {
    return unitvec_lengthened(oct32_decode(code.x), length_of_code(code.y, 16u, 2048u, -16));
}

#endif
