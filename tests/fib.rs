//! The spherical Fibonacci codecs: codes of their own points, nearest points, the bound at the poles, layout.

use glam::Vec3;
use unitvec::{Codec, Fib16, Fib24, Fib32};
use unitvec_oracle::{Fib, Oracle, Summary, angle_deg, dot, fib, normalize, spherical};
use unitvec_tests::checks::assert_attains;
use unitvec_tests::directions::{AXES, Rng, near_planes, sphere};
use unitvec_tests::tested::{Tested, narrow, widen};

/// The error of the encoder's arithmetic for a direction, in radians.
const ENCODE_ROUNDING: f64 = 2e-7;

/// The error of the decoder's arithmetic for a point, and of the rounding of its components.
const DECODE_ROUNDING: f64 = 1.5e-7;

/// All codes of 16 and 24 bits, 2^20 of those of 32, and those around both poles come back.
#[test]
fn every_code_comes_back() {
    for codec in Tested::family("fib") {
        for code in codec.codes(2, 24) {
            assert_eq!(codec.encode(codec.decode(code)), code, "{}", codec.id);
        }
    }
}

/// Directions of all kinds get the nearest point, or one as near but for the rounding.
#[test]
fn encodes_to_the_nearest() {
    for codec in Tested::family("fib") {
        let (mut excess, mut other, mut count) = (f64::NEG_INFINITY, 0, 0);
        for v in directions(3, 60_000, codec.bits) {
            let best = fib::nearest(widen(v), codec.bits);
            let over = codec.choice_deg::<Fib>(v) - angle_deg(widen(v), Fib::decode(best, codec.bits));
            let over = over.to_radians();
            assert!(over <= 2.0 * ENCODE_ROUNDING, "{}: {v:?} for {best:#x}: {over:e}", codec.id);
            (excess, count) = (excess.max(over), count + 1);
            other += usize::from(codec.encode(v) != best);
        }
        println!("{}: {excess:e} radians over nearest; other {other} of {count}", codec.id);
    }
}

/// The greatest error lies between points 1, 2 and 4 of either pole: around there the bound is attained, and nowhere
/// exceeded.
#[test]
fn bound_is_attained_beside_the_poles() {
    for codec in Tested::family("fib") {
        let (mut rng, bits) = (Rng::new(6), codec.bits);
        let (hole, bound) = (fib::hole(bits), fib::bound_deg(bits));
        let spread = bound.to_radians();
        let beside = (0..100_000).map(move |n| {
            let around = if n % 2 == 0 { hole } else { image(hole, bits) };
            let off = [(); 3].map(|()| rng.range(-0.03, 0.03) * spread);
            narrow([around[0] + off[0], around[1] + off[1], around[2] + off[2] * spread])
        });
        let most = f64::from(codec.max_error_deg());
        assert!(bound <= most, "{}", codec.id);
        assert_attains(&codec, beside.chain(sphere(5, 300_000)), bound, 0.99, most - bound);
    }
}

/// No error exceeds 0.57 degrees, scaled to the number of points, from point 10 to point 10,000.
#[test]
fn away_from_the_poles_errors_are_less() {
    for codec in Tested::family("fib") {
        let (mut rng, count) = (Rng::new(7), 2f64.powi(codec.bits as i32));
        let directions = (0..300_000).map(move |_| {
            let depth = 2.0 * rng.range(10.0, 100.0).powf(rng.range(1.0, 2.0)) / count;
            narrow(spherical::at((1.0 - depth).acos() / std::f64::consts::PI, rng.range(0.0, 2.0)))
        });
        let worst = Summary::of(directions.map(|v| codec.error_deg(v))).max;
        let scaled = worst * (count / 65536.0).sqrt();
        println!("{} beyond point 10: {worst:.7}, scaled {scaled:.4}", codec.id);
        assert!(scaled < 0.57 + 0.01, "{}: {scaled}", codec.id);
    }
}

/// Point N - 1 - i is the image of point i, turned half around a horizontal axis, within rounding, and so are directions'
/// codes, but for ties.
#[test]
fn symmetric() {
    for codec in Tested::family("fib") {
        for v in directions(8, 50_000, codec.bits) {
            let other = codec.mask() - codec.encode(v);
            let expected = image(widen(codec.round_trip(v)), codec.bits);
            let off = angle_deg(widen(codec.decode(other)), expected).to_radians();
            assert!(off <= 2.0 * DECODE_ROUNDING, "{}: {other:#x}: {off:e}", codec.id);
            let image = narrow(image(widen(v), codec.bits));
            let other = angle_deg(widen(image), Fib::decode(other, codec.bits));
            let over = (codec.choice_deg::<Fib>(image) - other).to_radians().abs();
            assert!(over <= 4.0 * ENCODE_ROUNDING, "{}: {v:?}: {over:e}", codec.id);
        }
    }
}

/// No axis is a point: Z and -Z get the first and the last, `sqrt(2 / N)` away, and all axes come back with an error below
/// the bound, but not 0.
#[test]
fn axes_are_no_points() {
    for codec in Tested::family("fib") {
        assert_eq!([Vec3::Z, Vec3::NEG_Z].map(|v| codec.encode(v)), [0, codec.mask()], "{}", codec.id);
        for axis in AXES {
            let error = codec.error_deg(axis);
            assert!(error > 1e-5 && error < fib::bound_deg(codec.bits), "{}: {axis}: {error}", codec.id);
            let at_pole = (2.0 / 2f64.powi(codec.bits as i32)).sqrt().to_degrees();
            assert!(axis.z == 0.0 || (error / at_pole - 1.0).abs() < 1e-3, "{}: {axis}: {error}", codec.id);
        }
    }
}

/// 1000 directions: the search over all points of 16 bits finds none nearer.
#[test]
fn no_other_point_is_nearer() {
    let points: Vec<[f64; 3]> = (0..1 << 16).map(|code| Fib::decode(code, 16)).collect();
    for v in directions(9, 500, 16) {
        let exact = normalize(widen(v));
        let cosine = points.iter().map(|&p| dot(p, exact)).fold(-1.0, f64::max);
        let ours = dot(points[Fib16::encode(v) as usize], exact);
        // The cosine changes by 0.005 of the angle's change at 0.3 degrees.
        assert!(cosine - ours <= 0.02 * ENCODE_ROUNDING, "{v:?}: {cosine} {ours}");
    }
}

/// Codes count from +Z to -Z, each 0.618 of a turn from +X towards +Y after the one before.
#[test]
fn layout() {
    let expected =
        [(0, 0.0, 32767.5), (1, 0.618_034, 32766.5), (2, 0.236_068, 32765.5), (3, 0.854_102, 32764.5)];
    for (code, turns, height) in expected {
        let v = Fib16::decode_vec3(code);
        assert_eq!(v.z, height / 32768.0);
        let turn = spherical::azimuth(widen(v)) / 2.0;
        assert!(spherical::around(turn, turns, 1.0) < 1e-6, "{code}: {turn}");
    }
    assert_eq!(Fib16::decode_vec3(0xffff).z, -32767.5 / 32768.0);
    assert_eq!(Fib24::decode_vec3(0x80_0000).z, -0.5f32.powi(24));
    assert_eq!(Fib32::decode_vec3(0x7fff_ffff).z, 0.5f32.powi(32));
}

/// Directions of all kinds: uniform ones, those near the planes and axes, and those around both poles.
fn directions(seed: u64, count: usize, bits: u32) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed + 2);
    let poles = (0..count / 2).map(move |_| {
        let depth = rng.range(0.0, 40.0).powi(2) / 2f64.powi(bits as i32) / 2.0;
        let v = spherical::at((1.0 - depth).acos() / std::f64::consts::PI, rng.range(0.0, 2.0));
        narrow([v[0], v[1], if rng.unit() < 0.5 { v[2] } else { -v[2] }])
    });
    sphere(seed, count).chain(near_planes(seed + 1, count / 2)).chain(poles)
}

/// `v` mirrored at the equator, and at the meridian that makes point N - 1 of point 0.
fn image(v: [f64; 3], bits: u32) -> [f64; 3] {
    let (y, x) = (std::f64::consts::TAU * fib::turn((1 << bits) - 1)).sin_cos();
    [v[0] * x + v[1] * y, v[0] * y - v[1] * x, -v[2]]
}
