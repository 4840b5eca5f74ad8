//! The committed SPIR-V modules match the manifest, are fresh, valid, and keep the arithmetic rules.

use std::collections::{BTreeSet, HashSet};
use std::path::PathBuf;
use std::process::Command;
use unitvec::best_fit;
#[cfg(feature = "glsl")]
use unitvec_catalogue::Domain;
use unitvec_catalogue::{CODECS, Operation, find};
use unitvec_link::{LIBRARY, Signature};
#[cfg(feature = "glsl")]
use unitvec_manifest::modules::Modules;
use unitvec_manifest::{BEST_FIT_TABLE, Manifest, Module, Role, SCHEMA, schema, sha256_hex};
use unitvec_render::shaders;
#[cfg(feature = "glsl")]
use unitvec_run::glsl::{Compiler, ENTRY_POINT};
#[cfg(feature = "glsl")]
use unitvec_run::sampling;
use unitvec_tests::repository;
#[cfg(feature = "glsl")]
use unitvec_tests::{assert_no_validation_messages, lavapipe};
#[cfg(feature = "glsl")]
use unitvec_vulkan::{BufferPromise, Runner, SENTINEL};
use unitvec_vulkan::{GROUP, WORKGROUP};

fn folder() -> PathBuf {
    repository().join("spirv")
}

fn manifest() -> Manifest {
    serde_json::from_slice(&std::fs::read(folder().join("manifest.json")).unwrap()).unwrap()
}

/// A module of two entry points a codec, and the decoder by table.
#[test]
fn the_manifest_lists_a_module_of_every_codec() {
    let manifest = manifest();
    let mut expected = BTreeSet::from(["kernels/decode_by_table.spv".to_owned()]);
    for format in &CODECS {
        let file = format!("kernels/{}.spv", format.id);
        let module = manifest.modules.iter().find(|module| module.file == file);
        let module = module.unwrap_or_else(|| panic!("no module {file}"));
        assert_eq!(module.codec.as_ref().map(|codec| codec.id.as_str()), Some(format.id), "{file}");
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

/// The manifest agrees with the catalogue about each codec.
#[test]
fn the_codecs_are_those_of_the_catalogue() {
    let described = manifest().modules.into_iter().filter_map(|module| module.codec);
    for codec in described {
        let format = find(&codec.id).unwrap();
        assert_eq!(
            (codec.element, codec.bits, codec.bytes as usize, codec.vk_format.as_deref()),
            (format.element, format.bits, format.bytes, format.vk_format),
            "{}",
            codec.id
        );
        assert_eq!(codec.max_error_deg, format.max_errors_deg, "{}", codec.id);
    }
    for table in manifest().tables {
        let size = std::fs::metadata(folder().join(&table.file)).unwrap().len();
        assert_eq!(u64::from(table.bytes), size, "{}", table.file);
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
    for (file, sha256) in modules.chain(tables).chain(library) {
        assert_eq!(*sha256, sha256_hex(&std::fs::read(folder().join(file)).unwrap()), "{file}");
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
    let bytes = std::fs::read(folder().join(BEST_FIT_TABLE)).unwrap();
    assert_eq!(bytes, table.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>());
}

#[test]
fn spirv_val_accepts_every_module() {
    let kernels = manifest().modules.into_iter().map(|module| folder().join(module.file));
    for file in kernels.chain(shaders::modules().map(|name| render_folder().join(name))) {
        let output = Command::new("spirv-val")
            .args(["--target-env", "vulkan1.1"])
            .arg(&file)
            .output()
            .expect("spirv-val is missing: `cargo xtask setup` installs it");
        assert!(output.status.success(), "{}: {}", file.display(), String::from_utf8_lossy(&output.stderr));
    }
}

fn render_folder() -> PathBuf {
    repository().join("host/render/shaders/spirv")
}

#[test]
fn every_float_result_is_marked_no_contraction() {
    let is_unmarked = |(module, spirv): &(Module, Spirv)| {
        // Half floats are converted with integers alone, and tables need no arithmetic.
        let fewest =
            if module.file.contains("float16x3") || module.file.contains("by_table") { 0 } else { 6 };
        unmarked_results(&module.file, spirv, &FLOAT_ARITHMETIC, fewest) > 0
    };
    let unmarked: Vec<_> =
        all_modules().into_iter().filter(is_unmarked).map(|(module, _)| module.file).collect();
    assert!(unmarked.is_empty(), "{unmarked:?}");
}

/// The renderer's modules keep to what the kernels do: exact arithmetic, no feature, no text. All but the one without arithmetic
/// have some.
#[test]
fn render_modules_keep_the_rules_of_the_kernels() {
    for name in shaders::modules() {
        let bytes = shaders::module(name).unwrap();
        let spirv = Spirv::parse(bytes);
        let fewest = if name == "fullscreen.spv" { 0 } else { 6 };
        assert_eq!(unmarked_results(name, &spirv, &FLOAT_ARITHMETIC, fewest), 0, "{name}");
        assert_eq!(bytes[4..8], 0x0001_0300_u32.to_le_bytes(), "{name}: SPIR-V's version");
        assert_eq!(spirv.all(OP_CAPABILITY).collect::<Vec<_>>(), [[SHADER]], "{name}");
        assert_eq!(spirv.all(OP_EXTENSION).count(), 0, "{name}");
        assert_eq!(spirv.all(OP_MEMORY_MODEL).collect::<Vec<_>>(), [[LOGICAL, GLSL450]], "{name}");
        assert!(DEBUG_TEXT.iter().all(|opcode| spirv.all(*opcode).count() == 0), "{name}");
    }
}

/// `precise` is nowhere forgotten in the GLSL. glslang does not mark negation, which is exact. Decoders' kernels take
/// their four codes in a loop, in which there may be no more than one division of a vector.
#[cfg(feature = "glsl")]
#[test]
fn every_float_result_of_the_glsl_is_marked_no_contraction() {
    let compiler = Compiler::new().unwrap();
    let unmarked: Vec<String> = CODECS
        .iter()
        .flat_map(|format| Operation::ALL.map(|operation| (format, operation)))
        .filter(|(format, operation)| {
            let spirv = Spirv::parse(&compiler.kernel(format, *operation).unwrap());
            let fewest = if format.id == "float16x3" { 0 } else { 1 };
            unmarked_results(&format.function(*operation), &spirv, &FLOAT_ARITHMETIC[1..], fewest) > 0
        })
        .map(|(format, operation)| format.function(operation))
        .collect();
    assert!(unmarked.is_empty(), "{unmarked:?}");
}

/// The number of results of these opcodes that are not marked. There are `fewest` at least.
fn unmarked_results(name: &str, spirv: &Spirv, arithmetic: &[u32], fewest: usize) -> usize {
    let of_arithmetic = spirv.0.iter().filter(|instruction| arithmetic.contains(&instruction.opcode));
    let results: Vec<u32> = of_arithmetic.map(|instruction| instruction.operands[1]).collect();
    assert!(results.len() >= fewest, "{name} has no arithmetic");
    let decorations = spirv.all(OP_DECORATE);
    let decorated: HashSet<u32> =
        decorations.filter(|operands| operands[1] == NO_CONTRACTION).map(|operands| operands[0]).collect();
    results.iter().filter(|id| !decorated.contains(id)).count()
}

/// Any device of Vulkan 1.1 takes them, with no feature turned on.
#[test]
fn modules_need_vulkan_1_1_and_nothing_else() {
    let manifest = manifest();
    assert_eq!((manifest.vulkan.as_str(), manifest.spirv.as_str()), ("1.1", "1.3"));
    assert_eq!((manifest.capabilities, manifest.features), (vec!["Shader".to_owned()], vec![]));
    for (module, spirv) in all_modules() {
        let name = &module.file;
        let bytes = std::fs::read(folder().join(name)).unwrap();
        assert_eq!(bytes[4..8], 0x0001_0300_u32.to_le_bytes(), "{name}: SPIR-V's version");
        assert_eq!(spirv.all(OP_CAPABILITY).collect::<Vec<_>>(), [[SHADER]], "{name}");
        assert_eq!(spirv.all(OP_EXTENSION).count(), 0, "{name}");
        assert_eq!(spirv.all(OP_MEMORY_MODEL).collect::<Vec<_>>(), [[LOGICAL, GLSL450]], "{name}");
    }
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
    let path = folder().join(LIBRARY);
    let bytes = std::fs::read(&path).unwrap();
    let spirv = Spirv::parse(&bytes);
    let text = |words: &[u32]| {
        let bytes = words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0);
        String::from_utf8(bytes.collect()).unwrap()
    };
    let named = |id: u32| spirv.all(OP_NAME).find(|operands| operands[0] == id).map(|name| text(&name[1..]));
    let exports = spirv.all(OP_DECORATE).filter(|operands| operands[1] == LINKAGE_ATTRIBUTES);
    let exports: BTreeSet<String> = exports
        .map(|operands| {
            assert_eq!(operands.last(), Some(&EXPORT));
            let name = text(&operands[2..]);
            assert_eq!(named(operands[0]), Some(name.clone()));
            name
        })
        .collect();
    let signatures: Vec<Signature> = Signature::all().collect();
    assert_eq!(exports, signatures.iter().map(|signature| signature.name.clone()).collect());
    assert_eq!(library.functions, signatures.iter().map(Signature::to_string).collect::<Vec<_>>());
    assert_eq!(spirv.all(OP_FUNCTION).count(), signatures.len());

    assert_eq!(bytes[4..8], 0x0001_0300_u32.to_le_bytes());
    let capabilities: BTreeSet<u32> = spirv.all(OP_CAPABILITY).map(|operands| operands[0]).collect();
    assert_eq!(capabilities, BTreeSet::from([SHADER, LINKAGE]));
    assert_eq!((spirv.all(OP_EXTENSION).count(), spirv.all(OP_ENTRY_POINT).count()), (0, 0));
    assert_eq!(spirv.all(OP_MEMORY_MODEL).collect::<Vec<_>>(), [[LOGICAL, GLSL450]]);
    assert_eq!(unmarked_results(LIBRARY, &spirv, &FLOAT_ARITHMETIC, 1000), 0);
    let validated = Command::new("spirv-val").args(["--target-env", "spv1.3"]).arg(&path).output().unwrap();
    assert!(validated.status.success(), "{}", String::from_utf8_lossy(&validated.stderr));
}

/// The facts that a host needs: names, workgroups, and of each buffer whether it is only read, and its array's element:
/// a word.
#[test]
fn entry_points_are_as_the_manifest_says() {
    let interfaces = manifest().interfaces;
    for (module, spirv) in all_modules() {
        let entry_points: Vec<&[u32]> = spirv.all(OP_ENTRY_POINT).collect();
        assert_eq!(entry_points.len(), module.entry_points.len(), "{}", module.file);
        for (entry, operands) in module.entry_points.iter().zip(entry_points) {
            let (function, name) = (operands[1], &entry.name);
            let (text, variables) = literal(&operands[2..]);
            assert_eq!((operands[0], &text), (GL_COMPUTE, name));
            for variable in variables {
                let class = spirv.all(OP_VARIABLE).find(|operands| operands[1] == *variable).unwrap()[2];
                assert!([INPUT, OUTPUT].contains(&class), "{name}: {class}");
            }
            let interface = &interfaces[&entry.interface];
            let mode = spirv.all(OP_EXECUTION_MODE).find(|operands| operands[0] == function).unwrap();
            assert_eq!(mode[1..], [&[LOCAL_SIZE], &interface.workgroup_size[..]].concat(), "{name}");
            let expected = interface
                .bindings
                .iter()
                .map(|binding| (interface.descriptor_set, binding.binding, binding.role != Role::Output));
            let actual = spirv.buffers(function);
            let found = actual.iter().map(|&(set, binding, is_read, _)| (set, binding, is_read));
            assert_eq!(found.collect::<Vec<_>>(), expected.collect::<Vec<_>>(), "{name}");
            assert_eq!(interface.vectors_per_workgroup as usize, GROUP * WORKGROUP, "{name}");
            for (buffer, binding) in actual.iter().zip(&interface.bindings[..2]) {
                assert_eq!(buffer.3, binding.size_multiple, "{name}");
            }
        }
    }
}

/// The constants of an entry point's interface, with their defaults: `whole_groups`.
#[test]
fn specialization_constants_are_those_of_the_manifest() {
    let interfaces = manifest().interfaces;
    for (module, spirv) in all_modules() {
        let constants = spirv.all(OP_SPEC_CONSTANT);
        let of_module: Vec<(u32, u32)> = constants
            .map(|operands| (spirv.decoration(operands[1], SPEC_ID).unwrap()[0], operands[2]))
            .collect();
        assert_eq!(of_module, [(0, 0)], "{}", module.file);
        for entry in &module.entry_points {
            let listed = &interfaces[&entry.interface].specialization_constants;
            let listed = listed.iter().map(|constant| (constant.id, constant.default));
            assert_eq!(listed.collect::<Vec<_>>(), of_module, "{}", entry.name);
        }
    }
}

/// Kernels for buffers of whole groups write the groups that the others write when they are asked for all of them, and
/// nothing behind.
#[cfg(feature = "glsl")]
#[test]
fn kernels_of_whole_groups_write_the_same() {
    const COUNTS: [usize; 3] = [4, 1000, 4099];
    const MOST: usize = 4100;
    let device = lavapipe();
    let mut runner = Runner::new(&device, MOST + GROUP, true).unwrap();
    let (modules, compiler) = (Modules::open(None).unwrap(), Compiler::new().unwrap());
    for id in ["oct8", "oct16", "oct24", "oct32", "oct48", "oct52p", "frame32", "frame64"] {
        let format = find(id).unwrap();
        let random = sampling::random_elements(format.element, Domain::Sphere, 11);
        let elements: Vec<u8> =
            random.take(MOST * format.element.floats()).flat_map(f32::to_le_bytes).collect();
        let mut codes = vec![0; MOST * format.bytes];
        for operation in Operation::ALL {
            let name = format.function(operation);
            let from_rust = modules.load(&name).unwrap();
            let from_glsl = compiler.kernel(format, operation).unwrap();
            for (spirv, entry_point) in [(&from_rust[..], name.as_str()), (&from_glsl[..], ENTRY_POINT)] {
                let [exact, whole] = [BufferPromise::ExactSize, BufferPromise::WholeGroups]
                    .map(|buffers| runner.kernel_for(buffers, spirv, entry_point, None).unwrap());
                let (read, written) = match operation {
                    Operation::Encode => (&elements, format.bytes),
                    Operation::Decode => (&codes, format.element.bytes()),
                };
                for count in COUNTS {
                    let groups = count.next_multiple_of(GROUP);
                    let input = &read[..groups * (read.len() / MOST)];
                    let [mut expected, mut actual] = [(); 2].map(|()| vec![0; groups * written + 16]);
                    runner.run(&exact, groups, input, &mut expected).unwrap();
                    runner.run(&whole, count, input, &mut actual).unwrap();
                    assert!(actual == expected, "{entry_point} of {name}: {count}");
                    let behind = actual[groups * written..].chunks(4);
                    assert!(behind.into_iter().all(|word| word == SENTINEL.to_le_bytes()), "{name}");
                }
                if operation == Operation::Encode {
                    runner.run(&exact, MOST, &elements, &mut codes).unwrap();
                }
            }
        }
    }
    drop(runner);
    assert_no_validation_messages(device);
}

/// The text that begins these words, and the words after it.
fn literal(words: &[u32]) -> (String, &[u32]) {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let length = bytes.iter().position(|byte| *byte == 0).unwrap();
    (String::from_utf8(bytes[..length].to_vec()).unwrap(), &words[length / 4 + 1..])
}

/// No source text or paths of the machine that built them.
#[test]
fn modules_carry_no_debug_text() {
    for (module, spirv) in all_modules() {
        let has_text = spirv.0.iter().any(|instruction| DEBUG_TEXT.contains(&instruction.opcode));
        assert!(!has_text, "{}", module.file);
    }
}

fn all_modules() -> Vec<(Module, Spirv)> {
    let modules = manifest().modules.into_iter();
    let read = |module: &Module| Spirv::parse(&std::fs::read(folder().join(&module.file)).unwrap());
    modules.map(|module| (module.clone(), read(&module))).collect()
}

/// A module's instructions.
pub struct Spirv(Vec<Instruction>);

/// An instruction: its opcode and the words after the first.
struct Instruction {
    opcode: u32,
    operands: Vec<u32>,
}

impl Spirv {
    /// The instructions of a module.
    pub fn parse(bytes: &[u8]) -> Self {
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
        Self(instructions)
    }

    /// The operands of all instructions of an opcode.
    pub fn all(&self, opcode: u32) -> impl Iterator<Item = &[u32]> {
        let of_opcode = self.0.iter().filter(move |instruction| instruction.opcode == opcode);
        of_opcode.map(|instruction| instruction.operands.as_slice())
    }

    /// The words after a decoration of an id.
    fn decoration(&self, id: u32, decoration: u32) -> Option<&[u32]> {
        self.all(OP_DECORATE)
            .find(|operands| operands[..2] == [id, decoration])
            .map(|operands| &operands[2..])
    }

    /// The storage buffers that a function reads and writes: set, binding, whether it only reads them, and the bytes from one
    /// element to the next.
    fn buffers(&self, function: u32) -> Vec<(u32, u32, bool, u32)> {
        let is_start = |instruction: &&Instruction| {
            instruction.opcode == OP_FUNCTION && instruction.operands[1] == function
        };
        let body = self.0.iter().skip_while(|instruction| !is_start(instruction));
        let accesses = body
            .take_while(|instruction| instruction.opcode != OP_FUNCTION_END)
            .filter(|instruction| ACCESSES.contains(&instruction.opcode));
        let used: BTreeSet<u32> = accesses.map(|instruction| instruction.operands[2]).collect();
        let mut buffers: Vec<_> = used.into_iter().filter_map(|id| self.buffer(id)).collect();
        buffers.sort_unstable();
        buffers
    }

    fn buffer(&self, variable: u32) -> Option<(u32, u32, bool, u32)> {
        let set = self.decoration(variable, DESCRIPTOR_SET)?[0];
        let binding = self.decoration(variable, BINDING)?[0];
        let of = |opcode, id, n: usize| {
            self.all(opcode).find(|operands: &&[u32]| operands[0] == id).map(|operands| operands[n])
        };
        let pointer = self.all(OP_VARIABLE).find(|operands| operands[1] == variable)?[0];
        let array = of(OP_TYPE_STRUCT, of(OP_TYPE_POINTER, pointer, 2)?, 1)?;
        let stride = self.decoration(array, ARRAY_STRIDE)?[0];
        Some((set, binding, self.decoration(variable, NON_WRITABLE).is_some(), stride))
    }
}

// Numbers from the SPIR-V specification, section 3.
const OP_NAME: u32 = 5;
const OP_EXTENSION: u32 = 10;
const OP_MEMORY_MODEL: u32 = 14;
const OP_ENTRY_POINT: u32 = 15;
const OP_EXECUTION_MODE: u32 = 16;
const OP_CAPABILITY: u32 = 17;
const OP_TYPE_STRUCT: u32 = 30;
const OP_TYPE_POINTER: u32 = 32;
const OP_SPEC_CONSTANT: u32 = 50;
const OP_FUNCTION: u32 = 54;
const OP_FUNCTION_END: u32 = 56;
const OP_VARIABLE: u32 = 59;
const OP_DECORATE: u32 = 71;
/// OpAccessChain, OpInBoundsAccessChain, OpArrayLength.
const ACCESSES: [u32; 3] = [65, 66, 68];
const SPEC_ID: u32 = 1;
const ARRAY_STRIDE: u32 = 6;
const NON_WRITABLE: u32 = 24;
const BINDING: u32 = 33;
const DESCRIPTOR_SET: u32 = 34;
const NO_CONTRACTION: u32 = 42;
const LINKAGE_ATTRIBUTES: u32 = 41;
const EXPORT: u32 = 0;
const SHADER: u32 = 1;
const LINKAGE: u32 = 5;
const LOGICAL: u32 = 0;
const GLSL450: u32 = 1;
const GL_COMPUTE: u32 = 5;
const LOCAL_SIZE: u32 = 17;
const INPUT: u32 = 1;
const OUTPUT: u32 = 3;
/// OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv, OpFRem, OpFMod, OpVectorTimesScalar to OpDot.
const FLOAT_ARITHMETIC: [u32; 14] = [127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148];
/// OpSourceContinued, OpSource, OpSourceExtension, OpName, OpMemberName, OpString, OpLine, OpModuleProcessed.
const DEBUG_TEXT: [u32; 8] = [2, 3, 4, 5, 6, 7, 8, 330];
