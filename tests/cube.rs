//! The cube codecs: faces, lattice points, bounds, layout.

use glam::Vec3;
use unitvec::{Codec, Cube16};
use unitvec_oracle::cube;
use unitvec_tests::checks::{assert_attains, assert_commutes, assert_rounds, assert_total};
use unitvec_tests::directions::{Rng, around, near_octant_middles, near_planes, sphere};
use unitvec_tests::expected::symmetries;
use unitvec_tests::tested::Tested;

/// Directions close to the cube's edges, where two magnitudes are equal, and to its corners.
fn near_edges(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    sphere(seed + 1, count).map(move |v| {
        let scale = 1.0 + rng.range(-1.0, 1.0) as f32 * 2f32.powi(-((rng.bits() % 26) as i32));
        [Vec3::new(v.y * scale, v.y, v.z), Vec3::new(v.x, v.z, v.z * scale), Vec3::splat(v.x) * scale]
            [(rng.bits() % 3) as usize]
    })
}

/// The face is that of the largest component and the coordinates are the nearest, to 2^-7 of a step.
#[test]
fn encodes_as_the_oracle() {
    for codec in Tested::family("cube") {
        let steps_off = |v, code| {
            let position = cube::position(v, code, codec.bits, is_warped(&codec));
            let integers = cube::integers(code, codec.bits);
            [0, 1].map(|i| (position[i] - integers[i] as f64).abs())
        };
        let directions = sphere(3, 500_000).chain(near_planes(4, 50_000)).chain(near_edges(5, 50_000));
        assert_rounds(&codec, directions, steps_off, 1.0 / 128.0);
    }
}

/// The largest error, of those over the sphere, in the middles of faces and in corners, comes to 95 % of the bound (Meyer's
/// eq. 8 for the plain cube) at least and does not exceed it by more than higher orders and `f32` add.
#[test]
fn attains_its_bound() {
    for codec in Tested::family("cube") {
        let bits = codec.bits;
        let near = (8.0 * cube::half_steps(bits)[1]).min(0.3);
        let directions = sphere(6, 300_000)
            .chain(around(7, 200_000, [0.0, 1.0, 0.0], near))
            .chain(near_octant_middles(8, 200_000, near));
        let bound = if is_warped(&codec) { cube::warped_bound_deg(bits) } else { cube::bound_deg(bits) };
        let higher_orders = if is_warped(&codec) { 0.02 * bound } else { 0.0 };
        assert_attains(&codec, directions, bound, 0.95, 2e-5 + higher_orders);
    }
}

/// Directions near edges keep the contract and the symmetries.
#[test]
fn edges() {
    for codec in Tested::family("cube") {
        near_edges(13, 100_000).for_each(|v| assert_total(&codec, v));
        assert_commutes(&codec, near_edges(11, 50_000), symmetries(&codec));
    }
}

fn is_warped(codec: &Tested) -> bool {
    codec.id.starts_with("warped")
}

/// Twice the axis and the sign in the high bits, u in the low ones.
#[test]
fn layout() {
    let codes = [0u32, 1, 2, 3, 4, 5].map(|face| face << 13);
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    assert_eq!(axes.map(Cube16::encode_vec3), codes);
    assert_eq!(Cube16::encode(Vec3::new(1.0, 0.999, -0.999)), 0x10bf);
    assert_eq!(Cube16::decode_vec3(7 << 13), Vec3::NEG_Z);
}
