//! DDS files (Microsoft, Programming Guide for DDS), written with the header of Direct3D 10.

use crate::format::{FORMATS, named};
use crate::{Error, Result, Texture};
use ddsfile::{AlphaMode, Caps2, D3D10ResourceDimension, D3DFormat, Dds, NewDxgiParams};
use std::path::Path;

/// Reads the first level of a texture.
///
/// # Errors
/// [`Error::Damaged`], and [`Error::Unsupported`] for arrays, cubes, volumes and other formats.
pub fn read(path: &Path, bytes: &[u8]) -> Result<Texture> {
    let mut dds = Dds::read(bytes).map_err(|error| Error::damaged(path, "dds", error))?;
    let layers = dds.header10.as_ref().map_or(1, |header| header.array_size);
    let is_cube = dds.header.caps2.intersects(Caps2::CUBEMAP | Caps2::VOLUME);
    if layers > 1 || is_cube || dds.get_depth() > 1 {
        return Err(Error::unsupported(path, "is an array, a cube or no plane; extract one image of it"));
    }
    let dxgi = dds.get_dxgi_format();
    let format = FORMATS.iter().find(|format| dxgi.is_some() && format.dxgi == dxgi);
    let format = format.or_else(|| legacy(dds.get_d3d_format()?)).ok_or_else(|| {
        let name = dxgi.map_or_else(|| "another format".to_owned(), |format| format!("{format:?}"));
        Error::unsupported(path, format!("has {name}; save it in R8G8B8A8_UNorm, for example"))
    })?;
    let (width, height) = (dds.get_width(), dds.get_height());
    let needed = format.bytes_of(width, height).filter(|needed| (1..=dds.data.len()).contains(needed));
    let needed =
        needed.ok_or_else(|| Error::damaged(path, "dds", "it has fewer bytes than its size asks for"))?;
    dds.data.truncate(needed);
    Ok(Texture { format, width, height, levels: vec![dds.data], codec: None, y: None })
}

/// The format of a file without the header of Direct3D 10.
fn legacy(format: D3DFormat) -> Option<&'static crate::Format> {
    named(match format {
        D3DFormat::A8R8G8B8 | D3DFormat::X8R8G8B8 => "B8G8R8A8_UNORM",
        D3DFormat::A8B8G8R8 | D3DFormat::X8B8G8R8 => "R8G8B8A8_UNORM",
        D3DFormat::A16B16G16R16 => "R16G16B16A16_UNORM",
        D3DFormat::A16B16G16R16F => "R16G16B16A16_SFLOAT",
        D3DFormat::A32B32G32R32F => "R32G32B32A32_SFLOAT",
        _ => return None,
    })
}

/// The file of a texture.
///
/// # Errors
/// [`Error::Output`] for a format that Direct3D lacks, and for 4 GiB.
pub fn write(texture: &Texture) -> Result<Vec<u8>> {
    let failed = |reason: String| Error::Output { format: "dds", reason };
    let format = texture.format.dxgi;
    let format = format.ok_or_else(|| failed(format!("it has no {}", texture.format.name())))?;
    let data = texture.levels.concat();
    if u32::try_from(data.len()).is_err() {
        return Err(failed("it cannot hold so many texels".to_owned()));
    }
    let mut dds = Dds::new_dxgi(NewDxgiParams {
        height: texture.height,
        width: texture.width,
        depth: None,
        format,
        mipmap_levels: Some(texture.levels.len() as u32),
        array_layers: None,
        caps2: None,
        is_cubemap: false,
        resource_dimension: D3D10ResourceDimension::Texture2D,
        alpha_mode: AlphaMode::Unknown,
    })
    .map_err(|error| failed(unitvec_files::one_line(error)))?;
    dds.data = data;
    let mut bytes = Vec::new();
    dds.write(&mut bytes).map_err(|error| failed(unitvec_files::one_line(error)))?;
    Ok(bytes)
}
