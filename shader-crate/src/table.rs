//! Decoding by table: all decoded vectors of a codec of at most 16 bits.
//!
//! Source: Cigolle et al. 2014, section 2.4.
//!
//! A table holds `2^BITS` vectors, 768 KiB at 16 bits, and gives the bits that [`Codec::decode`] gives. To look a
//! vector up takes about a nanosecond as long as the table stays in a second-level cache of 1 MiB or more, whatever the
//! codec: with AVX2 as long as [`oct`](crate::oct) is worked out by [`decode_slice`](crate::slice::decode_slice), less
//! than a third of the time for [`latlong`](crate::latlong). So a table pays for codecs that are expensive to decode,
//! for vectors one by one, and where vector instructions are scarce; it does not where other work needs the cache.
//!
//! ```
//! use unitvec::table::DecodeTable;
//! use unitvec::{Codec, LatLongD16};
//!
//! let mut memory = vec![[0.0; 3]; DecodeTable::<LatLongD16>::ENTRIES];
//! let table = DecodeTable::<LatLongD16>::fill(&mut memory)?;
//! let mut vectors = [[0.0; 3]; 2];
//! table.decode_slice(&[7, 1, 0, 0], &mut vectors)?;
//! assert_eq!(vectors[0], LatLongD16::decode::<[f32; 3]>(0x107));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::codec::{Codec, RawCode};
use crate::slice::block::BLOCK;
use crate::slice::loops;
use crate::slice::machine::{Level, Task, as_chunks, prefetch};
use crate::slice::stored::{Stored, with_size};
use crate::slice::{self, LengthMismatch, Vector};
use core::fmt;
use core::marker::PhantomData;

/// The memory for a table is not of the table's size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TableSizeMismatch {
    /// Entries of the table.
    pub expected: usize,
    /// Entries that there is memory for.
    pub actual: usize,
}

impl fmt::Display for TableSizeMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a table of {} vectors in memory for {}", self.expected, self.actual)
    }
}

impl core::error::Error for TableSizeMismatch {}

/// All vectors that the codes of `C`, of at most 16 bits, stand for. More bits do not compile.
pub struct DecodeTable<'a, C> {
    entries: &'a [[f32; 3]],
    codec: PhantomData<fn() -> C>,
}

impl<'a, C: Codec> DecodeTable<'a, C> {
    /// Entries of the table: one for each code.
    pub const ENTRIES: usize = {
        assert!(C::BITS <= 16, "tables are for codecs of at most 16 bits");
        1 << C::BITS
    };

    /// Computes the table in `entries`, in about a millisecond at most.
    ///
    /// # Errors
    /// [`TableSizeMismatch`] unless there are [`ENTRIES`](Self::ENTRIES). Nothing is written then.
    pub fn fill(entries: &'a mut [[f32; 3]]) -> Result<Self, TableSizeMismatch> {
        if entries.len() != Self::ENTRIES {
            return Err(TableSizeMismatch { expected: Self::ENTRIES, actual: entries.len() });
        }
        Level::best().run(Fill { entries, codec: PhantomData::<fn() -> C> });
        Ok(Self { entries, codec: PhantomData })
    }

    /// The vector of `code`, with the bits that [`Codec::decode`] gives. Bits above [`Codec::BITS`] are ignored.
    #[must_use]
    #[inline(always)]
    pub fn decode<V: From<[f32; 3]>>(&self, code: C::Code) -> V {
        self.entry(code.to_words()[0]).into()
    }

    /// Writes the vectors of `codes`, packed as by [`encode_slice`](crate::slice::encode_slice).
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `codes` has exactly `vectors.len() * C::BYTES` bytes. Nothing is written then.
    pub fn decode_slice(&self, codes: &[u8], vectors: &mut [impl Vector]) -> Result<(), LengthMismatch> {
        slice::expect_length(codes.len(), vectors.len() * C::BYTES)?;
        let far = loops::is_far(vectors);
        let (ahead, blocks) = (loops::AHEAD, vectors.len().div_ceil(BLOCK));
        for i in 0..blocks {
            let range = i * BLOCK..vectors.len().min((i + 1) * BLOCK);
            if far && i + ahead + 1 < blocks {
                prefetch(&vectors[(i + ahead) * BLOCK..][..BLOCK]);
            }
            let codes = &codes[range.start * C::BYTES..range.end * C::BYTES];
            let vectors = &mut vectors[range];
            with_size!(C::BYTES, SIZE => {
                for (vector, code) in vectors.iter_mut().zip(as_chunks::<_, SIZE>(codes).0) {
                    *vector = self.entry(code.words().0).into();
                }
            });
        }
        Ok(())
    }

    #[inline(always)]
    fn entry(&self, code: u32) -> [f32; 3] {
        self.entries[code as usize & (Self::ENTRIES - 1)]
    }
}

struct Fill<'a, C> {
    entries: &'a mut [[f32; 3]],
    codec: PhantomData<C>,
}

impl<C: Codec> Task for Fill<'_, fn() -> C> {
    #[inline(always)]
    fn run(self, _: Level) {
        for (code, entry) in (0..).zip(self.entries) {
            *entry = C::decode(C::Code::from_words([code, 0]));
        }
    }
}
