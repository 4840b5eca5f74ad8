//! The cube codecs: edges, bounds, layout.

use glam::Vec3;
use unitvec::{Codec, Cube16};
use unitvec_oracle::cube;
use unitvec_tests::checks::{assert_attains, assert_commutes, assert_total};
use unitvec_tests::directions::{around, near_diagonals, near_octant_middles, sphere};
use unitvec_tests::expected::symmetries;
use unitvec_tests::tested::Tested;

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
        near_diagonals(13, 100_000).for_each(|v| assert_total(&codec, v));
        assert_commutes(&codec, near_diagonals(11, 50_000), symmetries(&codec));
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
