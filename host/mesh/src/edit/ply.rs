//! The properties `nx ny nz` of PLY files.

use super::{ChangeVectors, Edited, Normals, Splice, no_normals, not_movable, shortest, span};
use crate::MeshError;
use crate::ply::{Payload, Source, Vertex, check_counts, size};
use ply_rs_bw::ply::{ElementDef, Encoding, PropertyType, ScalarType};
use std::ops::Range;
use std::path::Path;

const NAMES: [&str; 3] = ["nx", "ny", "nz"];

/// Moves the normals of the vertices, in text or in bytes of either order.
pub(super) fn edit<'c>(
    path: &Path,
    bytes: &[u8],
    change: &'c mut ChangeVectors<'c>,
) -> Result<Edited, MeshError> {
    let (header, mut payload) = Payload::after_header(path, bytes)?;
    check_counts(path, &header, bytes.len())?;
    if Source::of(&header) != Some(Source::Normals) {
        return Err(no_normals(path));
    }
    let encoding = header.encoding;
    let write = |value, size| number(encoding, value, size);
    let mut moved = Normals { splice: Splice::new(path, bytes)?, change, write: &write, waiting: Vec::new() };
    for (name, element) in &header.elements {
        if name != "vertex" {
            payload.skip(element)?;
            continue;
        }
        check_floats(path, element)?;
        for _ in 0..element.count {
            let before = payload.rest;
            let Vertex { normal, .. } = payload.next(element)?;
            let row = &before[..before.len() - payload.rest.len()];
            let places = span(bytes, row).zip(places(encoding, element, row));
            let (row, places) = places.ok_or_else(|| payload.error("a vertex has no normal".into()))?;
            moved.push(places.map(|place| row.start + place.start..row.start + place.end), normal);
        }
    }
    Ok(moved.finish())
}

fn check_floats(path: &Path, element: &ElementDef) -> Result<(), MeshError> {
    let is_float = |name: &&str| {
        let kind = element.properties.get(*name).map(|property| &property.data_type);
        matches!(kind, Some(PropertyType::Scalar(ScalarType::Float | ScalarType::Double)))
    };
    match NAMES.iter().all(is_float) {
        true => Ok(()),
        false => {
            let reason = "its normals are integers, quantised already".into();
            Err(not_movable(path, reason, "take the mesh before it is quantised"))
        }
    }
}

/// The places of the normal's components in a vertex.
fn places(encoding: Encoding, element: &ElementDef, row: &[u8]) -> Option<[Range<usize>; 3]> {
    let (mut places, mut at) = ([const { 0..0 }; 3], 0);
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
                if let Some(axis) = NAMES.iter().position(|axis| axis == name) {
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
