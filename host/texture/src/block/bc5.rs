//! BC5: two channels, each with two end points of 8 bits and an index of 3 bits for each texel.
//!
//! Source: Khronos Data Format Specification, "RGTC Compressed Texture Image Formats".

use super::{BYTES, TEXELS};

/// The end points that stand for -1 and 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub least: i32,
    most: i32,
}

pub(super) const UNORM: Range = Range { least: 0, most: 255 };
/// -128 reads as -127. It is never written: whether it compares as one or the other is left to the decoder.
pub(super) const SNORM: Range = Range { least: -127, most: 127 };

impl Range {
    pub fn clamp(self, end: i32) -> i32 {
        end.clamp(self.least, self.most)
    }

    /// The end point nearest to a coordinate.
    pub fn nearest(self, coordinate: f64) -> i32 {
        let part = (coordinate + 1.0) / 2.0;
        self.clamp(self.least + (part * f64::from(self.most - self.least)).round() as i32)
    }

    fn read(self, byte: u8) -> i32 {
        self.clamp(if self.least < 0 { i32::from(byte as i8) } else { i32::from(byte) })
    }

    /// The coordinates that a channel's 8 indices stand for: the end points, and 6 values between them where the first is the
    /// greater, else 4, -1 and 1. The quotients are exact; hardware may interpolate in fewer bits.
    pub fn palette(self, ends: [i32; 2]) -> [f64; 8] {
        let [a, b] = ends.map(|end| 2 * end - self.least - self.most);
        let (parts, most) = (if a > b { 7 } else { 5 }, self.most - self.least);
        let end = |a| f64::from(a) / f64::from(most);
        let mut palette = [end(a), end(b), 0.0, 0.0, 0.0, 0.0, -1.0, 1.0];
        for of_b in 1..parts {
            palette[1 + of_b as usize] = f64::from(a * (parts - of_b) + b * of_b) / f64::from(parts * most);
        }
        palette
    }
}

/// The end points of both channels, and their indices texel by texel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub ends: [[i32; 2]; 2],
    pub indices: [[u8; TEXELS]; 2],
}

impl Block {
    pub fn read(bytes: [u8; BYTES], range: Range) -> Self {
        let bits = u128::from_le_bytes(bytes);
        let byte = |at: usize| range.read((bits >> (8 * at)) as u8);
        let indices = |first: usize| std::array::from_fn(|texel| (bits >> (first + 3 * texel)) as u8 & 7);
        Self { ends: [[byte(0), byte(1)], [byte(8), byte(9)]], indices: [indices(16), indices(80)] }
    }

    pub fn bytes(&self) -> [u8; BYTES] {
        let [low, high] = [0, 1].map(|channel| {
            // The low byte of two's complement.
            let [a, b] = self.ends[channel].map(|end| u128::from(end as u8));
            self.indices[channel].iter().rev().fold(0, |bits, index| bits << 3 | u128::from(*index)) << 16
                | b << 8
                | a
        });
        (high << 64 | low).to_le_bytes()
    }

    /// The coordinates of each texel.
    pub fn points(&self, range: Range) -> [[f64; 2]; TEXELS] {
        let palettes = self.ends.map(|ends| range.palette(ends));
        std::array::from_fn(|texel| {
            [0, 1].map(|channel| palettes[channel][usize::from(self.indices[channel][texel])])
        })
    }
}
