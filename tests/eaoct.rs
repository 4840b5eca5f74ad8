//! The equal-area octahedral codecs against Clarberg 2008: [`unitvec_tests::oracle::eaoct`].

use glam::Vec3;
use std::f64::consts::FRAC_PI_2;
use unitvec::Listed;
use unitvec::eaoct as module;
use unitvec::{
    Codec, EaOct16, EaOct20, EaOct22, EaOct24, EaOct32, EaOctPrecise16, EaOctPrecise20, EaOctPrecise22,
    EaOctPrecise24, EaOctPrecise32, OctPrecise16, OctPrecise20, OctPrecise22, OctPrecise24, OctPrecise32,
};
use unitvec_tests::oracle::{
    self, EaOct, LENGTH_ROUNDING, Oracle, Summary, angle_deg, codes, cross, dot, eaoct, largest, length, oct,
    widen,
};
use unitvec_tests::remez::{Problem, polynomial};
use unitvec_tests::sampling::{self, Rng, near_planes, sphere};

/// What the rounding in `f32` makes of r in `encode`, and of phi as a part of a quarter turn.
const RADIUS_ROUNDING: f64 = 8.0 / (1 << 24) as f64;
const TURN_ROUNDING: f64 = 4.0 / (1 << 24) as f64;

/// What the rounding in `f32` turns a decoded vector by, in radians: r by 2^-25, sine and cosine by 7.0e-8, products.
const DECODE_ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// What `f32` adds to the error of a choice, in degrees: as in `MAX_ERROR_DEG`.
const ROUNDING_DEG: f64 = 26.0 / (1 << 24) as f64 * 180.0 / std::f64::consts::PI;

/// Tests of every codec: its type, the bound of its errors without rounding, and their mean over uniform directions.
macro_rules! common_tests {
    ($codec:ty, $bound:path, $mean:literal) => {
        use super::*;

        /// Every code of 16 and 20 bits, every third of 22, every 13th of 24 and 2^20 of 32 bits decode to the oracle's
        /// direction to 2^-22 radians, to unit length to 2 ULP, without -0 and with high bits ignored.
        #[test]
        fn decodes_as_the_oracle() {
            assert_decodes::<$codec>(
                sampling::codes(<$codec>::BITS, 1, 1 << 20).step_by(stride(<$codec>::BITS)),
            );
        }

        /// The same share of codes, decoded, encoded and decoded, give the first vector, exactly.
        #[test]
        fn round_trip_is_stable() {
            let all = sampling::codes(<$codec>::BITS, 2, 1 << 20).step_by(stride(<$codec>::BITS));
            oracle::assert_stable::<$codec>(all);
        }

        /// Codes of the square's border and the diamond's edge, in the same way.
        #[test]
        fn border_is_stable() {
            let m = largest(<$codec>::BITS) as i32;
            let step = (m / 2000).max(1) as usize;
            let border = (-m..=m).step_by(step).flat_map(|i| {
                let edge = m - i.abs();
                [
                    [m, i],
                    [-m, i],
                    [i, m],
                    [i, -m],
                    [i, edge],
                    [i, -edge],
                    [i, 0],
                    [0, i],
                    [i, i],
                    [i, edge - 1],
                ]
            });
            let border: Vec<u32> = border.map(|point| EaOct::pack(point, <$codec>::BITS)).collect();
            assert_decodes::<$codec>(border.iter().copied());
            oracle::assert_stable::<$codec>(border.into_iter());
        }

        /// Over 10^6 directions the mean is the stated one, to 0.5 %, and the maximum within the bound.
        #[test]
        fn errors_are_the_stated_ones() {
            let ours = Summary::of(sphere(3, 1_000_000).map(oracle::round_trip_error_deg::<$codec>));
            println!(
                "{} error: mean {:.7} max {:.7}, said {:.7}",
                <$codec>::NAME,
                ours.mean,
                ours.max,
                <$codec>::MAX_ERROR_DEG
            );
            assert!((ours.mean / $mean - 1.0).abs() <= 0.005, "{ours:?}");
            assert_bounded::<$codec>(ours.max, $bound(<$codec>::BITS));
        }

        /// Mirrored at a coordinate plane, or with x and y swapped, a direction decodes to the decoded vector's image,
        /// exactly.
        #[test]
        fn symmetric() {
            for image in oracle::OCT_SYMMETRIES {
                oracle::assert_commutes::<$codec>(sphere(5, 200_000).chain(near_planes(6, 50_000)), image);
            }
        }

        /// The six axes come back exactly.
        #[test]
        fn keeps_the_axes() {
            oracle::assert_keeps::<$codec>(&sampling::AXES);
        }

        /// Zeros, denormals, infinities, NaN, huge and tiny numbers, and any bit patterns taken as floats or codes.
        #[test]
        fn total() {
            let mut rng = Rng::new(20);
            let any = (0..100_000).map(|_| [(); 3].map(|()| f32::from_bits(rng.bits() as u32)));
            codes::assert_total::<$codec>(any, Some(codes::sphere));
            let mut rng = Rng::new(21);
            let near = (0..100_000).map(|_| {
                let exponent = 20 + rng.bits() as u32 % 212;
                [(); 3].map(|()| f32::from_bits((rng.bits() as u32 & 0x81ff_ffff) + (exponent << 23)))
            });
            codes::assert_total::<$codec>(near, Some(codes::sphere));
            codes::assert_stable::<$codec>(codes::patterns::<$codec>(22));
            codes::assert_unit::<$codec>(codes::patterns::<$codec>(23));
            assert_denormals_count_as_zero::<$codec>();
        }
    };
}

/// Modules of tests, one for each codec of a fast encoder: its type and mean error.
macro_rules! fast_codecs {
    ($($module:ident: $codec:ty, $mean:literal;)*) => {$(
        mod $module {
            common_tests!($codec, eaoct::fast_bound_deg, $mean);

            /// 10^6 directions and those near the coordinate planes get the nearest ring and the nearest of its points,
            /// except within `f32` rounding of a tie.
            #[test]
            fn encodes_as_the_oracle() {
                let m = largest(<$codec>::BITS);
                let beyond = sphere(8, 1_000_000).chain(near_planes(9, 100_000)).map(|v| {
                    let code = <$codec>::encode(v);
                    let ([r, phi], [ring, place]) =
                        (eaoct::polar(widen(v)), eaoct::ring_point(code, <$codec>::BITS).map(f64::from));
                    let across = ((r * m - ring).abs() - 0.5) / (m * RADIUS_ROUNDING * r);
                    let along = ((phi * ring - place).abs() - 0.5) / (ring.max(1.0) * TURN_ROUNDING);
                    let signs = angle_deg(widen(v), widen(<$codec>::decode(code)));
                    assert!(
                        across <= 1.0 && along <= 1.0 && signs <= f64::from(<$codec>::MAX_ERROR_DEG),
                        "{v:?} at {r}, {phi} gets {code:#x}, point {place} of ring {ring}"
                    );
                    across.max(along)
                });
                println!("{} encode: {:.3} of the rounding", <$codec>::NAME, Summary::of(beyond).max);
            }

            /// Midway between the points of ring 1, half a ring out, the error comes to 98 % of the bound at least.
            #[test]
            fn bound_is_attained_near_the_pole() {
                let m = largest(<$codec>::BITS);
                assert_attains::<$codec>([[1.5 / m, 0.5]], 0.01, eaoct::fast_bound_deg(<$codec>::BITS));
            }
        }
    )*};
}

/// Modules of tests, one for each codec of a precise encoder: its type, that of [`unitvec::OctPrecise`], mean and
/// maximum of the error over 10^6 directions.
macro_rules! precise_codecs {
    ($($module:ident: $codec:ty, $oct:ty, $mean:literal, $max:literal;)*) => {$(
        mod $module {
            common_tests!($codec, eaoct::precise_bound_deg, $mean);

            /// 10^5 directions and those near the coordinate planes get the code of the oracle's search.
            #[test]
            fn encodes_to_the_nearest() {
                let nearest = |v| eaoct::nearest_in_neighbourhood(v, <$codec>::BITS);
                assert_nearest::<$codec>(sphere(10, 100_000), nearest);
                assert_nearest::<$codec>(near_planes(11, 50_000), nearest);
                assert_nearest::<$codec>(near_pole(12, 50_000, 6.0 / largest(<$codec>::BITS)), nearest);
            }

            /// Where the points of two rings lie opposite each other, near a pole and y = 0, the error comes to 98 % of
            /// the bound at least; nowhere along that edge does it exceed it.
            #[test]
            fn bound_is_attained_near_the_pole() {
                let m = largest(<$codec>::BITS);
                let middles = (1..m as u32).step_by((m as usize / 2000).max(1)).map(|ring| {
                    let ring = f64::from(ring) + 0.5;
                    [ring / m, 0.5 / ring]
                });
                assert_attains::<$codec>(middles, 0.01, eaoct::precise_bound_deg(<$codec>::BITS));
            }

            /// Mean and maximum over 10^6 directions are below those of the octahedral code of the same bits, and the
            /// maximum is the planned one, to 1 %.
            #[test]
            fn better_than_oct() {
                let ours = Summary::of(sphere(13, 1_000_000).map(oracle::round_trip_error_deg::<$codec>));
                let oct = Summary::of(sphere(13, 1_000_000).map(oracle::round_trip_error_deg::<$oct>));
                assert!(ours.mean < oct.mean && ours.max < oct.max, "{ours:?} {oct:?}");
                assert!((ours.max / $max - 1.0).abs() <= 0.01, "{ours:?}");
            }
        }
    )*};
}

fast_codecs! {
    eaoct16: EaOct16, 0.30960;
    eaoct20: EaOct20, 0.07695;
    eaoct22: EaOct22, 0.03843;
    eaoct24: EaOct24, 0.01921;
    eaoct32: EaOct32, 0.00120;
}

precise_codecs! {
    eaoct16p: EaOctPrecise16, OctPrecise16, 0.3059, 0.5815;
    eaoct20p: EaOctPrecise20, OctPrecise20, 0.07608, 0.1454;
    eaoct22p: EaOctPrecise22, OctPrecise22, 0.03800, 0.0726;
    eaoct24p: EaOctPrecise24, OctPrecise24, 0.01900, 0.03628;
    eaoct32p: EaOctPrecise32, OctPrecise32, 0.001187, 0.002262;
}

/// Of all codes of 22 and 24 bits a part is enough. Odd, so that all residues of powers of two are among them.
fn stride(bits: u32) -> usize {
    match bits {
        22 => 3,
        24 => 13,
        _ => 1,
    }
}

/// Directions within about `radius` of both poles.
fn near_pole(seed: u64, count: usize, radius: f64) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        let z = if rng.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let [x, y] = [(); 2].map(|()| rng.range(-radius, radius));
        Vec3::from_array([x, y, z].map(|t| t as f32))
    })
}

/// Asserts that `C` decodes each of `codes` to the oracle's direction and to unit length, without -0, with the high bits
/// of the code set to anything.
fn assert_decodes<C: Listed<Code = u32>>(codes: impl Iterator<Item = u32>) {
    let (mut worst_turn, mut worst_length) = (0f64, 0f64);
    for code in codes {
        let decoded = C::decode(code);
        let (actual, expected) = (widen(decoded), EaOct::decode(code, C::BITS));
        let (turn, off) = (length(cross(actual, expected)), (length(actual) - 1.0).abs());
        let fits = turn <= DECODE_ROUNDING && dot(actual, expected) > 0.0 && off <= LENGTH_ROUNDING;
        assert!(
            fits,
            "{}: {code:#x} decodes to {decoded:?}, {turn:e} rad and {off:e} off {expected:?}",
            C::NAME
        );
        let negative_zero = decoded.to_array().iter().any(|t| t.to_bits() == (-0f32).to_bits());
        assert!(!negative_zero, "{}: {code:#x} decodes to {decoded:?}", C::NAME);
        if C::BITS < 32 {
            let dirty = code | (code.wrapping_mul(0x9E37_79B9) << C::BITS);
            assert_eq!(C::decode(dirty), decoded, "{}: {dirty:#x}, bits above the code count", C::NAME);
        }
        (worst_turn, worst_length) = (worst_turn.max(turn), worst_length.max(off));
    }
    let ulp = f64::from(f32::EPSILON);
    println!(
        "{} decode: {:.3} ULP turned, {:.3} ULP of length",
        C::NAME,
        worst_turn / ulp,
        worst_length / ulp
    );
}

/// Asserts that `error_deg` is at most `bound_deg` and what `f32` rounds, and at most [`Codec::MAX_ERROR_DEG`].
fn assert_bounded<C: Listed>(error_deg: f64, bound_deg: f64) {
    assert!(error_deg <= bound_deg + ROUNDING_DEG, "{}: {error_deg} exceeds {bound_deg}", C::NAME);
    assert!(error_deg <= f64::from(C::MAX_ERROR_DEG), "{}: {error_deg} exceeds MAX_ERROR_DEG", C::NAME);
}

/// Asserts that around `middles`, pairs of r and phi, by up to `radius` of a step, the largest error is at least 98 % of
/// `bound_deg`, and not above it.
fn assert_attains<C: Listed<Code = u32>>(
    middles: impl IntoIterator<Item = [f64; 2]>,
    radius: f64,
    bound_deg: f64,
) {
    let (mut rng, m) = (Rng::new(4), largest(C::BITS));
    let errors = middles.into_iter().flat_map(|[r, phi]| {
        let spread = [(); 100].map(|()| {
            let [a, b] = [(); 2].map(|()| rng.range(-radius, radius));
            eaoct::at([r + a / m, phi + b / (r * m)])
        });
        spread.map(|v| oracle::round_trip_error_deg::<C>(Vec3::from_array(v.map(|t| t as f32))))
    });
    let worst = Summary::of(errors).max;
    println!("{} worst: {worst:.7}, {:.3} % of {bound_deg:.7}", C::NAME, worst / bound_deg * 100.0);
    assert!(worst >= 0.98 * bound_deg, "{worst} of {bound_deg}");
    assert_bounded::<C>(worst, bound_deg);
}

/// Asserts that mean and maximum of the errors of `C`'s choices are those of `nearest` to four digits, and that no
/// choice is worse by more than the rounding in `f32` and 1e-5 of a step, which the measure neglects at 16 bits.
fn assert_nearest<C: Listed<Code = u32>>(
    directions: impl Iterator<Item = Vec3>,
    nearest: impl Fn([f64; 3]) -> u32,
) {
    let neglected = 1e-5 / largest(C::BITS);
    let slack = 2.0 * (ROUNDING_DEG + neglected.to_degrees());
    let errors: Vec<[f64; 2]> = directions
        .map(|v| {
            let codes = [C::encode(v), nearest(widen(v))];
            let [ours, best] = codes.map(|code| angle_deg(widen(v), EaOct::decode(code, C::BITS)));
            assert!(ours - best <= slack, "{}: {v:?}: {codes:x?}, {ours} and {best}", C::NAME);
            [ours, best]
        })
        .collect();
    let [ours, best] = [0, 1].map(|i| Summary::of(errors.iter().map(|e| e[i])));
    let excess = Summary::of(errors.iter().map(|e| e[0] - e[1])).max;
    println!("{} over nearest: {:.4} of {slack:e}; {ours:?} {best:?}", C::NAME, excess / slack);
    for (ours, best) in [(ours.mean, best.mean), (ours.max, best.max)] {
        assert!((ours - best).abs() <= 0.5e-4 * best, "{}: {ours} is not {best} to four digits", C::NAME);
    }
}

/// Asserts that components of -0 or a denormal count as 0, beside others as short as vectors may be too.
fn assert_denormals_count_as_zero<C: Listed<Code = u32>>() {
    let mut rng = Rng::new(24);
    let code = |v: [f32; 3]| C::encode(Vec3::from_array(v));
    for tiny in [
        -0.0,
        -1e-40,
        1e-40,
        -f32::from_bits(1),
        f32::MIN_POSITIVE.next_down(),
        -f32::MIN_POSITIVE.next_down(),
    ] {
        for _ in 0..2000 {
            let scale = if rng.bits() & 1 == 0 { 1.0 } else { 2.0 * f64::from(sampling::LEAST_NORM) };
            let [a, b] = [(); 2].map(|()| (rng.range(-2.0, 2.0) * scale) as f32);
            assert_eq!(code([tiny, a, b]), code([0.0, a, b]), "{}: {tiny:e} {a:e} {b:e}", C::NAME);
            assert_eq!(code([a, tiny, b]), code([a, 0.0, b]), "{}: {a:e} {tiny:e} {b:e}", C::NAME);
            assert_eq!(code([a, b, tiny]), code([a, b, 0.0]), "{}: {a:e} {b:e} {tiny:e}", C::NAME);
        }
    }
}

/// 16 bits, precise: the nearest of all 65536 codes, for 30 000 directions, 10 000 of them near coordinate planes.
#[test]
fn eaoct16p_encodes_to_the_nearest_of_all() {
    let all: Vec<[f64; 3]> = (0..1 << 16).map(|code| EaOct::decode(code, 16)).collect();
    assert_nearest::<EaOctPrecise16>(sphere(14, 20_000), |v| oct::nearest_of_all(v, &all));
    assert_nearest::<EaOctPrecise16>(near_planes(15, 10_000), |v| oct::nearest_of_all(v, &all));
}

/// Codes are those of oct's layout: +X, +Y, +-Z and the patterns that encoding never writes.
#[test]
fn layout() {
    assert_eq!(EaOct16::encode(Vec3::X), 0x007f);
    assert_eq!(EaOct16::encode(Vec3::NEG_Y), 0x8100);
    assert_eq!(EaOct16::encode(Vec3::Z), 0x0000);
    assert_eq!(EaOct32::encode(Vec3::NEG_Z), 0x7fff_7fff);
    assert_eq!(EaOct16::decode(0x0080), Vec3::NEG_X);
    assert_eq!(EaOct22::decode(1 << 21), Vec3::NEG_Y);
    assert_eq!(EaOct32::decode(0x8000_8000), Vec3::NEG_Z);
    assert_eq!(EaOct24::encode(Vec3::X), oct::code([0xff, 0xe7, 0xff]));
    assert_eq!(EaOct24::decode(oct::code([0xff, 0xf7, 0xff])), Vec3::X);
}

/// The coefficients of phi are what the Remez exchange gives, rounded to f32, and leave the error the docs state.
#[test]
fn coefficients_are_minimax() {
    let problem = Problem { target: |u| u.sqrt().atan() / FRAC_PI_2, weight: f64::sqrt, end: 1.0 };
    let constants = [
        module::TURN_0,
        module::TURN_1,
        module::TURN_2,
        module::TURN_3,
        module::TURN_4,
        module::TURN_5,
        module::TURN_6,
        module::TURN_7,
    ];
    let fit = problem.solve(8);
    let rounded: Vec<f32> = fit.coefficients.iter().map(|&c| c as f32).collect();
    let exact = constants.map(f64::from);
    let error = |i: i32| {
        let q = f64::from(i) / 1e5;
        (q * polynomial(&exact, q * q) - q.atan() / FRAC_PI_2).abs()
    };
    let worst = Summary::of((0..=100_000).map(error)).max;
    println!("error {:.3e}, rounded {worst:.3e}, {rounded:?}", fit.error);
    assert_eq!(rounded, constants);
    assert!(worst <= 5.1e-8, "{worst}");
}

/// All cells have the same area: rings split the octant's area by the squares of their numbers, for ring s has a z of
/// `1 - s^2 / m^2`.
#[test]
fn rings_are_of_equal_area() {
    for ring in 0u16..=127 {
        let (z, part) = (EaOct16::decode(u32::from(ring)).z, f32::from(ring) / 127.0);
        assert!((1.0 - z - part * part).abs() <= f32::EPSILON, "{ring}: {z}");
    }
}
