//! Exits of loops.
//!
//! rust-gpu puts the body of a `while` into an arm beside an empty one, and asks its condition once more where the loop
//! repeats. GLSL leaves a loop where the condition fails, which costs one mask less a round where invocations are
//! lanes of a vector.

use super::blocks::{incoming, index_of, label, phis, predecessors, remove};
use super::globals::ids;
use rspirv::dr::{Block, Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};

/// Makes each loop whose body is an arm leave from where that begins.
pub fn at_conditions(module: &mut Module) {
    for function in &mut module.functions {
        while let Some(found) = (0..function.blocks.len()).find_map(|header| guarded(function, header)) {
            unguard(function, &found);
        }
    }
}

/// A loop that does nothing but its body in an arm, all as indices of blocks: `header: branch guard; guard: if condition
/// { body } else { nothing }, which meet; meeting: branch repeat; repeat: if condition { header } else { end }`.
struct Guarded {
    header: usize,
    guard: usize,
    body: usize,
    nothing: usize,
    meeting: usize,
    repeat: usize,
    end: Word,
}

fn guarded(function: &Function, header: usize) -> Option<Guarded> {
    let block = |id: Word| index_of(function, id);
    let instructions = |block: usize| function.blocks[block].instructions.as_slice();

    let [.., merge, _] = instructions(header) else { return None };
    let guard = block(only_target(&function.blocks[header])?)?;
    if merge.class.opcode != Op::LoopMerge {
        return None;
    }
    let (end, repeat) = (merge.operands[0].id_ref_any()?, block(merge.operands[1].id_ref_any()?)?);

    let [.., merge, branch] = instructions(guard) else { return None };
    if merge.class.opcode != Op::SelectionMerge || branch.class.opcode != Op::BranchConditional {
        return None;
    }
    let meeting = block(merge.operands[0].id_ref_any()?)?;
    let [condition, body, nothing] = [0, 1, 2].map(|n| branch.operands[n].id_ref_any());
    let (body, nothing) = (block(body?)?, block(nothing?)?);

    let [again] = instructions(repeat) else { return None };
    let ends = [condition, Some(label(&function.blocks[header])), Some(end)];
    let repeats = again.class.opcode == Op::BranchConditional
        && [0, 1, 2].map(|n| again.operands[n].id_ref_any()) == ends;

    let ends_in = |from: usize, to: usize| {
        only_target(&function.blocks[from]) == Some(label(&function.blocks[to]))
            && predecessors(function, label(&function.blocks[from])) == 1
    };
    let only_meets = phis(&function.blocks[meeting]).count() + 1 == instructions(meeting).len()
        && only_target(&function.blocks[meeting]) == Some(label(&function.blocks[repeat]))
        && predecessors(function, label(&function.blocks[repeat])) == 1;
    let is_guarded = repeats
        && only_meets
        && ends_in(body, meeting)
        && ends_in(nothing, meeting)
        && instructions(nothing).len() == 1
        && is_known_to_header_alone(function, meeting, header)
        && block(end).is_some_and(|end| phis(&function.blocks[end]).count() == 0);
    is_guarded.then_some(Guarded { header, guard, body, nothing, meeting, repeat, end })
}

/// Where the block branches to, if to one only.
fn only_target(block: &Block) -> Option<Word> {
    let last = block.instructions.last()?;
    if last.class.opcode == Op::Branch { last.operands[0].id_ref_any() } else { None }
}

/// True if nothing but the header's phis uses the phis of the meeting block.
fn is_known_to_header_alone(function: &Function, meeting: usize, header: usize) -> bool {
    let results: Vec<Word> = phis(&function.blocks[meeting]).filter_map(|phi| phi.result_id).collect();
    let uses = |instruction: &&Instruction| ids(instruction).iter().any(|id| results.contains(id));
    function.blocks.iter().enumerate().all(|(n, block)| {
        let mut users = block.instructions.iter().filter(uses);
        users.all(|user| n == header && user.class.opcode == Op::Phi)
    })
}

/// Leaves the loop at the guard; the body goes on to `repeat`, which always repeats.
fn unguard(function: &mut Function, found: &Guarded) {
    let Guarded { header, guard, body, nothing, meeting, repeat, end } = *found;
    let [header_label, body_label, repeat_label] =
        [header, body, repeat].map(|block| label(&function.blocks[block]));
    let from_body: Vec<(Word, Word)> = phis(&function.blocks[meeting])
        .filter_map(|phi| phi.result_id.map(|result| (result, incoming(phi, body_label))))
        .collect();
    for phi in &mut function.blocks[header].instructions {
        for operand in &mut phi.operands {
            if let Some((_, value)) = from_body.iter().find(|(id, _)| *operand == Operand::IdRef(*id)) {
                *operand = Operand::IdRef(*value);
            }
        }
    }
    let instructions = &mut function.blocks[guard].instructions;
    instructions.remove(instructions.len() - 2);
    if let Some(branch) = instructions.last_mut() {
        branch.operands[2] = Operand::IdRef(end);
    }
    for (block, target) in [(body, repeat_label), (repeat, header_label)] {
        let instructions = &mut function.blocks[block].instructions;
        instructions.pop();
        instructions.push(Instruction::new(Op::Branch, None, None, vec![Operand::IdRef(target)]));
    }
    remove(function, &[nothing, meeting]);
}

#[cfg(test)]
mod tests {
    use super::super::snippet::{assert_valid, guarded_loop, module, opcodes};
    use super::*;

    #[test]
    fn a_loop_leaves_at_its_condition() {
        let mut module = module(&guarded_loop("OpStore %6 %10"));
        at_conditions(&mut module);
        assert_valid(&module);
        let expected = "[Branch, Phi, LoopMerge, Branch, FOrdLessThan, BranchConditional, FAdd, Branch, Branch, Store, \
                        Return]";
        assert_eq!(format!("{:?}", opcodes(&module)), expected);
        let [_, header, guard, body, repeat, end] = module.functions[0].blocks.as_slice() else { panic!() };
        assert_eq!(ids(&header.instructions[0])[2..], [12, 25], "the phi takes the body's result");
        let leave = guard.instructions.last().unwrap();
        assert_eq!(ids(leave), [11, label(body), label(end)]);
        assert_eq!((only_target(body), only_target(repeat)), (Some(25), Some(20)));
    }

    /// What the loop leaves in its last round is known only where the arms meet.
    #[test]
    fn a_loop_whose_result_is_used_stays() {
        let lines = guarded_loop("OpStore %6 %13");
        let mut module = module(&lines);
        at_conditions(&mut module);
        assert_eq!(opcodes(&module), opcodes(&super::super::snippet::module(&lines)));
    }
}
