//! The search for the nearest point of an octahedral lattice, whether or not it has one in the middle of the square.

use crate::arith::{dot, floor, is_negative, max, negate_if, over};
use glam::{Vec2, Vec3};

/// A point of the lattice, and the square of the tangent of its angle from the direction sought, as a fraction.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) at: Vec2,
    pub(super) across: f32,
    pub(super) along: f32,
}

impl Corner {
    /// The point `at`, which lies on the octahedron at `p + d`, from `square` = `d . d` and `part` = `d . p`.
    ///
    /// With `length` = `p . p`, the squares of `|c x p|` and `c . p` are `square length - part^2` and `(length + part)^2`. The
    /// octahedron's faces are so far from edge on that the difference keeps its digits: it is a third of the product at
    /// least.
    #[inline(always)]
    pub(super) fn beside(at: Vec2, square: f32, part: f32, length: f32) -> Self {
        let along = length + part;
        Self { at, across: square * length - part * part, along: along * along }
    }

    /// `other` where it is nearer, else `self`.
    #[inline(always)]
    pub(super) fn or_nearer(self, other: Self) -> Self {
        if other.across * self.along < self.across * other.along { other } else { self }
    }
}

/// The lattice point that is nearest in angle to the direction of `v`, of the L1 norm `norm`, on the square `[-m, m]^2`
/// with points at steps of 1 from -m to m: whole numbers where `half` is 0, odd multiples of 1/2 where it is 1/2. `m` is 1 to
/// 2^15. Unspecified without a usable direction.
///
/// By symmetry x and y are not negative; nor are -0 and denormals, since there may be no point between the signs. On the
/// unfolded faces the lattice goes on across z = 0, and the right and the upper corner of a cell are the closest to each other,
/// so that they divide it into two triangles, none of them obtuse: the nearest point is a corner of the triangle. A cell that
/// x = 0 or y = 0 cuts is left of its mirror image: points there are nearer to the corners that both share with the next cell.
/// On the square's border the cell beyond it has two corners that are none, and farther than the others.
#[inline(always)]
pub fn nearest(v: Vec3, norm: f32, m: f32, half: f32) -> Vec2 {
    let scale = over(m, norm);
    let p = Vec3::new(v.x.abs() * scale, v.y.abs() * scale, v.z * scale);
    let below = max(-p.z, 0.0);
    let (x, y) = (p.x + below, p.y + below);
    let low = Vec2::new(max(floor(x - half) + half, half), max(floor(y - half) + half, half));
    let depth = m - low.x - low.y;
    let length = dot(p, p);

    // The right and the upper corner lie in one face, and differ from a common point by 1 in x, and in y.
    let folded = max(1.0 - depth, 0.0);
    let d = Vec3::new(low.x - folded - p.x, low.y - folded - p.y, depth - 1.0 - p.z);
    let (square, part) = (dot(d, d), dot(d, p));
    let right = Vec2::new(low.x + 1.0, low.y);
    let right = Corner::beside(right, square + (2.0 * d.x + 1.0), part + p.x, length);
    let up = Vec2::new(low.x, low.y + 1.0);
    let up = Corner::beside(up, square + (2.0 * d.y + 1.0), part + p.y, length);

    // The lower or the upper corner differs by 1 in z, and where the edge z = 0 lies between by a part of a fold.
    let is_far = x + y >= low.x + low.y + 1.0;
    let (step, z) = if is_far { (1.0, -1.0) } else { (0.0, 1.0) };
    let moved = (step + folded) - max((step + step) - depth, 0.0);
    let square = square + 2.0 * ((moved * (d.x + d.y) + moved * moved) + z * d.z) + 1.0;
    let part = part + moved * (p.x + p.y) + z * p.z;
    let at = Vec2::new(low.x + step, low.y + step);
    let at = Corner::beside(at, square, part, length).or_nearer(right).or_nearer(up).at;
    Vec2::new(negate_if(is_negative(v.x), at.x), negate_if(is_negative(v.y), at.y))
}
