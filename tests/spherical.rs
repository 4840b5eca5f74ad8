//! The spherical codecs: bound, poles, layout.

use glam::Vec3;
use unitvec::{Codec, Spherical16, Spherical20, Spherical32};
use unitvec_oracle::spherical::{self, at, steps};
use unitvec_oracle::{Oracle, Spherical, largest};
use unitvec_tests::checks::{assert_attains, assert_commutes_but_for_ties};
use unitvec_tests::directions::{Rng, near_planes, sphere};
use unitvec_tests::expected::{ANGLE_ROUNDING, MIRROR_X, SWAP};
use unitvec_tests::tested::{Tested, narrow, widen};

/// Corners of cells at the equator come to 99 % of the bound at least, and nothing exceeds it.
#[test]
fn bound_is_attained_at_the_equator() {
    for codec in Tested::named("spherical", "") {
        let (m, steps) = (largest(codec.bits), steps(codec.bits));
        let mut rng = Rng::new(6);
        let corners = (0..50_000).map(move |_| {
            let column = (rng.unit() * 2.0 * steps).floor() + 0.5;
            let off = rng.range(-0.02, 0.02);
            narrow(at(0.5 + (0.5 + off) / (2.0 * m), column / steps))
        });
        let bound = spherical::bound_deg(codec.bits);
        assert!(bound <= f64::from(codec.max_error_deg()), "{}", codec.id);
        assert_attains(&codec, corners.chain(sphere(5, 300_000)), bound, 0.99, 4e-5);
    }
}

/// Mirrored at x = 0 or with x and y swapped, a direction comes back as the image within rounding, except within f32
/// rounding of a tie.
#[test]
fn symmetric_up_to_ties() {
    for codec in Tested::family("spherical") {
        for image in [MIRROR_X, SWAP] {
            let directions = sphere(7, 100_000).chain(near_planes(8, 50_000));
            assert_commutes_but_for_ties(&codec, directions, image, |v| is_tie(v, codec.bits));
        }
    }
}

/// True where one of the angles of `v` is within `f32` rounding of half a step.
fn is_tie(v: Vec3, bits: u32) -> bool {
    let ([t, phi], m, steps) = (Spherical::position(widen(v)), largest(bits), steps(bits));
    [t * m, phi * steps].iter().any(|p| ((p.abs().fract()) - 0.5).abs() <= 4.0 * steps * ANGLE_ROUNDING)
}

/// Every phi at theta = 0 and at pi is the pole, exactly, whose code encoding writes with phi = 0; the pattern that
/// encoding never writes is +Z too.
#[test]
fn poles_have_one_code() {
    for codec in Tested::named("spherical", "") {
        let (half, m) = (codec.bits / 2, largest(codec.bits) as u64);
        for phi in (0..1 << half).step_by(1 << half.saturating_sub(16)) {
            let theta = [(1 << half) - m, (1 << half) - m - 1, m];
            let poles = theta.map(|i| codec.decode(i | (phi << half)));
            assert_eq!(poles, [Vec3::Z, Vec3::Z, Vec3::NEG_Z], "{}: {phi:#x}", codec.id);
        }
        assert_eq!(codec.encode(Vec3::Z), (1 << half) - m);
        assert_eq!(codec.encode(Vec3::NEG_Z), m);
        assert_eq!(codec.encode(Vec3::new(1e-9, -1e-9, -1.0)), m);
    }
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
