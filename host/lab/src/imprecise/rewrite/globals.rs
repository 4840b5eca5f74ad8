//! Additions to a module: types, constants and functions.

use super::functions::{self, Function};
use crate::imprecise::Model;
use rspirv::dr::{self, Block, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, FunctionControl, GLOp, Op, Word};
use std::cell::RefCell;
use std::collections::HashMap;

/// A type of scalars.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    Float,
    Int,
    Uint,
    Bool,
}

impl Type {
    fn declaration(self) -> (Op, Vec<Operand>) {
        let words = |words: &[u32]| words.iter().map(|word| Operand::LiteralBit32(*word)).collect();
        match self {
            Self::Float => (Op::TypeFloat, words(&[32])),
            Self::Int => (Op::TypeInt, words(&[32, 1])),
            Self::Uint => (Op::TypeInt, words(&[32, 0])),
            Self::Bool => (Op::TypeBool, Vec::new()),
        }
    }
}

/// A module without the functions that it had, and those that are added to it.
pub struct Globals {
    module: Module,
    bound: Word,
    added: HashMap<Function, Word>,
}

impl Globals {
    pub fn new(module: Module) -> Self {
        let bound = module.header.as_ref().map_or(1, |header| header.bound);
        Self { module, bound, added: HashMap::new() }
    }

    /// The module with the functions that were added, and then these.
    pub fn with_functions(self, functions: Vec<dr::Function>) -> Module {
        let mut module = self.module;
        if let Some(header) = &mut module.header {
            header.bound = self.bound;
        }
        module.functions.extend(functions);
        module
    }

    /// Decorations and other annotations.
    pub fn annotations(&mut self) -> &mut Vec<Instruction> {
        &mut self.module.annotations
    }

    pub fn fresh(&mut self) -> Word {
        self.bound += 1;
        self.bound - 1
    }

    pub fn of_type(&mut self, of_type: Type) -> Word {
        let (opcode, operands) = of_type.declaration();
        self.global(opcode, None, operands)
    }

    /// The type, constant or other global of these operands, which is declared if it is not there.
    fn global(&mut self, opcode: Op, of_type: Option<Word>, operands: Vec<Operand>) -> Word {
        let equals = |global: &&Instruction| {
            global.class.opcode == opcode && global.result_type == of_type && global.operands == operands
        };
        let globals = &self.module.types_global_values;
        if let Some(id) = globals.iter().find(equals).and_then(|global| global.result_id) {
            return id;
        }
        let id = self.fresh();
        self.module.types_global_values.push(Instruction::new(opcode, of_type, Some(id), operands));
        id
    }

    fn glsl_import(&mut self) -> Word {
        let operands = vec![Operand::LiteralString("GLSL.std.450".to_owned())];
        let imports = &self.module.ext_inst_imports;
        let import = imports.iter().find(|import| import.operands == operands);
        if let Some(id) = import.and_then(|import| import.result_id) {
            return id;
        }
        let id = self.fresh();
        let import = Instruction::new(Op::ExtInstImport, None, Some(id), operands);
        self.module.ext_inst_imports.push(import);
        id
    }

    /// The function, which is added if it is not there.
    pub fn function(&mut self, function: Function, model: Model, seed: u32) -> Word {
        if let Some(id) = self.added.get(&function) {
            return *id;
        }
        let id = self.fresh();
        self.added.insert(function, id);
        let float = self.of_type(Type::Float);
        let types: Vec<Word> = function.parameters().iter().map(|of_type| self.of_type(*of_type)).collect();
        let signature = [float].iter().chain(&types).map(|id| Operand::IdRef(*id)).collect();
        let signature = self.global(Op::TypeFunction, None, signature);
        let parameters: Vec<Word> = types.iter().map(|_| self.fresh()).collect();

        let mut added = dr::Function::new();
        let control = vec![Operand::FunctionControl(FunctionControl::NONE), Operand::IdRef(signature)];
        added.def = Some(Instruction::new(Op::Function, Some(float), Some(id), control));
        added.end = Some(Instruction::new(Op::FunctionEnd, None, None, Vec::new()));
        let parameter = |(id, of_type): (&Word, &Word)| {
            Instruction::new(Op::FunctionParameter, Some(*of_type), Some(*id), Vec::new())
        };
        added.parameters = parameters.iter().zip(&types).map(parameter).collect();
        let mut block = Block::new();
        block.label = Some(Instruction::new(Op::Label, None, Some(self.fresh()), Vec::new()));
        let body = Body { globals: RefCell::new(self), instructions: RefCell::default() };
        let result = functions::build(function, model, seed, &parameters, &body);
        block.instructions = body.instructions.into_inner();
        let result = vec![Operand::IdRef(result)];
        block.instructions.push(Instruction::new(Op::ReturnValue, None, None, result));
        added.blocks.push(block);
        self.module.functions.push(added);
        id
    }
}

/// The instructions of a function that is being added. They are appended through a shared reference, so that the operands of one
/// may be appended where it is written.
pub struct Body<'a> {
    globals: RefCell<&'a mut Globals>,
    instructions: RefCell<Vec<Instruction>>,
}

impl Body<'_> {
    /// Appends an operation. No driver may contract its arithmetic on floats: the errors of sums and products are exact
    /// only as they are written.
    pub fn add(&self, of_type: Type, opcode: Op, operands: &[Word]) -> Word {
        let operands = operands.iter().map(|id| Operand::IdRef(*id)).collect();
        let result = self.append(of_type, opcode, operands);
        if matches!(opcode, Op::FAdd | Op::FSub | Op::FMul | Op::FDiv | Op::FNegate) {
            let operands = vec![Operand::IdRef(result), Operand::Decoration(Decoration::NoContraction)];
            self.globals.borrow_mut().annotations().push(Instruction::new(
                Op::Decorate,
                None,
                None,
                operands,
            ));
        }
        result
    }

    /// Appends an instruction of GLSL.std.450.
    pub fn extended(&self, of_type: Type, operation: GLOp, operands: &[Word]) -> Word {
        let import = self.globals.borrow_mut().glsl_import();
        let head = [Operand::IdRef(import), Operand::LiteralExtInstInteger(operation as u32)];
        let operands = head.into_iter().chain(operands.iter().map(|id| Operand::IdRef(*id))).collect();
        self.append(of_type, Op::ExtInst, operands)
    }

    pub fn constant(&self, of_type: Type, value: u32) -> Word {
        let mut globals = self.globals.borrow_mut();
        let of_type = globals.of_type(of_type);
        globals.global(Op::Constant, Some(of_type), vec![Operand::LiteralBit32(value)])
    }

    fn append(&self, of_type: Type, opcode: Op, operands: Vec<Operand>) -> Word {
        let mut globals = self.globals.borrow_mut();
        let (of_type, result) = (globals.of_type(of_type), globals.fresh());
        self.instructions.borrow_mut().push(Instruction::new(opcode, Some(of_type), Some(result), operands));
        result
    }
}
