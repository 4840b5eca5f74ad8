//! Cases of frames against the oracle.

use super::Case;
use glam::Vec3;
use unitvec_catalogue::{AnyCodec, find};
use unitvec_oracle::frame::{Format, perpendicular};
use unitvec_oracle::{angle_deg, dot, length, normalize};
use unitvec_tests::directions::usable;

/// The angle by which a decoded vector may be off, in degrees: 2^-21, more than the roundings of normal and tangent.
const DECODE_DEG: f64 = 57.3 / (1 << 21) as f64;

/// Asserts that each code decodes to the oracle's frame, and that it is the right one for the input.
pub fn check(id: &str, cases: &[Case]) {
    let (codec, format) = (find(id).unwrap(), Format::find(id).unwrap());
    for case in cases {
        assert!(format.bits() == 64 || case.code >> format.bits() == 0, "{id}: {case:x?}");
        let exact = format.decode(case.code);
        let [normal, tangent] = [0, 3].map(|first| vector(&case.decoded[first..first + 3]));
        for (decoded, exact) in [(normal, exact.normal), (tangent, exact.tangent)] {
            let is_unit = (length(decoded) - 1.0).abs() <= 2.0 * f64::from(f32::EPSILON);
            assert!(is_unit && angle_deg(decoded, exact) <= DECODE_DEG, "{id}: {case:x?} for {exact:?}");
        }
        assert_eq!(f64::from(case.decoded[6]), exact.handedness, "{id}: {case:x?}");
        assert_is_code_of(codec, format, case);
    }
}

/// The three floats of a slice.
fn vector(floats: &[f32]) -> [f64; 3] {
    [0, 1, 2].map(|i| f64::from(floats[i]))
}

/// The normal is as near as the codec promises, to +Z where it has no direction; so is the tangent to its part that is
/// perpendicular to the decoded normal, and its angle is 0 where that is nothing. Denormals and NaN count as +1.
fn assert_is_code_of(codec: &AnyCodec, format: Format, case: &Case) {
    let [[n, decoded_n], [t, decoded_t]] =
        [0, 3].map(|first| [&case.input, &case.decoded].map(|floats| vector(&floats[first..first + 3])));
    let has_direction = |first| usable(Vec3::from_slice(&case.input[first..]));
    let normal_error =
        angle_deg(if has_direction(0) == Some(false) { [0.0, 0.0, 1.0] } else { n }, decoded_n);
    assert!(
        has_direction(0).is_none() || normal_error <= f64::from(codec.max_errors_deg[0]),
        "{}: {case:x?}: {normal_error}",
        codec.id
    );
    let across = angle_deg(t, decoded_n);
    let is_parallel = across.min(180.0 - across) < 0.4;
    let angle = (case.code >> format.normal_bits) % (1 << format.angle_bits);
    if has_direction(3) == Some(false) {
        assert_eq!(angle, 0, "{}: {case:x?}", codec.id);
    } else if has_direction(3) == Some(true) && !is_parallel {
        let error = angle_deg(perpendicular(normalize(decoded_n), normalize(t)), decoded_t);
        assert!(error <= f64::from(codec.max_errors_deg[1]), "{}: {case:x?}: {error}", codec.id);
    }
    assert!(dot(decoded_n, decoded_t).abs() <= 4.0 * f64::from(f32::EPSILON), "{}: {case:x?}", codec.id);
    let is_negative = case.input[6] <= -f32::MIN_POSITIVE;
    assert_eq!(case.decoded[6], if is_negative { -1.0 } else { 1.0 }, "{}: {case:x?}", codec.id);
}
