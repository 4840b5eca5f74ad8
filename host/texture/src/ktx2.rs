//! KTX 2.0 files (Khronos, KTX File Format Specification 2.0): without supercompression, one layer, one face.

use crate::format::FORMATS;
use crate::{Error, Result, Texture};
use ktx2::dfd::{Basic, Block};
use ktx2::{Header, Index, KeyValueDataIterator, LevelIndex};
use std::path::Path;

/// The key of the codec's identifier. Values are text, ended by a zero, as KTX's own are.
const CODEC: &str = "unitvecCodec";

/// The key of the direction of y: `up` or `down`.
const Y: &str = "unitvecY";

/// Reads the first level of a texture.
///
/// # Errors
/// [`Error::Damaged`], and [`Error::Unsupported`] for arrays, cubes, volumes, supercompression and other formats.
pub fn read(path: &Path, bytes: &[u8]) -> Result<Texture> {
    let damaged = |reason: &str| Error::damaged(path, "ktx2", reason);
    let part = |from: u64, length: u64| {
        let end = usize::try_from(from.checked_add(length)?).ok()?;
        bytes.get(usize::try_from(from).ok()?..end)
    };
    // The crate's whole reader panics at descriptors of blocks 256 texels wide. With a Vulkan format none is needed.
    let head = bytes.first_chunk().ok_or_else(|| damaged("it ends within its header"))?;
    let header = Header::from_bytes(head).map_err(|error| Error::damaged(path, "ktx2", error))?;
    if header.supercompression_scheme.is_some() {
        let words = "is supercompressed; write it without, as `ktx deflate` and Basis Universal do not";
        return Err(Error::unsupported(path, words));
    }
    let (width, height) = (header.pixel_width, header.pixel_height);
    if header.pixel_depth > 1 || header.layer_count > 1 || header.face_count > 1 || height == 0 {
        return Err(Error::unsupported(path, "is an array, a cube or no plane; extract one image of it"));
    }
    let format = FORMATS.iter().find(|format| Some(format.vulkan) == header.format).ok_or_else(|| {
        let name =
            header.format.map_or_else(|| "no Vulkan format".to_owned(), |format| format!("{format:?}"));
        Error::unsupported(path, format!("has {name}; save it in R8G8B8A8_UNORM, for example"))
    })?;
    let entry = part(Header::LENGTH as u64, LevelIndex::LENGTH as u64).and_then(<[u8]>::first_chunk);
    let entry = LevelIndex::from_bytes(entry.ok_or_else(|| damaged("it has no levels"))?);
    let level = part(entry.byte_offset, entry.byte_length)
        .filter(|level| format.bytes_of(width, height) == Some(level.len()))
        .ok_or_else(|| {
            damaged("its first level is not as long as its size asks for, or lies beyond its end")
        })?;
    let values = part(header.index.kvd_byte_offset.into(), header.index.kvd_byte_length.into());
    let value = |name: &str| {
        let mut pairs = KeyValueDataIterator::new(values.unwrap_or_default());
        let (_, value) = pairs.find(|(key, _)| *key == name)?;
        Some(std::str::from_utf8(value).ok()?.trim_end_matches('\0').to_owned())
    };
    let (codec, y) = (value(CODEC), value(Y));
    Ok(Texture { format, width, height, levels: vec![level.to_vec()], codec, y })
}

/// The file of a texture.
pub fn write(texture: &Texture) -> Vec<u8> {
    let (descriptor, type_size) = descriptor(texture);
    let values = values(texture);
    let dfd_byte_offset = Header::LENGTH + LevelIndex::LENGTH * texture.levels.len();
    let kvd_byte_offset = dfd_byte_offset + descriptor.len();
    let header = Header {
        format: Some(texture.format.vulkan),
        type_size,
        pixel_width: texture.width,
        pixel_height: texture.height,
        pixel_depth: 0,
        layer_count: 0,
        face_count: 1,
        level_count: texture.levels.len() as u32,
        supercompression_scheme: None,
        index: Index {
            dfd_byte_offset: dfd_byte_offset as u32,
            dfd_byte_length: descriptor.len() as u32,
            kvd_byte_offset: kvd_byte_offset as u32,
            kvd_byte_length: values.len() as u32,
            sgd_byte_offset: 0,
            sgd_byte_length: 0,
        },
    };
    let mut levels = Vec::new();
    let mut index = vec![Vec::new(); texture.levels.len()];
    // The smallest level comes first, each at a multiple of 4 bytes and of a texel (section 3.9.7).
    let start = kvd_byte_offset + values.len();
    for (level, entry) in texture.levels.iter().zip(&mut index).rev() {
        let at = (start + levels.len()).next_multiple_of(texture.format.bytes().max(4));
        levels.resize(at - start, 0);
        let length = level.len() as u64;
        let place =
            LevelIndex { byte_offset: at as u64, byte_length: length, uncompressed_byte_length: length };
        *entry = place.as_bytes().to_vec();
        levels.extend(level);
    }
    [&header.as_bytes()[..], &index.concat(), &descriptor, &values, &levels].concat()
}

/// The data format descriptor with its length, and the size of the type that a big-endian reader turns round.
fn descriptor(texture: &Texture) -> (Vec<u8>, u32) {
    let Ok((basic, type_size)) = Basic::from_format(texture.format.vulkan) else {
        unreachable!("a test makes the descriptor of each of the formats")
    };
    let block = Block::Basic(basic).to_vec();
    ([&(block.len() as u32 + 4).to_le_bytes()[..], &block].concat(), type_size)
}

/// Keys and values, in the order of the keys, each padded to 4 bytes.
fn values(texture: &Texture) -> Vec<u8> {
    let writer = Some(concat!("unitvec ", env!("CARGO_PKG_VERSION")).to_owned());
    let pairs = [
        ("KTXorientation", Some("rd".to_owned())),
        ("KTXwriter", writer),
        (CODEC, texture.codec.clone()),
        (Y, texture.y.clone()),
    ];
    let mut bytes = Vec::new();
    for (key, value) in pairs.into_iter().filter_map(|(key, value)| Some((key, value?))) {
        let pair = format!("{key}\0{value}\0");
        bytes.extend((pair.len() as u32).to_le_bytes());
        bytes.extend(pair.bytes());
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}
