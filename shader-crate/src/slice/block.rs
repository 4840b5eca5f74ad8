//! A block of vectors and of codes, turned so that the compiler makes vector instructions of the loops over it: an
//! array for each component, and for each word of a code.
//!
//! The loops over whole blocks are compiled apart from those over the last vectors of a slice: where the number is
//! known, they are a fifth faster. No closures here: they are not inlined always, and functions that are not inlined do
//! not get the instructions of the [`Level`](super::machine::Level). No iterators either: in a build without
//! optimisation they cost more than a codec.

use super::Vector;
use super::machine::{as_chunks, as_chunks_mut};
use super::stored::{Stored, with_size};
use crate::arith::snorm_code;
use crate::codec::{Codec, RawCode};
use core::marker::PhantomData;
use glam::Vec3;

/// Vectors of a block: enough for the loops to stay loops, few enough for the arrays to stay in the nearest cache.
pub const BLOCK: usize = 64;

/// Vectors that are encoded or decoded at a time: the last block may have fewer. The number is fixed, so that each codec
/// is compiled without a second loop, of single vectors, for the rest.
const GROUP: usize = 32;

/// Does this for each index below `$end`, of at most [`BLOCK`].
macro_rules! each {
    ($i:ident in $start:expr, $end:expr => $body:block) => {
        let mut $i = $start;
        while $i < $end && $i < BLOCK {
            $body
            $i += 1;
        }
    };
}

/// What encodes and decodes: a codec, or a value that stands for a format. Its functions are always inlined.
pub trait Coder: Copy {
    /// Bytes of a stored code.
    fn bytes(self) -> usize;
    /// The code of a vector: the low and the high word.
    fn encode(self, v: Vec3) -> [u32; 2];
    /// The vector of a code.
    fn decode(self, low: u32, high: u32) -> Vec3;
}

impl<C: Codec> Coder for PhantomData<C> {
    #[inline(always)]
    fn bytes(self) -> usize {
        C::BYTES
    }

    #[inline(always)]
    fn encode(self, v: Vec3) -> [u32; 2] {
        C::encode_vec3(v).to_words()
    }

    #[inline(always)]
    fn decode(self, low: u32, high: u32) -> Vec3 {
        C::decode_vec3(C::Code::from_low_high(low, high))
    }
}

/// At most [`BLOCK`] vectors by components, and codes by words.
pub struct Block {
    x: [f32; BLOCK],
    y: [f32; BLOCK],
    z: [f32; BLOCK],
    low: [u32; BLOCK],
    high: [u32; BLOCK],
}

impl Block {
    #[inline(always)]
    pub fn new() -> Self {
        Self { x: [0.0; BLOCK], y: [0.0; BLOCK], z: [0.0; BLOCK], low: [0; BLOCK], high: [0; BLOCK] }
    }

    /// Encodes the first `count` vectors, and some more that do no harm.
    #[inline(always)]
    pub fn encode(&mut self, coder: impl Coder, count: usize) {
        let mut start = 0;
        while start < count && start < BLOCK {
            each!(i in start, start + GROUP => {
                let code = coder.encode(Vec3::new(self.x[i], self.y[i], self.z[i]));
                self.low[i] = code[0];
                self.high[i] = code[1];
            });
            start += GROUP;
        }
    }

    /// Decodes the first `count` codes, and some more that do no harm.
    #[inline(always)]
    pub fn decode(&mut self, coder: impl Coder, count: usize) {
        let mut start = 0;
        while start < count && start < BLOCK {
            each!(i in start, start + GROUP => {
                let v = coder.decode(self.low[i], self.high[i]);
                self.x[i] = v.x;
                self.y[i] = v.y;
                self.z[i] = v.z;
            });
            start += GROUP;
        }
    }

    /// Takes these vectors.
    #[inline(always)]
    pub fn load_vectors(&mut self, vectors: &[impl Vector]) {
        each!(i in 0, vectors.len() => {
            [self.x[i], self.y[i], self.z[i]] = vectors[i].into();
        });
    }

    /// Fills `to` with the vectors.
    #[inline(always)]
    pub fn store_vectors<T: Target<V>, V>(&self, to: &mut [V]) {
        each!(i in 0, to.len() => {
            to[i] = T::vector(Vec3::new(self.x[i], self.y[i], self.z[i]));
        });
    }

    /// Takes the codes in these bytes.
    #[inline(always)]
    pub fn load_codes(&mut self, coder: impl Coder, codes: &[u8]) {
        if coder.bytes() == 3 {
            return self.load_codes_of_3(codes);
        }
        with_size!(coder.bytes(), SIZE => self.load_codes_of::<SIZE>(codes));
    }

    /// Fills `codes` with the codes' bytes.
    #[inline(always)]
    pub fn store_codes(&self, coder: impl Coder, codes: &mut [u8]) {
        if coder.bytes() == 3 {
            return self.store_codes_of_3(codes);
        }
        with_size!(coder.bytes(), SIZE => self.store_codes_of::<SIZE>(codes));
    }

    #[inline(always)]
    fn load_codes_of<const SIZE: usize>(&mut self, codes: &[u8])
    where
        [u8; SIZE]: Stored,
    {
        let codes = as_chunks::<_, SIZE>(codes).0;
        each!(i in 0, codes.len() => {
            let (low, high) = codes[i].words();
            self.low[i] = low;
            if SIZE > 4 {
                self.high[i] = high;
            }
        });
    }

    #[inline(always)]
    fn store_codes_of<const SIZE: usize>(&self, codes: &mut [u8])
    where
        [u8; SIZE]: Stored,
    {
        let codes = as_chunks_mut::<_, SIZE>(codes).0;
        each!(i in 0, codes.len() => {
            codes[i] = Stored::of_words([self.low[i], self.high[i]]);
        });
    }

    /// Four codes are three words.
    #[inline(always)]
    fn load_codes_of_3(&mut self, codes: &[u8]) {
        let (groups, rest) = as_chunks::<_, 12>(codes);
        let (low, low_of_rest) = self.low.split_at_mut(4 * groups.len());
        for (low, group) in as_chunks_mut(low).0.iter_mut().zip(groups) {
            let [a, b, c] = words(group);
            *low = [a & 0x00ff_ffff, (a >> 24) | ((b & 0xffff) << 8), (b >> 16) | ((c & 0xff) << 16), c >> 8];
        }
        for (low, &[a, b, c]) in low_of_rest.iter_mut().zip(as_chunks(rest).0) {
            *low = u32::from_le_bytes([a, b, c, 0]);
        }
    }

    #[inline(always)]
    fn store_codes_of_3(&self, codes: &mut [u8]) {
        let (groups, rest) = as_chunks_mut::<_, 12>(codes);
        let (low, low_of_rest) = self.low.split_at(4 * groups.len());
        for (group, &[a, b, c, d]) in groups.iter_mut().zip(as_chunks(low).0) {
            let words = [a | (b << 24), (b >> 8) | (c << 16), (c >> 16) | (d << 8)];
            for (bytes, word) in as_chunks_mut(group).0.iter_mut().zip(words) {
                *bytes = word.to_le_bytes();
            }
        }
        for (bytes, low) in as_chunks_mut(rest).0.iter_mut().zip(low_of_rest) {
            let [a, b, c, _] = low.to_le_bytes();
            *bytes = [a, b, c];
        }
    }
}

/// A type of vectors, `V`, that codes are decoded to.
pub trait Target<V> {
    /// The vector as this type.
    fn vector(v: Vec3) -> V;
}

/// Vectors as they are.
pub struct Floats;

impl<V: Vector> Target<V> for Floats {
    #[inline(always)]
    fn vector(v: Vec3) -> V {
        v.to_array().into()
    }
}

/// Snorm of 16 bits and 0.
pub struct Snorms;

impl Target<[i16; 4]> for Snorms {
    #[inline(always)]
    fn vector(v: Vec3) -> [i16; 4] {
        [snorm_code(v.x, 16) as i16, snorm_code(v.y, 16) as i16, snorm_code(v.z, 16) as i16, 0]
    }
}

/// Three words, little endian.
#[inline(always)]
fn words(&[a, b, c, d, e, f, g, h, i, j, k, l]: &[u8; 12]) -> [u32; 3] {
    [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h]), u32::from_le_bytes([i, j, k, l])]
}
