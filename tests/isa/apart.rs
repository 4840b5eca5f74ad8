//! Shaders compiled by another process: a process compiles for one GPU only, and a driver that does not know it ends the
//! process.

use super::compiled::{comparable, dearer, newer_driver};
use super::{RENEW, recorded};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use unitvec_choose::costs::{KernelKind, Report, Row, find_generation};
use unitvec_lab::isa::Asked;
use unitvec_lab::isa::stand_in::StandIn;
use unitvec_manifest::sha256_hex;
use unitvec_run::glsl::{self, Compiler};
use unitvec_tests::repository;
use unitvec_vulkan::{DeviceChoice, Inspector, Instance};

/// Names the file that [`compile`] writes to.
const OUTPUT: &str = "UNITVEC_COMPILED_COSTS";

/// The report that a test of this name makes by [`compile`] with the compiler for a GPU.
fn compiled(test: &str, gpu: &str) -> Result<Report, String> {
    let newer = find_generation(gpu).and_then(newer_driver);
    let stand_in = StandIn::new(gpu, newer.as_deref()).map_err(|error| error.to_string())?;
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("costs.json");
    let mut program = Command::new(std::env::current_exe().unwrap());
    program.args(["--ignored", "--exact", test]).env(OUTPUT, &output);
    program.stdout(Stdio::piped()).stderr(Stdio::piped());
    let _said = stand_in.prepare(&mut program).unwrap();
    let ended = program.spawn().and_then(Child::wait_with_output).unwrap();
    if !ended.status.success() {
        let said = [ended.stdout, ended.stderr].concat();
        return Err(String::from_utf8_lossy(&said).into_owned());
    }
    Ok(Report::parse(&output, &std::fs::read(&output).unwrap()).unwrap())
}

/// Compiles for the device of this process, and writes the rows where [`compiled`] waits for them. They come from these
/// files of `glsl/` and from others of these names and texts.
pub fn compile(
    files: &[&str],
    others: &[(&str, &str)],
    rows: impl FnOnce(&Asked<'_>, &Compiler) -> Vec<Row>,
) {
    let Some(output) = std::env::var_os(OUTPUT) else { return };
    let instance = Arc::new(Instance::new(None, false).unwrap());
    let inspector = Inspector::open(&instance, &DeviceChoice::Best).unwrap();
    // The first half of the SHA-256, as in the shipped figures.
    let hash = |text: &str| sha256_hex(text.as_bytes())[..32].to_owned();
    let shipped = files.iter().map(|file| (format!("glsl/{file}"), hash(glsl::source(file).unwrap())));
    let others = others.iter().map(|(file, text)| ((*file).to_owned(), hash(text)));
    let rows = rows(&Asked::new(&inspector).unwrap(), &Compiler::new().unwrap());
    let device = inspector.device().info().clone();
    let report = Report {
        sources: shipped.chain(others).collect(),
        ..Report::new(device, KernelKind::default(), rows)
    };
    unitvec_files::write_file(Path::new(&output), report.to_json().as_bytes()).unwrap();
    // VideoCore's stand-in waits for its queue, and ends the process.
    std::mem::forget(inspector);
}

/// Fails where a row that the test of this name makes costs over 2 % more or less than in this file of `docs/data/`.
pub fn assert_as_recorded(file: &str, test: &str, gpu: &str) {
    let before = recorded(file);
    let Some(after) = comparable(&before, compiled(test, gpu)) else { return };
    let (dearer, cheaper) = (dearer(&before, &after), dearer(&after, &before));
    assert!(
        dearer.is_empty() && cheaper.is_empty(),
        "not as recorded; dearer:\n{}\ncheaper, with before and after the other way around:\n{}\n{RENEW}",
        dearer.join("\n"),
        cheaper.join("\n")
    );
}

/// Writes the report that the test of this name makes to this file of `docs/data/`.
pub fn renew(file: &str, test: &str, gpu: &str) {
    let (path, report) = (repository().join("docs/data").join(file), compiled(test, gpu).unwrap());
    unitvec_files::write_file(&path, report.to_json().as_bytes()).unwrap();
    println!("{}: written, of {}", path.display(), report.subject());
}
