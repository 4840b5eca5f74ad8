//! `shaders/stubs/`: the includes of shaders that are to be linked, made from the catalogue.

use super::compare;
use unitvec_link::stubs::{Language, text};
use unitvec_tests::{files, repository};

/// Every language has its file, as `unitvec link --stubs` prints it, and there is no other.
#[test]
fn stubs_are_current() {
    let folder = repository().join("shaders/stubs");
    std::fs::create_dir_all(&folder).unwrap();
    let mut expected = Language::ALL.map(|language| folder.join(format!("unitvec.{}", language.ending())));
    for (language, path) in Language::ALL.into_iter().zip(&expected) {
        compare(path, &text(language));
    }
    expected.sort();
    assert_eq!(files(&folder, &[""]), expected);
}
