//! Dithered codes of codecs that are chosen at run time.

use crate::{AnyCodec, CODECS, integer};
use unitvec::Codec;
use unitvec::codec::RawCode;
use unitvec::dither::Dithered;
use unitvec::glam::{Vec2, Vec3};
use unitvec::slice::{LengthMismatch, expect_length};

/// A codec has no dithered codes.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{id} has no dithered codes; {} have", with())]
pub struct NoDither {
    /// The codec's identifier.
    pub id: &'static str,
}

/// The codecs with dithered codes.
fn with() -> String {
    CODECS.iter().filter(|codec| find(codec).is_some()).map(|codec| codec.id).collect::<Vec<_>>().join(", ")
}

/// The dithered functions of a codec: [`unitvec::dither`].
#[derive(Clone, Copy, Debug)]
pub struct Dither<'a> {
    /// The codec.
    pub codec: &'a AnyCodec,
    /// [`Dithered::encode_dithered`] of one vector with its offset: the low word first.
    pub encode_one: fn(Vec3, Vec2) -> [u32; 2],
    /// [`Dithered::decode_dithered`] of one code with its offset.
    pub decode_one: fn([u32; 2], Vec2) -> Vec3,
}

impl<'a> Dither<'a> {
    const fn of<C: Dithered>(codec: &'a AnyCodec) -> Self {
        Self {
            codec,
            encode_one: |v, offset| C::encode_dithered(v, offset).to_words(),
            decode_one: |code, offset| C::decode_dithered(<C as Codec>::Code::from_words(code), offset),
        }
    }
}

/// The functions of a codec of this family, and `None` for the families without them.
macro_rules! of_family {
    (oct $type:ident $codec:ident) => {
        Some(Dither::of::<unitvec::$type>($codec))
    };
    (hemioct $type:ident $codec:ident) => {
        of_family!(oct $type $codec)
    };
    (soct $type:ident $codec:ident) => {
        of_family!(oct $type $codec)
    };
    (eaoct $type:ident $codec:ident) => {
        of_family!(oct $type $codec)
    };
    ($family:ident $type:ident $codec:ident) => {
        None
    };
}

macro_rules! find {
    ($([$id:ident $type:ident $(($by:ident))? = $family:ident::$($rest:tt)*])*) => {
        fn find(codec: &AnyCodec) -> Option<Dither<'_>> {
            match codec.id {
                $(stringify!($id) => of_family!($family $type codec),)*
                _ => None,
            }
        }
    };
}

unitvec::for_each_codec!(find);

impl AnyCodec {
    /// The dithered functions.
    ///
    /// # Errors
    /// [`NoDither`] where the codec has none.
    pub fn dither(&self) -> Result<Dither<'_>, NoDither> {
        find(self).ok_or(NoDither { id: self.id })
    }
}

impl Dither<'_> {
    /// Encodes vectors, three floats each, with an offset of two floats for each. Codes are little endian, without gaps.
    ///
    /// # Errors
    /// The error of [`AnyCodec::count`], also for offsets. Nothing is written then.
    pub fn encode(self, vectors: &[f32], offsets: &[f32], codes: &mut [u8]) -> Result<(), LengthMismatch> {
        expect_length(2 * self.codec.count(vectors.len(), codes.len())?, offsets.len())?;
        let pairs = vectors.chunks_exact(3).zip(offsets.chunks_exact(2));
        for ((vector, offset), code) in pairs.zip(codes.chunks_exact_mut(self.codec.bytes)) {
            let [low, high] = (self.encode_one)(Vec3::from_slice(vector), Vec2::from_slice(offset));
            let word = u64::from(low) | (u64::from(high) << 32);
            code.copy_from_slice(&word.to_le_bytes()[..self.codec.bytes]);
        }
        Ok(())
    }

    /// Decodes codes with the offsets that they were encoded with.
    ///
    /// # Errors
    /// The error of [`encode`](Self::encode).
    pub fn decode(self, codes: &[u8], offsets: &[f32], vectors: &mut [f32]) -> Result<(), LengthMismatch> {
        expect_length(2 * self.codec.count(vectors.len(), codes.len())?, offsets.len())?;
        let pairs = codes.chunks_exact(self.codec.bytes).zip(offsets.chunks_exact(2));
        for ((code, offset), vector) in pairs.zip(vectors.chunks_exact_mut(3)) {
            let word = integer(code);
            let decoded = (self.decode_one)([word as u32, (word >> 32) as u32], Vec2::from_slice(offset));
            vector.copy_from_slice(&decoded.to_array());
        }
        Ok(())
    }
}
