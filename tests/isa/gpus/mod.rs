//! Kernels of one element on GPUs of all makers, by their compilers: `docs/data/gpus/*.json`, and the selection of them that
//! ships, `host/choose/data/counted.csv`.

#[cfg(feature = "glsl")]
mod compiled;

use super::{RENEW, kernels};
use crate::docs::compare;
use std::fmt::Write;
use std::sync::LazyLock;
use unitvec_catalogue::{CODECS, Operation};
use unitvec_choose::costs::{GPUS, Gpu, KernelKind, Line, Report, Row, Source};
use unitvec_lab::textbook::TEXTBOOK;
use unitvec_tests::repository;

/// The committed counts of each GPU.
pub static COUNTED: LazyLock<Vec<(&Gpu, Report)>> =
    LazyLock::new(|| GPUS.iter().map(|gpu| (gpu, committed(gpu))).collect());

/// The GPUs of docs/costs.md's tables, at most two of a [`Line`]. The first is that whose driver most have.
pub const SHOWN: [&str; 10] =
    ["navi21", "gfx1201", "tgl", "dg2", "sm_75", "sm_86", "a730", "g52", "g610", "v3d42"];

fn committed(gpu: &Gpu) -> Report {
    let path = repository().join(gpu.path());
    let json = std::fs::read(&path).unwrap_or_default();
    Report::parse(&path, &json).unwrap_or_else(|error| panic!("{error}; {RENEW}"))
}

/// The row of a kernel; of textbooks' kernels, of this one's.
pub fn row<'a>(
    report: &'a Report,
    id: &str,
    operation: Operation,
    source: Source,
    textbook: Option<&str>,
) -> Option<&'a Row> {
    report.rows.iter().find(|row| {
        (row.id.as_str(), row.operation, row.source, row.textbook.as_deref())
            == (id, operation, source, textbook)
    })
}

/// The instructions of a codec's kernel from GLSL as a multiple of `oct32`'s.
pub fn ratio(report: &Report, id: &str, operation: Operation) -> Option<f64> {
    report.ratio_to_oct32(report.row(id, operation, Source::Glsl)?)
}

/// The instructions of a codec's kernel from Rust as a multiple of those of the exact edition, which does the same.
pub fn rust_to_exact(report: &Report, id: &str, operation: Operation) -> Option<f64> {
    let count = |source| report.beyond_idle(report.row(id, operation, source)?);
    Some(count(Source::Rust)? / count(Source::Exact)?)
}

/// Every kernel has a count on every GPU, from Rust, of both editions and of the textbook's.
#[test]
fn counts_are_complete() {
    for (gpu, report) in COUNTED.iter() {
        assert_eq!(report.kernel, KernelKind::One, "{}", gpu.name);
        for (format, operation) in kernels() {
            for source in [Source::Rust, Source::Glsl, Source::Exact] {
                let count = report.row(format.id, operation, source).and_then(|row| report.beyond_idle(row));
                assert!(count.is_some(), "{} {operation} {source} on {}", format.id, gpu.name);
            }
        }
        let of_textbooks = report.rows.iter().filter(|row| row.source == Source::Textbook).count();
        assert_eq!(of_textbooks, 2 * TEXTBOOK.len(), "{}", gpu.name);
    }
}

/// Octahedral codes cost no more than the textbook's on any GPU, precise encoders at most 0.5 and 0.65 of listing 3. AMD's
/// GPUs have an instruction that converts and packs two snorms of 16 bits as the textbook wants them: there `oct32` encodes for
/// more, the most on GCN 4, which has no packed arithmetic.
#[test]
fn octahedral_codes_cost_no_more_than_the_textbook() {
    let mut found = String::new();
    for (gpu, report) in COUNTED.iter() {
        for (id, operation, most) in [
            ("oct16", Operation::Encode, 1.0),
            ("oct16", Operation::Decode, 1.0),
            ("oct32", Operation::Encode, if gpu.line == Line::Radeon { 1.5 } else { 1.0 }),
            ("oct32", Operation::Decode, 1.0),
            ("oct16p", Operation::Encode, 0.65),
            ("oct32p", Operation::Encode, 0.5),
        ] {
            let count = |source, textbook| {
                let row = row(report, id, operation, source, textbook);
                row.and_then(|row| report.beyond_idle(row)).unwrap()
            };
            let of_textbook = count(Source::Glsl, None) / count(Source::Textbook, Some(id));
            if of_textbook > most {
                let _ = writeln!(found, "{id} {operation} on {}: {of_textbook:.2}", gpu.title);
            }
        }
    }
    assert!(found.is_empty(), "{found}");
}

/// The selection that ships has the counts' ratios, encoding and decoding for each GPU.
#[test]
fn the_shares_are_current() {
    let names: Vec<&str> = GPUS.iter().map(|gpu| gpu.name).collect();
    let mut text = format!("codec,operation,{}\n", names.join(","));
    for codec in CODECS.iter() {
        for operation in Operation::ALL {
            let of = |(_, report): &(_, _)| {
                ratio(report, codec.id, operation).map_or(String::new(), |it| format!("{it:.4}"))
            };
            let row: Vec<String> = COUNTED.iter().map(of).collect();
            let _ = writeln!(text, "{},{operation},{}", codec.id, row.join(","));
        }
    }
    compare(&repository().join("host/choose/data/counted.csv"), &text);
}
