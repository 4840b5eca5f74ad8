//! What RADV's compiler makes of the dithered functions for RDNA 2: `docs/data/dither_costs.json`, which docs/dither.md shows.
//!
//! The modules that ship have no kernels of dithered functions. These are of the GLSL, in `kernel.comp`, by glslang. They
//! have the form of the shipped kernels, whose costs are in `host/choose/data/`, so that both can be compared.

#[cfg(feature = "glsl")]
mod compiled;

use super::RENEW;
use std::collections::BTreeMap;
use std::path::PathBuf;
use unitvec_choose::costs::Report;
use unitvec_manifest::sha256_hex;
use unitvec_run::glsl;
use unitvec_tests::repository;

/// The codecs that stand for the others.
pub const CODECS: [&str; 8] =
    ["oct16", "oct16p", "oct24", "oct24p", "hemioct16", "soct17", "eaoct16", "eaoct16p"];

/// Where an offset comes from: nothing computes one that is `given`.
pub const GIVEN: &str = "given";

/// The functions that make offsets, by the names that the kernel has for them.
pub const KEYS: [&str; 4] = ["pixel", "key", "texel", "position"];

/// The codec that they are measured with.
pub const KEYED: &str = "oct16";

/// The identifier of a row: `oct16 dithered, pixel`.
pub fn row_id(codec: &str, key: &str) -> String {
    format!("{codec} dithered, {key}")
}

const KERNEL: &str = include_str!("kernel.comp");

fn path() -> PathBuf {
    repository().join("docs/data/dither_costs.json")
}

/// The committed figures.
pub fn committed() -> Report {
    let json = std::fs::read(path()).unwrap_or_default();
    Report::parse(&path(), &json).unwrap_or_else(|error| panic!("{error}; {RENEW}"))
}

/// The files that the kernels come from, with the first half of their SHA-256, as in the shipped figures.
fn sources() -> BTreeMap<String, String> {
    let hash = |text: &str| sha256_hex(text.as_bytes())[..32].to_owned();
    let of_library =
        ["arith", "oct", "hemioct", "soct", "eaoct", "dither"].map(|name| format!("unitvec/{name}.glsl"));
    let of_kernels = ["group", "words"].map(|name| format!("kernels/{name}.glsl"));
    let shipped = of_library.iter().chain(&of_kernels);
    let mut sources: BTreeMap<String, String> =
        shipped.map(|file| (format!("glsl/{file}"), hash(glsl::source(file).unwrap()))).collect();
    sources.insert("tests/isa/dithered/kernel.comp".to_owned(), hash(KERNEL));
    sources
}

/// The figures are of the functions that are committed with them.
#[test]
fn dithered_costs_are_of_these_functions() {
    let (committed, here) = (committed().sources, sources());
    let changed: Vec<&String> = here.keys().filter(|file| committed.get(*file) != here.get(*file)).collect();
    assert!(changed.is_empty(), "{} is of other files than these: {changed:?}; {RENEW}", path().display());
    assert_eq!(committed.len(), here.len(), "{}; {RENEW}", path().display());
}
