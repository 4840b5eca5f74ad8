//! Formats of other software as codecs.

use crate::cpu::AnyFunctions;
use crate::{AnyCodec, Element, UnknownCodec, WRAPPED, find};
use std::sync::LazyLock;
use unitvec::Domain;
use unitvec::interop::{FRAMES, Format, FrameFormat, RotationFormat, UnknownFormat};

/// The word after a name that stands for the plain encoder of the original.
const PLAIN: &str = " plain";

/// All formats of [`unitvec::interop`]: of vectors at each width, each with its nearest encoder and then with its plain one,
/// whose names end in ` plain`; of rotations likewise; and those of frames. No backend but the CPU has them.
pub fn formats() -> &'static [AnyCodec] {
    static FORMATS: LazyLock<Vec<AnyCodec>> = LazyLock::new(|| {
        let others = RotationFormat::all().flat_map(of_rotations).chain(FRAMES.iter().map(of_frames));
        Format::all().flat_map(of_vectors).chain(others).collect()
    });
    &FORMATS
}

/// The nearest and the plain encoder of a format. Names live as long as the program: there are as many as formats.
fn of_vectors(format: Format) -> [AnyCodec; 2] {
    [("", format), (PLAIN, format.plain())].map(|(ending, format)| AnyCodec {
        bits: format.bits(),
        bytes: format.bytes(),
        max_errors_deg: Vec::leak(vec![format.max_error_deg()]),
        null: format.null().map(|code| [code as u32, (code >> 32) as u32]),
        ..of(String::leak(format!("{format}{ending}")), Element::Vector, AnyFunctions::Format(format))
    })
}

/// The nearest and the plain encoder of a format of rotations.
fn of_rotations(format: RotationFormat) -> [AnyCodec; 2] {
    [("", format), (PLAIN, format.plain())].map(|(ending, format)| AnyCodec {
        bits: format.bits(),
        bytes: format.bytes(),
        max_errors_deg: Vec::leak(vec![format.max_error_deg()]),
        ..of(
            String::leak(format!("{format}{ending}")),
            Element::Rotation,
            AnyFunctions::RotationFormat(format),
        )
    })
}

fn of_frames(format: &'static FrameFormat) -> AnyCodec {
    AnyCodec {
        bits: format.bits,
        bytes: format.bytes(),
        max_errors_deg: Vec::leak(format.max_errors_deg().to_vec()),
        ..of(format.name, Element::Frame, AnyFunctions::FrameFormat(*format))
    }
}

/// What all formats have in common.
fn of(id: &'static str, element: Element, functions: AnyFunctions) -> AnyCodec {
    AnyCodec {
        id,
        rust_type: id,
        survey_name: id,
        family: AnyCodec::FORMATS,
        element,
        bits: 0,
        bytes: 0,
        vk_format: None,
        domain: Domain::Sphere,
        is_unit: false,
        exact_axes: false,
        stable_across_devices: false,
        max_errors_deg: &[],
        encodes_by_table: false,
        null: None,
        functions,
    }
}

impl AnyCodec {
    /// The family of the formats of other software.
    pub const FORMATS: &str = "interop";

    /// True for formats of other software, of vectors or frames.
    pub fn is_format(&self) -> bool {
        self.family == Self::FORMATS
    }

    /// The format of other software that this stands for, of vectors.
    pub fn format(&self) -> Option<Format> {
        match self.functions {
            AnyFunctions::Format(format) => Some(format),
            _ => None,
        }
    }

    /// The same format with the plain encoder of the original; `None` for codecs.
    pub fn plain(&self) -> Option<&'static AnyCodec> {
        if !self.is_format() || self.element == Element::Frame {
            return None;
        }
        let plain = format!("{}{PLAIN}", self.id.trim_end_matches(PLAIN));
        formats().iter().find(|other| other.id == plain)
    }
}

/// The codec of this name, as [`find`] takes it, one of [`WRAPPED`], or the format of other software, as [`Format::named`] and
/// [`RotationFormat::named`] do.
///
/// # Errors
/// [`UnknownCodec`] if there is none, with the widths where only these are wrong.
pub fn find_any(name: &str) -> Result<&'static AnyCodec, UnknownCodec> {
    if let Some(codec) = WRAPPED.iter().chain(formats()).find(|codec| codec.is_named(name)) {
        return Ok(codec);
    }
    find(name).map_err(|error| match (Format::named(name).err(), RotationFormat::named(name).err()) {
        (Some(bits @ UnknownFormat::Bits { .. }), _) | (_, Some(bits @ UnknownFormat::Bits { .. })) => {
            UnknownCodec { id: error.id, of_format: Some(bits) }
        }
        _ => error,
    })
}
