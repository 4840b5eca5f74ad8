//! SPIR-V as instructions whose words mean nothing yet: the output of newer compilers than this program passes through.

pub use rspirv::spirv::Op;

const MAGIC: u32 = 0x0723_0203;

/// Words before the first instruction.
const HEADER_WORDS: usize = 5;

/// The largest bound of ids that Vulkan promises to take.
const MAX_BOUND: u32 = 0x003f_ffff;

/// An instruction of a module.
#[derive(Clone, Copy, Debug)]
pub struct Instruction<'m> {
    pub opcode: u32,
    /// The words after the first.
    pub operands: &'m [u32],
}

impl Instruction<'_> {
    /// The operation, where it is a known one.
    pub fn op(&self) -> Option<Op> {
        Op::from_u32(self.opcode)
    }

    /// An operand's word.
    pub fn word(&self, at: usize) -> Option<u32> {
        self.operands.get(at).copied()
    }

    /// The literal string that begins at this operand, as far as it is text.
    pub fn text(&self, at: usize) -> String {
        let words = self.operands.get(at..).unwrap_or_default();
        let bytes: Vec<u8> =
            words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0).collect();
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

/// A literal string's words.
pub fn literal(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.push(0);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    words_of(&bytes)
}

fn words_of(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}

/// Writes an instruction behind others.
pub fn push(words: &mut Vec<u32>, opcode: u32, operands: &[u32]) {
    words.push((operands.len() as u32 + 1) << 16 | opcode);
    words.extend(operands);
}

/// The instructions in these words, up to one that is cut short.
pub fn instructions(mut words: &[u32]) -> impl Iterator<Item = Instruction<'_>> {
    std::iter::from_fn(move || {
        let (first, others) = words.split_first()?;
        let operands;
        (operands, words) = others.split_at_checked(((first >> 16) as usize).checked_sub(1)?)?;
        Some(Instruction { opcode: first & 0xffff, operands })
    })
}

/// A module.
#[derive(Clone, Debug)]
pub struct Module {
    /// 0x0001_0300 for SPIR-V 1.3.
    pub version: u32,
    generator: u32,
    bound: u32,
    /// Whole instructions, one after the other.
    pub words: Vec<u32>,
}

impl Module {
    /// The instructions of a file, or why it has none.
    pub fn parse(bytes: &[u8]) -> Result<Self, &'static str> {
        if bytes.get(..4) == Some(MAGIC.to_be_bytes().as_slice()) {
            return Err("its words are big endian");
        }
        if bytes.get(..4) != Some(MAGIC.to_le_bytes().as_slice()) {
            return Err("its first word is not SPIR-V's");
        }
        if !bytes.len().is_multiple_of(4) {
            return Err("it ends within a word");
        }
        let mut words = words_of(bytes);
        let [_, version, generator, bound, _, ..] = words[..] else { return Err("it is cut short") };
        if !(1..=MAX_BOUND).contains(&bound) {
            return Err("its bound of ids is 0 or more than Vulkan takes");
        }
        drop(words.drain(..HEADER_WORDS));
        let module = Self { version, generator, bound, words };
        let whole: usize = module.instructions().map(|instruction| instruction.operands.len() + 1).sum();
        if whole < module.words.len() { Err("it is cut short") } else { Ok(module) }
    }

    pub fn instructions(&self) -> impl Iterator<Item = Instruction<'_>> {
        instructions(&self.words)
    }

    /// The file's bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let header = [MAGIC, self.version, self.generator, self.bound, 0];
        let mut bytes = Vec::with_capacity(4 * (HEADER_WORDS + self.words.len()));
        header.iter().chain(&self.words).for_each(|word| bytes.extend(word.to_le_bytes()));
        bytes
    }

    /// The instructions of an operation.
    pub fn all(&self, op: Op) -> impl Iterator<Item = Instruction<'_>> {
        self.instructions().filter(move |instruction| instruction.opcode == op as u32)
    }

    /// An id that is free.
    pub fn fresh(&mut self) -> u32 {
        self.bound += 1;
        self.bound - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_hold_no_instructions_are_refused() {
        let header = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
        let whole = header(&[MAGIC, 0x0001_0300, 0, 9, 0, 2 << 16 | 17, 1]);
        assert_eq!(Module::parse(&whole).unwrap().bytes(), whole);
        let big: Vec<u8> = whole.chunks(4).flat_map(|word| word.iter().rev().copied()).collect();
        for (bytes, reason) in [
            (b"".to_vec(), "its first word is not SPIR-V's"),
            (b"#version 450\n".to_vec(), "its first word is not SPIR-V's"),
            (big, "its words are big endian"),
            (whole[..25].to_vec(), "it ends within a word"),
            (whole[..24].to_vec(), "it is cut short"),
            (whole[..16].to_vec(), "it is cut short"),
            (header(&[MAGIC, 0x0001_0300, 0, 0, 0]), "its bound of ids is 0 or more than Vulkan takes"),
            // An instruction of no words would be read again and again.
            (header(&[MAGIC, 0x0001_0300, 0, 9, 0, 17]), "it is cut short"),
        ] {
            assert_eq!(Module::parse(&bytes).unwrap_err(), reason);
        }
    }

    #[test]
    fn literals_end_in_a_zero() {
        for text in ["", "abc", "abcd", "unitvec_oct16_encode"] {
            let words = literal(text);
            assert_eq!(words.last().unwrap() >> 24, 0);
            assert_eq!(Instruction { opcode: Op::Name as u32, operands: &words }.text(0), text);
        }
    }
}
