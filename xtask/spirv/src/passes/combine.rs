//! One instruction for several.
//!
//! rust-gpu makes a branch of `a && b`, of which a select of booleans is left, and there is no Rust for a signed field of
//! a word but two shifts, nor for a minimum of integers but `if`, since its `min` needs a capability. Compilers of GPUs
//! do not always know these as what they are.

use super::globals::{Globals, instruction, operands};
use anyhow::Result;
use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};
use std::collections::HashMap;

/// Replaces selects of a boolean or a constant by logical operations, those of the lesser number by minima, and shifts to
/// the left and back by extractions.
pub fn instructions(module: &mut Module) -> Result<()> {
    let is_glsl =
        |import: &&Instruction| import.operands == [Operand::LiteralString("GLSL.std.450".to_owned())];
    let glsl = module.ext_inst_imports.iter().find(is_glsl).and_then(|import| import.result_id);
    Globals::pass(module, |functions, globals| {
        for function in functions {
            let defined = definitions(function);
            for block in &mut function.blocks {
                let mut combined = Vec::with_capacity(block.instructions.len());
                for instruction in block.instructions.drain(..) {
                    let other = logical(&instruction, globals)
                        .or_else(|| minimum(&instruction, &defined, glsl?))
                        .or_else(|| field(&instruction, &defined, globals));
                    combined.extend(other.unwrap_or_else(|| vec![instruction]));
                }
                block.instructions = combined;
            }
        }
    })
}

/// The instructions of a function by their results.
fn definitions(function: &Function) -> HashMap<Word, Instruction> {
    let instructions = function.blocks.iter().flat_map(|block| &block.instructions);
    instructions.filter_map(|instruction| Some((instruction.result_id?, instruction.clone()))).collect()
}

/// `c && x` of `c ? x : false`, `c || x` of `c ? true : x`, and so on with `!c`.
fn logical(select: &Instruction, globals: &mut Globals) -> Option<Vec<Instruction>> {
    let of_type = select.result_type.filter(|of_type| globals.is(*of_type, Op::TypeBool))?;
    if select.class.opcode != Op::Select {
        return None;
    }
    let [condition, yes, no] = operands(select)?;
    let (opcode, is_negated, other) = if globals.is(no, Op::ConstantFalse) {
        (Op::LogicalAnd, false, yes)
    } else if globals.is(yes, Op::ConstantTrue) {
        (Op::LogicalOr, false, no)
    } else if globals.is(yes, Op::ConstantFalse) {
        (Op::LogicalAnd, true, no)
    } else if globals.is(no, Op::ConstantTrue) {
        (Op::LogicalOr, true, yes)
    } else {
        return None;
    };
    let result = select.result_id?;
    if !is_negated {
        return Some(vec![instruction(opcode, of_type, result, &[condition, other])]);
    }
    let negated = globals.fresh();
    Some(vec![
        instruction(Op::LogicalNot, of_type, negated, &[condition]),
        instruction(opcode, of_type, result, &[negated, other]),
    ])
}

/// `UMin` of GLSL.std.450.
const UMIN: u32 = 38;

/// `min(a, b)` of `a < b ? a : b`, not negative.
fn minimum(
    select: &Instruction,
    defined: &HashMap<Word, Instruction>,
    glsl: Word,
) -> Option<Vec<Instruction>> {
    let [condition, yes, no] = operands(select).filter(|_| select.class.opcode == Op::Select)?;
    let condition = defined.get(&condition).filter(|of| of.class.opcode == Op::ULessThan)?;
    if operands(condition)? != [yes, no] {
        return None;
    }
    let mut minimum = instruction(Op::ExtInst, select.result_type?, select.result_id?, &[glsl, yes, no]);
    minimum.operands.insert(1, Operand::LiteralExtInstInteger(UMIN));
    Some(vec![minimum])
}

/// The signed field of a word, for `(word << a) as i32 >> b`, or `((word >> c) << a) as i32 >> b` with `c` up to `a`.
fn field(
    shift: &Instruction,
    defined: &HashMap<Word, Instruction>,
    globals: &mut Globals,
) -> Option<Vec<Instruction>> {
    if shift.class.opcode != Op::ShiftRightArithmetic {
        return None;
    }
    let by_opcode = |id: Word, opcode: Op| defined.get(&id).filter(|of| of.class.opcode == opcode);
    let [moved, right] = operands(shift)?;
    let [moved] = operands(by_opcode(moved, Op::Bitcast)?)?;
    let moved = by_opcode(moved, Op::ShiftLeftLogical)?;
    let [word, left] = operands(moved)?;
    let (left, right) = (globals.value(left)?, globals.value(right)?);
    let within = by_opcode(word, Op::ShiftRightLogical).and_then(|inner| {
        let [word, by] = operands(inner)?;
        Some((word, globals.value(by)?)).filter(|(_, by)| *by <= left)
    });
    let (word, by) = within.unwrap_or((word, 0));
    if right < left || right > 31 {
        return None;
    }
    let (of_type, of_word) = (shift.result_type?, moved.result_type?);
    let first = globals.constant(of_word, by + right - left);
    let bits = globals.constant(of_word, 32 - right);
    let signed = globals.fresh();
    Some(vec![
        instruction(Op::Bitcast, of_type, signed, &[word]),
        instruction(Op::BitFieldSExtract, of_type, shift.result_id?, &[signed, first, bits]),
    ])
}

#[cfg(test)]
mod tests {
    use super::super::globals::ids;
    use super::super::snippet::{self, assert_valid, module};
    use super::*;

    /// The instructions that are left of these: opcode and operands.
    fn combined(lines: &str) -> (Module, Vec<(Op, Vec<Word>)>) {
        let mut module = module(lines);
        super::instructions(&mut module).unwrap();
        assert_valid(&module);
        let all = snippet::instructions(&module);
        let left = all.iter().map(|instruction| (instruction.class.opcode, ids(instruction))).collect();
        (module, left)
    }

    #[test]
    fn selects_of_booleans_become_logical_operations() {
        for (yes, no, opcode, is_negated) in [
            ("%11", "%false", Op::LogicalAnd, false),
            ("%true", "%11", Op::LogicalOr, false),
            ("%false", "%11", Op::LogicalAnd, true),
            ("%11", "%true", Op::LogicalOr, true),
        ] {
            let lines = format!(
                "%10 = OpFOrdLessThan %bool %7 %f0
                %11 = OpFOrdLessThan %bool %7 %f1
                %12 = OpSelect %bool %10 {yes} {no}
                %13 = OpSelect %float %12 %7 %f0
                OpStore %6 %13"
            );
            let (module, left) = combined(&lines);
            let (result, condition) = if is_negated {
                assert_eq!(left[2], (Op::LogicalNot, vec![10]));
                (3, snippet::instructions(&module)[2].result_id.unwrap())
            } else {
                (2, 10)
            };
            assert_eq!(left[result], (opcode, vec![condition, 11]), "{yes} {no}");
            assert_eq!(snippet::instructions(&module)[result].result_id, Some(12));
        }
        let (_, left) = combined(
            "%10 = OpFOrdLessThan %bool %7 %f0
            %12 = OpSelect %float %10 %7 %f0
            OpStore %6 %12",
        );
        assert_eq!(left[1].0, Op::Select);
    }

    #[test]
    fn selects_of_the_lesser_become_minima() {
        for (yes, no, expected) in [("%10", "%u4", Op::ExtInst), ("%u4", "%10", Op::Select)] {
            let (_, left) = combined(&format!(
                "%10 = OpBitcast %uint %7
                %11 = OpULessThan %bool %10 %u4
                %12 = OpSelect %uint %11 {yes} {no}
                %13 = OpBitcast %float %12
                OpStore %6 %13"
            ));
            assert_eq!(left[2].0, expected, "{yes} {no}");
        }
    }

    /// Field and offset, for each way to write it.
    #[test]
    fn shifts_to_the_left_and_back_become_a_field() {
        let shifts = |inner: &str, left: &str, right: &str| {
            format!(
                "%10 = OpBitcast %uint %7
                %11 = OpShiftRightLogical %uint %10 {inner}
                %12 = OpShiftLeftLogical %uint %11 {left}
                %13 = OpBitcast %int %12
                %14 = OpShiftRightArithmetic %int %13 {right}
                %15 = OpConvertSToF %float %14
                OpStore %6 %15"
            )
        };
        for (inner, left, right, expected) in [
            ("%u4", "%u20", "%u22", Some((10, 6, 10))),
            ("%u20", "%u20", "%u22", Some((10, 22, 10))),
            // What the inner shift puts in at the top is part of the field.
            ("%u22", "%u20", "%u22", Some((11, 2, 10))),
            ("%u4", "%u22", "%u20", None),
        ] {
            let (module, left_over) = combined(&shifts(inner, left, right));
            let Some((word, first, bits)) = expected else {
                assert_eq!(left_over[4].0, Op::ShiftRightArithmetic);
                continue;
            };
            assert_eq!(left_over[4], (Op::Bitcast, vec![word]), "{inner} {left} {right}");
            let (opcode, operands) = &left_over[5];
            assert_eq!(*opcode, Op::BitFieldSExtract);
            let globals = Globals { bound: 0, known: module.types_global_values };
            let values = operands[1..].iter().map(|id| globals.value(*id).unwrap());
            assert_eq!(values.collect::<Vec<_>>(), [first, bits], "{inner} {left} {right}");
        }
    }
}
