//! Caps: the directions within an angle of an axis, in all codes of a codec.
//!
//! Source: Lambert's azimuthal equal-area map; the choice of what a cap fills, and the bounds, are ours.
//!
//! In the frame of the axis, with a the cap's half-angle and `h = 1 - cos` of a direction's angle from the axis, the
//! map keeps the azimuth and scales h by `k = (1 - cos b) / (1 - cos a)`: the cap fills the cap of half-angle b about
//! +Z, which the codec then encodes. Equal areas stay equal. Lengths across the radius become `g = sqrt(k (2 - k h) /
//! (2 - h))` times as large, along it `k / g` times. So an error shrinks by `sqrt(k)` at the axis, and less across the
//! radius at the rim: there it counts `sin a / sin b` times.
//!
//! * A codec of the hemisphere is filled whole: `b` = 90 degrees. Its error counts `sqrt(1 - cos a)` times at the axis
//!   and at most `sin a` times, up to 90 degrees, beyond `tan(a / 2)` times. **Take one of these**: of equal bits it is
//!   a sphere's codec with half the area to cover, and at the rim no more than `sqrt(2)` from the mean.
//! * A codec of the sphere is filled to `b` = 120 degrees, three quarters of its codes: `sqrt(1 - cos a) / sqrt(1.5)`
//!   at the axis, and at most `sin a / sin 120°` times (beyond the rim by the codec's own error e: `sin(120° + e)`). To
//!   fill it whole, as the formula `sqrt((1 - cos a) / 2)` has it, does not work: all of the rim is then the point -Z,
//!   next to which a code says nothing about the azimuth. The largest error is the cap's width, and the mean of the
//!   error's square grows without bound as codes get finer. In small caps this mean is least for b of 120 to 135
//!   degrees.
//!
//! Frames: the axis is normalised, and [`frame::basis`](crate::frame::basis) gives the other two vectors. Both sides
//! must have the axis and half-angle to the bit.
//!
//! * Layout: the codec's own. Codes that lie beyond the rim, a quarter of the codes of a sphere's codec, are not
//!   written, and decode to the rim. So a decoded vector never lies outside of the cap but for the rounding of `f32`.
//! * Directions outside of the cap get the code of the nearest direction of the rim; the opposite of the axis that of
//!   the side of the basis's first vector.
//! * Error: the above, and 2^-22 radians for `f32`, which is what vectors of `f32` resolve: with 32 bits it counts in
//!   caps of a few degrees. The axis comes back exactly where the codec keeps +Z.
//! * Stable, but for codes beyond the rim, where a step of the code is far above this rounding: at 16 bits in caps of
//!   0.1 degrees and more, at 32 bits of 10.
//! * Seams: caps share no code and no lattice. A direction in two caps decodes to two vectors, which differ by up to
//!   the sum of both errors; along a border lit by neighbouring meshlets this is a crease of that size. So where
//!   vertices are shared, give both sides one cap, or one code of the whole sphere; or encode the border's vectors once
//!   and move the copy to what it decodes to, in the same cap. Overlapping caps do not help. Nothing is lost inside of
//!   a cap.
//! * Good for: normals of meshlets, light cones, fur, fibres. Weakness: a root and a quotient each way, and an axis and
//!   an angle to store or know.

use super::about::{About, bound_deg, lifted, unit_axis};
use crate::arith::{exp2, is_nan, max, min, quotient, root, sin};
use crate::codec::Domain;
use crate::frame::basis;
use crate::list::Listed;
use core::f32::consts::PI;
use core::marker::PhantomData;
use glam::Vec3;

/// The least half-angle, 2^-12 radians: vectors of `f32` resolve a few thousand steps across it.
const LEAST_ANGLE: f32 = exp2(-12);

/// The cotangent of 120 degrees: the rim's height beside its radius in a sphere's codec.
const SPHERE_RIM: f32 = -0.577_350_26;

/// `(1 - cos b) / 2` of the part of a sphere's codec that a cap fills, b = 120 degrees. A larger cap is the whole
/// sphere.
const SPHERE_PART: f32 = 0.75;

/// The codec `C` over the directions within an angle of an axis, with the less error the smaller the angle: see the
/// [module](self). Axis and angle are values, which the decoder needs too.
///
/// ```
/// use unitvec::wrap::Cap;
/// use unitvec::{HemiOctPrecise16, angle_deg};
///
/// let cap = Cap::<HemiOctPrecise16>::new([0.0, 0.6, 0.8], 10f32.to_radians());
/// let decoded: [f32; 3] = cap.decode(cap.encode([0.0, 0.5, 0.8]));
/// assert!(angle_deg([0.0, 0.5, 0.8], decoded) < cap.max_error_deg().into());
/// assert!(cap.max_error_deg() < 0.1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap<C> {
    axis: Vec3,
    /// `(1 - cos a) / 2`.
    area: f32,
    codec: PhantomData<C>,
}

/// The parts of the sphere that a cap and its image in a codec have, `(1 - cos) / 2` of their half-angles.
#[derive(Clone, Copy)]
struct Parts {
    cap: f32,
    image: f32,
    /// The cotangent of the image's half-angle.
    rim: f32,
}

impl<C: Listed> Cap<C> {
    /// The cap of half-angle `half_angle`, in radians, about `axis`, of any length; +Z stands in for an axis that has
    /// no usable direction (see [`direction`](crate::direction)).
    ///
    /// Angles count as 2^-12 at least. In a codec of the sphere those above 120 degrees, and NaN, are the whole sphere;
    /// in one of the hemisphere they count as 120 degrees.
    #[must_use]
    pub fn new(axis: impl Into<[f32; 3]>, half_angle: f32) -> Self {
        const { assert!(C::IS_UNIT, "a codec whose vectors have unit length") };
        let angle = if is_nan(half_angle) { PI } else { min(max(half_angle, LEAST_ANGLE), PI) };
        let chord = sin(0.5 * angle);
        Self { axis: unit_axis(Vec3::from_array(axis.into())), area: chord * chord, codec: PhantomData }
    }

    /// The cap as the functions of GLSL take it: the axis, and `(1 - cos a) / 2`.
    #[must_use]
    pub fn to_array(self) -> [f32; 4] {
        [self.axis.x, self.axis.y, self.axis.z, self.area]
    }

    #[inline(always)]
    fn parts(self) -> Parts {
        match C::DOMAIN {
            Domain::Hemisphere => Parts { cap: min(self.area, SPHERE_PART), image: 0.5, rim: 0.0 },
            Domain::Sphere if self.area > SPHERE_PART => Parts { cap: 1.0, image: 1.0, rim: SPHERE_RIM },
            Domain::Sphere => Parts { cap: self.area, image: SPHERE_PART, rim: SPHERE_RIM },
        }
    }

    /// The code of the direction of `v`; of the nearest direction of the rim for one outside of the cap; of the axis
    /// where `v` has no usable direction.
    #[must_use]
    #[inline(always)]
    pub fn encode<V: Into<[f32; 3]>>(self, v: V) -> C::Code {
        C::encode_vec3(self.image(Vec3::from_array(v.into())))
    }

    /// The direction that `code` stands for, in the cap, of unit length to within 2 ULP. Any bit pattern is valid.
    #[must_use]
    #[inline(always)]
    pub fn decode<V: From<[f32; 3]>>(self, code: C::Code) -> V {
        self.of_image(C::decode_vec3(code)).to_array().into()
    }

    /// Where the map takes the direction of `v`: a vector for the codec to encode, not of unit length.
    #[must_use]
    #[inline(always)]
    pub fn image(self, v: Vec3) -> Vec3 {
        let (Parts { cap, image, rim }, at) = (self.parts(), About::axis(self.axis, v));
        let (h, rest) = at.parts();
        let k = quotient(image, cap);
        let across = root(quotient(k * max(at.rest(k), 0.0), rest));
        let (x, y, square) = at.azimuth();
        if h > 2.0 * cap {
            Vec3::new(x, y, root(square) * rim)
        } else {
            Vec3::new(at.x * across, at.y * across, 1.0 - k * h)
        }
    }

    /// The direction that the map takes to the unit vector `u`; of the rim where there is none. The inverse of
    /// [`image`](Self::image).
    #[must_use]
    #[inline(always)]
    pub fn of_image(self, u: Vec3) -> Vec3 {
        let (Parts { cap, image, .. }, at) = (self.parts(), About::z(u));
        let (h, rest) = at.parts();
        let k = quotient(cap, image);
        let (x, y, square) = at.azimuth();
        let basis = basis(self.axis);
        if h > 2.0 * image {
            let across = root(quotient((4.0 * cap) * (1.0 - cap), square));
            lifted(self.axis, basis, x * across, y * across, 2.0 * cap)
        } else {
            let across = root(quotient(k * at.rest(k), rest));
            lifted(self.axis, basis, at.x * across, at.y * across, k * h)
        }
    }

    /// An upper bound of the angle, in degrees, between a direction of the cap and its decoded code: the codec's, times
    /// the most that the map lengthens, and 2^-22 radians for `f32` before the map and after.
    #[must_use]
    pub fn max_error_deg(self) -> f32 {
        let parts = self.parts();
        let sine = 2.0 * root(parts.cap * (1.0 - parts.cap));
        let most = match C::DOMAIN {
            Domain::Hemisphere if parts.cap <= 0.5 => sine,
            Domain::Hemisphere => root(quotient(parts.cap, 1.0 - parts.cap)),
            Domain::Sphere if parts.cap < 1.0 => {
                // sin(120° + e) is at least sin 120° - e / 2 - e^2 / 2.
                let e = C::MAX_ERROR_DEG.to_radians();
                let beyond = max(0.866_025_4 - 0.5 * (e + e * e), 0.125);
                quotient(sine, beyond)
            }
            Domain::Sphere => 1.0,
        };
        bound_deg(C::MAX_ERROR_DEG, most)
    }
}
