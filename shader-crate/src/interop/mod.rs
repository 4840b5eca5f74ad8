//! Formats of other software: the nearest code in each, with no decoder changed.
//!
//! Most files have normals that somebody's plain rounding wrote. Their decoders stay, their encoders need not: here each
//! format has an encoder that finds the code that its decoder brings nearest, and beside it the plain encoder of the
//! original, bit for bit, for who must match it.
//!
//! ```
//! use unitvec::angle_deg;
//! use unitvec::interop::Format;
//!
//! let format = Format::named("tiles3d-oct16")?;
//! let normal = [0.36, 0.48, 0.8];
//! let nearest: [f32; 3] = format.decode(format.encode(normal));
//! let plain: [f32; 3] = format.decode(format.plain().encode(normal));
//! assert!(angle_deg(normal, nearest) <= angle_deg(normal, plain));
//! # Ok::<(), unitvec::interop::UnknownFormat>(())
//! ```
//!
//! [`RotationFormat`] has formats of unit quaternions.
//!
//! A format is a value: a lattice of so many bits, the axis of the pole, the order of bits, and the original's rounding; its
//! name is `draco:10` where it has several widths. [`Format::all`] lists them, `docs/interop.md` of the repository has
//! their errors, sources and the tools that they were run against.
//!
//! * Codes are little endian in [`Format::bytes`] bytes. All functions are total. Vectors without a usable direction (see
//!   [`direction`](crate::direction)) get the code of +Z, whatever the original does; [`Format::null`] is a code that stands
//!   for no vector, where there is one.
//! * Decoding gives the direction that a code stands for, of unit length to within 2 ULP, but for formats whose decoders
//!   give integers: there it gives these, scaled. Originals round otherwise in the last bits.
//! * It needs the feature `std`, and is for CPUs.

/// What becomes of a value that is taken three times, with 0, 1 and -1. Written out: around a loop, and around calls of closures,
/// the compiler makes no vector instructions.
macro_rules! three {
    ($value:expr, |$taken:ident, $step:ident| $next:expr) => {{
        let ($taken, $step) = ($value, 0.0);
        let ($taken, $step) = ($next, 1.0);
        let ($taken, $step) = ($next, -1.0);
        $next
    }};
}

#[cfg(not(target_family = "wasm"))]
mod bytes;
mod components;
mod four_components;
mod frames;
mod list;
mod nearest;
mod octahedral;
mod plain;
mod quaternion;
mod rotations;
mod smallest_three;
mod tetrahedron;
mod turn;

use crate::direction::or_z;
use crate::slice::machine::Level;
use crate::slice::{
    Coder, LengthMismatch, StrideError, Strided, Vector, decode_slice_by, decode_strided_with,
    encode_slice_by, encode_strided_with,
};
use core::fmt;
pub use frames::{FRAMES, FrameFormat, decode_angle, encode_angle};
use glam::Vec3;
use list::Mapping;
pub use list::{ROWS, Row};
use octahedral::with_lattice;
pub use rotations::{ROTATIONS, RotationFormat};

/// A format of other software, of a number of bits, with the nearest or the [plain](Self::plain) encoder.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    row: &'static Row,
    bits: u32,
    is_plain: bool,
}

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        (self.row.name, self.bits, self.is_plain) == (other.row.name, other.bits, other.is_plain)
    }
}

impl Eq for Format {}

/// The name, as [`Format::named`] takes it.
impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.row.has_widths() {
            true => write!(f, "{}:{}", self.row.name, self.bits),
            false => f.write_str(self.row.name),
        }
    }
}

/// No format has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnknownFormat {
    /// No format begins so.
    Name {
        /// The name asked for.
        name: String,
    },
    /// The format has other widths.
    Bits {
        /// The name of the format, without a width.
        format: &'static str,
        /// Its least number of bits.
        least: u32,
        /// Its greatest number of bits.
        most: u32,
    },
}

impl fmt::Display for UnknownFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name { name } => {
                let name: String = name.escape_debug().take(60).collect();
                write!(f, "unknown format `{name}`; there are")?;
                ROWS.iter().try_for_each(|row| write!(f, " {row}"))?;
                FRAMES.iter().try_for_each(|frames| write!(f, " {}", frames.name))?;
                ROTATIONS.iter().try_for_each(|rotations| write!(f, " {}", rotations.name))
            }
            Self::Bits { format, least, most } if least == most => {
                write!(f, "{format} has one width; leave it out")
            }
            Self::Bits { format, least, most } => {
                write!(f, "{format} has {least} to {most} bits; name a number of them, as {format}:{most}")
            }
        }
    }
}

impl core::error::Error for UnknownFormat {}

impl Format {
    /// The format of this name: `tiles3d-oct16`, or `draco:10` where there are several widths.
    ///
    /// # Errors
    /// [`UnknownFormat`], which lists the formats, or the widths of this one.
    pub fn named(name: &str) -> Result<Self, UnknownFormat> {
        let (base, bits) = name.split_once(':').map_or((name, None), |(base, bits)| (base, Some(bits)));
        let row = ROWS.iter().find(|row| row.name.eq_ignore_ascii_case(base));
        let row = row.ok_or_else(|| UnknownFormat::Name { name: name.to_owned() })?;
        let bits = width(row.name, row.widths, bits)?;
        Ok(Self { row, bits, is_plain: false })
    }

    /// All formats, at each of their widths.
    pub fn all() -> impl Iterator<Item = Self> {
        ROWS.iter().flat_map(|row| {
            (row.widths[0]..=row.widths[1]).map(move |bits| Self { row, bits, is_plain: false })
        })
    }

    /// The same format with the plain encoder of the original.
    #[must_use]
    pub fn plain(self) -> Self {
        Self { is_plain: true, ..self }
    }

    /// The facts that do not depend on the width.
    pub fn row(self) -> &'static Row {
        self.row
    }

    /// The number of bits in the name: of a component, mostly.
    pub fn component_bits(self) -> u32 {
        self.bits
    }

    /// Significant bits of a code.
    pub fn bits(self) -> u32 {
        match self.row.mapping {
            Mapping::Octahedral { layout, .. } => layout.bits(self.bits),
            Mapping::Tetrahedron => 22,
            Mapping::Snorm => 3 * self.bits,
        }
    }

    /// Bytes of a stored code, unused lanes included.
    pub fn bytes(self) -> usize {
        match self.row.mapping {
            Mapping::Octahedral { layout, .. } => layout.bytes(self.bits),
            Mapping::Tetrahedron => 4,
            Mapping::Snorm => self.bits as usize / 2,
        }
    }

    /// A code that the encoder never writes and that stands for no vector: where the format's users take it for that, or
    /// where a pattern is free. Cesium's plain encoder writes its code 0, and has none.
    pub fn null(self) -> Option<u64> {
        let is_written = self.is_plain && matches!(self.row.mapping, Mapping::Octahedral { .. });
        self.row.null.filter(|code| !is_written || *code != 0)
    }

    /// An upper bound of the nearest encoder's error, in degrees.
    pub fn max_error_deg(self) -> f32 {
        match self.row.mapping {
            Mapping::Octahedral { lattice, layout, .. } => {
                lattice.bound_deg(self.bits) + layout.rounding_deg()
            }
            Mapping::Tetrahedron => tetrahedron::BOUND_DEG,
            Mapping::Snorm => components::bound_deg(self.bits),
        }
    }

    /// The code of the direction of `v`, whose length does not matter.
    #[must_use]
    pub fn encode<V: Into<[f32; 3]>>(self, v: V) -> u64 {
        joined(self.encode_words(v.into()))
    }

    /// The direction of a code. Bits above [`bits`](Self::bits), and lanes that hold no direction, are ignored.
    #[must_use]
    pub fn decode<V: From<[f32; 3]>>(self, code: u64) -> V {
        self.decode_words(parted(code)).into()
    }

    /// The vector to give to the original's encoder, so that it writes the nearest code that it can: of vectors that stand for
    /// the nearest code or for others beside it, and `v` itself, the first that comes out best. So it never does worse than
    /// the original with `v`.
    #[must_use]
    pub fn snap<V: Into<[f32; 3]> + From<[f32; 3]>>(self, v: V) -> V {
        let v = usable(v.into());
        let code = || Self { is_plain: false, ..self }.encode_words(v.to_array());
        let written = |v: &Vec3| self.decode_words(self.plain().encode_words(v.to_array())).into();
        let snapped = match self.row.mapping {
            Mapping::Octahedral { lattice, layout, pole_x, .. } => {
                let numbers = layout.numbers(code(), lattice.sign(self.bits), self.bits);
                // Parts of a step, around the middle of what the original rounds or truncates to the code.
                let aims = around([0, 0], [0, 1, -1]).map(|aim| aim.map(|i| self.row.aim + 0.25 * i as f32));
                let beside = aims.map(|aim| lattice.direction(self.bits, numbers, pole_x, aim));
                nearest_of(v, beside.chain([v]), written)
            }
            Mapping::Tetrahedron => nearest_of(v, [tetrahedron::decode(code()[0]), v].into_iter(), written),
            Mapping::Snorm => nearest_of(v, components::neighbours(v, self.bits).chain([v]), written),
        };
        snapped.unwrap_or(v).to_array().into()
    }

    /// [`encode`](Self::encode), to the low and the high word.
    #[doc(hidden)]
    pub fn encode_words(self, direction: [f32; 3]) -> [u32; 2] {
        let v = usable(direction);
        match self.row.mapping {
            Mapping::Octahedral { layout, plain, .. } if self.is_plain => {
                layout.code(plain(v, self.bits), self.bits)
            }
            Mapping::Octahedral { lattice, layout, pole_x, .. } => {
                // Of any length, as in slices: scaled, a component that becomes 0 would lose its sign.
                lattice.nearest_code(or_z(direction.into()).0, self.bits, pole_x, layout)
            }
            Mapping::Tetrahedron if self.is_plain => tetrahedron::plain(v),
            Mapping::Tetrahedron => tetrahedron::Nearest.encode(direction),
            Mapping::Snorm => components::encode(v, self.bits, self.is_plain),
        }
    }

    /// [`decode`](Self::decode), of the low and the high word.
    #[doc(hidden)]
    pub fn decode_words(self, code: [u32; 2]) -> [f32; 3] {
        let v = match self.row.mapping {
            Mapping::Octahedral { lattice, layout, pole_x, .. } => {
                layout.decode(code, lattice, pole_x, self.bits)
            }
            Mapping::Tetrahedron => tetrahedron::decode(code[0]),
            Mapping::Snorm => components::decode(code, self.bits),
        };
        v.to_array()
    }

    /// [`encode`](Self::encode) of each vector, into [`bytes`](Self::bytes) little-endian bytes each, without gaps: several
    /// at a time for octahedral formats, as [`slice`](mod@crate::slice) does.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `codes` is as long as the vectors' codes. Nothing is written then.
    pub fn encode_slice(self, vectors: &[impl Vector], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.encode_slice_at(Level::best(), vectors, codes)
    }

    /// The reverse of [`encode_slice`](Self::encode_slice).
    ///
    /// # Errors
    /// The errors of [`encode_slice`](Self::encode_slice).
    pub fn decode_slice(self, codes: &[u8], vectors: &mut [impl Vector]) -> Result<(), LengthMismatch> {
        self.decode_slice_at(Level::best(), codes, vectors)
    }

    /// [`encode_slice`](Self::encode_slice) among other fields: see [`slice::encode_strided`](crate::slice::encode_strided).
    ///
    /// # Errors
    /// [`StrideError`] where the vectors or the codes do not fit their bytes or are not equally many.
    pub fn encode_strided(
        self,
        vectors: Strided<&[u8]>,
        codes: Strided<&mut [u8]>,
    ) -> Result<(), StrideError> {
        let encode =
            |level, vectors: &[_], codes: &mut [u8]| self.encode_slice_at::<[f32; 3]>(level, vectors, codes);
        encode_strided_with::<3>(Level::best(), vectors, codes, self.bytes(), encode)
    }

    /// The reverse of [`encode_strided`](Self::encode_strided).
    ///
    /// # Errors
    /// The errors of [`encode_strided`](Self::encode_strided).
    pub fn decode_strided(
        self,
        codes: Strided<&[u8]>,
        vectors: Strided<&mut [u8]>,
    ) -> Result<(), StrideError> {
        let decode =
            |level, codes: &[u8], vectors: &mut [_]| self.decode_slice_at::<[f32; 3]>(level, codes, vectors);
        decode_strided_with::<3>(Level::best(), codes, vectors, self.bytes(), decode)
    }

    /// [`encode_slice`](Self::encode_slice) with the instructions of a given level.
    #[doc(hidden)]
    pub fn encode_slice_at<V: Vector>(
        self,
        level: Level,
        vectors: &[V],
        codes: &mut [u8],
    ) -> Result<(), LengthMismatch> {
        #[cfg(not(target_family = "wasm"))]
        match self.row.mapping {
            Mapping::Tetrahedron if !self.is_plain => {
                return encode_slice_by(tetrahedron::Nearest, level, vectors, codes);
            }
            Mapping::Snorm if !self.is_plain && self.bits == 8 => {
                return bytes::encode_slice(level, vectors, codes);
            }
            _ => {}
        }
        with_lattice!(self, !self.is_plain,
            coder => encode_slice_by(coder, level, vectors, codes),
            encode_slice_by(self, level, vectors, codes))
    }

    /// [`decode_slice`](Self::decode_slice) with the instructions of a given level.
    #[doc(hidden)]
    pub fn decode_slice_at<V: Vector>(
        self,
        level: Level,
        codes: &[u8],
        vectors: &mut [V],
    ) -> Result<(), LengthMismatch> {
        with_lattice!(self, true,
            coder => decode_slice_by(coder, level, codes, vectors),
            decode_slice_by(self, level, codes, vectors))
    }
}

/// The width after a format's name: none where there is but one.
fn width(format: &'static str, [least, most]: [u32; 2], bits: Option<&str>) -> Result<u32, UnknownFormat> {
    let bits = match (least != most, bits) {
        (true, Some(bits)) => bits.parse().ok().filter(|bits| (least..=most).contains(bits)),
        (false, None) => Some(least),
        _ => None,
    };
    bits.ok_or(UnknownFormat::Bits { format, least, most })
}

/// The vector, or +Z where it has no usable direction, of a length whose square is a normal number.
fn usable(v: [f32; 3]) -> Vec3 {
    const FAR: f32 = 1.099_511_6e12;
    let (v, norm) = or_z(Vec3::from_array(v));
    // Powers of two change no digit.
    let up = if norm < 1.0 / FAR { FAR } else { 1.0 };
    v * if norm > FAR { 1.0 / (FAR * FAR) } else { up }
}

/// A code of two words, the low one first.
fn joined([low, high]: [u32; 2]) -> u64 {
    u64::from(low) | u64::from(high) << 32
}

/// The reverse of [`joined`].
fn parted(code: u64) -> [u32; 2] {
    [code as u32, (code >> 32) as u32]
}

/// One vector at a time.
impl Coder<3> for Format {
    fn bytes(self) -> usize {
        self.bytes()
    }

    fn encode(self, v: [f32; 3]) -> [u32; 2] {
        self.encode_words(v)
    }

    fn decode(self, code: [u32; 2]) -> [f32; 3] {
        self.decode_words(code)
    }
}

/// Of these candidates the one whose vector is nearest in angle to `v`, the first of equals.
fn nearest_of<T>(v: Vec3, candidates: impl Iterator<Item = T>, vector: impl Fn(&T) -> Vec3) -> Option<T> {
    let mut best = None;
    // A loop: of `reduce` the compiler leaves calls for each candidate.
    for candidate in candidates {
        let distance = distance(v, vector(&candidate));
        if best.as_ref().is_none_or(|(least, _)| distance < *least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The 3 by 3 points around one, by steps of x in this order, and of y for each.
fn around([x, y]: [i32; 2], steps: [i32; 3]) -> impl Iterator<Item = [i32; 2]> {
    steps.into_iter().flat_map(move |i| steps.map(move |j| [x + i, y + j]))
}

/// The square of the tangent of the angle between two directions, infinite from a right angle on: in float64, so that it
/// tells the codes of any format apart.
#[inline(always)]
fn distance(v: Vec3, w: Vec3) -> f64 {
    let (a, b, c) = (f64::from(v.x), f64::from(v.y), f64::from(v.z));
    let (x, y, z) = (f64::from(w.x), f64::from(w.y), f64::from(w.z));
    let (p, q, r) = (b * z - c * y, c * x - a * z, a * y - b * x);
    let along = (a * x + b * y) + c * z;
    if along > 0.0 { ((p * p + q * q) + r * r) / (along * along) } else { f64::INFINITY }
}
