//! Normal maps: image files, formats of texels, mips, and compressed blocks.

#![deny(unsafe_code)]

pub mod block;
pub mod coding;
pub mod dds;
mod error;
pub mod format;
pub mod ktx2;
pub mod mips;
mod pair;
pub mod picture;
mod read;
pub mod space;

pub use coding::Coding;
pub use error::{Error, Result};
pub use format::Format;
pub use pair::Pair;
pub use read::{Source, has_ending, kind, read};

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

impl NormalMap {
    /// The map without an alpha that is 1 throughout.
    pub fn without_opaque_alpha(self) -> Self {
        Self { alpha: self.alpha.filter(|alpha| alpha.iter().any(|alpha| *alpha != 1.0)), ..self }
    }

    /// Turns green round: y up becomes y down.
    pub fn flip_y(&mut self) {
        self.vectors.iter_mut().for_each(|v| v[1] = -v[1]);
    }
}

/// The length of a vector.
fn length(vector: &[f32; 3]) -> f64 {
    vector.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt()
}

/// Levels of texels in one format, as KTX2 and DDS files hold them.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The format of the texels.
    pub format: &'static Format,
    /// Texels in a row of the first level.
    pub width: u32,
    /// Rows of the first level.
    pub height: u32,
    /// The bytes of each level, the largest first, row by row, without gaps. Readers return the first alone.
    pub levels: Vec<Vec<u8>>,
    /// The codec's identifier, where a KTX2 file tells it.
    pub codec: Option<String>,
    /// The direction of y, `up` or `down`, where a KTX2 file tells it.
    pub y: Option<String>,
}
