//! Encoders choose the nearest point of a lattice: a row for each family whose codes are two numbers. And the bounds of
//! octahedra, which are attained in one place.

use glam::Vec3;
use unitvec::{Codec, HemiOct16, HemiOct24, HemiOct32};
use unitvec_oracle::spherical::{self, steps};
use unitvec_oracle::{
    HemiOct, Oct, Oracle, cube, cylindrical, hemioct, largest, latlong, oct, soct, turn_deg, uoct,
};
use unitvec_tests::checks::{POSITION_ROUNDING, assert_attains, assert_rounds};
use unitvec_tests::directions::{near_diagonals, near_octant_middles, near_planes, sphere};
use unitvec_tests::expected::ANGLE_ROUNDING;
use unitvec_tests::tested::Tested;

/// The steps between the oracle's position of a direction and a code, along both coordinates.
type StepsOff = fn([f64; 3], u64, u32) -> [f64; 2];

/// The names of codecs, as [`Tested::named`] takes them; the steps; and the effect of rounding in `f32`, in steps.
type Row = ([&'static str; 2], StepsOff, fn(u32) -> f64);

const ROWS: [Row; 9] = [
    // At 48 bits the position takes two floats.
    (
        ["oct", ""],
        |v, code, bits| off(Oct::position(v), Oct::unpack(code, bits), bits),
        |bits| {
            if bits > 32 { 1.0 / f64::from(1 << 20) } else { octahedral(bits) }
        },
    ),
    (
        ["hemioct", ""],
        |v, code, bits| off(HemiOct::position(HemiOct::domain(v)), HemiOct::unpack(code, bits), bits),
        octahedral,
    ),
    (["soct", ""], soct_steps_off, octahedral),
    (["cylindrical", ""], cylindrical::steps_off, |bits| 2.0 * largest(bits) * ANGLE_ROUNDING),
    (["spherical", ""], spherical::steps_off, |bits| {
        if bits > 32 { 1.0 / 16.0 } else { 2.0 * steps(bits) * ANGLE_ROUNDING }
    }),
    (["latlong", ""], latlong::grid_steps_off, |bits| 4.0 * steps(bits) * ANGLE_ROUNDING),
    (["latlong", "d"], latlong::steps_off, |bits| 4.0 * steps(bits) * ANGLE_ROUNDING),
    (["cube", ""], |v, code, bits| cube_steps_off(v, code, bits, false), |_| 1.0 / 128.0),
    (["warpedcube", ""], |v, code, bits| cube_steps_off(v, code, bits, true), |_| 1.0 / 128.0),
];

/// The effect of rounding on an octahedron's position.
fn octahedral(bits: u32) -> f64 {
    largest(bits) * POSITION_ROUNDING
}

fn off(position: [f64; 2], point: [i64; 2], bits: u32) -> [f64; 2] {
    [0, 1].map(|i| (position[i] * largest(bits) - point[i] as f64).abs())
}

/// The sign of z has to be right.
fn soct_steps_off(v: [f64; 3], code: u64, bits: u32) -> [f64; 2] {
    let ((point, negative), (position, below)) = (soct::unpack(code, bits), soct::position(v));
    assert_eq!(negative, below, "{v:?} gets {code:#x}");
    off(position, point, bits)
}

/// The face is that of the largest component.
fn cube_steps_off(v: [f64; 3], code: u64, bits: u32, is_warped: bool) -> [f64; 2] {
    let (position, point) = (cube::position(v, code, bits, is_warped), cube::integers(code, bits));
    [0, 1].map(|i| (position[i] - point[i] as f64).abs())
}

/// 6 * 10^5 directions, those near the coordinate planes, where two magnitudes are equal and in the middles of octants get the
/// nearest point, except within `f32` rounding of a tie.
#[test]
fn encodes_as_the_oracle() {
    for ([name, suffix], steps_off, rounding) in ROWS {
        for codec in Tested::named(name, suffix) {
            let edges = near_planes(4, 100_000).chain(near_diagonals(5, 50_000));
            let directions = sphere(3, 600_000).chain(edges).chain(near_octant_middles(7, 50_000, 0.1));
            let bits = codec.bits;
            assert_rounds(&codec, directions, |v, code| steps_off(v, code, bits), rounding(bits));
        }
    }
}

/// Around the middles of the octants, where Meyer's bound is attained, the error comes to 95 % of it at least; nowhere
/// does it exceed it by more than `f32`'s rounding.
#[test]
fn bound_is_attained_in_the_middle_of_octants() {
    for codec in ["oct", "uoct", "hemioct", "soct"].into_iter().flat_map(Tested::family) {
        let bound = match codec.family {
            "oct" if codec.is_precise() => oct::range_bound_deg,
            "oct" => oct::domain_bound_deg,
            "uoct" => uoct::bound_deg,
            _ => hemioct::bound_deg,
        };
        let middles = near_octant_middles(4, 300_000, (4.0 / largest(codec.bits)).max(0.01));
        let upper = |v: Vec3| if codec.family == "hemioct" { Vec3::new(v.x, v.y, v.z.abs()) } else { v };
        let slack = turn_deg(POSITION_ROUNDING) + f64::from(f32::EPSILON).to_degrees();
        let directions = middles.chain(sphere(3, 300_000)).map(upper);
        assert_attains(&codec, directions, bound(codec.bits), 0.95, slack);
    }
}

/// The corners of the square of `hemioct` are the horizontal axes; the pattern that encoding never writes counts as -1.
#[test]
fn layout_of_hemioct() {
    assert_eq!(HemiOct16::encode(Vec3::X), 0x7f7f);
    assert_eq!(HemiOct16::encode(Vec3::Y), 0x817f);
    assert_eq!(HemiOct24::encode(Vec3::NEG_X), 0x801801);
    assert_eq!(HemiOct32::encode(Vec3::NEG_Y), 0x7fff_8001);
    assert_eq!(HemiOct16::decode_vec3(0x8080), Vec3::NEG_X);
    assert_eq!(HemiOct24::decode_vec3(0x800_800), Vec3::NEG_X);
    assert_eq!(HemiOct32::decode_vec3(0x8000_8000), Vec3::NEG_X);
}
