//! The unit-vector codecs of `unitvec` as shaders: GLSL to include, the same in other shading languages, and SPIR-V kernels to
//! load.
//!
//! The files are part of the program that depends on this crate. Their paths are those of the repository's folders
//! `glsl/`, `shaders/` and `spirv/`.
//!
//! ```
//! // For a build script: an include file, to be written where a shader compiler finds it.
//! let oct: &str = unitvec_shaders::glsl("unitvec/oct.glsl").ok_or("no such file")?;
//! assert!(oct.contains("uint oct16_encode("));
//!
//! // The same in another language. The files in `exact/` keep compilers from fusing and reordering operations.
//! let in_wgsl: &str = unitvec_shaders::shader("wgsl/exact/oct.wgsl").ok_or("no such file")?;
//! assert!(in_wgsl.contains("fn oct16_encode(v: vec3f) -> u32"));
//!
//! // For an engine: compute kernels, for vkCreateShaderModule; their entry points are `oct16_encode` and
//! // `oct16_decode`. `manifest.json` describes their interfaces. Vulkan 1.1 runs them without any feature.
//! let kernels: &[u8] = unitvec_shaders::spirv("kernels/oct16.spv").ok_or("no such file")?;
//! assert_eq!(kernels[..4], 0x0723_0203u32.to_le_bytes());
//! # Ok::<(), &str>(())
//! ```

use include_dir::{Dir, include_dir};

static GLSL: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/glsl");
static SHADERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders");
static SPIRV: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/spirv");

/// The text of a file of `glsl/`: `unitvec/oct.glsl`. The includes are in `unitvec/`, the same without any `#include` in
/// `flat/`, kernels over them in `kernels/`, what people write today in `textbook/`, only to measure against.
pub fn glsl(path: &str) -> Option<&'static str> {
    GLSL.get_file(path)?.contents_utf8()
}

/// The text of a file of `shaders/`: `hlsl/oct.hlsl`. The folders are named after the languages; those of languages without
/// `precise` have a folder `exact` with the exact edition. `stubs/` is for linking with `spirv("unitvec.spv")`. `stubs` has what
/// shaders include that are linked with `unitvec.spv`.
pub fn shader(path: &str) -> Option<&'static str> {
    // What lies beside the folders is this crate's own.
    path.contains('/').then(|| SHADERS.get_file(path)?.contents_utf8()).flatten()
}

/// A file of `spirv/`: `kernels/oct16.spv`; `unitvec.spv`, all codecs as functions to link with; `manifest.json` and its
/// schema, `manifest.schema.json`; `best_fit_table.bin`, which two kernels read. The kernels in `cost/` are for measuring.
pub fn spirv(path: &str) -> Option<&'static [u8]> {
    Some(SPIRV.get_file(path)?.contents())
}

/// The paths of all files that [`glsl`] gives.
pub fn glsl_paths() -> impl Iterator<Item = &'static str> {
    paths(&GLSL)
}

/// The paths of all files that [`shader`] gives.
pub fn shader_paths() -> impl Iterator<Item = &'static str> {
    SHADERS.dirs().flat_map(paths)
}

/// The paths of all files that [`spirv`] gives.
pub fn spirv_paths() -> impl Iterator<Item = &'static str> {
    paths(&SPIRV)
}

fn paths(folder: &'static Dir<'_>) -> Box<dyn Iterator<Item = &'static str>> {
    let files = folder.files().filter_map(|file| file.path().to_str());
    Box::new(files.chain(folder.dirs().flat_map(paths)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every path leads to its file, of text or of words.
    #[test]
    fn paths_lead_to_files() {
        for path in ["unitvec/oct.glsl", "flat/oct.glsl"] {
            assert!(glsl_paths().any(|other| other == path), "{path}");
        }
        for path in glsl_paths() {
            assert!(glsl(path).is_some_and(|text| !text.is_empty()), "{path}");
        }
        assert!(shader_paths().any(|path| path == "msl/oct.metal"));
        for path in shader_paths() {
            assert!(shader(path).is_some_and(|text| !text.is_empty()), "{path}");
        }
        assert!(spirv_paths().any(|path| path == "manifest.json"));
        for path in spirv_paths().filter(|path| path.ends_with(".spv")) {
            assert!(spirv(path).is_some_and(|words| words.len() > 20 && words.len() % 4 == 0), "{path}");
        }
        assert_eq!((glsl("unitvec"), shader("lib.rs"), spirv("oct16")), (None, None, None));
    }
}
