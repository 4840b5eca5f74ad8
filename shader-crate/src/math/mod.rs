//! The functions that `core` lacks, with the same result on every target: square root and floor, and trigonometry made
//! of plain arithmetic.

#[cfg(all(any(not(feature = "std"), test), not(target_arch = "spirv")))]
mod bare;
mod trig;

pub use trig::*;

use glam::Vec3;

/// Square root, correctly rounded on the CPU; on a GPU as exact as its `sqrt`.
#[inline(always)]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(all(not(feature = "std"), not(target_arch = "spirv")))]
    return bare::sqrt(x);
    #[cfg(all(not(feature = "std"), target_arch = "spirv"))]
    return libm::sqrtf(x);
}

/// The largest integer not above `x`, as a float.
#[inline(always)]
pub fn floor(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.floor();
    #[cfg(all(not(feature = "std"), not(target_arch = "spirv")))]
    return bare::floor(x);
    #[cfg(all(not(feature = "std"), target_arch = "spirv"))]
    return libm::floorf(x);
}

/// True where `x` is below zero by at least the least normal number.
///
/// Devices may flush denormals to zero, so a comparison with zero would tell -1e-40 from 0 on some and not on
/// others. This one has the same answer everywhere; both zeros and all denormals count as not negative.
#[inline(always)]
pub fn is_negative(x: f32) -> bool {
    x <= -f32::MIN_POSITIVE
}

/// `x`, or 0 where that is a denormal, which some devices flush.
#[inline(always)]
pub(crate) fn without_denormal(x: f32) -> f32 {
    if x.abs() < f32::MIN_POSITIVE { 0.0 } else { x }
}

/// `-x` where `negative`, else `x`.
#[inline(always)]
pub fn negate_if(negative: bool, x: f32) -> f32 {
    if negative { -x } else { x }
}

/// `a . b`, summed from x to z.
#[inline(always)]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    (a.x * b.x + a.y * b.y) + a.z * b.z
}

/// The larger of two numbers, neither of which is NaN nor both 0.
#[inline(always)]
pub fn max(x: f32, y: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    return libm::fmaxf(x, y);
    #[cfg(not(target_arch = "spirv"))]
    return if x < y { y } else { x };
}

/// `v` at unit length, to within 2 ULP. `v . v` must be a normal number.
#[inline(always)]
pub fn normalize(v: Vec3) -> Vec3 {
    v * (1.0 / sqrt(dot(v, v)))
}
