//! Slices with an integer for each code.

use super::machine::{as_chunks, as_chunks_mut};
use super::stored::{Stored, with_size};
use super::strided::{LARGEST_CODE, PORTION};
use super::{LengthMismatch, Vector, decode_slice, encode_slice, expect_length};
use crate::codec::Codec;

/// [`encode_slice`] into integers, one for each code: `u16`, `u32`, `u64`, `[u32; 2]`, or a pair `[i8; 2]` or `[i16; 2]`, the
/// lower half first. Those that are smaller than a code do not compile, nor do pairs that are not as large: they are for
/// codecs of the formats `R8G8_SNORM` and `R16G16_SNORM`.
///
/// ```
/// use unitvec::Oct32;
/// use unitvec::slice::encode_codes;
///
/// let mut codes = [[0i16; 2]; 1];
/// encode_codes::<Oct32>(&[[1.0, 0.0, 0.0]], &mut codes)?;
/// assert_eq!(codes, [[32767, 0]]);
/// # Ok::<(), unitvec::slice::LengthMismatch>(())
/// ```
///
/// ```compile_fail,E0080
/// unitvec::slice::encode_codes::<unitvec::Oct24>(&[[1.0, 0.0, 0.0]], &mut [0u16]);
/// ```
///
/// ```compile_fail,E0080
/// unitvec::slice::encode_codes::<unitvec::Oct24>(&[[1.0, 0.0, 0.0]], &mut [[0i16; 2]]);
/// ```
///
/// # Errors
/// [`LengthMismatch`] unless there are as many codes as vectors. Nothing is written then.
pub fn encode_codes<C: Codec>(
    vectors: &[impl Vector],
    codes: &mut [impl Stored],
) -> Result<(), LengthMismatch> {
    expect_room::<C, _>(codes);
    expect_length(vectors.len() * C::BYTES, codes.len() * C::BYTES)?;
    let mut bytes = [0; PORTION * LARGEST_CODE];
    for (vectors, codes) in vectors.chunks(PORTION).zip(codes.chunks_mut(PORTION)) {
        let bytes = &mut bytes[..codes.len() * C::BYTES];
        encode_slice::<C>(vectors, bytes)?;
        with_size!(C::BYTES, SIZE => convert(as_chunks::<_, SIZE>(bytes).0, codes));
    }
    Ok(())
}

/// [`decode_slice`] from integers, as [`encode_codes`] fills them.
///
/// # Errors
/// The errors of [`encode_codes`].
pub fn decode_codes<C: Codec>(
    codes: &[impl Stored],
    vectors: &mut [impl Vector],
) -> Result<(), LengthMismatch> {
    expect_room::<C, _>(codes);
    expect_length(codes.len() * C::BYTES, vectors.len() * C::BYTES)?;
    let mut bytes = [0; PORTION * LARGEST_CODE];
    for (codes, vectors) in codes.chunks(PORTION).zip(vectors.chunks_mut(PORTION)) {
        let bytes = &mut bytes[..codes.len() * C::BYTES];
        with_size!(C::BYTES, SIZE => convert(codes, as_chunks_mut::<_, SIZE>(bytes).0));
        decode_slice::<C>(bytes, vectors)?;
    }
    Ok(())
}

/// Does not compile where a `T` is smaller than a code of `C`, or a pair of another size.
const fn expect_room<C: Codec, T: Stored>(_: &[T]) {
    const {
        let bits = 8 * size_of::<T>();
        assert!(C::BITS as usize <= bits, "codes of this codec need larger integers");
        assert!(!T::IS_PAIR || C::BITS as usize == bits, "codes of this codec are no pairs of such integers");
    }
}

fn convert(from: &[impl Stored], to: &mut [impl Stored]) {
    for (from, to) in from.iter().zip(to) {
        let (low, high) = from.words();
        *to = Stored::of_words([low, high]);
    }
}
