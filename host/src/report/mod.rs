//! One page to decide from: what to take, the published tables beside ours, the figures, and whether this device agrees. It is one
//! file, loads nothing and works without scripts.

mod tables;

pub use tables::{Agreement, Machine, shipped_costs, work};

use crate::choose::Costs;
use crate::figures::{Difference, Figure, Figures, Labelled, Shown, Subject};
use crate::vulkan::DeviceInfo;
use crate::{Error, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use minijinja::{AutoEscape, Environment, Value};
use serde::Serialize;
use std::collections::BTreeMap;

/// What goes into a report besides what ships with the program.
pub struct Contents {
    /// The figures, with the bytes of each picture's file.
    pub figures: Figures,
    /// Those bytes, by the file's name.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Whether the device agrees with the CPU, where that was looked at.
    pub agreement: Option<Agreement>,
    /// What the report was made on.
    pub machine: Machine,
    /// Costs, those to begin with first.
    pub costs: Vec<Costs>,
    /// Random directions of each row of the tables.
    pub count: usize,
}

const TEMPLATES: [(&str, &str); 3] = [
    ("page.html", include_str!("page.html")),
    ("page.css", include_str!("page.css")),
    ("page.js", include_str!("page.js")),
];

/// What the template shows.
#[derive(Serialize)]
struct Page<'a> {
    version: &'a str,
    machine: &'a Machine,
    device: Option<&'a DeviceInfo>,
    answers: Vec<tables::Answer>,
    gpus: Vec<&'a str>,
    codecs: Vec<tables::Codec>,
    codecs_json: String,
    tables: Vec<tables::PageTable>,
    figures: Vec<PageFigure<'a>>,
    agreement: Option<&'a Agreement>,
}

/// A figure of the page.
#[derive(Serialize)]
struct PageFigure<'a> {
    heading: String,
    caption: &'a str,
    anchor: String,
    pictures: Vec<PagePicture<'a>>,
    numbers: Vec<[String; 2]>,
    viewer: Option<Viewer>,
}

#[derive(Serialize)]
struct PagePicture<'a> {
    uri: String,
    alt: &'a str,
    size: Option<[u32; 2]>,
    differences: Vec<[String; 4]>,
}

/// Pictures of codecs over those of floats, to slide between.
#[derive(Serialize)]
struct Viewer {
    materials: Vec<String>,
    codecs: Vec<String>,
    /// The codec and the material of the first look.
    first: [String; 2],
    width: u32,
    height: u32,
    pictures: BTreeMap<String, ViewerPicture>,
}

#[derive(Serialize)]
struct ViewerPicture {
    uri: String,
    words: String,
}

/// The page. `progress` hears of each row of the tables that is measured.
///
/// # Errors
/// What measuring meets; a picture that `files` lacks.
pub fn html(contents: &Contents, progress: &mut dyn FnMut()) -> Result<String> {
    let codecs = tables::codecs(&contents.costs, progress)?;
    let tables = tables::published(&contents.costs, contents.count, progress)?;
    let figures: Result<Vec<PageFigure<'_>>> =
        contents.figures.figures.iter().map(|figure| page_figure(figure, &contents.files)).collect();
    let page = Page {
        version: &contents.figures.version,
        machine: &contents.machine,
        device: contents.figures.device.as_ref(),
        answers: tables::answers(&codecs),
        gpus: contents.costs.iter().map(Costs::device).collect(),
        codecs_json: json(&codecs),
        codecs,
        tables,
        figures: figures?,
        agreement: contents.agreement.as_ref(),
    };
    render(&page).map_err(|error| Error::Usage(format!("the report's page cannot be made: {error}")))
}

fn render(page: &Page<'_>) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.set_auto_escape_callback(|name| {
        if name == "page.html" { AutoEscape::Html } else { AutoEscape::None }
    });
    environment.add_filter("degrees", |value: f64| tables::degrees(value));
    environment.add_filter("json", |value: Value| Value::from_safe_string(json(&value)));
    for (name, text) in TEMPLATES {
        environment.add_template(name, text)?;
    }
    environment.get_template("page.html")?.render(Value::from_serialize(page))
}

/// JSON that may stand within a page: no tag ends or begins in it.
fn json(value: &impl Serialize) -> String {
    // Serialising plain structs and strings to memory has no way to fail.
    serde_json::to_string(value).unwrap_or_default().replace('<', "\\u003c")
}

fn page_figure<'a>(figure: &'a Figure, files: &BTreeMap<String, Vec<u8>>) -> Result<PageFigure<'a>> {
    let (compared, sheets): (Vec<&Shown>, Vec<&Shown>) =
        figure.pictures.iter().partition(|shown| shown.of.is_some());
    let picture = |shown: &&'a Shown| {
        let differences = shown.differences.iter().map(|Labelled { label, difference }| {
            let Difference { mean, max, ssim } = difference;
            [label.clone(), format!("{mean:.3}"), max.to_string(), format!("{ssim:.4}")]
        });
        let differences = differences.collect();
        Ok(PagePicture { uri: uri(&shown.file, files)?, alt: &shown.alt, size: shown.size, differences })
    };
    Ok(PageFigure {
        heading: figure.heading(),
        caption: &figure.caption,
        anchor: format!("figure-{}", figure.id),
        pictures: sheets.iter().map(picture).collect::<Result<_>>()?,
        numbers: figure.numbers.iter().map(|number| [number.name.clone(), number.in_words()]).collect(),
        viewer: if figure.id == VIEWED { viewer(&compared, files)? } else { None },
    })
}

/// The figure whose pictures the page slides between.
const VIEWED: &str = "8";

fn viewer(compared: &[&Shown], files: &BTreeMap<String, Vec<u8>>) -> Result<Option<Viewer>> {
    let Some([width, height]) = compared.first().and_then(|shown| shown.size) else { return Ok(None) };
    let (mut materials, mut codecs, mut pictures) = (Vec::new(), Vec::new(), BTreeMap::new());
    for shown in compared {
        let Some(Subject { codec, material }) = &shown.of else { continue };
        for (list, name) in [(&mut materials, material), (&mut codecs, codec)] {
            if !list.contains(name) {
                list.push(name.clone());
            }
        }
        let words = shown.differences.first().map_or_else(String::new, |one| one.difference.in_words());
        pictures
            .insert(format!("{material}/{codec}"), ViewerPicture { uri: uri(&shown.file, files)?, words });
    }
    codecs.retain(|codec| codec != "float");
    let first = [codecs.first(), materials.last()].map(|name| name.cloned().unwrap_or_default());
    Ok(Some(Viewer { materials, codecs, first, width, height, pictures }))
}

/// A file as part of the page.
fn uri(file: &str, files: &BTreeMap<String, Vec<u8>>) -> Result<String> {
    let missing = || Error::Usage(format!("the figures lack {file}; make them again with `unitvec figures`"));
    let bytes = files.get(file).ok_or_else(missing)?;
    let kind = if file.ends_with(".svg") { "image/svg+xml" } else { "image/png" };
    Ok(format!("data:{kind};base64,{}", STANDARD.encode(bytes)))
}
