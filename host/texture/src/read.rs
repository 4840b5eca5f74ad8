//! Files to maps.

use crate::format::Numbers;
use crate::picture::Raw;
use crate::{Coding, Error, NormalMap, Result, Texture, dds, ktx2, length, picture};
use image::ImageFormat;
use std::path::Path;
use unitvec_catalogue::{AnyCodec, find_vector};

/// Lengths below this, and beyond [`GREATEST`] of biased channels, are those of texels that nothing was baked to: grey, black,
/// white. Rounding to 8 bits changes the length of a unit vector by less than a hundredth.
const LEAST: f64 = 0.05;

/// The length of a corner of the cube is the root of 3.
const GREATEST: f64 = 1.7;

const UNKNOWN: &str = "is no png, jpeg, tga, exr, ktx2 or dds; save it as one of these";

/// A map, and the facts of its file.
#[derive(Clone, Debug)]
pub struct Source {
    /// The map, of unit vectors.
    pub map: NormalMap,
    /// The file's format: `png of 8 bits`, `ktx2 of R8G8_SNORM`.
    pub format: String,
    /// The codec of its texels; `None` for components.
    pub codec: Option<&'static AnyCodec>,
    /// The direction of y, `up` or `down`, where the file tells it.
    pub y: Option<String>,
    /// Texels without a direction, which became +Z.
    pub filled: u64,
    /// The least and the greatest length of the others before they were normalised; `None` for codes of unit vectors.
    pub lengths: Option<[f64; 2]>,
}

/// The kinds of files: their first bytes, or "" where the ending has to do, and their names.
const KINDS: [(&[u8], &str); 6] = [
    (b"\x89PNG\r\n\x1a\n", "png"),
    (b"\x76\x2f\x31\x01", "exr"),
    (b"\xff\xd8\xff", "jpeg"),
    (&::ktx2::MAGIC, "ktx2"),
    (b"DDS ", "dds"),
    (b"", "tga"),
];

/// The kind of a file that [`read`] takes, by its first bytes and its ending.
pub fn kind(path: &Path, head: &[u8]) -> Option<&'static str> {
    let ending = path.extension().unwrap_or_default();
    let kind = KINDS.iter().find(|(magic, name)| match magic {
        [] => ending.eq_ignore_ascii_case(name),
        magic => head.starts_with(magic),
    });
    kind.map(|(_, name)| *name)
}

/// True where the name ends as those of files that [`read`] takes.
pub fn has_ending(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    KINDS.iter().map(|(_, name)| *name).chain(["jpg"]).any(|name| ending.eq_ignore_ascii_case(name))
}

/// Reads a map from the bytes of a file. Its texels are codes of `codec`; or, if that is not given, of the codec that the file
/// names; or components. Components are normalised. Those of integers are biased, but for SNORM; sRGB formats are refused.
///
/// # Errors
/// Errors of a damaged file, of a format that is unknown, and of a codec that the format cannot hold.
pub fn read(path: &Path, bytes: &[u8], codec: Option<&'static AnyCodec>) -> Result<Source> {
    let kind = kind(path, bytes).ok_or_else(|| Error::unsupported(path, UNKNOWN))?;
    let picture = |format| picture::read(path, bytes, format, kind).map(|raw| normalised(raw, None, None));
    match (kind, codec) {
        ("ktx2", _) => of_texture(path, kind, ktx2::read(path, bytes)?, codec),
        ("dds", _) => of_texture(path, kind, dds::read(path, bytes)?, codec),
        (_, Some(codec)) => {
            let words = format!("is a {kind}, which holds no codes of {}; leave --from out", codec.id);
            Err(Error::unsupported(path, words))
        }
        ("png", None) => picture(ImageFormat::Png),
        ("exr", None) => picture(ImageFormat::OpenExr),
        ("jpeg", None) => picture(ImageFormat::Jpeg),
        _ => picture(ImageFormat::Tga),
    }
}

fn of_texture(path: &Path, kind: &str, texture: Texture, codec: Option<&'static AnyCodec>) -> Result<Source> {
    let Texture { format, width, height, levels, y, codec: named } = texture;
    let codec = codec.or_else(|| find_vector(&named?).ok());
    let (name, texels) = (format!("{kind} of {}", format.name()), levels.concat());
    let raw = match codec.map(|codec| (codec, Coding::reading(codec, format))) {
        Some((_, Some(coding))) => {
            let map = coding.unpack(&texels, width, height);
            Raw { format: name, map, is_biased: false }
        }
        Some((codec, None)) => {
            let own = Coding::of(codec, false).map(|coding| coding.format.name()).unwrap_or_default();
            let words =
                format!("is a {name}, and {} lies in {own}; name another codec with --from", codec.id);
            return Err(Error::unsupported(path, words));
        }
        None if !format.has_components() => {
            let words = format!("is a {name}, and names no codec; say which with --from, such as xyonly16");
            return Err(Error::unsupported(path, words));
        }
        None => {
            let texels = texels.chunks_exact(format.bytes()).map(|texel| format.channels(texel));
            let is_biased = format.numbers == Numbers::Unorm;
            Raw::of_channels(name, [width, height], texels, is_biased)
        }
    };
    Ok(normalised(raw, codec, y))
}

/// Normalises the vectors of a map; those that a codec of unit vectors decoded keep their bits.
fn normalised(raw: Raw, codec: Option<&'static AnyCodec>, y: Option<String>) -> Source {
    let Raw { format, mut map, is_biased } = raw;
    let (mut filled, mut lengths) = (0, None);
    let is_unit = codec.is_some_and(|codec| codec.is_unit);
    for vector in map.vectors.iter_mut().filter(|_| !is_unit) {
        let length = length(vector);
        if !(length >= LEAST && length.is_finite()) || is_biased && length > GREATEST {
            filled += 1;
            *vector = [0.0, 0.0, 1.0];
        } else {
            let [least, most] = lengths.unwrap_or([length; 2]);
            lengths = Some([length.min(least), length.max(most)]);
            *vector = vector.map(|c| (f64::from(c) / length) as f32);
        }
    }
    Source { map, format, codec, y, filled, lengths }
}
