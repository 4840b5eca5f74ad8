//! Buffers of glTF files, each file once.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::{BTreeSet, HashMap};
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use ::gltf::json;
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;
use unitvec_files::{one_line, read_start};

use crate::{MeshError, Reach};

/// The contents of a buffer, which may be those of others as well.
pub(crate) type Content<'p> = Rc<Cow<'p, [u8]>>;

/// The contents of the buffers that are `used`, and their bytes outside of the file; the others are empty. URIs, which may
/// be contents themselves, are taken out of all.
pub(super) fn read<'p>(
    path: &Path,
    buffers: &mut [json::Buffer],
    used: &BTreeSet<usize>,
    blob: Option<Cow<'p, [u8]>>,
    reach: Reach,
) -> Result<(Vec<Content<'p>>, usize), MeshError> {
    let mut contents = vec![Content::default(); buffers.len()];
    let uris: Vec<_> = buffers.iter_mut().map(|buffer| buffer.uri.take()).collect();
    let (mut files, mut outside) = (HashMap::<PathBuf, Content>::new(), 0);
    let mut read = |buffer: usize, length: u64| -> Result<Content<'p>, String> {
        let Some(uri) = uris[buffer].as_deref() else {
            // The chunk is that of the first buffer.
            let blob = blob.clone().filter(|_| buffer == 0).ok_or("it has neither a URI nor a BIN chunk")?;
            return Ok(Rc::new(blob));
        };
        let (place, bytes) = match uri.strip_prefix("data:") {
            Some(data) => (None, decode_data(data)?),
            None => {
                let file = file_of(path, uri, reach)?;
                let place = file.canonicalize().unwrap_or_else(|_| file.clone());
                if let Some(content) = files.get(&place) {
                    return Ok(content.clone());
                }
                (Some(place), read_file(&file, length)?)
            }
        };
        outside += bytes.len();
        let content = Content::new(bytes.into());
        files.extend(place.map(|place| (place, content.clone())));
        Ok(content)
    };
    // The longest first: of a file that several buffers name, it has all bytes that the others want.
    let mut order: Vec<usize> = used.iter().copied().filter(|at| *at < contents.len()).collect();
    order.sort_by_key(|at| Reverse(buffers[*at].byte_length.0));
    for buffer in order {
        let length = buffers[buffer].byte_length.0;
        let content = read(buffer, length).and_then(|content| match (content.len() as u64) < length {
            true => Err(format!("it has {} of its {length} bytes", content.len())),
            false => Ok(content),
        });
        contents[buffer] = content.map_err(|reason| MeshError::MissingBuffer {
            path: path.into(),
            buffer,
            reason: one_line(reason),
        })?;
    }
    Ok((contents, outside))
}

/// The file of a URI, which lies in the folder of `path` or below it, unless `reach` says otherwise. Links are followed:
/// whoever made them wants that.
pub(crate) fn file_of(path: &Path, uri: &str, reach: Reach) -> Result<PathBuf, String> {
    let name = percent_decode_str(uri).decode_utf8_lossy();
    let is_within = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    let is_below = |part| is_within(part) || (part == Component::ParentDir && reach == Reach::Anywhere);
    if uri.contains(':') || Path::new(name.as_ref()).has_root() {
        return Err("its URI is neither a relative file name nor base64 data".into());
    }
    if !Path::new(name.as_ref()).components().all(is_below) {
        return Err(format!("{name} leaves the folder of the file; --buffers-anywhere allows that"));
    }
    if path == Path::new("-") || path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        return Err(format!("it lies in {name}, and the standard input has no folder; name the .gltf file"));
    }
    Ok(path.with_file_name(name.as_ref()))
}

/// The first bytes of a file, or why they cannot be had.
pub(super) fn read_file(file: &Path, length: u64) -> Result<Vec<u8>, String> {
    read_start(file, length).map_err(|error| format!("cannot read {}: {error}", file.display()))
}

pub(super) fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    // Exporters differ over the padding.
    const LENIENT: GeneralPurposeConfig =
        GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
    let (_, encoded) = data.split_once(";base64,").ok_or("its data URI is not in base64")?;
    let engine = GeneralPurpose::new(&alphabet::STANDARD, LENIENT);
    engine.decode(encoded).map_err(|error| format!("its data URI is not in base64: {error}"))
}
