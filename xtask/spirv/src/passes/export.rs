//! Exported functions of entry points: what they read becomes parameters, what they write the result.

use super::globals::{Globals, extract, instruction, operands};
use super::join::{self, decorations, target};
use anyhow::{Context, Result, bail, ensure};
use rspirv::binary::Assemble;
use rspirv::dr::{Block, Function, Instruction, Module, Operand};
use rspirv::spirv::{Capability, Decoration, FunctionControl, LinkageType, Op, StorageClass, Word};
use std::collections::{BTreeMap, HashMap};
use unitvec_link::{Signature, Type};

/// Makes a function of the entry point of a module that has one, with one block that returns. It is not yet exported, so that
/// equal functions make equal modules.
pub fn function(module: &mut Module) -> Result<()> {
    ensure!(module.entry_points.len() == 1, "the module has {} entry points", module.entry_points.len());
    ensure!(module.functions.len() == 1, "the module has {} functions", module.functions.len());
    let inputs = variables(module, StorageClass::Input)?;
    let outputs = variables(module, StorageClass::Output)?;
    let of_inputs = inputs.iter().map(|input| Ok((input.of_type, fresh(module)?)));
    let parameters = of_inputs.collect::<Result<Vec<_>>>()?;
    let result = match outputs.as_slice() {
        [output] => output.of_type,
        [] => bail!("the entry point writes nothing"),
        _ => of_types(module, Op::TypeStruct, outputs.iter().map(|output| output.of_type))?,
    };
    let types = [result].into_iter().chain(parameters.iter().map(|(of_type, _)| *of_type));
    let of_type = of_types(module, Op::TypeFunction, types)?;

    read_parameters(module, &inputs, &parameters);
    let mut values = Vec::new();
    for (output, parts) in outputs.iter().zip(written(module, &outputs)?) {
        values.push(construct(module, output.of_type, &parts)?);
    }
    let returned = construct(module, result, &values)?;
    let function = &mut module.functions[0];
    if let Some(last) = last_block(function)?.instructions.last_mut() {
        *last = Instruction::new(Op::ReturnValue, None, None, vec![Operand::IdRef(returned)]);
    }
    if let Some(definition) = &mut function.def {
        definition.result_type = Some(result);
        definition.operands = vec![Operand::FunctionControl(FunctionControl::NONE), Operand::IdRef(of_type)];
    }
    let parameters = parameters.iter();
    function.parameters =
        parameters.map(|(of_type, id)| instruction(Op::FunctionParameter, *of_type, *id, &[])).collect();
    remove_interface(module, inputs.iter().chain(&outputs).map(|variable| variable.id).collect());
    Ok(())
}

/// An input or an output of an entry point.
struct Variable {
    id: Word,
    of_type: Word,
}

/// The variables of a storage class, by their locations.
fn variables(module: &Module, class: StorageClass) -> Result<Vec<Variable>> {
    let decorations = decorations(module);
    let mut found = Vec::new();
    for global in &module.types_global_values {
        if global.class.opcode != Op::Variable || global.operands[0] != Operand::StorageClass(class) {
            continue;
        }
        let id = global.result_id.context("a variable without an id")?;
        let location = decorations.get(&Some(id)).into_iter().flatten().find_map(|of| match of.as_slice() {
            [Operand::Decoration(Decoration::Location), Operand::LiteralBit32(location)] => Some(*location),
            _ => None,
        });
        let mut globals = module.types_global_values.iter();
        let pointer = globals.find(|other| other.result_id == global.result_type);
        let of_type = pointer.and_then(|pointer| pointer.operands[1].id_ref_any());
        let of_type = of_type.context("a variable whose type is no pointer")?;
        found.push((location.context("a variable without a location")?, Variable { id, of_type }));
    }
    found.sort_by_key(|(location, _)| *location);
    Ok(found.into_iter().map(|(_, variable)| variable).collect())
}

fn fresh(module: &mut Module) -> Result<Word> {
    let header = module.header.as_mut().context("the module has no header")?;
    header.bound += 1;
    Ok(header.bound - 1)
}

/// A new type of these types.
fn of_types(module: &mut Module, opcode: Op, types: impl Iterator<Item = Word>) -> Result<Word> {
    let id = fresh(module)?;
    let types = types.map(Operand::IdRef).collect();
    module.types_global_values.push(Instruction::new(opcode, None, Some(id), types));
    Ok(id)
}

/// Uses the parameters where the variables were loaded, whole or by components.
fn read_parameters(module: &mut Module, inputs: &[Variable], parameters: &[(Word, Word)]) {
    let components = take_components(module, inputs);
    let function = &mut module.functions[0];
    let mut loaded = HashMap::new();
    for block in &mut function.blocks {
        block.instructions.retain_mut(|load| {
            let (Op::Load, Some([from]), Some(of_type), Some(result)) =
                (load.class.opcode, operands(load), load.result_type, load.result_id)
            else {
                return true;
            };
            if let Some(n) = inputs.iter().position(|input| input.id == from) {
                loaded.insert(result, parameters[n].1);
                return false;
            }
            if let Some((n, component)) = components.get(&from) {
                *load = extract(of_type, result, parameters[*n].1, *component);
            }
            true
        });
    }
    for instruction in function.all_inst_iter_mut() {
        for id in instruction.operands.iter_mut().filter_map(Operand::id_ref_any_mut) {
            *id = loaded.get(id).copied().unwrap_or(*id);
        }
    }
}

/// Pointers to components of variables: which variable and which component. They are removed.
fn take_components(module: &mut Module, variables: &[Variable]) -> HashMap<Word, (usize, u32)> {
    let globals = Globals { known: module.types_global_values.clone(), bound: 0 };
    let mut components = HashMap::new();
    for block in &mut module.functions[0].blocks {
        block.instructions.retain(|chain| {
            let (Op::AccessChain | Op::InBoundsAccessChain, Some([of, component]), Some(id)) =
                (chain.class.opcode, operands(chain), chain.result_id)
            else {
                return true;
            };
            let variable = variables.iter().position(|variable| of == variable.id);
            let found = variable.zip(globals.value(component));
            components.extend(found.map(|found| (id, found)));
            found.is_none()
        });
    }
    components
}

/// What is stored in each output, whole or by components, without the stores. They stand in the last block, which alone
/// returns.
fn written(module: &mut Module, outputs: &[Variable]) -> Result<Vec<Vec<Word>>> {
    let components = take_components(module, outputs);
    let function = &mut module.functions[0];
    let mut values = vec![BTreeMap::new(); outputs.len()];
    last_block(function)?.instructions.retain(|instruction| {
        let (Op::Store, Some([to, value])) = (instruction.class.opcode, operands(instruction)) else {
            return true;
        };
        let whole = || outputs.iter().position(|output| output.id == to).map(|n| (n, 0));
        let written = components.get(&to).copied().or_else(whole);
        if let Some((n, component)) = written {
            values[n].insert(component, value);
        }
        written.is_none()
    });
    let is_written = values.iter().all(|parts| !parts.is_empty());
    ensure!(is_written, "an output is not written where the entry point ends");
    Ok(values.into_iter().map(|parts| parts.into_values().collect()).collect())
}

/// The block that returns, if there is only one.
fn last_block(function: &mut Function) -> Result<&mut Block> {
    let returns = |block: &&mut Block| {
        block
            .instructions
            .last()
            .is_some_and(|last| matches!(last.class.opcode, Op::Return | Op::Kill | Op::Unreachable))
    };
    let mut blocks: Vec<&mut Block> = function.blocks.iter_mut().filter(returns).collect();
    ensure!(blocks.len() == 1, "the entry point ends in {} places", blocks.len());
    blocks.pop().context("the entry point does not end")
}

/// The value of this type with these parts, which one part is already.
fn construct(module: &mut Module, of_type: Word, values: &[Word]) -> Result<Word> {
    if let [value] = values {
        return Ok(*value);
    }
    let id = fresh(module)?;
    let instructions = &mut last_block(&mut module.functions[0])?.instructions;
    instructions.insert(instructions.len() - 1, instruction(Op::CompositeConstruct, of_type, id, values));
    Ok(id)
}

/// Removes entry point, variables and their decorations. What else uses the variables is found by spirv-val.
fn remove_interface(module: &mut Module, variables: Vec<Word>) {
    module.entry_points.clear();
    module.execution_modes.clear();
    module.annotations.retain(|annotation| target(annotation).is_none_or(|id| !variables.contains(&id)));
    module.types_global_values.retain(|global| global.result_id.is_none_or(|id| !variables.contains(&id)));
}

/// A library of such functions, by the name of codec and operation: those that are equal share one body.
pub fn library(functions: Vec<(Signature, Module)>) -> Result<Module> {
    let (mut modules, mut signatures) = (Vec::new(), Vec::<Vec<Signature>>::new());
    let mut bodies = HashMap::new();
    for (signature, module) in functions {
        let body = *bodies.entry(module.assemble()).or_insert(modules.len());
        if body == modules.len() {
            modules.push(module);
            signatures.push(Vec::new());
        }
        signatures[body].push(signature);
    }
    let mut library = join_in_pairs(modules)?;
    ensure!(library.functions.len() == signatures.len(), "the modules have more than a function each");
    let linkage = vec![Operand::Capability(Capability::Linkage)];
    library.capabilities.push(Instruction::new(Op::Capability, None, None, linkage));
    for (n, signatures) in signatures.iter().enumerate() {
        let [first, others @ ..] = signatures.as_slice() else { continue };
        export(&mut library, n, first)?;
        for other in others {
            let at = library.functions.len();
            let forwarding = forwarding(&mut library, n)?;
            library.functions.push(forwarding);
            export(&mut library, at, other)?;
        }
    }
    Ok(library)
}

/// Joins neighbours until one is left: each join looks at all that is joined.
fn join_in_pairs(mut modules: Vec<Module>) -> Result<Module> {
    while modules.len() > 1 {
        let mut joined = Vec::new();
        let mut rest = modules.into_iter();
        while let Some(first) = rest.next() {
            joined.push(join::join(std::iter::once(first).chain(rest.next()).collect())?);
        }
        modules = joined;
    }
    modules.pop().context("no function for the library")
}

/// A function that does nothing but call the one with this number.
fn forwarding(library: &mut Module, callee: usize) -> Result<Function> {
    let [function, label, result] = [fresh(library)?, fresh(library)?, fresh(library)?];
    let mut forwarding = library.functions[callee].clone();
    let definition = forwarding.def.as_mut().context("a function without a definition")?;
    let mut operands = vec![definition.result_id.context("a function without an id")?];
    let of_type = definition.result_type.context("a function without a type")?;
    definition.result_id = Some(function);
    for parameter in &mut forwarding.parameters {
        let id = fresh(library)?;
        parameter.result_id = Some(id);
        operands.push(id);
    }
    forwarding.blocks = vec![Block {
        label: Some(Instruction::new(Op::Label, None, Some(label), Vec::new())),
        instructions: vec![
            instruction(Op::FunctionCall, of_type, result, &operands),
            Instruction::new(Op::ReturnValue, None, None, vec![Operand::IdRef(result)]),
        ],
    }];
    Ok(forwarding)
}

/// Exports a function under its name, and names what belongs to it.
fn export(library: &mut Module, n: usize, signature: &Signature) -> Result<()> {
    let function = &library.functions[n];
    let id = function.def_id().context("a function without an id")?;
    let Signature { name, parameters, result } = signature;
    ensure!(function.parameters.len() == parameters.len(), "{name} has other parameters");
    let text = |text: &str| Operand::LiteralString(text.to_owned());
    let named =
        |id: Word, name: &str| Instruction::new(Op::Name, None, None, vec![Operand::IdRef(id), text(name)]);
    library.debug_names.push(named(id, name));
    for (parameter, (name, _)) in function.parameters.iter().zip(parameters) {
        library.debug_names.push(named(parameter.result_id.context("a parameter without an id")?, name));
    }
    let of_type = function.def.as_ref().and_then(|definition| definition.result_type);
    let frame = of_type.context("a function without a type")?;
    // The struct of frames is named once.
    let is_named = library.debug_names.iter().any(|name| name.operands[0] == Operand::IdRef(frame));
    if *result == Type::Frame && !is_named {
        library.debug_names.push(named(frame, "UnitvecFrame"));
        for (n, member) in (0..).zip(["normal", "tangent"]) {
            let operands = vec![Operand::IdRef(frame), Operand::LiteralBit32(n), text(member)];
            library.debug_names.push(Instruction::new(Op::MemberName, None, None, operands));
        }
    }
    let linkage = Operand::Decoration(Decoration::LinkageAttributes);
    let operands = vec![Operand::IdRef(id), linkage, text(name), Operand::LinkageType(LinkageType::Export)];
    library.annotations.push(Instruction::new(Op::Decorate, None, None, operands));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::LIBRARY_ENVIRONMENT;
    use super::super::snippet::assembled;
    use super::*;
    use spirv_tools::val::{self, Validator};
    use unitvec_catalogue::{Operation, find};

    /// A vertex shader that reads a code of two words, and writes a vector %8 and another, %9, with these lines at its end.
    fn entry_point(end: &str) -> Module {
        assembled(&format!(include_str!("snippets/vertex.spvasm"), end = end))
    }

    /// One vector whole, the other by components.
    const WRITES: &str = "OpStore %9 %14
        %20 = OpAccessChain %pointer_out %8 %u0
        %21 = OpAccessChain %pointer_out %8 %u1
        %22 = OpAccessChain %pointer_out %8 %u2
        OpStore %22 %13
        OpStore %20 %13
        OpStore %21 %13
        OpReturn";

    fn signature(id: &str) -> Signature {
        Signature::of(find(id).unwrap(), Operation::Decode)
    }

    /// What was read is a parameter, what was written a struct in the order of locations.
    #[test]
    fn entry_points_become_functions() {
        let mut module = entry_point(WRITES);
        function(&mut module).unwrap();
        assert_eq!((module.entry_points.len(), module.annotations.len()), (0, 0));
        let function = &module.functions[0];
        let parameter = function.parameters[0].result_id.unwrap();
        let opcodes: Vec<Op> = function.blocks[0].instructions.iter().map(|line| line.class.opcode).collect();
        use Op::*;
        let expected =
            [CompositeExtract, ConvertUToF, CompositeConstruct, CompositeConstruct, CompositeConstruct];
        assert_eq!(opcodes, [&expected[..], &[ReturnValue]].concat());
        let [extract, _, whole, parts, result, _] = function.blocks[0].instructions.as_slice() else {
            panic!()
        };
        assert_eq!(extract.operands, [Operand::IdRef(parameter), Operand::LiteralBit32(1)]);
        let members = [parts, whole].map(|line| Operand::IdRef(line.result_id.unwrap()));
        assert_eq!(result.operands, members);
    }

    /// Both are exported under their names; the second calls the first.
    #[test]
    fn equal_functions_share_a_body() {
        let functions = ["frame64", "oct48"].map(|id| {
            let mut module = entry_point(WRITES);
            function(&mut module).unwrap();
            (signature(id), module)
        });
        let library = library(functions.into()).unwrap();
        val::create(Some(LIBRARY_ENVIRONMENT)).validate(library.assemble(), None).unwrap();
        let sizes = library.functions.iter().map(|function| function.blocks[0].instructions.len());
        assert_eq!(sizes.collect::<Vec<_>>(), [6, 2]);
        let exports = library.annotations.iter().filter_map(|line| match line.operands.as_slice() {
            [_, Operand::Decoration(Decoration::LinkageAttributes), Operand::LiteralString(name), kind] => {
                assert_eq!(*kind, Operand::LinkageType(LinkageType::Export));
                Some(name.as_str())
            }
            _ => None,
        });
        assert_eq!(exports.collect::<Vec<_>>(), ["unitvec_frame64_decode", "unitvec_oct48_decode"]);
    }

    #[test]
    fn entry_points_that_do_not_write_all_at_their_end_are_refused() {
        let twice = "%15 = OpIEqual %bool %12 %u0
            OpSelectionMerge %17 None
            OpBranchConditional %15 %16 %17
            %16 = OpLabel
            OpReturn
            %17 = OpLabel
            OpStore %8 %14
            OpStore %9 %14
            OpReturn";
        for (lines, reason) in [
            ("OpStore %8 %14 OpReturn", "an output is not written"),
            (twice, "the entry point ends in 2 places"),
        ] {
            let error = function(&mut entry_point(lines)).unwrap_err();
            assert!(error.to_string().starts_with(reason), "{error}");
        }
    }
}
