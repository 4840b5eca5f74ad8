//! Arrays in portions: rounded, encoded and widened one after the other, or on several threads.

use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::borrow::Cow;
use unitvec_catalogue::{AnyCodec, Dither, Element, Null, has_threads};

/// Elements of a portion. The slices of `unitvec` prefetch from 1 MiB of floats on.
const PORTION: usize = 1 << 17;

/// The only error: arrays of different lengths, which `__init__.py` never passes.
type Result = std::result::Result<(), Box<dyn std::error::Error + Send + Sync>>;

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

/// How to code, besides the codec.
pub struct Manner<'a> {
    pub null: Option<Null<'a>>,
    /// Dithered functions, and an offset of two floats for each vector.
    pub dither: Option<(Dither<'a>, &'a [f32])>,
    pub pool: Pool,
}

impl<'a> Manner<'a> {
    /// The dithered functions, and the offsets of the portion of this index.
    fn dither(&self, index: usize) -> Option<(Dither<'a>, &'a [f32])> {
        let portion = |offsets: &'a [f32]| offsets.chunks(PORTION * 2).nth(index).unwrap_or_default();
        self.dither.map(|(dither, offsets)| (dither, portion(offsets)))
    }
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

/// Encodes elements to little-endian codes in `item` bytes each.
pub fn encode(
    codec: &AnyCodec,
    floats: Floats<'_>,
    (codes, item): (&mut [u8], usize),
    manner: &Manner<'_>,
) -> Result {
    manner.pool.run(codes, PORTION * item, |index, codes| {
        let floats = floats.portion(codec.element, index);
        let encode = |codes: &mut [u8]| {
            match manner.dither(index) {
                Some((dither, offsets)) => dither.encode(&floats, offsets, codes)?,
                None => codec.encode_here(&floats, codes)?,
            }
            manner.null.map_or(Ok(0), |null| null.put(&floats, codes)).map(drop)
        };
        if item == codec.bytes {
            return Ok(encode(codes)?);
        }
        let mut packed = vec![0; codes.len() / item * codec.bytes];
        encode(&mut packed)?;
        codes.fill(0);
        copy_each((&packed, codec.bytes), (codes, item));
        Ok(())
    })
}

/// Decodes little-endian codes in `item` bytes each.
pub fn decode(
    codec: &AnyCodec,
    (codes, item): (&[u8], usize),
    elements: &mut [f32],
    manner: &Manner<'_>,
) -> Result {
    manner.pool.run(elements, PORTION * codec.element.floats(), |index, elements| {
        let codes = codes.chunks(PORTION * item).nth(index).unwrap_or_default();
        let packed = match item == codec.bytes {
            true => Cow::Borrowed(codes),
            false => {
                let mut packed = vec![0; codes.len() / item * codec.bytes];
                copy_each((codes, item), (&mut packed, codec.bytes));
                Cow::Owned(packed)
            }
        };
        match manner.dither(index) {
            Some((dither, offsets)) => dither.decode(&packed, offsets, elements)?,
            None => codec.decode_here(&packed, elements)?,
        }
        Ok(manner.null.map_or(Ok(()), |null| null.clear(&packed, elements))?)
    })
}

/// Copies the first bytes of each value to those of another array, whose values are of another size.
fn copy_each((from, from_size): (&[u8], usize), (to, to_size): (&mut [u8], usize)) {
    let copy = |size, to: &mut [u8]| {
        let pairs = from.chunks_exact(from_size).zip(to.chunks_exact_mut(to_size));
        pairs.for_each(|(from, to)| to[..size].copy_from_slice(&from[..size]));
    };
    // Copies of known size are single instructions.
    match from_size.min(to_size) {
        3 => copy(3, to),
        6 => copy(6, to),
        size => copy(size, to),
    }
}

/// The error of each part of each element.
pub fn error(codec: &AnyCodec, floats: Floats<'_>, errors: &mut [f64], pool: &Pool) -> Result {
    let (width, parts) = (codec.element.floats(), codec.element.directions().len());
    pool.run(errors, PORTION * parts, |index, errors| {
        let floats = floats.portion(codec.element, index);
        let mut codes = vec![0; floats.len() / width * codec.bytes];
        let mut decoded = vec![0.0; floats.len()];
        codec.encode_here(&floats, &mut codes)?;
        codec.decode_here(&codes, &mut decoded)?;
        let elements = floats.chunks_exact(width).zip(decoded.chunks_exact(width));
        for ((original, decoded), errors) in elements.zip(errors.chunks_exact_mut(parts)) {
            for (part, error) in errors.iter_mut().enumerate() {
                let measured = codec.measure().error_of_part(codec.element, part, original, decoded);
                *error = measured.unwrap_or(f64::NAN);
            }
        }
        Ok(())
    })
}
