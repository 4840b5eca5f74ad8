use super::counted;
use super::run::Json;
use super::table::{Layout, Wide, left, left_out, right, wrapped};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::Element;
use unitvec_choose::costs::USUAL;
use unitvec_choose::{Answer, Candidate, Costs, Demand, Limit, Miss, choose, degrees};
use unitvec_files::{read_small, shown};
use unitvec_host::Result;

#[derive(Args)]
pub struct Arguments {
    /// Largest error that is allowed for any direction, in degrees. Codecs of few bytes come first; with --bits alone, those of
    /// the least bound.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number_of_degrees, required_unless_present = "bits")]
    max_error: Option<f64>,
    /// Largest mean error that is allowed, in degrees; besides --max-error or --bits.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number_of_degrees)]
    mean_error: Option<f64>,
    /// Most bits of a code.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    bits: Option<u32>,
    /// Codecs of tangent frames instead of vectors. Of the errors of normal and tangent the greater counts.
    #[arg(long)]
    frames: bool,
    /// Codecs of rotations, unit quaternions, instead of vectors. Errors are angles of rotation.
    #[arg(long, conflicts_with = "frames")]
    rotations: bool,
    /// Leave out encoders that read a table.
    #[arg(long)]
    no_table: bool,
    /// Directions with z >= 0 only, as in tangent-space normal maps: that saves a bit.
    #[arg(long, conflicts_with_all = ["frames", "rotations"])]
    hemisphere: bool,
    /// Weights of encoding and of decoding in the cost: 0,1 for what is encoded once and decoded often.
    #[arg(long, value_name = "E,D", allow_hyphen_values = true, default_value = "1,1", value_parser = weights)]
    weights: [f64; 2],
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
    /// Weights of encoding and of decoding in the cost.
    weights: [f64; 2],
    /// Why the first is the choice, or why there is none.
    reason: String,
    #[serde(flatten)]
    answer: Answer,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let costs = match &arguments.costs {
        Some(path) => Costs::parse(path, &read_small(path)?)?,
        None => Costs::shipped(&arguments.gpu)?,
    };
    let demand = Demand {
        element: match (arguments.frames, arguments.rotations) {
            (true, _) => Element::Frame,
            (_, true) => Element::Rotation,
            _ => Element::Vector,
        },
        max_error_deg: arguments.max_error,
        mean_error_deg: arguments.mean_error,
        bits: arguments.bits,
        no_table: arguments.no_table,
        hemisphere: arguments.hemisphere,
        weights: arguments.weights,
    };
    let columns = arguments.wide.columns()?;
    let answer = choose(&demand, &costs);
    let reason = reason(&demand, &answer);
    let report = Report { costs_of: costs.device().to_owned(), weights: demand.weights, reason, answer };
    let status = arguments.json.write_or_print(&report, || text(&report, &demand, columns))?;
    Ok(if report.answer.candidates.is_empty() { ExitCode::FAILURE } else { status })
}

fn number_of_degrees(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if degrees > 0.0 => Ok(degrees),
        _ => Err("not a number of degrees above 0".to_owned()),
    }
}

fn weights(text: &str) -> Result<[f64; 2], String> {
    let weight =
        |text: &str| text.trim().parse().ok().filter(|weight: &f64| *weight >= 0.0 && weight.is_finite());
    match text.split_once(',').map(|(encode, decode)| [weight(encode), weight(decode)]) {
        Some([Some(encode), Some(decode)]) if encode + decode > 0.0 => Ok([encode, decode]),
        _ => Err("not two numbers from 0, one of them above 0, such as 0,1".to_owned()),
    }
}

/// Why the first is the choice, or why there is none.
fn reason(demand: &Demand, answer: &Answer) -> String {
    match (&answer.candidates[..], demand.max_error_deg) {
        ([], _) if answer.misses.is_empty() => "no codec meets this demand".to_owned(),
        ([], _) => format!("no codec meets this demand; nearest: {}", named(&answer.misses)),
        ([best, rest @ ..], None) => finest(best, rest),
        ([best, rest @ ..], Some(_)) => smallest(best, rest),
    }
}

/// The choice where only bits are limited, and what else is recommended in as many bytes.
fn finest(best: &Candidate, rest: &[Candidate]) -> String {
    let alike = rest.iter().filter(|other| other.bytes == best.bytes && !other.recommended_for.is_empty());
    let alike = alike.map(|other| format!("{} ({})", other.id, other.recommended_for.join("; ")));
    let mut text = format!("take {}: no codec of so few bits has a smaller bound", best.id);
    let alike = alike.collect::<Vec<_>>().join(", ");
    if !alike.is_empty() {
        text += &format!("; recommended in as many bytes: {alike}");
    }
    text
}

/// The choice where an error is demanded.
fn smallest(best: &Candidate, rest: &[Candidate]) -> String {
    let alike: Vec<&Candidate> = rest.iter().filter(|other| other.bytes == best.bytes).collect();
    let bytes = counted(best.bytes as u64, "bytes");
    let mut text = format!("take {}: {bytes} a code is the least that meets the demand", best.id);
    let is_known = best.cost.is_some() && alike.iter().all(|other| other.cost.is_some());
    text += match alike.as_slice() {
        [] => ", and no other codec does with so few",
        _ if !is_known => "; the costs of the codecs that do with so few are not all known",
        [_] => ", and the other codec that does with so few costs more",
        _ => ", and all others that do with so few cost more",
    };
    let finest = alike.iter().min_by(|a, b| a.mean_deg.total_cmp(&b.mean_deg));
    if let Some(finer) = finest.filter(|finest| finest.mean_deg < 0.995 * best.mean_deg) {
        text += &format!("; of these, {} has the smallest mean error", finer.id);
    }
    text
}

/// Codecs that fail, each with what it exceeds.
fn named(misses: &[Miss]) -> String {
    let words = |miss: &Miss| {
        let Miss { candidate, exceeds, times } = miss;
        let has = match exceeds {
            Limit::Bound => format!("bound {}", degrees(candidate.bound_deg)),
            Limit::Mean => format!("mean {}", degrees(candidate.mean_deg)),
            Limit::Bits => format!("{} bits", candidate.bits),
        };
        let bytes = counted(candidate.bytes as u64, "bytes");
        let times = degrees(*times);
        format!(
            "{} ({has}, {times} times what is asked; {bytes}, cost {})",
            candidate.id,
            cost(candidate.cost)
        )
    };
    misses.iter().map(words).collect::<Vec<_>>().join(", ")
}

fn cost(cost: Option<f64>) -> String {
    cost.map_or_else(|| "-".to_owned(), |cost| format!("{cost:.1}"))
}

fn text(report: &Report, demand: &Demand, columns: Option<usize>) -> String {
    let Report { costs_of, weights: [encode, decode], reason, answer: Answer { candidates, misses } } =
        report;
    let (mut text, layout) = (String::new(), layout(columns));
    if !candidates.is_empty() {
        let first = if demand.max_error_deg.is_some() { "bytes" } else { "bound" };
        let legend = format!(
            "errors in degrees: no direction exceeds the bound, max and mean are measured; cost: {encode} x encode + {decode} x decode, \
             multiples of oct32's on {}; order: {first}, cost, mean",
            shown(costs_of)
        );
        text = wrapped(&legend, "", columns) + "\n" + &table(candidates, &layout);
    }
    // Writing to a String cannot fail.
    let _ = writeln!(text, "\n{}", wrapped(reason, "", columns));
    if !candidates.is_empty() && !misses.is_empty() {
        let _ = writeln!(text, "{}", wrapped(&format!("near misses: {}", named(misses)), "", columns));
    }
    text + &if candidates.is_empty() { String::new() } else { left_out(&[&layout]) }
}

fn layout(columns: Option<usize>) -> Layout {
    Layout::new(
        vec![
            left("codec", 19),
            right("bits", 4),
            right("bytes", 5),
            right("bound", 8).apart(),
            right("max", 8),
            right("mean", 8),
            right("encode", 6).apart(),
            right("decode", 6),
            right("cost", 5),
            left("table", 5).apart().rank(2),
            left("recommended for", 40).rank(1),
        ],
        columns,
    )
}

fn table(candidates: &[Candidate], layout: &Layout) -> String {
    let mut text = layout.heading();
    for codec in candidates.iter().take(SHOWN) {
        text += &layout.line(&[
            &codec.id,
            &codec.bits,
            &codec.bytes,
            &degrees(codec.bound_deg),
            &degrees(codec.max_deg),
            &degrees(codec.mean_deg),
            &cost(codec.encode_cost),
            &cost(codec.decode_cost),
            &cost(codec.cost),
            &if codec.reads_table { "yes" } else { "" },
            &codec.recommended_for.join("; "),
        ]);
    }
    if candidates.len() > SHOWN {
        text += &format!("and {} more; `--json -` lists them\n", candidates.len() - SHOWN);
    }
    text
}
