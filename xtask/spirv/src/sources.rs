//! Hashes of the sources that modules are compiled from.

use anyhow::Result;
use std::fs;
use std::path::{Path, PathBuf};
use unitvec_manifest::sha256_hex;

/// Name of the file beside the renderer's modules that has the hash of their [sources](of_render).
pub const RENDER_SOURCES: &str = "sources.sha256";

/// Packages whose version decides the bytes of the modules.
const SHAPING_PACKAGES: [&str; 7] =
    ["glam", "libm", "rspirv", "spirv-builder", "spirv-std", "spirv-tools", "spirv-tools-sys"];

/// A hash of what the modules are made from: the crate's and this program's sources without comments, and the locked versions
/// of the packages that shape the output.
pub fn of_modules(repository: &Path) -> Result<String> {
    let mut text = Vec::new();
    add_crates(&mut text, repository, &["shader-crate", "xtask/spirv"])?;
    add_locked(&mut text, &repository.join("Cargo.lock"))?;
    Ok(sha256_hex(&text))
}

/// A hash of what the renderer's modules are made from: their crate's sources, and those that [`of_modules`] is of.
pub fn of_render(repository: &Path) -> Result<String> {
    let folder = "host/render/shaders/rust";
    let mut text = Vec::new();
    add(&mut text, "unitvec", &of_modules(repository)?);
    add_crates(&mut text, repository, &[folder])?;
    add_locked(&mut text, &repository.join(folder).join("Cargo.lock"))?;
    Ok(sha256_hex(&text))
}

/// Adds the manifests and sources of crates in these folders, without lines that are comments: they change no module.
fn add_crates(text: &mut Vec<u8>, repository: &Path, folders: &[&str]) -> Result<()> {
    let mut files = Vec::new();
    for folder in folders {
        files.push(repository.join(folder).join("Cargo.toml"));
        rust_files(&repository.join(folder).join("src"), &mut files)?;
    }
    let portable = |file: PathBuf| {
        let relative = file.strip_prefix(repository).unwrap_or(&file).components();
        (relative.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/"), file)
    };
    let mut named: Vec<(String, PathBuf)> = files.into_iter().map(portable).collect();
    named.sort();
    for (name, file) in named {
        let whole = fs::read_to_string(file)?;
        let code = whole.lines().filter(|line| !line.trim_start().starts_with("//"));
        add(text, &name, &code.collect::<Vec<_>>().join("\n"));
    }
    Ok(())
}

/// Adds the packages of a lock file that decide the bytes of modules.
fn add_locked(text: &mut Vec<u8>, lock: &Path) -> Result<()> {
    for package in fs::read_to_string(lock)?.split("[[package]]").map(str::trim) {
        let is_it = |name: &&str| package.starts_with(&format!("name = \"{name}\"\n"));
        if SHAPING_PACKAGES.iter().any(is_it) {
            add(text, "Cargo.lock", package);
        }
    }
    Ok(())
}

/// Adds a name and a content; the length keeps two of them apart.
fn add(text: &mut Vec<u8>, name: &str, content: &str) {
    for part in [name.as_bytes(), &[0], &(content.len() as u64).to_le_bytes(), content.as_bytes()] {
        text.extend(part);
    }
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            rust_files(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_manifest::{FILE_NAME, Manifest};

    /// The committed modules are those of the sources as they are. (`cargo xtask renew --check` finds stale ones without
    /// a compiler of C++.)
    #[test]
    fn modules_are_built_from_the_sources_as_they_are() {
        let repository = crate::repository().unwrap();
        let manifest = fs::read(repository.join("spirv").join(FILE_NAME)).unwrap();
        let manifest: Manifest = serde_json::from_slice(&manifest).unwrap();
        assert_eq!(manifest.sources_sha256, of_modules(&repository).unwrap(), "run `cargo xtask spirv`");
        let render = repository.join("host/render/shaders/spirv").join(RENDER_SOURCES);
        let render = fs::read_to_string(render).unwrap();
        assert_eq!(render.trim_end(), of_render(&repository).unwrap(), "run `cargo xtask spirv`");
    }
}
