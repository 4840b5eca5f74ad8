//! Writes `shaders/` and `glsl/flat/` from `glsl/unitvec/`: what `cargo xtask shaders` runs. With `--check` it writes nothing,
//! and fails where a file is not the one it would write.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fs;
use std::path::Path;
use unitvec_languages::{Language, Library};

fn main() -> Result<(), Box<dyn Error>> {
    let is_check = match std::env::args().nth(1).as_deref() {
        None => false,
        Some("--check") => true,
        Some(other) => return Err(format!("unknown argument `{other}`; there is --check").into()),
    };
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let texts = texts(&repository)?;
    let stale = stale(&repository, &texts)?;
    if let (true, Some(first)) = (is_check, stale.first()) {
        let number = stale.len();
        return Err(format!(
            "{number} files are not what glsl/unitvec/ gives, {first} among them; `cargo xtask shaders` writes them"
        )
        .into());
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
    println!("shaders/, glsl/flat/: {} files, {} of them changed", texts.len(), stale.len());
    Ok(())
}

/// All expected files, by their paths in the repository.
fn texts(repository: &Path) -> Result<BTreeMap<String, String>, Box<dyn Error>> {
    let mut sources = BTreeMap::new();
    for entry in fs::read_dir(repository.join("glsl/unitvec"))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        sources.insert(format!("unitvec/{name}"), fs::read_to_string(entry.path())?);
    }
    let library = Library::parse(|path| sources.get(path).map(String::as_str))?;
    let mut texts = BTreeMap::new();
    let mut add = |folder: &str, files: BTreeMap<String, String>| {
        texts.extend(files.into_iter().map(|(name, text)| (format!("{folder}/{name}"), text)));
    };
    add("glsl/flat", library.flat()?);
    for language in Language::ALL.into_iter().filter(|language| language.is_committed()) {
        add(&format!("shaders/{}", language.id()), library.folder(language)?);
    }
    Ok(texts)
}

/// The paths of files that are missing, different or unexpected.
fn stale(repository: &Path, texts: &BTreeMap<String, String>) -> Result<BTreeSet<String>, Box<dyn Error>> {
    let differs = |(path, text): (&String, &String)| {
        let current = fs::read_to_string(repository.join(path));
        (current.ok().as_ref() != Some(text)).then(|| path.clone())
    };
    let mut stale: BTreeSet<String> = texts.iter().filter_map(differs).collect();
    let folders: BTreeSet<&str> = texts.keys().filter_map(|path| Some(path.rsplit_once('/')?.0)).collect();
    for folder in folders {
        let Ok(entries) = fs::read_dir(repository.join(folder)) else { continue };
        for entry in entries {
            let entry = entry?;
            let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
            if entry.file_type()?.is_file() && !texts.contains_key(&path) {
                stale.insert(path);
            }
        }
    }
    Ok(stale)
}
