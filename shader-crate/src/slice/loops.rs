//! The loops over slices: block by block, with what memory asks for.

use super::block::{BLOCK, Block, Coder, Target};
use super::machine::{Level, Stream, Task, as_chunks, as_chunks_mut, prefetch};
use super::stored::{Stored, with_size};
use super::strided::LARGEST_CODE;
use core::marker::PhantomData;

/// True where elements go one by one: without optimisation, and on AArch64 those in up to 4 bytes but rotations, since there
/// LLVM makes vector instructions of that loop too. Not with a coder that has fields, of which each size would be a loop.
#[inline(always)]
fn one_by_one<const N: usize, K>(bytes: usize) -> bool {
    cfg!(unoptimised) || cfg!(target_arch = "aarch64") && size_of::<K>() == 0 && N != 4 && bytes <= 4
}

/// Bytes of vectors from which on memory is prefetched: a slice of this size does not stay in the caches nearest to the
/// core. The processor's own prefetching ends with each page, and counts for little where memory is written.
const FAR: usize = 1 << 20;

/// The number of blocks to prefetch ahead.
pub const AHEAD: usize = 2;

/// The number of places where a far slice is worked on in turn. The processor prefetches for each, so that more memory is
/// under way than with one. Three are faster than two and four.
const PLACES: usize = 3;

/// The order in which the blocks of a slice are worked through.
#[derive(Clone, Copy)]
pub struct Order {
    blocks: usize,
    /// Blocks of each place.
    part: usize,
    /// Steps to prefetch ahead.
    ahead: usize,
}

impl Order {
    #[inline(always)]
    pub fn new(blocks: usize, far: bool) -> Self {
        if far {
            Self { blocks, part: blocks / PLACES, ahead: AHEAD * PLACES }
        } else {
            Self { blocks, part: 0, ahead: blocks }
        }
    }

    /// The block of this step.
    #[inline(always)]
    pub fn block(self, step: usize) -> usize {
        if step < PLACES * self.part { step % PLACES * self.part + step / PLACES } else { step }
    }

    /// The block to prefetch in this step.
    #[inline(always)]
    pub fn next(self, step: usize) -> Option<usize> {
        if step + self.ahead < self.blocks { Some(self.block(step + self.ahead)) } else { None }
    }
}

/// True where a slice of vectors of this size should be prefetched. WebAssembly has no such instruction, and the bytes of its
/// modules count.
#[inline(always)]
pub fn is_far<T>(vectors: &[T]) -> bool {
    cfg!(not(target_family = "wasm")) && size_of_val(vectors) >= FAR
}

/// The loop that encodes a slice.
pub struct Encode<'a, const N: usize, K, E> {
    pub elements: &'a [E],
    pub codes: &'a mut [u8],
    pub coder: K,
}

// Whole blocks and the rest go through one loop, so that each codec is compiled once.
impl<const N: usize, K: Coder<N>, E: Copy + Into<[f32; N]>> Task for Encode<'_, N, K, E> {
    #[inline(always)]
    fn run(self, level: Level) {
        let (coder, bytes) = (self.coder, self.coder.bytes());
        if one_by_one::<N, K>(bytes) {
            return with_size!(bytes, SIZE => encode_each::<N, SIZE>(coder, self.elements, self.codes));
        }
        let size = BLOCK * bytes;
        let (blocks, rest) = as_chunks::<_, BLOCK>(self.elements);
        let (codes, codes_of_rest) = self.codes.split_at_mut(blocks.len() * size);
        let order = Order::new(blocks.len(), is_far(self.elements));
        let mut stream = Stream::<u8, { BLOCK * LARGEST_CODE }>::to(level, codes);
        let mut block = Block::<N>::new();
        for step in 0..blocks.len() + usize::from(!rest.is_empty()) {
            let i = order.block(step);
            let whole = i < blocks.len();
            if let Some(next) = order.next(step) {
                prefetch(&blocks[next]);
            }
            if whole {
                block.load_elements(&blocks[i])
            } else {
                block.load_elements(rest)
            }
            block.encode(coder, if whole { BLOCK } else { rest.len() });
            if !whole {
                block.store_codes(coder, codes_of_rest);
                continue;
            }
            let to = &mut codes[i * size..][..size];
            let place = match &mut stream {
                Some(stream) => &mut stream.lines[..size],
                None => &mut *to,
            };
            // One call for both places, so that it is compiled once.
            block.store_codes(coder, place);
            if let Some(stream) = &stream {
                stream.store(to);
            }
        }
    }
}

/// The loop that decodes a slice.
pub struct Decode<'a, const N: usize, K, T, E> {
    pub codes: &'a [u8],
    pub elements: &'a mut [E],
    pub coder: K,
    pub target: PhantomData<T>,
}

impl<const N: usize, K: Coder<N>, T: Target<E, N>, E: Copy> Task for Decode<'_, N, K, T, E> {
    #[inline(always)]
    fn run(self, level: Level) {
        let (coder, bytes) = (self.coder, self.coder.bytes());
        if one_by_one::<N, K>(bytes) {
            return with_size!(bytes, SIZE => decode_each::<N, T, E, SIZE>(coder, self.codes, self.elements));
        }
        let (size, far) = (BLOCK * bytes, is_far(self.elements));
        let mut stream = Stream::<E, BLOCK>::to(level, self.elements);
        let (blocks, rest) = as_chunks_mut::<_, BLOCK>(self.elements);
        let (codes, codes_of_rest) = self.codes.split_at(blocks.len() * size);
        let order = Order::new(blocks.len(), far);
        let mut block = Block::<N>::new();
        for step in 0..blocks.len() + usize::from(!rest.is_empty()) {
            let i = order.block(step);
            let whole = i < blocks.len();
            match order.next(step) {
                Some(next) if stream.is_none() => prefetch(&blocks[next]),
                Some(next) => prefetch(&codes[next * size..][..size]),
                None => {}
            }
            if bytes == 2 {
                // With a compile-time length LLVM turns two-byte loads into scalar ones, so this hides the length.
                let start = i * size;
                block.load_codes(coder, &self.codes[start..self.codes.len().min(start + size)]);
            } else if whole {
                block.load_codes(coder, &codes[i * size..][..size]);
            } else {
                block.load_codes(coder, codes_of_rest);
            }
            block.decode(coder, if whole { BLOCK } else { rest.len() });
            if !whole {
                block.store_elements::<T, E>(rest);
                continue;
            }
            let to = &mut blocks[i];
            let place = match &mut stream {
                Some(stream) => &mut stream.lines,
                None => &mut *to,
            };
            block.store_elements::<T, E>(place);
            if let Some(stream) = &stream {
                stream.store(to);
            }
        }
    }
}

/// Encodes one element at a time. Without iterators, which cost more than a codec where they are not optimised.
fn encode_each<const N: usize, const SIZE: usize>(
    coder: impl Coder<N>,
    elements: &[impl Copy + Into<[f32; N]>],
    codes: &mut [u8],
) where
    [u8; SIZE]: Stored,
{
    let codes = as_chunks_mut::<_, SIZE>(codes).0;
    let mut i = 0;
    while i < elements.len() {
        codes[i] = Stored::of_words(coder.encode(elements[i].into()));
        i += 1;
    }
}

/// Decodes one code at a time.
fn decode_each<const N: usize, T: Target<E, N>, E, const SIZE: usize>(
    coder: impl Coder<N>,
    codes: &[u8],
    elements: &mut [E],
) where
    [u8; SIZE]: Stored,
{
    let codes = as_chunks::<_, SIZE>(codes).0;
    let mut i = 0;
    while i < elements.len() {
        let (low, high) = codes[i].words();
        elements[i] = T::element(coder.decode([low, high]));
        i += 1;
    }
}
