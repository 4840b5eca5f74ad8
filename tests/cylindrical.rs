//! The cylindrical codecs against the formula: [`unitvec_tests::oracle::cylindrical`]. Nothing is published about
//! them.

use glam::Vec3;
use unitvec::{Codec, Cylindrical16, Cylindrical24, Cylindrical32};
use unitvec_tests::oracle::{self, Cylindrical, Oracle, Summary, cylindrical, spherical};
use unitvec_tests::sampling::{self, Rng, near_planes, sphere};

/// Modules of tests, one for each codec: its type, and the mean error measured once.
macro_rules! codecs {
    ($($module:ident: $codec:ty, $mean:literal;)*) => {$(
        mod $module {
            use super::*;

            /// Every code (2^21 at 24 bits, 2^20 at 32) decodes to the oracle's direction, to unit length to 2 ULP,
            /// with high bits ignored.
            #[test]
            fn decodes_as_the_oracle() {
                spherical::assert_decodes::<$codec, Cylindrical>(codes(<$codec>::BITS, 1));
            }

            /// The same codes, decoded, encoded and decoded, give the first vector, exactly.
            #[test]
            fn round_trip_is_stable() {
                oracle::assert_stable::<$codec>(codes(<$codec>::BITS, 2));
            }

            /// 5 * 10^5 directions and those near the coordinate planes get the nearest integers of phi and z,
            /// except within f32 rounding of a tie.
            #[test]
            fn encodes_as_the_oracle() {
                let rounding = 2.0 * oracle::largest(<$codec>::BITS) * spherical::ANGLE_ROUNDING;
                let directions = sphere(3, 500_000).chain(near_planes(4, 100_000));
                spherical::assert_rounds::<$codec>(directions, cylindrical::steps_off, rounding);
            }

            /// The mean over 10^6 directions is what the docs say; no error exceeds the bound.
            #[test]
            fn errors_are_those_of_the_docs() {
                let bound = cylindrical::bound_deg(<$codec>::BITS);
                oracle::assert_errors::<$codec>(sphere(5, 1_000_000), Summary { mean: $mean, max: bound }, bound);
            }

            /// Half a step of z off the poles the error comes to 99 % of the bound at least, and does not exceed
            /// it.
            #[test]
            fn bound_is_attained_at_the_poles() {
                let half_step = 0.5 / oracle::largest(<$codec>::BITS);
                let mut rng = Rng::new(6);
                let off_poles = (0..50_000).map(move |i| {
                    let z = 1.0 - half_step * rng.range(0.985, 1.015);
                    let v = Cylindrical::direction([rng.range(-1.0, 1.0), if i % 2 == 0 { z } else { -z }]);
                    Vec3::from_array(v.map(|t| t as f32))
                });
                spherical::assert_attains::<$codec>(off_poles, cylindrical::bound_deg(<$codec>::BITS));
            }

            /// Mirrored at y = 0 or z = 0, a direction decodes to the decoded vector's image, exactly.
            #[test]
            fn symmetric() {
                let images: [fn(Vec3) -> Vec3; 2] =
                    [|v| Vec3::new(v.x, -v.y, v.z), |v| Vec3::new(v.x, v.y, -v.z)];
                for image in images {
                    oracle::assert_commutes::<$codec>(sphere(7, 100_000).chain(near_planes(8, 50_000)), image);
                }
            }

            /// +-X and +-Z come back exactly; +-Y, half a step off, do not, and are turned by that about z.
            #[test]
            fn keeps_four_axes() {
                oracle::assert_keeps::<$codec>(&[Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z]);
                for y in [Vec3::Y, Vec3::NEG_Y] {
                    let error = oracle::round_trip_error_deg::<$codec>(y);
                    assert!((error * oracle::largest(<$codec>::BITS) / 90.0 - 1.0).abs() < 0.01, "{error}");
                }
            }

            /// Every phi at z = 1 and -1 is the pole, exactly, whose code encoding writes with phi = 0.
            #[test]
            fn poles_have_one_code() {
                let (half, m) = (<$codec>::BITS / 2, oracle::largest(<$codec>::BITS) as u32);
                for phi in 0..1 << half {
                    let poles = [m, (1 << half) - m, m + 1].map(|z| <$codec>::decode(phi | (z << half)));
                    assert_eq!(poles, [Vec3::Z, Vec3::NEG_Z, Vec3::NEG_Z], "{phi:#x}");
                }
                assert_eq!(<$codec>::encode(Vec3::Z), m << half);
                assert_eq!(<$codec>::encode(Vec3::new(1e-4, -1e-4, 1.0)), m << half);
            }
        }
    )*};
}

codecs! {
    cylindrical16: Cylindrical16, 0.374;
    cylindrical24: Cylindrical24, 0.0230;
    cylindrical32: Cylindrical32, 0.00144;
}

/// All codes of 16 bits; of 24, every eighth.
fn codes(bits: u32, seed: u64) -> Box<dyn Iterator<Item = u32>> {
    let step = if bits == 24 { 8 } else { 1 };
    Box::new(sampling::codes(bits, seed, 1 << 20).step_by(step))
}

/// An snorm pair, phi's first; -X is the largest integer, and both patterns of -pi decode to it.
#[test]
fn layout() {
    assert_eq!(Cylindrical16::encode(Vec3::X), 0x0000);
    assert_eq!(Cylindrical16::encode(Vec3::NEG_X), 0x007f);
    assert_eq!(Cylindrical16::encode(Vec3::NEG_Z), 0x8100);
    assert_eq!(Cylindrical24::encode(Vec3::Y), 0x000_400);
    assert_eq!(Cylindrical32::encode(Vec3::new(0.0, -3.0, 4.0)), 0x6666_c000);
    for code in [0x007f, 0x0080, 0x0081] {
        assert_eq!(Cylindrical16::decode(code), Vec3::NEG_X);
    }
}
