//! The angle between two vectors, to check codecs with.

/// The angle between two vectors of any length, in degrees: 0 to 180.
///
/// It is `atan2(|a x b|, a . b)` in `f64`, which is exact for small angles too. An arc cosine of `a . b` in `f32` is
/// not: the least angle above 0 that it gives is `acos(1 - 2^-24)`, 0.0198 degrees, five times the maximum error of
/// [`Oct32`](crate::Oct32).
///
/// Where a vector is zero the result is 0; where a component is infinite or NaN it is NaN.
///
/// ```
/// use unitvec::angle_deg;
///
/// assert_eq!(angle_deg([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]), 90.0);
/// ```
#[must_use]
pub fn angle_deg(a: impl Into<[f32; 3]>, b: impl Into<[f32; 3]>) -> f64 {
    let ([ax, ay, az], [bx, by, bz]) = (a.into().map(f64::from), b.into().map(f64::from));
    let cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    let length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
    // Adding 0 turns -0 into 0: with -0 the arc tangent would be 180 degrees.
    let dot = ax * bx + ay * by + az * bz + 0.0;
    // No product of finite f32 is infinite in f64.
    if (length + dot).is_finite() { atan2(length, dot).to_degrees() } else { f64::NAN }
}

#[cfg(feature = "std")]
fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

#[cfg(feature = "std")]
fn atan2(y: f64, x: f64) -> f64 {
    y.atan2(x)
}

#[cfg(not(feature = "std"))]
use libm::{atan2, sqrt};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_of_known_directions() {
        assert_eq!(angle_deg([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]), 90.0);
        assert_eq!(angle_deg([1.0, 0.0, 0.0], [-3.0, 0.0, 0.0]), 180.0);
        assert_eq!(angle_deg([0.0, 0.0, 5.0], [0.0, 0.0, 1.0]), 0.0);
        assert!((angle_deg([1.0, 1.0, 0.0], [0.0, 1.0, 1.0]) - 60.0).abs() < 1e-13);
    }

    /// Angles far below the least that an arc cosine can tell, for which `atan(t) = t`, and vectors of any length.
    #[test]
    fn small_angles_and_all_lengths() {
        for t in [1e-3f32, 1e-5, 1e-7, 1e-20] {
            let expected = f64::from(t).atan().to_degrees();
            for length in [1.0, f32::MIN_POSITIVE / t, 1e30] {
                let angle = angle_deg([length, 0.0, 0.0], [1.0, t, 0.0]);
                assert!((angle / expected - 1.0).abs() < 1e-12, "{t} {length}: {angle}");
            }
        }
        assert_eq!(angle_deg([f32::MAX; 3], [-f32::MAX; 3]), 180.0);
        assert_eq!(angle_deg([f32::from_bits(1), 0.0, 0.0], [0.0, f32::from_bits(1), 0.0]), 90.0);
    }

    #[test]
    fn vectors_without_a_direction() {
        for v in [[1.0, 2.0, 3.0], [-1.0, -2.0, -3.0], [-0.0; 3], [0.0; 3]] {
            assert_eq!([angle_deg([0.0; 3], v), angle_deg(v, [-0.0; 3])], [0.0; 2], "{v:?}");
            for odd in [f32::NAN, f32::INFINITY] {
                assert!(angle_deg([odd, 0.0, 1.0], v).is_nan(), "{v:?}");
            }
        }
    }
}
