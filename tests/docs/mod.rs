//! README, docs and the module docs: the parts that the program writes in them, and those that it can check.
//!
//! `<!-- generated: NAME -->` begins a generated part, `<!-- end -->` ends it. `cargo xtask renew tables` writes them all again.

pub mod accuracy;
mod browsers;
mod claims;
pub mod costs;
mod dither;
mod drivers;
mod engines;
mod imprecise;
mod languages;
mod pictures;
mod processors;
mod projected;
mod prose;
mod slices;
mod stubs;
mod tables;
pub mod textbook;

use std::path::{Path, PathBuf};
use unitvec_tests::repository;

const BEGIN: &str = "<!-- generated: ";
const END: &str = "<!-- end -->";

/// True where files are to be written and not compared.
fn is_blessing() -> bool {
    std::env::var_os("BLESS").is_some()
}

/// Compares a committed file with the expected text, or writes it.
fn compare(path: &Path, expected: &str) {
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    if is_blessing() && committed != expected {
        unitvec_files::write_file(path, expected.as_bytes()).unwrap();
    } else {
        assert!(committed == expected, "{} is stale: `cargo xtask renew` writes it again", path.display());
    }
}

/// The files of these extensions in a folder and below, except build outputs.
fn files(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            found.extend(files(&path, extensions));
        } else if extensions.iter().any(|extension| name.ends_with(extension)) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// All Markdown of the repository.
fn markdown() -> Vec<PathBuf> {
    files(&repository(), &[".md"])
}

/// `text` with its generated parts made anew. A part's lines begin as the line of its marker does: `//! `.
fn renewed(path: &Path, text: &str) -> String {
    let mut lines = text.lines();
    let mut renewed = String::new();
    while let Some(line) = lines.next() {
        renewed += line;
        renewed.push('\n');
        let Some((indent, name)) = line.split_once(BEGIN).filter(|(indent, _)| ["", "//! "].contains(indent))
        else {
            continue;
        };
        let name = name.strip_suffix(" -->").unwrap_or_else(|| panic!("{}: {line}", path.display()));
        // xtask writes the table of records, and holds it.
        if name == "records" {
            continue;
        }
        for made in
            tables::table(name).unwrap_or_else(|| panic!("{}: no table `{name}`", path.display())).lines()
        {
            renewed += format!("{indent}{made}").trim_end();
            renewed.push('\n');
        }
        let end = lines.find(|line| line.contains(END));
        renewed += end.unwrap_or_else(|| panic!("{}: `{name}` does not end", path.display()));
        renewed.push('\n');
    }
    renewed
}

/// Every generated part agrees with the catalogue and the measurements.
#[test]
fn generated_parts_are_current() {
    let sources = files(&repository().join("shader-crate/src"), &[".rs"]);
    for path in markdown().into_iter().chain(sources) {
        let text = std::fs::read_to_string(&path).unwrap();
        if text.contains(BEGIN) {
            compare(&path, &renewed(&path, &text));
        }
    }
}
