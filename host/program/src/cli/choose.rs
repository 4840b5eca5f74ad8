use super::table::{Layout, Wide, left, right, wrapped};
use super::{print, to_json};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_choose::costs::USUAL;
use unitvec_choose::{Candidate, Costs, Demand, candidates};
use unitvec_files::read_small;
use unitvec_host::Result;

#[derive(Args)]
#[command(
    after_help = "Examples:\n  unitvec choose --max-error 0.05\n  unitvec choose --bits 24\n  unitvec choose --bits 16 --hemisphere --gpu rdna3"
)]
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
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    wide: Wide,
}

/// Codecs that are shown.
const SHOWN: usize = 8;

#[derive(serde::Serialize)]
struct Report<'a> {
    costs_of: &'a str,
    reason: String,
    candidates: &'a [Candidate],
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
    let found = candidates(&demand, &costs)?;
    let reason = if demand.max_error_deg.is_some() { reason(&found) } else { finest(&found) };
    if arguments.json {
        print(&to_json(&Report { costs_of: costs.device(), reason, candidates: &found }))?;
    } else {
        print(&table(&found, &costs, &reason, arguments.wide.columns()?))?;
    }
    Ok(if found.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS })
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
        [best, ..] => format!("{}: no codec of so many bits has a smaller maximum error", best.id),
    }
}

/// Why the first is the choice.
fn reason(found: &[Candidate]) -> String {
    let [best, rest @ ..] = found else {
        return "no codec meets this demand: allow more bits or a larger error".to_owned();
    };
    let alike: Vec<&Candidate> = rest.iter().filter(|other| other.bytes == best.bytes).collect();
    let mut text =
        format!("{}: no codec that meets the demand takes fewer bytes than {}", best.id, best.bytes);
    let measured = best.cost().is_finite() && alike.iter().all(|other| other.cost().is_finite());
    match alike.as_slice() {
        _ if !measured && !alike.is_empty() => {
            text += "; what it costs, or one of as few bytes, was not measured";
        }
        [] => text += ", and no other as few",
        [_] => text += ", and the one other that takes as few costs more",
        others => {
            // Writing to a String cannot fail.
            let _ = write!(text, ", and the {} others that take as few cost more", others.len());
        }
    }
    let finest = alike.iter().min_by(|a, b| a.mean_error_deg.total_cmp(&b.mean_error_deg));
    if let Some(finer) = finest.filter(|finest| finest.mean_error_deg < 0.995 * best.mean_error_deg) {
        let _ = write!(text, "; the least mean error of those has {}", finer.id);
    }
    text
}

fn table(found: &[Candidate], costs: &Costs, reason: &str, columns: Option<usize>) -> String {
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
            "errors in degrees: the upper bound of the maximum, the mean measured; cost as multiples of oct32's on {}",
            costs.device()
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
        let _ = writeln!(text, "and {} more; --json lists them", found.len() - SHOWN);
    }
    let _ = writeln!(text, "\n{}", wrapped(reason, "", columns));
    text
}
