//! Compute kernels in SPIR-V as CUDA, for a compiler that takes no SPIR-V. Each instruction becomes a call of the function of
//! its name in `kernel.cuh`, each block a label.

use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{BuiltIn, Decoration, GLOp, Op, StorageClass, Word};
use std::collections::{HashMap, HashSet};
use std::fmt::Write;

/// The functions that kernels call.
pub const HEADER: &str = include_str!("kernel.cuh");

/// The kernel of a module with one entry point, under another name.
///
/// # Errors
/// The instruction that has no counterpart, or the parser's message.
pub fn kernel(spirv: &[u8], name: &str) -> Result<String, String> {
    let module = rspirv::dr::load_bytes(spirv).map_err(|error| format!("{error:?}"))?;
    Printer::new(&module).kernel(&module, name)
}

/// The text of the values and types that are known so far.
struct Printer<'a> {
    instructions: HashMap<Word, &'a Instruction>,
    /// Results that the compiler may not fuse.
    rounded: HashSet<Word>,
    invocation: Option<Word>,
    /// Declarations of types, parameters, declarations of values, statements.
    types: String,
    parameters: Vec<String>,
    values: String,
    body: String,
}

impl<'a> Printer<'a> {
    fn new(module: &'a Module) -> Self {
        let instructions = module.all_inst_iter().filter_map(|one| Some((one.result_id?, one))).collect();
        let mut printer = Self {
            instructions,
            rounded: HashSet::new(),
            invocation: None,
            types: String::new(),
            parameters: Vec::new(),
            values: String::new(),
            body: String::new(),
        };
        for decoration in &module.annotations {
            match decoration.operands[..] {
                [Operand::IdRef(id), Operand::Decoration(Decoration::NoContraction)] => {
                    printer.rounded.insert(id);
                }
                [Operand::IdRef(id), _, Operand::BuiltIn(BuiltIn::GlobalInvocationId)] => {
                    printer.invocation = Some(id);
                }
                _ => {}
            }
        }
        printer
    }

    fn kernel(mut self, module: &'a Module, name: &str) -> Result<String, String> {
        module.types_global_values.iter().try_for_each(|one| self.global(one))?;
        let blocks = &module.functions.first().ok_or("it has no function")?.blocks;
        // Values of a block's successors come from it.
        let mut phis: HashMap<Word, Vec<(Word, String, String)>> = HashMap::new();
        for block in blocks {
            for phi in block.instructions.iter().filter(|one| one.class.opcode == Op::Phi) {
                let target = block.label.as_ref().and_then(|label| label.result_id).unwrap_or_default();
                for pair in ids(phi).chunks_exact(2) {
                    phis.entry(pair[1]).or_default().push((target, result(phi), value(pair[0])));
                }
            }
        }
        for block in blocks {
            let label = block.label.as_ref().and_then(|label| label.result_id).unwrap_or_default();
            let _ = writeln!(self.body, "L{label}:");
            let (last, others) = block.instructions.split_last().ok_or("a block is empty")?;
            others.iter().try_for_each(|one| self.statement(one))?;
            self.end(last, phis.get(&label).map_or(&[][..], Vec::as_slice))?;
        }
        Ok(format!(
            "namespace of_{name} {{\n{}extern \"C\" __global__ void __launch_bounds__(64) {name}({}) {{\n{}{}}}\n}}\n",
            self.types,
            self.parameters.join(", "),
            self.values,
            self.body
        ))
    }

    /// The name of a type.
    fn type_name(&self, id: Word) -> Result<String, String> {
        let declared = self.instruction(id)?;
        Ok(match (declared.class.opcode, &declared.operands[..]) {
            (Op::TypeBool, _) => "bool".to_owned(),
            (Op::TypeInt, _) => "uint".to_owned(),
            (Op::TypeFloat, _) => "float".to_owned(),
            (Op::TypeVector, [Operand::IdRef(of), Operand::LiteralBit32(size)]) => {
                format!("vec<{}, {size}>", self.type_name(*of)?)
            }
            (Op::TypeArray, [Operand::IdRef(of), Operand::IdRef(size)]) => {
                format!("array<{}, {}>", self.type_name(*of)?, self.literal(*size)?)
            }
            (Op::TypeRuntimeArray, [Operand::IdRef(of)]) => format!("array<{}, 1>", self.type_name(*of)?),
            (Op::TypeStruct, _) => format!("T{id}"),
            (Op::TypePointer, [_, Operand::IdRef(of)]) => format!("{}*", self.type_name(*of)?),
            _ => return Err(declared.class.opname.to_owned()),
        })
    }

    fn instruction(&self, id: Word) -> Result<&'a Instruction, String> {
        self.instructions.get(&id).copied().ok_or_else(|| format!("%{id} has no definition"))
    }

    /// The bits of a constant.
    fn literal(&self, id: Word) -> Result<u32, String> {
        match self.instruction(id)?.operands[..] {
            [Operand::LiteralBit32(bits)] => Ok(bits),
            _ => Err(format!("%{id} is no constant")),
        }
    }

    /// Declares a type, a constant or a variable of the module.
    fn global(&mut self, one: &Instruction) -> Result<(), String> {
        let id = one.result_id.unwrap_or_default();
        if one.class.opcode == Op::TypeStruct {
            let _ = write!(self.types, "struct T{id} {{ ");
            for (at, member) in ids(one).into_iter().enumerate() {
                let member = self.type_name(member)?;
                let _ = write!(self.types, "{member} m{at}; ");
            }
            self.types += "};\n";
        }
        let Some(kind) = one.result_type else { return Ok(()) };
        let kind = self.type_name(kind)?;
        let text = match (one.class.opcode, &one.operands[..]) {
            (
                Op::Variable,
                [Operand::StorageClass(StorageClass::StorageBuffer | StorageClass::Uniform), ..],
            ) => {
                self.parameters.push(format!("{kind} __restrict__ v{id}"));
                return Ok(());
            }
            (Op::Variable, _) if self.invocation == Some(id) => {
                self.values += "vec<uint, 3> invocation = {{blockIdx.x * 64 + threadIdx.x, 0, 0}};\n";
                "&invocation".to_owned()
            }
            (Op::Constant, [Operand::LiteralBit32(bits)]) if kind == "float" => {
                format!("__uint_as_float({bits}u)")
            }
            (Op::Constant, [Operand::LiteralBit32(bits)]) => format!("{bits}u"),
            (Op::ConstantTrue, _) => "true".to_owned(),
            (Op::ConstantFalse, _) => "false".to_owned(),
            (Op::ConstantNull | Op::Undef, _) => format!("{kind}{{}}"),
            (Op::ConstantComposite, _) => aggregate(&kind, &values(one)),
            _ => return Err(one.class.opname.to_owned()),
        };
        let _ = writeln!(self.values, "{kind} v{id} = {text};");
        Ok(())
    }

    /// Prints an instruction within a block.
    fn statement(&mut self, one: &Instruction) -> Result<(), String> {
        let operands = values(one);
        match (one.class.opcode, &operands[..]) {
            (Op::SelectionMerge | Op::LoopMerge | Op::Nop, _) => return Ok(()),
            (Op::Store, [to, what, ..]) => {
                let _ = writeln!(self.body, "*{to} = {what};");
                return Ok(());
            }
            _ => {}
        }
        let kind = self.type_name(one.result_type.ok_or_else(|| one.class.opname.to_owned())?)?;
        let text = match (one.class.opcode, &operands[..]) {
            // Their blocks' predecessors assign them.
            (Op::Phi, _) => String::new(),
            (Op::Variable, _) => {
                let id = one.result_id.unwrap_or_default();
                let _ = writeln!(self.values, "{} s{id};", kind.trim_end_matches('*'));
                format!("&s{id}")
            }
            (Op::Load, [from, ..]) => format!("*{from}"),
            (Op::Undef, _) => format!("{kind}{{}}"),
            (Op::CompositeConstruct, parts) => self.construct(&kind, one, parts)?,
            (Op::CompositeExtract, [of, ..]) => format!("{of}{}", self.path(one, 0)?),
            (Op::CompositeInsert, [what, into, ..]) => {
                let path = self.path(one, 1)?;
                let _ = writeln!(self.body, "{} = {into};", result(one));
                let _ = writeln!(self.body, "{}{path} = {what};", result(one));
                String::new()
            }
            (Op::AccessChain | Op::InBoundsAccessChain, [base, ..]) => {
                format!("&(*{base}){}", self.path(one, 0)?)
            }
            (Op::VectorShuffle, _) => self.shuffle(&kind, one)?,
            (Op::Bitcast, [of]) => format!("Bitcast<{kind}>({of})"),
            (Op::ExtInst, [_, of @ ..]) => {
                let Operand::LiteralExtInstInteger(number) = one.operands[1] else {
                    return Err("OpExtInst".to_owned());
                };
                let name = GLOp::from_u32(number).ok_or_else(|| format!("function {number}"))?;
                format!("{name:?}({})", of.join(", "))
            }
            (_, of) => {
                let rounded = one.result_id.is_some_and(|id| self.rounded.contains(&id));
                // No compiler fuses other operations.
                let can_be =
                    matches!(one.class.opcode, Op::FAdd | Op::FSub | Op::FMul | Op::VectorTimesScalar);
                format!(
                    "{}{}({})",
                    one.class.opname,
                    if rounded && can_be { "Rounded" } else { "" },
                    of.join(", ")
                )
            }
        };
        let _ = writeln!(self.values, "{kind} {};", result(one));
        if !text.is_empty() {
            let _ = writeln!(self.body, "{} = {text};", result(one));
        }
        Ok(())
    }

    /// The end of a block, after the values of other blocks that it sets.
    fn end(&mut self, one: &Instruction, phis: &[(Word, String, String)]) -> Result<(), String> {
        let jump = |to: Word| {
            let own: Vec<_> = phis.iter().filter(|(target, ..)| *target == to).collect();
            let read: String = own.iter().map(|(_, of, from)| format!("auto n{of} = {from}; ")).collect();
            let set: String = own.iter().map(|(_, of, _)| format!("{of} = n{of}; ")).collect();
            format!("{{ {read}{set}goto L{to}; }}")
        };
        let targets = ids(one);
        let text = match (one.class.opcode, &targets[..]) {
            (Op::Return, _) => "return;".to_owned(),
            (Op::Branch, [to]) => jump(*to),
            (Op::BranchConditional, [condition, yes, no, ..]) => {
                format!("if ({}) {} else {}", value(*condition), jump(*yes), jump(*no))
            }
            (Op::Switch, [of, default, others @ ..]) => {
                let cases = one.operands.iter().filter_map(|operand| match operand {
                    Operand::LiteralBit32(case) => Some(case),
                    _ => None,
                });
                let cases: String =
                    cases.zip(others).map(|(case, to)| format!("case {case}u: {} ", jump(*to))).collect();
                format!("switch ({}) {{ {cases}default: {} }}", value(*of), jump(*default))
            }
            _ => return Err(one.class.opname.to_owned()),
        };
        let _ = writeln!(self.body, "{text}");
        Ok(())
    }

    /// A composite of parts; vectors among those of a vector are taken apart.
    fn construct(&self, kind: &str, one: &Instruction, parts: &[String]) -> Result<String, String> {
        if !kind.starts_with("vec") {
            return Ok(aggregate(kind, parts));
        }
        let mut scalars = Vec::new();
        for (id, part) in ids(one).into_iter().zip(parts) {
            let of = self.instruction(id)?.result_type.ok_or("a value has no type")?;
            match self.instruction(of)?.operands[..] {
                [Operand::IdRef(_), Operand::LiteralBit32(size)] => {
                    scalars.extend((0..size).map(|at| format!("{part}.c[{at}]")));
                }
                _ => scalars.push(part.clone()),
            }
        }
        Ok(aggregate(kind, &scalars))
    }

    fn shuffle(&self, kind: &str, one: &Instruction) -> Result<String, String> {
        let [Operand::IdRef(first), Operand::IdRef(second), chosen @ ..] = &one.operands[..] else {
            return Err("OpVectorShuffle".to_owned());
        };
        let of = self.instruction(*first)?.result_type.ok_or("a value has no type")?;
        let Some(Operand::LiteralBit32(size)) = self.instruction(of)?.operands.get(1) else {
            return Err("OpVectorShuffle".to_owned());
        };
        let scalars = chosen.iter().filter_map(|at| match at {
            Operand::LiteralBit32(at) if at < size => Some(format!("v{first}.c[{at}]")),
            Operand::LiteralBit32(at) => Some(format!("v{second}.c[{}]", at.saturating_sub(*size))),
            _ => None,
        });
        Ok(aggregate(kind, &scalars.collect::<Vec<_>>()))
    }

    /// The way into a composite by the operands behind that of this index.
    fn path(&self, one: &Instruction, base: usize) -> Result<String, String> {
        let Some(Operand::IdRef(of)) = one.operands.get(base) else {
            return Err(one.class.opname.to_owned());
        };
        let mut kind = self.instruction(*of)?.result_type.ok_or("a value has no type")?;
        if let (Op::TypePointer, [_, Operand::IdRef(to)]) =
            (self.instruction(kind)?.class.opcode, &self.instruction(kind)?.operands[..])
        {
            kind = *to;
        }
        let mut path = String::new();
        for index in &one.operands[base + 1..] {
            let declared = self.instruction(kind)?;
            let members = ids(declared);
            let member = if declared.class.opcode == Op::TypeStruct {
                let at = match index {
                    Operand::LiteralBit32(at) => *at,
                    Operand::IdRef(id) => self.literal(*id)?,
                    _ => return Err(one.class.opname.to_owned()),
                };
                let _ = write!(path, ".m{at}");
                members.get(at as usize)
            } else {
                let _ = write!(path, ".c[{}]", operand(index));
                members.first()
            };
            kind = *member.ok_or_else(|| one.class.opname.to_owned())?;
        }
        Ok(path)
    }
}

/// A value of a type with these parts.
fn aggregate(kind: &str, parts: &[String]) -> String {
    // A vector and an array have one member, which is an array.
    let (open, close) = if kind.starts_with('T') { ("{", "}") } else { ("{{", "}}") };
    format!("{kind}{open}{}{close}", parts.join(", "))
}

fn value(id: Word) -> String {
    format!("v{id}")
}

fn result(one: &Instruction) -> String {
    value(one.result_id.unwrap_or_default())
}

fn operand(operand: &Operand) -> String {
    match operand {
        Operand::IdRef(id) => value(*id),
        other => other.to_string(),
    }
}

fn values(one: &Instruction) -> Vec<String> {
    // The set of instructions, and its number, stand before the values.
    let skipped = if one.class.opcode == Op::ExtInst { 1 } else { 0 };
    one.operands.iter().skip(skipped).map(operand).collect()
}

fn ids(one: &Instruction) -> Vec<Word> {
    let id = |operand: &Operand| match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    };
    one.operands.iter().filter_map(id).collect()
}
