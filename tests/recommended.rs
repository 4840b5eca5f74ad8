//! The recommended codecs and their formats: each fits, devices have what is promised, and all speak from one table.

use crate::report;
use serde_json::Value;
use unitvec_catalogue::{
    AnyCodec, CODECS, FORMATS, Format, RECOMMENDED, Recommendation, Usage, find, vectors,
};
use unitvec_choose::degrees;
use unitvec_tests::program::{run, stdout};
use unitvec_tests::{lavapipe, repository};
use unitvec_vulkan::{FormatUse, ImageFormat};

/// The row of a format, and Vulkan's own value of this name.
fn format(name: &str) -> (Format, ImageFormat) {
    let row = FORMATS.into_iter().find(|row| row.vulkan == name);
    let value = (1..=184).map(ImageFormat::from_raw).find(|value| format!("{value:?}") == name);
    row.zip(value).unwrap_or_else(|| panic!("no format {name}"))
}

/// The bits of a format: the sum of its components'.
fn bits(name: &str) -> u32 {
    let components = name.split('_').next().unwrap().split(|c: char| c.is_ascii_alphabetic());
    components.filter_map(|bits| bits.parse::<u32>().ok()).sum()
}

/// A recommended format holds the code; one that is no unsigned integer is the codec's own; the other one is promised.
#[test]
fn every_choice_fits_its_format() {
    for (row, choice) in RECOMMENDED.iter().flat_map(|row| row.choices.iter().map(move |one| (row, one))) {
        let codec = find(choice.id).unwrap();
        for name in [choice.format, choice.anywhere] {
            assert!(bits(format(name).0.vulkan) >= codec.bits, "{} in {name}", codec.id);
            let own = codec.vk_format == Some(&format!("VK_FORMAT_{name}"));
            assert!(own || name.ends_with("_UINT"), "{} in {name}", codec.id);
        }
        assert!(format(choice.anywhere).0.promised.contains(&row.usage), "{choice:?}");
    }
    for name in CODECS.iter().filter_map(|codec| codec.vk_format) {
        format(name.trim_start_matches("VK_FORMAT_"));
    }
}

/// A conformant device has what Vulkan promises.
#[test]
fn lavapipe_has_what_vulkan_promises() {
    let device = lavapipe();
    for (row, usage) in FORMATS.iter().flat_map(|row| row.promised.iter().map(move |usage| (row, *usage))) {
        let usage = match usage {
            Usage::Attachment => FormatUse::Attachment,
            Usage::Texture => FormatUse::Texture,
            Usage::Vertex => FormatUse::Vertex,
        };
        assert!(device.supports(format(row.vulkan).1, usage), "{} {}", row.vulkan, usage.words());
    }
}

/// What is said of mirrors goes by the mean difference, of 255, that figure 8's mirror has.
#[test]
fn the_words_on_mirrors_are_figure_8s() {
    let text = std::fs::read_to_string(repository().join("docs/figures/figures.json")).unwrap();
    let figures: Value = serde_json::from_str(&text).unwrap();
    let pictures =
        figures["figures"].as_array().unwrap().iter().flat_map(|one| one["pictures"].as_array().unwrap());
    let mirror = pictures.into_iter().find(|one| one["file"] == "figure8_mirror.png").unwrap();
    let shown = mirror["differences"].as_array().unwrap();
    assert!(shown.len() > 10);
    for row in shown {
        let codec = vectors().iter().find(|codec| row["label"] == codec.survey_name).unwrap();
        let word = match row["mean"].as_f64().unwrap() {
            0.5.. => "bands",
            0.05..0.5 => "traces",
            _ => "nothing",
        };
        assert_eq!(codec.on_a_mirror(), Some(word), "{row}");
    }
}

/// README, the report and `choose` say the same of each recommended codec.
#[test]
fn all_speak_from_one_table() {
    let readme = std::fs::read_to_string(repository().join("README.md")).unwrap();
    let page = report::plain().replace("&#x27;", "'");
    let chosen = stdout(&run(["choose", "--bits", "64", "--json", "-"]));
    let chosen: Value = serde_json::from_str(&chosen).unwrap();
    let mut compared = 0;
    for choice in RECOMMENDED.iter().flat_map(Recommendation::short) {
        let codec = find(choice.id).unwrap();
        // Of frames README has the parts, the others the greater error.
        let Some(errors) = codec.measured("direction") else { continue };
        let [mean, max] = [errors.mean_deg, errors.max_deg].map(degrees);
        let row = readme.lines().find(|line| line.contains(&format!("| `{}` |", choice.id))).unwrap();
        let (_, cells) = page.split_once(&format!("<strong>{}</strong>", choice.id)).unwrap();
        let cells = cells.split_once("</tr>").unwrap().0;
        for said in [choice.why, choice.format, choice.anywhere, codec.on_a_mirror().unwrap(), &mean, &max] {
            assert!(row.contains(said) && cells.contains(said), "{said}: {row}\n{cells}");
        }
        let candidate = chosen["candidates"].as_array().unwrap().iter().find(|one| one["id"] == choice.id);
        if let Some(candidate) = candidate {
            let said = ["mean_deg", "max_deg"].map(|key| degrees(candidate[key].as_f64().unwrap()));
            assert_eq!(said, [mean, max], "{}", choice.id);
            compared += 1;
        }
    }
    assert!(compared > 8, "{compared}");
}

/// The reason for `hemioct`: less error than the precise `oct` of as many bits.
#[test]
fn hemioct_beats_precise_oct() {
    let errors = |id: &str| find(id).ok().and_then(|codec: &AnyCodec| codec.measured("direction")).unwrap();
    for bits in [16, 24] {
        let [ours, other] = [errors(&format!("hemioct{bits}")), errors(&format!("oct{bits}p"))];
        assert!(ours.mean_deg < other.mean_deg && ours.max_deg < other.max_deg, "{bits}");
    }
}
