//! The survey's measure of arithmetic (section 4.2) as compute kernels.
//!
//! An invocation takes one vector or code and encodes or decodes it `repetitions` times, each time a little changed so
//! that nothing can be moved out of the loop, and sums the results. Four go at a time, so that the loop takes little and
//! each can start before the one before it is done. The same loop with next to nothing in it is the baseline to subtract.

use super::{CodeWords, element};
use crate::best_fit::{EncodeByTable, TABLE_WORDS};
use crate::codec::{Codec, RawCode};
use crate::frame::{Frame, FrameCodec};
use crate::quat::RotationCodec;
use crate::{for_each_codec, for_each_frame, for_each_rotation};
use glam::Vec3;
use spirv_std::spirv;

/// The amount of work.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Work {
    /// Number of vectors, one an invocation.
    pub vectors: u32,
    /// Times that each is encoded or decoded: a multiple of four, or else the next, and not 0.
    pub repetitions: u32,
}

/// The numbers that each repetition adds to the vector: 2^-12 and two other small steps, so that the sizes and signs of
/// components do change now and then, as they do from pixel to pixel.
const NUDGE: Vec3 = Vec3::new(1.0 / 4096.0, -1.0 / 8192.0, 1.0 / 6144.0);

/// The number that each repetition adds to both words of a code: odd, so that all bits change; the fraction of the
/// golden ratio, so that codes spread evenly.
const STEP: u32 = 0x9e37_79b9;

/// Sums the codes of a vector and its neighbours.
#[inline(always)]
fn encode<C: RawCode>(
    index: usize,
    work: Work,
    input: &[[u32; 3]],
    output: &mut [u32],
    encode: impl Fn(Vec3) -> C,
) {
    if index >= work.vectors as usize {
        return;
    }
    let [x, y, z] = input[index];
    let mut v = Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z));
    let mut sum = 0u32;
    let mut repetition = 0;
    // A test at the end: rust-gpu makes a branch inside the loop of one at the beginning.
    loop {
        let [v1, v2, v3] = [v + NUDGE, v + 2.0 * NUDGE, v + 3.0 * NUDGE];
        let [a, b] = [encode(v).to_words(), encode(v1).to_words()];
        let [c, d] = [encode(v2).to_words(), encode(v3).to_words()];
        sum = sum.wrapping_add(total(a)).wrapping_add(total(b)).wrapping_add(total(c)).wrapping_add(total(d));
        v += 4.0 * NUDGE;
        repetition += 4;
        if repetition >= work.repetitions {
            break;
        }
    }
    output[index] = sum;
}

#[inline(always)]
fn total([low, high]: CodeWords) -> u32 {
    low.wrapping_add(high)
}

/// Sums the components of the vectors of a code and its successors.
#[inline(always)]
fn decode(
    index: usize,
    work: Work,
    input: &[[u32; 3]],
    output: &mut [u32],
    decode: impl Fn(CodeWords) -> Vec3,
) {
    if index >= work.vectors as usize {
        return;
    }
    let [mut low, mut high, _] = input[index];
    let mut sum = 0.0;
    let mut repetition = 0;
    loop {
        let code = |n: u32| [low.wrapping_add(STEP.wrapping_mul(n)), high.wrapping_add(STEP.wrapping_mul(n))];
        let v = (decode(code(0)) + decode(code(1))) + (decode(code(2)) + decode(code(3)));
        sum += (v.x + v.y) + v.z;
        [low, high] = code(4);
        repetition += 4;
        if repetition >= work.repetitions {
            break;
        }
    }
    output[index] = f32::to_bits(sum);
}

/// The baseline's code: the sum of the components' bits.
#[inline(always)]
fn nothing_encoded(v: Vec3) -> u32 {
    v.x.to_bits().wrapping_add(v.y.to_bits()).wrapping_add(v.z.to_bits())
}

/// The baseline's vector: a number from 1 to 2 made of the code's bits, thrice. As bare bits it might be a denormal,
/// which some processors add slowly.
#[inline(always)]
fn nothing_decoded([low, _]: CodeWords) -> Vec3 {
    Vec3::splat(f32::from_bits((low >> 9) | 0x3f80_0000))
}

/// Declares the kernel that sums, by `encode` or `decode`, what this function gives; with a table, where it has at least so
/// many words.
macro_rules! kernel {
    ($doc:literal $kernel:ident = $sum:ident, $function:expr $(, $table:ident of $words:expr)?) => {
        #[doc = $doc]
        #[spirv(compute(threads(64)))]
        pub fn $kernel(
            #[spirv(global_invocation_id)] id: spirv_std::glam::UVec3,
            #[spirv(push_constant)] work: &Work,
            #[spirv(storage_buffer, descriptor_set = 0, binding = 0)] input: &[[u32; 3]],
            #[spirv(storage_buffer, descriptor_set = 0, binding = 1)] output: &mut [u32],
            $(#[spirv(storage_buffer, descriptor_set = 0, binding = 2)] $table: &[u32],)?
        ) {
            $(if $table.len() < $words {
                return;
            })?
            super::$sum(id.x as usize, *work, input, output, $function);
        }
    };
}

/// The kernel that encodes with a codec; `by_table` as a second argument for codecs that encode by a table.
macro_rules! encode_kernel {
    ($codec:ident) => {
        kernel!("Encodes a vector and its neighbours." encode_cost = encode, crate::$codec::encode_vec3);
    };
    ($codec:ident by_table) => {
        kernel!("Encodes a vector and its neighbours." encode_cost = encode, |v| {
            // SAFETY: the table has all its words, and encoders look up no others.
            #[allow(unsafe_code)]
            let word = |index| unsafe { element(table, index) };
            crate::$codec::encode_by(v, word)
        }, table of TABLE_WORDS);
    };
}

/// A module of kernels for each codec, named after it.
macro_rules! kernels {
    ($([$id:ident $codec:ident $(($by:ident))? = $($rest:tt)*])*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            encode_kernel!($codec $($by)?);

            kernel!("Decodes a code and its successors." decode_cost = decode, |words| {
                crate::$codec::decode_vec3(RawCode::from_words(words))
            });
        }
    )* };
}

for_each_codec!(kernels);

/// A module of kernels for each codec of rotations, named after it.
macro_rules! rotation_kernels {
    ($([$id:ident $codec:ident = $($rest:tt)*])*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            kernel!(
                "Encodes a vector and its neighbours, each as a quaternion whose w is its y."
                encode_cost = encode, |v| crate::$codec::encode_vec4(v.extend(v.y))
            );
            kernel!("Decodes a code and its successors." decode_cost = decode, |words| {
                let q = crate::$codec::decode_vec4(RawCode::from_words(words));
                q.truncate() * q.w
            });
        }
    )* };
}

for_each_rotation!(rotation_kernels);

/// A module of kernels for each codec of frames, named after it.
macro_rules! frame_kernels {
    ($([$id:ident $codec:ident, $($rest:tt)*])*) => { $(
        #[doc = concat!("Kernels of [`", stringify!($codec), "`](crate::", stringify!($codec), ").")]
        pub mod $id {
            use super::*;

            kernel!(
                "Encodes a vector and its neighbours, each as normal and, turned about (1, 1, 1), as tangent."
                encode_cost = encode, |v| {
                    crate::$codec::encode(Frame { normal: v, tangent: Vec3::new(v.y, v.z, v.x), handedness: v.x })
                }
            );
            kernel!("Decodes a code and its successors." decode_cost = decode, |words| {
                let frame = crate::$codec::decode(RawCode::from_words(words));
                frame.normal + frame.tangent * frame.handedness
            });
        }
    )* };
}

for_each_frame!(frame_kernels);

/// The work of the cost kernels besides encoding and decoding, to be subtracted.
pub mod baseline {
    use super::*;

    kernel!("Fetches and sums as `encode_cost` does." encode_cost = encode, nothing_encoded);
    kernel!("Fetches and sums as `decode_cost` does." decode_cost = decode, nothing_decoded);
}
