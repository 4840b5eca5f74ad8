//! `unitvec conform imprecise`.

use super::conform::{Inputs, all_codes_up_to};
use super::run::{Live, PERCENT, close};
use super::table::{Layout, left, right, wrapped};
use super::{print, reports_to_stdout, status_after_validation, to_csv, to_json};
use clap::Args;
use serde::Serialize;
use std::fmt::Display;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::find;
use unitvec_host::Result;
use unitvec_lab::imprecise;
use unitvec_lab::imprecise::{Bounds, Gpus, Model, Options, Row, Summary};
use unitvec_run::conform::Rounding;
use unitvec_vulkan::DeviceInfo;

/// Random elements and codes of a codec and seed.
const COUNT: u64 = 1 << 16;

#[derive(Args)]
pub struct Arguments {
    /// A kind of device; may be given again. All of them if not given.
    #[arg(long, value_name = "MODEL")]
    model: Vec<Model>,
    /// Number of seeds, from --seed on; each is a run of its own.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: u64,
    /// Decode all codes of up to 24 bits instead of up to 16. Takes several times as long.
    #[arg(long)]
    exhaustive: bool,
    /// Write the table as CSV as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    inputs: Inputs,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let Inputs { count, seed, run, .. } = &arguments.inputs;
    let options = Options {
        count: count.unwrap_or(COUNT) as usize,
        seeds: (0..arguments.seeds).map(|index| seed.wrapping_add(index)).collect(),
        models: if arguments.model.is_empty() { Model::ALL.to_vec() } else { arguments.model.clone() },
        all_codes_up_to: all_codes_up_to(arguments.exhaustive),
    };
    let formats = arguments.inputs.formats()?;
    let device = run.vulkan.device()?;
    let open = || run.vulkan.gpus(&device);
    let truncation_is_seen = truncation_is_seen(&options, open()?)?;

    let to_stdout = reports_to_stdout(run.json.as_deref(), arguments.csv.as_deref())?;
    let columns = run.wide.columns()?;
    let table = table(columns);
    if !to_stdout {
        print(&(heading(device.info(), &options, columns) + &table.heading()))?;
    }
    let work = formats.iter().map(|format| options.work(format)).sum();
    let live = Live::new(work, PERCENT, to_stdout);
    let (mut lines, mut rows, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    imprecise::run(formats, &options, open, &mut |done| live.advance(done), &mut |row| {
        let bounds = Bounds::of(find(&row.id)?);
        let objections = row.objections(&bounds);
        let line = Summary::new(&row, &bounds);
        live.print(&row.id, || text(&line, &table, &objections, columns))?;
        if !objections.is_empty() {
            failed.push(row.id.clone());
        }
        lines.push(line);
        rows.push(row);
        Ok(())
    })?;
    live.finish();
    let (device, messages) = close(device);

    let agreed = failed.is_empty() && truncation_is_seen;
    let verdict = verdict(&failed, truncation_is_seen, &rows, messages.len());
    let report = Report { device, options, agreed, rows };
    if let Some(path) = &run.json {
        unitvec_files::write_file(path, to_json(&report).as_bytes())?;
    }
    if let Some(path) = &arguments.csv {
        unitvec_files::write_file(path, &to_csv(path, &lines)?)?;
    }
    if !to_stdout {
        print(&wrapped(&verdict, "", columns))?;
    }
    Ok(status_after_validation(&messages, agreed))
}

/// The whole report.
#[derive(Serialize)]
struct Report {
    device: DeviceInfo,
    options: Options,
    agreed: bool,
    rows: Vec<Row>,
}

/// True where `conform` would refuse the devices that truncate sums, if there are any.
fn truncation_is_seen(options: &Options, mut gpus: Gpus) -> Result<bool> {
    for model in options.models.iter().filter(|model| !model.rounds_to_nearest()) {
        for gpu in gpus.values_mut() {
            gpu.rewrite_with(Some(model.rewrite(0)));
            if Rounding::of(gpu)? == Rounding::Nearest {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// A codec's line of the table, and what speaks against it.
fn text(line: &Summary, table: &Layout, objections: &[String], columns: Option<usize>) -> String {
    let most = line.codes_differ_at_most.map_or_else(|| "-".to_owned(), |most| most.to_string());
    let [ulp, ulp_most] = [line.component_ulp, line.component_ulp_at_most].map(|ulp| format!("{ulp:.0}"));
    let [angle, angle_most] = [line.angle_deg, line.angle_deg_at_most].map(|angle| format!("{angle:.1e}"));
    let cells: [&dyn Display; 8] =
        [&line.id, &line.codes_differ, &most, &ulp, &ulp_most, &angle, &angle_most, &line.codes_lost];
    let objections = objections.iter().map(|text| wrapped(&format!("    {text}\n"), "        ", columns));
    table.line(&cells) + &objections.collect::<String>()
}

fn table(columns: Option<usize>) -> Layout {
    Layout::new(
        vec![
            left("codec", 20),
            right("codes that\ndiffer", 10),
            right("at\nmost", 8),
            right("components\n2^-24", 10).apart(),
            right("at\nmost", 6),
            right("angle\ndegrees", 7).apart(),
            right("at\nmost", 7),
            right("codes\nlost", 6).apart(),
        ],
        columns,
    )
}

fn heading(device: &DeviceInfo, options: &Options, columns: Option<usize>) -> String {
    let models: Vec<String> = options.models.iter().map(Model::to_string).collect();
    let text = format!(
        "device: {}, driver {}, rewritten kernels of models {}\n\
         input of a codec: {} seeds from {}, each {} random vectors; all codes of up to {} bits, as many random codes of more\n\
         codes that differ from the CPU's, components and vectors decoded: the worst of the models; codes lost: those that do \
         not come back from the worst pair of devices, one that decodes and one that encodes\n\n",
        device.name,
        device.driver,
        models.join(", "),
        options.seeds.len(),
        options.seeds.first().copied().unwrap_or(0),
        options.count,
        options.all_codes_up_to,
    );
    wrapped(&text, "    ", columns)
}

fn verdict(failed: &[String], truncation_is_seen: bool, rows: &[Row], messages: usize) -> String {
    if messages > 0 {
        return format!("\nconform imprecise: FAIL: {messages} messages of the validation layer\n");
    }
    if !truncation_is_seen {
        return "\nconform imprecise: FAIL: a device that truncates sums passes for one that rounds them\n"
            .to_owned();
    }
    if failed.is_empty() {
        let elements: u64 = rows.iter().map(|row| row.elements).sum();
        let codes: u64 = rows.iter().map(|row| row.codes).sum();
        return format!(
            "\nconform imprecise: PASS: all is within its bounds, and comes back where that is promised: {} codecs, \
             {elements} elements and {codes} codes on each device\n",
            rows.len()
        );
    }
    format!("\nconform imprecise: FAIL: {}\n", failed.join(", "))
}
