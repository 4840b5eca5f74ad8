//! Snippets of SPIR-V as text, for the tests of passes.

use super::{ENVIRONMENT, parse};
use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module};
use rspirv::spirv::Op;
use spirv_tools::assembler::{self, Assembler, AssemblerOptions};
use spirv_tools::val::{self, Validator};

/// What every snippet begins with: an entry point %1, some types and constants, and a buffer %2 of one float.
const BEGINNING: &str = include_str!("snippets/beginning.spvasm");

/// The module of a function with these lines. They begin in its first block, %5, where %6 is the buffer's address and
/// %7 what it holds.
pub fn module(lines: &str) -> Module {
    let text = format!(
        "{BEGINNING} %1 = OpFunction %void None %procedure
        %5 = OpLabel
        %6 = OpAccessChain %pointer %2 %u0
        %7 = OpLoad %float %6
        {lines}
        OpReturn
        OpFunctionEnd"
    );
    let module = assembled(&text);
    assert_valid(&module);
    module
}

/// Lines of a branch around an arm, and what follows.
pub fn one_arm(arm: &str, rest: &str) -> String {
    format!(include_str!("snippets/one_arm.spvasm"), arm = arm, rest = rest)
}

/// Lines of a loop as rust-gpu writes `while`, and these after it.
pub fn guarded_loop(rest: &str) -> String {
    format!(include_str!("snippets/guarded_loop.spvasm"), rest = rest)
}

/// The module of this text, with its numbers as ids.
pub fn assembled(text: &str) -> Module {
    let options = AssemblerOptions { preserve_numeric_ids: true };
    let binary = assembler::create(Some(ENVIRONMENT)).assemble(text, options).unwrap();
    parse(binary.as_words()).unwrap()
}

/// Fails where spirv-val objects.
pub fn assert_valid(module: &Module) {
    val::create(Some(ENVIRONMENT)).validate(module.assemble(), None).unwrap();
}

/// The instructions of the functions, without labels, after the first two of [`module`].
pub fn instructions(module: &Module) -> Vec<&Instruction> {
    let blocks = module.functions.iter().flat_map(|function| &function.blocks);
    blocks.flat_map(|block| &block.instructions).skip(2).collect()
}

/// The opcodes of [`instructions`].
pub fn opcodes(module: &Module) -> Vec<Op> {
    instructions(module).iter().map(|instruction| instruction.class.opcode).collect()
}
