//! Directions of the plane, in 4 to 16 bits: headings, two-dimensional normals, the direction of a flow.
//!
//! Source: Ong 2023, "Tangent Spaces and Diamond Encoding", for the diamond.
//!
//! A code is the number of steps, `2^bits` to the turn, from +X towards +Y. [`EqualAngle`] has steps of equal angle, by the
//! trigonometry of `arith`; [`Angle`] has those of [`frame`](crate::frame)'s diamond, equal but for 0.26 %, by a quotient, a
//! polynomial and a root. No code has a lower maximum than `180 / 2^bits` degrees, or a lower mean than half of it.
//!
//! | degrees | mean | max | bound | `180 / 2^bits` |
//! |---|---|---|---|---|
//! | `angle8` | 0.352 | 0.706 | 0.708 | 0.703 |
//! | `eqangle8` | 0.352 | 0.703 | 0.703 | 0.703 |
//! | `angle16` | 0.00137 | 0.00276 | 0.00278 | 0.00275 |
//! | `eqangle16` | 0.00137 | 0.00275 | 0.00277 | 0.00275 |
//!
//! * Decoded vectors have unit length to within 2 ULP, and encode to their code. The four axes are exact; on the diagonals
//!   both magnitudes are the same.
//! * The two kinds place a code up to 0.0434 degrees apart: one's codes are not the other's.
//! * A vector's length does not matter. One without a usable direction (see [`direction`](crate::direction)) gets code 0, +X.
//!
//! ```
//! use unitvec::{Angle8, AngleCodec};
//!
//! assert_eq!(Angle8::encode([-3.0, 0.0]), 128);
//! assert_eq!(Angle8::decode::<[f32; 2]>(128), [-1.0, 0.0]);
//! ```

use crate::arith::{
    atan2_half_turns, diamond_code, diamond_error, diamond_point, exp2, inverse_root, mask, nearest_code,
    ratio, sin_cos_half_turns,
};
use crate::direction::is_usable;
use core::f32::consts::PI;
use glam::Vec2;

/// The effect of the rounding of `f32` on an angle, in radians: of encoding and of decoding together.
const ROUNDING: f32 = 1.0 / 2_097_152.0;

/// A way to store a direction of the plane in [`BITS`](Self::BITS) bits: [`Codec`](crate::Codec), for two components.
pub trait AngleCodec {
    /// Significant bits of a code: 4 to 16.
    const BITS: u32;

    /// An upper bound of the angle, in degrees, between a vector and its decoded code.
    const MAX_ERROR_DEG: f32;

    /// The code of the direction of `v`, of any length. 0, the code of +X, where that has no usable direction.
    #[must_use]
    fn encode<V: Into<[f32; 2]>>(v: V) -> u32;

    /// The direction that `code` stands for, of unit length to within 2 ULP. Higher bits are ignored.
    #[must_use]
    fn decode<V: From<[f32; 2]>>(code: u32) -> V;
}

/// `bits`, if angles may have so many.
const fn checked(bits: u32) -> u32 {
    assert!(bits >= 4 && bits <= 16, "angles have 4 to 16 bits");
    bits
}

/// A direction of the plane in `BITS` bits, without trigonometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Angle<const BITS: u32>;

/// A direction of the plane in 8 bits, without trigonometry: at most 0.708 degrees off.
pub type Angle8 = Angle<8>;
/// A direction of the plane in 16 bits, without trigonometry: at most 0.00279 degrees off.
pub type Angle16 = Angle<16>;

impl<const BITS: u32> AngleCodec for Angle<BITS> {
    const BITS: u32 = checked(BITS);
    const MAX_ERROR_DEG: f32 = (diamond_error(BITS) + ROUNDING).to_degrees();

    #[inline(always)]
    fn encode<V: Into<[f32; 2]>>(v: V) -> u32 {
        const { Self::BITS };
        let [x, y] = v.into();
        let sum = x.abs() + y.abs();
        let code = diamond_code::<BITS>(x, y, sum);
        if is_usable(sum) { code } else { 0 }
    }

    #[inline(always)]
    fn decode<V: From<[f32; 2]>>(code: u32) -> V {
        let p = diamond_point::<BITS>(code);
        let Vec2 { x, y } = p * inverse_root(p.x * p.x + p.y * p.y);
        // -0 becomes 0.
        [if x.abs() > 0.0 { x } else { 0.0 }, if y.abs() > 0.0 { y } else { 0.0 }].into()
    }
}

/// A direction of the plane in `BITS` bits, by steps of equal angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EqualAngle<const BITS: u32>;

/// A direction of the plane in 8 bits, by steps of equal angle: at most 0.7032 degrees off.
pub type EqualAngle8 = EqualAngle<8>;
/// A direction of the plane in 16 bits, by steps of equal angle: at most 0.00278 degrees off.
pub type EqualAngle16 = EqualAngle<16>;

impl<const BITS: u32> AngleCodec for EqualAngle<BITS> {
    const BITS: u32 = checked(BITS);
    const MAX_ERROR_DEG: f32 = (ratio(PI, (1u32 << BITS) as f32) + ROUNDING).to_degrees();

    #[inline(always)]
    fn encode<V: Into<[f32; 2]>>(v: V) -> u32 {
        let [x, y] = v.into();
        // Half a turn and its opposite, the largest number and the least, have the same low bits.
        let code = nearest_code(atan2_half_turns(y, x) * exp2(BITS as i32 - 1), Self::BITS);
        if is_usable(x.abs() + y.abs()) { code } else { 0 }
    }

    #[inline(always)]
    fn decode<V: From<[f32; 2]>>(code: u32) -> V {
        sin_cos_half_turns((code & mask(BITS)) as f32 * exp2(1 - BITS as i32)).to_array().into()
    }
}
