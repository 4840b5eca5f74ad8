//! Shaders that call the library's functions by stubs and are linked compute the CPU's results, to the bit; modules
//! that cannot be linked are refused in one line.

use std::path::Path;
use std::process::Command;
use unitvec_catalogue::{self as catalogue, AnyCodec, Domain, Element, Operation};
use unitvec_link::stubs::Language;
use unitvec_link::{self as link, Error, Signature, Type, stubs};
use unitvec_run::sampling;
use unitvec_tests::program::{command, refusal, stderr};
use unitvec_tests::{assert_no_validation_messages, lavapipe, repository};
use unitvec_vulkan::Runner;

/// Codecs of a module: each module takes the linker as long as a few codecs do.
const CODECS: usize = 10;

/// Random vectors, and as many random codes. A wrong function, argument or result shows in nearly all of them.
const RANDOM: usize = 1 << 14;

/// A compiler, and how a shader is written for it.
pub struct FrontEnd {
    name: &'static str,
    language: Language,
    /// Lines before the stubs.
    words: &'static str,
    /// Buffers, and the beginning of `main`.
    interface: &'static str,
    /// The command but for the source and `-o`.
    command: &'static str,
}

/// Part of the packages that tests need.
pub const GLSL: FrontEnd = FrontEnd {
    name: "GLSL by glslang",
    language: Language::Glsl,
    words: include_str!("link/words.glsl"),
    interface: include_str!("link/begin.glsl"),
    command: "glslangValidator -V --target-env vulkan1.1 -S comp",
};

/// Arguments are pointers.
pub const HLSL: FrontEnd = FrontEnd {
    name: "HLSL by glslang",
    language: Language::Hlsl,
    words: "",
    interface: include_str!("link/begin.hlsl"),
    command: "glslangValidator -V -D -Od --target-env vulkan1.1 -S comp -e main",
};

/// Words that an invocation reads: an element and a code; and writes for each codec: a code and an element.
fn words(element: Element) -> usize {
    element.floats() + 2
}

/// Lines that write a value of this type to consecutive words.
fn write(value: &str, of_type: Type, at: &str) -> String {
    let components = |n: usize, name: &str, cast: &str, from: usize| -> String {
        let line = |i: usize| {
            let component = &"xyzw"[i..=i];
            format!("    words_out[{at} + {}u] = {cast}({value}{name}.{component});\n", from + i)
        };
        (0..n).map(line).collect()
    };
    match of_type {
        Type::Uint => format!("    words_out[{at}] = {value};\n    words_out[{at} + 1u] = 0u;\n"),
        Type::Uvec2 => components(2, "", "", 0),
        Type::Vec3 => components(3, "", "asuint", 0),
        Type::Vec4 => components(4, "", "asuint", 0),
        Type::Frame => components(3, ".normal", "asuint", 0) + &components(4, ".tangent", "asuint", 3),
    }
}

/// A compute shader that encodes an element and decodes a code by each of these codecs, without the stubs.
pub fn caller(front_end: &FrontEnd, formats: &[&'static AnyCodec]) -> String {
    let (element, interface) = (formats[0].element, front_end.interface);
    let words = words(element);
    let float = |k: usize| format!("asfloat(words_in[first + {k}u])");
    let vector = |from: usize, n: usize| (from..from + n).map(float).collect::<Vec<_>>().join(", ");
    let mut text = format!(
        "{interface}    if (n >= count) return;
    uint first = n * {words}u;
    uint2 code = uint2(words_in[first + {}u], words_in[first + {}u]);
",
        words - 2,
        words - 1,
    );
    let names: &[(&str, usize)] = match element {
        Element::Vector => &[("normal", 3)],
        Element::Frame => &[("normal", 3), ("tangent", 4)],
        Element::Rotation => &[("rotation", 4)],
    };
    let mut first = 0;
    for (name, floats) in names {
        text += &format!("    float{floats} {name} = float{floats}({});\n", vector(first, *floats));
        first += floats;
    }
    for (k, format) in formats.iter().enumerate() {
        let [encode, decode] = Operation::ALL.map(|operation| Signature::of(format, operation));
        let arguments = match element {
            Element::Vector => "normal",
            Element::Frame => "normal, tangent",
            Element::Rotation => "rotation",
        };
        let given = if encode.result == Type::Uint { "code.x" } else { "code" };
        let [code, decoded] = [encode.result, decode.result].map(|of_type| match of_type {
            Type::Vec3 => "float3".to_owned(),
            Type::Vec4 => "float4".to_owned(),
            Type::Uvec2 => "uint2".to_owned(),
            other => other.to_string(),
        });
        let at = format!("at{k}");
        text += &format!("    uint {at} = (n * {}u + {k}u) * {words}u;\n", formats.len());
        text += &format!("    {code} code{k} = {}({arguments});\n", encode.name);
        text += &write(&format!("code{k}"), encode.result, &at);
        text += &format!("    {decoded} decoded{k} = {}({given});\n", decode.name);
        text += &write(&format!("decoded{k}"), decode.result, &format!("{at} + 2u"));
    }
    text + "}\n"
}

fn compile(front_end: &FrontEnd, text: &str) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let ending = front_end.language.ending();
    let [source, module] =
        [format!("shader.{ending}"), "shader.spv".to_owned()].map(|name| folder.path().join(name));
    std::fs::write(&source, text).unwrap();
    let command = front_end.command;
    let mut words = command.split(' ');
    let mut compiler = Command::new(words.next().unwrap());
    compiler.args(words).arg(&source).arg("-o").arg(&module);
    let output =
        compiler.output().unwrap_or_else(|error| panic!("{command}: {error}; see `cargo xtask setup`"));
    let said = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{said:?}\n{text}");
    std::fs::read(module).unwrap()
}

/// A shader with the stubs, which `change` may change.
pub fn with_stubs(front_end: &FrontEnd, caller: &str, change: impl Fn(String) -> String) -> Vec<u8> {
    let stubs = change(stubs::text(front_end.language));
    compile(front_end, &format!("{}{stubs}{caller}", front_end.words))
}

/// Elements and codes: the special ones, then random ones.
fn inputs(element: Element) -> (Vec<f32>, Vec<u64>) {
    let special = sampling::special_elements(element);
    let count = special.len() / element.floats() + RANDOM;
    let more = sampling::random_elements(element, Domain::Sphere, 21).take(RANDOM * element.floats());
    let codes = sampling::special_codes().into_iter().chain(sampling::random_codes(22)).take(count);
    (special.iter().copied().chain(more).collect(), codes.collect())
}

/// Runs modules of all codecs, linked, beside the CPU; the number of inputs of a codec that were compared.
fn agree(front_end: &FrontEnd) {
    let device = lavapipe();
    let (mut compared, mut mismatches) = (0, Vec::new());
    for element in Element::ALL {
        let formats: Vec<&'static AnyCodec> =
            catalogue::CODECS.iter().filter(|format| format.element == element).collect();
        let (elements, codes) = inputs(element);
        let count = codes.len();
        let given: Vec<u8> = elements
            .chunks(element.floats())
            .zip(&codes)
            .flat_map(|(element, code)| {
                let words = element.iter().map(|float| float.to_bits());
                words.chain([*code as u32, (*code >> 32) as u32]).flat_map(u32::to_le_bytes)
            })
            .collect();
        // The runner's buffers have 28 bytes a vector.
        let mut runner = Runner::new(&device, count * words(element) * CODECS / 7 + 1, true).unwrap();
        for formats in formats.chunks(CODECS) {
            let module = with_stubs(front_end, &caller(front_end, formats), |text| text);
            let linked = link::link(&module).unwrap_or_else(|error| panic!("{error}"));
            let kernel = runner.kernel(&linked, "main", None).unwrap();
            let mut actual = vec![0; count * formats.len() * words(element) * 4];
            runner.run_cost(&kernel, count, 0, &given, &mut actual).unwrap();
            for (k, format) in formats.iter().enumerate() {
                let actual = actual.chunks(words(element) * 4).skip(k).step_by(formats.len());
                let expected = expected(format, &elements, &codes);
                for (actual, expected) in actual.zip(expected.chunks(words(element) * 4)) {
                    compared += 1;
                    if actual != expected && !is_nan_twice(actual, expected) {
                        mismatches.push(format!("{}: {actual:?} for {expected:?}", format.id));
                    }
                }
            }
        }
    }
    println!(
        "link: {compared} encodings and as many decodings from {}: {} mismatches",
        front_end.name,
        mismatches.len()
    );
    assert_eq!(mismatches.len(), 0, "{:#?}", &mismatches[..mismatches.len().min(20)]);
    assert_no_validation_messages(device);
}

/// True where the only difference is how a NaN is written.
fn is_nan_twice(a: &[u8], b: &[u8]) -> bool {
    let float = |word: &[u8]| f32::from_le_bytes(word.try_into().unwrap());
    a[..8] == b[..8]
        && a[8..]
            .chunks(4)
            .zip(b[8..].chunks(4))
            .all(|(a, b)| a == b || float(a).is_nan() && float(b).is_nan())
}

/// The CPU's words: the code of each element, and the element of each code.
fn expected(format: &AnyCodec, elements: &[f32], codes: &[u64]) -> Vec<u8> {
    let mut encoded = vec![0; codes.len() * format.bytes];
    format.encode_cpu(elements, &mut encoded).unwrap();
    let mut decoded = vec![0.0; elements.len()];
    format.decode_cpu(&sampling::stored(codes, format.bytes), &mut decoded).unwrap();
    let (codes, decoded) = (encoded.chunks(format.bytes), decoded.chunks(format.element.floats()));
    let each = codes.zip(decoded).flat_map(|(code, decoded)| {
        let mut words = code.to_vec();
        words.resize(8, 0);
        words.extend(decoded.iter().flat_map(|float| float.to_le_bytes()));
        words
    });
    each.collect()
}

#[test]
fn linked_glsl_computes_what_the_cpu_does() {
    agree(&GLSL);
}

#[test]
fn linked_hlsl_computes_what_the_cpu_does() {
    agree(&HLSL);
}

/// A shader that calls one stub.
const CALLER: &str = "
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Out { uint words_out[]; };
void main() { words_out[0] = unitvec_oct16_encode(vec3(words_out[0])); }
";

fn refused(spirv: &[u8]) -> Error {
    let error = link::link(spirv).unwrap_err();
    let text = error.to_string();
    assert!(!text.contains('\n') && text.len() < 400, "{text}");
    error
}

#[test]
fn what_cannot_be_linked_is_refused() {
    let stub = |from: &str, to: &str| {
        with_stubs(&GLSL, CALLER, |text| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        })
    };
    let whole = stub("unitvec", "unitvec");
    link::link(&whole).unwrap_or_else(|error| panic!("{error}"));
    let plain = compile(&GLSL, "#version 450\nvoid main() {}\n");
    assert!(matches!(refused(&plain), Error::NoStubs));
    let marker = stubs::marker(stubs::VERSION);
    assert!(matches!(refused(&stub(&marker, "another_name")), Error::NoVersion));
    let other = refused(&stub(&marker, "unitvec_stubs_9_8_7"));
    assert!(matches!(&other, Error::OtherVersion { found } if found == "9.8.7"), "{other}");
    let begins = |of_type: &str| format!("{of_type} unitvec_oct16_encode(const vec3 v) {{ return {of_type}(");
    let int = stub(&begins("uint"), &begins("int"));
    let wrong = refused(&int);
    assert!(
        matches!(&wrong, Error::WrongTypes { signature } if signature == "uint unitvec_oct16_encode(vec3 v)"),
        "{wrong}"
    );

    assert!(matches!(refused(b"#version 450"), Error::NotSpirv { .. }));
    assert!(matches!(refused(&whole[..whole.len() - 8]), Error::NotSpirv { .. }));
    let with_word = |at: usize, word: u32| {
        let mut bytes = whole.clone();
        bytes[4 * at..][..4].copy_from_slice(&word.to_le_bytes());
        bytes
    };
    assert!(matches!(refused(&with_word(1, 0x0001_0700)), Error::Version { major: 1, minor: 7 }));
    let words: Vec<&[u8]> = whole.chunks(4).collect();
    let model = words.iter().position(|word| *word == [14, 0, 3, 0]).unwrap();
    assert!(matches!(refused(&with_word(model + 2, 2)), Error::MemoryModel { addressing: 0, memory: 2 }));
    // The id 0, which nothing has: spirv-link's affair.
    assert!(matches!(refused(&with_word(words.len() - 2, 0)), Error::Refused { .. }));
}

/// A module may have two copies of the stubs, each with functions of its own.
#[test]
fn stubs_may_be_there_twice() {
    // GLSL lets no function be there twice: the name is changed in the module.
    let (name, other) = ("unitvec_oct16_encode(", "unitvec_oct16_second(");
    let second =
        format!("uint {other}const vec3 v) {{ return uint({}(v.x)); }}", stubs::marker(stubs::VERSION));
    let main = "words_out[0] = unitvec_oct16_encode(vec3(words_out[0]))";
    let both = format!("{main}; words_out[1] = {other}vec3(words_out[1]))");
    let mut module = with_stubs(&GLSL, &format!("{second}{}", CALLER.replace(main, &both)), |text| text);
    let at = module.windows(other.len()).position(|bytes| bytes == other.as_bytes()).unwrap();
    module[at..][..name.len()].copy_from_slice(name.as_bytes());
    let (_, names) = link::imports(&module).unwrap();
    assert_eq!(names, ["unitvec_oct16_encode"]);
    link::link(&module).unwrap_or_else(|error| panic!("{error}"));
}

/// The program links a file as the library does; where it cannot, it leaves the earlier file.
#[test]
fn the_program_links_files() {
    let folder = tempfile::tempdir().unwrap();
    let [module, linked] = ["shader.spv", "linked.spv"].map(|name| folder.path().join(name));
    let spirv = with_stubs(&GLSL, CALLER, |text| text);
    std::fs::write(&module, &spirv).unwrap();
    let link = || command([Path::new("link"), &module, Path::new("-o"), &linked]);
    let output = link().output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let bytes = std::fs::read(&linked).unwrap();
    assert_eq!(bytes, link::link(&spirv).unwrap());

    let said = refusal(&link().env("PATH", folder.path()).output().unwrap(), 1);
    assert!(said.contains("spirv-link cannot be started") && said.contains("Vulkan SDK"), "{said}");
    assert_eq!(std::fs::read(&linked).unwrap(), bytes);

    for language in Language::ALL {
        let output = command(["link", "--stubs", language.ending()]).output().unwrap();
        assert_eq!(String::from_utf8(output.stdout).unwrap(), stubs::text(language));
    }
}

/// A linked module has the functions that it calls, without linkage and without the others.
#[test]
fn what_is_not_used_is_removed() {
    let linked = link::link(&with_stubs(&GLSL, CALLER, |text| text)).unwrap();
    let library = std::fs::read(repository().join("spirv").join(link::LIBRARY)).unwrap();
    assert!(linked.len() * 20 < library.len(), "{} bytes of {}", linked.len(), library.len());
    let text = String::from_utf8_lossy(&linked);
    assert!(!text.contains("_decode") && !text.contains("oct32"));
}

/// Engines that link without the program get, as docs/linking.md says, stubs that become imports: by value.
#[test]
fn stubs_become_imports_by_the_script_of_the_docs() {
    let folder = tempfile::tempdir().unwrap();
    let docs = std::fs::read_to_string(repository().join("docs/linking.md")).unwrap();
    let script = docs.split("```awk\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let formats: Vec<&'static AnyCodec> = catalogue::frames().iter().collect();
    let module = with_stubs(&GLSL, &caller(&GLSL, &formats), |text| text);
    std::fs::write(folder.path().join("shader.spv"), module).unwrap();
    std::fs::write(folder.path().join("imports.awk"), script).unwrap();
    std::fs::copy(repository().join("spirv").join(link::LIBRARY), folder.path().join(link::LIBRARY)).unwrap();
    let commands = "set -e
        spirv-dis --raw-id shader.spv > shader.spvasm
        awk -f imports.awk shader.spvasm shader.spvasm | spirv-as --target-env spv1.3 - -o importing.spv
        spirv-link importing.spv unitvec.spv -o linked.spv
        spirv-opt -O linked.spv -o optimised.spv
        spirv-val --target-env vulkan1.1 optimised.spv
        spirv-dis optimised.spv";
    let run =
        |commands: &str| Command::new("sh").args(["-c", commands]).current_dir(&folder).output().unwrap();
    let older = run(&commands.replace("spv1.3", "spv1.0"));
    let words = "Conflicting SPIR-V versions";
    assert!(docs.contains(words) && stderr(&older).contains(words), "{}", stderr(&older));
    let output = run(commands);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("NoContraction") && !text.contains("Linkage"), "{text}");
}
