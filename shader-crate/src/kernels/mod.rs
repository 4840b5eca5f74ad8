//! Compute entry points `<identifier>_encode` and `<identifier>_decode`, one SPIR-V module each.
//!
//! Binding 0 is the input, binding 1 the output, the push constant is the number of vectors. Vectors are three
//! packed f32, codes are dense bytes. An invocation takes four consecutive vectors, which is what makes any code
//! width end on whole words; the buffers are padded to a multiple of four vectors. Workgroups have 64 invocations.
//!
//! Binding 2 is a table, where the kernel reads one: that of [`best_fit`](crate::best_fit) for `snorm8x3p_encode` and
//! `crytek_bfn24_encode`, the decoded vectors of all 2^16 codes for `decode_by_table`, which serves all codecs whose
//! codes take two bytes. A kernel whose table is too short writes nothing.
//!
//! Beside them, `encode_cost` and `decode_cost` of each codec measure arithmetic.

mod cost;
mod frames;
mod words;

pub use cost::Work;
pub use frames::{Frames, frame32, frame64};
pub use words::Vectors;

use crate::best_fit::{TABLE_WORDS, crytek_bfn24_encode_by, snorm8x3p_encode_by};
use crate::codec::{Code, Codec};
use crate::{
    CrytekBfn24, Cube16, Cube24, Cube32, Cylindrical16, Cylindrical24, Cylindrical32, EaOct16, EaOct20,
    EaOct22, EaOct24, EaOct32, EaOctPrecise16, EaOctPrecise20, EaOctPrecise22, EaOctPrecise24,
    EaOctPrecise32, Eqarea16, Eqarea20, Eqarea22, Eqarea24, Eqarea32, EqareaConcentric16, EqareaConcentric20,
    EqareaConcentric22, EqareaConcentric24, EqareaConcentric32, EqareaEllipse16, EqareaEllipse20,
    EqareaEllipse22, EqareaEllipse24, EqareaEllipse32, Eqdist16, Eqdist20, Eqdist22, Eqdist24, Eqdist32,
    EqdistConcentric16, EqdistConcentric20, EqdistConcentric22, EqdistConcentric24, EqdistConcentric32,
    EqdistEllipse16, EqdistEllipse20, EqdistEllipse22, EqdistEllipse24, EqdistEllipse32, Fib16, Fib24, Fib32,
    Float16x3, HemiOct16, HemiOct24, HemiOct32, Ico16, Ico24, Ico32, LatLong16, LatLong24, LatLong32,
    LatLongD16, LatLongD24, LatLongD32, Oct16, Oct20, Oct22, Oct24, Oct32, Oct48, OctPrecise16, OctPrecise20,
    OctPrecise22, OctPrecise24, OctPrecise32, OctPrecise48, OctPrecise52, Pp16, Pp24, Pp32, Pp48, SOct17,
    SOct25, SOct33, Snorm5x3, Snorm8x3, Snorm10x3, Snorm11x11x10, Snorm16x3, SnormBest8, SnormBest16,
    SnormNearest8, Spherical16, Spherical20, Spherical22, Spherical24, Spherical32, Spp16, Spp24, Spp32,
    Spp48, Stereo16, Stereo20, Stereo22, Stereo24, Stereo32, StereoConcentric16, StereoConcentric20,
    StereoConcentric22, StereoConcentric24, StereoConcentric32, StereoEllipse16, StereoEllipse20,
    StereoEllipse22, StereoEllipse24, StereoEllipse32, Unorm8x3, WarpedCube16, WarpedCube24, WarpedCube32,
    XyOnly16, XyOnly24, XyOnly32, XyOnly32F,
};
use glam::Vec3;
use spirv_std::arch::IndexUnchecked;
use spirv_std::spirv;
use words::{CodeWords, Words, set_vector, vector};

/// Number of vectors to process.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Count {
    /// The number.
    pub vectors: u32,
}

#[inline(always)]
fn encode<C: Code, W: Words>(
    index: usize,
    count: Count,
    input: &[Vectors],
    output: &mut [W],
    encode: impl Fn(Vec3) -> C,
) {
    if index * 4 >= count.vectors as usize {
        return;
    }
    let v = &input[index];
    output[index] = W::pack([
        encode(vector(v, 0)).to_words(),
        encode(vector(v, 1)).to_words(),
        encode(vector(v, 2)).to_words(),
        encode(vector(v, 3)).to_words(),
    ]);
}

#[inline(always)]
fn decode<W: Words>(
    index: usize,
    count: Count,
    input: &[W],
    output: &mut [Vectors],
    decode: impl Fn(CodeWords) -> Vec3,
) {
    if index * 4 >= count.vectors as usize {
        return;
    }
    let [a, b, c, d] = input[index].unpack();
    let v = &mut output[index];
    set_vector(v, 0, decode(a));
    set_vector(v, 1, decode(b));
    set_vector(v, 2, decode(c));
    set_vector(v, 3, decode(d));
}

/// An element of a table, without a test: one for each vector costs a sixth of an encoder by table.
///
/// # Safety
/// The table has more than `index` elements.
#[inline(always)]
#[allow(unsafe_code)]
unsafe fn element<T: Copy>(table: &[T], index: u32) -> T {
    // SAFETY: as the caller promises.
    unsafe { *table.index_unchecked(index as usize) }
}

/// The kernels that decode with a codec.
macro_rules! decode_kernels {
    ($codec:ident, $bytes:literal, $decode_name:literal) => {
        /// Decodes four codes.
        #[spirv(compute(threads(64), entry_point_name = $decode_name))]
        pub fn decode(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] count: &Count,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; $bytes]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [Vectors],
        ) {
            super::decode(id.x as usize, *count, input, output, |words| {
                $codec::decode(Code::from_words(words))
            });
        }

        /// Decodes a code and its successors.
        #[spirv(compute(threads(64)))]
        pub fn decode_cost(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] work: &Work,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
        ) {
            cost::decode(id.x as usize, *work, input, output, |words| {
                $codec::decode(Code::from_words(words))
            });
        }
    };
}

/// A module of kernels for each codec, named after it.
macro_rules! kernels {
    ($($id:ident $codec:ident, $bytes:literal bytes, $encode_name:literal, $decode_name:literal;)*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`].")]
        pub mod $id {
            use super::*;

            /// Encodes four vectors.
            #[spirv(compute(threads(64), entry_point_name = $encode_name))]
            pub fn encode(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] count: &Count,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[Vectors],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [[u32; $bytes]],
            ) {
                super::encode(id.x as usize, *count, input, output, $codec::encode);
            }

            /// Encodes a vector and its neighbours.
            #[spirv(compute(threads(64)))]
            pub fn encode_cost(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] work: &Work,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
            ) {
                cost::encode(id.x as usize, *work, input, output, $codec::encode);
            }

            decode_kernels!($codec, $bytes, $decode_name);
        }
    )* };
}

/// As [`kernels`], for codecs that encode by a table.
macro_rules! table_kernels {
    ($($id:ident $codec:ident, $bytes:literal bytes, $encode_name:literal by $encode:ident, $decode_name:literal;)*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`].")]
        pub mod $id {
            use super::*;

            /// Encodes four vectors.
            #[spirv(compute(threads(64), entry_point_name = $encode_name))]
            pub fn encode(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] count: &Count,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[Vectors],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [[u32; $bytes]],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] table: &[u32],
            ) {
                if table.len() < TABLE_WORDS {
                    return;
                }
                // SAFETY: the table is whole, and encoders look for no word beyond.
                #[allow(unsafe_code)]
                let word = |index| unsafe { element(table, index) };
                super::encode(id.x as usize, *count, input, output, |v| $encode(v, word));
            }

            /// Encodes a vector and its neighbours.
            #[spirv(compute(threads(64)))]
            pub fn encode_cost(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] work: &Work,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] table: &[u32],
            ) {
                if table.len() < TABLE_WORDS {
                    return;
                }
                // SAFETY: as in `encode`.
                #[allow(unsafe_code)]
                let word = |index| unsafe { element(table, index) };
                cost::encode(id.x as usize, *work, input, output, |v| $encode(v, word));
            }

            decode_kernels!($codec, $bytes, $decode_name);
        }
    )* };
}

/// What the cost kernels do besides encoding and decoding, to be subtracted.
pub mod baseline {
    use super::*;

    /// Fetches and sums as `encode_cost` does.
    #[spirv(compute(threads(64)))]
    pub fn encode_cost(
        #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
        #[spirv(push_constant)] work: &Work,
        #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
        #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
    ) {
        cost::encode(id.x as usize, *work, input, output, cost::nothing_encoded);
    }

    /// Fetches and sums as `decode_cost` does.
    #[spirv(compute(threads(64)))]
    pub fn decode_cost(
        #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
        #[spirv(push_constant)] work: &Work,
        #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
        #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
    ) {
        cost::decode(id.x as usize, *work, input, output, cost::nothing_decoded);
    }
}

/// Decodes four codes of two bytes by looking their vectors up.
#[spirv(compute(threads(64), entry_point_name = "decode_by_table"))]
pub fn decode_by_table(
    #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
    #[spirv(push_constant)] count: &Count,
    #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 2]],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [Vectors],
    #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] table: &[[u32; 3]],
) {
    if table.len() < 1 << 16 {
        return;
    }
    decode(id.x as usize, *count, input, output, |[code, _]| {
        // SAFETY: the table has 2^16 elements.
        #[allow(unsafe_code)]
        let [x, y, z] = unsafe { element(table, code & 0xffff) };
        Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z))
    });
}

table_kernels! {
    snorm8x3p SnormBest8, 3 bytes, "snorm8x3p_encode" by snorm8x3p_encode_by, "snorm8x3p_decode";
    crytek_bfn24 CrytekBfn24, 3 bytes, "crytek_bfn24_encode" by crytek_bfn24_encode_by, "crytek_bfn24_decode";
}

kernels! {
    oct16 Oct16, 2 bytes, "oct16_encode", "oct16_decode";
    oct16p OctPrecise16, 2 bytes, "oct16p_encode", "oct16p_decode";
    oct20 Oct20, 3 bytes, "oct20_encode", "oct20_decode";
    oct20p OctPrecise20, 3 bytes, "oct20p_encode", "oct20p_decode";
    oct22 Oct22, 3 bytes, "oct22_encode", "oct22_decode";
    oct22p OctPrecise22, 3 bytes, "oct22p_encode", "oct22p_decode";
    oct24 Oct24, 3 bytes, "oct24_encode", "oct24_decode";
    oct24p OctPrecise24, 3 bytes, "oct24p_encode", "oct24p_decode";
    oct32 Oct32, 4 bytes, "oct32_encode", "oct32_decode";
    oct32p OctPrecise32, 4 bytes, "oct32p_encode", "oct32p_decode";
    hemioct16 HemiOct16, 2 bytes, "hemioct16_encode", "hemioct16_decode";
    hemioct24 HemiOct24, 3 bytes, "hemioct24_encode", "hemioct24_decode";
    hemioct32 HemiOct32, 4 bytes, "hemioct32_encode", "hemioct32_decode";
    eaoct16 EaOct16, 2 bytes, "eaoct16_encode", "eaoct16_decode";
    eaoct16p EaOctPrecise16, 2 bytes, "eaoct16p_encode", "eaoct16p_decode";
    eaoct20 EaOct20, 3 bytes, "eaoct20_encode", "eaoct20_decode";
    eaoct20p EaOctPrecise20, 3 bytes, "eaoct20p_encode", "eaoct20p_decode";
    eaoct22 EaOct22, 3 bytes, "eaoct22_encode", "eaoct22_decode";
    eaoct22p EaOctPrecise22, 3 bytes, "eaoct22p_encode", "eaoct22p_decode";
    eaoct24 EaOct24, 3 bytes, "eaoct24_encode", "eaoct24_decode";
    eaoct24p EaOctPrecise24, 3 bytes, "eaoct24p_encode", "eaoct24p_decode";
    eaoct32 EaOct32, 4 bytes, "eaoct32_encode", "eaoct32_decode";
    eaoct32p EaOctPrecise32, 4 bytes, "eaoct32p_encode", "eaoct32p_decode";
    soct17 SOct17, 3 bytes, "soct17_encode", "soct17_decode";
    soct25 SOct25, 4 bytes, "soct25_encode", "soct25_decode";
    soct33 SOct33, 6 bytes, "soct33_encode", "soct33_decode";
    oct48 Oct48, 6 bytes, "oct48_encode", "oct48_decode";
    oct48p OctPrecise48, 6 bytes, "oct48p_encode", "oct48p_decode";
    oct52p OctPrecise52, 8 bytes, "oct52p_encode", "oct52p_decode";
    spherical16 Spherical16, 2 bytes, "spherical16_encode", "spherical16_decode";
    spherical20 Spherical20, 3 bytes, "spherical20_encode", "spherical20_decode";
    spherical22 Spherical22, 3 bytes, "spherical22_encode", "spherical22_decode";
    spherical24 Spherical24, 3 bytes, "spherical24_encode", "spherical24_decode";
    spherical32 Spherical32, 4 bytes, "spherical32_encode", "spherical32_decode";
    cylindrical16 Cylindrical16, 2 bytes, "cylindrical16_encode", "cylindrical16_decode";
    cylindrical24 Cylindrical24, 3 bytes, "cylindrical24_encode", "cylindrical24_decode";
    cylindrical32 Cylindrical32, 4 bytes, "cylindrical32_encode", "cylindrical32_decode";
    latlong16 LatLong16, 2 bytes, "latlong16_encode", "latlong16_decode";
    latlong24 LatLong24, 3 bytes, "latlong24_encode", "latlong24_decode";
    latlong32 LatLong32, 4 bytes, "latlong32_encode", "latlong32_decode";
    latlong16d LatLongD16, 2 bytes, "latlong16d_encode", "latlong16d_decode";
    latlong24d LatLongD24, 3 bytes, "latlong24d_encode", "latlong24d_decode";
    latlong32d LatLongD32, 4 bytes, "latlong32d_encode", "latlong32d_decode";
    fib16 Fib16, 2 bytes, "fib16_encode", "fib16_decode";
    fib24 Fib24, 3 bytes, "fib24_encode", "fib24_decode";
    fib32 Fib32, 4 bytes, "fib32_encode", "fib32_decode";
    ico16 Ico16, 2 bytes, "ico16_encode", "ico16_decode";
    ico24 Ico24, 3 bytes, "ico24_encode", "ico24_decode";
    ico32 Ico32, 4 bytes, "ico32_encode", "ico32_decode";
    snorm8x3_nearest SnormNearest8, 3 bytes, "snorm8x3_nearest_encode", "snorm8x3_nearest_decode";
    snorm16x3p SnormBest16, 6 bytes, "snorm16x3p_encode", "snorm16x3p_decode";
    stereo16 Stereo16, 2 bytes, "stereo16_encode", "stereo16_decode";
    stereo20 Stereo20, 3 bytes, "stereo20_encode", "stereo20_decode";
    stereo22 Stereo22, 3 bytes, "stereo22_encode", "stereo22_decode";
    stereo24 Stereo24, 3 bytes, "stereo24_encode", "stereo24_decode";
    stereo32 Stereo32, 4 bytes, "stereo32_encode", "stereo32_decode";
    stereo_concentric16 StereoConcentric16, 2 bytes, "stereo_concentric16_encode", "stereo_concentric16_decode";
    stereo_concentric20 StereoConcentric20, 3 bytes, "stereo_concentric20_encode", "stereo_concentric20_decode";
    stereo_concentric22 StereoConcentric22, 3 bytes, "stereo_concentric22_encode", "stereo_concentric22_decode";
    stereo_concentric24 StereoConcentric24, 3 bytes, "stereo_concentric24_encode", "stereo_concentric24_decode";
    stereo_concentric32 StereoConcentric32, 4 bytes, "stereo_concentric32_encode", "stereo_concentric32_decode";
    stereo_ellipse16 StereoEllipse16, 2 bytes, "stereo_ellipse16_encode", "stereo_ellipse16_decode";
    stereo_ellipse20 StereoEllipse20, 3 bytes, "stereo_ellipse20_encode", "stereo_ellipse20_decode";
    stereo_ellipse22 StereoEllipse22, 3 bytes, "stereo_ellipse22_encode", "stereo_ellipse22_decode";
    stereo_ellipse24 StereoEllipse24, 3 bytes, "stereo_ellipse24_encode", "stereo_ellipse24_decode";
    stereo_ellipse32 StereoEllipse32, 4 bytes, "stereo_ellipse32_encode", "stereo_ellipse32_decode";
    eqarea16 Eqarea16, 2 bytes, "eqarea16_encode", "eqarea16_decode";
    eqarea20 Eqarea20, 3 bytes, "eqarea20_encode", "eqarea20_decode";
    eqarea22 Eqarea22, 3 bytes, "eqarea22_encode", "eqarea22_decode";
    eqarea24 Eqarea24, 3 bytes, "eqarea24_encode", "eqarea24_decode";
    eqarea32 Eqarea32, 4 bytes, "eqarea32_encode", "eqarea32_decode";
    eqarea_concentric16 EqareaConcentric16, 2 bytes, "eqarea_concentric16_encode", "eqarea_concentric16_decode";
    eqarea_concentric20 EqareaConcentric20, 3 bytes, "eqarea_concentric20_encode", "eqarea_concentric20_decode";
    eqarea_concentric22 EqareaConcentric22, 3 bytes, "eqarea_concentric22_encode", "eqarea_concentric22_decode";
    eqarea_concentric24 EqareaConcentric24, 3 bytes, "eqarea_concentric24_encode", "eqarea_concentric24_decode";
    eqarea_concentric32 EqareaConcentric32, 4 bytes, "eqarea_concentric32_encode", "eqarea_concentric32_decode";
    eqarea_ellipse16 EqareaEllipse16, 2 bytes, "eqarea_ellipse16_encode", "eqarea_ellipse16_decode";
    eqarea_ellipse20 EqareaEllipse20, 3 bytes, "eqarea_ellipse20_encode", "eqarea_ellipse20_decode";
    eqarea_ellipse22 EqareaEllipse22, 3 bytes, "eqarea_ellipse22_encode", "eqarea_ellipse22_decode";
    eqarea_ellipse24 EqareaEllipse24, 3 bytes, "eqarea_ellipse24_encode", "eqarea_ellipse24_decode";
    eqarea_ellipse32 EqareaEllipse32, 4 bytes, "eqarea_ellipse32_encode", "eqarea_ellipse32_decode";
    eqdist16 Eqdist16, 2 bytes, "eqdist16_encode", "eqdist16_decode";
    eqdist20 Eqdist20, 3 bytes, "eqdist20_encode", "eqdist20_decode";
    eqdist22 Eqdist22, 3 bytes, "eqdist22_encode", "eqdist22_decode";
    eqdist24 Eqdist24, 3 bytes, "eqdist24_encode", "eqdist24_decode";
    eqdist32 Eqdist32, 4 bytes, "eqdist32_encode", "eqdist32_decode";
    eqdist_concentric16 EqdistConcentric16, 2 bytes, "eqdist_concentric16_encode", "eqdist_concentric16_decode";
    eqdist_concentric20 EqdistConcentric20, 3 bytes, "eqdist_concentric20_encode", "eqdist_concentric20_decode";
    eqdist_concentric22 EqdistConcentric22, 3 bytes, "eqdist_concentric22_encode", "eqdist_concentric22_decode";
    eqdist_concentric24 EqdistConcentric24, 3 bytes, "eqdist_concentric24_encode", "eqdist_concentric24_decode";
    eqdist_concentric32 EqdistConcentric32, 4 bytes, "eqdist_concentric32_encode", "eqdist_concentric32_decode";
    eqdist_ellipse16 EqdistEllipse16, 2 bytes, "eqdist_ellipse16_encode", "eqdist_ellipse16_decode";
    eqdist_ellipse20 EqdistEllipse20, 3 bytes, "eqdist_ellipse20_encode", "eqdist_ellipse20_decode";
    eqdist_ellipse22 EqdistEllipse22, 3 bytes, "eqdist_ellipse22_encode", "eqdist_ellipse22_decode";
    eqdist_ellipse24 EqdistEllipse24, 3 bytes, "eqdist_ellipse24_encode", "eqdist_ellipse24_decode";
    eqdist_ellipse32 EqdistEllipse32, 4 bytes, "eqdist_ellipse32_encode", "eqdist_ellipse32_decode";
    snorm5x3 Snorm5x3, 2 bytes, "snorm5x3_encode", "snorm5x3_decode";
    snorm8x3 Snorm8x3, 3 bytes, "snorm8x3_encode", "snorm8x3_decode";
    snorm10x3 Snorm10x3, 4 bytes, "snorm10x3_encode", "snorm10x3_decode";
    snorm11_11_10 Snorm11x11x10, 4 bytes, "snorm11_11_10_encode", "snorm11_11_10_decode";
    snorm16x3 Snorm16x3, 6 bytes, "snorm16x3_encode", "snorm16x3_decode";
    unorm8x3 Unorm8x3, 3 bytes, "unorm8x3_encode", "unorm8x3_decode";
    float16x3 Float16x3, 6 bytes, "float16x3_encode", "float16x3_decode";
    cube16 Cube16, 2 bytes, "cube16_encode", "cube16_decode";
    cube24 Cube24, 3 bytes, "cube24_encode", "cube24_decode";
    cube32 Cube32, 4 bytes, "cube32_encode", "cube32_decode";
    warpedcube16 WarpedCube16, 2 bytes, "warpedcube16_encode", "warpedcube16_decode";
    warpedcube24 WarpedCube24, 3 bytes, "warpedcube24_encode", "warpedcube24_decode";
    warpedcube32 WarpedCube32, 4 bytes, "warpedcube32_encode", "warpedcube32_decode";
    xyonly16 XyOnly16, 2 bytes, "xyonly16_encode", "xyonly16_decode";
    xyonly24 XyOnly24, 3 bytes, "xyonly24_encode", "xyonly24_decode";
    xyonly32 XyOnly32, 4 bytes, "xyonly32_encode", "xyonly32_decode";
    xyonly32f XyOnly32F, 4 bytes, "xyonly32f_encode", "xyonly32f_decode";
    pp16 Pp16, 2 bytes, "pp16_encode", "pp16_decode";
    pp24 Pp24, 3 bytes, "pp24_encode", "pp24_decode";
    pp32 Pp32, 4 bytes, "pp32_encode", "pp32_decode";
    pp48 Pp48, 6 bytes, "pp48_encode", "pp48_decode";
    spp16 Spp16, 2 bytes, "spp16_encode", "spp16_decode";
    spp24 Spp24, 3 bytes, "spp24_encode", "spp24_decode";
    spp32 Spp32, 4 bytes, "spp32_encode", "spp32_decode";
    spp48 Spp48, 6 bytes, "spp48_encode", "spp48_decode";
}
