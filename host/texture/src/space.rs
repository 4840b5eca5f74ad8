//! What a map tells of itself: the space of its vectors, and the direction of y.

use crate::NormalMap;
use rayon::prelude::*;

/// z from here on is that of the hemisphere z >= 0: 8 bits round the equator to -1/255.
const NOISE: f32 = -0.02;

/// The texels whose z is below the equator beyond noise.
pub fn count_below(map: &NormalMap) -> u64 {
    map.vectors.iter().filter(|v| v[2] < NOISE).count() as u64
}

/// True for a map of object space, where more than one texel in a thousand is below the equator. A tangent-space map has none;
/// baking leaves a few at seams.
pub fn is_object_space(map: &NormalMap) -> bool {
    1000 * count_below(map) > map.vectors.len() as u64
}

/// The correlation of the two mixed derivatives of the height whose normals a tangent-space map holds, -1 to 1: positive where y
/// points up the image, negative where it points down, 0 where the map has none, such as one of a single direction.
///
/// Slopes p = -x/z and q = -y/z of a height have no curl: dp/dY = dq/dX, if Y points up. Down the image, where rows are
/// counted, dp/drow is -dp/dY. So the correlation of -dp/drow and dq/dcolumn is 1 for y up; for y down q has the other sign, and
/// it is -1. Of noise it is near 0.
pub fn upward(map: &NormalMap) -> f64 {
    /// Slopes of steeper texels are noise.
    const STEEPEST: f32 = 0.1;
    let width = map.width as usize;
    let slopes = |at: usize| {
        let [x, y, z] = map.vectors[at];
        (z > STEEPEST).then(|| [f64::from(-x / z), f64::from(-y / z)])
    };
    let cell = |at: usize| {
        let corners = [at, at + 1, at + width, at + width + 1].map(slopes);
        let [Some(a), Some(b), Some(c), Some(d)] = corners else { return [0.0; 3] };
        let p_by_row = c[0] + d[0] - a[0] - b[0];
        let q_by_column = b[1] + d[1] - a[1] - c[1];
        [-p_by_row * q_by_column, p_by_row * p_by_row, q_by_column * q_by_column]
    };
    let row = |row: usize| {
        let cells = (row * width..(row + 1) * width - 1).map(cell);
        cells.fold([0.0; 3], |sum, cell| [0, 1, 2].map(|i| sum[i] + cell[i]))
    };
    let rows = (0..(map.height as usize).saturating_sub(1)).into_par_iter().map(row);
    let sums: Vec<[f64; 3]> = rows.collect();
    let [product, pp, qq] = [0, 1, 2].map(|i| sums.iter().map(|sum| sum[i]).sum::<f64>());
    if pp * qq > 0.0 { product / (pp * qq).sqrt() } else { 0.0 }
}
