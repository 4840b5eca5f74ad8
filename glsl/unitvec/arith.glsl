// unitvec: the arithmetic that the codecs share, in one file, so that a shader needs no other than a codec's own.
//
// Needs GLSL 3.30 or GLSL ES 3.00. Include it (GL_GOOGLE_include_directive), or take the families from
// glsl/flat, where nothing is included. Besides the functions that the heads of the files name, all names at the top
// level begin with unitvec (in any case).
//
// In GLSL ES every file sets the default precision of float and int to highp. Lower it, if you must, after the last
// file. Without `precise` (before GLSL 4.00 and GLSL ES 3.20, and in naga) a compiler may give other codes where a
// direction is nearly as far from two of them.
//
// The functions are those of the Rust crate's modules `arith` and `direction`, in their order. They repeat the crate's
// operations, so that all devices give the same bits: the built-in trigonometry does not. `floor`, `max` and
// `min` are GLSL's own.
//
//   unitvec_unorm_encode(r, bits), unitvec_unorm_decode(code, bits)    normalised fixed point (Cigolle et al. 2014,
//   unitvec_snorm_encode(r, bits), unitvec_snorm_decode(code, bits)    section 1.2)
//   unitvec_half_encode(x), unitvec_half_decode(code)  half floats: nearest, ties to even
//   unitvec_sin_cos_half_turns(t)      vec2(cos(pi t), sin(pi t)), any finite t
//   unitvec_from_diagonal(d)           vec2(cos(d pi/2), sin(d pi/2)) / sqrt(2), d in [-1/2, 1/2]
//   unitvec_atan2_half_turns(y, x)     angle of (x, y), -1 to 1; 0 without a direction
//   unitvec_atan_octant_ratio(y, x)    4/pi atan(y/x), 0 <= y <= x
//   unitvec_atan_octant(r)             4/pi atan(r), r in [0, 1]
//   unitvec_tan_octant(t)              tan(pi t / 4), t in [0, 1]
//   unitvec_asin_half_turns(x)         asin(x) / pi, x clamped to [-1, 1]
//   unitvec_acos_half_turns(x)         acos(x) / pi, x clamped to [-1, 1]
//   unitvec_sin_cos(x), unitvec_sin, unitvec_cos, unitvec_atan2, unitvec_asin, unitvec_acos    in radians
//
// Angles are in half turns of pi radians: reduction to the first octant is exact, the axes and diagonals are exact, and
// -1 to 1 is the range of an snorm. Magnitudes below 2^-100 count as 0; no result is -0 or denormal. The Rust crate's
// documentation has the errors, and the results for bad input.

#ifndef UNITVEC_ARITH_GLSL
#define UNITVEC_ARITH_GLSL

precision highp float;
precision highp int;

// `precise` keeps compilers from fusing and reordering: devices then differ by their divisions and roots alone.
#ifndef UNITVEC_PRECISE
#if __VERSION__ < 320 || (__VERSION__ < 400 && !defined(GL_ES))
#define UNITVEC_PRECISE
#else
#define UNITVEC_PRECISE precise
#endif
#endif

// The least normal number, 2^-126.
const float UNITVEC_MIN_POSITIVE = 1.1754943508222875e-38;

// sign: signs that do not depend on how a device treats denormals and -0.

const uint UNITVEC_SIGN_BIT = 0x80000000u;

// True where x is below zero by at least the least normal number. A comparison with zero would depend on whether the
// device flushes denormals.
bool unitvec_is_negative(float x) {
    return x <= -UNITVEC_MIN_POSITIVE;
}

float unitvec_negate_if(bool negative, float x) {
    return negative ? -x : x;
}

// -x where negative, else x, for x of at least 0; 0 stays +0.
float unitvec_negate_positive(bool negative, float x) {
    return unitvec_negate_if(negative && x > 0.0, x);
}

// `magnitude`, of at least 0, with the sign bit of y.
float unitvec_with_sign(float magnitude, float y) {
    return uintBitsToFloat(floatBitsToUint(magnitude) | (floatBitsToUint(y) & UNITVEC_SIGN_BIT));
}

// -x where sign_bit is UNITVEC_SIGN_BIT, x where it is 0.
float unitvec_flip_sign(float x, uint sign_bit) {
    return uintBitsToFloat(floatBitsToUint(x) ^ sign_bit);
}

// round: rounding to whole numbers, and whole numbers as integers.

// Its sums with numbers of at most 2^22 are whole; their low 22 bits are the two's complement.
const float UNITVEC_ONE_AND_A_HALF_2_23 = 12582912.0;

// Its sums with numbers of 0 to 2^23 are whole; their low 23 bits are the number.
const float UNITVEC_2_23 = 8388608.0;

// The integer part of a number from 0 to 2^31. It goes through int, for which more processors have an instruction.
uint unitvec_whole_to_u32(float whole) {
    return uint(int(whole));
}

// The nearest whole numbers, the even one of two, for magnitudes up to 2^21.
vec2 unitvec_nearest_whole(vec2 x) {
    UNITVEC_PRECISE vec2 whole = (x + UNITVEC_ONE_AND_A_HALF_2_23) - UNITVEC_ONE_AND_A_HALF_2_23;
    return whole;
}

// scale: powers of two, and vectors scaled by them.

// 2^-100: angles and parts of a vector of about unit length that are less count as 0.
const float UNITVEC_NEGLIGIBLE = 7.888609052210118e-31;
// 2^100: larger numbers have no meaning as an angle or a part.
const float UNITVEC_ENORMOUS = 1.2676506002282294e30;

// 2 to the power `exponent`, -126 to 127.
float unitvec_exp2(int exponent) {
    return uintBitsToFloat(uint(127 + exponent) << 23u);
}

// True where x is `least` or more and below `end`, both positive. False for NaN: the comparison is one of integers,
// since a GPU need not compare NaN as IEEE 754 says.
bool unitvec_is_within(float x, float least, float end) {
    uint first = floatBitsToUint(least);
    return floatBitsToUint(x) - first < floatBitsToUint(end) - first;
}

// The power of two that scales a usable L1 norm to 1 to 2, exactly. The result for other norms has no meaning.
float unitvec_scale_to_one(float l1_norm) {
    return uintBitsToFloat((254u << 23u) - (floatBitsToUint(l1_norm) & 0x7f800000u));
}

// x, or 0 where x is a denormal, which some devices flush.
float unitvec_without_denormal(float x) {
    return abs(x) < UNITVEC_MIN_POSITIVE ? 0.0 : x;
}

// v with denormal components as 0: scaled up they could be large beside the others of a short vector.
vec3 unitvec_without_denormals(vec3 v) {
    return vec3(unitvec_without_denormal(v.x), unitvec_without_denormal(v.y), unitvec_without_denormal(v.z));
}

// v, denormal components as 0, scaled by a power of two that takes its L1 norm to 1 to 2.
vec3 unitvec_scaled_to_one(vec3 v, float l1_norm) {
    UNITVEC_PRECISE vec3 scaled = unitvec_without_denormals(v) * unitvec_scale_to_one(l1_norm);
    return scaled;
}

// divide: the only divisions and square roots of floats. GPUs round them badly; where UNITVEC_EXACT is defined (in other
// languages: in the exact edition), integers put them right: the results are rounded to nearest, elsewhere as the device
// rounds. The Rust crate's arith/exact.rs derives how.

const uint UNITVEC_EXACT_BELOW = 32u;
const uint UNITVEC_EXACT_HIDDEN = 0x800000u;
const uint UNITVEC_EXACT_EXPONENT = 0x7f800000u;
const uint UNITVEC_EXACT_SIGNIFICAND = 0xffffffu;
// The bits of 2^-1.
const uint UNITVEC_EXACT_HALF = 0x3f000000u;

uint unitvec_exact_significand(uint bits) {
    return (bits & (UNITVEC_EXACT_HIDDEN - 1u)) | UNITVEC_EXACT_HIDDEN;
}

// The whole number nearest to dividend / divisor, from a guess that is 1 to 64 less; minus_part is about -1 / divisor.
uint unitvec_exact_nearest(uint dividend, uint guess, uint divisor, float minus_part) {
    int excess = int(guess * divisor - dividend);
    UNITVEC_PRECISE float step_up = float(excess) * minus_part;
    uint near = (guess + uint(int(step_up))) & UNITVEC_EXACT_SIGNIFICAND;
    uint rest = near * divisor - dividend;
    return near + (((rest << 1u) + divisor) >> 31u);
}

// a / b, a of 0 or more and b positive.
float unitvec_exact_quotient(float a, float b) {
    uint dividend = unitvec_exact_significand(floatBitsToUint(a));
    uint divisor = unitvec_exact_significand(floatBitsToUint(b));
    uint less = dividend < divisor ? 1u : 0u;
    uint exponent = floatBitsToUint(b) & UNITVEC_EXACT_EXPONENT;
    UNITVEC_PRECISE float inverse = 1.0 / b;
    UNITVEC_PRECISE float rough = a * inverse;
    // The bits of the power of two below the quotient, less the hidden one.
    uint first = (floatBitsToUint(a) & UNITVEC_EXACT_EXPONENT) + (UNITVEC_EXACT_HALF - (less << 23u)) - exponent;
    uint guess = (floatBitsToUint(rough) - first - UNITVEC_EXACT_BELOW) & UNITVEC_EXACT_SIGNIFICAND;
    // About -1 over the divisor.
    uint minus_part = floatBitsToUint(inverse) + exponent + (UNITVEC_SIGN_BIT - (150u << 23u));
    uint found = unitvec_exact_nearest(dividend << (23u + less), guess, divisor, uintBitsToFloat(minus_part));
    return rough < UNITVEC_NEGLIGIBLE ? 0.0 : uintBitsToFloat(first + found);
}

// `near`, or the next float where the top bit of remainder is set.
float unitvec_exact_next_if(float near, uint remainder) {
    return uintBitsToFloat(floatBitsToUint(near) + (remainder >> 31u));
}

// m / b, both positive and m a constant, from about 1 / b.
float unitvec_exact_over(float m, float b, float inverse) {
    uint m_bits = floatBitsToUint(m);
    uint b_bits = floatBitsToUint(b);
    if ((unitvec_exact_significand(m_bits) << 23u) != 0u) return unitvec_exact_quotient(m, b);
    // A part of 2^-18 more, so that the start is above the result.
    UNITVEC_PRECISE float rough = (m * 1.000003814697265625) * inverse;
    uint divisor = unitvec_exact_significand(b_bits);
    float excess = float(int(unitvec_exact_significand(floatBitsToUint(rough)) * divisor));
    // The exponents of b and of the start add up to that of m, or to one less.
    uint is_even = (m_bits ^ b_bits ^ floatBitsToUint(rough)) & UNITVEC_EXACT_HIDDEN;
    // A part of 2^-8 more than it is: so one comparison is enough.
    float minus_step = uintBitsToFloat((m_bits & UNITVEC_EXACT_EXPONENT) + (0xbf808000u - (174u << 23u)));
    UNITVEC_PRECISE float near =
        rough + (excess * minus_step) * uintBitsToFloat(floatBitsToUint(inverse) + is_even);
    uint rest = unitvec_exact_significand(floatBitsToUint(near)) * divisor;
    return unitvec_exact_next_if(near, (rest << 1u) + divisor);
}

// The root of normal x, from about 1 / sqrt(x).
float unitvec_exact_root(float x, float inverse) {
    uint bits = floatBitsToUint(x);
    uint exponent = ((bits + 0x3f800000u) >> 1u) & (UNITVEC_EXACT_EXPONENT | UNITVEC_SIGN_BIT);
    uint square = bits << (24u - ((bits >> 23u) & 1u));
    UNITVEC_PRECISE float rough = x * inverse;
    uint guess = (floatBitsToUint(rough) - exponent + (UNITVEC_EXACT_HIDDEN - UNITVEC_EXACT_BELOW))
        & UNITVEC_EXACT_SIGNIFICAND;
    int remainder = int(square - guess * guess);
    float half_part = uintBitsToFloat(floatBitsToUint(inverse) + exponent - (151u << 23u));
    UNITVEC_PRECISE float step_up = float(remainder) * half_part;
    uint near = (guess + uint(int(step_up))) & UNITVEC_EXACT_SIGNIFICAND;
    int left = int(square - near * near);
    uint found = near + (left > int(near) ? 1u : 0u);
    return uintBitsToFloat(exponent + found - UNITVEC_EXACT_HIDDEN);
}

// 1 over the root of x, which is from 1 + 2^-17 to 2 - 2^-16 times unit, a power of two.
float unitvec_exact_inverse_root_near(float x, float unit) {
    uint bits = floatBitsToUint(x);
    // The significand of x times 2^23, or 2^24 in the upper half of the range.
    uint square = bits << (((bits >> 23u) - (2u * (floatBitsToUint(unit) >> 23u) - 150u)) & 31u);
    float inverse = inversesqrt(x);
    UNITVEC_PRECISE float rough = x * inverse;
    uint guess = unitvec_exact_significand(floatBitsToUint(rough));
    float excess = float(int(guess * guess + (guess - square)));
    // The reciprocal times 2^-47, by integers: no compiler takes out a common factor, which would round twice.
    uint half_places = floatBitsToUint(inverse) - (47u << 23u);
    UNITVEC_PRECISE float unit_squared = unit * unit;
    uint of_square = half_places + (floatBitsToUint(unit_squared) - 0x3f800000u);
    UNITVEC_PRECISE float near = rough - excess * uintBitsToFloat(of_square);
    guess = unitvec_exact_significand(floatBitsToUint(near));
    float root = unitvec_exact_next_if(near, guess * guess + (guess - square));

    uint divisor = unitvec_exact_significand(floatBitsToUint(root));
    excess = float(int(unitvec_exact_significand(floatBitsToUint(inverse)) * divisor + (divisor >> 1u)));
    UNITVEC_PRECISE float result = inverse - excess * uintBitsToFloat(half_places);
    guess = unitvec_exact_significand(floatBitsToUint(result));
    return unitvec_exact_next_if(result, guess * divisor + (divisor >> 1u));
}

// a / b for a of 0 or more, positive b below 2^126, and a quotient below 2^127. Numbers are normal or 0; quotients below
// 2^-100 may be 0.
float unitvec_quotient(float a, float b) {
#ifdef UNITVEC_EXACT
    return unitvec_exact_quotient(a, b);
#else
    UNITVEC_PRECISE float quotient = a / b;
    return quotient;
#endif
}

// unitvec_quotient for numbers of either sign.
float unitvec_signed_quotient(float a, float b) {
#ifdef UNITVEC_EXACT
    uint sign_bit = (floatBitsToUint(a) ^ floatBitsToUint(b)) & UNITVEC_SIGN_BIT;
    return unitvec_flip_sign(unitvec_exact_quotient(abs(a), abs(b)), sign_bit);
#else
    UNITVEC_PRECISE float quotient = a / b;
    return quotient;
#endif
}

// m / b, for b from 2^-100 to 2^94 and a positive constant m; cheaper where m has up to 15 bits.
float unitvec_over(float m, float b) {
#ifdef UNITVEC_EXACT
    UNITVEC_PRECISE float inverse = 1.0 / b;
    return unitvec_exact_over(m, b, inverse);
#else
    UNITVEC_PRECISE float quotient = m / b;
    return quotient;
#endif
}

// 1 / b, for b from 2^-100 to 2^94.
float unitvec_reciprocal(float b) {
    return unitvec_over(1.0, b);
}

// The square root of x, +0 or positive and finite; of denormals it may be 0.
float unitvec_root(float x) {
#ifdef UNITVEC_EXACT
    return floatBitsToUint(x) < UNITVEC_EXACT_HIDDEN ? 0.0 : unitvec_exact_root(x, inversesqrt(x));
#else
    UNITVEC_PRECISE float found = sqrt(x);
    return found;
#endif
}

// 1 / unitvec_root(x) for positive normal x.
float unitvec_inverse_root(float x) {
#ifdef UNITVEC_EXACT
    float inverse = inversesqrt(x);
    return unitvec_exact_over(1.0, unitvec_exact_root(x, inverse), inverse);
#else
    UNITVEC_PRECISE float inverse = 1.0 / sqrt(x);
    return inverse;
#endif
}

// pack: integers in the low bits of words.

// The low `bits` bits (1 to 31) set.
uint unitvec_mask(uint bits) {
    return (1u << bits) - 1u;
}

// Two's complement, in `bits` bits, of a whole number.
uint unitvec_signed_code(float whole, uint bits) {
    return uint(int(whole)) & unitvec_mask(bits);
}

// Two's complement, in `bits` bits (at most 22), of the whole number nearest to x, the even one of two: one addition rounds
// and converts. Magnitudes up to 2^21; for others, and NaN, any code.
uint unitvec_nearest_code(float x, uint bits) {
    UNITVEC_PRECISE float sum = x + UNITVEC_ONE_AND_A_HALF_2_23;
    return floatBitsToUint(sum) & unitvec_mask(bits);
}

// The integer of the `bits` bits of a code from bit `first` on, in two's complement.
int unitvec_signed_field(uint code, uint first, uint bits) {
#if __VERSION__ >= 400 || (defined(GL_ES) && __VERSION__ >= 310)
    return bitfieldExtract(int(code), int(first), int(bits));
#else
    return int(code << (32u - bits - first)) >> int(32u - bits);
#endif
}

// Integer of the low `bits` bits (2 to 25) of a code, in two's complement.
float unitvec_signed_integer(uint code, uint bits) {
    return float(unitvec_signed_field(code, 0u, bits));
}

// The nearest whole numbers to those of e as one code: x in the low `bits` bits (at most 16), y in the next.
uint unitvec_nearest_pair(vec2 e, uint bits) {
    return unitvec_nearest_code(e.x, bits) | (unitvec_nearest_code(e.y, bits) << bits);
}

// snorm: normalised fixed point.

// Largest integer of a unorm of `bits` bits (1 to 23).
float unitvec_unorm_max(uint bits) {
    return float(unitvec_mask(bits));
}

// Largest integer of an snorm of `bits` bits (2 to 24).
float unitvec_snorm_max(uint bits) {
    return float(unitvec_mask(bits - 1u));
}

// 1 / unitvec_snorm_max(bits), the nearest float: by integers, since devices need not divide floats exactly.
float unitvec_snorm_reciprocal(uint bits) {
    uint m = unitvec_mask(bits - 1u);
    return uintBitsToFloat(((128u - bits) << 23u) + (8388608u + m / 2u) / m);
}

// x / unitvec_snorm_max(bits), rounded correctly on every device, for whole x (2 to 24 bits). With h = 2^(1 - bits), 1 / m is
// h + h / m, or h + h^2 + h^2 / m, whose products with x are exact but for the last.
float unitvec_snorm_part(float x, uint bits) {
    float h = unitvec_exp2(1 - int(bits));
    bool few = bits <= 11u;
    UNITVEC_PRECISE float high = few ? h + h * h : h;
    UNITVEC_PRECISE float low = (few ? h * h : h) * unitvec_snorm_reciprocal(bits);
    UNITVEC_PRECISE float quotient = x * high + x * low;
    return quotient;
}

// x / unitvec_snorm_max(bits), for whole x. The exact edition multiplies, which is cheaper than a quotient put right.
float unitvec_snorm_quotient(float x, uint bits) {
#ifdef UNITVEC_EXACT
    return unitvec_snorm_part(x, bits);
#else
    UNITVEC_PRECISE float quotient = x / unitvec_snorm_max(bits);
    return quotient;
#endif
}

// unitvec_snorm_quotient for vectors, with xy_bits and z_bits.
vec3 unitvec_snorm_quotients(vec3 e, uint xy_bits, uint z_bits) {
    return vec3(unitvec_snorm_quotient(e.x, xy_bits), unitvec_snorm_quotient(e.y, xy_bits),
        unitvec_snorm_quotient(e.z, z_bits));
}

// True for NaN, by comparing integers: see unitvec_is_within.
bool unitvec_is_nan(float x) {
    return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u;
}

// Eq. 1, for up to 23 bits and r that is not NaN; NaN gives any code. Ties go to the even integer.
uint unitvec_unorm_code(float r, uint bits) {
    UNITVEC_PRECISE float sum = min(max(r, 0.0), 1.0) * unitvec_unorm_max(bits) + UNITVEC_2_23;
    return floatBitsToUint(sum) & unitvec_mask(bits);
}

// Eq. 1 for any r: NaN gives 0.
uint unitvec_unorm_encode(float r, uint bits) {
    return unitvec_is_nan(r) ? 0u : unitvec_unorm_code(r, bits);
}

// Eq. 2. Bits above `bits` are ignored.
float unitvec_unorm_decode(uint code, uint bits) {
    return unitvec_snorm_quotient(float(code & unitvec_mask(bits)), bits + 1u);
}

// round(clamp(r, -1, 1) (2^(bits-1) - 1)) in two's complement, for up to 22 bits and r that is not NaN; NaN gives any
// code. Ties go to the even integer.
uint unitvec_snorm_code(float r, uint bits) {
    UNITVEC_PRECISE float position = min(max(r, -1.0), 1.0) * unitvec_snorm_max(bits);
    return unitvec_nearest_code(position, bits);
}

// unitvec_snorm_code for any r: NaN gives 0.
uint unitvec_snorm_encode(float r, uint bits) {
    return unitvec_is_nan(r) ? 0u : unitvec_snorm_code(r, bits);
}

// Integer of the snorm in the `bits` bits of a code from bit `first` on, as a float, with -2^(bits-1) taken as
// -(2^(bits-1) - 1).
float unitvec_snorm_field(uint code, uint first, uint bits) {
    return max(float(unitvec_signed_field(code, first, bits)), -unitvec_snorm_max(bits));
}

// Integer of the snorm in the low `bits` bits, with -2^(bits-1) taken as -(2^(bits-1) - 1).
float unitvec_snorm_integer(uint code, uint bits) {
    return unitvec_snorm_field(code, 0u, bits);
}

// The integers of a code of two snorms of `bits` bits: x in the low bits, y in the next.
vec2 unitvec_snorm_integers(uint code, uint bits) {
    return vec2(unitvec_snorm_field(code, 0u, bits), unitvec_snorm_field(code, bits, bits));
}

// Both components clamped to [-1, 1]; 0 where one is NaN.
vec2 unitvec_snorm_clamp(vec2 e) {
    return unitvec_is_nan(abs(e.x) + abs(e.y)) ? vec2(0.0) : clamp(e, -1.0, 1.0);
}

// Maps [-1, 1] to [0, 1], for a UNORM format.
vec2 unitvec_biased(vec2 e) {
    UNITVEC_PRECISE vec2 on_unorm = e * 0.5 + 0.5;
    return on_unorm;
}

// The inverse of unitvec_biased.
vec2 unitvec_unbiased(vec2 e) {
    UNITVEC_PRECISE vec2 on_snorm = e * 2.0 - 1.0;
    return on_snorm;
}

// True for a number that stands for a set bit: 1/2 and more. False for NaN.
bool unitvec_is_set(float x) {
    return x >= 0.5 && !unitvec_is_nan(x);
}

// clamp(i / (2^(bits-1) - 1), -1, 1). Bits above `bits` are ignored.
float unitvec_snorm_decode(uint code, uint bits) {
    return unitvec_snorm_quotient(unitvec_snorm_integer(code, bits), bits);
}

// half: half floats (IEEE 754 binary16), converted with integers.

// The halves of 65504, the largest, and of 1.0.
const uint UNITVEC_HALF_MAX = 0x7bffu;
const uint UNITVEC_HALF_ONE = 0x3c00u;

// Half nearest to |x|, ties to even.
uint unitvec_half_encode_magnitude(float x) {
    uint bits = floatBitsToUint(x) & 0x7fffffffu;
    uint exponent = bits >> 23u;

    // From 2^-14 on: 13 bits less of the significand, 112 less of the exponent; a carry is right in both.
    uint normal = (bits - (0x38000000u - 0xfffu) + ((bits >> 13u) & 1u)) >> 13u;

    // From 2^-25 to 2^-14: whole multiples of 2^-24. Below, `shift` stands in for one that is larger.
    uint shift = exponent >= 102u ? (126u - exponent) & 31u : 25u;
    uint significand = (bits & 0x007fffffu) | 0x00800000u;
    uint whole = significand >> shift;
    uint rest = significand & ((1u << shift) - 1u);
    uint middle = (1u << shift) >> 1u;
    uint subnormal = whole + (rest + (whole & 1u) > middle ? 1u : 0u);

    uint rounded = bits >= 0x38800000u ? normal : subnormal;
    return bits >= 0x477ff000u ? UNITVEC_HALF_MAX : rounded;
}

// The half nearest to x, ties to even. Larger magnitudes, infinity and NaN give +-65504; 0 of either sign gives +0.
uint unitvec_half_encode(float x) {
    uint magnitude = unitvec_half_encode_magnitude(x);
    return magnitude | (unitvec_is_negative(x) && magnitude != 0u ? 0x8000u : 0u);
}

// Number of a half without its sign.
float unitvec_half_decode_magnitude(uint code) {
    uint finite = min(code, UNITVEC_HALF_MAX);
    UNITVEC_PRECISE float subnormal = float(finite) * 5.9604645e-8;
    float normal = uintBitsToFloat((finite << 13u) + 0x38000000u);
    return finite < 0x400u ? subnormal : normal;
}

// Number of the half in the low 16 bits. Infinity and NaN count as +-65504, -0 as 0.
float unitvec_half_decode(uint code) {
    float magnitude = unitvec_half_decode_magnitude(code & 0x7fffu);
    return unitvec_negate_positive((code & 0x8000u) != 0u, magnitude);
}

// vector: vectors, with sums in a stated order.

float unitvec_dot(vec3 a, vec3 b) {
    UNITVEC_PRECISE float d = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return d;
}

// v at unit length, to within 2 ULP.
vec3 unitvec_normalize(vec3 v) {
    UNITVEC_PRECISE vec3 n = v * unitvec_inverse_root(unitvec_dot(v, v));
    return n;
}

// unitvec_normalize for a point of an octahedron's lattice, cheaper where it must be exact: v has the L1 norm m and unit is
// (m + 1) / 2, or all are doubled or halved. For an m of 2^k - 1 from 7 to 2^17, the length is between unit and its double.
vec3 unitvec_normalize_octahedral(vec3 v, float m, float unit) {
#ifdef UNITVEC_EXACT
    float square = unitvec_dot(v, v);
    bool is_near = unitvec_is_within(m, 7.0, 131072.0);
    UNITVEC_PRECISE vec3 n =
        v * (is_near ? unitvec_exact_inverse_root_near(square, unit) : unitvec_inverse_root(square));
    return n;
#else
    return unitvec_normalize(v);
#endif
}

// Distance of v from the z axis.
float unitvec_horizontal_length(vec3 v) {
    UNITVEC_PRECISE float square = v.x * v.x + v.y * v.y;
    return unitvec_root(square);
}

// face: the faces of a cube, the one in a direction, and the components in its order.

// Twice the axis of the component of largest magnitude, the last one if several are equal, and 1 if it is negative.
uint unitvec_face_of(vec3 v) {
    vec3 a = abs(v);
    bool z_above = a.z >= a.x && a.z >= a.y;
    bool y_above = a.y >= a.x;
    uint axis = z_above ? 2u : (y_above ? 1u : 0u);
    float component = z_above ? v.z : (y_above ? v.y : v.x);
    return 2u * axis + (unitvec_is_negative(component) ? 1u : 0u);
}

// Components in the order that the face has them: u, v, and that of its axis.
vec3 unitvec_to_face(vec3 v, uint face) {
    uint axis = face >> 1u;
    return axis >= 2u ? v : (axis == 0u ? v.yzx : v.zxy);
}

// The inverse of unitvec_to_face. Faces 6 and 7 count as 4 and 5.
vec3 unitvec_from_face(vec3 p, uint face) {
    uint axis = face >> 1u;
    return axis >= 2u ? p : (axis == 0u ? p.zxy : p.yzx);
}

// two_float: sums, products and quotients as two floats, and unit vectors as exact as floats are, without fused
// multiplication.

// x without the lower 12 of its 24 bits: a product of two such numbers is exact, and so is the rest.
float unitvec_upper_half(float x) {
    return uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u);
}

// a + b, rounded, and the remainder, exactly (Knuth 1969).
vec2 unitvec_two_sum(float a, float b) {
    UNITVEC_PRECISE float sum = a + b;
    UNITVEC_PRECISE float b_in_sum = sum - a;
    UNITVEC_PRECISE float rest = (a - (sum - b_in_sum)) + (b - b_in_sum);
    return vec2(sum, rest);
}

// The remainder that rounding takes from the product of a and b, exactly (Dekker 1971): a b - product.
float unitvec_product_rest(float a, float b, float product) {
    float a_upper = unitvec_upper_half(a);
    float b_upper = unitvec_upper_half(b);
    UNITVEC_PRECISE float a_lower = a - a_upper;
    UNITVEC_PRECISE float b_lower = b - b_upper;
    UNITVEC_PRECISE float rest =
        (((a_upper * b_upper - product) + a_upper * b_lower) + a_lower * b_upper) + a_lower * b_lower;
    return rest;
}

// The coordinate (2^(bits-1) - 1) x / (sum.x + sum.y), 0 <= x <= sum.x; the quotient's first float is returned.
float unitvec_coordinate(float x, vec2 sum, float reciprocal, uint bits, out int integer, out float fraction) {
    UNITVEC_PRECISE float quotient = x * reciprocal;
    UNITVEC_PRECISE float product = quotient * sum.x;
    UNITVEC_PRECISE float product_rest = unitvec_product_rest(quotient, sum.x, product);
    UNITVEC_PRECISE float remainder = ((x - product) - product_rest) - quotient * sum.y;
    float steps = unitvec_exp2(int(bits) - 1);

    UNITVEC_PRECISE float first = quotient * steps;
    int whole = int(first);
    UNITVEC_PRECISE float beyond = ((first - float(whole)) - quotient) + (remainder * reciprocal) * steps;
    float carry = floor(beyond);
    UNITVEC_PRECISE float rest = beyond - carry;

    integer = whole + int(carry);
    fraction = rest;
    return quotient;
}

// Unit vector of upper + lower, whose components are 0 or more; each is the float nearest to the exact one: half an ULP
// off, and 2^-33 for the arithmetic. upper has whole components of up to 12 bits, whose squares have a sum of up to 2^24;
// those of lower are at most 1. All products with a reciprocal length of 12 bits are exact, or as good as it.
vec3 unitvec_normalize_parts(vec3 upper, vec3 lower) {
    float squares = unitvec_dot(upper, upper);
    UNITVEC_PRECISE float other_squares = 2.0 * unitvec_dot(upper, lower) + unitvec_dot(lower, lower);
    UNITVEC_PRECISE float square = squares + other_squares;
    float estimate = unitvec_inverse_root(square);
    float reciprocal = uintBitsToFloat((floatBitsToUint(estimate) + 0x800u) & 0xfffff000u);

    UNITVEC_PRECISE float scale = reciprocal * reciprocal;
    float scale_upper = unitvec_upper_half(scale);
    float squares_upper = unitvec_upper_half(squares);
    UNITVEC_PRECISE float scale_lower = scale - scale_upper;
    UNITVEC_PRECISE float squares_lower = squares - squares_upper;
    UNITVEC_PRECISE float t =
        ((squares_upper * scale_upper - 1.0) + (squares_upper * scale_lower + squares_lower * scale_upper))
        + (squares_lower * scale_lower + other_squares * scale);
    UNITVEC_PRECISE float correction = t * (t * 0.375 - 0.5);

    UNITVEC_PRECISE vec3 first = upper * reciprocal;
    UNITVEC_PRECISE vec3 second = lower * reciprocal;
    UNITVEC_PRECISE vec3 v = first + (second + (first + second) * correction);
    return v;
}

// trig: trigonometry that gives the same bits on every device.

// Minimax polynomials, lowest power first: in the square of the argument d, of 1/4 - d^2 for the two of the diagonal.
const float UNITVEC_SIN_0 = -9.759589e-8;
const float UNITVEC_SIN_1 = -5.167708;
const float UNITVEC_SIN_2 = 2.549761;
const float UNITVEC_SIN_3 = -0.5890122;

const float UNITVEC_COS_0 = -4.934802;
const float UNITVEC_COS_1 = 4.0586963;
const float UNITVEC_COS_2 = -1.3347237;
const float UNITVEC_COS_3 = 0.22859502;

const float UNITVEC_ATAN_0 = 0.27323955;
const float UNITVEC_ATAN_1 = -0.15117298;
const float UNITVEC_ATAN_2 = 0.103452094;
const float UNITVEC_ATAN_3 = -0.078128025;
const float UNITVEC_ATAN_4 = 0.06114309;
const float UNITVEC_ATAN_5 = -0.04537342;
const float UNITVEC_ATAN_6 = 0.027637284;
const float UNITVEC_ATAN_7 = -0.0113028735;
const float UNITVEC_ATAN_8 = 0.0021957082;

const float UNITVEC_TAN_0 = -0.21460184;
const float UNITVEC_TAN_1 = -0.053110685;
const float UNITVEC_TAN_2 = -0.013266972;
const float UNITVEC_TAN_3 = -0.0032981238;
const float UNITVEC_TAN_4 = -0.00088685006;
const float UNITVEC_TAN_5 = -0.00011413961;
const float UNITVEC_TAN_6 = -0.00011944919;

const float UNITVEC_ASIN_0 = 1.14357475e-8;
const float UNITVEC_ASIN_1 = 0.05305204;
const float UNITVEC_ASIN_2 = 0.023855526;
const float UNITVEC_ASIN_3 = 0.014499074;
const float UNITVEC_ASIN_4 = 0.0075942916;
const float UNITVEC_ASIN_5 = 0.013571346;

const float UNITVEC_TURN_0 = 0.6366193;
const float UNITVEC_TURN_1 = -0.21218449;
const float UNITVEC_TURN_2 = 0.12698378;
const float UNITVEC_TURN_3 = -0.088545084;
const float UNITVEC_TURN_4 = 0.061384138;
const float UNITVEC_TURN_5 = -0.035594895;
const float UNITVEC_TURN_6 = 0.013918393;
const float UNITVEC_TURN_7 = -0.002581218;

const float UNITVEC_DIAGONAL_COS_0 = 0.7853982;
const float UNITVEC_DIAGONAL_COS_1 = 0.16854808;
const float UNITVEC_DIAGONAL_COS_2 = 0.014111487;
const float UNITVEC_DIAGONAL_COS_3 = 0.00063868886;

const float UNITVEC_DIAGONAL_SIN_0 = 0.42920387;
const float UNITVEC_DIAGONAL_SIN_1 = 0.053904664;
const float UNITVEC_DIAGONAL_SIN_2 = 0.003245287;

const float UNITVEC_HALF_PI_HIGH = 1.5703125;
const float UNITVEC_HALF_PI_MIDDLE = 0.0004837513;
const float UNITVEC_HALF_PI_LOW = 7.54979e-8;

const float UNITVEC_PI = 3.1415927;
const float UNITVEC_FRAC_1_PI = 0.31830987;
const float UNITVEC_FRAC_2_PI = 0.63661975;
// Angles in radians from here on count as 0: 2^13.
const float UNITVEC_MAX_RADIANS = 8192.0;

// sin(pi r), r in [0, 1/4].
float unitvec_sin_eighth(float r) {
    UNITVEC_PRECISE float u = r * r;
    UNITVEC_PRECISE float low = UNITVEC_SIN_0 + u * (UNITVEC_SIN_1 + u * (UNITVEC_SIN_2 + u * UNITVEC_SIN_3));
    UNITVEC_PRECISE float sine = r * (UNITVEC_PI + low);
    return sine;
}

// cos(pi r), r in [0, 1/4].
float unitvec_cos_eighth(float r) {
    UNITVEC_PRECISE float u = r * r;
    UNITVEC_PRECISE float low = UNITVEC_COS_0 + u * (UNITVEC_COS_1 + u * (UNITVEC_COS_2 + u * UNITVEC_COS_3));
    UNITVEC_PRECISE float cosine = 1.0 + u * low;
    return cosine;
}

// (cos(pi t), sin(pi t)). Infinity and NaN count as 0.
vec2 unitvec_sin_cos_half_turns(float t) {
    float a = unitvec_is_within(abs(t), UNITVEC_NEGLIGIBLE, UNITVEC_ENORMOUS) ? abs(t) : 0.0;
    UNITVEC_PRECISE float turn = a - 2.0 * floor(0.5 * a);
    UNITVEC_PRECISE float rest_of_turn = 2.0 - turn;
    float halved = turn > 1.0 ? rest_of_turn : turn;
    UNITVEC_PRECISE float rest_of_half = 1.0 - halved;
    float quarter = halved > 0.5 ? rest_of_half : halved;
    UNITVEC_PRECISE float rest_of_quarter = 0.5 - quarter;
    bool swapped = quarter > 0.25;
    float eighth = swapped ? rest_of_quarter : quarter;

    float sine = unitvec_sin_eighth(eighth);
    float cosine = unitvec_cos_eighth(eighth);
    float x = swapped ? sine : cosine;
    float y = swapped ? cosine : sine;
    bool below = unitvec_is_negative(t) != (turn > 1.0);
    return vec2(unitvec_negate_if(halved > 0.5, x), unitvec_negate_positive(below, y));
}

// x - y and x + y are cosine and sine of pi/4 + d pi/2, d in [-1/2, 1/2]. Both ends are exact.
vec2 unitvec_from_diagonal(float d) {
    UNITVEC_PRECISE float w = 0.25 - d * d;
    UNITVEC_PRECISE float cosine = UNITVEC_DIAGONAL_COS_0 +
        w * (UNITVEC_DIAGONAL_COS_1 + w * (UNITVEC_DIAGONAL_COS_2 + w * UNITVEC_DIAGONAL_COS_3));
    UNITVEC_PRECISE float sine = UNITVEC_DIAGONAL_SIN_0 + w * (UNITVEC_DIAGONAL_SIN_1 + w * UNITVEC_DIAGONAL_SIN_2);
    UNITVEC_PRECISE vec2 halves = vec2(0.5 + w * cosine, d + (d * w) * sine);
    return halves;
}

// 4/pi atan(r), r 0 or in [2^-100, 1]. Both ends are exact.
float unitvec_atan_octant_of_normal(float r) {
    UNITVEC_PRECISE float u = r * r;
    UNITVEC_PRECISE float low =
        UNITVEC_ATAN_4 + u * (UNITVEC_ATAN_5 + u * (UNITVEC_ATAN_6 + u * (UNITVEC_ATAN_7 + u * UNITVEC_ATAN_8)));
    UNITVEC_PRECISE float polynomial =
        UNITVEC_ATAN_0 + u * (UNITVEC_ATAN_1 + u * (UNITVEC_ATAN_2 + u * (UNITVEC_ATAN_3 + u * low)));
    UNITVEC_PRECISE float octants = r + r * ((1.0 - u) * polynomial);
    return octants;
}

// 4/pi atan(r), r in [0, 1]. Both ends are exact.
float unitvec_atan_octant(float r) {
    return unitvec_atan_octant_of_normal(r < UNITVEC_NEGLIGIBLE ? 0.0 : r);
}

// 4/pi atan(y/x), 0 <= y <= x. Both ends are exact on every device, however it divides.
float unitvec_atan_octant_ratio(float y, float x) {
    float divided = unitvec_quotient(y, x);
    float quotient = y < x ? divided : 1.0;
    return unitvec_atan_octant(y < UNITVEC_MIN_POSITIVE ? 0.0 : quotient);
}

// 2/pi atan(q), q in [0, 1], for the codecs of up to 32 bits.
float unitvec_atan_quarter(float q) {
    UNITVEC_PRECISE float u = q * q;
    UNITVEC_PRECISE float w = u * u;
    UNITVEC_PRECISE float even = UNITVEC_TURN_0 + w * (UNITVEC_TURN_2 + w * (UNITVEC_TURN_4 + w * UNITVEC_TURN_6));
    UNITVEC_PRECISE float odd = UNITVEC_TURN_1 + w * (UNITVEC_TURN_3 + w * (UNITVEC_TURN_5 + w * UNITVEC_TURN_7));
    UNITVEC_PRECISE float turn = q * (even + u * odd);
    return turn;
}

// tan(pi t / 4), t in [0, 1]. Both ends are exact.
float unitvec_tan_octant(float t) {
    t = t < UNITVEC_NEGLIGIBLE ? 0.0 : t;
    UNITVEC_PRECISE float u = t * t;
    UNITVEC_PRECISE float low = UNITVEC_TAN_3 + u * (UNITVEC_TAN_4 + u * (UNITVEC_TAN_5 + u * UNITVEC_TAN_6));
    UNITVEC_PRECISE float polynomial = UNITVEC_TAN_0 + u * (UNITVEC_TAN_1 + u * (UNITVEC_TAN_2 + u * low));
    UNITVEC_PRECISE float tangent = t + t * ((1.0 - u) * polynomial);
    return tangent;
}

// Angle of (x, y) from +X towards +Y. Its sign is that of y, where 0, -0 and denormals are not negative.
float unitvec_atan2_half_turns(float y, float x) {
    UNITVEC_PRECISE float norm = abs(x) + abs(y);
    bool usable = unitvec_is_within(norm, UNITVEC_NEGLIGIBLE, UNITVEC_ENORMOUS);
    x = usable ? x : 1.0;
    y = usable ? y : 0.0;
    bool steep = abs(y) > abs(x);
    float shorter = steep ? abs(x) : abs(y);
    float longer = steep ? abs(y) : abs(x);
    UNITVEC_PRECISE float part = 0.25 * unitvec_atan_octant_ratio(shorter, longer);

    bool left = unitvec_is_negative(x);
    float flat_base = left ? 1.0 : 0.0;
    float base = steep ? 0.5 : flat_base;
    UNITVEC_PRECISE float angle = base + unitvec_negate_if(steep != left, part);
    return unitvec_negate_positive(unitvec_is_negative(y), angle);
}

// |x|, at most 1; 1 for NaN.
float unitvec_clamped_magnitude(float x) {
    float a = abs(x);
    return floatBitsToUint(a) < 0x3f800000u ? a : 1.0;
}

// asin(a)/pi for a in [0, 1/2], half of acos(a)/pi for a in (1/2, 1].
float unitvec_asin_small(float a) {
    bool outer_part = a > 0.5;
    UNITVEC_PRECISE float half_chord_squared = 0.5 * (1.0 - a);
    UNITVEC_PRECISE float squared = a * a;
    float u = outer_part ? half_chord_squared : squared;
    float root = unitvec_root(u);
    float w = outer_part ? root : a;
    UNITVEC_PRECISE float low = UNITVEC_ASIN_2 + u * (UNITVEC_ASIN_3 + u * (UNITVEC_ASIN_4 + u * UNITVEC_ASIN_5));
    UNITVEC_PRECISE float angle = w * (UNITVEC_FRAC_1_PI + (UNITVEC_ASIN_0 + u * (UNITVEC_ASIN_1 + u * low)));
    return angle;
}

// asin(x) / pi. NaN counts as 1.
float unitvec_asin_half_turns(float x) {
    float magnitude = unitvec_clamped_magnitude(x);
    float a = magnitude < UNITVEC_NEGLIGIBLE ? 0.0 : magnitude;
    float part = unitvec_asin_small(a);
    UNITVEC_PRECISE float outer_angle = 0.5 - 2.0 * part;
    float angle = a > 0.5 ? outer_angle : part;
    return unitvec_negate_positive(unitvec_is_negative(x), angle);
}

// acos(x) / pi. NaN counts as 1.
float unitvec_acos_half_turns(float x) {
    float a = unitvec_clamped_magnitude(x);
    bool negative = unitvec_is_negative(x);
    bool outer_part = a > 0.5;
    float outer_base = negative ? 1.0 : 0.0;
    float base = outer_part ? outer_base : 0.5;
    float part = unitvec_asin_small(a);
    UNITVEC_PRECISE float doubled = 2.0 * part;
    UNITVEC_PRECISE float angle = base + unitvec_negate_if(outer_part == negative, outer_part ? doubled : part);
    return angle;
}

// (cos(x), sin(x)) of x radians, |x| < 2^13; other x count as 0.
vec2 unitvec_sin_cos(float x) {
    bool usable = unitvec_is_within(abs(x), UNITVEC_NEGLIGIBLE, UNITVEC_MAX_RADIANS);
    float a = usable ? abs(x) : 0.0;
    // Cody and Waite 1980: all but the last product is exact.
    UNITVEC_PRECISE float k = floor(a * UNITVEC_FRAC_2_PI + 0.5);
    UNITVEC_PRECISE float rest =
        ((a - k * UNITVEC_HALF_PI_HIGH) - k * UNITVEC_HALF_PI_MIDDLE) - k * UNITVEC_HALF_PI_LOW;
    UNITVEC_PRECISE float r = rest * UNITVEC_FRAC_1_PI;
    uint quadrant = unitvec_whole_to_u32(k);

    float sine = unitvec_sin_eighth(r);
    float cosine = unitvec_cos_eighth(r);
    bool swapped = (quadrant & 1u) != 0u;
    float horizontal = swapped ? sine : cosine;
    float vertical = swapped ? cosine : sine;
    bool left = ((quadrant + 1u) & 2u) != 0u;
    bool below = unitvec_is_negative(x) != ((quadrant & 2u) != 0u);
    return vec2(unitvec_negate_if(left, horizontal), unitvec_negate_if(below && vertical != 0.0, vertical));
}

float unitvec_sin(float x) { return unitvec_sin_cos(x).y; }
float unitvec_cos(float x) { return unitvec_sin_cos(x).x; }

float unitvec_atan2(float y, float x) {
    UNITVEC_PRECISE float angle = unitvec_atan2_half_turns(y, x) * UNITVEC_PI;
    return angle;
}

float unitvec_asin(float x) {
    UNITVEC_PRECISE float angle = unitvec_asin_half_turns(x) * UNITVEC_PI;
    return angle;
}

float unitvec_acos(float x) {
    UNITVEC_PRECISE float angle = unitvec_acos_half_turns(x) * UNITVEC_PI;
    return angle;
}

// diamond: angles as places on the diamond |x| + |y| = 1, without trigonometry.

// With a, b, c the constants, w = v (a + b v^2 + c v^4), near tan(pi v / 4): equal steps of v are angles of
// atan(w) that are equal but for 0.26 %. The sum of the three is 1.
const float UNITVEC_WARP_0 = 0.787353515625;
const float UNITVEC_WARP_1 = 0.15234375;
const float UNITVEC_WARP_2 = 0.060302734375;

// The inverse of this stretching, v = w + w (1 - u) (a + u (b + u c)) with u = w^2: within 3.0e-5.
const float UNITVEC_UNWARP_0 = 0.27020066;
const float UNITVEC_UNWARP_1 = -0.13198552;
const float UNITVEC_UNWARP_2 = 0.0392082;

// The place on a side of the diamond, -1 to 1, for v of -1 to 1.
float unitvec_diamond_warp(float v) {
    UNITVEC_PRECISE float u = v * v;
    UNITVEC_PRECISE float w = v * (UNITVEC_WARP_0 + u * (UNITVEC_WARP_1 + u * UNITVEC_WARP_2));
    return w;
}

// The inverse of unitvec_diamond_warp; for more than 9 bits of angle, with a step of Newton's method.
float unitvec_diamond_unwarp(float w, uint bits) {
    UNITVEC_PRECISE float u = w * w;
    UNITVEC_PRECISE float v = w + w * ((1.0 - u) * (UNITVEC_UNWARP_0 + u * (UNITVEC_UNWARP_1 + u * UNITVEC_UNWARP_2)));
    if (bits <= 9u) return v;
    // 4 / pi / (1 + u), the slope of the inverse but for 0.26 %.
    UNITVEC_PRECISE float missing = (w - unitvec_diamond_warp(v)) * 1.2732395;
    UNITVEC_PRECISE float slope = 1.0 + u;
    UNITVEC_PRECISE float nearer = v + unitvec_signed_quotient(missing, slope);
    return nearer;
}

// Code of the angle of (x, y) from +X towards +Y, for sum = |x| + |y|, a normal number below 2^126. The upper two of its
// `bits` bits (4 to 21) count quarter turns.
uint unitvec_diamond_code(float x, float y, float sum, uint bits) {
    // Odd quarter turns are entered where |x| is 0: there the side runs from |y| to |x|.
    uint below = floatBitsToUint(y) & UNITVEC_SIGN_BIT;
    uint odd = (floatBitsToUint(x) & UNITVEC_SIGN_BIT) ^ below;
    UNITVEC_PRECISE float difference = abs(y) - abs(x);
    float w = unitvec_signed_quotient(unitvec_flip_sign(difference, odd), sum);

    float half_places = float(1u << (bits - 3u));
    UNITVEC_PRECISE float place = half_places * (unitvec_diamond_unwarp(w, bits) + 1.0) + UNITVEC_2_23;
    uint quarters = (below >> (32u - bits)) | (odd >> (33u - bits));
    // The last place of a quarter is the first one of the next, and that of the last quarter code 0.
    return (quarters + floatBitsToUint(place)) & unitvec_mask(bits);
}

// Place of an angle's code: a point of the diamond |x| + |y| = 2. Zeros may be -0.
vec2 unitvec_diamond_point(uint code, uint bits) {
    float place = float(code & unitvec_mask(bits - 2u));
    UNITVEC_PRECISE float v = place * unitvec_exp2(3 - int(bits)) - 1.0;

    uint odd = (code << (33u - bits)) & UNITVEC_SIGN_BIT;
    uint below = (code << (32u - bits)) & UNITVEC_SIGN_BIT;
    float w = unitvec_flip_sign(unitvec_diamond_warp(v), odd);
    UNITVEC_PRECISE float x = 1.0 - w;
    UNITVEC_PRECISE float y = 1.0 + w;
    return vec2(unitvec_flip_sign(x, odd ^ below), unitvec_flip_sign(y, below));
}

// direction: the rule for usable directions.

// Least L1 norm of a usable direction, 2^-64: far enough above the denormals that whether a device flushes them changes
// no code.
const float UNITVEC_MIN_NORM = 5.421010862427522e-20;
// L1 norms from 2^100 on give no direction.
const float UNITVEC_MAX_NORM = 1.2676506002282294e30;

float unitvec_l1_norm(vec3 v) {
    UNITVEC_PRECISE float norm = (abs(v.x) + abs(v.y)) + abs(v.z);
    return norm;
}

// False for zero, infinity and NaN.
bool unitvec_is_usable(float l1_norm) {
    return unitvec_is_within(l1_norm, UNITVEC_MIN_NORM, UNITVEC_MAX_NORM);
}

// v, or +Z where v has no usable direction.
vec3 unitvec_or_z(vec3 v) {
    return unitvec_is_usable(unitvec_l1_norm(v)) ? v : vec3(0.0, 0.0, 1.0);
}

// v, moved up to the equator if below it.
vec3 unitvec_upper(vec3 v) {
    return vec3(v.xy, max(v.z, 0.0));
}

// True where both v and unitvec_upper(v) have a usable direction.
bool unitvec_is_upper_usable(vec3 v) {
    uint norm = floatBitsToUint(unitvec_l1_norm(v));
    uint upper_norm = floatBitsToUint(unitvec_l1_norm(unitvec_upper(v)));
    return norm < floatBitsToUint(UNITVEC_MAX_NORM) && upper_norm >= floatBitsToUint(UNITVEC_MIN_NORM);
}

// angles: functions that the codecs of longitude and latitude or height share; the Rust crate has them in the codecs'
// folder.

// 2^-40 and 2^-61, the least values that x and y count as, beside an L1 norm of 1 to 2: no scaled denormal is more.
const float UNITVEC_ANGLES_LEAST_X = 9.094947017729282e-13;
const float UNITVEC_ANGLES_LEAST_Y = 4.336808689942018e-19;

// The magnitudes of v's components, scaled by a power of two to an L1 norm of 1 to 2. Unspecified without a usable
// direction.
vec3 unitvec_angles_scaled(vec3 v, float norm) {
    UNITVEC_PRECISE vec3 p = abs(v) * unitvec_scale_to_one(norm);
    return vec3(max(p.x, UNITVEC_ANGLES_LEAST_X), max(p.y, UNITVEC_ANGLES_LEAST_Y), p.z);
}

// The angle of (x, y) from +X in quarter turns, 0 to 1. Neither is negative, and not both are 0.
float unitvec_angles_quarter(float y, float x) {
    float q = unitvec_quotient(min(x, y), max(x, y));
    float part = unitvec_atan_quarter(q);
    UNITVEC_PRECISE float rest = 1.0 - part;
    return y > x ? rest : part;
}

// The angle of a vector from +X in quarter turns, 0 to 2. x and y are its magnitudes; it is on the side of +X or, if
// `left`, of -X.
float unitvec_angles_half_turn(float y, float x, bool left) {
    float angle = unitvec_angles_quarter(y, x);
    UNITVEC_PRECISE float rest = 2.0 - angle;
    return left ? rest : angle;
}

// The azimuth of v, in quarter turns, -2 to 2. p is unitvec_angles_scaled of v.
float unitvec_angles_azimuth(vec3 v, vec3 p) {
    float angle = unitvec_angles_half_turn(p.y, p.x, unitvec_is_negative(v.x));
    return unitvec_negate_if(unitvec_is_negative(v.y), angle);
}

// Unit vector of a cylinder's radius and height at the angle of so many quarter turns, -2 to 2, about +Z.
vec3 unitvec_angles_around_z(float radius, float z, float quarters) {
    UNITVEC_PRECISE float ahead = 1.0 - abs(quarters);
    UNITVEC_PRECISE float diagonal = 0.5 - abs(ahead);
    vec2 e = unitvec_from_diagonal(diagonal);
    UNITVEC_PRECISE float x = (e.x - e.y) * radius;
    UNITVEC_PRECISE float y = (e.x + e.y) * radius;
    return vec3(unitvec_with_sign(x, ahead), unitvec_negate_positive(quarters < 0.0, y), z);
}

// A point (x, y) of a lattice on an octahedron, at p + d: x, y, and the square of the tangent of its angle from p as a
// fraction, z / w. `square` is d . d, `part` d . p, `len` p . p.
vec4 unitvec_beside(vec2 at, float square, float part, float len) {
    UNITVEC_PRECISE float along = len + part;
    UNITVEC_PRECISE float across = square * len - part * part;
    UNITVEC_PRECISE float squared = along * along;
    return vec4(at, across, squared);
}

// b where it is nearer, else a.
vec4 unitvec_nearer(vec4 a, vec4 b) {
    UNITVEC_PRECISE float of_b = b.z * a.w;
    UNITVEC_PRECISE float of_a = a.z * b.w;
    return of_b < of_a ? b : a;
}

#endif
