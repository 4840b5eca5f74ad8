//! Null codes of codecs that are chosen at run time.

use crate::{AnyCodec, WRAPPED, integer, vectors};
use unitvec::direction::{is_usable, l1_norm};
use unitvec::glam::Vec3;
use unitvec::slice::LengthMismatch;

/// A codec has no null code: it is for frames, or writes every code.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
#[error(
    "{id} has no code to spare for vectors without a direction; all codecs of vectors have, but {}; of formats of other \
     software {}",
    without(),
    with()
)]
pub struct NoNull {
    /// The codec's identifier.
    pub id: &'static str,
}

/// The formats of other software with a null code.
fn with() -> String {
    let rows = unitvec::interop::ROWS.iter().filter(|row| row.null.is_some());
    rows.map(|row| row.name).collect::<Vec<_>>().join(", ")
}

/// The codecs of vectors without a null code.
fn without() -> String {
    let without = vectors().iter().chain(&WRAPPED).filter(|codec| codec.null.is_none());
    without.map(|codec| codec.id).collect::<Vec<_>>().join(", ")
}

/// The null code of a codec. It makes codes and vectors those of [`unitvec::OrNull`].
#[derive(Clone, Copy, Debug)]
pub struct Null<'a> {
    codec: &'a AnyCodec,
    /// The code as a number.
    pub code: u64,
}

impl AnyCodec {
    /// The null code.
    ///
    /// # Errors
    /// [`NoNull`] where the codec has none.
    pub fn null(&self) -> Result<Null<'_>, NoNull> {
        let [low, high] = self.null.ok_or(NoNull { id: self.id })?;
        Ok(Null { codec: self, code: u64::from(low) | (u64::from(high) << 32) })
    }
}

impl Null<'_> {
    /// Puts the null code in the place of the codes of vectors without a usable direction. Returns their number.
    ///
    /// # Errors
    /// The error of [`AnyCodec::count`]. Nothing is written then.
    pub fn put(self, vectors: &[f32], codes: &mut [u8]) -> Result<u64, LengthMismatch> {
        self.codec.count(vectors.len(), codes.len())?;
        let pairs = vectors.chunks_exact(3).zip(codes.chunks_exact_mut(self.codec.bytes));
        let mut count = 0;
        for (_, code) in pairs.filter(|(vector, _)| !is_usable(l1_norm(Vec3::from_slice(vector)))) {
            code.copy_from_slice(&self.code.to_le_bytes()[..self.codec.bytes]);
            count += 1;
        }
        Ok(count)
    }

    /// Puts (0, 0, 0) in the place of the vectors of null codes.
    ///
    /// # Errors
    /// The error of [`AnyCodec::count`]. Nothing is written then.
    pub fn clear(self, codes: &[u8], vectors: &mut [f32]) -> Result<(), LengthMismatch> {
        self.codec.count(vectors.len(), codes.len())?;
        let is_null = |code| (integer(code) ^ self.code) << (64 - self.codec.bits) == 0;
        let pairs = codes.chunks_exact(self.codec.bytes).zip(vectors.chunks_exact_mut(3));
        pairs.filter(|(code, _)| is_null(code)).for_each(|(_, vector)| vector.fill(0.0));
        Ok(())
    }
}
