//! The spherical codecs against the survey: [`unitvec_tests::oracle::spherical`] and the survey's table 1.

use glam::Vec3;
use unitvec::{Codec, Spherical16, Spherical20, Spherical22, Spherical24, Spherical32};
use unitvec_tests::oracle::{self, Oracle, Spherical, Summary, spherical, widen};
use unitvec_tests::sampling::{self, Rng, near_planes, sphere};

/// Modules of tests, one for each codec: its type, and the survey's mean and maximal error.
macro_rules! codecs {
    ($($module:ident: $codec:ty, $mean:literal, $max:literal;)*) => {$(
        mod $module {
            use super::*;

            /// Every code (2^21 at 24 bits, 2^20 at 32) decodes to the oracle's direction, to unit length to 2 ULP,
            /// with high bits ignored.
            #[test]
            fn decodes_as_the_oracle() {
                spherical::assert_decodes::<$codec, Spherical>(codes(<$codec>::BITS, 1));
            }

            /// The same codes, decoded, encoded and decoded, give the first vector, exactly.
            #[test]
            fn round_trip_is_stable() {
                oracle::assert_stable::<$codec>(codes(<$codec>::BITS, 2));
            }

            /// 5 * 10^5 directions and those near the coordinate planes get the nearest integers of both angles,
            /// except within f32 rounding of a tie.
            #[test]
            fn encodes_as_the_oracle() {
                let rounding = 2.0 * spherical::steps(<$codec>::BITS) * spherical::ANGLE_ROUNDING;
                let directions = sphere(3, 500_000).chain(near_planes(4, 100_000));
                spherical::assert_rounds::<$codec>(directions, spherical::steps_off, rounding);
            }

            /// Mean and maximum over 10^6 directions are at most those of the survey's table 1; no error exceeds
            /// the bound. The survey's maximum at 32 bits is that of f32 trigonometry, and ours a third of it.
            #[test]
            fn errors_are_the_published_ones() {
                let published = Summary { mean: $mean, max: $max };
                oracle::assert_errors::<$codec>(sphere(5, 1_000_000), published, spherical::bound_deg(<$codec>::BITS));
            }

            /// Corners of cells at the equator come to 99 % of the bound at least, and do not exceed it.
            #[test]
            fn bound_is_attained_at_the_equator() {
                let (m, bits) = (oracle::largest(<$codec>::BITS), <$codec>::BITS);
                let mut rng = Rng::new(6);
                let corners = (0..50_000).map(move |_| {
                    let column = (rng.unit() * 2.0 * spherical::steps(bits)).floor() + 0.5;
                    let off = rng.range(-0.02, 0.02);
                    let v = spherical::at(0.5 + (0.5 + off) / (2.0 * m), column / spherical::steps(bits));
                    Vec3::from_array(v.map(|t| t as f32))
                });
                spherical::assert_attains::<$codec>(corners, spherical::bound_deg(bits));
            }

            /// Mirrored at y = 0 or z = 0, a direction decodes to the decoded vector's image, exactly; mirrored at
            /// x = 0 or with x and y swapped, within rounding, except within f32 rounding of a tie.
            #[test]
            fn symmetric() {
                let directions = || sphere(7, 100_000).chain(near_planes(8, 50_000));
                let exact: [fn(Vec3) -> Vec3; 2] =
                    [|v| Vec3::new(v.x, -v.y, v.z), |v| Vec3::new(v.x, v.y, -v.z)];
                for image in exact {
                    oracle::assert_commutes::<$codec>(directions(), image);
                }
                let rounded: [fn(Vec3) -> Vec3; 2] = [|v| Vec3::new(-v.x, v.y, v.z), |v| Vec3::new(v.y, v.x, v.z)];
                for image in rounded {
                    spherical::assert_commutes_but_for_ties::<$codec>(directions(), image, |v| {
                        is_tie(v, <$codec>::BITS)
                    });
                }
            }

            /// The six axes come back exactly.
            #[test]
            fn keeps_the_axes() {
                oracle::assert_keeps::<$codec>(&sampling::AXES);
            }

            /// Every phi at theta = 0 and at pi is the pole, exactly, whose code encoding writes with phi = 0; the
            /// pattern that encoding never writes is +Z too.
            #[test]
            fn poles_have_one_code() {
                let (half, m) = (<$codec>::BITS / 2, oracle::largest(<$codec>::BITS) as u32);
                for phi in 0..1 << half {
                    let theta = [(1 << half) - m, (1 << half) - m - 1, m];
                    let poles = theta.map(|i| <$codec>::decode(i | (phi << half)));
                    assert_eq!(poles, [Vec3::Z, Vec3::Z, Vec3::NEG_Z], "{phi:#x}");
                }
                assert_eq!(<$codec>::encode(Vec3::Z), (1 << half) - m);
                assert_eq!(<$codec>::encode(Vec3::NEG_Z), m);
                assert_eq!(<$codec>::encode(Vec3::new(1e-7, -1e-7, -1.0)), m);
            }
        }
    )*};
}

codecs! {
    spherical16: Spherical16, 0.35527, 0.78685;
    spherical20: Spherical20, 0.08847, 0.19632;
    spherical22: Spherical22, 0.04423, 0.09809;
    spherical24: Spherical24, 0.02209, 0.04906;
    spherical32: Spherical32, 0.00138, 0.00957;
}

/// All codes of up to 22 bits; of 24, every eighth.
fn codes(bits: u32, seed: u64) -> Box<dyn Iterator<Item = u32>> {
    let step = if bits == 24 { 8 } else { 1 };
    Box::new(sampling::codes(bits, seed, 1 << 20).step_by(step))
}

/// True where one of the angles of `v` is within `f32` rounding of half a step.
fn is_tie(v: Vec3, bits: u32) -> bool {
    let ([t, phi], m, steps) = (Spherical::position(widen(v)), oracle::largest(bits), spherical::steps(bits));
    [t * m, phi * steps]
        .iter()
        .any(|p| ((p.abs().fract()) - 0.5).abs() <= 4.0 * steps * spherical::ANGLE_ROUNDING)
}

/// Integers in two's complement, theta's first: +X is in the middle of theta's range, a quarter turn 2^(b-2) steps
/// of phi.
#[test]
fn layout() {
    assert_eq!(Spherical16::encode(Vec3::X), 0x0000);
    assert_eq!(Spherical16::encode(Vec3::Y), 0x4000);
    assert_eq!(Spherical16::encode(Vec3::NEG_X), 0x8000);
    assert_eq!(Spherical16::encode(Vec3::new(-1.0, -1e-9, 0.0)), 0x8000);
    assert_eq!(Spherical16::encode(Vec3::Z), 0x0081);
    assert_eq!(Spherical20::encode(Vec3::NEG_Z), 0x001ff);
    assert_eq!(Spherical32::encode(Vec3::NEG_Y), 0xc000_0000);
}
