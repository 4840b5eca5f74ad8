//! The kernels compiled again, by the compilers that are here.

use super::committed;
use crate::isa::RENEW;
use crate::isa::compiled::{NEWER_DRIVER, compiled, dearer};
use std::io::Write;
use std::path::PathBuf;
use unitvec_catalogue::{AnyCodec, CODECS};
use unitvec_choose::costs::{GPUS, Gpu, KernelKind, Line, Report};
use unitvec_run::conform::widest_of_each_series;
use unitvec_tests::repository;

/// The report of a GPU's compiler; AMD's GPUs have the newer driver's, which tells more.
fn asked(gpu: &Gpu, codecs: impl IntoIterator<Item = &'static AnyCodec>) -> Result<Report, String> {
    let newer = std::env::var_os(NEWER_DRIVER).map(PathBuf::from).filter(|_| gpu.line == Line::Radeon);
    if gpu.line == Line::Radeon && newer.is_none() {
        return Err(format!("{NEWER_DRIVER} names no driver"));
    }
    compiled((gpu.name, KernelKind::One), newer.as_deref(), codecs)
}

/// True if a compiler is not here: other refusals are faults.
fn is_absent(reason: &str) -> bool {
    reason.contains(NEWER_DRIVER) || reason.contains("UNITVEC_COMPILERS")
}

/// No kernel has become dearer on the GPUs whose compilers are here: those of the widest codec of each series.
#[test]
fn no_kernel_is_dearer_than_committed() {
    let mut found = Vec::new();
    let mut left = Vec::new();
    for gpu in &GPUS {
        let before = committed(gpu);
        match asked(gpu, widest_of_each_series()) {
            Ok(after) if before.device == after.device => {
                let lines = dearer(&before, &after);
                found.extend(lines.into_iter().map(|line| format!("{}: {line}", gpu.name)));
            }
            Err(reason) if !is_absent(&reason) => found.push(format!("{}: {reason}", gpu.name)),
            _ => left.push(gpu.name),
        }
    }
    if !left.is_empty() {
        // It says so even where tests pass.
        let left = left.join(", ");
        let said = format!("warning: the counts on {left} are not compared: their compilers are not here");
        let _ = writeln!(std::io::stderr(), "{said}");
    }
    assert!(found.is_empty(), "dearer than committed:\n{}\nif it has to be: {RENEW}", found.join("\n"));
}

/// Compiles all kernels again, for all GPUs.
#[test]
#[ignore = "`cargo xtask renew costs` runs it: some minutes"]
fn renew() {
    for gpu in &GPUS {
        let report = asked(gpu, &CODECS).unwrap_or_else(|reason| panic!("{}: {reason}", gpu.name));
        let path = repository().join(gpu.path());
        if let Ok(before) =
            std::fs::read(&path).map_err(drop).and_then(|json| Report::parse(&path, &json).map_err(drop))
        {
            dearer(&before, &report).iter().for_each(|line| println!("{}: {line}", gpu.name));
        }
        unitvec_files::write_file(&path, report.to_json().as_bytes()).unwrap();
        println!("{}: written, of {}", path.display(), report.subject());
    }
}
