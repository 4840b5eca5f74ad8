//! The crate's trigonometry: exact values, symmetries and bad input.

use super::{Function, SMALL, TINY, floats, no_negative_zero, vectors};
use glam::Vec2;
use unitvec::arith;
use unitvec_tests::directions::Rng;

/// Multiples of a quarter: 0, +-1 and equal parts, out to 2^100 half turns; x and y as bits, so that -0 shows.
#[test]
fn sin_cos_half_turns_of_quarters() {
    let diagonal = std::f32::consts::FRAC_1_SQRT_2;
    let quarters = [
        (1.0, 0.0),
        (diagonal, diagonal),
        (0.0, 1.0),
        (-diagonal, diagonal),
        (-1.0, 0.0),
        (-diagonal, -diagonal),
        (0.0, -1.0),
        (diagonal, -diagonal),
    ];
    let bits = |v: Vec2| [v.x.to_bits(), v.y.to_bits()];
    for i in -100_000i32..=100_000 {
        let (x, y) = quarters[i.rem_euclid(8) as usize];
        assert_eq!(bits(arith::sin_cos_half_turns(i as f32 / 4.0)), bits(Vec2::new(x, y)), "{i}/4");
    }
    for exponent in 1..=127 {
        assert_eq!(arith::sin_cos_half_turns(2f32.powi(exponent)), Vec2::X, "2^{exponent}");
    }
    for even in [f32::MAX, f32::MIN, 2f32.powi(24) + 2.0] {
        assert_eq!(arith::sin_cos_half_turns(even), Vec2::X, "{even}");
    }
    assert_eq!(arith::sin_cos_half_turns(2f32.powi(24) - 1.0), Vec2::NEG_X);
}

/// Axes and diagonals of vectors of every usable length.
#[test]
fn atan2_half_turns_of_axes_and_diagonals() {
    for exponent in -100..99 {
        let l = 1.9 * 2f32.powi(exponent);
        let cases = [
            (0.0, l, 0.0),
            (l, l, 0.25),
            (l, 0.0, 0.5),
            (l, -l, 0.75),
            (0.0, -l, 1.0),
            (-0.0, -l, 1.0),
            (-l, -l, -0.75),
            (-l, 0.0, -0.5),
            (-l, l, -0.25),
            (-0.0, l, 0.0),
            (-l, -0.0, -0.5),
            (l, -0.0, 0.5),
        ];
        for (y, x, angle) in cases {
            assert_eq!(arith::atan2_half_turns(y, x).to_bits(), f32::to_bits(angle), "{y} {x}");
        }
        assert_eq!([arith::atan_octant_ratio(0.0, l), arith::atan_octant_ratio(l, l)], [0.0, 1.0]);
    }
    assert_eq!(arith::atan2(1.0, 0.0), std::f32::consts::FRAC_PI_2);
    assert_eq!(arith::atan2(0.0, -1.0), std::f32::consts::PI);
}

/// The ends of the functions of one octant, and -1, 0 and 1 of the inverse functions, as bits.
#[test]
fn ends_are_exact() {
    let cases: [(&str, Function, f32, f32); 10] = [
        ("atan_octant", arith::atan_octant, 0.0, 0.0),
        ("atan_octant", arith::atan_octant, 1.0, 1.0),
        ("tan_octant", arith::tan_octant, 0.0, 0.0),
        ("tan_octant", arith::tan_octant, 1.0, 1.0),
        ("asin_half_turns", arith::asin_half_turns, -1.0, -0.5),
        ("asin_half_turns", arith::asin_half_turns, -0.0, 0.0),
        ("asin_half_turns", arith::asin_half_turns, 1.0, 0.5),
        ("acos_half_turns", arith::acos_half_turns, -1.0, 1.0),
        ("acos_half_turns", arith::acos_half_turns, -0.0, 0.5),
        ("acos_half_turns", arith::acos_half_turns, 1.0, 0.0),
    ];
    for (name, function, x, expected) in cases {
        assert_eq!(function(x).to_bits(), expected.to_bits(), "{name} of {x}");
    }
    assert_eq!([arith::asin(1.0), arith::acos(-1.0)], [std::f32::consts::FRAC_PI_2, std::f32::consts::PI]);
}

/// Mirrored angles give mirrored vectors: t, -t, and, where the arithmetic on t is exact, 1 - t, 1/2 - t and t + 2.
#[test]
fn sin_cos_half_turns_symmetries() {
    for t in floats(0.25, 1.0, 31) {
        let v = arith::sin_cos_half_turns(t);
        assert_eq!(arith::sin_cos_half_turns(-t), Vec2::new(v.x, -v.y), "-{t}");
        if t >= 0.5 {
            assert_eq!(arith::sin_cos_half_turns(1.0 - t), Vec2::new(-v.x, v.y), "1 - {t}");
        }
        assert_eq!(arith::sin_cos_half_turns(0.5 - t), Vec2::new(v.y, v.x), "1/2 - {t}");
    }
    for i in 0..1 << 20 {
        let t = i as f32 / 2f32.powi(19);
        assert_eq!(arith::sin_cos_half_turns(t + 2.0), arith::sin_cos_half_turns(t), "2 + {t}");
        assert_eq!(arith::sin_cos_half_turns(t - 8.0), arith::sin_cos_half_turns(t), "{t} - 8");
    }
}

/// Vectors mirrored at the x axis and arguments with the other sign give the negated result exactly; scaling by a
/// power of two changes nothing.
#[test]
fn inverse_symmetries() {
    for v in vectors(1_000_000) {
        let angle = arith::atan2_half_turns(v.y, v.x);
        assert_eq!(arith::atan2_half_turns(-v.y, v.x), -angle, "{v}");
        let doubled = 2.0 * v;
        assert_eq!(arith::atan2_half_turns(doubled.y, doubled.x), angle, "{v}");
        assert!((-1.0..=1.0).contains(&angle), "{v}");
    }
    for x in floats(SMALL, 1.0, 101) {
        assert_eq!(arith::asin_half_turns(-x), -arith::asin_half_turns(x), "{x}");
        assert_eq!(arith::sin_cos(-x), Vec2::new(arith::cos(x), -arith::sin(x)), "{x}");
    }
}

/// The functions of an octant, and the arcs, never fall (acos: never rise) from one float to the next: every float
/// from 1/4 to 1, which has all changes of formula, and sparsely below.
#[test]
fn monotonic() {
    let functions: [(&str, Function); 4] = [
        ("atan_octant", arith::atan_octant),
        ("tan_octant", arith::tan_octant),
        ("asin_half_turns", arith::asin_half_turns),
        ("-acos_half_turns", |x| -arith::acos_half_turns(x)),
    ];
    for (name, function) in functions {
        let mut last = -1.0;
        for x in floats(TINY, 0.25, 1009).chain(floats(0.25, 1.0, 1)) {
            let value = function(x);
            assert!(value >= last, "{name} falls before {x:e}");
            assert!(value <= 1.0, "{name} of {x:e}");
            last = value;
        }
    }
}

/// atan2 of sine and cosine gives the angle back, to within 1.2e-7, and tan_octant the input of atan_octant, to within
/// 1.8e-7.
#[test]
fn round_trips() {
    for t in floats(SMALL, 1.0, 31).flat_map(|t| [t, -t]) {
        let v = arith::sin_cos_half_turns(t);
        let back = arith::atan2_half_turns(v.y, v.x);
        assert!((back - t).abs() <= 1.2e-7, "{t}: {back}");
        let back = arith::tan_octant(arith::atan_octant(t.abs()));
        assert!((back - t.abs()).abs() <= 1.8e-7, "{t}: {back}");
    }
}

/// Denormals and all below 2^-100 count as 0; so do infinity and NaN, except where the docs differ. No result is -0.
#[test]
fn bad_input() {
    let negligible = [0.0, f32::from_bits(1), 1e-40, f32::MIN_POSITIVE, TINY.next_down()];
    let bad = [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -f32::NAN];
    for t in negligible.into_iter().flat_map(|t| [t, -t]) {
        for v in [arith::sin_cos_half_turns(t), arith::sin_cos(t)] {
            assert_eq!(v, Vec2::X, "{t:e}");
            assert!(no_negative_zero(v), "{t:e}");
        }
        let results =
            [arith::atan_octant(t), arith::tan_octant(t), arith::asin_half_turns(t), arith::asin(t)];
        assert_eq!(results.map(f32::to_bits), [0; 4], "{t:e}");
        assert_eq!(arith::acos_half_turns(t), 0.5, "{t:e}");
        for (y, x) in [(0.5 * t, 0.4 * t), (0.0, t), (t, 0.0), (t, 1.0)] {
            assert_eq!(arith::atan2_half_turns(y, x).to_bits(), 0, "{y:e} {x:e}");
        }
        assert_eq!(arith::atan2_half_turns(1.0, t), 0.5, "{t:e}");
    }
    for denormal in [f32::from_bits(1), 1e-40, -1e-40, f32::MIN_POSITIVE.next_down()] {
        // A denormal beside the least usable length would still be 2^-26 of it.
        assert_eq!(arith::atan2_half_turns(denormal, TINY).to_bits(), 0, "{denormal:e}");
        assert_eq!(arith::atan2_half_turns(denormal, -TINY), 1.0, "{denormal:e}");
        assert_eq!(arith::atan_octant_ratio(denormal, TINY).to_bits(), 0, "{denormal:e}");
    }
    for t in bad {
        assert_eq!([arith::sin_cos_half_turns(t), arith::sin_cos(t)], [Vec2::X; 2], "{t}");
        for other in [0.0, 1.0, -1.0, f32::MAX, t] {
            let angles = [arith::atan2_half_turns(t, other), arith::atan2_half_turns(other, t)];
            assert_eq!(angles.map(f32::to_bits), [0; 2], "{t} {other}");
        }
    }
    for (x, asin, acos) in [
        (f32::INFINITY, 0.5, 0.0),
        (f32::NAN, 0.5, 0.0),
        (1.0001, 0.5, 0.0),
        (f32::MAX, 0.5, 0.0),
        (f32::NEG_INFINITY, -0.5, 1.0),
        (-1.0001, -0.5, 1.0),
    ] {
        assert_eq!([arith::asin_half_turns(x), arith::acos_half_turns(x)], [asin, acos], "{x}");
    }
    for x in [arith::MAX_RADIANS, -arith::MAX_RADIANS, f32::MAX] {
        assert_eq!(arith::sin_cos(x), Vec2::X, "{x}");
    }
}

/// 10^7 random bit patterns: sines and cosines within [-1, 1], angles within [-1, 1], never NaN, -0 or denormal.
#[test]
fn random_bits() {
    let mut rng = Rng::new(2);
    for _ in 0..10_000_000 {
        let bits = rng.bits();
        let [x, y] = [bits as u32, (bits >> 32) as u32].map(f32::from_bits);
        let [half_turns, radians] = [arith::sin_cos_half_turns(x), arith::sin_cos(x)];
        let angles = [arith::atan2_half_turns(y, x), arith::asin_half_turns(x), arith::acos_half_turns(x)];
        for value in [half_turns.x, half_turns.y, radians.x, radians.y].into_iter().chain(angles) {
            assert!((-1.0..=1.0).contains(&value), "{y:e} {x:e}: {value}");
            assert!(value.to_bits() == 0 || value.is_normal(), "{y:e} {x:e}: {value:e}");
        }
    }
}
