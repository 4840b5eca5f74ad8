use super::figures::{Rendering, Studio, draw_all};
use super::run::{Live, close};
use super::{print, write_output};
use clap::{Args, ValueEnum};
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, CODECS, RECOMMENDED, find};
use unitvec_choose::Costs;
use unitvec_files::read_small;
use unitvec_host::{Error, Result};
use unitvec_render as render;
use unitvec_render::Material;
use unitvec_render::figures::{Figures, Options, Part, Theme};
use unitvec_render::report;
use unitvec_render::report::{Contents, Files, Machine};
use unitvec_run::backend::BackendKind;
use unitvec_run::conform;
use unitvec_run::conform::{Arithmetic, Backends, Plan, Rounding};
use unitvec_vulkan as vulkan;
use unitvec_vulkan::Device;

#[derive(Args)]
pub struct Arguments {
    /// File to write.
    #[arg(short, long, value_name = "FILE", alias = "out", default_value = "report.html")]
    output: PathBuf,
    /// Folder with figures of `unitvec figures`; they are made now if it is not given. Of a folder that --small made, the page slides
    /// between the parts of pictures that figure 8 shows.
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    /// Report of `unitvec conform --json` to show; a short run is made now if it is not given.
    #[arg(long, value_name = "FILE")]
    conform: Option<PathBuf>,
    /// Report of `unitvec conform pipeline --json` to show; a short run with the recommended codecs is made now if it
    /// is not given.
    #[arg(long, value_name = "FILE")]
    pipeline: Option<PathBuf>,
    /// Costs to begin with: a report of `unitvec bench device --json` or `unitvec bench compiler --json`.
    #[arg(long, value_name = "FILE")]
    costs: Option<PathBuf>,
    /// Use no Vulkan device: leave out rendered figures and the runs of `conform`, unless their files are given.
    #[arg(long)]
    no_device: bool,
    /// Random directions of each row of the tables.
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = super::counts())]
    count: u64,
    #[command(flatten)]
    rendering: Rendering,
}

/// Random vectors of a codec, and the codes that are all decoded, of the short run.
const SHORT: (usize, u32) = (1 << 12, 8);

/// Random directions of a codec of the short run of the graphics pipeline.
const SHORT_PIPELINE: usize = 1 << 8;

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    // What cannot be written is told before the work.
    let output = unitvec_files::Output::create(&arguments.output)?;
    let is_page = output.is_stdout();
    // So is what cannot be read.
    let mut costs = report::shipped_costs()?;
    if let Some(path) = &arguments.costs {
        costs.insert(0, Costs::parse(path, &read_small(path)?)?);
    }
    let agreement = given(arguments.conform.as_deref(), "unitvec conform --json")?;
    let pipeline = given(arguments.pipeline.as_deref(), "unitvec conform pipeline --json")?;
    let figures = arguments.figures.as_deref().map(figures_of).transpose()?;

    let mut messages = Vec::new();
    let drawing = drawing(arguments)?;
    let not_rendered = drawing.as_ref().err().filter(|_| figures.is_none()).cloned();
    let agreement = match agreement {
        None if !arguments.no_device => Some(short_conform(&arguments.rendering, &mut messages)?),
        given => given,
    };
    let pipeline = match (pipeline, drawing) {
        (Some(given), _) => Ok(given),
        (None, Ok(device)) => Ok(short_pipeline(device, &mut messages)?),
        (None, Err(reason)) => Err(reason),
    };
    let (figures, files) = match figures {
        Some(given) => given,
        None => draw_figures(arguments, not_rendered.is_none(), &mut messages)?,
    };
    let count = arguments.count as usize;
    let machine = Machine::this();
    let contents = Contents { figures, files, not_rendered, agreement, pipeline, machine, costs, count };
    let live = Live::new(Some(report::work() as u64), "tables {wide_bar} {pos} of {len}, {eta} left", true);
    let html = report::html(&contents, &mut || live.advance(1))?;
    live.finish();
    write_output(output, html.as_bytes())?;
    let size = html.len() as f64 / f64::from(1 << 20);
    if !is_page {
        print(&format!("report: {} ({size:.1} MiB)\n", arguments.output.display()))?;
    }
    Ok(super::status_after_validation(&messages))
}

/// The report in a file that this command writes, where one is named.
fn given<T: DeserializeOwned>(path: Option<&Path>, command: &str) -> Result<Option<T>> {
    let Some(path) = path else { return Ok(None) };
    let not_of = |error| Error::Usage(format!("{} is not a report of `{command}`: {error}", path.display()));
    serde_json::from_slice(&read_small(path)?).map(Some).map_err(not_of)
}

/// A device that draws; else why there is none, in a sentence. One that fails for another reason is an error.
type Drawing = Result<Arc<Device>, String>;

fn drawing(arguments: &Arguments) -> Result<Drawing> {
    let is_asked = arguments.figures.is_none() || arguments.pipeline.is_none();
    if arguments.no_device || !is_asked {
        return Ok(Err("No Vulkan device was used.".to_owned()));
    }
    match arguments.rendering.vulkan.device_for_graphics() {
        Err(vulkan::Error::MissingFeature { device, feature }) => {
            Ok(Err(format!("The device {device} lacks {feature}.")))
        }
        opened => Ok(Ok(opened?)),
    }
}

/// The figures of a folder with their files.
fn figures_of(folder: &Path) -> Result<(Figures, Files)> {
    let figures = Figures::read(folder)?;
    let shown = figures.figures.iter().flat_map(|figure| &figure.pictures);
    let files = shown.map(|shown| Ok((shown.file.clone(), read_small(&folder.join(&shown.file))?)));
    let files = files.collect::<Result<Files>>()?;
    Ok((figures, files))
}

/// Draws the figures, those that are rendered too if a device draws.
fn draw_figures(arguments: &Arguments, draws: bool, messages: &mut Vec<String>) -> Result<(Figures, Files)> {
    let mut files = Files::new();
    let options = Options {
        small: true,
        theme: Theme::LIGHT,
        codecs: Vec::new(),
        materials: Material::ALL.to_vec(),
        whole: true,
    };
    let parts = Part::value_variants().iter().copied();
    let parts: Vec<Part> = parts.filter(|part| draws || !part.is_rendered()).collect();
    let mut studio = Studio::new(&arguments.rendering, None, true);
    let figures = draw_all(&parts, &options, &mut studio, |file, bytes| {
        files.insert(file.to_owned(), bytes);
        Ok(())
    })?;
    messages.extend(studio.close());
    Ok((figures, files))
}

/// A short run of the graphics pipeline with the codecs that the page recommends: all of them take minutes.
fn short_pipeline(device: Arc<Device>, messages: &mut Vec<String>) -> Result<render::conform::Report> {
    let options = render::conform::Options { count: SHORT_PIPELINE, seed: 1 };
    let traits = render::conform::traits(&device, &options)?;
    let choices = RECOMMENDED.iter().flat_map(|one| one.choices);
    let formats = choices.map(|choice| Ok(find(choice.id)?)).collect::<Result<Vec<&'static AnyCodec>>>()?;
    let live = Live::new(Some(formats.len() as u64), "graphics pipeline {wide_bar} {pos} of {len}", true);
    let mut rows = Vec::new();
    render::conform::run(formats, &options, &device, &traits, &mut |row| {
        live.advance(1);
        rows.push(row);
        Ok::<(), Error>(())
    })?;
    live.finish();
    let (device, closing) = close(device);
    messages.extend(closing);
    Ok(render::conform::Report::new(&device, &options, traits, rows, Vec::new()))
}

/// A short run of the kernels of all codecs.
fn short_conform(rendering: &Rendering, messages: &mut Vec<String>) -> Result<conform::Report> {
    let options = conform::Options { count: SHORT.0, seed: 1, normals: Vec::new(), all_codes_up_to: SHORT.1 };
    let device = rendering.vulkan.device()?;
    let backend = || rendering.vulkan.backend(BackendKind::Rust, &device, true);
    let open = || -> Result<Backends> { Ok([(BackendKind::Rust, backend()?)].into()) };
    let rounding = [(BackendKind::Rust, Rounding::of(backend()?.as_mut())?)].into();
    let arithmetic = Arithmetic::of(&device, &rendering.vulkan.modules()?)?;
    let plans: Vec<Plan<'_>> = CODECS.iter().map(|format| Plan::new(format, &options)).collect();
    let live = Live::new(Some(plans.len() as u64), "agreement {wide_bar} {pos} of {len}", true);
    let mut rows = Vec::new();
    conform::run(plans, open, &mut |_| live.advance(0), &mut |row| {
        live.advance(1);
        rows.push(row);
        Ok::<(), Error>(())
    })?;
    live.finish();
    let (device, closing) = close(device);
    messages.extend(closing);
    Ok(conform::Report::new(device, &options, rounding, arithmetic, None, rows))
}
