//! Projections through attachments, textures and vertex attributes of every format that holds their numbers.

use super::fields::Fields;
use super::points::Points;
use super::rounding::HardwareRounding;
use super::{Checks, Options, Renderers, Row, Tally, Traits, directions_of, shown, texels};
use crate::projection::{PROJECTIONS, Projection};
use crate::variant::Variant;
use crate::{Renderer, Result};
use unitvec_catalogue::Domain;
use unitvec_run::backend::BackendKind;
use unitvec_run::sampling;
use unitvec_vulkan::{Device, FormatUse};

/// A projection and a format.
#[derive(Clone, Copy)]
pub struct Pair {
    projection: &'static Projection,
    fields: Fields,
}

/// Each projection with each format of its numbers.
pub fn pairs() -> Vec<Pair> {
    let of = |projection: &'static Projection| {
        let holds = move |fields: &Fields| {
            let has_room = if projection.has_bit() {
                fields.has_alpha()
            } else {
                !fields.has_alpha() || fields.bits() == 10
            };
            let is_made_for = projection.precise_bits().is_none_or(|bits| bits == 2 * fields.bits());
            fields.is_signed != projection.is_unorm() && has_room && is_made_for
        };
        Fields::all().filter(holds).map(move |fields| Pair { projection, fields })
    };
    PROJECTIONS.iter().flat_map(of).collect()
}

/// Draws and fetches with the shaders of all sources.
pub(super) fn row(
    Pair { projection, fields }: Pair,
    options: &Options,
    device: &Device,
    renderers: &mut Renderers,
    traits: &Traits,
) -> Result<Row> {
    let mut row = Row::of_format(device, projection.name, 2 * fields.bits(), fields.format);
    let directions = directions_of(Domain::Sphere, options);
    let supports = |usage| device.supports(fields.format, usage);
    for (source, renderer) in renderers.iter() {
        let mut checks = Checks::default();
        let one = One { source: *source, renderer, projection, fields };
        if let Some(rule) = traits.rounding(fields.format) {
            checks.attachment = one.attachment(&mut row, &directions, rule)?;
        }
        let texels = one.texels(&directions, options);
        if supports(FormatUse::Texture) {
            checks.texture = one.texture(&mut row, &texels)?;
        }
        if supports(FormatUse::Vertex) {
            checks.vertex = one.vertex(&mut row, &texels)?;
        }
        row.checks.insert(*source, checks);
    }
    Ok(row)
}

/// A pair with the shaders of one source.
struct One<'a> {
    source: BackendKind,
    renderer: &'a Renderer,
    projection: &'static Projection,
    fields: Fields,
}

impl One<'_> {
    fn variant(&self) -> Variant {
        Variant::projected(self.projection)
    }

    /// The CPU's numbers of normals.
    fn projected(&self, normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        normals.iter().map(|normal| self.projection.project(*normal)).collect()
    }

    /// The texels of numbers rounded by this rule.
    fn rounded(&self, numbers: &[[f32; 3]], rule: HardwareRounding) -> Vec<u8> {
        let mut texels = Vec::new();
        for [x, y, bit] in numbers {
            let alpha = if self.fields.has_alpha() { rule.of(*bit, self.fields.most(3)) } else { 0 };
            let [red, green] = [(x, 0), (y, 1)].map(|(x, at)| rule.of(*x, self.fields.most(at)));
            self.fields.push(&mut texels, [red, green, alpha]);
        }
        texels
    }

    /// The texels that the device itself stores for numbers written as they are, with the alpha of `drawn`.
    fn stored(&self, numbers: &[[f32; 3]], drawn: &[u8]) -> Result<Vec<u8>> {
        let (fields, size) = (self.fields, self.fields.size());
        let pairs: Vec<[f32; 3]> = numbers.iter().map(|[x, y, _]| [*x, *y, 0.0]).collect();
        let points = Points::of_normals(self.renderer, &pairs)?;
        let (stored, _) = points.draw_texels(self.renderer, &Variant::FLOAT, fields.format)?;
        let mut texels = Vec::new();
        for (stored, drawn) in stored.chunks_exact(size).zip(drawn.chunks_exact(size)) {
            let alpha = if fields.has_alpha() { fields.get(drawn, 3) } else { 0 };
            fields.push(&mut texels, [fields.get(stored, 0), fields.get(stored, 1), alpha]);
        }
        Ok(texels)
    }

    /// Texels whose alpha is not the integer of the number that was written, 0 or 1.
    fn lost_alpha(&self, numbers: &[[f32; 3]], drawn: &[u8]) -> usize {
        let expected = |bit: f32| bit as i64 * i64::from(self.fields.most(3));
        let texels = drawn.chunks_exact(self.fields.size()).zip(numbers);
        texels.filter(|(texel, [.., bit])| self.fields.get(texel, 3) != expected(*bit)).count()
    }

    /// Compares the attachment's contents for normals with the CPU's numbers, rounded as the device rounds.
    fn attachment(&self, row: &mut Row, normals: &[[f32; 3]], rule: HardwareRounding) -> Result<Tally> {
        let points = Points::of_normals(self.renderer, normals)?;
        let (texels, normals) = points.draw_texels(self.renderer, &self.variant(), self.fields.format)?;
        let numbers = self.projected(&normals);
        let expected =
            if rule.is_definite() { self.rounded(&numbers, rule) } else { self.stored(&numbers, &texels)? };
        if !rule.is_definite() && self.projection.has_bit() {
            let lost = self.lost_alpha(&numbers, &texels);
            if lost > 0 {
                let (format, count) = (self.fields.format, numbers.len());
                row.unsupported.push(format!(
                    "{} {format:?} that keeps alpha: {lost} of {count} texels lost it",
                    self.source
                ));
            }
        }
        let what = format!("{} attachment", self.source);
        Ok(row.compare(&what, self.fields.size(), &expected, &texels, |at| shown(&normals[at])))
    }

    /// Texels of normals, and random ones.
    fn texels(&self, normals: &[[f32; 3]], options: &Options) -> Vec<u8> {
        let mut texels = self.rounded(&self.projected(normals), HardwareRounding::NearestEven);
        let size = self.fields.size();
        let random = sampling::random_codes(options.seed).take(options.count);
        for code in sampling::special_codes().into_iter().chain(random) {
            texels.extend(&code.to_le_bytes()[..size]);
        }
        texels
    }

    /// The CPU's normals of numbers that the device has converted. Alpha's are the exact quotients.
    fn normals(&self, texels: &[u8], converted: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let texels = texels.chunks_exact(self.fields.size());
        let normal = |(texel, [x, y, _]): (&[u8], &[f32; 3])| {
            let bit = if self.projection.has_bit() { self.fields.value(texel, 3) } else { 0.0 };
            self.projection.unproject([*x, *y, bit])
        };
        texels.zip(converted).map(normal).collect()
    }

    /// Normals that the lighting pass computes from texels.
    fn texture(&self, row: &mut Row, texels: &[u8]) -> Result<Tally> {
        let fetched = texels::fetched(self.renderer, self.fields.format, texels)?;
        let expected = self.normals(texels, &fetched);
        let found = texels::decoded(self.renderer, &self.variant(), self.fields.format, texels)?;
        let what = format!("{} texture", self.source);
        Ok(row.compare_normals(&what, texels, self.fields.size(), &expected, &found))
    }

    /// Normals that the vertex shader computes from attributes, both interpolated.
    fn vertex(&self, row: &mut Row, texels: &[u8]) -> Result<Tally> {
        let passed = |vertices: Variant| -> Result<Vec<[f32; 3]>> {
            let points = Points::of_attributes(self.renderer, vertices, self.fields.format, texels)?;
            let [_, normals] = points.draw(self.renderer, &Variant::FLOAT)?;
            Ok(normals)
        };
        let cpu = self.normals(texels, &passed(Variant::FLOAT)?);
        let [_, expected] = Points::of_normals(self.renderer, &cpu)?.draw(self.renderer, &Variant::FLOAT)?;
        let what = format!("{} vertex", self.source);
        Ok(row.compare_normals(&what, texels, self.fields.size(), &expected, &passed(self.variant())?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every projection has a format, and precise ones that of their codec alone.
    #[test]
    fn projections_have_their_formats() {
        let pairs = pairs();
        let formats = |name: &str| -> Vec<String> {
            let of = pairs.iter().filter(|pair| pair.projection.name == name);
            of.map(|pair| format!("{:?}", pair.fields.format)).collect()
        };
        assert_eq!(formats("oct_unorm"), ["R8G8_UNORM", "R16G16_UNORM", "A2B10G10R10_UNORM_PACK32"]);
        assert_eq!(formats("eaoct16p_snorm"), ["R8G8_SNORM"]);
        assert_eq!(formats("oct32p_snorm"), ["R16G16_SNORM"]);
        assert_eq!(
            formats("soct_unorm"),
            ["A2B10G10R10_UNORM_PACK32", "R8G8B8A8_UNORM", "R16G16B16A16_UNORM"]
        );
        assert!(PROJECTIONS.iter().all(|projection| !formats(projection.name).is_empty()));
    }
}
