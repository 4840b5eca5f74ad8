//! Compute entry points `<identifier>_encode` and `<identifier>_decode`, one SPIR-V module each.
//!
//! Binding 0 is the input, binding 1 the output, the push constant is the number of vectors. Vectors are three
//! packed f32, codes are dense bytes. An invocation takes four consecutive vectors, which is what makes any code
//! width end on whole words; the buffers are padded to a multiple of four vectors. Workgroups have 64 invocations.

use crate::codec::{Code, Codec};
use crate::{
    CrytekBfn24, Cube16, Cube24, Cube32, Cylindrical16, Cylindrical24, Cylindrical32, Eqarea16, Eqarea20,
    Eqarea22, Eqarea24, Eqarea32, EqareaConcentric16, EqareaConcentric20, EqareaConcentric22,
    EqareaConcentric24, EqareaConcentric32, EqareaEllipse16, EqareaEllipse20, EqareaEllipse22,
    EqareaEllipse24, EqareaEllipse32, Eqdist16, Eqdist20, Eqdist22, Eqdist24, Eqdist32, EqdistConcentric16,
    EqdistConcentric20, EqdistConcentric22, EqdistConcentric24, EqdistConcentric32, EqdistEllipse16,
    EqdistEllipse20, EqdistEllipse22, EqdistEllipse24, EqdistEllipse32, Float16x3, HemiOct16, HemiOct24,
    HemiOct32, LatLong16, LatLong24, LatLong32, LatLongD16, LatLongD24, LatLongD32, Oct16, Oct20, Oct22,
    Oct24, Oct32, Oct48, OctPrecise16, OctPrecise20, OctPrecise22, OctPrecise24, OctPrecise32, OctPrecise48,
    OctPrecise52, Pp16, Pp24, Pp32, Pp48, Snorm5x3, Snorm8x3, Snorm10x3, Snorm11x11x10, Snorm16x3,
    SnormBest8, SnormBest16, Spherical16, Spherical20, Spherical22, Spherical24, Spherical32, Spp16, Spp24,
    Spp32, Spp48, Stereo16, Stereo20, Stereo22, Stereo24, Stereo32, StereoConcentric16, StereoConcentric20,
    StereoConcentric22, StereoConcentric24, StereoConcentric32, StereoEllipse16, StereoEllipse20,
    StereoEllipse22, StereoEllipse24, StereoEllipse32, Unorm8x3, WarpedCube16, WarpedCube24, WarpedCube32,
    XyOnly16, XyOnly24, XyOnly32, XyOnly32F,
};
use glam::Vec3;
use spirv_std::spirv;

/// Four vectors, as words of f32 bits.
type Vectors = [u32; 12];

/// Number of vectors to process.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Count {
    /// The number.
    pub vectors: u32,
}

#[inline(always)]
fn vector(words: &Vectors, n: usize) -> Vec3 {
    Vec3::new(
        f32::from_bits(words[3 * n]),
        f32::from_bits(words[3 * n + 1]),
        f32::from_bits(words[3 * n + 2]),
    )
}

#[inline(always)]
fn set_vector(words: &mut Vectors, n: usize, v: Vec3) {
    words[3 * n] = v.x.to_bits();
    words[3 * n + 1] = v.y.to_bits();
    words[3 * n + 2] = v.z.to_bits();
}

/// Low and high word of a code.
type CodeWords = [u32; 2];

/// The words that four codes fill.
trait Words {
    fn pack(codes: [CodeWords; 4]) -> Self;
    fn unpack(&self) -> [CodeWords; 4];
}

impl Words for [u32; 2] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a | (b << 16), c | (d << 16)]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a, c] = *self;
        [[a, 0], [a >> 16, 0], [c, 0], [c >> 16, 0]]
    }
}

impl Words for [u32; 3] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a | (b << 24), (b >> 8) | (c << 16), (c >> 16) | (d << 8)]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [u, v, w] = *self;
        [[u, 0], [(u >> 24) | (v << 8), 0], [(v >> 16) | (w << 16), 0], [w >> 8, 0]]
    }
}

impl Words for [u32; 4] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; 4]) -> Self {
        [a, b, c, d]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a, b, c, d] = *self;
        [[a, 0], [b, 0], [c, 0], [d, 0]]
    }
}

impl Words for [u32; 6] {
    #[inline(always)]
    fn pack([[a, a_high], [b, b_high], [c, c_high], [d, d_high]]: [CodeWords; 4]) -> Self {
        let pack_two =
            |low, low_high, high, high_high| [low, low_high | (high << 16), (high >> 16) | (high_high << 16)];
        let ([t, u, v], [w, x, y]) = (pack_two(a, a_high, b, b_high), pack_two(c, c_high, d, d_high));
        [t, u, v, w, x, y]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [t, u, v, w, x, y] = *self;
        [[t, u & 0xffff], [(u >> 16) | (v << 16), v >> 16], [w, x & 0xffff], [(x >> 16) | (y << 16), y >> 16]]
    }
}

impl Words for [u32; 8] {
    #[inline(always)]
    fn pack([[a, a_high], [b, b_high], [c, c_high], [d, d_high]]: [CodeWords; 4]) -> Self {
        [a, a_high, b, b_high, c, c_high, d, d_high]
    }

    #[inline(always)]
    fn unpack(&self) -> [CodeWords; 4] {
        let [a, a_high, b, b_high, c, c_high, d, d_high] = *self;
        [[a, a_high], [b, b_high], [c, c_high], [d, d_high]]
    }
}

#[inline(always)]
fn encode<C: Codec, W: Words>(index: usize, count: Count, input: &[Vectors], output: &mut [W]) {
    if index * 4 >= count.vectors as usize {
        return;
    }
    let v = &input[index];
    output[index] = W::pack([
        C::encode(vector(v, 0)).to_words(),
        C::encode(vector(v, 1)).to_words(),
        C::encode(vector(v, 2)).to_words(),
        C::encode(vector(v, 3)).to_words(),
    ]);
}

#[inline(always)]
fn decode<C: Codec, W: Words>(index: usize, count: Count, input: &[W], output: &mut [Vectors]) {
    if index * 4 >= count.vectors as usize {
        return;
    }
    let [a, b, c, d] = input[index].unpack();
    let v = &mut output[index];
    set_vector(v, 0, C::decode(C::Code::from_words(a)));
    set_vector(v, 1, C::decode(C::Code::from_words(b)));
    set_vector(v, 2, C::decode(C::Code::from_words(c)));
    set_vector(v, 3, C::decode(C::Code::from_words(d)));
}

macro_rules! kernels {
    ($($encode:ident $encode_name:literal $decode:ident $decode_name:literal $codec:ty, $bytes:literal bytes;)*) => { $(
        #[doc = concat!("Encodes four vectors with [`", stringify!($codec), "`].")]
        #[spirv(compute(threads(64), entry_point_name = $encode_name))]
        pub fn $encode(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] count: &Count,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[Vectors],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [[u32; $bytes]],
        ) {
            encode::<$codec, _>(id.x as usize, *count, input, output);
        }

        #[doc = concat!("Decodes four codes of [`", stringify!($codec), "`].")]
        #[spirv(compute(threads(64), entry_point_name = $decode_name))]
        pub fn $decode(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] count: &Count,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; $bytes]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [Vectors],
        ) {
            decode::<$codec, _>(id.x as usize, *count, input, output);
        }
    )* };
}

kernels! {
    oct16_encode "oct16_encode" oct16_decode "oct16_decode" Oct16, 2 bytes;
    oct16p_encode "oct16p_encode" oct16p_decode "oct16p_decode" OctPrecise16, 2 bytes;
    oct20_encode "oct20_encode" oct20_decode "oct20_decode" Oct20, 3 bytes;
    oct20p_encode "oct20p_encode" oct20p_decode "oct20p_decode" OctPrecise20, 3 bytes;
    oct22_encode "oct22_encode" oct22_decode "oct22_decode" Oct22, 3 bytes;
    oct22p_encode "oct22p_encode" oct22p_decode "oct22p_decode" OctPrecise22, 3 bytes;
    oct24_encode "oct24_encode" oct24_decode "oct24_decode" Oct24, 3 bytes;
    oct24p_encode "oct24p_encode" oct24p_decode "oct24p_decode" OctPrecise24, 3 bytes;
    oct32_encode "oct32_encode" oct32_decode "oct32_decode" Oct32, 4 bytes;
    oct32p_encode "oct32p_encode" oct32p_decode "oct32p_decode" OctPrecise32, 4 bytes;
    hemioct16_encode "hemioct16_encode" hemioct16_decode "hemioct16_decode" HemiOct16, 2 bytes;
    hemioct24_encode "hemioct24_encode" hemioct24_decode "hemioct24_decode" HemiOct24, 3 bytes;
    hemioct32_encode "hemioct32_encode" hemioct32_decode "hemioct32_decode" HemiOct32, 4 bytes;
    oct48_encode "oct48_encode" oct48_decode "oct48_decode" Oct48, 6 bytes;
    oct48p_encode "oct48p_encode" oct48p_decode "oct48p_decode" OctPrecise48, 6 bytes;
    oct52p_encode "oct52p_encode" oct52p_decode "oct52p_decode" OctPrecise52, 8 bytes;
    spherical16_encode "spherical16_encode" spherical16_decode "spherical16_decode" Spherical16, 2 bytes;
    spherical20_encode "spherical20_encode" spherical20_decode "spherical20_decode" Spherical20, 3 bytes;
    spherical22_encode "spherical22_encode" spherical22_decode "spherical22_decode" Spherical22, 3 bytes;
    spherical24_encode "spherical24_encode" spherical24_decode "spherical24_decode" Spherical24, 3 bytes;
    spherical32_encode "spherical32_encode" spherical32_decode "spherical32_decode" Spherical32, 4 bytes;
    cylindrical16_encode "cylindrical16_encode" cylindrical16_decode "cylindrical16_decode" Cylindrical16, 2 bytes;
    cylindrical24_encode "cylindrical24_encode" cylindrical24_decode "cylindrical24_decode" Cylindrical24, 3 bytes;
    cylindrical32_encode "cylindrical32_encode" cylindrical32_decode "cylindrical32_decode" Cylindrical32, 4 bytes;
    latlong16_encode "latlong16_encode" latlong16_decode "latlong16_decode" LatLong16, 2 bytes;
    latlong24_encode "latlong24_encode" latlong24_decode "latlong24_decode" LatLong24, 3 bytes;
    latlong32_encode "latlong32_encode" latlong32_decode "latlong32_decode" LatLong32, 4 bytes;
    latlong16d_encode "latlong16d_encode" latlong16d_decode "latlong16d_decode" LatLongD16, 2 bytes;
    latlong24d_encode "latlong24d_encode" latlong24d_decode "latlong24d_decode" LatLongD24, 3 bytes;
    latlong32d_encode "latlong32d_encode" latlong32d_decode "latlong32d_decode" LatLongD32, 4 bytes;
    snorm8x3p_encode "snorm8x3p_encode" snorm8x3p_decode "snorm8x3p_decode" SnormBest8, 3 bytes;
    snorm16x3p_encode "snorm16x3p_encode" snorm16x3p_decode "snorm16x3p_decode" SnormBest16, 6 bytes;
    crytek_bfn24_encode "crytek_bfn24_encode" crytek_bfn24_decode "crytek_bfn24_decode" CrytekBfn24, 3 bytes;
    stereo16_encode "stereo16_encode" stereo16_decode "stereo16_decode" Stereo16, 2 bytes;
    stereo20_encode "stereo20_encode" stereo20_decode "stereo20_decode" Stereo20, 3 bytes;
    stereo22_encode "stereo22_encode" stereo22_decode "stereo22_decode" Stereo22, 3 bytes;
    stereo24_encode "stereo24_encode" stereo24_decode "stereo24_decode" Stereo24, 3 bytes;
    stereo32_encode "stereo32_encode" stereo32_decode "stereo32_decode" Stereo32, 4 bytes;
    stereo_concentric16_encode "stereo_concentric16_encode" stereo_concentric16_decode "stereo_concentric16_decode" StereoConcentric16, 2 bytes;
    stereo_concentric20_encode "stereo_concentric20_encode" stereo_concentric20_decode "stereo_concentric20_decode" StereoConcentric20, 3 bytes;
    stereo_concentric22_encode "stereo_concentric22_encode" stereo_concentric22_decode "stereo_concentric22_decode" StereoConcentric22, 3 bytes;
    stereo_concentric24_encode "stereo_concentric24_encode" stereo_concentric24_decode "stereo_concentric24_decode" StereoConcentric24, 3 bytes;
    stereo_concentric32_encode "stereo_concentric32_encode" stereo_concentric32_decode "stereo_concentric32_decode" StereoConcentric32, 4 bytes;
    stereo_ellipse16_encode "stereo_ellipse16_encode" stereo_ellipse16_decode "stereo_ellipse16_decode" StereoEllipse16, 2 bytes;
    stereo_ellipse20_encode "stereo_ellipse20_encode" stereo_ellipse20_decode "stereo_ellipse20_decode" StereoEllipse20, 3 bytes;
    stereo_ellipse22_encode "stereo_ellipse22_encode" stereo_ellipse22_decode "stereo_ellipse22_decode" StereoEllipse22, 3 bytes;
    stereo_ellipse24_encode "stereo_ellipse24_encode" stereo_ellipse24_decode "stereo_ellipse24_decode" StereoEllipse24, 3 bytes;
    stereo_ellipse32_encode "stereo_ellipse32_encode" stereo_ellipse32_decode "stereo_ellipse32_decode" StereoEllipse32, 4 bytes;
    eqarea16_encode "eqarea16_encode" eqarea16_decode "eqarea16_decode" Eqarea16, 2 bytes;
    eqarea20_encode "eqarea20_encode" eqarea20_decode "eqarea20_decode" Eqarea20, 3 bytes;
    eqarea22_encode "eqarea22_encode" eqarea22_decode "eqarea22_decode" Eqarea22, 3 bytes;
    eqarea24_encode "eqarea24_encode" eqarea24_decode "eqarea24_decode" Eqarea24, 3 bytes;
    eqarea32_encode "eqarea32_encode" eqarea32_decode "eqarea32_decode" Eqarea32, 4 bytes;
    eqarea_concentric16_encode "eqarea_concentric16_encode" eqarea_concentric16_decode "eqarea_concentric16_decode" EqareaConcentric16, 2 bytes;
    eqarea_concentric20_encode "eqarea_concentric20_encode" eqarea_concentric20_decode "eqarea_concentric20_decode" EqareaConcentric20, 3 bytes;
    eqarea_concentric22_encode "eqarea_concentric22_encode" eqarea_concentric22_decode "eqarea_concentric22_decode" EqareaConcentric22, 3 bytes;
    eqarea_concentric24_encode "eqarea_concentric24_encode" eqarea_concentric24_decode "eqarea_concentric24_decode" EqareaConcentric24, 3 bytes;
    eqarea_concentric32_encode "eqarea_concentric32_encode" eqarea_concentric32_decode "eqarea_concentric32_decode" EqareaConcentric32, 4 bytes;
    eqarea_ellipse16_encode "eqarea_ellipse16_encode" eqarea_ellipse16_decode "eqarea_ellipse16_decode" EqareaEllipse16, 2 bytes;
    eqarea_ellipse20_encode "eqarea_ellipse20_encode" eqarea_ellipse20_decode "eqarea_ellipse20_decode" EqareaEllipse20, 3 bytes;
    eqarea_ellipse22_encode "eqarea_ellipse22_encode" eqarea_ellipse22_decode "eqarea_ellipse22_decode" EqareaEllipse22, 3 bytes;
    eqarea_ellipse24_encode "eqarea_ellipse24_encode" eqarea_ellipse24_decode "eqarea_ellipse24_decode" EqareaEllipse24, 3 bytes;
    eqarea_ellipse32_encode "eqarea_ellipse32_encode" eqarea_ellipse32_decode "eqarea_ellipse32_decode" EqareaEllipse32, 4 bytes;
    eqdist16_encode "eqdist16_encode" eqdist16_decode "eqdist16_decode" Eqdist16, 2 bytes;
    eqdist20_encode "eqdist20_encode" eqdist20_decode "eqdist20_decode" Eqdist20, 3 bytes;
    eqdist22_encode "eqdist22_encode" eqdist22_decode "eqdist22_decode" Eqdist22, 3 bytes;
    eqdist24_encode "eqdist24_encode" eqdist24_decode "eqdist24_decode" Eqdist24, 3 bytes;
    eqdist32_encode "eqdist32_encode" eqdist32_decode "eqdist32_decode" Eqdist32, 4 bytes;
    eqdist_concentric16_encode "eqdist_concentric16_encode" eqdist_concentric16_decode "eqdist_concentric16_decode" EqdistConcentric16, 2 bytes;
    eqdist_concentric20_encode "eqdist_concentric20_encode" eqdist_concentric20_decode "eqdist_concentric20_decode" EqdistConcentric20, 3 bytes;
    eqdist_concentric22_encode "eqdist_concentric22_encode" eqdist_concentric22_decode "eqdist_concentric22_decode" EqdistConcentric22, 3 bytes;
    eqdist_concentric24_encode "eqdist_concentric24_encode" eqdist_concentric24_decode "eqdist_concentric24_decode" EqdistConcentric24, 3 bytes;
    eqdist_concentric32_encode "eqdist_concentric32_encode" eqdist_concentric32_decode "eqdist_concentric32_decode" EqdistConcentric32, 4 bytes;
    eqdist_ellipse16_encode "eqdist_ellipse16_encode" eqdist_ellipse16_decode "eqdist_ellipse16_decode" EqdistEllipse16, 2 bytes;
    eqdist_ellipse20_encode "eqdist_ellipse20_encode" eqdist_ellipse20_decode "eqdist_ellipse20_decode" EqdistEllipse20, 3 bytes;
    eqdist_ellipse22_encode "eqdist_ellipse22_encode" eqdist_ellipse22_decode "eqdist_ellipse22_decode" EqdistEllipse22, 3 bytes;
    eqdist_ellipse24_encode "eqdist_ellipse24_encode" eqdist_ellipse24_decode "eqdist_ellipse24_decode" EqdistEllipse24, 3 bytes;
    eqdist_ellipse32_encode "eqdist_ellipse32_encode" eqdist_ellipse32_decode "eqdist_ellipse32_decode" EqdistEllipse32, 4 bytes;
    snorm5x3_encode "snorm5x3_encode" snorm5x3_decode "snorm5x3_decode" Snorm5x3, 2 bytes;
    snorm8x3_encode "snorm8x3_encode" snorm8x3_decode "snorm8x3_decode" Snorm8x3, 3 bytes;
    snorm10x3_encode "snorm10x3_encode" snorm10x3_decode "snorm10x3_decode" Snorm10x3, 4 bytes;
    snorm11_11_10_encode "snorm11_11_10_encode" snorm11_11_10_decode "snorm11_11_10_decode" Snorm11x11x10, 4 bytes;
    snorm16x3_encode "snorm16x3_encode" snorm16x3_decode "snorm16x3_decode" Snorm16x3, 6 bytes;
    unorm8x3_encode "unorm8x3_encode" unorm8x3_decode "unorm8x3_decode" Unorm8x3, 3 bytes;
    float16x3_encode "float16x3_encode" float16x3_decode "float16x3_decode" Float16x3, 6 bytes;
    cube16_encode "cube16_encode" cube16_decode "cube16_decode" Cube16, 2 bytes;
    cube24_encode "cube24_encode" cube24_decode "cube24_decode" Cube24, 3 bytes;
    cube32_encode "cube32_encode" cube32_decode "cube32_decode" Cube32, 4 bytes;
    warpedcube16_encode "warpedcube16_encode" warpedcube16_decode "warpedcube16_decode" WarpedCube16, 2 bytes;
    warpedcube24_encode "warpedcube24_encode" warpedcube24_decode "warpedcube24_decode" WarpedCube24, 3 bytes;
    warpedcube32_encode "warpedcube32_encode" warpedcube32_decode "warpedcube32_decode" WarpedCube32, 4 bytes;
    xyonly16_encode "xyonly16_encode" xyonly16_decode "xyonly16_decode" XyOnly16, 2 bytes;
    xyonly24_encode "xyonly24_encode" xyonly24_decode "xyonly24_decode" XyOnly24, 3 bytes;
    xyonly32_encode "xyonly32_encode" xyonly32_decode "xyonly32_decode" XyOnly32, 4 bytes;
    xyonly32f_encode "xyonly32f_encode" xyonly32f_decode "xyonly32f_decode" XyOnly32F, 4 bytes;
    pp16_encode "pp16_encode" pp16_decode "pp16_decode" Pp16, 2 bytes;
    pp24_encode "pp24_encode" pp24_decode "pp24_decode" Pp24, 3 bytes;
    pp32_encode "pp32_encode" pp32_decode "pp32_decode" Pp32, 4 bytes;
    pp48_encode "pp48_encode" pp48_decode "pp48_decode" Pp48, 6 bytes;
    spp16_encode "spp16_encode" spp16_decode "spp16_decode" Spp16, 2 bytes;
    spp24_encode "spp24_encode" spp24_decode "spp24_decode" Spp24, 3 bytes;
    spp32_encode "spp32_encode" spp32_decode "spp32_decode" Spp32, 4 bytes;
    spp48_encode "spp48_encode" spp48_decode "spp48_decode" Spp48, 6 bytes;
}
