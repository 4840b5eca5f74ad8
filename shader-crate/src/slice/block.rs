//! A block of vectors and of codes, turned so that the compiler makes vector instructions of the loops over it: an
//! array for each component, and for each word of a code.
//!
//! The loops over whole blocks are compiled apart from those over the last vectors of a slice: where the number is known,
//! they are a fifth faster. No closures here: they are not inlined always, and what is not inlined does not get the
//! instructions of the [`Level`](super::machine::Level).

use super::Vector;
use super::machine::{as_chunks, as_chunks_mut};
use crate::arith::snorm_encode;
use crate::codec::{Code, Codec};
use glam::Vec3;

/// Vectors of a block: enough for the loops to stay loops, few enough for the arrays to stay in the nearest cache.
pub const BLOCK: usize = 64;

/// Vectors that are encoded or decoded at a time: the last block may have fewer. The number is fixed, so that each codec
/// is compiled without a second loop, of single vectors, for the rest.
const GROUP: usize = 32;

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
    pub fn encode<C: Codec>(&mut self, count: usize) {
        let mut start = 0;
        while start < count && start < BLOCK {
            for i in start..start + GROUP {
                let code = C::encode(Vec3::new(self.x[i], self.y[i], self.z[i])).to_words();
                self.low[i] = code[0];
                self.high[i] = code[1];
            }
            start += GROUP;
        }
    }

    /// Decodes the first `count` codes, and some more that do no harm.
    #[inline(always)]
    pub fn decode<C: Codec>(&mut self, count: usize) {
        let mut start = 0;
        while start < count && start < BLOCK {
            for i in start..start + GROUP {
                let v = C::decode(C::Code::from_words([self.low[i], self.high[i]]));
                self.x[i] = v.x;
                self.y[i] = v.y;
                self.z[i] = v.z;
            }
            start += GROUP;
        }
    }

    /// Takes these vectors.
    #[inline(always)]
    pub fn load_vectors(&mut self, vectors: &[impl Vector]) {
        let parts = self.x.iter_mut().zip(&mut self.y).zip(&mut self.z);
        for (((x, y), z), vector) in parts.zip(vectors) {
            [*x, *y, *z] = vector.xyz();
        }
    }

    /// Takes the codes in these bytes.
    #[inline(always)]
    pub fn load_codes<C: Codec>(&mut self, codes: &[u8]) {
        let (low, high) = (self.low.iter_mut(), self.high.iter_mut());
        match C::BYTES {
            1 => {
                for (low, &byte) in low.zip(codes) {
                    *low = u32::from(byte);
                }
            }
            2 => {
                for (low, &bytes) in low.zip(as_chunks(codes).0) {
                    *low = u32::from(u16::from_le_bytes(bytes));
                }
            }
            3 => {
                // Four codes are three words.
                let (groups, rest) = as_chunks::<_, 12>(codes);
                let (low, low_of_rest) = self.low.split_at_mut(4 * groups.len());
                for (low, group) in as_chunks_mut(low).0.iter_mut().zip(groups) {
                    let [a, b, c] = words(group);
                    *low = [
                        a & 0x00ff_ffff,
                        (a >> 24) | ((b & 0xffff) << 8),
                        (b >> 16) | ((c & 0xff) << 16),
                        c >> 8,
                    ];
                }
                for (low, &[a, b, c]) in low_of_rest.iter_mut().zip(as_chunks(rest).0) {
                    *low = u32::from_le_bytes([a, b, c, 0]);
                }
            }
            4 => {
                for (low, &bytes) in low.zip(as_chunks(codes).0) {
                    *low = u32::from_le_bytes(bytes);
                }
            }
            6 => {
                for ((low, high), &[a, b, c, d, e, f]) in low.zip(high).zip(as_chunks(codes).0) {
                    *low = u32::from_le_bytes([a, b, c, d]);
                    *high = u32::from(u16::from_le_bytes([e, f]));
                }
            }
            _ => {
                for ((low, high), &[a, b, c, d, e, f, g, h]) in low.zip(high).zip(as_chunks(codes).0) {
                    *low = u32::from_le_bytes([a, b, c, d]);
                    *high = u32::from_le_bytes([e, f, g, h]);
                }
            }
        }
    }

    /// Fills `codes` with the codes' bytes.
    #[inline(always)]
    pub fn store_codes<C: Codec>(&self, codes: &mut [u8]) {
        let (low, high) = (self.low.iter(), self.high.iter());
        match C::BYTES {
            1 => {
                for (byte, low) in codes.iter_mut().zip(low) {
                    *byte = *low as u8;
                }
            }
            2 => {
                for (bytes, low) in as_chunks_mut(codes).0.iter_mut().zip(low) {
                    *bytes = (*low as u16).to_le_bytes();
                }
            }
            3 => {
                // Four codes are three words.
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
            4 => {
                for (bytes, low) in as_chunks_mut(codes).0.iter_mut().zip(low) {
                    *bytes = low.to_le_bytes();
                }
            }
            6 => {
                for (bytes, (low, high)) in as_chunks_mut(codes).0.iter_mut().zip(low.zip(high)) {
                    let ([a, b, c, d], [e, f, ..]) = (low.to_le_bytes(), high.to_le_bytes());
                    *bytes = [a, b, c, d, e, f];
                }
            }
            _ => {
                for (bytes, (low, high)) in as_chunks_mut(codes).0.iter_mut().zip(low.zip(high)) {
                    *bytes = ((u64::from(*high) << 32) | u64::from(*low)).to_le_bytes();
                }
            }
        }
    }
}

/// What a block decodes to.
pub trait Decoded: Copy {
    /// Fills `to` with the vectors of `block`.
    fn store(block: &Block, to: &mut [Self]);
}

impl<V: Vector> Decoded for V {
    #[inline(always)]
    fn store(block: &Block, to: &mut [Self]) {
        let parts = block.x.iter().zip(&block.y).zip(&block.z);
        for (((x, y), z), vector) in parts.zip(to) {
            *vector = V::from_xyz([*x, *y, *z]);
        }
    }
}

/// As snorm of 16 bits and 0.
impl Decoded for [i16; 4] {
    #[inline(always)]
    fn store(block: &Block, to: &mut [Self]) {
        let parts = block.x.iter().zip(&block.y).zip(&block.z);
        for (((&x, &y), &z), vector) in parts.zip(to) {
            let (x, y, z) = (snorm_encode(x, 16), snorm_encode(y, 16), snorm_encode(z, 16));
            *vector = [x as i16, y as i16, z as i16, 0];
        }
    }
}

/// Three words, little endian.
#[inline(always)]
fn words(&[a, b, c, d, e, f, g, h, i, j, k, l]: &[u8; 12]) -> [u32; 3] {
    [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h]), u32::from_le_bytes([i, j, k, l])]
}
