//! The smallest cap of a set of directions.

use super::about::unit_axis;
use crate::angle_deg;
use crate::direction::{is_usable, l1_norm};
use glam::Vec3;

/// Passes over the vectors at most: sets of a million need about ten.
const PASSES: usize = 64;

/// The chord beyond a rim within which a direction counts as inside: far below what `f32` resolves, and above the
/// rounding of axes in `f64`, which small caps multiply.
const SLACK: f64 = 1e-8;

type Point = [f64; 3];

/// A cap: its axis, the square of the chord from there to the rim, and the one to three directions that hold it.
#[derive(Clone, Copy)]
struct Held {
    axis: Point,
    chord: f64,
    by: [Point; 3],
    count: usize,
}

/// The smallest cap that holds the directions of `vectors`: its axis, of unit length, and its half-angle in radians,
/// for [`Cap::new`](super::Cap::new). Vectors without a usable direction do not count; +Z and 0 without any.
///
/// Every direction is in the cap of that axis, and the half-angle is at most 2^-21 radians above that of the smallest
/// cap, where that is less than 90 degrees. Else the cap holds all, but need not be the smallest.
///
/// Each pass over the vectors takes the direction farthest from the axis, and then the smallest cap of that one and of those that
/// hold the cap so far, two or three. The angle grows with each pass, and the work with the number of vectors.
///
/// ```
/// let (axis, half_angle) = unitvec::wrap::smallest_cap(&[[0.0, 0.6, 0.8], [0.0, -0.6, 0.8], [0.1, 0.0, 1.0]]);
/// assert_eq!(axis, [0.0, 0.0, 1.0]);
/// assert!((half_angle - 0.6f32.asin()).abs() < 1e-6);
/// ```
#[must_use]
pub fn smallest_cap<V: Copy + Into<[f32; 3]>>(vectors: &[V]) -> ([f32; 3], f32) {
    let usable = || {
        let all = vectors.iter().map(|v| Vec3::from_array((*v).into()));
        all.filter(|v| is_usable(l1_norm(*v)))
    };
    let Some(first) = usable().next().and_then(|v| unit(v.to_array().map(f64::from))) else {
        return ([0.0, 0.0, 1.0], 0.0);
    };
    let mut cap = Held { axis: first, chord: 0.0, by: [first; 3], count: 1 };
    for _ in 0..PASSES {
        let points = usable().filter_map(|v| unit(v.to_array().map(f64::from)));
        let farther = |a: Point, b: Point| if square(b, cap.axis) > square(a, cap.axis) { b } else { a };
        let farthest = points.fold(first, farther);
        let grown = if holds(cap.axis, cap.chord, farthest) { None } else { grown(&cap, farthest) };
        let Some(grown) = grown else { break };
        cap = grown;
    }
    let axis = unit_axis(Vec3::from_array(cap.axis.map(|c| c as f32)));
    let most = usable().fold(0f64, |most, v| most.max(angle_deg(axis, v)));
    (axis.to_array(), most.to_radians() as f32 * (1.0 + f32::EPSILON))
}

/// The smallest cap of `point`, outside of `cap`, and the directions that hold it. None where these are in no
/// hemisphere.
fn grown(cap: &Held, point: Point) -> Option<Held> {
    let mut all = [point; 4];
    all[..cap.count].copy_from_slice(&cap.by[..cap.count]);
    let all = &all[..=cap.count];
    let mut best: Option<Held> = None;
    let mut offer = |axis: Option<Point>, by: [Point; 3], count: usize| {
        let Some(axis) = axis else { return };
        let chord = square(axis, by[0]);
        let is_better = best.is_none_or(|best| chord < best.chord);
        if is_better && all.iter().all(|p| holds(axis, chord, *p)) {
            best = Some(Held { axis, chord, by, count });
        }
    };
    for (i, a) in all.iter().enumerate() {
        for (j, b) in all.iter().enumerate().skip(i + 1) {
            offer(unit(sum(*a, *b)), [*a, *b, *b], 2);
            for c in &all[j + 1..] {
                let normal = cross(difference(*b, *a), difference(*c, *a));
                let side = if dot(normal, *a) < 0.0 { -1.0 } else { 1.0 };
                offer(unit(normal.map(|x| side * x)), [*a, *b, *c], 3);
            }
        }
    }
    best
}

fn holds(axis: Point, chord: f64, p: Point) -> bool {
    // The square of the chord and the slack.
    let reach = f64::from(crate::arith::root(chord as f32));
    square(axis, p) <= chord + SLACK * (2.0 * reach + SLACK)
}

/// The point at unit length, none without a direction. The root is that of `f32`, and two steps of Newton's method.
fn unit(p: Point) -> Option<Point> {
    let most = p.iter().fold(0f64, |most, c| most.max(c.abs()));
    let p = p.map(|c| c / most);
    let square = dot(p, p);
    let start = f64::from(crate::arith::inverse_root(square as f32));
    let inverse = (0..2).fold(start, |y, _| y * (1.5 - 0.5 * square * y * y));
    (most > 0.0).then(|| p.map(|c| c * inverse))
}

fn sum(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The square of the chord.
fn square(a: Point, b: Point) -> f64 {
    let off = difference(a, b);
    dot(off, off)
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
