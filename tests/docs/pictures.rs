//! The pictures in docs/figures/, and what the docs say of them.

use super::tables::degrees;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::PathBuf;
use unitvec_tests::repository;

fn folder() -> PathBuf {
    repository().join("docs/figures")
}

fn figures() -> Value {
    serde_json::from_str(&std::fs::read_to_string(folder().join("figures.json")).unwrap()).unwrap()
}

/// A number of the figure on dither.
fn number(figures: &Value, name: &str) -> f64 {
    let all = figures["figures"].as_array().unwrap();
    let figure = all.iter().find(|figure| figure["id"] == "dither").unwrap();
    let found = figure["numbers"].as_array().unwrap().iter().find(|number| number["name"] == name);
    found.unwrap_or_else(|| panic!("docs/figures/figures.json has no {name}"))["value"].as_f64().unwrap()
}

/// What dither does to a highlight, still and turning.
pub fn dither() -> String {
    let figures = figures();
    let mut text = String::from(
        "| offsets | from pixel to pixel | left after a blur, over 30 frames | as a part of plain |\n|---|---|---|---|\n",
    );
    let crawl = |label: &str| {
        number(
            &figures,
            &format!("turning panel, {label}, temporal variance of the highlight, means of 8 x 8 pixels"),
        )
    };
    for key in ["plain", "by pixel", "by blue noise", "by position"] {
        let label = format!("oct16 {key}");
        let shared = number(
            &figures,
            &format!("highlight, {label}, autocorrelation of the difference in the part shown"),
        );
        let left = crawl(&label);
        let part = left / crawl("oct16 plain");
        text +=
            &format!("| {} | {shared:.2} | {} | {part:.2} |\n", key.trim_start_matches("by "), degrees(left));
    }
    text
}

/// Dithered bands crawl less: what is left after a blur is under a fifth of what it is without.
#[test]
fn dither_keeps_bands_from_crawling() {
    let figures = figures();
    let crawl = |label: &str| {
        let name =
            format!("turning panel, {label}, temporal variance of the highlight, means of 8 x 8 pixels");
        number(&figures, &name)
    };
    for key in ["pixel", "blue noise", "position"] {
        let (dithered, plain) = (crawl(&format!("oct16 by {key}")), crawl("oct16 plain"));
        assert!(dithered < 0.2 * plain, "{key}: {dithered} of {plain}");
    }
}

/// The folder has the files that its own list names, besides the lists, and all that `unitvec figures --small` makes; they are
/// small enough for a repository.
#[test]
fn the_set_is_whole_and_small() {
    let figures = figures();
    let all = figures["figures"].as_array().unwrap();
    let ids: Vec<&str> = all.iter().map(|figure| figure["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["1", "2", "3", "4", "5", "6", "7", "8", "meyer", "dither", "errors", "front"]);
    let pictures = all.iter().flat_map(|figure| figure["pictures"].as_array().unwrap());
    let mut named: BTreeSet<String> =
        pictures.map(|picture| picture["file"].as_str().unwrap().to_owned()).collect();
    named.extend(["figures.json", "figures.md"].map(str::to_owned));
    let files: Vec<_> = std::fs::read_dir(folder()).unwrap().map(Result::unwrap).collect();
    let there = files.iter().map(|file| file.file_name().into_string().unwrap()).collect();
    assert_eq!(named, there);
    let bytes: u64 = files.iter().map(|file| file.metadata().unwrap().len()).sum();
    assert!(bytes < 3_000_000, "{bytes}");
}
