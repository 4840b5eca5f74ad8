//! The cylindrical codecs: bound, poles, layout.

use glam::Vec3;
use unitvec::{Codec, Cylindrical16, Cylindrical24, Cylindrical32};
use unitvec_oracle::{Cylindrical, Oracle, cylindrical, largest};
use unitvec_tests::checks::assert_attains;
use unitvec_tests::directions::{Rng, sphere};
use unitvec_tests::tested::{Tested, narrow};

/// Half a step of z off the poles the error comes to 99 % of the bound at least, and nothing exceeds it.
#[test]
fn bound_is_attained_at_the_poles() {
    for codec in Tested::family("cylindrical") {
        let half_step = 0.5 / largest(codec.bits);
        let mut rng = Rng::new(6);
        let off_poles = (0..50_000).map(move |i| {
            let z = 1.0 - half_step * rng.range(0.985, 1.015);
            narrow(Cylindrical::direction([rng.range(-1.0, 1.0), if i % 2 == 0 { z } else { -z }]))
        });
        let (bound, most) = (cylindrical::bound_deg(codec.bits), f64::from(codec.max_error_deg()));
        assert!(bound <= most, "{}", codec.id);
        assert_attains(&codec, off_poles.chain(sphere(5, 300_000)), bound, 0.99, most - bound);
    }
}

/// +-X and +-Z come back exactly; +-Y, half a step off, do not, and are turned by that about z.
#[test]
fn keeps_four_axes() {
    for codec in Tested::family("cylindrical") {
        for axis in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
            assert_eq!(codec.round_trip(axis), axis, "{}", codec.id);
        }
        for y in [Vec3::Y, Vec3::NEG_Y] {
            let error = codec.error_deg(y);
            assert!((error * largest(codec.bits) / 90.0 - 1.0).abs() < 0.01, "{}: {error}", codec.id);
        }
    }
}

/// Every phi at z = 1 and -1 is the pole, exactly, whose code encoding writes with phi = 0.
#[test]
fn poles_have_one_code() {
    for codec in Tested::family("cylindrical") {
        let (half, m) = (codec.bits / 2, largest(codec.bits) as u64);
        for phi in 0..1 << half {
            let poles = [m, (1 << half) - m, m + 1].map(|z| codec.decode(phi | (z << half)));
            assert_eq!(poles, [Vec3::Z, Vec3::NEG_Z, Vec3::NEG_Z], "{}: {phi:#x}", codec.id);
        }
        assert_eq!(codec.encode(Vec3::Z), m << half);
        assert_eq!(codec.encode(Vec3::new(1e-4, -1e-4, 1.0)), m << half);
    }
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
        assert_eq!(Cylindrical16::decode_vec3(code), Vec3::NEG_X);
    }
}
