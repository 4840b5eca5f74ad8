//! Whole slices of vectors, to and from densely packed codes.

use crate::codec::{Code, Codec};
use core::fmt;
use glam::Vec3;

/// The slice of codes and the slice of vectors are not of the same number of elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthMismatch {
    /// Bytes of codes that one slice asks of the other.
    pub expected: usize,
    /// Bytes of codes that there are, or that there is room for.
    pub actual: usize,
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the slices do not fit each other: {} bytes of codes against {}",
            self.expected, self.actual
        )
    }
}

impl core::error::Error for LengthMismatch {}

/// Encodes `vectors` into `codes`: [`Codec::BYTES`] little-endian bytes each, without gaps.
///
/// # Errors
/// [`LengthMismatch`] unless `codes` has exactly `vectors.len() * C::BYTES` bytes. Nothing is written then.
pub fn encode_slice<C: Codec>(vectors: &[[f32; 3]], codes: &mut [u8]) -> Result<(), LengthMismatch> {
    encode_slice_with::<C>(vectors, codes, C::encode)
}

/// As [`encode_slice`], with another encoder of the same format, such as one by table.
///
/// # Errors
/// As [`encode_slice`].
pub fn encode_slice_with<C: Codec>(
    vectors: &[[f32; 3]],
    codes: &mut [u8],
    encode: impl Fn(Vec3) -> C::Code,
) -> Result<(), LengthMismatch> {
    expect_length(vectors.len() * C::BYTES, codes.len())?;
    for (vector, stored) in vectors.iter().zip(codes.chunks_exact_mut(C::BYTES)) {
        let [low, high] = encode(Vec3::from_array(*vector)).to_words();
        let bytes = (u64::from(high) << 32 | u64::from(low)).to_le_bytes();
        stored.copy_from_slice(&bytes[..C::BYTES]);
    }
    Ok(())
}

/// Decodes `codes`, packed as by [`encode_slice`], into `vectors`.
///
/// # Errors
/// [`LengthMismatch`] unless `codes` has exactly `vectors.len() * C::BYTES` bytes. Nothing is written then.
pub fn decode_slice<C: Codec>(codes: &[u8], vectors: &mut [[f32; 3]]) -> Result<(), LengthMismatch> {
    expect_length(codes.len(), vectors.len() * C::BYTES)?;
    for (stored, vector) in codes.chunks_exact(C::BYTES).zip(vectors) {
        let mut bytes = [0; 8];
        bytes[..C::BYTES].copy_from_slice(stored);
        let code = u64::from_le_bytes(bytes);
        *vector = C::decode(C::Code::from_words([code as u32, (code >> 32) as u32])).to_array();
    }
    Ok(())
}

/// Fails unless the two sizes are the same.
///
/// # Errors
/// [`LengthMismatch`] of the two.
pub fn expect_length(expected: usize, actual: usize) -> Result<(), LengthMismatch> {
    if expected == actual { Ok(()) } else { Err(LengthMismatch { expected, actual }) }
}
