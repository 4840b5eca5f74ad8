//! The survey's measure of arithmetic (section 4.2) as compute kernels.
//!
//! An invocation takes one vector or code and encodes or decodes it `repetitions` times, each time a little changed so
//! that nothing can be moved out of the loop, and sums the results. The same loop with next to nothing in it is the
//! baseline to subtract.

use super::words::CodeWords;
use crate::codec::Code;
use glam::Vec3;

/// How much to do.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Work {
    /// Number of vectors, one an invocation.
    pub vectors: u32,
    /// Times that each is encoded or decoded.
    pub repetitions: u32,
}

/// What each repetition adds to the vector: 2^-12 and two other small steps, so that the sizes and signs of components
/// do change now and then, as they do from pixel to pixel.
const NUDGE: Vec3 = Vec3::new(1.0 / 4096.0, -1.0 / 8192.0, 1.0 / 6144.0);

/// What each repetition adds to both words of a code: odd, so that all bits change; the fraction of the golden ratio,
/// so that codes spread evenly.
const STEP: u32 = 0x9e37_79b9;

/// Sums the codes of a vector and its neighbours.
#[inline(always)]
pub fn encode<C: Code>(
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
    while repetition < work.repetitions {
        let [low, high] = encode(v).to_words();
        sum = sum.wrapping_add(low).wrapping_add(high);
        v += NUDGE;
        repetition += 1;
    }
    output[index] = sum;
}

/// Sums the components of the vectors of a code and its successors.
#[inline(always)]
pub fn decode(
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
    while repetition < work.repetitions {
        let v = decode([low, high]);
        sum += (v.x + v.y) + v.z;
        low = low.wrapping_add(STEP);
        high = high.wrapping_add(STEP);
        repetition += 1;
    }
    output[index] = f32::to_bits(sum);
}

/// The baseline's code: the sum of the components' bits.
#[inline(always)]
pub fn nothing_encoded(v: Vec3) -> u32 {
    v.x.to_bits().wrapping_add(v.y.to_bits()).wrapping_add(v.z.to_bits())
}

/// The baseline's vector: a number from 1 to 2 made of the code's bits, thrice. As bare bits it might be a denormal,
/// which some processors add slowly.
#[inline(always)]
pub fn nothing_decoded([low, _]: CodeWords) -> Vec3 {
    Vec3::splat(f32::from_bits((low >> 9) | 0x3f80_0000))
}
