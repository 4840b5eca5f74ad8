//! Writes `shaders/` from `glsl/unitvec/`: what `cargo xtask shaders` runs. With `--check` it writes nothing, and fails
//! where a file is not the one it would write.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use unitvec_languages::{Edition, Language, Library};

fn main() -> Result<(), Box<dyn Error>> {
    let is_check = match std::env::args().nth(1).as_deref() {
        None => false,
        Some("--check") => true,
        Some(other) => return Err(format!("unknown argument `{other}`; there is --check").into()),
    };
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let texts = texts(&repository)?;
    let stale = stale(&repository, &texts)?;
    if is_check {
        return match stale.as_slice() {
            [] => {
                println!("shaders/: {} files are those of glsl/unitvec", texts.len());
                Ok(())
            }
            [first, ..] => Err(format!(
                "{} of the files in shaders/ are not those of glsl/unitvec, {} among them; `cargo xtask shaders` writes them",
                stale.len(),
                first.display()
            )
            .into()),
        };
    }
    for path in &stale {
        let file = repository.join(path);
        match texts.get(path) {
            Some(text) => {
                fs::create_dir_all(file.parent().unwrap_or(&file))?;
                fs::write(&file, text)?;
            }
            None => fs::remove_file(&file)?,
        }
    }
    println!("shaders/: {} files, of which {} are new or changed", texts.len(), stale.len());
    Ok(())
}

/// All files by their paths in the repository.
fn texts(repository: &Path) -> Result<BTreeMap<PathBuf, String>, Box<dyn Error>> {
    let mut sources = BTreeMap::new();
    for entry in fs::read_dir(repository.join("glsl/unitvec"))? {
        let entry = entry?;
        sources.insert(entry.file_name().to_string_lossy().into_owned(), fs::read_to_string(entry.path())?);
    }
    let library = Library::parse(|path| {
        path.strip_prefix("unitvec/").and_then(|name| sources.get(name)).map(String::as_str)
    })?;
    let mut texts = BTreeMap::new();
    for (language, edition) in generated() {
        for file in library.files() {
            if let Some(name) = library.file_name(file, language) {
                texts.insert(folder(language, edition).join(name), library.file(file, language, edition)?);
            }
        }
    }
    Ok(texts)
}

/// The languages besides GLSL, with their editions.
fn generated() -> impl Iterator<Item = (Language, Edition)> {
    let others = Language::ALL.into_iter().filter(|language| *language != Language::Glsl);
    others.flat_map(|language| language.editions().iter().map(move |edition| (language, *edition)))
}

fn folder(language: Language, edition: Edition) -> PathBuf {
    let folder = Path::new("shaders").join(language.id());
    if edition == Edition::Exact { folder.join("exact") } else { folder }
}

/// The paths of files that are missing, or differ, or have no source.
fn stale(repository: &Path, texts: &BTreeMap<PathBuf, String>) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let differs = |(path, text): (&PathBuf, &String)| {
        let current = fs::read_to_string(repository.join(path));
        (current.ok().as_ref() != Some(text)).then(|| path.clone())
    };
    let mut stale: Vec<PathBuf> = texts.iter().filter_map(differs).collect();
    for (language, edition) in generated() {
        let folder = folder(language, edition);
        let Ok(entries) = fs::read_dir(repository.join(&folder)) else { continue };
        for entry in entries {
            let entry = entry?;
            let path = folder.join(entry.file_name());
            if entry.file_type()?.is_file() && !texts.contains_key(&path) {
                stale.push(path);
            }
        }
    }
    Ok(stale)
}
