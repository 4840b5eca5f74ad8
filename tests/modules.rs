//! The committed SPIR-V modules match the manifest, are fresh, valid, and keep the arithmetic rules.

use rspirv::dr::{Function, Instruction, Module, Operand, load_bytes};
use rspirv::spirv::{
    AddressingModel, Capability, Decoration, ExecutionMode, ExecutionModel, GLOp, LinkageType, MemoryModel,
    Op, StorageClass, Word,
};
use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use unitvec::best_fit;
use unitvec_catalogue::{CODECS, Operation};
use unitvec_link::{LIBRARY, Signature};
use unitvec_manifest::{BEST_FIT_TABLE, Manifest, Module as Entry, Role, SCHEMA, schema, sha256_hex};
use unitvec_render::shaders;
#[cfg(feature = "glsl")]
use unitvec_run::{conform::widest_of_each_series, glsl::Compiler, shader::Edition};
use unitvec_tests::repository;
use unitvec_vulkan::{GROUP, WORKGROUP};

fn folder() -> PathBuf {
    repository().join("spirv")
}

/// A file of the folder.
fn read(file: &str) -> Vec<u8> {
    std::fs::read(folder().join(file)).unwrap()
}

fn manifest() -> Manifest {
    serde_json::from_slice(&read("manifest.json")).unwrap()
}

/// A module of two entry points a codec, described as the catalogue has it, and the decoder by table.
#[test]
fn the_manifest_lists_a_module_of_every_codec() {
    let manifest = manifest();
    let mut expected =
        BTreeSet::from(["decode_by_table", "arithmetic"].map(|name| format!("kernels/{name}.spv")));
    for format in &CODECS {
        let file = format!("kernels/{}.spv", format.id);
        let module = manifest.modules.iter().find(|module| module.file == file);
        let module = module.unwrap_or_else(|| panic!("no module {file}"));
        let codec = module.codec.as_ref().unwrap_or_else(|| panic!("{file} has no codec"));
        assert_eq!(
            (codec.id.as_str(), codec.element, codec.bits, codec.bytes as usize, codec.vk_format.as_deref()),
            (format.id, format.element, format.bits, format.bytes, format.vk_format)
        );
        assert_eq!(codec.max_error_deg, format.max_errors_deg, "{file}");
        let actual = module.entry_points.iter().map(|entry| (entry.name.clone(), entry.operation));
        let both = Operation::ALL.map(|operation| (format.function(operation), operation));
        assert_eq!(actual.collect::<Vec<_>>(), both, "{file}");
        expected.insert(file);
    }
    let listed: BTreeSet<String> = manifest.modules.into_iter().map(|module| module.file).collect();
    assert_eq!(listed, expected);
}

#[test]
fn the_interfaces_are_those_of_the_codecs() {
    let manifest = manifest();
    for codec in &CODECS {
        let module =
            manifest.modules.iter().find(|module| module.file == format!("kernels/{}.spv", codec.id));
        for entry in &module.unwrap().entry_points {
            let bindings = &manifest.interfaces[&entry.interface].bindings;
            let sizes: Vec<Option<u32>> = bindings.iter().map(|binding| binding.bytes_per_vector).collect();
            let (element, code) = (Some(codec.element.bytes() as u32), Some(codec.bytes as u32));
            let is_encoder = entry.operation == Operation::Encode;
            assert_eq!(
                sizes[..2],
                if is_encoder { [element, code] } else { [code, element] },
                "{}",
                entry.name
            );
            let tables: Vec<_> = bindings[2..].iter().map(|binding| binding.table.as_deref()).collect();
            let by_table = is_encoder && codec.encodes_by_table;
            assert_eq!(tables, if by_table { vec![Some(BEST_FIT_TABLE)] } else { vec![] }, "{}", entry.name);
        }
    }
}

/// The schema beside the manifest is that of the types that it is read into, which take no other members.
#[test]
fn the_schema_is_that_of_the_manifest() {
    let manifest = std::fs::read_to_string(folder().join("manifest.json")).unwrap();
    assert_eq!(std::fs::read_to_string(folder().join(SCHEMA)).unwrap(), schema(), "run `cargo xtask spirv`");
    assert!(manifest.contains(&format!("\"$schema\": \"{SCHEMA}\"")));
    let with_another = manifest.replacen("{", "{ \"another\": 1,", 1);
    assert!(serde_json::from_str::<Manifest>(&with_another).is_err());
}

/// The folder holds the files that the manifest lists, with their SHA-256, the schema, the mark that they are
/// generated, and nothing else.
#[test]
fn the_folder_holds_what_the_manifest_lists() {
    let manifest = manifest();
    let modules = manifest.modules.iter().map(|module| (&module.file, &module.sha256));
    let tables = manifest.tables.iter().map(|table| (&table.file, &table.sha256));
    let library = [(&manifest.library.file, &manifest.library.sha256)];
    let mut expected = BTreeSet::from(["README.md", "manifest.json", SCHEMA, "kernels"].map(str::to_owned));
    for table in &manifest.tables {
        assert_eq!(table.bytes as usize, read(&table.file).len(), "{}", table.file);
    }
    for (file, sha256) in modules.chain(tables).chain(library) {
        assert_eq!(*sha256, sha256_hex(&read(file)), "{file}");
        expected.insert(file.clone());
    }
    let mut actual = BTreeSet::new();
    for part in ["", "kernels"] {
        for entry in std::fs::read_dir(folder().join(part)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            actual.insert(if part.is_empty() { name } else { format!("{part}/{name}") });
        }
    }
    assert_eq!(actual, expected);
}

/// The shipped table is the one that the crate computes, little-endian.
#[test]
fn the_table_file_is_the_table_that_the_crate_fills() {
    let mut table = vec![0; best_fit::TABLE_WORDS];
    best_fit::fill_table(&mut table);
    assert_eq!(read(BEST_FIT_TABLE), table.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>());
}

#[test]
fn spirv_val_accepts_every_module() {
    let kernels = manifest().modules.into_iter().map(|module| folder().join(module.file));
    let render = repository().join("host/render/shaders/spirv");
    kernels
        .chain(shaders::modules().map(|name| render.join(name)))
        .for_each(|file| validate("vulkan1.1", &file));
    validate("spv1.3", &folder().join(LIBRARY));
}

/// Fails unless spirv-val accepts a file.
fn validate(target: &str, file: &Path) {
    let mut validator = Command::new("spirv-val");
    let output = validator
        .args(["--target-env", target])
        .arg(file)
        .output()
        .expect("spirv-val is missing: `cargo xtask setup` installs it");
    assert!(output.status.success(), "{}: {}", file.display(), String::from_utf8_lossy(&output.stderr));
}

/// Kernels and the renderer's modules run on any device of Vulkan 1.1, with no feature turned on; every float result is
/// marked NoContraction; and there is no source text or path of the machine that built them.
#[test]
fn modules_keep_the_rules() {
    let manifest = manifest();
    assert_eq!((manifest.vulkan.as_str(), manifest.spirv.as_str()), ("1.1", "1.3"));
    assert_eq!((manifest.capabilities, manifest.features), (vec!["Shader".to_owned()], vec![]));
    let render: Vec<(&str, Module)> =
        shaders::modules().map(|name| (name, load_bytes(shaders::module(name).unwrap()).unwrap())).collect();
    let kernels = all_modules().iter().map(|(module, spirv)| (module.file.as_str(), spirv));
    for (name, spirv) in kernels.chain(render.iter().map(|(name, spirv)| (*name, spirv))) {
        // Half floats are converted with integers alone, and tables need no arithmetic.
        let has_none = ["float16x3", "by_table", "fullscreen.spv"].iter().any(|part| name.contains(part));
        assert_rules(name, spirv, &[Capability::Shader], if has_none { 0 } else { 6 });
        let texts = [&spirv.debug_string_source, &spirv.debug_names, &spirv.debug_module_processed];
        assert!(texts.iter().all(|text| text.is_empty()), "{name}");
    }
}

/// Fails unless a module is SPIR-V 1.3 with these capabilities and no extension, by GLSL's memory model, and all
/// results of at least so many float operations are marked.
fn assert_rules(name: &str, spirv: &Module, capabilities: &[Capability], fewest: usize) {
    assert_eq!(spirv.header.as_ref().unwrap().version, 0x0001_0300, "{name}: SPIR-V's version");
    let found: Vec<&Operand> = spirv.capabilities.iter().flat_map(|line| &line.operands).collect();
    let are_allowed = capabilities.iter().all(|allowed| found.contains(&&Operand::Capability(*allowed)));
    assert!(are_allowed && found.len() == capabilities.len(), "{name}: {found:?}");
    assert!(spirv.extensions.is_empty(), "{name}");
    let model =
        [Operand::AddressingModel(AddressingModel::Logical), Operand::MemoryModel(MemoryModel::GLSL450)];
    assert_eq!(spirv.memory_model.as_ref().unwrap().operands, model, "{name}");
    assert_eq!(unmarked_results(name, spirv, &FLOAT_ARITHMETIC, fewest), 0, "{name}");
}

/// `precise` is nowhere forgotten in the GLSL. glslang does not mark negation, which is exact. Decoders' kernels take
/// their four codes in a loop, in which there may be no more than one division of a vector.
#[cfg(feature = "glsl")]
#[test]
fn every_float_result_of_the_glsl_is_marked_no_contraction() {
    let compiler = Compiler::new().unwrap();
    let exact = Compiler::of(Edition::Exact).unwrap();
    let exact = widest_of_each_series().into_iter().map(|format| (format, &exact));
    let unmarked: Vec<String> = CODECS
        .iter()
        .map(|format| (format, &compiler))
        .chain(exact)
        .flat_map(|(format, compiler)| Operation::ALL.map(|operation| (format, operation, compiler)))
        .filter(|(format, operation, compiler)| {
            let spirv = load_bytes(compiler.kernel(format, *operation).unwrap()).unwrap();
            let fewest = if format.id == "float16x3" { 0 } else { 1 };
            unmarked_results(&format.function(*operation), &spirv, &FLOAT_ARITHMETIC[1..], fewest) > 0
        })
        .map(|(format, operation, _)| format.function(operation))
        .collect();
    assert!(unmarked.is_empty(), "{unmarked:?}");
}

/// The number of results of these operations that are not marked. There are `fewest` at least.
fn unmarked_results(name: &str, spirv: &Module, arithmetic: &[Op], fewest: usize) -> usize {
    let of_arithmetic = spirv.all_inst_iter().filter(|line| arithmetic.contains(&line.class.opcode));
    let results: Vec<Word> = of_arithmetic.filter_map(|line| line.result_id).collect();
    assert!(results.len() >= fewest, "{name} has no arithmetic");
    let mark = Operand::Decoration(Decoration::NoContraction);
    let marks = spirv.annotations.iter().filter(|line| line.operands.get(1) == Some(&mark));
    let marked: HashSet<Word> = marks.filter_map(|line| line.operands[0].id_ref_any()).collect();
    results.iter().filter(|id| !marked.contains(id)).count()
}

/// Every codec's two functions, under the names that the catalogue gives them, by which they are exported; no entry point; and
/// what the kernels keep to.
#[test]
fn the_library_exports_the_functions_of_all_codecs() {
    let library = manifest().library;
    assert_eq!(
        (library.file.as_str(), library.capabilities),
        (LIBRARY, vec!["Linkage".into(), "Shader".into()])
    );
    let spirv = load_bytes(read(LIBRARY)).unwrap();
    let linkage = Operand::Decoration(Decoration::LinkageAttributes);
    let exports = spirv.annotations.iter().filter(|line| line.operands.get(1) == Some(&linkage));
    let exports: BTreeSet<&str> = exports
        .map(|line| {
            let [id, _, name @ Operand::LiteralString(text), last] = &line.operands[..] else {
                panic!("{line:?}")
            };
            assert_eq!(*last, Operand::LinkageType(LinkageType::Export));
            assert!(
                spirv.debug_names.iter().any(|line| line.operands == [id.clone(), name.clone()]),
                "{text}"
            );
            text.as_str()
        })
        .collect();
    let signatures: Vec<Signature> = Signature::all().collect();
    assert_eq!(exports, signatures.iter().map(|signature| signature.name.as_str()).collect());
    assert_eq!(library.functions, signatures.iter().map(Signature::to_string).collect::<Vec<_>>());
    assert_eq!((spirv.functions.len(), spirv.entry_points.len()), (signatures.len(), 0));
    assert_rules(LIBRARY, &spirv, &[Capability::Shader, Capability::Linkage], 1000);
}

/// The facts that a host needs: names, workgroups, and of each buffer whether it is only read, and its array's element:
/// a word.
#[test]
fn entry_points_are_as_the_manifest_says() {
    let interfaces = manifest().interfaces;
    for (module, spirv) in all_modules() {
        assert_eq!(spirv.entry_points.len(), module.entry_points.len(), "{}", module.file);
        for (entry, line) in module.entry_points.iter().zip(&spirv.entry_points) {
            let name = &entry.name;
            let [model, Operand::IdRef(function), text, variables @ ..] = &line.operands[..] else {
                panic!("{line:?}")
            };
            assert_eq!(*model, Operand::ExecutionModel(ExecutionModel::GLCompute), "{name}");
            assert_eq!(*text, Operand::LiteralString(name.clone()));
            for variable in variables {
                let mut globals = spirv.types_global_values.iter();
                let line = globals.find(|line| line.result_id == variable.id_ref_any()).unwrap();
                let classes = [StorageClass::Input, StorageClass::Output].map(Operand::StorageClass);
                assert!(classes.contains(&line.operands[0]), "{name}: {line:?}");
            }
            let interface = &interfaces[&entry.interface];
            let [x, y, z] = interface.workgroup_size.map(Operand::LiteralBit32);
            let size = [Operand::IdRef(*function), Operand::ExecutionMode(ExecutionMode::LocalSize), x, y, z];
            assert!(spirv.execution_modes.iter().any(|mode| mode.operands == size), "{name}");
            let expected = interface
                .bindings
                .iter()
                .map(|binding| (interface.descriptor_set, binding.binding, binding.role != Role::Output));
            let actual = buffers(spirv, *function);
            let found = actual.iter().map(|&(set, binding, is_read, _)| (set, binding, is_read));
            assert_eq!(found.collect::<Vec<_>>(), expected.collect::<Vec<_>>(), "{name}");
            assert_eq!(interface.vectors_per_workgroup as usize, GROUP * WORKGROUP, "{name}");
            for (buffer, binding) in actual.iter().zip(&interface.bindings[..2]) {
                assert_eq!(buffer.3, binding.size_multiple, "{name}");
            }
        }
    }
}

/// The constants of an entry point's interface, with their defaults: `whole_groups`, and `fast` where anything is divided.
#[test]
fn specialization_constants_are_those_of_the_manifest() {
    let interfaces = manifest().interfaces;
    for (module, spirv) in all_modules() {
        let of = |opcode| spirv.types_global_values.iter().filter(move |line| line.class.opcode == opcode);
        let (lines, of_bool) = (of(Op::SpecConstant), of(Op::SpecConstantFalse));
        let number = |line: &Instruction| decorated(spirv, line.result_id.unwrap(), Decoration::SpecId);
        let of_module: Vec<_> = lines.map(|line| (number(line), line.operands.clone())).collect();
        assert_eq!(of_module, [(Some(0), vec![Operand::LiteralBit32(0)])], "{}", module.file);
        let of_bool: Vec<_> = of_bool.map(number).collect();
        let expected = if divides(spirv) { &[Some(1)][..] } else { &[] };
        assert_eq!(of_bool, expected, "{}", module.file);
        for entry in &module.entry_points {
            let listed = &interfaces[&entry.interface].specialization_constants;
            let listed = listed.iter().map(|constant| (constant.id, constant.default));
            assert_eq!(listed.collect::<Vec<_>>(), [(0, 0), (1, 0)], "{}", entry.name);
        }
    }
}

/// True for a module that takes the device's quotients or roots.
fn divides(spirv: &Module) -> bool {
    let roots = [GLOp::Sqrt, GLOp::InverseSqrt].map(|root| Operand::LiteralExtInstInteger(root as u32));
    spirv.all_inst_iter().any(|line| match line.class.opcode {
        Op::FDiv => true,
        Op::ExtInst => roots.contains(&line.operands[1]),
        _ => false,
    })
}

/// The kernels' modules, which several tests look through.
fn all_modules() -> &'static [(Entry, Module)] {
    static MODULES: LazyLock<Vec<(Entry, Module)>> = LazyLock::new(|| {
        let loaded = |entry: Entry| (entry.clone(), load_bytes(read(&entry.file)).unwrap());
        manifest().modules.into_iter().map(loaded).collect()
    });
    &MODULES
}

/// The words after a decoration of an id.
fn decoration(spirv: &Module, id: Word, decoration: Decoration) -> Option<&[Operand]> {
    let begin = [Operand::IdRef(id), Operand::Decoration(decoration)];
    spirv.annotations.iter().find_map(|line| line.operands.strip_prefix(&begin))
}

/// The number after a decoration of an id.
fn decorated(spirv: &Module, id: Word, of: Decoration) -> Option<u32> {
    match decoration(spirv, id, of)? {
        [Operand::LiteralBit32(number)] => Some(*number),
        _ => None,
    }
}

/// The storage buffers that a function reads and writes: set, binding, whether it only reads them, and the bytes from
/// one element to the next.
fn buffers(spirv: &Module, function: Word) -> Vec<(u32, u32, bool, u32)> {
    let is_it = |other: &&Function| other.def_id() == Some(function);
    let body = spirv.functions.iter().find(is_it).unwrap().all_inst_iter();
    let accesses = body.filter(|line| {
        [Op::AccessChain, Op::InBoundsAccessChain, Op::ArrayLength].contains(&line.class.opcode)
    });
    let used: BTreeSet<Word> = accesses.filter_map(|line| line.operands[0].id_ref_any()).collect();
    let mut buffers: Vec<_> = used.into_iter().filter_map(|id| buffer(spirv, id)).collect();
    buffers.sort_unstable();
    buffers
}

fn buffer(spirv: &Module, variable: Word) -> Option<(u32, u32, bool, u32)> {
    let [set, binding] =
        [Decoration::DescriptorSet, Decoration::Binding].map(|of| decorated(spirv, variable, of));
    let line = |id| spirv.types_global_values.iter().find(|line| line.result_id == Some(id));
    let pointer = line(line(variable)?.result_type?)?;
    let array = line(pointer.operands[1].id_ref_any()?)?.operands[0].id_ref_any()?;
    let is_read = decoration(spirv, variable, Decoration::NonWritable).is_some();
    Some((set?, binding?, is_read, decorated(spirv, array, Decoration::ArrayStride)?))
}

/// The operations whose results are floats.
const FLOAT_ARITHMETIC: [Op; 14] = [
    Op::FNegate,
    Op::FAdd,
    Op::FSub,
    Op::FMul,
    Op::FDiv,
    Op::FRem,
    Op::FMod,
    Op::VectorTimesScalar,
    Op::MatrixTimesScalar,
    Op::VectorTimesMatrix,
    Op::MatrixTimesVector,
    Op::MatrixTimesMatrix,
    Op::OuterProduct,
    Op::Dot,
];
