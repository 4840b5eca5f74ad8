//! Unit quaternions and vectors in float64, and the points of a lattice around them.

use crate::arith::mask;

/// The quaternion of unit length.
pub(super) fn unit(q: [f32; 4]) -> [f64; 4] {
    let q = q.map(f64::from);
    q.map(|c| c / length(q))
}

/// The quaternion as it is, for originals that take it for one of unit length; others are made such, in f32.
pub(super) fn given(q: [f32; 4]) -> [f64; 4] {
    let wide = q.map(f64::from);
    if (length(wide) - 1.0).abs() <= 1e-3 { wide } else { unit(q).map(|c| f64::from(c as f32)) }
}

/// The squared sine of the angle between two vectors or quaternions, and its cosine, times their lengths squared.
#[inline(always)]
pub(super) fn parts<const N: usize>(a: [f64; N], b: [f64; N]) -> (f64, f64) {
    let (mut across, mut along) = (0.0, 0.0);
    for i in 0..N {
        for j in i + 1..N {
            let area = a[i] * b[j] - a[j] * b[i];
            across += area * area;
        }
        along += a[i] * b[i];
    }
    (across, along)
}

/// The tangent of the angle between two quaternions up to their signs: not less than the distance of unit quaternions.
pub(super) fn distance(a: [f64; 4], b: [f32; 4]) -> f64 {
    let (across, along) = parts(a, b.map(f64::from));
    if along == 0.0 { f64::INFINITY } else { across.sqrt() / along.abs() }
}

/// The points whose components are whole numbers of these ranges.
pub(super) fn points<const N: usize>(ranges: [[f64; 2]; N]) -> impl Iterator<Item = [i32; N]> {
    let ranges = ranges.map(|[from, to]| [from.ceil() as i32, to.floor() as i32]);
    let first = ranges.iter().all(|[from, to]| from <= to).then_some(ranges.map(|[from, _]| from));
    core::iter::successors(first, move |point| {
        let mut point = *point;
        for (number, [from, to]) in point.iter_mut().zip(ranges) {
            if *number < to {
                *number += 1;
                return Some(point);
            }
            *number = from;
        }
        None
    })
}

pub(super) fn length<const N: usize>(q: [f64; N]) -> f64 {
    q.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The place of the largest magnitude, the first of equals in this order.
pub(super) fn largest<const N: usize>(q: [f64; N], order: &[usize]) -> usize {
    order.iter().copied().reduce(|a, b| if q[b].abs() > q[a].abs() { b } else { a }).unwrap_or(N - 1)
}

/// The largest signed number.
pub(super) fn largest_number(bits: u32) -> f64 {
    f64::from(mask(bits - 1))
}
