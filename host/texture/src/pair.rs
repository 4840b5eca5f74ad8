//! Directions in two channels.

use unitvec::glam::Vec3;
use unitvec::{hemioct, oct};

/// What two channels hold of a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pair {
    /// x and y of a direction of the hemisphere z >= 0.
    Xy,
    /// Hemi-oct: the hemisphere z >= 0 on a square (Cigolle et al. 2014, listing 6).
    Hemioct,
    /// Oct: the whole sphere on a square (Cigolle et al. 2014, listings 1 and 2).
    Oct,
}

impl Pair {
    /// The point of a direction of any length, in -1 to 1, not rounded. (0, 0), which is +Z, where there is no direction.
    /// The pairs of the hemisphere give a direction below the equator the point of its horizontal part.
    #[must_use]
    pub fn point(self, vector: [f32; 3]) -> [f64; 2] {
        let v = Vec3::from_array(vector);
        match self {
            Self::Oct => oct::project(v).to_array().map(f64::from),
            Self::Hemioct => hemioct::project(v).to_array().map(f64::from),
            Self::Xy => {
                let [x, y, _] = Self::Hemioct.vector(Self::Hemioct.point(vector));
                [x, y]
            }
        }
    }

    /// The unit vector of a point. Coordinates are clamped to -1 to 1, and NaN counts as 0. A point of [`Pair::Xy`] outside the
    /// unit circle moves onto it, toward the middle.
    #[must_use]
    pub fn vector(self, point: [f64; 2]) -> [f64; 3] {
        let [u, v] = point.map(|t| if t.is_nan() { 0.0 } else { t.clamp(-1.0, 1.0) });
        let [x, y, z] = match self {
            Self::Xy => [u, v, (1.0 - u * u - v * v).max(0.0).sqrt()],
            // Twice listing 6.
            Self::Hemioct => [u + v, u - v, 2.0 * (1.0 - u.abs().max(v.abs()))],
            // Listing 2: the lower half is folded in.
            Self::Oct => {
                let z = 1.0 - u.abs() - v.abs();
                let below = (-z).max(0.0);
                [u - below.copysign(u), v - below.copysign(v), z]
            }
        };
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    }
}
