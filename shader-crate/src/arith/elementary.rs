//! The functions that `core` lacks. All but `sqrt` on a GPU give the same result on every target, NaN apart.

#[cfg(all(not(feature = "std"), not(target_arch = "spirv")))]
use super::bare;

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

/// The larger of two numbers. Unspecified: which of two zeros, and the result where one is NaN.
#[inline(always)]
pub fn max(x: f32, y: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    return libm::fmaxf(x, y);
    #[cfg(not(target_arch = "spirv"))]
    return if x < y { y } else { x };
}

/// The smaller of two numbers. Unspecified: which of two zeros, and the result where one is NaN.
#[inline(always)]
pub fn min(x: f32, y: f32) -> f32 {
    #[cfg(target_arch = "spirv")]
    return libm::fminf(x, y);
    #[cfg(not(target_arch = "spirv"))]
    return if y < x { y } else { x };
}
