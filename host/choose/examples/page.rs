//! Writes the data of the page in `web/` into a folder: `codecs.json`, the facts of all codecs of vectors and frames, and for
//! each shading language a `.json` with the codecs' functions. `cargo xtask web` runs it.

use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use std::error::Error;
use std::path::PathBuf;
use unitvec_catalogue::{AnyCodec, Domain, Element, Measured, Operation, directions};
use unitvec_choose::Costs;
use unitvec_choose::costs::GENERATIONS;
use unitvec_run::shader::{Edition, Language, library, text};

/// The languages that the page shows or runs. Modules for Bevy are WGSL with other heads.
const LANGUAGES: [Language; 8] = [
    Language::Glsl,
    Language::GlslEs,
    Language::Hlsl,
    Language::Wgsl,
    Language::Slang,
    Language::Msl,
    Language::Godot,
    Language::Cpp,
];

#[derive(Serialize)]
struct Facts {
    version: &'static str,
    /// Titles of the generations of GPUs whose costs the codecs have.
    gpus: Vec<String>,
    codecs: Vec<Codec>,
}

#[derive(Serialize)]
struct Codec {
    id: &'static str,
    rust_type: &'static str,
    family: &'static str,
    frame: bool,
    hemisphere: bool,
    bits: u32,
    bytes: usize,
    format: Option<&'static str>,
    dither: bool,
    by_table: bool,
    uses: Vec<&'static str>,
    /// Mean, maximum and bound in degrees, of frames for normal and tangent.
    errors: Vec<[f64; 3]>,
    /// Encoding and decoding in multiples of `oct32`'s, for each of the GPUs.
    costs: Vec<[Option<f64>; 2]>,
}

/// Texts of many functions, which share most paragraphs.
#[derive(Default, Serialize)]
struct Texts {
    name: &'static str,
    paragraphs: Vec<String>,
    /// The paragraphs of a codec, by `oct16`, and by `oct16 dithered`.
    codecs: BTreeMap<String, Vec<usize>>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args_os().nth(1).ok_or("usage: page FOLDER")?);
    let costs = GENERATIONS.iter().map(|one| Costs::shipped(one.name)).collect::<Result<Vec<_>, _>>()?;
    let dithered: Vec<&str> =
        library()?.functions().filter_map(|name| name.strip_suffix("_encode_dithered")).collect();
    let codecs = directions();
    let of_codec = |codec: &AnyCodec| facts(codec, &costs, dithered.contains(&codec.id));
    let facts = Facts {
        version: env!("CARGO_PKG_VERSION"),
        gpus: GENERATIONS.iter().map(|one| format!("{} ({})", one.title, one.series)).collect(),
        codecs: codecs.iter().map(of_codec).collect(),
    };
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("codecs.json"), serde_json::to_vec(&facts)?)?;
    for language in LANGUAGES {
        let texts = texts(language, &codecs, &dithered)?;
        std::fs::write(folder.join(format!("{}.json", language.id())), serde_json::to_vec(&texts)?)?;
    }
    Ok(())
}

fn facts(codec: &AnyCodec, costs: &[Costs], dither: bool) -> Codec {
    let parts = codec.element.directions().iter().zip(codec.max_errors_deg);
    let errors = parts.filter_map(|(of, bound)| {
        let Measured { mean_deg, max_deg } = codec.measured(of)?;
        Some([mean_deg, max_deg, f64::from(*bound)])
    });
    let cost = |costs: &Costs| Operation::ALL.map(|operation| costs.of(codec.id, operation));
    Codec {
        id: codec.id,
        rust_type: codec.rust_type,
        family: codec.family,
        frame: codec.element == Element::Frame,
        hemisphere: codec.domain == Domain::Hemisphere,
        bits: codec.bits,
        bytes: codec.bytes,
        format: codec.vk_format.map(|name| name.trim_start_matches("VK_FORMAT_")),
        dither,
        by_table: codec.encodes_by_table,
        uses: codec.recommended_for().collect(),
        errors: errors.collect(),
        costs: costs.iter().map(cost).collect(),
    }
}

fn texts(language: Language, codecs: &[AnyCodec], dithered: &[&str]) -> Result<Texts, Box<dyn Error>> {
    let mut texts = Texts { name: language.name(), ..Texts::default() };
    let mut known = HashMap::new();
    for codec in codecs {
        let (id, tongue) = (codec.id, language.id());
        let plain = Operation::ALL.map(|operation| codec.function(operation)).to_vec();
        let mut kinds = vec![(id.to_owned(), plain, format!("--codec {id}"))];
        if dithered.contains(&id) {
            let names = [
                format!("{id}_encode_dithered"),
                format!("{id}_decode_dithered"),
                "dither_from_pixel".to_owned(),
            ];
            kinds.push((format!("{id} dithered"), names.to_vec(), format!("--function {}", names.join(","))));
        }
        for (key, functions, option) in kinds {
            let command = format!("unitvec shader --language {tongue} {option}");
            let text = text(&functions, language, Edition::Plain, &command)?;
            let places = text.split("\n\n").map(|paragraph| {
                *known.entry(paragraph.to_owned()).or_insert_with(|| {
                    texts.paragraphs.push(paragraph.to_owned());
                    texts.paragraphs.len() - 1
                })
            });
            let places = places.collect();
            texts.codecs.insert(key, places);
        }
    }
    Ok(texts)
}
