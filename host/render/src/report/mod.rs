//! One page to decide from: recommendations, the published tables beside ours, the figures, and whether this device
//! agrees. It is one file, loads nothing and works without scripts.

mod agreement;
pub mod model;
mod tables;
mod viewer;

pub use tables::{Machine, shipped_costs, work};

use crate::figures::{Figure, Figures, Labelled, Shown};
use crate::{Error, Result, conform};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use minijinja::{AutoEscape, Environment, HtmlEscape, Value, context};
use serde::Serialize;
use std::collections::BTreeMap;
use unitvec_choose::Costs;
use unitvec_run::conform as kernels;
use viewer::VIEWED;

/// The contents of a report besides the data that ship with the program.
pub struct Contents {
    /// The figures, with the bytes of each picture's file.
    pub figures: Figures,
    /// The pictures' bytes, by the file's name.
    pub files: Files,
    /// The reason, in a sentence, why rendered figures were left out, where they were.
    pub not_rendered: Option<String>,
    /// The report of the device's kernels, where they were compared with the CPU.
    pub agreement: Option<kernels::Report>,
    /// The report of the graphics pipeline; else why it was not checked, in a sentence.
    pub pipeline: Result<conform::Report, String>,
    /// The machine that the report was made on.
    pub machine: Machine,
    /// Costs, those to begin with first.
    pub costs: Vec<Costs>,
    /// Random directions of each row of the tables.
    pub count: usize,
}

/// Files by their names.
pub type Files = BTreeMap<String, Vec<u8>>;

const TEMPLATES: [(&str, &str); 7] = [
    ("page.html", include_str!("page.html")),
    ("model.html", include_str!("model.html")),
    ("viewer.html", include_str!("viewer.html")),
    ("viewer.js", include_str!("viewer.js")),
    ("head.html", include_str!("head.html")),
    ("page.css", include_str!("page.css")),
    ("page.js", include_str!("page.js")),
];

/// Makes the page. `progress` is called for each row of the tables that is measured.
///
/// # Errors
/// Any error of measuring; a picture that `files` lacks.
pub fn html(contents: &Contents, progress: &mut dyn FnMut()) -> Result<String> {
    let codecs = tables::codecs(&contents.costs);
    let tables = tables::published(&contents.costs, contents.count, progress)?;
    let figures = contents.figures.figures.iter().map(|figure| page_figure(figure, &contents.files));
    let figures = figures.collect::<Result<Vec<(Value, bool)>>>()?;
    let has_viewer = figures.iter().any(|(_, has_viewer)| *has_viewer);
    let note = (!has_viewer).then(|| viewer::note(&contents.figures, contents.not_rendered.as_deref()));
    let page = context! {
        version => env!("CARGO_PKG_VERSION"),
        machine => contents.machine,
        device => contents.figures.origin.device,
        answers => contents.costs.first().map(tables::answers),
        gpus => contents.costs.iter().map(Costs::device).collect::<Vec<_>>(),
        codecs_json => json(&codecs),
        codecs,
        tables,
        figures => figures.into_iter().map(|(figure, _)| figure).collect::<Vec<_>>(),
        // Set where figures are missing.
        note,
        agreement => contents.agreement.as_ref().map(agreement::of_kernels),
        pipeline => contents.pipeline.as_ref().ok().map(agreement::of_pipeline),
        no_pipeline => contents.pipeline.as_ref().err(),
    };
    render("page.html", page).map_err(|error| Error::Page(error.to_string()))
}

fn render(name: &str, page: Value) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.set_auto_escape_callback(|name| {
        if name.ends_with(".html") { AutoEscape::Html } else { AutoEscape::None }
    });
    environment.add_filter("degrees", |value: f64| unitvec_choose::degrees(value));
    environment.add_filter("json", |value: Value| Value::from_safe_string(json(&value)));
    environment.add_filter("code", |text: &str| Value::from_safe_string(with_code(text)));
    for (name, text) in TEMPLATES {
        environment.add_template(name, text)?;
    }
    environment.get_template(name)?.render(page)
}

/// HTML of a sentence with code between backticks.
fn with_code(text: &str) -> String {
    let parts = text.split('`').map(|part| HtmlEscape(part).to_string()).enumerate();
    parts.map(|(at, part)| if at % 2 == 1 { format!("<code>{part}</code>") } else { part }).collect()
}

/// JSON that may stand within a page: no tag ends or begins in it.
fn json(value: &impl Serialize) -> String {
    // Serialising plain structs and strings to memory has no way to fail.
    serde_json::to_string(value).unwrap_or_default().replace('<', "\\u003c")
}

/// A figure of the page, and whether it has the viewer.
fn page_figure(figure: &Figure, files: &Files) -> Result<(Value, bool)> {
    let (compared, sheets): (Vec<&Shown>, Vec<&Shown>) =
        figure.pictures.iter().partition(|shown| shown.of.is_some());
    let picture = |shown: &&Shown| {
        let differences = shown.differences.iter().map(|Labelled { label, difference }| {
            let [mean, max, ssim, flip] = difference.cells();
            [label.clone(), mean, max, ssim, flip]
        });
        let differences: Vec<[String; 5]> = differences.collect();
        Ok(context! { uri => uri(&shown.file, files)?, alt => shown.alt, size => shown.size, differences })
    };
    let numbers = figure.numbers.iter().map(|number| [number.name.clone(), number.in_words()]);
    let viewer = if figure.id == VIEWED { viewer::of(&compared, &sheets, files)? } else { None };
    let page_figure = context! {
        heading => figure.heading(),
        caption => figure.caption,
        earlier => figure.earlier_in_words(),
        anchor => format!("figure-{}", figure.id),
        pictures => sheets.iter().map(picture).collect::<Result<Vec<Value>>>()?,
        numbers => numbers.collect::<Vec<_>>(),
        viewer,
    };
    Ok((page_figure, viewer.is_some()))
}

/// A file as part of the page.
fn uri(file: &str, files: &Files) -> Result<String> {
    let kind = if file.ends_with(".svg") { "image/svg+xml" } else { "image/png" };
    Ok(data(kind, bytes(file, files)?))
}

fn data(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}

fn bytes<'a>(file: &str, files: &'a Files) -> Result<&'a [u8]> {
    files.get(file).map(Vec::as_slice).ok_or_else(|| Error::Lacking(file.to_owned()))
}
