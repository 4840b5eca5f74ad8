//! The codecs once more, in `f64` and straight from the papers' formulas, and the comparisons with them.
//!
//! The papers: "survey" is Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
//! Vectors"; "Meyer" is Meyer et al. 2010, "On Floating-Point Normal Vectors". Nothing here calls or copies codec
//! code, except the comparisons at the end, which put it to the test.

pub mod azimuthal;
pub mod best_fit;
pub mod codes;
pub mod cube;
pub mod cylindrical;
pub mod hemioct;
pub mod latlong;
pub mod oct;
pub mod oct_wide;
pub mod projection;
pub mod raw;
pub mod spherical;

pub use cylindrical::Cylindrical;
pub use hemioct::HemiOct;
pub use latlong::{LatLong, LatLongD};
pub use oct::Oct;
pub use spherical::Spherical;

use glam::Vec3;
use unitvec::Codec;

/// What `encode` makes of the rounding in `f32` of a position on the square `[-1, 1]^2`, per axis.
///
/// Listings 1 and 6 take at most two roundings for the L1 norm, one each for the reciprocal, the product and the
/// fold or rotation, and one for the scaling to steps: six of 2^-24, relative to values of at most 1.
pub const POSITION_ROUNDING: f64 = 1.0 / (1 << 21) as f64;

/// What `decode` makes of the rounding in `f32`, as an angle in radians.
///
/// Lattice points are exact before the normalisation, and a common factor does not turn the vector; so there is
/// one rounding of 2^-24 per component for its product with that factor, and as much again to spare.
pub const DECODE_ROUNDING: f64 = 1.0 / (1 << 23) as f64;

/// 2 ULP of 1: what a decoded vector's length may be off by.
pub const LENGTH_ROUNDING: f64 = 2.0 * f32::EPSILON as f64;

/// An octahedral mapping of directions to the square `[-1, 1]^2`, and its code's bits.
pub trait Oracle {
    /// The real-valued position of a direction (any length) on the square.
    fn position(v: [f64; 3]) -> [f64; 2];

    /// The direction (any length) of a position on the square.
    fn direction(e: [f64; 2]) -> [f64; 3];

    /// The direction that is encoded in place of `v`: `v` itself if the mapping covers the sphere.
    fn domain(v: [f64; 3]) -> [f64; 3] {
        v
    }

    /// The pair of snorm integers in a code: the first in the low half, the second in the high half.
    fn unpack(code: u32, bits: u32) -> [i32; 2] {
        split_halves(code, bits)
    }

    /// The code of a pair of snorm integers.
    fn pack(point: [i32; 2], bits: u32) -> u32 {
        join_halves(point, bits)
    }

    /// The unit vector that a code stands for.
    fn decode(code: u32, bits: u32) -> [f64; 3] {
        let m = largest(bits);
        normalize(Self::direction(Self::unpack(code, bits).map(|i| snorm(i, m))))
    }
}

/// Survey, section 1.2: the largest integer `2^(b-1) - 1` of the snorm components of `b = bits / 2` bits.
pub fn largest(bits: u32) -> f64 {
    ((1 << (bits / 2 - 1)) - 1) as f64
}

/// Survey, section 1.2: the value of the snorm integer `i`, `clamp(i / (2^(b-1) - 1), -1, 1)`.
pub fn snorm(i: i32, m: f64) -> f64 {
    (f64::from(i) / m).clamp(-1.0, 1.0)
}

/// The integer that the low `b` bits of `bits` are in two's complement.
pub fn twos_complement(bits: u32, b: u32) -> i32 {
    let low = i64::from(bits) % (1 << b);
    (if low < 1 << (b - 1) { low } else { low - (1 << b) }) as i32
}

/// The two integers, in two's complement, in the halves of a code's `bits` bits, the low half first.
pub fn split_halves(code: u32, bits: u32) -> [i32; 2] {
    [twos_complement(code, bits / 2), twos_complement(code >> (bits / 2), bits / 2)]
}

/// The code whose halves are two integers: the inverse of [`split_halves`].
pub fn join_halves(point: [i32; 2], bits: u32) -> u32 {
    let [low, high] = point.map(|i| i as u32 & ((1 << (bits / 2)) - 1));
    low | (high << (bits / 2))
}

/// Survey, listing 1: +1 or -1.
pub fn sign_not_zero(t: f64) -> f64 {
    if t >= 0.0 { 1.0 } else { -1.0 }
}

/// The scalar product.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The Euclidean length.
pub fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// `a` scaled to length 1.
pub fn normalize(a: [f64; 3]) -> [f64; 3] {
    let l = length(a);
    a.map(|t| t / l)
}

/// The vector product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The angle between two vectors of any length, in degrees: `atan2(|a x b|, a . b)`, exact for small angles too.
pub fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(cross(a, b)).atan2(dot(a, b)).to_degrees()
}

/// A vector in double precision: exact.
pub fn widen(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

/// The largest angle, in degrees, by which a position off by `steps` of the square's half side along each axis
/// turns a direction on the octahedron: Meyer, eq. 10, where `steps` is half the sample spacing.
pub fn turn_deg(steps: f64) -> f64 {
    (3.0 / 2f64.sqrt() * 2.0 * steps).to_degrees()
}

/// Mean and maximum of a sequence.
#[derive(Clone, Copy, Debug, Default)]
pub struct Summary {
    /// The arithmetic mean.
    pub mean: f64,
    /// The largest value.
    pub max: f64,
}

impl Summary {
    /// Of `values`.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut sum, mut count, mut max) = (0.0, 0.0, f64::NEG_INFINITY);
        for value in values {
            sum += value;
            count += 1.0;
            max = value.max(max);
        }
        Self { mean: sum / count, max }
    }
}

/// The angle in degrees between what was encoded and what is decoded.
pub fn round_trip_error_deg<C: Codec<Code = u32>>(v: Vec3) -> f64 {
    angle_deg(widen(v), widen(C::decode(C::encode(v))))
}

/// Asserts that `C` decodes each of `codes` to the oracle's direction and to unit length, with the high bits of
/// the code set to anything.
pub fn assert_decodes<C: Codec<Code = u32>, O: Oracle>(codes: impl Iterator<Item = u32>) {
    let (mut worst_turn, mut worst_length) = (0f64, 0f64);
    for code in codes {
        let decoded = C::decode(code);
        let (actual, expected) = (widen(decoded), O::decode(code, C::BITS));
        let turn = length(cross(actual, expected));
        let off = (length(actual) - 1.0).abs();
        assert!(
            turn <= DECODE_ROUNDING && dot(actual, expected) > 0.0 && off <= LENGTH_ROUNDING,
            "{}: {code:#x} decodes to {decoded:?}, which is {turn:e} rad off {expected:?} and {off:e} off length 1",
            C::NAME
        );
        if C::BITS < 32 {
            let dirty = code | (code.wrapping_mul(0x9E37_79B9) << C::BITS);
            assert_eq!(C::decode(dirty), decoded, "{}: {dirty:#x}, bits above the code count", C::NAME);
        }
        (worst_turn, worst_length) = (worst_turn.max(turn), worst_length.max(off));
    }
    println!("{} decode: {:.3} ULP turned, {:.3} ULP of length", C::NAME, ulp(worst_turn), ulp(worst_length));
}

/// Asserts that each of `codes`, decoded, encoded and decoded, gives the vector of the first decoding.
pub fn assert_stable<C: Codec<Code = u32>>(codes: impl Iterator<Item = u32>) {
    for code in codes {
        let once = C::decode(code);
        let again = C::encode(once);
        assert_eq!(C::decode(again), once, "{}: {code:#x} comes back as {again:#x}", C::NAME);
    }
}

/// Asserts that `C` rounds each position to the nearest lattice point, as the oracle has it: by at most half a
/// step on each axis, and the rounding of the position in `f32`.
pub fn assert_rounds<C: Codec<Code = u32>, O: Oracle>(directions: impl Iterator<Item = Vec3>) {
    let m = largest(C::BITS);
    let worst = directions.map(|v| {
        let code = C::encode(v);
        let (position, point) = (O::position(O::domain(widen(v))), O::unpack(code, C::BITS));
        let beyond =
            (0..2).map(|i| (position[i] * m - f64::from(point[i])).abs() - 0.5).fold(-0.5, f64::max) / m;
        assert!(
            beyond < POSITION_ROUNDING,
            "{}: {v:?} of position {position:?} gets {code:#x}, the point {point:?}",
            C::NAME
        );
        beyond
    });
    println!("{} encode: {:.3} of 2^-21", C::NAME, Summary::of(worst).max / POSITION_ROUNDING);
}

/// Asserts that the errors of `directions` fit the mean and maximum that the survey publishes (to five decimals),
/// and that none exceeds `bound_deg` by more than `f32` rounds, nor [`Codec::MAX_ERROR_DEG`].
pub fn assert_errors<C: Codec<Code = u32>>(
    directions: impl Iterator<Item = Vec3>,
    published: Summary,
    bound_deg: f64,
) {
    let half_digit = 0.000_005;
    let ours = Summary::of(directions.map(round_trip_error_deg::<C>));
    println!("{} error: mean {:.6} max {:.6}, bound {bound_deg:.6}", C::NAME, ours.mean, ours.max);
    assert!(ours.mean <= (published.mean + half_digit) * 1.01, "{}: {ours:?}", C::NAME);
    assert!(ours.mean >= (published.mean - half_digit) * 0.97, "{}: {ours:?}", C::NAME);
    assert!(ours.max <= (published.max + half_digit) * 1.02, "{}: {ours:?}", C::NAME);
    assert_bounded::<C>(ours.max, bound_deg);
}

/// Asserts that `error_deg` is at most `bound_deg` and what `f32` rounds, and at most [`Codec::MAX_ERROR_DEG`].
pub fn assert_bounded<C: Codec<Code = u32>>(error_deg: f64, bound_deg: f64) {
    let slack = turn_deg(POSITION_ROUNDING) + DECODE_ROUNDING.to_degrees();
    assert!(error_deg <= bound_deg + slack, "{}: {error_deg} exceeds {bound_deg}", C::NAME);
    assert!(error_deg <= f64::from(C::MAX_ERROR_DEG), "{}: {error_deg} exceeds MAX_ERROR_DEG", C::NAME);
}

/// Asserts that `C` decodes the mirror image or permutation `f` of each direction to that of the decoded vector.
pub fn assert_commutes<C: Codec<Code = u32>>(
    directions: impl Iterator<Item = Vec3>,
    f: impl Fn(Vec3) -> Vec3,
) {
    for v in directions {
        let expected = f(C::decode(C::encode(v)));
        assert_eq!(C::decode(C::encode(f(v))), expected, "{}: {v:?} and its image {:?}", C::NAME, f(v));
    }
}

/// Asserts that `C` gives each of `axes` back, exactly.
pub fn assert_keeps<C: Codec<Code = u32>>(axes: &[Vec3]) {
    for &axis in axes {
        assert_eq!(C::decode(C::encode(axis)), axis, "{}", C::NAME);
    }
}

/// In units of the last place of 1.
fn ulp(t: f64) -> f64 {
    t / f64::from(f32::EPSILON)
}
