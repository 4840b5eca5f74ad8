//! Signs that do not depend on how a device treats denormals and -0.

/// True where `x` is below zero by at least the least normal number.
///
/// Devices may flush denormals to zero, so a comparison with zero would tell -1e-40 from 0 on some and not on
/// others. This one has the same answer everywhere; both zeros and all denormals count as not negative.
#[inline(always)]
pub fn is_negative(x: f32) -> bool {
    x <= -f32::MIN_POSITIVE
}

/// `-x` where `negative`, else `x`.
#[inline(always)]
pub fn negate_if(negative: bool, x: f32) -> f32 {
    if negative { -x } else { x }
}

/// `-x` where `negative`, else `x`, for `x` of at least 0; 0 stays +0.
#[inline(always)]
pub fn negate_positive(negative: bool, x: f32) -> f32 {
    negate_if(negative && x > 0.0, x)
}

/// `magnitude`, of at least 0 and not -0, with the sign bit of `y`: bits, so that denormals and -0 count alike everywhere.
#[inline(always)]
pub fn with_sign(magnitude: f32, y: f32) -> f32 {
    f32::from_bits(magnitude.to_bits() | (y.to_bits() & SIGN_BIT))
}

/// `-x` where `sign` is [`SIGN_BIT`], `x` where it is 0: bits, so that 0 changes its sign too.
#[inline(always)]
pub(crate) fn flip_sign(x: f32, sign: u32) -> f32 {
    f32::from_bits(x.to_bits() ^ sign)
}

/// The sign bit of an f32.
pub(crate) const SIGN_BIT: u32 = 0x8000_0000;
