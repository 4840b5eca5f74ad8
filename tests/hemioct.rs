//! The hemi-octahedral codecs: bound, lattice points, layout.

use glam::Vec3;
use unitvec::{Codec, HemiOct16, HemiOct24, HemiOct32};
use unitvec_oracle::{HemiOct, Oracle, hemioct, largest, turn_deg};
use unitvec_tests::checks::{POSITION_ROUNDING, assert_attains, assert_rounds};
use unitvec_tests::directions::{hemisphere, near_octant_middles, near_planes, sphere};
use unitvec_tests::tested::Tested;

/// 10^6 directions, those near the coordinate planes and those below the equator get the lattice point nearest to the
/// oracle's position, except within 2^-21 of the square's half side of a tie.
#[test]
fn encodes_as_the_oracle() {
    for codec in Tested::family("hemioct") {
        let m = largest(codec.bits);
        let steps_off = |v, code| {
            let (position, point) =
                (HemiOct::position(HemiOct::domain(v)), HemiOct::unpack(code, codec.bits));
            [0, 1].map(|i| (position[i] * m - point[i] as f64).abs())
        };
        let directions = hemisphere(3, 1_000_000).chain(near_planes(4, 100_000)).chain(sphere(5, 100_000));
        assert_rounds(&codec, directions, steps_off, m * POSITION_ROUNDING);
    }
}

/// Around the middles of the octants the error comes to 95 % of the bound at least; nowhere does it exceed it.
#[test]
fn bound_is_attained_in_the_middle_of_octants() {
    for codec in Tested::family("hemioct") {
        let directions =
            near_octant_middles(7, 300_000, (4.0 / largest(codec.bits)).max(0.01)).filter(|v| v.z > 0.0);
        let slack = turn_deg(POSITION_ROUNDING) + f64::from(f32::EPSILON).to_degrees();
        let directions = directions.chain(hemisphere(6, 300_000));
        assert_attains(&codec, directions, hemioct::bound_deg(codec.bits), 0.95, slack);
    }
}

/// The corners of the square are the horizontal axes; the pattern that encoding never writes counts as -1.
#[test]
fn layout() {
    assert_eq!(HemiOct16::encode(Vec3::X), 0x7f7f);
    assert_eq!(HemiOct16::encode(Vec3::Y), 0x817f);
    assert_eq!(HemiOct24::encode(Vec3::NEG_X), 0x801801);
    assert_eq!(HemiOct32::encode(Vec3::NEG_Y), 0x7fff_8001);
    assert_eq!(HemiOct16::decode_vec3(0x8080), Vec3::NEG_X);
    assert_eq!(HemiOct24::decode_vec3(0x800_800), Vec3::NEG_X);
    assert_eq!(HemiOct32::decode_vec3(0x8000_8000), Vec3::NEG_X);
}
