//! The choice of the device's own division, and arithmetic of constants.

use super::globals::{Globals, operands};
use anyhow::Result;
use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, FunctionControl, Op, Word};

/// The specialization constant that takes the device's own division and roots.
pub const FAST: u32 = 1;

/// Makes `arith::divide::is_fast` return the specialization constant [`FAST`], by default false, or false in a library, whose
/// users have specialization constants of their own. It is the function without parameters that returns false.
pub fn choose(module: &mut Module, is_library: bool) -> Result<()> {
    let mut constant = None;
    Globals::pass(module, |functions, globals| {
        for function in functions {
            let Some(returned) = returned_constant(function) else { continue };
            let found = globals.find(*returned).filter(|of| of.class.opcode == Op::ConstantFalse);
            let Some(of_type) = found.map(|found| found.result_type) else { continue };
            if !is_library {
                *returned = *constant.get_or_insert_with(|| {
                    let id = globals.fresh();
                    let declared = Instruction::new(Op::SpecConstantFalse, of_type, Some(id), Vec::new());
                    globals.known.push(declared);
                    id
                });
            }
            // rust-gpu must not inline it, so that it is found here; spirv-opt has to.
            if let Some(Operand::FunctionControl(control)) =
                function.def.as_mut().and_then(|def| def.operands.first_mut())
            {
                *control = FunctionControl::NONE;
            }
        }
    })?;
    let decoration = |id| {
        let operands =
            vec![Operand::IdRef(id), Operand::Decoration(Decoration::SpecId), Operand::LiteralBit32(FAST)];
        Instruction::new(Op::Decorate, None, None, operands)
    };
    module.annotations.extend(constant.map(decoration));
    Ok(())
}

/// The result of a function that has no parameters and does nothing but return.
fn returned_constant(function: &mut Function) -> Option<&mut Word> {
    let [block] = function.blocks.as_mut_slice() else { return None };
    let [last] = block.instructions.as_mut_slice() else { return None };
    if !function.parameters.is_empty() || last.class.opcode != Op::ReturnValue {
        return None;
    }
    last.operands.first_mut()?.id_ref_any_mut()
}

/// Replaces sums, products, quotients and bit patterns of constants by constants, and tells whether there were any. spirv-opt
/// leaves them, since they must not be contracted; a device would divide.
pub fn fold(module: &mut Module) -> Result<bool> {
    let mut any = false;
    Globals::pass(module, |functions, globals| {
        for instruction in functions.iter_mut().flat_map(Function::all_inst_iter_mut) {
            let Some(value) = folded(instruction, globals) else { continue };
            let Some(of_type) = instruction.result_type else { continue };
            let constant = Operand::IdRef(globals.constant(of_type, value));
            instruction.class = rspirv::grammar::CoreInstructionTable::get(Op::CopyObject);
            instruction.operands = vec![constant];
            any = true;
        }
    })?;
    Ok(any)
}

fn folded(instruction: &Instruction, globals: &Globals) -> Option<u32> {
    match instruction.class.opcode {
        opcode @ (Op::FAdd | Op::FSub | Op::FMul | Op::FDiv) => {
            let [a, b] = operands(instruction)?.map(|id| globals.value(id).map(f32::from_bits));
            let (a, b) = (a?, b?);
            let result = match opcode {
                Op::FAdd => a + b,
                Op::FSub => a - b,
                Op::FMul => a * b,
                _ => a / b,
            };
            Some(result.to_bits())
        }
        Op::Bitcast => {
            let [bits] = operands(instruction)?;
            let is_scalar = globals.is(instruction.result_type?, Op::TypeFloat)
                || globals.is(instruction.result_type?, Op::TypeInt);
            globals.value(bits).filter(|_| is_scalar)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::snippet;
    use super::*;

    /// A call of the marker chooses by the specialization constant; other functions stay.
    #[test]
    fn the_function_that_returns_false_returns_a_specialization_constant() {
        let mut module = snippet::assembled(include_str!("snippets/two_functions.spvasm"));
        choose(&mut module, false).unwrap();
        snippet::assert_valid(&module);
        let added = module.types_global_values.last().unwrap();
        assert_eq!(added.class.opcode, Op::SpecConstantFalse);
        let returned = module.functions.iter_mut().map(|function| returned_constant(function).copied());
        assert_eq!(returned.collect::<Vec<_>>(), [added.result_id, Some(7), None]);
        assert_eq!(module.annotations.len(), 1);
        let control = &module.functions[0].def.as_ref().unwrap().operands[0];
        assert_eq!(*control, Operand::FunctionControl(FunctionControl::NONE));
    }

    #[test]
    fn arithmetic_of_constants_is_a_constant() {
        let mut module = snippet::module(
            "%10 = OpFDiv %float %f1 %f1
            %11 = OpFDiv %float %f1 %7
            %12 = OpBitcast %uint %f1
            %13 = OpBitcast %float %12
            OpStore %6 %11",
        );
        assert!(fold(&mut module).unwrap());
        let opcodes = snippet::opcodes(&module);
        assert_eq!(opcodes[..4], [Op::CopyObject, Op::FDiv, Op::CopyObject, Op::Bitcast]);
        snippet::assert_valid(&module);
    }
}
