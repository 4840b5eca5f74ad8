use super::figures::{Rendering, Studio, draw_all};
use super::{print, progress, to_json};
use clap::{Args, ValueEnum};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_host::backend::BackendKind;
use unitvec_host::catalogue::formats;
use unitvec_host::choose::Costs;
use unitvec_host::conform::{self, Backends, Plan, Rounding};
use unitvec_host::figures::{Figures, Options, Part};
use unitvec_host::input::{Input, read_small};
use unitvec_host::render::Material;
use unitvec_host::report::{self, Agreement, Contents, Machine};
use unitvec_host::vulkan::Device;
use unitvec_host::{Error, Result, output};

#[derive(Args)]
pub struct Arguments {
    /// File to write.
    #[arg(long, value_name = "FILE", default_value = "report.html")]
    out: PathBuf,
    /// Folder with figures of `unitvec figures`; they are made now if it is not given. One that --small made has no single
    /// pictures to slide between.
    #[arg(long, value_name = "DIR")]
    figures: Option<PathBuf>,
    /// Report of `unitvec conform --json` to show; a short run is made now if it is not given.
    #[arg(long, value_name = "FILE")]
    conform: Option<PathBuf>,
    /// Costs to begin with: a report of `unitvec bench --json`, with --isa or without.
    #[arg(long, value_name = "FILE")]
    costs: Option<PathBuf>,
    /// Use no Vulkan device: leave out rendered figures and the run of `conform`.
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

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    // What cannot be written is told before the work.
    let output = output::Output::create(&arguments.out)?;
    let is_page = output.is_stdout();
    let (agreement, mut messages) = match &arguments.conform {
        Some(path) => (Some(parse_conform(path, &read(path)?)?), Vec::new()),
        None if arguments.no_device => (None, Vec::new()),
        None => {
            short_conform(&arguments.rendering).map(|(agreement, messages)| (Some(agreement), messages))?
        }
    };
    let mut costs = report::shipped_costs()?;
    if let Some(path) = &arguments.costs {
        costs.insert(0, Costs::parse(path, &read(path)?)?);
    }
    let (figures, files, of_figures) = figures(arguments)?;
    messages.extend(of_figures);
    let count = arguments.count as usize;
    let contents = Contents { figures, files, agreement, machine: Machine::this(), costs, count };
    let bar = progress::bar(Some(report::work() as u64), "tables {wide_bar} {pos} of {len}, {eta} left");
    let html = report::html(&contents, &mut || {
        progress::show_if_due(&bar);
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    write(output, &html)?;
    let size = html.len() as f64 / f64::from(1 << 20);
    if !is_page {
        print(&format!("report: {} ({size:.1} MiB)\n", arguments.out.display()))?;
    }
    Ok(super::status_after_validation(&messages, true))
}

fn write(mut output: output::Output, html: &str) -> Result<()> {
    let path = output.path().to_owned();
    std::io::Write::write_all(&mut output, html.as_bytes())
        .map_err(|source| Error::writing(&path, source))?;
    output.finish()
}

fn read(path: &Path) -> Result<Vec<u8>> {
    read_small(Input::open(path)?).map_err(|source| Error::Read { path: path.to_owned(), source })
}

fn parse_conform(path: &Path, json: &[u8]) -> Result<Agreement> {
    let not_one = |error| {
        Error::Usage(format!("{} is not a report of `unitvec conform --json`: {error}", path.display()))
    };
    Agreement::parse(json).map_err(not_one)
}

/// Files by their names.
type Files = BTreeMap<String, Vec<u8>>;

/// The figures with their files, and what the validation layer said.
fn figures(arguments: &Arguments) -> Result<(Figures, Files, Vec<String>)> {
    let mut files = BTreeMap::new();
    if let Some(folder) = &arguments.figures {
        let path = folder.join("figures.json");
        let not_one =
            |error| Error::Usage(format!("{} is not of `unitvec figures`: {error}", path.display()));
        let figures: Figures = serde_json::from_slice(&read(&path)?).map_err(not_one)?;
        for shown in figures.figures.iter().flat_map(|figure| &figure.pictures) {
            if Path::new(&shown.file).file_name() != Some(shown.file.as_ref()) {
                let reason = format!("{} is not the name of a file in its folder", shown.file);
                return Err(Error::Usage(format!("{}: {reason}", path.display())));
            }
            files.insert(shown.file.clone(), read(&folder.join(&shown.file))?);
        }
        return Ok((figures, files, Vec::new()));
    }
    let options = Options { small: true, codecs: Vec::new(), materials: Material::ALL.to_vec(), whole: true };
    let parts = Part::value_variants().iter().copied();
    let parts: Vec<Part> = parts.filter(|part| !(arguments.no_device && part.is_rendered())).collect();
    let mut studio = Studio::new(&arguments.rendering, None, true);
    let figures = draw_all(&parts, &options, &mut studio, |file, bytes| {
        files.insert(file.to_owned(), bytes);
        Ok(())
    })?;
    Ok((figures, files, studio.close()))
}

/// A short run of all codecs, and what the validation layer said.
fn short_conform(rendering: &Rendering) -> Result<(Agreement, Vec<String>)> {
    let options = conform::Options { count: SHORT.0, seed: 1, normals: Vec::new(), all_codes_up_to: SHORT.1 };
    let device = rendering.vulkan.device()?;
    let open = || -> Result<Backends> { Ok([(BackendKind::Rust, backend(rendering, &device)?)].into()) };
    let rounding = [(BackendKind::Rust, Rounding::of(backend(rendering, &device)?.as_mut())?)].into();
    let plans: Vec<Plan<'_>> = formats().map(|format| Plan::new(format, &options)).collect();
    let bar = progress::bar(Some(plans.len() as u64), "agreement {wide_bar} {pos} of {len}");
    let mut rows = Vec::new();
    conform::run(plans, open, &mut |_| progress::show_if_due(&bar), &mut |row| {
        bar.inc(1);
        rows.push(row);
        Ok(())
    })?;
    bar.finish_and_clear();
    let report = conform::Report {
        device: device.info().clone(),
        random_directions: options.count,
        all_codes_up_to: options.all_codes_up_to,
        glsl_compared: false,
        agreed: rows.iter().all(conform::Row::agrees),
        rounding,
        rows,
    };
    let instance = device.instance().clone();
    drop(device);
    let agreement = parse_conform(Path::new("this run"), to_json(&report).as_bytes())?;
    Ok((agreement, instance.validation_messages()))
}

fn backend(rendering: &Rendering, device: &Arc<Device>) -> Result<Box<dyn unitvec_host::backend::Backend>> {
    rendering.vulkan.backend(BackendKind::Rust, device, true)
}
