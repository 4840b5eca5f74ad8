//! The header of a PLY file, and the elements below it, one at a time.

use std::path::Path;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, PropertyAccess, PropertyType, ScalarType};

use super::{FORMAT, INDICES, Skipped};
use crate::{MeshError, parse_error};

/// The longest header: the parser takes many times its size. Those of scanners and of Gaussian splats have some kB.
const MAX_HEADER: usize = 1 << 15;

/// The longest line of an ASCII file: the parser takes many times its size.
const MAX_LINE: usize = 1 << 20;

/// The data below the header, as far as it is not read.
#[derive(Clone)]
pub(crate) struct Payload<'b> {
    pub(super) path: &'b Path,
    pub(crate) encoding: Encoding,
    pub(crate) rest: &'b [u8],
    /// The line in an ASCII file, counted from 1.
    line: usize,
    /// The last byte of lines.
    line_end: u8,
}

impl<'b> Payload<'b> {
    pub(crate) fn after_header(path: &'b Path, bytes: &'b [u8]) -> Result<(Header, Self), MeshError> {
        const END: &[u8] = b"\nend_header\n";
        let head = &bytes[..bytes.len().min(MAX_HEADER)];
        // Old Macs, and Rhinoceros, end lines in `\r` alone.
        let line_end = match head.iter().position(|byte| b"\r\n".contains(byte)) {
            Some(at) if head[at] == b'\r' && head.get(at + 1) != Some(&b'\n') => b'\r',
            _ => b'\n',
        };
        let (mut text, mut length, mut line) = (Vec::new(), 0, 1);
        for row in head.split_inclusive(|byte| *byte == line_end) {
            (length, line) = (length + row.len(), line + 1);
            push_line(&mut text, row);
            if text.ends_with(END) {
                break;
            }
        }
        if head.len() < bytes.len() && !text.ends_with(END) {
            return Err(parse_error(path, FORMAT, format!("no header of up to {MAX_HEADER} bytes")));
        }
        let header = Parser::<Skipped>::new().read_header(&mut Reader::new(&text[..]));
        let header = header.map_err(|error| parse_error(path, FORMAT, error))?;
        check_names(path, &text, &header)?;
        let rest = &bytes[length..];
        let encoding = header.encoding;
        Ok((header, Self { path, encoding, rest, line, line_end }))
    }

    pub(crate) fn next<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<E, MeshError> {
        let parser = Parser::new();
        let read = match self.encoding {
            Encoding::Ascii => return self.next_line(element),
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut self.rest, element),
            Encoding::BinaryLittleEndian => parser.read_little_endian_element(&mut self.rest, element),
        };
        read.map_err(|error| self.error(format!("element {}: {error}", element.name)))
    }

    fn next_line<E: PropertyAccess>(&mut self, element: &ElementDef) -> Result<E, MeshError> {
        let ElementDef { name, .. } = element;
        let end = self.rest.iter().take(MAX_LINE).position(|byte| *byte == self.line_end).map(|end| end + 1);
        let line = match end.or_else(|| (self.rest.len() <= MAX_LINE).then_some(self.rest.len())) {
            None => Err(format!("it has more than {MAX_LINE} bytes")),
            Some(0) => Err("the file ends before it".to_owned()),
            Some(end) => std::str::from_utf8(&self.rest[..end]).map_err(|error| error.to_string()),
        };
        let read = line.and_then(|line| {
            self.rest = &self.rest[line.len()..];
            Parser::new().read_ascii_element(line, element).map_err(|error| error.to_string())
        });
        let read =
            read.map_err(|reason| self.error(format!("line {}, of element {name}: {reason}", self.line)));
        self.line += 1;
        read
    }

    pub(crate) fn skip(&mut self, element: &ElementDef) -> Result<(), MeshError> {
        if self.encoding != Encoding::Ascii && element.properties.is_empty() {
            return Ok(());
        }
        (0..element.count).try_for_each(|_| self.next::<Skipped>(element).map(drop))
    }

    pub(crate) fn error(&self, reason: String) -> MeshError {
        parse_error(self.path, FORMAT, reason)
    }
}

/// Adds a line of a header as the parser takes it: a space between words, and no comment, which may have any encoding.
fn push_line(text: &mut Vec<u8>, line: &[u8]) {
    let words: Vec<_> = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
    match words.first() {
        Some(&b"comment" | &b"obj_info") => text.extend(b"comment -"),
        _ => text.extend(words.join(&b' ')),
    }
    text.push(b'\n');
}

/// Refuses names that are there twice, since the parser drops all but one of the same name.
fn check_names(path: &Path, head: &[u8], header: &Header) -> Result<(), MeshError> {
    let lines = head.split(|byte| *byte == b'\n');
    let lines = lines.take_while(|line| *line != b"end_header");
    let told = lines.filter(|line| line.starts_with(b"element ") || line.starts_with(b"property ")).count();
    let of = |element: &ElementDef| 1 + element.properties.len();
    let lists =
        |element: &ElementDef| INDICES.iter().filter(|name| element.properties.contains_key(**name)).count();
    match told > header.elements.values().map(of).sum() || header.elements.values().any(|one| lists(one) > 1)
    {
        true => {
            Err(parse_error(path, FORMAT, "two of its elements, or properties of one, have the same name"))
        }
        false => Ok(()),
    }
}

/// Refuses counts that the file cannot hold together, before memory and time are taken for them.
pub(crate) fn check_counts(path: &Path, header: &Header, bytes: usize) -> Result<(), MeshError> {
    let mut all = 0_usize;
    for ElementDef { name, count, properties, .. } in header.elements.values() {
        let least = properties.values().map(|p| least_bytes(header.encoding, &p.data_type)).sum::<usize>();
        // In text an element without properties takes a line.
        let least = least.max(usize::from(header.encoding == Encoding::Ascii));
        all = all.saturating_add(count.saturating_mul(least));
        if all > bytes {
            return Err(parse_error(
                path,
                FORMAT,
                format!("{count} elements {name} in a file of {bytes} bytes"),
            ));
        }
    }
    Ok(())
}

/// The fewest bytes that a property takes. In text those are a digit and a space.
fn least_bytes(encoding: Encoding, property: &PropertyType) -> usize {
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = property;
    if encoding == Encoding::Ascii { 2 } else { size(scalar) }
}

/// The bytes of a number in binary files.
pub(crate) fn size(scalar: &ScalarType) -> usize {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}
