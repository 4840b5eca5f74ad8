//! Every codec of [`unitvec`] by its identifier, for programs that choose one at run time: the properties of each, and
//! functions that encode and decode with it on the CPU, on all cores.
//!
//! ```
//! use unitvec_catalogue::{Coding, find};
//!
//! let codec = find("oct32p")?;
//! let mut codes = vec![0; 2 * codec.bytes];
//! codec.encode_cpu(&[[0.6, 0.0, -0.8], [0.0, 1.0, 0.0]], &mut codes)?;
//! let mut vectors = [[0.0; 3]; 2];
//! codec.decode_cpu(&codes, &mut vectors)?;
//! assert_eq!(vectors[1], [0.0, 1.0, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A program that knows its codec when it is written needs only [`unitvec`]. This crate compiles all of them, which takes
//! about a minute on two cores. With the feature `serde`, [`CodecInfo`], [`FrameInfo`], [`Element`] and [`Operation`] can
//! be serialised.

mod cpu;
mod list;

use cpu::{AnyFunctions, Functions};
use unitvec::slice::machine::Level;
use unitvec::slice::{EncodeAt, LengthMismatch, expect_length};
#[cfg(doc)]
use unitvec::{Codec, FrameCodec};
use unitvec::{Listed, ListedFrame};

pub use cpu::best_fit_table;
pub use list::{CATALOGUE, FRAMES};
pub use unitvec::Domain;

/// A codec: what is known of it, and its CPU functions.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CodecInfo {
    /// Identifier, as in `--codec`, the entry points and the GLSL functions: `oct16p`.
    pub id: &'static str,
    /// Name of its type in [`unitvec`]: `OctPrecise16`.
    pub rust_type: &'static str,
    /// The survey's name, `oct16P`; for codecs that are not in the survey, a name in the same style.
    pub survey_name: &'static str,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// The Vulkan format with the code's layout, where there is one.
    pub vk_format: Option<&'static str>,
    /// The directions it is made for.
    #[cfg_attr(feature = "serde", serde(serialize_with = "serialize_domain"))]
    pub domain: Domain,
    /// True where decoded vectors have unit length; false for raw component formats.
    pub is_unit: bool,
    /// True where the directions of the domain's axes come back exactly.
    pub exact_axes: bool,
    /// True where what any device decodes, any other encodes to a code of the same vector.
    pub stable_across_devices: bool,
    /// Upper bound of the error over the domain, in degrees.
    pub max_error_deg: f32,
    /// The family: its module in [`unitvec`] and, with `.glsl`, the GLSL include file with its functions.
    pub family: &'static str,
    /// True where the encoder looks lengths up in the table of [`unitvec::best_fit`]: its kernel binds it.
    pub encodes_by_table: bool,
    #[cfg_attr(feature = "serde", serde(skip))]
    functions: Functions<3>,
}

impl CodecInfo {
    const fn of<C: Listed>() -> Self {
        Self {
            id: C::NAME,
            rust_type: C::RUST_TYPE,
            survey_name: C::SURVEY_NAME,
            bits: C::BITS,
            bytes: C::BYTES,
            vk_format: C::VK_FORMAT,
            domain: C::DOMAIN,
            is_unit: C::IS_UNIT,
            exact_axes: C::EXACT_AXES,
            stable_across_devices: C::STABLE_ACROSS_DEVICES,
            max_error_deg: C::MAX_ERROR_DEG,
            family: C::FAMILY,
            encodes_by_table: false,
            functions: Functions::of_vectors::<C>(),
        }
    }

    /// The GLSL include file with its functions: `oct.glsl`.
    pub fn glsl_file(&self) -> String {
        format!("{}.glsl", self.family)
    }

    /// The codec, encoding by the table of [`unitvec::best_fit`].
    const fn by_table(self, encode: EncodeAt<[f32; 3]>) -> Self {
        Self { encodes_by_table: true, functions: self.functions.by_table(encode), ..self }
    }

    /// Entry point of the kernel, and name of the GLSL function, of this operation: `oct16_encode`.
    pub fn function(&self, operation: Operation) -> String {
        self.format().function(operation)
    }
}

#[cfg(feature = "serde")]
fn serialize_domain<S: serde::Serializer>(domain: &Domain, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(match domain {
        Domain::Sphere => "sphere",
        Domain::Hemisphere => "hemisphere",
    })
}

/// A codec of tangent frames: seven floats, which are normal, tangent and handedness.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FrameInfo {
    /// Identifier: `frame32`.
    pub id: &'static str,
    /// Name of its type in [`unitvec`]: `Frame32`.
    pub rust_type: &'static str,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// The Vulkan format that holds a code.
    pub vk_format: &'static str,
    /// Upper bound of the normal's error, in degrees.
    pub max_normal_error_deg: f32,
    /// Upper bound of the tangent's error, in degrees.
    pub max_tangent_error_deg: f32,
    #[cfg_attr(feature = "serde", serde(skip))]
    functions: Functions<7>,
}

impl FrameInfo {
    /// The GLSL include file with its functions.
    pub fn glsl_file(&self) -> &'static str {
        "frame.glsl"
    }

    const fn of<F: ListedFrame>() -> Self {
        Self {
            id: F::NAME,
            rust_type: F::RUST_TYPE,
            bits: F::BITS,
            bytes: F::BYTES,
            vk_format: F::VK_FORMAT,
            max_normal_error_deg: F::MAX_NORMAL_ERROR_DEG,
            max_tangent_error_deg: F::MAX_TANGENT_ERROR_DEG,
            functions: Functions::of_frames::<F>(),
        }
    }
}

/// What runs a codec, of vectors or of frames, needs to know of it.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Identifier.
    pub id: &'static str,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// What it encodes.
    pub element: Element,
    /// The Vulkan format with the code's layout, where there is one.
    pub vk_format: Option<&'static str>,
    /// The directions it is made for.
    pub domain: Domain,
    /// As in [`CodecInfo`].
    pub encodes_by_table: bool,
    functions: AnyFunctions,
}

/// What is encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Element {
    /// Vectors of three floats.
    Vector,
    /// Tangent frames of seven: normal, tangent, handedness.
    Frame,
}

impl Element {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Vector, Self::Frame];

    /// Its number of f32.
    pub const fn floats(self) -> usize {
        match self {
            Self::Vector => 3,
            Self::Frame => 7,
        }
    }

    /// Its size as packed f32.
    pub const fn bytes(self) -> usize {
        4 * self.floats()
    }

    /// `vectors` or `frames`.
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Vector => "vectors",
            Self::Frame => "frames",
        }
    }
}

impl Format {
    /// Entry point of the kernel, and name of the GLSL function, of this operation: `oct16_encode`.
    pub fn function(&self, operation: Operation) -> String {
        format!("{}_{operation}", self.id)
    }

    /// The number of elements, where slices of these lengths hold equally many.
    ///
    /// # Errors
    /// [`LengthMismatch`] where they do not, or where one ends within an element.
    pub fn count(&self, floats: usize, code_bytes: usize) -> Result<usize, LengthMismatch> {
        let count = floats / self.element.floats();
        expect_length(count * self.bytes, code_bytes)?;
        // Floats beyond the last whole element ask for one code more.
        expect_length(floats.div_ceil(self.element.floats()) * self.bytes, code_bytes)?;
        Ok(count)
    }

    /// As [`Coding::encode_cpu`], of elements whose floats follow each other.
    ///
    /// # Errors
    /// As [`count`](Self::count). Nothing is written then.
    pub fn encode_cpu(&self, elements: &[f32], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        match self.functions {
            AnyFunctions::Vector(codec) => codec.encode(self.bytes, bytemuck::cast_slice(elements), codes),
            AnyFunctions::Frame(codec) => codec.encode(self.bytes, bytemuck::cast_slice(elements), codes),
        }
    }

    /// As [`Coding::decode_cpu`], to elements whose floats follow each other.
    ///
    /// # Errors
    /// As [`count`](Self::count). Nothing is written then.
    pub fn decode_cpu(&self, codes: &[u8], elements: &mut [f32]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        match self.functions {
            AnyFunctions::Vector(codec) => {
                codec.decode(self.bytes, codes, bytemuck::cast_slice_mut(elements))
            }
            AnyFunctions::Frame(codec) => codec.decode(self.bytes, codes, bytemuck::cast_slice_mut(elements)),
        }
    }

    /// As [`encode_cpu`](Self::encode_cpu), on the calling thread alone.
    ///
    /// # Errors
    /// As [`count`](Self::count). Nothing is written then.
    pub fn encode_here(&self, elements: &[f32], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        match self.functions {
            AnyFunctions::Vector(codec) => codec.encode_here(bytemuck::cast_slice(elements), codes),
            AnyFunctions::Frame(codec) => codec.encode_here(bytemuck::cast_slice(elements), codes),
        }
    }

    /// As [`decode_cpu`](Self::decode_cpu), on the calling thread alone.
    ///
    /// # Errors
    /// As [`count`](Self::count). Nothing is written then.
    pub fn decode_here(&self, codes: &[u8], elements: &mut [f32]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        match self.functions {
            AnyFunctions::Vector(codec) => codec.decode_here(codes, bytemuck::cast_slice_mut(elements)),
            AnyFunctions::Frame(codec) => codec.decode_here(codes, bytemuck::cast_slice_mut(elements)),
        }
    }
}

/// The formats of all codecs, of vectors and then of frames.
pub fn formats() -> impl Iterator<Item = Format> {
    CATALOGUE.iter().map(Coding::format).chain(FRAMES.iter().map(Coding::format))
}

/// A codec of elements of `N` floats.
pub trait Coding<const N: usize> {
    /// What runs it needs to know.
    fn format(&self) -> Format;

    #[doc(hidden)]
    fn functions(&self) -> &Functions<N>;

    /// Encodes on the CPU, on all cores: little endian, without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] where `codes` is not of that size. Nothing is written then.
    fn encode_cpu(&self, elements: &[[f32; N]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.functions().encode(self.format().bytes, elements, codes)
    }

    /// Decodes on the CPU, on all cores.
    ///
    /// # Errors
    /// [`LengthMismatch`] where `codes` is not as [`encode_cpu`](Self::encode_cpu) makes it. Nothing is written then.
    fn decode_cpu(&self, codes: &[u8], elements: &mut [[f32; N]]) -> Result<(), LengthMismatch> {
        self.functions().decode(self.format().bytes, codes, elements)
    }

    /// [`Codec::encode`] or [`FrameCodec::encode`] of one element: the low word first.
    fn encode_one(&self, element: [f32; N]) -> [u32; 2] {
        (self.functions().encode_one)(element)
    }

    /// [`Codec::decode`] or [`FrameCodec::decode`] of one code, the low word first.
    fn decode_one(&self, code: [u32; 2]) -> [f32; N] {
        (self.functions().decode_one)(code)
    }

    /// The slice function with the instructions of a given level, on one core, and without a table.
    #[doc(hidden)]
    fn encode_cpu_at(
        &self,
        level: Level,
        elements: &[[f32; N]],
        codes: &mut [u8],
    ) -> Result<(), LengthMismatch> {
        (self.functions().encode_at)(level, elements, codes)
    }

    /// The slice function with the instructions of a given level, on one core.
    #[doc(hidden)]
    fn decode_cpu_at(
        &self,
        level: Level,
        codes: &[u8],
        elements: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        (self.functions().decode_at)(level, codes, elements)
    }
}

impl Coding<3> for CodecInfo {
    fn format(&self) -> Format {
        let Self { id, bits, bytes, vk_format, domain, encodes_by_table, functions, .. } = *self;
        let (element, functions) = (Element::Vector, AnyFunctions::Vector(functions));
        Format { id, bits, bytes, element, vk_format, domain, encodes_by_table, functions }
    }

    fn functions(&self) -> &Functions<3> {
        &self.functions
    }
}

impl Coding<7> for FrameInfo {
    fn format(&self) -> Format {
        let Self { id, bits, bytes, vk_format, functions, .. } = *self;
        let (element, functions) = (Element::Frame, AnyFunctions::Frame(functions));
        let (vk_format, domain) = (Some(vk_format), Domain::Sphere);
        Format { id, bits, bytes, element, vk_format, domain, encodes_by_table: false, functions }
    }

    fn functions(&self) -> &Functions<7> {
        &self.functions
    }
}

/// What a codec does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Operation {
    /// Vectors or frames to codes.
    Encode,
    /// Codes to vectors or frames.
    Decode,
}

impl Operation {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Encode, Self::Decode];
}

impl std::fmt::Display for Operation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Encode => "encode",
            Self::Decode => "decode",
        })
    }
}

/// No codec has this identifier.
#[derive(Clone, Debug, thiserror::Error)]
#[error("unknown codec `{id}`; {}`unitvec codecs` lists them all", suggestion(id))]
pub struct UnknownCodec {
    /// What was asked for.
    pub id: String,
}

/// Codecs whose identifier or survey name is this one but for case, or else that begin with the same letters.
fn suggestion(id: &str) -> String {
    if find_frame(id).is_some() {
        return "it is a codec of tangent frames: see `find_frame`; ".to_owned();
    }
    let letters =
        |text: &str| text.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default().to_lowercase();
    let codecs = CATALOGUE.iter().map(|codec| (codec.id, codec.survey_name));
    let names: Vec<_> = codecs.chain(FRAMES.iter().map(|codec| (codec.id, codec.id))).collect();
    let close = |is_close: &dyn Fn(&str, &str) -> bool| -> Vec<&str> {
        names.iter().filter(|(id, survey_name)| is_close(id, survey_name)).map(|(id, _)| *id).collect()
    };
    let mut found =
        close(&|other, survey_name| [other, survey_name].iter().any(|name| name.eq_ignore_ascii_case(id)));
    if found.is_empty() {
        found = close(&|other, _| letters(other) == letters(id));
    }
    if found.is_empty() { String::new() } else { format!("did you mean {}? ", found.join(", ")) }
}

/// The codec of vectors with this identifier.
///
/// # Errors
/// [`UnknownCodec`] where there is none.
pub fn find(id: &str) -> Result<&'static CodecInfo, UnknownCodec> {
    CATALOGUE.iter().find(|codec| codec.id == id).ok_or_else(|| UnknownCodec { id: id.to_owned() })
}

/// The codec of frames with this identifier.
pub fn find_frame(id: &str) -> Option<&'static FrameInfo> {
    FRAMES.iter().find(|codec| codec.id == id)
}

/// The format of the codec, of vectors or of frames, with this identifier.
///
/// # Errors
/// [`UnknownCodec`] where there is none.
pub fn find_format(id: &str) -> Result<Format, UnknownCodec> {
    formats().find(|format| format.id == id).ok_or_else(|| UnknownCodec { id: id.to_owned() })
}
