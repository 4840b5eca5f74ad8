//! Rotations in the formats of other software: unit quaternions x, y, z, w, of which q and -q are one rotation.
//!
//! ```
//! use unitvec::{interop::RotationFormat, rotation_angle_deg};
//!
//! let format = RotationFormat::named("spz")?;
//! let turn = [0.18, 0.36, 0.54, 0.74];
//! let nearest = format.decode(format.encode(turn));
//! let plain = format.decode(format.plain().encode(turn));
//! assert!(rotation_angle_deg(turn, nearest) <= rotation_angle_deg(turn, plain));
//! # Ok::<(), unitvec::interop::UnknownFormat>(())
//! ```
//!
//! Most formats drop one component, the largest, and store the other three in equal steps; the decoder takes it back from the
//! length of 1, whether it is the largest or not. So a rotation lies in up to four *charts*, one for each dropped component.
//! Charts stretch distances, and by twice where all components are equal: there rounding each number misses the nearest code
//! of the chart, and another chart, in which the rotation lies between other codes, has one that is nearer still for one
//! rotation in six.
//!
//! Without a usable quaternion (zero, NaN, infinity) all encoders write the code of the identity. Of formats of unsigned
//! numbers no decoder gives the identity back, nor other rotations with components of 0.

use super::quaternion::unit;
use super::smallest_three::{FIEDLER_RANGE, Lattice, Layout, MIRROR_RANGE, Order, Original, Three};
use super::{UnknownFormat, four_components, joined, parted, width};
use crate::codec::storage_bytes;
use crate::slice::{LengthMismatch, load_each, store_each};
use core::f64::consts::FRAC_1_SQRT_2;
use core::fmt;

/// A format of rotations, with the nearest or the [plain](Self::plain) encoder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationFormat {
    /// The name, without a width.
    pub name: &'static str,
    /// The bits of a component, the sign's included.
    pub component_bits: u32,
    /// The least and the greatest number of them.
    pub widths: [u32; 2],
    /// The source of encoder and decoder: repository, commit, file.
    pub source: &'static str,
    /// The bits of a code, the low ones first.
    pub layout: &'static str,
    /// The original's answer to a quaternion of length 0.
    pub zero: &'static str,
    packing: Packing,
    is_plain: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Packing {
    /// Three components; the fourth is at least 0.
    Three(Three),
    /// Four components in signed lanes.
    Four,
}

/// All formats of rotations, with the least width where there are several.
pub static ROTATIONS: [RotationFormat; 10] = {
    use Lattice::{Signed, Snorm, Unorm};
    use Layout::{IndexHigh, IndexLow, Lanes, NoIndex, Rgba};
    use Order::{Cyclic, W1, W4, Xyz};
    use Original::{Fiedler, League, Meshopt, Mirror, Ply, Sog, Spz, Spz2};
    use Packing::Four;
    type Text = &'static str;
    const fn of(name: Text, widths: [u32; 2], packing: Packing, texts: [Text; 3]) -> RotationFormat {
        let ([source, layout, zero], component_bits) = (texts, widths[0]);
        RotationFormat { name, component_bits, widths, source, layout, zero, packing, is_plain: false }
    }
    const fn three(lattice: Lattice, range: f64, order: Order, layout: Layout, by: Original) -> Packing {
        Packing::Three(Three { lattice, range, order, layout, original: by })
    }
    const ROOT: f64 = FRAC_1_SQRT_2;
    const MIRROR: f64 = MIRROR_RANGE as f64;
    const FIEDLER: f64 = FIEDLER_RANGE as f64;
    const BY_MIRROR: Text = "MirrorNetworking/Mirror 2237ac3b, Assets/Mirror/Core/Tools/Compression.cs";
    const BY_LEAGUE: Text = "LeagueToolkit/LeagueToolkit 00515383, Core/Primitives/QuantizedQuaternion.cs";
    const BY_FIEDLER: Text = "GPopov/protocol2 08f26db5, 002_serialization_strategies.cpp: 2 to 10 bits";
    const BY_PLAYCANVAS: Text = "playcanvas/splat-transform 8d6b801f, src/lib/writers";
    const BY_SPZ: Text = "nianticlabs/spz 21715c38, src/cc/load-spz.cc and splat-utils.h: versions 3 and 4";
    const BY_SPZ2: Text = "nianticlabs/spz 21715c38, src/cc/load-spz.cc and splat-utils.h: versions 1 and 2";
    const BY_MESHOPT: Text = "zeux/meshoptimizer b5b2c439, src/vertexfilter.cpp; KHR_meshopt_compression";
    const BY_GLTF: Text = "glTF, KHR_gaussian_splatting; zeux/meshoptimizer b5b2c439, gltf/stream.cpp";
    const CBA: Text = "c, b, a, unsigned, of x, y, z, w without the largest; its index, 2 bits";
    const ABC: Text = "the index of the largest, 2 bits; a, b, c, unsigned, of x, y, z, w without it";
    const OF_W: Text = "c, b, a, unsigned, of w, x, y, z without the largest; its index, 2 bits";
    const BYTES: Text = "a, b, c, unsigned bytes, of w, x, y, z without the largest; 252 + its index";
    const SIGNS: Text = "c, b, a, 9 bits and a sign each, of x, y, z, w without the largest; its index";
    const XYZ: Text = "x, y, z, unsigned bytes, where w is at least 0";
    const WORDS: Text = "signed words: the three after the largest, in a circle; the largest number | index";
    const TURN: Text = "the code of a half turn about x";
    const TURN_Z: Text = "the code of a half turn about z";
    const REFUSED: Text = "0, which the validator refuses";
    const UNDEFINED: Text = "NaN: no defined code";
    [
        of("quat10x3", [10; 2], three(Unorm, MIRROR, W4, IndexHigh, Mirror), [BY_MIRROR, CBA, TURN]),
        of("quat15x3", [15; 2], three(Unorm, ROOT, W4, IndexHigh, League), [BY_LEAGUE, CBA, TURN]),
        of("smallest3", [4, 20], three(Unorm, FIEDLER, W4, IndexLow, Fiedler), [BY_FIEDLER, ABC, TURN]),
        of("playcanvas-ply", [10; 2], three(Unorm, ROOT, W1, IndexHigh, Ply), [BY_PLAYCANVAS, OF_W, TURN_Z]),
        of("sog", [8; 2], three(Unorm, ROOT, W1, Rgba, Sog), [BY_PLAYCANVAS, BYTES, "bytes 0, 0, 0, 252"]),
        of("spz", [10; 2], three(Signed, ROOT, W4, IndexHigh, Spz), [BY_SPZ, SIGNS, UNDEFINED]),
        of("spz2", [8; 2], three(Unorm, 1.0, Xyz, NoIndex, Spz2), [BY_SPZ2, XYZ, UNDEFINED]),
        of("meshopt-quat", [4, 16], three(Snorm, ROOT, Cyclic, Lanes, Meshopt), [BY_MESHOPT, WORDS, TURN]),
        of("gltf-quat8", [8; 2], Four, [BY_GLTF, "x, y, z, w, signed bytes", REFUSED]),
        of("gltf-quat16", [16; 2], Four, [BY_GLTF, "x, y, z, w, signed words", REFUSED]),
    ]
};

/// The name, as [`RotationFormat::named`] takes it.
impl fmt::Display for RotationFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        if self.widths[0] < self.widths[1] { write!(f, ":{}", self.component_bits) } else { Ok(()) }
    }
}

impl RotationFormat {
    /// The format of this name: `spz`, or `meshopt-quat:12` where there are several widths.
    ///
    /// # Errors
    /// [`UnknownFormat`], which lists the formats, or the widths of this one.
    pub fn named(name: &str) -> Result<Self, UnknownFormat> {
        let (base, bits) = name.split_once(':').map_or((name, None), |(base, bits)| (base, Some(bits)));
        let format = ROTATIONS.iter().find(|format| format.name.eq_ignore_ascii_case(base));
        let format = *format.ok_or_else(|| UnknownFormat::Name { name: name.to_owned() })?;
        Ok(Self { component_bits: width(format.name, format.widths, bits)?, ..format })
    }

    /// All formats, at each of their widths.
    pub fn all() -> impl Iterator<Item = Self> {
        ROTATIONS.iter().flat_map(|format| {
            (format.widths[0]..=format.widths[1]).map(|component_bits| Self { component_bits, ..*format })
        })
    }

    /// The same format with the plain encoder of the original.
    #[must_use]
    pub fn plain(self) -> Self {
        Self { is_plain: true, ..self }
    }

    /// Significant bits of a code.
    pub fn bits(self) -> u32 {
        let Packing::Three(Three { layout, .. }) = self.packing else { return 4 * self.component_bits };
        match layout {
            Layout::Lanes => 64,
            Layout::Rgba => 32,
            Layout::NoIndex => 24,
            Layout::IndexHigh | Layout::IndexLow => 3 * self.component_bits + 2,
        }
    }

    /// Bytes of a stored code.
    pub fn bytes(self) -> usize {
        storage_bytes(self.bits())
    }

    /// An upper bound of the nearest encoder's error, in degrees of rotation.
    pub fn max_error_deg(self) -> f32 {
        let radians = match self.packing {
            Packing::Three(three) => three.bound(self.component_bits),
            Packing::Four => four_components::bound(self.component_bits),
        };
        radians.to_degrees() as f32
    }

    /// The code of a rotation: of a quaternion of any length, in x, y, z, w.
    #[must_use]
    pub fn encode(self, q: impl Into<[f32; 4]>) -> u64 {
        const IDENTITY: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
        let q = q.into();
        let is_usable = q.iter().all(|c| c.is_finite()) && q != [0.0; 4];
        let q = if is_usable { q } else { IDENTITY };
        match self.packing {
            Packing::Three(three) if self.is_plain => three.plain(q, self.component_bits),
            Packing::Three(three) => three.nearest(unit(q), self.component_bits),
            Packing::Four => four_components::encode(q, self.component_bits, self.is_plain),
        }
    }

    /// The quaternion of a code, of unit length to within 2 ULP; with `meshopt-quat` and glTF's as their integers have it.
    /// A component that is dropped is at least 0. Where the others are longer than 1, which only `spz2` writes, it is 0.
    #[must_use]
    pub fn decode(self, code: u64) -> [f32; 4] {
        match self.packing {
            Packing::Three(three) => three.decode(code, self.component_bits),
            Packing::Four => four_components::decode(code, self.component_bits),
        }
    }

    /// [`encode`](Self::encode) as words, low word first.
    #[doc(hidden)]
    pub fn encode_words(self, q: [f32; 4]) -> [u32; 2] {
        parted(self.encode(q))
    }

    /// [`decode`](Self::decode) of words, low word first.
    #[doc(hidden)]
    pub fn decode_words(self, code: [u32; 2]) -> [f32; 4] {
        self.decode(joined(code))
    }

    /// [`encode`](Self::encode) of each rotation, into [`bytes`](Self::bytes) little-endian bytes each, without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `codes` is as long as the rotations' codes. Nothing is written then.
    pub fn encode_slice(self, rotations: &[[f32; 4]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        store_each(rotations, codes, self.bytes(), |q| self.encode_words(*q))
    }

    /// The reverse of [`encode_slice`](Self::encode_slice).
    ///
    /// # Errors
    /// The errors of [`encode_slice`](Self::encode_slice).
    pub fn decode_slice(self, codes: &[u8], rotations: &mut [[f32; 4]]) -> Result<(), LengthMismatch> {
        load_each(codes, rotations, self.bytes(), |code| self.decode_words(code))
    }
}
