//! The one list of codecs: everything that names, lists or runs codecs reads it.

use serde::Serialize;
use std::sync::OnceLock;
use unitvec::best_fit::{TABLE_WORDS, crytek_bfn24_encode_by_table, fill_table, snorm8x3p_encode_by_table};
use unitvec::frame::{decode_frames, encode_frames};
use unitvec::slice::{LengthMismatch, encode_slice_with, par_decode_slice, par_encode_slice};
use unitvec::{
    Codec, CrytekBfn24, Cube16, Cube24, Cube32, Cylindrical16, Cylindrical24, Cylindrical32, EaOct16,
    EaOct20, EaOct22, EaOct24, EaOct32, EaOctPrecise16, EaOctPrecise20, EaOctPrecise22, EaOctPrecise24,
    EaOctPrecise32, Eqarea16, Eqarea20, Eqarea22, Eqarea24, Eqarea32, EqareaConcentric16, EqareaConcentric20,
    EqareaConcentric22, EqareaConcentric24, EqareaConcentric32, EqareaEllipse16, EqareaEllipse20,
    EqareaEllipse22, EqareaEllipse24, EqareaEllipse32, Eqdist16, Eqdist20, Eqdist22, Eqdist24, Eqdist32,
    EqdistConcentric16, EqdistConcentric20, EqdistConcentric22, EqdistConcentric24, EqdistConcentric32,
    EqdistEllipse16, EqdistEllipse20, EqdistEllipse22, EqdistEllipse24, EqdistEllipse32, Fib16, Fib24, Fib32,
    Float16x3, Frame32, Frame64, FrameCodec, HemiOct16, HemiOct24, HemiOct32, Ico16, Ico24, Ico32, LatLong16,
    LatLong24, LatLong32, LatLongD16, LatLongD24, LatLongD32, Oct16, Oct20, Oct22, Oct24, Oct32, Oct48,
    OctPrecise16, OctPrecise20, OctPrecise22, OctPrecise24, OctPrecise32, OctPrecise48, OctPrecise52, Pp16,
    Pp24, Pp32, Pp48, SOct17, SOct25, SOct33, Snorm5x3, Snorm8x3, Snorm10x3, Snorm11x11x10, Snorm16x3,
    SnormBest8, SnormBest16, SnormNearest8, Spherical16, Spherical20, Spherical22, Spherical24, Spherical32,
    Spp16, Spp24, Spp32, Spp48, Stereo16, Stereo20, Stereo22, Stereo24, Stereo32, StereoConcentric16,
    StereoConcentric20, StereoConcentric22, StereoConcentric24, StereoConcentric32, StereoEllipse16,
    StereoEllipse20, StereoEllipse22, StereoEllipse24, StereoEllipse32, Unorm8x3, WarpedCube16, WarpedCube24,
    WarpedCube32, XyOnly16, XyOnly24, XyOnly32, XyOnly32F,
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

type EncodeSlice<const N: usize> = fn(&[[f32; N]], &mut [u8]) -> Result<(), LengthMismatch>;
type DecodeSlice<const N: usize> = fn(&[u8], &mut [[f32; N]]) -> Result<(), LengthMismatch>;

/// A codec: what is known of it, and its CPU functions.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CodecInfo {
    /// Identifier, as in `--codec`, the entry points and the GLSL functions: `oct16p`.
    pub id: &'static str,
    /// The survey's name, `oct16P`; of codecs that it does not have, one like them.
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
    /// True where the directions of the domain's axes come back exactly.
    pub exact_axes: bool,
    /// Upper bound of the error over the domain, in degrees.
    pub max_error_deg: f32,
    /// The GLSL include file with its functions.
    pub glsl_file: &'static str,
    /// True where the encoder looks lengths up in the table of [`unitvec::best_fit`]: its kernel binds it.
    pub encodes_by_table: bool,
    #[serde(skip)]
    encode: EncodeSlice<3>,
    #[serde(skip)]
    decode: DecodeSlice<3>,
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
            exact_axes: C::EXACT_AXES,
            max_error_deg: C::MAX_ERROR_DEG,
            glsl_file,
            encodes_by_table: false,
            encode: par_encode_slice::<C>,
            decode: par_decode_slice::<C>,
        }
    }

    /// The codec, encoding by the table of [`unitvec::best_fit`].
    const fn by_table(self, encode: EncodeSlice<3>) -> Self {
        Self { encodes_by_table: true, encode, ..self }
    }

    /// Entry point of the kernel, and name of the GLSL function, of this codec and direction: `oct16_encode`.
    pub fn function(&self, direction: Direction) -> String {
        self.format().function(direction)
    }
}

/// A codec of tangent frames: seven floats, which are normal, tangent and handedness.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FrameInfo {
    /// Identifier: `frame32`.
    pub id: &'static str,
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
    /// The GLSL include file with its functions.
    pub glsl_file: &'static str,
    #[serde(skip)]
    encode: EncodeSlice<7>,
    #[serde(skip)]
    decode: DecodeSlice<7>,
}

impl FrameInfo {
    const fn of<F: FrameCodec>(vk_format: &'static str) -> Self {
        Self {
            id: F::NAME,
            bits: F::BITS,
            bytes: F::BYTES,
            vk_format,
            max_normal_error_deg: F::MAX_NORMAL_ERROR_DEG,
            max_tangent_error_deg: F::MAX_TANGENT_ERROR_DEG,
            glsl_file: "frame.glsl",
            encode: encode_frames::<F>,
            decode: decode_frames::<F>,
        }
    }
}

/// What kernels need to know of a codec.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Identifier.
    pub id: &'static str,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// What it encodes.
    pub element: Element,
    /// As in [`CodecInfo`].
    pub encodes_by_table: bool,
}

/// What is encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// Vectors of three floats.
    Vector,
    /// Tangent frames of seven.
    Frame,
}

impl Element {
    /// Its size as packed f32.
    pub fn bytes(self) -> usize {
        match self {
            Self::Vector => 12,
            Self::Frame => 28,
        }
    }
}

impl Format {
    /// Entry point of the kernel, and name of the GLSL function, of this codec and direction: `oct16_encode`.
    pub fn function(&self, direction: Direction) -> String {
        format!("{}_{direction}", self.id)
    }
}

/// The formats of all codecs, of vectors and then of frames.
pub fn formats() -> impl Iterator<Item = Format> {
    CATALOGUE.iter().map(Coding::format).chain(FRAMES.iter().map(Coding::format))
}

/// A codec of elements of `N` floats.
pub trait Coding<const N: usize> {
    /// What kernels need to know of it.
    fn format(&self) -> Format;

    /// Encodes on the CPU: little endian, without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] where `codes` is not of that size.
    fn encode_cpu(&self, elements: &[[f32; N]], codes: &mut [u8]) -> Result<(), LengthMismatch>;

    /// Decodes on the CPU.
    ///
    /// # Errors
    /// [`LengthMismatch`] where `codes` is not as [`encode_cpu`](Self::encode_cpu) makes it.
    fn decode_cpu(&self, codes: &[u8], elements: &mut [[f32; N]]) -> Result<(), LengthMismatch>;
}

impl Coding<3> for CodecInfo {
    fn format(&self) -> Format {
        let Self { id, bits, bytes, encodes_by_table, .. } = *self;
        Format { id, bits, bytes, element: Element::Vector, encodes_by_table }
    }

    fn encode_cpu(&self, vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        (self.encode)(vectors, codes)
    }

    fn decode_cpu(&self, codes: &[u8], vectors: &mut [[f32; 3]]) -> Result<(), LengthMismatch> {
        (self.decode)(codes, vectors)
    }
}

impl Coding<7> for FrameInfo {
    fn format(&self) -> Format {
        let Self { id, bits, bytes, .. } = *self;
        Format { id, bits, bytes, element: Element::Frame, encodes_by_table: false }
    }

    fn encode_cpu(&self, frames: &[[f32; 7]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        (self.encode)(frames, codes)
    }

    fn decode_cpu(&self, codes: &[u8], frames: &mut [[f32; 7]]) -> Result<(), LengthMismatch> {
        (self.decode)(codes, frames)
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

/// The table of [`unitvec::best_fit`], computed once.
pub fn best_fit_table() -> &'static [u32] {
    static TABLE: OnceLock<Vec<u32>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = vec![0; TABLE_WORDS];
        fill_table(&mut table);
        table
    })
}

fn snorm8x3p_encode_slice(vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
    let table = best_fit_table();
    encode_slice_with::<SnormBest8>(vectors, codes, |v| snorm8x3p_encode_by_table(v, table))
}

fn crytek_bfn24_encode_slice(vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
    let table = best_fit_table();
    encode_slice_with::<CrytekBfn24>(vectors, codes, |v| crytek_bfn24_encode_by_table(v, table))
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
    CodecInfo::of::<EaOct16>("eaoct16", "eaoct.glsl", Sphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<EaOctPrecise16>("eaoct16P", "eaoct.glsl", Sphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<EaOct20>("eaoct20", "eaoct.glsl", Sphere, None),
    CodecInfo::of::<EaOctPrecise20>("eaoct20P", "eaoct.glsl", Sphere, None),
    CodecInfo::of::<EaOct22>("eaoct22", "eaoct.glsl", Sphere, None),
    CodecInfo::of::<EaOctPrecise22>("eaoct22P", "eaoct.glsl", Sphere, None),
    CodecInfo::of::<EaOct24>("eaoct24", "eaoct.glsl", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")),
    CodecInfo::of::<EaOctPrecise24>("eaoct24P", "eaoct.glsl", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")),
    CodecInfo::of::<EaOct32>("eaoct32", "eaoct.glsl", Sphere, Some("VK_FORMAT_R16G16_SNORM")),
    CodecInfo::of::<EaOctPrecise32>("eaoct32P", "eaoct.glsl", Sphere, Some("VK_FORMAT_R16G16_SNORM")),
    CodecInfo::of::<SOct17>("soct17", "soct.glsl", Sphere, None),
    CodecInfo::of::<SOct25>("soct25", "soct.glsl", Sphere, None),
    CodecInfo::of::<SOct33>("soct33", "soct.glsl", Sphere, None),
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
    CodecInfo::of::<Fib16>("fib16", "fib.glsl", Sphere, None),
    CodecInfo::of::<Fib24>("fib24", "fib.glsl", Sphere, None),
    CodecInfo::of::<Fib32>("fib32", "fib.glsl", Sphere, None),
    CodecInfo::of::<Ico16>("ico16", "ico.glsl", Sphere, None),
    CodecInfo::of::<Ico24>("ico24", "ico.glsl", Sphere, None),
    CodecInfo::of::<Ico32>("ico32", "ico.glsl", Sphere, None),
    CodecInfo::of::<SnormBest8>("snorm8x3P", "best_fit.glsl", Sphere, Some("VK_FORMAT_R8G8B8_SNORM"))
        .by_table(snorm8x3p_encode_slice),
    CodecInfo::of::<SnormNearest8>(
        "snorm8x3Nearest",
        "best_fit.glsl",
        Sphere,
        Some("VK_FORMAT_R8G8B8_SNORM"),
    ),
    CodecInfo::of::<SnormBest16>("snorm16x3P", "best_fit.glsl", Sphere, Some("VK_FORMAT_R16G16B16_SNORM")),
    CodecInfo::of::<CrytekBfn24>("CrytekBFN24", "best_fit.glsl", Sphere, Some("VK_FORMAT_R8G8B8_SNORM"))
        .by_table(crytek_bfn24_encode_slice),
    CodecInfo::of::<Stereo16>("stereo16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Stereo20>("stereo20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Stereo22>("stereo22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Stereo24>("stereo24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Stereo32>("stereo32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoConcentric16>("stereo+concentric16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoConcentric20>("stereo+concentric20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoConcentric22>("stereo+concentric22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoConcentric24>("stereo+concentric24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoConcentric32>("stereo+concentric32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoEllipse16>("stereo+ellipse16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoEllipse20>("stereo+ellipse20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoEllipse22>("stereo+ellipse22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoEllipse24>("stereo+ellipse24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<StereoEllipse32>("stereo+ellipse32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqarea16>("eqarea16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqarea20>("eqarea20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqarea22>("eqarea22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqarea24>("eqarea24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqarea32>("eqarea32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaConcentric16>("eqarea+concentric16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaConcentric20>("eqarea+concentric20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaConcentric22>("eqarea+concentric22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaConcentric24>("eqarea+concentric24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaConcentric32>("eqarea+concentric32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaEllipse16>("eqarea+ellipse16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaEllipse20>("eqarea+ellipse20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaEllipse22>("eqarea+ellipse22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaEllipse24>("eqarea+ellipse24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqareaEllipse32>("eqarea+ellipse32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqdist16>("eqdist16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqdist20>("eqdist20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqdist22>("eqdist22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqdist24>("eqdist24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Eqdist32>("eqdist32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistConcentric16>("eqdist+concentric16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistConcentric20>("eqdist+concentric20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistConcentric22>("eqdist+concentric22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistConcentric24>("eqdist+concentric24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistConcentric32>("eqdist+concentric32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistEllipse16>("eqdist+ellipse16", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistEllipse20>("eqdist+ellipse20", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistEllipse22>("eqdist+ellipse22", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistEllipse24>("eqdist+ellipse24", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<EqdistEllipse32>("eqdist+ellipse32", "azimuthal.glsl", Sphere, None),
    CodecInfo::of::<Snorm5x3>("snorm5x3", "snorm.glsl", Sphere, None),
    CodecInfo::of::<Snorm8x3>("snorm8x3", "snorm.glsl", Sphere, Some("VK_FORMAT_R8G8B8_SNORM")),
    CodecInfo::of::<Snorm10x3>("snorm10x3", "snorm.glsl", Sphere, Some("VK_FORMAT_A2B10G10R10_SNORM_PACK32")),
    CodecInfo::of::<Snorm11x11x10>("snorm11-11-10", "snorm.glsl", Sphere, None),
    CodecInfo::of::<Snorm16x3>("snorm16x3", "snorm.glsl", Sphere, Some("VK_FORMAT_R16G16B16_SNORM")),
    CodecInfo::of::<Unorm8x3>("unorm8x3", "unorm.glsl", Sphere, Some("VK_FORMAT_R8G8B8_UNORM")),
    CodecInfo::of::<Float16x3>("float16x3", "float.glsl", Sphere, Some("VK_FORMAT_R16G16B16_SFLOAT")),
    CodecInfo::of::<Cube16>("cube16", "cube.glsl", Sphere, None),
    CodecInfo::of::<Cube24>("cube24", "cube.glsl", Sphere, None),
    CodecInfo::of::<Cube32>("cube32", "cube.glsl", Sphere, None),
    CodecInfo::of::<WarpedCube16>("warpedcube16", "cube.glsl", Sphere, None),
    CodecInfo::of::<WarpedCube24>("warpedcube24", "cube.glsl", Sphere, None),
    CodecInfo::of::<WarpedCube32>("warpedcube32", "cube.glsl", Sphere, None),
    CodecInfo::of::<XyOnly16>("XYOnly16", "projection.glsl", Hemisphere, Some("VK_FORMAT_R8G8_SNORM")),
    CodecInfo::of::<XyOnly24>("XYOnly24", "projection.glsl", Hemisphere, None),
    CodecInfo::of::<XyOnly32>("XYOnly32", "projection.glsl", Hemisphere, Some("VK_FORMAT_R16G16_SNORM")),
    CodecInfo::of::<XyOnly32F>("XYOnly32F", "projection.glsl", Hemisphere, Some("VK_FORMAT_R16G16_SFLOAT")),
    CodecInfo::of::<Pp16>("PP16", "projection.glsl", Sphere, None),
    CodecInfo::of::<Pp24>("PP24", "projection.glsl", Sphere, None),
    CodecInfo::of::<Pp32>("PP32", "projection.glsl", Sphere, None),
    CodecInfo::of::<Pp48>("PP48", "projection.glsl", Sphere, None),
    CodecInfo::of::<Spp16>("SPP16", "projection.glsl", Sphere, None),
    CodecInfo::of::<Spp24>("SPP24", "projection.glsl", Sphere, None),
    CodecInfo::of::<Spp32>("SPP32", "projection.glsl", Sphere, None),
    CodecInfo::of::<Spp48>("SPP48", "projection.glsl", Sphere, None),
];

/// The codecs of tangent frames.
pub static FRAMES: &[FrameInfo] =
    &[FrameInfo::of::<Frame32>("VK_FORMAT_R32_UINT"), FrameInfo::of::<Frame64>("VK_FORMAT_R32G32_UINT")];

/// The codec of frames with this identifier.
pub fn find_frame(id: &str) -> Option<&'static FrameInfo> {
    FRAMES.iter().find(|codec| codec.id == id)
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
    let letters =
        |text: &str| text.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default().to_lowercase();
    let same =
        |codec: &&CodecInfo| codec.id.eq_ignore_ascii_case(id) || codec.survey_name.eq_ignore_ascii_case(id);
    let mut close: Vec<&str> = CATALOGUE.iter().filter(same).map(|codec| codec.id).collect();
    if close.is_empty() {
        close =
            CATALOGUE.iter().map(|codec| codec.id).filter(|other| letters(other) == letters(id)).collect();
    }
    if close.is_empty() { String::new() } else { format!("did you mean {}? ", close.join(", ")) }
}

/// The codec with this identifier.
///
/// # Errors
/// [`UnknownCodec`] where there is none.
pub fn find(id: &str) -> Result<&'static CodecInfo, UnknownCodec> {
    CATALOGUE.iter().find(|codec| codec.id == id).ok_or_else(|| UnknownCodec { id: id.to_owned() })
}
