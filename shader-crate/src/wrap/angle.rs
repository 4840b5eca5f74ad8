//! Directions of the plane, in 4 to 16 bits: headings, two-dimensional normals, the direction of a flow.
//!
//! Source: Ong 2023, "Tangent Spaces and Diamond Encoding", for the diamond.
//!
//! A code is the number of steps, `2^bits` to the turn, from +X towards +Y. `angle8` and `angle16`, of
//! [`frame`](crate::frame)'s diamond, have steps that are equal but for 0.26 %, by a quotient, a polynomial and a root;
//! `eqangle8` and `eqangle16`, by the trigonometry of `arith`, equal ones. No code has a lower
//! maximum than `180 / 2^bits` degrees, or a lower mean than half of it.
//!
//! | degrees | mean | max | bound | `180 / 2^bits` |
//! |---|---|---|---|---|
//! | `angle8` | 0.352 | 0.706 | 0.708 | 0.703 |
//! | `eqangle8` | 0.352 | 0.703 | 0.703 | 0.703 |
//! | `angle16` | 0.00137 | 0.00276 | 0.00278 | 0.00275 |
//! | `eqangle16` | 0.00137 | 0.00275 | 0.00277 | 0.00275 |
//!
//! * Decoded vectors have unit length to within 2 ULP, and encode to their code. The four axes are exact; on the
//!   diagonals both magnitudes are the same.
//! * The two kinds place a code up to 0.0434 degrees apart: one's codes are not the other's.
//! * A vector's length does not matter. One without a usable direction (see [`direction`](crate::direction)) gets code
//!   0, +X.
//!
//! ```
//! use unitvec::Angle8;
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

/// A direction of the plane in `BITS` bits, by steps of equal angle if `EQUAL`, else without trigonometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Angle<const BITS: u32, const EQUAL: bool = false>;

/// A direction of the plane in 8 bits, without trigonometry: at most 0.708 degrees off.
pub type Angle8 = Angle<8>;
/// A direction of the plane in 16 bits, without trigonometry: at most 0.00279 degrees off.
pub type Angle16 = Angle<16>;
/// A direction of the plane in 8 bits, by steps of equal angle: at most 0.7032 degrees off.
pub type EqualAngle8 = Angle<8, true>;
/// A direction of the plane in 16 bits, by steps of equal angle: at most 0.00278 degrees off.
pub type EqualAngle16 = Angle<16, true>;

impl<const BITS: u32, const EQUAL: bool> Angle<BITS, EQUAL> {
    /// Significant bits of a code: 4 to 16.
    pub const BITS: u32 = {
        assert!(BITS >= 4 && BITS <= 16, "angles have 4 to 16 bits");
        BITS
    };

    /// An upper bound of the angle, in degrees, between a vector and its decoded code.
    pub const MAX_ERROR_DEG: f32 = {
        let half_step = ratio(PI, (1u32 << Self::BITS) as f32);
        (if EQUAL { half_step } else { diamond_error(BITS) } + ROUNDING).to_degrees()
    };

    /// The code of the direction of `v`, of any length. 0, the code of +X, where that has no usable direction.
    #[must_use]
    #[inline(always)]
    pub fn encode<V: Into<[f32; 2]>>(v: V) -> u32 {
        const { Self::BITS };
        let [x, y] = v.into();
        let sum = x.abs() + y.abs();
        let code = if EQUAL {
            // Half a turn and its opposite, the largest number and the least, have the same low bits.
            nearest_code(atan2_half_turns(y, x) * exp2(BITS as i32 - 1), BITS)
        } else {
            diamond_code::<BITS>(x, y, sum)
        };
        if is_usable(sum) { code } else { 0 }
    }

    /// The direction that `code` stands for, of unit length to within 2 ULP. Higher bits are ignored.
    #[must_use]
    #[inline(always)]
    pub fn decode<V: From<[f32; 2]>>(code: u32) -> V {
        if EQUAL {
            let half_turns = (code & mask(BITS)) as f32 * exp2(1 - BITS as i32);
            return sin_cos_half_turns(half_turns).to_array().into();
        }
        let p = diamond_point::<BITS>(code);
        let Vec2 { x, y } = p * inverse_root(p.x * p.x + p.y * p.y);
        // -0 becomes 0.
        [if x.abs() > 0.0 { x } else { 0.0 }, if y.abs() > 0.0 { y } else { 0.0 }].into()
    }
}
