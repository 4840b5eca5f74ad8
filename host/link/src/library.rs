//! The library, as a module needs it.

use super::words::Module;
use super::{Error, LIBRARY, memory_model};
use rspirv::binary::Assemble;
use rspirv::dr::{Function, Instruction, Operand, load_bytes};
use rspirv::spirv::{AddressingModel, Decoration, MemoryModel, Op, Word};
use std::collections::{HashMap, HashSet};

/// The library's functions of these names and their callees, in the version and with the memory model of a module: they
/// use no memory but their own. The linker takes a second for all functions.
pub fn library_for(module: &Module, names: &[String]) -> Result<Vec<u8>, Error> {
    part(unitvec_shaders::spirv(LIBRARY).ok_or(Error::NoLibrary)?, module, names)
}

fn part(library: &[u8], module: &Module, names: &[String]) -> Result<Vec<u8>, Error> {
    let mut library =
        load_bytes(library).map_err(|_| Error::BadLibrary { reason: "is not SPIR-V".to_owned() })?;
    let exports: HashMap<&str, Word> = library.annotations.iter().filter_map(exported).collect();
    let found = names.iter().map(|name| {
        let found = exports.get(name.as_str()).copied();
        found.ok_or_else(|| Error::BadLibrary { reason: format!("does not have {name}") })
    });
    let mut wanted: HashSet<Word> = found.collect::<Result<_, _>>()?;
    // The functions called call nothing.
    let called: Vec<Word> =
        library.functions.iter().filter(|function| is_one_of(function, &wanted)).flat_map(calls).collect();
    wanted.extend(called);

    let (kept, others): (Vec<_>, Vec<_>) =
        library.functions.into_iter().partition(|function| is_one_of(function, &wanted));
    let gone: HashSet<Word> =
        others.iter().flat_map(Function::all_inst_iter).filter_map(|line| line.result_id).collect();
    library.functions = kept;
    let is_left = |line: &Instruction| {
        line.operands.first().and_then(Operand::id_ref_any).is_none_or(|id| !gone.contains(&id))
    };
    library.annotations.retain(is_left);
    library.debug_names.retain(is_left);

    if let Some(header) = &mut library.header {
        header.version = module.version;
    }
    let [addressing, memory] = memory_model(module)?;
    if let (Some(model), Some(addressing), Some(memory)) =
        (&mut library.memory_model, AddressingModel::from_u32(addressing), MemoryModel::from_u32(memory))
    {
        model.operands = vec![Operand::AddressingModel(addressing), Operand::MemoryModel(memory)];
    }
    Ok(library.assemble().into_iter().flat_map(u32::to_le_bytes).collect())
}

/// The function that a decoration exports, by its name.
fn exported(line: &Instruction) -> Option<(&str, Word)> {
    match line.operands.as_slice() {
        [
            Operand::IdRef(id),
            Operand::Decoration(Decoration::LinkageAttributes),
            Operand::LiteralString(name),
            ..,
        ] => Some((name, *id)),
        _ => None,
    }
}

fn is_one_of(function: &Function, ids: &HashSet<Word>) -> bool {
    function.def_id().is_some_and(|id| ids.contains(&id))
}

fn calls(function: &Function) -> impl Iterator<Item = Word> {
    let lines = function.all_inst_iter().filter(|line| line.class.opcode == Op::FunctionCall);
    lines.filter_map(|line| line.operands.first()?.id_ref_any())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function that calls another brings it, and nothing else comes along.
    #[test]
    fn only_what_is_called_is_taken() {
        let bytes = unitvec_shaders::spirv(LIBRARY).unwrap();
        let mut module = Module::parse(bytes).unwrap();
        module.version = 0x0001_0000;
        let names = ["unitvec_oct16p_decode".to_owned()];
        let part = load_bytes(library_for(&module, &names).unwrap()).unwrap();
        assert_eq!(part.header.as_ref().unwrap().version, 0x0001_0000);
        assert_eq!(part.functions.len(), 2);
        let all: Vec<String> = super::super::Signature::all().map(|signature| signature.name).collect();
        let whole = load_bytes(library_for(&module, &all).unwrap()).unwrap();
        assert_eq!(whole.functions.len(), all.len());
    }

    /// The message names the fault; it is not that there is none.
    #[test]
    fn libraries_that_do_not_fit_are_refused() {
        let bytes = unitvec_shaders::spirv(LIBRARY).unwrap();
        let module = Module::parse(bytes).unwrap();
        let names = ["unitvec_oct16_decode".to_owned(), "unitvec_oct15_decode".to_owned()];
        for (bytes, reason) in [
            (bytes, "spirv/unitvec.spv of this program does not have unitvec_oct15_decode"),
            (&bytes[..bytes.len() / 8 * 4], "spirv/unitvec.spv of this program is not SPIR-V"),
        ] {
            let error = part(bytes, &module, &names).unwrap_err().to_string();
            assert!(error.starts_with(reason), "{error}");
        }
    }
}
