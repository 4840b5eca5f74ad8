//! Costs of codecs: measured, as `unitvec bench device --json` wrote them to `host/choose/data/`, and by GPUs' compilers.

use super::tables::is_shown;
use super::{compare, markdown_table};
use crate::isa::gpus::{COUNTED, SHOWN, ratio, row, rust_to_exact};
use crate::isa::{committed, stages};
use std::path::Path;
use std::sync::LazyLock;
use unitvec_catalogue::{AnyCodec, CODECS, Operation};
use unitvec_choose::MEASURED;
use unitvec_choose::costs::{GENERATIONS, Generation, Gpu, Report, Row, Source, Times, find_gpu};
use unitvec_lab::isa::pareto;
use unitvec_lab::textbook::TEXTBOOK;
use unitvec_tests::repository;
use unitvec_vulkan::DeviceInfo;

/// The reports of [`MEASURED`].
static REPORTS: LazyLock<[Report; 2]> =
    LazyLock::new(|| MEASURED.map(|(name, report)| Report::parse(Path::new(name), report).unwrap()));

/// The times of a codec's kernel in SPIR-V from Rust.
fn times<'a>(report: &'a Report, id: &str, operation: Operation) -> Option<&'a Times> {
    report.row(id, operation, Source::Rust)?.times.as_deref()
}

/// The arithmetic of that kernel as a multiple of that of `oct32`'s.
fn to_oct32(report: &Report, id: &str, operation: Operation) -> Option<f64> {
    times(report, id, operation)?.ratio_to_oct32
}

/// The inverse throughput of encoding or decoding on RDNA 2 as a multiple of `oct32`'s.
pub fn cost(id: &str, operation: Operation) -> f64 {
    let row = rdna2().row(id, operation, Source::Glsl).unwrap();
    rdna2().ratio_to_oct32(row).unwrap()
}

/// The costs of both operations on RDNA 2.
pub fn both(id: &str) -> String {
    Operation::ALL.map(|operation| format!("{:.1}", cost(id, operation))).join(" / ")
}

/// The catalogue has the costs on RDNA 2.
#[test]
fn the_catalogue_is_current() {
    let row = |codec: &AnyCodec| {
        let [encode, decode] = Operation::ALL.map(|operation| cost(codec.id, operation));
        format!("{},{encode},{decode}\n", codec.id)
    };
    let text = String::from("codec,encode,decode\n") + &CODECS.iter().map(row).collect::<String>();
    compare(&repository().join("catalogue/data/costs.csv"), &text);
}

/// A number with so many digits, or a dash where there is none.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.digits$}"))
}

/// True where the arithmetic of both operations was measured on every device.
pub fn is_measured(id: &str) -> bool {
    let has = |report| Operation::ALL.iter().all(|operation| to_oct32(report, id, *operation).is_some());
    REPORTS.iter().all(has)
}

/// The devices, and the amount of their work.
pub fn devices() -> String {
    let rows = REPORTS.iter().map(|report| {
        let DeviceInfo { name, driver, api_version, .. } = &report.device;
        let (count, repetitions) = (report.count.unwrap(), report.repetitions.unwrap());
        format!("{name} | {driver} | {api_version} | {count} | {repetitions}")
    });
    markdown_table("device | driver | Vulkan | vectors | times each", rows)
}

/// Costs of both operations: inverse throughput on all generations of GPUs and measured arithmetic, as multiples of
/// `oct32`'s; the other figures of RDNA 2, and the speed of the shipped kernels.
pub fn table(rows: &str) -> String {
    let measured = MEASURED.map(|(name, _)| name).join(" | ");
    let titles: Vec<&str> = COMPILED.iter().map(|(generation, _)| generation.title).collect();
    let titles = format!(
        "codec: encode / decode | {} | {measured} | RDNA 2: T | vector / v | registers | rust / glsl | % of copy: {measured}",
        titles.join(" | ")
    );
    let shown = CODECS.iter().map(|format| format.id).filter(|id| is_shown(rows, id)).map(|id| {
        let mut cells: Vec<String> = COMPILED
            .iter()
            .map(|(_, report)| {
                pair(1, |operation| report.ratio_to_oct32(report.row(id, operation, Source::Glsl)?))
            })
            .collect();
        let integer = |figure: fn(&Row) -> Option<u64>| {
            pair(0, |operation| Some(figure(rdna2().row(id, operation, Source::Glsl)?)? as f64))
        };
        let measured = |report| pair(1, |operation| to_oct32(report, id, operation));
        cells.extend(REPORTS.iter().map(measured));
        cells.extend([
            integer(|row| row.inverse_throughput),
            pair(1, |operation| vector_instructions(id, operation)),
            integer(|row| row.vector_registers),
            pair(2, |operation| rdna2().ratio_to_glsl(rdna2().row(id, operation, Source::Rust)?)),
        ]);
        cells.extend(
            REPORTS.iter().map(|report| pair(0, |operation| times(report, id, operation)?.of_copy())),
        );
        format!("`{id}` | {}", cells.join(" | "))
    });
    markdown_table(&titles, shown)
}

/// A figure of both operations, with so many decimals.
fn pair(digits: usize, figure: impl Fn(Operation) -> Option<f64>) -> String {
    Operation::ALL.map(|operation| number(figure(operation), digits)).join(" / ")
}

/// The committed figures of each generation.
static COMPILED: LazyLock<Vec<(&Generation, Report)>> =
    LazyLock::new(|| GENERATIONS.iter().map(|generation| (generation, committed(generation))).collect());

/// The committed figures of RDNA 2.
pub fn rdna2() -> &'static Report {
    &COMPILED.iter().find(|(generation, _)| generation.name == "rdna2").unwrap().1
}

/// The vector instructions of encoding or decoding a vector on RDNA 2.
pub fn vector_instructions(id: &str, operation: Operation) -> Option<f64> {
    rdna2().row(id, operation, Source::Glsl)?.vector_instructions
}

fn shown() -> impl Iterator<Item = &'static (&'static Gpu, Report)> {
    COUNTED.iter().filter(|(gpu, _)| SHOWN.contains(&gpu.name))
}

/// Costs of both operations on GPUs of all makers, as multiples of `oct32`'s: of the recommended codecs with the textbook's
/// functions on some, or of all codecs on all.
pub fn gpus(rows: &str) -> String {
    let is_all = rows != "recommended";
    let shown: Vec<_> = if is_all { COUNTED.iter().collect() } else { shown().collect() };
    let titles: Vec<&str> = shown.iter().map(|(gpu, _)| gpu.title).collect();
    let line = |name: &str, source, id: &str, textbook: Option<&str>| {
        let of =
            |report: &Report, operation| report.ratio_to_oct32(row(report, id, operation, source, textbook)?);
        let cells: Vec<String> =
            shown.iter().map(|(_, report)| pair(1, |operation| of(report, operation))).collect();
        format!("{name} | {}", cells.join(" | "))
    };
    let codecs = CODECS.iter().map(|format| format.id).filter(|id| is_all || is_shown(rows, id));
    let codecs = codecs.map(|id| line(&format!("`{id}`"), Source::Glsl, id, None));
    let textbooks = TEXTBOOK.iter().filter(|one| is_all || one.id == one.codec && is_shown(rows, one.codec));
    let textbooks = textbooks
        .map(|one| line(&format!("textbook `{}`", one.id), Source::Textbook, one.codec, Some(one.id)));
    markdown_table(&format!("encode / decode | {}", titles.join(" | ")), codecs.chain(textbooks))
}

/// The pairs of recommended codecs whose order by cost is another than on RDNA 2, by a tenth on both.
pub fn order() -> String {
    let codecs: Vec<&str> =
        CODECS.iter().map(|format| format.id).filter(|id| is_shown("recommended", id)).collect();
    let of = |gpu: &str, id: &str, operation| {
        let (_, report) = COUNTED.iter().find(|(one, _)| one.name == gpu)?;
        ratio(report, id, operation)
    };
    let rows = SHOWN.iter().skip(1).map(|gpu| {
        let changed = |operation| {
            let pairs = codecs.iter().flat_map(|a| codecs.iter().map(move |b| (*a, *b)));
            let is_other = |(a, b): &(&str, &str)| {
                let less = |gpu: &str, a: &str, b: &str| {
                    Some(1.1 * of(gpu, a, operation)? <= of(gpu, b, operation)?)
                };
                less("navi21", a, b) == Some(true) && less(gpu, b, a) == Some(true)
            };
            let found: Vec<String> = pairs.filter(is_other).map(|(a, b)| format!("`{b}` < `{a}`")).collect();
            if found.is_empty() { "as there".to_owned() } else { found.join(", ") }
        };
        let [encode, decode] = Operation::ALL.map(changed);
        format!("{} | {encode} | {decode}", find_gpu(gpu).unwrap().title)
    });
    markdown_table("GPU | encode | decode", rows)
}

/// The kernels from Rust beside those of the exact edition, from the least ratio of instructions to the largest; encoders by
/// table, which Rust's are not, are left out.
pub fn rust() -> String {
    let rows = shown().map(|(gpu, report)| {
        let of = |operation| {
            let by_table = |codec: &&AnyCodec| codec.encodes_by_table && operation == Operation::Encode;
            let ratio = |codec: &AnyCodec| Some((codec.id, rust_to_exact(report, codec.id, operation)?));
            let mut ratios: Vec<(&str, f64)> =
                CODECS.iter().filter(|codec| !by_table(codec)).filter_map(ratio).collect();
            ratios.sort_by(|a, b| a.1.total_cmp(&b.1));
            let (last, (id, most)) = (ratios.len() - 1, ratios[ratios.len() - 1]);
            format!("{:.2}, {:.2}, {most:.2} (`{id}`)", ratios[0].1, ratios[last / 2].1)
        };
        let [encode, decode] = Operation::ALL.map(of);
        format!("{} | {encode} | {decode}", gpu.title)
    });
    markdown_table("GPU | encode: least, median, most | decode: least, median, most", rows)
}

/// The compilers of the counts.
pub fn counters() -> String {
    let rows = COUNTED.iter().map(|(gpu, report)| {
        format!("{} | {} | `{}` | {}", gpu.title, gpu.series, gpu.name, report.device.driver)
    });
    markdown_table("GPU | in | name | compiler", rows)
}

/// The price of exact kernels on RDNA 2, beside plain ones, both from Rust: vector instructions of a vector, and T.
pub fn exact() -> String {
    let shown = CODECS.iter().map(|format| format.id).filter(|id| is_shown("recommended", id)).map(|id| {
        let row = |operation, source| rdna2().row(id, operation, source);
        let instructions = |source| pair(1, |operation| row(operation, source)?.vector_instructions);
        let throughput =
            |source| pair(0, |operation| Some(row(operation, source)?.inverse_throughput? as f64));
        let [plain, exact] = [Source::Rust, Source::Exact];
        format!(
            "`{id}` | {} | {} | {} | {}",
            instructions(plain),
            instructions(exact),
            throughput(plain),
            throughput(exact)
        )
    });
    let titles = "codec: encode / decode | vector / v, plain | vector / v, exact | T, plain | T, exact";
    markdown_table(titles, shown)
}

/// Costs in pixel and vertex shaders, unitvec's beside the textbook's.
pub fn stages() -> String {
    let reports: Vec<Report> = stages::gpus().map(|gpu| stages::committed(gpu.name)).collect();
    let rows = stages::WAYS.iter().map(|way| {
        let stages::Way(place, format, ours, textbook) = way;
        let cells = reports.iter().map(|report| {
            let of = |expression: &str| {
                let count = way.beyond_idle(report, expression, |row| row.instructions);
                count.map_or_else(|| "-".to_owned(), |count| count.to_string())
            };
            format!("{} / {}", of(ours), textbook.map_or_else(|| "-".to_owned(), of))
        });
        format!("{place} | `{:?}` | `{ours}` | {}", format.raw, cells.collect::<Vec<_>>().join(" | "))
    });
    let titles = stages::gpus().map(|gpu| gpu.title).collect::<Vec<_>>().join(" | ");
    markdown_table(&format!("shader | format | unitvec's / the textbook's instructions | {titles}"), rows)
}

/// The compilers of the figures.
pub fn compilers() -> String {
    let rows = COMPILED.iter().map(|(generation, report)| {
        format!("{} | `{}` | {}", generation.title, generation.gpu, report.device.driver)
    });
    markdown_table("generation | GPU | compiler", rows)
}

/// The charts of error against cost show the committed figures, on RDNA 2 and on a GPU of each other maker.
#[test]
fn the_chart_is_current() {
    compare(&repository().join("docs/pareto.svg"), &pareto::svg(rdna2()).unwrap());
    for (gpu, report) in
        COUNTED.iter().filter(|(gpu, _)| ["dg2", "sm_86", "a730", "g610", "v3d42"].contains(&gpu.name))
    {
        compare(&repository().join(format!("docs/pareto_{}.svg", gpu.name)), &pareto::svg(report).unwrap());
    }
}

/// The chart names the codecs on its fronts, and nothing else.
#[test]
fn the_chart_names_its_fronts() {
    let svg = pareto::svg(rdna2()).unwrap();
    let is_named = |id: &str| svg.contains(&format!("\n{id}\n"));
    for operation in Operation::ALL {
        let points = pareto::points(rdna2(), operation);
        // The codec with the least error of all is in a front, however much it costs; so is the cheapest.
        let finest = points.iter().min_by(|a, b| a.error_deg.total_cmp(&b.error_deg)).unwrap();
        assert!(is_named(finest.codec.id) && is_named(points[0].codec.id), "{}", finest.codec.id);
    }
    assert!(is_named("ico16") && is_named("ico24") && is_named("ico32"));
    assert!(!is_named("stereo16") && !is_named("hemioct16"));
}
