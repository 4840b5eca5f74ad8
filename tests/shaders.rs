//! The codecs in other shading languages: HLSL by glslang, WGSL by naga, on lavapipe, and `unitvec shader`.

use crate::glsl::versions::assert_valid;
use unitvec_catalogue::{CODECS, Operation};
use unitvec_run::backend::{Backend, BackendKind, Gpu, KernelSource};
use unitvec_run::conform;
use unitvec_run::conform::{Backends, Options, Plan, widest_of_each_series};
use unitvec_run::glsl::Compiler;
use unitvec_run::shader::{Edition, Language, compile, kernel, library, text};
use unitvec_tests::program::{refusal, run, stderr, stdout};
use unitvec_tests::{assert_no_validation_messages, lavapipe};

/// 2^12 random directions, special and tied input, all codes of up to 16 bits and 2^12 of more, of a codec of each series: the
/// exact editions of GLSL, HLSL and WGSL, and HLSL's plain one, give the CPU's bits. `cargo xtask conform` takes every codec.
#[test]
fn exact_editions_and_hlsl_agree_to_the_bit() {
    let device = lavapipe();
    let options = Options { count: 1 << 12, seed: 15, normals: Vec::new(), all_codes_up_to: 16 };
    let formats = widest_of_each_series();
    // WGSL's compilers may round the plain edition as they like.
    for (kind, language, edition) in [
        (BackendKind::Glsl, Language::Glsl, Edition::Exact),
        (BackendKind::Hlsl, Language::Hlsl, Edition::Plain),
        (BackendKind::Hlsl, Language::Hlsl, Edition::Exact),
        (BackendKind::Wgsl, Language::Wgsl, Edition::Exact),
    ] {
        let plans: Vec<Plan<'_>> = formats.iter().map(|format| Plan::new(format, &options)).collect();
        let mut codecs = 0;
        let open = || {
            let source = match kind {
                BackendKind::Glsl => KernelSource::Glsl(Compiler::of(edition).unwrap()),
                _ => KernelSource::Language(language, edition),
            };
            let gpu: Box<dyn Backend> = Box::new(Gpu::new(&device, source, true).unwrap());
            Ok(Backends::from([(kind, gpu)]))
        };
        conform::run(plans, open, &mut |_| {}, &mut |row| {
            assert!(row.agrees(), "{row:#?}");
            codecs += 1;
            Ok::<(), unitvec_run::Error>(())
        })
        .unwrap();
        assert_eq!(codecs, formats.len());
    }
    assert_no_validation_messages(device);
}

/// Texts by `unitvec shader` for each codec alone compile, in both editions, with a kernel's entry point below them.
#[test]
fn the_text_of_each_codec_compiles() {
    for format in &CODECS {
        for (language, edition) in [
            (Language::Hlsl, Edition::Plain),
            (Language::Hlsl, Edition::Exact),
            (Language::Wgsl, Edition::Plain),
            (Language::Wgsl, Edition::Exact),
        ] {
            // Compilers check all functions of a text, whichever of them the entry point calls. Decoders' kernels
            // are compiled, and run, by the test above.
            let functions = Operation::ALL.map(|half| format.function(half));
            let functions = text(&functions, language, edition, "test").unwrap();
            let whole = functions + &kernel::kernel(language, format, Operation::Encode);
            let module = compile(language, format.id, &whole);
            assert!(module.is_ok(), "{} in {language}: {:?}", format.id, module.err());
        }
    }
}

/// Texts of single functions, of all there are and in reverse order, compile in one unit: what they share counts once. So do
/// those of the languages that glslang compiles as GLSL ES.
#[test]
fn texts_combine_in_languages_with_a_preprocessor() {
    let names: Vec<String> = library().unwrap().functions().map(str::to_owned).collect();
    for (language, options) in [
        (Language::Hlsl, &["-V", "-D", "-e", "main", "-S", "comp", "-o", "/dev/null"][..]),
        (Language::Glsl, &["-V", "-S", "comp", "-o", "/dev/null"]),
        (Language::GlslEs, &[]),
        (Language::Godot, &[]),
    ] {
        let edition = *language.editions().last().unwrap();
        let one = |name| text(std::slice::from_ref(name), language, edition, "test").unwrap();
        let mut whole = kernel::head(language).unwrap_or_default().to_owned();
        whole.extend(names.iter().rev().map(one));
        whole += &kernel::kernel(language, &CODECS[0], Operation::Encode);
        assert_valid(language.name(), &whole, options);
    }
}

/// The head of a text describes the codec, in the language's words.
#[test]
fn a_text_says_what_it_is() {
    let output = run(["shader", "--language", "msl", "--exact", "--codec", "oct48p", "--codec", "frame32"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    let head: Vec<&str> = text.lines().take_while(|line| line.starts_with("//")).collect();
    // Comments are wrapped anew in each language.
    let head = head.join("\n").replace("\n// ", " ");
    for part in [
        "functions in MSL, exact edition",
        "`unitvec shader --language msl --exact --codec oct48p --codec frame32`",
        "MIT or Apache-2.0",
        "oct48p   48 bits, error up to 0.0000",
        "frame32  32 bits, error up to 0.",
        "Layout: x in the low 24 or 26",
        "Layout: the normal's x in the low 11 (21) bits",
    ] {
        assert!(head.contains(part), "{part} is not in\n{head}");
    }
    assert!(text.contains("\n#include <metal_stdlib>\nusing namespace metal;\n"), "{text}");
    assert!(text.contains("\ninline uint2 oct48p_encode(float3 v) {"), "{text}");
    assert!(text.contains(
        "\ninline void frame32_decode(uint code, thread float3& normal, thread float4& tangent) {"
    ));
}

/// Functions by name stand beside a codec's, and bring nothing that they do not need.
#[test]
fn functions_are_written_by_name() {
    let options = "--codec snorm8x3 --function oct32_decode --function float32x3_to_oct";
    let text = stdout(&run(format!("shader --language wgsl {options}").split(' ')));
    let written = library().unwrap().functions().filter(|name| text.contains(&format!("\nfn {name}(")));
    let expected = ["float32x3_to_oct", "oct32_decode", "snorm8x3_encode", "snorm8x3_decode"];
    assert!(written.eq(expected) && text.contains(options), "{text}");
}

/// The text without a codec has all; a file gets the same text as the standard output.
#[test]
fn a_file_gets_the_text_of_all_codecs() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("unitvec.slang");
    let output = run(["shader", "--language", "slang", "-o", file.to_str().unwrap()]);
    assert!(output.status.success() && output.stdout.is_empty(), "{}", stderr(&output));
    let text = std::fs::read_to_string(&file).unwrap();
    assert_eq!(text, stdout(&run(["shader", "--language", "slang"])));
    let functions = CODECS.iter().flat_map(|format| Operation::ALL.map(|half| format.function(half)));
    for function in functions {
        assert!(text.contains(&format!(" {function}(")), "{function}");
    }
}

/// A folder gets the files of all families, in both editions: of GLSL, which has no other, the includes but for where lines break.
#[test]
fn a_folder_gets_the_files_of_all_families() {
    let folder = tempfile::tempdir().unwrap();
    for language in Language::ALL {
        let to = folder.path().join("shaders").join(language.id());
        let output = run(["shader", "--language", language.id(), "--all", "-o", to.to_str().unwrap()]);
        assert!(output.status.success(), "{}", stderr(&output));
        let files = library().unwrap().folder(language).unwrap();
        assert!(files.len() > 20 && stdout(&output).contains(&format!("{} files", files.len())));
        for (name, text) in files {
            assert_eq!(std::fs::read_to_string(to.join(&name)).unwrap(), text, "{name}");
            let committed = unitvec_shaders::shader(&format!("{}/{name}", language.id()));
            assert!(committed.is_none_or(|committed| committed == text), "{name}");
        }
    }
    let file = folder.path().join("file");
    std::fs::write(&file, "mine").unwrap();
    for (to, status, part) in [(file.to_str().unwrap(), 1, "a file stands"), ("-", 2, "name a folder")] {
        let said = refusal(&run(["shader", "--language", "wesl", "--all", "-o", to]), status);
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(run(["shader", "--language", "wesl", "--all"]).status.code(), Some(2));
}

/// All languages, codecs and functions are in the list.
#[test]
fn the_list_has_all_languages_codecs_and_functions() {
    let text = stdout(&run(["shader", "--list"]));
    let words: Vec<&str> = text.split([' ', ',', '\n']).collect();
    let listed = Language::ALL.map(Language::id).into_iter().chain(CODECS.iter().map(|format| format.id));
    for id in listed.chain(library().unwrap().functions()) {
        assert!(words.contains(&id), "{id}");
    }
}
