//! A module's types and constants, and instructions by ids alone.

use anyhow::{Context, Result};
use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};

/// The module's types, constants and variables, and the next free id.
pub struct Globals {
    pub known: Vec<Instruction>,
    pub bound: Word,
}

impl Globals {
    /// Runs a pass on a module's functions. It may add constants and ids.
    pub fn pass(module: &mut Module, pass: impl FnOnce(&mut [Function], &mut Self)) -> Result<()> {
        let header = module.header.as_mut().context("the module has no header")?;
        let known = std::mem::take(&mut module.types_global_values);
        let mut globals = Self { known, bound: header.bound };
        pass(&mut module.functions, &mut globals);
        (module.types_global_values, header.bound) = (globals.known, globals.bound);
        Ok(())
    }

    pub fn fresh(&mut self) -> Word {
        self.bound += 1;
        self.bound - 1
    }

    pub fn find(&self, id: Word) -> Option<&Instruction> {
        self.known.iter().find(|global| global.result_id == Some(id))
    }

    pub fn is(&self, id: Word, opcode: Op) -> bool {
        self.find(id).is_some_and(|global| global.class.opcode == opcode)
    }

    /// The value of a constant of 32 bits.
    pub fn value(&self, id: Word) -> Option<u32> {
        self.find(id).and_then(value)
    }

    /// The constant of this type and value.
    pub fn constant(&mut self, of_type: Word, of_value: u32) -> Word {
        let equals =
            |global: &&Instruction| value(global) == Some(of_value) && global.result_type == Some(of_type);
        if let Some(id) = self.known.iter().find(equals).and_then(|global| global.result_id) {
            return id;
        }
        let (id, operands) = (self.fresh(), vec![Operand::LiteralBit32(of_value)]);
        self.known.push(Instruction::new(Op::Constant, Some(of_type), Some(id), operands));
        id
    }

    /// The types of a composite's parts, if the type has any; of vectors and arrays the same one several times.
    pub fn members(&self, of_type: Word) -> Option<Vec<Word>> {
        let definition = self.find(of_type)?;
        let ids = ids(definition);
        let length = match (definition.class.opcode, definition.operands.as_slice()) {
            (Op::TypeStruct, _) => return Some(ids),
            (Op::TypeVector, [_, Operand::LiteralBit32(length)]) => *length,
            (Op::TypeArray, _) => self.value(ids[1]).unwrap_or(0),
            _ => return None,
        };
        Some(vec![ids[0]; length as usize])
    }
}

/// The value of a constant of 32 bits.
fn value(global: &Instruction) -> Option<u32> {
    match (global.class.opcode, global.operands.as_slice()) {
        (Op::Constant, [Operand::LiteralBit32(value)]) => Some(*value),
        _ => None,
    }
}

/// The ids among an instruction's operands.
pub fn ids(instruction: &Instruction) -> Vec<Word> {
    instruction.operands.iter().filter_map(Operand::id_ref_any).collect()
}

/// The ids among an instruction's operands, where there are so many.
pub fn operands<const N: usize>(instruction: &Instruction) -> Option<[Word; N]> {
    ids(instruction).try_into().ok()
}

/// An instruction whose operands are ids.
pub fn instruction(opcode: Op, of_type: Word, result: Word, operands: &[Word]) -> Instruction {
    let operands = operands.iter().map(|id| Operand::IdRef(*id)).collect();
    Instruction::new(opcode, Some(of_type), Some(result), operands)
}

/// An instruction that takes this part of a composite.
pub fn extract(of_type: Word, result: Word, whole: Word, part: u32) -> Instruction {
    let operands = vec![Operand::IdRef(whole), Operand::LiteralBit32(part)];
    Instruction::new(Op::CompositeExtract, Some(of_type), Some(result), operands)
}
