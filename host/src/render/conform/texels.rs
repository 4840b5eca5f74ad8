//! Codes in a texture, decoded by the lighting pass.

use super::super::renderer::{FLOATS, Lighting, RAW, Renderer, decoded, pipeline};
use super::super::storage::texels_of;
use super::super::variant::{Stage, Variant};
use super::points::{WIDTH, vectors};
use super::{Row, Tally, compare_normals};
use crate::Result;
use crate::backend::BackendKind;
use crate::catalogue::Format;
use crate::vulkan::{Draw, Image, ImageFormat, Target, bytes_per_texel};

/// Decodes codes on the CPU and by texel fetch.
pub(super) fn check(
    row: &mut Row,
    source: BackendKind,
    renderer: &Renderer,
    variant: &Variant,
    format: Format,
    codes: &[u8],
) -> Result<Tally> {
    let count = codes.len() / format.bytes;
    let size = (WIDTH as u32, count.div_ceil(WIDTH) as u32);
    let texel = variant.storage.texel();
    let texture = texture(renderer, texel, size, texels_of(codes, texel, format.bytes))?;
    // The shader reads it and does nothing with it.
    let surfaces = self::texture(renderer, ImageFormat::R32G32B32A32_SFLOAT, size, Vec::new())?;
    let target = Target::new(&renderer.graphics, size, &FLOATS, false)?;
    let stages = [(variant, Stage::Fullscreen), (variant, Stage::Light)];
    let pipeline = pipeline(&renderer.shaders, &target, stages, &[], false)?;
    let lighting = Lighting { flags: RAW, ..bytemuck::Zeroable::zeroed() };
    let draw = Draw { pipeline: &pipeline, mesh: None, constants: bytemuck::bytes_of(&lighting) };
    renderer.graphics.draw(&target, &[(0, &texture), (1, &surfaces)], &[draw])?;
    let normals = target.read(1)?;
    let found: Vec<[f32; 3]> = vectors(&normals).take(count).map_while(|normal| normal).collect();
    let cpu = decoded(format, codes)?;
    Ok(compare_normals(row, &format!("{source} texture"), format, codes, &cpu, &found))
}

/// A texture of this size; what texels do not fill is 0.
fn texture(renderer: &Renderer, format: ImageFormat, size: (u32, u32), mut texels: Vec<u8>) -> Result<Image> {
    let bytes = bytes_per_texel(format).unwrap_or_default();
    texels.resize(bytes * size.0 as usize * size.1 as usize, 0);
    Ok(Image::texture(&renderer.graphics, format, size, &texels)?)
}
