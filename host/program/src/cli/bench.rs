//! `unitvec bench`.

use super::run::{CODECS_LEFT, Live, Outputs, Run, Screen};
use super::table::{Column, left, right};
use super::{counted, examples, number};
use clap::{Args, Subcommand};
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue as catalogue;
use unitvec_catalogue::Operation;
use unitvec_choose::costs::{Report, Row, Source, Times, find_row};
use unitvec_host::Result;
use unitvec_lab::bench::{Bench, Options, survey_ns};
use unitvec_vulkan::{DeviceInfo, DeviceKind};

#[derive(Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct Arguments {
    #[command(subcommand)]
    mode: Option<Mode>,
    #[command(flatten)]
    on_device: OnDevice,
}

#[derive(Subcommand)]
enum Mode {
    /// Run the kernels on a device; `unitvec bench` alone does the same. Needs a build with `--features glsl`.
    #[command(after_help = examples::of("bench device"))]
    Device(OnDevice),
    /// Count the instructions that a GPU's compiler makes of the kernels; run nothing, so that no GPU is needed. Needs a build
    /// with `--features glsl`.
    #[command(after_help = examples::of("bench compiler"))]
    Compiler(super::compiler::Arguments),
}

/// Which codecs, and where the outcome goes.
#[derive(Args)]
pub struct Reported {
    #[command(flatten)]
    pub outputs: Outputs,
    /// Write a table in Markdown as well.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    #[command(flatten)]
    pub run: Run,
}

impl Reported {
    /// Writes the outcome; `table` has titles and rows.
    pub fn write(&self, table: &[Vec<String>], json: &str, markdown: &str) -> Result<()> {
        self.outputs.write(table)?;
        if let Some(path) = &self.markdown {
            unitvec_files::write_file(path, markdown.as_bytes())?;
        }
        self.run.json.write_text(json)
    }
}

#[derive(Args)]
struct OnDevice {
    /// Vectors in a dispatch.
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u32).range(1..=4_000_000))]
    count: u32,
    /// Dispatches of each kernel that measures arithmetic, of which the median counts; the others run twice as often.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    samples: u32,
    /// Folder of the kernels from Rust that measure arithmetic: `cargo xtask spirv --cost` builds target/spirv-cost in the
    /// repository. They run as they are: only their framing is checked. Without it only kernels from GLSL are measured.
    #[arg(long, value_name = "FOLDER")]
    cost_kernels: Option<PathBuf>,
    #[command(flatten)]
    reported: Reported,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    match &arguments.mode {
        None => run_on_device(&arguments.on_device),
        Some(Mode::Device(arguments)) => run_on_device(arguments),
        Some(Mode::Compiler(arguments)) => super::compiler::run(arguments),
    }
}

fn run_on_device(arguments: &OnDevice) -> Result<ExitCode> {
    let (reported, run) = (&arguments.reported, &arguments.reported.run);
    let is_quiet = reported.outputs.take_stdout(&run.json)?;
    let chosen = run.formats()?;
    let device = run.vulkan.device()?;
    let options = Options {
        count: arguments.count as usize,
        samples: arguments.samples as usize,
        throughput_samples: 2 * arguments.samples as usize,
        cost_kernels: arguments.cost_kernels.clone(),
    };
    let live = Live::new(Some(chosen.len() as u64), CODECS_LEFT, is_quiet);
    let mut screen = Screen::new(columns(), &run.wide, live)?;
    let legend = legend(device.info(), &options);
    let mut bench = Bench::new(&device, run.vulkan.modules()?, options)?;
    screen.head(&legend)?;
    let mut rows = Vec::new();
    for format in chosen {
        let of_codec = bench.measure(format)?;
        screen.row(format.id, || lines(&screen, format.id, &of_codec))?;
        screen.live.advance(1);
        rows.extend(of_codec);
    }
    let report = bench.report(rows);
    drop(bench);
    screen.close(device);
    reported.write(&table(&report), &report.to_json(), &markdown(&report))?;
    screen.end(&summary(&report))
}

fn legend(device: &DeviceInfo, options: &Options) -> String {
    let warning = match device.kind {
        DeviceKind::Software => {
            "warning: this device is a CPU: its ratios say little of GPUs, and other programs disturb it\n"
        }
        _ => "",
    };
    let unit = match options.cost_kernels {
        Some(_) => "/ oct32 is SPIR-V from Rust",
        None => {
            "those of SPIR-V from Rust are left out, and / oct32 is from GLSL: `cargo xtask spirv --cost` builds what \
             --cost-kernels takes"
        }
    };
    format!(
        "device: {} ({:?}), driver {}, Vulkan {}\n{warning}\
         arithmetic: nanoseconds a vector, median of {} dispatches of {} vectors, 100 times each, less a baseline; +- is \
         largest less smallest; ratios are medians of those of dispatches side by side; {unit}; \
         survey is its GTX 680\n\
         throughput: of the shipped kernels, 10^6 vectors a second, and of a copy of as many bytes\n\n",
        device.name, device.kind, device.driver, device.api_version, options.samples, options.count,
    )
}

fn columns() -> Vec<Column> {
    vec![
        left("codec", 20),
        left("", 6),
        right("ns\nrust", 8),
        right("\n+-", 7).rank(7),
        right("ns\nglsl", 8).rank(3),
        right("\n+-", 7).rank(8),
        right("rust /\nglsl", 6).rank(2),
        right("\n/ oct32", 7),
        right("survey\nns", 7).rank(5),
        right("10^6/s\nrust", 8).apart(),
        right("10^6/s\nglsl", 8).rank(4),
        right("% of\ncopy", 8).rank(1),
        right("by\ntable", 7).rank(6),
    ]
}

/// The times of a codec's kernel.
fn find<'a>(rows: &'a [Row], id: &str, operation: Operation, source: Source) -> Option<&'a Times> {
    find_row(rows, id, operation, source)?.times.as_deref()
}

fn lines(screen: &Screen, id: &str, rows: &[Row]) -> String {
    let mut text = String::new();
    for operation in Operation::ALL {
        let of = |source| find(rows, id, operation, source);
        let (Some(rust), Some(glsl)) = (of(Source::Rust), of(Source::Glsl)) else {
            continue;
        };
        let millions = |times: &Times| times.vectors_per_s.map(|speed| speed / 1e6);
        text += &screen.line(&[
            &id,
            &operation.to_string(),
            &fitting(rust.ns_per_vector, 4, 8),
            &fitting(rust.spread_ns, 4, 7),
            &fitting(glsl.ns_per_vector, 4, 8),
            &fitting(glsl.spread_ns, 4, 7),
            &fitting(rust.ratio_to_glsl, 3, 6),
            &fitting(rust.ratio_to_oct32.or(glsl.ratio_to_oct32), 2, 7),
            &fitting(survey_ns(id, operation), 4, 7),
            &fitting(millions(rust), 1, 8),
            &fitting(millions(glsl), 1, 8),
            &number(rust.of_copy(), 0),
            &fitting(of(Source::Table).and_then(millions), 1, 7),
        ]);
    }
    text
}

/// The rows under titles.
fn table(report: &Report) -> Vec<Vec<String>> {
    let titles = "id,operation,source,ns_per_vector,spread_ns,ratio_to_oct32,ratio_to_glsl,vectors_per_s,bytes_per_s,\
        copy_bytes_per_s";
    let titles = titles.split(',').map(str::to_owned).collect();
    let rows = report.rows.iter().filter_map(|row| {
        let times = row.times.as_deref()?;
        let Times { ns_per_vector, spread_ns, ratio_to_oct32, ratio_to_glsl, .. } = *times;
        let Times { vectors_per_s, bytes_per_s, copy_bytes_per_s, .. } = *times;
        let speeds = [vectors_per_s, bytes_per_s, copy_bytes_per_s];
        let figures = [ns_per_vector, spread_ns, ratio_to_oct32, ratio_to_glsl].into_iter().chain(speeds);
        let figures = figures.map(|figure| figure.map_or_else(String::new, |figure| figure.to_string()));
        let names = [row.id.clone(), row.operation.to_string(), row.source.to_string()];
        Some(names.into_iter().chain(figures).collect())
    });
    std::iter::once(titles).chain(rows).collect()
}

/// The arithmetic of both operations as multiples of `oct32`'s, and the kernels' part of the copy's speed.
fn markdown(report: &Report) -> String {
    let (device, count) = (&report.device, report.count.unwrap_or_default());
    let repetitions = report.repetitions.unwrap_or_default();
    let mut text = format!(
        "{}, {}, Vulkan {}; {} vectors, {} times each.\n\n\
         | codec | bits | bound of the error, degrees | encode / oct32 | decode / oct32 | encode: rust / glsl | \
         decode: rust / glsl | encode, % of copy | decode, % of copy |\n|---|---|---|---|---|---|---|---|---|\n",
        device.name, device.driver, device.api_version, count, repetitions
    );
    let source = report.main_source();
    for id in codecs(report) {
        let of = |operation| {
            let rust = find(&report.rows, id, operation, Source::Rust)?;
            Some((rust, find(&report.rows, id, operation, source)?.ratio_to_oct32))
        };
        let [Some((encode, to_encode)), Some((decode, to_decode))] = Operation::ALL.map(of) else { continue };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "| `{id}` | {} | {} | {} | {} | {} | {} | {} | {} |",
            catalogue::find(id).map_or(0, |codec| codec.bits),
            bound(id),
            number(to_encode, 1),
            number(to_decode, 1),
            number(encode.ratio_to_glsl, 2),
            number(decode.ratio_to_glsl, 2),
            number(encode.of_copy(), 0),
            number(decode.of_copy(), 0),
        );
    }
    text
}

fn codecs(report: &Report) -> impl Iterator<Item = &str> {
    let is_first = |row: &&Row| (row.source, row.operation) == (Source::Rust, Operation::Encode);
    report.rows.iter().filter(is_first).map(|row| row.id.as_str())
}

/// Of a frame, its normal's and its tangent's.
fn bound(id: &str) -> String {
    let bounds = catalogue::find(id).map_or(&[][..], |codec| codec.max_errors_deg);
    let texts: Vec<String> = bounds.iter().map(|bound| format!("{bound:.3e}")).collect();
    if texts.is_empty() { "-".to_owned() } else { texts.join(", ") }
}

/// A number with fewer digits where it would be wider than its column, as the noise of small samples can be.
fn fitting(value: Option<f64>, digits: usize, width: usize) -> String {
    let texts = (0..=digits).rev().map(|digits| number(value, digits));
    let short = value.map(|value| format!("{value:.0e}"));
    texts.chain(short).find(|text| text.len() <= width).unwrap_or_else(|| "-".to_owned())
}

/// Where SPIR-V from Rust costs more than that from GLSL.
fn summary(report: &Report) -> String {
    let ratios = || report.rows.iter().filter_map(|row| Some((row, report.ratio_to_glsl(row)?)));
    let slower: Vec<String> = ratios()
        .filter(|(_, ratio)| *ratio > 1.05)
        .map(|(row, ratio)| format!("{} {} {ratio:.2}", row.id, row.operation))
        .collect();
    let codecs = counted(codecs(report).count() as u64, "codecs");
    if ratios().next().is_none() {
        return format!("\nbench: {codecs}\n");
    }
    let verdict = if slower.is_empty() { "none".to_owned() } else { slower.join(", ") };
    format!("\nbench: {codecs}; arithmetic of SPIR-V from Rust above 1.05 of that from GLSL: {verdict}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number loses decimals before it is wider than its column.
    #[test]
    fn numbers_fit_their_columns() {
        for (value, digits, width, expected) in [
            (Some(1.9759), 4, 8, "1.9759"),
            (Some(-100.5884), 4, 8, "-100.588"),
            (Some(-50.908), 3, 6, "-50.91"),
            (Some(99999.96), 1, 7, "100000"),
            (Some(-123456.7), 3, 6, "-1e5"),
            (None, 3, 6, "-"),
        ] {
            assert_eq!(fitting(value, digits, width), expected);
        }
    }
}
