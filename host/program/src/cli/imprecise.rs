//! `unitvec conform imprecise`.

use super::conform::{Inputs, all_codes_up_to};
use super::counted;
use super::run::{Live, Outputs, PERCENT, Screen};
use super::table::{Column, left, right};
use clap::Args;
use serde::Serialize;
use std::fmt::Display;
use std::process::ExitCode;
use unitvec_catalogue::find;
use unitvec_host::Result;
use unitvec_lab::imprecise;
use unitvec_lab::imprecise::{Bounds, Gpus, Model, Options, Row, Summary};
use unitvec_run::conform::Rounding;
use unitvec_run::shader::Edition;
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
    #[command(flatten)]
    outputs: Outputs,
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
    let is_quiet = arguments.outputs.take_stdout(&run.json)?;
    let formats = arguments.inputs.formats()?;
    let work = formats.iter().map(|format| options.work(format)).sum();
    let mut screen = Screen::new(columns(), &run.wide, Live::new(Some(work), PERCENT, is_quiet))?;
    let device = run.vulkan.device()?;
    let open = || run.vulkan.gpus(&device, &[Edition::Plain, Edition::Exact]);
    let truncation_is_seen = truncation_is_seen(&options, open()?)?;

    screen.head(&legend(device.info(), &options))?;
    let (mut lines, mut rows, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    imprecise::run(formats, &options, open, &mut |done| screen.live.advance(done), &mut |row| {
        let bounds = Bounds::of(find(&row.id)?);
        let objections = row.objections(&bounds);
        let line = Summary::new(&row, &bounds);
        screen.row(&row.id, || text(&screen, &line, &objections))?;
        if !objections.is_empty() {
            failed.push(row.id.clone());
        }
        lines.push(line);
        rows.push(row);
        Ok(())
    })?;
    let device = screen.close(device);

    let outcome = outcome(&failed, truncation_is_seen, &rows);
    arguments.outputs.write(&lines)?;
    run.json.write(&Report { device, options, agreed: outcome.is_ok(), rows })?;
    screen.verdict("conform imprecise", outcome)
}

/// Devices that round as loosely as Vulkan allows, beside their bounds.
#[derive(Serialize, schemars::JsonSchema)]
pub struct Report {
    /// Device that ran the rewritten kernels.
    device: DeviceInfo,
    /// The extent of the run.
    options: Options,
    /// True if all is within its bounds, and `conform` would refuse a device that truncates sums.
    agreed: bool,
    /// One row a codec.
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
fn text(screen: &Screen, line: &Summary, objections: &[String]) -> String {
    let most = line.codes_differ_at_most.map_or_else(|| "-".to_owned(), |most| most.to_string());
    let [ulp, ulp_most] = [line.component_ulp, line.component_ulp_at_most].map(|ulp| format!("{ulp:.0}"));
    let [angle, angle_most] = [line.angle_deg, line.angle_deg_at_most].map(|angle| format!("{angle:.1e}"));
    let cells: [&dyn Display; 8] =
        [&line.id, &line.codes_differ, &most, &ulp, &ulp_most, &angle, &angle_most, &line.codes_lost];
    screen.line(&cells) + &objections.iter().map(|text| screen.note(text)).collect::<String>()
}

fn columns() -> Vec<Column> {
    vec![
        left("codec", 20),
        right("codes that\ndiffer", 10),
        right("at\nmost", 8),
        right("components\n2^-24", 10).apart(),
        right("at\nmost", 6),
        right("angle\ndegrees", 7).apart(),
        right("at\nmost", 7),
        right("codes\nlost", 6).apart(),
    ]
}

fn legend(device: &DeviceInfo, options: &Options) -> String {
    let models: Vec<String> = options.models.iter().map(Model::to_string).collect();
    format!(
        "device: {}, driver {}, rewritten kernels of models {}\n\
         input of a codec: {} from {}, each {} random vectors; all codes of up to {} bits, as many random codes of more\n\
         codes that differ from the CPU's, components and vectors decoded: the worst of the models; codes lost: those that do \
         not come back from the worst pair of devices, one that decodes and one that encodes\n\n",
        device.name,
        device.driver,
        models.join(", "),
        counted(options.seeds.len() as u64, "seeds"),
        options.seeds.first().copied().unwrap_or(0),
        options.count,
        options.all_codes_up_to,
    )
}

/// What all devices agree in, or why they fail.
fn outcome(failed: &[String], truncation_is_seen: bool, rows: &[Row]) -> Result<String, String> {
    if !truncation_is_seen {
        return Err("a device that truncates sums passes for one that rounds them".to_owned());
    }
    if !failed.is_empty() {
        return Err(failed.join(", "));
    }
    let elements: u64 = rows.iter().map(|row| row.elements).sum();
    let codes: u64 = rows.iter().map(|row| row.codes).sum();
    Ok(format!(
        "all is within its bounds, and comes back where that is promised: {}, {elements} elements and {codes} codes on each \
         device",
        counted(rows.len() as u64, "codecs")
    ))
}
