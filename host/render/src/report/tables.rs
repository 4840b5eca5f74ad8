//! The contents of the page's tables.

use crate::Result;
use crate::Storage;
use minijinja::{Value, context};
use serde::Serialize;
use unitvec_catalogue::{AnyCodec, Domain, Operation, find, vectors};
use unitvec_choose::REFERENCE;
use unitvec_choose::costs::{GENERATIONS, USUAL};
use unitvec_choose::{COUNT, Costs, RECOMMENDED, Recommendation};
use unitvec_lab::accuracy::meyer::{METHODS, WIDTHS};
use unitvec_lab::accuracy::{Table, measure_meyer_row, measure_row};
use unitvec_lab::bench::survey_ns;
use unitvec_run::backend::Cpu;
use unitvec_run::measure::measure;

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
    hemisphere: bool,
    unit: bool,
    by_table: bool,
    /// Over the directions that the codec is for.
    mean: f64,
    /// Over z >= 0.
    mean_above: f64,
    max: f64,
    /// Encoding and decoding as multiples of oct32's, for each device with known costs.
    costs: Vec<[Option<f64>; 2]>,
}

/// Costs that ship with the program: that of `choose`, then the others, the newest first, then lavapipe's.
///
/// # Errors
/// [`Error::BadCosts`](unitvec_choose::Error::BadCosts), which would be a fault of this crate.
pub fn shipped_costs() -> Result<Vec<Costs>> {
    let others = GENERATIONS.iter().rev().map(|one| one.name).filter(|name| *name != USUAL);
    [USUAL].into_iter().chain(others).chain(["lavapipe"]).map(|name| Ok(Costs::shipped(name)?)).collect()
}

/// All codecs of vectors, in the order of `choose`.
pub fn codecs(all: &[Costs], progress: &mut dyn FnMut()) -> Result<Vec<Codec>> {
    let mut codecs = Vec::new();
    for codec in vectors() {
        let of_gpu = |costs: &Costs| Operation::ALL.map(|operation| costs.of(codec.id, operation));
        let mean_over =
            |domain| -> Result<f64> { Ok(measure(&mut Cpu, codec, domain, COUNT, 1)?.normal.mean_deg()) };
        let mean_above = mean_over(Domain::Hemisphere)?;
        let is_for_above = codec.domain == Domain::Hemisphere;
        codecs.push(Codec {
            id: codec.id,
            name: codec.survey_name,
            bits: codec.bits,
            bytes: codec.bytes,
            format: codec.vk_format.map(short_format),
            hemisphere: is_for_above,
            unit: codec.is_unit,
            by_table: codec.encodes_by_table,
            mean: if is_for_above { mean_above } else { mean_over(codec.domain)? },
            mean_above,
            max: f64::from(codec.max_error_deg()),
            costs: all.iter().map(of_gpu).collect(),
        });
        progress();
    }
    let cost = |codec: &Codec| codec.costs[0][0].zip(codec.costs[0][1]).map_or(f64::INFINITY, |(a, b)| a + b);
    codecs.sort_by(|a, b| {
        a.bytes.cmp(&b.bytes).then(cost(a).total_cmp(&cost(b))).then(a.mean.total_cmp(&b.mean))
    });
    Ok(codecs)
}

fn short_format(name: &'static str) -> &'static str {
    name.strip_prefix("VK_FORMAT_").unwrap_or(name)
}

/// The attachment for a codec in a G-buffer: of the codec's format, or of its sibling of four components.
fn attachment(format: &AnyCodec) -> String {
    let storage = Storage::of(format);
    let spare = if storage.three().is_some() { ", whose fourth component is free" } else { "" };
    let or = if storage.is_drawn_everywhere() {
        ""
    } else {
        ", or in R32_UINT where a device does not draw to that"
    };
    format!("{:?}{spare}{or}", storage.texel())
}

/// The recommendations of `choose` and README.
pub fn answers(codecs: &[Codec]) -> Vec<Value> {
    let of_codec = |id: &&'static str| {
        let codec = find(id).ok()?;
        let measured = codecs.iter().find(|measured| measured.id == codec.id);
        Some(context! {
            id => codec.id,
            bits => codec.bits,
            format => codec.vk_format.map(short_format),
            attachment => attachment(codec),
            mean => measured.map(|measured| measured.mean),
            max => f64::from(codec.max_errors_deg[0]),
            costs => measured.map_or([None; 2], |measured| measured.costs[0]),
        })
    };
    let of_purpose = |one: &Recommendation| {
        let codecs: Vec<Value> = one.codecs.iter().filter_map(of_codec).collect();
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
            degrees(published.mean_error_deg),
            degrees(row.max_deg),
            degrees(published.max_error_deg),
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
    let both = |costs: [Option<f64>; 2]| costs.map(ratio).join(" / ");
    let [encode, decode] =
        Operation::ALL.map(|operation| survey_ns(REFERENCE, operation).unwrap_or(f64::NAN));
    let rows = vectors().iter().filter_map(|codec| {
        let survey = Operation::ALL.map(|operation| survey_ns(codec.id, operation));
        let survey = both([Some(survey[0]? / encode), Some(survey[1]? / decode)]);
        let others =
            all.iter().map(|costs| both(Operation::ALL.map(|operation| costs.of(codec.id, operation))));
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
                 floats of 16 bits stand for their floating-point normals.",
        columns => ["method", "codec", "bits", "estimate", "found"],
        rows,
    })
}

/// Rows that the page measures.
pub fn work() -> usize {
    let tables: usize = [Table::One, Table::Three].map(|table| table.published().len()).iter().sum();
    let of_meyer =
        METHODS.iter().map(|method| WIDTHS.iter().filter(|bits| method.codec(**bits).is_some()).count());
    vectors().len() + tables + of_meyer.sum::<usize>()
}

/// Degrees with three digits that count.
pub fn degrees(value: f64) -> String {
    if value <= 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if value < 1e-4 {
        return format!("{value:.2e}");
    }
    let digits = (2 - value.log10().floor() as i32).clamp(0, 8) as usize;
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_have_three_digits() {
        for (value, text) in
            [(0.63575, "0.636"), (0.0195, "0.0195"), (12.34, "12.3"), (1.5e-6, "1.50e-6"), (0.0, "0")]
        {
            assert_eq!(degrees(value), text);
        }
    }
}
