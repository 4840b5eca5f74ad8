//! Compressed blocks of 4 by 4 texels: BC5 by angle, and BC7.
//!
//! The crate `block_compression`, after Intel's ISPC Texture Compressor, makes BC7 and the first blocks of BC5. It lowers the
//! errors of bytes, of each channel by itself. [`compress`] chooses the end points and indices of BC5 anew, by the angles
//! between directions, for both channels together.

mod bc5;
mod search;
#[cfg(test)]
mod tests;

use crate::Pair;
use bc5::{Block, Range, SNORM, UNORM};
use block_compression::decode::decode_block_bc7;
use block_compression::encode::compress_rgba8;
use block_compression::{BC7Settings, CompressionVariant};
use rayon::prelude::*;

/// Texels along a block's side.
const SIDE: u64 = 4;
/// Texels of a block.
const TEXELS: usize = 16;
/// Bytes of a block.
const BYTES: usize = 16;

/// A format of compressed blocks, 8 bits a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compression {
    /// `VK_FORMAT_BC5_UNORM_BLOCK`: 0 stands for -1.
    Bc5Unorm,
    /// `VK_FORMAT_BC5_SNORM_BLOCK`: 0 is exact.
    Bc5Snorm,
    /// `VK_FORMAT_BC7_UNORM_BLOCK`: red and green are as in [`Self::Bc5Unorm`], blue is 0 and alpha 1.
    Bc7,
}

impl Compression {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Bc5Unorm, Self::Bc5Snorm, Self::Bc7];

    /// Vulkan's name of the format, after `VK_FORMAT_`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bc5Unorm => "BC5_UNORM_BLOCK",
            Self::Bc5Snorm => "BC5_SNORM_BLOCK",
            Self::Bc7 => "BC7_UNORM_BLOCK",
        }
    }

    /// The end points of a channel.
    fn range(self) -> Range {
        match self {
            Self::Bc5Snorm => SNORM,
            Self::Bc5Unorm | Self::Bc7 => UNORM,
        }
    }
}

/// The blocks of a map, row by row from the top, 16 bytes each. Blocks beyond the right and lower edge repeat its texels.
///
/// `vectors` are as many directions of any length as `width * height`; what [`Pair::point`] says of others holds, and missing
/// ones count as +Z.
#[must_use]
pub fn compress(
    vectors: &[[f32; 3]],
    width: u32,
    height: u32,
    pair: Pair,
    compression: Compression,
) -> Vec<u8> {
    let range = compression.range();
    encode(vectors, width, height, |texels| match compression {
        Compression::Bc5Unorm | Compression::Bc5Snorm => {
            search::best(texels, pair, range, bc5_by_channel(texels, pair, range)).bytes()
        }
        Compression::Bc7 => {
            bytewise(texels, pair, range, CompressionVariant::BC7(BC7Settings::opaque_basic()))
        }
    })
}

/// [`compress`] by the crate `block_compression` alone, which knows no angles: what BC5 is compared with. BC7 is the same.
#[must_use]
pub fn compress_by_channel(
    vectors: &[[f32; 3]],
    width: u32,
    height: u32,
    pair: Pair,
    compression: Compression,
) -> Vec<u8> {
    match compression {
        Compression::Bc5Unorm | Compression::Bc5Snorm => {
            encode(vectors, width, height, |texels| bc5_by_channel(texels, pair, compression.range()).bytes())
        }
        Compression::Bc7 => compress(vectors, width, height, pair, compression),
    }
}

/// Each block of a map by `block`; rows of blocks in parallel.
fn encode(
    vectors: &[[f32; 3]],
    width: u32,
    height: u32,
    block: impl Fn(&[[f32; 3]; TEXELS]) -> [u8; BYTES] + Sync,
) -> Vec<u8> {
    let [width, height] = [width, height].map(u64::from);
    let texel = |x: u64, y: u64| {
        let at = y.min(height - 1) * width + x.min(width - 1);
        vectors.get(at as usize).copied().unwrap_or([0.0, 0.0, 1.0])
    };
    let (texel, block) = (&texel, &block);
    let row = |row: u64| {
        (0..width.div_ceil(SIDE)).flat_map(move |column| {
            let of_block = |at: u64| texel(SIDE * column + at % SIDE, SIDE * row + at / SIDE);
            block(&std::array::from_fn(|at| of_block(at as u64)))
        })
    };
    (0..height.div_ceil(SIDE)).into_par_iter().flat_map_iter(row).collect()
}

/// A block of bytes by `block_compression`: the points in red and green, counted from the least end point.
fn bytewise(
    texels: &[[f32; 3]; TEXELS],
    pair: Pair,
    range: Range,
    variant: CompressionVariant,
) -> [u8; BYTES] {
    let rgba = texels.map(|texel| {
        let [red, green] =
            pair.point(texel).map(|coordinate| (range.nearest(coordinate) - range.least) as u8);
        // The other pair of channels, colour and alpha, gave greater errors in BC7.
        [red, green, 0, 255]
    });
    let (mut block, side) = ([0; BYTES], SIDE as u32);
    compress_rgba8(variant, rgba.as_flattened(), &mut block, side, side, 4 * side);
    block
}

/// A block of BC5 by `block_compression`. It knows UNORM only; its end points are moved.
fn bc5_by_channel(texels: &[[f32; 3]; TEXELS], pair: Pair, range: Range) -> Block {
    let block = Block::read(bytewise(texels, pair, range, CompressionVariant::BC5), UNORM);
    Block { ends: block.ends.map(|ends| ends.map(|end| range.clamp(end + range.least))), ..block }
}

/// The unit vectors of a map's blocks, row by row from the top. `None` unless `bytes` are as many as the size asks for.
#[must_use]
pub fn decompress(
    bytes: &[u8],
    width: u32,
    height: u32,
    pair: Pair,
    compression: Compression,
) -> Option<Vec<[f32; 3]>> {
    let [width, height] = [width, height].map(u64::from);
    let columns = width.div_ceil(SIDE);
    let expected = u128::from(columns * height.div_ceil(SIDE)) * BYTES as u128;
    if bytes.len() as u128 != expected {
        return None;
    }
    let vector = |point| pair.vector(point).map(|t| t as f32);
    let blocks = bytes.par_chunks_exact(BYTES).map(|block| points(block, compression).map(vector));
    let decoded: Vec<[[f32; 3]; TEXELS]> = blocks.collect();
    let texel = |at: u64| {
        let (x, y) = (at % width, at / width);
        decoded[(y / SIDE * columns + x / SIDE) as usize][(y % SIDE * SIDE + x % SIDE) as usize]
    };
    Some((0..width * height).map(texel).collect())
}

/// The points of a block's texels.
fn points(block: &[u8], compression: Compression) -> [[f64; 2]; TEXELS] {
    let range = compression.range();
    match compression {
        Compression::Bc5Unorm | Compression::Bc5Snorm => {
            let mut bytes = [0; BYTES];
            bytes.copy_from_slice(block);
            Block::read(bytes, range).points(range)
        }
        Compression::Bc7 => {
            let mut rgba = [[0; 4]; TEXELS];
            decode_block_bc7(block, rgba.as_flattened_mut(), 4 * SIDE as usize);
            rgba.map(|[red, green, ..]| [red, green].map(|byte| (2.0 * f64::from(byte) - 255.0) / 255.0))
        }
    }
}
