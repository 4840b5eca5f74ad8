//! Modules of one entry point each become one.

use anyhow::{Context, Result, ensure};
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};
use std::collections::HashMap;

/// Names the entry point of a module that has one.
pub fn name_entry_point(module: &mut Module, name: &str) -> Result<()> {
    ensure!(module.entry_points.len() == 1, "the module has {} entry points", module.entry_points.len());
    let operands = module.entry_points[0].operands.iter_mut();
    for operand in operands.filter(|operand| matches!(operand, Operand::LiteralString(_))) {
        *operand = Operand::LiteralString(name.to_owned());
    }
    Ok(())
}

/// One module with all that is in these. They share types, constants and imports; each keeps its variables.
pub fn join(modules: Vec<Module>) -> Result<Module> {
    let mut modules = modules.into_iter();
    let mut joined = modules.next().context("no module to join")?;
    for module in modules {
        append(&mut joined, module)?;
    }
    Ok(joined)
}

fn append(joined: &mut Module, mut module: Module) -> Result<()> {
    let (header, from) =
        joined.header.as_mut().zip(module.header.take()).context("a module has no header")?;
    ensure!(header.version == from.version, "the modules have different versions of SPIR-V");
    ensure!(module.memory_model == joined.memory_model, "the modules have different memory models");
    let by = header.bound;
    header.bound += from.bound;
    for instruction in module.all_inst_iter_mut() {
        change_ids(instruction, |id| id + by);
    }

    for (to, from) in [
        (&mut joined.capabilities, &mut module.capabilities),
        (&mut joined.extensions, &mut module.extensions),
    ] {
        for instruction in from.drain(..) {
            if !to.contains(&instruction) {
                to.push(instruction);
            }
        }
    }
    let shared = share_globals(joined, &mut module);
    for function in &mut module.functions {
        for instruction in function.all_inst_iter_mut() {
            change_ids(instruction, |id| shared.get(&id).copied().unwrap_or(id));
        }
    }
    joined.entry_points.append(&mut module.entry_points);
    joined.execution_modes.append(&mut module.execution_modes);
    let is_shared = |annotation: &Instruction| target(annotation).is_some_and(|id| shared.contains_key(&id));
    joined.annotations.extend(module.annotations.into_iter().filter(|annotation| !is_shared(annotation)));
    joined.functions.append(&mut module.functions);
    Ok(())
}

/// Moves the imports, types, constants and variables that `joined` does not have yet into it. Returns the ids of the
/// others with those of their equals.
fn share_globals(joined: &mut Module, module: &mut Module) -> HashMap<Word, Word> {
    let mut shared = HashMap::new();
    let known = decorations(joined);
    let own = decorations(module);
    for (to, from) in [
        (&mut joined.ext_inst_imports, &mut module.ext_inst_imports),
        (&mut joined.types_global_values, &mut module.types_global_values),
    ] {
        let before = to.len();
        for mut global in from.drain(..) {
            change_ids(&mut global, |id| shared.get(&id).copied().unwrap_or(id));
            let equals = |other: &&Instruction| {
                global.class.opcode != Op::Variable
                    && other.class.opcode == global.class.opcode
                    && other.result_type == global.result_type
                    && other.operands == global.operands
                    && known.get(&other.result_id) == own.get(&global.result_id)
            };
            match (to[..before].iter().find(equals).and_then(|equal| equal.result_id), global.result_id) {
                (Some(equal), Some(id)) => _ = shared.insert(id, equal),
                _ => to.push(global),
            }
        }
    }
    shared
}

/// The operands of each id's decorations, of members too, in order.
pub fn decorations(module: &Module) -> HashMap<Option<Word>, Vec<Vec<Operand>>> {
    let mut decorations: HashMap<_, Vec<_>> = HashMap::new();
    for annotation in &module.annotations {
        decorations.entry(target(annotation)).or_default().push(annotation.operands[1..].to_vec());
    }
    decorations
}

/// What an annotation is about.
pub fn target(annotation: &Instruction) -> Option<Word> {
    annotation.operands.first()?.id_ref_any()
}

fn change_ids(instruction: &mut Instruction, change: impl Fn(Word) -> Word) {
    let operands = instruction.operands.iter_mut().filter_map(Operand::id_ref_any_mut);
    for id in operands.chain(&mut instruction.result_type).chain(&mut instruction.result_id) {
        *id = change(*id);
    }
}

#[cfg(test)]
mod tests {
    use super::super::snippet;
    use super::*;
    use rspirv::spirv::MemoryModel;

    fn named(name: &str, lines: &str) -> Module {
        let mut module = snippet::module(lines);
        name_entry_point(&mut module, name).unwrap();
        module
    }

    fn pair() -> [Module; 2] {
        [named("one", "OpStore %6 %f1"), named("other", "%10 = OpFAdd %float %7 %f1 OpStore %6 %10")]
    }

    /// Numbers of types and constants, variables, imports, and functions.
    fn counts(module: &Module) -> [usize; 4] {
        let globals = &module.types_global_values;
        let variables = globals.iter().filter(|global| global.class.opcode == Op::Variable).count();
        let imports = module.ext_inst_imports.len();
        [globals.len() - variables, variables, imports, module.functions.len()]
    }

    #[test]
    fn entry_points_share_types_and_keep_their_variables() {
        let [one, other] = pair();
        let [types, ..] = counts(&one);
        let joined = join(vec![one.clone(), other]).unwrap();
        snippet::assert_valid(&joined);
        assert_eq!(counts(&joined), [types, 2, 1, 2]);
        assert_eq!(joined.capabilities, one.capabilities);
        assert_eq!(joined.execution_modes.len(), 2);
        let names = joined.entry_points.iter().map(|entry| entry.operands[2].clone());
        let expected = ["one", "other"].map(|name| Operand::LiteralString(name.to_owned()));
        assert_eq!(names.collect::<Vec<_>>(), expected);
    }

    /// A struct of another layout is another type, and so is a pointer to it.
    #[test]
    fn types_of_other_decorations_are_not_shared() {
        let [one, mut other] = pair();
        let [types, ..] = counts(&one);
        let offsets = other.annotations.iter_mut().filter(|entry| entry.class.opcode == Op::MemberDecorate);
        for offset in offsets {
            offset.operands[3] = Operand::LiteralBit32(16);
        }
        let joined = join(vec![one, other]).unwrap();
        snippet::assert_valid(&joined);
        assert_eq!(counts(&joined), [types + 2, 2, 1, 2]);
    }

    #[test]
    fn modules_that_do_not_go_together_are_refused() {
        assert!(join(Vec::new()).is_err());
        let [one, mut other] = pair();
        let joined = join(vec![one.clone(), other.clone()]).unwrap();
        other.memory_model.as_mut().unwrap().operands[1] = Operand::MemoryModel(MemoryModel::Vulkan);
        assert!(join(vec![one, other]).is_err());
        assert!(name_entry_point(&mut joined.clone(), "two").is_err());
    }
}
