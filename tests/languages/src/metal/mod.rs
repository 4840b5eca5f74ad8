//! MSL as C++17, by clang.

use crate::cases::COUNT;
use crate::job::Job;
use crate::tally::Tally;
use crate::{Result, told, tool, whole};
use std::fmt::Write;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, thread};
use unitvec_run::shader::kernel::metal_name;
use unitvec_run::shader::{Edition, Language};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/metal");

const ARGUMENTS: [&str; 8] = [
    "-std=c++17",
    "-O2",
    "-fno-math-errno",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wno-unknown-attributes",
    "-xc++",
];

/// Options of a compiler that takes arithmetic for that of real numbers.
pub const HOSTILE: [&str; 6] = [
    "-ffp-contract=fast",
    "-fassociative-math",
    "-fno-signed-zeros",
    "-fno-trapping-math",
    "-freciprocal-math",
    "-mfma",
];

/// Compiles with these options, into the folder, and runs.
pub fn run(
    edition: Edition,
    options: &[&str],
    folder: &Path,
    jobs: &[Job<'_>],
    tally: &mut Tally,
) -> Result<()> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let size = jobs.len().div_ceil(thread::available_parallelism().map_or(1, usize::from)).max(1);
    let parts: Vec<_> = jobs.chunks(size).enumerate().collect();
    let programs: Vec<Result<PathBuf>> = thread::scope(|scope| {
        let build = |(number, jobs): &(usize, &[Job<'_>])| {
            let (program, text) = (folder.join(format!("codecs{number}")), source(jobs));
            scope.spawn(move || compile(edition, options, &program, &text))
        };
        let threads: Vec<_> = parts.iter().map(build).collect();
        let join = |thread: thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|_| Err("the thread that ran clang panicked".to_owned()))
        };
        threads.into_iter().map(join).collect()
    });
    for ((_, jobs), program) in parts.iter().zip(programs) {
        for (number, job) in jobs.iter().enumerate() {
            tally.add(job.case, program.clone().and_then(|program| execute(&program, number, job)))?;
        }
    }
    Ok(())
}

/// All kernels in one file, each with the functions it needs, as people get it: what they share counts once. The files of
/// `shaders/` stand apart.
fn source(jobs: &[Job<'_>]) -> String {
    let mut text = "#include <metal_stdlib>\n".to_owned();
    let mut table = String::new();
    for job in jobs {
        let name = if job.case.has_all_files { "files" } else { "texts" };
        let kernel = metal_name(job.case.format, job.case.operation);
        let (read, written) = job.case.words();
        // Writing to a string cannot fail.
        let _ = write!(text, "\nnamespace {name} {{\n{}\n}}\n", job.text);
        let _ = writeln!(table, "    {{{name}::{kernel}, {read}, {written}}},");
    }
    let kernel = "struct Kernel { void (*run)(const uint*, uint*, const uint&, uint); uint read, written; };";
    format!("{text}\n{kernel}\nconst Kernel KERNELS[] = {{\n{table}}};\n\n#include \"run.h\"\n")
}

fn compile(edition: Edition, options: &[&str], program: &Path, text: &str) -> Result<PathBuf> {
    let source = program.with_extension("metal");
    fs::write(&source, text).map_err(|error| format!("{}: {error}", source.display()))?;
    let mut clang = Command::new("clang++");
    clang.args(ARGUMENTS).args(options).args(["-I", FOLDER, "-I"]).arg(whole::folder(Language::Msl, edition));
    clang.arg("-o").arg(program).arg(&source);
    tool::output(&mut clang)?;
    Ok(program.to_owned())
}

fn execute(program: &Path, number: usize, job: &Job<'_>) -> Result<Vec<u32>> {
    let mut command = Command::new(program);
    command.arg(number.to_string()).arg(COUNT.to_string());
    let input = bytemuck::cast_slice(&job.case.input).to_vec();
    let bytes = tool::converse(&mut command, input, |mut output| {
        let mut bytes = Vec::new();
        output.read_to_end(&mut bytes).map_err(told)?;
        Ok(bytes)
    })?;
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}
