//! Lengths tried one after the other.

use crate::arith::{exp2, floor, is_negative, max, min, negate_if, quotient, signed_code};
use glam::Vec3;

/// Lengths that a scan tries, from the longest down.
pub(super) const SCANNED: f32 = 64.0;

/// Directions whose least component is a larger part of the largest one are near the middle of an octant.
const MIDDLE_OF_OCTANT: f32 = 0.75;

/// Components that are a smaller part of the largest one count as 0: 2^-24. No length of these formats tells them from
/// 0, and a denormal component of a vector with a direction is always less.
pub(super) const LEAST_PART: f32 = exp2(-24);

/// The magnitudes of a vector's components by size, as parts of the largest one, which is 1.
#[derive(Clone, Copy)]
pub(super) struct Parts {
    pub(super) mid: f32,
    pub(super) min: f32,
}

/// `a / max`, or 0 where that is too small to matter.
#[inline(always)]
fn part(a: f32, max: f32) -> f32 {
    let part = quotient(a, max);
    if part < LEAST_PART { 0.0 } else { part }
}

/// The magnitudes of the components of `v`, which has a direction, over that of the largest one.
#[inline(always)]
pub(super) fn on_cube(v: Vec3) -> Vec3 {
    let a = v.abs();
    let max = max(max(a.x, a.y), a.z);
    Vec3::new(part(a.x, max), part(a.y, max), part(a.z, max))
}

#[inline(always)]
pub(super) fn by_size(u: Vec3) -> Parts {
    let (low, high) = (min(u.x, u.y), max(u.x, u.y));
    Parts { mid: max(low, min(high, u.z)), min: min(low, u.z) }
}

/// A candidate: the scale of `u` whose rounding it is, and the squared sine of its angle to `u`, up to a factor, as a
/// fraction.
#[derive(Clone, Copy)]
pub(super) struct Fit {
    pub(super) scale: f32,
    numerator: f32,
    denominator: f32,
}

impl Fit {
    /// The vector whose largest component is `k`, a whole number.
    ///
    /// It is off by `d = (0, dy, dz)`, and its angle to `u` has the sine `|d x u| / (|q| |u|)`.
    #[inline(always)]
    pub(super) fn of_length(u: Parts, k: f32) -> Self {
        let (y, z) = (u.mid * k, u.min * k);
        let (qy, qz) = (floor(y + 0.5), floor(z + 0.5));
        let (dy, dz) = (qy - y, qz - z);
        let cx = dy * u.min - dz * u.mid;
        Self { scale: k, numerator: (cx * cx + dy * dy) + dz * dz, denominator: (k * k + qy * qy) + qz * qz }
    }

    /// The vector `u` times `scale`, rounded; any scale.
    #[inline(always)]
    pub(super) fn of_scale(u: Parts, scale: f32) -> Self {
        let (y, z) = (u.mid * scale, u.min * scale);
        let (qx, qy, qz) = (floor(scale + 0.5), floor(y + 0.5), floor(z + 0.5));
        let (dx, dy, dz) = (qx - scale, qy - y, qz - z);
        let (cx, cy, cz) = (dy * u.min - dz * u.mid, dz - dx * u.min, dx * u.mid - dy);
        Self { scale, numerator: (cx * cx + cy * cy) + cz * cz, denominator: (qx * qx + qy * qy) + qz * qz }
    }

    /// `other` where it points nearer to `u`, else `self`.
    #[inline(always)]
    fn or_nearer(self, other: Self) -> Self {
        if other.numerator * self.denominator < self.numerator * other.denominator { other } else { self }
    }

    /// The best of `self` and the 64 lengths from `longest` down; of equals the first.
    #[inline(always)]
    pub(super) fn or_scanned(self, u: Parts, longest: f32) -> Self {
        let mut best = self;
        let mut k = longest;
        while k > longest - SCANNED {
            best = best.or_nearer(Self::of_length(u, k));
            k -= 1.0;
        }
        best
    }
}

/// The scale that fits best of all, up to 127.25.
///
/// The rounding at a length is the nearest in its plane, which need not be the nearest in angle, least so near the
/// middle of an octant, to which the planes lie aslant. Scales between whole numbers find the nearer vectors.
#[inline(always)]
pub(super) fn best_scale(u: Parts) -> f32 {
    let mut best = Fit::of_length(u, 127.0).or_scanned(u, 127.0);
    let end = if u.min > MIDDLE_OF_OCTANT { 111.5 } else { 123.5 };
    let mut scale = 127.25;
    while scale > end {
        best = best.or_nearer(Fit::of_scale(u, scale));
        scale -= 0.5;
    }
    best.scale
}

/// The whole vector of a scale: magnitudes rounded, with the signs of `v`.
#[inline(always)]
pub(super) fn at_scale(v: Vec3, u: Vec3, scale: f32) -> Vec3 {
    Vec3::new(
        negate_if(is_negative(v.x), floor(u.x * scale + 0.5)),
        negate_if(is_negative(v.y), floor(u.y * scale + 0.5)),
        negate_if(is_negative(v.z), floor(u.z * scale + 0.5)),
    )
}

/// Whole vectors of components from -127 to 127 to 24 bits.
#[inline(always)]
pub(super) fn pack8(q: Vec3) -> u32 {
    signed_code(q.x, 8) | (signed_code(q.y, 8) << 8) | (signed_code(q.z, 8) << 16)
}
