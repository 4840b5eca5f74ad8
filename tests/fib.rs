//! The spherical Fibonacci codecs against Keinert et al. 2015: [`unitvec_tests::oracle::fib`].

use glam::Vec3;
use unitvec::Listed;
use unitvec::{Codec, Fib16, Fib24, Fib32};
use unitvec_tests::oracle::{self, Fib, Oracle, Summary, angle_deg, fib, spherical, widen};
use unitvec_tests::sampling::{self, Rng, near_planes, sphere};

/// What the encoder's arithmetic makes of a direction, in radians.
const ENCODE_ROUNDING: f64 = 2e-7;

/// What the decoder's makes of a point, and the rounding of its components.
const DECODE_ROUNDING: f64 = 1.5e-7;

/// Modules of tests, one for each codec.
macro_rules! tests {
    ($($module:ident: $codec:ty;)*) => {$(
        mod $module {
            use super::*;

            const BITS: u32 = <$codec>::BITS;

            /// All codes of 16 bits, a part of those of 24 and 32, and those around both poles decode to the
            /// oracle's points, to unit length to 2 ULP, with high bits ignored.
            #[test]
            fn decodes_as_the_oracle() {
                let step = if BITS == 24 { 8 } else { 1 };
                let codes = || sampling::codes(BITS, 1, 1 << 20).step_by(step).chain(polar_codes(BITS));
                spherical::assert_decodes::<$codec, Fib>(codes());
                for code in codes() {
                    let off = angle_deg(widen(<$codec>::decode(code)), Fib::decode(code, BITS));
                    assert!(off.to_radians() <= DECODE_ROUNDING, "{code:#x}: {off:e}");
                }
            }

            /// All codes of 16 and 24 bits, 2^22 of those of 32, and those around both poles come back.
            #[test]
            fn every_code_comes_back() {
                for code in sampling::codes(BITS, 2, 1 << 22).chain(polar_codes(BITS)) {
                    assert_eq!(<$codec>::encode(<$codec>::decode(code)), code);
                }
            }

            /// Directions of all kinds get the nearest point, or one as near but for the rounding.
            #[test]
            fn encodes_to_the_nearest() {
                let (mut excess, mut other, mut count) = (f64::NEG_INFINITY, 0, 0);
                for v in directions(3, 60_000, BITS) {
                    let (code, best) = (<$codec>::encode(v), fib::nearest(widen(v), BITS));
                    let [ours, least] = [code, best].map(|c| angle_deg(widen(v), Fib::decode(c, BITS)));
                    let over = (ours - least).to_radians();
                    assert!(over <= 2.0 * ENCODE_ROUNDING, "{v:?}: {code:#x} for {best:#x}: {over:e}");
                    (excess, other, count) = (excess.max(over), other + usize::from(code != best), count + 1);
                }
                println!("{}: {excess:e} radians over nearest; other {other} of {count}", <$codec>::NAME);
            }

            /// Over 10^6 directions the mean is 1.0 to 1.3 % above that of a hexagonal lattice, and no error
            /// exceeds the bound.
            #[test]
            fn errors_are_those_of_the_points() {
                let [mean, max] = fib::hexagonal_deg(BITS);
                let ours = Summary::of(sphere(5, 1_000_000).map(oracle::round_trip_error_deg::<$codec>));
                let [mean, max] = [ours.mean / mean, ours.max / max];
                println!("{} error: {ours:?}, {mean:.4} and {max:.4} of hexagonal", <$codec>::NAME);
                assert!((1.0085..1.0135).contains(&mean), "{mean}");
                assert!((1.12..1.25).contains(&max), "{max}");
                oracle::assert_bounded::<$codec>(ours.max, fib::bound_deg(BITS));
            }

            /// The greatest error lies between points 1, 2 and 4 of either pole: around there the bound is
            /// attained and not exceeded.
            #[test]
            fn bound_is_attained_beside_the_poles() {
                let (mut rng, hole) = (Rng::new(6), fib::hole(BITS));
                let spread = fib::bound_deg(BITS).to_radians();
                let directions = (0..100_000).map(move |n| {
                    let around = if n % 2 == 0 { hole } else { image(hole, BITS) };
                    let off = [(); 3].map(|()| rng.range(-0.03, 0.03) * spread);
                    narrow([around[0] + off[0], around[1] + off[1], around[2] + off[2] * spread])
                });
                spherical::assert_attains::<$codec>(directions, fib::bound_deg(BITS));
            }

            /// From point 10 to point 10,000 no error exceeds 0.57 degrees, scaled to the number of points.
            #[test]
            fn away_from_the_poles_errors_are_less() {
                let (mut rng, count) = (Rng::new(7), 2f64.powi(BITS as i32));
                let directions = (0..300_000).map(move |_| {
                    let depth = 2.0 * rng.range(10.0, 100.0).powf(rng.range(1.0, 2.0)) / count;
                    narrow(spherical::at((1.0 - depth).acos() / std::f64::consts::PI, rng.range(0.0, 2.0)))
                });
                let worst = Summary::of(directions.map(oracle::round_trip_error_deg::<$codec>)).max;
                let scaled = worst * (count / 65536.0).sqrt();
                println!("{} beyond point 10: {worst:.7}, scaled {scaled:.4}", <$codec>::NAME);
                assert!(scaled < 0.57 + 0.01, "{scaled}");
            }

            /// Point N - 1 - i is the image of point i, turned half around a horizontal axis, within rounding,
            /// and so are directions' codes, but for ties.
            #[test]
            fn symmetric() {
                let last = u32::MAX >> (32 - BITS);
                for v in directions(8, 50_000, BITS) {
                    let code = <$codec>::encode(v);
                    let expected = image(widen(<$codec>::decode(code)), BITS);
                    let off = angle_deg(widen(<$codec>::decode(last - code)), expected).to_radians();
                    assert!(off <= 2.0 * DECODE_ROUNDING, "{code:#x}: {off:e}");
                    let image = narrow(image(widen(v), BITS));
                    let codes = [<$codec>::encode(image), last - code];
                    let [ours, least] = codes.map(|c| angle_deg(widen(image), Fib::decode(c, BITS)));
                    let over = (ours - least).to_radians().abs();
                    assert!(over <= 4.0 * ENCODE_ROUNDING, "{v:?}: {over:e}");
                }
            }

            /// No axis is a point: Z and -Z get the first and the last, `sqrt(2 / N)` away, and all axes come
            /// back with an error below the bound, but not 0.
            #[test]
            fn axes_are_no_points() {
                assert_eq!(<$codec>::encode(Vec3::Z), 0);
                assert_eq!(<$codec>::encode(Vec3::NEG_Z), u32::MAX >> (32 - BITS));
                for axis in sampling::AXES {
                    let error = oracle::round_trip_error_deg::<$codec>(axis);
                    assert!(error > 1e-5 && error < fib::bound_deg(BITS), "{axis}: {error}");
                    let at_pole = (2.0 / 2f64.powi(BITS as i32)).sqrt().to_degrees();
                    assert!(axis.z == 0.0 || (error / at_pole - 1.0).abs() < 1e-3, "{axis}: {error}");
                }
            }
        }
    )*};
}

tests! {
    fib16: Fib16;
    fib24: Fib24;
    fib32: Fib32;
}

/// 1000 directions: the search over all points of 16 bits finds none nearer.
#[test]
fn no_other_point_is_nearer() {
    let points: Vec<[f64; 3]> = (0..1 << 16).map(|code| Fib::decode(code, 16)).collect();
    for v in directions(9, 500, 16) {
        let exact = oracle::normalize(widen(v));
        let cosine = points.iter().map(|&p| oracle::dot(p, exact)).fold(-1.0, f64::max);
        let ours = oracle::dot(points[Fib16::encode(v) as usize], exact);
        // At 0.3 degrees the cosine changes by 0.005 of the angle's change.
        assert!(cosine - ours <= 0.02 * ENCODE_ROUNDING, "{v:?}: {cosine} {ours}");
    }
}

/// Codes count from +Z to -Z, each 0.618 of a turn from +X towards +Y after the one before.
#[test]
fn layout() {
    let expected =
        [(0, 0.0, 32767.5), (1, 0.618_034, 32766.5), (2, 0.236_068, 32765.5), (3, 0.854_102, 32764.5)];
    for (code, turns, height) in expected {
        let v = Fib16::decode(code);
        assert_eq!(v.z, height / 32768.0);
        let turn = spherical::azimuth(widen(v)) / 2.0;
        assert!(spherical::around(turn, turns, 1.0) < 1e-6, "{code}: {turn}");
    }
    assert_eq!(Fib16::decode(0xffff).z, -32767.5 / 32768.0);
    assert_eq!(Fib24::decode(0x80_0000).z, -0.5f32.powi(24));
    assert_eq!(Fib32::decode(0x7fff_ffff).z, 0.5f32.powi(32));
}

/// Directions of all kinds: uniform ones, those near the planes and axes, and those around both poles.
fn directions(seed: u64, count: usize, bits: u32) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed + 2);
    let poles = (0..count / 2).map(move |_| {
        let depth = rng.range(0.0, 40.0).powi(2) / 2f64.powi(bits as i32) / 2.0;
        let v = spherical::at((1.0 - depth).acos() / std::f64::consts::PI, rng.range(0.0, 2.0));
        narrow([v[0], v[1], if rng.unit() < 0.5 { v[2] } else { -v[2] }])
    });
    sphere(seed, count).chain(near_planes(seed + 1, count / 2)).chain(poles)
}

/// The codes around both poles.
fn polar_codes(bits: u32) -> impl Iterator<Item = u32> {
    (0..20_000).flat_map(move |i| [i, (u32::MAX >> (32 - bits)) - i])
}

/// `v` mirrored at the equator, and at the meridian that makes point N - 1 of point 0.
fn image(v: [f64; 3], bits: u32) -> [f64; 3] {
    let (y, x) = (std::f64::consts::TAU * fib::turn((1 << bits) - 1)).sin_cos();
    [v[0] * x + v[1] * y, v[0] * y - v[1] * x, -v[2]]
}

fn narrow(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|t| t as f32))
}
