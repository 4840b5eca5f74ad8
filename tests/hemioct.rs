//! The hemi-octahedral codecs against the papers: [`unitvec_tests::oracle::hemioct`] and the survey's table 3.

use glam::Vec3;
use unitvec::Listed;
use unitvec::{Codec, HemiOct16, HemiOct24, HemiOct32};
use unitvec_tests::oracle::{self, HemiOct, Summary, hemioct};
use unitvec_tests::sampling::{self, hemisphere, near_octant_middles, near_planes, sphere};

/// Modules of tests, one for each codec: its type, and the survey's mean and maximal error.
macro_rules! codecs {
    ($($module:ident: $codec:ty, $mean:literal, $max:literal;)*) => {$(
        mod $module {
            use super::*;

            /// Every code (2^20 at 32 bits) decodes to the oracle's direction to 1 ULP, to unit length to 2 ULP,
            /// with high bits ignored.
            #[test]
            fn decodes_as_the_oracle() {
                oracle::assert_decodes::<$codec, HemiOct>(sampling::codes(<$codec>::BITS, 1, 1 << 20));
            }

            /// Every code (2^22 at 32 bits), decoded, encoded and decoded, gives the first vector, exactly.
            #[test]
            fn round_trip_is_stable() {
                oracle::assert_stable::<$codec>(sampling::codes(<$codec>::BITS, 2, 1 << 22));
            }

            /// 10^6 directions, those near the coordinate planes and those below the equator get the lattice point
            /// nearest to the oracle's position, except within 2^-21 of the square's half side of a tie.
            #[test]
            fn encodes_as_the_oracle() {
                let directions = hemisphere(3, 1_000_000).chain(near_planes(4, 100_000)).chain(sphere(5, 100_000));
                oracle::assert_rounds::<$codec, HemiOct>(directions);
            }

            /// Mean and maximum over 10^6 directions are those of the survey's table 3; no error exceeds the bound.
            #[test]
            fn errors_are_the_published_ones() {
                let published = Summary { mean: $mean, max: $max };
                let bound = hemioct::bound_deg(<$codec>::BITS);
                oracle::assert_errors::<$codec>(hemisphere(6, 1_000_000), published, bound);
            }

            /// Around the middles of the octants the error comes to 95 % of the bound at least, not more than 100 %.
            #[test]
            fn bound_is_attained_in_the_middle_of_octants() {
                let (m, bound) = (oracle::largest(<$codec>::BITS), hemioct::bound_deg(<$codec>::BITS));
                let directions = near_octant_middles(7, 300_000, (4.0 / m).max(0.01)).filter(|v| v.z > 0.0);
                let worst = Summary::of(directions.map(oracle::round_trip_error_deg::<$codec>)).max;
                println!("{} worst: {worst:.6}, {:.3} % of {bound:.6}", <$codec>::NAME, worst / bound * 100.0);
                assert!(worst >= 0.95 * bound, "{worst}");
                oracle::assert_bounded::<$codec>(worst, bound);
            }

            /// Mirrored at x = 0 or y = 0 or with x and y swapped, a direction decodes to the decoded vector's image,
            /// exactly.
            #[test]
            fn symmetric() {
                let images: [fn(Vec3) -> Vec3; 3] = [
                    |v| Vec3::new(-v.x, v.y, v.z),
                    |v| Vec3::new(v.x, -v.y, v.z),
                    |v| Vec3::new(v.y, v.x, v.z),
                ];
                for image in images {
                    oracle::assert_commutes::<$codec>(sphere(8, 200_000).chain(near_planes(9, 50_000)), image);
                }
            }

            /// The five axes of the hemisphere come back exactly, and -Z as +Z.
            #[test]
            fn keeps_the_axes() {
                oracle::assert_keeps::<$codec>(&sampling::AXES[..5]);
                assert_eq!(<$codec>::encode(Vec3::NEG_Z), <$codec>::encode(Vec3::Z));
            }
        }
    )*};
}

codecs! {
    hemioct16: HemiOct16, 0.24000, 0.55112;
    hemioct24: HemiOct24, 0.01489, 0.03406;
    hemioct32: HemiOct32, 0.00093, 0.00213;
}

/// The corners of the square are the horizontal axes; the pattern that encoding never writes counts as -1.
#[test]
fn layout() {
    assert_eq!(HemiOct16::encode(Vec3::X), 0x7f7f);
    assert_eq!(HemiOct16::encode(Vec3::Y), 0x817f);
    assert_eq!(HemiOct24::encode(Vec3::NEG_X), 0x801801);
    assert_eq!(HemiOct32::encode(Vec3::NEG_Y), 0x7fff_8001);
    assert_eq!(HemiOct16::decode(0x8080), Vec3::NEG_X);
    assert_eq!(HemiOct24::decode(0x800_800), Vec3::NEG_X);
    assert_eq!(HemiOct32::decode(0x8000_8000), Vec3::NEG_X);
}
