//! The cube codecs against [`unitvec_tests::oracle::cube`] and Meyer's eq. 8.

use glam::Vec3;
use unitvec::Listed;
use unitvec::{Codec, Cube16, Cube24, Cube32, WarpedCube16, WarpedCube24, WarpedCube32};
use unitvec_tests::oracle::{codes, cube, widen};
use unitvec_tests::sampling::{AXES, Rng, near_octant_middles, near_planes, sphere};

/// Directions close to the cube's edges, where two magnitudes are equal, and to its corners.
fn near_edges(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    sphere(seed + 1, count).map(move |v| {
        let scale = 1.0 + rng.range(-1.0, 1.0) as f32 * 2f32.powi(-((rng.bits() % 26) as i32));
        [Vec3::new(v.y * scale, v.y, v.z), Vec3::new(v.x, v.z, v.z * scale), Vec3::splat(v.x) * scale]
            [(rng.bits() % 3) as usize]
    })
}

/// Modules of tests, one for each codec: its type, whether it is warped, and the bound of its error.
macro_rules! codecs {
    ($($module:ident: $codec:ty, $warped:literal, $bound:path;)*) => {$(
        mod $module {
            use super::*;

            /// Codes of all faces, 6 and 7 too, decode to the oracle's direction.
            #[test]
            fn decodes_as_the_oracle() {
                let oracle = |code| cube::decode(code, <$codec>::BITS, $warped);
                codes::assert_decodes::<$codec>(codes::patterns::<$codec>(1), oracle, 2.0 / (1 << 23) as f64);
                codes::assert_unit::<$codec>(codes::patterns::<$codec>(1));
            }

            /// Codes, decoded, encoded and decoded, give the first vector, exactly.
            #[test]
            fn round_trip_is_stable() {
                codes::assert_stable::<$codec>(codes::patterns::<$codec>(2));
            }

            /// The face is that of the largest component and the coordinates are the nearest, to 2^-7 of a step.
            #[test]
            fn encodes_as_the_oracle() {
                for v in sphere(3, 500_000).chain(near_planes(4, 50_000)).chain(near_edges(5, 50_000)) {
                    let code = u64::from(<$codec>::encode(v));
                    let position = cube::position(widen(v), code, <$codec>::BITS, $warped);
                    let integers = cube::integers(code, <$codec>::BITS);
                    let near = (0..2).all(|i| (position[i] - integers[i] as f64).abs() <= 0.5 + 1.0 / 128.0);
                    assert!(near, "{v:?}: {position:?} and {integers:?}");
                }
            }

            /// The largest error, of those over the sphere, in the middles of faces and in corners, comes to 95 % of
            /// the bound at least and does not exceed it by more than what `f32` rounds.
            #[test]
            fn attains_its_bound() {
                let bits = <$codec>::BITS;
                let near = (8.0 * cube::half_steps(bits)[1]).min(0.3);
                let directions = sphere(6, 300_000)
                    .chain(codes::around(7, 200_000, [0.0, 1.0, 0.0], near))
                    .chain(near_octant_middles(8, 200_000, near));
                let bound = $bound(bits);
                codes::assert_attains::<$codec>(directions, bound, 2e-5 + bound * if $warped { 0.02 } else { 0.0 });
                let mean = unitvec_tests::oracle::Summary::of(sphere(9, 500_000).map(codes::error_deg::<$codec>)).mean;
                println!("{} mean: {mean:.6}", <$codec>::NAME);
            }

            /// Mirrored at a coordinate plane, a direction decodes to the decoded vector's image, exactly.
            #[test]
            fn symmetric() {
                for f in [|v| v * Vec3::new(-1.0, 1.0, 1.0), |v| v * Vec3::new(1.0, -1.0, 1.0), |v| v * Vec3::new(1.0, 1.0, -1.0)] {
                    codes::assert_commutes::<$codec>(sphere(10, 100_000).chain(near_edges(11, 50_000)), f);
                }
            }

            /// Special inputs, random bits and directions near edges keep the contract; the axes come back exactly.
            #[test]
            fn takes_anything() {
                let mut rng = Rng::new(12);
                let any = (0..200_000).map(move |_| [(); 3].map(|()| f32::from_bits(rng.bits() as u32)));
                let edges = near_edges(13, 100_000).map(|v| v.to_array());
                codes::assert_total::<$codec>(any.chain(edges), Some(codes::sphere));
                for axis in AXES {
                    assert_eq!(codes::round_trip::<$codec>(axis), axis);
                }
            }
        }
    )*};
}

codecs! {
    cube16: Cube16, false, cube::bound_deg;
    cube24: Cube24, false, cube::bound_deg;
    cube32: Cube32, false, cube::bound_deg;
    warpedcube16: WarpedCube16, true, cube::warped_bound_deg;
    warpedcube24: WarpedCube24, true, cube::warped_bound_deg;
    warpedcube32: WarpedCube32, true, cube::warped_bound_deg;
}

/// Twice the axis and the sign in the high bits, u in the low ones.
#[test]
fn layout() {
    let codes = [0u32, 1, 2, 3, 4, 5].map(|face| face << 13);
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    assert_eq!(axes.map(Cube16::encode), codes);
    assert_eq!(Cube16::encode(Vec3::new(1.0, 0.999, -0.999)), 0x10bf);
    assert_eq!(Cube16::decode(7 << 13), Vec3::NEG_Z);
}
