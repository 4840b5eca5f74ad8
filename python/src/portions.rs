//! Arrays in portions: rounded, encoded and widened one after the other, or on several threads.

use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::borrow::Cow;
use unitvec::slice::expect_length;
use unitvec_catalogue::{AnyCodec, Element, Manner, has_threads};

/// Elements of a portion. The slices of `unitvec` prefetch from 1 MiB of floats on.
const PORTION: usize = 1 << 17;

/// The only error: arrays of different lengths, which `__init__.py` never passes.
type Result = std::result::Result<(), unitvec_catalogue::LengthMismatch>;

/// Floats of elements, without gaps.
#[derive(Clone, Copy)]
pub enum Floats<'a> {
    Single(&'a [f32]),
    Double(&'a [f64]),
}

impl<'a> Floats<'a> {
    /// The floats of the portion of this index.
    fn portion(self, element: Element, index: usize) -> Cow<'a, [f32]> {
        let size = PORTION * element.floats();
        match self {
            Self::Single(floats) => Cow::Borrowed(floats.chunks(size).nth(index).unwrap_or_default()),
            Self::Double(doubles) => {
                let doubles = doubles.chunks(size).nth(index).unwrap_or_default();
                let mut floats = vec![0.0; doubles.len()];
                element.round(doubles, &mut floats);
                Cow::Owned(floats)
            }
        }
    }
}

/// The manner of the portion of this index.
fn portion<'a>(manner: &Manner<'a>, index: usize) -> Manner<'a> {
    let of = |offsets: &'a [f32]| offsets.chunks(PORTION * 2).nth(index).unwrap_or_default();
    Manner { dither: manner.dither.map(|(dither, offsets)| (dither, of(offsets))), ..*manner }
}

/// Threads to work on.
pub enum Pool {
    /// The calling one.
    Here,
    /// All cores, by rayon's own threads.
    Shared,
    Own(ThreadPool),
}

impl Pool {
    /// All cores for `None`, unless this process was forked from one whose threads had been started.
    pub fn of(threads: Option<usize>) -> std::result::Result<Self, ThreadPoolBuildError> {
        match threads {
            Some(0 | 1) => Ok(Self::Here),
            Some(number) => ThreadPoolBuilder::new().num_threads(number).build().map(Self::Own),
            None if has_threads() => Ok(Self::Shared),
            None => Ok(Self::Here),
        }
    }

    /// Runs a function for each portion of `size` values, with its index.
    fn run<T: Send>(
        &self,
        output: &mut [T],
        size: usize,
        each: impl Fn(usize, &mut [T]) -> Result + Sync,
    ) -> Result {
        let in_parallel = |output: &mut [T]| {
            output.par_chunks_mut(size).enumerate().try_for_each(|(index, portion)| each(index, portion))
        };
        match self {
            Self::Here => {
                output.chunks_mut(size).enumerate().try_for_each(|(index, portion)| each(index, portion))
            }
            Self::Shared => in_parallel(output),
            Self::Own(pool) => pool.install(|| in_parallel(output)),
        }
    }
}

/// Encodes elements to little-endian integers.
pub fn encode(
    codec: &AnyCodec,
    floats: Floats<'_>,
    integers: &mut [u8],
    manner: &Manner<'_>,
    pool: &Pool,
) -> Result {
    pool.run(integers, PORTION * codec.integer_bytes(), |index, integers| {
        codec.encode_integers(&floats.portion(codec.element, index), integers, portion(manner, index))
    })
}

/// Decodes little-endian integers.
pub fn decode(
    codec: &AnyCodec,
    integers: &[u8],
    elements: &mut [f32],
    manner: &Manner<'_>,
    pool: &Pool,
) -> Result {
    pool.run(elements, PORTION * codec.element.floats(), |index, elements| {
        let integers = integers.chunks(PORTION * codec.integer_bytes()).nth(index).unwrap_or_default();
        codec.decode_integers(integers, elements, portion(manner, index))
    })
}

/// The error of each part of each element.
pub fn error(codec: &AnyCodec, floats: Floats<'_>, errors: &mut [f64], pool: &Pool) -> Result {
    pool.run(errors, PORTION * codec.element.directions().len(), |index, errors| {
        codec.errors(&floats.portion(codec.element, index), errors)
    })
}

/// The elements as [`AnyCodec::snapped`] moves them.
pub fn snap(codec: &AnyCodec, floats: Floats<'_>, snapped: &mut [f32], pool: &Pool) -> Result {
    pool.run(snapped, PORTION * codec.element.floats(), |index, snapped| {
        let floats = floats.portion(codec.element, index);
        expect_length(floats.len(), snapped.len())?;
        snapped.copy_from_slice(&floats);
        codec.snap(snapped);
        Ok(())
    })
}
