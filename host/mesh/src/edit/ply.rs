//! The properties `nx ny nz` of PLY files, and those of the rotations of splats.

use super::{Edited, Moved, Splice, no_normals, no_splats, not_movable, shortest, span};
use crate::MeshError;
use crate::ply::{NORMAL, Payload, ROTATION, Vertex, check_counts, has_scalars, size};
use ply_rs_bw::ply::{ElementDef, Encoding, PropertyType, ScalarType};
use std::ops::Range;
use std::path::Path;

/// Moves the normals of the vertices, in text or in bytes of either order.
pub(super) fn edit_normals(
    path: &Path,
    bytes: &[u8],
    change: &mut dyn FnMut(&mut [[f32; 3]]),
) -> Result<Edited, MeshError> {
    edit(path, bytes, NORMAL, |vertex| vertex.normal, no_normals, change)
}

/// Moves the rotations of splats, as [`edit_normals`] does normals.
pub(super) fn edit_rotations(
    path: &Path,
    bytes: &[u8],
    change: &mut dyn FnMut(&mut [[f32; 4]]),
) -> Result<Edited, MeshError> {
    edit(path, bytes, ROTATION, |vertex| vertex.rotation, no_splats, change)
}

/// Moves the vectors of these properties; a file without them gets the error.
fn edit<const N: usize>(
    path: &Path,
    bytes: &[u8],
    names: [&str; N],
    vector: fn(Vertex) -> [f32; N],
    without: fn(&Path) -> MeshError,
    change: &mut dyn FnMut(&mut [[f32; N]]),
) -> Result<Edited, MeshError> {
    let (header, mut payload) = Payload::after_header(path, bytes)?;
    check_counts(path, &header, bytes.len())?;
    if !header.elements.get("vertex").is_some_and(|vertex| has_scalars(vertex, &names)) {
        return Err(without(path));
    }
    let encoding = header.encoding;
    let write = |value, size| number(encoding, value, size);
    let mut moved = Moved { splice: Splice::new(path, bytes)?, change, write: &write, waiting: Vec::new() };
    for (name, element) in &header.elements {
        if name != "vertex" {
            payload.skip(element)?;
            continue;
        }
        check_floats(path, element, &names)?;
        for _ in 0..element.count {
            let before = payload.rest;
            let vertex = payload.next(element)?;
            let row = &before[..before.len() - payload.rest.len()];
            let places = span(bytes, row).zip(places(encoding, element, names, row));
            let (row, places) = places.ok_or_else(|| payload.error("a vertex ends too early".into()))?;
            moved.push(places.map(|place| row.start + place.start..row.start + place.end), vector(vertex));
        }
    }
    Ok(moved.finish())
}

fn check_floats(path: &Path, element: &ElementDef, names: &[&str]) -> Result<(), MeshError> {
    let is_float = |name: &&str| {
        let kind = element.properties.get(*name).map(|property| &property.data_type);
        matches!(kind, Some(PropertyType::Scalar(ScalarType::Float | ScalarType::Double)))
    };
    match names.iter().all(is_float) {
        true => Ok(()),
        false => {
            let reason = format!("{} are integers, quantised already", names.join(", "));
            Err(not_movable(path, reason, "take the file before it is quantised"))
        }
    }
}

/// The places of a vector's components in a vertex.
fn places<const N: usize>(
    encoding: Encoding,
    element: &ElementDef,
    names: [&str; N],
    row: &[u8],
) -> Option<[Range<usize>; N]> {
    let (mut places, mut at) = ([const { 0..0 }; N], 0);
    let mut next = |kind: &ScalarType| {
        let place = match encoding {
            Encoding::Ascii => word(row, at)?,
            _ => at..at.checked_add(size(kind))?,
        };
        at = place.end;
        row.get(place.clone()).map(|value| (place, value))
    };
    for (name, property) in &element.properties {
        match &property.data_type {
            PropertyType::Scalar(kind) => {
                let (place, _) = next(kind)?;
                if let Some(axis) = names.iter().position(|axis| axis == name) {
                    places[axis] = place;
                }
            }
            PropertyType::List(count, kind) => {
                let (_, value) = next(count)?;
                for _ in 0..length(encoding, value)? {
                    next(kind)?;
                }
            }
        }
    }
    Some(places)
}

/// The place of the next word of a line.
fn word(line: &[u8], at: usize) -> Option<Range<usize>> {
    let start = at + line.get(at..)?.iter().position(|byte| !byte.is_ascii_whitespace())?;
    let length = line[start..].iter().position(u8::is_ascii_whitespace).unwrap_or(line.len() - start);
    Some(start..start + length)
}

/// The length of a list. The parser has refused those below zero.
fn length(encoding: Encoding, value: &[u8]) -> Option<usize> {
    let sum = |sum, byte: &u8| sum << 8 | usize::from(*byte);
    match encoding {
        Encoding::Ascii => std::str::from_utf8(value).ok()?.parse().ok(),
        Encoding::BinaryBigEndian => Some(value.iter().fold(0, sum)),
        Encoding::BinaryLittleEndian => Some(value.iter().rev().fold(0, sum)),
    }
}

/// A number as text, or as a float or double of this size.
fn number(encoding: Encoding, value: f32, size: usize) -> Vec<u8> {
    let double = f64::from(value);
    match (encoding, size) {
        (Encoding::Ascii, _) => shortest(value).into_bytes(),
        (Encoding::BinaryBigEndian, 8) => double.to_be_bytes().into(),
        (Encoding::BinaryBigEndian, _) => value.to_be_bytes().into(),
        (Encoding::BinaryLittleEndian, 8) => double.to_le_bytes().into(),
        (Encoding::BinaryLittleEndian, _) => value.to_le_bytes().into(),
    }
}
