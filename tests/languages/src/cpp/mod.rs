//! MSL as C++17, by clang; C++11 by several compilers.

use crate::cases::COUNT;
use crate::job::Job;
use crate::tally::Tally;
use crate::{Result, told, tool, whole};
use std::fmt::Write;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, thread};
use unitvec_run::shader::kernel::own_name;
use unitvec_run::shader::{Edition, Language};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/cpp");

const ARGUMENTS: [&str; 5] = ["-O2", "-Wall", "-Wextra", "-Werror", "-xc++"];

/// Options for MSL.
pub const MSL: [&str; 3] = ["-std=c++17", "-fno-math-errno", "-Wno-unknown-attributes"];

/// Options for C++: on x86-64 with instructions that fuse.
pub const FUSING: [&str; 3] =
    ["-std=c++11", "-ffp-contract=fast", if cfg!(target_arch = "x86_64") { "-mfma" } else { "-O2" }];

/// Options of a compiler that takes arithmetic for that of real numbers.
pub const HOSTILE: [&str; 6] = [
    "-ffp-contract=fast",
    "-fassociative-math",
    "-fno-signed-zeros",
    "-fno-trapping-math",
    "-freciprocal-math",
    "-mfma",
];

/// A compiler and its options, for a language.
#[derive(Clone, Copy)]
pub struct Compiler<'a> {
    pub program: &'a str,
    pub options: &'a [&'a [&'a str]],
    pub language: Language,
}

/// Compiles into the folder, and runs.
pub fn run(
    compiler: Compiler<'_>,
    edition: Edition,
    folder: &Path,
    jobs: &[Job<'_>],
    tally: &mut Tally,
) -> Result<()> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let size = jobs.len().div_ceil(thread::available_parallelism().map_or(1, usize::from)).max(1);
    let parts: Vec<_> = jobs.chunks(size).enumerate().collect();
    let programs: Vec<Result<PathBuf>> = thread::scope(|scope| {
        let build = |(number, jobs): &(usize, &[Job<'_>])| {
            let (program, text) = (folder.join(format!("codecs{number}")), source(compiler.language, jobs));
            scope.spawn(move || compile(compiler, edition, &program, &text))
        };
        let threads: Vec<_> = parts.iter().map(build).collect();
        let join = |thread: thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|_| Err("the thread that ran the compiler panicked".to_owned()))
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
fn source(language: Language, jobs: &[Job<'_>]) -> String {
    let is_cpp = language == Language::Cpp;
    // Where the texts include them, in a namespace, these have been included.
    let head = if is_cpp {
        "#include <float.h>\n#include <math.h>\n#include <string.h>\n"
    } else {
        "#include <metal_stdlib>\n"
    };
    let (mut text, mut table) = (head.to_owned(), String::new());
    for job in jobs {
        let name = if job.case.has_all_files { "files" } else { "texts" };
        let kernel = own_name(job.case.format, job.case.operation);
        // The types of one namespace are not those of another.
        let own_types = if is_cpp && job.case.has_all_files {
            "#undef UNITVEC_VECTORS_HPP\n#undef UNITVEC_EXACT\n"
        } else {
            ""
        };
        let (read, written) = job.case.words();
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{own_types}namespace {name} {{\n{}\n}}\n{own_types}", job.text);
        let _ = writeln!(table, "    {{{name}::{kernel}, {read}, {written}}},");
    }
    let kernel = "typedef unsigned int uint;\nstruct Kernel { void (*run)(const uint*, uint*, const uint&, uint); uint read, written; };";
    format!("{text}\n{kernel}\nconst Kernel KERNELS[] = {{\n{table}}};\n\n#include \"run.h\"\n")
}

fn compile(compiler: Compiler<'_>, edition: Edition, program: &Path, text: &str) -> Result<PathBuf> {
    let source = program.with_extension(compiler.language.extension());
    fs::write(&source, text).map_err(|error| format!("{}: {error}", source.display()))?;
    let mut command = Command::new(compiler.program);
    command.args(ARGUMENTS).args(compiler.options.concat()).args(["-I", FOLDER, "-I"]);
    command.arg(whole::folder(compiler.language, edition));
    command.arg("-o").arg(program).arg(&source);
    tool::output(&mut command)?;
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
