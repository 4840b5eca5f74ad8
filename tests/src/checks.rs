//! Assertions about codecs, of which the suite and the families' own tests are made. All name the codec.

use crate::directions::usable;
use crate::expected::{self, Image, Tolerance};
use crate::tested::{Tested, portions, widen};
use glam::Vec3;
use unitvec_oracle::{Summary, angle_deg, cross, dot, length};

/// 2 ULP of 1: the error allowed in a decoded vector's length.
pub const LENGTH_ROUNDING: f64 = 2.0 * f32::EPSILON as f64;

/// The effect on `encode` of the rounding in `f32` of a position on the square `[-1, 1]^2`, per axis.
///
/// Listings 1 and 6 take at most two roundings for the L1 norm, one each for the reciprocal, the product and the
/// fold or rotation, and one for the scaling to steps: six of 2^-24, relative to values of at most 1.
pub const POSITION_ROUNDING: f64 = 1.0 / (1 << 21) as f64;

/// Asserts that a decoded vector has unit length to 2 ULP if the codec promises it, and no component that is -0.
pub fn assert_unit(codec: &Tested, code: u64, decoded: Vec3) {
    let off = (length(widen(decoded)) - 1.0).abs();
    assert!(
        decoded.is_finite() && (!codec.is_unit || off <= LENGTH_ROUNDING),
        "{}: {code:#x} decodes to {decoded:?}, {off:e} off length 1",
        codec.id
    );
    let negative_zero = decoded.to_array().iter().any(|t| t.to_bits() == (-0f32).to_bits());
    assert!(!negative_zero, "{}: {code:#x} decodes to {decoded:?}", codec.id);
}

/// Asserts that the codec decodes each of `codes` to the reference's vector, in a slice and alone, whatever the bits above the
/// code, and that at least `share` of them has one.
pub fn assert_decodes(codec: &Tested, codes: impl Iterator<Item = u64>, share: f64) {
    let tolerance = expected::decoding(codec);
    let (mut worst, mut settled, mut count) = (0f64, 0, 0);
    let decoded = portions(codes).flat_map(|codes| {
        let vectors = codec.decode_all(&codes);
        codes.into_iter().zip(vectors)
    });
    for (code, decoded) in decoded {
        assert_unit(codec, code, decoded);
        let dirty = code | code.wrapping_mul(0x9E37_79B9_7F4A_7C15) & !codec.mask();
        assert_eq!(codec.decode(dirty), decoded, "{}: {dirty:#x}, bits above the code count", codec.id);
        count += 1;
        // The reference leaves some codes open.
        let Some(exact) = codec.reference.decode(code) else { continue };
        let off = tolerance.off(codec, decoded, exact);
        assert!(
            off <= 1.0,
            "{}: {code:#x} is {decoded:?}, not {exact:?}: {off:.3} of {tolerance:?}",
            codec.id
        );
        settled += 1;
        worst = worst.max(off);
    }
    println!("{} decode: {worst:.3} of {tolerance:?}; {settled} of {count} codes", codec.id);
    assert!(f64::from(settled) >= share * f64::from(count), "{}: {settled} of {count}", codec.id);
}

impl Tolerance {
    /// The error of a decoded vector against the exact one, in parts of the tolerance.
    fn off(self, codec: &Tested, decoded: Vec3, exact: [f64; 3]) -> f64 {
        let actual = widen(decoded);
        let off = |i: usize| (actual[i] - exact[i]).abs();
        match self {
            Self::Turn(_) if dot(actual, exact) < 0.0 => f64::INFINITY,
            Self::Turn(radians) => length(cross(actual, exact)) / (radians + expected::rim(codec, decoded)),
            Self::Components(most) => off(0).max(off(1)).max(off(2)) / most,
            Self::Nearest if decoded.to_array() == exact.map(|t| t as f32) => 0.0,
            Self::Nearest => f64::INFINITY,
            Self::Squares => {
                let square = |i: usize| (actual[i] * actual[i].abs() - exact[i] * exact[i].abs()).abs();
                let mut offs = [off(0), off(1), off(2)];
                offs.sort_by(f64::total_cmp);
                (square(0).max(square(1)).max(square(2)) * 2f64.powi(21)).max(offs[1] * 2f64.powi(23))
            }
        }
    }
}

/// Asserts that each of `codes`, decoded, encoded and decoded, gives the vector of the first decoding, and that encoding
/// leaves the bits above the code 0.
pub fn assert_stable(codec: &Tested, codes: impl Iterator<Item = u64>) {
    for codes in portions(codes) {
        let once = codec.decode_all(&codes);
        let again = codec.encode_all(&once);
        let twice = codec.decode_all(&again);
        for (((code, once), again), twice) in codes.into_iter().zip(once).zip(again).zip(twice) {
            assert!(again & !codec.mask() == 0, "{}: {code:#x} comes back as {again:#x}", codec.id);
            assert_eq!(twice, once, "{}: {code:#x} comes back as {again:#x}", codec.id);
        }
    }
}

/// Asserts that the image of each direction comes back as the image of the direction's decoded vector.
pub fn assert_commutes(codec: &Tested, directions: impl Iterator<Item = Vec3>, images: &[Image]) {
    for vectors in portions(directions.filter(|_| !images.is_empty())) {
        let decoded = codec.round_trip_all(&vectors);
        for image in images {
            let moved: Vec<Vec3> = vectors.iter().map(|v| image(*v)).collect();
            for ((v, of_moved), decoded) in moved.iter().zip(codec.round_trip_all(&moved)).zip(&decoded) {
                assert_eq!(of_moved, image(*decoded), "{}: the image {v:?}", codec.id);
            }
        }
    }
}

/// Asserts that encoding commutes, except for the rounding of decoding, and for directions that `is_tie`.
pub fn assert_commutes_but_for_ties(
    codec: &Tested,
    directions: impl Iterator<Item = Vec3>,
    f: impl Fn(Vec3) -> Vec3,
    is_tie: impl Fn(Vec3) -> bool,
) {
    let Tolerance::Turn(rounding) = expected::decoding(codec) else {
        panic!("{} is not of unit length", codec.id)
    };
    for v in directions.filter(|&v| !is_tie(v)) {
        let [actual, expected] = [codec.round_trip(f(v)), f(codec.round_trip(v))];
        let turn = angle_deg(widen(expected), widen(actual)).to_radians();
        assert!(turn <= rounding, "{}: {v:?}: {expected:?} and {actual:?}", codec.id);
    }
}

/// Asserts that the largest error of `directions` is at least `part` of `bound_deg`, exceeds it by at most `slack_deg`, and
/// keeps to the codec's own bound.
pub fn assert_attains(
    codec: &Tested,
    directions: impl Iterator<Item = Vec3>,
    bound_deg: f64,
    part: f64,
    slack_deg: f64,
) {
    let worst = Summary::of(directions.map(|v| codec.error_deg(v))).max;
    println!("{} worst: {worst:.8}, {:.3} % of {bound_deg:.8}", codec.id, worst / bound_deg * 100.0);
    assert!(worst >= part * bound_deg, "{}: {worst} of {bound_deg}", codec.id);
    assert!(worst <= bound_deg + slack_deg, "{}: {worst} exceeds {bound_deg}", codec.id);
    assert_bounded(codec, worst);
}

/// Asserts that an error keeps to the codec's own bound.
pub fn assert_bounded(codec: &Tested, error_deg: f64) {
    let bound = codec.max_error_deg();
    assert!(error_deg <= f64::from(bound), "{}: {error_deg} exceeds the maximum, {bound}", codec.id);
}

/// Asserts that the codec chooses the nearest point along each of two coordinates: by `steps_off` at most half a step
/// away, plus `rounding` steps for `f32`.
pub fn assert_rounds(
    codec: &Tested,
    directions: impl Iterator<Item = Vec3>,
    steps_off: impl Fn([f64; 3], u64) -> [f64; 2],
    rounding: f64,
) {
    let beyond = directions.map(|v| {
        let code = codec.encode(v);
        let off = steps_off(widen(v), code);
        let beyond = off[0].max(off[1]) - 0.5;
        assert!(beyond <= rounding, "{}: {v:?} gets {code:#x}, {off:?} steps away", codec.id);
        beyond
    });
    println!("{} encode: {:.6} steps, allowed {rounding:.6}", codec.id, Summary::of(beyond).max);
}

/// Asserts that no choice is worse than that of `nearest` by more than `slack_deg`, and that mean and maximum of the errors
/// are the same to four digits. `error_deg` is the error of a code.
pub fn assert_nearest(
    codec: &Tested,
    directions: impl Iterator<Item = Vec3>,
    nearest: impl Fn([f64; 3]) -> u64,
    error_deg: impl Fn([f64; 3], u64) -> f64,
    slack_deg: f64,
) {
    let errors: Vec<[f64; 2]> = directions
        .map(|v| {
            let codes = [codec.encode(v), nearest(widen(v))];
            let [ours, best] = codes.map(|code| error_deg(widen(v), code));
            assert!(ours - best <= slack_deg, "{}: {v:?}: {codes:x?}, {ours} and {best}", codec.id);
            [ours, best]
        })
        .collect();
    let [ours, best] = [0, 1].map(|i| Summary::of(errors.iter().map(|e| e[i])));
    let excess = Summary::of(errors.iter().map(|e| e[0] - e[1])).max;
    println!("{} over nearest: {:.4} of {slack_deg:e}; {ours:?} {best:?}", codec.id, excess / slack_deg);
    for (ours, best) in [(ours.mean, best.mean), (ours.max, best.max)] {
        assert!((ours - best).abs() <= 0.5e-4 * best, "{}: {ours} is not {best} to four digits", codec.id);
    }
}

/// Asserts the contract of `encode` for any vector.
pub fn assert_total(codec: &Tested, v: Vec3) {
    assert_is_code_of(codec, v, codec.encode(v), f64::from(codec.max_error_deg()));
}

/// Asserts that `code` may be that of a vector: one of the codec's bits; +Z's without a usable direction; with one, unless
/// the codec stores raw components, an error of at most `bound_deg`.
pub fn assert_is_code_of(codec: &Tested, v: Vec3, code: u64, bound_deg: f64) {
    let z = codec.z;
    let decoded = codec.decode(code);
    assert!(code & !codec.mask() == 0, "{}: {v:?} gives {code:#x}", codec.id);
    assert!(decoded.is_finite() && decoded != Vec3::ZERO, "{}: {v:?} gives {decoded:?}", codec.id);
    match usable(v) {
        Some(false) => assert_eq!(code, z, "{}: {v:?} has no direction", codec.id),
        is_usable if codec.is_directional() => {
            // The rest of a vector below the hemisphere may itself be too short to be a direction.
            let direction = codec.reference.domain(widen(v));
            let sure =
                is_usable == Some(true) && direction.iter().map(|t| t.abs()).sum::<f64>() >= 2f64.powi(-63);
            let error = angle_deg(direction, widen(decoded));
            assert!(
                error <= bound_deg || (!sure && code == z),
                "{}: {v:?} gets {code:#x}, {error} degrees off",
                codec.id
            );
        }
        _ => {}
    }
}
