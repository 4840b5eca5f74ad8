//! Normalised fixed point: unorm of 1 to 23 bits, snorm of 2 to 22.
//!
//! Source: Cigolle et al. 2014, section 1.2. Vulkan's `*_UNORM` and `*_SNORM` formats convert alike, save that they
//! leave the rounding of ties open; here ties go to the even integer.

use super::{
    SIGN_BIT, TWO_23, exp2, mask, max, min, nearest_code, ratio, signed_integer, signed_integer_at,
    snorm_quotient,
};
use glam::Vec2;

/// Largest integer of a unorm of `bits` bits, `2^bits - 1`. `bits` is 1 to 23.
#[inline(always)]
pub const fn unorm_max(bits: u32) -> f32 {
    ((1 << bits) - 1) as f32
}

/// Largest integer of an snorm of `bits` bits, `2^(bits-1) - 1`. `bits` is 2 to 24.
#[inline(always)]
pub const fn snorm_max(bits: u32) -> f32 {
    ((1 << (bits - 1)) - 1) as f32
}

/// The unorm code of `r`: `round(clamp(r, 0, 1) (2^bits - 1))` (eq. 1). `bits` is 1 to 23. NaN gives 0.
#[inline(always)]
pub fn unorm_encode(r: f32, bits: u32) -> u32 {
    if is_nan(r) { 0 } else { unorm_code(r, bits) }
}

/// [`unorm_encode`] for `r` that is not NaN; NaN gives any code.
///
/// The sum with 2^23 rounds and converts, as in [`nearest_code`].
#[inline(always)]
pub fn unorm_code(r: f32, bits: u32) -> u32 {
    (min(max(r, 0.0), 1.0) * unorm_max(bits) + TWO_23).to_bits() & mask(bits)
}

/// The number that a unorm code stands for: `i / (2^bits - 1)` (eq. 2), 0 to 1. Bits above `bits` (1 to 23) are
/// ignored.
#[inline(always)]
pub fn unorm_decode(code: u32, bits: u32) -> f32 {
    snorm_quotient((code & mask(bits)) as f32, bits + 1)
}

/// The snorm code of `r`: `round(clamp(r, -1, 1) (2^(bits-1) - 1))`, in two's complement. `bits` is 2 to 22. The
/// pattern of `-2^(bits-1)` is never written. NaN gives 0.
#[inline(always)]
pub fn snorm_encode(r: f32, bits: u32) -> u32 {
    if is_nan(r) { 0 } else { snorm_code(r, bits) }
}

/// True for NaN, by comparing integers, since a GPU need not compare NaN as IEEE 754 says.
#[inline(always)]
pub(crate) fn is_nan(x: f32) -> bool {
    x.to_bits() & !SIGN_BIT > f32::INFINITY.to_bits()
}

/// [`snorm_encode`] for `r` that is not NaN; NaN gives any code.
#[inline(always)]
pub fn snorm_code(r: f32, bits: u32) -> u32 {
    nearest_code(min(max(r, -1.0), 1.0) * snorm_max(bits), bits)
}

/// The number that an snorm code stands for: `clamp(i / (2^(bits-1) - 1), -1, 1)`. Bits above `bits` (2 to 24) are
/// ignored.
#[inline(always)]
pub fn snorm_decode(code: u32, bits: u32) -> f32 {
    snorm_quotient(snorm_integer(code, bits), bits)
}

/// The integer of an snorm code as a float, with `-2^(bits-1)` taken as `-(2^(bits-1) - 1)`: both stand for -1.
#[inline(always)]
pub fn snorm_integer(code: u32, bits: u32) -> f32 {
    max(signed_integer(code, bits), -snorm_max(bits))
}

/// Division of whole numbers by the largest integer of an snorm of 2 to 24 bits, rounded correctly on every device: GPUs need
/// not divide exactly.
///
/// With `h = 2^(1 - bits)`, `1 / m` is `h + h / m`, or `h + h^2 + h^2 / m` where `x` leaves room for it: products of all but
/// the last summand with `x` are exact, and the last is so small that its rounding does not show. Tests go through all
/// whole `x`.
#[derive(Clone, Copy, Debug)]
pub struct SnormDivision {
    high: f32,
    low: f32,
}

impl SnormDivision {
    /// The division for an snorm of `bits` bits. For constants only: a device would divide.
    pub const fn new(bits: u32) -> Self {
        let (h, reciprocal) = (exp2(1 - bits as i32), ratio(1.0, snorm_max(bits)));
        if bits <= 11 {
            Self { high: h + h * h, low: h * h * reciprocal }
        } else {
            Self { high: h, low: h * reciprocal }
        }
    }

    /// The quotient `x / snorm_max(bits)`, for `x` up to `snorm_max(bits)`.
    #[inline(always)]
    pub fn of(self, x: f32) -> f32 {
        x * self.high + x * self.low
    }
}

/// The integers of a code of two snorms of `bits` bits (2 to 16): x in the low bits, y in the next.
#[inline(always)]
pub fn snorm_integers(code: u32, bits: u32) -> Vec2 {
    let m = snorm_max(bits);
    Vec2::new(max(signed_integer_at(code, 0, bits), -m), max(signed_integer_at(code, bits, bits), -m))
}

/// Both components clamped to \[-1, 1\]; 0 where one is NaN.
#[inline(always)]
pub(crate) fn snorm_clamp(e: Vec2) -> Vec2 {
    let clamped = Vec2::new(min(max(e.x, -1.0), 1.0), min(max(e.y, -1.0), 1.0));
    if is_nan(e.x.abs() + e.y.abs()) { Vec2::ZERO } else { clamped }
}

/// Maps \[-1, 1\] to \[0, 1\], for a UNORM format.
#[inline(always)]
pub(crate) fn biased(e: Vec2) -> Vec2 {
    Vec2::new(e.x * 0.5 + 0.5, e.y * 0.5 + 0.5)
}

/// The inverse of [`biased`].
#[inline(always)]
pub(crate) fn unbiased(e: Vec2) -> Vec2 {
    Vec2::new(e.x * 2.0 - 1.0, e.y * 2.0 - 1.0)
}

/// True for a number that stands for a set bit: 1/2 and more. False for NaN.
#[inline(always)]
pub(crate) fn is_set(x: f32) -> bool {
    x >= 0.5 && !is_nan(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_of_every_width_round_trips() {
        for bits in 1..=16 {
            for code in 0..1u32 << bits {
                assert_eq!(unorm_encode(unorm_decode(code, bits), bits), code, "unorm{bits}");
            }
        }
        for bits in 2..=16 {
            let lowest = 1 << (bits - 1);
            for code in (0..1u32 << bits).filter(|&code| code != lowest) {
                assert_eq!(snorm_encode(snorm_decode(code, bits), bits), code, "snorm{bits}");
            }
            assert_eq!(snorm_decode(lowest, bits), -1.0);
            assert_eq!(snorm_decode(lowest + 1, bits), -1.0);
        }
    }

    /// Equations 1 and 2 and the snorm pair in float64, with Rust's own rounding, ties to even.
    #[test]
    fn equals_the_equations_up_to_the_rounding_of_f32() {
        for bits in 2..=22 {
            let most = |bits: u32| 2f64.powi(bits as i32) - 1.0;
            let is_tie = |exact: f64| (exact.abs().fract() - 0.5).abs() <= 2f64.powi(bits as i32 - 23);
            for step in -3000..=3000 {
                let r = step as f32 / 2500.0;
                let unorm = f64::from(r).clamp(0.0, 1.0) * most(bits);
                let expected = unorm.round_ties_even() as u32;
                assert!(is_tie(unorm) || unorm_encode(r, bits) == expected, "unorm{bits} of {r}");
                let snorm = f64::from(r).clamp(-1.0, 1.0) * most(bits - 1);
                let expected = snorm.round_ties_even() as i32 as u32 & mask(bits);
                assert!(is_tie(snorm) || snorm_encode(r, bits) == expected, "snorm{bits} of {r}");
            }
        }
    }

    /// Compares with the CPU's own division, which is correct, for all whole numbers, and for those 7/16 below, which
    /// the parallel projections have. Up to three of the latter may be off where there is no room for `h^2`; they have
    /// no room at all beyond 22 bits.
    #[test]
    fn division_is_correctly_rounded() {
        for bits in 2..=24 {
            let (m, division) = (snorm_max(bits), SnormDivision::new(bits));
            let is_off = |x: &f32| division.of(*x) != x / m;
            let whole = || (0..1 << (bits - 1)).map(|i| i as f32);
            assert_eq!(whole().find(is_off), None, "{bits} bits");
            let below = whole().skip(1).map(|x| x - 0.4375).filter(is_off).count();
            assert!(bits > 22 || below <= if bits <= 11 { 0 } else { 3 }, "{bits} bits: {below}");
        }
    }

    /// Widths whose largest integers are 3 and 127: halves of them are exact.
    #[test]
    fn ties_go_to_the_even_integer() {
        assert_eq!([0.5, 0.0, 1.0].map(|r| unorm_encode(r, 8)), [128, 0, 255]);
        assert_eq!([0.5, -0.5].map(|r| snorm_encode(r, 8)), [64, 0xc0]);
        assert_eq!([0.5, -0.5].map(|r| snorm_encode(r, 3)), [2, 6]);
    }

    #[test]
    fn ends_zero_and_nan() {
        for bits in 2..=23 {
            assert_eq!(unorm_encode(1.0, bits), mask(bits));
            assert_eq!(unorm_encode(f32::INFINITY, bits), mask(bits));
            assert_eq!(unorm_encode(f32::NAN, bits), 0);
            assert_eq!(unorm_decode(!0, bits), 1.0);
        }
        for bits in 2..=22 {
            assert_eq!(snorm_encode(1.0, bits), mask(bits - 1));
            assert_eq!(snorm_encode(f32::NEG_INFINITY, bits), 1 << (bits - 1) | 1);
            assert_eq!(snorm_encode(0.0, bits), 0);
            assert_eq!(snorm_encode(-0.0, bits), 0);
            assert_eq!(snorm_encode(f32::NAN, bits), 0);
        }
    }
}
