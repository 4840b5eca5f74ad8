//! What the generator makes of the includes, and what it refuses.

use std::collections::BTreeSet;
use unitvec_languages::{Edition, Error, Language, Library};

fn glsl(path: &str) -> Option<&'static str> {
    unitvec_shaders::glsl(path)
}

fn library() -> Library {
    Library::parse(glsl).unwrap()
}

/// The text of an include.
fn source(file: &str) -> &'static str {
    glsl(&format!("unitvec/{file}")).unwrap()
}

/// The text of an include as far as it belongs to this edition: the functions of `unitvec_exact_` are not in plain ones, where no
/// macro chooses.
fn source_of(file: &str, language: Language, edition: Edition) -> String {
    let is_kept = |block: &&str| {
        let first = code(block).next().unwrap_or_default().to_ascii_lowercase();
        edition == Edition::Exact
            || [Language::Hlsl, Language::Cpp].contains(&language)
            || !first.contains("unitvec_exact_")
    };
    source(file).split("\n\n").filter(is_kept).collect::<Vec<_>>().join("\n\n")
}

/// The words in a text.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The lines of a text that are no comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim_start().starts_with("//"))
}

/// All languages and editions but GLSL.
fn generated() -> impl Iterator<Item = (Language, Edition)> {
    let others = Language::ALL.into_iter().filter(|language| *language != Language::Glsl);
    others.flat_map(|language| language.editions().iter().map(move |edition| (language, *edition)))
}

/// The committed files are those that the includes give: a change to an include without `cargo xtask shaders` fails.
#[test]
fn committed_files_are_current() {
    let library = library();
    let mut known = BTreeSet::new();
    for language in Language::ALL.into_iter().filter(|language| language.is_committed()) {
        for (name, text) in library.folder(language).unwrap() {
            let path = format!("{}/{name}", language.id());
            let is_current = unitvec_shaders::shader(&path) == Some(&text);
            assert!(is_current, "shaders/{path} is not what glsl/unitvec gives: run `cargo xtask shaders`");
            known.insert(path);
        }
    }
    for path in unitvec_shaders::shader_paths() {
        let is_known = known.contains(path) || path.starts_with("stubs/");
        assert!(is_known, "shaders/{path} comes from no file of glsl/unitvec: run `cargo xtask shaders`");
    }
}

/// Babylon.js and others search a whole text for directives, its comments too.
#[test]
fn no_comment_has_a_directive() {
    let shaders = unitvec_shaders::shader_paths().map(|path| (path, unitvec_shaders::shader(path)));
    for (path, text) in unitvec_shaders::glsl_paths().map(|path| (path, glsl(path))).chain(shaders) {
        for line in text.unwrap_or_default().lines() {
            let comment = line.split_once("//").map_or("", |(_, comment)| comment);
            let is_directive = |after: &str| after.starts_with(|c: char| c.is_ascii_lowercase());
            assert!(!comment.split('#').skip(1).any(is_directive), "{path}: {line}");
        }
    }
}

/// Every family has its file in `glsl/flat/`, as the includes give it, and there is no other.
#[test]
fn flat_files_are_current() {
    let flat = library().flat().unwrap();
    for (name, text) in &flat {
        let is_current = glsl(&format!("flat/{name}")) == Some(text);
        assert!(is_current, "glsl/flat/{name} is not what glsl/unitvec gives: run `cargo xtask shaders`");
    }
    let committed = unitvec_shaders::glsl_paths().filter_map(|path| path.strip_prefix("flat/"));
    assert_eq!(committed.collect::<BTreeSet<_>>(), flat.keys().map(String::as_str).collect());
}

/// A flat file has all that its family's file has, and of the others only what it uses; but for what half of the families use,
/// which all have.
#[test]
fn flat_files_have_what_their_families_need() {
    fn of_code(text: &str) -> Vec<&str> {
        code(text).filter(|line| !line.starts_with('#')).flat_map(words).collect()
    }
    let flat = library().flat().unwrap();
    let flat: Vec<(&String, Vec<&str>)> = flat.iter().map(|(file, text)| (file, of_code(text))).collect();
    let is_in_all = |name: &str| flat.iter().all(|(_, words)| words.contains(&name));
    for (file, words) in &flat {
        let own = of_code(source(file));
        assert_eq!(own.iter().find(|word| !words.contains(word)), None, "{file} lacks it");
        let is_used =
            |name: &str| own.contains(&name) || words.iter().filter(|word| **word == name).count() > 1;
        let names = words.iter().filter(|word| word.to_lowercase().starts_with("unitvec_"));
        assert_eq!(
            names.copied().find(|name| !is_used(name) && !is_in_all(name)),
            None,
            "{file} does not use it"
        );
    }
}

/// Printed as GLSL, each file is its source again, but for where lines break: the tree loses nothing.
#[test]
fn glsl_comes_back() {
    let without_blanks = |text: &str| text.split_whitespace().collect::<String>();
    let library = library();
    for file in library.files() {
        let printed = library.file(file, Language::Glsl, Edition::Plain).unwrap();
        assert!(without_blanks(&printed) == without_blanks(source(file)), "{file}");
    }
}

/// The lines of code and comment below a file's head, but for guards, includes and the like.
fn lines(text: &str) -> Vec<&str> {
    let mut is_import = false;
    let body = text.lines().skip_while(|line| line.starts_with("//")).filter(move |line| {
        let was_import = is_import;
        is_import = (is_import || line.trim_start_matches('#').starts_with("import ")) && !line.contains('}');
        !was_import && !line.starts_with("import ")
    });
    let frame = ["#", "precision ", "module ", "implementing ", "__include ", "using "];
    body.filter(|line| !line.is_empty() && !frame.iter().any(|start| line.starts_with(start))).collect()
}

/// Each file has as many lines as its source, to within a tenth, and none of code is longer than 120 columns. Barriers make lines
/// of the exact editions longer, so that more of them are broken: an eighth.
#[test]
fn files_are_as_long_as_their_sources() {
    let library = library();
    for (language, edition) in generated() {
        for file in library.files().filter(|file| *file != "unitvec.glsl") {
            let source = source_of(file, language, edition);
            let source = lines(&source);
            let text = library.file(file, language, edition).unwrap();
            let text = lines(&text);
            let ratio = text.len() as f64 / source.len() as f64;
            // Lines of C++ are broken where calls of the barrier make them long.
            let most = match (language, edition) {
                (Language::Cpp, _) => 1.2,
                (_, Edition::Exact) => 1.125,
                _ => 1.1,
            };
            assert!((0.9..=most).contains(&ratio), "{file} in {language}, {edition:?}: {ratio}");
            let is_long = |line: &&&str| line.len() > 120 && !line.trim_start().starts_with("//");
            assert_eq!(text.iter().find(is_long), None, "{file} in {language}");
        }
    }
}

/// The words of a comment that are the same in all languages.
fn common_words(comment: &str) -> Vec<&str> {
    let of_language = |word: &&str| {
        let is_type =
            ["vec", "float", "uint", "int", "u32"].iter().any(|stem| word.contains(stem)) && word.len() <= 6;
        is_type || Language::ALL.iter().any(|language| language.extension() == *word)
    };
    words(comment).filter(|word| !of_language(word)).collect()
}

/// The comments below a file's head, in their order.
fn comments(text: &str) -> Vec<Vec<&str>> {
    let body = text.lines().skip_while(|line| line.starts_with("//")).map(str::trim);
    body.filter(|line| line.starts_with("//")).map(common_words).collect()
}

/// Every comment of the source stands in every language, in the same order. Those that are left out or added are of
/// `precise`, of Metal's pragma and of the barriers.
#[test]
fn comments_stay_in_their_places() {
    let is_own = |words: &Vec<&str>| {
        let text = words.join(" ");
        ["precise keeps compilers", "No product and sum", "No result is larger"]
            .iter()
            .any(|start| text.starts_with(start))
    };
    let library = library();
    for (language, edition) in generated() {
        for file in library.files() {
            let text = library.file(file, language, edition).unwrap();
            let source = source_of(file, language, edition);
            let [source, text] = [&source, &text]
                .map(|text| comments(text).into_iter().filter(|words| !is_own(words)).collect::<Vec<_>>());
            assert_eq!(text, source, "{file} in {language}");
        }
    }
}

/// The names in the code of all files.
fn names(texts: impl Iterator<Item = String>) -> BTreeSet<String> {
    let in_code = |text: String| {
        let words =
            code(&text).flat_map(words).filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()));
        words.map(str::to_owned).collect::<Vec<_>>()
    };
    texts.flat_map(in_code).collect()
}

/// No name is in a translation that is not in the source, but for words of the language, the barrier, and parameters that
/// WGSL makes a function copy. So there are no temporaries.
#[test]
fn names_are_those_of_the_source() {
    let library = library();
    let source = names(library.files().map(|file| source(file).to_owned()));
    for (language, edition) in generated() {
        let files = library.files().filter(|file| library.file_name(file, language).is_some());
        let text = names(files.map(|file| library.file(file, language, edition).unwrap()));
        let own = match language {
            Language::Hlsl => {
                "static float2 float3 float4 uint2 uint3 uint4 int2 int3 asuint asfloat all any rsqrt"
            }
            Language::Wgsl | Language::NagaOil | Language::Wesl => {
                "fn let var f32 u32 i32 vec2f vec3f vec4f vec2u vec3u vec4u vec2i vec3i bitcast select array ptr function \
                 all import super define_import_path unitvec inverseSqrt"
            }
            Language::Slang => {
                "module unitvec implementing __include public static float2 float3 float4 uint2 uint3 uint4 int2 int3 asuint \
                 asfloat all rsqrt"
            }
            Language::Msl => {
                "metal_stdlib using namespace metal pragma clang fp contract off constant inline thread float2 float3 \
                 float4 uint2 uint3 uint4 int2 int3 as_type all rsqrt"
            }
            Language::Cpp => {
                "namespace unitvec define constexpr UNITVEC_FN unitvec_rounded vectors float2 float3 float4 uint2 uint3 uint4 int2 \
                 int3 int4"
            }
            _ => "",
        };
        let stems: Vec<&str> = library.files().map(|file| file.trim_end_matches(".glsl")).collect();
        let endings = ["HLSL", "METAL", "GDSHADERINC", "GLSL", "HPP"];
        let is_known = |word: &&String| {
            let is_guard = word.starts_with("UNITVEC_") && endings.iter().any(|end| word.ends_with(end));
            let copied = word.strip_suffix("_in").is_some_and(|name| source.contains(name));
            own.split_whitespace().any(|own| own == word.as_str())
                || source.contains(*word)
                || is_guard
                || *word == language.extension()
                || stems.contains(&word.as_str())
                || (edition == Edition::Exact && *word == "UNITVEC_HUGE")
                || (own.starts_with("fn let") && copied)
        };
        let unknown: Vec<&String> = text.iter().filter(|word| !is_known(word)).collect();
        assert!(unknown.is_empty(), "{language}: {unknown:?}");
    }
}

/// An excerpt has the functions asked for and what they need, in the library's order, and nothing else. Guards surround what
/// the same functions need.
#[test]
fn an_excerpt_has_what_it_needs() {
    let half = "// Half of it.\nfloat unitvec_half(float x) {\n    return 0.5 * x;\n}\n\n";
    let twice = "float twice(float x) {\n    return x + x;\n}\n\n";
    let quarter = "float quarter(float x) {\n    return unitvec_half(unitvec_half(x));\n}\n";
    let library_of_three = of(&format!("// A head.\n\n{half}{twice}{quarter}"));
    let printed = |language| library_of_three.excerpt(&["quarter"], language, Edition::Plain).unwrap();
    let guard = "#ifndef UNITVEC_ONCE_HALF\n#define UNITVEC_ONCE_HALF\n";
    assert_eq!(printed(Language::Hlsl), format!("{guard}{half}{quarter}#endif\n"));
    let wgsl = printed(Language::Wgsl);
    assert!(wgsl.starts_with("// Half of it.\nfn unitvec_half(x: f32) -> f32 {") && !wgsl.contains("twice"));
    let unknown = library().excerpt(&["oct17_encode"], Language::Hlsl, Edition::Plain);
    assert_eq!(unknown, Err(Error::NoFunction("oct17_encode".to_owned())));
}

/// What an excerpt declares is used in it, or was asked for: it follows the branch that its language and edition take.
#[test]
fn an_excerpt_has_nothing_else() {
    let library = library();
    for (language, edition) in generated() {
        for codec in ["snorm8x3", "crytek_bfn24", "oct32p"] {
            let asked = [format!("{codec}_encode"), format!("{codec}_decode")];
            let text = library.excerpt(&[&asked[0], &asked[1]], language, edition).unwrap();
            let words: Vec<&str> = code(&text).flat_map(words).collect();
            for name in words.iter().filter(|word| word.to_lowercase().starts_with("unitvec_")) {
                let count = words.iter().filter(|word| *word == name).count();
                let is_frame = ["UNITVEC_HUGE", "UNITVEC_BEST_FIT_TABLE", "UNITVEC_EXACT"].contains(name);
                assert!(count > 1 || is_frame, "{codec} in {language}, {edition:?}: {name} is not used");
            }
        }
    }
}

/// Sums and products that are rounded pass through the barrier; products that are exact, quotients and roots do not.
#[test]
fn the_exact_edition_has_barriers() {
    let text = "float f(float a, float b) {\n    UNITVEC_PRECISE float r = (a * b + 2.0 * a) / sqrt(b);\n    return r;\n}\n";
    let printed = |language| of(text).excerpt(&["f"], language, Edition::Exact).unwrap();
    let barriers = "min(min(a * b, UNITVEC_HUGE) + 2.0 * a, UNITVEC_HUGE) / sqrt(b);";
    assert!(printed(Language::Wgsl).contains(&format!("let r = {barriers}")));
    let in_metal = barriers.replace("2.0", "2.0f");
    assert!(printed(Language::Msl).contains(&format!("float r = {in_metal}")));
    let vectors = text.replace("float", "vec2");
    let printed = of(&vectors).excerpt(&["f"], Language::Slang, Edition::Exact).unwrap();
    assert!(printed.contains("min(min(a * b, (float2)(UNITVEC_HUGE))"), "{printed}");
}

/// A library of one file.
fn of(text: &str) -> Library {
    parse(text).unwrap()
}

fn parse(text: &str) -> Result<Library, Error> {
    Library::parse(|path| match path {
        "unitvec/unitvec.glsl" => Some("#include \"a.glsl\"\n"),
        "unitvec/a.glsl" => Some(text),
        _ => None,
    })
}

/// What the includes do not use is refused by file and line, and nothing panics.
#[test]
fn other_glsl_is_refused() {
    let in_function = |line: &str| format!("float f(float x) {{\n    {line}\n}}\n");
    let refused = [
        ("float x;\n", 1, "`(` should stand in place of `;`"),
        ("float f(float x) {\n", 1, "`}` should stand in place of the end of the file"),
        ("#define A 1\n", 1, "what is `#define A 1` for?"),
        ("float f() { return 1.0; }\nfloat f(float x) { return x; }\n", 2, "`f` is declared twice"),
        (&in_function("return y;"), 2, "`y` is not declared"),
        (&in_function("return sin(x);"), 2, "`sin` is not among the functions that the includes use"),
        (&in_function("float y = 1;"), 2, "this is of another type, and needs a conversion"),
        (&in_function("return x + 1;"), 2, "`+` needs operands of one type"),
        (&in_function("float y, z;"), 2, "each variable needs a declaration of its own"),
        (
            &in_function("vec2 v = vec2(1.0, 2u);"),
            2,
            "`vec2` takes 2 components of its own type, or one to convert",
        ),
        (&in_function("return - -x;"), 2, "an expression should stand in place of `-`"),
        (&in_function("return -1u;"), 2, "`-` does not take this type"),
        (&in_function("return 1u;"), 2, "this is of another type, and needs a conversion"),
        (&in_function("return 1.0f;"), 2, "`1.0f` is no number of the includes"),
        (&in_function("return 017.0;"), 2, "`017.0` is no number of the includes"),
        (&in_function("return abs(x, x);"), 2, "`abs` cannot be called so here"),
        (&in_function("int i = bitfieldExtract(1, 0, 1);"), 2, "`bitfieldExtract` cannot be called so here"),
        (&in_function("x += 1u;"), 2, "`+` needs operands of one type"),
        (&in_function("int i = 1; i <<= 1;"), 2, "both sides of an assignment have to be of one type"),
        (&in_function("vec2 v = vec2(x); v.xy = vec2(x);"), 2, "components are assigned to one by one"),
        (&in_function("#ifndef A\n#else\n#endif"), 2, "what is `#ifndef A` for?"),
        (
            "struct S { float a; };\nS f() { return S(1.0); }\n",
            2,
            "a struct is made only where a variable is declared",
        ),
        (
            "float f(\n    // why\n    float x) { return x; }\n",
            3,
            "a comment has to stand before a declaration or a statement",
        ),
        (&in_function("return x.y;"), 2, "there is no `y` in this"),
        (&in_function("return x; // why"), 2, "a comment has to stand on a line of its own, after //"),
        (
            &in_function("if (x > 0.0) { return x; } else { return -x; }"),
            2,
            "`else` is not among what the includes use",
        ),
        (&in_function("do { x = 1.0; } while (true);"), 2, "`do` is not declared"),
        (&in_function("1.0 = x;"), 2, "this cannot be assigned to"),
        (&in_function("f(x) = x;"), 2, "`f` is not among the functions that the includes use"),
    ];
    for (text, line, what) in refused {
        let expected = Error::Refused { file: "a.glsl".to_owned(), line, what: what.to_owned() };
        assert_eq!(parse(text).err(), Some(expected), "{text}");
    }
    let cut = glsl("unitvec/oct.glsl").unwrap();
    for end in (0..cut.len()).step_by(31).filter(|end| cut.is_char_boundary(*end)) {
        let _ = parse(&cut[..end]);
    }
}

/// A name that a language keeps for itself is found where that language is printed.
#[test]
fn reserved_names_are_found() {
    let library = of("float f(float point) { return point; }\n");
    let printed = |language| library.excerpt(&["f"], language, Edition::Plain);
    let error = printed(Language::Hlsl).unwrap_err();
    assert_eq!(
        error.to_string(),
        "glsl/unitvec/a.glsl: HLSL keeps the name `point` for itself; give it another"
    );
    assert!(printed(Language::Wgsl).is_ok());
}

/// Each file imports the names that it uses of other files, each once, and no other.
#[test]
fn modules_import_what_they_use() {
    let library = library();
    for language in [Language::NagaOil, Language::Wesl] {
        let text = library.file("oct.glsl", language, Edition::Exact).unwrap();
        let (before, after) = text.split_at(text.find("\n\n// Moves a point").unwrap());
        let imports = &before[before.find("import ").unwrap()..];
        let names = imports[imports.find('{').unwrap() + 1..].trim_end_matches([';', '}']);
        let names: Vec<&str> = names.split(',').map(str::trim).collect();
        assert!(
            names.contains(&"UNITVEC_HUGE") && names.contains(&"unitvec_normalize_octahedral"),
            "{imports}"
        );
        assert!(names.iter().all(|name| after.contains(name)), "{imports}");
    }
    let text = library.file("arith.glsl", Language::NagaOil, Edition::Plain).unwrap();
    assert!(text.contains("\n#define_import_path unitvec::arith\n") && !text.contains("\n#import"));
    let excerpt = library.excerpt(&["oct16_encode"], Language::NagaOil, Edition::Plain).unwrap();
    assert!(excerpt.starts_with("#define_import_path unitvec\n"));
}

/// Godot 4 prints numbers with 14 decimals for the driver's compiler (`String::num`): they are the same floats after that.
#[test]
fn numbers_survive_godot() {
    let library = library();
    for file in library.files() {
        let text = library.file(file, Language::Godot, Edition::Exact).unwrap();
        assert!(floats(source(file)).is_empty() || !floats(&text).is_empty(), "{file}");
        for number in floats(&text) {
            let value: f32 = number.parse().unwrap();
            assert_eq!(format!("{value:.14}").parse(), Ok(value), "{number} in {file}");
        }
    }
    let text = "float f(float x) {\n    return x * 1.1754943508222875e-38 - 3.1415927e-9;\n}\n";
    let printed = of(text).excerpt(&["f"], Language::Godot, Edition::Plain).unwrap();
    assert!(
        printed.contains("return x * (1.0 / 8.507059173023462e37) - 1.6866298 / 536870912.0;"),
        "{printed}"
    );
}

/// The numbers with a point in the code of a text.
fn floats(text: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
    let words =
        code(text).flat_map(|line| line.split(|c| !is_part(c))).map(|word| word.trim_start_matches('-'));
    words.filter(|word| word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('.')).collect()
}

/// Godot shifts signed numbers by signed ones, and unsigned ones by unsigned ones.
#[test]
fn godot_shifts_by_the_same_kind() {
    let text = "int f(int x, uint n) {\n    return (x << (n + 1u)) >> 2;\n}\n";
    let printed = of(text).excerpt(&["f"], Language::Godot, Edition::Plain).unwrap();
    assert!(printed.contains("return (x << int(n + 1u)) >> 2;"), "{printed}");
}

/// In fragment shaders of GLSL ES floats have no precision before one is given.
#[test]
fn floats_have_a_precision_in_glsl_es() {
    for edition in [Edition::Plain, Edition::Exact] {
        let file = library().file("arith.glsl", Language::GlslEs, edition).unwrap();
        let excerpt = library().excerpt(&["oct16_encode"], Language::GlslEs, edition).unwrap();
        for text in [file, excerpt] {
            let before = text.split("precision highp float;").next().unwrap();
            let is_bare =
                |line: &&str| line.contains("float ") && !line.contains("highp") && !line.starts_with("//");
            assert_eq!(before.lines().find(is_bare), None);
            assert!(before.len() < text.len());
        }
    }
}
