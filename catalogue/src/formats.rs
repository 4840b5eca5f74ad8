//! Formats of other software as codecs.

use crate::cpu::{AnyFunctions, words};
use crate::{AnyCodec, Element, UnknownCodec, find};
use std::sync::LazyLock;
use unitvec::Domain;
use unitvec::interop::{Format, UnknownFormat};

/// The word after a name that stands for the plain encoder of the original.
const PLAIN: &str = " plain";

/// All formats of [`unitvec::interop`], at each width, each with its nearest encoder and then with its plain one, whose names
/// end in ` plain`. No backend but the CPU has them.
pub fn formats() -> &'static [AnyCodec] {
    static FORMATS: LazyLock<Vec<AnyCodec>> = LazyLock::new(|| {
        Format::all().flat_map(|format| [of(format, ""), of(format.plain(), PLAIN)]).collect()
    });
    &FORMATS
}

/// Names live as long as the program: there are as many as formats.
fn of(format: Format, ending: &str) -> AnyCodec {
    let id = String::leak(format!("{format}{ending}"));
    AnyCodec {
        id,
        rust_type: id,
        survey_name: id,
        family: AnyCodec::FORMATS,
        element: Element::Vector,
        bits: format.bits(),
        bytes: format.bytes(),
        vk_format: None,
        domain: Domain::Sphere,
        is_unit: false,
        exact_axes: false,
        stable_across_devices: false,
        max_errors_deg: Vec::leak(vec![format.max_error_deg()]),
        encodes_by_table: false,
        null: format.null().map(words),
        functions: AnyFunctions::Format(format),
    }
}

impl AnyCodec {
    /// The family of the formats of other software.
    pub const FORMATS: &str = "interop";

    /// The format of other software that this stands for.
    pub fn format(&self) -> Option<Format> {
        match self.functions {
            AnyFunctions::Format(format) => Some(format),
            _ => None,
        }
    }

    /// The same format with the plain encoder of the original; `None` for codecs.
    pub fn plain(&self) -> Option<&'static AnyCodec> {
        let plain = self.format()?.plain();
        formats().iter().find(|other| other.format() == Some(plain))
    }
}

/// The codec of this name, as [`find`] takes it, or the format of other software, as [`Format::named`] does.
///
/// # Errors
/// [`UnknownCodec`] if there is none, with the widths where only these are wrong.
pub fn find_any(name: &str) -> Result<&'static AnyCodec, UnknownCodec> {
    if let Some(format) = formats().iter().find(|format| format.id.eq_ignore_ascii_case(name)) {
        return Ok(format);
    }
    find(name).map_err(|error| match Format::named(name) {
        Err(bits @ UnknownFormat::Bits { .. }) => UnknownCodec { id: error.id, of_format: Some(bits) },
        _ => error,
    })
}
