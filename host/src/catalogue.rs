//! The one list of codecs: everything that names, lists or runs codecs reads it.

use serde::Serialize;
use unitvec::slice::{LengthMismatch, decode_slice, encode_slice};
use unitvec::{
    Codec, CrytekBfn24, Cylindrical16, Cylindrical24, Cylindrical32, HemiOct16, HemiOct24, HemiOct32,
    LatLong16, LatLong24, LatLong32, LatLongD16, LatLongD24, LatLongD32, Oct16, Oct20, Oct22, Oct24, Oct32,
    Oct48, OctPrecise16, OctPrecise20, OctPrecise22, OctPrecise24, OctPrecise32, OctPrecise48, OctPrecise52,
    SnormBest8, SnormBest16, Spherical16, Spherical20, Spherical22, Spherical24, Spherical32,
};

/// The directions that a codec is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Domain {
    /// All directions.
    Sphere,
    /// Directions with z >= 0.
    Hemisphere,
}

type EncodeSlice = fn(&[[f32; 3]], &mut [u8]) -> Result<(), LengthMismatch>;
type DecodeSlice = fn(&[u8], &mut [[f32; 3]]) -> Result<(), LengthMismatch>;

/// A codec: what is known of it, and its CPU functions.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CodecInfo {
    /// Identifier, as in `--codec`, the entry points and the GLSL functions: `oct16p`.
    pub id: &'static str,
    /// The survey's name: `oct16P`.
    pub survey_name: &'static str,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// The Vulkan format with the code's layout, where there is one.
    pub vk_format: Option<&'static str>,
    /// The directions it is made for.
    pub domain: Domain,
    /// True where decoded vectors have unit length; false for raw component formats.
    pub is_unit: bool,
    /// Upper bound of the error over the domain, in degrees.
    pub max_error_deg: f32,
    /// The GLSL include file with its functions.
    pub glsl_file: &'static str,
    #[serde(skip)]
    encode: EncodeSlice,
    #[serde(skip)]
    decode: DecodeSlice,
}

impl CodecInfo {
    const fn of<C: Codec>(
        survey_name: &'static str,
        glsl_file: &'static str,
        domain: Domain,
        vk_format: Option<&'static str>,
    ) -> Self {
        Self {
            id: C::NAME,
            survey_name,
            bits: C::BITS,
            bytes: C::BYTES,
            vk_format,
            domain,
            is_unit: C::IS_UNIT,
            max_error_deg: C::MAX_ERROR_DEG,
            glsl_file,
            encode: encode_slice::<C>,
            decode: decode_slice::<C>,
        }
    }

    /// Entry point of the kernel, and name of the GLSL function, of this codec and direction: `oct16_encode`.
    pub fn function(&self, direction: Direction) -> String {
        format!("{}_{direction}", self.id)
    }

    /// Encodes on the CPU: `bytes` bytes a vector, little endian, without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] where `codes` is not of that size.
    pub fn encode_cpu(&self, vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        (self.encode)(vectors, codes)
    }

    /// Decodes on the CPU what [`encode_cpu`](Self::encode_cpu) wrote.
    ///
    /// # Errors
    /// [`LengthMismatch`] where `codes` is not `bytes` bytes a vector.
    pub fn decode_cpu(&self, codes: &[u8], vectors: &mut [[f32; 3]]) -> Result<(), LengthMismatch> {
        (self.decode)(codes, vectors)
    }
}

/// The two halves of a codec.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// Vectors to codes.
    Encode,
    /// Codes to vectors.
    Decode,
}

impl std::fmt::Display for Direction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Encode => "encode",
            Self::Decode => "decode",
        })
    }
}

use Domain::{Hemisphere, Sphere};

/// Every codec, by family and width.
pub static CATALOGUE: &[CodecInfo] = &[
    CodecInfo::of::<Oct16>("oct16", "oct.glsl", Sphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<OctPrecise16>("oct16P", "oct.glsl", Sphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<Oct20>("oct20", "oct.glsl", Sphere, None),
    CodecInfo::of::<OctPrecise20>("oct20P", "oct.glsl", Sphere, None),
    CodecInfo::of::<Oct22>("oct22", "oct.glsl", Sphere, None),
    CodecInfo::of::<OctPrecise22>("oct22P", "oct.glsl", Sphere, None),
    CodecInfo::of::<Oct24>("oct24", "oct.glsl", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")),
    CodecInfo::of::<OctPrecise24>("oct24P", "oct.glsl", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")),
    CodecInfo::of::<Oct32>("oct32", "oct.glsl", Sphere, Some("VK_FORMAT_R16G16_SNORM")),
    CodecInfo::of::<OctPrecise32>("oct32P", "oct.glsl", Sphere, Some("VK_FORMAT_R16G16_SNORM")),
    CodecInfo::of::<HemiOct16>("HemiOct16", "hemioct.glsl", Hemisphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<HemiOct24>("HemiOct24", "hemioct.glsl", Hemisphere, None),
    CodecInfo::of::<HemiOct32>("HemiOct32", "hemioct.glsl", Hemisphere, Some("VK_FORMAT_R16G16_SNORM")),
    CodecInfo::of::<Oct48>("oct48", "oct_wide.glsl", Sphere, None),
    CodecInfo::of::<OctPrecise48>("oct48P", "oct_wide.glsl", Sphere, None),
    CodecInfo::of::<OctPrecise52>("oct52P", "oct_wide.glsl", Sphere, None),
    CodecInfo::of::<Spherical16>("spherical16", "spherical.glsl", Sphere, Some("VK_FORMAT_R8G8_SINT")),
    CodecInfo::of::<Spherical20>("spherical20", "spherical.glsl", Sphere, None),
    CodecInfo::of::<Spherical22>("spherical22", "spherical.glsl", Sphere, None),
    CodecInfo::of::<Spherical24>("spherical24", "spherical.glsl", Sphere, None),
    CodecInfo::of::<Spherical32>("spherical32", "spherical.glsl", Sphere, Some("VK_FORMAT_R16G16_SINT")),
    CodecInfo::of::<Cylindrical16>("cylindrical16", "cylindrical.glsl", Sphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<Cylindrical24>("cylindrical24", "cylindrical.glsl", Sphere, None),
    CodecInfo::of::<Cylindrical32>(
        "cylindrical32",
        "cylindrical.glsl",
        Sphere,
        Some("VK_FORMAT_R16G16_SNORM"),
    ),
    CodecInfo::of::<LatLong16>("latlong16", "latlong.glsl", Sphere, None),
    CodecInfo::of::<LatLong24>("latlong24", "latlong.glsl", Sphere, None),
    CodecInfo::of::<LatLong32>("latlong32", "latlong.glsl", Sphere, None),
    CodecInfo::of::<LatLongD16>("latlong16D", "latlong.glsl", Sphere, None),
    CodecInfo::of::<LatLongD24>("latlong24D", "latlong.glsl", Sphere, None),
    CodecInfo::of::<LatLongD32>("latlong32D", "latlong.glsl", Sphere, None),
    CodecInfo::of::<SnormBest8>("snorm8x3P", "best_fit.glsl", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")),
    CodecInfo::of::<SnormBest16>("snorm16x3P", "best_fit.glsl", Sphere, Some("VK_FORMAT_R16G16B16_SNORM")),
    CodecInfo::of::<CrytekBfn24>("CrytekBFN24", "best_fit.glsl", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")),
];

/// No codec has this identifier.
#[derive(Clone, Debug, thiserror::Error)]
#[error("unknown codec `{id}`; `unitvec codecs` lists them: {}", known_ids())]
pub struct UnknownCodec {
    /// What was asked for.
    pub id: String,
}

fn known_ids() -> String {
    CATALOGUE.iter().map(|codec| codec.id).collect::<Vec<_>>().join(", ")
}

/// The codec with this identifier.
///
/// # Errors
/// [`UnknownCodec`] where there is none.
pub fn find(id: &str) -> Result<&'static CodecInfo, UnknownCodec> {
    CATALOGUE.iter().find(|codec| codec.id == id).ok_or_else(|| UnknownCodec { id: id.to_owned() })
}
