//! Kernels that encode and decode.
//!
//! In descriptor set 0, binding 0 is the input, binding 1 the output, both storage buffers; the push constant, a `u32`,
//! is the number of vectors. Vectors are three packed f32, frames seven: normal, tangent, handedness. Codes are dense
//! bytes. Both buffers are arrays of 32-bit words and hold at least the words that the vectors and codes fill. Where
//! one is shorter, only the vectors that both hold are processed. An invocation takes four consecutive vectors, so that
//! any code width ends on whole words; the last takes the rest. Workgroups have 64 invocations.
//!
//! Specialization constant 0, a `u32`: any value but 0 leaves out the tests of lengths, a third of a cheap codec's
//! instructions. Both buffers must then hold the number of vectors rounded up to a multiple of four; shorter ones are
//! undefined behaviour.
//!
//! Specialization constant 1, a `bool`: true takes the device's own division and square root, which may change the last
//! bit of a result. False, the default, rounds both as the CPU does.
//!
//! Binding 2 is a table, where the kernel reads one: that of [`best_fit`](crate::best_fit) for `snorm8x3p_encode` and
//! `crytek_bfn24_encode`, the decoded vectors of all 2^16 codes for `decode_by_table`, which serves all codecs whose
//! codes take two bytes. A kernel whose table is too short writes nothing.

use super::words::{Codes, Element, GROUP, Words};
use super::{CodeWords, element};
use crate::arith::{inverse_root, quotient, reciprocal, root};
use crate::best_fit::{EncodeByTable, TABLE_WORDS};
use crate::codec::{Codec, RawCode};
use crate::frame::{Frame, FrameCodec};
use crate::quat::RotationCodec;
use crate::{for_each_codec, for_each_frame, for_each_rotation};
use glam::Vec3;
use spirv_std::spirv;

/// Number of vectors to process.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Count {
    /// The number of vectors.
    pub vectors: u32,
}

/// The work of an invocation: a group of four.
#[derive(Clone, Copy)]
struct Group {
    index: usize,
    /// Vectors that the host asks for, or none.
    count: usize,
    whole_groups: u32,
}

impl Group {
    /// The number of vectors from this group on, four or more for a whole group, that buffers of these numbers of words
    /// hold and the host asks for: none, where the invocation has nothing to do.
    #[inline(always)]
    fn here<E: Element, W: Codes>(self, words: usize, code_words: usize) -> usize {
        let (first, count) = (self.index * GROUP, self.count);
        if self.whole_groups != 0 {
            return if first < count { GROUP } else { 0 };
        }
        let held = words / (E::Four::LEN / GROUP);
        let codes_held = code_words * 4 / W::LEN;
        let held = if held < codes_held { held } else { codes_held };
        let count = if count < held { count } else { held };
        if first < count { count - first } else { 0 }
    }
}

#[inline(always)]
fn encode<E: Element, W: Codes, C: RawCode>(
    group: Group,
    input: &[u32],
    output: &mut [u32],
    encode: impl Fn(E) -> C,
) {
    let here = group.here::<E, W>(input.len(), output.len());
    if here > 0 {
        // SAFETY: both buffers hold `here` vectors, not 0, from this group on, or with `whole_groups` four, as the caller promised.
        #[allow(unsafe_code)]
        let words = unsafe { E::Four::load(input, group.index, here) };
        let [a, b, c, d] = E::unpack(words);
        let codes =
            W::pack([encode(a).to_words(), encode(b).to_words(), encode(c).to_words(), encode(d).to_words()]);
        // SAFETY: as above.
        #[allow(unsafe_code)]
        unsafe {
            codes.store(output, group.index, here)
        };
    }
}

#[inline(always)]
fn decode<E: Element, W: Codes>(
    group: Group,
    input: &[u32],
    output: &mut [u32],
    decode: impl Fn(CodeWords) -> E,
) {
    let here = group.here::<E, W>(output.len(), input.len());
    if here > 0 {
        // SAFETY: as in `encode`.
        #[allow(unsafe_code)]
        let words = unsafe { W::load(input, group.index, here) };
        let [a, b, c, d] = words.unpack();
        let elements = E::pack([decode(a), decode(b), decode(c), decode(d)]);
        // SAFETY: as in `encode`.
        #[allow(unsafe_code)]
        unsafe {
            elements.store(output, group.index, here)
        };
    }
}

/// Declares a kernel with these statements, for each invocation; with a table, and none to process where that has fewer
/// elements.
macro_rules! kernel {
    (
        $doc:literal
        $kernel:ident($group:ident, $input:ident, $output:ident $(, $table:ident: $Table:ty, $least:expr)?) $body:block
    ) => {
        #[doc = $doc]
        #[spirv(compute(threads(64)))]
        pub fn $kernel(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] count: &Count,
            #[spirv(spec_constant(id = 0, default = 0))] whole_groups: u32,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] $input: &[u32],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] $output: &mut [u32],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = 2)] $table: $Table,)?
        ) {
            $(let count = Count { vectors: if $table.len() < $least { 0 } else { count.vectors } };)?
            let $group = Group { index: id.x as usize, count: count.vectors as usize, whole_groups };
            $body
        }
    };
}

/// The kernel that encodes with this function of a codec; `by_table` as a last argument for codecs that encode by a table.
macro_rules! encode_kernel {
    ($codec:ident $encode:ident) => {
        kernel!("Encodes four vectors, rotations or frames." encode(group, input, output) {
            super::encode::<_, FourCodes, _>(group, input, output, crate::$codec::$encode);
        });
    };
    ($codec:ident $encode:ident by_table) => {
        kernel!("Encodes four vectors." encode(group, input, output, table: &[u32], TABLE_WORDS) {
            // SAFETY: the table has all its words, or no vector is encoded, and encoders look up no others.
            #[allow(unsafe_code)]
            let word = |index| unsafe { element(table, index) };
            super::encode::<_, FourCodes, _>(group, input, output, |v| crate::$codec::encode_by(v, word));
        });
    };
}

/// A module of kernels for each codec, named after it, that call these functions of the trait.
macro_rules! kernels {
    ($trait:ident $encode:ident $decode:ident: $([$id:ident $codec:ident $(($by:ident))?])*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            /// The words that four codes fill.
            type FourCodes = [u32; <crate::$codec as $trait>::BYTES];

            encode_kernel!($codec $encode $($by)?);

            kernel!("Decodes four codes." decode(group, input, output) {
                super::decode::<_, FourCodes>(group, input, output, |words| {
                    crate::$codec::$decode(RawCode::from_words(words))
                });
            });
        }
    )* };
}

macro_rules! codec_kernels {
    ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => {
        kernels! { Codec encode_vec3 decode_vec3: $([$id $codec $(($by))?])* }
    };
}

macro_rules! frame_kernels {
    ($([$id:ident $codec:ident, $($rest:tt)*])*) => {
        kernels! { FrameCodec encode decode: $([$id $codec])* }
    };
}

macro_rules! rotation_kernels {
    ($([$id:ident $codec:ident = $($rest:tt)*])*) => {
        kernels! { RotationCodec encode_vec4 decode_vec4: $([$id $codec])* }
    };
}

for_each_codec!(codec_kernels);
for_each_rotation!(rotation_kernels);
for_each_frame!(frame_kernels);

kernel!("Decodes four codes of two bytes by looking their vectors up."
    decode_by_table(group, input, output, table: &[[u32; 3]], 1 << 16) {
        decode::<_, [u32; 2]>(group, input, output, |[code, _]| {
            // SAFETY: the table has 2^16 elements, or no code is decoded.
            #[allow(unsafe_code)]
            let [x, y, z] = unsafe { element(table, code & 0xffff) };
            Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z))
        });
    }
);

kernel!("Computes with pairs of floats, a of at least 0 and positive b, what codecs compute: a / b, 1 / b, the root of a and its
    inverse, a + b, a b + a, and b's bits as a number. `unitvec conform` learns from it how a device rounds."
    arithmetic(group, input, output) {
        decode::<_, [u32; 8]>(group, input, output, |[low, high]| {
            let (a, b) = (f32::from_bits(low), f32::from_bits(high));
            Frame {
                normal: Vec3::new(quotient(a, b), reciprocal(b), root(a)),
                tangent: Vec3::new(inverse_root(a), a + b, a * b + a),
                handedness: high as i32 as f32,
            }
        });
    }
);
