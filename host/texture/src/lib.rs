//! Normal maps: directions texel by texel, what two channels of a texture hold of them, and compressed blocks.

#![deny(unsafe_code)]

pub mod block;
mod pair;

pub use pair::Pair;

/// A map of directions.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalMap {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// A unit vector for each texel, row by row from the top.
    pub vectors: Vec<[f32; 3]>,
    /// What the image's fourth channel holds, in 0 to 1, in the same order.
    pub alpha: Option<Vec<f32>>,
}
