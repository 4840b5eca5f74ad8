//! Raw floats of any kind, and NumPy's arrays: read as little-endian f32.

use std::fmt::{self, Write as _};
use std::io::{self, Read};
use std::str::FromStr;
use unitvec_catalogue::Element;

/// A kind of raw floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dtype {
    /// Bytes of a float.
    pub bytes: usize,
    is_big_endian: bool,
}

/// The kinds of raw floats, with their names on the command line and in NumPy's arrays.
pub const DTYPES: [(&str, &str, Dtype); 6] = [
    ("f32", "<f4", Dtype { bytes: 4, is_big_endian: false }),
    ("f64", "<f8", Dtype { bytes: 8, is_big_endian: false }),
    ("f16", "<f2", Dtype { bytes: 2, is_big_endian: false }),
    ("f32be", ">f4", Dtype { bytes: 4, is_big_endian: true }),
    ("f64be", ">f8", Dtype { bytes: 8, is_big_endian: true }),
    ("f16be", ">f2", Dtype { bytes: 2, is_big_endian: true }),
];

impl Dtype {
    /// Little-endian f32, as which everything is read.
    pub const F32: Self = DTYPES[0].2;

    /// The nearest f32 to a stored float: infinite where an f64 is beyond its range.
    fn to_f32(self, stored: &[u8]) -> f32 {
        let mut bytes = [0; 8];
        bytes[..self.bytes].copy_from_slice(stored);
        if self.is_big_endian {
            bytes[..self.bytes].reverse();
        }
        let bits = u64::from_le_bytes(bytes);
        match self.bytes {
            2 => half::f16::from_bits(bits as u16).to_f32(),
            4 => f32::from_bits(bits as u32),
            _ => f64::from_bits(bits) as f32,
        }
    }

    fn floats(self, bytes: &[u8]) -> Vec<f32> {
        bytes.chunks_exact(self.bytes).map(|stored| self.to_f32(stored)).collect()
    }

    /// The same floats as little-endian f32.
    pub fn as_f32(self, input: impl Read + 'static) -> Box<dyn Read> {
        match self == Self::F32 {
            true => Box::new(input),
            false => Box::new(AsF32 { input, dtype: self, ready: io::Cursor::default() }),
        }
    }
}

impl FromStr for Dtype {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = DTYPES.iter().find(|(own, ..)| *own == name);
        found.map(|(.., dtype)| *dtype).ok_or_else(|| format!("no kind of floats is named {name}"))
    }
}

struct AsF32<R> {
    input: R,
    dtype: Dtype,
    ready: io::Cursor<Vec<u8>>,
}

impl<R: Read> Read for AsF32<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.ready.position() == self.ready.get_ref().len() as u64 {
            let mut bytes = vec![0; self.dtype.bytes << 14];
            let filled = read_until_full(&mut self.input, &mut bytes)?;
            if filled % self.dtype.bytes != 0 {
                return Err(io::Error::other(
                    "it ends within a float; is it cut short, or of another --dtype?",
                ));
            }
            self.ready = io::Cursor::new(to_bytes(&self.dtype.floats(&bytes[..filled])));
        }
        self.ready.read(buffer)
    }
}

/// Converts from little endian to the byte order of this machine, or back.
pub(crate) fn swap_if_big_endian(floats: &mut [f32]) {
    if cfg!(target_endian = "big") {
        floats.iter_mut().for_each(|float| *float = f32::from_bits(float.to_bits().swap_bytes()));
    }
}

/// Floats as little-endian bytes.
pub fn to_bytes(floats: &[f32]) -> Vec<u8> {
    floats.iter().flat_map(|float| float.to_le_bytes()).collect()
}

pub(crate) fn read_until_full(input: &mut dyn Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match input.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(count) => filled += count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}

/// What floats seem to be instead of unit vectors, with the remedy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Suspicion {
    /// Raw floats of the kind of this name.
    Dtype(&'static str),
    /// Components moved to 0..1.
    Biased,
    /// All x, then all y, then all z.
    Planar,
    /// Vectors without a negative component, which are biased perhaps.
    Positive,
    /// Vectors of lengths far from 1.
    Far,
}

impl Suspicion {
    /// True unless the input, which is no guess, tells the kind of its floats.
    pub fn applies(self, is_guess: bool) -> bool {
        is_guess || !matches!(self, Self::Dtype(_))
    }
}

impl fmt::Display for Suspicion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Dtype(name) => {
                return write!(f, "as {name} they would have unit length: is --dtype {name} missing?");
            }
            Self::Biased => "as 2 n - 1 they would have unit length: are they biased to 0..1?",
            Self::Planar => "all x, all y, all z would have unit length: interleave the components",
            Self::Positive => "no component is negative: are they biased to 0..1?",
            Self::Far => "most lengths are far from 1: are these unit vectors, and of this kind of floats?",
        })
    }
}

/// What floats seem to be instead of unit vectors: where few have unit length as they are, and nearly all do otherwise.
/// `is_whole` where these are all floats of the input.
pub fn suspicion(element: Element, floats: &[f32], is_whole: bool) -> Option<Suspicion> {
    let each = element.floats();
    let most_have = |floats: &[f32], is_it: fn(f64) -> bool| {
        let length =
            |v: &[f32]| v[..element.part_floats()].iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt();
        let lengths = floats.chunks_exact(each).map(length).filter(|length| *length != 0.0);
        let (are, all) =
            lengths.fold((0, 0), |(are, all), length| (are + usize::from(is_it(length)), all + 1));
        are * 10 > all * 9
    };
    let are_unit = |floats: &[f32]| most_have(floats, |length| (length - 1.0).abs() < 0.02);
    if floats.is_empty() || floats.iter().all(|component| *component == 0.0) || are_unit(floats) {
        return None;
    }
    let bytes = to_bytes(floats);
    let other = DTYPES.iter().skip(1).find(|(.., dtype)| are_unit(&dtype.floats(&bytes)));
    if let Some((name, ..)) = other {
        return Some(Suspicion::Dtype(name));
    }
    let count = floats.len() / each;
    let planes = || (0..floats.len()).map(|at| floats[at % each * count + at / each]).collect::<Vec<_>>();
    let is_unusual = |length: f64| !(0.02..50.0).contains(&length);
    if are_unit(&floats.iter().map(|c| 2.0 * c - 1.0).collect::<Vec<_>>()) {
        Some(Suspicion::Biased)
    } else if is_whole && count > 1 && are_unit(&planes()) {
        Some(Suspicion::Planar)
    } else if count > 64 && floats.iter().all(|component| *component >= 0.0) {
        Some(Suspicion::Positive)
    } else {
        most_have(floats, is_unusual).then_some(Suspicion::Far)
    }
}

/// The header of a NumPy array: the kind of its numbers, and its shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Npy {
    descr: String,
    shape: Vec<u64>,
}

impl Npy {
    /// The first bytes of such a file.
    pub const MAGIC: &[u8] = b"\x93NUMPY";

    /// The header of `count` elements of `each` numbers.
    pub fn new(descr: &str, count: u64, each: usize) -> Self {
        let shape = if each == 1 { vec![count] } else { vec![count, each as u64] };
        Self { descr: descr.to_owned(), shape }
    }

    /// Reads a header, up to the first byte of the array.
    ///
    /// # Errors
    /// Errors of reading, and one that tells what NumPy should save instead.
    pub fn read(reader: &mut impl Read) -> io::Result<Self> {
        let mut start = [0; 10];
        reader.read_exact(&mut start)?;
        let mut more = [0; 2];
        // Version 1 has two bytes of length, later ones four.
        if start[6] > 1 {
            reader.read_exact(&mut more)?;
        }
        let length = u32::from_le_bytes([start[8], start[9], more[0], more[1]]);
        if length > 1 << 16 {
            return Err(io::Error::other("its header is longer than any of NumPy's"));
        }
        let mut text = Vec::new();
        reader.take(length.into()).read_to_end(&mut text)?;
        Self::parse(&String::from_utf8_lossy(&text)).ok_or_else(|| {
            io::Error::other("it is no array of plain numbers in C's order: save numpy.ascontiguousarray(a)")
        })
    }

    fn parse(text: &str) -> Option<Self> {
        let value = |key| Some(text.split_once(key)?.1.trim_start());
        let descr = value("'descr':")?.strip_prefix('\'')?.split_once('\'')?.0.to_owned();
        // It stands in messages.
        let is_plain = |descr: &str| descr.chars().all(|c| c.is_ascii_alphanumeric() || "<>|=".contains(c));
        let shape = value("'shape':")?.strip_prefix('(')?.split_once(')')?.0.split(',').map(str::trim);
        let shape = shape.filter(|size| !size.is_empty()).map(|size| size.parse().ok());
        let shape = shape.collect::<Option<Vec<_>>>()?;
        let is_c = value("'fortran_order':")?.starts_with("False");
        (is_c && is_plain(&descr)).then_some(Self { descr, shape })
    }

    /// The bytes of the header, as NumPy writes them.
    pub fn to_bytes(&self) -> Vec<u8> {
        let shape: Vec<String> = self.shape.iter().map(u64::to_string).collect();
        let (shape, comma) = (shape.join(", "), if shape.len() == 1 { "," } else { "" });
        let mut text =
            format!("{{'descr': '{}', 'fortran_order': False, 'shape': ({shape}{comma}), }}", self.descr);
        // The array begins at a multiple of 64 bytes.
        let padded = (text.len() + 11).next_multiple_of(64) - 11;
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:1$}", "", padded - text.len());
        [Self::MAGIC, &[1, 0], &(text.len() as u16).to_le_bytes(), text.as_bytes()].concat()
    }

    /// The kind and the number of elements of floats.
    ///
    /// # Errors
    /// What is wrong, and what to save instead.
    pub fn elements(&self, element: Element) -> io::Result<(Dtype, u64)> {
        let Some((.., dtype)) = DTYPES.iter().find(|(_, descr, _)| *descr == self.descr) else {
            let words = format!("its numbers are {}, no floats: save a.astype(numpy.float32)", self.descr);
            return Err(io::Error::other(words));
        };
        Ok((*dtype, self.count(element.floats() as u64, element.plural())?))
    }

    /// The number of codes of so many bytes.
    ///
    /// # Errors
    /// What is wrong, and what to save instead.
    pub fn codes(&self, bytes: usize) -> io::Result<u64> {
        let size = self.descr.strip_prefix(['<', '|']).and_then(|kind| kind.strip_prefix(['u', 'i']));
        let size = size.and_then(|size| size.parse().ok()).filter(|size: &usize| *size > 0);
        match size {
            Some(size) if bytes.is_multiple_of(size) => self.count((bytes / size) as u64, "codes"),
            _ => Err(io::Error::other(format!(
                "its numbers are {}, no codes of {bytes} bytes in little-endian integers: is it of another codec?",
                self.descr
            ))),
        }
    }

    /// The number of elements of `each` numbers.
    fn count(&self, each: u64, unit: &str) -> io::Result<u64> {
        let (rows, last) = match self.shape.split_last() {
            Some((last, rows)) if each != 1 => (rows, *last),
            _ => (&self.shape[..], 1),
        };
        let count = rows.iter().try_fold(1, |all: u64, size| all.checked_mul(*size));
        count.filter(|_| last == each).ok_or_else(|| {
            io::Error::other(format!("its shape is {:?}: {unit} have the shape [n, {each}]", self.shape))
        })
    }
}
