//! docs/engines.md: the files and functions that it names.

use std::collections::BTreeSet;
use unitvec_tests::repository;

fn text() -> String {
    std::fs::read_to_string(repository().join("docs/engines.md")).unwrap()
}

/// Files and folders of the repository that it names are there.
#[test]
fn files_exist() {
    let text = text();
    let words = text.split('`').flat_map(|part| part.split_whitespace());
    let starts = ["shaders/", "glsl/", "spirv/", "examples/"];
    let named: BTreeSet<&str> =
        words.filter(|word| starts.iter().any(|start| word.starts_with(start))).collect();
    assert!(named.len() > 10, "{named:?}");
    for name in named {
        assert!(repository().join(name).exists(), "{name}");
    }
    // Files that engines include, by their last names, in all folders of languages.
    for include in text.split("#include \"").skip(1).filter_map(|rest| rest.split('"').next()) {
        let name = include.rsplit('/').next().unwrap();
        let folders = ["shaders/hlsl", "shaders/godot", "shaders/msl", "shaders/cpp", "glsl/unitvec"];
        let is_there = folders.iter().any(|folder| repository().join(folder).join(name).exists());
        assert!(is_there || name == "unitvec.ush", "{include}");
    }
}

/// Functions that it calls or imports are those of the includes.
#[test]
fn functions_exist() {
    let glsl: String = unitvec_tests::glsl_families()
        .iter()
        .map(|family| std::fs::read_to_string(repository().join(format!("glsl/unitvec/{family}"))).unwrap())
        .collect();
    let is_ours = |word: &&str| {
        word.ends_with("_encode")
            || word.ends_with("_decode")
            || word.contains("float32x3")
            || (word.starts_with("unitvec_") && *word != "unitvec_shaders")
    };
    let text = text();
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    let named: BTreeSet<&str> = words.filter(is_ours).filter(|word| !word.starts_with('_')).collect();
    assert!(named.len() >= 3, "{named:?}");
    for name in named {
        assert!(glsl.contains(&format!(" {name}(")), "{name}");
    }
}
