//! `unitvec conform pipeline`.

use super::conform::{Inputs, compared_with_cpu};
use super::counted;
use super::run::{Live, PERCENT, Screen};
use super::table::{Column, left, right};
use clap::Args;
use std::process::ExitCode;
use unitvec_catalogue::{Element, directions};
use unitvec_host::{Error, Result};
use unitvec_render::conform;
use unitvec_render::conform::{Options, Projected, Report, Row, Traits};
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
    let formats = match run.codec.is_empty() {
        true => directions().iter().collect(),
        false => arguments.inputs.formats()?,
    };
    if let Some(format) = formats.iter().find(|format| format.element == Element::Rotation) {
        let words =
            format!("{} stores rotations, of which nothing is drawn; choose a codec of normals", format.id);
        return Err(Error::Usage(words));
    }
    // A choice of codecs leaves projections out.
    let pairs = if run.codec.is_empty() { conform::pairs() } else { Vec::new() };
    let live = Live::new(Some((formats.len() + pairs.len()) as u64), PERCENT, run.json.is_to_stdout());
    let mut screen = Screen::new(columns(), &run.wide, live)?;
    let device = run.vulkan.device_for_graphics()?;
    let traits = conform::traits(&device, &options)?;
    screen.head(&legend(device.info(), &options, &traits))?;
    let (mut rows, mut projections) = (Vec::new(), Vec::new());
    let show = |row: Row, rows: &mut Vec<Row>| {
        screen.live.advance(1);
        screen.row(&row.id, || lines(&screen, &row))?;
        rows.push(row);
        Ok::<(), Error>(())
    };
    conform::run(formats, &options, &device, &traits, &mut |row| show(row, &mut rows))?;
    if !pairs.is_empty() {
        screen.say(PROJECTIONS, "")?;
    }
    conform::run_pairs(pairs, &options, &device, &traits, &mut |row| show(row, &mut projections))?;
    let device = screen.close(device);

    let report = Report::new(&device, &options, traits, rows, projections);
    run.json.write(&report)?;
    screen.verdict("conform pipeline", outcome(&report))
}

fn legend(device: &DeviceInfo, options: &Options, traits: &Traits) -> String {
    let conversions: String =
        traits.conversions.iter().map(|one| format!("{}: {}\n", one.name(), one.in_words())).collect();
    format!(
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
    )
}

/// What stands over the rows of projections.
const PROJECTIONS: &str = "\nprojections that the hardware rounds; diff: texels that are not the CPU's numbers, rounded as the \
     device does, and normals that are not what the CPU makes of the numbers fetched\n";

/// As wide as the longest name of a format in it.
const FORMAT: usize = 24;

fn columns() -> Vec<Column> {
    let kinds: Vec<String> = conform::sources().map(|kind| format!("{kind:>5}")).collect();
    let kinds = kinds.join(" ");
    vec![
        left("codec", 20),
        right("bits", 4),
        left("attachment", FORMAT).apart(),
        right(&format!("diff\n{kinds}"), kinds.len()).apart(),
        right("projected", 10).apart(),
    ]
}

fn lines(screen: &Screen, row: &Row) -> String {
    let differing: Vec<String> =
        conform::sources().map(|kind| format!("{:>5}", row.differing(kind))).collect();
    let texel = row.texel.trim_end_matches("_PACK32");
    let text = screen.line(&[&row.id, &row.bits, &texel, &differing.join(" "), &projected(row)]);
    let notes = row.unsupported.iter().map(|what| format!("not here: {what}"));
    text + &notes.chain(row.examples.iter().cloned()).map(|note| screen.note(&note)).collect::<String>()
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

/// What agrees, or why the device fails.
fn outcome(report: &Report) -> Result<String, String> {
    let rows = || report.rows.iter().chain(&report.projections);
    let failed: Vec<&str> = rows().filter(|row| !row.agrees()).map(|row| row.id.as_str()).collect();
    if !failed.is_empty() {
        return Err(format!("differences in {}", failed.join(", ")));
    }
    if !report.agreed {
        return Err("this device changes normals between vertex and fragment shader".to_owned());
    }
    let compared: u64 = rows().map(Row::compared).sum();
    let projections = match report.projections.len() as u64 {
        0 => String::new(),
        1 => ", 1 pair of projection and format".to_owned(),
        count => format!(", {count} pairs of projection and format"),
    };
    Ok(format!(
        "{} agree to the bit: {}{projections}, {compared} texels and vertices",
        compared_with_cpu(conform::sources(), report.glsl_compared),
        counted(report.rows.len() as u64, "codecs"),
    ))
}
