//! Costs on GPUs that are not there, by their compilers, held against the committed `host/choose/data/costs_*.json`,
//! and those against their promises. `cargo xtask renew costs` renews them; `records.lock` has the hash of their
//! kernels.

#[cfg(feature = "glsl")]
mod apart;
#[cfg(feature = "glsl")]
mod compiled;
pub mod dithered;
pub mod gpus;
pub mod stages;

use unitvec_catalogue::{AnyCodec, CODECS, Operation};
use unitvec_choose::costs::{GENERATIONS, Generation, Report, Source};
use unitvec_tests::repository;

/// The advice on renewing the figures.
const RENEW: &str = "renew the figures: cargo xtask renew costs";

/// The generation whose costs are promised.
fn rdna2() -> &'static Generation {
    unitvec_choose::costs::find_generation("rdna2").unwrap()
}

/// The committed figures.
pub fn committed(generation: &Generation) -> Report {
    let path = repository().join(generation.path());
    Report::parse(&path, &std::fs::read(&path).unwrap()).unwrap_or_else(|error| panic!("{error}; {RENEW}"))
}

/// The committed figures in a file of `docs/data/`.
fn recorded(file: &str) -> Report {
    let path = repository().join("docs/data").join(file);
    let json = std::fs::read(&path).unwrap_or_default();
    Report::parse(&path, &json).unwrap_or_else(|error| panic!("{error}; {RENEW}"))
}

/// Every kernel has figures for every generation, compiled for its GPU.
#[test]
fn costs_are_complete() {
    for generation in &GENERATIONS {
        let report = committed(generation);
        assert!(report.device.name.to_lowercase().contains(generation.gpu), "{}", report.device.name);
        assert!(report.device.driver.contains("Mesa"), "{}", report.device.driver);
        for (format, operation) in kernels() {
            for source in [Source::Rust, Source::Exact, Source::Glsl] {
                let row = report.row(format.id, operation, source);
                let is_whole = row.is_some_and(|row| {
                    row.instructions.is_some()
                        && row.inverse_throughput.is_some()
                        && row.vector_registers.is_some()
                });
                assert!(is_whole, "{} {operation} from {source}, {}", format.id, generation.gpu);
            }
        }
    }
}

fn kernels() -> impl Iterator<Item = (&'static AnyCodec, Operation)> {
    CODECS.iter().flat_map(|format| Operation::ALL.map(|operation| (format, operation)))
}

/// Kernels from Rust have, compiled by the driver, at most 1.02 times the instructions of those from GLSL.
#[test]
fn rust_costs_what_glsl_costs() {
    let report = committed(rdna2());
    let ratio = |(format, operation): (&'static AnyCodec, Operation)| {
        let row = report.row(format.id, operation, Source::Rust).unwrap();
        (format.id, operation, report.ratio_to_glsl(row).unwrap())
    };
    let found: Vec<String> = kernels()
        .map(ratio)
        .filter(|(.., ratio)| *ratio > 1.02)
        .map(|(id, operation, ratio)| format!("{id} {operation} {ratio:.3}"))
        .collect();
    assert!(found.is_empty(), "more instructions from Rust than 1.02 times those from GLSL: {found:?}");
}

/// The greatest inverse throughput that is promised for encoding and decoding on RDNA 2.
const PROMISED: [(&str, Option<u64>, Option<u64>); 11] = [
    ("oct32", Some(114), Some(136)),
    ("oct16", Some(117), Some(138)),
    ("oct24", Some(147), Some(186)),
    ("oct32p", Some(306), Some(136)),
    ("oct16p", Some(453), Some(138)),
    ("hemioct16", Some(111), None),
    ("hemioct32", Some(111), None),
    ("soct17", Some(117), None),
    ("soct33", Some(117), None),
    ("frame32", Some(820), Some(522)),
    ("ico24", Some(1150), None),
];

/// Kernels cost no more than promised.
#[test]
fn kernels_cost_what_is_promised() {
    let report = committed(rdna2());
    let mut above = Vec::new();
    for (id, encode, decode) in PROMISED {
        for (operation, limit) in [(Operation::Encode, encode), (Operation::Decode, decode)] {
            let cost = report.row(id, operation, Source::Glsl).unwrap().inverse_throughput.unwrap();
            if limit.is_some_and(|limit| cost > limit) {
                above.push(format!("{id} {operation}: {cost} above {limit:?}"));
            }
        }
    }
    assert!(above.is_empty(), "{above:?}");
}

/// The inverse throughput of textbooks' kernels on navi21, encoding and decoding, as a script measured it with Mesa 22.3.6 that
/// shares nothing with the program.
const TEXTBOOKS: [(&str, u64, Option<u64>); 9] = [
    ("oct32", 99, Some(147)),
    ("oct16", 150, Some(149)),
    ("oct24", 215, Some(203)),
    ("oct32p", 657, None),
    ("oct16p", 708, None),
    ("hemioct32", 57, None),
    ("hemioct16", 108, None),
    ("soct33", 75, None),
    ("soct17", 132, None),
];

/// The program finds what the script found. Other versions of Mesa may differ by a tenth.
#[test]
fn textbooks_cost_what_was_measured_apart() {
    let report = committed(rdna2());
    for (id, encode, decode) in TEXTBOOKS {
        for (operation, expected) in [(Operation::Encode, Some(encode)), (Operation::Decode, decode)] {
            let Some(expected) = expected else { continue };
            let row = report.row(id, operation, Source::Textbook).unwrap();
            let found = row.inverse_throughput.unwrap();
            let allowed = if report.device.driver.ends_with("22.3.6") { 0 } else { expected / 10 };
            assert!(found.abs_diff(expected) <= allowed, "{id} {operation}: {found}, not {expected}");
        }
    }
}
