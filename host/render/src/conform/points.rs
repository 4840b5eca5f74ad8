//! Vertices that are drawn as points, a pixel each, so that each goes through the pipeline on its own.

use super::super::Error;
use super::super::renderer::{FLOATS, Geometry, RAW, Renderer, pipeline};
use super::super::storage::{Storage, float_texels, texels_of};
use super::super::variant::{Stage, Variant};
use crate::Result;
use bytemuck::Zeroable;
use unitvec_catalogue::AnyCodec;
use unitvec_vulkan::{Draw, ImageFormat, Mesh, Target, bytes_per_texel};

/// Pixels of a row.
pub(super) const WIDTH: usize = 512;

/// Points with a normal each.
pub(super) struct Points {
    mesh: Mesh,
    vertices: Variant,
    attribute: ImageFormat,
    count: usize,
}

impl Points {
    pub(super) fn of_normals(renderer: &Renderer, normals: &[[f32; 3]]) -> Result<Self> {
        let attribute = Storage::Float.attribute(renderer.graphics.device());
        Self::of_attributes(renderer, Variant::FLOAT, attribute, bytemuck::cast_slice(normals))
    }

    pub(super) fn of_codes(
        renderer: &Renderer,
        variant: &Variant,
        format: &AnyCodec,
        codes: &[u8],
    ) -> Result<Self> {
        let attribute = variant.storage.attribute(renderer.graphics.device());
        Self::of_attributes(renderer, *variant, attribute, &texels_of(codes, attribute, format.bytes))
    }

    pub(super) fn of_attributes(
        renderer: &Renderer,
        vertices: Variant,
        attribute: ImageFormat,
        normals: &[u8],
    ) -> Result<Self> {
        let count = normals.len() / bytes_per_texel(attribute).unwrap_or(1);
        let rows = count.div_ceil(WIDTH);
        // Pixels' centres in clip space.
        let centre = |at: usize, size: usize| ((2 * at + 1) as f64 / size as f64 - 1.0) as f32;
        let positions: Vec<[f32; 3]> =
            (0..count).map(|at| [centre(at % WIDTH, WIDTH), centre(at / WIDTH, rows), 0.5]).collect();
        let attributes =
            [(ImageFormat::R32G32B32_SFLOAT, bytemuck::cast_slice(&positions)), (attribute, normals)];
        let mesh = Mesh::new(&renderer.graphics, &attributes, None)?;
        Ok(Self { mesh, vertices, attribute, count })
    }

    /// Draws to floats, whatever the variant's format; the result of its geometry shader, and the normals beside it.
    pub(super) fn draw(&self, renderer: &Renderer, variant: &Variant) -> Result<[Vec<[f32; 3]>; 2]> {
        let [stored, normals] = self.draw_to(renderer, variant, ImageFormat::R32G32B32A32_SFLOAT)?;
        let stored = float_texels(&stored).take(self.count).map(|[x, y, z, _]| [x, y, z]);
        Ok([stored.collect(), all_vectors(&normals, self.count)?])
    }

    /// Draws to an attachment of this format; texels, and the normals beside them.
    pub(super) fn draw_texels(
        &self,
        renderer: &Renderer,
        variant: &Variant,
        format: ImageFormat,
    ) -> Result<(Vec<u8>, Vec<[f32; 3]>)> {
        let [mut texels, normals] = self.draw_to(renderer, variant, format)?;
        let size = texels.len() / (self.rows() * WIDTH);
        texels.truncate(self.count * size);
        Ok((texels, all_vectors(&normals, self.count)?))
    }

    fn rows(&self) -> usize {
        self.count.div_ceil(WIDTH)
    }

    /// Draws to an attachment of this format, and one of normals.
    pub(super) fn draw_to(
        &self,
        renderer: &Renderer,
        variant: &Variant,
        format: ImageFormat,
    ) -> Result<[Vec<u8>; 2]> {
        let formats = [&[format], &FLOATS[..]].concat();
        let size = (WIDTH as u32, self.rows() as u32);
        let target = Target::new(&renderer.graphics, size, &formats, false)?;
        let attributes = [ImageFormat::R32G32B32_SFLOAT, self.attribute];
        let stages = [(&self.vertices, Stage::Vertex), (variant, Stage::Gbuffer)];
        let pipeline = pipeline(&renderer.shaders, &target, stages, &attributes, true)?;
        let constants = Geometry {
            clip_from_object: glam::Mat4::IDENTITY.to_cols_array_2d(),
            world_from_object: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
            object: 1,
            flags: RAW,
            ..Geometry::zeroed()
        };
        let draw =
            Draw { pipeline: &pipeline, mesh: Some(&self.mesh), constants: bytemuck::bytes_of(&constants) };
        renderer.graphics.draw(&target, &[], &[draw])?;
        Ok([target.read(0)?, target.read(1)?])
    }
}

/// The vectors of an attachment; `None` where nothing was drawn.
pub(super) fn vectors(texels: &[u8]) -> impl Iterator<Item = Option<[f32; 3]>> {
    float_texels(texels).map(|[x, y, z, drawn]| (drawn != 0.0).then_some([x, y, z]))
}

/// The first vectors of an attachment, all of which were drawn.
fn all_vectors(texels: &[u8], count: usize) -> Result<Vec<[f32; 3]>> {
    let drawn: Vec<[f32; 3]> = vectors(texels).take(count).flatten().collect();
    if drawn.len() < count {
        return Err(Error::NotDrawn { drawn: drawn.len(), wanted: count });
    }
    Ok(drawn)
}
