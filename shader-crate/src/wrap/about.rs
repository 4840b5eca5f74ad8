//! Directions in the frame of an axis, by `1 - cos` of their angle from it: what [`Cap`](super::Cap) and
//! [`Dense`](super::Dense) share.

use crate::arith::{dot, exp2, is_negative, max, min, normalize, quotient, scaled_to_one, without_denormals};
use crate::direction::{is_usable, l1_norm};
use crate::frame::basis;
use glam::Vec3;

/// The least that `x^2 + y^2` counts as: 2^-80, of an angle of 2^-40. So no denormal counts, and nothing is divided by
/// 0.
const LEAST_SQUARE: f32 = exp2(-80);

/// A direction by its place about an axis.
///
/// `1 - cos` of a small angle cancels; `sin^2 / (1 + cos)` does not. So of `1 + cos` and `1 - cos` the larger is a sum,
/// and the smaller the quotient.
#[derive(Clone, Copy)]
pub(super) struct About {
    /// The components along the two vectors of the axis's basis.
    pub(super) x: f32,
    pub(super) y: f32,
    /// `x^2 + y^2`, at least [`LEAST_SQUARE`].
    pub(super) square: f32,
    /// `1 - |cos|`.
    pub(super) near: f32,
    /// `1 + |cos|`.
    pub(super) far: f32,
    /// True beyond 90 degrees from the axis.
    pub(super) behind: bool,
}

impl About {
    /// The place of a unit vector of these components, the last along the axis.
    #[inline(always)]
    fn new(x: f32, y: f32, z: f32) -> Self {
        let far = 1.0 + min(z.abs(), 1.0);
        let square = max(x * x + y * y, LEAST_SQUARE);
        Self { x, y, square, near: quotient(square, far), far, behind: is_negative(z) }
    }

    /// The place of the direction of `v` about a unit axis; that of the axis where `v` has no usable direction.
    ///
    /// The basis takes the difference of `v` and the axis, or its opposite: its components are exact beside their size,
    /// and so a small angle is.
    #[inline(always)]
    pub(super) fn axis(axis: Vec3, v: Vec3) -> Self {
        let n = unit_or(v, axis);
        let z = dot(n, axis);
        let off = if is_negative(z) { n + axis } else { n - axis };
        let (first, second) = basis(axis);
        Self::new(dot(off, first), dot(off, second), z)
    }

    /// The place of a codec's unit vector about +Z.
    #[inline(always)]
    pub(super) fn z(u: Vec3) -> Self {
        Self::new(u.x, u.y, u.z)
    }

    /// `1 - cos` and `1 + cos`.
    #[inline(always)]
    pub(super) fn parts(self) -> (f32, f32) {
        if self.behind { (self.far, self.near) } else { (self.near, self.far) }
    }

    /// `2 - k (1 - cos)`, exact beside its size for a `k` of 1 too.
    #[inline(always)]
    pub(super) fn rest(self, k: f32) -> f32 {
        if self.behind { 2.0 * (1.0 - k) + k * self.near } else { 2.0 - k * self.near }
    }

    /// (x, y) and the square of its length, (1, 0) where that has no direction.
    #[inline(always)]
    pub(super) fn azimuth(self) -> (f32, f32, f32) {
        if self.square > LEAST_SQUARE { (self.x, self.y, self.square) } else { (1.0, 0.0, 1.0) }
    }
}

/// The unit vector of components x and y along the basis of a unit axis, and `1 - h` along `axis`, which is that axis
/// or its opposite; `axis` itself for an x and y of 0.
#[inline(always)]
pub(super) fn lifted(axis: Vec3, basis: (Vec3, Vec3), x: f32, y: f32, h: f32) -> Vec3 {
    let v = axis + ((basis.0 * x + basis.1 * y) - axis * h);
    let pole = if h > 1.0 { -axis } else { axis };
    without_denormals(if (x == 0.0) & (y == 0.0) { pole } else { normalize(v) })
}

/// The direction of `v` at unit length, no component of it denormal or -0; +Z where it has none.
#[inline(always)]
pub(super) fn unit_axis(v: Vec3) -> Vec3 {
    without_denormals(unit_or(v, Vec3::Z))
}

/// `v` at unit length, or `other` where it has no usable direction.
#[inline(always)]
fn unit_or(v: Vec3, other: Vec3) -> Vec3 {
    let norm = l1_norm(v);
    if is_usable(norm) { normalize(scaled_to_one(v, norm)) } else { other }
}

/// The bound of a wrapped codec's error, in degrees: the codec's, times the most that the map lengthens, and 2^-22 radians for
/// `f32` before the map and after.
pub(super) fn bound_deg(codec_deg: f32, most: f32) -> f32 {
    let rounding = exp2(-22).to_degrees();
    (codec_deg + rounding) * most + rounding
}
