//! The committed SPIR-V modules are what the manifest says, are fresh, valid, and keep the arithmetic rules.

use std::collections::{BTreeSet, HashSet};
use std::process::Command;
use unitvec::best_fit;
use unitvec_host::catalogue::{Operation, formats};
#[cfg(feature = "glsl")]
use unitvec_host::glsl::Compiler;
use unitvec_host::manifest::{BEST_FIT_TABLE, DECODE_BY_TABLE, Manifest, sha256_hex, sources_sha256};
use unitvec_tests::repository;

/// The modules' folders: that of the manifest's kernels, and that of the kernels that measure.
const FOLDERS: [&str; 2] = ["spirv", "spirv/cost"];

fn manifest(folder: &str) -> Manifest {
    let text = std::fs::read(repository().join(folder).join("manifest.json")).unwrap();
    serde_json::from_slice(&text).unwrap()
}

/// A stale module is found without the compiler: `cargo xtask spirv` rebuilds it.
#[test]
fn modules_are_built_from_the_sources_as_they_are() {
    for folder in FOLDERS {
        let sources = sources_sha256(&repository()).unwrap();
        assert_eq!(manifest(folder).sources_sha256, sources, "run `cargo xtask spirv`");
    }
}

#[test]
fn the_folder_holds_the_modules_as_the_manifest_describes_them() {
    let manifest = manifest("spirv");
    for codec in formats() {
        for direction in [Operation::Encode, Operation::Decode] {
            let name = codec.function(direction);
            let module = manifest.modules.iter().find(|module| module.entry_point == name).unwrap();
            assert_eq!(module.codec.as_deref(), Some(codec.id), "{name}");
            assert_eq!(module.direction, direction, "{name}");
            let sizes: Vec<Option<u32>> =
                module.bindings.iter().map(|binding| binding.bytes_per_vector).collect();
            let (element, code) = (Some(codec.element.bytes() as u32), Some(codec.bytes as u32));
            let in_and_out = if direction == Operation::Encode { [element, code] } else { [code, element] };
            assert_eq!(sizes[..2], in_and_out, "{name}");
            let tables: Vec<_> =
                module.bindings[2..].iter().map(|binding| binding.table.as_deref()).collect();
            let by_table = direction == Operation::Encode && codec.encodes_by_table;
            assert_eq!(tables, if by_table { vec![Some(BEST_FIT_TABLE)] } else { vec![] }, "{name}");
        }
    }
    assert_eq!(manifest.modules.len(), 2 * formats().count() + 1);
    assert!(manifest.modules.iter().any(|module| module.entry_point == DECODE_BY_TABLE));
    assert_listed("spirv", &manifest, &["manifest.json", "cost"]);
}

/// Two kernels a codec and the two baselines.
#[test]
fn the_cost_folder_holds_the_modules_as_its_manifest_describes_them() {
    let manifest = manifest("spirv/cost");
    assert_eq!(manifest.modules.len(), 2 * formats().count() + 2);
    assert_listed("spirv/cost", &manifest, &["manifest.json"]);
}

/// The folder has the files that the manifest lists, with the SHA-256 that it says, these others, and nothing else.
fn assert_listed(folder: &str, manifest: &Manifest, others: &[&str]) {
    let modules = manifest.modules.iter().map(|module| (&module.file, &module.sha256));
    let tables = manifest.tables.iter().map(|table| (&table.file, &table.sha256));
    let mut expected: BTreeSet<String> = others.iter().map(|name| (*name).to_owned()).collect();
    for (file, sha256) in modules.chain(tables) {
        let bytes = std::fs::read(repository().join(folder).join(file)).unwrap();
        assert_eq!(*sha256, sha256_hex(&bytes), "{file}");
        expected.insert(file.clone());
    }
    let actual: BTreeSet<String> = std::fs::read_dir(repository().join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(actual, expected);
}

/// The shipped table is the one that the crate computes, little-endian.
#[test]
fn the_table_file_is_the_table_that_the_crate_fills() {
    let mut table = vec![0; best_fit::TABLE_WORDS];
    best_fit::fill_table(&mut table);
    let bytes = std::fs::read(repository().join("spirv").join(BEST_FIT_TABLE)).unwrap();
    assert_eq!(bytes, table.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>());
}

#[test]
fn spirv_val_accepts_every_module() {
    for folder in FOLDERS {
        for module in manifest(folder).modules {
            let path = repository().join(folder).join(&module.file);
            let output = Command::new("spirv-val")
                .args(["--target-env", "vulkan1.2"])
                .arg(&path)
                .output()
                .expect("spirv-val is missing: `cargo xtask setup` installs it");
            assert!(output.status.success(), "{}: {}", module.file, String::from_utf8_lossy(&output.stderr));
        }
    }
}

#[test]
fn every_float_result_is_marked_no_contraction() {
    let unmarked: Vec<String> = all_modules()
        .into_iter()
        .filter(|(name, instructions)| unmarked_results(name, instructions, &FLOAT_ARITHMETIC, 6) > 0)
        .map(|(name, _)| name)
        .collect();
    assert!(unmarked.is_empty(), "{unmarked:?}");
}

/// `precise` is nowhere forgotten in the GLSL. glslang does not mark negation, which is exact. The kernels take
/// their four vectors in a loop, in which there may be no more than one division a component.
#[cfg(feature = "glsl")]
#[test]
fn every_float_result_of_the_glsl_is_marked_no_contraction() {
    let compiler = Compiler::new().unwrap();
    let unmarked: Vec<String> = formats()
        .flat_map(|format| [(format, Operation::Encode), (format, Operation::Decode)])
        .filter(|(format, direction)| {
            let instructions = parse(&compiler.kernel(*format, *direction).unwrap());
            unmarked_results(&format.function(*direction), &instructions, &FLOAT_ARITHMETIC[1..], 3) > 0
        })
        .map(|(format, direction)| format.function(direction))
        .collect();
    assert!(unmarked.is_empty(), "{unmarked:?}");
}

/// How many results of these opcodes are not marked. There are `fewest` at least.
fn unmarked_results(name: &str, instructions: &[Instruction], arithmetic: &[u32], fewest: usize) -> usize {
    let decorated: HashSet<u32> = instructions
        .iter()
        .filter(|instruction| instruction.opcode == OP_DECORATE && instruction.operands[1] == NO_CONTRACTION)
        .map(|instruction| instruction.operands[0])
        .collect();
    let results: Vec<u32> = instructions
        .iter()
        .filter(|instruction| arithmetic.contains(&instruction.opcode))
        .map(|instruction| instruction.operands[1])
        .collect();
    // Half floats are converted with integers alone, and tables need no arithmetic.
    let whole = name.starts_with("float16x3") || name.starts_with(DECODE_BY_TABLE);
    assert!(results.len() >= fewest || whole, "{name} has no arithmetic");
    results.iter().filter(|id| !decorated.contains(id)).count()
}

#[test]
fn modules_need_shader_and_the_vulkan_memory_model_and_nothing_else() {
    for (name, instructions) in all_modules() {
        let operands = |opcode| {
            let of_opcode = instructions.iter().filter(move |instruction| instruction.opcode == opcode);
            of_opcode.map(|instruction| instruction.operands.clone()).collect::<Vec<_>>()
        };
        for capability in operands(OP_CAPABILITY) {
            assert!([SHADER, VULKAN_MEMORY_MODEL].contains(&capability[0]), "{name}: {capability:?}");
        }
        assert_eq!(operands(OP_EXTENSION).len(), 0, "{name}");
        assert_eq!(operands(OP_EXECUTION_MODE)[0][1..], [LOCAL_SIZE, 64, 1, 1], "{name}");
    }
}

/// No source text or paths of the machine that built them.
#[test]
fn modules_carry_no_debug_text() {
    for (name, instructions) in all_modules() {
        assert!(!instructions.iter().any(|instruction| DEBUG_TEXT.contains(&instruction.opcode)), "{name}");
    }
}

/// An instruction: its opcode and the words after the first.
struct Instruction {
    opcode: u32,
    operands: Vec<u32>,
}

// Numbers from the SPIR-V specification, section 3.
const OP_EXTENSION: u32 = 10;
const OP_EXECUTION_MODE: u32 = 16;
const OP_CAPABILITY: u32 = 17;
const OP_DECORATE: u32 = 71;
const NO_CONTRACTION: u32 = 42;
const SHADER: u32 = 1;
const VULKAN_MEMORY_MODEL: u32 = 5345;
const LOCAL_SIZE: u32 = 17;
/// OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv, OpFRem, OpFMod, OpVectorTimesScalar to OpDot.
const FLOAT_ARITHMETIC: [u32; 14] = [127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148];
/// OpSourceContinued, OpSource, OpSourceExtension, OpName, OpMemberName, OpString, OpLine, OpModuleProcessed.
const DEBUG_TEXT: [u32; 8] = [2, 3, 4, 5, 6, 7, 8, 330];

fn all_modules() -> Vec<(String, Vec<Instruction>)> {
    let modules = manifest("spirv").modules.into_iter();
    modules
        .map(|module| {
            let bytes = std::fs::read(repository().join("spirv").join(&module.file)).unwrap();
            (module.file, parse(&bytes))
        })
        .collect()
}

fn parse(bytes: &[u8]) -> Vec<Instruction> {
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    assert_eq!(words[0], 0x0723_0203, "SPIR-V's magic number");
    let mut rest = &words[5..];
    let mut instructions = Vec::new();
    while let [first, ..] = rest {
        let (length, opcode) = ((first >> 16) as usize, first & 0xffff);
        instructions.push(Instruction { opcode, operands: rest[1..length].to_vec() });
        rest = &rest[length..];
    }
    instructions
}
