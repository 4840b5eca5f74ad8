use super::counted;
use super::run::Json;
use super::table::{Layout, Wide, left, left_out, right, wrapped};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::Element;
use unitvec_choose::costs::USUAL;
use unitvec_choose::seen::{Colour, Lobe, least_bits, mirror_error_deg};
use unitvec_choose::{Answer, Candidate, Costs, Demand, Limit, Miss, choose, degrees};
use unitvec_files::{read_small, shown};
use unitvec_host::Result;

#[derive(Args)]
pub struct Arguments {
    /// Largest error that is allowed for any direction, in degrees. Codecs of few bytes come first; with --bits alone, those of
    /// the least bound.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number_of_degrees,
          required_unless_present_any = ["bits", "color_depth", "mirror"])]
    max_error: Option<f64>,
    /// Largest mean error that is allowed, in degrees; besides --max-error or --bits.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = number_of_degrees)]
    mean_error: Option<f64>,
    /// Most bits of a code.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    bits: Option<u32>,
    #[command(flatten)]
    sight: Sight,
    /// Codecs of tangent frames instead of vectors. Of the errors of normal and tangent the greater counts.
    #[arg(long)]
    frames: bool,
    /// Codecs of rotations, unit quaternions, instead of vectors. Errors are angles of rotation.
    #[arg(long, alias = "rotation", conflicts_with = "frames")]
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
    /// GPU whose costs to choose by: AMD's by generation or code name (rdna2, navi21), one of another maker whose compiler was asked
    /// (dg2, sm_86, a730, g610, v3d42), or one that was measured, h200 or lavapipe. The order of codecs of equal size may change
    /// from GPU to GPU.
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

/// What is seen of an error.
#[derive(Args)]
#[command(next_help_heading = "What is seen")]
struct Sight {
    /// Bits of a picture's colours: no error may change one by half a step, on a matt surface or, with --roughness, in a highlight.
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u32).range(1..=32))]
    color_depth: Option<u32>,
    /// Steps that are equal in light. If not given they are equal on the curve of sRGB, where the dark has finer ones.
    #[arg(long, requires = "color_depth")]
    linear: bool,
    /// Roughness of a highlight by GGX.
    #[arg(long, value_name = "R", allow_negative_numbers = true, requires = "color_depth", value_parser = within(0.01, 1.0))]
    roughness: Option<f64>,
    /// Diameter of the light, which blurs the highlight: 0.5 for the sun.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, requires = "roughness", default_value_t = 0.0, value_parser = within(0.0, 180.0))]
    light_degrees: f64,
    /// Light in the middle of the highlight, as a multiple of white.
    #[arg(long, value_name = "P", allow_negative_numbers = true, requires = "roughness", default_value_t = 1.0, value_parser = within(0.01, 1e6))]
    peak: f64,
    /// A flat mirror: no error may move what it shows by half a pixel.
    #[arg(long)]
    mirror: bool,
    /// Height of the mirror's picture in pixels.
    #[arg(long, value_name = "N", requires = "mirror", default_value_t = 1080, value_parser = clap::value_parser!(u32).range(1..))]
    pixels: u32,
    /// Field of view over that height, in degrees.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, requires = "mirror", default_value_t = 60.0, value_parser = within(0.1, 179.0))]
    fov: f64,
}

/// The largest error that is not seen.
#[derive(serde::Serialize, schemars::JsonSchema)]
struct Unseen {
    /// The error in degrees.
    max_error_deg: f64,
    /// What would show a larger one first: `matt surface`, `highlight` or `mirror`.
    of: &'static str,
    /// Bits that no code with this error has fewer than, if discs could pack the sphere (Meyer et al. 2010, eq. 1).
    least_bits: f64,
}

impl Sight {
    /// `None` where neither colours nor a mirror are named.
    fn unseen(&self) -> Option<Unseen> {
        let colour = self.color_depth.map(|bits| Colour { bits, is_linear: self.linear });
        let highlight = |roughness| Lobe::Ggx { roughness, light_degrees: self.light_degrees };
        let (lobe, peak) = (self.roughness.map(highlight), self.peak);
        let errors = [
            ("matt surface", colour.map(|colour| Lobe::Lambert.max_error_deg(1.0, colour))),
            ("highlight", lobe.zip(colour).map(|(lobe, colour)| lobe.max_error_deg(peak, colour))),
            ("mirror", self.mirror.then(|| mirror_error_deg(self.pixels, self.fov))),
        ];
        let errors = errors.into_iter().filter_map(|(of, error)| Some((of, error?)));
        let (of, max_error_deg) = errors.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Unseen { max_error_deg, of, least_bits: least_bits(max_error_deg) })
    }
}

const SHOWN: usize = 8;

/// The codecs that meet a demand.
#[derive(serde::Serialize, schemars::JsonSchema)]
pub struct Report {
    /// The device whose costs the choice goes by.
    costs_of: String,
    /// Weights of encoding and of decoding in the cost.
    weights: [f64; 2],
    /// The largest error that is not seen, where colours or a mirror are named.
    unseen: Option<Unseen>,
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
    let unseen = arguments.sight.unseen();
    let errors = [arguments.max_error, unseen.as_ref().map(|unseen| unseen.max_error_deg)];
    let demand = Demand {
        element: match (arguments.frames, arguments.rotations) {
            (true, _) => Element::Frame,
            (_, true) => Element::Rotation,
            _ => Element::Vector,
        },
        max_error_deg: errors.into_iter().flatten().reduce(f64::min),
        mean_error_deg: arguments.mean_error,
        bits: arguments.bits,
        no_table: arguments.no_table,
        hemisphere: arguments.hemisphere,
        weights: arguments.weights,
    };
    let columns = arguments.wide.columns()?;
    let answer = choose(&demand, &costs);
    let reason = reason(&demand, &answer);
    let costs_of = costs.device().to_owned();
    let report = Report { costs_of, weights: demand.weights, unseen, reason, answer };
    let status = arguments.json.write_or_print(&report, || text(&report, &demand, columns))?;
    Ok(if report.answer.candidates.is_empty() { ExitCode::FAILURE } else { status })
}

fn number_of_degrees(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if degrees > 0.0 => Ok(degrees),
        _ => Err("not a number of degrees above 0".to_owned()),
    }
}

fn within(least: f64, most: f64) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| match text.parse() {
        Ok(number) if (least..=most).contains(&number) => Ok(number),
        _ => Err(format!("not a number from {least} to {most}")),
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
    let Report { costs_of, weights: [encode, decode], unseen, reason, answer } = report;
    let Answer { candidates, misses } = answer;
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
    if let Some(Unseen { max_error_deg, of, least_bits }) = unseen {
        let limit = degrees(*max_error_deg);
        let words = format!(
            "not seen: errors up to {limit} degrees, by the {of}; codes of {least_bits:.1} bits could have so little"
        );
        let _ = write!(text, "\n{}", wrapped(&words, "", columns));
    }
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
