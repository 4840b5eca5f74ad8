//! Costs of the exact editions' barriers: the same kernel from each edition by the compiler of a GPU's driver. HLSL has
//! `precise` instead.

use crate::cases::Case;
use crate::report::write_csv;
use crate::spirv::Compiler;
use crate::{Result, job, slang_to_spirv, told};
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;
use unitvec_catalogue::Operation;
use unitvec_run::shader::kernel::ENTRY_POINT;
use unitvec_run::shader::{Edition, Language, compile};
use unitvec_vulkan::{DeviceChoice, Division, Inspector, Instance};

/// The codecs that stand for the others.
pub const CODECS: [&str; 8] =
    ["oct16", "oct32", "oct32p", "eaoct32", "ico32", "fib32", "spherical32", "frame32"];

/// Instructions of the kernels of one codec.
#[derive(Serialize)]
struct Row {
    codec: &'static str,
    operation: Operation,
    hlsl: u64,
    wgsl_plain: u64,
    wgsl_exact: u64,
    slang_plain: u64,
    slang_exact: u64,
}

/// Compiles with the device of this process, and writes the results.
pub fn record(cases: &[Case], dxc: &Compiler<'_>, slang: &Path, path: &Path) -> Result<()> {
    let instance = Arc::new(Instance::new(None, false).map_err(told)?);
    let inspector = Inspector::open(&instance, &DeviceChoice::Best).map_err(told)?;
    let of_library = |compiler: &Compiler<'_>, language, edition| {
        let mut counts = Vec::new();
        let jobs = job::jobs(cases, language, edition)?;
        compiler.compile(&jobs, &mut |case, module| {
            counts.push(instructions(&inspector, &case.name(), &module?)?);
            Ok(())
        })?;
        Ok::<_, String>(counts)
    };
    let of_naga = |edition| {
        let jobs = job::jobs(cases, Language::Wgsl, edition)?;
        let count = |job: &job::Job<'_>| {
            let name = job.case.name();
            let module = compile(Language::Wgsl, &name, &job.text).map_err(told)?;
            instructions(&inspector, &name, &module)
        };
        jobs.iter().map(count).collect::<Result<Vec<_>>>()
    };
    let hlsl = of_library(dxc, Language::Hlsl, Edition::Plain)?;
    let [wgsl_plain, wgsl_exact] = [of_naga(Edition::Plain)?, of_naga(Edition::Exact)?];
    let of_slang = |edition| of_library(&slang_to_spirv(slang, edition), Language::Slang, edition);
    let [slang_plain, slang_exact] = [of_slang(Edition::Plain)?, of_slang(Edition::Exact)?];

    let rows = cases.iter().enumerate().map(|(n, case)| Row {
        codec: case.format.id,
        operation: case.operation,
        hlsl: hlsl[n],
        wgsl_plain: wgsl_plain[n],
        wgsl_exact: wgsl_exact[n],
        slang_plain: slang_plain[n],
        slang_exact: slang_exact[n],
    });
    write_csv(rows, path)
}

fn instructions(inspector: &Inspector, name: &str, module: &[u8]) -> Result<u64> {
    let statistics = inspector
        .statistics(Division::Device, module, ENTRY_POINT)
        .map_err(|error| format!("{name}: {error}"))?;
    let count = statistics.get("Instructions").copied();
    count.ok_or_else(|| format!("{name}: the driver does not count instructions"))
}
