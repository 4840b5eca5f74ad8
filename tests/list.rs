//! Everything that the list cannot generate exists for each of its codecs.
//!
//! The catalogue, the kernels, the suite, the slices and the benchmarks are made from the list: they need no test here.

use crate::docs::costs::is_measured;
use std::collections::BTreeSet;
use std::sync::OnceLock;
use unitvec_catalogue::{CODECS, Operation, find, frames, rotations};
use unitvec_lab::accuracy::meyer::{METHODS, WIDTHS};
use unitvec_lab::accuracy::{Table, beyond};
use unitvec_manifest::modules::Modules;
use unitvec_oracle::Reference;
use unitvec_oracle::frame::Format;
use unitvec_oracle::quat::WIDTHS as WIDTHS_OF_ROTATIONS;
use unitvec_tests::repository;

/// A test of whether a codec has something, by its identifier.
type Has = Box<dyn Fn(&str) -> bool>;

/// Every codec has its two SPIR-V kernels, GLSL functions, an oracle of as many bits, a digest, a row of `unitvec accuracy`, and one of `docs/tables.md`. All that lacks is named. `modules` compiles the GLSL kernels.
#[test]
fn nothing_is_lacking() {
    let has: [(&str, Has); 5] = [
        ("SPIR-V kernels", has_kernels()),
        ("a digest in vectors/digests.csv", is_among(rows("vectors/digests.csv"))),
        ("a row of `unitvec accuracy`", is_among(measured())),
        ("a measured error in catalogue/data/accuracy.csv", is_among(rows("catalogue/data/accuracy.csv"))),
        ("a row of docs/tables.md", is_named_in("docs/tables.md")),
    ];
    let mut lacking = Vec::new();
    for format in &CODECS {
        lacking.extend(
            has.iter().filter(|(_, has)| !has(format.id)).map(|(what, _)| format!("{}: {what}", format.id)),
        );
        let missing = Operation::ALL.map(|half| format.function(half)).into_iter();
        lacking.extend(
            missing
                .filter(|function| !is_in_glsl(function))
                .map(|function| format!("{function} in glsl/unitvec")),
        );
        let of_vectors = Reference::find(format.id).map(|codec| codec.bits);
        let of_rotations = WIDTHS_OF_ROTATIONS.iter().find(|(bits, _)| format.id == format!("quat{bits}"));
        let others = || Format::find(format.id).map(Format::bits).or(of_rotations.map(|(bits, _)| *bits));
        let bits = of_vectors.or_else(others);
        if bits != Some(format.bits) {
            lacking.push(format!("{}: an oracle of {} bits", format.id, format.bits));
        }
    }
    assert!(lacking.is_empty(), "lacking:\n{}", lacking.join("\n"));
}

/// No two codecs share a name, whatever its case: each of a codec's three names finds it.
#[test]
fn names_are_unique() {
    for codec in &CODECS {
        for name in [codec.id, codec.survey_name, codec.rust_type] {
            assert_eq!(find(&name.to_uppercase()).unwrap(), codec, "{name}");
        }
    }
}

/// Released codecs stay: a codec with a digest is in the list.
#[test]
fn no_released_codec_is_gone() {
    let ids: BTreeSet<String> = CODECS.iter().map(|format| format.id.to_owned()).collect();
    let gone: Vec<String> = rows("vectors/digests.csv").difference(&ids).cloned().collect();
    assert!(gone.is_empty(), "{gone:?}");
}

/// Every codec's cost on lavapipe is measured: `unitvec bench` measures it.
#[test]
fn costs_are_complete() {
    let lacking: Vec<&str> = CODECS.iter().map(|format| format.id).filter(|id| !is_measured(id)).collect();
    assert!(lacking.is_empty(), "host/choose/data/costs_lavapipe.json lacks {lacking:?}");
}

/// Every file of tests belongs to the program of tests: cargo would not miss one that does not.
#[test]
fn all_files_of_tests_are_run() {
    let folder = repository().join("tests");
    let main = std::fs::read_to_string(folder.join("main.rs")).unwrap();
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let is_test =
            path.extension().is_some_and(|extension| extension == "rs") || path.join("mod.rs").exists();
        assert!(
            !is_test || name == "main" || main.contains(&format!("mod {name};\n")),
            "tests/main.rs lacks {name}"
        );
    }
}

fn has_kernels() -> Has {
    let modules = Modules::open(None).unwrap();
    Box::new(move |id| ["encode", "decode"].iter().all(|half| modules.load(&format!("{id}_{half}")).is_ok()))
}

/// The codecs that `unitvec accuracy` has rows for.
fn measured() -> BTreeSet<String> {
    let published = [Table::One, Table::Three].into_iter().flat_map(Table::published);
    let survey = published.filter_map(|row| row.codec());
    let meyer = METHODS.iter().flat_map(|method| WIDTHS.iter().filter_map(|&bits| method.codec(bits)));
    let vectors = survey.chain(meyer).chain(beyond::codecs()).map(|codec| codec.id);
    let others = frames().iter().chain(rotations()).map(|codec| codec.id);
    vectors.chain(others).map(str::to_owned).collect()
}

/// The codecs in a file with a row for each, that begins with the identifier.
fn rows(csv: &str) -> BTreeSet<String> {
    let text = std::fs::read_to_string(repository().join(csv)).unwrap();
    text.lines().skip(1).filter_map(|row| Some(row.split(',').next()?.to_owned())).collect()
}

fn is_among(ids: BTreeSet<String>) -> Has {
    Box::new(move |id| ids.contains(id))
}

/// A test of whether an identifier stands between backquotes in a file.
fn is_named_in(file: &str) -> Has {
    let text = std::fs::read_to_string(repository().join(file)).unwrap_or_default();
    Box::new(move |id| text.contains(&format!("`{id}`")))
}

/// True if a file of `glsl/unitvec/` names a function, which macros may define.
fn is_in_glsl(function: &str) -> bool {
    static TEXT: OnceLock<String> = OnceLock::new();
    let text = TEXT.get_or_init(|| {
        let files = std::fs::read_dir(repository().join("glsl/unitvec")).unwrap();
        files.map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap()).collect()
    });
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|word| word == function)
}
