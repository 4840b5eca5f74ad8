use super::run::{Json, Live, Outputs, Screen};
use super::table::{Column, Wide, left, right};
use super::{OpenBackend, Vulkan, counts, degrees, number, write_chart};
use clap::{Args, ValueEnum};
use std::fmt::Display;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, Domain, frames, rotations};
use unitvec_host::{Error, Result};
use unitvec_lab::accuracy;
use unitvec_lab::accuracy::filtering::{self, MAPS, Sample};
use unitvec_lab::accuracy::meyer::{METHODS, Method, WIDTHS};
use unitvec_lab::accuracy::{Published, Row, Table, beyond, blocks, chart};
use unitvec_run::backend::{Backend, BackendKind};

#[derive(Args)]
pub struct Arguments {
    /// Which table to measure.
    #[arg(long, value_enum, default_value = "all")]
    table: TableName,
    /// Random directions for each row: 1000000 if not given, 4000 for filtering.
    #[arg(long, value_name = "N", value_parser = counts())]
    count: Option<u64>,
    /// Seed of the random directions.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// What runs the codecs.
    #[arg(long, value_enum, default_value = "cpu")]
    backend: BackendKind,
    /// Measure with float64 intermediates too, as the survey did: all but Meyer's table and frames. Takes minutes more.
    #[arg(long)]
    float64: bool,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    outputs: Outputs,
    /// Draw a chart of the errors against bits, with the covering bound, as SVG.
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    vulkan: Vulkan,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum TableName {
    /// The survey's table 1: all representations, over the sphere.
    #[value(name = "1")]
    One,
    /// The survey's table 3: hemi-oct and its rivals, over the hemisphere.
    #[value(name = "3")]
    Three,
    /// Table 1 of Meyer et al.: bounds, and the largest errors that a search finds.
    Meyer,
    /// What no published table has: all other codecs, and tangent frames.
    Beyond,
    /// Normal maps in compressed blocks, by `--seed`.
    Blocks,
    /// Errors of components that hardware filters, blends or resolves before they are decoded, in float64.
    Filtering,
    /// All but blocks and filtering.
    All,
}

enum Job {
    Published(Table, Published, &'static AnyCodec),
    Meyer(&'static Method, &'static AnyCodec),
    Beyond(&'static AnyCodec),
    Frame(&'static AnyCodec),
    Rotation(&'static AnyCodec),
}

impl Job {
    fn codec(&self) -> &'static AnyCodec {
        let (Self::Published(_, _, codec)
        | Self::Meyer(_, codec)
        | Self::Beyond(codec)
        | Self::Frame(codec)
        | Self::Rotation(codec)) = self;
        codec
    }

    fn measure(&self, backend: &mut dyn Backend, arguments: &Arguments) -> Result<Vec<Row>> {
        let (codec, count, seed) =
            (self.codec(), arguments.count.unwrap_or(1_000_000) as usize, arguments.seed);
        let with_float64 = |mut row: Row, domain: Domain| {
            if arguments.float64 {
                let errors = accuracy::measure_float64(codec, domain, count, seed);
                (row.float64_mean_deg, row.float64_max_deg) = errors.unzip();
            }
            vec![row]
        };
        Ok(match self {
            Self::Published(table, row, _) => {
                let row = accuracy::measure_row(backend, *table, row, codec, count, seed)?;
                with_float64(row, table.domain())
            }
            Self::Meyer(method, _) => {
                vec![accuracy::measure_meyer_row(backend, method, codec, count, seed)?]
            }
            Self::Beyond(_) => with_float64(beyond::measure_row(backend, codec, count, seed)?, codec.domain),
            Self::Frame(_) => beyond::measure_frame(backend, codec, count, seed)?.into(),
            Self::Rotation(_) => vec![beyond::measure_rotation(backend, codec, count, seed)?],
        })
    }
}

impl TableName {
    /// The rows to measure, and the names of the survey's rows that no codec implements.
    fn jobs(self) -> (Vec<Job>, Vec<String>) {
        let (mut jobs, mut missing) = (Vec::new(), Vec::new());
        let is_wanted = |name| self == name || self == Self::All;
        for (name, table) in [(Self::One, Table::One), (Self::Three, Table::Three)] {
            for row in table.published().into_iter().filter(|_| is_wanted(name)) {
                match row.codec() {
                    Some(codec) => jobs.push(Job::Published(table, row, codec)),
                    None => missing.push(row.name),
                }
            }
        }
        if is_wanted(Self::Meyer) {
            let widths = |method| WIDTHS.iter().filter_map(move |bits| Method::codec(method, *bits));
            jobs.extend(
                METHODS.iter().flat_map(|method| widths(method).map(|codec| Job::Meyer(method, codec))),
            );
        }
        if is_wanted(Self::Beyond) {
            jobs.extend(beyond::codecs().map(Job::Beyond).chain(frames().iter().map(Job::Frame)));
            jobs.extend(rotations().iter().map(Job::Rotation));
        }
        (jobs, missing)
    }
}

/// The errors of all rows.
#[derive(Default, serde::Serialize, schemars::JsonSchema)]
pub struct Report {
    /// A row for each codec of each table, and for each part of a frame.
    rows: Vec<Row>,
    /// The rows of blocks, where they were asked for.
    blocks: Vec<blocks::Row>,
    /// The rows of filtering, where it was asked for.
    filtering: Vec<filtering::Row>,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let is_quiet = arguments.outputs.take_stdout(&arguments.json)?;
    if arguments.table == TableName::Blocks {
        return compress(arguments, is_quiet);
    }
    if arguments.table == TableName::Filtering {
        return filter(arguments, is_quiet);
    }
    let (jobs, missing) = arguments.table.jobs();
    let live =
        Live::new(Some(jobs.len() as u64), "{msg:<18} {wide_bar} {pos} of {len} rows, {eta} left", is_quiet);
    let screen = Screen::new(columns(arguments.float64), &arguments.wide, live)?;
    let mut open = OpenBackend::open(arguments.backend, &arguments.vulkan)?;
    screen.head(LEGEND)?;
    let mut rows = Vec::new();
    for job in jobs {
        screen.live.name(job.codec().id);
        let measured = job.measure(open.backend.as_mut(), arguments)?;
        screen.row(job.codec().id, || measured.iter().map(|row| line(&screen, row)).collect())?;
        screen.live.advance(1);
        rows.extend(measured);
    }
    screen.live.finish();
    for words in best(&rows) {
        screen.say(&words, "    ")?;
    }
    screen.end(&not_implemented(&missing))?;
    if let Some(path) = &arguments.chart {
        write_chart(path, chart::svg(&rows))?;
    }
    arguments.outputs.write(&rows)?;
    arguments.json.write(&Report { rows, ..Report::default() })?;
    Ok(open.close())
}

/// Refuses the options of the tables of codecs.
fn refuse_others(arguments: &Arguments, table: &str) -> Result<()> {
    match arguments.float64 || arguments.chart.is_some() || arguments.backend != BackendKind::Cpu {
        true => Err(Error::Usage(format!(
            "--table {table} has no chart, and the CPU alone measures it; leave out --chart, --float64 and --backend"
        ))),
        false => Ok(()),
    }
}

/// The table of blocks.
fn compress(arguments: &Arguments, is_quiet: bool) -> Result<ExitCode> {
    refuse_others(arguments, "blocks")?;
    let columns = vec![
        left("map", 7),
        left("codec", 10),
        left("format", 9),
        right("bits", 4),
        right("mean", 9).apart(),
        right("max", 9),
        right("by channel: mean", 16).apart().rank(1),
        right("max", 9).rank(1),
        right("ratio", 6).rank(1),
    ];
    let (all, mut rows) = (blocks::Stored::all(), Vec::new());
    let count = (blocks::MAPS.len() * all.len()) as u64;
    let live = Live::new(Some(count), "{msg:<18} {wide_bar} {pos} of {len} rows, {eta} left", is_quiet);
    let screen = Screen::new(columns, &arguments.wide, live)?;
    screen.head(BLOCKS_LEGEND)?;
    for map in &blocks::MAPS {
        let normals = map.normals(arguments.seed);
        for stored in &all {
            let row = blocks::measure(map, &normals, *stored);
            let [mean, max] = [row.mean_deg, row.max_deg].map(degrees);
            let [by_channel, by_channel_max] =
                [row.by_channel_mean_deg, row.by_channel_max_deg].map(|error| number(error, 6));
            let ratio = number(row.by_channel_mean_deg.map(|mean| row.mean_deg / mean), 3);
            let cells: [&dyn Display; 9] = [
                &row.map,
                &row.codec,
                &row.format,
                &row.bits,
                &mean,
                &max,
                &by_channel,
                &by_channel_max,
                &ratio,
            ];
            screen.row(row.codec, || screen.line(&cells))?;
            screen.live.advance(1);
            rows.push(row);
        }
    }
    screen.end("")?;
    arguments.outputs.write(&rows)?;
    arguments.json.write(&Report { blocks: rows, ..Report::default() })?;
    Ok(ExitCode::SUCCESS)
}

const BLOCKS_LEGEND: &str = "errors in degrees, of maps of 512 by 512 normals; by channel: BC5 as the crate block_compression \
     encodes it; ratio is ours / by channel\n";

/// The table of filtering.
fn filter(arguments: &Arguments, is_quiet: bool) -> Result<ExitCode> {
    refuse_others(arguments, "filtering")?;
    let mut columns = vec![left("map", 17), left("channel", 7), left("region", 6)];
    columns.extend(["mean", "max", "torn"].map(|heading| right(heading, 9)));
    columns.extend(["decoded mean", "decoded max"].map(|heading| right(heading, 12).rank(1)));
    let live = Live::new(Some(MAPS.len() as u64), "{msg:<18} {wide_bar} {pos} of {len} maps", is_quiet);
    let screen = Screen::new(columns, &arguments.wide, live)?;
    screen.head(FILTER_LEGEND)?;
    let mut rows = Vec::new();
    for map in &MAPS {
        let measured = filtering::measure(map, arguments.count.unwrap_or(4_000) as usize, arguments.seed);
        let shown = measured.iter().filter(|row| row.sample == Sample::Midpoint && row.apart_deg == 1.0);
        screen.row(map.name, || shown.map(|row| filter_line(&screen, row)).collect())?;
        screen.live.advance(1);
        rows.extend(measured);
    }
    arguments.outputs.write(&rows)?;
    arguments.json.write(&Report { filtering: rows, ..Report::default() })?;
    screen.end("")
}

fn filter_line(screen: &Screen, row: &filtering::Row) -> String {
    let filtering::Row { map, channel, region, torn, .. } = row;
    let region = format!("{region:?}").to_lowercase();
    let torn = format!("{:.2} %", 100.0 * torn);
    let [mean, max] = [row.mean_deg, row.max_deg].map(degrees);
    let [decoded, decoded_max] = [row.decoded_mean_deg, row.decoded_max_deg].map(degrees);
    screen.line(&[map, channel, &region, &mean, &max, &torn, &decoded, &decoded_max])
}

const FILTER_LEGEND: &str = "midpoints of neighbours 1 degree apart: errors in degrees of components blended and then decoded, to the same \
     blend of the vectors; torn are those off by more than 2; --csv and --json have all samples and distances\n";

const LEGEND: &str = "errors in degrees; ratio is ours / published (Meyer: their bound); least is that of hexagonal \
     covering; waste is bits against it; ± is the survey's mark of errors that float64 lowers; --float64 adds mean and max \
     with float64 intermediates\n";

/// The column of the published names.
const SURVEY: usize = 2;

/// The columns of the table; those with float64 intermediates were asked for.
fn columns(float64: bool) -> Vec<Column> {
    let mut all = vec![
        left("table", 5).rank(4),
        left("codec", 22),
        left("survey", 19).rank(7),
        right("bits", 4),
        right("mean", 9).apart(),
        right("survey", 9).rank(5),
        right("ratio", 6).rank(2),
        right("max", 9).apart(),
        right("survey", 9).rank(5),
        right("ratio", 6).rank(3),
        right("least mean", 10).apart().rank(6),
        right("least max", 10).rank(6),
        right("waste", 6).rank(1),
    ];
    if float64 {
        all.extend([right("mean f64", 10).apart(), right("max f64", 10)]);
    }
    all
}

fn line(screen: &Screen, row: &Row) -> String {
    let error = |error: Option<f64>| error.map_or_else(|| "-".to_owned(), degrees);
    // What of a frame the errors are of stands in the survey's column.
    let of = if row.table == "frames" && !screen.shows(SURVEY) { &row.survey_name } else { "" };
    screen.line(&[
        &row.table,
        &format!("{} {of}", row.id).trim_end(),
        &row.survey_name,
        &row.bits,
        &degrees(row.mean_deg),
        &(number(row.survey_mean_deg, 5) + &row.survey_mean_flag),
        &number(row.survey_mean_deg.map(|mean| row.mean_deg / mean), 3),
        &degrees(row.max_deg),
        &(error(row.survey_max_deg) + &row.survey_max_flag),
        &number(row.survey_max_deg.map(|max| row.max_deg / max), 3),
        &error(row.least_mean_deg),
        &error(row.least_max_deg),
        &number(row.wasted_bits, 2),
        &error(row.float64_mean_deg),
        &error(row.float64_max_deg),
    ])
}

/// A sentence for each width at which a codec beats the survey.
fn best(rows: &[Row]) -> Vec<String> {
    let sentence = |(at, bits): (usize, u32)| {
        let best = beyond::beats_the_survey(rows, bits)?;
        let gap = if at == 0 { "\n" } else { "" };
        Some(format!(
            "{gap}{bits} bits: {} has a lower maximum than every row of table 1, and no higher mean within the sample\n",
            best.id
        ))
    };
    [16, 24, 32].into_iter().enumerate().filter_map(sentence).collect()
}

fn not_implemented(missing: &[String]) -> String {
    match missing {
        [] => String::new(),
        _ => format!("\n{} rows of the survey are not implemented: {}\n", missing.len(), missing.join(", ")),
    }
}
