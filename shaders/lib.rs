//! The unit-vector codecs of `unitvec` as shaders: GLSL to include, its translations to other shading languages, and
//! SPIR-V kernels to load.
//!
//! The files are part of the program that depends on this crate. Their paths are those of the repository's folders
//! `glsl/`, `shaders/` and `spirv/`.
//!
//! ```
//! // For a build script: an include file, to be written where a shader compiler finds it.
//! let oct: &str = unitvec_shaders::glsl("unitvec/oct.glsl").ok_or("no such file")?;
//! assert!(oct.contains("uint oct16_encode("));
//!
//! // The same in another language. The files in `exact/` give the CPU's bits on all devices.
//! let in_wgsl: &str = unitvec_shaders::shader("wgsl/exact/oct.wgsl").ok_or("no such file")?;
//! assert!(in_wgsl.contains("fn oct16_encode(v: vec3f) -> u32"));
//!
//! // For an engine: compute kernels, for vkCreateShaderModule; their entry points are `oct16_encode` and
//! // `oct16_decode`. `manifest.json` describes their interfaces. Vulkan 1.1 runs them without any feature.
//! let kernels: &[u8] = unitvec_shaders::spirv("kernels/oct16.spv").ok_or("no such file")?;
//! assert_eq!(kernels[..4], 0x0723_0203u32.to_le_bytes());
//! # Ok::<(), &str>(())
//! ```
//!
//! With the feature `languages`, `folder` makes the files of languages that are not embedded: WGSL's modules in WESL and for
//! naga_oil.

use include_dir::{Dir, include_dir};

static GLSL: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/glsl");
static SHADERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders");
static SPIRV: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/spirv");

/// The text of a file of `glsl/`: `unitvec/oct.glsl`. The includes are in `unitvec/`, each alone with what it needs in
/// `flat/`, kernels over them in `kernels/`, the functions that people commonly write today in `textbook/`, only to measure
/// against.
pub fn glsl(path: &str) -> Option<&'static str> {
    GLSL.get_file(path)?.contents_utf8()
}

/// The text of a file of `shaders/`: `hlsl/oct.hlsl`. The folders are named after the languages; those of languages
/// without `precise` have a folder `exact` with the exact edition. `stubs/` has the declarations for shaders that are
/// linked with `spirv("unitvec.spv")`.
pub fn shader(path: &str) -> Option<&'static str> {
    // Files beside the folders are this crate's own.
    path.contains('/').then(|| SHADERS.get_file(path)?.contents_utf8()).flatten()
}

#[cfg(feature = "languages")]
pub use unitvec_languages::{Error, Language};

/// The files of a language, by their paths in its folder: `oct.wesl`, `exact/oct.wesl`. They are made from the GLSL, so that
/// there are those of languages without a folder in `shaders/`, too.
///
/// ```
/// use unitvec_shaders::Language;
///
/// // For a build script: modules of WESL, to be written to a folder of shaders.
/// let files = unitvec_shaders::folder(Language::Wesl)?;
/// assert!(files["exact/oct.wesl"].contains("fn oct16_encode(v: vec3f) -> u32"));
/// # Ok::<(), unitvec_shaders::Error>(())
/// ```
///
/// # Errors
/// [`Error`], which tests rule out.
#[cfg(feature = "languages")]
pub fn folder(language: Language) -> Result<std::collections::BTreeMap<String, String>, Error> {
    unitvec_languages::Library::parse(glsl)?.folder(language)
}

/// A file of `spirv/`: `kernels/oct16.spv`; `unitvec.spv`, all codecs as functions to link with; `manifest.json` and its
/// schema, `manifest.schema.json`; `best_fit_table.bin`, which two kernels read.
pub fn spirv(path: &str) -> Option<&'static [u8]> {
    Some(SPIRV.get_file(path)?.contents())
}

/// A tile of 64 x 64 texels of blue noise, two bytes each, row by row: a VK_FORMAT_R8G8_UNORM for the offsets of dithered codes.
/// In each channel every byte occurs equally often.
pub fn blue_noise() -> &'static [u8] {
    include_bytes!("blue_noise_64x64.rg8")
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

    /// The share of a channel's variance in frequencies of up to `most` periods a tile, by the definition of Fourier's transform,
    /// and the share of these frequencies in all.
    fn low_share(channel: &[f64], most: i32) -> (f64, f64) {
        let mean = channel.iter().sum::<f64>() / 4096.0;
        let variance = channel.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
        let (mut power, mut frequencies) = (0.0, 0.0);
        for (fx, fy) in (-most..=most).flat_map(|fx| (-most..=most).map(move |fy| (fx, fy))) {
            if (fx, fy) == (0, 0) || fx * fx + fy * fy > most * most {
                continue;
            }
            let (mut real, mut imaginary) = (0.0, 0.0);
            for (texel, x) in channel.iter().enumerate() {
                let turns = f64::from(fx * (texel % 64) as i32 + fy * (texel / 64) as i32) / 64.0;
                let (sine, cosine) = (turns * std::f64::consts::TAU).sin_cos();
                (real, imaginary) = (real + (x - mean) * cosine, imaginary + (x - mean) * sine);
            }
            (power, frequencies) =
                (power + (real * real + imaginary * imaginary) / 4096.0, frequencies + 1.0);
        }
        (power / variance, frequencies / 4095.0)
    }

    /// Uniform, so that no error is added, and blue: in low frequencies white noise has their share of all frequencies,
    /// this tile less than a hundredth of it.
    #[test]
    fn the_tile_is_uniform_blue_noise() {
        let channels = [0, 1].map(|c| blue_noise().iter().skip(c).step_by(2).copied().collect::<Vec<u8>>());
        for channel in &channels {
            for byte in 0..=255 {
                assert_eq!(channel.iter().filter(|other| **other == byte).count(), 16, "{byte}");
            }
            let values: Vec<f64> = channel.iter().map(|byte| f64::from(*byte)).collect();
            let (low, of_white) = low_share(&values, 8);
            assert!(low < 0.01 * of_white, "{low} of the variance, white noise {of_white}");
        }
        let products = channels[0]
            .iter()
            .zip(&channels[1])
            .map(|(r, g)| (f64::from(*r) - 127.5) * (f64::from(*g) - 127.5));
        let correlation = products.sum::<f64>() / 4096.0 / (256.0 * 256.0 / 12.0);
        assert!(correlation.abs() < 0.05, "the channels' correlation is {correlation}");
    }

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
