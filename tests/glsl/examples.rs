//! The GLSL in README and docs compiles.

use super::versions::assert_valid;
use crate::docs::formats;
use unitvec_tests::{glsl_families, repository};

/// The blocks of GLSL in a Markdown file.
fn blocks(file: &str) -> Vec<String> {
    let text = std::fs::read_to_string(repository().join(file)).unwrap();
    let starts = text.split("```glsl\n").skip(1);
    starts.map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// Fails unless glslangValidator, called as README says, accepts a shader with the files that it includes, and with those of
/// `glsl/flat/` pasted in their place.
fn assert_compiles(what: &str, stage: &str, shader: &str) {
    let folder = format!("-I{}", repository().join("glsl").display());
    let pasted = glsl_families().into_iter().fold(shader.to_owned(), |text, file| {
        let flat = std::fs::read_to_string(repository().join("glsl/flat").join(&file)).unwrap();
        text.replace(&format!("#include \"unitvec/{file}\""), &flat)
    });
    for shader in [shader, &pasted] {
        assert_valid(what, shader, &["-V", &folder, "-S", stage, "-o", "/dev/null"]);
    }
}

#[test]
fn the_readmes_shader_compiles() {
    let [shader] = &blocks("README.md")[..] else { panic!("README has another number of shaders than one") };
    assert_compiles("README.md", "frag", shader);
}

/// Fragments of shaders, each with the files that itself includes: declarations go before `main`, statements into it.
#[test]
fn the_lines_for_formats_and_dither_compile() {
    for (file, count) in [("docs/formats.md", 8), ("docs/dither.md", 3), ("docs/codecs.md", 1)] {
        let blocks = blocks(file);
        assert_eq!(blocks.len(), count, "{file}");
        blocks.iter().for_each(|block| assert_lines_compile(file, block));
    }
}

/// The expressions of the table of formats, in one shader.
#[test]
fn the_expressions_for_formats_compile() {
    let lines = formats::uses().map(|(_, codec, format, [write, read])| {
        let value = match (format.ends_with("_SNORM"), codec.bits > 32) {
            (true, _) => format!("vec4 value = vec4({write}, 0.0, 0.0);"),
            (_, true) => format!("uvec4 value = uvec4({write}, 0u, 0u);"),
            _ => format!("uvec4 value = uvec4({write}, 0u, 0u, 0u);"),
        };
        format!("{{ {value} {read}; }}\n")
    });
    let files = formats::uses().map(|(_, codec, ..)| format!("#include \"unitvec/{}\"\n", codec.glsl_file()));
    let given = "vec3 normal = vec3(1.0);\nvec4 tangent = vec4(1.0);\n".to_owned();
    assert_lines_compile("the table of formats", &files.chain(lines).fold(given, |all, line| all + &line));
}

/// Direct3D's lines compile as HLSL.
#[test]
fn the_lines_for_direct3d_compile() {
    let folder = format!("-I{}", repository().join("shaders/hlsl").display());
    let text = std::fs::read_to_string(repository().join("docs/formats.md")).unwrap();
    let block = text.split("```hlsl\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_valid("docs/formats.md", block, &["-V", "-D", &folder, "-e", "stored", "-o", "/dev/null"]);
}

/// Fails unless glslangValidator accepts the lines of a shader.
fn assert_lines_compile(file: &str, block: &str) {
    let is_declaration = |line: &&str| line.starts_with("layout") || line.starts_with('#');
    let (declarations, statements): (Vec<&str>, Vec<&str>) = block.lines().partition(is_declaration);
    let sampler = if block.contains("usampler2D") { "usampler2D" } else { "sampler2D" };
    let (stage, given) = if block.contains("texelFetch") {
        let inputs = "layout(location = 0) in vec3 normal;\nlayout(location = 1) flat in ivec2 pixel;";
        ("frag", format!("{inputs}\nlayout(binding = 0) uniform {sampler} normals;"))
    } else {
        ("vert", String::new())
    };
    let shader = format!(
        "#version 450\n#extension GL_GOOGLE_include_directive : require\n{given}\n{}\nvoid main() {{\n{}\n}}\n",
        declarations.join("\n"),
        statements.join("\n")
    );
    assert_compiles(file, stage, &shader);
}
