//! All divisions and square roots of the codecs.
//!
//! The CPU rounds them correctly. A GPU need not: there they are put right, which `exact` derives, so that all devices give the
//! same bits. Divisions of constants by constants are constants: [`ratio`].

#[cfg(target_arch = "spirv")]
use super::{SIGN_BIT, SnormDivision, exact, flip_sign};
use super::{snorm_max, sqrt};

/// True where a kernel is to take the device's own division and roots.
///
/// False wherever rust-gpu compiles it. In the shipped kernels it is the specialization constant 1: the build of the modules
/// puts that in the place of this function, which it knows by having no parameters and no instructions.
#[cfg(target_arch = "spirv")]
#[inline(never)]
fn is_fast() -> bool {
    false
}

/// The result of the device, or of the CPU, where that rounds correctly or is wanted as it is; else the exact one.
macro_rules! exactly {
    ($device:expr, $exact:expr) => {{
        #[cfg(not(target_arch = "spirv"))]
        return $device;
        #[cfg(target_arch = "spirv")]
        return if is_fast() { $device } else { $exact };
    }};
}

/// `a / b`, rounded to nearest, for `a` of 0 or more, positive `b` below 2^126, and a quotient below 2^127. Numbers are normal
/// or 0; quotients below 2^-100 may be 0. Of other numbers, GPUs make anything.
#[inline(always)]
pub fn quotient(a: f32, b: f32) -> f32 {
    exactly!(a / b, exact::quotient(a, b, 1.0 / b))
}

/// [`quotient`] for numbers of either sign.
#[inline(always)]
pub fn signed_quotient(a: f32, b: f32) -> f32 {
    exactly!(a / b, {
        let magnitude = exact::quotient(a.abs(), b.abs(), 1.0 / b.abs());
        flip_sign(magnitude, (a.to_bits() ^ b.to_bits()) & SIGN_BIT)
    })
}

/// `m / b`, rounded to nearest, for `b` from 2^-100 to 2^94 and a positive constant `m` from 1 to 2^24; cheaper than
/// [`quotient`] where `m` has up to 15 bits.
#[inline(always)]
pub fn over(m: f32, b: f32) -> f32 {
    exactly!(m / b, exact::over(m, b, 1.0 / b))
}

/// `1 / b`, rounded to nearest, for `b` from 2^-100 to 2^94.
#[inline(always)]
pub fn reciprocal(b: f32) -> f32 {
    over(1.0, b)
}

/// `x / snorm_max(bits)`, rounded to nearest, for whole `x` up to that and constant `bits`: by [`SnormDivision`], which is
/// cheaper than [`signed_quotient`].
///
/// [`SnormDivision`]: super::SnormDivision
#[inline(always)]
pub(crate) fn snorm_quotient(x: f32, bits: u32) -> f32 {
    exactly!(x / snorm_max(bits), SnormDivision::new(bits).of(x))
}

/// `a / b` of constants: the build of the modules leaves its result.
#[inline(always)]
pub const fn ratio(a: f32, b: f32) -> f32 {
    a / b
}

/// The square root of `x`, rounded to nearest, for `x` of +0 or positive and finite; denormals may count as 0. Of other
/// numbers, GPUs make anything.
#[inline(always)]
pub fn root(x: f32) -> f32 {
    exactly!(sqrt(x), exact::root(x, 1.0 / sqrt(x)))
}

/// `1 / root(x)`, for positive normal `x`: two roundings to nearest.
#[inline(always)]
pub fn inverse_root(x: f32) -> f32 {
    exactly!(1.0 / sqrt(x), exact::inverse_root(x, 1.0 / sqrt(x)))
}

/// [`inverse_root`], cheaper, of an `x` whose root is from `1 + 2^-17` to `2 - 2^-16` times `unit`, a constant power of
/// two from 2^-32 to 2^62.
#[inline(always)]
#[cfg_attr(not(target_arch = "spirv"), expect(unused_variables, reason = "the CPU needs no start"))]
pub(crate) fn inverse_root_near(x: f32, unit: f32) -> f32 {
    exactly!(1.0 / sqrt(x), exact::inverse_root_near(x, unit, 1.0 / sqrt(x)))
}
