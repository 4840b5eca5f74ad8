//! The latlong codecs: rings, bounds, layout.

use glam::Vec3;
use unitvec::{Codec, LatLong16, LatLong32, LatLongD16};
use unitvec_oracle::latlong::{self, rings};
use unitvec_oracle::spherical::{at, steps};
use unitvec_tests::checks::{assert_attains, assert_commutes_but_for_ties, assert_decodes, assert_stable};
use unitvec_tests::directions::{AXES, Rng, near_planes, sphere};
use unitvec_tests::expected::ANGLE_ROUNDING;
use unitvec_tests::tested::{Tested, narrow, widen};

/// Corners of the equator's patches come to 99 % of the bound of the grids at least, and nothing exceeds it.
#[test]
fn bound_of_grids_is_attained_at_the_equator() {
    for codec in Tested::named("latlong", "") {
        let count = 2.0 * steps(codec.bits);
        let mut rng = Rng::new(6);
        let corners = (0..50_000).map(move |_| {
            let patch = (rng.unit() * count).floor() * 2.0 / count;
            narrow(at(0.5 + rng.range(-0.02, 0.02) / count, patch))
        });
        assert_bound(&codec, corners, latlong::grid_bound_deg(codec.bits));
    }
}

/// Corners of the patches of the worst ring come to 99 % of the bound at least; those of all rings do not exceed it.
#[test]
fn bound_of_rings_is_attained_at_corners() {
    for codec in Tested::named("latlong", "d") {
        let rings = rings(codec.bits);
        let mut rng = Rng::new(6);
        let step = (2 * rings.last / 100_000).max(1);
        let corners = (0..rings.last).step_by(step).flat_map(move |i| {
            let count = f64::from(rings.count(i));
            let edge = (i as f64 + 0.5 + rng.range(-0.01, 0.01)) / rings.last as f64 / 2.0;
            let off = rng.range(-0.01, 0.01);
            [0.0, (rng.unit() * 4.0 * count).floor()].map(|j| narrow(at(edge, (j + 0.5 + off) / count / 2.0)))
        });
        assert_bound(&codec, corners, rings.farthest_corner_deg());
    }
}

/// Asserts that `corners` and other directions attain the bound, and that the codec's own is not below it.
fn assert_bound(codec: &Tested, corners: impl Iterator<Item = Vec3>, bound: f64) {
    let most = f64::from(codec.max_error_deg());
    assert!(bound <= most, "{}: {bound}", codec.id);
    assert_attains(codec, corners.chain(sphere(5, 300_000)), bound, 0.99, most - bound);
}

/// The axes are corners of the grids' patches, and come back as the middle of one of them.
#[test]
fn axes_are_corners_of_grids() {
    for codec in Tested::named("latlong", "") {
        let (bound, ring) = (latlong::grid_bound_deg(codec.bits), 45.0 / steps(codec.bits));
        for (i, axis) in AXES.into_iter().enumerate() {
            let expected = if i % 3 == 2 { ring } else { bound };
            let error = codec.error_deg(axis);
            assert!((error / expected - 1.0).abs() < 0.02, "{}: {axis}: {error}, not {expected}", codec.id);
        }
    }
}

/// Every ring of every hemisphere and quarter: its first and last index are decoded to the oracle's direction, and come
/// back. With the rings between these, the inverse of the start of rings is right for every code.
#[test]
fn finds_every_ring() {
    for codec in Tested::named("latlong", "d") {
        let ends = rings(codec.bits).starts.windows(2).flat_map(|s| [s[0], s[1] - 1]);
        let parts = ends.flat_map(|index| (0..8).map(move |part| (u64::from(index), part)));
        let codes: Vec<u64> = parts.map(|(index, part)| index | (part << (codec.bits - 3))).collect();
        assert_decodes(&codec, codes.iter().copied(), 1.0);
        assert_stable(&codec, codes.into_iter());
    }
}

/// Every code is a patch: rings start at 0, grow, and end with the last index.
#[test]
fn no_code_of_the_rings_is_unused() {
    for codec in Tested::named("latlong", "d") {
        let starts = &rings(codec.bits).starts;
        assert_eq!((starts[0], starts[1]), (0, 1));
        assert_eq!(starts[starts.len() - 1], 1 << (codec.bits - 3));
        assert!(starts.windows(2).all(|s| s[0] < s[1]));
    }
}

/// Turned by a quarter about z, a direction comes back as the image of the rings' within rounding, except within f32
/// rounding of a border.
#[test]
fn rings_turn_by_quarters() {
    for codec in Tested::named("latlong", "d") {
        let rounding = 8.0 * steps(codec.bits) * ANGLE_ROUNDING;
        let is_tie = |v: Vec3| {
            let off = latlong::steps_off(widen(v), codec.encode(v), codec.bits);
            off[0].max(off[1]) >= 0.5 - rounding
        };
        let directions = sphere(7, 100_000).chain(near_planes(8, 50_000));
        assert_commutes_but_for_ties(&codec, directions, |v| Vec3::new(-v.y, v.x, v.z), is_tie);
    }
}

/// The fast format counts patches from +X and rings from +Z; the better one has quarter and hemisphere above the
/// index, whose last ring is the equator.
#[test]
fn layout() {
    assert_eq!(LatLong16::encode(Vec3::Z), 0x0000);
    assert_eq!(LatLong16::encode(Vec3::NEG_Z), 0xff00);
    assert_eq!(LatLong16::encode(Vec3::new(0.0, 1.0, 0.001)), 0x7f40);
    assert_eq!(LatLong32::encode(Vec3::new(1.0, -1e-6, -1e-6)), 0x8000_ffff);

    let equator = latlong::rings(16).starts[113];
    assert_eq!(LatLongD16::encode(Vec3::Z), 0x0000);
    assert_eq!(LatLongD16::encode(Vec3::NEG_Z), 0x8000);
    assert_eq!(LatLongD16::encode(Vec3::new(-1e-5, -1e-5, 1.0)), 0x0000);
    for (quarter, axis) in [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y].into_iter().enumerate() {
        assert_eq!(LatLongD16::encode(axis), equator | ((quarter as u32) << 13), "{axis}");
    }
}
