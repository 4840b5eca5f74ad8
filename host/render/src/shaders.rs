//! The renderer's shaders, inside the program: SPIR-V modules made of `shaders/rust`, and GLSL.

use include_dir::{Dir, include_dir};
use unitvec_run::glsl::{Compiler, Shader, Stage};

static SPIRV: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders/spirv");
static GLSL: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders/glsl");

/// A SPIR-V module. That of a codec, `oct16.spv`, has the entry points `oct16_vertex`, `oct16_gbuffer` and `oct16_light`;
/// `oct16_uint.spv` has those that store its codes as integers, `float.spv` those that store normals as they are, and
/// `fullscreen.spv` the vertex shader `fullscreen_vertex`. `oct16_dithered.spv`, of integers too, has no vertices of its own;
/// `oct_snorm.spv` and `oct_unorm.spv` have those of projections, which the hardware rounds.
pub fn module(name: &str) -> Option<&'static [u8]> {
    Some(SPIRV.get_file(name)?.contents())
}

/// A GLSL file: `vertex.vert`, `gbuffer.frag`, `light.frag`, `fullscreen.vert`, and their includes besides the codecs.
pub fn glsl(name: &str) -> Option<&'static str> {
    GLSL.get_file(name)?.contents_utf8()
}

/// The names of all modules.
pub fn modules() -> impl Iterator<Item = &'static str> {
    SPIRV.files().filter_map(|file| file.path().to_str()).filter(|name| name.ends_with(".spv"))
}

/// The codecs whose dithered functions have modules.
pub fn dithered() -> impl Iterator<Item = &'static str> {
    modules().filter_map(|name| name.strip_suffix("_dithered.spv"))
}

/// Compiles a shader of [`glsl`](fn@glsl), `vertex.vert`, for a variant of this name, optimised.
pub(crate) fn compile_glsl(
    compiler: &Compiler,
    file: &str,
    variant: &str,
    macros: &[(String, String)],
) -> Result<Vec<u8>, unitvec_run::glsl::Error> {
    let path = || format!("host/render/shaders/glsl/{file}");
    let text = glsl(file).ok_or_else(|| unitvec_run::glsl::Error::NoSource { file: path() })?;
    let stage = if file.ends_with(".vert") { Stage::Vertex } else { Stage::Fragment };
    let shader = Shader { stage, file, text, beside: &glsl };
    compiler.compile_shader(shader, macros).map_err(|error| unitvec_run::glsl::Error::Rejected {
        file: path(),
        kernel: variant.to_owned(),
        error,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rspirv::dr::load_bytes;
    use std::collections::BTreeSet;
    use unitvec_catalogue::directions;

    #[test]
    fn every_codec_has_a_module() {
        let names: BTreeSet<&str> = modules().collect();
        for name in directions().iter().map(|format| format.id).chain(["float", "fullscreen"]) {
            assert!(names.contains(format!("{name}.spv").as_str()), "{name}");
        }
    }

    /// Entry points are called after their module and pass.
    #[test]
    fn modules_have_their_passes() {
        for file in modules() {
            let name = file.trim_end_matches(".spv");
            let passes: &[&str] = match name {
                "fullscreen" => &["vertex"],
                dithered if dithered.ends_with("_dithered") => &["gbuffer", "light"],
                _ => &["vertex", "gbuffer", "light"],
            };
            let module = load_bytes(module(file).unwrap()).unwrap();
            let entry_points =
                module.entry_points.iter().map(|entry| entry.operands[2].unwrap_literal_string());
            let found: BTreeSet<&str> = entry_points.collect();
            let expected: Vec<String> = passes.iter().map(|pass| format!("{name}_{pass}")).collect();
            assert_eq!(found, expected.iter().map(String::as_str).collect(), "{name}");
        }
    }
}
