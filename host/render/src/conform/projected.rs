//! Projections that the hardware rounds to snorm, beside the codes that the encoders round themselves.

use super::fields::Fields;
use super::points::Points;
use super::{HardwareRounding, Traits};
use crate::projection::Projection;
use crate::renderer::encoded;
use crate::storage::Storage;
use crate::variant::Variant;
use crate::{Renderer, Result};
use serde::{Deserialize, Serialize};
use unitvec_catalogue::AnyCodec;
use unitvec_vulkan::FormatUse;

/// A codec's projection, rounded by the hardware.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Projected {
    /// Texels compared with the CPU's codes.
    pub texels: u64,
    /// The number of codes that differ.
    pub differing: u64,
    /// The largest difference of a component, in steps.
    pub max_steps: i64,
    /// Texels that do not match the device's rounding of the projection, and differences of encoders that round the
    /// projection themselves where it does not lie halfway, nearly, between two codes.
    pub unexplained: u64,
}

/// Families whose fast encoders do nothing but round the projection. That of `eaoct` rounds ring and place on the ring, and that
/// of `cylindrical` has one code for each pole.
const ROUNDED: [&str; 2] = ["oct_snorm", "hemioct_snorm"];

/// The distance from halfway that counts as near, as a part of the largest integer: the encoder's arithmetic beyond the
/// projection is off by a few units in the last place.
const NEAR_HALFWAY: f64 = 8.0 * f32::EPSILON as f64;

/// Compares the hardware's codes of the codec's projection with the CPU's codes of the same normals. `None` for a codec
/// without a shader for it, and where the device does not draw to its format.
pub(super) fn check(
    renderer: &Renderer,
    format: &AnyCodec,
    directions: &[[f32; 3]],
    traits: &Traits,
) -> Result<Option<Projected>> {
    let Some(projection) = Projection::of(format) else { return Ok(None) };
    let Some(fields) = Fields::of(Storage::of(format).texel()) else { return Ok(None) };
    let variant = Variant::projected(projection);
    if !renderer.graphics.device().supports(fields.format, FormatUse::Attachment) {
        return Ok(None);
    }
    let rule = traits.rounding(fields.format);
    let is_rounded = projection.precise_bits().is_some() || ROUNDED.contains(&projection.name);
    let m = fields.most(0);
    let near = match rule {
        Some(HardwareRounding::NearlyNearest) => HardwareRounding::NEARLY,
        _ => NEAR_HALFWAY * f64::from(m),
    };
    let points = Points::of_normals(renderer, directions)?;
    let (texels, normals) = points.draw_texels(renderer, &variant, fields.format)?;
    let [unrounded, _] = points.draw(renderer, &variant)?;
    let integers = |texels: &[u8]| -> Vec<[i64; 2]> {
        texels.chunks_exact(fields.size()).map(|texel| [0, 1].map(|at| fields.get(texel, at))).collect()
    };
    let (stored, codes) = (integers(&texels), integers(&encoded(format, &normals)?));
    let mut found = Projected { texels: directions.len() as u64, ..Projected::default() };
    for (at, (stored, code)) in stored.iter().zip(&codes).enumerate() {
        let [x, y, _] = unrounded.get(at).copied().unwrap_or([f32::NAN; 3]);
        let steps = stored.iter().zip(code).map(|(a, b)| (a - b).abs()).max().unwrap_or_default();
        found.differing += u64::from(steps > 0);
        found.max_steps = found.max_steps.max(steps);
        let components = stored.iter().zip(code).zip([x, y]);
        let is_explained = components.into_iter().all(|((stored, code), x)| {
            let is_single = (stored - code).abs() <= 1 && is_halfway(x, m, near);
            rule.is_none_or(|rule| rule.allows(x, m, *stored)) && (!is_rounded || stored == code || is_single)
        });
        found.unexplained += u64::from(!is_explained);
    }
    Ok(Some(found))
}

/// True where `x` times `m` lies at most `near` from halfway between two integers.
fn is_halfway(x: f32, m: i32, near: f64) -> bool {
    let product = f64::from(x) * f64::from(m);
    (product - product.floor() - 0.5).abs() <= near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_near_halves() {
        for (x, expected) in
            [(0.5, true), (10.5 / 127.0, true), (0.25, false), (10.6 / 127.0, false), (1.0, false)]
        {
            assert_eq!(is_halfway(x, 127, 127.0 * NEAR_HALFWAY), expected, "{x}");
        }
    }
}
