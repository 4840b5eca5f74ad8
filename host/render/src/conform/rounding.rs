//! A device's conversions of numbers to the integers of a format, and back.

use super::fields::Fields;
use super::points::{Points, vectors};
use super::texels;
use crate::variant::Variant;
use crate::{Renderer, Result};
use serde::{Deserialize, Serialize};
use std::fmt;
use unitvec_vulkan::FormatUse;

/// A device's rounding when it writes to an SNORM or UNORM format: of `x` times the largest integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
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
    /// To nearest, but within a tenth of a step of halfway either neighbour, as Direct3D 11 allows.
    NearlyNearest,
    /// None of these rules.
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
            Self::NearlyNearest => "to nearest, but nearly halfway to either neighbour",
            Self::Other => "not to nearest",
        })
    }
}

impl HardwareRounding {
    const RULES: [Self; 6] = [
        Self::NearestEven,
        Self::NearestAway,
        Self::NearestUp,
        Self::Exact,
        Self::Truncated,
        Self::NearlyNearest,
    ];

    /// The distance from halfway, in steps, up to which [`Self::NearlyNearest`] takes either neighbour.
    pub(super) const NEARLY: f64 = 0.1;

    /// True where the value of a code is stored as that code.
    pub fn keeps_codes(self) -> bool {
        !matches!(self, Self::Truncated | Self::Other)
    }

    /// True where the rule tells the integer of every number.
    pub(super) fn is_definite(self) -> bool {
        !matches!(self, Self::NearlyNearest | Self::Other)
    }

    /// True where `x` may be stored as this integer, where the largest is `m`.
    pub(super) fn allows(self, x: f32, m: i32, stored: i64) -> bool {
        match self {
            Self::NearlyNearest => (f64::from(x) * f64::from(m) - stored as f64).abs() <= 0.5 + Self::NEARLY,
            rule => rule.of(x, m) == stored,
        }
    }

    /// The integer that this rule gives for `x`, where the largest is `m`; one of them, where it is not definite.
    pub(super) fn of(self, x: f32, m: i32) -> i64 {
        let product = x * m as f32;
        (match self {
            Self::NearestEven => f64::from(product).round_ties_even(),
            Self::NearestAway => f64::from(product).round(),
            Self::NearestUp => (f64::from(product) + 0.5).floor(),
            Self::Exact | Self::NearlyNearest => (f64::from(x) * f64::from(m)).round_ties_even(),
            Self::Truncated | Self::Other => f64::from(product).trunc(),
        }) as i64
    }

    /// The first rule that explains all of these values and their integers.
    fn explaining(values: &[(f32, i64)], m: i32) -> Self {
        let explains = |rule: &Self| values.iter().all(|(x, stored)| rule.allows(*x, m, *stored));
        Self::RULES.into_iter().find(explains).unwrap_or(Self::Other)
    }
}

/// A device's conversions for one format.
#[derive(Clone, Debug, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Conversion {
    /// The format.
    pub format: String,
    /// The rounding of written values; `None` where the format is no attachment.
    pub rounding: Option<HardwareRounding>,
    /// The farthest that an integer is from the exact product, in steps: a half where it is rounded to nearest.
    pub steps_off: f64,
    /// Integers whose value was fetched from a texture.
    pub fetched: u64,
    /// Values that are not the exact quotient, rounded once.
    pub inexact: u64,
}

impl Conversion {
    /// The format, `R8G8_SNORM`.
    pub fn name(&self) -> &str {
        self.format.trim_end_matches("_PACK32")
    }

    /// The rules of writing and reading, in words.
    pub fn in_words(&self) -> String {
        let Self { rounding, steps_off, fetched, inexact, .. } = self;
        let written = match rounding {
            None => "no attachment".to_owned(),
            Some(HardwareRounding::Other) => {
                format!("not rounded to nearest, up to {steps_off:.2} steps off")
            }
            Some(rounding) => format!("rounded {rounding}"),
        };
        match (fetched, inexact) {
            (0, _) => format!("{written}; no texture"),
            (_, 0) => format!("{written}; fetched exactly"),
            _ => format!("{written}; {inexact} of {fetched} fetched inexactly"),
        }
    }
}

/// Measures a format: writes a ramp of quarters, halves and their neighbours, and fetches integers.
pub(super) fn conversion(renderer: &Renderer, fields: Fields) -> Result<Conversion> {
    let device = renderer.graphics.device();
    let is = |usage| device.supports(fields.format, usage);
    let mut found = Conversion {
        format: format!("{:?}", fields.format),
        rounding: None,
        steps_off: 0.0,
        fetched: 0,
        inexact: 0,
    };
    if is(FormatUse::Attachment) {
        let (m, stored) = (fields.most(0), ramp(renderer, fields)?);
        let off = |(x, integer): &(f32, i64)| (f64::from(*x) * f64::from(m) - *integer as f64).abs();
        found.rounding = Some(HardwareRounding::explaining(&stored, m));
        found.steps_off = stored.iter().map(off).fold(0.0, f64::max);
    }
    if !is(FormatUse::Texture) {
        return Ok(found);
    }
    let (texels, size) = (every_integer(fields), fields.size());
    let values = texels::fetched(renderer, fields.format, &texels)?;
    for (texel, [x, y, _]) in texels.chunks_exact(size).zip(&values) {
        found.fetched += 1;
        found.inexact += u64::from([fields.value(texel, 0), fields.value(texel, 1)] != [*x, *y]);
    }
    Ok(found)
}

/// Texels with each integer in red and in green.
fn every_integer(fields: Fields) -> Vec<u8> {
    let mut texels = Vec::new();
    let end = i64::from(fields.most(0)) + 1;
    for red in if fields.is_signed { -end..end } else { 0..end } {
        let green = if fields.is_signed { -1 - red } else { end - 1 - red };
        fields.push(&mut texels, [red, green, 0]);
    }
    texels
}

/// Numbers that were written, and the integers stored for them.
fn ramp(renderer: &Renderer, fields: Fields) -> Result<Vec<(f32, i64)>> {
    const FRACTIONS: [f32; 5] = [0.0, 0.25, 0.5, 0.75, 0.9];
    /// Integers of the ramp, each way.
    const STEPS: i32 = 2000;
    let m = fields.most(0);
    let whole = |step: i32| (i64::from(m) * i64::from(step) / i64::from(STEPS)) as f32;
    let least = if fields.is_signed { -1.0 } else { 0.0 };
    let values: Vec<[f32; 3]> = (1 - STEPS..STEPS)
        .flat_map(|step| FRACTIONS.map(|fraction| (whole(step) + fraction) / m as f32))
        .flat_map(|x| [x.next_down(), x, x.next_up()])
        .chain([least, 1.0])
        .filter(|x| (least..=1.0).contains(x))
        .map(|x| [x, x, 0.0])
        .collect();
    let points = Points::of_normals(renderer, &values)?;
    let [texels, normals] = points.draw_to(renderer, &Variant::FLOAT, fields.format)?;
    let written = vectors(&normals).take(values.len()).flatten().map(|[x, ..]| x);
    let stored = texels.chunks_exact(fields.size()).map(|texel| fields.get(texel, 0));
    Ok(written.zip(stored).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A device of each rule is recognised by a ramp that has exact halves among its products.
    #[test]
    fn rules_are_told_apart() {
        let ramp: Vec<f32> = (-253..254).map(|half| 0.5 * half as f32 / 127.0).collect();
        for rule in HardwareRounding::RULES.into_iter().filter(|rule| rule.is_definite()) {
            let values: Vec<_> = ramp.iter().map(|x| (*x, rule.of(*x, 127))).collect();
            assert_eq!(HardwareRounding::explaining(&values, 127), rule);
        }
        // Every half, and numbers up to a twentieth of a step above it, go down.
        let below = |x: f32| (x, (f64::from(x) * 127.0 - 0.05).round() as i64);
        let loose: Vec<_> = ramp.iter().flat_map(|x| [below(*x), below(x + 0.05 / 127.0)]).collect();
        assert_eq!(HardwareRounding::explaining(&loose, 127), HardwareRounding::NearlyNearest);
        let wrong: Vec<_> = ramp.iter().map(|x| (*x, 1 + HardwareRounding::Exact.of(*x, 127))).collect();
        assert_eq!(HardwareRounding::explaining(&wrong, 127), HardwareRounding::Other);
    }

    #[test]
    fn every_integer_is_in_red_and_green() {
        for fields in Fields::all() {
            let texels = every_integer(fields);
            let count = 1usize << fields.bits();
            assert_eq!(texels.len(), count * fields.size());
            for at in [0, 1] {
                let mut integers: Vec<i64> =
                    texels.chunks_exact(fields.size()).map(|texel| fields.get(texel, at)).collect();
                integers.sort_unstable();
                integers.dedup();
                assert_eq!(integers.len(), count, "{:?}", fields.format);
            }
        }
    }
}
