//! Powers of two, and vectors scaled by them.

use glam::Vec3;

/// 2^-100: angles and parts of a vector of about unit length that are less count as 0.
pub const NEGLIGIBLE: f32 = exp2(-100);

/// 2^100: larger numbers have no meaning as an angle or a part.
pub const ENORMOUS: f32 = exp2(100);

/// The least value that x counts as for an azimuth, beside an L1 norm of 1 to 2: 2^-40, far below half a step of any
/// angle. So nothing is divided by 0, and no denormal counts, since some devices flush them: scaled, they are all less.
pub(crate) const LEAST_X: f32 = exp2(-40);

/// The least value that y counts as for an azimuth: 2^-61, which no scaled denormal reaches. It is so much less than
/// [`LEAST_X`] that the azimuth of +Z is 0.
pub(crate) const LEAST_Y: f32 = exp2(-61);

/// 2 to the power `exponent`, -126 to 127.
#[inline(always)]
pub(crate) const fn exp2(exponent: i32) -> f32 {
    f32::from_bits(((127 + exponent) as u32) << 23)
}

/// True where `x` is `least` or more and below `end`, both positive. False for NaN: the comparison is one of integers, since
/// a GPU need not compare NaN as IEEE 754 says.
#[inline(always)]
pub fn is_within(x: f32, least: f32, end: f32) -> bool {
    x.to_bits().wrapping_sub(least.to_bits()) < end.to_bits() - least.to_bits()
}

/// The power of two that scales a usable L1 norm to 1 to 2, exactly. The result for other norms has no meaning.
#[inline(always)]
pub(crate) fn scale_to_one(l1_norm: f32) -> f32 {
    f32::from_bits((254u32 << 23).wrapping_sub(l1_norm.to_bits() & 0x7f80_0000))
}

/// `x`, or 0 for denormals and -0: devices may flush them.
#[inline(always)]
pub(crate) fn without_denormal(x: f32) -> f32 {
    if x.abs() < f32::MIN_POSITIVE { 0.0 } else { x }
}

/// `v` without denormals and -0.
#[inline(always)]
pub(crate) fn without_denormals(v: Vec3) -> Vec3 {
    Vec3::new(without_denormal(v.x), without_denormal(v.y), without_denormal(v.z))
}

/// `v`, denormal components as 0, scaled by [`scale_to_one`] of its L1 norm: squares of components that count neither
/// overflow nor vanish. Scaled up, denormals could be large beside the others of a short vector, and devices that flush them
/// would differ.
#[inline(always)]
pub(crate) fn scaled_to_one(v: Vec3, l1_norm: f32) -> Vec3 {
    without_denormals(v) * scale_to_one(l1_norm)
}
