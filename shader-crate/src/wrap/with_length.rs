//! Vectors with a length, such as velocities and forces: a codec's direction beside the logarithm of the length.
//!
//! A length is rounded to the nearest of `2^(L + i / S)`, i = 0, 1, 2 ..., so that the relative error is alike for all
//! lengths: at most `2^(1 / (2 S)) - 1`. (Half floats, for 32 octaves in 15 bits, err by up to 4.9e-4; 16 bits here by
//! 1.7e-4.)
//!
//! | format | direction | bits of length | S | lengths | relative error, mean | max | bound |
//! |---|---|---|---|---|---|---|---|
//! | `vector32` | [`oct20p`](crate::oct) | 12 | 128 | 2^-16 to 2^15.98 | 0.00204 | 0.00378 | 0.00390 |
//! | `WithLength<OctPrecise<24>, u32, 8, 8, -16>` | `oct24p` | 8 | 8 | 2^-16 to 2^15.75 | 0.0217 | 0.0443 | 0.0447 |
//! | signed R9G9B9E5 | | | | | 0.00225 | 0.00637 | |
//! | `vector48` | [`oct32p`](crate::oct) | 16 | 2048 | 2^-16 to 2^15.999 | 8.95e-5 | 0.000175 | 0.000177 |
//! | three halves | | | | | 0.000191 | 0.000545 | |
//!
//! The relative error is `|d - v| / |v|`, of a vector v and the decoded one, d, over random directions and lengths from
//! 2^-13 to 2^15 whose logarithm is uniform. R9G9B9E5 has no signs; its signed analogue has a sign and 8 bits a
//! component.
//!
//! * Bound: with an angle `a` between them, and d longer than v by the part e, `|d - v|^2 / |v|^2` is
//!   `e^2 + (1 + e) (2 sin(a / 2))^2`, so that the error is at most `sqrt(e^2 + (1 + e) a^2)`.
//! * `vector32` and `vector48` balance the two parts. 24 + 8 bits are for those to whom the direction matters more.
//! * Layout: the direction's code in the low bits, above it 0 for the zero vector or `i + 1`. More than 32 bits are two
//!   words, low word first.
//! * Exact: zero, and vectors along the axes whose length is a power of two in the range.
//! * Beyond the range: greater lengths, infinite ones too, get the greatest. Lesser ones get the least, down to half of
//!   it (to half a step); below that a vector is zero, as is one with NaN. Infinite components count as the largest
//!   float.
//! * Decode, encode and decode again: the second vector equals the first. This holds for octahedral codecs of up to 32
//!   bits, and for all whose decoded vectors may be rounded without a change of their code.
//!
//! ```
//! use unitvec::{Codec, Vector32};
//!
//! assert_eq!(Vector32::decode::<[f32; 3]>(Vector32::encode([0.0, -8.0, 0.0])), [0.0, -8.0, 0.0]);
//! ```

use crate::arith::{
    ONE_AND_A_HALF_2_23, SIGN_BIT, coefficients, dot, exp2, hypotenuse_bound, is_nan, mask, ratio,
    scaled_to_one, with_sign,
};
use crate::codec::{Codec, RawCode};
use crate::direction::{MIN_NORM, l1_norm};
use crate::oct::OctPrecise;
use core::f32::consts::LN_2;
use core::marker::PhantomData;
use glam::Vec3;

coefficients! {
    /// `log2(1 + f) = f + f (1 - f) (LOG_0 + f (LOG_1 + ... + f LOG_4))`, for f in \[0, 1\]: absolute error 2.3e-6,
    /// 0.0023 of a step of 2048 to the octave. The factors make both ends exact.
    pub LOG_0 = 0.44254494, LOG_1 = -0.2756003, LOG_2 = 0.18194889, LOG_3 = -0.09595646, LOG_4 = 0.02584145;

    /// `2^g = 1 + g - g (1 - g) (EXP_0 + g (EXP_1 + g (EXP_2 + g EXP_3)))`, for g in \[0, 1\]: relative error 9.3e-8
    /// before rounding. The factors make both ends exact.
    pub EXP_0 = 0.30684826, EXP_1 = 0.06668899, EXP_2 = 0.010870314, EXP_3 = 0.0018793186;
}

/// Vectors of an L1 norm from here on, 2^64, are longer than any range.
const FAR: f32 = exp2(64);

/// The logarithm of `x` to the base of two, for positive normal `x`.
#[inline(always)]
fn log2(x: f32) -> f32 {
    let whole = (x.to_bits() >> 23) as i32 - 127;
    let f = f32::from_bits((x.to_bits() & mask(23)) | 1f32.to_bits()) - 1.0;
    let polynomial = LOG_0 + f * (LOG_1 + f * (LOG_2 + f * (LOG_3 + f * LOG_4)));
    whole as f32 + (f + (f * (1.0 - f)) * polynomial)
}

/// The code of the length of `v`, of this L1 norm, in `bits` bits: of the nearest of `2^(low + i / steps)`, as the
/// module describes. `steps` is a power of two.
#[inline(always)]
fn length_code(v: Vec3, norm: f32, bits: u32, steps: u32, low: i32) -> u32 {
    let v = scaled_to_one(v, norm);
    // Half the logarithm of the square.
    let rest = log2(dot(v, v)) * (0.5 * steps as f32);
    let nearest = (rest + ONE_AND_A_HALF_2_23).to_bits().wrapping_sub(ONE_AND_A_HALF_2_23.to_bits()) as i32;
    let octaves = (norm.to_bits() >> 23) as i32 - 127 - low;
    let i = (octaves * steps as i32).wrapping_add(nearest);

    let most = mask(bits) as i32 - 1;
    let reached = if i > most || norm.to_bits() >= FAR.to_bits() { most } else { i };
    let is_zero = reached < -(steps as i32) || norm.to_bits() < MIN_NORM.to_bits() || is_nan(norm);
    let inside = if reached < 0 { 0 } else { reached };
    if is_zero { 0 } else { inside as u32 + 1 }
}

/// The length of a code other than 0.
#[inline(always)]
fn length(code: u32, steps: u32, low: i32) -> f32 {
    let i = code.wrapping_sub(1);
    let octaves = steps.trailing_zeros();
    let g = (i & (steps - 1)) as f32 * exp2(-(octaves as i32));
    let polynomial = EXP_0 + g * (EXP_1 + g * (EXP_2 + g * EXP_3));
    ((1.0 + g) - (g * (1.0 - g)) * polynomial) * exp2(low + (i >> octaves) as i32)
}

/// `v`, or a shorter vector of its direction if its L1 norm, `norm`, is far beyond the range: finite, so that it has a
/// usable direction.
#[inline(always)]
fn within_reach(v: Vec3, norm: f32) -> Vec3 {
    let finite = |x: f32| with_sign(f32::from_bits((x.to_bits() & !SIGN_BIT).min(f32::MAX.to_bits())), x);
    let shorter = Vec3::new(finite(v.x), finite(v.y), finite(v.z)) * exp2(-64);
    if norm.to_bits() < FAR.to_bits() { v } else { shorter }
}

/// The codec `C`, of up to 32 bits, with the vector's length in `LENGTH_BITS` bits above: `STEPS` to an octave, a power
/// of two, from `2^LOW` on. `W` is the code: `u32` for up to 32 bits in all, else `[u32; 2]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct WithLength<C, W, const LENGTH_BITS: u32, const STEPS: u32, const LOW: i32>(PhantomData<(C, W)>);

/// Vectors of lengths up to 2^15.98 in 32 bits: 20 of direction, 12 of length. See the [module](self).
pub type Vector32 = WithLength<OctPrecise<20>, u32, 12, 128, -16>;
/// Vectors of lengths up to 2^15.999 in 48 bits: 32 of direction, 16 of length. See the [module](self).
pub type Vector48 = WithLength<OctPrecise<32>, [u32; 2], 16, 2048, -16>;

impl<C: Codec, W: RawCode, const LENGTH_BITS: u32, const STEPS: u32, const LOW: i32>
    WithLength<C, W, LENGTH_BITS, STEPS, LOW>
{
    /// An upper bound of the relative error of a length in the range. To half a step come 0.004 steps, of the logarithm
    /// and its rounding, and 3e-7, of the decoded vector.
    pub const MAX_LENGTH_ERROR: f32 = {
        assert!(STEPS.is_power_of_two() && STEPS <= 2048 && LENGTH_BITS >= 2 && LENGTH_BITS <= 22);
        assert!(
            LOW >= -62 && LOW + (mask(LENGTH_BITS) >> STEPS.trailing_zeros()) as i32 <= 61,
            "lengths from 2^-62 to 2^62"
        );
        // e^t - 1 <= t + t^2/2 + t^3/4 for t up to 1.
        let t = ratio(LN_2 * 0.504, STEPS as f32);
        t + 0.5 * t * t + 0.25 * t * t * t + 3e-7
    };

    /// An upper bound of `|d - v| / |v|`, for a vector v whose length is in the range and the decoded one, d.
    pub const MAX_RELATIVE_ERROR: f32 = hypotenuse_bound(
        Self::MAX_LENGTH_ERROR,
        Self::MAX_ERROR_DEG.to_radians() * (1.0 + Self::MAX_LENGTH_ERROR),
    );
}

impl<C: Codec, W: RawCode, const LENGTH_BITS: u32, const STEPS: u32, const LOW: i32> Codec
    for WithLength<C, W, LENGTH_BITS, STEPS, LOW>
{
    const BITS: u32 = {
        assert!(C::BITS <= 32 && C::BITS + LENGTH_BITS <= 8 * size_of::<W>() as u32);
        C::BITS + LENGTH_BITS
    };
    /// The bound of the codec of directions, and 2^-23 radians for the product with the length.
    const MAX_ERROR_DEG: f32 = C::MAX_ERROR_DEG + (1.0f32 / 8_388_608.0).to_degrees();
    const IS_UNIT: bool = false;
    const EXACT_AXES: bool = C::EXACT_AXES;
    const STABLE_ACROSS_DEVICES: bool = C::STABLE_ACROSS_DEVICES;
    type Code = W;

    /// The code of a vector of any length; 0, the zero vector, for one that is too short or has NaN.
    #[inline(always)]
    fn encode_vec3(v: Vec3) -> W {
        const { (Self::BITS, Self::MAX_LENGTH_ERROR) };
        let norm = l1_norm(v);
        let length = length_code(v, norm, LENGTH_BITS, STEPS, LOW);
        let direction = C::encode_vec3(within_reach(v, norm)).to_words()[0];
        let (low, high) = if C::BITS < 32 {
            (direction | (length << C::BITS), length >> (32 - C::BITS))
        } else {
            (direction, length)
        };
        if length == 0 { W::from_low_high(0, 0) } else { W::from_low_high(low, high) }
    }

    /// The vector, of its length.
    #[inline(always)]
    fn decode_vec3(code: W) -> Vec3 {
        let [low, high] = code.to_words();
        let field = if C::BITS < 32 { (low >> C::BITS) | (high << (32 - C::BITS)) } else { high };
        let field = field & mask(LENGTH_BITS);
        let direction = C::decode_vec3(C::Code::from_low_high(low, 0));
        if field == 0 { Vec3::ZERO } else { direction * length(field, STEPS, LOW) }
    }
}
