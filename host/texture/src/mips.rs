//! Mips: vectors averaged as vectors, and the roughness of what their mean loses.

use crate::{NormalMap, length};
use rayon::prelude::*;

/// A level: the means of the unit vectors that its texels cover, which are shorter than 1 where these differ.
#[derive(Clone, Debug)]
pub struct Level {
    /// The directions of the means; +Z where vectors cancel each other out.
    pub map: NormalMap,
    /// The lengths of the means, 0 to 1.
    pub lengths: Vec<f32>,
}

impl Level {
    fn of(width: u32, height: u32, means: &[[f32; 3]], alpha: Option<Vec<f32>>) -> Self {
        /// The mean of unit vectors in f32 that cancel each other out.
        const NONE: f64 = 1e-6;
        let direction = |v: &[f32; 3]| match length(v) {
            length if length > NONE => v.map(|c| (f64::from(c) / length) as f32),
            _ => [0.0, 0.0, 1.0],
        };
        let lengths = means.iter().map(|v| length(v).min(1.0) as f32).collect();
        let vectors = means.iter().map(direction).collect();
        Self { map: NormalMap { width, height, vectors, alpha }, lengths }
    }

    /// The roughness that a mirror gets from the spread of each texel's normals, 0 to 1: the root of GGX's alpha, as glTF and
    /// Burley's materials have it. Of a rough material, `alpha^2 = alpha_material^2 + roughness^4`.
    ///
    /// Source: Toksvig 2005, "Mipmapping Normal Maps": the variance `(1 - r) / r` of normals whose mean has the length r adds to
    /// the inverse of Blinn-Phong's exponent, for which `alpha^2 = 2 / exponent` (Walter et al. 2007, section 5.2, for large
    /// ones).
    pub fn roughness(&self) -> Vec<f32> {
        let alpha_squared = |r: f32| 2.0 * (1.0 - f64::from(r)) / f64::from(r).max(1e-6);
        self.lengths.iter().map(|r| alpha_squared(*r).min(1.0).powf(0.25) as f32).collect()
    }
}

/// All levels of a map, the map itself first, each of half the size, rounded down, to the last of one texel.
pub fn chain(map: &NormalMap) -> Vec<Level> {
    let (mut width, mut height) = (map.width, map.height);
    let (mut means, mut alpha) = (map.vectors.clone(), map.alpha.clone());
    let mut levels = vec![Level::of(width, height, &means, alpha.clone())];
    while width > 1 || height > 1 {
        means = halved(&means, width, height);
        alpha = alpha.map(|alpha| {
            let texels: Vec<[f32; 1]> = alpha.into_iter().map(|alpha| [alpha]).collect();
            halved(&texels, width, height).into_iter().map(|[alpha]| alpha).collect()
        });
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
        levels.push(Level::of(width, height, &means, alpha.clone()));
    }
    levels
}

/// The texels along one axis that a texel of the next level covers, and the share of each. Of an odd size 2n + 1, one of the n
/// covers 2 + 1/n of them.
fn taps(size: u32, at: u32) -> impl Iterator<Item = (usize, f64)> + Clone {
    let half = size / 2;
    let shares = match () {
        () if size == 1 => [1, 0, 0],
        () if size.is_multiple_of(2) => [half, half, 0],
        () => [half - at, half, at + 1],
    };
    (2 * at as usize..)
        .zip(shares)
        .filter(|(_, share)| *share > 0)
        .map(move |(texel, share)| (texel, f64::from(share) / f64::from(size)))
}

/// The means of the texels that each texel of the next level covers.
fn halved<const N: usize>(texels: &[[f32; N]], width: u32, height: u32) -> Vec<[f32; N]> {
    let row = |y: u32| {
        (0..(width / 2).max(1)).map(move |x| {
            let mut sum = [0.0; N];
            for (row, tall) in taps(height, y) {
                for (column, wide) in taps(width, x) {
                    let texel = &texels[row * width as usize + column];
                    sum.iter_mut().zip(texel).for_each(|(sum, c)| *sum += tall * wide * f64::from(*c));
                }
            }
            sum.map(|c| c as f32)
        })
    };
    (0..(height / 2).max(1)).into_par_iter().flat_map_iter(row).collect()
}
