//! SPIR-V modules, rewritten to compute as a device of a [`Model`] does.
//!
//! Each operation that the model concerns becomes a call of a function that is added to the module. Operations on vectors
//! become one call a component.

mod functions;
mod globals;

use super::Model;
use functions::Function;
use globals::{Globals, Type};
use rspirv::binary::Assemble;
use rspirv::dr::{Block, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, GLOp, Op, Word};
use std::collections::HashMap;
use std::sync::Arc;
use unitvec_run::backend::Rewrite;
use unitvec_vulkan::check_spirv;

/// A module that cannot be rewritten.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The parser rejects the module.
    #[error("the SPIR-V module {module} cannot be parsed ({reason}); `cargo xtask spirv` rebuilds it")]
    NotSpirv {
        /// Kernel it is of.
        module: String,
        /// The parser's message.
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
    // The parser panics where an instruction is longer than the rest of the module.
    check_spirv(spirv, entry_point).map_err(|error| not_spirv(error.to_string()))?;
    let mut module = rspirv::dr::load_bytes(spirv).map_err(|error| not_spirv(format!("{error:?}")))?;
    let mut functions = std::mem::take(&mut module.functions);
    let types = Types::of(&module);
    let mut rewriter = Rewriter { globals: Globals::new(module), types, model, seed, calls: HashMap::new() };
    for function in &mut functions {
        rewriter.types.add(function.parameters.iter());
        for block in &mut function.blocks {
            rewriter
                .block(block)
                .map_err(|operation| Error::NotModelled { module: kernel.to_owned(), operation })?;
        }
    }
    let Rewriter { mut globals, calls, .. } = rewriter;
    // The decoration is one of arithmetic instructions alone: it goes with them.
    globals.annotations().retain_mut(|annotation| {
        let [Operand::IdRef(id), Operand::Decoration(Decoration::NoContraction)] =
            &mut annotation.operands[..]
        else {
            return true;
        };
        let Some(arithmetic) = calls.get(id) else { return true };
        *id = arithmetic.unwrap_or(*id);
        arithmetic.is_some()
    });
    let module = globals.with_functions(functions);
    Ok(module.assemble().iter().flat_map(|word| word.to_le_bytes()).collect())
}

impl Model {
    /// The rewrite of kernels for a backend on such a device.
    pub fn rewrite(self, seed: u32) -> Rewrite {
        let module = move |spirv: &[u8], kernel: &str, entry_point: &str| {
            Ok(rewrite(spirv, (kernel, entry_point), self, seed)?)
        };
        Rewrite { key: (self as u64) << 32 | u64::from(seed), module: Arc::new(module) }
    }
}

/// The types of a module, and those of its values.
struct Types {
    float: Option<Word>,
    /// The type of a vector's components, and their number.
    vectors: HashMap<Word, (Word, u32)>,
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
                if global.class.opcode == Op::TypeVector =>
            {
                Some((global.result_id?, (of, components)))
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
    fn float_components(&self, of_type: Word) -> Option<u32> {
        let (component, count) = self.vectors.get(&of_type).copied().unwrap_or((of_type, 1));
        (Some(component) == self.float).then_some(count)
    }

    /// A value, with the type of its components and their number.
    fn operand(&self, id: Word) -> Value {
        let of_type = self.of_values.get(&id).copied().unwrap_or_default();
        let (component, count) = self.vectors.get(&of_type).copied().unwrap_or((of_type, 1));
        Value { id, component, count }
    }
}

/// A scalar or vector.
#[derive(Clone, Copy)]
struct Value {
    id: Word,
    /// The type of its components.
    component: Word,
    count: u32,
}

/// An operation on floats as the models see it.
enum Meaning {
    /// No operation on floats, or a copy of them as bits.
    Other,
    /// Arithmetic that a model may replace by a function of its own.
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
        Some(GLOp::InverseSqrt) => Meaning::Arithmetic(Function::InverseRoot),
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
    /// Results that came from arithmetic and come from calls, with the arithmetic's new result where it is left.
    calls: HashMap<Word, Option<Word>>,
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
            self.flush_operands(&mut instruction, block);
        }
        let (Some(of_type), Some(result)) = (instruction.result_type, instruction.result_id) else {
            return block.push(instruction);
        };
        let Some(components) = self.types.float_components(of_type) else { return block.push(instruction) };
        let result = (of_type, result, components);
        if let Some(function) = function {
            let first = instruction.operands.len() - function.parameters().len();
            let ids = instruction.operands[first..].iter().filter_map(Operand::id_ref_any);
            let operands: Vec<Value> = ids.map(|id| self.types.operand(id)).collect();
            self.each_component(function, result, &operands, block);
        } else if self.model == Model::Flush {
            let raw = self.globals.fresh();
            instruction.result_id = Some(raw);
            self.types.of_values.insert(raw, of_type);
            self.calls.insert(result.1, Some(raw));
            block.push(instruction);
            self.each_component(Function::Flush, result, &[self.types.operand(raw)], block);
        } else {
            block.push(instruction);
        }
    }

    /// Flushes the operands of an operation that are floats.
    fn flush_operands(&mut self, instruction: &mut Instruction, block: &mut Vec<Instruction>) {
        for operand in &mut instruction.operands {
            let Some(id) = operand.id_ref_any() else { continue };
            let Some(of_type) = self.types.of_values.get(&id).copied() else { continue };
            if let Some(components) = self.types.float_components(of_type) {
                let flushed = self.globals.fresh();
                let value = self.types.operand(id);
                self.each_component(Function::Flush, (of_type, flushed, components), &[value], block);
                *operand = Operand::IdRef(flushed);
            }
        }
    }

    /// Calls a function for each component of a result; operands of one component stand for all.
    fn each_component(
        &mut self,
        function: Function,
        (of_type, result, components): (Word, Word, u32),
        operands: &[Value],
        block: &mut Vec<Instruction>,
    ) {
        self.calls.entry(result).or_default();
        let callee = self.globals.function(function, self.model, self.seed);
        let float = self.globals.of_type(Type::Float);
        let mut parts = Vec::with_capacity(components as usize);
        for component in 0..components {
            let ids: Vec<Word> = operands
                .iter()
                .zip(function.parameters())
                .map(|(operand, of_type)| self.argument(*of_type, *operand, component, block))
                .collect();
            let part = if components == 1 { result } else { self.globals.fresh() };
            block.push(call(float, part, callee, &ids));
            parts.push(Operand::IdRef(part));
        }
        if components > 1 {
            block.push(Instruction::new(Op::CompositeConstruct, Some(of_type), Some(result), parts));
        }
    }

    /// A component of a value, as a parameter of this type takes it: integers are converted without looking at their sign.
    fn argument(
        &mut self,
        of_type: Type,
        Value { id, component, count }: Value,
        index: u32,
        block: &mut Vec<Instruction>,
    ) -> Word {
        let mut add = |globals: &mut Globals, opcode, of_type, operands| {
            let id = globals.fresh();
            block.push(Instruction::new(opcode, Some(of_type), Some(id), operands));
            id
        };
        let mut scalar = id;
        if count > 1 {
            let operands = vec![Operand::IdRef(scalar), Operand::LiteralBit32(index)];
            scalar = add(&mut self.globals, Op::CompositeExtract, component, operands);
        }
        let expected = self.globals.of_type(of_type);
        if component != expected {
            scalar = add(&mut self.globals, Op::Bitcast, expected, vec![Operand::IdRef(scalar)]);
        }
        scalar
    }
}

fn call(of_type: Word, result: Word, callee: Word, arguments: &[Word]) -> Instruction {
    let operands = [callee].iter().chain(arguments).map(|id| Operand::IdRef(*id)).collect();
    Instruction::new(Op::FunctionCall, Some(of_type), Some(result), operands)
}
