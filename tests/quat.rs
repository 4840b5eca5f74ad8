//! Rotations: their layout, nearest points, the bound of the lattice's cells, exact rotations, any input.

use unitvec::codec::RawCode;
use unitvec::direction::{MAX_NORM, MIN_NORM};
use unitvec::{ListedRotation, Quat24, Quat32, Quat48, Quat64, RotationCodec, rotation_angle_deg};
use unitvec_oracle::quat::{self, Point};
use unitvec_run::sampling::{special_codes, special_rotations};
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::Rng;

/// Tests that run `check::<name>::<codec>()` for all widths.
macro_rules! for_all {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            check::$name::<Quat24>();
            check::$name::<Quat32>();
            check::$name::<Quat48>();
            check::$name::<Quat64>();
        }
    )*};
}

for_all! {
    decodes_by_the_layout round_trip_is_stable keeps_the_rotations_of_a_cube length_and_sign_do_not_matter
    any_input_has_a_code encodes_the_nearest errors_reach_the_bound_of_cells_and_no_further
}

fn number<C: RotationCodec>(q: [f32; 4]) -> u64 {
    let [low, high] = C::encode(q).to_words();
    u64::from(low) | (u64::from(high) << 32)
}

fn decode<C: RotationCodec>(code: u64) -> [f32; 4] {
    C::decode(C::Code::from_words([code as u32, (code >> 32) as u32]))
}

fn error_deg<C: RotationCodec>(q: [f32; 4]) -> f64 {
    rotation_angle_deg(q, decode::<C>(number::<C>(q)))
}

fn widen(q: [f32; 4]) -> [f64; 4] {
    quat::unit(q.map(f64::from))
}

fn narrow(q: [f64; 4]) -> [f32; 4] {
    q.map(|c| c as f32)
}

/// Codes whose fields are at the ends of their ranges, and random ones; unused patterns are among both.
fn codes<C: RotationCodec>(seed: u64, count: usize) -> impl Iterator<Item = u64> {
    let mut rng = Rng::new(seed);
    let mask = u64::MAX >> (64 - C::BITS);
    special_codes().into_iter().chain((0..count).map(move |_| rng.bits())).map(move |code| code & mask)
}

/// Uniform rotations, and as many on and beside the borders of charts: some components are nearly as large as the largest.
fn rotations(seed: u64, count: usize) -> impl Iterator<Item = [f32; 4]> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |at| {
        let mut q = uniform(&mut rng);
        if at % 2 == 1 {
            let (largest, choice) = (q.iter().fold(0.0, |m: f64, c| m.max(c.abs())), rng.bits());
            for (i, c) in q.iter_mut().enumerate().filter(|(i, _)| (choice >> i) & 1 == 1) {
                let off = rng.range(0.0, 1.0) * 2f64.powi(-((choice >> (8 + 6 * i)) as i32 & 31));
                *c = c.signum() * largest * (1.0 - off);
            }
        }
        narrow(quat::unit(q))
    })
}

/// Four normal numbers, by Box and Muller, at unit length.
fn uniform(rng: &mut Rng) -> [f64; 4] {
    let normal = |rng: &mut Rng| {
        let radius = (-2.0 * rng.range(1e-300, 1.0).ln()).sqrt();
        radius * rng.range(0.0, std::f64::consts::TAU).cos()
    };
    quat::unit([(); 4].map(|()| normal(rng)))
}

/// The 24 rotations that turn a cube into itself: each is a quaternion of one component, of two or of four equal ones.
fn cube() -> Vec<[f32; 4]> {
    let mut found: Vec<[f32; 4]> = Vec::new();
    for signs in 0..81 {
        let q = [1, 3, 9, 27].map(|place| (signs / place % 3 - 1) as f32);
        let count = q.iter().filter(|c| **c != 0.0).count();
        let size = [1.0, std::f32::consts::FRAC_1_SQRT_2, f32::NAN, 0.5][count.max(1) - 1];
        let q = q.map(|c| if c == 0.0 { 0.0 } else { c * size });
        if [1, 2, 4].contains(&count) && !found.contains(&q.map(|c| 0.0 - c)) {
            found.push(q);
        }
    }
    found
}

/// The largest of the lattice's cells, in degrees, and the place of its middle in a chart: over a grid of places, of all that
/// symmetry leaves, and around the largest of these.
fn largest_cell(bits: u32) -> (f64, [f64; 3]) {
    const STEPS: i32 = 24;
    let at = |i: i32| f64::from(i) / f64::from(STEPS);
    let places = (0..=STEPS).flat_map(|i| (0..=i).flat_map(move |j| (0..=j).map(move |k| [i, j, k].map(at))));
    let of = |u: [f64; 3]| (quat::largest_cell_deg(u, bits), u);
    let larger = |a: (f64, [f64; 3]), b: (f64, [f64; 3])| if b.0 > a.0 { b } else { a };
    let mut best = places.map(of).fold((0.0, [0.0; 3]), larger);
    let mut step = 1.0 / f64::from(STEPS);
    for _ in 0..12 {
        for k in 0..27 {
            let moves = [k % 3, k / 3 % 3, k / 9].map(|m| f64::from(m - 1) * step);
            best = larger(best, of([0, 1, 2].map(|i| (best.1[i] + moves[i]).clamp(0.0, 1.0))));
        }
        step *= 0.6;
    }
    best
}

/// The largest error, in degrees, that climbing from random rotations, and from some about the largest cell, finds.
fn worst_found<C: RotationCodec>(middle: [f64; 3]) -> f64 {
    let mut rng = Rng::new(21);
    let step = 2.0 / quat::steps(C::BITS) as f64;
    let mut worst = 0.0f64;
    for start in 0..600 {
        let mut q = uniform(&mut rng);
        if start % 2 == 0 {
            let [x, y, z] = middle.map(|u| quat::warp((u + rng.range(-8.0, 8.0) * step).clamp(-1.0, 1.0)));
            q = quat::unit([x, y, z, 1.0]);
        }
        let (mut best, mut reach) = (error_deg::<C>(narrow(q)), step);
        for _ in 0..250 {
            let moved = quat::unit(q.map(|c| c + rng.range(-reach, reach)));
            let error = error_deg::<C>(narrow(moved));
            if error > best {
                (best, q) = (error, moved);
            } else {
                reach *= 0.985;
            }
        }
        worst = worst.max(best);
    }
    worst
}

mod check {
    use super::*;

    /// Codes decode to the oracle's unit quaternions, to rounding: the ends of fields and 2^18 random ones.
    pub fn decodes_by_the_layout<C: ListedRotation>() {
        for code in codes::<C>(1, 1 << 18) {
            let (decoded, expected) = (decode::<C>(code), quat::decode(code, C::BITS));
            let length = decoded.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt();
            assert!((length - 1.0).abs() <= LENGTH_ROUNDING, "{code:#x}: {decoded:?}");
            for (a, b) in decoded.iter().zip(expected) {
                assert!((f64::from(*a) - b).abs() < 3e-7, "{} {code:#x}: {decoded:?} {expected:?}", C::NAME);
            }
            assert_eq!(decode::<C>(code | !(u64::MAX >> (64 - C::BITS))), decoded, "higher bits are ignored");
        }
    }

    /// A decoded rotation encodes to a code of the same one, perhaps with the other sign.
    pub fn round_trip_is_stable<C: ListedRotation>() {
        for code in codes::<C>(2, 1 << 18) {
            let once = decode::<C>(code);
            let again = decode::<C>(number::<C>(once));
            assert!(again == once || again == once.map(|c| -c), "{} {code:#x}: {once:?} {again:?}", C::NAME);
        }
    }

    /// The 24 rotations of a cube come back exactly, but for the sign.
    pub fn keeps_the_rotations_of_a_cube<C: ListedRotation>() {
        assert_eq!(cube().len(), 24);
        for q in cube() {
            let decoded = decode::<C>(number::<C>(q));
            assert!(decoded == q || decoded == q.map(|c| 0.0 - c), "{}: {q:?} {decoded:?}", C::NAME);
        }
    }

    /// q, -q and all lengths have one code; -0 and denormals count as 0.
    pub fn length_and_sign_do_not_matter<C: ListedRotation>() {
        for q in rotations(3, 2000).chain(cube()) {
            let code = number::<C>(q);
            assert_eq!(number::<C>(q.map(|c| -c)), code, "{q:?}");
            for exponent in [-60, -20, 1, 30, 98] {
                assert_eq!(number::<C>(q.map(|c| c * 2f32.powi(exponent))), code, "{q:?} 2^{exponent}");
            }
            for place in 0..4 {
                let with =
                    |c: f32| std::array::from_fn(|i| if i == place { c } else { q[i] * MIN_NORM * 4.0 });
                for tiny in [-0.0, 1e-40, -f32::MIN_POSITIVE.next_down()] {
                    assert_eq!(number::<C>(with(tiny)), number::<C>(with(0.0)), "{q:?}");
                }
            }
        }
    }

    /// Any four floats have a code; without a usable direction it is that of the identity, else the error keeps its bound.
    pub fn any_input_has_a_code<C: ListedRotation>() {
        let identity = number::<C>([0.0, 0.0, 0.0, 1.0]);
        for q in special_rotations() {
            let norm: f64 = q.iter().map(|c| f64::from(*c).abs()).sum();
            let code = number::<C>(q);
            assert_eq!(code & !(u64::MAX >> (64 - C::BITS)), 0, "{q:?}");
            // The sum of magnitudes is rounded where it is at a limit.
            let rounding = 1.0 + 4.0 * f64::from(f32::EPSILON);
            if !(norm >= f64::from(MIN_NORM) / rounding && norm < f64::from(MAX_NORM) * rounding) {
                assert_eq!(code, identity, "{q:?}");
            } else if norm >= f64::from(MIN_NORM) * rounding && norm < f64::from(MAX_NORM) / rounding {
                assert!(error_deg::<C>(q) <= C::MAX_ERROR_DEG.into(), "{}: {q:?}", C::NAME);
            }
        }
    }

    /// The encoder's point is nearly always the nearest of 54 around a rotation: others are so few, and so little farther off,
    /// that the mean error is at most 0.2 % higher (0.5 % at 64 bits, where `f32` rounds by a tenth of a step).
    pub fn encodes_the_nearest<C: ListedRotation>() {
        let (mut sum, mut least) = (0.0, 0.0);
        for q in rotations(4, 60_000) {
            let (error, nearest) = (error_deg::<C>(q), quat::nearest(widen(q), C::BITS).1);
            assert!(error > nearest - 1.5e-5, "{q:?}: the search missed {error}");
            (sum, least) = (sum + error, least + nearest);
        }
        let excess = sum / least - 1.0;
        println!("{}: {excess:e}", C::NAME);
        let allowed = if C::BITS == 64 { 0.005 } else { 0.002 };
        assert!(excess.abs() < allowed, "{}: {excess:e}", C::NAME);
    }

    /// No rotation that climbing finds is farther off than the bound, and it comes near the largest cell that the metric
    /// gives. The bound is that cell's, and what its documentation adds.
    pub fn errors_reach_the_bound_of_cells_and_no_further<C: ListedRotation>() {
        let (cell, middle) = largest_cell(C::BITS);
        let (worst, bound) = (worst_found::<C>(middle), f64::from(C::MAX_ERROR_DEG));
        println!(
            "{}: cell {cell:.6e}, worst {:.5} of it, bound {:.5} of it, at {middle:?}",
            C::NAME,
            worst / cell,
            bound / cell
        );
        let added = match C::BITS {
            24 => 0.03,
            64 => 0.25,
            _ => 0.015,
        };
        assert!(worst <= bound && worst > 0.97 * cell, "{}", C::NAME);
        assert!(bound > cell && bound < cell * (1.0 + added), "{}", C::NAME);
    }
}

/// Patterns past the last point along a coordinate count as that.
#[test]
fn unused_patterns_count_as_the_last_point() {
    // The last patterns of 64 bits have 5 values of each coordinate above 18 bits in place of the 8.2 that are left.
    let last = Point { chart: 3, halves: [1_310_717, 1_310_717, 1_310_717] };
    let code = u64::MAX >> 10 | (7 * 125 + 124) << 54;
    assert_eq!(quat::point(code, 64), last);
    assert_eq!(decode::<Quat64>(code), decode::<Quat64>(code - 1));
    let face = Point { chart: 0, halves: [126, -126, 0] };
    assert_eq!(quat::point(127 | (63 << 14), 24), face);
}
