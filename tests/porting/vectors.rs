//! Cases of vectors against the oracle.

use super::Case;
use glam::Vec3;
use unitvec_oracle::angle_deg;
use unitvec_tests::checks::{assert_bounded, assert_is_vector_of, assert_unit};
use unitvec_tests::directions::usable;
use unitvec_tests::tested::{Tested, widen};

/// The L1 norm from which on the rest of a vector below a hemisphere is a direction, with room for rounding.
const SURE_NORM: f64 = 2.0 / (1u128 << 64) as f64;

/// Asserts that each code decodes to the oracle's vector, and that it is the right one for the input.
pub fn check(id: &str, cases: &[Case]) {
    let codec = Tested::find(id);
    let z = cases.iter().find(|case| case.input == [0.0, 0.0, 1.0]).unwrap();
    let mut settled = 0;
    for case in cases {
        let decoded = vector(&case.decoded);
        assert!(case.code & !codec.mask() == 0, "{id}: {case:x?}");
        assert_unit(&codec, case.code, decoded);
        settled += usize::from(assert_is_vector_of(&codec, case.code, decoded).is_some());
        assert_is_code_of(&codec, vector(&case.input), case, z.code);
    }
    // The oracle leaves points on a disk's rim open: those of the equator.
    assert!(2 * settled > cases.len(), "{id}: the oracle decodes {settled}");
}

fn vector(floats: &[f32]) -> Vec3 {
    Vec3::from_slice(floats)
}

/// The code of a vector without a direction is that of +Z. Any other vector comes back as near as the codec promises:
/// in direction or, where components are stored as they are, in each of them.
fn assert_is_code_of(codec: &Tested, v: Vec3, case: &Case, z: u64) {
    let decoded = widen(vector(&case.decoded));
    if usable(v) == Some(false) {
        assert_eq!(case.code, z, "{}: {v:?} has no direction", codec.id);
    } else if codec.is_directional() {
        let direction = codec.reference.domain(widen(v));
        let is_sure = usable(v) == Some(true) && direction.iter().map(|t| t.abs()).sum::<f64>() >= SURE_NORM;
        if is_sure || case.code != z {
            assert_bounded(codec, angle_deg(direction, decoded));
        }
    } else if case.code != z {
        // Half a step of one component alone turns an axis by as much. Steps of halves grow with the component.
        let step = f64::from(codec.max_error_deg()).to_radians();
        let largest: f64 = if codec.family == "float" { 65504.0 } else { 1.0 };
        for (given, stored) in widen(v).into_iter().zip(decoded) {
            let off = (given.clamp(-largest, largest) - stored).abs();
            assert!(off <= step * stored.abs().max(1.0), "{}: {v:?} comes back as {decoded:?}", codec.id);
        }
    }
}
