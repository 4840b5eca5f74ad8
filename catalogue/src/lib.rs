//! Every codec of [`unitvec`] by its identifier, for programs that choose one at run time: the properties of each, and
//! functions that encode and decode with it on the CPU, on all cores.
//!
//! ```
//! let codec = unitvec_catalogue::find("oct32p")?;
//! let mut codes = vec![0; 2 * codec.bytes];
//! codec.encode_cpu([[0.6, 0.0, -0.8], [0.0, 1.0, 0.0]].as_flattened(), &mut codes)?;
//! let mut vectors = [[0.0; 3]; 2];
//! codec.decode_cpu(&codes, vectors.as_flattened_mut())?;
//! assert_eq!(vectors[1], [0.0, 1.0, 0.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A program that knows its codec when it is written needs only [`unitvec`]. This crate compiles all of them, which takes
//! about a minute on two cores. With the feature `serde`, [`AnyCodec`], [`Element`] and [`Operation`] can be serialised;
//! with `schemars`, they have JSON schemas. With `compact`, slices of recommended codecs alone take wide instructions: the code is
//! smaller by half, for downloads.

mod callers;
mod cpu;
mod dither;
mod formats;
#[cfg(feature = "serde")]
mod json;
mod list;
mod null;
mod recommended;
mod wrapped;

use bytemuck::{cast_slice, cast_slice_mut};
use cpu::{AnyFunctions, Functions, resized, with_functions};
use std::hash::{Hash, Hasher};
use unitvec::direction::is_usable;
use unitvec::interop::UnknownFormat;
use unitvec::slice::machine::Level;
use unitvec::slice::{EncodeAt, expect_length, par_decode_with, par_encode_with};
use unitvec::{Codec, Listed, ListedFrame, ListedRotation, angle_deg, rotation_angle_deg};
#[cfg(doc)]
use unitvec::{FrameCodec, RotationCodec};

pub use callers::{Manner, NotForDirections, has_threads};
pub use cpu::best_fit_table;
pub use dither::{Dither, NoDither};
pub use formats::{find_any, formats};
pub use list::{CODECS, directions, frames, rotations, vectors};
pub use null::{NoNull, Null};
pub use recommended::{Choice, FORMATS, Format, Measured, RECOMMENDED, Recommendation, Usage};
pub use unitvec::Domain;
pub use unitvec::slice::LengthMismatch;
pub use wrapped::{Measure, WRAPPED};

/// A codec of vectors, frames or rotations: its properties and its CPU functions. Two codecs with one identifier are equal.
#[derive(Clone, Copy, Debug)]
pub struct AnyCodec {
    /// Identifier, as in `--codec`, the entry points and the GLSL functions: `oct16p`.
    pub id: &'static str,
    /// Name of the codec's type in [`unitvec`]: `OctPrecise16`.
    pub rust_type: &'static str,
    /// The survey's name, `oct16P`; for other codecs of vectors a name in the same style, and for those of frames and rotations
    /// `id`.
    pub survey_name: &'static str,
    /// The family: its module in [`unitvec`] and, with `.glsl`, the GLSL include file with its functions.
    pub family: &'static str,
    /// The kind of element that it encodes.
    pub element: Element,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// The Vulkan format with the code's layout, where there is one.
    pub vk_format: Option<&'static str>,
    /// The directions that the codec is made for.
    pub domain: Domain,
    /// True where decoded vectors have unit length; false for raw component formats.
    pub is_unit: bool,
    /// True where the directions of the domain's axes come back exactly, of rotations the 24 that keep a cube. Codecs of frames
    /// do not promise it.
    pub exact_axes: bool,
    /// True where every device encodes any other device's decoded element to a code of the same element.
    pub stable_across_devices: bool,
    /// Upper bounds of the errors over the domain, in degrees: one for each of [`Element::directions`].
    pub max_errors_deg: &'static [f32],
    /// The null code, low word first: [`Codec::NULL`]. Codecs of frames and rotations have none. See [`null`](Self::null).
    pub null: Option<[u32; 2]>,
    /// True where the encoder looks lengths up in the table of [`unitvec::best_fit`]: its kernel binds it.
    pub encodes_by_table: bool,
    functions: AnyFunctions,
}

impl PartialEq for AnyCodec {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for AnyCodec {}

impl Hash for AnyCodec {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.id.hash(state);
    }
}

impl AnyCodec {
    const fn of_vectors<C: Listed>() -> Self {
        Self {
            survey_name: C::SURVEY_NAME,
            vk_format: C::VK_FORMAT,
            domain: C::DOMAIN,
            ..Self::of_codec::<C>(C::NAME, C::RUST_TYPE, C::FAMILY)
        }
    }

    /// A codec of vectors that is a type.
    const fn of_codec<C: Codec>(id: &'static str, rust_type: &'static str, family: &'static str) -> Self {
        Self {
            id,
            rust_type,
            survey_name: id,
            family,
            element: Element::Vector,
            bits: C::BITS,
            bytes: C::BYTES,
            vk_format: None,
            domain: Domain::Sphere,
            is_unit: C::IS_UNIT,
            exact_axes: C::EXACT_AXES,
            stable_across_devices: C::STABLE_ACROSS_DEVICES,
            max_errors_deg: const { &[C::MAX_ERROR_DEG] },
            null: C::NULL,
            encodes_by_table: false,
            functions: AnyFunctions::Vector(Functions::of_vectors::<C>(id)),
        }
    }

    /// The codec, encoding by the table of [`unitvec::best_fit`].
    const fn by_table(self, encode: EncodeAt<[f32; 3]>) -> Self {
        let AnyFunctions::Vector(functions) = self.functions else { return self };
        let functions = AnyFunctions::Vector(Functions { encode, ..functions });
        Self { encodes_by_table: true, functions, ..self }
    }

    const fn of_frames<F: ListedFrame>() -> Self {
        Self {
            id: F::NAME,
            rust_type: F::RUST_TYPE,
            survey_name: F::NAME,
            family: "frame",
            element: Element::Frame,
            bits: F::BITS,
            bytes: F::BYTES,
            vk_format: Some(F::VK_FORMAT),
            domain: Domain::Sphere,
            is_unit: true,
            exact_axes: false,
            stable_across_devices: true,
            max_errors_deg: const { &[F::MAX_NORMAL_ERROR_DEG, F::MAX_TANGENT_ERROR_DEG] },
            null: None,
            encodes_by_table: false,
            functions: AnyFunctions::Frame(Functions::of_frames::<F>()),
        }
    }

    const fn of_rotations<C: ListedRotation>() -> Self {
        Self {
            id: C::NAME,
            rust_type: C::RUST_TYPE,
            survey_name: C::NAME,
            family: "quat",
            element: Element::Rotation,
            bits: C::BITS,
            bytes: C::BYTES,
            vk_format: C::VK_FORMAT,
            domain: Domain::Sphere,
            is_unit: true,
            exact_axes: true,
            stable_across_devices: true,
            max_errors_deg: const { &[C::MAX_ERROR_DEG] },
            null: None,
            encodes_by_table: false,
            functions: AnyFunctions::Rotation(Functions::of_rotations::<C>()),
        }
    }

    /// Upper bound of the error over the domain, in degrees; for frames the greater of the normal's and the tangent's.
    pub fn max_error_deg(&self) -> f32 {
        self.max_errors_deg.iter().copied().fold(0.0, f32::max)
    }

    fn is_named(&self, name: &str) -> bool {
        [self.id, self.survey_name, self.rust_type].iter().any(|own| own.eq_ignore_ascii_case(name))
    }

    /// The GLSL include file with its functions: `oct.glsl`.
    pub fn glsl_file(&self) -> String {
        format!("{}.glsl", self.family)
    }

    /// Entry point of the kernel, and name of the GLSL function, of this operation: `oct16_encode`.
    pub fn function(&self, operation: Operation) -> String {
        format!("{}_{operation}", self.id)
    }

    /// The number of elements, where slices of these lengths hold equally many.
    ///
    /// # Errors
    /// [`LengthMismatch`] where the numbers differ, or where a slice ends within an element.
    pub fn count(&self, floats: usize, code_bytes: usize) -> Result<usize, LengthMismatch> {
        let count = floats / self.element.floats();
        expect_length(count * self.bytes, code_bytes)?;
        // Floats beyond the last whole element ask for one code more.
        expect_length(floats.div_ceil(self.element.floats()) * self.bytes, code_bytes)?;
        Ok(count)
    }

    /// Encodes elements, whose floats follow each other, on the CPU, on all cores: little endian, without gaps.
    ///
    /// # Errors
    /// The error of [`count`](Self::count). Nothing is written then.
    pub fn encode_cpu(&self, elements: &[f32], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        with_functions!(self, it => par_encode_with(cast_slice(elements), codes, self.bytes, it.encode))
    }

    /// Decodes codes, as [`encode_cpu`](Self::encode_cpu) makes them, on the CPU, on all cores.
    ///
    /// # Errors
    /// The error of [`count`](Self::count). Nothing is written then.
    pub fn decode_cpu(&self, codes: &[u8], elements: &mut [f32]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        with_functions!(self, it => par_decode_with(codes, cast_slice_mut(elements), self.bytes, it.decode_at))
    }

    /// Encodes as [`encode_cpu`](Self::encode_cpu) does, on the calling thread alone.
    ///
    /// # Errors
    /// The error of [`count`](Self::count). Nothing is written then.
    pub fn encode_here(&self, elements: &[f32], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        with_functions!(self, it => (it.encode)(Level::best(), cast_slice(elements), codes))
    }

    /// Decodes as [`decode_cpu`](Self::decode_cpu) does, on the calling thread alone.
    ///
    /// # Errors
    /// The error of [`count`](Self::count). Nothing is written then.
    pub fn decode_here(&self, codes: &[u8], elements: &mut [f32]) -> Result<(), LengthMismatch> {
        self.decode_at(Level::best(), codes, elements)
    }

    /// Encodes as [`encode_here`](Self::encode_here) does, with the instructions of a given level and without a table.
    #[doc(hidden)]
    pub fn encode_at(&self, level: Level, elements: &[f32], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        with_functions!(self, it => (it.encode_at)(level, cast_slice(elements), codes))
    }

    /// Decodes as [`decode_here`](Self::decode_here) does, with the instructions of a given level.
    #[doc(hidden)]
    pub fn decode_at(&self, level: Level, codes: &[u8], elements: &mut [f32]) -> Result<(), LengthMismatch> {
        self.count(elements.len(), codes.len())?;
        with_functions!(self, it => (it.decode_at)(level, codes, cast_slice_mut(elements)))
    }

    /// [`Codec::encode`], [`FrameCodec::encode`] or [`RotationCodec::encode`] of one element: the low word first. `N` is 3 for
    /// vectors, 7 for frames and 4 for rotations; floats that lack count as 0, and those beyond are left out.
    pub fn encode_one<const N: usize>(&self, element: [f32; N]) -> [u32; 2] {
        with_functions!(self, it => (it.encode_one)(resized(element)))
    }

    /// [`Codec::decode`], [`FrameCodec::decode`] or [`RotationCodec::decode`] of one code, the low word first. `N` is as in
    /// [`encode_one`](Self::encode_one).
    pub fn decode_one<const N: usize>(&self, code: [u32; 2]) -> [f32; N] {
        with_functions!(self, it => resized((it.decode_one)(code)))
    }
}

/// The kind of element that a codec encodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub enum Element {
    /// Vectors of three floats.
    Vector,
    /// Tangent frames of seven: normal, tangent, handedness.
    Frame,
    /// Rotations of four: the unit quaternion x, y, z, w.
    Rotation,
}

impl Element {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Vector, Self::Frame, Self::Rotation];

    /// The number of f32 in an element.
    pub const fn floats(self) -> usize {
        self.row().0
    }

    /// The element's size as packed f32.
    pub const fn bytes(self) -> usize {
        4 * self.floats()
    }

    /// `vectors`, `frames` or `rotations`.
    pub const fn plural(self) -> &'static str {
        self.row().1
    }

    /// The parts of an element that have an error: `direction` for a vector, `normal` and `tangent` for a frame, `rotation`.
    pub const fn directions(self) -> &'static [&'static str] {
        self.row().2
    }

    /// The number of f32 of each part: three components, or the four of a quaternion.
    pub const fn part_floats(self) -> usize {
        match self {
            Self::Vector | Self::Frame => 3,
            Self::Rotation => 4,
        }
    }

    /// A part of an element, by its place in [`directions`](Self::directions).
    pub fn part(self, element: &[f32], index: usize) -> &[f32] {
        &element[index * self.part_floats()..][..self.part_floats()]
    }

    /// The parts of an element, in the order of [`directions`](Self::directions).
    pub fn parts(self, element: &[f32]) -> impl Iterator<Item = &[f32]> {
        element.chunks_exact(self.part_floats()).take(self.directions().len())
    }

    const fn row(self) -> (usize, &'static str, &'static [&'static str]) {
        match self {
            Self::Vector => (3, "vectors", &["direction"]),
            Self::Frame => (7, "frames", &["normal", "tangent"]),
            Self::Rotation => (4, "rotations", &["rotation"]),
        }
    }
}

/// True where a part of an element has a direction that codecs can use: see [`unitvec::direction`].
pub fn has_direction(part: &[f32]) -> bool {
    is_usable(part.iter().map(|component| component.abs()).sum())
}

/// The angle between two parts of elements, in degrees: of rotations that of the rotation between them. NaN where a component is
/// infinite or NaN.
pub fn angle_between_parts_deg(a: &[f32], b: &[f32]) -> f64 {
    match (a, b) {
        (&[x, y, z, w], &[to_x, to_y, to_z, to_w]) => {
            rotation_angle_deg([x, y, z, w], [to_x, to_y, to_z, to_w])
        }
        (&[x, y, z], &[to_x, to_y, to_z]) => angle_deg([x, y, z], [to_x, to_y, to_z]),
        _ => f64::NAN,
    }
}

/// An operation of a codec.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
pub enum Operation {
    /// Elements to codes.
    Encode,
    /// Codes to elements.
    Decode,
}

impl Operation {
    /// Both operations.
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

/// No codec has this name.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", message(id, of_format.as_ref()))]
pub struct UnknownCodec {
    /// The name asked for.
    pub id: String,
    /// The error of a format of other software, where one begins so.
    pub of_format: Option<UnknownFormat>,
}

fn message(id: &str, of_format: Option<&UnknownFormat>) -> String {
    match of_format {
        Some(error) => error.to_string(),
        None => format!("unknown codec `{id}`; {}`unitvec codecs` lists them all", suggestion(id)),
    }
}

/// Codecs and formats of the same letters and digits, or else codecs that begin with the same letters.
fn suggestion(name: &str) -> String {
    if frames().iter().any(|codec| codec.is_named(name)) {
        return "it is a codec of tangent frames; ".to_owned();
    }
    if WRAPPED.iter().any(|codec| codec.is_named(name)) {
        return "it is for `encode`, `decode` and `error` alone; ".to_owned();
    }
    let ids = || CODECS.iter().chain(&WRAPPED).map(|codec| codec.id);
    let plain = |text: &str| text.to_ascii_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "");
    let same = ids().chain(formats().iter().map(|format| format.id)).filter(|id| plain(id) == plain(name));
    let mut close: Vec<&str> = same.filter(|id| *id != name).collect();
    if close.is_empty() {
        let letters = |text: &str| {
            text.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default().to_ascii_lowercase()
        };
        close = ids().filter(|id| letters(id) == letters(name)).collect();
    }
    if close.is_empty() { String::new() } else { format!("did you mean {}? ", close.join(", ")) }
}

/// The integer of these bytes, of which the first is the lowest.
fn integer(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
}

/// The codec of this name: its identifier, the survey's name, or the name of its type, in upper or lower case.
///
/// ```
/// for name in ["oct24p", "oct24P", "OctPrecise24", "OCT24P"] {
///     assert_eq!(unitvec_catalogue::find(name)?.id, "oct24p");
/// }
/// # Ok::<(), unitvec_catalogue::UnknownCodec>(())
/// ```
///
/// # Errors
/// [`UnknownCodec`] if no codec has it.
pub fn find(name: &str) -> Result<&'static AnyCodec, UnknownCodec> {
    find_among(&CODECS, name)
}

/// The codec of vectors of this name, as [`find`] takes it.
///
/// # Errors
/// [`UnknownCodec`] if no codec of vectors has it.
pub fn find_vector(name: &str) -> Result<&'static AnyCodec, UnknownCodec> {
    find_among(vectors(), name)
}

fn find_among(codecs: &'static [AnyCodec], name: &str) -> Result<&'static AnyCodec, UnknownCodec> {
    codecs
        .iter()
        .find(|codec| codec.is_named(name))
        .ok_or_else(|| UnknownCodec { id: name.to_owned(), of_format: None })
}
