use super::run::{Live, PERCENT, Run, Screen};
use super::table::{Column, left, right};
use super::{Vulkan, counted, counts, examples, to_json, write_separated};
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_catalogue::AnyCodec;
use unitvec_host::Result;
use unitvec_host::input::Input;
#[cfg(feature = "lab")]
use unitvec_lab::imprecise::{self, Bounds, Model};
use unitvec_mesh as mesh;
use unitvec_mesh::Reach;
use unitvec_run::backend::BackendKind;
use unitvec_run::conform::{
    self, Arithmetic, Options, Plain, Plan, Report, Rounding, Roundings, Row, Summary,
    all_round_to_nearest as is_nearest,
};
#[cfg(feature = "lab")]
use unitvec_run::shader::Edition;
use unitvec_vulkan::{Device, DeviceInfo};

#[derive(Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct Arguments {
    #[command(subcommand)]
    mode: Option<Mode>,
    #[command(flatten)]
    kernels: Kernels,
}

#[derive(Subcommand)]
enum Mode {
    /// Compare the kernels with the CPU, to the bit; `unitvec conform` alone does the same.
    #[command(after_help = examples::of("conform kernels"))]
    Kernels(Kernels),
    /// Compare attachments, textures and vertex attributes with the CPU: the hardware converts codes to formats and back.
    #[cfg(feature = "render")]
    #[command(after_help = examples::of("conform pipeline"), mut_args = super::hide_modules)]
    Pipeline(super::pipeline::Arguments),
    /// Run devices that round as loosely as Vulkan allows: kernels rewritten so that quotients and square roots are off,
    /// denormals are flushed, or sums are truncated. Differences are held against their bounds, and each code has to come back
    /// from any two devices.
    #[cfg(feature = "lab")]
    #[command(after_help = examples::of("conform imprecise"))]
    Imprecise(super::imprecise::Arguments),
}

/// The options of all modes.
#[derive(Args)]
pub struct Inputs {
    /// Run only the widest codec of each series, such as oct32 of oct8 to oct32: the others differ only in width. Takes a third
    /// of the time.
    #[arg(long, conflicts_with = "codec")]
    widest: bool,
    /// Random vectors or frames for each codec, and random codes for those whose codes are not all decoded. If not given: 2^18
    /// by `kernels`, or 10^6 with --exhaustive; 2^16 by `imprecise`; 2^15 by `pipeline`, and at most 2^20.
    #[arg(long, value_name = "N", value_parser = counts())]
    pub count: Option<u64>,
    /// Seed of the random directions.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub run: Run,
}

impl Inputs {
    pub fn formats(&self) -> Result<Vec<&'static AnyCodec>> {
        if self.widest { Ok(conform::widest_of_each_series()) } else { self.run.formats() }
    }
}

/// Decodes all codes of up to so many bits, with --exhaustive or without.
pub fn all_codes_up_to(is_exhaustive: bool) -> u32 {
    if is_exhaustive { 24 } else { 16 }
}

#[derive(Args)]
struct Kernels {
    /// Decode all codes of up to 24 bits instead of up to 16. Takes several times as long.
    #[arg(long)]
    exhaustive: bool,
    /// Write the outcome in one line as well, tab-separated, below the names of its fields: device, driver, vulkan, codecs,
    /// vectors, codes, mismatches.
    #[arg(long, value_name = "FILE")]
    summary: Option<PathBuf>,
    /// Write what docs/devices.md tells of a device, to send it in: its name and driver, how it rounds, the verdict and the
    /// counts, and nothing else.
    #[arg(long, value_name = "FILE")]
    share: Option<PathBuf>,
    #[command(flatten)]
    inputs: Inputs,
    /// Meshes whose normals are encoded too (obj, ply, gltf, glb); the Stanford bunny if none is given. A command stands
    /// before all options: `conform pipeline --codec oct16`.
    mesh: Vec<PathBuf>,
}

/// Random directions of a codec: enough to hit the rare cases, few enough to run all codecs while a person waits.
const COUNT: u64 = 1 << 18;

/// As [`COUNT`], with `--exhaustive`.
const EXHAUSTIVE_COUNT: u64 = 1_000_000;

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    match &arguments.mode {
        None => run_kernels(&arguments.kernels),
        Some(Mode::Kernels(kernels)) => run_kernels(kernels),
        #[cfg(feature = "render")]
        Some(Mode::Pipeline(arguments)) => super::pipeline::run(arguments),
        #[cfg(feature = "lab")]
        Some(Mode::Imprecise(arguments)) => super::imprecise::run(arguments),
    }
}

fn run_kernels(arguments: &Kernels) -> Result<ExitCode> {
    let Inputs { count, seed, run, .. } = &arguments.inputs;
    let default_count = if arguments.exhaustive { EXHAUSTIVE_COUNT } else { COUNT };
    let options = Options {
        count: count.unwrap_or(default_count) as usize,
        seed: *seed,
        normals: normals(&arguments.mesh)?,
        all_codes_up_to: all_codes_up_to(arguments.exhaustive),
    };
    let formats = arguments.inputs.formats()?;
    let plans: Vec<Plan<'_>> = formats.iter().map(|format| Plan::new(format, &options)).collect();
    let live = Live::new(Some(plans.iter().map(Plan::work).sum()), PERCENT, run.json.is_to_stdout());
    let mut screen = Screen::new(columns(), &run.wide, live)?;
    let device = run.vulkan.device()?;
    let open = || run.vulkan.backends(&device);

    let rounding = open()?
        .iter_mut()
        .map(|(kind, backend)| Ok((*kind, Rounding::of(backend.as_mut())?)))
        .collect::<Result<Roundings>>()?;
    let arithmetic = Arithmetic::of(&device, &run.vulkan.modules()?)?;
    screen.head(&legend(device.info(), &options, &rounding, &arithmetic))?;
    let mut rows = Vec::new();
    conform::run(plans, open, &mut |done| screen.live.advance(done), &mut |row| {
        screen.row(&row.id, || lines(&screen, &row))?;
        rows.push(row);
        Ok(())
    })?;
    let plain = plain(formats, &options, &run.vulkan, &device)?;
    let device = screen.close(device);

    let report = Report::new(device, &options, rounding, arithmetic, plain, rows);
    run.json.write(&report)?;
    if let Some(path) = &arguments.share {
        unitvec_files::write_file(path, to_json(&report.shared()).as_bytes())?;
    }
    if let Some(path) = &arguments.summary {
        write_separated(path, &[report.summary()], b'\t')?;
    }
    screen.verdict("conform", outcome(&report))
}

/// Random elements and codes of a codec for plain functions: differences are counted, not looked for in corners.
#[cfg(feature = "lab")]
const PLAIN_COUNT: usize = 1 << 12;

/// Runs plain functions on the device as it is.
#[cfg(feature = "lab")]
fn plain(
    formats: Vec<&'static AnyCodec>,
    options: &Options,
    vulkan: &Vulkan,
    device: &Arc<Device>,
) -> Result<Option<Plain>> {
    let options = imprecise::Options {
        count: options.count.min(PLAIN_COUNT),
        seeds: vec![options.seed],
        models: vec![Model::Own],
        all_codes_up_to: 0,
    };
    let mut all = Plain::default();
    let open = || vulkan.gpus(device, &[Edition::Plain]);
    imprecise::run(formats, &options, open, &mut |_| {}, &mut |row: imprecise::Row| {
        let bounds = Bounds::of(unitvec_catalogue::find(&row.id)?);
        all.objections.extend(row.objections(&bounds).iter().map(|text| format!("{}: {text}", row.id)));
        for outcome in row.models.values() {
            all.codes_differ += outcome.codes_differ + outcome.special_differ;
            all.elements_differ += outcome.elements_differ;
        }
        Ok::<(), unitvec_host::Error>(())
    })?;
    Ok(Some(all))
}

#[cfg(not(feature = "lab"))]
fn plain(_: Vec<&'static AnyCodec>, _: &Options, _: &Vulkan, _: &Arc<Device>) -> Result<Option<Plain>> {
    Ok(None)
}

fn normals(meshes: &[PathBuf]) -> Result<Vec<[f32; 3]>> {
    if meshes.is_empty() {
        return Ok(mesh::read_obj(Path::new("bunny.obj"), mesh::BUNNY)?.normals);
    }
    let mut normals = Vec::new();
    for path in meshes {
        normals.extend(Input::open(path)?.parse(mesh::parse, Reach::Folder)?.normals);
    }
    Ok(normals)
}

fn legend(device: &DeviceInfo, options: &Options, rounding: &Roundings, arithmetic: &Arithmetic) -> String {
    let sums = if is_nearest(rounding) { "rounded to nearest" } else { "not rounded to nearest" };
    format!(
        "device: {} ({:?}), driver {}, Vulkan {}\n\
         input of a codec: {} random vectors (seed {}), {} mesh normals, special vectors; {}\n\
         sums, by which encoders round: {sums}\n\
         {arithmetic}\n\
         diff: codes and vectors that differ from the CPU's in any bit\n\n",
        device.name,
        device.kind,
        device.driver,
        device.api_version,
        options.count,
        options.seed,
        options.normals.len(),
        codes_covered(options.all_codes_up_to, options.count),
    )
}

fn columns() -> Vec<Column> {
    let kinds = in_one_line(BackendKind::of_devices().map(|kind| kind.to_string()));
    vec![
        left("codec", 20),
        right("bits", 4),
        right("mean\ndegrees", 10),
        right("max\ndegrees", 10),
        right(&format!("diff\n{kinds}"), kinds.len()).apart(),
    ]
}

/// What is said of each backend, side by side.
fn in_one_line(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(" ")
}

/// Which codes are decoded, in words.
fn codes_covered(all_up_to: u32, count: usize) -> String {
    format!("all codes of up to {all_up_to} bits, {count} random codes of more")
}

fn lines(screen: &Screen, row: &Row) -> String {
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
    let mut text = screen.line(&[&row.id, &row.bits, &mean, &max, &differing]);
    if let (Some(mean), Some(max)) = (row.tangent_mean_deg, row.tangent_max_deg) {
        let [mean, max] = errors(mean, max);
        text += &screen.line(&[&"  its tangents", &"", &mean, &max]);
    }
    text + &row.examples.iter().map(|example| screen.note(example)).collect::<String>()
}

/// The names of what was compared.
pub fn compared_with_cpu(kinds: impl Iterator<Item = BackendKind>, with_glsl: bool) -> String {
    let kinds: String = kinds.map(|kind| format!(", {kind}")).collect();
    let without = if with_glsl {
        ""
    } else {
        " (no GLSL compiler: `cargo install --path host/program --features glsl`)"
    };
    format!("cpu{kinds}{without}")
}

/// What agrees, or why the device fails.
fn outcome(report: &Report) -> Result<String, String> {
    let Summary { codecs, vectors, codes, .. } = report.summary();
    if report.agreed {
        let plain = match &report.plain {
            None => "; plain functions were not run (this build lacks the feature `lab`)".to_owned(),
            Some(Plain { codes_differ: 0, elements_differ: 0, .. }) => "; plain functions too".to_owned(),
            Some(Plain { codes_differ, elements_differ, .. }) => format!(
                "; plain functions keep within their bounds on this device ({codes_differ} codes and {elements_differ} vectors \
                 differ)"
            ),
        };
        return Ok(format!(
            "{} agree to the bit: {}, {vectors} vectors encoded, {codes} codes decoded ({}){plain}",
            compared_with_cpu(BackendKind::of_devices(), report.glsl_compared),
            counted(codecs as u64, "codecs"),
            codes_covered(report.all_codes_up_to, report.random_directions),
        ));
    }
    if report.rounding.values().any(|rounding| *rounding == Rounding::Down) {
        return Err("this device rounds sums down, and encoders need them rounded to nearest: codes are up to a step off"
            .to_owned());
    }
    if let Some(objection) = report.arithmetic.objection() {
        return Err(objection);
    }
    let failed: Vec<&str> =
        report.rows.iter().filter(|row| !row.agrees()).map(|row| row.id.as_str()).collect();
    let differences = match failed.as_slice() {
        [] => "no codec differs".to_owned(),
        failed => format!("differences in {}", failed.join(", ")),
    };
    let rounding = match is_nearest(&report.rounding) {
        true => "",
        false => "; sums are not rounded to nearest",
    };
    let plain = report.plain.iter().flat_map(|plain| &plain.objections).next();
    let plain = plain.map_or_else(String::new, |objection| format!("; plain functions: {objection}"));
    Err(differences + rounding + &plain)
}
