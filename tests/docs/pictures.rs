//! The pictures in docs/figures/, and the docs' words about them.

use super::tables::degrees;
use super::{markdown, markdown_table};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use unitvec_render::figures::{Difference, Figures, Original};
use unitvec_tests::program::{command, stderr};
use unitvec_tests::repository;

fn folder() -> PathBuf {
    repository().join("docs/figures")
}

/// The figures that pages show, beside [`folder`]'s, for readers with dark pages.
const DARK: &str = "1,dither,rotations,caps,filtering";

fn list(folder: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder.join("figures.json")).unwrap()).unwrap()
}

fn figures() -> Value {
    list(&folder())
}

/// A number of the figure on dither.
fn number(figures: &Value, name: &str) -> f64 {
    let all = figures["figures"].as_array().unwrap();
    let figure = all.iter().find(|figure| figure["id"] == "dither").unwrap();
    let found = figure["numbers"].as_array().unwrap().iter().find(|number| number["name"] == name);
    found.unwrap_or_else(|| panic!("docs/figures/figures.json has no {name}"))["value"].as_f64().unwrap()
}

/// Effects of dither on a highlight, still and turning.
pub fn dither() -> String {
    let figures = figures();
    let rows = ["plain", "by pixel", "by blue noise", "by position"].map(|key| {
        let name = format!("highlight, oct16 {key}, autocorrelation of the difference in the part shown");
        let (shared, left) = (number(&figures, &name), crawl(&figures, key));
        let part = left / crawl(&figures, "plain");
        format!("{} | {shared:.2} | {} | {part:.2}", key.trim_start_matches("by "), degrees(left))
    });
    markdown_table(
        "offsets | from pixel to pixel | left after a blur, over 30 frames | as a part of plain",
        rows,
    )
}

/// The rest of a highlight after a blur, over 30 frames, of `oct16` with these offsets.
fn crawl(figures: &Value, key: &str) -> f64 {
    let of = "temporal variance of the highlight, means of 8 x 8 pixels";
    number(figures, &format!("turning panel, oct16 {key}, {of}"))
}

/// Dithered bands crawl less: the rest after a blur is under a fifth of the rest without dither.
#[test]
fn dither_keeps_bands_from_crawling() {
    let figures = figures();
    for key in ["by pixel", "by blue noise", "by position"] {
        let (dithered, plain) = (crawl(&figures, key), crawl(&figures, "plain"));
        assert!(dithered < 0.2 * plain, "{key}: {dithered} of {plain}");
    }
}

/// Each folder has the files that its own list names, besides the lists: one all that `unitvec figures --small` makes, and one
/// those that pages show, for dark ones. They are small enough for a repository.
#[test]
fn the_sets_are_whole_and_small() {
    check_set(
        &folder(),
        "1 2 3 4 5 6 7 8 meyer dither errors rotations caps dense filtering front",
        4_800_000,
    );
    check_set(&folder().join("dark"), &DARK.replace(',', " "), 1_800_000);
}

fn check_set(folder: &Path, expected: &str, most: u64) {
    let figures = list(folder);
    let all = figures["figures"].as_array().unwrap();
    let ids: Vec<&str> = all.iter().map(|figure| figure["id"].as_str().unwrap()).collect();
    assert_eq!(ids.join(" "), expected);
    let pictures = all.iter().flat_map(|figure| figure["pictures"].as_array().unwrap());
    let mut named: BTreeSet<String> =
        pictures.map(|picture| picture["file"].as_str().unwrap().to_owned()).collect();
    named.extend(["figures.json", "figures.md"].map(str::to_owned));
    let entries = std::fs::read_dir(folder).unwrap().map(Result::unwrap);
    let files: Vec<_> = entries.filter(|entry| entry.path().is_file()).collect();
    let there = files.iter().map(|file| file.file_name().into_string().unwrap()).collect();
    assert_eq!(named, there);
    let bytes: u64 = files.iter().map(|file| file.metadata().unwrap().len()).sum();
    assert!(bytes < most, "{bytes}");
}

/// The command that draws the pictures again.
const RENEW: &str = "unitvec figures --small --device lavapipe --out docs/figures";

/// The difference allowed between pictures drawn again and those committed.
#[derive(Clone, Copy)]
struct Tolerance {
    /// Mean difference of a picture, in steps of 1/255.
    picture: f64,
    /// Difference of a number: so much, and this share of it besides.
    number: [f64; 2],
    /// True if largest differences, which occur at a single pixel, are compared.
    largest: bool,
}

/// The tolerance for pictures drawn without a device.
const EXACT: Tolerance = Tolerance { picture: 0.0, number: [0.0, 0.0], largest: true };

/// The driver of the record, lavapipe, compiles for the processor. One without AVX is up to 0.008 steps off in the mean, and its
/// numbers up to 6e-5.
const SAME_DRIVER: Tolerance = Tolerance { picture: 0.02, number: [2e-4, 1e-3], largest: false };

/// Other drivers round otherwise, and an edge in a mirror may move by a pixel. SwiftShader's pictures are up to 0.23 steps off in
/// the mean, its numbers up to 3 %, and small ones up to 0.011.
const OTHER_DRIVER: Tolerance = Tolerance { picture: 0.5, number: [0.02, 0.05], largest: false };

/// The difference of a picture from the committed one, if any.
fn difference(file: &str, [committed, drawn]: [&Path; 2], tolerance: Tolerance) -> Option<String> {
    let paths = [committed, drawn].map(|folder| folder.join(file));
    let [before, after] = paths.each_ref().map(|path| std::fs::read(path).unwrap_or_default());
    if before == after {
        return None;
    }
    // Another version of the encoder may pack the same pixels into other bytes.
    let pictures = paths.map(|path| image::open(path).ok().map(image::DynamicImage::into_rgb8));
    let [Some(before), Some(after)] = pictures else { return Some(format!("{file}: another content")) };
    if before.dimensions() != after.dimensions() {
        return Some(format!(
            "{file}: {:?} pixels before, {:?} now",
            before.dimensions(),
            after.dimensions()
        ));
    }
    let Difference { mean, max, .. } = Original::new(&before).difference(&after);
    (mean > tolerance.picture)
        .then(|| format!("{file}: {mean:.4} steps of 1/255 off in the mean, {max} at most"))
}

/// The differences of two values of figures.json, a line for each; `at` is their place.
fn differences(at: &str, before: &Value, after: &Value, tolerance: Tolerance) -> Vec<String> {
    match (before, after) {
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).flat_map(|(a, b)| differences(at, a, b, tolerance)).collect()
        }
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            let name = ["id", "file", "label", "name"].iter().find_map(|key| b.get(*key)?.as_str());
            let at = name.map_or_else(|| at.to_owned(), |name| format!("{at}, {name}"));
            let compared = a.iter().filter(|(key, _)| tolerance.largest || *key != "max");
            compared
                .flat_map(|(key, a)| differences(&format!("{at}, {key}"), a, &b[key], tolerance))
                .collect()
        }
        (Value::Number(a), Value::Number(b)) => {
            let ([a, b], [least, share]) = ([a, b].map(|number| number.as_f64().unwrap()), tolerance.number);
            let is_close = (a - b).abs() <= least + share * a.abs().max(b.abs());
            if is_close { Vec::new() } else { vec![format!("{at}: {a} before, {b} now")] }
        }
        _ if before == after => Vec::new(),
        _ => vec![format!("{at}: {before} before, {after} now")],
    }
}

/// Draws these figures of the small set again, with these options, and compares with a folder.
fn are_current(folder: &Path, only: &str, options: &[&str]) {
    let place = tempfile::tempdir().unwrap();
    let mut run = command(["figures", "--small", "--only", only, "--out"]);
    let run = run.arg(place.path()).args(options).output().unwrap();
    assert!(run.status.success(), "{}", stderr(&run));
    let (before, after) = (list(folder), list(place.path()));
    let (of_record, here) = (&before["device"]["driver"], &after["device"]["driver"]);
    let tolerance = match here {
        Value::Null => EXACT,
        here if here == of_record => SAME_DRIVER,
        _ => OTHER_DRIVER,
    };
    let mut found = Vec::new();
    for figure in after["figures"].as_array().unwrap() {
        let mut all = before["figures"].as_array().unwrap().iter();
        let before = all.find(|before| before["id"] == figure["id"]).unwrap_or(&Value::Null);
        found.extend(differences("figures.json", before, figure, tolerance));
        let files =
            figure["pictures"].as_array().unwrap().iter().map(|shown| shown["file"].as_str().unwrap());
        found.extend(files.filter_map(|file| difference(file, [folder, place.path()], tolerance)));
    }
    assert!(found.is_empty(), "docs/figures is stale: `{RENEW}` draws it again\n{}", found.join("\n"));
}

/// The pictures that take no device are those that the program draws now.
#[test]
fn drawn_pictures_are_current() {
    are_current(&folder(), "2,3,4,5,errors,rotations,caps,dense,filtering,front", &[]);
    are_current(&folder().join("dark"), "rotations,caps,filtering", &["--dark"]);
}

/// Rendered figures that take a second each are those that the program draws now. For figure 8 and the one on dither, which
/// take ten, the record vouches: what draws them has not changed since.
#[test]
fn rendered_pictures_are_current() {
    are_current(&folder(), "1,6,7,meyer", &[]);
}

/// Small differences between drivers pass, and others do not; figures.json's words are always the same.
#[test]
fn drivers_may_differ_a_little() {
    let of = |mean: f64, max: u8| serde_json::json!({"differences": [{"label": "oct16", "mean": mean, "max": max}]});
    let lines = |a: &Value, b: &Value, tolerance| differences("figures.json", a, b, tolerance);
    let before = of(1.0, 170);
    assert!(lines(&before, &of(1.06, 200), OTHER_DRIVER).is_empty());
    assert_eq!(lines(&before, &of(1.06, 200), EXACT).len(), 2);
    assert_eq!(lines(&before, &of(1.06, 200), SAME_DRIVER).len(), 1);
    let found = lines(&before, &of(1.1, 170), OTHER_DRIVER);
    assert!(found.len() == 1 && found[0].ends_with("oct16, mean: 1 before, 1.1 now"), "{found:?}");
    assert_eq!(lines(&before, &Value::Null, OTHER_DRIVER).len(), 1);
}

/// The page agrees with the list.
#[test]
fn the_page_is_of_the_list() {
    let figures: Figures = serde_json::from_value(figures()).unwrap();
    let page = std::fs::read_to_string(folder().join("figures.md")).unwrap();
    assert!(page == figures.to_markdown(), "docs/figures/figures.md is stale: `{RENEW}` writes it again");
}

/// Pages show each picture for light and for dark pages.
#[test]
fn pages_have_dark_pictures() {
    let mut dark = BTreeSet::new();
    // The program writes the pages of figures, which show their own folder's.
    for page in markdown().iter().filter(|page| !page.ends_with("figures.md")) {
        let (text, page) = (std::fs::read_to_string(page).unwrap(), page.display());
        let is_light_alone = |link: &str| {
            link.split(')').next().is_some_and(|to| to.contains("figures/") && to.ends_with(".png"))
        };
        assert!(
            !text.split("](").skip(1).any(is_light_alone),
            "{page} shows a picture for light pages alone"
        );
        for part in text.split("<picture>").skip(1) {
            let within = |before: &str| part.split(before).nth(1).unwrap().split('"').next().unwrap();
            let (shown, file) = (within("srcset=\""), within("src=\"").split("figures/").nth(1).unwrap());
            assert!(shown.ends_with(&format!("figures/dark/{file}")), "{page}: {shown} beside {file}");
            dark.insert(file.to_owned());
        }
    }
    let all = list(&folder().join("dark"));
    for figure in all["figures"].as_array().unwrap() {
        let mut files =
            figure["pictures"].as_array().unwrap().iter().map(|shown| shown["file"].as_str().unwrap());
        assert!(files.any(|file| dark.contains(file)), "no page shows figure {}", figure["id"]);
    }
}
