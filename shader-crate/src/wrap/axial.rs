//! Axes: directions for which v and -v are the same, such as fibres, crystal axes and the normals of thin leaves.
//!
//! An axis has one end in half of the sphere, so that the codes of a hemisphere serve, at the error that they have there.
//! Measure it as `min(e, 180 - e)` degrees, where `e` is the angle between an encoded and a decoded vector.
//!
//! | degrees | mean | max | bound |
//! |---|---|---|---|
//! | `axial16` | 0.239 | 0.552 | 0.553 |
//! | `axial24` | 0.0148 | 0.0343 | 0.0343 |
//! | `axial32` | 0.000926 | 0.00214 | 0.00218 |
//! | [`oct16p`](crate::oct), which tells v from -v | 0.315 | 0.638 | 0.638 |
//!
//! * Layout: that of [`hemioct`](crate::hemioct), whose decoder decodes. The first component that is not 0, of z, x and y in
//!   this order, is positive in decoded vectors.
//! * One code for each axis, whichever end is encoded. Axes on the equator, z = 0, have two codes in the hemisphere's
//!   format: encoders write that of the end with x > 0 or, where x is 0 too, y > 0. The other one decodes to the other
//!   end.
//! * Of codes that encoders write, the decoded vector is encoded to the code. The axes of the coordinates are exact.
//! * A vector without a usable direction gets the code of Z. [`OrNull`](crate::OrNull) tells it apart.
//! * Good for: axes. Weaknesses: a decoded vector jumps to its opposite where an axis crosses the equator, so that
//!   neighbours must be compared and averaged as axes, by `v v^T` or after turning one to the other.
//!
//! ```
//! use unitvec::{Axial16, Codec};
//!
//! let code = Axial16::encode([0.0, -1.0, 0.0]);
//! assert_eq!(code, Axial16::encode([0.0, 1.0, 0.0]));
//! assert_eq!(Axial16::decode::<[f32; 3]>(code), [0.0, 1.0, 0.0]);
//! ```

use crate::arith::{is_negative, mask};
use crate::codec::{Codec, Width};
use crate::hemioct::{HemiOct, HemiOctPrecise};
use core::marker::PhantomData;
use glam::Vec3;

/// A codec of the hemisphere z >= 0, equator included.
pub trait HalfSphere: Codec {
    /// `code`, or that of the opposite direction if `code` is one of the equator with x < 0, or with x = 0 and y < 0.
    /// Unspecified for codes that `encode` never writes.
    #[must_use]
    fn one_of_two(code: Self::Code) -> Self::Code;
}

/// [`HalfSphere::one_of_two`] of a hemi-octahedral code of `bits` bits. The equator is the square's border, and there
/// x + y or x - y is the largest number of its sign: the end sought has +m as the first, or as the second.
#[inline(always)]
fn one_of_two(code: u32, bits: u32) -> u32 {
    let half = bits / 2;
    let (most, whole) = (mask(half - 1), mask(half));
    let least = whole - most + 1;
    let (u, v) = (code & whole, code >> half);
    let opposite = (0u32.wrapping_sub(u) & whole) | ((0u32.wrapping_sub(v) & whole) << half);
    if u == least || (v == least && u != most) { opposite } else { code }
}

impl<const BITS: u32> HalfSphere for HemiOct<BITS>
where
    Self: Width,
{
    #[inline(always)]
    fn one_of_two(code: u32) -> u32 {
        one_of_two(code, BITS)
    }
}

impl<const BITS: u32> HalfSphere for HemiOctPrecise<BITS>
where
    HemiOct<BITS>: Width,
{
    #[inline(always)]
    fn one_of_two(code: u32) -> u32 {
        one_of_two(code, BITS)
    }
}

/// The end of the axis of `v` whose first component that is not 0, of z, x and y in this order, is positive. Denormals
/// count as 0.
#[inline(always)]
fn end(v: Vec3) -> Vec3 {
    let counts = |x: f32| x.abs() >= f32::MIN_POSITIVE;
    let horizontal = if counts(v.x) { v.x } else { v.y };
    let first = if counts(v.z) { v.z } else { horizontal };
    if is_negative(first) { -v } else { v }
}

/// The codec `C` of a hemisphere, for axes: v and -v get the same code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Axial<C>(PhantomData<C>);

/// Axes in 16 bits: at most 0.553 degrees off.
pub type Axial16 = Axial<HemiOctPrecise<16>>;
/// Axes in 24 bits: at most 0.0343 degrees off.
pub type Axial24 = Axial<HemiOctPrecise<24>>;
/// Axes in 32 bits: at most 0.00218 degrees off.
pub type Axial32 = Axial<HemiOctPrecise<32>>;

impl<C: HalfSphere> Codec for Axial<C> {
    const BITS: u32 = C::BITS;
    /// The bound of the angle between the axes, which is 90 degrees at most.
    const MAX_ERROR_DEG: f32 = C::MAX_ERROR_DEG;
    const IS_UNIT: bool = C::IS_UNIT;
    const EXACT_AXES: bool = C::EXACT_AXES;
    const STABLE_ACROSS_DEVICES: bool = C::STABLE_ACROSS_DEVICES;
    const NULL: Option<[u32; 2]> = C::NULL;
    type Code = C::Code;

    #[inline(always)]
    fn encode_vec3(v: Vec3) -> C::Code {
        C::one_of_two(C::encode_vec3(end(v)))
    }

    #[inline(always)]
    fn decode_vec3(code: C::Code) -> Vec3 {
        C::decode_vec3(code)
    }
}
