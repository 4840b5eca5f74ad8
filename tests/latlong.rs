//! The latlong codecs against the survey: [`unitvec_tests::oracle::latlong`] and the survey's table 1.

use glam::Vec3;
use unitvec::{Codec, LatLong16, LatLong24, LatLong32, LatLongD16, LatLongD24, LatLongD32};
use unitvec_tests::oracle::{self, LatLong, LatLongD, Summary, latlong, spherical};
use unitvec_tests::sampling::{self, Rng, near_planes, sphere};

/// Tests of every codec: its oracle, how far off its patches are, the steps of its angles in half a turn, its
/// bound, and the survey's mean and maximal error.
macro_rules! common_tests {
    ($codec:ty, $oracle:ty, $steps_off:path, $bound:expr, $mean:literal, $max:literal) => {
        use super::*;

        /// Every code (2^21 at 24 bits, 2^20 at 32) decodes to the oracle's direction, to unit length to 2 ULP,
        /// with high bits ignored.
        #[test]
        fn decodes_as_the_oracle() {
            spherical::assert_decodes::<$codec, $oracle>(codes(<$codec>::BITS, 1));
        }

        /// The same codes, decoded, encoded and decoded, give the first vector, exactly.
        #[test]
        fn round_trip_is_stable() {
            oracle::assert_stable::<$codec>(codes(<$codec>::BITS, 2));
        }

        /// 5 * 10^5 directions and those near the coordinate planes get the patch they are in, except within f32
        /// rounding of its border.
        #[test]
        fn encodes_as_the_oracle() {
            let rounding = 4.0 * spherical::steps(<$codec>::BITS) * spherical::ANGLE_ROUNDING;
            let directions = sphere(3, 500_000).chain(near_planes(4, 100_000));
            spherical::assert_rounds::<$codec>(directions, $steps_off, rounding);
        }

        /// Mean and maximum over 10^6 directions are those of the survey's table 1; no error exceeds the bound. At
        /// 32 bits the survey's maxima are those of f32 trigonometry.
        #[test]
        fn errors_are_the_published_ones() {
            let published = Summary { mean: $mean, max: $max };
            oracle::assert_errors::<$codec>(sphere(5, 1_000_000), published, $bound);
        }
    };
}

/// Modules of tests, one for each fast codec: its type, and the survey's mean and maximal error.
macro_rules! grids {
    ($($module:ident: $codec:ty, $mean:literal, $max:literal;)*) => {$(
        mod $module {
            common_tests!(
                $codec, LatLong, latlong::grid_steps_off, latlong::grid_bound_deg(<$codec>::BITS), $mean, $max
            );

            /// Corners of the equator's patches come to 99 % of the bound at least, and do not exceed it.
            #[test]
            fn bound_is_attained_at_the_equator() {
                let count = 2.0 * spherical::steps(<$codec>::BITS);
                let mut rng = Rng::new(6);
                let corners = (0..50_000).map(move |_| {
                    let patch = (rng.unit() * count).floor() * 2.0 / count;
                    narrow(spherical::at(0.5 + rng.range(-0.02, 0.02) / count, patch))
                });
                spherical::assert_attains::<$codec>(corners, latlong::grid_bound_deg(<$codec>::BITS));
            }

            /// The axes are corners of patches, and come back as the middle of one of them.
            #[test]
            fn axes_are_corners() {
                let (bound, ring) = (latlong::grid_bound_deg(<$codec>::BITS), 45.0 / spherical::steps(<$codec>::BITS));
                for (i, axis) in sampling::AXES.into_iter().enumerate() {
                    let expected = if i % 3 == 2 { ring } else { bound };
                    let error = oracle::round_trip_error_deg::<$codec>(axis);
                    assert!((error / expected - 1.0).abs() < 0.02, "{axis}: {error}, not {expected}");
                }
            }
        }
    )*};
}

/// Modules of tests, one for each better codec: its type, and the survey's mean and maximal error.
macro_rules! rings {
    ($($module:ident: $codec:ty, $mean:literal, $max:literal;)*) => {$(
        mod $module {
            common_tests!(
                $codec, LatLongD, latlong::steps_off, latlong::rings(<$codec>::BITS).farthest_corner_deg(), $mean, $max
            );

            /// Every ring of every hemisphere and quarter: its first and last index are decoded to the oracle's
            /// direction, and come back. With the rings between these, the inverse of the start of rings is right
            /// for every code.
            #[test]
            fn finds_every_ring() {
                let (rings, bits) = (latlong::rings(<$codec>::BITS), <$codec>::BITS);
                let ends = rings.starts.windows(2).flat_map(|s| [s[0], s[1] - 1]);
                let codes: Vec<u32> =
                    ends.flat_map(|index| (0..8).map(move |part| index | (part << (bits - 3)))).collect();
                spherical::assert_decodes::<$codec, LatLongD>(codes.iter().copied());
                oracle::assert_stable::<$codec>(codes.into_iter());
            }

            /// Every code is a patch: rings start at 0, grow, and end with the last index.
            #[test]
            fn no_code_is_unused() {
                let starts = &latlong::rings(<$codec>::BITS).starts;
                assert_eq!((starts[0], starts[1]), (0, 1));
                assert_eq!(starts[starts.len() - 1], 1 << (<$codec>::BITS - 3));
                assert!(starts.windows(2).all(|s| s[0] < s[1]));
            }

            /// Corners of the patches of the worst ring come to 99 % of the bound at least; those of all rings do
            /// not exceed it.
            #[test]
            fn bound_is_attained_at_corners() {
                let rings = latlong::rings(<$codec>::BITS);
                let mut rng = Rng::new(6);
                let step = (2 * rings.last / 100_000).max(1);
                let corners = (0..rings.last).step_by(step).flat_map(move |i| {
                    let count = f64::from(rings.count(i));
                    let edge = (i as f64 + 0.5 + rng.range(-0.01, 0.01)) / rings.last as f64 / 2.0;
                    let off = rng.range(-0.01, 0.01);
                    [0.0, (rng.unit() * 4.0 * count).floor()]
                        .map(|j| narrow(spherical::at(edge, (j + 0.5 + off) / count / 2.0)))
                });
                spherical::assert_attains::<$codec>(corners, rings.farthest_corner_deg());
            }

            /// Mirrored at x = 0, y = 0 or z = 0, a direction decodes to the decoded vector's image, exactly;
            /// turned by a quarter about z, within rounding, except within f32 rounding of a border.
            #[test]
            fn symmetric() {
                let directions = || sphere(7, 100_000).chain(near_planes(8, 50_000));
                let mirrors: [fn(Vec3) -> Vec3; 3] = [
                    |v| Vec3::new(-v.x, v.y, v.z),
                    |v| Vec3::new(v.x, -v.y, v.z),
                    |v| Vec3::new(v.x, v.y, -v.z),
                ];
                for image in mirrors {
                    oracle::assert_commutes::<$codec>(directions(), image);
                }
                let turn = |v: Vec3| Vec3::new(-v.y, v.x, v.z);
                let rounding = 8.0 * spherical::steps(<$codec>::BITS) * spherical::ANGLE_ROUNDING;
                spherical::assert_commutes_but_for_ties::<$codec>(directions(), turn, |v| {
                    let off = latlong::steps_off(oracle::widen(v), <$codec>::encode(v), <$codec>::BITS);
                    off[0].max(off[1]) >= 0.5 - rounding
                });
            }

            /// The six axes come back exactly.
            #[test]
            fn keeps_the_axes() {
                oracle::assert_keeps::<$codec>(&sampling::AXES);
            }
        }
    )*};
}

grids! {
    latlong16: LatLong16, 0.35560, 0.78846;
    latlong24: LatLong24, 0.02211, 0.04907;
    latlong32: LatLong32, 0.00138, 0.00324;
}

rings! {
    latlong16d: LatLongD16, 0.30351, 0.56178;
    latlong24d: LatLongD24, 0.01895, 0.03504;
    latlong32d: LatLongD32, 0.00119, 0.00381;
}

/// All codes of 16 bits; of 24, every eighth.
fn codes(bits: u32, seed: u64) -> Box<dyn Iterator<Item = u32>> {
    let step = if bits == 24 { 8 } else { 1 };
    Box::new(sampling::codes(bits, seed, 1 << 20).step_by(step))
}

fn narrow(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|t| t as f32))
}

/// The fast format counts patches from +X and rings from +Z; the better one has quarter and hemisphere above the
/// index, whose last ring is the equator.
#[test]
fn layout() {
    assert_eq!(LatLong16::encode(Vec3::Z), 0x0000);
    assert_eq!(LatLong16::encode(Vec3::NEG_Z), 0xff00);
    assert_eq!(LatLong16::encode(Vec3::new(0.0, 1.0, 0.001)), 0x7f40);
    assert_eq!(LatLong32::encode(Vec3::new(1.0, -1e-6, -1e-6)), 0x8000_ffff);

    let equator = latlong::rings(16).starts[113];
    assert_eq!(LatLongD16::encode(Vec3::Z), 0x0000);
    assert_eq!(LatLongD16::encode(Vec3::NEG_Z), 0x8000);
    assert_eq!(LatLongD16::encode(Vec3::new(-1e-5, -1e-5, 1.0)), 0x0000);
    for (quarter, axis) in [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y].into_iter().enumerate() {
        assert_eq!(LatLongD16::encode(axis), equator | ((quarter as u32) << 13), "{axis}");
    }
}
