//! The octahedral codecs of 48 and 52 bits: codes finer than `f32` vectors.

use glam::Vec3;
use unitvec_oracle::{Oct, Oracle, Summary, angle, largest, oct};
use unitvec_tests::directions::{near_octant_middles, near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

/// The angle, at most, by which the rounding of a unit vector's components to `f32` turns it, in radians: half an ULP
/// of 2^-24 along each axis, and the decoder's arithmetic.
const VECTOR_ROUNDING: f64 = 1.732_050_81 / (1 << 25) as f64 + 2.0 * DECODE_ROUNDING;

/// The error that the decoder's arithmetic adds to half an ULP: 2^-33.
const DECODE_ROUNDING: f64 = 1.0 / (1u64 << 33) as f64;

/// Directions of all kinds: uniform ones, and those near planes and middles.
fn directions(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let middles = near_octant_middles(seed + 2, count / 4, 0.1);
    sphere(seed, count).chain(near_planes(seed + 1, count / 4)).chain(middles)
}

/// Meyer's bound of the error for the encoder, leading term, in radians.
fn bound(codec: &Tested) -> f64 {
    let degrees = if codec.is_precise() { oct::range_bound_deg } else { oct::domain_bound_deg };
    degrees(codec.bits).to_radians()
}

/// The angle in radians between `v` and the oracle's direction of its code: the error of the encoder's choice alone.
fn choice_error(codec: &Tested, v: Vec3) -> f64 {
    angle(widen(v), Oct::decode(codec.encode(v), codec.bits))
}

/// Codes decode to the float next to each exact component, but for the arithmetic's 2^-33.
#[test]
fn decodes_to_the_next_float() {
    for codec in Tested::family("oct_wide") {
        let mut worst = 0f64;
        for code in codec.codes(1, 22) {
            let (decoded, expected) = (codec.decode(code), Oct::decode(code, codec.bits));
            for (actual, exact) in decoded.to_array().into_iter().zip(expected) {
                let half_ulp = f64::from(actual.abs().next_up() - actual.abs()) / 2.0;
                let beyond = (f64::from(actual) - exact).abs() - half_ulp;
                assert!(beyond <= DECODE_ROUNDING, "{}: {code:#x}: {decoded:?} for {expected:?}", codec.id);
                worst = worst.max(beyond);
            }
        }
        println!("{} decode: half an ULP and {:.3} of 2^-33", codec.id, worst / DECODE_ROUNDING);
    }
}

/// Over 10^6 directions the code's own error keeps to Meyer's bound, but for vectors that come back exactly, and its mean
/// is the survey's of 24 bits, finer by the number of steps. With the decoded vector's rounding in `f32` the error keeps to
/// the bound and that rounding. At 52 bits the bound is no more than the error of rounding a direction to three floats.
#[test]
fn errors_keep_to_the_bound() {
    for codec in Tested::family("oct_wide") {
        let bound = bound(&codec);
        let pairs: Vec<[f64; 2]> = sphere(3, 1_000_000)
            .map(|v| [choice_error(&codec, v), angle(widen(v), widen(codec.round_trip(v)))])
            .collect();
        let [code, decoded] = [0, 1].map(|i| Summary::of(pairs.iter().map(|pair| pair[i])));
        let inexact = Summary::of(pairs.iter().filter(|pair| pair[1] > 0.0).map(|pair| pair[0]));
        for (of, errors) in [("code", code), ("inexact code", inexact), ("decoded vector", decoded)] {
            let [mean, max] = [errors.mean, errors.max].map(|t| t * 1e8);
            println!("{} error of the {of} in 1e-8 rad: mean {mean:.4} max {max:.4}", codec.id);
        }
        assert!(
            inexact.max <= bound * 1.0001 && code.max <= bound.max(VECTOR_ROUNDING) * 1.0001,
            "{}",
            codec.id
        );
        assert!(decoded.max <= bound * 1.0001 + VECTOR_ROUNDING, "{}", codec.id);
        assert!(codec.bits < 52 || bound <= oct::FPNV, "{}: coarser than three floats", codec.id);
        let survey_mean_24 = if codec.is_precise() { 0.01953 } else { 0.02091 };
        let published = survey_mean_24 * largest(24) / largest(codec.bits);
        let mean = code.mean.to_degrees() / published;
        assert!((0.99..=1.01).contains(&mean), "{}: {code:?} {published}", codec.id);
    }
}

/// Around the middles of the octants, where Meyer's bound is attained, the error of the code comes to 95 % of it at
/// least, and does not exceed it.
#[test]
fn bound_is_attained_in_the_middle_of_octants() {
    for codec in Tested::family("oct_wide") {
        let directions = near_octant_middles(4, 1_000_000, 0.01).filter(|&v| codec.error_deg(v) > 0.0);
        let part = Summary::of(directions.map(|v| choice_error(&codec, v))).max / bound(&codec);
        println!("{} worst: {:.3} % of the bound", codec.id, part * 100.0);
        assert!((0.95..=1.0001).contains(&part), "{}: {part}", codec.id);
    }
}

/// The precise encoders give 1.5 * 10^5 directions of all kinds the code of the oracle's search, or one as near but for
/// the rounding; or else, at 52 bits, one that decodes to the very vector.
#[test]
fn encodes_to_the_nearest() {
    for codec in Tested::family("oct_wide").iter().filter(|codec| codec.is_precise()) {
        let step = bound(codec);
        let (mut excess, mut kept, mut count) = (f64::NEG_INFINITY, 0, 0);
        for v in directions(10, 100_000) {
            let (code, best) = (codec.encode(v), oct::nearest_in_neighbourhood(widen(v), codec.bits));
            let [ours, least] = [code, best].map(|code| angle(widen(v), Oct::decode(code, codec.bits)));
            count += 1;
            if codec.bits == 52 && codec.decode(code) == v {
                kept += usize::from(ours > least);
                continue;
            }
            excess = excess.max((ours - least) / step);
            assert!(ours - least <= 1e-6 * step, "{}: {v:?}: {code:#x} for {best:#x}", codec.id);
        }
        println!("{} over nearest: {excess:e} of the bound; kept {kept} of {count}", codec.id);
    }
}

/// The format is that of the fast codec: any code decodes to the same vector.
#[test]
fn oct48p_decodes_as_oct48() {
    let [fast, precise] = ["oct48", "oct48p"].map(Tested::find);
    for code in fast.edges(14) {
        assert_eq!(precise.decode(code), fast.decode(code));
    }
}
