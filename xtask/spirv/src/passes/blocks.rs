//! Blocks of a function's control flow: their labels, their predecessors, and the phis that they begin with.

use rspirv::dr::{Block, Function, Instruction, Operand};
use rspirv::spirv::{Op, Word};

/// The phis, with which a block begins.
pub fn phis(block: &Block) -> impl Iterator<Item = &Instruction> {
    block.instructions.iter().take_while(|instruction| instruction.class.opcode == Op::Phi)
}

/// Takes the phis out of a block.
pub fn take_phis(block: &mut Block) -> Vec<Instruction> {
    let count = phis(block).count();
    block.instructions.drain(..count).collect()
}

/// What a phi takes when control comes from `predecessor`; 0, which no id is, if it does not know it.
pub fn incoming(phi: &Instruction, predecessor: Word) -> Word {
    let mut pairs = phi.operands.chunks_exact(2);
    let pair = pairs.find(|pair| pair[1].id_ref_any() == Some(predecessor));
    pair.and_then(|pair| pair[0].id_ref_any()).unwrap_or(0)
}

/// Makes all phis know the predecessor `from` as `to`.
pub fn rename_predecessor(function: &mut Function, from: Word, to: Word) {
    let instructions = function.blocks.iter_mut().flat_map(|block| &mut block.instructions);
    for phi in instructions.filter(|instruction| instruction.class.opcode == Op::Phi) {
        for operand in &mut phi.operands {
            if *operand == Operand::IdRef(from) {
                *operand = Operand::IdRef(to);
            }
        }
    }
}

/// True for the block through which a loop repeats.
pub fn is_continue_target(function: &Function, block: Word) -> bool {
    let instructions = function.blocks.iter().flat_map(|block| &block.instructions);
    instructions
        .filter(|instruction| instruction.class.opcode == Op::LoopMerge)
        .any(|merge| merge.operands[1].id_ref_any() == Some(block))
}

/// The id that branches call a block by.
pub fn label(block: &Block) -> Word {
    block.label.as_ref().and_then(|label| label.result_id).unwrap_or(0)
}

/// The place of the block with this label.
pub fn index_of(function: &Function, wanted: Word) -> Option<usize> {
    function.blocks.iter().position(|block| label(block) == wanted)
}

/// How many blocks branch to this one.
pub fn predecessors(function: &Function, block: Word) -> usize {
    let ends = function.blocks.iter().filter_map(|block| block.instructions.last());
    ends.filter(|end| end.operands.contains(&Operand::IdRef(block))).count()
}

/// Removes the blocks at these places.
pub fn remove(function: &mut Function, gone: &[usize]) {
    let mut place = 0..;
    function.blocks.retain(|_| place.next().is_none_or(|place| !gone.contains(&place)));
}
