//! SPIR-V modules, rewritten to compute as a device of a [`Model`] does.
//!
//! Each operation that the model concerns becomes a call of a function that is added to the module. Operations on vectors
//! become one call a component.

mod functions;
mod globals;

use super::Model;
use crate::vulkan::check_spirv;
use functions::Function;
use globals::{Globals, Type};
use rspirv::binary::Assemble;
use rspirv::dr::{Block, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, GLOp, Op, Word};
use std::collections::{HashMap, HashSet};

/// A module that cannot be rewritten.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The parser does not take it.
    #[error("the SPIR-V module {module} cannot be parsed ({reason}); `cargo xtask spirv` rebuilds it")]
    NotSpirv {
        /// Kernel it is of.
        module: String,
        /// What the parser says.
        reason: String,
    },
    /// An operation on floats whose error none of the models knows.
    #[error(
        "the SPIR-V module {module} has {operation} on floats, which no model of an imprecise device covers; write it with \
         the operations that all codecs keep to"
    )]
    NotModelled {
        /// Kernel it is of.
        module: String,
        /// Operation.
        operation: String,
    },
}

/// The module of a kernel, which has this entry point, computing as the model does. `seed` chooses the directions of [`Model::Bits`].
///
/// # Errors
/// [`Error`].
pub fn rewrite(
    spirv: &[u8],
    (kernel, entry_point): (&str, &str),
    model: Model,
    seed: u32,
) -> Result<Vec<u8>, Error> {
    let not_spirv = |reason: String| Error::NotSpirv { module: kernel.to_owned(), reason };
    // The parser panics where an instruction is longer than what is left.
    check_spirv(spirv, entry_point).map_err(|error| not_spirv(error.to_string()))?;
    let mut module = rspirv::dr::load_bytes(spirv).map_err(|error| not_spirv(format!("{error:?}")))?;
    let mut functions = std::mem::take(&mut module.functions);
    let types = Types::of(&module);
    let mut rewriter = Rewriter { globals: Globals::new(module), types, model, seed, calls: HashSet::new() };
    for function in &mut functions {
        rewriter.types.add(function.parameters.iter());
        for block in &mut function.blocks {
            rewriter
                .block(block)
                .map_err(|operation| Error::NotModelled { module: kernel.to_owned(), operation })?;
        }
    }
    let Rewriter { mut globals, calls, .. } = rewriter;
    // The decoration is one of arithmetic instructions alone.
    globals.annotations().retain(|annotation| {
        let is_of_call =
            annotation.operands.first().and_then(Operand::id_ref_any).is_some_and(|id| calls.contains(&id));
        !(is_of_call && annotation.operands.get(1) == Some(&Operand::Decoration(Decoration::NoContraction)))
    });
    let module = globals.with_functions(functions);
    Ok(module.assemble().iter().flat_map(|word| word.to_le_bytes()).collect())
}

/// The types of a module that have floats of 32 bits, and the types of values.
struct Types {
    float: Option<Word>,
    /// Components of float vectors, by type.
    vectors: HashMap<Word, u32>,
    of_values: HashMap<Word, Word>,
}

impl Types {
    fn of(module: &Module) -> Self {
        let is_float = |global: &&Instruction| {
            global.class.opcode == Op::TypeFloat && global.operands == [Operand::LiteralBit32(32)]
        };
        let float = module.types_global_values.iter().find(is_float).and_then(|global| global.result_id);
        let vectors = module.types_global_values.iter().filter_map(|global| match global.operands[..] {
            [Operand::IdRef(of), Operand::LiteralBit32(components)]
                if global.class.opcode == Op::TypeVector && Some(of) == float =>
            {
                Some((global.result_id?, components))
            }
            _ => None,
        });
        let mut types = Self { float, vectors: vectors.collect(), of_values: HashMap::new() };
        types.add(module.types_global_values.iter());
        types
    }

    fn add<'a>(&mut self, instructions: impl Iterator<Item = &'a Instruction>) {
        let typed =
            instructions.filter_map(|instruction| Some((instruction.result_id?, instruction.result_type?)));
        self.of_values.extend(typed);
    }

    /// The components of a type's values where they are floats: 1 for float itself.
    fn components(&self, of_type: Word) -> Option<u32> {
        if Some(of_type) == self.float { Some(1) } else { self.vectors.get(&of_type).copied() }
    }
}

/// What an operation on floats means to the models.
enum Meaning {
    /// It is no operation on floats, or copies them as bits.
    Other,
    /// Arithmetic that a model may do by a function of its own.
    Arithmetic(Function),
    /// Exact, but for denormals.
    Exact,
    /// Unknown.
    NotModelled,
}

fn meaning(instruction: &Instruction) -> Meaning {
    match instruction.class.opcode {
        Op::FDiv => Meaning::Arithmetic(Function::Divide),
        Op::FAdd => Meaning::Arithmetic(Function::Add),
        Op::FSub => Meaning::Arithmetic(Function::Subtract),
        Op::FMul | Op::VectorTimesScalar => Meaning::Arithmetic(Function::Multiply),
        Op::ConvertSToF => Meaning::Arithmetic(Function::ConvertSigned),
        Op::ConvertUToF => Meaning::Arithmetic(Function::ConvertUnsigned),
        Op::FNegate
        | Op::ConvertFToS
        | Op::ConvertFToU
        | Op::FOrdEqual
        | Op::FUnordEqual
        | Op::FOrdNotEqual
        | Op::FUnordNotEqual
        | Op::FOrdLessThan
        | Op::FUnordLessThan
        | Op::FOrdGreaterThan
        | Op::FUnordGreaterThan
        | Op::FOrdLessThanEqual
        | Op::FUnordLessThanEqual
        | Op::FOrdGreaterThanEqual
        | Op::FUnordGreaterThanEqual => Meaning::Exact,
        Op::ExtInst => extended(instruction),
        Op::FRem
        | Op::FMod
        | Op::Dot
        | Op::VectorTimesMatrix
        | Op::MatrixTimesScalar
        | Op::MatrixTimesVector
        | Op::MatrixTimesMatrix
        | Op::OuterProduct
        | Op::FConvert
        | Op::QuantizeToF16 => Meaning::NotModelled,
        _ => Meaning::Other,
    }
}

fn extended(instruction: &Instruction) -> Meaning {
    match extended_operation(instruction) {
        Some(GLOp::Sqrt) => Meaning::Arithmetic(Function::SquareRoot),
        Some(
            GLOp::FAbs
            | GLOp::Floor
            | GLOp::Trunc
            | GLOp::Ceil
            | GLOp::FMin
            | GLOp::FMax
            | GLOp::FClamp
            | GLOp::NMin
            | GLOp::NMax
            | GLOp::NClamp,
        ) => Meaning::Exact,
        Some(
            GLOp::SAbs
            | GLOp::UMin
            | GLOp::SMin
            | GLOp::UMax
            | GLOp::SMax
            | GLOp::UClamp
            | GLOp::SClamp
            | GLOp::FindILsb
            | GLOp::FindSMsb
            | GLOp::FindUMsb,
        ) => Meaning::Other,
        _ => Meaning::NotModelled,
    }
}

/// The operation of an instruction of GLSL.std.450, the one extended set that kernels import.
fn extended_operation(instruction: &Instruction) -> Option<GLOp> {
    match instruction.operands.get(1) {
        Some(Operand::LiteralExtInstInteger(number)) => GLOp::from_u32(*number),
        _ => None,
    }
}

fn name(instruction: &Instruction) -> String {
    match extended_operation(instruction) {
        Some(operation) => format!("{operation:?}"),
        None => format!("{:?}", instruction.class.opcode),
    }
}

struct Rewriter {
    globals: Globals,
    types: Types,
    model: Model,
    seed: u32,
    /// Results that came from arithmetic and come from calls.
    calls: HashSet<Word>,
}

impl Rewriter {
    fn block(&mut self, block: &mut Block) -> Result<(), String> {
        self.types.add(block.instructions.iter());
        let mut rewritten = Vec::with_capacity(2 * block.instructions.len());
        for instruction in block.instructions.drain(..) {
            match meaning(&instruction) {
                Meaning::Other => rewritten.push(instruction),
                Meaning::Exact => self.operation(instruction, None, &mut rewritten),
                Meaning::Arithmetic(function) => {
                    let function = function.is_changed_by(self.model).then_some(function);
                    self.operation(instruction, function, &mut rewritten);
                }
                Meaning::NotModelled => return Err(name(&instruction)),
            }
        }
        block.instructions = rewritten;
        Ok(())
    }

    /// An operation on floats, by `function` where the model has its own, with denormals flushed where the model does that.
    fn operation(
        &mut self,
        mut instruction: Instruction,
        function: Option<Function>,
        block: &mut Vec<Instruction>,
    ) {
        if self.model == Model::Flush {
            for operand in &mut instruction.operands {
                let Some(id) = operand.id_ref_any() else { continue };
                let Some(of_type) = self.types.of_values.get(&id).copied() else { continue };
                if let Some(components) = self.types.components(of_type) {
                    let flushed = self.globals.fresh();
                    self.each_component(
                        Function::Flush,
                        components,
                        (of_type, flushed),
                        &[(id, components)],
                        block,
                    );
                    *operand = Operand::IdRef(flushed);
                }
            }
        }
        let (Some(of_type), Some(result)) = (instruction.result_type, instruction.result_id) else {
            return block.push(instruction);
        };
        let components = self.types.components(of_type);
        match (components, function) {
            (Some(components), Some(function)) => {
                self.calls.insert(result);
                let first = instruction.operands.len() - function.parameters().len();
                let operands: Vec<Word> =
                    instruction.operands[first..].iter().filter_map(Operand::id_ref_any).collect();
                let operands: Vec<(Word, u32)> = operands
                    .into_iter()
                    .zip(function.parameters())
                    .map(|(id, of_type)| (self.integer_as(*of_type, id, block), self.components_of(id)))
                    .collect();
                self.each_component(function, components, (of_type, result), &operands, block);
            }
            (Some(components), None) if self.model == Model::Flush => {
                self.calls.insert(result);
                let raw = self.globals.fresh();
                instruction.result_id = Some(raw);
                block.push(instruction);
                self.each_component(
                    Function::Flush,
                    components,
                    (of_type, result),
                    &[(raw, components)],
                    block,
                );
            }
            _ => block.push(instruction),
        }
    }

    /// An integer of either signedness as one of the parameter's type; floats stay as they are.
    fn integer_as(&mut self, of_type: Type, id: Word, block: &mut Vec<Instruction>) -> Word {
        let expected = self.globals.of_type(of_type);
        if of_type == Type::Float || self.types.of_values.get(&id) == Some(&expected) {
            return id;
        }
        let cast = self.globals.fresh();
        let operand = vec![Operand::IdRef(id)];
        block.push(Instruction::new(Op::Bitcast, Some(expected), Some(cast), operand));
        cast
    }

    /// The components of a value; 1 of those that are no vectors of floats.
    fn components_of(&self, id: Word) -> u32 {
        self.types.of_values.get(&id).and_then(|of_type| self.types.components(*of_type)).unwrap_or(1)
    }

    /// Calls a function for each component; operands of one component stand for all.
    fn each_component(
        &mut self,
        function: Function,
        components: u32,
        (of_type, result): (Word, Word),
        operands: &[(Word, u32)],
        block: &mut Vec<Instruction>,
    ) {
        let callee = self.globals.function(function, self.model, self.seed);
        if components == 1 {
            let ids: Vec<Word> = operands.iter().map(|(id, _)| *id).collect();
            return block.push(call(of_type, result, callee, &ids));
        }
        let float = self.globals.of_type(Type::Float);
        let parts: Vec<Word> = (0..components)
            .map(|component| {
                let ids: Vec<Word> = operands
                    .iter()
                    .map(|(id, of)| if *of == 1 { *id } else { self.extract(float, *id, component, block) })
                    .collect();
                let part = self.globals.fresh();
                block.push(call(float, part, callee, &ids));
                part
            })
            .collect();
        let parts = parts.into_iter().map(Operand::IdRef).collect();
        block.push(Instruction::new(Op::CompositeConstruct, Some(of_type), Some(result), parts));
    }

    fn extract(&mut self, float: Word, from: Word, component: u32, block: &mut Vec<Instruction>) -> Word {
        let id = self.globals.fresh();
        let operands = vec![Operand::IdRef(from), Operand::LiteralBit32(component)];
        block.push(Instruction::new(Op::CompositeExtract, Some(float), Some(id), operands));
        id
    }
}

fn call(of_type: Word, result: Word, callee: Word, arguments: &[Word]) -> Instruction {
    let operands = [callee].iter().chain(arguments).map(|id| Operand::IdRef(*id)).collect();
    Instruction::new(Op::FunctionCall, Some(of_type), Some(result), operands)
}
