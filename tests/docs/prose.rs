//! Checks of the words around the tables.

use super::{BEGIN, END, markdown, tables};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use unitvec_catalogue::{CODECS, frames, vectors};
use unitvec_tests::{files, repository};
use unitvec_vulkan::{GROUP, WORKGROUP};

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The targets of Markdown's links and pictures.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

/// The anchor that GitHub gives a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.collect::<String>().trim().to_lowercase().replace(' ', "-")
}

fn anchors(path: &Path) -> BTreeSet<String> {
    let text = read(path);
    text.lines()
        .filter(|line| line.starts_with('#'))
        .map(|line| anchor(line.trim_start_matches('#')))
        .collect()
}

/// Every relative link leads to a file, and to a heading of it.
#[test]
fn links_resolve() {
    let mut checked = 0;
    for path in markdown() {
        let text = read(&path);
        for link in links(&text).filter(|link| !link.starts_with("http")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            assert!(target.exists(), "{}: {link}", path.display());
            assert!(heading.is_empty() || anchors(&target).contains(heading), "{}: {link}", path.display());
            checked += 1;
        }
    }
    assert!(checked > 20);
}

/// `text` without its generated parts and without code.
fn by_hand(text: &str) -> String {
    let (mut kept, mut generated, mut code) = (String::new(), false, false);
    for line in text.lines() {
        generated = (generated || line.contains(BEGIN)) && !line.contains(END);
        code ^= line.trim_start().starts_with("```");
        if !generated && !code {
            // Every other part stands between backquotes.
            line.split('`').step_by(2).for_each(|words| kept += words);
            kept.push('\n');
        }
    }
    kept
}

/// Numbers with decimals that we did not measure: versions, sections of papers, what the Vulkan specification allows.
const NOT_MEASURED: [&str; 21] = [
    "11.0", "0.19", "0.20", "1.1", "1.3", "1.85", "1.87", "2.0", "3.30", "3.00", "3.3", "3.0", "0.10.0",
    "4.2", "0.5", "2.25", "2.5", "4.5", "22.3", "25.0", "2.17",
];

/// Measurements stand in generated parts only, where they cannot grow old. The program writes the pages of figures whole.
#[test]
fn measurements_are_generated() {
    let is_by_hand = |path: &&PathBuf| !path.ends_with("CHANGELOG.md") && !path.ends_with("figures.md");
    for path in markdown().iter().filter(is_by_hand) {
        for word in by_hand(&read(path)).split(|c: char| !(c.is_ascii_alphanumeric() || c == '.')) {
            let word = word.trim_matches('.');
            let is_decimal = word.contains('.') && word.chars().all(|c| c.is_ascii_digit() || c == '.');
            assert!(!is_decimal || NOT_MEASURED.contains(&word), "{}: {word}", path.display());
        }
    }
}

/// The oldest Rust that README promises, for the crate and for the program, is that of their manifests.
#[test]
fn rust_versions_are_those_of_the_manifests() {
    let text = read(&repository().join("README.md"));
    for manifest in ["Cargo.toml", "host/program/Cargo.toml"] {
        let manifest = read(&repository().join(manifest));
        let version = manifest.lines().find_map(|line| line.strip_prefix("rust-version = \"")).unwrap();
        assert!(text.contains(&format!("needs Rust {}", version.trim_end_matches('"'))), "{version}");
    }
}

/// docs/kernels.md: how many vectors fit the least limits of Vulkan, and how they are shared out.
#[test]
fn limits_of_a_dispatch() {
    let text = read(&repository().join("docs/kernels.md")).split_whitespace().collect::<Vec<_>>().join(" ");
    let grouped = |number: usize| match number {
        ..1_000_000 => format!("{} {:03}", number / 1000, number % 1000),
        _ => format!("{} {:03} {:03}", number / 1_000_000, number / 1000 % 1000, number % 1000),
    };
    let taken = GROUP * WORKGROUP;
    for said in [
        format!("{WORKGROUP} invocations, which take {taken} vectors"),
        format!("{} vectors or {} frames", grouped((1 << 27) / 12), grouped((1 << 27) / 28)),
        format!("{}, which take {}", grouped(65_535), grouped(65_535 * taken)),
        format!("(count + {}) / {taken}", taken - 1),
    ] {
        assert!(text.contains(&said), "{said}");
    }
}

/// Numbers of bits in texts are the catalogue's: for vectors, or for frames too.
#[test]
fn widths_are_the_catalogues() {
    let bits: Vec<u32> = vectors().iter().map(|codec| codec.bits).collect();
    let least = bits.iter().min().unwrap();
    let most = [*bits.iter().max().unwrap(), frames().iter().map(|codec| codec.bits).max().unwrap()];
    let allowed = most.map(|most| format!("in {least} to {most} bits"));
    let mut found = 0;
    for path in files(&repository(), &[".md", "lib.rs", "Cargo.toml"]) {
        let text = read(&path).replace("\n//! ", " ").replace('\n', " ");
        let words: Vec<&str> = text.split([' ', ',', '.', ')']).collect();
        for said in words.windows(5).filter(|words| matches!(words, ["in", _, "to", _, "bits"])) {
            assert!(allowed.contains(&said.join(" ")), "{}: {said:?}", path.display());
            found += 1;
        }
    }
    assert!(found >= 4, "{found}");
}

/// The layout of each codec's code is documented.
#[test]
fn every_layout_is_told() {
    let text = read(&repository().join("docs/codecs.md"));
    let (_, layouts) = text.split_once("## Storage layout").unwrap();
    for id in CODECS.iter().map(|codec| codec.id) {
        let family = tables::family(id);
        let names = [id, &family, family.trim_end_matches(['p', 'd'])].map(|name| format!("`{name}`"));
        let plain = names.clone().map(|name| name.replace("_concentric", "").replace("_ellipse", ""));
        assert!(names.iter().chain(&plain).any(|name| layouts.contains(name)), "{id}");
    }
}

/// The tests that `cargo xtask` runs by name exist: of a name that none has, `cargo test` runs nothing and passes.
#[test]
fn xtask_runs_tests_that_exist() {
    let text = read(&repository().join("xtask/src/renew/records.rs"));
    let quoted = text.split('"').skip(1).step_by(2);
    let names: Vec<&str> = quoted.filter(|text| text.contains("::") && !text.ends_with("::")).collect();
    assert!(names.len() >= 3, "{names:?}");
    for name in names {
        let (module, function) = name.rsplit_once("::").unwrap();
        let path = repository().join("tests").join(module.replace("::", "/"));
        let file = if path.is_dir() { path.join("mod.rs") } else { path.with_extension("rs") };
        assert!(read(&file).contains(&format!("fn {function}()")), "{name}");
    }
}

/// One page says what may be filtered, and the others lead to it.
#[test]
fn filtering_is_told_once() {
    for path in markdown() {
        let (text, is_it) = (read(&path), path.ends_with("docs/filtering.md"));
        assert!(is_it || !text.contains("be filtered"), "{}", path.display());
        let pages = ["docs/costs.md", "docs/engines.md", "docs/formats.md", "docs/open-problems.md"];
        let must = pages.iter().any(|page| path.ends_with(page));
        assert!(!must || text.contains("(filtering.md)"), "{}", path.display());
    }
}
