//! The same bits on other processors: a small program that digests every codec's results for fixed input, built for
//! each of them and run by qemu, Node.js or Miri, against its output on this machine.

use crate::{cargo, setup};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread::{self, JoinHandle};

/// The file of the results for the docs.
const RECORD: &str = "docs/data/processors.csv";

/// The compiler that `cargo xtask spirv` installs: it has the standard library's sources.
const WITH_SOURCES: &str = "nightly-2026-07-03";

/// A processor, or one of fewer instructions.
#[derive(Debug)]
struct Processor {
    name: &'static str,
    target: &'static str,
    /// Instructions that the program is compiled for beyond the target's, or none.
    instructions: &'static str,
    /// The program that links.
    linker: &'static str,
    /// Debian's packages beside Rust's.
    packages: &'static [&'static str],
    /// The command that runs the program, and its arguments.
    runner: &'static [&'static str],
    editions: &'static [Edition],
    /// The levels of slices that `std` must find, the best first; any where this is empty. Without `std` there is one.
    levels: &'static [&'static str],
}

/// Features of `unitvec`, and the number of vectors and codes of each digest.
#[derive(Clone, Copy, Debug)]
struct Edition {
    features: &'static str,
    count: usize,
}

/// The number of inputs in the released digests.
const ALL: usize = 1 << 16;
/// Few enough for an emulator to finish in seconds.
const SOME: usize = 1 << 13;
/// Few enough for Miri to finish in a minute: a block of slices and a rest.
const FEW: usize = 85;

const STD: Edition = Edition { features: "std", count: ALL };
const LIBM: Edition = Edition { features: "libm", count: ALL };
const EMULATED_STD: Edition = Edition { count: SOME, ..STD };
const EMULATED_LIBM: Edition = Edition { count: SOME, ..LIBM };

/// The machine itself, with whose results others are compared.
const NATIVE: Processor = Processor {
    name: "x86-64",
    target: "x86_64-unknown-linux-gnu",
    instructions: "",
    linker: "cc",
    packages: &[],
    runner: &[],
    editions: &[STD, LIBM],
    levels: &[],
};

const fn x86_64(
    name: &'static str,
    runner: &'static [&'static str],
    levels: &'static [&'static str],
) -> Processor {
    Processor { name, packages: &["qemu-user"], runner, editions: &[EMULATED_STD], levels, ..NATIVE }
}

const fn linux(
    name: &'static str,
    target: &'static str,
    linker: &'static str,
    packages: &'static [&'static str],
    runner: &'static [&'static str],
) -> Processor {
    let (editions, levels): (_, &[_]) = (&[EMULATED_LIBM, EMULATED_STD], &["Baseline"]);
    Processor { name, target, linker, packages, runner, editions, levels, ..NATIVE }
}

const fn wasm(name: &'static str, instructions: &'static str, editions: &'static [Edition]) -> Processor {
    Processor {
        name,
        target: "wasm32-unknown-unknown",
        instructions,
        linker: "rust-lld",
        packages: &["nodejs"],
        // The optimising compiler, without Liftoff, compiles everything before it runs.
        runner: &["node", "--no-liftoff", "tests/processors/run.mjs"],
        editions,
        levels: &["Baseline"],
    }
}

static PROCESSORS: [Processor; 10] = [
    NATIVE,
    x86_64("x86-64 with SSE2", &["qemu-x86_64", "-cpu", "qemu64"], &["Baseline"]),
    x86_64("x86-64 with SSE4.1", &["qemu-x86_64", "-cpu", "Nehalem"], &["Sse41", "Baseline"]),
    x86_64("x86-64 with AVX2", &["qemu-x86_64", "-cpu", "max"], &["Avx2", "Sse41", "Baseline"]),
    linux(
        "i686",
        "i686-unknown-linux-gnu",
        "i686-linux-gnu-gcc",
        &["gcc-i686-linux-gnu", "libc6-dev-i386-cross", "qemu-user"],
        &["qemu-i386", "-L", "/usr/i686-linux-gnu"],
    ),
    linux(
        "aarch64",
        "aarch64-unknown-linux-gnu",
        "aarch64-linux-gnu-gcc",
        &["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross", "qemu-user"],
        &["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"],
    ),
    linux(
        "riscv64",
        "riscv64gc-unknown-linux-gnu",
        "riscv64-linux-gnu-gcc",
        &["gcc-riscv64-linux-gnu", "libc6-dev-riscv64-cross", "qemu-user"],
        &["qemu-riscv64", "-L", "/usr/riscv64-linux-gnu"],
    ),
    linux(
        "s390x",
        "s390x-unknown-linux-gnu",
        "s390x-linux-gnu-gcc",
        &["gcc-s390x-linux-gnu", "libc6-dev-s390x-cross", "qemu-user"],
        &["qemu-s390x", "-L", "/usr/s390x-linux-gnu"],
    ),
    wasm("wasm32", "", &[LIBM]),
    wasm("wasm32 with simd128", "+simd128", &[STD]),
];

/// The processors and their runners, for the hash of the record's inputs.
pub fn versions() -> String {
    format!("{PROCESSORS:?}")
}

const MIRI: &str = "x86-64 in Miri";

/// An interpreter that finds undefined behaviour: all `unsafe` blocks, at every level. It takes so long that it runs only where
/// it is named.
static INTERPRETER: Processor = Processor {
    name: MIRI,
    instructions: "+avx2",
    editions: &[Edition { count: FEW, ..STD }, Edition { count: FEW, ..LIBM }],
    levels: &["Avx2", "Sse41", "Baseline"],
    ..NATIVE
};

/// `cargo xtask processors [--exhaustive] [--build-std] [--record] [NAME…]`.
pub fn run(repository: &Path, arguments: &[String]) -> Result<(), String> {
    let (options, names): (Vec<&str>, Vec<&str>) =
        arguments.iter().map(String::as_str).partition(|argument| argument.starts_with("--"));
    if let Some(unknown) = options.iter().find(|o| !["--exhaustive", "--build-std", "--record"].contains(o)) {
        return Err(format!("unknown option {unknown}; `cargo xtask help` lists those of processors"));
    }
    let has = |option| options.contains(&option);
    if has("--record") && !names.is_empty() {
        return Err("--record keeps what all processors do, and takes no names".to_owned());
    }
    let chosen = chosen(&names)?;
    let packages: BTreeSet<&str> = chosen.iter().flat_map(|p| p.packages).copied().collect();
    setup::packages(&packages.into_iter().collect::<Vec<_>>())?;

    let job = |processor, edition| Job { repository: repository.to_owned(), processor, edition };
    let native = job(&NATIVE, STD);
    let native_program = native.build(false)?.program;
    println!("xtask: {}, {}: what others are compared with", NATIVE.name, STD.features);
    let mut references = BTreeMap::new();
    for count in [ALL, SOME, FEW] {
        let text = native.output(&mut native.command(&native_program), count)?;
        references.insert(count, Digests::parse(&text)?.only("values"));
    }
    expect_released(repository, &references[&ALL])?;

    // Programs that are built run while the next is built.
    let mut running = Vec::new();
    for processor in chosen {
        for edition in processor.editions {
            let exhaustive = has("--exhaustive") && edition.count == SOME;
            let edition = if exhaustive { Edition { count: ALL, ..*edition } } else { *edition };
            println!("xtask: building {}, {}", processor.name, edition.features);
            let job = job(processor, edition);
            running.push(job.start(has("--build-std"), references[&edition.count].clone()));
        }
    }
    let joined = running.into_iter().map(|thread| thread.join().unwrap_or_else(|_| Row::of_panic()));
    let rows: Vec<Row> = joined.collect();
    print_table(&rows);
    let failed = rows.iter().filter(|row| row.verdict.is_err()).count();
    if failed > 0 {
        return Err(format!("{failed} of {} programs differ or did not run", rows.len()));
    }
    if has("--record") {
        let lines: Vec<String> = rows.iter().map(Row::record).collect();
        let text = format!("{}\n{}\n", COLUMNS.join(","), lines.join("\n"));
        fs::write(repository.join(RECORD), text).map_err(|error| format!("{RECORD}: {error}"))?;
    }
    Ok(())
}

/// The processors of these names, or all.
fn chosen(names: &[&str]) -> Result<Vec<&'static Processor>, String> {
    let all = || PROCESSORS.iter().chain([&INTERPRETER]);
    if let Some(unknown) = names.iter().find(|name| !all().any(|p| p.name == **name)) {
        let known: Vec<String> = all().map(|p| format!("`{}`", p.name)).collect();
        return Err(format!("no processor `{unknown}`; there are {}", known.join(", ")));
    }
    if names.is_empty() {
        return Ok(PROCESSORS.iter().collect());
    }
    Ok(all().filter(|p| names.contains(&p.name)).collect())
}

/// A program's output: digests by way and codec.
#[derive(Clone)]
struct Digests(BTreeMap<String, BTreeMap<String, String>>);

impl Digests {
    fn parse(text: &str) -> Result<Self, String> {
        let mut ways = BTreeMap::new();
        for line in text.lines() {
            let mut fields = line.splitn(3, ',');
            let (Some(way), Some(id), Some(digests)) = (fields.next(), fields.next(), fields.next()) else {
                return Err(format!("the program printed `{line}`"));
            };
            let way = way.trim_start_matches("Level(").trim_end_matches(')');
            let of_way: &mut BTreeMap<_, _> = ways.entry(way.to_owned()).or_default();
            of_way.insert(id.to_owned(), digests.to_owned());
        }
        Ok(Self(ways))
    }

    fn only(mut self, way: &str) -> BTreeMap<String, String> {
        self.0.remove(way).unwrap_or_default()
    }

    /// The levels of slices.
    fn levels(&self) -> BTreeSet<&str> {
        self.0.keys().map(String::as_str).filter(|way| *way != "values").collect()
    }

    /// The number of digests, if all are those of the reference, none is missing and the levels are these.
    fn compare(&self, reference: &BTreeMap<String, String>, levels: &[&str]) -> Result<usize, String> {
        let found = self.levels();
        if !levels.is_empty() && found != levels.iter().copied().collect() {
            return Err(format!("slices at levels {found:?}, not {levels:?}"));
        }
        for way in ["values", "Baseline"] {
            let codecs = self.0.get(way).map_or(0, BTreeMap::len);
            if codecs != reference.len() {
                return Err(format!("{way}: {codecs} codecs, not {}", reference.len()));
            }
        }
        let rows = || self.0.iter().flat_map(|(way, rows)| rows.iter().map(move |row| (way, row)));
        let differing: Vec<String> = rows()
            .filter(|(_, (id, digests))| reference.get(*id) != Some(*digests))
            .map(|(way, (id, _))| format!("{id} ({way})"))
            .collect();
        if !differing.is_empty() {
            return Err(format!("other bits: {}", differing.join(", ")));
        }
        Ok(rows().count())
    }
}

/// The released digests are those that this machine computes.
fn expect_released(repository: &Path, computed: &BTreeMap<String, String>) -> Result<(), String> {
    let path = repository.join("vectors/digests.csv");
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let released: BTreeSet<&str> = text.lines().skip(1).collect();
    for (id, digests) in computed {
        // Two of the four are released.
        let two: Vec<&str> = digests.split(',').take(2).collect();
        if !released.contains(format!("{id},{}", two.join(",")).as_str()) {
            return Err(format!("{id} differs from its released digests, on this machine"));
        }
    }
    if released.len() == computed.len() {
        return Ok(());
    }
    Err(format!("{} codecs have released digests, the program has {}", released.len(), computed.len()))
}

/// A program to build and run.
struct Job {
    repository: PathBuf,
    processor: &'static Processor,
    edition: Edition,
}

/// A program, and the compiler that made it.
struct Built {
    program: PathBuf,
    compiler: String,
}

impl Job {
    /// Builds here, and runs in another thread.
    fn start(self, build_std: bool, reference: BTreeMap<String, String>) -> JoinHandle<Row> {
        let is_miri = self.processor.name == MIRI;
        let built = if is_miri { self.miri() } else { self.build(build_std) };
        thread::spawn(move || {
            let run = |built: &Built| {
                let mut command = if is_miri { self.interpret() } else { self.command(&built.program) };
                let digests = Digests::parse(&self.output(&mut command, self.edition.count)?)?;
                let is_std = self.edition.features == STD.features;
                let same = digests
                    .compare(&reference, if is_std { self.processor.levels } else { &["Baseline"] })?;
                let levels = digests.levels().into_iter().collect::<Vec<_>>().join(" ");
                Ok((levels, same))
            };
            let compiler = built.as_ref().map_or_else(|_| String::new(), |built| built.compiler.clone());
            let verdict = built.and_then(|built| run(&built));
            let by = self.runner_version();
            let row = Row { processor: self.processor, edition: self.edition, compiler, by, verdict };
            println!("xtask: {}", row.line());
            row
        })
    }

    /// Builds the program with this compiler, if rustup has the target's standard library for it, or else with the one that
    /// has its sources.
    fn build(&self, build_std: bool) -> Result<Built, String> {
        let Processor { target, instructions, linker, .. } = self.processor;
        let has_std =
            !build_std && (*target == NATIVE.target || succeeds("rustup", &["target", "add", target]));
        let mut command = if has_std {
            cargo(&["build", "--quiet"])
        } else {
            let mut command = with_toolchain(WITH_SOURCES);
            command.args(["build", "--quiet", "-Zbuild-std=std,panic_abort"]);
            command
        };
        let folder = self
            .repository
            .join("target/processors")
            .join(format!("{}{instructions}", self.edition.features));
        command.args(["--package", "unitvec-processors", "--no-default-features"]);
        command.args(["--config", "profile.dev.debug=false"]);
        command.args(["--features", self.edition.features, "--target", target]);
        command.arg("--target-dir").arg(&folder).current_dir(&self.repository);
        let linker = if *linker == "rust-lld" { rust_lld()? } else { (*linker).to_owned() };
        command.args(["--config", &format!("target.{target}.linker={linker:?}")]);
        if !instructions.is_empty() {
            command.args([
                "--config",
                &format!("target.{target}.rustflags=['-Ctarget-feature={instructions}']"),
            ]);
        }
        succeed(&mut command).map_err(|error| {
            if has_std { error } else { format!("{error}; `cargo xtask spirv` installs {WITH_SOURCES}") }
        })?;
        let suffix = if target.starts_with("wasm") { ".wasm" } else { "" };
        let program = folder.join(target).join("debug").join(format!("unitvec-processors{suffix}"));
        let mut compiler = Command::new("rustc");
        if !has_std {
            compiler.arg(format!("+{WITH_SOURCES}")).env_remove("RUSTUP_TOOLCHAIN");
        }
        Ok(Built { program, compiler: version(compiler.arg("-V")) })
    }

    /// Nothing to build: Miri interprets. It comes with a nightly.
    fn miri(&self) -> Result<Built, String> {
        if !succeeds("rustup", &["component", "add", "--toolchain", "nightly", "miri", "rust-src"]) {
            return Err("no Miri: rustup toolchain install nightly --component miri,rust-src".to_owned());
        }
        let mut compiler = Command::new("rustc");
        compiler.args(["+nightly", "-V"]).env_remove("RUSTUP_TOOLCHAIN");
        Ok(Built { program: PathBuf::new(), compiler: version(&mut compiler) })
    }

    fn interpret(&self) -> Command {
        let mut command = with_toolchain("nightly");
        command.args(["miri", "run", "--quiet", "--package", "unitvec-processors", "--no-default-features"]);
        command.args(["--features", self.edition.features]);
        command.arg("--target-dir").arg(self.repository.join("target/processors/miri"));
        command.env("RUSTFLAGS", format!("-Ctarget-feature={}", self.processor.instructions));
        command.arg("--").current_dir(&self.repository);
        command
    }

    fn command(&self, program: &Path) -> Command {
        let mut words = self.processor.runner.iter();
        let Some(first) = words.next() else { return Command::new(program) };
        let mut command = Command::new(first);
        command.args(words).arg(program).current_dir(&self.repository);
        command
    }

    /// The program's output.
    fn output(&self, command: &mut Command, count: usize) -> Result<String, String> {
        if count != ALL {
            command.arg(count.to_string());
        }
        succeed(command)
    }

    fn runner_version(&self) -> String {
        match self.processor.runner {
            [] if self.processor.name == MIRI => {
                version(with_toolchain("nightly").args(["miri", "--version"]))
            }
            [] => cpu_model(),
            [runner, ..] => version(Command::new(runner).arg("--version")),
        }
    }
}

/// The result of a program.
struct Row {
    processor: &'static Processor,
    edition: Edition,
    compiler: String,
    by: String,
    /// The levels of slices, and the number of digests that are the same; or the fault.
    verdict: Result<(String, usize), String>,
}

const COLUMNS: [&str; 8] =
    ["processor", "target", "unitvec", "compiler", "run by", "slices", "inputs", "digests"];

impl Row {
    fn of_panic() -> Self {
        let verdict = Err("the thread that ran it panicked".to_owned());
        Self { processor: &NATIVE, edition: STD, compiler: String::new(), by: String::new(), verdict }
    }

    /// Formats the row for the screen.
    fn line(&self) -> String {
        let verdict = if self.verdict.is_ok() { "same bits" } else { "FAIL" };
        format!("{}: {verdict}", self.record().replace(',', " | "))
    }

    /// A line of the record.
    fn record(&self) -> String {
        let (levels, digests) = self.verdict.clone().unwrap_or_else(|reason| (reason, 0));
        let Edition { features, count } = self.edition;
        let Processor { name, target, .. } = self.processor;
        format!("{name},{target},{features},{},{},{levels},{count},{digests}", self.compiler, self.by)
    }
}

fn print_table(rows: &[Row]) {
    println!("\n{}", COLUMNS.join(" | "));
    for row in rows {
        println!("{}", row.line());
    }
}

/// Cargo of another toolchain than the one that runs this: without the variables that cargo sets for that one, which
/// rustup would take for the choice.
fn with_toolchain(name: &str) -> Command {
    let mut command = Command::new("cargo");
    command.arg(format!("+{name}")).env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO");
    command
}

/// The linker of WebAssembly that comes with the compiler that runs this.
fn rust_lld() -> Result<String, String> {
    let sysroot = succeed(Command::new("rustc").args(["--print", "sysroot"]))?;
    let path = Path::new(sysroot.trim()).join("lib/rustlib").join(NATIVE.target).join("bin/rust-lld");
    Ok(if path.exists() { path.to_string_lossy().into_owned() } else { "wasm-ld".to_owned() })
}

/// The model of this machine's processor.
fn cpu_model() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = text.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    model.unwrap_or("this machine").replace(',', " ")
}

/// A program's version by its own account, up to the date or the packager's part.
fn version(command: &mut Command) -> String {
    let text = succeed(command).unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    line.split(" (").next().unwrap_or_default().replace(',', " ")
}

fn succeeds(program: &str, arguments: &[&str]) -> bool {
    succeed(Command::new(program).args(arguments)).is_ok()
}

/// A command's output, or the last line of its errors.
fn succeed(command: &mut Command) -> Result<String, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{program} cannot be started: {error}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    let said: Vec<&str> = errors.lines().filter(|line| !line.trim().is_empty()).collect();
    Err(format!(
        "{program} ended with {}: {}",
        output.status,
        said[said.len().saturating_sub(3)..].join("; ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str =
        "values,a,1,2,3,4\nvalues,b,5,6,7,8\nLevel(Baseline),a,1,2,3,4\nLevel(Baseline),b,5,6,7,8\n";

    /// The result of `compare` for this program's output, beside [`PRINTED`].
    fn compared(text: &str, levels: &[&str]) -> Result<usize, String> {
        let reference = Digests::parse(PRINTED).unwrap().only("values");
        Digests::parse(text)?.compare(&reference, levels)
    }

    #[test]
    fn the_same_digests_are_counted() {
        assert_eq!(compared(PRINTED, &["Baseline"]), Ok(4));
        assert_eq!(compared(PRINTED, &[]), Ok(4));
    }

    #[test]
    fn other_bits_are_named() {
        for (from, to, named) in
            [("values,b,5,6,7,8", "values,b,5,6,7,9", "b (values)"), (",a,1", ",a,0", "a (Baseline)")]
        {
            let error = compared(&PRINTED.replace(from, to), &["Baseline"]).unwrap_err();
            assert!(error.contains(named), "{error}");
        }
    }

    #[test]
    fn what_is_missing_is_named() {
        let error = compared("values,a,1,2,3,4\n", &[]).unwrap_err();
        assert_eq!(error, "values: 1 codecs, not 2");
        assert!(compared(PRINTED, &["Avx2", "Baseline"]).unwrap_err().contains("Avx2"));
        assert!(compared("", &[]).is_err() && compared("killed", &[]).is_err());
    }

    #[test]
    fn unknown_names_are_refused() {
        assert!(chosen(&["vax"]).err().unwrap_or_default().contains("`s390x`"));
        assert_eq!(chosen(&["s390x"]).map(|found| found.len()), Ok(1));
        assert_eq!(chosen(&[]).map(|found| found.len()), Ok(PROCESSORS.len()));
    }
}
