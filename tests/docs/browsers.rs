//! The example for browsers, the tests of languages and xtask start Chromium alike.

use unitvec_tests::repository;

/// Quoted strings of one function or list of a file, from its beginning to its end.
fn quoted(file: &str, begin: &str, end: &str) -> Vec<String> {
    let text = std::fs::read_to_string(repository().join(file)).unwrap();
    let rest = text.split_once(begin).unwrap_or_else(|| panic!("{file}: {begin}")).1;
    let part = rest.split_once(end).unwrap_or_else(|| panic!("{file}: {end}")).0;
    part.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

const LANGUAGES: &str = "tests/languages/src/web/mod.rs";

/// The page of the example and the tests of languages run in the same Chromium. The example's console is read, too.
#[test]
fn chromium_has_the_same_flags() {
    let example = quoted("examples/web/check.py", "\nFLAGS = [", "]");
    let example: Vec<_> = example.iter().filter(|flag| *flag != "--enable-logging=stderr").collect();
    let languages = quoted(LANGUAGES, "\nfn chromium(", "\n}");
    let languages: Vec<_> =
        languages.iter().filter(|text| text.starts_with("--") && !text.contains('{')).collect();
    assert!(example.len() > 4);
    assert_eq!(example, languages);
}

/// The program and its libraries lie where Debian's packages have them.
#[test]
fn chromium_has_the_same_paths() {
    let [example, languages] = [
        quoted("xtask/src/examples.rs", "\nfn with_chromium", "\n}"),
        quoted(LANGUAGES, "\nfn chromium(", "\n}"),
    ];
    let paths: Vec<_> =
        languages.iter().filter(|text| text.starts_with("usr/") || text.as_str() == "pulseaudio").collect();
    assert_eq!(paths.len(), 3);
    for path in paths {
        assert!(example.contains(path), "xtask/src/examples.rs does not have {path}");
    }
}
