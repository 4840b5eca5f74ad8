//! Codes in a texture, decoded by the lighting pass.

use super::super::renderer::{FLOATS, Lighting, RAW, Renderer, pipeline};
use super::super::variant::{Stage, Variant};
use super::points::{WIDTH, vectors};
use crate::Result;
use unitvec_vulkan::{Draw, Image, ImageFormat, Target, bytes_per_texel};

/// The first three numbers of texels as the device fetches them.
pub(super) fn fetched(renderer: &Renderer, format: ImageFormat, texels: &[u8]) -> Result<Vec<[f32; 3]>> {
    decoded(renderer, &Variant::FLOAT, format, texels)
}

/// The normals that the lighting pass computes from texels.
pub(super) fn decoded(
    renderer: &Renderer,
    variant: &Variant,
    format: ImageFormat,
    texels: &[u8],
) -> Result<Vec<[f32; 3]>> {
    let count = texels.len() / bytes_per_texel(format).unwrap_or(1);
    let size = (WIDTH as u32, count.div_ceil(WIDTH) as u32);
    let texture = texture(renderer, format, size, texels.to_vec())?;
    // The shader reads it and does nothing with it.
    let surfaces = self::texture(renderer, ImageFormat::R32G32B32A32_SFLOAT, size, Vec::new())?;
    let target = Target::new(&renderer.graphics, size, &FLOATS, false)?;
    let stages = [(variant, Stage::Fullscreen), (variant, Stage::Light)];
    let pipeline = pipeline(&renderer.shaders, &target, stages, &[], false)?;
    let lighting = Lighting { flags: RAW, ..bytemuck::Zeroable::zeroed() };
    let draw = Draw { pipeline: &pipeline, mesh: None, constants: bytemuck::bytes_of(&lighting) };
    renderer.graphics.draw(&target, &[(0, &texture), (1, &surfaces)], &[draw])?;
    let normals = target.read(1)?;
    Ok(vectors(&normals).take(count).map_while(|normal| normal).collect())
}

/// A texture of this size; texels beyond those given are 0.
fn texture(renderer: &Renderer, format: ImageFormat, size: (u32, u32), mut texels: Vec<u8>) -> Result<Image> {
    let bytes = bytes_per_texel(format).unwrap_or_default();
    texels.resize(bytes * size.0 as usize * size.1 as usize, 0);
    Ok(Image::texture(&renderer.graphics, format, size, &texels)?)
}
