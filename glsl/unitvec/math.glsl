// unitvec: trigonometry that gives the same bits on every device: the built-in functions do not.
//
// The unit of angles is the half turn, pi radians: reduction to the first octant is exact, the axes and diagonals are
// exact, and -1 to 1 is what an snorm holds. Magnitudes below 2^-100 count as 0; no result is -0 or denormal.
//
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
// Errors and bad input are as the Rust crate's module `math` has them, whose every operation these repeat.

#ifndef UNITVEC_MATH_GLSL
#define UNITVEC_MATH_GLSL

#ifndef UNITVEC_SCALAR_GLSL
#include "scalar.glsl"
#endif

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
// 2^-100, and the least normal number.
const float UNITVEC_MIN_NORM = 7.888609052210118e-31;
const float UNITVEC_MIN_POSITIVE = 1.1754943508222875e-38;

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
    float a = unitvec_is_usable(abs(t)) ? abs(t) : 0.0;
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
    // Not where y is 0, which would become -0.
    return vec2(unitvec_negate_if(halved > 0.5, x), unitvec_negate_if(below && y > 0.0, y));
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

// 4/pi atan(r), r in [0, 1]. Both ends are exact.
float unitvec_atan_octant(float r) {
    r = r < UNITVEC_MIN_NORM ? 0.0 : r;
    UNITVEC_PRECISE float u = r * r;
    UNITVEC_PRECISE float low =
        UNITVEC_ATAN_4 + u * (UNITVEC_ATAN_5 + u * (UNITVEC_ATAN_6 + u * (UNITVEC_ATAN_7 + u * UNITVEC_ATAN_8)));
    UNITVEC_PRECISE float polynomial =
        UNITVEC_ATAN_0 + u * (UNITVEC_ATAN_1 + u * (UNITVEC_ATAN_2 + u * (UNITVEC_ATAN_3 + u * low)));
    UNITVEC_PRECISE float octants = r + r * ((1.0 - u) * polynomial);
    return octants;
}

// 4/pi atan(y/x), 0 <= y <= x. Both ends are exact on every device, however it divides.
float unitvec_atan_octant_ratio(float y, float x) {
    UNITVEC_PRECISE float divided = y / x;
    float quotient = y < x ? divided : 1.0;
    return unitvec_atan_octant(y < UNITVEC_MIN_POSITIVE ? 0.0 : quotient);
}

// tan(pi t / 4), t in [0, 1]. Both ends are exact.
float unitvec_tan_octant(float t) {
    t = t < UNITVEC_MIN_NORM ? 0.0 : t;
    UNITVEC_PRECISE float u = t * t;
    UNITVEC_PRECISE float low = UNITVEC_TAN_3 + u * (UNITVEC_TAN_4 + u * (UNITVEC_TAN_5 + u * UNITVEC_TAN_6));
    UNITVEC_PRECISE float polynomial = UNITVEC_TAN_0 + u * (UNITVEC_TAN_1 + u * (UNITVEC_TAN_2 + u * low));
    UNITVEC_PRECISE float tangent = t + t * ((1.0 - u) * polynomial);
    return tangent;
}

// Angle of (x, y) from +X towards +Y. Its sign is that of y, where 0, -0 and denormals are not negative.
float unitvec_atan2_half_turns(float y, float x) {
    UNITVEC_PRECISE float norm = abs(x) + abs(y);
    bool usable = unitvec_is_usable(norm);
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
    return unitvec_negate_if(unitvec_is_negative(y) && angle > 0.0, angle);
}

// |x|, at most 1; of NaN 1.
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
    UNITVEC_PRECISE float root = sqrt(u);
    float w = outer_part ? root : a;
    UNITVEC_PRECISE float low = UNITVEC_ASIN_2 + u * (UNITVEC_ASIN_3 + u * (UNITVEC_ASIN_4 + u * UNITVEC_ASIN_5));
    UNITVEC_PRECISE float angle = w * (UNITVEC_FRAC_1_PI + (UNITVEC_ASIN_0 + u * (UNITVEC_ASIN_1 + u * low)));
    return angle;
}

// asin(x) / pi. NaN counts as 1.
float unitvec_asin_half_turns(float x) {
    float magnitude = unitvec_clamped_magnitude(x);
    float a = magnitude < UNITVEC_MIN_NORM ? 0.0 : magnitude;
    float part = unitvec_asin_small(a);
    UNITVEC_PRECISE float outer_angle = 0.5 - 2.0 * part;
    float angle = a > 0.5 ? outer_angle : part;
    return unitvec_negate_if(unitvec_is_negative(x) && angle > 0.0, angle);
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
    bool usable = floatBitsToUint(abs(x)) - 0x0d800000u < 0x46000000u - 0x0d800000u;
    float a = usable ? abs(x) : 0.0;
    // Cody and Waite 1980: all but the last product is exact.
    UNITVEC_PRECISE float k = floor(a * UNITVEC_FRAC_2_PI + 0.5);
    UNITVEC_PRECISE float rest =
        ((a - k * UNITVEC_HALF_PI_HIGH) - k * UNITVEC_HALF_PI_MIDDLE) - k * UNITVEC_HALF_PI_LOW;
    UNITVEC_PRECISE float r = rest * UNITVEC_FRAC_1_PI;
    uint quadrant = uint(int(k));

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

#endif
