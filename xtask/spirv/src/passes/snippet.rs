//! Snippets of SPIR-V as text, for the tests of passes.

use super::{ENVIRONMENT, parse};
use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module};
use rspirv::spirv::Op;
use spirv_tools::assembler::{self, Assembler, AssemblerOptions};
use spirv_tools::val::{self, Validator};

/// What every snippet begins with: an entry point %1, some types and constants, and a buffer %2 of one float.
const BEGINNING: &str = r#"
    OpCapability Shader
    %3 = OpExtInstImport "GLSL.std.450"
    OpMemoryModel Logical GLSL450
    OpEntryPoint GLCompute %1 "main"
    OpExecutionMode %1 LocalSize 64 1 1
    OpDecorate %4 Block
    OpMemberDecorate %4 0 Offset 0
    OpDecorate %2 DescriptorSet 0
    OpDecorate %2 Binding 0
    %void = OpTypeVoid
    %procedure = OpTypeFunction %void
    %bool = OpTypeBool
    %uint = OpTypeInt 32 0
    %int = OpTypeInt 32 1
    %float = OpTypeFloat 32
    %pair = OpTypeVector %float 2
    %4 = OpTypeStruct %float
    %buffer = OpTypePointer StorageBuffer %4
    %pointer = OpTypePointer StorageBuffer %float
    %2 = OpVariable %buffer StorageBuffer
    %u0 = OpConstant %uint 0
    %u4 = OpConstant %uint 4
    %u20 = OpConstant %uint 20
    %u22 = OpConstant %uint 22
    %true = OpConstantTrue %bool
    %false = OpConstantFalse %bool
    %f0 = OpConstant %float 0
    %f1 = OpConstant %float 1
"#;

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
