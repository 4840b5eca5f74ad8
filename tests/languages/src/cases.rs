//! The inputs of every compiler's code, and the CPU's results.

use crate::{Result, told};
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Domain, Operation};
use unitvec_run::sampling;
use unitvec_run::shader::kernel;

/// Random elements of each codec, and codes: all of 16 bits and fewer, random wider ones.
pub const RANDOM: usize = 1 << 16;
/// Special ones after them.
pub const SPECIAL: usize = 1 << 12;
/// The number of both kinds.
pub const COUNT: usize = RANDOM + SPECIAL;

const SEED: u64 = 15;

/// One codec, encoding or decoding: its kernel's input, and the expected output.
pub struct Case {
    pub format: &'static AnyCodec,
    pub operation: Operation,
    /// The number of inputs before the special ones.
    pub random: usize,
    pub input: Arc<[u32]>,
    pub expected: Vec<u32>,
    /// True where all files of the language are compiled, and not only those that the codec needs.
    pub has_all_files: bool,
}

impl Case {
    /// `oct32_encode`.
    pub fn name(&self) -> String {
        if self.has_all_files { "all_files".to_owned() } else { self.format.function(self.operation) }
    }

    /// The case with all files of the language.
    pub fn with_all_files(&self) -> Self {
        let (input, expected) = (self.input.clone(), self.expected.clone());
        Self { input, expected, has_all_files: true, ..*self }
    }

    /// Words of the input and of the output, for one element.
    pub fn words(&self) -> (usize, usize) {
        kernel::words(self.format, self.operation)
    }
}

/// Encoding and decoding by these codecs.
pub fn cases(formats: &[&'static AnyCodec]) -> Result<Vec<Case>> {
    let mut inputs = Inputs::new(RANDOM);
    let mut cases = Vec::new();
    for format in formats {
        for operation in Operation::ALL {
            cases.push(inputs.case(format, operation)?);
        }
    }
    Ok(cases)
}

/// The inputs of codecs, which many of them share.
pub struct Inputs {
    /// The number of inputs before the special ones.
    random: usize,
    /// Elements of so many floats, over the sphere or not.
    elements: HashMap<(usize, bool), Arc<[u32]>>,
    /// Codes of so many bytes.
    codes: HashMap<usize, Arc<[u32]>>,
}

impl Inputs {
    pub fn new(random: usize) -> Self {
        Self { random, elements: HashMap::new(), codes: HashMap::new() }
    }

    /// The inputs of an operation, and the CPU's results.
    pub fn case(&mut self, format: &'static AnyCodec, operation: Operation) -> Result<Case> {
        let (random, count) = (self.random, self.random + SPECIAL);
        let (input, expected) = match operation {
            Operation::Encode => {
                let kind = (format.element.floats(), format.domain == Domain::Sphere);
                let elements =
                    self.elements.entry(kind).or_insert_with(|| elements_of(format, random)).clone();
                let mut encoded = vec![0; count * format.bytes];
                format.encode_cpu(bytemuck::cast_slice(&elements), &mut encoded).map_err(told)?;
                (elements, whole_words(format, &encoded))
            }
            Operation::Decode => {
                let codes =
                    self.codes.entry(format.bytes).or_insert_with(|| codes_of(format, random)).clone();
                let mut decoded = vec![0; count * format.element.floats()];
                let stored = stored(format, &codes);
                format.decode_cpu(&stored, bytemuck::cast_slice_mut(&mut decoded)).map_err(told)?;
                (codes, decoded)
            }
        };
        Ok(Case { format, operation, random, input, expected, has_all_files: false })
    }
}

/// Stored codes as words, one or two each.
fn whole_words(format: &AnyCodec, stored: &[u8]) -> Vec<u32> {
    let words = kernel::code_words(format);
    let codes = stored.chunks_exact(format.bytes);
    codes
        .flat_map(|code| {
            let mut bytes = [0; 8];
            bytes[..code.len()].copy_from_slice(code);
            let code = u64::from_le_bytes(bytes);
            [code as u32, (code >> 32) as u32].into_iter().take(words)
        })
        .collect()
}

/// Codes of whole words as they are stored.
pub fn stored(format: &AnyCodec, words: &[u32]) -> Vec<u8> {
    let codes = words.chunks_exact(kernel::code_words(format));
    codes
        .flat_map(|code| {
            bytemuck::cast_slice::<u32, u8>(code).iter().take(format.bytes).copied().collect::<Vec<_>>()
        })
        .collect()
}

/// Random elements of the domain, and some of the special ones, evenly taken.
fn elements_of(format: &AnyCodec, random: usize) -> Arc<[u32]> {
    let floats = format.element.floats();
    let random = sampling::random_elements(format.element, format.domain, SEED).take(random * floats);
    let special: Vec<&[f32]> = sampling::special_elements(format.element).chunks_exact(floats).collect();
    let special = (0..SPECIAL).flat_map(|n| special[n * special.len() / SPECIAL].iter().copied());
    random.chain(special).map(f32::to_bits).collect()
}

/// All codes of 16 bits and fewer, random codes, and special ones.
fn codes_of(format: &AnyCodec, random: usize) -> Arc<[u32]> {
    let all = if format.bytes <= 2 { 0..1 << 16 } else { 0..0 };
    let special = sampling::special_codes();
    let special = (0..SPECIAL).map(|n| special[n * special.len() / SPECIAL]);
    let codes: Vec<u64> = all.chain(sampling::random_codes(SEED)).take(random).chain(special).collect();
    whole_words(format, &sampling::stored(&codes, format.bytes)).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_catalogue::find;

    #[test]
    fn words_come_back_from_stored_codes() {
        for id in ["oct16", "oct24", "oct32", "soct33", "oct48p", "frame64"] {
            let format = find(id).unwrap();
            let codes = codes_of(format, RANDOM);
            assert_eq!(codes.len(), COUNT * kernel::code_words(format), "{id}");
            assert_eq!(whole_words(format, &stored(format, &codes)), codes.to_vec(), "{id}");
        }
    }
}
