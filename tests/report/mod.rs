//! `unitvec report`: one whole file. `browser.py` beside this file opens it in a browser, for `cargo xtask examples`.

use base64::Engine;
use serde_json::Value;
use std::process::Output;
use std::sync::OnceLock;
use unitvec_catalogue::directions;
use unitvec_tests::program::{command, stderr};
use unitvec_tests::repository;

fn report(arguments: &[&str], place: &tempfile::TempDir) -> Output {
    command(["report", "--no-device", "--count", "100", "--out"])
        .arg(place.path().join("report.html"))
        .args(arguments)
        .output()
        .unwrap()
}

/// The page without anything given, made once for all tests: it measures the published tables.
pub fn plain() -> &'static str {
    static PAGE: OnceLock<String> = OnceLock::new();
    PAGE.get_or_init(|| page(&[]))
}

fn page(arguments: &[&str]) -> String {
    let place = tempfile::tempdir().unwrap();
    let output = report(arguments, &place);
    assert!(output.status.success(), "{}", stderr(&output));
    std::fs::read_to_string(place.path().join("report.html")).unwrap()
}

/// The page loads nothing, its data are whole, and every codec has a row and is in the data that the filter reads.
#[test]
fn the_page_is_whole() {
    let page = plain();
    let embedded: Vec<&str> = page.split("data:").skip(1).filter(|uri| uri.starts_with("image/")).collect();
    assert!(embedded.len() >= 6, "{}", embedded.len());
    for uri in embedded {
        let (kind, rest) = uri.split_once(";base64,").unwrap();
        let end = rest.find('"').unwrap();
        let bytes = base64::engine::general_purpose::STANDARD.decode(&rest[..end]).unwrap();
        let begins: &[u8] = if kind == "image/svg+xml" { b"<svg" } else { b"\x89PNG" };
        assert!(bytes.starts_with(begins), "{kind}");
    }
    for load in ["=\"http", "=\"//", "url(", "@import", "fetch(", "{{", "{%"] {
        assert!(!page.contains(load), "{load}");
    }
    for codec in directions() {
        assert_eq!(page.matches(&format!("<tr id=\"codec-{}\">", codec.id)).count(), 1, "{}", codec.id);
    }
    let (_, data) = page.split_once("id=\"codecs-data\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    // Means over z >= 0 are of their own.
    let whole = data.as_array().unwrap().iter().find(|codec| codec["id"] == "fib16").unwrap();
    assert_ne!(whole["mean"], whole["mean_above"]);
    let hemisphere = data.as_array().unwrap().iter().find(|codec| codec["id"] == "hemioct16").unwrap();
    assert_eq!(hemisphere["mean"], hemisphere["mean_above"]);
    let in_data = |id: &str| data.as_array().unwrap().iter().any(|codec| codec["id"] == id);
    assert!(
        data.as_array().unwrap().len() == directions().len()
            && directions().iter().all(|codec| in_data(codec.id))
    );
    // Tags that have to be closed.
    for tag in ["table", "tbody", "tr", "details", "section", "article", "select", "script", "ul", "dl"] {
        let opened = page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
}

/// The page without a device names the missing parts and the command to run; given files are shown.
#[test]
fn the_page_says_what_it_lacks() {
    let (viewer, no_slider) = ("<div class=\"viewer\"", "id=\"no-slider\"");
    let without = plain();
    assert!(without.contains(no_slider) && !without.contains(viewer));
    assert!(without.contains("<code>unitvec report</code>"));
    assert!(without.contains("No Vulkan device was used. Whether codes go through"));

    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("pipeline.json");
    let run = ["conform", "pipeline", "--codec", "oct16", "--codec", "snorm8x3", "--count", "16", "--json"];
    let output = command(run).arg(&file).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));

    // The small figures are sheets, whose parts the page slides between.
    let small = repository().join("docs/figures");
    let with = page(&["--figures", small.to_str().unwrap(), "--pipeline", file.to_str().unwrap()]);
    assert!(with.contains(viewer) && !with.contains(no_slider));
    let (_, pictures) = with.split_once("<script type=\"application/json\">").unwrap();
    let pictures: Value = serde_json::from_str(pictures.split_once("</script>").unwrap().0).unwrap();
    assert_eq!(pictures.as_object().unwrap().len(), 4 * 18);
    assert!(pictures.as_object().unwrap().iter().all(|(name, one)| {
        one["uri"].as_str().unwrap().starts_with("data:image/png;")
            && (name.ends_with("/float") || one["words"].as_str().unwrap().contains("SSIM"))
    }));

    let (_, section) = with.split_once("id=\"pipeline\">").unwrap();
    assert!(section.contains("agree with the CPU to the bit: 2 codecs"), "{section}");
    assert!(section.contains("<dt>R8G8_SNORM</dt><dd>rounded to nearest"), "{section}");
}

/// Wrong inputs end in one line, and no page is left.
#[test]
fn faults_leave_no_page() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("no.json");
    std::fs::write(&file, "{}").unwrap();
    let file = file.to_str().unwrap();
    for (arguments, word) in [
        (["--conform", file], "unitvec conform --json"),
        (["--pipeline", file], "unitvec conform pipeline --json"),
        (["--costs", file], "unitvec bench --json"),
        (["--figures", place.path().to_str().unwrap()], "figures.json"),
    ] {
        let output = report(&arguments, &place);
        let text = stderr(&output);
        assert!(!output.status.success() && text.lines().count() == 1 && text.contains(word), "{text}");
        assert_eq!(place.path().read_dir().unwrap().count(), 1);
    }
}
