//! The codecs to take for each use, and the formats that hold codes. README, docs, `unitvec choose` and `unitvec report`
//! read these tables.

use crate::{AnyCodec, Operation};
use Usage::{Attachment, Texture, Vertex};

/// A use of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Usage {
    /// A colour attachment that is read as a texture afterwards.
    Attachment,
    /// A texture.
    Texture,
    /// A vertex attribute.
    Vertex,
}

/// The names of a format of texels and vertices in the APIs, "" where one has none, and where it can be used.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Format {
    /// Vulkan's name, after `VK_FORMAT_`.
    pub vulkan: &'static str,
    /// Direct3D's name, after `DXGI_FORMAT_`. Feature level 11.0 requires each for every [`Usage`].
    pub dxgi: &'static str,
    /// OpenGL's internal format, after `GL_`.
    pub opengl: &'static str,
    /// Metal's `MTLPixelFormat` and `MTLVertexFormat`.
    pub metal: [&'static str; 2],
    /// WebGPU's texture format and vertex format.
    pub webgpu: [&'static str; 2],
    /// The uses that Vulkan requires of every device.
    pub promised: &'static [Usage],
}

const ALL: &[Usage] = &[Attachment, Texture, Vertex];

/// Rows of [`FORMATS`]: the names in Vulkan, Direct3D, OpenGL, Metal (texture, then vertex) and WebGPU (likewise).
macro_rules! formats {
    ($($vulkan:literal $dxgi:literal $opengl:literal $pixel:literal $metal:literal $texture:literal $webgpu:literal:
        $promised:expr;)*) => {
        [$(Format {
            vulkan: $vulkan,
            dxgi: $dxgi,
            opengl: $opengl,
            metal: [$pixel, $metal],
            webgpu: [$texture, $webgpu],
            promised: $promised,
        }),*]
    };
}

/// The formats that hold codes, those that every device has first.
pub const FORMATS: [Format; 19] = formats! {
    "R32_UINT" "R32_UINT" "R32UI" "R32Uint" "UInt" "r32uint" "uint32": ALL;
    "R16_UINT" "R16_UINT" "R16UI" "R16Uint" "UShort" "r16uint" "uint16": ALL;
    "R8_UINT" "R8_UINT" "R8UI" "R8Uint" "UChar" "r8uint" "uint8": ALL;
    "R32G32_UINT" "R32G32_UINT" "RG32UI" "RG32Uint" "UInt2" "rg32uint" "uint32x2": ALL;
    "R8G8_SINT" "R8G8_SINT" "RG8I" "RG8Sint" "Char2" "rg8sint" "sint8x2": ALL;
    "R16G16_SINT" "R16G16_SINT" "RG16I" "RG16Sint" "Short2" "rg16sint" "sint16x2": ALL;
    "R16G16_SFLOAT" "R16G16_FLOAT" "RG16F" "RG16Float" "Half2" "rg16float" "float16x2": ALL;
    "R8G8_UNORM" "R8G8_UNORM" "RG8" "RG8Unorm" "UChar2Normalized" "rg8unorm" "unorm8x2": ALL;
    "R8G8B8A8_UNORM" "R8G8B8A8_UNORM" "RGBA8" "RGBA8Unorm" "UChar4Normalized" "rgba8unorm" "unorm8x4": ALL;
    "A2B10G10R10_UNORM_PACK32" "R10G10B10A2_UNORM" "RGB10_A2"
        "RGB10A2Unorm" "UInt1010102Normalized" "rgb10a2unorm" "unorm10-10-10-2": ALL;
    "A2B10G10R10_UINT_PACK32" "R10G10B10A2_UINT" "RGB10_A2UI" "RGB10A2Uint" "" "rgb10a2uint" "": &[Attachment, Texture];
    "R8G8_SNORM" "R8G8_SNORM" "RG8_SNORM" "RG8Snorm" "Char2Normalized" "rg8snorm" "snorm8x2": &[Texture, Vertex];
    "R16G16_SNORM" "R16G16_SNORM" "RG16_SNORM" "RG16Snorm" "Short2Normalized" "rg16snorm" "snorm16x2": &[Vertex];
    "R16G16_UNORM" "R16G16_UNORM" "RG16" "RG16Unorm" "UShort2Normalized" "rg16unorm" "unorm16x2": &[Vertex];
    "R8G8B8_UNORM" "" "RGB8" "" "UChar3Normalized" "" "": &[];
    "R8G8B8_SNORM" "" "RGB8_SNORM" "" "Char3Normalized" "" "": &[];
    "R16G16B16_SNORM" "" "RGB16_SNORM" "" "Short3Normalized" "" "": &[];
    "R16G16B16_SFLOAT" "" "RGB16F" "" "Half3" "" "": &[];
    "A2B10G10R10_SNORM_PACK32" "" "" "" "Int1010102Normalized" "" "": &[];
};

/// A codec recommended for a use.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Choice {
    /// Identifier.
    pub id: &'static str,
    /// The format to take where the device has it: the `vulkan` of one of [`FORMATS`].
    pub format: &'static str,
    /// The format that holds the same codes on every device.
    pub anywhere: &'static str,
    /// What speaks for this one of the use's codecs.
    pub why: &'static str,
}

/// The codecs recommended for a use, the first choice first.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Recommendation {
    /// The use.
    pub purpose: &'static str,
    /// The use of the format that it asks for.
    pub usage: Usage,
    /// The codecs: fast encoders where encoding happens in every frame, precise ones where it happens once.
    pub choices: &'static [Choice],
    in_short: usize,
}

impl Recommendation {
    /// The choices in the short table, which README has and `unitvec error` measures.
    pub fn short(&self) -> &'static [Choice] {
        &self.choices[..self.in_short]
    }
}

const USUAL: &str = "the usual choice";
const EIGHT_LEFT: &str = "leaves 8 bits for something else";
const LEAST: &str = "where memory counts most";

/// Rows of [`RECOMMENDED`]: a use and its number of short rows; below it each codec, its two formats and the reason.
macro_rules! recommended {
    ($($purpose:literal, $usage:ident, $in_short:literal {
        $($id:literal $format:literal $anywhere:literal, $why:expr;)*
    })*) => {
        [$(Recommendation {
            purpose: $purpose,
            usage: $usage,
            choices: const { &[$(Choice { id: $id, format: $format, anywhere: $anywhere, why: $why }),*] },
            in_short: $in_short,
        }),*]
    };
}

/// The recommended codecs by use.
pub const RECOMMENDED: [Recommendation; 9] = recommended! {
    "encoded often: G-buffers", Attachment, 3 {
        "oct32" "R16G16_SNORM" "R32_UINT", USUAL;
        "oct24" "R32_UINT" "R32_UINT", EIGHT_LEFT;
        "oct16" "R8G8_SNORM" "R16_UINT", LEAST;
    }
    "encoded once: vertices", Vertex, 3 {
        "oct32p" "R16G16_SNORM" "R16G16_SNORM", USUAL;
        "oct24p" "R32_UINT" "R32_UINT", EIGHT_LEFT;
        "oct16p" "R8G8_SNORM" "R8G8_SNORM", LEAST;
    }
    "z >= 0: tangent-space normal maps", Texture, 2 {
        "hemioct16" "R8G8_SNORM" "R8G8_SNORM", "less error than oct16p, at less cost";
        "hemioct24" "R32_UINT" "R32_UINT", "less error than oct24p, at less cost";
    }
    "two snorms and a sign bit", Attachment, 1 {
        "soct17" "R32_UINT" "R32_UINT", "hemioct16's error over the whole sphere";
        "soct25" "R32_UINT" "R32_UINT", "hemioct24's error over the whole sphere";
    }
    "files: least maximum error for the bytes", Texture, 3 {
        "ico16" "R16_UINT" "R16_UINT", "in 2 bytes";
        "ico24" "R32_UINT" "R32_UINT", "in 3 bytes";
        "ico32" "R32_UINT" "R32_UINT", "in 4 bytes";
    }
    "near the least error, at half of ico's cost", Attachment, 2 {
        "hexcube32" "R32_UINT" "R32_UINT", "in 4 bytes";
        "hexcube24" "R32_UINT" "R32_UINT", "in 3 bytes";
        "hexcube16" "R16_UINT" "R16_UINT", "in 2 bytes";
    }
    "very few bits", Texture, 1 {
        "oct8p" "R8_UINT" "R8_UINT", "in 1 byte";
        "oct12p" "R16_UINT" "R16_UINT", "leaves 4 bits of 2 bytes";
    }
    "finer than 32 bits", Texture, 1 {
        "oct48p" "R32G32_UINT" "R32G32_UINT", "leaves 16 bits of 8 bytes";
        "oct52p" "R32G32_UINT" "R32G32_UINT", "as fine as floats";
    }
    "a normal with its tangent", Vertex, 2 {
        "frame32" "R32_UINT" "R32_UINT", "4 bytes instead of 28";
        "frame64" "R32G32_UINT" "R32G32_UINT", "finer tangents";
    }
};

/// Measured errors, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The mean over 10^6 random directions.
    pub mean_deg: f64,
    /// The largest error of those, and of a search for the worst direction.
    pub max_deg: f64,
}

const RECORD: &str = include_str!("../data/accuracy.csv");
const COSTS: &str = include_str!("../data/costs.csv");

impl AnyCodec {
    /// The measured errors of one of its [directions](crate::Element::directions) (`direction`; of frames `normal`, `tangent`), or, of a codec for the sphere,
    /// `above`: over z >= 0, without a search. `None` for another name, and for a codec that is not measured yet.
    pub fn measured(&self, of: &str) -> Option<Measured> {
        let row = |line: &'static str| {
            line.strip_prefix(self.id)?.strip_prefix(',')?.strip_prefix(of)?.strip_prefix(',')
        };
        let (mean, max) = RECORD.lines().find_map(row)?.split_once(',')?;
        Some(Measured { mean_deg: mean.parse().ok()?, max_deg: max.parse().ok()? })
    }

    /// The cost of an operation on a GPU, RDNA 2, by its compiler's estimate: a multiple of `oct32`'s. `None` for a codec that is
    /// not compiled yet, and for formats of other software.
    pub fn cost(&self, operation: Operation) -> Option<f64> {
        let row = COSTS.lines().find_map(|line| line.strip_prefix(self.id)?.strip_prefix(','))?;
        row.split(',').nth(operation as usize)?.parse().ok()
    }

    /// What a mirror shows of the error of its first direction: `bands`, `traces` or `nothing`.
    pub fn on_a_mirror(&self) -> Option<&'static str> {
        let max = self.measured(self.element.directions().first()?)?.max_deg;
        Some(if max >= 0.2 {
            "bands"
        } else if max >= 0.01 {
            "traces"
        } else {
            "nothing"
        })
    }

    /// The uses that it is recommended for.
    pub fn recommended_for(&self) -> impl Iterator<Item = &'static str> {
        let is_it = |row: &&Recommendation| row.choices.iter().any(|choice| choice.id == self.id);
        RECOMMENDED.iter().filter(is_it).map(|row| row.purpose)
    }
}
