//! The licences of the libraries in the program, with their texts.

use super::{Platform, VERSION, cargo_home};
use crate::{cargo, output, repository};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Texts of libraries whose packages have none, from their repositories.
const ELSEWHERE: [(&str, &str); 1] = [("include_dir", include_str!("include_dir.txt"))];

/// What names of files with a licence begin with.
const NAMES: [&str; 6] = ["licen", "copying", "copyright", "notice", "unlicense", "authors"];

/// A library, and its licence as it names it.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Library {
    name: String,
    version: String,
    licence: String,
}

/// The licences of all libraries in the program for a platform, with their texts.
pub fn of(platform: &Platform, zig: &Path) -> Result<String, String> {
    // Macros run in the compiler, and are no part of the program.
    let mut tree = cargo(&["tree", "--locked", "--package=unitvec-host", "--edges=normal,no-proc-macro"]);
    tree.args(["--target", platform.target, "--prefix=none", "--format={p}|{l}"]);
    let mut libraries = Vec::new();
    for library in libraries_of(&output(&mut tree)?)? {
        let texts = texts(&library, &sources(&library)?)?;
        libraries.push((format!("{} {}: {}", library.name, library.version, library.licence), texts));
    }
    libraries.push(of_linker(platform, zig)?);
    let title = format!("The program unitvec {VERSION} for {} contains these libraries.", platform.name);
    Ok(listing(&title, &libraries))
}

/// The licences of Rust's own library, which comes with the compiler.
pub fn of_rust() -> Result<PathBuf, String> {
    let root = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let file = Path::new(root.trim()).join("share/doc/rust/COPYRIGHT-library.html");
    let remedy = "install the compiler by rustup, whose component `rustc` has it";
    file.is_file().then_some(file.clone()).ok_or_else(|| format!("no {}: {remedy}", file.display()))
}

/// The libraries that the linker adds.
fn of_linker(platform: &Platform, zig: &Path) -> Result<(String, Vec<String>), String> {
    let read = |file: &Path| fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()));
    if !platform.is_linux() {
        let text = read(Path::new("/usr/share/doc/mingw-w64-x86-64-dev/copyright"))?;
        return Ok(("the runtime of mingw-w64: as its text says".to_owned(), vec![text]));
    }
    let packages = output(
        Command::new(zig.join("bin/python"))
            .args(["-c", "import os, ziglang; print(os.path.dirname(ziglang.__file__))"]),
    )?;
    let texts =
        ["LICENSE", "lib/libunwind/LICENSE.TXT"].map(|file| read(&Path::new(packages.trim()).join(file)));
    let title = "compiler-rt and libunwind of zig: MIT, Apache-2.0 WITH LLVM-exception";
    Ok((title.to_owned(), texts.into_iter().collect::<Result<_, _>>()?))
}

/// The libraries of others in what `cargo tree` prints, by name.
fn libraries_of(tree: &str) -> Result<BTreeSet<Library>, String> {
    let mut libraries = BTreeSet::new();
    for line in tree.lines() {
        // A package of this repository has its folder behind the version, and a repeated line a star behind the licence.
        let (package, licence) =
            line.split_once('|').ok_or_else(|| format!("cargo tree printed `{line}`"))?;
        let (name, version) =
            package.split_once(" v").ok_or_else(|| format!("cargo tree printed `{line}`"))?;
        let licence = licence.trim_end_matches("(*)").trim();
        if version.contains(" (") {
            continue;
        }
        if licence.is_empty() {
            return Err(format!("{name} {version} names no licence: leave it out, or ask its authors"));
        }
        let [name, version, licence] = [name, version, licence].map(str::to_owned);
        libraries.insert(Library { name, version, licence });
    }
    Ok(libraries)
}

/// The folder with a library's sources, wherever cargo fetched it from.
fn sources(library: &Library) -> Result<PathBuf, String> {
    let registries = cargo_home()?.join("registry/src");
    let name = format!("{}-{}", library.name, library.version);
    let folders = fs::read_dir(&registries).map_err(|error| format!("{}: {error}", registries.display()))?;
    let mut folders = folders.filter_map(|folder| Some(folder.ok()?.path().join(&name)));
    let found = folders.find(|folder| folder.is_dir());
    found.ok_or_else(|| format!("no sources of {name} in {}: `cargo fetch` gets them", registries.display()))
}

/// The texts of a library's licences, by the names of their files.
fn texts(library: &Library, folder: &Path) -> Result<Vec<String>, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let files = fs::read_dir(folder).map_err(failed)?.map(|file| file.map(|file| file.path()));
    let mut files = files.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    files.retain(|file| {
        let name = file.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        file.is_file() && NAMES.iter().any(|start| name.starts_with(start))
    });
    files.sort();
    if files.is_empty() {
        return lacking(library).map(|text| vec![text]);
    }
    files.iter().map(fs::read_to_string).collect::<Result<_, _>>().map_err(failed)
}

/// The text for a library whose package has none: the one known here, or that of Apache 2.0, which names no owner.
fn lacking(library: &Library) -> Result<String, String> {
    let Library { name, version, licence } = library;
    if let Some((_, text)) = ELSEWHERE.iter().find(|(known, _)| known == name) {
        return Ok((*text).to_owned());
    }
    if !licence.split(" OR ").any(|one| one == "Apache-2.0") {
        let remedy =
            "copy that of its repository into xtask/src/dist, with a row of ELSEWHERE in licences.rs";
        return Err(format!("{name} {version} ({licence}) has no text of a licence: {remedy}"));
    }
    fs::read_to_string(repository().join("LICENSE-APACHE"))
        .map_err(|error| format!("LICENSE-APACHE: {error}"))
}

/// Libraries with the numbers of their texts, then each text once.
fn listing(title: &str, libraries: &[(String, Vec<String>)]) -> String {
    let (mut texts, mut keys) = (String::new(), Vec::new());
    let mut listing = format!("{title} Numbers in brackets are those of the texts below.\n\n");
    for (library, own) in libraries {
        let mut numbers = Vec::new();
        for text in own {
            // Texts that differ in their lines' ends alone are one.
            let key: Vec<&str> = text.split_whitespace().collect();
            let known = keys.iter().position(|known| *known == key);
            let number = known.unwrap_or(keys.len()) + 1;
            if known.is_none() {
                keys.push(key);
                texts += &format!("\n{:=<80}\n[{number}]\n\n{}\n", "", text.replace('\r', "").trim_end());
            }
            numbers.push(number.to_string());
        }
        listing += &format!("{library} [{}]\n", numbers.join(", "));
    }
    listing + &texts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::folder;

    fn library(name: &str, licence: &str) -> Library {
        Library { name: name.to_owned(), version: "1.0.0+a".to_owned(), licence: licence.to_owned() }
    }

    #[test]
    fn libraries_of_others_are_listed_once() {
        let tree = "own v0.1.0 (/folder)|MIT\nb v1.0.0+a|MIT\na v1.0.0+a|MIT OR Zlib\nb v1.0.0+a|MIT (*)\n";
        let found: Vec<_> = libraries_of(tree).unwrap().into_iter().collect();
        assert_eq!(found, [library("a", "MIT OR Zlib"), library("b", "MIT")]);
        assert!(libraries_of("c v1.0.0|").unwrap_err().contains("c 1.0.0 names no licence"));
        assert!(libraries_of("error").is_err());
    }

    #[test]
    fn a_library_without_a_text_is_refused() {
        let folder = folder("licences");
        assert!(texts(&library("a", "MIT"), &folder).unwrap_err().contains("a 1.0.0+a (MIT)"));
        assert!(texts(&library("include_dir", "MIT"), &folder).unwrap()[0].contains("Michael Bryan"));
        assert!(texts(&library("a", "MIT OR Apache-2.0"), &folder).unwrap()[0].contains("Version 2.0"));
        fs::write(folder.join("LICENSE.md"), "free").unwrap();
        assert_eq!(texts(&library("a", "MIT"), &folder), Ok(vec!["free".to_owned()]));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn the_same_text_is_kept_once() {
        let texts = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        let listed =
            listing("", &[("a".to_owned(), texts(&["x y"])), ("b".to_owned(), texts(&["z", "x\r\n y"]))]);
        assert!(listed.contains("a [1]\nb [2, 1]\n") && listed.matches("x y").count() == 1, "{listed}");
    }
}
