//! Comparisons of the codecs with [`unitvec_oracle`], which has them once more in `f64` and is all here too.

pub mod codes;
pub mod spherical;

use glam::Vec3;
use unitvec::Listed;
pub use unitvec_oracle::*;

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

/// The symmetries of the octahedral mappings of the whole sphere: mirrored at a coordinate plane, x and y swapped.
pub const OCT_SYMMETRIES: [fn(Vec3) -> Vec3; 4] = [
    |v| Vec3::new(-v.x, v.y, v.z),
    |v| Vec3::new(v.x, -v.y, v.z),
    |v| Vec3::new(v.x, v.y, -v.z),
    |v| Vec3::new(v.y, v.x, v.z),
];

/// A vector in double precision: exact.
pub fn widen(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

/// The angle in degrees between what was encoded and what is decoded.
pub fn round_trip_error_deg<C: Listed<Code = u32>>(v: Vec3) -> f64 {
    angle_deg(widen(v), widen(C::decode(C::encode(v))))
}

/// Asserts that `C` decodes each of `codes` to the oracle's direction and to unit length, with the high bits of
/// the code set to anything.
pub fn assert_decodes<C: Listed<Code = u32>, O: Oracle>(codes: impl Iterator<Item = u32>) {
    assert_decodes_within::<C, O>(codes, DECODE_ROUNDING);
}

/// The same, with the decoded vector turned from the oracle's by up to `rounding` radians.
pub fn assert_decodes_within<C: Listed<Code = u32>, O: Oracle>(
    codes: impl Iterator<Item = u32>,
    rounding: f64,
) {
    let (mut worst_turn, mut worst_length) = (0f64, 0f64);
    for code in codes {
        let decoded = C::decode(code);
        let (actual, expected) = (widen(decoded), O::decode(code, C::BITS));
        let turn = length(cross(actual, expected));
        let off = (length(actual) - 1.0).abs();
        assert!(
            turn <= rounding && dot(actual, expected) > 0.0 && off <= LENGTH_ROUNDING,
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
pub fn assert_stable<C: Listed<Code = u32>>(codes: impl Iterator<Item = u32>) {
    for code in codes {
        let once = C::decode(code);
        let again = C::encode(once);
        assert_eq!(C::decode(again), once, "{}: {code:#x} comes back as {again:#x}", C::NAME);
    }
}

/// Asserts that `C` rounds each position to the nearest lattice point, as the oracle has it: by at most half a
/// step on each axis, and the rounding of the position in `f32`.
pub fn assert_rounds<C: Listed<Code = u32>, O: Oracle>(directions: impl Iterator<Item = Vec3>) {
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
pub fn assert_errors<C: Listed<Code = u32>>(
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
pub fn assert_bounded<C: Listed<Code = u32>>(error_deg: f64, bound_deg: f64) {
    let slack = turn_deg(POSITION_ROUNDING) + DECODE_ROUNDING.to_degrees();
    assert!(error_deg <= bound_deg + slack, "{}: {error_deg} exceeds {bound_deg}", C::NAME);
    assert!(error_deg <= f64::from(C::MAX_ERROR_DEG), "{}: {error_deg} exceeds MAX_ERROR_DEG", C::NAME);
}

/// Asserts that `C` decodes the mirror image or permutation `f` of each direction to that of the decoded vector.
pub fn assert_commutes<C: Listed<Code = u32>>(
    directions: impl Iterator<Item = Vec3>,
    f: impl Fn(Vec3) -> Vec3,
) {
    for v in directions {
        let expected = f(C::decode(C::encode(v)));
        assert_eq!(C::decode(C::encode(f(v))), expected, "{}: {v:?} and its image {:?}", C::NAME, f(v));
    }
}

/// Asserts that `C` gives each of `axes` back, exactly.
pub fn assert_keeps<C: Listed<Code = u32>>(axes: &[Vec3]) {
    for &axis in axes {
        assert_eq!(C::decode(C::encode(axis)), axis, "{}", C::NAME);
    }
}

/// In units of the last place of 1.
fn ulp(t: f64) -> f64 {
    t / f64::from(f32::EPSILON)
}
