//! Angular error, by the survey's method (Cigolle et al. 2014, section 4.1) in float64.

use crate::backend::{Backend, round_trip};
use crate::{Result, sampling};
use unitvec_catalogue::{AnyCodec, Domain, Element, angle_between_parts_deg};

/// Mean and maximum of a series of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorStats {
    sum: f64,
    sum_of_squares: f64,
    max: f64,
    count: u64,
}

impl ErrorStats {
    /// Adds an error in degrees.
    pub fn add(&mut self, error: f64) {
        self.sum += error;
        self.sum_of_squares += error * error;
        self.max = self.max.max(error);
        self.count += 1;
    }

    /// Mean in degrees; 0 for an empty series.
    pub fn mean_deg(&self) -> f64 {
        if self.count == 0 { 0.0 } else { self.sum / self.count as f64 }
    }

    /// Standard error of the mean in degrees, as an estimate of the mean over all directions; 0 for an empty series.
    pub fn standard_error_deg(&self) -> f64 {
        let count = self.count.max(1) as f64;
        let variance = (self.sum_of_squares / count - self.mean_deg().powi(2)).max(0.0);
        (variance / count).sqrt()
    }

    /// Maximum in degrees.
    pub fn max_deg(&self) -> f64 {
        self.max
    }
}

impl FromIterator<f64> for ErrorStats {
    fn from_iter<I: IntoIterator<Item = f64>>(errors: I) -> Self {
        let mut stats = Self::default();
        errors.into_iter().for_each(|error| stats.add(error));
        stats
    }
}

/// Errors of elements: of a vector or a rotation itself; of a frame's normal and its tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementErrors {
    /// Errors of the vectors, rotations or normals.
    pub normal: ErrorStats,
    /// Errors of the tangents; empty for others.
    pub tangent: ErrorStats,
}

impl ElementErrors {
    /// Adds the errors between an element and its decoded one.
    pub fn add(&mut self, element: Element, original: &[f32], decoded: &[f32]) {
        let parts = element.parts(original).zip(element.parts(decoded));
        for (errors, (original, decoded)) in [&mut self.normal, &mut self.tangent].into_iter().zip(parts) {
            errors.add(angle_between_parts_deg(original, decoded));
        }
    }
}

/// Measures a codec over `count` random directions of the domain, frames or rotations, by the survey's method (section 4.1).
///
/// # Errors
/// An error of the backend.
pub fn measure(
    backend: &mut dyn Backend,
    codec: &AnyCodec,
    domain: Domain,
    count: usize,
    seed: u64,
) -> Result<ElementErrors> {
    let mut errors = ElementErrors::default();
    let elements = sampling::random_elements(codec.element, domain, seed);
    round_trip(backend, codec, elements, count, |element, decoded| {
        errors.add(codec.element, element, decoded)
    })?;
    Ok(errors)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of 1 and 3 degrees: mean 2, deviation 1, over the root of 2.
    #[test]
    fn the_standard_error_of_two() {
        let error = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            unitvec::angle_deg([1.0, 0.0, 0.0], [cos as f32, sin as f32, 0.0])
        };
        let errors: ErrorStats = [1.0, 3.0].map(error).into_iter().collect();
        assert!((errors.mean_deg() - 2.0).abs() < 1e-6);
        assert!((errors.standard_error_deg() - 0.5f64.sqrt()).abs() < 1e-6);
    }
}
