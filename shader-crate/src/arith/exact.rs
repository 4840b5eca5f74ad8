//! Division and square root, rounded as IEEE 754 says, from a device's own that are some last places off.
//!
//! Vulkan lets a quotient be 2.5 units in the last place (ULP) off, and a root about 5; GPUs multiply by an approximate
//! reciprocal. Integers are exact everywhere. From the device's result, which is the start, a step leads to one of two
//! neighbours, and integers choose: by two remainders modulo 2^32 and one comparison.
//!
//! # Quotients
//!
//! `A` and `B` are the significands of `a` and `b`, whole numbers from 2^23 to 2^24 - 1. With `k` of 23 where `A >= B` and
//! of 24 elsewhere, `T = A 2^k / B` lies from 2^23 to below 2^24: it is the quotient in its own last places, and the float
//! nearest to `a / b` has the significand `Q`, the whole number nearest to `T`.
//!
//! 1. No tie, no carry. With `T = n + 1/2`, `A 2^(k+1)` would be `(2 n + 1) B`, so that 2^(k+1), 2^24 at least, would divide
//!    `B`, which is less. `T` is at most `2^24 (B - 1) / B < 2^24 - 1` where `A < B`, and at most `A` elsewhere.
//! 2. The start. A reciprocal that is `E` ULP off, multiplied by `a` and rounded either way, is at most `2 E + 1` last places
//!    from `T`. Floats' bits count last places, beyond the next power of two as well. So with `E <= 15` the guess
//!    `G`, which begins [`BELOW`] places lower, has `1 <= T - G < 64`, and `(T - G) B = A 2^k - G B` lies between 0 and 2^30:
//!    it is known exactly modulo 2^32.
//! 3. The step. That remainder as a float, times a `1 / B` that is off by less than a part of 2^-9, is within 1/8 of `T - G`;
//!    so its integer part added to `G` gives a `near` with `-1/8 < T - near < 9/8`. `Q` is `near`, or `near + 1` where
//!    `2 (A 2^k - near B) > B`: one comparison of numbers below 2^26 settles it.
//!
//! # Quotients of constants
//!
//! Where `A` has 15 bits and 9 zeros below them, `A 2^k` is 0 modulo 2^32 for any `k` that occurs: the remainder of a float
//! `q` is the product of its own significand `G` with `B`, whichever power of two `q` lies above. So the step can be a sum
//! of floats, in cheaper instructions.
//!
//! 1. The start is raised by [`ABOVE`]. It lies above the quotient by 16 to 48 parts of 2^-23, so by 15 to 96 last places,
//!    and `G B - A 2^k` between 0 and 2^31. `q b` is about `a`, not less, so that the sum of the two exponents is that of `a`
//!    (`k` is 23) or one less (24), as its parity says.
//! 2. The step down is `G B - A 2^k` last places of `a` at `2^-k`, over `b`, and longer by [`MORE`]. `near` is the sum, to
//!    nearest, with `T - near` from `1/18 - 1/2` to `3/8 + 1/2`, and errors of 2^-10. Should `near` lie below a power of
//!    two, and `T` above it, it is from `1/9 - 1/2` to `3/4 + 1/2` in the places of `near`. The comparison is as above.
//!
//! # Roots
//!
//! The significand of the root of `x` is the whole number nearest to `T = sqrt(N)`, where `N` is `x`'s significand times
//! 2^23 or 2^24, as the exponent asks: from 2^46 to below 2^48. A tie would need `N = n^2 + n + 1/4`. From `1 / sqrt(x)`, off by
//! up to 14 ULP, the same guess follows; `N - G^2 = (T - G) (T + G)` is below 2^31, divided by `2 T` it is `T - G` but for
//! `(T - G)^2 / 2 T < 2^-12`, and `T > near + 1/2` where `N > near^2 + near`. The reciprocal of the root starts
//! from the same float: it is a ULP off the exact start at most.
//!
//! Where the root is so far from powers of two that none lies between it and the start, nor between their reciprocals, all
//! exponents are known beforehand, and the steps are sums of floats: from a start that is up to 30 places off on either
//! side, `G^2 + G - N` and `G B + B / 2` lead to the middle of the two candidates for `near`, half a place below `T`.
//!
//! The start may be rounded in any way, and the compiler may reorder it as it likes. Steps that are sums of floats are
//! rounded to nearest; powers of two join them by integers, so that a compiler that ignores NoContraction, as naga does,
//! finds no common factor to take out, which would round twice.

use super::{NEGLIGIBLE, SIGN_BIT, exp2, integer_part};

/// How far below the start the search begins: so far that the start, 31 places off at most, is never above the result, and
/// no remainder is negative.
const BELOW: u32 = 32;

/// Raises the start of a quotient of a constant: by twice what it can be off, so that it is above the result.
const ABOVE: f32 = 1.0 + 1.0 / 262_144.0;

/// Lengthens the step down from there: by 1/18 to 3/8 of a place, so that one comparison is enough.
const MORE: f32 = 1.0 + 1.0 / 256.0;

/// 2^23, the least significand: the part of a float that its bits leave out.
const HIDDEN: u32 = 0x80_0000;

/// The bits of a float's exponent.
const EXPONENT: u32 = 0x7f80_0000;

/// Mask of a significand. GPUs multiply integers of 24 bits at four times the speed of others, where the compiler sees that
/// they are.
const SIGNIFICAND: u32 = 0xff_ffff;

/// The bits of a power of two.
const fn power(exponent: i32) -> u32 {
    exp2(exponent).to_bits()
}

#[inline(always)]
fn significand(bits: u32) -> u32 {
    bits & (HIDDEN - 1) | HIDDEN
}

/// `a / b` for `a` of 0 or more and positive `b`, both normal; 0 where that is below 2^-100. `inverse` is the device's `1 / b`.
#[inline(always)]
pub(super) fn quotient(a: f32, b: f32, inverse: f32) -> f32 {
    let (a_bits, b_bits) = (a.to_bits(), b.to_bits());
    let (dividend, divisor) = (significand(a_bits), significand(b_bits));
    let less = if dividend < divisor { 1 } else { 0 };
    let exponent = b_bits & EXPONENT;
    let rough = a * inverse;
    // The bits of the power of two below the quotient, less the hidden one.
    let first = (a_bits & EXPONENT).wrapping_add(power(-1) - (less << 23)).wrapping_sub(exponent);
    let guess = rough.to_bits().wrapping_sub(first).wrapping_sub(BELOW) & SIGNIFICAND;
    // About -1 over the divisor.
    let minus_part = inverse.to_bits().wrapping_add(exponent).wrapping_add(SIGN_BIT.wrapping_sub(150 << 23));
    let found = nearest(dividend << (23 + less), guess, divisor, f32::from_bits(minus_part));
    if rough < NEGLIGIBLE { 0.0 } else { f32::from_bits(first.wrapping_add(found)) }
}

/// The whole number nearest to `dividend / divisor`, from a guess that is 1 to 64 less; `dividend` is modulo 2^32.
/// `minus_part` is about `-1 / divisor`.
#[inline(always)]
fn nearest(dividend: u32, guess: u32, divisor: u32, minus_part: f32) -> u32 {
    let excess = guess.wrapping_mul(divisor).wrapping_sub(dividend) as i32;
    let step = integer_part(excess as f32 * minus_part) as u32;
    let near = guess.wrapping_add(step) & SIGNIFICAND;
    let rest = near.wrapping_mul(divisor).wrapping_sub(dividend);
    near + ((rest << 1).wrapping_add(divisor) >> 31)
}

/// `m / b` for a positive constant `m` and positive `b`; `inverse` is the device's `1 / b`.
#[inline(always)]
pub(super) fn over(m: f32, b: f32, inverse: f32) -> f32 {
    let (m_bits, b_bits) = (m.to_bits(), b.to_bits());
    if significand(m_bits) << 23 != 0 {
        return quotient(m, b, inverse);
    }
    let rough = m * ABOVE * inverse;
    let divisor = significand(b_bits);
    let excess = significand(rough.to_bits()).wrapping_mul(divisor) as i32 as f32;
    // The exponents of `b` and of the start add up to that of `m`, or to one less.
    let is_even = (m_bits ^ b_bits ^ rough.to_bits()) & HIDDEN;
    // For a divisor from 1 to 2.
    let minus_step = f32::from_bits((m_bits & EXPONENT).wrapping_add((-MORE).to_bits() - (174 << 23)));
    let near = rough + (excess * minus_step) * f32::from_bits(inverse.to_bits().wrapping_add(is_even));
    let rest = significand(near.to_bits()).wrapping_mul(divisor);
    next_if(near, (rest << 1).wrapping_add(divisor))
}

/// `near`, or the next float where the top bit of `remainder` is set.
#[inline(always)]
fn next_if(near: f32, remainder: u32) -> f32 {
    f32::from_bits(near.to_bits().wrapping_add(remainder >> 31))
}

/// The root of `x`, which is normal, or 0 and denormal: 0. `inverse` is about `1 / sqrt(x)`.
#[inline(always)]
pub(super) fn root(x: f32, inverse: f32) -> f32 {
    if x.to_bits() < HIDDEN { 0.0 } else { root_of_normal(x, inverse) }
}

#[inline(always)]
fn root_of_normal(x: f32, inverse: f32) -> f32 {
    let bits = x.to_bits();
    let exponent = bits.wrapping_add(power(0)) >> 1 & (EXPONENT | SIGN_BIT);
    let square = bits << (24 - (bits >> 23 & 1));
    let rough = (x * inverse).to_bits();
    let guess = rough.wrapping_sub(exponent).wrapping_add(HIDDEN - BELOW) & SIGNIFICAND;
    let remainder = square.wrapping_sub(guess.wrapping_mul(guess)) as i32;
    let half_part = f32::from_bits(inverse.to_bits().wrapping_add(exponent).wrapping_sub(151 << 23));
    let step = integer_part(remainder as f32 * half_part) as u32;
    let near = guess.wrapping_add(step) & SIGNIFICAND;
    let left = square.wrapping_sub(near.wrapping_mul(near)) as i32;
    let found = near + if left > near as i32 { 1 } else { 0 };
    f32::from_bits(exponent.wrapping_add(found).wrapping_sub(HIDDEN))
}

/// `1 / root(x)` for normal `x`, rounded twice: as the root, and as the quotient. `inverse` is about that.
#[inline(always)]
pub(super) fn inverse_root(x: f32, inverse: f32) -> f32 {
    over(1.0, root_of_normal(x, inverse), inverse)
}

/// [`inverse_root`] of an `x` whose root is from `1 + 2^-17` to `2 - 2^-16` times `unit`, a power of two from 2^-32 to
/// 2^62: cheaper, since no number on the way changes its exponent.
#[inline(always)]
pub(super) fn inverse_root_near(x: f32, unit: f32, inverse: f32) -> f32 {
    // The reciprocal times 2^-47.
    let half_places = inverse.to_bits().wrapping_sub(47 << 23);
    let rough = x * inverse;
    // The significand of `x` times 2^23, or 2^24 in the upper half of the range.
    let square = x.to_bits().wrapping_shl((x.to_bits() >> 23).wrapping_sub(2 * (unit.to_bits() >> 23) - 150));
    let above_middle = |s: u32| s.wrapping_mul(s).wrapping_add(s.wrapping_sub(square));
    let excess = above_middle(significand(rough.to_bits())) as i32 as f32;
    let of_square = half_places.wrapping_add((unit * unit).to_bits()).wrapping_sub(power(0));
    let near = rough - excess * f32::from_bits(of_square);
    let root = next_if(near, above_middle(significand(near.to_bits())));

    let divisor = significand(root.to_bits());
    let above_middle = |s: u32| s.wrapping_mul(divisor).wrapping_add(divisor >> 1);
    let excess = above_middle(significand(inverse.to_bits())) as i32 as f32;
    let near = inverse - excess * f32::from_bits(half_places);
    next_if(near, above_middle(significand(near.to_bits())))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The greatest error of a start that is made good, in ULP; of roots one less.
    const MOST: i32 = 15;

    /// A device's result: the CPU's, moved by up to `most` ULP, which operands choose.
    fn moved(exact: f32, by: u32, most: i32) -> f32 {
        let steps = (by.wrapping_mul(0x9e37_79b9) >> 16) as i32 % (2 * most + 1) - most;
        f32::from_bits(exact.to_bits().wrapping_add_signed(steps))
    }

    fn quotient_is_exact(a: f32, b: f32) -> bool {
        quotient(a, b, moved(1.0 / b, a.to_bits() ^ b.to_bits(), MOST)) == a / b
    }

    /// The next of a sequence of numbers (Marsaglia 2003).
    fn next(state: &mut u64) -> u64 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        *state
    }

    /// All significands, in four ranges of exponents.
    #[test]
    fn roots_are_exact() {
        for bits in 0..1u32 << 24 {
            for exponent in [1i32, 63, 127, 251] {
                let x = f32::from_bits(bits + ((exponent as u32) << 23));
                let inverse = moved(1.0 / x.sqrt(), bits, MOST - 1);
                assert_eq!(root(x, inverse), x.sqrt(), "{x:e}");
                assert_eq!(inverse_root(x, inverse), 1.0 / x.sqrt(), "{x:e}");
                let unit = exp2((exponent - 127).div_euclid(2));
                let part = x.sqrt() / unit - 1.0;
                if exponent > 1 && part >= exp2(-17) && part <= 1.0 - exp2(-16) {
                    assert_eq!(inverse_root_near(x, unit, inverse), 1.0 / x.sqrt(), "{x:e}");
                }
            }
        }
        assert_eq!([0.0, 1e-40].map(|x: f32| root(x, 1.0 / x.sqrt())), [0.0; 2]);
    }

    /// All significands: reciprocals, and quotients of the largest integers of snorm, unorm and half-step codes, of small
    /// constants, and of constants with all 24 bits.
    #[test]
    fn quotients_of_constants_are_exact() {
        let integers = (3..=24).map(|bits| ((1u32 << bits) - 1) as f32);
        let constants: Vec<f32> = integers.chain([1.0, 2.0, 3.0, 4097.0, 1.224_744_9, 0.3795]).collect();
        for bits in 0..1u32 << 23 {
            for exponent in [27, 126, 220] {
                let b = f32::from_bits(bits + (exponent << 23));
                let inverse = moved(1.0 / b, bits, MOST);
                assert_eq!(over(1.0, b, inverse), 1.0 / b, "{b:e}");
                let m = constants[(bits.wrapping_mul(exponent) >> 3) as usize % constants.len()];
                assert_eq!(over(m, b, inverse), m / b, "{m} / {b:e}");
            }
        }
        // Each constant over divisors next to it and to the powers of two, where the significand's comparison turns.
        for m in constants {
            for near in [m, 1.0, 2.0] {
                for step in -4096..=4096 {
                    let b = f32::from_bits(near.to_bits().wrapping_add_signed(step));
                    assert_eq!(over(m, b, moved(1.0 / b, step as u32, MOST)), m / b, "{m} / {b:e}");
                }
            }
        }
    }

    /// Any operands, from 2^-27 to 2^27.
    #[test]
    fn quotients_are_exact() {
        let mut state = 26;
        let mut operand = || {
            let bits = next(&mut state) as u32;
            f32::from_bits((bits & (HIDDEN - 1)) + ((100 + (bits >> 23) % 54) << 23))
        };
        for _ in 0..20_000_000 {
            let (a, b) = (operand(), operand());
            assert!(quotient_is_exact(a, b), "{a:e} / {b:e}");
        }
        // The ends of the range.
        for _ in 0..1_000_000 {
            let bits = next(&mut state);
            let float =
                |bits: u64, exponent: u32| f32::from_bits((bits as u32 & (HIDDEN - 1)) + (exponent << 23));
            for [of_a, of_b] in [[252, 252], [253, 127], [28, 127], [253, 152], [1, 1], [1, 99]] {
                let (a, b) = (float(bits, of_a), float(bits >> 32, of_b));
                assert!(quotient_is_exact(a, b), "{a:e} / {b:e}");
            }
        }
        assert!(quotient_is_exact(0.0, 3.0) && quotient_is_exact(1.0, 1.0));
        assert_eq!(quotient(1e-30, 1e10, 1e-10), 0.0);
    }

    /// Significands of numerators and divisors whose quotient lies next to the middle between two floats: `A 2^(k+1)` is
    /// `n B + r` for an odd `n` and a small odd `r`, which `n` follows from modulo 2^(k+1).
    fn next_to_the_middle(state: &mut u64) -> Option<(u32, u32)> {
        let bits = next(state);
        let divisor = bits as u32 & (HIDDEN - 1) | HIDDEN | 1;
        let rest = 2 * ((bits >> 32) as i64 % 8) - 7;
        // Newton's iteration doubles the bits that are right; three are to begin with.
        let inverse = (0..4).fold(divisor, |x, _| x.wrapping_mul(2u32.wrapping_sub(divisor.wrapping_mul(x))));
        let k = 23 + (bits >> 40) as u32 % 2;
        let odd = (inverse.wrapping_mul((-rest) as u32) & ((2 << k) - 1)) | 1 << 24;
        let product = i64::from(odd) * i64::from(divisor) + rest;
        let numerator = u32::try_from(product >> (k + 1)).ok()?;
        let fits = product & ((2 << k) - 1) == 0 && numerator >> 23 == 1 && odd >> 24 == 1;
        (fits && (numerator < divisor) == (k == 24)).then_some((numerator, divisor))
    }

    /// 10^8 quotients that a comparison off by 2 would round to the wrong side.
    #[test]
    fn hard_quotients_are_exact() {
        let (mut state, mut hard, mut caught) = (1, 0, 0);
        while hard < 100_000_000 {
            let Some((numerator, divisor)) = next_to_the_middle(&mut state) else { continue };
            hard += 1;
            let [a, b] = [numerator, divisor].map(|significand| significand as f32);
            assert!(quotient_is_exact(a, b), "{a} / {b}");
            if hard % 100 == 0 {
                // The comparison is of twice the dividend: one more or less is a comparison off by 2.
                let k = if numerator < divisor { 24 } else { 23 };
                let guess = (u64::from(numerator) << k) / u64::from(divisor) - 9;
                let part = -1.0 / divisor as f32;
                let of =
                    |change: u32| nearest((numerator << k).wrapping_add(change), guess as u32, divisor, part);
                caught += u32::from(of(1) != of(0) || of(u32::MAX) != of(0));
            }
        }
        assert!(caught > 100_000, "{caught} of 10^6 quotients tell a wrong comparison");
    }
}
