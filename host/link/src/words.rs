//! SPIR-V as instructions whose words mean nothing yet: the output of newer compilers than this program passes through.

pub use rspirv::spirv::Op;

const MAGIC: u32 = 0x0723_0203;

/// Words before the first instruction.
const HEADER_WORDS: usize = 5;

/// The largest bound of ids that Vulkan promises to take.
const MAX_BOUND: u32 = 0x003f_ffff;

/// An instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instruction {
    pub opcode: u32,
    /// The words after the first.
    pub operands: Vec<u32>,
}

impl Instruction {
    pub fn new(op: Op, operands: impl Into<Vec<u32>>) -> Self {
        Self { opcode: op as u32, operands: operands.into() }
    }

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

/// A module.
#[derive(Clone, Debug)]
pub struct Module {
    /// 0x0001_0300 for SPIR-V 1.3.
    pub version: u32,
    generator: u32,
    bound: u32,
    pub instructions: Vec<Instruction>,
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
        let words = words_of(bytes);
        let [_, version, generator, bound, _, ..] = words[..] else { return Err("it is cut short") };
        if !(1..=MAX_BOUND).contains(&bound) {
            return Err("its bound of ids is 0 or more than Vulkan takes");
        }
        let mut instructions = Vec::new();
        let mut rest = words.get(HEADER_WORDS..).unwrap_or_default();
        while let Some(first) = rest.first() {
            let length = (first >> 16) as usize;
            let operands = rest.get(1..length).ok_or("it is cut short")?;
            instructions.push(Instruction { opcode: first & 0xffff, operands: operands.to_vec() });
            rest = &rest[length..];
        }
        Ok(Self { version, generator, bound, instructions })
    }

    /// The file's bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let mut words = vec![MAGIC, self.version, self.generator, self.bound, 0];
        for Instruction { opcode, operands } in &self.instructions {
            words.push((operands.len() as u32 + 1) << 16 | opcode);
            words.extend(operands);
        }
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// The instructions of an operation.
    pub fn all(&self, op: Op) -> impl Iterator<Item = &Instruction> {
        self.instructions.iter().filter(move |instruction| instruction.opcode == op as u32)
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
            assert_eq!(Instruction::new(Op::Name, words).text(0), text);
        }
    }
}
