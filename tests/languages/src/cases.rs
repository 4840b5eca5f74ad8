//! The inputs of every compiler's code, and the CPU's results.

use crate::{Result, told};
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Domain, Operation};
use unitvec_run::sampling;
use unitvec_run::shader::kernel;

/// Random elements, and random codes, of each codec.
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
    let mut elements = HashMap::new();
    let mut codes = HashMap::new();
    let mut cases = Vec::new();
    for &format in formats {
        let kind = (format.element.floats(), format.domain == Domain::Sphere);
        let elements = elements.entry(kind).or_insert_with(|| elements_of(format));
        let codes = codes.entry(format.bytes).or_insert_with(|| codes_of(format));
        let mut encoded = vec![0; COUNT * format.bytes];
        format.encode_cpu(bytemuck::cast_slice(elements), &mut encoded).map_err(told)?;
        let mut decoded = vec![0; COUNT * format.element.floats()];
        format.decode_cpu(&stored(format, codes), bytemuck::cast_slice_mut(&mut decoded)).map_err(told)?;
        let case =
            |(operation, input, expected)| Case { format, operation, input, expected, has_all_files: false };
        let encode = (Operation::Encode, elements.clone(), whole_words(format, &encoded));
        cases.extend([encode, (Operation::Decode, codes.clone(), decoded)].map(case));
    }
    Ok(cases)
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
fn elements_of(format: &AnyCodec) -> Arc<[u32]> {
    let floats = format.element.floats();
    let random = sampling::random_elements(format.element, format.domain, SEED).take(RANDOM * floats);
    let special: Vec<&[f32]> = sampling::special_elements(format.element).chunks_exact(floats).collect();
    let special = (0..SPECIAL).flat_map(|n| special[n * special.len() / SPECIAL].iter().copied());
    random.chain(special).map(f32::to_bits).collect()
}

/// Random codes, and special ones.
fn codes_of(format: &AnyCodec) -> Arc<[u32]> {
    let special = sampling::special_codes();
    let special = (0..SPECIAL).map(|n| special[n * special.len() / SPECIAL]);
    let codes: Vec<u64> = sampling::random_codes(SEED).take(RANDOM).chain(special).collect();
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
            let codes = codes_of(format);
            assert_eq!(codes.len(), COUNT * kernel::code_words(format), "{id}");
            assert_eq!(whole_words(format, &stored(format, &codes)), codes.to_vec(), "{id}");
        }
    }
}
