use super::table::{Layout, Wide, left, right, wrapped};
use super::{
    Vulkan, chosen_formats, counts, print, progress, status_after_validation, to_json, to_separated,
};
use clap::Args;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_host::Result;
use unitvec_host::input::Input;
use unitvec_lab::imprecise::Model;
use unitvec_mesh as mesh;
use unitvec_run::backend::BackendKind;
use unitvec_run::conform;
use unitvec_run::conform::{Options, Plan, Report, Rounding, Row, Summary};
use unitvec_vulkan::DeviceInfo;

#[derive(Args)]
pub struct Arguments {
    /// Codec to run, as `unitvec codecs` lists them; may be given again. All of them if not given.
    #[arg(long, value_name = "ID")]
    pub codec: Vec<String>,
    /// Run only the widest codec of each series, whose others differ in their bits alone. Takes a third of the time.
    #[arg(long, conflicts_with = "codec")]
    widest: bool,
    /// Random vectors or frames for each codec, and random codes for those whose codes are not all decoded; 2^18 if not
    /// given, 10^6 with --exhaustive.
    #[arg(long, value_name = "N", value_parser = counts())]
    pub count: Option<u64>,
    /// Decode all codes of up to 24 bits instead of up to 16. Takes several times as long.
    #[arg(long)]
    pub exhaustive: bool,
    /// Seed of the random directions.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Run the graphics pipeline instead: what an attachment of the codec's Vulkan format holds after the hardware's conversion
    /// is compared with the CPU's code, and what vertex and texel fetch give with the CPU's vector; 2^15 random vectors, and as
    /// many random codes of more than 16 bits, if --count does not say otherwise.
    #[arg(long, conflicts_with_all = ["imprecise", "exhaustive", "summary", "mesh"])]
    pipeline: bool,
    #[command(flatten)]
    pub imprecise: Imprecise,
    /// Write the report as JSON as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write the outcome in one line as well, tab-separated, below the names of its fields: device, driver, vulkan, codecs,
    /// vectors, codes, mismatches.
    #[arg(long, value_name = "FILE", conflicts_with = "imprecise")]
    summary: Option<PathBuf>,
    #[command(flatten)]
    pub wide: Wide,
    #[command(flatten)]
    pub vulkan: Vulkan,
    /// Meshes whose normals are encoded too (obj, ply, gltf, glb); the Stanford bunny if none is given.
    mesh: Vec<PathBuf>,
}

/// Devices that round as badly as Vulkan allows.
#[derive(Args)]
pub struct Imprecise {
    /// Run on devices that round as badly as Vulkan allows: kernels rewritten so that quotients and square roots are off,
    /// denormals are flushed, or sums are truncated. Differences are held against their bounds, and each code has to come back
    /// from any two devices.
    #[arg(long, conflicts_with = "mesh")]
    pub imprecise: bool,
    /// A kind of device; may be given again. All of them if not given.
    #[arg(long, value_name = "MODEL", requires = "imprecise")]
    pub model: Vec<Model>,
    /// Number of seeds, from --seed on; each is a run of its own.
    #[arg(long, value_name = "N", requires = "imprecise", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub seeds: u64,
    /// Write the table as CSV as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE", requires = "imprecise")]
    pub csv: Option<PathBuf>,
}

impl Arguments {
    pub fn all_codes_up_to(&self) -> u32 {
        if self.exhaustive { 24 } else { 16 }
    }
}

/// Random directions of a codec: enough to hit the rare cases, few enough to run all codecs while a person waits.
const COUNT: u64 = 1 << 18;

/// As [`COUNT`], with `--exhaustive`.
const EXHAUSTIVE_COUNT: u64 = 1_000_000;

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let formats =
        if arguments.widest { conform::widest_of_each_series() } else { chosen_formats(&arguments.codec)? };
    if arguments.imprecise.imprecise {
        return super::imprecise::run(arguments, formats);
    }
    if arguments.pipeline {
        return super::pipeline::run(arguments, formats);
    }
    let default_count = if arguments.exhaustive { EXHAUSTIVE_COUNT } else { COUNT };
    let options = Options {
        count: arguments.count.unwrap_or(default_count) as usize,
        seed: arguments.seed,
        normals: normals(&arguments.mesh)?,
        all_codes_up_to: arguments.all_codes_up_to(),
    };
    let device = arguments.vulkan.device()?;
    let open = || arguments.vulkan.backends(&device);

    let rounding = open()?
        .iter_mut()
        .map(|(kind, backend)| Ok((*kind, Rounding::of(backend.as_mut())?)))
        .collect::<Result<Roundings>>()?;
    let to_stdout = arguments.json.as_deref() == Some(Path::new("-"));
    let columns = arguments.wide.columns()?;
    let table = table(columns);
    if !to_stdout {
        print(&(heading(device.info(), &options, &rounding, columns) + &table.heading()))?;
    }
    let plans: Vec<Plan<'_>> = formats.into_iter().map(|format| Plan::new(format, &options)).collect();
    let work = plans.iter().map(Plan::work).sum();
    let bar = progress::bar(Some(work), "{msg:<20} {wide_bar} {percent}%, {eta} left");
    let mut rows = Vec::new();
    let mut advance = |done| {
        progress::show_if_due(&bar);
        bar.inc(done);
    };
    conform::run(plans, open, &mut advance, &mut |row| {
        bar.set_message(row.id);
        if !to_stdout {
            bar.suspend(|| print(&lines(&table, &row, columns)))?;
        }
        rows.push(row);
        Ok(())
    })?;
    bar.finish_and_clear();
    // What the layer says of objects that outlive their device counts as well.
    let (info, instance) = (device.info().clone(), device.instance().clone());
    drop(device);
    let messages = instance.validation_messages();

    let report = Report {
        device: info,
        random_directions: options.count,
        all_codes_up_to: options.all_codes_up_to,
        glsl_compared: cfg!(feature = "glsl"),
        agreed: rows.iter().all(Row::agrees) && is_nearest(&rounding),
        rounding,
        rows,
    };
    if let Some(path) = &arguments.json {
        unitvec_files::write_file(path, to_json(&report).as_bytes())?;
    }
    if let Some(path) = &arguments.summary {
        unitvec_files::write_file(path, &to_separated(path, &[report.summary()], b'\t')?)?;
    }
    if !to_stdout {
        print(&wrapped(&verdict(&report, messages.len()), "", columns))?;
    }
    Ok(status_after_validation(&messages, report.agreed))
}

fn normals(meshes: &[PathBuf]) -> Result<Vec<[f32; 3]>> {
    if meshes.is_empty() {
        return Ok(mesh::read_obj(Path::new("bunny.obj"), mesh::BUNNY)?.normals);
    }
    let mut normals = Vec::new();
    for path in meshes {
        normals.extend(Input::open(path)?.parse(mesh::parse)?.normals);
    }
    Ok(normals)
}

fn heading(device: &DeviceInfo, options: &Options, rounding: &Roundings, columns: Option<usize>) -> String {
    let sums = if is_nearest(rounding) { "rounded to nearest" } else { "not rounded to nearest" };
    let text = format!(
        "device: {} ({:?}), driver {}, Vulkan {}\n\
         input of a codec: {} random vectors (seed {}), {} mesh normals, special vectors; {}\n\
         sums, by which encoders round: {sums}\n\
         diff: codes and vectors that differ from the CPU's in any bit\n\n",
        device.name,
        device.kind,
        device.driver,
        device.api_version,
        options.count,
        options.seed,
        options.normals.len(),
        codes_covered(options.all_codes_up_to, options.count),
    );
    wrapped(&text, "    ", columns)
}

/// How each backend rounds.
type Roundings = BTreeMap<BackendKind, Rounding>;

fn is_nearest(rounding: &Roundings) -> bool {
    rounding.values().all(|rounding| *rounding == Rounding::Nearest)
}

fn table(columns: Option<usize>) -> Layout {
    let kinds = in_one_line(BackendKind::of_devices().map(|kind| kind.to_string()));
    Layout::new(
        vec![
            left("codec", 20),
            right("bits", 4),
            right("mean\ndegrees", 10),
            right("max\ndegrees", 10),
            right(&format!("diff\n{kinds}"), kinds.len()).apart(),
        ],
        columns,
    )
}

/// What is said of each backend, side by side.
fn in_one_line(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(" ")
}

/// Which codes are decoded, in words.
fn codes_covered(all_up_to: u32, count: usize) -> String {
    format!("all codes of up to {all_up_to} bits, {count} random codes of more")
}

fn lines(table: &Layout, row: &Row, columns: Option<usize>) -> String {
    let differing = in_one_line(BackendKind::of_devices().map(|kind| {
        let counts = [&row.encode_mismatches, &row.decode_mismatches].map(|mismatches| mismatches.get(&kind));
        let count = match counts {
            [None, None] => "-".to_owned(),
            counts => counts.into_iter().flatten().sum::<u64>().to_string(),
        };
        // As wide as the backend's name above it.
        format!("{count:>4}")
    }));
    let errors = |mean: f64, max: f64| [mean, max].map(|error| format!("{error:.6}"));
    let [mean, max] = errors(row.mean_deg, row.max_deg);
    let mut text = table.line(&[&row.id, &row.bits, &mean, &max, &differing]);
    if let (Some(mean), Some(max)) = (row.tangent_mean_deg, row.tangent_max_deg) {
        let [mean, max] = errors(mean, max);
        text += &table.line(&[&"  its tangents", &"", &mean, &max]);
    }
    for example in &row.examples {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}", wrapped(&format!("    {example}"), "        ", columns));
    }
    text
}

fn verdict(report: &Report, validation_messages: usize) -> String {
    if validation_messages > 0 {
        return format!("\nconform: FAIL: {validation_messages} messages of the validation layer\n");
    }
    let Summary { codecs, vectors, codes, .. } = report.summary();
    let backends: Vec<String> = BackendKind::of_devices().map(|kind| kind.to_string()).collect();
    let without =
        if report.glsl_compared { "" } else { " (this build has no GLSL compiler: `--features glsl`)" };
    let compared = format!("cpu, {}{without}", backends.join(", "));
    if report.agreed {
        return format!(
            "\nconform: PASS: {compared} agree to the bit: {codecs} codecs, {vectors} vectors encoded, {codes} codes \
             decoded ({})\n",
            codes_covered(report.all_codes_up_to, report.random_directions),
        );
    }
    if report.rounding.values().any(|rounding| *rounding == Rounding::Down) {
        return "\nconform: FAIL: this device rounds sums down, and encoders need them rounded to nearest: codes are up to a \
                step off\n"
            .to_owned();
    }
    let failed: Vec<&str> = report.rows.iter().filter(|row| !row.agrees()).map(|row| row.id).collect();
    let failed = if failed.is_empty() { "none of the codecs" } else { &failed.join(", ") };
    let rounding = if is_nearest(&report.rounding) { "" } else { "; sums are not rounded to nearest" };
    format!("\nconform: FAIL: differences in {failed}{rounding}\n")
}
