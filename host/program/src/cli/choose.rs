use super::counted;
use super::run::Json;
use super::table::{Layout, Wide, left, right, wrapped};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_choose::costs::USUAL;
use unitvec_choose::{Candidate, Costs, Demand, candidates};
use unitvec_files::read_small;
use unitvec_host::Result;

#[derive(Args)]
pub struct Arguments {
    /// Largest error that is allowed for any direction, in degrees. Codecs of few bytes come first; with --bits alone, those of
    /// the least error.
    #[arg(long, value_name = "DEG", value_parser = degrees, required_unless_present = "bits")]
    max_error: Option<f64>,
    /// Largest mean error that is allowed, in degrees; besides --max-error or --bits.
    #[arg(long, value_name = "DEG", value_parser = degrees)]
    mean_error: Option<f64>,
    /// Most bits of a code.
    #[arg(long, value_name = "N")]
    bits: Option<u32>,
    /// Leave out encoders that read a table.
    #[arg(long)]
    no_table: bool,
    /// Directions with z >= 0 only, as in tangent-space normal maps: that saves a bit.
    #[arg(long)]
    hemisphere: bool,
    /// GPU whose costs to choose by, by generation or code name (rdna2, navi21); or lavapipe.
    #[arg(long, value_name = "NAME", default_value = USUAL)]
    gpu: String,
    /// Costs to choose by instead: a report that `unitvec bench device --json FILE` or `unitvec bench compiler --json FILE` wrote.
    #[arg(long, value_name = "FILE", conflicts_with = "gpu")]
    costs: Option<PathBuf>,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    wide: Wide,
}

const SHOWN: usize = 8;

/// The codecs that meet a demand.
#[derive(serde::Serialize, schemars::JsonSchema)]
pub struct Report {
    /// The device whose costs the choice goes by.
    costs_of: String,
    /// Why the first is the choice, or why there is none.
    reason: String,
    /// The codecs, the best choice first.
    candidates: Vec<Candidate>,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let costs = match &arguments.costs {
        Some(path) => Costs::parse(path, &read_small(path)?)?,
        None => Costs::shipped(&arguments.gpu)?,
    };
    let demand = Demand {
        max_error_deg: arguments.max_error,
        mean_error_deg: arguments.mean_error,
        bits: arguments.bits,
        no_table: arguments.no_table,
        hemisphere: arguments.hemisphere,
    };
    let columns = arguments.wide.columns()?;
    let found = candidates(&demand, &costs)?;
    let reason = if demand.max_error_deg.is_some() { reason(&found) } else { finest(&found) };
    let report = Report { costs_of: costs.device().to_owned(), reason, candidates: found };
    let status = arguments.json.write_or_print(&report, || table(&report, columns))?;
    Ok(if report.candidates.is_empty() { ExitCode::FAILURE } else { status })
}

fn degrees(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(degrees) if degrees > 0.0 => Ok(degrees),
        _ => Err("not a number of degrees above 0".to_owned()),
    }
}

/// The choice where only bits are limited.
fn finest(found: &[Candidate]) -> String {
    match found {
        [] => "no codec has so few bits".to_owned(),
        [best, ..] => format!("take {}: no codec of so few bits has a smaller maximum error", best.id),
    }
}

/// Why the first is the choice.
fn reason(found: &[Candidate]) -> String {
    let [best, rest @ ..] = found else {
        return "no codec meets this demand: allow more bits or a larger error".to_owned();
    };
    let alike: Vec<&Candidate> = rest.iter().filter(|other| other.bytes == best.bytes).collect();
    let bytes = counted(best.bytes as u64, "bytes");
    let mut text = format!("take {}: {bytes} a code is the least that meets the demand", best.id);
    let measured = best.cost().is_finite() && alike.iter().all(|other| other.cost().is_finite());
    text += match alike.as_slice() {
        [] => ", and no other codec does with so few",
        _ if !measured => "; the costs of the codecs that do with so few were not all measured",
        [_] => ", and the other codec that does with so few costs more",
        _ => ", and all others that do with so few cost more",
    };
    let finest = alike.iter().min_by(|a, b| a.mean_error_deg.total_cmp(&b.mean_error_deg));
    if let Some(finer) = finest.filter(|finest| finest.mean_error_deg < 0.995 * best.mean_error_deg) {
        text += &format!("; of these, {} has the smallest mean error", finer.id);
    }
    text
}

fn table(Report { costs_of, reason, candidates: found }: &Report, columns: Option<usize>) -> String {
    let table = Layout::new(
        vec![
            left("codec", 20),
            right("bits", 4),
            right("bytes", 5),
            right("max", 10).apart(),
            right("mean", 10),
            right("encode", 7).apart(),
            right("decode", 7),
        ],
        columns,
    );
    let mut text = String::new();
    if !found.is_empty() {
        let legend = format!(
            "errors in degrees: the upper bound of the maximum, the mean measured; cost as multiples of oct32's on {costs_of}"
        );
        text += &wrapped(&legend, "", columns);
        text.push('\n');
        text += &table.heading();
    }
    for codec in found.iter().take(SHOWN) {
        let cost = |cost: Option<f64>| cost.map_or_else(|| "-".to_owned(), |cost| format!("{cost:.1}"));
        text += &table.line(&[
            &codec.id,
            &codec.bits,
            &codec.bytes,
            &format_args!("{:.3e}", codec.max_error_deg),
            &format_args!("{:.3e}", codec.mean_error_deg),
            &cost(codec.encode_cost),
            &cost(codec.decode_cost),
        ]);
    }
    if found.len() > SHOWN {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "and {} more; `--json -` lists them", found.len() - SHOWN);
    }
    let _ = writeln!(text, "\n{}", wrapped(reason, "", columns));
    text
}
