//! The octahedral codecs of 48 and 52 bits against Meyer et al. 2010: [`unitvec_tests::oracle::oct_wide`].

use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use unitvec::Listed;
use unitvec::{Codec, Oct48, OctPrecise48, OctPrecise52};
use unitvec_tests::oracle::oct_wide::{self, angle};
use unitvec_tests::oracle::{self, Summary, length, widen};
use unitvec_tests::sampling::{self, Rng, near_octant_middles, near_planes, special_inputs, sphere, usable};

/// What the rounding of a unit vector's components to `f32` turns it by at most, in radians: half an ULP of 2^-24
/// along each axis, and the decoder's arithmetic.
const VECTOR_ROUNDING: f64 = 1.732_050_81 / (1 << 25) as f64 + 2.0 * DECODE_ROUNDING;

/// What the decoder's arithmetic adds to half an ULP: 2^-33.
const DECODE_ROUNDING: f64 = 1.0 / (1u64 << 33) as f64;

/// What the encoder's arithmetic makes of a position, in steps.
const POSITION_ROUNDING: f64 = 1.0 / (1 << 20) as f64;

type Code = [u32; 2];

/// Codes: `count` at random, and all pairs of components at the ends, the folds and the parts of the range.
fn codes(bits: u32, seed: u64, count: usize) -> impl Iterator<Item = Code> {
    let (mut rng, m) = (Rng::new(seed), oct_wide::largest(bits));
    let random = (0..count).map(move |_| {
        let word = rng.bits();
        [word as u32, (word >> 32) as u32 & ((1 << (bits - 32)) - 1)]
    });
    let parts = [0, 1, 2, 3, m / 8, m / 4, m / 3, m / 2, 2 * (m / 3), m - m / 4, m - 3, m - 2, m - 1, m];
    let ends = parts.iter().flat_map(|&t| [t - 1, t, t + 1]).flat_map(|t| [t, -t]).chain([-m - 1]);
    let ends: Vec<i64> = ends.filter(|t| (-m - 1..=m).contains(t)).collect();
    let mut rng = Rng::new(seed + 1);
    let structured: Vec<Code> = ends
        .iter()
        .flat_map(|&x| ends.iter().map(move |&y| [x, y]))
        // Along the diamond's edges, where z is 0 or nearly, and along the border, where z is negative.
        .chain((0..20_000).flat_map(|_| {
            let along = rng.range(-(m as f64), m as f64) as i64;
            let across = m - along.abs();
            [
                [along, across],
                [along, -across],
                [along, across - 1],
                [along, m],
                [m, along],
                [-m, along],
                [along, 1 - m],
            ]
        }))
        .map(|point| oct_wide::pack(point, bits))
        .collect();
    random.chain(structured)
}

/// Directions of all kinds: uniform ones, those near planes and middles, and decoded codes of `bits` bits.
fn directions(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    sphere(seed, count).chain(near_planes(seed + 1, count / 4)).chain(near_octant_middles(
        seed + 2,
        count / 4,
        0.1,
    ))
}

/// The angle in radians between `v` and the oracle's direction of `code`: the error of the encoder's choice alone.
fn choice_error<C: Listed<Code = Code>>(v: Vec3) -> f64 {
    angle(widen(v), oct_wide::decode(C::encode(v), C::BITS))
}

/// The angle in radians between what was encoded and what is decoded in `f32`.
fn round_trip_error<C: Listed<Code = Code>>(v: Vec3) -> f64 {
    angle(widen(v), widen(C::decode(C::encode(v))))
}

/// Tests of every codec. `bound` is Meyer's bound of the error for the encoder, in radians; `survey_mean_24` the
/// survey's mean error in degrees of the same encoder at 24 bits, that is, with 2047 steps.
macro_rules! common_tests {
    ($codec:ty, $bound:path, $survey_mean_24:literal) => {
        use super::*;

        const BITS: u32 = <$codec>::BITS;

        /// Structured codes and 2^20 at random decode to the float next to each exact component, but for the
        /// arithmetic's 2^-33, and so to unit length to 2 ULP, with the bits above the code ignored.
        #[test]
        fn decodes_as_the_oracle() {
            let (mut worst, mut worst_length) = (0f64, 0f64);
            for code in codes(BITS, 1, 1 << 20) {
                let (decoded, expected) = (<$codec>::decode(code), oct_wide::decode(code, BITS));
                for (actual, exact) in decoded.to_array().into_iter().zip(expected) {
                    let half_ulp = f64::from(actual.abs().next_up() - actual.abs()) / 2.0;
                    let beyond = (f64::from(actual) - exact).abs() - half_ulp;
                    assert!(beyond <= DECODE_ROUNDING, "{code:x?}: {decoded:?} for {expected:?}");
                    worst = worst.max(beyond);
                }
                let off = (length(widen(decoded)) - 1.0).abs();
                assert!(off <= oracle::LENGTH_ROUNDING, "{code:x?}: {off:e}");
                worst_length = worst_length.max(off);
                let dirty = [code[0], code[1] | (code[0].wrapping_mul(0x9E37_79B9) << (BITS - 32))];
                assert_eq!(<$codec>::decode(dirty), decoded, "{dirty:x?}, bits above the code count");
            }
            let [worst, worst_length] = [worst / DECODE_ROUNDING, worst_length / f64::from(f32::EPSILON)];
            println!(
                "{} decode: half an ULP and {worst:.3} of 2^-33, length {worst_length:.3} ULP",
                <$codec>::NAME
            );
        }

        /// Structured codes and 2^20 at random, decoded, encoded and decoded, give the first vector, exactly.
        #[test]
        fn round_trip_is_stable() {
            for code in codes(BITS, 2, 1 << 20) {
                let once = <$codec>::decode(code);
                let again = <$codec>::encode(once);
                assert_eq!(<$codec>::decode(again), once, "{code:x?} comes back as {again:x?}");
            }
        }

        /// Over 10^6 directions the code's own error keeps to Meyer's bound, but for vectors that come back exactly,
        /// and its mean is the survey's, finer by the number of steps. With the decoded vector's rounding in `f32` the
        /// error keeps to the bound and that rounding, and to MAX_ERROR_DEG.
        #[test]
        fn errors_keep_to_the_bound() {
            let bound = $bound(BITS);
            let pairs =
                sphere(3, 1_000_000).map(|v| [choice_error::<$codec>(v), round_trip_error::<$codec>(v)]);
            let pairs: Vec<[f64; 2]> = pairs.collect();
            let [code, decoded] = [0, 1].map(|i| Summary::of(pairs.iter().map(|pair| pair[i])));
            let inexact = Summary::of(pairs.iter().filter(|pair| pair[1] > 0.0).map(|pair| pair[0]));
            for (of, errors) in [("code", code), ("inexact code", inexact), ("decoded vector", decoded)] {
                let [mean, max] = [errors.mean, errors.max].map(|t| t * 1e8);
                println!("{} error of the {of} in 1e-8 rad: mean {mean:.4} max {max:.4}", <$codec>::NAME);
            }
            assert!(inexact.max <= bound * 1.0001 && code.max <= bound.max(VECTOR_ROUNDING) * 1.0001);
            assert!(decoded.max <= bound * 1.0001 + VECTOR_ROUNDING);
            assert!(decoded.max.to_degrees() <= f64::from(<$codec>::MAX_ERROR_DEG));
            let published = $survey_mean_24 * 2047.0 / oct_wide::largest(BITS) as f64;
            assert!((0.99..=1.01).contains(&(code.mean.to_degrees() / published)), "{code:?} {published}");
        }

        /// Around the middles of the octants, where Meyer's bound is attained, the error of the code comes to 95 % of
        /// it at least, and does not exceed it.
        #[test]
        fn bound_is_attained_in_the_middle_of_octants() {
            let bound = $bound(BITS);
            let worst = Summary::of(
                near_octant_middles(4, 1_000_000, 0.01)
                    .filter(|&v| round_trip_error::<$codec>(v) > 0.0)
                    .map(choice_error::<$codec>),
            )
            .max;
            println!("{} worst: {:.3} % of {bound:e}", <$codec>::NAME, worst / bound * 100.0);
            assert!(worst >= 0.95 * bound && worst <= 1.0001 * bound);
        }

        /// Mirrored at a coordinate plane or with x and y swapped, a direction decodes to the decoded vector's image,
        /// exactly.
        #[test]
        fn symmetric() {
            for v in directions(5, 100_000) {
                for image in oracle::OCT_SYMMETRIES {
                    let expected = image(<$codec>::decode(<$codec>::encode(v)));
                    assert_eq!(<$codec>::decode(<$codec>::encode(image(v))), expected, "{v:?}");
                }
            }
        }

        /// The six axes come back exactly.
        #[test]
        fn keeps_the_axes() {
            for axis in sampling::AXES {
                assert_eq!(<$codec>::decode(<$codec>::encode(axis)), axis);
            }
        }

        /// Scaled by a power of two, within the range of usable norms, a vector keeps its code.
        #[test]
        fn scaling_keeps_the_code() {
            for v in sphere(6, 2000).chain(near_planes(7, 2000)) {
                let code = <$codec>::encode(v);
                for exponent in -90..=98 {
                    assert_eq!(<$codec>::encode(v * 2f32.powi(exponent)), code, "{v:?} 2^{exponent}");
                }
            }
        }

        /// Components that are -0 or a denormal count as +0, next to the shortest vectors too, where a denormal would
        /// be part of a step, and as a tie-breaker in the middle between two codes.
        #[test]
        fn negative_zeros_and_denormals_count_as_zero() {
            for tiny in [-0.0, -1e-40, 1e-40, f32::from_bits(1), f32::MIN_POSITIVE.next_down()] {
                for (a, b) in
                    [(0.6, 0.8), (-0.6, 0.8), (0.0, -1.0), (0.5, 0.5), (-0.5, 0.5), (1.0, 2f32.powi(-26))]
                {
                    let (a, b) = (a * 2f32.powi(-99), b * 2f32.powi(-99));
                    for (with, without) in [
                        (Vec3::new(tiny, a, b), Vec3::new(0.0, a, b)),
                        (Vec3::new(a, tiny, b), Vec3::new(a, 0.0, b)),
                        (Vec3::new(a, b, tiny), Vec3::new(a, b, 0.0)),
                    ] {
                        assert_eq!(<$codec>::encode(with), <$codec>::encode(without), "{with:?}");
                    }
                }
            }
        }

        /// Zeros, denormals, infinities, NaN, huge and tiny numbers in all combinations, and the fold lines.
        #[test]
        fn special_inputs_keep_the_contract() {
            special_inputs().into_iter().for_each(check_encode::<$codec>);
        }

        proptest! {
            #![proptest_config(ProptestConfig {
                rng_seed: RngSeed::Fixed(1), cases: 100_000,
                failure_persistence: None,
                ..ProptestConfig::default()
            })]

            /// Any three bit patterns taken as floats.
            #[test]
            fn any_bits_keep_the_contract(bits in any::<[u32; 3]>()) {
                check_encode::<$codec>(bits.map(f32::from_bits));
            }

            /// Any three floats of exponents that are close together, so that the directions are all over the sphere.
            #[test]
            fn any_vector_keeps_the_contract(bits in any::<[u32; 3]>(), exponent in 20u32..232) {
                check_encode::<$codec>(bits.map(|b| f32::from_bits((b & 0x81ff_ffff) + (exponent << 23))));
            }

            /// Any code, with any bits above it.
            #[test]
            fn any_code_keeps_the_contract(code in any::<[u32; 2]>()) {
                let v = <$codec>::decode(code);
                prop_assert!(v.is_finite() && (length(widen(v)) - 1.0).abs() <= oracle::LENGTH_ROUNDING);
            }
        }
    };
}

/// Asserts the contract of `encode`: a code of the codec's bits, that of +Z if `v` has no usable direction, and one
/// within the maximal error of the direction if it has.
fn check_encode<C: Listed<Code = Code>>(v: [f32; 3]) {
    let code = C::encode(Vec3::from_array(v));
    assert_eq!(code[1] >> (C::BITS - 32), 0, "{}: {v:?} gives {code:x?}", C::NAME);
    let plus_z = code == C::encode(Vec3::Z);
    let usable = usable(v);
    if usable == Some(false) {
        assert!(plus_z, "{}: {v:?} has no direction but the code {code:x?}", C::NAME);
        return;
    }
    let error = angle(v.map(f64::from), oct_wide::decode(code, C::BITS)).to_degrees();
    assert!(
        error <= f64::from(C::MAX_ERROR_DEG) || (plus_z && usable.is_none()),
        "{}: {v:?} gets {code:x?}, {error} degrees off",
        C::NAME
    );
}

/// Tests of every codec of a precise encoder.
macro_rules! precise_tests {
    ($codec:ty) => {
        common_tests!($codec, oct_wide::range_bound, 0.01953);

        /// 2 * 10^5 directions of all kinds get the code of the oracle's search, or one as near but for the rounding;
        /// or else one that decodes to the very vector, at 52 bits.
        #[test]
        fn encodes_to_the_nearest() {
            let step = oct_wide::range_bound(BITS);
            let (mut excess, mut kept, mut other, mut count) = (f64::NEG_INFINITY, 0, 0, 0);
            for v in directions(10, 100_000) {
                let (code, best) = (<$codec>::encode(v), oct_wide::nearest(widen(v), BITS));
                let [ours, least] = [code, best].map(|c| angle(widen(v), oct_wide::decode(c, BITS)));
                count += 1;
                other += usize::from(code != best);
                if BITS == 52 && <$codec>::decode(code) == v {
                    kept += usize::from(ours > least);
                    continue;
                }
                excess = excess.max((ours - least) / step);
                assert!(ours - least <= 1e-6 * step, "{v:?}: {code:x?} for {best:x?}: {ours:e} {least:e}");
            }
            println!(
                "{} over nearest: {excess:e} of the bound; other {other}, kept {kept} of {count}",
                <$codec>::NAME
            );
        }
    };
}

mod oct48 {
    common_tests!(Oct48, oct_wide::domain_bound, 0.02091);

    /// Directions of all kinds get the lattice point nearest to the oracle's position, except within 2^-20 of a step
    /// of a tie.
    #[test]
    fn encodes_as_the_oracle() {
        let worst = Summary::of(directions(8, 1_000_000).map(|v| {
            let (position, point) =
                (oct_wide::position(widen(v), BITS), oct_wide::unpack(Oct48::encode(v), BITS));
            (0..2).map(|i| (position[i] - point[i] as f64).abs() - 0.5).fold(-0.5, f64::max)
        }))
        .max;
        println!("oct48 encode: {:.4} of 2^-20 steps", worst / POSITION_ROUNDING);
        assert!(worst <= POSITION_ROUNDING, "{worst:e}");
    }
}

mod oct48p {
    precise_tests!(OctPrecise48);

    /// The format is that of the fast codec: any code decodes to the same vector.
    #[test]
    fn decodes_as_oct48() {
        for code in codes(BITS, 14, 1 << 16) {
            assert_eq!(OctPrecise48::decode(code), Oct48::decode(code));
        }
    }
}

mod oct52p {
    precise_tests!(OctPrecise52);

    /// Meyer's claim: at 52 bits the code's error is no more than that of rounding a direction to three floats.
    #[test]
    fn codes_are_as_exact_as_three_floats() {
        let mut rng = Rng::new(20);
        let floats = Summary::of((0..1_000_000).map(|_| {
            let (z, a) = (rng.range(-1.0, 1.0), rng.range(0.0, std::f64::consts::TAU));
            let r = (1.0 - z * z).sqrt();
            let v = [r * a.cos(), r * a.sin(), z];
            angle(v, v.map(|t| f64::from(t as f32)))
        }));
        let mut rng = Rng::new(20);
        let ours = Summary::of((0..1_000_000).map(|_| {
            let (z, a) = (rng.range(-1.0, 1.0), rng.range(0.0, std::f64::consts::TAU));
            let r = (1.0 - z * z).sqrt();
            let v = [r * a.cos(), r * a.sin(), z];
            angle(v, oct_wide::decode(oct_wide::nearest(v, BITS), BITS))
        }));
        println!(
            "three floats in 1e-8 rad: mean {:.4} max {:.4}; 52 bits: mean {:.4} max {:.4}; Meyer {:.4}",
            floats.mean * 1e8,
            floats.max * 1e8,
            ours.mean * 1e8,
            ours.max * 1e8,
            oct_wide::FPNV * 1e8
        );
        assert!(ours.max <= floats.max && ours.max <= oct_wide::FPNV);
    }
}
