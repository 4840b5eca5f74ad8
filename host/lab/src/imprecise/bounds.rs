//! Bounds of the difference between devices' results and the CPU's, counted from the operations that lead to them.
//!
//! The unit is 2^-23. A quotient's relative error is at most 2.5 on the device and 0.5 on the CPU. A square root's error is
//! that of `1 / inversesqrt(x)`: at most `s^2 + 2.5` ULP for a significand s from 1 to 2, which is 3.5 of the root, and 0.5
//! on the CPU. An arc function of [`unitvec::arith`] is off by at most 1.7e-7 on either, which is 1.5 each. So a number is
//! off by `3 q + 4 r + 3 a` where q quotients, r roots and a arc functions lead to it, none of them steeper than 1 in its
//! argument, and by 1 more for the sums and products after them, which round other numbers.
//!
//! These are limits to hold results against, not a proof: slopes are mostly far below 1, which pays for the roundings
//! of a long way.

use super::{Model, Outcome, error_bound};
use std::f64::consts::PI;
use unitvec_catalogue::{AnyCodec, Element};

/// 2^-23: a ULP of the numbers from 1 to 2.
const UNIT: f64 = 1.0 / 8_388_608.0;

/// The error of a result, in [`UNIT`]s, by the number of quotients, square roots and arc functions on the longest way to it. Those
/// of constants count as well: a device may compute them.
fn way(quotients: u32, roots: u32, arcs: u32) -> f64 {
    let counted = 3 * quotients + 4 * roots + 3 * arcs;
    if counted == 0 { 0.0 } else { f64::from(counted + 1) }
}

/// The source of an encoder's bound.
#[derive(Clone, Copy, Debug)]
enum Encoder {
    /// The [`way`] to a coordinate, in whose unit there are half as many steps as codes in a row of the square of all codes.
    Way(f64),
    /// A [`Way`](Self::Way) whose coordinate is a sum of two floats, of which only the second has the error.
    TwoFloats(f64),
    /// The [`way`] to a coordinate of three, of a lattice that has the root of the third degree of all codes along each.
    Space(f64),
    /// Parts of a step by which a coordinate may be off on either side.
    Steps(f64),
    /// The [`way`] to the distance of a code. For codes in nearly the same direction the last bit decides which is nearest:
    /// the number that differ has no bound.
    Choice(f64),
}

/// The source of a decoder's bound.
#[derive(Clone, Copy, Debug)]
enum Decoder {
    /// The vector is exact but for a factor, which is the inverse of its length.
    Scaled,
    /// The [`way`] to a coordinate whose unit is up to half a turn.
    Way(f64),
}

/// The bounds of a codec's errors on a device.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    encoder: Encoder,
    decoder: Decoder,
    bits: u32,
    element: Element,
    error_bound_deg: f64,
    /// True where codes come back from any two devices.
    pub is_stable: bool,
}

impl Bounds {
    /// The bounds of a codec.
    pub fn of(format: &AnyCodec) -> Self {
        let (encoder, decoder) = derivation(format.family);
        Self {
            encoder,
            decoder,
            bits: format.bits,
            element: format.element,
            error_bound_deg: error_bound(format),
            is_stable: format.stable_across_devices,
        }
    }

    /// The most codes of `elements` random elements that may differ. `None` where there is no bound.
    ///
    /// A coordinate's code differs where the coordinate lies no farther from the border between two codes than its
    /// error. For two coordinates of m steps that is a part `4 m e` of all. Of so many on average, six standard
    /// deviations and six more are never exceeded.
    pub fn codes_differ(&self, elements: u64) -> Option<u64> {
        let steps = 2f64.powi(self.bits as i32 / 2 - 1);
        let off = match self.encoder {
            Encoder::Way(error) => steps * error * UNIT,
            // Three coordinates, whose cells have more faces, in as many halves of the cube's side.
            Encoder::Space(error) => 2f64.powf(f64::from(self.bits) / 3.0) * error * UNIT,
            Encoder::TwoFloats(error) => steps * error * UNIT * UNIT,
            Encoder::Steps(part) => part,
            Encoder::Choice(_) => return None,
        };
        let mean = 4.0 * off * elements as f64;
        let most = if mean == 0.0 { 0.0 } else { mean + 6.0 * mean.sqrt() + 6.0 };
        Some((most as u64).min(elements))
    }

    /// The largest difference of a component, in 2^-24, and the largest angle, in degrees.
    pub fn decoded(&self) -> (f64, f64) {
        // The components of two elements are rounded, each by at most 2^-25. Rotations turn by twice the angle of quaternions.
        let rounding = match self.element {
            Element::Vector | Element::Frame => 3f64.sqrt() * UNIT / 2.0,
            Element::Rotation => 2.0 * 4f64.sqrt() * UNIT / 2.0,
        };
        // The inverse of a length.
        let factor = way(1, 1, 0);
        match self.decoder {
            Decoder::Scaled => (2.0 * factor + 1.0, rounding.to_degrees()),
            Decoder::Way(error) => {
                let angle = PI * error * UNIT;
                (angle / UNIT * 2.0 + 2.0 * factor + 1.0, (angle + rounding).to_degrees())
            }
        }
    }

    /// The objections to an outcome, in words.
    pub(super) fn objections(&self, model: Model, elements: u64, outcome: &Outcome) -> Vec<String> {
        // The effects of truncation are reported, and not bounded: `unitvec conform` refuses such a device.
        if !model.rounds_to_nearest() {
            return Vec::new();
        }
        let Outcome { codes_differ, special_differ, elements_differ, error, component_ulp, angle_deg } =
            outcome;
        let (mut codes, (mut component, mut angle)) = (self.codes_differ(elements), self.decoded());
        let is_exact = model.divides_exactly();
        if is_exact {
            (codes, component, angle) = (Some(0), 0.0, 0.0);
        }
        let most = codes.unwrap_or(u64::MAX);
        let all = [
            (is_exact && *elements_differ > 0, format!("decoded elements that differ: {elements_differ}")),
            (
                is_exact && *special_differ > 0,
                format!("codes of special elements that differ: {special_differ}"),
            ),
            (*codes_differ > most, format!("codes that differ: {codes_differ}, more than {most}")),
            (
                *component_ulp > component,
                format!("components differ by {component_ulp} 2^-24, more than {component}"),
            ),
            (*angle_deg > angle, format!("vectors are {angle_deg:.3e} degrees apart, more than {angle:.3e}")),
            (*error > self.error_part(), format!("the error is {error:.6} of the codec's bound")),
        ];
        all.into_iter().filter_map(|(is_one, text)| is_one.then_some(text)).collect()
    }

    /// The largest error as a part of the codec's bound: a code that differs is as good as the CPU's, but for the error
    /// of the coordinates, or of the distances of two candidates.
    fn error_part(&self) -> f64 {
        let off = match self.encoder {
            Encoder::Way(error) | Encoder::TwoFloats(error) | Encoder::Space(error) => PI * error,
            Encoder::Choice(error) => 2.0 * error,
            Encoder::Steps(_) => 0.0,
        };
        1.0 + off * UNIT / self.error_bound_deg.to_radians()
    }
}

/// The sources of a family's bounds.
fn derivation(family: &str) -> (Encoder, Decoder) {
    use Decoder::Scaled;
    let exact = way(0, 0, 0);
    match family {
        // m / norm.
        "oct" | "hemioct" | "soct" | "uoct" => (Encoder::Way(way(1, 0, 0)), Scaled),
        // The reciprocal of the norm corrects the error of a coordinate's first float.
        "oct_wide" => (Encoder::TwoFloats(way(1, 0, 0)), Scaled),
        // The length, r^2 by that, and r; the turn's way is shorter. Decoding: turn and 1 / m, and the distance from the axis.
        "eaoct" => (Encoder::Way(way(1, 2, 0)), Decoder::Way(way(2, 1, 0))),
        // The latitude of z and the distance from the axis. Decoding: 1 / m.
        "spherical" => (Encoder::Way(way(1, 1, 1)), Decoder::Way(way(1, 0, 0))),
        // Its docs give the number: the arithmetic adds 1/16 of a step, on the CPU and on the device.
        "spherical_wide" => (Encoder::Steps(0.125), Scaled),
        // z by the length. Decoding: 1 / m, and the distance from the axis.
        "cylindrical" => (Encoder::Way(way(1, 1, 0)), Decoder::Way(way(1, 1, 0))),
        // As `spherical`. Decoding: the place on the ring, and 1 / n.
        "latlong" => (Encoder::Way(way(1, 1, 1)), Decoder::Way(way(2, 1, 0))),
        // The reciprocal of the length, the area from the pole, the azimuth; the spacing of points, and their distance.
        "fib" => (Encoder::Way(way(4, 2, 1)), Decoder::Way(way(0, 1, 0))),
        // The reciprocal of the warp's denominator.
        "hexcube" => (Encoder::Way(way(1, 0, 0)), Scaled),
        // The reciprocal of the sum, that of the determinant, and 1 / n.
        "ico" => (Encoder::Way(way(3, 0, 0)), Decoder::Way(way(2, 0, 0))),
        // The parts of the longest component, the distance of each candidate. Decoding: the largest integer.
        "best_fit" => (Encoder::Choice(way(2, 1, 0)), Decoder::Way(way(1, 0, 0))),
        // The norm; length and its inverse; disk and square, each with a quotient or root, and an angle.
        "azimuthal" => (Encoder::Way(way(4, 3, 1)), Decoder::Way(way(4, 2, 0))),
        // The reciprocal of z and the scale; for angles the arc. Decoding: the scale.
        "cube" => (Encoder::Way(way(2, 0, 1)), Decoder::Way(way(2, 0, 0))),
        // The inverse of the length. Decoding: z, from the rest of x and y, which is the same number on every device.
        "parallel" | "xyonly" => (Encoder::Way(way(1, 1, 0)), Decoder::Way(way(0, 1, 0))),
        // Encoders do not divide.
        "snorm" | "unorm" => (Encoder::Way(exact), Decoder::Way(way(1, 0, 0))),
        "float" => (Encoder::Way(exact), Decoder::Way(exact)),
        // The normal's scale; basis, place on the diamond, and its warp. Decoding: the normal's length, basis, and that of
        // the tangent.
        "frame" => (Encoder::Way(way(3, 1, 0)), Decoder::Way(way(3, 2, 0))),
        // The reciprocal of the largest component, the inverse warp and its step of Newton's method.
        "quat" => (Encoder::Space(way(3, 0, 0)), Scaled),
        // Exact: a family that is missing here shows at once.
        _ => (Encoder::Way(exact), Decoder::Way(exact)),
    }
}
