//! The kernels compiled again, by the RADV that is installed here.

use super::{CODECS, GIVEN, KEYED, KEYS, committed, path, row_id};
use crate::isa::compiled::{comparable, dearer};
use crate::isa::{RENEW, rdna2};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use unitvec_catalogue::{Operation, find};
use unitvec_choose::costs::{Report, Row, Source};
use unitvec_lab::isa::radv::Radv;
use unitvec_manifest::sha256_hex;
use unitvec_run::glsl;
use unitvec_run::glsl::{Compiler, ENTRY_POINT};
use unitvec_vulkan::{DeviceChoice, Division, Inspector, Instance};

const KERNEL: &str = include_str!("kernel.comp");

/// Names the file that [`compile`] writes to.
const OUTPUT: &str = "UNITVEC_DITHERED_COSTS";

/// The report of the system's RADV on the kernels. A process compiles for one GPU only, and a driver that does not know
/// it ends the process: so another one of this program does that.
fn compiled() -> Result<Report, String> {
    let radv = Radv::new(rdna2().gpu, None).map_err(|error| error.to_string())?;
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("costs.json");
    let mut program = Command::new(std::env::current_exe().unwrap());
    program.args(["--ignored", "--exact", "isa::dithered::compiled::compile"]);
    let ended = program.envs(radv.environment()).env(OUTPUT, &output).output().unwrap();
    if !ended.status.success() {
        let said = [ended.stdout, ended.stderr].concat();
        return Err(String::from_utf8_lossy(&said).into_owned());
    }
    Ok(Report::parse(&output, &std::fs::read(&output).unwrap()).unwrap())
}

/// The files that the kernels come from, with the first half of their SHA-256, as in the shipped figures.
fn sources() -> BTreeMap<String, String> {
    let hash = |text: &str| sha256_hex(text.as_bytes())[..32].to_owned();
    let of_library =
        ["arith", "oct", "hemioct", "soct", "eaoct", "dither"].map(|name| format!("unitvec/{name}.glsl"));
    let of_kernels = ["group", "words"].map(|name| format!("kernels/{name}.glsl"));
    let shipped = of_library.iter().chain(&of_kernels);
    let mut sources: BTreeMap<String, String> =
        shipped.map(|file| (format!("glsl/{file}"), hash(glsl::source(file).unwrap()))).collect();
    sources.insert("tests/isa/dithered/kernel.comp".to_owned(), hash(KERNEL));
    sources
}

/// Compiles the kernels for the device of this process.
#[test]
#[ignore = "other tests run it with the environment of a driver"]
fn compile() {
    let Some(output) = std::env::var_os(OUTPUT) else { return };
    let instance = Arc::new(Instance::new(None, false).unwrap());
    let inspector = Inspector::open(&instance, &DeviceChoice::Best).unwrap();
    let compiler = Compiler::new().unwrap();
    let given = CODECS.map(|codec| (codec, GIVEN));
    let kernels = given.into_iter().chain(KEYS.map(|key| (KEYED, key)));
    let rows = kernels.flat_map(|(codec, key)| {
        Operation::ALL.map(|operation| row(&inspector, &compiler, codec, operation, key))
    });
    let device = inspector.device().info().clone();
    let report = Report { device, sources: sources(), rows: rows.collect() };
    unitvec_files::write_file(Path::new(&output), report.to_json().as_bytes()).unwrap();
}

fn row(inspector: &Inspector, compiler: &Compiler, codec: &str, operation: Operation, key: &str) -> Row {
    let format = find(codec).unwrap();
    let macros = [
        (operation.to_string().to_uppercase(), format!("{codec}_{operation}_dithered")),
        ("BYTES".to_owned(), format.bytes.to_string()),
        ("KEY".to_owned(), key.to_owned()),
    ];
    let module = compiler.compile("kernels/dithered.comp", KERNEL, &macros).unwrap();
    let statistics = inspector.statistics(Division::Device, &module, ENTRY_POINT).unwrap();
    let device = &inspector.device().info().name;
    unitvec_lab::isa::row(&row_id(codec, key), operation, Source::Glsl, None, &statistics, device)
}

/// Each function is compiled again, and its cost matches the record.
#[test]
fn dithered_functions_cost_what_is_recorded() {
    let before = committed();
    let Some(after) = comparable(&before, compiled()) else { return };
    let (dearer, cheaper) = (dearer(&before, &after), dearer(&after, &before));
    assert!(
        dearer.is_empty() && cheaper.is_empty(),
        "not as recorded; dearer:\n{}\ncheaper, with before and after the other way around:\n{}\n{RENEW}",
        dearer.join("\n"),
        cheaper.join("\n")
    );
}

/// Compiles all again.
#[test]
#[ignore = "`cargo xtask renew costs` runs it"]
fn renew() {
    let report = compiled().unwrap();
    unitvec_files::write_file(&path(), report.to_json().as_bytes()).unwrap();
    println!("{}: written, of {}", path().display(), report.subject());
}
