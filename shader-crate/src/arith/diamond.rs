//! Angles as places on the diamond `|x| + |y| = 1`, without trigonometry: [`frame`](crate::frame) describes them.

use super::{SIGN_BIT, TWO_23, exp2, flip_sign, mask, ratio, signed_quotient};
use core::f32::consts::{FRAC_2_PI, PI};
use glam::Vec2;

coefficients! {
    /// `w = v (WARP_0 + WARP_1 v^2 + WARP_2 v^4)`, near `tan(pi v / 4)`: equal steps of v from -1 to 1 are angles of
    /// `atan(w)` that are equal but for 0.26 %. The least maximum that three terms allow is 0.25 %; these are rounded
    /// to multiples of 2^-12 so that their sum is 1 and both ends are exact.
    pub WARP_0 = 3225.0 / 4096.0, WARP_1 = 624.0 / 4096.0, WARP_2 = 247.0 / 4096.0;

    /// The inverse warp, `v = w + w (1 - u) (UNWARP_0 + u (UNWARP_1 + u UNWARP_2))` with `u = w^2`: within 3.0e-5.
    pub UNWARP_0 = 0.27020066, UNWARP_1 = -0.13198552, UNWARP_2 = 0.0392082;
}

/// The place on a side of the diamond, -1 to 1, for `v` of -1 to 1. Both ends are exact.
#[inline(always)]
fn warp(v: f32) -> f32 {
    let u = v * v;
    v * (WARP_0 + u * (WARP_1 + u * WARP_2))
}

/// The inverse of [`warp`]: within 3.0e-5, which is 0.4 % of half a step of 9 bits. For more bits a step of Newton's
/// method follows and leaves only rounding.
#[inline(always)]
fn unwarp<const BITS: u32>(w: f32) -> f32 {
    let u = w * w;
    let v = w + w * ((1.0 - u) * (UNWARP_0 + u * (UNWARP_1 + u * UNWARP_2)));
    if BITS <= 9 {
        return v;
    }
    // The slope of `warp` is that of tan(pi v / 4) but for 0.26 %.
    v + signed_quotient((w - warp(v)) * (FRAC_2_PI * 2.0), 1.0 + u)
}

/// The code of the angle of (x, y) from +X towards +Y, for `sum = |x| + |y|`, a normal number below 2^126. The upper
/// two of its `BITS` bits (4 to 21) count quarter turns.
#[inline(always)]
pub(crate) fn diamond_code<const BITS: u32>(x: f32, y: f32, sum: f32) -> u32 {
    // Odd quarter turns are entered where |x| is 0: there the side runs from |y| to |x|.
    let below = y.to_bits() & SIGN_BIT;
    let odd = (x.to_bits() & SIGN_BIT) ^ below;
    let w = signed_quotient(flip_sign(y.abs() - x.abs(), odd), sum);

    let half_places = (1 << (BITS - 3)) as f32;
    let place = half_places * (unwarp::<BITS>(w) + 1.0) + TWO_23;
    let quarters = (below >> (32 - BITS)) | (odd >> (33 - BITS));
    // The last place of a quarter is the first one of the next, and that of the last quarter code 0.
    quarters.wrapping_add(place.to_bits()) & mask(BITS)
}

/// The place of an angle's code: a point of the diamond `|x| + |y| = 2`. Zeros may be -0.
#[inline(always)]
pub(crate) fn diamond_point<const BITS: u32>(code: u32) -> Vec2 {
    let place = (code & mask(BITS - 2)) as f32;
    let v = place * exp2(3 - BITS as i32) - 1.0;
    let odd = (code << (33 - BITS)) & SIGN_BIT;
    let below = (code << (32 - BITS)) & SIGN_BIT;
    let w = flip_sign(warp(v), odd);
    Vec2::new(flip_sign(1.0 - w, odd ^ below), flip_sign(1.0 + w, below))
}

/// An upper bound of a code's error in radians, but for the rounding of `f32`: half a step, the 0.26 % by which steps
/// differ, and 0.4 % of half a step for [`unwarp`] at 9 bits and less.
pub(crate) const fn diamond_error(bits: u32) -> f32 {
    ratio(PI, (1u32 << bits) as f32) * 1.0026 * if bits <= 9 { 1.004 } else { 1.0 }
}
