//! Angles between vectors and between rotations, to check codecs with.

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

/// The angle of the rotation that takes one rotation to another, in degrees: 0 to 180. Both are quaternions x, y, z, w of any
/// length and sign. It is twice the angle between them, or between one and the other's negative.
///
/// It is `2 atan2(|v|, |w|)` of the quotient of both in `f64`, exact for small angles too.
///
/// Where a quaternion is zero the result is 0; where a component is infinite or NaN it is NaN.
///
/// ```
/// use unitvec::rotation_angle_deg;
///
/// let quarter_turn_about_y = [0.0, 1.0, 0.0, 1.0];
/// assert_eq!(rotation_angle_deg(quarter_turn_about_y, [0.0, 0.0, 0.0, -2.0]), 90.0);
/// ```
#[must_use]
pub fn rotation_angle_deg(a: impl Into<[f32; 4]>, b: impl Into<[f32; 4]>) -> f64 {
    let ([ax, ay, az, aw], [bx, by, bz, bw]) = (a.into().map(f64::from), b.into().map(f64::from));
    let x = (aw * bx - bw * ax) + (az * by - ay * bz);
    let y = (aw * by - bw * ay) + (ax * bz - az * bx);
    let z = (aw * bz - bw * az) + (ay * bx - ax * by);
    let w = (ax * bx + ay * by) + (az * bz + aw * bw);
    let length = sqrt(x * x + y * y + z * z);
    if (length + w).is_finite() { (2.0 * atan2(length, w.abs())).to_degrees() } else { f64::NAN }
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

    /// A turn by t about any axis, before or after any rotation, is an angle of t, whatever lengths and signs are.
    #[test]
    fn angles_of_known_rotations() {
        for t in [0.0f32, 1e-6, 1e-3, 0.5, 3.0] {
            let (sin, cos) = ((t / 2.0).sin(), (t / 2.0).cos());
            for (turned, other) in [
                ([sin, 0.0, 0.0, cos], [0.0, 0.0, 0.0, 1.0]),
                ([0.0, -3.0 * sin, 0.0, -3.0 * cos], [0.0, 0.0, 0.0, 5.0]),
                ([cos - sin, sin + cos, sin + cos, cos - sin], [-1.0; 4]),
            ] {
                let angle = rotation_angle_deg(turned, other);
                assert!((angle - f64::from(t).to_degrees()).abs() < 2e-5, "{turned:?} {other:?}: {angle}");
            }
        }
        assert_eq!(rotation_angle_deg([0.0; 4], [0.0, 0.0, 0.0, 1.0]), 0.0);
        assert!(rotation_angle_deg([f32::NAN; 4], [0.0, 0.0, 0.0, 1.0]).is_nan());
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
