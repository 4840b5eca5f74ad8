//! Pictures: png, tga and exr read, png written.

use crate::{Error, NormalMap, Result};
use image::{DynamicImage, ImageBuffer, ImageDecoder, ImageFormat, ImageReader, Luma, Rgb, Rgba};
use std::io::Cursor;
use std::path::Path;

/// The most bytes of an image that a byte of its file stands for. Deflate, the closest of the compressions, has 1032
/// (zlib, Technical Details).
const CLOSEST: u64 = 1032;

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
    let damaged = |error: &dyn std::fmt::Display| Error::damaged(path, name, error);
    let decoder = ImageReader::with_format(Cursor::new(bytes), format).into_decoder();
    let decoder = decoder.map_err(|error| damaged(&error))?;
    if !(1..=CLOSEST * bytes.len() as u64).contains(&decoder.total_bytes()) {
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

/// A png of vectors, biased: the integer nearest to `(c + 1) / 2` of the greatest, of 8 or 16 bits, for each component c; alpha
/// where there is one.
///
/// # Errors
/// [`Error::Png`].
pub fn write(map: &NormalMap, bits: u32) -> Result<Vec<u8>> {
    let most = f64::from((1u32 << bits) - 1);
    let to = |number: f64| (number.clamp(0.0, 1.0) * most).round() as u16;
    let biased = |component: &f32| to(f64::from(*component) * 0.5 + 0.5);
    let colors = map.vectors.iter().map(|v| v.each_ref().map(biased));
    let texels: Vec<u16> = match &map.alpha {
        Some(alpha) => {
            colors.zip(alpha).flat_map(|([x, y, z], alpha)| [x, y, z, to((*alpha).into())]).collect()
        }
        None => colors.flatten().collect(),
    };
    let (width, height) = (map.width, map.height);
    let image = match (bits, map.alpha.is_some()) {
        (8, is_alpha) => {
            let texels = texels.into_iter().map(|number| number as u8).collect();
            match is_alpha {
                true => ImageBuffer::<Rgba<u8>, _>::from_raw(width, height, texels).map(DynamicImage::from),
                false => ImageBuffer::<Rgb<u8>, _>::from_raw(width, height, texels).map(DynamicImage::from),
            }
        }
        (_, true) => ImageBuffer::<Rgba<u16>, _>::from_raw(width, height, texels).map(DynamicImage::from),
        (_, false) => ImageBuffer::<Rgb<u16>, _>::from_raw(width, height, texels).map(DynamicImage::from),
    };
    png(image)
}

/// A png of errors from black over red and yellow to white, which stands for the greatest.
///
/// # Errors
/// [`Error::Png`].
pub fn heat(width: u32, height: u32, errors: &[f64]) -> Result<Vec<u8>> {
    let most = errors.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let color = |error: &f64| [0.0, 1.0, 2.0].map(|dark| ((error / most * 3.0 - dark) * 255.0).round() as u8);
    let texels = errors.iter().flat_map(color).collect();
    png(ImageBuffer::<Rgb<u8>, _>::from_raw(width, height, texels).map(DynamicImage::from))
}

/// A gray png of the levels of numbers of 0 to 1, each to the right of the one before it.
///
/// # Errors
/// [`Error::Png`].
pub fn strip(levels: &[(u32, u32, Vec<f32>)]) -> Result<Vec<u8>> {
    let (width, height) = levels.iter().fold((0, 0), |(sum, most), (w, h, _)| (sum + w, most.max(*h)));
    let mut image = ImageBuffer::<Luma<u8>, Vec<u8>>::new(width, height);
    let mut left = 0;
    for (width, _, numbers) in levels {
        for (at, number) in (0..).zip(numbers) {
            image.put_pixel(left + at % width, at / width, Luma([(number * 255.0).round() as u8]));
        }
        left += width;
    }
    png(Some(image.into()))
}

fn png(image: Option<DynamicImage>) -> Result<Vec<u8>> {
    let failed = |reason: String| Error::Png { reason };
    let image = image.ok_or_else(|| failed("its size is not that of its texels".to_owned()))?;
    let mut bytes = Cursor::new(Vec::new());
    let written = image.write_to(&mut bytes, ImageFormat::Png);
    written.map_err(|error| failed(unitvec_files::one_line(error)))?;
    Ok(bytes.into_inner())
}
