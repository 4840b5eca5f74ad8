//! The `vn` lines of OBJ files.

use super::{Edited, Moved, Splice, no_normals, shortest, span};
use crate::MeshError;
use crate::obj::{Line, lines};
use std::path::Path;

/// Moves the numbers of the `vn` lines; those that stay keep their text.
pub(super) fn edit(
    path: &Path,
    bytes: &[u8],
    change: &mut dyn FnMut(&mut [[f32; 3]]),
) -> Result<Edited, MeshError> {
    let normals = || lines(bytes).filter(|line: &Line| line.keyword == b"vn");
    if normals().next().is_none() {
        return Err(no_normals(path));
    }
    let write = |value, _| shortest(value).into_bytes();
    let mut moved = Moved { splice: Splice::new(path, bytes)?, change, write: &write, waiting: Vec::new() };
    for line in normals() {
        let mut places = line.words().map(|word| span(bytes, word).unwrap_or_default());
        moved.push([(); 3].map(|()| places.next().unwrap_or_default()), line.vector(path)?);
    }
    Ok(moved.finish())
}
