//! Codecs of [`unitvec::wrap`], and what the error of an element is.

use crate::{AnyCodec, Element};
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
    /// The names of the parts of an element that have an error.
    pub const fn parts(self, element: Element) -> &'static [&'static str] {
        match (element, self) {
            (Element::Vector, Self::Axis) => &["axis"],
            (Element::Vector, _) => &["vector"],
            (Element::Frame | Element::Rotation, _) => element.directions(),
        }
    }
}
