//! The sphere with unequal precision: more codes in front of an axis than behind.
//!
//! Source: the question is P.-P. Sloan's, in section 5 of the survey. The map and the bounds are ours.
//!
//! The half of the sphere around the axis gets r times as many codes as the other. Each half is a cap of 90 degrees,
//! mapped with equal areas as in [`cap`](super::cap): `1 - cos` of the angle from its own pole is scaled by `2 r / (r +
//! 1)` in front and `2 / (r + 1)` behind. The halves meet without a gap, at the direction's azimuth and `cos b = (1 -
//! r) / (1 + r)` of the codec's sphere.
//!
//! Lengths along the radius and across it, in parts of those on the codec's sphere:
//!
//! | | at the pole | at the border, across | at the border, along |
//! |---|---|---|---|
//! | front | `sqrt((r + 1) / 2r)` | `(r + 1) / (2 sqrt r)` | `1 / sqrt r` |
//! | behind | `sqrt((r + 1) / 2)` | `(r + 1) / (2 sqrt r)` | `sqrt r` |
//!
//! * Error, with e that of the codec: at most `sqrt(r) e` anywhere. In front, farther from the border than that bound
//!   itself, at most `(r + 1) / (2 sqrt r) e`: 1.25 e for r = 4. So the mean in front falls with r, and **the maximum
//!   in front does not**: it grows, since all that the border's circle loses in length it gains in width. No map that
//!   is symmetric about an axis can have less there with these shares of the codes, as the border must keep its place.
//! * The trade, in degrees; r = 2 has the better half of the gain over a half's directions, and above 8 the front gains
//!   nothing there. Most normals that a camera sees face it, where the gain is greatest: see [`DEFAULT_RATIO`].
//!
//! | codec | r | mean in front | behind | largest in front | behind |
//! |---|---|---|---|---|---|
//! | `oct16p` | 1 | 0.3146 | 0.3150 | 0.635 | 0.635 |
//! | `oct16p` | 2 | 0.2687 | 0.4032 | 0.797 | 0.846 |
//! | `oct16p` | 4 | 0.2550 | 0.5094 | 1.13 | 1.26 |
//! | `oct16p` | 6 | 0.2528 | 0.5801 | 1.42 | 1.51 |
//! | `oct16p` | 8 | 0.2526 | 0.6358 | 1.61 | 1.68 |
//! | `oct16p` | 16 | 0.2545 | 0.7952 | 1.85 | 2.10 |
//! | `oct16p` | - | 0.3146 | 0.3150 | 0.635 | 0.635 |
//!
//! * A codec of the hemisphere is better in front than any of these, 0.239 and 0.550 for `hemioct16p`, and a bit for
//!   the half, as in `soct17`, has that everywhere. So take this where the back must decode, and neither a bit nor a
//!   choice is to be had.
//! * Layout: the codec's own; all codes are used. The axis and its opposite come back exactly where the codec keeps +Z
//!   and -Z. Bad input: as with [`Cap`](super::Cap).

use super::about::{About, bound_deg, lifted, unit_axis};
use crate::arith::{is_nan, max, min, over, quotient, root};
use crate::codec::Domain;
use crate::frame::basis;
use crate::list::Listed;
use core::marker::PhantomData;
use glam::Vec3;

/// The ratio for normals of what a camera sees, with the axis towards it: of rendered views `oct16p` has 0.71 of the mean
/// error that it has without a density, and less error in all but a thousandth of the pixels. Greater ratios lower the mean
/// by a tenth at most, and make the errors at silhouettes greater than without one.
pub const DEFAULT_RATIO: f32 = 6.0;

/// The largest ratio of codes in front to codes behind.
pub const MAX_RATIO: f32 = 64.0;

/// The codec `C` of the sphere, with more codes for the half in front of an axis than for the other: see the
/// [module](self). Axis and ratio are values, which the decoder needs too.
///
/// ```
/// use unitvec::wrap::{Dense, dense::DEFAULT_RATIO};
/// use unitvec::OctPrecise16;
///
/// let dense = Dense::<OctPrecise16>::new([0.0, 0.0, 1.0], DEFAULT_RATIO);
/// assert_eq!(dense.decode::<[f32; 3]>(dense.encode([0.0, 0.0, -2.0])), [0.0, 0.0, -1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dense<C> {
    axis: Vec3,
    /// `2 / (r + 1)`: what `1 - cos` from the axis's opposite is scaled by.
    behind: f32,
    codec: PhantomData<C>,
}

impl<C: Listed> Dense<C> {
    /// The half in front of `axis`, of any length, with `ratio` times as many codes as the other; +Z stands in for an
    /// axis that has no usable direction. The ratio is clamped to 1, which is the codec itself, and [`MAX_RATIO`]; NaN
    /// counts as 1.
    #[must_use]
    pub fn new(axis: impl Into<[f32; 3]>, ratio: f32) -> Self {
        const {
            assert!(
                C::IS_UNIT && matches!(C::DOMAIN, Domain::Sphere),
                "a codec of the sphere, of unit vectors"
            )
        };
        let ratio = if is_nan(ratio) { 1.0 } else { min(max(ratio, 1.0), MAX_RATIO) };
        let behind = over(2.0, ratio + 1.0);
        Self { axis: unit_axis(Vec3::from_array(axis.into())), behind, codec: PhantomData }
    }

    /// The value as the functions of GLSL take it: the axis, and `2 / (r + 1)`.
    #[must_use]
    pub fn to_array(self) -> [f32; 4] {
        [self.axis.x, self.axis.y, self.axis.z, self.behind]
    }

    /// The code of the direction of `v`; of the axis where it has no usable direction.
    #[must_use]
    #[inline(always)]
    pub fn encode<V: Into<[f32; 3]>>(self, v: V) -> C::Code {
        C::encode_vec3(self.image(Vec3::from_array(v.into())))
    }

    /// The direction that `code` stands for, of unit length to within 2 ULP. Any bit pattern is valid.
    #[must_use]
    #[inline(always)]
    pub fn decode<V: From<[f32; 3]>>(self, code: C::Code) -> V {
        self.of_image(C::decode_vec3(code)).to_array().into()
    }

    /// Where the map takes the direction of `v`: a vector for the codec to encode, of about unit length.
    #[must_use]
    #[inline(always)]
    pub fn image(self, v: Vec3) -> Vec3 {
        let at = About::axis(self.axis, v);
        let k = if at.behind { self.behind } else { 2.0 - self.behind };
        let across = root(quotient(k * (2.0 - k * at.near), at.far));
        let z = 1.0 - k * at.near;
        Vec3::new(at.x * across, at.y * across, if at.behind { -z } else { z })
    }

    /// The direction that the map takes to the unit vector `u`. The inverse of [`image`](Self::image).
    #[must_use]
    #[inline(always)]
    pub fn of_image(self, u: Vec3) -> Vec3 {
        let at = About::z(u);
        let (front, (h, rest)) = (2.0 - self.behind, at.parts());
        let is_front = h <= front;
        let (k, h, rest) = if is_front { (front, h, rest) } else { (self.behind, rest, h) };
        let h = min(quotient(h, k), 1.0);
        let across = root(quotient(2.0 - h, k * rest));
        let axis = if is_front { self.axis } else { -self.axis };
        lifted(axis, basis(self.axis), at.x * across, at.y * across, h)
    }

    /// An upper bound of the angle, in degrees, between any direction and its decoded code: `sqrt(r)` times the
    /// codec's, and 2^-22 radians for `f32` before the map and after.
    #[must_use]
    pub fn max_error_deg(self) -> f32 {
        let ratio = quotient(2.0 - self.behind, self.behind);
        bound_deg(C::MAX_ERROR_DEG, root(ratio))
    }

    /// The same bound for directions at more than this angle from the border, in front: with `(r + 1) / (2 sqrt r)`.
    #[must_use]
    pub fn max_front_error_deg(self) -> f32 {
        let across = root((2.0 - self.behind) * self.behind);
        bound_deg(C::MAX_ERROR_DEG, over(1.0, across))
    }
}
