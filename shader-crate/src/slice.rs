//! Whole slices of vectors, to and from densely packed codes.

use crate::codec::Codec;
use core::fmt;
use glam::Vec3;

/// The output slice does not have the size that the input slice asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthMismatch {
    /// Elements that the output must have: bytes when encoding, vectors when decoding.
    pub expected: usize,
    /// Elements that it has.
    pub actual: usize,
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the output slice has {} elements, but the input fills {}", self.actual, self.expected)
    }
}

impl core::error::Error for LengthMismatch {}

/// Encodes `vectors` into `codes`: [`Codec::BYTES`] little-endian bytes each, without gaps.
///
/// # Errors
/// [`LengthMismatch`] unless `codes` has exactly `vectors.len() * C::BYTES` bytes. Nothing is written then.
pub fn encode_slice<C: Codec<Code = u32>>(
    vectors: &[[f32; 3]],
    codes: &mut [u8],
) -> Result<(), LengthMismatch> {
    expect_length(vectors.len() * C::BYTES, codes.len())?;
    for (vector, stored) in vectors.iter().zip(codes.chunks_exact_mut(C::BYTES)) {
        stored.copy_from_slice(&C::encode(Vec3::from_array(*vector)).to_le_bytes()[..C::BYTES]);
    }
    Ok(())
}

/// Decodes `codes`, packed as by [`encode_slice`], into `vectors`.
///
/// # Errors
/// [`LengthMismatch`] unless `codes` has exactly `vectors.len() * C::BYTES` bytes. Nothing is written then.
pub fn decode_slice<C: Codec<Code = u32>>(
    codes: &[u8],
    vectors: &mut [[f32; 3]],
) -> Result<(), LengthMismatch> {
    expect_length(codes.len(), vectors.len() * C::BYTES)?;
    for (stored, vector) in codes.chunks_exact(C::BYTES).zip(vectors) {
        let mut word = [0; 4];
        word[..C::BYTES].copy_from_slice(stored);
        *vector = C::decode(u32::from_le_bytes(word)).to_array();
    }
    Ok(())
}

fn expect_length(expected: usize, actual: usize) -> Result<(), LengthMismatch> {
    if expected == actual { Ok(()) } else { Err(LengthMismatch { expected, actual }) }
}
