//! Mutations of files. Those of proptest's kind, so that an input that fails is shrunk to few of them.

use proptest::prelude::*;
use proptest::sample::{Index, select};
use std::ops::Range;
use std::rc::Rc;

/// Numbers in text that parsers stumble over.
const TEXT_NUMBERS: [&str; 18] = [
    "0",
    "-1",
    "1",
    "2147483647",
    "2147483648",
    "-2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "1e39",
    "-1e39",
    "1e-46",
    "1e400",
    "nan",
    "inf",
];

/// Numbers in binary, and counts just beyond those of the seeds.
const BINARY_NUMBERS: [u32; 12] = [
    0,
    1,
    0x7f,
    0xff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0x7f80_0000,
    0x7fc0_0000,
    0x0100_0000,
    0x0040_0000,
];

/// A change of a file; places are fractions of its length, so that they fit any.
#[derive(Clone, Debug)]
enum Mutation {
    FlipBit(Index, u8),
    Byte(Index, u8),
    Truncate(Index),
    Delete(Index, Index),
    Repeat(Index, Index, u8),
    /// Puts a part of a seed at a place.
    Splice(Index, [Index; 2], Index),
    TextNumber(Index, &'static str),
    BinaryNumber(Index, u32, bool),
    /// Exchanges two words of a text.
    Swap(Index, Index),
    /// Multiplies what is at two places, until each fills a part of the largest file: products of two counts.
    Product([Index; 2]),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = any::<Index>;
    prop_oneof![
        2 => (at(), 0u8..8).prop_map(|(at, bit)| Mutation::FlipBit(at, bit)),
        2 => (at(), any::<u8>()).prop_map(|(at, byte)| Mutation::Byte(at, byte)),
        2 => at().prop_map(Mutation::Truncate),
        2 => (at(), at()).prop_map(|(from, to)| Mutation::Delete(from, to)),
        2 => (at(), at(), 1u8..4).prop_map(|(from, to, times)| Mutation::Repeat(from, to, times)),
        2 => (at(), [at(), at()], at()).prop_map(|(seed, part, at)| Mutation::Splice(seed, part, at)),
        6 => (at(), select(&TEXT_NUMBERS[..])).prop_map(|(at, number)| Mutation::TextNumber(at, number)),
        4 => (at(), select(&BINARY_NUMBERS[..]), any::<bool>())
            .prop_map(|(at, number, big)| Mutation::BinaryNumber(at, number, big)),
        2 => (at(), at()).prop_map(|(a, b)| Mutation::Swap(a, b)),
        1 => [at(), at()].prop_map(Mutation::Product),
    ]
}

/// Inputs: a seed with up to five mutations, one of 32 with none.
pub fn inputs(seeds: Vec<Vec<u8>>) -> impl Strategy<Value = Vec<u8>> {
    let seeds = Rc::new(seeds);
    let mutations = prop_oneof![1 => Just(Vec::new()), 31 => prop::collection::vec(mutation(), 1..6)];
    (any::<Index>(), mutations).prop_map(move |(seed, mutations)| {
        let mut bytes = seed.get(&seeds).clone();
        mutations.iter().for_each(|mutation| mutation.apply(&mut bytes, &seeds));
        bytes
    })
}

/// The largest file that repetition makes: large enough for a count to wrap, small enough to be quick.
pub const MOST: usize = 1 << 16;

impl Mutation {
    fn apply(&self, bytes: &mut Vec<u8>, seeds: &[Vec<u8>]) {
        if bytes.is_empty() {
            return;
        }
        let length = bytes.len();
        match self {
            Self::FlipBit(at, bit) => bytes[at.index(length)] ^= 1 << bit,
            Self::Byte(at, byte) => bytes[at.index(length)] = *byte,
            Self::Truncate(at) => bytes.truncate(at.index(length)),
            Self::Delete(from, to) => drop(bytes.drain(between(*from, *to, length))),
            Self::Repeat(from, to, times) => {
                let range = between(*from, *to, length);
                let copies = bytes[range.clone()].repeat((*times).into());
                if length + copies.len() <= MOST {
                    drop(bytes.splice(range.end..range.end, copies));
                }
            }
            Self::Splice(seed, [from, to], at) => {
                let seed = seed.get(seeds);
                if !seed.is_empty() && length + seed.len() <= MOST {
                    let part = seed[between(*from, *to, seed.len())].iter().copied();
                    let at = at.index(length);
                    drop(bytes.splice(at..at, part));
                }
            }
            Self::TextNumber(at, number) => {
                let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
                if let Some(range) = word(bytes, at.index(length), is_part, u8::is_ascii_digit) {
                    drop(bytes.splice(range, number.bytes()));
                }
            }
            Self::BinaryNumber(at, number, big) => {
                let number = if *big { number.to_be_bytes() } else { number.to_le_bytes() };
                let at = at.index(length);
                let end = length.min(at + 4);
                bytes[at..end].copy_from_slice(&number[..end - at]);
            }
            Self::Product(places) => places.iter().for_each(|at| multiply(bytes, *at)),
            Self::Swap(a, b) => {
                let is_part = |byte: &u8| byte.is_ascii_graphic() && !b",:{}[]\"".contains(byte);
                let words = [a, b].map(|at| word(bytes, at.index(length), is_part, is_part));
                if let [Some(a), Some(b)] = words {
                    let (first, second) = if a.start < b.start { (a, b) } else { (b, a) };
                    if first.end <= second.start {
                        let (left, right) = (bytes[first.clone()].to_vec(), bytes[second.clone()].to_vec());
                        drop(bytes.splice(second, left));
                        drop(bytes.splice(first, right));
                    }
                }
            }
        }
    }
}

/// Repeats the unit at a place: the object of JSON around it, with commas; else the line; else, in binary files, 32 bytes.
fn multiply(bytes: &mut Vec<u8>, at: Index) {
    let at = at.index(bytes.len());
    let open = bytes[..=at].iter().rposition(|byte| b"{}".contains(byte)).filter(|open| bytes[*open] == b'{');
    let close = bytes[at..].iter().position(|byte| b"{}".contains(byte)).map(|close| at + close);
    let object = open.zip(close).filter(|(_, close)| bytes[*close] == b'}');
    let line = || {
        let start = bytes[..at].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        bytes[at..].iter().position(|byte| *byte == b'\n').map(|length| start..at + length + 1)
    };
    let (unit, comma) = match object {
        Some((open, close)) => (open..close + 1, &b","[..]),
        None => (line().unwrap_or(at..bytes.len().min(at + 32)), &b""[..]),
    };
    let copy = [&bytes[unit.clone()], comma].concat();
    let times = (MOST / 2).saturating_sub(bytes.len() / 2) / copy.len();
    drop(bytes.splice(unit.start..unit.start, copy.repeat(times)));
}

fn between(a: Index, b: Index, length: usize) -> Range<usize> {
    let (a, b) = (a.index(length), b.index(length));
    a.min(b)..a.max(b)
}

/// The first run of such bytes, with one of the others in it, that begins or goes on at a place.
fn word(
    bytes: &[u8],
    at: usize,
    is_part: impl Fn(&u8) -> bool,
    is_core: impl Fn(&u8) -> bool,
) -> Option<Range<usize>> {
    let core = at + bytes[at..].iter().position(is_core)?;
    let start = bytes[..core].iter().rposition(|byte| !is_part(byte)).map_or(0, |before| before + 1);
    let end = bytes[core..].iter().position(|byte| !is_part(byte)).map_or(bytes.len(), |after| core + after);
    Some(start..end)
}
