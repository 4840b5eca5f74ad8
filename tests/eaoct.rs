//! The equal-area octahedral codecs: rings, nearest codes, bounds, layout.

use glam::Vec3;
use unitvec::{Codec, EaOct16, EaOct22, EaOct24, EaOct32};
use unitvec_oracle::{EaOct, Oracle, angle_deg, eaoct, largest, oct};
use unitvec_tests::checks::{assert_attains, assert_bounded, assert_nearest, assert_rounds};
use unitvec_tests::directions::{Rng, near_planes, sphere};
use unitvec_tests::tested::{Tested, narrow};

/// The effect of rounding in `f32` on r in `encode`, and on phi as a part of a quarter turn.
const RADIUS_ROUNDING: f64 = 8.0 / (1 << 24) as f64;
const TURN_ROUNDING: f64 = 4.0 / (1 << 24) as f64;

/// The error that `f32` adds to a choice, in degrees: as in `MAX_ERROR_DEG`.
const ROUNDING_DEG: f64 = 26.0 / (1 << 24) as f64 * 180.0 / std::f64::consts::PI;

/// The codecs of the fast or the precise encoder.
fn codecs(precise: bool) -> impl Iterator<Item = Tested> {
    Tested::family("eaoct").into_iter().filter(move |codec| codec.is_precise() == precise)
}

/// The fast encoders give 10^6 directions and those near the coordinate planes the nearest ring and the nearest of its
/// points, except within `f32` rounding of a tie.
#[test]
fn encodes_as_the_oracle() {
    for codec in codecs(false) {
        let m = largest(codec.bits);
        // Half a step, and the excess in parts of the rounding.
        let steps_off = |v, code| {
            let ([r, phi], point) = (eaoct::polar(v), eaoct::ring_point(code, codec.bits));
            let [ring, place] = point.map(|i| i as f64);
            assert_bounded(&codec, angle_deg(v, EaOct::decode(code, codec.bits)));
            let across = ((r * m - ring).abs() - 0.5) / (m * RADIUS_ROUNDING * r);
            let along = ((phi * ring - place).abs() - 0.5) / (ring.max(1.0) * TURN_ROUNDING);
            [across + 0.5, along + 0.5]
        };
        assert_rounds(&codec, sphere(8, 1_000_000).chain(near_planes(9, 100_000)), steps_off, 1.0);
    }
}

/// Midway between the points of ring 1, half a ring out, the error of the fast encoders comes to 98 % of the bound at least.
#[test]
fn bound_of_the_fast_is_attained_near_the_pole() {
    for codec in codecs(false) {
        let middle = [1.5 / largest(codec.bits), 0.5];
        let directions = around_middles(&codec, vec![middle]).chain(sphere(3, 300_000));
        assert_attains(&codec, directions, eaoct::fast_bound_deg(codec.bits), 0.98, ROUNDING_DEG);
    }
}

/// The error of the precise encoders comes to 98 % of the bound at least where the points of two rings lie opposite
/// each other, near a pole and y = 0; nowhere along that edge does it exceed it.
#[test]
fn bound_of_the_precise_is_attained_near_the_pole() {
    for codec in codecs(true) {
        let m = largest(codec.bits);
        let middles = (1..m as u32).step_by((m as usize / 2000).max(1)).map(|ring| {
            let ring = f64::from(ring) + 0.5;
            [ring / m, 0.5 / ring]
        });
        let directions = around_middles(&codec, middles.collect()).chain(sphere(3, 300_000));
        assert_attains(&codec, directions, eaoct::precise_bound_deg(codec.bits), 0.98, ROUNDING_DEG);
    }
}

/// Directions around pairs of r and phi, by up to a hundredth of a step.
fn around_middles(codec: &Tested, middles: Vec<[f64; 2]>) -> impl Iterator<Item = Vec3> {
    let (mut rng, m) = (Rng::new(4), largest(codec.bits));
    middles.into_iter().flat_map(move |[r, phi]| {
        [(); 100].map(|()| {
            let [a, b] = [(); 2].map(|()| rng.range(-0.01, 0.01));
            narrow(eaoct::at([r + a / m, phi + b / (r * m)]))
        })
    })
}

/// The precise encoders give 10^5 directions, those near the coordinate planes and those near a pole the code that the
/// oracle's search finds.
#[test]
fn encodes_to_the_nearest() {
    for codec in codecs(true) {
        let nearest = |v| eaoct::nearest_in_neighbourhood(v, codec.bits);
        assert_nearest_choice(&codec, sphere(10, 100_000), nearest);
        assert_nearest_choice(&codec, near_planes(11, 50_000), nearest);
        assert_nearest_choice(&codec, near_pole(12, 50_000, 6.0 / largest(codec.bits)), nearest);
    }
}

/// 16 bits, precise: the nearest of all 65536 codes, for 6000 directions, half of them near coordinate planes.
#[test]
fn eaoct16p_encodes_to_the_nearest_of_all() {
    let all: Vec<[f64; 3]> = (0..1 << 16).map(|code| EaOct::decode(code, 16)).collect();
    let codec = Tested::find("eaoct16p");
    let directions = sphere(14, 3000).chain(near_planes(15, 3000));
    assert_nearest_choice(&codec, directions, |v| oct::nearest_of_all(v, &all));
}

/// Asserts that a precise encoder's choices are those of `nearest` but for its rounding and 1e-5 of a step, which its
/// measure neglects at 16 bits.
fn assert_nearest_choice(
    codec: &Tested,
    directions: impl Iterator<Item = Vec3>,
    nearest: impl Fn([f64; 3]) -> u64,
) {
    let neglected = 1e-5 / largest(codec.bits);
    let slack = 2.0 * (ROUNDING_DEG + neglected.to_degrees());
    let error = |v, code| angle_deg(v, EaOct::decode(code, codec.bits));
    assert_nearest(codec, directions, nearest, error, slack);
}

/// Directions within about `radius` of both poles.
fn near_pole(seed: u64, count: usize, radius: f64) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        let z = if rng.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let [x, y] = [(); 2].map(|()| rng.range(-radius, radius));
        narrow([x, y, z])
    })
}

/// Codes are those of oct's layout: +X, +Y, +-Z and the patterns that encoding never writes.
#[test]
fn layout() {
    assert_eq!(EaOct16::encode(Vec3::X), 0x007f);
    assert_eq!(EaOct16::encode(Vec3::NEG_Y), 0x8100);
    assert_eq!(EaOct16::encode(Vec3::Z), 0x0000);
    assert_eq!(EaOct32::encode(Vec3::NEG_Z), 0x7fff_7fff);
    assert_eq!(EaOct16::decode_vec3(0x0080), Vec3::NEG_X);
    assert_eq!(EaOct22::decode_vec3(1 << 21), Vec3::NEG_Y);
    assert_eq!(EaOct32::decode_vec3(0x8000_8000), Vec3::NEG_Z);
    assert_eq!(EaOct24::encode(Vec3::X), 0xff_e7ff);
    assert_eq!(EaOct24::decode_vec3(0xff_f7ff), Vec3::X);
}

/// All cells have the same area: rings split the octant's area by the squares of their numbers, for ring s has a z of
/// `1 - s^2 / m^2`.
#[test]
fn rings_are_of_equal_area() {
    for ring in 0u16..=127 {
        let (z, part) = (EaOct16::decode_vec3(u32::from(ring)).z, f32::from(ring) / 127.0);
        assert!((1.0 - z - part * part).abs() <= f32::EPSILON, "{ring}: {z}");
    }
}
