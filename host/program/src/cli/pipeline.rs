//! `unitvec conform pipeline`.

use super::conform::Inputs;
use super::run::{Live, PERCENT, close};
use super::table::{Layout, left, right, wrapped};
use super::{print, status_after_validation, to_json};
use clap::Args;
use std::fmt::Write;
use std::process::ExitCode;
use unitvec_host::{Error, Result};
use unitvec_render::conform;
use unitvec_render::conform::{Options, Projected, Report, Row, Traits};
use unitvec_run::backend::BackendKind;
use unitvec_vulkan::DeviceInfo;

/// Random directions of a codec: besides the special ones, of which there are more.
const COUNT: u64 = 1 << 15;

/// The most points that are drawn at once: what every device's attachments have room for.
const MAX_COUNT: u64 = 1 << 20;

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    inputs: Inputs,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let Inputs { count, seed, run, .. } = &arguments.inputs;
    run.vulkan.refuse_modules()?;
    let count = count.unwrap_or(COUNT);
    if count > MAX_COUNT {
        return Err(Error::Usage(format!("--count of `pipeline` is at most {MAX_COUNT}, not {count}")));
    }
    let options = Options { count: count as usize, seed: *seed };
    let formats = arguments.inputs.formats()?;
    let device = run.vulkan.device_for_graphics()?;
    let columns = run.wide.columns()?;
    let table = table(columns);
    let traits = conform::traits(&device, &options)?;
    if !run.to_stdout() {
        print(&(heading(device.info(), &options, &traits, columns) + &table.heading()))?;
    }
    // A choice of codecs leaves projections out.
    let pairs = if run.codec.is_empty() { conform::pairs() } else { Vec::new() };
    let live = Live::new((formats.len() + pairs.len()) as u64, PERCENT, run.to_stdout());
    let (mut rows, mut projections) = (Vec::new(), Vec::new());
    let show = |row: Row, rows: &mut Vec<Row>| {
        live.advance(1);
        live.print(&row.id, || lines(&table, &row, columns))?;
        rows.push(row);
        Ok::<(), Error>(())
    };
    conform::run(formats, &options, &device, &traits, &mut |row| show(row, &mut rows))?;
    if !pairs.is_empty() {
        live.print("", || "\n".to_owned() + &wrapped(PROJECTIONS, "", columns))?;
    }
    conform::run_pairs(pairs, &options, &device, &traits, &mut |row| show(row, &mut projections))?;
    live.finish();
    let (device, messages) = close(device);

    let report = Report::new(&device, &options, traits, rows, projections);
    if let Some(path) = &run.json {
        unitvec_files::write_file(path, to_json(&report).as_bytes())?;
    }
    if !run.to_stdout() {
        print(&wrapped(&verdict(&report, messages.len()), "", columns))?;
    }
    Ok(status_after_validation(&messages, report.agreed))
}

fn heading(device: &DeviceInfo, options: &Options, traits: &Traits, columns: Option<usize>) -> String {
    let conversions: String =
        traits.conversions.iter().map(|one| format!("{}: {}\n", one.name(), one.in_words())).collect();
    let text = format!(
        "device: {} ({:?}), driver {}, Vulkan {}\n\
         input of a codec: {} random vectors (seed {}), special vectors; all codes of up to 16 bits, random and special codes \
         of more; the normals of the rendered scene\n\
         {conversions}\
         from vertex to fragment shader: {} of {} vectors changed beyond what Vulkan allows ({} lost a denormal or an infinity)\n\
         diff: texels and vertices that differ from the CPU in any bit\n\
         projected: codes that differ, and by how many steps at most, where the hardware rounds the codec's projection instead \
         of the encoder\n\n",
        device.name,
        device.kind,
        device.driver,
        device.api_version,
        options.count,
        options.seed,
        traits.changed,
        traits.interpolated,
        traits.flushed,
    );
    wrapped(&text, "    ", columns)
}

/// What stands over the rows of projections.
const PROJECTIONS: &str = "projections that the hardware rounds; diff: texels that are not the CPU's numbers, rounded as the \
     device does, and normals that are not what the CPU makes of the numbers fetched\n";

/// As wide as the longest name of a format in it.
const FORMAT: usize = 24;

fn table(columns: Option<usize>) -> Layout {
    let kinds: Vec<String> = conform::sources().map(|kind| format!("{kind:>5}")).collect();
    let kinds = kinds.join(" ");
    Layout::new(
        vec![
            left("codec", 20),
            right("bits", 4),
            left("attachment", FORMAT).apart(),
            right(&format!("diff\n{kinds}"), kinds.len()).apart(),
            right("projected", 10).apart(),
        ],
        columns,
    )
}

fn lines(table: &Layout, row: &Row, columns: Option<usize>) -> String {
    let differing: Vec<String> =
        conform::sources().map(|kind| format!("{:>5}", row.differing(kind))).collect();
    let texel = row.texel.trim_end_matches("_PACK32");
    let mut text = table.line(&[&row.id, &row.bits, &texel, &differing.join(" "), &projected(row)]);
    let notes = row.unsupported.iter().map(|what| format!("not here: {what}"));
    for note in notes.chain(row.examples.iter().cloned()) {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}", wrapped(&format!("    {note}"), "        ", columns));
    }
    text
}

/// The differences of the sources, which are the same as a rule.
fn projected(row: &Row) -> String {
    let one = |projected: &Projected| match projected.unexplained {
        0 if projected.differing == 0 => "0".to_owned(),
        0 => format!("{} by {}", projected.differing, projected.max_steps),
        unexplained => format!("{unexplained} wrong"),
    };
    let mut counts: Vec<String> = row.projected.values().map(one).collect();
    counts.dedup();
    counts.join(" ")
}

fn verdict(report: &Report, validation_messages: usize) -> String {
    let fail = |reason: String| format!("\nconform pipeline: FAIL: {reason}\n");
    if validation_messages > 0 {
        return fail(format!("{validation_messages} messages of the validation layer"));
    }
    let rows = || report.rows.iter().chain(&report.projections);
    let failed: Vec<&str> = rows().filter(|row| !row.agrees()).map(|row| row.id.as_str()).collect();
    if !failed.is_empty() {
        return fail(format!("differences in {}", failed.join(", ")));
    }
    if !report.agreed {
        return fail("this device changes normals between vertex and fragment shader".to_owned());
    }
    let sources: Vec<String> = conform::sources().map(|kind: BackendKind| kind.to_string()).collect();
    let without =
        if report.glsl_compared { "" } else { " (this build has no GLSL compiler: `--features glsl`)" };
    let compared: u64 = rows().map(Row::compared).sum();
    let projections = match report.projections.len() {
        0 => String::new(),
        count => format!(", {count} pairs of projection and format"),
    };
    format!(
        "\nconform pipeline: PASS: cpu, {}{without} agree to the bit: {} codecs{projections}, {compared} texels and \
         vertices\n",
        sources.join(", "),
        report.rows.len(),
    )
}
