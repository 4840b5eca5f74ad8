//! A block of elements and of codes, turned so that the compiler makes vector instructions of the loops over it: an
//! array for each float of an element, and for each word of a code.
//!
//! The loops over whole blocks are compiled apart from those over the last elements of a slice: where the number is
//! known, they are a fifth faster. No closures here: they are not inlined always, and functions that are not inlined do
//! not get the instructions of the [`Level`](super::machine::Level). No iterators either: in a build without
//! optimisation they cost more than a codec.

use super::machine::{as_chunks, as_chunks_mut};
use super::stored::{Stored, with_size};
use crate::arith::snorm_code;
use crate::codec::{Codec, RawCode};
use crate::frame::{Frame, FrameCodec};
use crate::quat::RotationCodec;
use core::marker::PhantomData;
use glam::{Vec3, Vec4};

/// Elements of a block: enough for the loops to stay loops, few enough for the arrays to stay in the nearest cache.
pub const BLOCK: usize = 64;

/// Elements that are encoded or decoded at a time: the last block may have fewer. The number is fixed, so that each codec
/// is compiled without a second loop, of single elements, for the rest.
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

/// What encodes and decodes elements of `N` floats: a codec, or a value that stands for a format. Its functions are always
/// inlined.
pub trait Coder<const N: usize>: Copy {
    /// Bytes of a stored code.
    fn bytes(self) -> usize;
    /// The code of an element: the low and the high word.
    fn encode(self, element: [f32; N]) -> [u32; 2];
    /// The element of a code.
    fn decode(self, code: [u32; 2]) -> [f32; N];
}

/// Implements [`Coder`] for a kind of codec.
macro_rules! coder {
    ($codec:ident of $floats:literal floats: $element:ident => $encode:expr, $code:ident => $decode:expr) => {
        impl<C: $codec> Coder<$floats> for PhantomData<C> {
            #[inline(always)]
            fn bytes(self) -> usize {
                C::BYTES
            }

            #[inline(always)]
            fn encode(self, $element: [f32; $floats]) -> [u32; 2] {
                $encode.to_words()
            }

            #[inline(always)]
            fn decode(self, [low, high]: [u32; 2]) -> [f32; $floats] {
                let $code = C::Code::from_low_high(low, high);
                $decode.to_array()
            }
        }
    };
}

coder!(Codec of 3 floats: v => C::encode_vec3(Vec3::from_array(v)), code => C::decode_vec3(code));
coder!(RotationCodec of 4 floats: q => C::encode_vec4(Vec4::from_array(q)), code => C::decode_vec4(code));
coder!(FrameCodec of 7 floats: frame => C::encode(Frame::from_array(frame)), code => C::decode(code));

/// At most [`BLOCK`] elements by floats, and codes by words. Aligned as the longest vectors of a processor.
#[repr(align(64))]
pub struct Block<const N: usize> {
    floats: [[f32; BLOCK]; N],
    low: [u32; BLOCK],
    high: [u32; BLOCK],
}

impl<const N: usize> Block<N> {
    #[inline(always)]
    pub fn new() -> Self {
        Self { floats: [[0.0; BLOCK]; N], low: [0; BLOCK], high: [0; BLOCK] }
    }

    #[inline(always)]
    fn element(&self, i: usize) -> [f32; N] {
        let mut element = [0.0; N];
        let mut k = 0;
        while k < N {
            element[k] = self.floats[k][i];
            k += 1;
        }
        element
    }

    #[inline(always)]
    fn set_element(&mut self, i: usize, element: [f32; N]) {
        let mut k = 0;
        while k < N {
            self.floats[k][i] = element[k];
            k += 1;
        }
    }

    /// Encodes the first `count` elements, and some more that do no harm.
    #[inline(always)]
    pub fn encode(&mut self, coder: impl Coder<N>, count: usize) {
        let mut start = 0;
        while start < count && start < BLOCK {
            each!(i in start, start + GROUP => {
                [self.low[i], self.high[i]] = coder.encode(self.element(i));
            });
            start += GROUP;
        }
    }

    /// Decodes the first `count` codes, and some more that do no harm.
    #[inline(always)]
    pub fn decode(&mut self, coder: impl Coder<N>, count: usize) {
        let mut start = 0;
        while start < count && start < BLOCK {
            each!(i in start, start + GROUP => {
                self.set_element(i, coder.decode([self.low[i], self.high[i]]));
            });
            start += GROUP;
        }
    }

    /// Takes these elements.
    #[inline(always)]
    pub fn load_elements(&mut self, elements: &[impl Copy + Into<[f32; N]>]) {
        each!(i in 0, elements.len() => {
            self.set_element(i, elements[i].into());
        });
    }

    /// Fills `to` with the elements.
    #[inline(always)]
    pub fn store_elements<T: Target<E, N>, E>(&self, to: &mut [E]) {
        each!(i in 0, to.len() => {
            to[i] = T::element(self.element(i));
        });
    }

    /// Takes the codes in these bytes.
    #[inline(always)]
    pub fn load_codes(&mut self, coder: impl Coder<N>, codes: &[u8]) {
        if coder.bytes() == 3 {
            return self.load_codes_of_3(codes);
        }
        with_size!(coder.bytes(), SIZE => self.load_codes_of::<SIZE>(codes));
    }

    /// Fills `codes` with the codes' bytes.
    #[inline(always)]
    pub fn store_codes(&self, coder: impl Coder<N>, codes: &mut [u8]) {
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

/// A type of elements, `E`, that codes are decoded to.
pub trait Target<E, const N: usize> {
    /// The element as this type.
    fn element(floats: [f32; N]) -> E;
}

/// Elements as they are.
pub struct Floats;

impl<E: From<[f32; N]>, const N: usize> Target<E, N> for Floats {
    #[inline(always)]
    fn element(floats: [f32; N]) -> E {
        floats.into()
    }
}

/// Snorm of 16 bits and 0.
pub struct Snorms;

impl Target<[i16; 4], 3> for Snorms {
    #[inline(always)]
    fn element([x, y, z]: [f32; 3]) -> [i16; 4] {
        [snorm_code(x, 16) as i16, snorm_code(y, 16) as i16, snorm_code(z, 16) as i16, 0]
    }
}

/// Three words, little endian.
#[inline(always)]
fn words(&[a, b, c, d, e, f, g, h, i, j, k, l]: &[u8; 12]) -> [u32; 3] {
    [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h]), u32::from_le_bytes([i, j, k, l])]
}
