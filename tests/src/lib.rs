//! Helpers of the integration tests.

pub mod checks;
pub mod directions;
pub mod expected;
pub mod program;
pub mod remez;
pub mod suite;
pub mod tested;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, CODECS};
use unitvec_manifest::modules::Modules;
use unitvec_manifest::{self as manifest, sha256_hex};
use unitvec_vulkan::{Device, DeviceChoice, Instance};

/// The backends that the tested program has: those of GLSL and HLSL need their compiler.
pub const BACKENDS: &[&str] =
    if cfg!(feature = "glsl") { &["cpu", "rust", "glsl", "hlsl", "wgsl"] } else { &["cpu", "rust", "wgsl"] };

/// The repository's root.
pub fn repository() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// The files of these extensions in a folder and below, except build outputs.
///
/// # Panics
/// If the folder cannot be read.
pub fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && !["target", "node_modules"].contains(&name.as_str()) && !name.starts_with('.') {
            found.extend(files(&path, extensions));
        } else if extensions.iter().any(|extension| name.ends_with(extension)) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The names in a folder, hidden ones too, in order.
///
/// # Panics
/// If the folder cannot be read, or a name is no text.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = folder.read_dir().unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// The files of GLSL that a shader includes: those of the families, `oct.glsl`, and those that serve several of them.
pub fn glsl_families() -> BTreeSet<String> {
    CODECS
        .iter()
        .map(AnyCodec::glsl_file)
        .chain(
            [
                "cap.glsl",
                "dither.glsl",
                "formats.glsl",
                "or_null.glsl",
                "axial.glsl",
                "angle.glsl",
                "with_length.glsl",
            ]
            .map(str::to_owned),
        )
        .collect()
}

/// lavapipe, with validation.
///
/// # Panics
/// If there is none: `cargo xtask setup` installs it.
pub fn lavapipe() -> Arc<Device> {
    let instance = Instance::new(None, true).unwrap_or_else(|error| panic!("{error}"));
    Device::open(&Arc::new(instance), &DeviceChoice::Named("lavapipe".into()))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Fails the test if the validation layer has printed anything, even about objects that outlive the device.
///
/// # Panics
/// If it has, or if a user of the device is left.
pub fn assert_no_validation_messages(device: Arc<Device>) {
    assert_eq!(Arc::strong_count(&device), 1, "something still uses the device");
    let instance = device.instance().clone();
    drop(device);
    let messages = instance.validation_messages();
    assert!(messages.is_empty(), "validation messages:\n{}", messages.join("\n"));
}

/// Copies the committed SPIR-V modules to `folder`, all but those that measure.
///
/// # Panics
/// If a file cannot be copied.
pub fn copy_modules(folder: &Path) {
    std::fs::create_dir(folder.join("kernels")).unwrap();
    for part in ["", "kernels"] {
        for entry in std::fs::read_dir(repository().join("spirv").join(part)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                std::fs::copy(&path, folder.join(part).join(path.file_name().unwrap())).unwrap();
            }
        }
    }
}

/// Writes a module in the place of another, to a folder of [`copy_modules`], with its SHA-256 in the manifest.
///
/// # Panics
/// If there is no such module, or a file cannot be written.
pub fn replace_module(folder: &Path, file: &str, bytes: &[u8]) {
    let mut manifest = Modules::open_trusted(folder).unwrap().manifest().clone();
    let module = manifest.modules.iter_mut().find(|module| module.file == file).unwrap();
    module.sha256 = sha256_hex(bytes);
    std::fs::write(folder.join(file), bytes).unwrap();
    std::fs::write(folder.join(manifest::FILE_NAME), serde_json::to_vec(&manifest).unwrap()).unwrap();
}

/// The repository's README, whose Rust is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
