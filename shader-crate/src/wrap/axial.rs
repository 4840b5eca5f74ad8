//! Axes: directions for which v and -v are the same, such as fibres, crystal axes and the normals of thin leaves.
//!
//! An axis has one end in half of the sphere, so that the codes of a hemisphere serve, with their error: of the angle
//! `e` between an encoded and a decoded vector, it is `min(e, 180 - e)`.
//!
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `axial16` | 0.239 | 0.552 | 0.553 |
//! | `axial24` | 0.0148 | 0.0343 | 0.0343 |
//! | `axial32` | 0.000926 | 0.00214 | 0.00218 |
//! | [`oct16p`](crate::oct), which tells v from -v | 0.315 | 0.638 | 0.638 |
//!
//! * Layout: that of [`hemioct`](crate::hemioct), whose decoder decodes. An encoder writes one code for an axis, of the
//!   end whose first component that is not 0, of z, x and y in this order, is positive. (The code of the other end of
//!   an axis on the equator, z = 0, is never written, and decodes to that end.)
//! * The axes of the coordinates are exact. What an encoder writes decodes to a vector that encodes to the same code.
//! * A vector without a usable direction gets the code of Z. [`OrNull`](crate::OrNull) tells it apart.
//! * Weakness: a decoded vector jumps to its opposite where an axis crosses the equator. Compare and average neighbours
//!   as axes, by `v v^T` or after turning one to the other.
//!
//! ```
//! use unitvec::{Axial16, Codec};
//!
//! let code = Axial16::encode([0.0, -1.0, 0.0]);
//! assert_eq!(Axial16::decode::<[f32; 3]>(code), [0.0, 1.0, 0.0]);
//! ```

use crate::arith::{is_negative, mask};
use crate::codec::{Codec, Width};
use crate::hemioct::{HemiOct, HemiOctPrecise};
use core::marker::PhantomData;
use glam::Vec3;

/// The end of the axis of `v` whose first component that is not 0, of z, x and y, is positive. Denormals count as 0.
#[inline(always)]
fn end(v: Vec3) -> Vec3 {
    let counts = |x: f32| x.abs() >= f32::MIN_POSITIVE;
    let horizontal = if counts(v.x) { v.x } else { v.y };
    if is_negative(if counts(v.z) { v.z } else { horizontal }) { -v } else { v }
}

/// `code` of `bits` bits, or that of the opposite direction if it is one of the equator with x < 0, or with x = 0 and
/// y < 0.
///
/// The equator is the border of the square, where one of x + y and x - y is m or -m. Of its ends, the one sought has m
/// as the first or, unless the first is -m, as the second.
#[inline(always)]
fn one_of_two(code: u32, bits: u32) -> u32 {
    let (half, most, whole) = (bits / 2, mask(bits / 2 - 1), mask(bits / 2));
    let least = whole - most + 1;
    let (u, v) = (code & whole, code >> half);
    let opposite = (0u32.wrapping_sub(u) & whole) | ((0u32.wrapping_sub(v) & whole) << half);
    if u == least || (v == least && u != most) { opposite } else { code }
}

/// The codec `C` of a hemisphere, [`HemiOctPrecise`] of 16, 24 or 32 bits, for axes: v and -v get the same code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Axial<C>(PhantomData<C>);

/// Axes in 16 bits: at most 0.553 degrees off.
pub type Axial16 = Axial<HemiOctPrecise<16>>;
/// Axes in 24 bits: at most 0.0343 degrees off.
pub type Axial24 = Axial<HemiOctPrecise<24>>;
/// Axes in 32 bits: at most 0.00218 degrees off.
pub type Axial32 = Axial<HemiOctPrecise<32>>;

impl<const BITS: u32> Codec for Axial<HemiOctPrecise<BITS>>
where
    HemiOct<BITS>: Width,
{
    const BITS: u32 = BITS;
    /// The bound of the angle between the axes, which is 90 degrees at most.
    const MAX_ERROR_DEG: f32 = HemiOct::<BITS>::MAX_ERROR_DEG;
    const NULL: Option<[u32; 2]> = HemiOct::<BITS>::NULL;
    type Code = u32;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> u32 {
        one_of_two(HemiOctPrecise::<BITS>::encode_vec3(end(v)), BITS)
    }

    #[inline(always)]
    fn decode_vec3(code: u32) -> Vec3 {
        HemiOct::<BITS>::decode_vec3(code)
    }
}
