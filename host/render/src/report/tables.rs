//! The contents of the page's tables.

use crate::Result;
use minijinja::{Value, context};
use serde::Serialize;
use unitvec_catalogue::{
    AnyCodec, Choice, Domain, Element, Operation, RECOMMENDED, Recommendation, directions, find, vectors,
};
use unitvec_choose::costs::{GENERATIONS, USUAL};
use unitvec_choose::{Costs, MEASURED, REFERENCE, degrees, measured};
use unitvec_lab::accuracy::meyer::{METHODS, WIDTHS};
use unitvec_lab::accuracy::{Table, measure_meyer_row, measure_row};
use unitvec_lab::bench::survey_ns;
use unitvec_run::backend::Cpu;

/// The machine that the report was made on.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// Operating system and processor architecture.
    pub platform: String,
    /// The processor's name, where the system gives it.
    pub processor: Option<String>,
    /// Processors that a program may use.
    pub threads: usize,
}

impl Machine {
    /// This machine.
    pub fn this() -> Self {
        let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let name = cpuinfo.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
        Self {
            platform: format!("{} on {}", std::env::consts::OS, std::env::consts::ARCH),
            processor: name.map(|(_, name)| name.trim().to_owned()),
            threads: std::thread::available_parallelism().map_or(1, |count| count.get()),
        }
    }
}

/// A codec of the table to choose from.
#[derive(Clone, Debug, Serialize)]
pub struct Codec {
    id: &'static str,
    name: &'static str,
    bits: u32,
    bytes: usize,
    format: Option<&'static str>,
    frame: bool,
    hemisphere: bool,
    unit: bool,
    by_table: bool,
    /// Over the directions that the codec is for.
    mean: f64,
    /// Over z >= 0.
    mean_above: f64,
    max: f64,
    bound: f64,
    /// Encoding and decoding as multiples of oct32's, for each device with known costs.
    costs: Vec<[Option<f64>; 2]>,
}

/// Costs that ship with the program: that of `choose`, then the others, the newest first, then the measured ones.
///
/// # Errors
/// [`Error::BadCosts`](unitvec_choose::Error::BadCosts), which would be a fault of this crate.
pub fn shipped_costs() -> Result<Vec<Costs>> {
    let others = GENERATIONS.iter().rev().map(|one| one.name).filter(|name| *name != USUAL);
    [USUAL]
        .into_iter()
        .chain(others)
        .chain(MEASURED.map(|(name, _)| name))
        .map(|name| Ok(Costs::shipped(name)?))
        .collect()
}

/// All codecs whose errors are recorded, in the order of `choose`.
pub fn codecs(all: &[Costs]) -> Vec<Codec> {
    let of_codec = |codec: &AnyCodec| {
        let [errors, above] = [measured(codec, false)?, measured(codec, true)?];
        Some(Codec {
            id: codec.id,
            name: codec.survey_name,
            bits: codec.bits,
            bytes: codec.bytes,
            format: codec.vk_format.map(|name| name.trim_start_matches("VK_FORMAT_")),
            frame: codec.element == Element::Frame,
            hemisphere: codec.domain == Domain::Hemisphere,
            unit: codec.is_unit,
            by_table: codec.encodes_by_table,
            mean: errors.mean_deg,
            mean_above: above.mean_deg,
            max: errors.max_deg,
            bound: f64::from(codec.max_error_deg()),
            costs: all.iter().map(|costs| both(costs, codec.id)).collect(),
        })
    };
    let mut codecs: Vec<Codec> = directions().iter().filter_map(of_codec).collect();
    let cost = |codec: &Codec| codec.costs[0][0].zip(codec.costs[0][1]).map_or(f64::INFINITY, |(a, b)| a + b);
    codecs.sort_by(|a, b| {
        a.bytes.cmp(&b.bytes).then(cost(a).total_cmp(&cost(b))).then(a.mean.total_cmp(&b.mean))
    });
    codecs
}

/// Costs of both operations.
fn both(costs: &Costs, id: &str) -> [Option<f64>; 2] {
    Operation::ALL.map(|operation| costs.of(id, operation))
}

/// The catalogue's recommendations, with costs.
pub fn answers(costs: &Costs) -> Vec<Value> {
    let of_choice = |choice: &Choice| {
        let codec = find(choice.id).ok()?;
        let errors = measured(codec, false)?;
        Some(context! {
            id => codec.id,
            why => choice.why,
            bits => codec.bits,
            mean => errors.mean_deg,
            max => errors.max_deg,
            seen => codec.on_a_mirror(),
            costs => both(costs, codec.id),
            format => choice.format,
            anywhere => choice.anywhere,
        })
    };
    let of_purpose = |one: &Recommendation| {
        let codecs: Vec<Value> = one.choices.iter().filter_map(of_choice).collect();
        context! { purpose => one.purpose, codecs }
    };
    RECOMMENDED.iter().map(of_purpose).collect()
}

/// The survey's tables 1, 2 and 3, and Meyer's, beside ours.
pub fn published(all: &[Costs], count: usize, progress: &mut dyn FnMut()) -> Result<Vec<Value>> {
    let one = errors(Table::One, "The survey's table 1: errors over the sphere", count, progress)?;
    let two = of_survey(all);
    let three = errors(Table::Three, "The survey's table 3: the hemisphere z >= 0", count, progress)?;
    Ok(vec![one, two, three, meyer(count, progress)?])
}

fn errors(table: Table, title: &str, count: usize, progress: &mut dyn FnMut()) -> Result<Value> {
    let mut rows = Vec::new();
    for published in table.published() {
        let Some(codec) = published.codec() else { continue };
        let row = measure_row(&mut Cpu, table, &published, codec, count, 1)?;
        rows.push(vec![
            published.name.clone(),
            codec.bits.to_string(),
            degrees(row.mean_deg),
            degrees(published.mean_error_deg) + &published.mean_flag,
            degrees(row.max_deg),
            degrees(published.max_error_deg) + &published.max_flag,
        ]);
        progress();
    }
    let columns = ["codec", "bits", "mean", "survey's mean", "max of these", "survey's max"];
    let note = format!(
        "Degrees, measured over {count} random directions, beside the published figures; in the survey's order."
    );
    Ok(context! { title, note, columns, rows })
}

fn of_survey(all: &[Costs]) -> Value {
    let ratio = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.2}"));
    let pair = |costs: [Option<f64>; 2]| costs.map(ratio).join(" / ");
    let [encode, decode] =
        Operation::ALL.map(|operation| survey_ns(REFERENCE, operation).unwrap_or(f64::NAN));
    let rows = vectors().iter().filter_map(|codec| {
        let survey = Operation::ALL.map(|operation| survey_ns(codec.id, operation));
        let survey = pair([Some(survey[0]? / encode), Some(survey[1]? / decode)]);
        let others = all.iter().map(|costs| pair(both(costs, codec.id)));
        Some([codec.survey_name.to_owned(), survey].into_iter().chain(others).collect())
    });
    let devices =
        all.iter().map(|costs| costs.device().split([',', '(']).next().unwrap_or_default().trim_end());
    context! {
        title => "The survey's table 2: costs",
        note => format!(
            "Encoding / decoding as multiples of {REFERENCE}'s: the survey's times on a GeForce GTX 680, what the compilers of \
             AMD's GPUs estimate, and times measured on the others."
        ),
        columns => ["codec", "GTX 680 (survey)"].into_iter().chain(devices).collect::<Vec<_>>(),
        rows => rows.collect::<Vec<Vec<String>>>(),
    }
}

fn meyer(count: usize, progress: &mut dyn FnMut()) -> Result<Value> {
    let mut rows = Vec::new();
    for method in &METHODS {
        for codec in WIDTHS.iter().filter_map(|bits| method.codec(*bits)) {
            let row = measure_meyer_row(&mut Cpu, method, codec, count, 1)?;
            let bound = row.survey_max_deg.map_or_else(|| "-".to_owned(), degrees);
            rows.push(vec![
                method.name.replace('_', ", "),
                codec.id.to_owned(),
                codec.bits.to_string(),
                bound,
                degrees(row.max_deg),
            ]);
            progress();
        }
    }
    Ok(context! {
        title => "Meyer's table 1: bounds",
        note => "Degrees: the largest error as Meyer et al. estimate it for so many bits, to first order, and the largest that a \
                 search finds. What is found may lie above the estimate; at 48 bits the arithmetic in f32 adds its own, and \
                 floats of 16 bits stand for their floating-point normals. SC stands twice: as the table prints it, and by \
                 eq. 5, half of that.",
        columns => ["method", "codec", "bits", "estimate", "found"],
        rows,
    })
}

/// Rows that the page measures.
pub fn work() -> usize {
    let tables: usize = [Table::One, Table::Three].map(|table| table.published().len()).iter().sum();
    let of_meyer =
        METHODS.iter().map(|method| WIDTHS.iter().filter(|bits| method.codec(**bits).is_some()).count());
    tables + of_meyer.sum::<usize>()
}
