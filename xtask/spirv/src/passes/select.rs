//! Selects for branches.
//!
//! rust-gpu makes a branch of every `if`, and spirv-opt turns few of them into selects: none that choose between
//! structs, for one. Where both sides are a few pure operations, a GPU, and LLVM's vectors more so, does both sides
//! sooner than it branches. GLSL's `?:` is a select from the start.

use super::blocks::{
    incoming, index_of, is_continue_target, label, predecessors, rename_predecessor, take_phis,
};
use anyhow::{Result, anyhow};
use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};
use std::collections::HashMap;

/// Replaces each conditional branch around pure instructions by those and selects.
pub fn for_branches(module: &mut Module) -> Result<()> {
    let header = module.header.as_ref().ok_or_else(|| anyhow!("the module has no header"))?;
    let mut types = Types::of(module, header.bound);
    for function in &mut module.functions {
        while let Some(diamond) = (0..function.blocks.len()).find_map(|head| diamond(function, head, &types))
        {
            flatten(function, &diamond, &mut types);
        }
    }
    if let Some(header) = &mut module.header {
        header.bound = types.bound;
    }
    Ok(())
}

/// A head that branches to one or two arms, or past one, which meet again.
struct Diamond {
    head: usize,
    condition: Word,
    /// The arm's block, if it has one, and the predecessor by which the meeting block's phis know it.
    arms: [(Option<usize>, Word); 2],
    meeting: usize,
}

fn diamond(function: &Function, head: usize, types: &Types) -> Option<Diamond> {
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
        is_arm(function, block, meeting, types).then(|| (Some(block), label(&function.blocks[block])))
    };
    let arms = [arm(&branch.operands[1])?, arm(&branch.operands[2])?];
    let meets_alone = predecessors(function, label(&function.blocks[meeting])) == 2;
    let is_one = arms[0].1 != arms[1].1 && meets_alone && !is_of_a_loop(function, condition);
    is_one.then_some(Diamond { head, condition, arms, meeting })
}

/// True for a block of pure instructions between one predecessor and the meeting block.
fn is_arm(function: &Function, block: usize, meeting: usize, types: &Types) -> bool {
    let block = &function.blocks[block];
    let [body @ .., last] = block.instructions.as_slice() else { return false };
    last.class.opcode == Op::Branch
        && last.operands[0].id_ref_any() == Some(label(&function.blocks[meeting]))
        && predecessors(function, label(block)) == 1
        && body.iter().all(|instruction| is_pure(instruction, types))
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
fn flatten(function: &mut Function, diamond: &Diamond, types: &mut Types) {
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
            types.select(&mut moved, of_type, result, [condition, yes, no]);
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
    gone.sort_unstable();
    for block in gone.into_iter().rev() {
        function.blocks.remove(block);
    }
}

/// True for what may be done though its result is not wanted: no memory, no undefined behaviour.
fn is_pure(instruction: &Instruction, types: &Types) -> bool {
    use Op::*;
    match instruction.class.opcode {
        FNegate
        | FAdd
        | FSub
        | FMul
        | FDiv
        | VectorTimesScalar
        | Dot
        | SNegate
        | IAdd
        | ISub
        | IMul
        | UMulExtended
        | SMulExtended
        | BitwiseAnd
        | BitwiseOr
        | BitwiseXor
        | Not
        | ShiftLeftLogical
        | ShiftRightLogical
        | ShiftRightArithmetic
        | Bitcast
        | ConvertFToS
        | ConvertFToU
        | ConvertSToF
        | ConvertUToF
        | FOrdEqual
        | FOrdNotEqual
        | FOrdLessThan
        | FOrdGreaterThan
        | FOrdLessThanEqual
        | FOrdGreaterThanEqual
        | FUnordEqual
        | FUnordNotEqual
        | FUnordLessThan
        | FUnordGreaterThan
        | FUnordLessThanEqual
        | FUnordGreaterThanEqual
        | IEqual
        | INotEqual
        | ULessThan
        | ULessThanEqual
        | UGreaterThan
        | UGreaterThanEqual
        | SLessThan
        | SLessThanEqual
        | SGreaterThan
        | SGreaterThanEqual
        | LogicalAnd
        | LogicalOr
        | LogicalNot
        | LogicalEqual
        | LogicalNotEqual
        | Select
        | CompositeExtract
        | CompositeConstruct
        | CompositeInsert
        | VectorShuffle
        | CopyObject
        | Undef => true,
        // Of the extended instructions, all of GLSL.std.450, Modf and Frexp write memory.
        ExtInst => !matches!(instruction.operands[1], Operand::LiteralExtInstInteger(35 | 51)),
        UDiv | UMod => instruction.operands[1].id_ref_any().is_some_and(|divisor| types.is_positive(divisor)),
        _ => false,
    }
}

/// The module's types and constants, and the next free id.
struct Types {
    /// Members of structs; vectors and arrays have the same one several times.
    members: HashMap<Word, Vec<Word>>,
    /// Integer constants.
    constants: HashMap<Word, u32>,
    bound: Word,
}

impl Types {
    fn of(module: &Module, bound: Word) -> Self {
        let (mut members, mut constants) = (HashMap::new(), HashMap::new());
        for instruction in &module.types_global_values {
            let Some(id) = instruction.result_id else { continue };
            let operand = |n: usize| instruction.operands.get(n).and_then(Operand::id_ref_any);
            match instruction.class.opcode {
                Op::TypeStruct => {
                    members.insert(id, instruction.operands.iter().filter_map(Operand::id_ref_any).collect());
                }
                Op::TypeVector | Op::TypeArray => {
                    let length = match instruction.operands.get(1) {
                        Some(Operand::LiteralBit32(length)) => *length,
                        _ => operand(1).and_then(|length| constants.get(&length)).copied().unwrap_or(0),
                    };
                    members.insert(id, operand(0).into_iter().cycle().take(length as usize).collect());
                }
                Op::Constant => {
                    if let Some(Operand::LiteralBit32(value)) = instruction.operands.first() {
                        constants.insert(id, *value);
                    }
                }
                _ => {}
            }
        }
        Self { members, constants, bound }
    }

    fn is_positive(&self, constant: Word) -> bool {
        self.constants.get(&constant).is_some_and(|value| *value > 0)
    }

    fn fresh(&mut self) -> Word {
        self.bound += 1;
        self.bound - 1
    }

    /// Appends what makes `result` the one or the other of two values of this type. Vectors, structs and arrays are
    /// selected by members: SPIR-V 1.3 selects no whole ones by a single condition.
    fn select(
        &mut self,
        to: &mut Vec<Instruction>,
        of_type: Word,
        result: Word,
        [condition, yes, no]: [Word; 3],
    ) {
        let ids = |ids: &[Word]| ids.iter().map(|id| Operand::IdRef(*id)).collect::<Vec<_>>();
        let Some(members) = self.members.get(&of_type).cloned() else {
            let operands = ids(&[condition, yes, no]);
            to.push(Instruction::new(Op::Select, Some(of_type), Some(result), operands));
            return;
        };
        let mut parts = Vec::new();
        for (n, member) in members.into_iter().enumerate() {
            let [yes, no] = [yes, no].map(|whole| {
                let part = self.fresh();
                let operands = vec![Operand::IdRef(whole), Operand::LiteralBit32(n as u32)];
                to.push(Instruction::new(Op::CompositeExtract, Some(member), Some(part), operands));
                part
            });
            let part = self.fresh();
            self.select(to, member, part, [condition, yes, no]);
            parts.push(part);
        }
        to.push(Instruction::new(Op::CompositeConstruct, Some(of_type), Some(result), ids(&parts)));
    }
}

#[cfg(test)]
mod tests {
    use super::super::snippet::{assert_valid, instructions, module, opcodes};
    use super::*;

    /// Flattens the snippet; its opcodes.
    fn flattened(lines: &str) -> (Module, Vec<Op>) {
        let mut module = module(lines);
        for_branches(&mut module).unwrap();
        assert_valid(&module);
        let opcodes = opcodes(&module);
        (module, opcodes)
    }

    /// A branch around an arm, and what follows.
    fn one_arm(arm: &str, rest: &str) -> String {
        format!(
            "%10 = OpFOrdLessThan %bool %7 %f0
            OpSelectionMerge %22 None
            OpBranchConditional %10 %21 %22
            %21 = OpLabel
            {arm}
            OpBranch %22
            %22 = OpLabel
            {rest}"
        )
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
        let lines = "OpBranch %20
            %20 = OpLabel
            %10 = OpPhi %float %7 %5 %13 %24
            OpLoopMerge %25 %24 None
            OpBranch %21
            %21 = OpLabel
            %11 = OpFOrdLessThan %bool %10 %f0
            OpSelectionMerge %23 None
            OpBranchConditional %11 %22 %23
            %22 = OpLabel
            %12 = OpFAdd %float %10 %f1
            OpBranch %23
            %23 = OpLabel
            %13 = OpPhi %float %10 %21 %12 %22
            OpBranch %24
            %24 = OpLabel
            OpBranchConditional %11 %20 %25
            %25 = OpLabel
            OpStore %6 %13";
        assert_eq!(flattened(lines).1, opcodes(&module(lines)));
    }
}
