//! Whole slices of vectors, to and from densely packed codes: the functions of [`Codec`], bit for bit, several vectors at
//! a time.
//!
//! * With the feature `std` the instruction set is chosen at run time: on x86-64 AVX2, SSE4.1 or the set that the crate
//!   was compiled for; on AArch64 NEON is always there. Without `std` it is the set that the crate was compiled for. The
//!   feature `avx512` adds AVX-512, from Rust 1.89 on. Its builds take longer, since every codec is compiled once more.
//! * Outputs of 32 MiB or more are written past the caches on x86-64: memory that is only written need not be read first.
//! * Nothing is allocated. A slice is worked through in blocks of 64 vectors. To encode or decode fewer than 32 costs as
//!   much as 32: for single vectors take the functions of [`Codec`].
//! * Vectors are those of any library: see [`Vector`].
//! * Codes may be integers: see [`encode_codes`]. To give other functions a slice of integers, see it as bytes, with
//!   `bytemuck::cast_slice_mut(&mut codes)`.
//! * Vectors and codes may lie among the other fields of vertices: see [`encode_strided`]. Of cheap codecs, such as `oct32`,
//!   that takes about the time of a loop of your own over the structs: gathering and scattering cost as much as the CPU's
//!   vector instructions save. Packed codes are read and written in place.
//! * Frames and rotations have functions of their own: [`encode_frames`], [`encode_rotations`].
//! * Slice functions are generic: they are compiled at the `opt-level` of the crate that calls them with a named codec.
//!   The `opt-level` of `unitvec` chooses the loop: at 0, the development profile's, one vector at a time, else blocks.
//!   For the speed of a release build raise both: `opt-level = 2` under `[profile.dev]`, or under
//!   `[profile.dev.package.unitvec]` and the same for the library of yours that calls them.
//! * With the feature `rayon`, functions that begin with `par_` use all cores; strided data and codes as integers have none.
//!   A process that is forked has none of its parent's threads. There, call `par_` functions inside
//!   `rayon::ThreadPool::install` of a new pool: without it, more than 16,384 elements wait for ever.
//!
//! ```
//! use unitvec::slice::{decode_slice, encode_slice};
//! use unitvec::{Codec, Oct16};
//!
//! let vectors = [[0.6, 0.0, -0.8], [0.0, 1.0, 0.0]];
//! let mut codes = [0; 2 * Oct16::BYTES];
//! encode_slice::<Oct16>(&vectors, &mut codes)?;
//! let mut decoded = [[0.0; 3]; 2];
//! decode_slice::<Oct16>(&codes, &mut decoded)?;
//! assert_eq!(decoded[1], [0.0, 1.0, 0.0]);
//! # Ok::<(), unitvec::slice::LengthMismatch>(())
//! ```

pub(crate) mod block;
mod coded;
mod elements;
pub(crate) mod loops;
#[doc(hidden)]
pub mod machine;
#[cfg(feature = "rayon")]
mod parallel;
pub(crate) mod stored;
mod strided;

use crate::codec::{Codec, RawCode};
pub(crate) use block::Coder;
use block::{Floats, Snorms, Target};
use core::fmt;
use core::marker::PhantomData;
use loops::{Decode, Encode};
use machine::{Level, as_chunks_mut};
pub use stored::Stored;
use stored::with_size;

pub use coded::{decode_codes, encode_codes};
pub use elements::{
    AnyFrame, AnyRotation, decode_frames, decode_frames_strided, decode_rotations, decode_rotations_strided,
    decode_slice, decode_strided, encode_frames, encode_frames_strided, encode_rotations,
    encode_rotations_strided, encode_slice, encode_strided,
};
#[doc(hidden)]
pub use elements::{
    decode_frames_at, decode_rotations_at, decode_slice_at, encode_frames_at, encode_rotations_at,
    encode_slice_at,
};
#[cfg(feature = "rayon")]
pub use elements::{
    par_decode_frames, par_decode_rotations, par_decode_slice, par_encode_frames, par_encode_rotations,
    par_encode_slice,
};
pub use strided::{Side, StrideError, Strided};
#[doc(hidden)]
pub use strided::{decode_strided_with, encode_strided_with};

#[cfg(feature = "rayon")]
#[doc(hidden)]
pub use parallel::{par_decode_with, par_encode_with};

/// A slice function: elements to codes, with the instructions of a level.
#[doc(hidden)]
pub type EncodeAt<T> = fn(Level, &[T], &mut [u8]) -> Result<(), LengthMismatch>;

/// A slice function: codes to elements, with the instructions of a level.
#[doc(hidden)]
pub type DecodeAt<T> = fn(Level, &[u8], &mut [T]) -> Result<(), LengthMismatch>;

/// The slices are not of as many elements as codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LengthMismatch {
    /// Bytes of codes for the elements of the input.
    pub expected: usize,
    /// Bytes of codes for the elements of the output.
    pub actual: usize,
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the slices are of different lengths: the input has, or makes, {} bytes of codes, and the output {}",
            self.expected, self.actual
        )
    }
}

impl core::error::Error for LengthMismatch {}

/// A vector of any library: whatever converts from and to `[f32; 3]`, and that array itself. Every such type implements it.
pub trait Vector: Copy + Send + Sync + From<[f32; 3]> + Into<[f32; 3]> {}

impl<V: Copy + Send + Sync + From<[f32; 3]> + Into<[f32; 3]>> Vector for V {}

/// [`encode_slice`] with another encoder of the same format, such as one by table. One vector at a time.
///
/// # Errors
/// The errors of [`encode_slice`].
pub fn encode_slice_with<C: Codec>(
    vectors: &[impl Vector],
    codes: &mut [u8],
    encode: impl Fn([f32; 3]) -> C::Code,
) -> Result<(), LengthMismatch> {
    store_each(vectors, codes, C::BYTES, |vector| encode((*vector).into()).to_words())
}

/// Writes the words of each element's code, of `size` bytes.
pub(crate) fn store_each<T>(
    elements: &[T],
    codes: &mut [u8],
    size: usize,
    words: impl Fn(&T) -> [u32; 2],
) -> Result<(), LengthMismatch> {
    expect_length(elements.len() * size, codes.len())?;
    with_size!(size, SIZE => {
        for (element, stored) in elements.iter().zip(as_chunks_mut::<_, SIZE>(codes).0) {
            *stored = Stored::of_words(words(element));
        }
    });
    Ok(())
}

/// Makes each element of the words of its code, of `size` bytes: the reverse of [`store_each`].
#[cfg(feature = "std")]
pub(crate) fn load_each<T>(
    codes: &[u8],
    elements: &mut [T],
    size: usize,
    element: impl Fn([u32; 2]) -> T,
) -> Result<(), LengthMismatch> {
    expect_length(codes.len(), elements.len() * size)?;
    with_size!(size, SIZE => {
        for (stored, to) in machine::as_chunks::<_, SIZE>(codes).0.iter().zip(elements) {
            let (low, high) = stored.words();
            *to = element([low, high]);
        }
    });
    Ok(())
}

/// Decodes `codes`, packed as by [`encode_slice`], into x, y and z as snorm of 16 bits and a fourth component of 0: a
/// VK_FORMAT_R16G16B16A16_SNORM, two thirds of the memory of floats. The components are those that [`decode_slice`]
/// gives, as [`snorm_encode`](crate::arith::snorm_encode) writes them.
///
/// # Errors
/// [`LengthMismatch`] unless `codes` has exactly `vectors.len() * C::BYTES` bytes. Nothing is written then.
pub fn decode_slice_i16x4<C: Codec>(codes: &[u8], vectors: &mut [[i16; 4]]) -> Result<(), LengthMismatch> {
    decode_slice_i16x4_at::<C>(Level::best(), codes, vectors)
}

/// [`encode_slice_at`] for any coder, of elements of `N` floats.
pub(crate) fn encode_slice_by<const N: usize>(
    coder: impl Coder<N>,
    level: Level,
    elements: &[impl Copy + Into<[f32; N]>],
    codes: &mut [u8],
) -> Result<(), LengthMismatch> {
    expect_length(elements.len() * coder.bytes(), codes.len())?;
    let level = level.for_output(codes.len());
    let head = level.before_line(codes, coder.bytes()).min(elements.len());
    let (elements, codes) = (elements.split_at(head), codes.split_at_mut(head * coder.bytes()));
    for (elements, codes) in [(elements.0, codes.0), (elements.1, codes.1)] {
        if !elements.is_empty() {
            level.run(Encode { elements, codes, coder });
        }
    }
    Ok(())
}

/// [`decode_slice_at`] for any coder, of elements of `N` floats.
pub(crate) fn decode_slice_by<const N: usize>(
    coder: impl Coder<N>,
    level: Level,
    codes: &[u8],
    elements: &mut [impl Copy + From<[f32; N]>],
) -> Result<(), LengthMismatch> {
    expect_length(codes.len(), elements.len() * coder.bytes())?;
    decode_to::<N, Floats, _>(coder, level, codes, elements);
    Ok(())
}

/// [`decode_slice_i16x4`] with the instructions of a given level.
#[doc(hidden)]
pub fn decode_slice_i16x4_at<C: Codec>(
    level: Level,
    codes: &[u8],
    vectors: &mut [[i16; 4]],
) -> Result<(), LengthMismatch> {
    expect_length(codes.len(), vectors.len() * C::BYTES)?;
    decode_to::<3, Snorms, _>(PhantomData::<C>, level, codes, vectors);
    Ok(())
}

/// Decodes as many codes as elements.
fn decode_to<const N: usize, T: Target<E, N>, E: Copy>(
    coder: impl Coder<N>,
    level: Level,
    codes: &[u8],
    elements: &mut [E],
) {
    let level = level.for_output(size_of_val(elements));
    let head = level.before_line(elements, size_of::<E>()).min(elements.len());
    let (codes, elements) = (codes.split_at(head * coder.bytes()), elements.split_at_mut(head));
    for (codes, elements) in [(codes.0, elements.0), (codes.1, elements.1)] {
        if !elements.is_empty() {
            level.run(Decode { codes, elements, coder, target: PhantomData::<T> });
        }
    }
}

/// Fails unless the two sizes are the same.
///
/// # Errors
/// [`LengthMismatch`] with the two.
#[doc(hidden)]
pub fn expect_length(expected: usize, actual: usize) -> Result<(), LengthMismatch> {
    if expected == actual { Ok(()) } else { Err(LengthMismatch { expected, actual }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::sync::atomic::{AtomicUsize, Ordering};
    use glam::Vec3;

    static CALLS: AtomicUsize = AtomicUsize::new(0);

    /// Counts how often it is called.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    struct Counting;

    impl Codec for Counting {
        const BITS: u32 = 32;
        const MAX_ERROR_DEG: f32 = 180.0;
        type Code = u32;

        fn encode_vec3(_: Vec3) -> u32 {
            CALLS.fetch_add(1, Ordering::Relaxed) as u32
        }

        fn decode_vec3(_: u32) -> Vec3 {
            CALLS.fetch_add(1, Ordering::Relaxed);
            Vec3::Z
        }
    }

    /// The number of calls of the encoder, and of the decoder, for a slice of one vector.
    fn calls() -> [usize; 2] {
        let (mut codes, mut vectors) = ([0; 4], [[0.0; 3]]);
        encode_slice::<Counting>(&vectors, &mut codes).unwrap();
        let encode = CALLS.swap(0, Ordering::Relaxed);
        decode_slice::<Counting>(&codes, &mut vectors).unwrap();
        [encode, CALLS.swap(0, Ordering::Relaxed)]
    }

    #[cfg(unoptimised)]
    #[test]
    fn unoptimised_is_one_at_a_time() {
        assert_eq!(calls(), [1, 1]);
    }

    /// As many vectors as vector instructions are made for: the block's functions are used.
    #[cfg(not(unoptimised))]
    #[test]
    fn optimised_is_a_group_at_a_time() {
        assert_eq!(calls(), [32, 32]);
    }
}
