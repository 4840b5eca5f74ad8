//! Projections that the hardware rounds to snorm, beside the codes that the encoders round themselves.

use super::super::renderer::{Renderer, encoded};
use super::super::storage::Storage;
use super::super::variant::Variant;
use super::Traits;
use super::points::Points;
use crate::Result;
use crate::catalogue::Format;
use crate::vulkan::{FormatUse, ImageFormat};
use serde::{Deserialize, Serialize};
use std::fmt;

/// How a device rounds what it writes to an SNORM format, `x` times the largest integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HardwareRounding {
    /// The product in f32 to nearest, halves to even.
    NearestEven,
    /// The product in f32 to nearest, halves away from zero.
    NearestAway,
    /// The product in f32 to nearest, halves up.
    NearestUp,
    /// The exact product to nearest.
    Exact,
    /// Towards zero.
    Truncated,
    /// None of these.
    Other,
}

impl fmt::Display for HardwareRounding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NearestEven => "to nearest, halves to even",
            Self::NearestAway => "to nearest, halves away from zero",
            Self::NearestUp => "to nearest, halves up",
            Self::Exact => "to nearest, of the exact product",
            Self::Truncated => "towards zero",
            Self::Other => "not to nearest",
        })
    }
}

impl HardwareRounding {
    const RULES: [Self; 5] =
        [Self::NearestEven, Self::NearestAway, Self::NearestUp, Self::Exact, Self::Truncated];

    /// True where the value of a code is stored as that code.
    pub(super) fn keeps_codes(self) -> bool {
        !matches!(self, Self::Truncated | Self::Other)
    }

    /// The integer that this rule makes of `x`, where the largest is `m`.
    fn of(self, x: f32, m: i32) -> i64 {
        let product = x * m as f32;
        (match self {
            Self::NearestEven => f64::from(product).round_ties_even(),
            Self::NearestAway => f64::from(product).round(),
            Self::NearestUp => (f64::from(product) + 0.5).floor(),
            Self::Exact => (f64::from(x) * f64::from(m)).round_ties_even(),
            Self::Truncated | Self::Other => f64::from(product).trunc(),
        }) as i64
    }

    /// The first rule that explains all of these values and what became of them.
    fn explaining(values: &[(f32, i64)], m: i32) -> Self {
        let explains = |rule: &Self| values.iter().all(|(x, stored)| rule.of(*x, m) == *stored);
        Self::RULES.into_iter().find(explains).unwrap_or(Self::Other)
    }
}

/// A codec's projection, rounded by the hardware.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Projected {
    /// Texels compared with the CPU's codes.
    pub texels: u64,
    /// Those that differ.
    pub differing: u64,
    /// The largest difference of a component, in steps.
    pub max_steps: i64,
    /// Texels that are not what the device's rounding makes of the projection, and differences of encoders that round the
    /// projection themselves where it does not lie halfway, nearly, between two codes.
    pub unexplained: u64,
}

/// What the identifiers of codecs begin with whose encoders do nothing but round the projection. That of `eaoct` rounds ring
/// and place on the ring, and that of `cylindrical` has one code for each pole.
const ROUNDED: [&str; 2] = ["oct", "hemioct"];

/// How near to halfway a component has to be, as a part of the largest integer: what the encoder computes beyond the
/// projection is off by a few units in the last place.
const NEAR_HALFWAY: f64 = 8.0 * f32::EPSILON as f64;

/// Compares what the hardware makes of the codec's projection with the CPU's codes of the same normals. `None` for a codec
/// without a shader for it, and where the device does not draw to its format.
pub(super) fn check(
    renderer: &Renderer,
    format: Format,
    directions: &[[f32; 3]],
    traits: &Traits,
) -> Result<Option<Projected>> {
    let Some(variant) = Variant::projected(format) else { return Ok(None) };
    let texel = variant.storage.texel();
    let device = renderer.graphics.device();
    if !device.supports(texel, FormatUse::Attachment) || !renderer.shaders.has(&variant) {
        return Ok(None);
    }
    let (m, rule) = match variant.storage {
        Storage::Snorm8x2 => (127, traits.rounding_8),
        _ => (32767, traits.rounding_16),
    };
    let is_rounded = ROUNDED.iter().any(|family| format.id.starts_with(family));
    let points = Points::of_normals(renderer, directions)?;
    let (texels, normals) = points.draw_codes(renderer, &variant)?;
    let [unrounded, _] = points.draw(renderer, &variant)?;
    let codes = encoded(format, &normals)?;
    let (stored, codes) = (integers(&texels, m), integers(&codes, m));
    let mut found = Projected { texels: directions.len() as u64, ..Projected::default() };
    for (at, (stored, code)) in stored.iter().zip(&codes).enumerate() {
        let [x, y, _] = unrounded.get(at).copied().unwrap_or([f32::NAN; 3]);
        let steps = stored.iter().zip(code).map(|(a, b)| (a - b).abs()).max().unwrap_or_default();
        found.differing += u64::from(steps > 0);
        found.max_steps = found.max_steps.max(steps);
        let components = stored.iter().zip(code).zip([x, y]);
        let is_explained = components.into_iter().all(|((stored, code), x)| {
            let is_single = (stored - code).abs() <= 1 && is_halfway(x, m);
            rule.is_none_or(|rule| rule.of(x, m) == *stored) && (!is_rounded || stored == code || is_single)
        });
        found.unexplained += u64::from(!is_explained);
    }
    Ok(Some(found))
}

/// True where `x` lies nearly halfway between two integers of `m`.
fn is_halfway(x: f32, m: i32) -> bool {
    let product = f64::from(x) * f64::from(m);
    (product - product.floor() - 0.5).abs() <= NEAR_HALFWAY * f64::from(m)
}

/// The first two integers of texels with fields of 8, 10 or 16 bits, by their largest integer `m`.
fn integers(texels: &[u8], m: i32) -> Vec<[i64; 2]> {
    let bits = 33 - m.leading_zeros();
    let size = if bits == 8 { 2 } else { 4 };
    let field = |word: u32, at: u32| i64::from(((word << (32 - bits * (at + 1))) as i32) >> (32 - bits));
    let word = |texel: &[u8]| texel.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte));
    texels.chunks_exact(size).map(word).map(|word| [field(word, 0), field(word, 1)]).collect()
}

/// How the device rounds what is written to a format of two snorm whose largest integer is `m`: by a ramp of quarters, halves
/// and their neighbours. `None` where the device does not draw to it.
pub(super) fn rounding(renderer: &Renderer, format: ImageFormat, m: i32) -> Result<Option<HardwareRounding>> {
    const FRACTIONS: [f32; 5] = [0.0, 0.25, 0.5, 0.75, 0.9];
    /// Integers of the ramp, each way.
    const STEPS: i32 = 2000;
    if !renderer.graphics.device().supports(format, FormatUse::Attachment) {
        return Ok(None);
    }
    let whole = |step: i32| (i64::from(m) * i64::from(step) / i64::from(STEPS)) as f32;
    let values: Vec<[f32; 3]> = (1 - STEPS..STEPS)
        .flat_map(|step| FRACTIONS.map(|fraction| (whole(step) + fraction) / m as f32))
        .flat_map(|x| [x.next_down(), x, x.next_up()])
        .filter(|x| x.abs() <= 1.0)
        .map(|x| [x, x, 0.0])
        .collect();
    let points = Points::of_normals(renderer, &values)?;
    let [texels, normals] = points.draw_to(renderer, &Variant::FLOAT, format)?;
    let written = super::points::vectors(&normals).take(values.len()).flatten().map(|[x, ..]| x);
    let stored = integers(&texels, m);
    let pairs: Vec<(f32, i64)> = written.zip(stored.iter().map(|pair| pair[0])).collect();
    Ok(Some(HardwareRounding::explaining(&pairs, m)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A device of each rule is recognised by a ramp that has exact halves among its products.
    #[test]
    fn rules_are_told_apart() {
        let ramp: Vec<f32> = (-253..254).map(|half| 0.5 * half as f32 / 127.0).collect();
        for rule in HardwareRounding::RULES {
            let values: Vec<_> = ramp.iter().map(|x| (*x, rule.of(*x, 127))).collect();
            assert_eq!(HardwareRounding::explaining(&values, 127), rule);
        }
        let wrong: Vec<_> = ramp.iter().map(|x| (*x, 1 + HardwareRounding::Exact.of(*x, 127))).collect();
        assert_eq!(HardwareRounding::explaining(&wrong, 127), HardwareRounding::Other);
    }

    #[test]
    fn halves_are_near_halves() {
        for (x, expected) in
            [(0.5, true), (10.5 / 127.0, true), (0.25, false), (10.6 / 127.0, false), (1.0, false)]
        {
            assert_eq!(is_halfway(x, 127), expected, "{x}");
        }
    }
}
