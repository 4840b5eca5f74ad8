use super::table::{Layout, Wide, left, left_out, right, wrapped};
use super::{OpenBackend, Vulkan, counts, degrees, print, progress, reports_to_stdout, to_csv, to_json};
use clap::{Args, ValueEnum};
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, frames};
use unitvec_host::Result;
use unitvec_lab::accuracy;
use unitvec_lab::accuracy::meyer::{METHODS, Method, WIDTHS};
use unitvec_lab::accuracy::{Row, Table, beyond, chart};
use unitvec_run::backend::BackendKind;

#[derive(Args)]
pub struct Arguments {
    /// Which table to measure.
    #[arg(long, value_enum, default_value = "all")]
    table: TableName,
    /// Random directions for each row.
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = counts())]
    count: u64,
    /// Seed of the random directions.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// What runs the codecs.
    #[arg(long, value_enum, default_value = "cpu")]
    backend: BackendKind,
    /// Measure with float64 intermediates too, as the survey did: all but Meyer's table and frames. Takes minutes more.
    #[arg(long)]
    float64: bool,
    /// Write the rows as JSON as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the rows as CSV as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw a chart of the errors against bits, with the covering bound, as SVG.
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    vulkan: Vulkan,
}

#[derive(Clone, Copy, ValueEnum)]
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
    /// All four.
    All,
}

impl TableName {
    fn tables(self) -> &'static [Table] {
        match self {
            Self::One => &[Table::One],
            Self::Three => &[Table::Three],
            Self::All => &[Table::One, Table::Three],
            Self::Meyer | Self::Beyond => &[],
        }
    }

    fn has_meyer(self) -> bool {
        matches!(self, Self::Meyer | Self::All)
    }

    fn has_beyond(self) -> bool {
        matches!(self, Self::Beyond | Self::All)
    }
}

#[derive(serde::Serialize)]
struct Report {
    rows: Vec<Row>,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let to_stdout = reports_to_stdout(arguments.json.as_deref(), arguments.csv.as_deref())?;
    let columns = arguments.wide.columns()?;
    let mut open = OpenBackend::open(arguments.backend, &arguments.vulkan)?;
    let published: Vec<_> = arguments
        .table
        .tables()
        .iter()
        .flat_map(|table| table.published().into_iter().map(move |row| (*table, row)))
        .collect();
    let methods = meyer_rows(arguments.table.has_meyer());
    let beyond: Vec<_> = beyond::codecs().filter(|_| arguments.table.has_beyond()).collect();
    let frames: Vec<_> = frames().iter().filter(|_| arguments.table.has_beyond()).collect();
    let count = published.len() + methods.len() + beyond.len() + frames.len();
    let bar = progress::bar(Some(count as u64), "{msg:<18} {wide_bar} {pos} of {len} rows, {eta} left");
    let (backend, count, seed) = (open.backend.as_mut(), arguments.count as usize, arguments.seed);
    let (mut rows, mut missing) = (Vec::new(), Vec::new());
    for (table, row) in published {
        progress::show_if_due(&bar);
        bar.set_message(row.name.clone());
        match row.codec() {
            Some(codec) => {
                let mut measured = accuracy::measure_row(backend, table, &row, codec, count, seed)?;
                if arguments.float64 {
                    let errors = accuracy::measure_float64(codec, table.domain(), count, seed);
                    (measured.float64_mean_deg, measured.float64_max_deg) = errors.unzip();
                }
                rows.push(measured);
            }
            None => missing.push(row.name),
        }
        bar.inc(1);
    }
    for (method, codec) in methods {
        progress::show_if_due(&bar);
        bar.set_message(codec.id);
        rows.push(accuracy::measure_meyer_row(backend, method, codec, count, seed)?);
        bar.inc(1);
    }
    for codec in beyond {
        progress::show_if_due(&bar);
        bar.set_message(codec.id);
        let mut measured = beyond::measure_row(backend, codec, count, seed)?;
        if arguments.float64 {
            let errors = accuracy::measure_float64(codec, codec.domain, count, seed);
            (measured.float64_mean_deg, measured.float64_max_deg) = errors.unzip();
        }
        rows.push(measured);
        bar.inc(1);
    }
    for codec in frames {
        progress::show_if_due(&bar);
        bar.set_message(codec.id);
        rows.extend(beyond::measure_frame(backend, codec, count, seed)?);
        bar.inc(1);
    }
    bar.finish_and_clear();

    if !to_stdout {
        print(&table_text(&rows, &missing, arguments.float64, columns))?;
    }
    if let Some(path) = &arguments.chart {
        let failed = |error: Box<dyn std::error::Error>| {
            unitvec_files::Error::writing(path, std::io::Error::other(error.to_string()))
        };
        unitvec_files::write_file(path, chart::svg(&rows).map_err(failed)?.as_bytes())?;
    }
    if let Some(path) = &arguments.csv {
        unitvec_files::write_file(path, &to_csv(path, &rows)?)?;
    }
    if let Some(path) = &arguments.json {
        unitvec_files::write_file(path, to_json(&Report { rows }).as_bytes())?;
    }
    Ok(open.close())
}

/// Meyer's methods at each width that there is a codec for.
fn meyer_rows(wanted: bool) -> Vec<(&'static Method, &'static AnyCodec)> {
    let methods = METHODS.iter().filter(|_| wanted);
    methods
        .flat_map(|method| WIDTHS.iter().filter_map(move |bits| Some((method, method.codec(*bits)?))))
        .collect()
}

/// As [`degrees`]; - for none.
fn degrees_or_none(error: Option<f64>) -> String {
    error.map_or_else(|| "-".to_owned(), degrees)
}

/// The column of the published names.
const SURVEY: usize = 2;

/// The columns of the table; those with float64 intermediates were asked for.
fn table(float64: bool, columns: Option<usize>) -> Layout {
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
        right("bound mean", 10).apart().rank(6),
        right("bound max", 10).rank(6),
        right("waste", 6).rank(1),
    ];
    if float64 {
        all.extend([right("mean f64", 10).apart(), right("max f64", 10)]);
    }
    Layout::new(all, columns)
}

/// What the columns mean.
fn legend(columns: Option<usize>) -> String {
    wrapped(
        "errors in degrees; ratio is ours / published (Meyer: their bound); bound is that of hexagonal covering; waste is \
         bits against it; --float64 adds mean and max with float64 intermediates",
        "",
        columns,
    ) + "\n"
}

fn table_text(rows: &[Row], missing: &[String], float64: bool, columns: Option<usize>) -> String {
    let table = table(float64, columns);
    let mut text = legend(columns) + &table.heading();
    for row in rows {
        let number = |value: Option<f64>, digits: usize| {
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
        };
        // What of a frame the errors are of stands in the survey's column.
        let of = if row.table == "frames" && !table.shows(SURVEY) { &row.survey_name } else { "" };
        text += &table.line(&[
            &row.table,
            &format!("{} {of}", row.id).trim_end(),
            &row.survey_name,
            &row.bits,
            &degrees(row.mean_deg),
            &number(row.survey_mean_deg, 5),
            &number(row.survey_mean_deg.map(|mean| row.mean_deg / mean), 3),
            &degrees(row.max_deg),
            &degrees_or_none(row.survey_max_deg),
            &number(row.survey_max_deg.map(|max| row.max_deg / max), 3),
            &degrees_or_none(row.bound_mean_deg),
            &degrees_or_none(row.bound_max_deg),
            &number(row.wasted_bits, 2),
            &degrees_or_none(row.float64_mean_deg),
            &degrees_or_none(row.float64_max_deg),
        ]);
    }
    // Writing to a String cannot fail.
    for bits in [16, 24, 32] {
        if let Some(best) = beyond::beats_the_survey(rows, bits) {
            let found = format!(
                "{bits} bits: {} has a lower maximum than every row of table 1 and a mean no higher",
                best.id
            );
            let _ =
                writeln!(text, "{}{}", if bits == 16 { "\n" } else { "" }, wrapped(&found, "    ", columns));
        }
    }
    if !missing.is_empty() {
        let list =
            format!("{} rows of the survey are not implemented: {}", missing.len(), missing.join(", "));
        let _ = writeln!(text, "\n{}", wrapped(&list, "", columns));
    }
    text + &left_out(&[&table])
}
