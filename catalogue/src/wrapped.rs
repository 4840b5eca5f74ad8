//! Codecs of [`unitvec::wrap`], and what the error of an element is.

use crate::{AnyCodec, Element, angle_between_parts_deg, has_direction};
use unitvec::{Axial16, Axial24, Axial32, Vector32, Vector48};

/// Codecs of axes and of vectors with a length, which [`CODECS`](crate::CODECS) does not have. No backend but the CPU has
/// them.
pub static WRAPPED: [AnyCodec; 5] = [
    AnyCodec::of_codec::<Axial16>("axial16", "Axial16", AnyCodec::AXES),
    AnyCodec::of_codec::<Axial24>("axial24", "Axial24", AnyCodec::AXES),
    AnyCodec::of_codec::<Axial32>("axial32", "Axial32", AnyCodec::AXES),
    AnyCodec::of_codec::<Vector32>("vector32", "Vector32", AnyCodec::LENGTHS),
    AnyCodec::of_codec::<Vector48>("vector48", "Vector48", AnyCodec::LENGTHS),
];

/// The error of a decoded element.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// The angle between directions, or of the rotation between rotations, in degrees.
    #[default]
    Angle,
    /// The angle between axes, `min(e, 180 - e)`, in degrees.
    Axis,
    /// `|d - v| / |v|`, of a vector v and the decoded one, d.
    Relative,
}

impl AnyCodec {
    const AXES: &str = "axial";
    const LENGTHS: &str = "with_length";

    /// The error that the codec is made to keep small.
    pub fn measure(&self) -> Measure {
        match self.family {
            Self::AXES => Measure::Axis,
            Self::LENGTHS => Measure::Relative,
            _ => Measure::Angle,
        }
    }
}

impl Measure {
    /// True where a part of an element has what is measured: a usable direction or, for relative errors, finite components.
    pub fn takes(self, part: &[f32]) -> bool {
        if self == Self::Relative { part.iter().all(|c| c.is_finite()) } else { has_direction(part) }
    }

    /// The error of a part of an element, `d` decoded for `v`. `None` where `v` cannot be measured, and where a vector of zero came
    /// back as another one.
    pub fn error(self, v: &[f32], d: &[f32]) -> Option<f64> {
        let angle = || angle_between_parts_deg(v, d);
        match self {
            _ if !self.takes(v) => None,
            Self::Angle => Some(angle()),
            Self::Axis => Some(90.0 - (angle() - 90.0).abs()),
            Self::Relative => relative_error(v, d),
        }
    }

    /// [`error`](Self::error) of a part of an element, by its place among the parts; `None` also where a part before it, as the
    /// normal of a tangent, cannot be measured.
    pub fn error_of_part(
        self,
        element: Element,
        part: usize,
        original: &[f32],
        decoded: &[f32],
    ) -> Option<f64> {
        let mut before = element.parts(original).take(part);
        if !before.all(|part| self.takes(part)) {
            return None;
        }
        self.error(element.part(original, part), element.part(decoded, part))
    }

    /// The names of the parts of an element that have an error.
    pub const fn parts(self, element: Element) -> &'static [&'static str] {
        match (element, self) {
            (Element::Vector, Self::Axis) => &["axis"],
            (Element::Vector, _) => &["vector"],
            (Element::Frame | Element::Rotation, _) => element.directions(),
        }
    }
}

/// `|d - v| / |v|`: 0 where both are zero, and nothing where only v is.
fn relative_error(v: &[f32], d: &[f32]) -> Option<f64> {
    let length = |of: fn(f64, f64) -> f64| {
        v.iter().zip(d).map(|(v, d)| of((*v).into(), (*d).into()).powi(2)).sum::<f64>().sqrt()
    };
    let (off, length) = (length(|v, d| d - v), length(|v, _| v));
    if off == 0.0 { Some(0.0) } else { (length > 0.0).then(|| off / length) }
}
