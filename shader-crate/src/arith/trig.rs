//! Trigonometry that gives the same bits on every target: the built-in functions of GPUs do not.
//!
//! The unit of angles is the half turn, pi radians: reduction to the first octant is exact, the axes and diagonals are
//! exact, and -1 to 1 is the range of an snorm. The functions in radians wrap those in half turns and add the rounding
//! of a product with pi.
//!
//! * Polynomials are minimax fits by the Remez exchange in `f64`, rounded to `f32`; the test `trig` fits them again and
//!   compares. Each constant names its polynomial.
//! * Errors are the greatest, measured against `f64` on the CPU over all floats from 2^-12 to 1 and a part of those
//!   below; where a relative error stands, it holds near the function's zeros too. In plain shaders the error of the
//!   device's own division and square root adds to that of the functions that need them: atan2, `atan_octant_ratio`, asin
//!   and acos.
//! * Every function is total. Angles and ratios of less than 2^-100 count as 0, so that no result depends on whether
//!   a device flushes denormals, and no result is -0 or denormal.

use super::{ENORMOUS, NEGLIGIBLE, floor, is_negative, is_within, negate_if, quotient, root, whole_to_u32};
use core::f32::consts::{FRAC_1_PI, FRAC_2_PI, FRAC_PI_4, PI};
use glam::Vec2;

coefficients! {
    /// `sin(pi r) = r (PI + (SIN_0 + u (SIN_1 + u (SIN_2 + u SIN_3))))` with `u = r^2`, for r in \[0, 1/4\]: relative error
    /// 3.3e-9 before rounding. `PI` is the `f32`; `SIN_0` holds the rest.
    pub SIN_0 = -9.759589e-8, SIN_1 = -5.167708, SIN_2 = 2.549761, SIN_3 = -0.5890122;

    /// `cos(pi r) = 1 + u (COS_0 + u (COS_1 + u (COS_2 + u COS_3)))` with `u = r^2`, for r in \[0, 1/4\]: absolute error
    /// 4.1e-10 before rounding. `COS_0` is -pi^2/2 and the others are fitted with it as `f32`, by which sine and cosine
    /// of 1/4 come out equal.
    pub COS_0 = -4.934802, COS_1 = 4.0586963, COS_2 = -1.3347237, COS_3 = 0.22859502;

    /// `4/pi atan(r) = r + r (1 - u) (ATAN_0 + u (ATAN_1 + ... + u ATAN_8))` with `u = r^2`, for r in \[0, 1\]: relative
    /// error 2.5e-9 before rounding. The factors make both ends exact.
    pub ATAN_0 = 0.27323955, ATAN_1 = -0.15117298, ATAN_2 = 0.103452094, ATAN_3 = -0.078128025,
        ATAN_4 = 0.06114309, ATAN_5 = -0.04537342, ATAN_6 = 0.027637284, ATAN_7 = -0.0113028735,
        ATAN_8 = 0.0021957082;

    /// `tan(pi t / 4) = t + t (1 - u) (TAN_0 + u (TAN_1 + ... + u TAN_6))` with `u = t^2`, for t in \[0, 1\]: relative
    /// error 1.3e-9 before rounding. The factors make both ends exact.
    pub TAN_0 = -0.21460184, TAN_1 = -0.053110685, TAN_2 = -0.013266972, TAN_3 = -0.0032981238,
        TAN_4 = -0.00088685006, TAN_5 = -0.00011413961, TAN_6 = -0.00011944919;

    /// `asin(w)/pi = w (FRAC_1_PI + (ASIN_0 + u (ASIN_1 + ... + u ASIN_5)))` with `u = w^2`, for w in \[0, 1/2\]: relative
    /// error 4.5e-9 before rounding. `FRAC_1_PI` is the `f32`; `ASIN_0` holds the rest.
    pub ASIN_0 = 1.14357475e-8, ASIN_1 = 0.05305204, ASIN_2 = 0.023855526, ASIN_3 = 0.014499074,
        ASIN_4 = 0.0075942916, ASIN_5 = 0.013571346;

    /// `2/pi atan(q) = q (TURN_0 + u (TURN_1 + ... + u TURN_7))` with `u = q^2`, for q in \[0, 1\]: absolute error 5.1e-8,
    /// 1.1e-7 with rounding. That is 2^-9 of a step at 32 bits, and 2^-8: less than
    /// [`atan_octant`] gives, at two thirds of the cost.
    pub TURN_0 = 0.6366193, TURN_1 = -0.21218449, TURN_2 = 0.12698378, TURN_3 = -0.088545084,
        TURN_4 = 0.061384138, TURN_5 = -0.035594895, TURN_6 = 0.013918393, TURN_7 = -0.002581218;

    /// `cos(pi d / 2) / root(2) = 1/2 + w (DIAGONAL_COS_0 + w (... + w DIAGONAL_COS_3))` with `w = 1/4 - d^2`, for d in
    /// \[-1/2, 1/2\]: absolute error 3.8e-11 before rounding. The factor makes the ends exact.
    pub DIAGONAL_COS_0 = FRAC_PI_4, DIAGONAL_COS_1 = 0.16854808, DIAGONAL_COS_2 = 0.014111487,
        DIAGONAL_COS_3 = 0.00063868886;

    /// `sin(pi d / 2) / root(2) = d + d w (DIAGONAL_SIN_0 + w (DIAGONAL_SIN_1 + w DIAGONAL_SIN_2))` with
    /// `w = 1/4 - d^2`, for d in \[-1/2, 1/2\]: absolute error 9.8e-10 before rounding. The factor makes the ends exact.
    pub DIAGONAL_SIN_0 = 0.42920387, DIAGONAL_SIN_1 = 0.053904664, DIAGONAL_SIN_2 = 0.003245287;
}

/// The first part of pi/2 as Cody and Waite split it: pi/2 cut off after 8 bits. With the next, of 11 bits,
/// products with whole numbers up to 2^13 are exact.
pub const HALF_PI_HIGH: f32 = 1.5703125;
/// The second part of pi/2: the next 11 bits.
pub const HALF_PI_MIDDLE: f32 = 0.0004837513;
/// The third part of pi/2: the rest.
pub const HALF_PI_LOW: f32 = 7.54979e-8;

/// Angles in radians from here on count as 0: 2^13.
pub const MAX_RADIANS: f32 = 8192.0;

/// The unit vector at the angle `t` half turns: x is `cos(pi t)`, y is `sin(pi t)`.
///
/// Takes every finite `t`: reduction is exact, by the symmetries of sine and cosine. Infinity and NaN count as 0.
/// Multiples of 1/2 give 0 and +-1 exactly; -t gives the same x and the negated y exactly.
///
/// Error: at most 7.0e-8 (1.2 times the spacing of floats below 1) and 1.2e-7 relative in each of x and y; the
/// length is within 9.2e-8 of 1.
#[inline(always)]
pub fn sin_cos_half_turns(t: f32) -> Vec2 {
    // From 2^100 on floats are whole turns, so that this only drops numbers that count as 0 anyway.
    let a = if is_within(t.abs(), NEGLIGIBLE, ENORMOUS) { t.abs() } else { 0.0 };
    let turn = a - 2.0 * floor(0.5 * a);
    let half = if turn > 1.0 { 2.0 - turn } else { turn };
    let quarter = if half > 0.5 { 1.0 - half } else { half };
    let swapped = quarter > 0.25;
    let eighth = if swapped { 0.5 - quarter } else { quarter };

    let (sine, cosine) = (sin_eighth(eighth), cos_eighth(eighth));
    let (x, y) = if swapped { (sine, cosine) } else { (cosine, sine) };
    let below = is_negative(t) != (turn > 1.0);
    // A y of 0 is not negated: it would become -0.
    Vec2::new(negate_if(half > 0.5, x), negate_if(below && y > 0.0, y))
}

/// The x and y whose difference x - y is the cosine of an angle in the first quarter turn, and whose sum x + y is its
/// sine. The angle is `pi/4 + d pi/2` with d in \[-1/2, 1/2\], 0 or normal. They are the cosine and sine of `d pi/2`,
/// divided by `root(2)`.
///
/// Needs no reduction, so that it costs half of [`sin_cos_half_turns`]. At the ends x is 1/2 and y is -+1/2 exactly:
/// the axes are exact, and no difference or sum is -0. -d gives the same x and the negated y exactly.
///
/// Error: at most 5.9e-8 in x and 2.0e-8 in y, 9.9e-8 in the difference and in the sum, whose length is within 1.1e-7
/// of 1.
#[inline(always)]
pub fn from_diagonal(d: f32) -> Vec2 {
    let w = 0.25 - d * d;
    let cosine = DIAGONAL_COS_0 + w * (DIAGONAL_COS_1 + w * (DIAGONAL_COS_2 + w * DIAGONAL_COS_3));
    let sine = DIAGONAL_SIN_0 + w * (DIAGONAL_SIN_1 + w * DIAGONAL_SIN_2);
    Vec2::new(0.5 + w * cosine, d + (d * w) * sine)
}

/// The angle of the vector (x, y) from +X towards +Y in half turns, -1 to 1. Length does not matter.
///
/// Its sign is that of `y`, where 0, -0 and denormals are not negative: from the lower side, -X is near -1, which
/// comes out when `y` is negative but too small beside `x` to matter, and from the upper side it is 1. Axes and
/// diagonals (+-1/4, +-3/4) are exact. (0, 0) gives 0, and so does every vector whose `|x| + |y|` is NaN or outside
/// \[2^-100, 2^100).
///
/// Error: at most 5.0e-8 (that of rounding alone is 3e-8) and 1.5e-7 relative, over random vectors.
#[inline(always)]
pub fn atan2_half_turns(y: f32, x: f32) -> f32 {
    let usable = is_within(x.abs() + y.abs(), NEGLIGIBLE, ENORMOUS);
    let (x, y) = if usable { (x, y) } else { (1.0, 0.0) };
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ay > ax;
    let (shorter, longer) = if steep { (ax, ay) } else { (ay, ax) };
    let part = 0.25 * atan_octant_ratio(shorter, longer);

    // Every octant begins or ends at a multiple of 1/2, an axis: only one sum rounds.
    let left = is_negative(x);
    let flat_base = if left { 1.0 } else { 0.0 };
    let base = if steep { 0.5 } else { flat_base };
    let angle = base + negate_if(steep != left, part);
    negate_if(is_negative(y) && angle > 0.0, angle)
}

/// `4/pi atan(y/x)` for `0 <= y <= x`: how far (x, y) is in the first octant, 0 to 1. Both ends are exact on every
/// device, however it divides.
///
/// `x` is 0 or a normal number below 2^126: beyond, devices may differ. Denormal `y` and quotients below 2^-100 count
/// as 0, `y > x` as `x`; (0, 0) gives 0.
///
/// Error: at most 7.9e-8 and 1.5e-7 relative, over random vectors.
#[inline(always)]
pub fn atan_octant_ratio(y: f32, x: f32) -> f32 {
    let divided = quotient(y, x);
    let ratio = if y < x { divided } else { 1.0 };
    atan_octant(if y < f32::MIN_POSITIVE { 0.0 } else { ratio })
}

/// `4/pi atan(r)` for r in \[0, 1\]: 0 to 1, with both ends exact. Numbers below 2^-100, negative ones too, count as 0;
/// above 1 the result means nothing.
///
/// Error: at most 5.3e-8 and 1.1e-7 relative (1.3 ULP). Monotonic.
#[inline(always)]
pub fn atan_octant(r: f32) -> f32 {
    atan_octant_of_normal(if r < NEGLIGIBLE { 0.0 } else { r })
}

/// [`atan_octant`] for r of 0, or from 2^-100 to 1.
#[inline(always)]
pub(crate) fn atan_octant_of_normal(r: f32) -> f32 {
    let u = r * r;
    let low = ATAN_4 + u * (ATAN_5 + u * (ATAN_6 + u * (ATAN_7 + u * ATAN_8)));
    let polynomial = ATAN_0 + u * (ATAN_1 + u * (ATAN_2 + u * (ATAN_3 + u * low)));
    r + r * ((1.0 - u) * polynomial)
}

/// `2/pi atan(q)` for q of 0 to 1, and perhaps an ULP: 0 to 1/2, for the codecs of up to 32 bits. Two sums side by side,
/// since each term of one waits for the term before.
#[inline(always)]
pub(crate) fn atan_quarter(q: f32) -> f32 {
    let u = q * q;
    let w = u * u;
    let even = TURN_0 + w * (TURN_2 + w * (TURN_4 + w * TURN_6));
    let odd = TURN_1 + w * (TURN_3 + w * (TURN_5 + w * TURN_7));
    q * (even + u * odd)
}

/// `tan(pi t / 4)` for t in \[0, 1\], the inverse of [`atan_octant`]: 0 to 1, with both ends exact. Numbers below
/// 2^-100, negative ones too, count as 0; above 1 the result means nothing.
///
/// Error: at most 5.1e-8 and 1.1e-7 relative (1.4 ULP). Monotonic.
#[inline(always)]
pub fn tan_octant(t: f32) -> f32 {
    let t = if t < NEGLIGIBLE { 0.0 } else { t };
    let u = t * t;
    let low = TAN_3 + u * (TAN_4 + u * (TAN_5 + u * TAN_6));
    let polynomial = TAN_0 + u * (TAN_1 + u * (TAN_2 + u * low));
    t + t * ((1.0 - u) * polynomial)
}

/// `asin(x) / pi`, -1/2 to 1/2. Exact at -1, 0 and 1; -x gives the negated result exactly.
///
/// `x` is clamped to \[-1, 1\]; NaN counts as 1.
///
/// Error: at most 4.4e-8 and 2.5e-7 relative. Monotonic.
#[inline(always)]
pub fn asin_half_turns(x: f32) -> f32 {
    let a = clamped_magnitude(x);
    let a = if a < NEGLIGIBLE { 0.0 } else { a };
    let part = asin_small(a);
    let outer_angle = 0.5 - 2.0 * part;
    let angle = if a > 0.5 { outer_angle } else { part };
    negate_if(is_negative(x) && angle > 0.0, angle)
}

/// `acos(x) / pi`, 0 to 1. Exact at -1, 0 and 1.
///
/// `x` is clamped to \[-1, 1\]; NaN counts as 1.
///
/// Error: at most 7.1e-8 and 1.6e-7 relative, near 1 too. Monotonic.
#[inline(always)]
pub fn acos_half_turns(x: f32) -> f32 {
    let a = clamped_magnitude(x);
    let negative = is_negative(x);
    let outer = a > 0.5;
    let outer_base = if negative { 1.0 } else { 0.0 };
    let base = if outer { outer_base } else { 0.5 };
    let part = asin_small(a);
    let doubled = 2.0 * part;
    base + negate_if(outer == negative, if outer { doubled } else { part })
}

/// `sin(pi r)` for r in \[-1/4, 1/4\].
#[inline(always)]
pub(crate) fn sin_eighth(r: f32) -> f32 {
    let u = r * r;
    r * (PI + (SIN_0 + u * (SIN_1 + u * (SIN_2 + u * SIN_3))))
}

/// `cos(pi r)` for r in \[-1/4, 1/4\].
#[inline(always)]
pub(crate) fn cos_eighth(r: f32) -> f32 {
    let u = r * r;
    1.0 + u * (COS_0 + u * (COS_1 + u * (COS_2 + u * COS_3)))
}

/// `|x|`, at most 1; 1 for NaN. The comparison is one of integers, since a GPU need not compare NaN as IEEE 754 says.
#[inline(always)]
fn clamped_magnitude(x: f32) -> f32 {
    let a = x.abs();
    if a.to_bits() < 1f32.to_bits() { a } else { 1.0 }
}

/// `asin(a)/pi` for a in \[0, 1/2\]; for a in (1/2, 1\] half of `acos(a)/pi`, which is the `asin` of half the chord: 0
/// to 1/6.
#[inline(always)]
fn asin_small(a: f32) -> f32 {
    let outer = a > 0.5;
    let u = if outer { 0.5 * (1.0 - a) } else { a * a };
    let root = root(u);
    let w = if outer { root } else { a };
    let low = ASIN_2 + u * (ASIN_3 + u * (ASIN_4 + u * ASIN_5));
    w * (FRAC_1_PI + (ASIN_0 + u * (ASIN_1 + u * low)))
}

/// The unit vector at the angle `x` radians: x is `cos(x)`, y is `sin(x)`.
///
/// For `|x|` below [`MAX_RADIANS`]; others count as 0, as do infinity and NaN. -x gives the same x and the negated
/// y exactly.
///
/// Error: at most 1.3e-7 in each of x and y; up to 1, 2e-7 relative.
#[inline(always)]
pub fn sin_cos(x: f32) -> Vec2 {
    let magnitude = x.abs();
    let usable = is_within(magnitude, NEGLIGIBLE, MAX_RADIANS);
    let a = if usable { magnitude } else { 0.0 };
    // Cody and Waite 1980: all but the last product is exact.
    let k = floor(a * FRAC_2_PI + 0.5);
    let rest = ((a - k * HALF_PI_HIGH) - k * HALF_PI_MIDDLE) - k * HALF_PI_LOW;
    let quadrant = whole_to_u32(k);

    let (sine, cosine) = (sin_eighth(rest * FRAC_1_PI), cos_eighth(rest * FRAC_1_PI));
    let (x_magnitude, y_magnitude) = if quadrant & 1 != 0 { (sine, cosine) } else { (cosine, sine) };
    let below = is_negative(x) != (quadrant & 2 != 0);
    Vec2::new(
        negate_if((quadrant + 1) & 2 != 0, x_magnitude),
        negate_if(below && y_magnitude != 0.0, y_magnitude),
    )
}

/// `sin(x)` of `x` radians: the y of [`sin_cos`].
#[inline(always)]
pub fn sin(x: f32) -> f32 {
    sin_cos(x).y
}

/// `cos(x)` of `x` radians: the x of [`sin_cos`].
#[inline(always)]
pub fn cos(x: f32) -> f32 {
    sin_cos(x).x
}

/// [`atan2_half_turns`] in radians: -pi to pi.
///
/// Error: at most 3.4e-7 and 2.3e-7 relative.
#[inline(always)]
pub fn atan2(y: f32, x: f32) -> f32 {
    atan2_half_turns(y, x) * PI
}

/// [`asin_half_turns`] in radians: -pi/2 to pi/2.
///
/// Error: at most 2.1e-7 and 3.3e-7 relative.
#[inline(always)]
pub fn asin(x: f32) -> f32 {
    asin_half_turns(x) * PI
}

/// [`acos_half_turns`] in radians: 0 to pi.
///
/// Error: at most 3.9e-7 and 2.3e-7 relative.
#[inline(always)]
pub fn acos(x: f32) -> f32 {
    acos_half_turns(x) * PI
}
