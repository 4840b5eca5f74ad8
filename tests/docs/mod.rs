//! README, docs and the module docs: the parts that the program writes in them, and those that it can check.
//!
//! `<!-- generated: NAME -->` begins a generated part, `<!-- end -->` ends it. `cargo xtask renew tables` writes them all again.

pub mod accuracy;
mod blocks;
#[cfg(feature = "glsl")]
mod commands;
pub mod costs;
mod devices;
mod dither;
mod drivers;
mod engines;
mod filtering;
pub mod formats;
mod imprecise;
mod interop;
mod languages;
mod orders;
mod papers;
mod pictures;
mod processors;
mod projected;
mod prose;
mod seen;
mod slices;
mod stubs;
mod tables;
pub mod textbook;
mod torus;
mod web;

use serde::Deserialize;
use std::path::{Path, PathBuf};
use unitvec_tests::{files, repository};

const BEGIN: &str = "<!-- generated: ";
const END: &str = "<!-- end -->";

/// Compares a committed file with what is expected, or writes it where `BLESS` is set.
pub fn compare(path: &Path, expected: &(impl AsRef<[u8]> + ?Sized)) {
    let (committed, expected) = (std::fs::read(path).unwrap_or_default(), expected.as_ref());
    if std::env::var_os("BLESS").is_some() && committed != expected {
        unitvec_files::write_file(path, expected).unwrap();
    } else {
        assert!(committed == expected, "{} is stale: `cargo xtask renew` writes it again", path.display());
    }
}

/// The rows of a file of `docs/data/`. Tabs part the cells of a `.tsv`, commas others.
fn recorded<T: for<'a> Deserialize<'a>>(file: &str) -> Vec<T> {
    let delimiter = if file.ends_with(".tsv") { b'\t' } else { b',' };
    let path = repository().join("docs/data").join(file);
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).from_path(path).unwrap();
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}

/// A table in Markdown, with these titles and rows; bars part their cells.
fn markdown_table(titles: &str, rows: impl IntoIterator<Item = String>) -> String {
    let head = format!("| {titles} |\n|{}\n", "---|".repeat(titles.split('|').count()));
    rows.into_iter().fold(head, |text, row| text + &format!("| {row} |\n"))
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
