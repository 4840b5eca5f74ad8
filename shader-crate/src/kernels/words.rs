//! Groups of four vectors, rotations, frames or codes as whole words, and how a kernel reads and writes them.

use super::CodeWords;
use crate::frame::Frame;
use glam::{Vec3, Vec4};
use spirv_std::arch::IndexUnchecked;

/// Elements and codes of a group: four of any width fill whole words.
pub const GROUP: usize = 4;

/// Words that hold a group.
pub trait Words: Copy {
    /// The number of these words, which is also the bytes of one of the four.
    const LEN: usize;

    /// The words of group `index` of a buffer. The last group may hold only `count` of the four; some of its words
    /// stand in for those that it lacks.
    ///
    /// # Safety
    /// The buffer holds `count` elements, at least one, of the group.
    #[allow(unsafe_code)]
    unsafe fn load(buffer: &[u32], index: usize, count: usize) -> Self;

    /// Writes the words of group `index`, or of the last group those that `count` of the four fill; the rest of the
    /// last word is 0.
    ///
    /// # Safety
    /// The requirement of [`load`](Self::load).
    #[allow(unsafe_code)]
    unsafe fn store(self, buffer: &mut [u32], index: usize, count: usize);
}

/// The first `bytes` bytes of a word, the others 0.
#[inline(always)]
fn low_bytes(word: u32, bytes: usize) -> u32 {
    if bytes < 4 { word & ((1 << (8 * bytes)) - 1) } else { word }
}

/// Implements [`Words`] for arrays of each length; its indices are literals, since SPIR-V has no loop over an array that
/// stays in registers.
macro_rules! words {
    ($($len:literal: $($n:literal)*;)*) => { $(
        impl Words for [u32; $len] {
            const LEN: usize = $len;

            #[inline(always)]
            #[allow(unsafe_code)]
            unsafe fn load(buffer: &[u32], index: usize, count: usize) -> Self {
                let first = index * $len;
                if count >= GROUP {
                    // SAFETY: the buffer holds the whole group.
                    unsafe { [$(*buffer.index_unchecked(first + $n)),*] }
                } else if $len % 4 == 0 {
                    // Each of the four has whole words. The last one's words stand in for missing ones.
                    let last = count - 1;
                    // SAFETY: the buffer holds the words of the group's first `count`, at least one.
                    unsafe {
                        [$({
                            let of = 4 * $n / $len;
                            let held = if of < last { of } else { last };
                            *buffer.index_unchecked(first + $len / 4 * held + ($n - $len / 4 * of))
                        }),*]
                    }
                } else {
                    let last = (count * $len - 1) / 4;
                    // SAFETY: the buffer holds the group's words up to `last`.
                    unsafe { [$(*buffer.index_unchecked(first + if $n < last { $n } else { last })),*] }
                }
            }

            #[inline(always)]
            #[allow(unsafe_code)]
            unsafe fn store(self, buffer: &mut [u32], index: usize, count: usize) {
                let first = index * $len;
                if count >= GROUP {
                    // SAFETY: the buffer holds the whole group.
                    unsafe { $(*buffer.index_unchecked_mut(first + $n) = self[$n];)* }
                } else if $len % 4 == 0 {
                    // Each of the four has whole words: these have no more than three conditions.
                    // SAFETY: the buffer holds the words of the group's first `count`.
                    unsafe {
                        $(if 4 * $n / $len < count {
                            *buffer.index_unchecked_mut(first + $n) = self[$n];
                        })*
                    }
                } else {
                    let bytes = count * $len;
                    // SAFETY: the buffer holds the words of the group's first `bytes` bytes.
                    unsafe {
                        $(if 4 * $n < bytes {
                            *buffer.index_unchecked_mut(first + $n) = low_bytes(self[$n], bytes - 4 * $n);
                        })*
                    }
                }
            }
        }
    )* };
}

words! {
    1: 0;
    2: 0 1;
    3: 0 1 2;
    4: 0 1 2 3;
    6: 0 1 2 3 4 5;
    8: 0 1 2 3 4 5 6 7;
    12: 0 1 2 3 4 5 6 7 8 9 10 11;
    16: 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15;
    28: 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27;
}

/// An element to encode, as words of f32 bits.
pub trait Element: Sized {
    /// The words of four.
    type Four: Words;

    /// The four of these words.
    fn unpack(words: Self::Four) -> [Self; GROUP];

    /// The words of these four.
    fn pack(elements: [Self; GROUP]) -> Self::Four;
}

impl Element for Vec3 {
    type Four = [u32; 12];

    #[inline(always)]
    fn unpack(words: Self::Four) -> [Self; GROUP] {
        let at = |n: usize| vector(words[n], words[n + 1], words[n + 2]);
        [at(0), at(3), at(6), at(9)]
    }

    #[inline(always)]
    fn pack([a, b, c, d]: [Self; GROUP]) -> Self::Four {
        let ([p, q, r], [s, t, u]) = (bits(a), bits(b));
        let ([v, w, x], [y, z, last]) = (bits(c), bits(d));
        [p, q, r, s, t, u, v, w, x, y, z, last]
    }
}

impl Element for Vec4 {
    type Four = [u32; 16];

    #[inline(always)]
    fn unpack(words: Self::Four) -> [Self; GROUP] {
        let at = |n: usize| vector(words[n], words[n + 1], words[n + 2]).extend(f32::from_bits(words[n + 3]));
        [at(0), at(4), at(8), at(12)]
    }

    #[inline(always)]
    fn pack([a, b, c, d]: [Self; GROUP]) -> Self::Four {
        let bits = |q: Self| [q.x.to_bits(), q.y.to_bits(), q.z.to_bits(), q.w.to_bits()];
        let ([e, f, g, h], [i, j, k, l]) = (bits(a), bits(b));
        let ([m, n, o, p], [q, r, s, t]) = (bits(c), bits(d));
        [e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t]
    }
}

impl Element for Frame {
    type Four = [u32; 28];

    #[inline(always)]
    fn unpack(words: Self::Four) -> [Self; GROUP] {
        let at = |n: usize| Frame {
            normal: vector(words[n], words[n + 1], words[n + 2]),
            tangent: vector(words[n + 3], words[n + 4], words[n + 5]),
            handedness: f32::from_bits(words[n + 6]),
        };
        [at(0), at(7), at(14), at(21)]
    }

    #[inline(always)]
    fn pack(frames: [Self; GROUP]) -> Self::Four {
        let mut words = [0; 28];
        set_frame(&mut words, 0, frames[0]);
        set_frame(&mut words, 7, frames[1]);
        set_frame(&mut words, 14, frames[2]);
        set_frame(&mut words, 21, frames[3]);
        words
    }
}

#[inline(always)]
fn vector(x: u32, y: u32, z: u32) -> Vec3 {
    Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z))
}

#[inline(always)]
fn bits(v: Vec3) -> [u32; 3] {
    [v.x.to_bits(), v.y.to_bits(), v.z.to_bits()]
}

/// Normal, tangent, handedness.
#[inline(always)]
fn set_frame(words: &mut [u32; 28], first: usize, frame: Frame) {
    let ([nx, ny, nz], [tx, ty, tz]) = (bits(frame.normal), bits(frame.tangent));
    words[first] = nx;
    words[first + 1] = ny;
    words[first + 2] = nz;
    words[first + 3] = tx;
    words[first + 4] = ty;
    words[first + 5] = tz;
    words[first + 6] = frame.handedness.to_bits();
}

/// The words that four codes fill.
pub trait Codes: Words {
    /// The words of these codes.
    fn pack(codes: [CodeWords; GROUP]) -> Self;

    /// The codes of these words; bits above a code's may be those of the next.
    fn unpack(self) -> [CodeWords; GROUP];
}

impl Codes for [u32; 1] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; GROUP]) -> Self {
        [a | (b << 8) | (c << 16) | (d << 24)]
    }

    #[inline(always)]
    fn unpack(self) -> [CodeWords; GROUP] {
        let [a] = self;
        [[a, 0], [a >> 8, 0], [a >> 16, 0], [a >> 24, 0]]
    }
}

impl Codes for [u32; 2] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; GROUP]) -> Self {
        [a | (b << 16), c | (d << 16)]
    }

    #[inline(always)]
    fn unpack(self) -> [CodeWords; GROUP] {
        let [a, c] = self;
        [[a, 0], [a >> 16, 0], [c, 0], [c >> 16, 0]]
    }
}

impl Codes for [u32; 3] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; GROUP]) -> Self {
        [a | (b << 24), (b >> 8) | (c << 16), (c >> 16) | (d << 8)]
    }

    #[inline(always)]
    fn unpack(self) -> [CodeWords; GROUP] {
        let [u, v, w] = self;
        [[u, 0], [(u >> 24) | (v << 8), 0], [(v >> 16) | (w << 16), 0], [w >> 8, 0]]
    }
}

impl Codes for [u32; 4] {
    #[inline(always)]
    fn pack([[a, _], [b, _], [c, _], [d, _]]: [CodeWords; GROUP]) -> Self {
        [a, b, c, d]
    }

    #[inline(always)]
    fn unpack(self) -> [CodeWords; GROUP] {
        let [a, b, c, d] = self;
        [[a, 0], [b, 0], [c, 0], [d, 0]]
    }
}

impl Codes for [u32; 6] {
    #[inline(always)]
    fn pack([[a, a_high], [b, b_high], [c, c_high], [d, d_high]]: [CodeWords; GROUP]) -> Self {
        let pack_two =
            |low, low_high, high, high_high| [low, low_high | (high << 16), (high >> 16) | (high_high << 16)];
        let ([t, u, v], [w, x, y]) = (pack_two(a, a_high, b, b_high), pack_two(c, c_high, d, d_high));
        [t, u, v, w, x, y]
    }

    #[inline(always)]
    fn unpack(self) -> [CodeWords; GROUP] {
        let [t, u, v, w, x, y] = self;
        [[t, u & 0xffff], [(u >> 16) | (v << 16), v >> 16], [w, x & 0xffff], [(x >> 16) | (y << 16), y >> 16]]
    }
}

impl Codes for [u32; 8] {
    #[inline(always)]
    fn pack([[a, a_high], [b, b_high], [c, c_high], [d, d_high]]: [CodeWords; GROUP]) -> Self {
        [a, a_high, b, b_high, c, c_high, d, d_high]
    }

    #[inline(always)]
    fn unpack(self) -> [CodeWords; GROUP] {
        let [a, a_high, b, b_high, c, c_high, d, d_high] = self;
        [[a, a_high], [b, b_high], [c, c_high], [d, d_high]]
    }
}
