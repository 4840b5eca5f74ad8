//! NoContraction on every float arithmetic result.

use super::join::target;
use anyhow::{Result, ensure};
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Decoration, Op};
use std::collections::HashSet;

/// True for the instructions whose result a device could otherwise fuse or reassociate.
fn is_float_arithmetic(op: Op) -> bool {
    use Op::*;
    matches!(op, FNegate | FAdd | FSub | FMul | FDiv) || (FRem..=Dot).contains(&op)
}

/// Adds NoContraction wherever it is missing.
pub fn no_contraction(module: &mut Module) {
    let missing = undecorated(module);
    module.annotations.extend(missing.into_iter().map(|id| {
        let operands = vec![Operand::IdRef(id), Operand::Decoration(Decoration::NoContraction)];
        Instruction::new(Op::Decorate, None, None, operands)
    }));
}

/// Fails if a float arithmetic result lacks NoContraction.
pub fn check_no_contraction(module: &Module) -> Result<()> {
    let ids = undecorated(module);
    let lost = "float results lost their NoContraction in spirv-opt";
    ensure!(ids.is_empty(), "{} {lost}, %{} first", ids.len(), ids[0]);
    Ok(())
}

fn undecorated(module: &Module) -> Vec<u32> {
    let is_it = Some(&Operand::Decoration(Decoration::NoContraction));
    let decorations = module.annotations.iter().filter(|annotation| annotation.operands.get(1) == is_it);
    let decorated: HashSet<u32> = decorations.filter_map(target).collect();
    let blocks = module.functions.iter().flat_map(|function| &function.blocks);
    let arithmetic = blocks.flat_map(|block| &block.instructions);
    let arithmetic = arithmetic.filter(|instruction| is_float_arithmetic(instruction.class.opcode));
    let results = arithmetic.filter_map(|instruction| instruction.result_id);
    results.filter(|id| !decorated.contains(id)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::snippet;
    use super::*;

    #[test]
    fn float_arithmetic_is_marked_once_and_nothing_else_is() {
        let mut module = snippet::module(
            "%10 = OpFAdd %float %7 %f1
            %11 = OpFNegate %float %10
            %12 = OpExtInst %float %3 FAbs %11
            %13 = OpIAdd %uint %u4 %u4
            OpStore %6 %12",
        );
        let before = module.annotations.len();
        let error = check_no_contraction(&module).unwrap_err();
        assert!(error.to_string().starts_with("2 float results lost their NoContraction"), "{error}");
        for _ in 0..2 {
            no_contraction(&mut module);
            let ids = module.annotations[before..].iter().map(|annotation| annotation.operands[0].clone());
            assert_eq!(ids.collect::<Vec<_>>(), [Operand::IdRef(10), Operand::IdRef(11)]);
            check_no_contraction(&module).unwrap();
        }
        snippet::assert_valid(&module);
    }
}
