//! What all formats of two angles are put to the test with.

use super::{Oracle, Summary, angle_deg, widen};
use glam::Vec3;
use unitvec::Listed;
pub use unitvec_oracle::spherical::*;

/// What `decode` makes of `f32` trigonometry, as an angle in radians: a sine and a cosine, each off by up to
/// 7.0e-8, for each of the two angles, which are rounded to 2^-25 of a half turn at most, and a product.
pub const DECODE_ROUNDING: f64 = 1.0 / (1 << 21) as f64;

/// What `encode` makes of the rounding in `f32` of an angle, in half turns: 5e-8 for the arc tangent, and as much
/// for the length and the scaling to steps.
pub const ANGLE_ROUNDING: f64 = 1.0 / (1 << 23) as f64;

/// Asserts that `C` decodes each of `codes` to the oracle's direction within [`DECODE_ROUNDING`], to unit length,
/// with no component -0 and with the high bits of the code set to anything.
pub fn assert_decodes<C: Listed<Code = u32>, O: Oracle>(codes: impl Iterator<Item = u32>) {
    let codes = codes.inspect(|code| {
        let decoded = C::decode(*code);
        let negative_zero = decoded.to_array().iter().any(|t| t.to_bits() == (-0f32).to_bits());
        assert!(!negative_zero, "{}: {code:#x} decodes to {decoded:?}", C::NAME);
    });
    super::assert_decodes_within::<C, O>(codes, DECODE_ROUNDING);
}

/// Asserts that `C` chooses the nearest point along each of two coordinates: by `steps_off` at most half a step
/// away, and `rounding` steps that `f32` makes of it.
pub fn assert_rounds<C: Listed<Code = u32>>(
    directions: impl Iterator<Item = Vec3>,
    steps_off: impl Fn([f64; 3], u32, u32) -> [f64; 2],
    rounding: f64,
) {
    let beyond = directions.map(|v| {
        let code = C::encode(v);
        let off = steps_off(widen(v), code, C::BITS);
        let beyond = off[0].max(off[1]) - 0.5;
        assert!(beyond <= rounding, "{}: {v:?} gets {code:#x}, {off:?} steps away", C::NAME);
        beyond
    });
    println!("{} encode: {:.6} steps, allowed {rounding:.6}", C::NAME, Summary::of(beyond).max);
}

/// Asserts that encoding `directions` comes to at least 99 % of `bound_deg`, and does not exceed it beyond
/// rounding.
pub fn assert_attains<C: Listed<Code = u32>>(directions: impl Iterator<Item = Vec3>, bound_deg: f64) {
    let worst = Summary::of(directions.map(super::round_trip_error_deg::<C>)).max;
    println!("{} worst: {worst:.7} of {bound_deg:.7}, said {:.7}", C::NAME, C::MAX_ERROR_DEG);
    assert!(worst >= 0.99 * bound_deg, "{}: {worst} of {bound_deg}", C::NAME);
    assert!(worst <= f64::from(C::MAX_ERROR_DEG), "{}: {worst} exceeds MAX_ERROR_DEG", C::NAME);
    assert!(bound_deg <= f64::from(C::MAX_ERROR_DEG), "{}: MAX_ERROR_DEG under {bound_deg}", C::NAME);
}

/// Asserts that `C` decodes the image `f` of each direction to that of the decoded vector, within `f32` rounding,
/// except where `is_tie`.
pub fn assert_commutes_but_for_ties<C: Listed<Code = u32>>(
    directions: impl Iterator<Item = Vec3>,
    f: impl Fn(Vec3) -> Vec3,
    is_tie: impl Fn(Vec3) -> bool,
) {
    for v in directions.filter(|&v| !is_tie(v)) {
        let [expected, actual] = [f(C::decode(C::encode(v))), C::decode(C::encode(f(v)))];
        let turn = angle_deg(widen(expected), widen(actual)).to_radians();
        assert!(turn <= DECODE_ROUNDING, "{}: {v:?}: {expected:?} and {actual:?}", C::NAME);
    }
}
