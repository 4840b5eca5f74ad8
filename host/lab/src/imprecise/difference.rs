//! Differences of results from the CPU's.

use super::Outcome;
use crate::Result;
use unitvec_catalogue::{AnyCodec, Element, angle_between_parts_deg};
use unitvec_run::backend::{Backend, Cpu};

/// The number of stored codes that differ from those expected, and the largest error of these, as a part of the codec's
/// bound. Every element has to have a direction, or the error means nothing.
///
/// # Errors
/// A wrong length.
pub fn of_codes(format: &AnyCodec, elements: &[f32], codes: &[u8], expected: &[u8]) -> Result<(u64, f64)> {
    let pairs = codes.chunks_exact(format.bytes).zip(expected.chunks_exact(format.bytes));
    let all = elements.chunks_exact(format.element.floats()).zip(pairs);
    let (mut differ, mut different) = (Vec::new(), Vec::new());
    for (element, (code, _)) in all.filter(|(_, (code, expected))| code != expected) {
        differ.extend_from_slice(element);
        different.extend_from_slice(code);
    }
    let mut decoded = vec![0.0; differ.len()];
    Cpu.decode(format, &different, &mut decoded)?;
    let errors = angles(format.element, &differ, &decoded).zip(format.max_errors_deg.iter().cycle());
    let parts = errors.map(|(angle, bound)| angle / f64::from(*bound));
    Ok(((differ.len() / format.element.floats()) as u64, parts.fold(0.0, f64::max)))
}

/// The difference of decoded elements from those expected: their number, components and angles.
pub fn of_elements(format: &AnyCodec, decoded: &[f32], expected: &[f32]) -> Outcome {
    let floats = format.element.floats();
    let differ = decoded.chunks_exact(floats).zip(expected.chunks_exact(floats));
    let differ = differ.filter(|(decoded, expected)| bits_differ(decoded, expected)).count();
    let differences = decoded.iter().zip(expected).map(|(a, b)| difference(*a, *b));
    Outcome {
        elements_differ: differ as u64,
        component_ulp: differences.fold(0.0, f64::max) * f64::from(1 << 24),
        angle_deg: angles(format.element, decoded, expected).fold(0.0, f64::max),
        ..Outcome::default()
    }
}

/// The difference of two numbers; infinite where one of them is NaN.
fn difference(a: f32, b: f32) -> f64 {
    let difference = (f64::from(a) - f64::from(b)).abs();
    if difference.is_nan() { f64::INFINITY } else { difference }
}

pub(super) fn bits_differ(a: &[f32], b: &[f32]) -> bool {
    a.iter().zip(b).any(|(a, b)| a.to_bits() != b.to_bits())
}

/// The angles between elements, degrees: of each the angle of the vectors or rotations, or those of normals and of tangents.
fn angles<'a>(element: Element, a: &'a [f32], b: &'a [f32]) -> impl Iterator<Item = f64> + 'a {
    let pairs = a.chunks_exact(element.floats()).zip(b.chunks_exact(element.floats()));
    pairs.flat_map(move |(a, b)| {
        let parts = element.parts(a).zip(element.parts(b));
        parts.map(move |(of_a, of_b)| if bits_differ(a, b) { angle_or_all(of_a, of_b) } else { 0.0 })
    })
}

/// The angle in degrees; 180 where there is none.
fn angle_or_all(a: &[f32], b: &[f32]) -> f64 {
    let angle = angle_between_parts_deg(a, b);
    if angle.is_nan() { 180.0 } else { angle }
}
