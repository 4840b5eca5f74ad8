//! Writes the data of the page in `web/` into a folder: `codecs.json`, the facts of all codecs of vectors and frames, and for
//! each shading language a `.json` with the codecs' functions. `cargo xtask web` runs it.

use serde::Serialize;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};
use std::error::Error;
use std::path::PathBuf;
use unitvec_catalogue::{AnyCodec, Domain, Element, Operation, directions};
use unitvec_choose::Costs;
use unitvec_choose::costs::GENERATIONS;
use unitvec_run::shader::{Edition, Language, text};

/// Texts of many functions, which share most paragraphs.
#[derive(Default, Serialize)]
struct Texts {
    paragraphs: Vec<String>,
    /// The paragraphs of a codec, by `oct16`, and by `oct16 dithered`.
    codecs: BTreeMap<String, Vec<usize>>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args_os().nth(1).ok_or("usage: page FOLDER")?);
    let costs = GENERATIONS.iter().map(|one| Costs::shipped(one.name)).collect::<Result<Vec<_>, _>>()?;
    let codecs = directions();
    let facts = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "gpus": GENERATIONS.map(|one| format!("{} ({})", one.title, one.series)),
        "codecs": codecs.iter().map(|one| facts(one, &costs)).collect::<Vec<_>>(),
    });
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("codecs.json"), facts.to_string())?;
    // Modules for Bevy are WGSL with other heads.
    let is_shown = |language: &Language| !matches!(language, Language::NagaOil | Language::Wesl);
    for language in Language::ALL.into_iter().filter(is_shown) {
        let texts = texts(language, codecs)?;
        std::fs::write(folder.join(format!("{}.json", language.id())), serde_json::to_vec(&texts)?)?;
    }
    Ok(())
}

/// The facts of a codec: `errors` are mean, maximum and bound in degrees, of frames for normal and tangent; `costs` are encoding
/// and decoding in multiples of `oct32`'s, for each GPU.
fn facts(codec: &AnyCodec, costs: &[Costs]) -> Value {
    let parts = codec.element.directions().iter().zip(codec.max_errors_deg);
    let errors = parts.filter_map(|(of, bound)| {
        let measured = codec.measured(of)?;
        Some([measured.mean_deg, measured.max_deg, f64::from(*bound)])
    });
    let cost = |costs: &Costs| Operation::ALL.map(|operation| costs.of(codec.id, operation));
    json!({
        "id": codec.id,
        "rust_type": codec.rust_type,
        "family": codec.family,
        "frame": codec.element == Element::Frame,
        "hemisphere": codec.domain == Domain::Hemisphere,
        "bits": codec.bits,
        "bytes": codec.bytes,
        "format": codec.vk_format.map(|name| name.trim_start_matches("VK_FORMAT_")),
        "dither": codec.dither().is_ok(),
        "by_table": codec.encodes_by_table,
        "uses": codec.recommended_for().collect::<Vec<_>>(),
        "errors": errors.collect::<Vec<_>>(),
        "costs": costs.iter().map(cost).collect::<Vec<_>>(),
    })
}

fn texts(language: Language, codecs: &[AnyCodec]) -> Result<Texts, Box<dyn Error>> {
    let (mut texts, mut known) = (Texts::default(), HashMap::new());
    for codec in codecs {
        let id = codec.id;
        let [encode, decode] = ["encode", "decode"].map(|half| format!("{id}_{half}"));
        let noisy =
            [format!("{encode}_dithered"), format!("{decode}_dithered"), "dither_from_pixel".to_owned()];
        let option = format!("--function {}", noisy.join(","));
        let kinds = [
            (id.to_owned(), vec![encode, decode], format!("--codec {id}")),
            (format!("{id} dithered"), noisy.to_vec(), option),
        ];
        for (key, functions, option) in kinds.into_iter().take(1 + usize::from(codec.dither().is_ok())) {
            let command = format!("unitvec shader --language {} {option}", language.id());
            let text = text(&functions, language, Edition::Plain, &command)?;
            let mut place = |paragraph: &str| {
                *known.entry(paragraph.to_owned()).or_insert_with(|| {
                    texts.paragraphs.push(paragraph.to_owned());
                    texts.paragraphs.len() - 1
                })
            };
            let places = text.split("\n\n").map(&mut place).collect();
            texts.codecs.insert(key, places);
        }
    }
    Ok(texts)
}
