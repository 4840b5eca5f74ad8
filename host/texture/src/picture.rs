//! Pictures: png, jpeg, tga and exr read, png written.

use crate::mips::Level;
use crate::{Error, NormalMap, Result};
use image::{DynamicImage, GrayImage, ImageDecoder, ImageFormat, ImageReader, Luma, RgbImage, Rgba32FImage};
use std::io::Cursor;
use std::path::Path;

/// The most bytes of an image that a byte of its file stands for. Deflate, the closest of the compressions, has 1032
/// (zlib, Technical Details). Of a jpeg, 16 by 16 pixels take 12 bits at least: 512.
const CLOSEST: u64 = 1032;

/// The bytes of a png of indices that are always read: 4096 by 4096 texels of four. An index, of one bit at least, stands for
/// more bytes than Deflate took it from.
const INDEXED: u64 = 1 << 26;

/// A map as its file has it.
pub(crate) struct Raw {
    pub format: String,
    /// Vectors of any length.
    pub map: NormalMap,
    /// True where the vectors were biased.
    pub is_biased: bool,
}

impl Raw {
    /// A map of channels: red, green, blue, alpha. Biased ones stand for -1 to 1 by 0 to 1.
    pub fn of_channels(
        format: String,
        [width, height]: [u32; 2],
        texels: impl Iterator<Item = [f32; 4]>,
        is_biased: bool,
    ) -> Self {
        let component = |c: f32| if is_biased { 2.0 * c - 1.0 } else { c };
        let (vectors, alpha) = texels.map(|[x, y, z, alpha]| ([x, y, z].map(component), alpha)).unzip();
        let map = NormalMap { width, height, vectors, alpha: Some(alpha) }.without_opaque_alpha();
        Self { format, map, is_biased }
    }
}

/// Reads a picture: floats as they are, integers biased.
///
/// # Errors
/// [`Error::Damaged`], before anything is allocated also for a size that the file is too short for; [`Error::Unsupported`] for
/// gray pictures.
pub(crate) fn read(path: &Path, bytes: &[u8], format: ImageFormat, name: &'static str) -> Result<Raw> {
    /// The place in a png of what its numbers are (PNG 3, 11.2.1 IHDR): 3 for indices of colours.
    const COLOR_TYPE: usize = 25;
    let damaged = |error: &dyn std::fmt::Display| Error::damaged(path, name, error);
    let decoder = ImageReader::with_format(Cursor::new(bytes), format).into_decoder();
    let decoder = decoder.map_err(|error| damaged(&error))?;
    let is_indexed = format == ImageFormat::Png && bytes.get(COLOR_TYPE) == Some(&3);
    let least = if is_indexed { INDEXED } else { 0 };
    if !(1..=least.max(CLOSEST * bytes.len() as u64)).contains(&decoder.total_bytes()) {
        return Err(damaged(&"it has not the bytes that its size asks for"));
    }
    let color = decoder.color_type();
    if !color.has_color() {
        return Err(Error::unsupported(path, "is gray, and no map of vectors; take the normal map itself"));
    }
    let image = DynamicImage::from_decoder(decoder).map_err(|error| damaged(&error))?;
    let bits = u32::from(color.bits_per_pixel()) / u32::from(color.channel_count());
    let size = [image.width(), image.height()];
    let texels = image.into_rgba32f();
    let channels = texels.pixels().map(|pixel| pixel.0);
    let is_biased = format != ImageFormat::OpenExr;
    Ok(Raw::of_channels(format!("{name} of {bits} bits"), size, channels, is_biased))
}

/// A png of vectors, biased: `(c + 1) / 2` of each component c, and alpha where there is one, in 8 or 16 bits.
///
/// # Errors
/// [`Error::Output`].
pub fn write(map: &NormalMap, bits: u32) -> Result<Vec<u8>> {
    let alpha = |at: usize| map.alpha.as_ref().map_or(1.0, |alpha| alpha[at]);
    let biased = |(at, [x, y, z]): (usize, &[f32; 3])| {
        let [x, y, z] = [x, y, z].map(|c| (f64::from(*c) * 0.5 + 0.5) as f32);
        [x, y, z, alpha(at)]
    };
    let texels = map.vectors.iter().enumerate().flat_map(biased).collect();
    let image = Rgba32FImage::from_raw(map.width, map.height, texels).map(DynamicImage::from);
    png(image.map(|image| match (bits, map.alpha.is_some()) {
        (8, false) => image.into_rgb8().into(),
        (8, true) => image.into_rgba8().into(),
        (_, false) => image.into_rgb16().into(),
        (_, true) => image.into_rgba16().into(),
    }))
}

/// A png of errors from black over red and yellow to white, which stands for the greatest.
///
/// # Errors
/// [`Error::Output`].
pub fn heat(width: u32, height: u32, errors: &[f64]) -> Result<Vec<u8>> {
    let most = errors.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let color = |error: &f64| [0.0, 1.0, 2.0].map(|dark| ((error / most * 3.0 - dark) * 255.0).round() as u8);
    let texels = errors.iter().flat_map(color).collect();
    png(RgbImage::from_raw(width, height, texels).map(DynamicImage::from))
}

/// A gray png of the [roughness](Level::roughness) of levels, each to the right of the one before it.
///
/// # Errors
/// [`Error::Output`].
pub fn strip(levels: &[Level]) -> Result<Vec<u8>> {
    let widths = levels.iter().map(|level| level.map.width);
    let height = levels.iter().map(|level| level.map.height).max();
    let (mut image, mut left) = (GrayImage::new(widths.sum(), height.unwrap_or(0)), 0);
    for level in levels {
        let width = level.map.width;
        for (at, roughness) in (0..).zip(level.roughness()) {
            image.put_pixel(left + at % width, at / width, Luma([(roughness * 255.0).round() as u8]));
        }
        left += width;
    }
    png(Some(image.into()))
}

fn png(image: Option<DynamicImage>) -> Result<Vec<u8>> {
    let failed = |reason: String| Error::Output { format: "png", reason };
    let image = image.ok_or_else(|| failed("its size is not that of its texels".to_owned()))?;
    let mut bytes = Cursor::new(Vec::new());
    let written = image.write_to(&mut bytes, ImageFormat::Png);
    written.map_err(|error| failed(unitvec_files::one_line(error)))?;
    Ok(bytes.into_inner())
}
