//! The azimuthal codecs against the papers: [`unitvec_tests::oracle::azimuthal`] and the survey's table 1.

use glam::Vec3;
use std::f64::consts::FRAC_PI_2;
use unitvec::Codec;
use unitvec::Listed;
use unitvec::azimuthal::Azimuthal;
use unitvec::azimuthal::{self, Concentric, Ellipse, Eqarea, Eqdist, Plain, Projection, SquareMap, Stereo};
use unitvec_tests::oracle::azimuthal::{self as papers, PLAIN, corner, largest_of_both, parts};
use unitvec_tests::oracle::{self, Oracle, Summary, angle_deg, cross, dot, length, widen};
use unitvec_tests::remez::Problem;
use unitvec_tests::sampling::{self, Rng, near_planes, sphere};

/// What the rounding of a position in `f32` comes to on the square `[-1, 1]^2`, per axis: 8 roundings of 2^-24.
const POSITION_ROUNDING: f64 = 1.0 / (1 << 21) as f64;

/// What `decode` makes of the rounding in `f32`, as an angle in radians: 4 roundings of 2^-24.
const DECODE_ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// How far off its lattice point, in steps, a position may be: half a step, or a 64th more at the rim.
const BEYOND_HALF: f64 = 1.0 / 64.0;

/// Codes to try: all up to 22 bits, each 15th of 24, 2^19 random ones of 32.
fn codes(bits: u32) -> Box<dyn Iterator<Item = u32>> {
    match bits {
        ..=22 => Box::new(0..1 << bits),
        24 => Box::new((0..1 << bits).step_by(15)),
        _ => {
            let mut rng = Rng::new(1);
            Box::new((0..1 << 19).map(move |_| rng.bits() as u32))
        }
    }
}

/// Directions that fall on the spots to trip over: next to the equator, the poles and the square's diagonals.
fn near_edges(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    near_planes(seed + 1, count).map(move |v| {
        let small = 2f32.powf(rng.range(-24.0, 0.0) as f32);
        match rng.bits() % 4 {
            0 => Vec3::new(v.x, v.y, v.z * small),
            1 => Vec3::new(v.x * small, v.y * small, v.z),
            2 => Vec3::new(v.x, v.x * (1.0 + small), v.z * small),
            _ => Vec3::new(v.x, -v.x, v.z),
        }
    })
}

/// Every code decodes to the oracle's direction, to unit length to 2 ULP, without -0, with high bits ignored; and
/// decoded, encoded and decoded it gives the first vector, exactly.
fn check_codes<C: Listed<Code = u32>, O: Oracle, const MAP: u32>() {
    let (mut worst_turn, mut worst_length) = (0f64, 0f64);
    for code in codes(C::BITS) {
        let decoded = C::decode(code);
        let again = C::encode(decoded);
        assert_eq!(C::decode(again), decoded, "{}: {code:#x} comes back as {again:#x}", C::NAME);
        assert!(
            decoded.to_array().iter().all(|t| t.to_bits() != (-0f32).to_bits()),
            "{}: {code:#x} decodes to {decoded:?}",
            C::NAME
        );
        if C::BITS < 32 {
            let dirty = code | (code.wrapping_mul(0x9E37_79B9) << C::BITS);
            assert_eq!(C::decode(dirty), decoded, "{}: {dirty:#x}, bits above the code", C::NAME);
        }
        let off = (length(widen(decoded)) - 1.0).abs();
        worst_length = worst_length.max(off);
        assert!(off <= oracle::LENGTH_ROUNDING, "{}: {code:#x}: {off:e} off length 1", C::NAME);
        // The oracle is slow: all codes of 16 bits, each 13th of the others.
        if C::BITS > 16 && code % 13 != 0 {
            continue;
        }
        let p = parts(code, C::BITS);
        if MAP == PLAIN && (corner(p, C::BITS) - 1.0).abs() < 1e-6 {
            continue;
        }
        let (actual, expected) = (widen(decoded), O::decode(code, C::BITS));
        let turn = length(cross(actual, expected));
        // Points on the rim are found with its slope taken as constant: along it, they may be off by a part of a
        // step.
        let rim = if MAP == PLAIN && decoded.z == 0.0 { 0.15 / largest_of_both(C::BITS)[1] } else { 0.0 };
        assert!(
            turn <= DECODE_ROUNDING + rim && dot(actual, expected) > 0.0,
            "{}: {code:#x} {p:?} decodes to {decoded:?}, {turn:e} rad off {expected:?}",
            C::NAME
        );
        worst_turn = worst_turn.max(turn - rim);
    }
    let ulp = f64::from(f32::EPSILON);
    println!("{}: {:.2} ULP turned, {:.2} ULP of length", C::NAME, worst_turn / ulp, worst_length / ulp);
}

/// Directions get the lattice point nearest to the oracle's position and the bit of their hemisphere, except within
/// `f32` rounding of a tie.
fn check_encode<C: Listed<Code = u32>, O: Oracle, const MAP: u32>() {
    let (m, mut worst) = (largest_of_both(C::BITS), 0f64);
    for v in sphere(2, 50_000).chain(near_edges(3, 50_000)) {
        let code = C::encode(v);
        let (position, p) = (O::position(widen(v)), parts(code, C::BITS));
        let point = [p.u, p.v].map(f64::from);
        let off = |i: usize| (position[i] * m[i] - point[i]).abs() - 0.5;
        let nearest = [0, 1].map(|i| (position[i] * m[i]).round() as i32);
        let remote = MAP == PLAIN
            && corner(papers::Parts { u: nearest[0], v: nearest[1], flag: false }, C::BITS) > 1.0 - 1e-6;
        let slack = if remote { [BEYOND_HALF; 2] } else { [0.0; 2] };
        for i in 0..2 {
            let beyond = off(i) - slack[i];
            assert!(
                beyond <= POSITION_ROUNDING * m[i],
                "{}: {v:?} of position {position:?} gets {code:#x}, {p:?}, {beyond} steps beyond",
                C::NAME
            );
            worst = worst.max(beyond / m[i]);
        }
        if p.v.abs() < m[1] as i32 {
            assert_eq!(p.flag, v.z <= -f32::MIN_POSITIVE, "{}: {v:?} gets {code:#x}", C::NAME);
        }
    }
    println!("{} encode: {:.3} of 2^-21", C::NAME, worst / POSITION_ROUNDING);
}

/// Mean and maximum over 10^6 directions are those of the survey's table 1 and below [`Codec::MAX_ERROR_DEG`]; next
/// to edges too there is no greater error.
///
/// The greatest error of eqarea+concentric is that of a few cells on the rim at the diagonals, and which of 10^6
/// directions come near it is chance: at 22 bits, with twelve seeds, 1.020 to 1.044 times the survey's, whose
/// value is 0.947 of the supremum (0.950 to 0.969 at other widths). So it gets 5 % there, the others 4 %.
fn check_errors<C: Listed<Code = u32>>(mean: f64, max: f64) {
    let half_digit = 0.000_005;
    let ours = Summary::of(sphere(4, 1_000_000).map(oracle::round_trip_error_deg::<C>));
    let edges = Summary::of(near_edges(5, 100_000).map(oracle::round_trip_error_deg::<C>)).max;
    let bound = f64::from(C::MAX_ERROR_DEG);
    println!(
        "{}: mean {:.6} ({:.4} of the survey's) max {:.6} ({:.4}), edges {edges:.6}, bound {bound:.6} ({:.3})",
        C::NAME,
        ours.mean,
        ours.mean / mean,
        ours.max,
        ours.max / max,
        ours.max.max(edges) / bound
    );
    assert!(ours.mean <= (mean + half_digit) * 1.01, "{}: {ours:?}", C::NAME);
    assert!(ours.mean >= (mean - half_digit) * 0.95, "{}: {ours:?}", C::NAME);
    let allowed = if C::NAME == "eqarea_concentric22" { 1.05 } else { 1.04 };
    assert!(ours.max <= (max + half_digit) * allowed, "{}: {ours:?}", C::NAME);
    assert!(ours.max <= bound && edges <= bound, "{}: {ours:?} {edges} exceeds {bound}", C::NAME);
    assert!(ours.max >= 0.8 * bound, "{}: {ours:?}, far below {bound}", C::NAME);
}

/// Modules of tests, one for each pair of projection and map: their types, the oracle's, and of each width the
/// survey's mean and maximal error.
macro_rules! codecs {
    ($($module:ident: $projection:ident, $map:ident, $papers_projection:ident, $papers_map:ident;
        $($bits:literal $mean:literal $max:literal),*;)*) => {$(
        mod $module {
            use super::*;

            type Papers = papers::Azimuthal<{ papers::$papers_projection }, { papers::$papers_map }>;

            /// See [`check_codes`].
            #[test]
            fn decodes_as_the_oracle_and_is_stable() {
                $(check_codes::<Azimuthal<$projection, $map, $bits>, Papers, { papers::$papers_map }>();)*
            }

            /// See [`check_encode`].
            #[test]
            fn encodes_as_the_oracle() {
                $(check_encode::<Azimuthal<$projection, $map, $bits>, Papers, { papers::$papers_map }>();)*
            }

            /// See [`check_errors`].
            #[test]
            fn errors_are_the_published_ones() {
                $(check_errors::<Azimuthal<$projection, $map, $bits>>($mean, $max);)*
            }

            /// The six axes come back exactly.
            #[test]
            fn keeps_the_axes() {
                $(oracle::assert_keeps::<Azimuthal<$projection, $map, $bits>>(&sampling::AXES);)*
            }

            /// Mirrored at a coordinate plane, a direction decodes to the decoded vector's image, exactly.
            #[test]
            fn symmetric() {
                let images: [fn(Vec3) -> Vec3; 3] = [
                    |v| Vec3::new(-v.x, v.y, v.z),
                    |v| Vec3::new(v.x, -v.y, v.z),
                    |v| Vec3::new(v.x, v.y, -v.z),
                ];
                for image in images {
                    $(oracle::assert_commutes::<Azimuthal<$projection, $map, $bits>>(
                        sphere(6, 10_000).chain(near_edges(7, 10_000)),
                        image,
                    );)*
                }
            }

            /// The constant behind the error bound is the oracle's, up to 0.3 %; without a map a 64th of a step is
            /// added to half a step at the rim, where stereo's is small.
            #[test]
            fn stretch_is_the_oracles() {
                let found = papers::stretch::<{ papers::$papers_projection }, { papers::$papers_map }>(64.0 / 127.0);
                let rim = if <$map>::INDEX == 0 && <$projection>::INDEX > 0 { 1.0 + 2.0 * BEYOND_HALF } else { 1.0 };
                let stated = f64::from(<$map>::STRETCH[<$projection>::INDEX as usize]) / rim;
                println!("{}: {found} of {stated}", stringify!($module));
                assert!(found <= stated && found >= 0.997 * stated, "{found} and {stated}");
            }
        }
    )*};
}

codecs! {
    stereo: Stereo, Plain, STEREO, PLAIN;
        16 0.40140 1.00318, 20 0.09980 0.24779, 22 0.04979 0.12437, 24 0.02490 0.06230, 32 0.00155 0.00547;
    stereo_concentric: Stereo, Concentric, STEREO, CONCENTRIC;
        16 0.37364 1.29985, 20 0.09290 0.32722, 22 0.04642 0.16228, 24 0.02319 0.08305, 32 0.00146 0.00522;
    stereo_ellipse: Stereo, Ellipse, STEREO, ELLIPSE;
        16 0.38233 1.00318, 20 0.09494 0.26171, 22 0.04746 0.14104, 24 0.02372 0.08093, 32 0.00149 0.02592;
    eqarea: Eqarea, Plain, EQAREA, PLAIN;
        16 0.38716 0.96092, 20 0.09627 0.24355, 22 0.04806 0.11915, 24 0.02402 0.06067, 32 0.00150 0.00383;
    eqarea_concentric: Eqarea, Concentric, EQAREA, CONCENTRIC;
        16 0.36584 1.00697, 20 0.09096 0.24671, 22 0.04545 0.12304, 24 0.02273 0.06265, 32 0.00142 0.00391;
    eqarea_ellipse: Eqarea, Ellipse, EQAREA, ELLIPSE;
        16 0.35217 0.90617, 20 0.08758 0.22567, 22 0.04374 0.11238, 24 0.02185 0.05615, 32 0.00137 0.01705;
    eqdist: Eqdist, Plain, EQDIST, PLAIN;
        16 0.38452 0.78944, 20 0.09541 0.19667, 22 0.04768 0.09806, 24 0.02387 0.04899, 32 0.00149 0.00307;
    eqdist_concentric: Eqdist, Concentric, EQDIST, CONCENTRIC;
        16 0.36114 1.05603, 20 0.08975 0.25856, 22 0.04484 0.12983, 24 0.02241 0.06548, 32 0.00141 0.00409;
    eqdist_ellipse: Eqdist, Ellipse, EQDIST, ELLIPSE;
        16 0.35663 0.79669, 20 0.08851 0.19633, 22 0.04418 0.10132, 24 0.02208 0.05704, 32 0.00138 0.01807;
}

/// Both coefficient sets are what the Remez exchange gives, rounded to f32, and leave the error the docs state.
#[test]
fn coefficients_are_minimax() {
    let sinc = Problem {
        target: |c| {
            let r = (1.0 - c).max(1e-14).sqrt();
            (FRAC_PI_2 * r).sin() / r - 1.0
        },
        weight: |c| c,
        end: 1.0,
    };
    let cosc = Problem {
        target: |w| {
            // cos(pi r / 2) = sin(pi/2 (1 - r)), 1 - r = c / (1 + r).
            let c = (1.0 - w).max(1e-12);
            (FRAC_PI_2 * c / (1.0 + w.sqrt())).sin() / c - 1.0
        },
        weight: |w| w,
        end: 1.0,
    };
    let sinc_constants = [azimuthal::SINC_0, azimuthal::SINC_1, azimuthal::SINC_2, azimuthal::SINC_3];
    let cosc_constants = [azimuthal::COSC_0, azimuthal::COSC_1, azimuthal::COSC_2, azimuthal::COSC_3];
    for (problem, constants, bound) in [(sinc, sinc_constants, 7.6e-9), (cosc, cosc_constants, 1e-9)] {
        let fit = problem.solve(4);
        let rounded: Vec<f32> = fit.coefficients.iter().map(|&c| c as f32).collect();
        println!("error {:.3e}, {rounded:?}", fit.error);
        assert_eq!(rounded, constants);
        assert!(fit.error <= bound, "{}", fit.error);
    }
}

/// Where the fields lie: u lowest, v above it, the hemisphere on top, which at v's ends is v's sign instead.
#[test]
fn layout() {
    use unitvec::{EqdistEllipse16, Stereo16, Stereo32, StereoConcentric24};
    assert_eq!(Stereo16::encode(Vec3::Z), 0);
    assert_eq!(Stereo16::encode(Vec3::NEG_Z), 0x8000);
    assert_eq!(Stereo16::encode(Vec3::X), 0x007f);
    assert_eq!(Stereo16::encode(Vec3::NEG_X), 0x0081);
    assert_eq!(Stereo16::encode(Vec3::Y), 0xc000);
    assert_eq!(Stereo16::encode(Vec3::NEG_Y), 0x4000);
    assert_eq!(Stereo32::encode(Vec3::Y), 0xc000_0000);
    assert_eq!(Stereo32::encode(Vec3::NEG_X), 0x8001);
    assert_eq!(EqdistEllipse16::encode(Vec3::new(1.0, 1.0, 0.0)), 0xc07f);
    assert_eq!(StereoConcentric24::encode(Vec3::new(1.0, -1.0, 0.0)), 0x40_07ff);
    // The pattern of u that encoding never writes is -1; corners that it never writes are an axis.
    assert_eq!(Stereo16::decode(0x0080), Vec3::NEG_X);
    assert_eq!(Stereo16::decode(0x407f), Vec3::NEG_Y);
    assert_eq!(Stereo16::decode(0x3f7f), Vec3::X);
}

/// The square's corners, where the survey's ellipse codes err by up to 0.026 degrees: at 32 bits the error stays
/// below the bound of the whole square.
#[test]
fn ellipse_is_exact_at_the_corners() {
    fn check<C: Listed<Code = u32>>() {
        let mut rng = Rng::new(9);
        let worst = Summary::of((0..200_000).map(|_| {
            let z = 2f64.powf(rng.range(-40.0, -2.0)) as f32;
            let v = Vec3::new(1.0, 1.0 + 2f64.powf(rng.range(-24.0, -2.0)) as f32, z);
            angle_deg(widen(v), widen(C::decode(C::encode(v))))
        }));
        println!("{} corners: {worst:?}, bound {}", C::NAME, C::MAX_ERROR_DEG);
        assert!(worst.max <= f64::from(C::MAX_ERROR_DEG), "{}: {worst:?}", C::NAME);
    }
    check::<unitvec::StereoEllipse32>();
    check::<unitvec::EqareaEllipse32>();
    check::<unitvec::EqdistEllipse32>();
}
