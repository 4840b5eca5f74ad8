//! Compute kernels: for each codec a module with the functions `encode` and `decode`, which the SPIR-V build names
//! `<identifier>_encode` and `<identifier>_decode`. (rust-gpu's attribute takes only a literal name, which a macro over the
//! list cannot write.)
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

use crate::best_fit::{EncodeByTable, TABLE_WORDS};
use crate::codec::{Code, Codec};
use crate::for_each_codec;
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

/// The kernels that encode with a codec; `by_table` as a second argument for codecs that encode by a table.
macro_rules! encode_kernels {
    ($codec:ident) => {
        /// Encodes four vectors.
        #[spirv(compute(threads(64)))]
        pub fn encode(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] count: &Count,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[Vectors],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [FourCodes],
        ) {
            super::encode(id.x as usize, *count, input, output, crate::$codec::encode);
        }

        /// Encodes a vector and its neighbours.
        #[spirv(compute(threads(64)))]
        pub fn encode_cost(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] work: &Work,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
        ) {
            cost::encode(id.x as usize, *work, input, output, crate::$codec::encode);
        }
    };
    ($codec:ident by_table) => {
        /// Encodes four vectors.
        #[spirv(compute(threads(64)))]
        pub fn encode(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] count: &Count,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[Vectors],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [FourCodes],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 2)] table: &[u32],
        ) {
            if table.len() < TABLE_WORDS {
                return;
            }
            // SAFETY: the table has all its words, and encoders look up no others.
            #[allow(unsafe_code)]
            let word = |index| unsafe { element(table, index) };
            super::encode(id.x as usize, *count, input, output, |v| crate::$codec::encode_by(v, word));
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
            cost::encode(id.x as usize, *work, input, output, |v| crate::$codec::encode_by(v, word));
        }
    };
}

/// A module of kernels for each codec, named after it.
macro_rules! kernels {
    ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            /// The words that four codes fill.
            type FourCodes = [u32; <crate::$codec as Codec>::BYTES];

            encode_kernels!($codec $($by)?);

            /// Decodes four codes.
            #[spirv(compute(threads(64)))]
            pub fn decode(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] count: &Count,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[FourCodes],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [Vectors],
            ) {
                super::decode(id.x as usize, *count, input, output, |words| {
                    crate::$codec::decode(Code::from_words(words))
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
                    crate::$codec::decode(Code::from_words(words))
                });
            }
        }
    )* };
}

for_each_codec!(kernels);

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
#[spirv(compute(threads(64)))]
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
