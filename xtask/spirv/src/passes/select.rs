//! Selects for branches.
//!
//! rust-gpu makes a branch of every `if`, and spirv-opt turns few of them into selects: none that choose between
//! structs, for one. Where both sides are a few pure operations, a GPU, and LLVM's vectors more so, does both sides
//! sooner than it branches. GLSL's `?:` is a select from the start.

use super::blocks::{
    incoming, index_of, is_continue_target, label, predecessors, remove, rename_predecessor, take_phis,
};
use super::globals::{Globals, extract, instruction};
use anyhow::Result;
use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};
use std::ops::RangeInclusive;

/// Replaces each conditional branch around pure instructions by those and selects.
pub fn for_branches(module: &mut Module) -> Result<()> {
    Globals::pass(module, |functions, globals| {
        for function in functions {
            while let Some(diamond) =
                (0..function.blocks.len()).find_map(|head| diamond(function, head, globals))
            {
                flatten(function, &diamond, globals);
            }
        }
    })
}

/// A head that branches to one or two arms, or past one, which meet again.
struct Diamond {
    head: usize,
    condition: Word,
    /// The arm's block, if it has one, and the predecessor by which the meeting block's phis know it.
    arms: [(Option<usize>, Word); 2],
    meeting: usize,
}

fn diamond(function: &Function, head: usize, globals: &Globals) -> Option<Diamond> {
    let [.., merge, branch] = function.blocks[head].instructions.as_slice() else { return None };
    if merge.class.opcode != Op::SelectionMerge || branch.class.opcode != Op::BranchConditional {
        return None;
    }
    let condition = branch.operands[0].id_ref_any()?;
    let meeting = index_of(function, merge.operands[0].id_ref_any()?)?;
    let arm = |target: &Operand| {
        let block = index_of(function, target.id_ref_any()?)?;
        if block == meeting {
            return Some((None, label(&function.blocks[head])));
        }
        is_arm(function, block, meeting, globals).then(|| (Some(block), label(&function.blocks[block])))
    };
    let arms = [arm(&branch.operands[1])?, arm(&branch.operands[2])?];
    let meets_alone = predecessors(function, label(&function.blocks[meeting])) == 2;
    let is_one = arms[0].1 != arms[1].1 && meets_alone && !is_of_a_loop(function, condition);
    is_one.then_some(Diamond { head, condition, arms, meeting })
}

/// True for a block of pure instructions between one predecessor and the meeting block.
fn is_arm(function: &Function, block: usize, meeting: usize, globals: &Globals) -> bool {
    let block = &function.blocks[block];
    let [body @ .., last] = block.instructions.as_slice() else { return false };
    last.class.opcode == Op::Branch
        && last.operands[0].id_ref_any() == Some(label(&function.blocks[meeting]))
        && predecessors(function, label(block)) == 1
        && body.iter().all(|instruction| is_pure(instruction, globals))
}

/// True where this condition ends or repeats a loop too: its body is not to be done once more.
fn is_of_a_loop(function: &Function, condition: Word) -> bool {
    function.blocks.iter().any(|block| match block.instructions.as_slice() {
        [.., merge, branch] => {
            merge.class.opcode != Op::SelectionMerge
                && branch.class.opcode == Op::BranchConditional
                && branch.operands[0].id_ref_any() == Some(condition)
        }
        [branch] => branch.operands.first() == Some(&Operand::IdRef(condition)),
        [] => false,
    })
}

/// Moves the arms into the head, makes selects of the meeting block's phis, and joins that block to the head where
/// nothing else refers to it.
fn flatten(function: &mut Function, diamond: &Diamond, globals: &mut Globals) {
    let Diamond { head, condition, arms, meeting } = *diamond;
    let mut moved: Vec<Instruction> = Vec::new();
    for block in arms.iter().filter_map(|(block, _)| *block) {
        let instructions = &mut function.blocks[block].instructions;
        instructions.pop();
        moved.append(instructions);
    }
    let phis = take_phis(&mut function.blocks[meeting]);
    for phi in &phis {
        let [yes, no] = arms.map(|(_, predecessor)| incoming(phi, predecessor));
        if let (Some(of_type), Some(result)) = (phi.result_type, phi.result_id) {
            select(globals, &mut moved, of_type, result, [condition, yes, no]);
        }
    }
    let meeting_label = label(&function.blocks[meeting]);
    let instructions = &mut function.blocks[head].instructions;
    instructions.truncate(instructions.len() - 2);
    instructions.append(&mut moved);
    let head_label = label(&function.blocks[head]);
    let mut gone: Vec<usize> = arms.iter().filter_map(|(block, _)| *block).collect();
    if is_continue_target(function, meeting_label) {
        let branch = Instruction::new(Op::Branch, None, None, vec![Operand::IdRef(meeting_label)]);
        function.blocks[head].instructions.push(branch);
    } else {
        let mut rest = std::mem::take(&mut function.blocks[meeting].instructions);
        function.blocks[head].instructions.append(&mut rest);
        rename_predecessor(function, meeting_label, head_label);
        gone.push(meeting);
    }
    remove(function, &gone);
}

/// Operations without memory and without undefined behaviour, in the order of SPIR-V's numbers.
const PURE: [RangeInclusive<Op>; 11] = {
    use Op::*;
    [
        Undef..=Undef,
        VectorShuffle..=CopyObject,
        ConvertFToU..=ConvertUToF,
        Bitcast..=Bitcast,
        SNegate..=FMul,
        FDiv..=FDiv,
        VectorTimesScalar..=VectorTimesScalar,
        Dot..=Dot,
        UMulExtended..=SMulExtended,
        LogicalEqual..=FUnordGreaterThanEqual,
        ShiftRightLogical..=Not,
    ]
};

/// True for what may be done though its result is not wanted.
fn is_pure(instruction: &Instruction, globals: &Globals) -> bool {
    match (instruction.class.opcode, instruction.operands.as_slice()) {
        // Of the extended instructions, all of GLSL.std.450, Modf and Frexp write memory.
        (Op::ExtInst, operands) => !matches!(operands[1], Operand::LiteralExtInstInteger(35 | 51)),
        (Op::UDiv | Op::UMod, [_, Operand::IdRef(divisor)]) => {
            globals.value(*divisor).is_some_and(|value| value > 0)
        }
        (opcode, _) => PURE.iter().any(|range| range.contains(&opcode)),
    }
}

/// Appends what makes `result` the one or the other of two values of this type. Vectors, structs and arrays are
/// selected by members: SPIR-V 1.3 selects no whole ones by a single condition.
fn select(
    globals: &mut Globals,
    to: &mut Vec<Instruction>,
    of_type: Word,
    result: Word,
    [condition, yes, no]: [Word; 3],
) {
    let Some(members) = globals.members(of_type) else {
        to.push(instruction(Op::Select, of_type, result, &[condition, yes, no]));
        return;
    };
    let mut parts = Vec::new();
    for (n, member) in (0..).zip(members) {
        let [yes, no] = [yes, no].map(|whole| {
            let part = globals.fresh();
            to.push(extract(member, part, whole, n));
            part
        });
        let part = globals.fresh();
        select(globals, to, member, part, [condition, yes, no]);
        parts.push(part);
    }
    to.push(instruction(Op::CompositeConstruct, of_type, result, &parts));
}

#[cfg(test)]
mod tests {
    use super::super::snippet::{assert_valid, guarded_loop, instructions, module, one_arm, opcodes};
    use super::*;

    /// Flattens the snippet; its opcodes.
    fn flattened(lines: &str) -> (Module, Vec<Op>) {
        let mut module = module(lines);
        for_branches(&mut module).unwrap();
        assert_valid(&module);
        let opcodes = opcodes(&module);
        (module, opcodes)
    }

    #[test]
    fn one_pure_arm_becomes_a_select() {
        let lines = one_arm("%11 = OpFNegate %float %7", "%12 = OpPhi %float %7 %5 %11 %21 OpStore %6 %12");
        let (module, opcodes) = flattened(&lines);
        assert_eq!(opcodes, [Op::FOrdLessThan, Op::FNegate, Op::Select, Op::Store, Op::Return]);
        let select = instructions(&module)[2];
        assert_eq!(select.result_id, Some(12));
        assert_eq!(select.operands, [10, 11, 7].map(Operand::IdRef));
    }

    #[test]
    fn two_arms_of_vectors_are_selected_by_members() {
        let (_, opcodes) = flattened(
            "%10 = OpFOrdLessThan %bool %7 %f0
            OpSelectionMerge %22 None
            OpBranchConditional %10 %20 %21
            %20 = OpLabel
            %11 = OpCompositeConstruct %pair %7 %f0
            OpBranch %22
            %21 = OpLabel
            %12 = OpCompositeConstruct %pair %f1 %7
            OpBranch %22
            %22 = OpLabel
            %13 = OpPhi %pair %11 %20 %12 %21
            %14 = OpCompositeExtract %float %13 0
            OpStore %6 %14",
        );
        let selects = opcodes.iter().filter(|opcode| **opcode == Op::Select).count();
        assert_eq!((selects, opcodes.contains(&Op::Phi)), (2, false));
    }

    #[test]
    fn arms_within_arms_become_selects_from_the_inside() {
        let (_, opcodes) = flattened(
            "%10 = OpFOrdLessThan %bool %7 %f0
            OpSelectionMerge %25 None
            OpBranchConditional %10 %21 %25
            %21 = OpLabel
            %11 = OpFOrdLessThan %bool %7 %f1
            OpSelectionMerge %23 None
            OpBranchConditional %11 %22 %23
            %22 = OpLabel
            OpBranch %23
            %23 = OpLabel
            %12 = OpPhi %float %f0 %21 %f1 %22
            OpBranch %25
            %25 = OpLabel
            %13 = OpPhi %float %7 %5 %12 %23
            OpStore %6 %13",
        );
        assert_eq!(
            opcodes,
            [Op::FOrdLessThan, Op::FOrdLessThan, Op::Select, Op::Select, Op::Store, Op::Return]
        );
    }

    /// What writes memory or is not defined everywhere stays in its arm.
    #[test]
    fn impure_arms_stay() {
        let of_uint = "%13 = OpPhi %uint %u0 %5 %12 %21";
        for (arm, rest) in
            [("OpStore %6 %f0", ""), ("%11 = OpConvertFToU %uint %7 %12 = OpUDiv %uint %u4 %11", of_uint)]
        {
            let lines = one_arm(arm, rest);
            assert_eq!(flattened(&lines).1, opcodes(&module(&lines)));
        }
        let by_constant = one_arm("%11 = OpConvertFToU %uint %7 %12 = OpUDiv %uint %11 %u4", of_uint);
        assert!(flattened(&by_constant).1.contains(&Op::Select));
    }

    /// A condition that repeats a loop keeps its branch.
    #[test]
    fn loops_stay() {
        let lines = guarded_loop("OpStore %6 %10");
        assert_eq!(flattened(&lines).1, opcodes(&module(&lines)));
    }
}
