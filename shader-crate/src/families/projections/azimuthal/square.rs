//! The disk on the square.

use super::Lattice;
use super::disk::Disk;
#[cfg(doc)]
use super::disk::Projection;
use crate::arith::{
    atan_octant_ratio, inverse_root, min, quotient, root, signed_quotient, sin_cos_half_turns,
};
#[cfg(doc)]
use crate::codec::Codec;
use core::fmt::Debug;
use core::hash::Hash;
use glam::Vec2;

/// A way to lay the disk on the square, on the quadrant of positive coordinates.
pub trait SquareMap: Copy + Debug + Default + Eq + Hash + Send + Sync + 'static {
    /// Number of the map: 0, 1, 2.
    const INDEX: u32;

    /// The K of [`Codec::MAX_ERROR_DEG`] with each projection, by [`Projection::INDEX`]: the greatest length of
    /// `k a/2 + b/2` and `k a/2 - b/2`, where a and b are the derivatives of the direction by u and v, and k, at
    /// most 64/127, is u's step over v's. Rounded up.
    const STRETCH: [f32; 3];

    /// The point on the square of a disk point.
    fn to_square(disk: Disk) -> Vec2;

    /// The lattice point to write where rounding gave `e`.
    #[inline(always)]
    fn settle(e: Vec2, _: Lattice) -> Vec2 {
        e
    }

    /// The disk point of a lattice point.
    #[inline(always)]
    fn to_disk(e: Vec2, lattice: Lattice) -> Disk {
        Self::square_to_disk(lattice.parts(e))
    }

    /// The disk point of a point on the square, the inverse of [`to_square`](Self::to_square).
    fn square_to_disk(s: Vec2) -> Disk;
}

/// No map: the disk lies in the square, whose corners, a part of `1 - pi/4`, are spare.
///
/// Rounding takes points near the rim to lattice points beyond it. Such a point stands for a point of the rim: it is
/// moved to the rim along the coordinate in which a step counts for more, or, where that takes more than half a step,
/// along the other one for the rest. So it stays in its cell, and rounding takes it back to the same lattice point. As
/// the rim's slope is taken as constant, the point comes to lie outside by up to 2^-7 of a step, and the projections
/// make it a direction on the equator.
///
/// A lattice point is remote where the disk covers nothing of its cell, or only the last 64th of a step at the
/// corner that points to the middle. Remote ones are never written, so that whatever is written comes back: where
/// rounding gives one, which takes a position in that last 64th, the next point inward is written. Remote codes
/// decode to +-X or +-Y, whichever is nearer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Plain;

/// The most that points beyond the rim are moved, in steps: a 64th less than half a step, which is twice what the
/// rounding of a position in `f32` comes to at 32 bits.
pub const REACH: f32 = 0.484375;

impl SquareMap for Plain {
    const INDEX: u32 = 0;
    const STRETCH: [f32; 3] = [1.12, 1.1549, 0.9071];

    #[inline(always)]
    fn to_square(disk: Disk) -> Vec2 {
        disk.point
    }

    #[inline(always)]
    fn settle(e: Vec2, lattice: Lattice) -> Vec2 {
        let slope = lattice.over_largest(lattice.parts(e));
        let (along_u, remote) = (slope.x > slope.y, is_remote(e, lattice));
        let less = |moves| if moves { 1.0 } else { 0.0 };
        Vec2::new(e.x - less(remote & along_u), e.y - less(remote & !along_u))
    }

    #[inline(always)]
    fn to_disk(e: Vec2, lattice: Lattice) -> Disk {
        let p = lattice.parts(e);
        let rim = 1.0 - (p.x * p.x + p.y * p.y);
        let onto_rim = move_to_rim(p, -0.5 * rim, lattice);
        let axis = if p.x > p.y { Vec2::X } else { Vec2::Y };
        let point = if is_remote(e, lattice) { axis } else { onto_rim };
        let rest = 1.0 - (point.x * point.x + point.y * point.y);
        Disk { point, radius: 0.0, rim: if rim > 0.0 { rest } else { min(rest, 0.0) } }
    }

    #[inline(always)]
    fn square_to_disk(s: Vec2) -> Disk {
        let square = s.x * s.x + s.y * s.y;
        let inward = inverse_root(square);
        if square < 1.0 {
            Disk { point: s, radius: 0.0, rim: 1.0 - square }
        } else {
            Disk { point: s * inward, radius: 0.0, rim: 0.0 }
        }
    }
}

/// True for lattice points with cells of which the disk covers nothing, or next to nothing.
#[inline(always)]
fn is_remote(e: Vec2, lattice: Lattice) -> bool {
    let corner = lattice.parts(e - REACH);
    corner.x * corner.x + corner.y * corner.y > 1.0
}

/// `a / b` of each component.
#[inline(always)]
fn over_each(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(signed_quotient(a.x, b.x), signed_quotient(a.y, b.y))
}

/// The point on the rim for a point `p` beyond it, where `excess` is `(|p|^2 - 1) / 2`; other points stay.
#[inline(always)]
fn move_to_rim(p: Vec2, excess: f32, lattice: Lattice) -> Vec2 {
    // The decrease of the excess by one step on each axis.
    let slope = lattice.over_largest(p);
    let along_u = slope.x > slope.y;
    let (steep, gentle) = if along_u { (slope.x, slope.y) } else { (slope.y, slope.x) };
    let alone = signed_quotient(excess, steep);
    let remainder = signed_quotient(excess - REACH * steep, gentle);
    let beyond = excess >= 0.0;
    let first = if beyond { min(alone, REACH) } else { 0.0 };
    let second = if beyond & (alone >= REACH) { remainder } else { 0.0 };
    p - lattice.over_largest(if along_u { Vec2::new(first, second) } else { Vec2::new(second, first) })
}

/// Shirley and Chiu's concentric map: keeps relative areas; circles become squares. It creases at the diagonals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Concentric;

impl SquareMap for Concentric {
    const INDEX: u32 = 1;
    const STRETCH: [f32; 3] = [1.5478, 1.162, 1.2157];

    #[inline(always)]
    fn to_square(disk: Disk) -> Vec2 {
        let p = disk.point;
        let steep = p.y > p.x;
        let (shorter, longer) = if steep { (p.x, p.y) } else { (p.y, p.x) };
        let across = disk.radius * atan_octant_ratio(shorter, longer);
        if steep { Vec2::new(across, disk.radius) } else { Vec2::new(disk.radius, across) }
    }

    #[inline(always)]
    fn square_to_disk(s: Vec2) -> Disk {
        let steep = s.y > s.x;
        let (shorter, radius) = if steep { (s.x, s.y) } else { (s.y, s.x) };
        let ratio = quotient(shorter, radius);
        let octant = if radius > 0.0 { ratio } else { 0.0 };
        let turn = sin_cos_half_turns(0.25 * octant);
        let (across, along) = (radius * turn.y, radius * turn.x);
        let point = if steep { Vec2::new(across, along) } else { Vec2::new(along, across) };
        Disk { point, radius, rim: 1.0 - radius * radius }
    }
}

/// The elliptical grid map: lines of the square become ellipses. Smooth but for the corners.
///
/// From square (s, t) to disk (x, y): `x = s sqrt(1 - t^2/2)`, `y = t sqrt(1 - s^2/2)`. Then `1 - x^2 - y^2 = (1
/// - s^2)(1 - t^2)`.
///
/// Back: with `d = x^2 - y^2 = s^2 - t^2` the first equation is a quadratic one of s^2, the solution of which is
/// `s^2 = 4 x^2 / (2 + d + root)` where `root^2 = (2 + d)^2 - 8 x^2 = d^2 + 4 rim`; and `t^2 = 4 y^2 / (2 - d +
/// root)`. Only sums of positive terms occur, and `d`, which the root passes on at most as it is: so if `rim` has
/// a small relative error the result has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Ellipse;

impl SquareMap for Ellipse {
    const INDEX: u32 = 2;
    const STRETCH: [f32; 3] = [1.12, 1.022, 0.8796];

    #[inline(always)]
    fn to_square(disk: Disk) -> Vec2 {
        let p = disk.point;
        let difference = (p.x - p.y) * (p.x + p.y);
        let sum = 2.0 + root(difference * difference + 4.0 * disk.rim);
        over_each(2.0 * p, Vec2::new(root(sum + difference), root(sum - difference)))
    }

    #[inline(always)]
    fn square_to_disk(s: Vec2) -> Disk {
        let point = Vec2::new(s.x * root(1.0 - 0.5 * s.y * s.y), s.y * root(1.0 - 0.5 * s.x * s.x));
        // (1 - s^2) (1 - t^2), with one rounding less near the middle.
        let factor = 1.0 - s.x * s.x;
        Disk { point, radius: 0.0, rim: factor - factor * (s.y * s.y) }
    }
}
