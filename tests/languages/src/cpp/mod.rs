//! MSL as C++17, by clang; C++11 by several compilers, CUDA among them.

use crate::cases::{Case, Inputs, SPECIAL};
use crate::job::Job;
use crate::tally::Tally;
use crate::{Result, told, tool, whole};
use std::fmt::Write;
use std::io::Read;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::{fs, thread};
use unitvec_run::shader::kernel::own_name;
use unitvec_run::shader::{Edition, Language};

/// Random inputs of each kernel in C++.
pub const MANY: usize = 1_000_000;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/cpp");

/// Options for GCC and clang.
pub const GNU: [&str; 5] = ["-O2", "-Wall", "-Wextra", "-Werror", "-xc++"];

/// Options for CUDA.
pub const CUDA: [&str; 7] = ["-x", "cu", "-O2", "-Werror", "all-warnings", "-Xcompiler", "-Wall,-Wextra"];

/// Options to assemble CUDA for the oldest GPUs that nvcc takes and for new ones.
pub const ASSEMBLED: [&str; 5] =
    ["-fatbin", "-gencode", "arch=compute_75,code=sm_75", "-gencode", "arch=compute_90,code=sm_90"];

/// Options for clang, which takes CUDA for known that is newer than it. The program for the host needs a tool that PyPI's
/// packages lack.
pub const CUDA_BY_CLANG: [&str; 10] = [
    "-x",
    "cuda",
    "-O2",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wno-unknown-cuda-version",
    "--cuda-device-only",
    "--cuda-gpu-arch=sm_75",
    "-c",
];

/// A GPU for hipcc, which otherwise looks for one: RDNA 2.
pub const HIP_GPU: &str = "--offload-arch=gfx1030";

/// Options for HIP, for GPUs of GCN 5 and RDNA 2.
pub const HIP: [&str; 9] =
    ["-x", "hip", "-O2", "-Wall", "-Wextra", "-Werror", "--offload-arch=gfx900", HIP_GPU, "-c"];

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
    pub program: &'a Path,
    pub options: &'a [&'a [&'a str]],
    pub language: Language,
    /// Inputs of each kernel before the special ones; `None` where the options make no program.
    pub random: Option<usize>,
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
    let tally = Mutex::new(tally);
    thread::scope(|scope| {
        let start = |(number, jobs)| {
            let (program, tally) = (folder.join(format!("codecs{number}")), &tally);
            scope.spawn(move || run_part(compiler, edition, &program, jobs, tally))
        };
        let threads: Vec<_> = jobs.chunks(size).enumerate().map(start).collect();
        threads.into_iter().try_for_each(|thread| {
            thread.join().unwrap_or_else(|_| Err("the thread that ran the compiler panicked".to_owned()))
        })
    })
}

fn run_part(
    compiler: Compiler<'_>,
    edition: Edition,
    program: &Path,
    jobs: &[Job<'_>],
    tally: &Mutex<&mut Tally>,
) -> Result<()> {
    let compiled = compile(compiler, edition, program, &source(compiler.language, jobs));
    let tally = || tally.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(random) = compiler.random else {
        jobs.iter().for_each(|job| tally().add_compiled(job.case, compiled.clone().map(|()| Vec::new())));
        return Ok(());
    };
    let mut inputs = Inputs::new(random);
    jobs.iter().enumerate().try_for_each(|(number, job)| {
        let case = inputs.case(job.case.format, job.case.operation)?;
        let case = Case { has_all_files: job.case.has_all_files, ..case };
        let result = compiled.clone().and_then(|()| execute(program, number, &case));
        tally().add(&case, result)
    })
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
    let (mut text, mut table) = (format!("{head}#include \"run.h\"\n"), String::new());
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
        let _ = writeln!(table, "    {{KERNEL({name}::{kernel}), {read}, {written}}},");
    }
    format!("{text}\nconst Kernel KERNELS[] = {{\n{table}}};\n\nMAIN\n")
}

fn compile(compiler: Compiler<'_>, edition: Edition, program: &Path, text: &str) -> Result<()> {
    let source = program.with_extension(compiler.language.extension());
    fs::write(&source, text).map_err(|error| format!("{}: {error}", source.display()))?;
    let mut command = Command::new(compiler.program);
    command.args(compiler.options.concat()).args(["-I", FOLDER, "-I"]);
    command.arg(whole::folder(compiler.language, edition));
    command.arg("-o").arg(program).arg(&source);
    tool::output(&mut command).map(drop)
}

fn execute(program: &Path, number: usize, case: &Case) -> Result<Vec<u32>> {
    let mut command = Command::new(program);
    command.arg(number.to_string()).arg((case.random + SPECIAL).to_string());
    let input = bytemuck::cast_slice(&case.input).to_vec();
    let bytes = tool::converse(&mut command, input, |mut output| {
        let mut bytes = Vec::new();
        output.read_to_end(&mut bytes).map_err(told)?;
        Ok(bytes)
    })?;
    Ok(bytemuck::pod_collect_to_vec(&bytes))
}
