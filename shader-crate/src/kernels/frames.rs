//! Kernels of the tangent frames: as those of vectors, with seven packed f32 for three.

use super::Count;
use super::cost::{self, Work};
use super::words::{CodeWords, Words};
use crate::codec::Code;
use crate::{Frame, Frame32, Frame64, FrameCodec, for_each_frame};
use glam::Vec3;
use spirv_std::spirv;

/// Four frames, as words of f32 bits: of each the normal, the tangent, the handedness.
pub type Frames = [u32; 28];

#[inline(always)]
fn frame(words: &Frames, n: usize) -> Frame {
    Frame {
        normal: Vec3::new(
            f32::from_bits(words[7 * n]),
            f32::from_bits(words[7 * n + 1]),
            f32::from_bits(words[7 * n + 2]),
        ),
        tangent: Vec3::new(
            f32::from_bits(words[7 * n + 3]),
            f32::from_bits(words[7 * n + 4]),
            f32::from_bits(words[7 * n + 5]),
        ),
        handedness: f32::from_bits(words[7 * n + 6]),
    }
}

#[inline(always)]
fn set_frame(words: &mut Frames, n: usize, frame: Frame) {
    words[7 * n] = frame.normal.x.to_bits();
    words[7 * n + 1] = frame.normal.y.to_bits();
    words[7 * n + 2] = frame.normal.z.to_bits();
    words[7 * n + 3] = frame.tangent.x.to_bits();
    words[7 * n + 4] = frame.tangent.y.to_bits();
    words[7 * n + 5] = frame.tangent.z.to_bits();
    words[7 * n + 6] = frame.handedness.to_bits();
}

#[inline(always)]
fn encode<F: FrameCodec, W: Words>(index: usize, count: Count, input: &[Frames], output: &mut [W]) {
    if index * 4 >= count.vectors as usize {
        return;
    }
    let f = &input[index];
    output[index] = W::pack([
        F::encode(frame(f, 0)).to_words(),
        F::encode(frame(f, 1)).to_words(),
        F::encode(frame(f, 2)).to_words(),
        F::encode(frame(f, 3)).to_words(),
    ]);
}

#[inline(always)]
fn decode<F: FrameCodec, W: Words>(index: usize, count: Count, input: &[W], output: &mut [Frames]) {
    if index * 4 >= count.vectors as usize {
        return;
    }
    let decode = |words: CodeWords| F::decode(Code::from_words(words));
    let [a, b, c, d] = input[index].unpack();
    let f = &mut output[index];
    set_frame(f, 0, decode(a));
    set_frame(f, 1, decode(b));
    set_frame(f, 2, decode(c));
    set_frame(f, 3, decode(d));
}

/// A module of kernels for each codec of frames, named after it.
macro_rules! frame_kernels {
    ($([$id:ident $codec:ident, $($rest:tt)*])*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`].")]
        pub mod $id {
            use super::*;

            /// The words that four codes fill.
            type FourCodes = [u32; <$codec as FrameCodec>::BYTES];

            /// Encodes four frames.
            #[spirv(compute(threads(64)))]
            pub fn encode(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] count: &Count,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[Frames],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [FourCodes],
            ) {
                super::encode::<$codec, _>(id.x as usize, *count, input, output);
            }

            /// Encodes a vector and its neighbours, each as normal and, turned about (1, 1, 1), as tangent.
            #[spirv(compute(threads(64)))]
            pub fn encode_cost(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] work: &Work,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
            ) {
                cost::encode(id.x as usize, *work, input, output, |v| {
                    $codec::encode(Frame { normal: v, tangent: Vec3::new(v.y, v.z, v.x), handedness: v.x })
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
                    let frame = $codec::decode(Code::from_words(words));
                    frame.normal + frame.tangent * frame.handedness
                });
            }

            /// Decodes four codes.
            #[spirv(compute(threads(64)))]
            pub fn decode(
                #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
                #[spirv(push_constant)] count: &Count,
                #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[FourCodes],
                #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [Frames],
            ) {
                super::decode::<$codec, _>(id.x as usize, *count, input, output);
            }
        }
    )* };
}

for_each_frame!(frame_kernels);
