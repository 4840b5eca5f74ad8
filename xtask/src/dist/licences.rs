//! The licences of the libraries in the program, with their texts.

use super::{Platform, VERSION, cargo_home};
use crate::{at, cargo, output, repository};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Libraries by the MIT licence whose packages lack its text, and who owns them by the text in their repositories.
const MIT: [(&str, &str); 1] = [("include_dir", "Copyright (c) 2017 Michael Bryan")];

/// What names of files with a licence begin with.
const NAMES: [&str; 5] = ["licen", "copying", "copyright", "notice", "unlicense"];

/// Names, versions and licences of all libraries in the program for a platform, with their texts.
pub fn of(platform: &Platform, zig: &Path) -> Result<String, String> {
    // Macros run in the compiler, and are no part of the program.
    let mut tree = cargo(&["tree", "--locked", "--package=unitvec-host", "--edges=normal,no-proc-macro"]);
    tree.args(["--target", platform.target, "--prefix=none", "--format={p}|{l}"]);
    let mut libraries = Vec::new();
    for (library, licence) in libraries_of(&output(&mut tree)?)? {
        let texts = texts(&library, &licence, &sources(&library)?)?;
        libraries.push((format!("{library}: {licence}"), texts));
    }
    let (linker, files) = if platform.is_linux() {
        let files = ["LICENSE", "lib/libunwind/LICENSE.TXT"].map(|file| zig.join("ziglang").join(file));
        ("compiler-rt and libunwind of zig: MIT, Apache-2.0 WITH LLVM-exception", files.to_vec())
    } else {
        ("mingw-w64: as its text says", vec!["/usr/share/doc/mingw-w64-x86-64-dev/copyright".into()])
    };
    libraries.push((linker.to_owned(), read(&files)?));
    // The typeface of figures.
    libraries
        .push(("Inter: OFL-1.1".to_owned(), read(&[repository().join("host/render/data/LICENSE-INTER")])?));
    let title = format!("The program unitvec {VERSION} for {} contains these libraries.", platform.name);
    Ok(listing(&title, &libraries))
}

/// The licences of Rust's own library, which comes with the compiler.
pub fn of_rust() -> Result<PathBuf, String> {
    let root = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let file = Path::new(root.trim()).join("share/doc/rust/COPYRIGHT-library.html");
    let missing = || format!("no {}: a compiler that rustup installs has it", file.display());
    if file.is_file() { Ok(file) } else { Err(missing()) }
}

/// The libraries of others in what `cargo tree` prints, by name and version, with their licences.
fn libraries_of(tree: &str) -> Result<BTreeSet<(String, String)>, String> {
    let mut libraries = BTreeSet::new();
    for line in tree.lines() {
        let (library, licence) =
            line.split_once('|').ok_or_else(|| format!("cargo tree printed `{line}`"))?;
        // A package of this repository has its folder behind the version, and a repeated line a star behind the licence.
        if library.contains(" (") {
            continue;
        }
        let licence = licence.trim_end_matches("(*)").trim();
        if licence.is_empty() {
            return Err(format!("{library} names no licence: do without it, or ask its authors"));
        }
        libraries.insert((library.replacen(" v", " ", 1), licence.to_owned()));
    }
    Ok(libraries)
}

/// The folder with a library's sources, wherever cargo fetched it from.
fn sources(library: &str) -> Result<PathBuf, String> {
    let registries = cargo_home()?.join("registry/src");
    let folders = fs::read_dir(&registries).map_err(at(&registries))?;
    let mut folders = folders.flatten().map(|folder| folder.path().join(library.replace(' ', "-")));
    let found = folders.find(|folder| folder.is_dir());
    found.ok_or_else(|| {
        format!("no sources of {library} in {}: `cargo fetch` gets them", registries.display())
    })
}

/// The texts of a library's licences, by the names of their files.
fn texts(library: &str, licence: &str, folder: &Path) -> Result<Vec<String>, String> {
    let entries = fs::read_dir(folder).map_err(at(folder))?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|file| file.path()).collect();
    files.retain(|file| {
        let name = file.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        file.is_file() && NAMES.iter().any(|start| name.starts_with(start))
    });
    files.sort();
    if !files.is_empty() {
        return read(&files);
    }
    if let Some((_, owner)) = MIT.iter().find(|(name, _)| library.split(' ').next() == Some(name)) {
        let text = read(&[repository().join("LICENSE-MIT")])?.concat();
        let terms = text.find("Permission is").map_or("", |at| &text[at..]);
        return Ok(vec![format!("MIT License\n\n{owner}\n\n{terms}")]);
    }
    // The text of Apache 2.0 names no owner.
    if licence.split(" OR ").any(|one| one == "Apache-2.0") {
        return read(&[repository().join("LICENSE-APACHE")]);
    }
    let remedy = "look it up in its repository, and add it in xtask/src/dist/licences.rs";
    Err(format!("the package {library} ({licence}) has no text of a licence: {remedy}"))
}

fn read(files: &[PathBuf]) -> Result<Vec<String>, String> {
    files.iter().map(|file| fs::read_to_string(file).map_err(at(file))).collect()
}

/// Libraries with the numbers of their texts, then each text once.
fn listing(title: &str, libraries: &[(String, Vec<String>)]) -> String {
    let (mut texts, mut known) = (String::new(), Vec::new());
    let mut listing = format!("{title} Numbers in brackets are those of the texts below.\n\n");
    for (library, own) in libraries {
        let mut numbers = Vec::new();
        for text in own {
            // Texts whose lines end elsewhere are the same.
            let words: Vec<&str> = text.split_whitespace().collect();
            let at = known.iter().position(|other| *other == words).unwrap_or(known.len());
            numbers.push((at + 1).to_string());
            if at == known.len() {
                known.push(words);
                texts += &format!("\n{:=<80}\n[{}]\n\n{}\n", "", at + 1, text.replace('\r', "").trim_end());
            }
        }
        listing += &format!("{library} [{}]\n", numbers.join(", "));
    }
    listing + &texts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{folder, strings};

    #[test]
    fn libraries_of_others_are_listed_once() {
        let tree = "own v0.1.0 (/folder)|MIT\nb v1.0.0+a|MIT\na v1.0.0|MIT OR Zlib\nb v1.0.0+a|MIT (*)\n";
        let found: Vec<_> =
            libraries_of(tree).unwrap().into_iter().map(|(name, of)| name + ": " + &of).collect();
        assert_eq!(found, ["a 1.0.0: MIT OR Zlib", "b 1.0.0+a: MIT"]);
        assert!(libraries_of("c v1.0.0|").unwrap_err().contains("c v1.0.0 names no licence"));
    }

    #[test]
    fn a_library_without_a_text_is_refused() {
        let folder = folder("licences");
        assert!(texts("a 1.0.0", "MIT", &folder).unwrap_err().contains("a 1.0.0 (MIT)"));
        let text = texts("include_dir 1.0.0", "MIT", &folder).unwrap().concat();
        assert!(
            text.contains("Michael Bryan\n\nPermission") && text.matches("Copyright").count() == 1,
            "{text}"
        );
        assert!(texts("a 1.0.0", "MIT OR Apache-2.0", &folder).unwrap()[0].contains("Version 2.0"));
        fs::write(folder.join("LICENSE.md"), "free").unwrap();
        assert_eq!(texts("a 1.0.0", "MIT", &folder), Ok(strings(&["free"])));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn the_same_text_is_kept_once() {
        let libraries = [("a".to_owned(), strings(&["x y"])), ("b".to_owned(), strings(&["z", "x\r\n y"]))];
        let listed = listing("", &libraries);
        assert!(listed.contains("a [1]\nb [2, 1]\n") && listed.matches("x y").count() == 1, "{listed}");
    }
}
