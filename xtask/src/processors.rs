//! The same bits on other processors: cargo builds a small program that digests every codec's results for fixed input, and
//! runs it by qemu, Node.js or Miri. Its output must be that of this machine.

use crate::{output, repository, setup, take, write};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use std::{fs, thread};

/// The file of the results for the docs.
const RECORD: &str = "docs/data/processors.csv";

/// The compiler that `cargo xtask spirv` installs: it has the standard library's sources.
const WITH_SOURCES: &str = "nightly-2026-07-03";

/// The number of inputs in the released digests.
const ALL: usize = 1 << 16;
/// Few enough for an emulator to finish in seconds.
const SOME: usize = 1 << 13;
/// Few enough for Miri to finish in a minute: a block of slices and a rest.
const FEW: usize = 85;

/// The target of this machine, with whose results others are compared.
const NATIVE: &str = "x86_64-unknown-linux-gnu";

/// An interpreter that finds undefined behaviour: all `unsafe` blocks, at every level. It takes so long that it runs only where
/// it is named.
const MIRI: &str = "x86-64 in Miri";

/// A processor, or one of fewer instructions, and how cargo links and runs the program for it.
#[derive(Clone, Debug)]
struct Processor {
    name: &'static str,
    target: &'static str,
    /// Instructions that the program is compiled for beyond the target's, or none.
    instructions: &'static str,
    linker: String,
    /// Debian's packages beside Rust's.
    packages: Vec<String>,
    /// The command that runs the program, with its arguments, or none.
    runner: String,
    /// Features of `unitvec`, for a program each.
    features: &'static [&'static str],
    /// The number of vectors and codes of each digest.
    count: usize,
    /// The levels of slices that `std` must find; any where this is empty. Without `std` there is one.
    levels: &'static str,
}

fn x86_64(name: &'static str, qemu: &str, levels: &'static str) -> Processor {
    Processor {
        name,
        target: NATIVE,
        instructions: "",
        linker: "cc".to_owned(),
        packages: vec!["qemu-user".to_owned()],
        runner: format!("qemu-x86_64 -cpu {qemu}"),
        features: &["std"],
        count: SOME,
        levels,
    }
}

/// A processor that Debian has a cross compiler for, by its names for qemu and for Debian's libraries.
fn linux(name: &'static str, target: &'static str, qemu: &str, library: &str) -> Processor {
    let gcc = format!("{name}-linux-gnu");
    Processor {
        name,
        target,
        linker: format!("{gcc}-gcc"),
        packages: vec![format!("gcc-{gcc}"), format!("libc6-dev-{library}-cross"), "qemu-user".to_owned()],
        runner: format!("qemu-{qemu} -L /usr/{gcc}"),
        features: &["libm", "std"],
        ..x86_64("", "", "Baseline")
    }
}

fn wasm(name: &'static str, instructions: &'static str, features: &'static [&'static str]) -> Processor {
    Processor {
        name,
        target: "wasm32-unknown-unknown",
        instructions,
        linker: "rust-lld".to_owned(),
        packages: vec!["nodejs".to_owned()],
        // The optimising compiler, without Liftoff, compiles everything before it runs.
        runner: "node --no-liftoff tests/processors/run.mjs".to_owned(),
        features,
        count: ALL,
        levels: "Baseline",
    }
}

/// All processors; [`MIRI`] is the last.
fn processors() -> Vec<Processor> {
    let here = Processor {
        runner: String::new(),
        packages: Vec::new(),
        features: &["avx512", "libm"],
        count: ALL,
        ..x86_64("x86-64", "", "")
    };
    let all_levels = "Avx2 Baseline Sse41";
    let miri = Processor {
        name: MIRI,
        instructions: "+avx2",
        features: &["std", "libm"],
        count: FEW,
        levels: all_levels,
        ..here.clone()
    };
    vec![
        here,
        x86_64("x86-64 with SSE2", "qemu64", "Baseline"),
        x86_64("x86-64 with SSE4.1", "Nehalem", "Baseline Sse41"),
        x86_64("x86-64 with AVX2", "max", all_levels),
        linux("i686", "i686-unknown-linux-gnu", "i386", "i386"),
        linux("aarch64", "aarch64-unknown-linux-gnu", "aarch64", "arm64"),
        linux("riscv64", "riscv64gc-unknown-linux-gnu", "riscv64", "riscv64"),
        linux("s390x", "s390x-unknown-linux-gnu", "s390x", "s390x"),
        wasm("wasm32", "", &["libm"]),
        wasm("wasm32 with simd128", "+simd128", &["std"]),
        miri,
    ]
}

/// The processors and their runners, for the hash of the record's inputs.
pub fn versions() -> String {
    format!("{:?}", processors())
}

/// `cargo xtask processors [--exhaustive] [--build-std] [--record] [NAME…]`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let mut names = arguments.to_vec();
    let [exhaustive, build_std, record] =
        ["--exhaustive", "--build-std", "--record"].map(|option| take(&mut names, option));
    if let Some(unknown) = names.iter().find(|name| name.starts_with("--")) {
        return Err(format!("unknown option {unknown}; `cargo xtask help` lists those of processors"));
    }
    if record && !names.is_empty() {
        return Err("--record keeps what all processors do, and takes no names".to_owned());
    }
    let chosen = chosen(&names)?;
    let packages: BTreeSet<&str> = chosen.iter().flat_map(|p| &p.packages).map(String::as_str).collect();
    setup::packages(&packages.into_iter().collect::<Vec<_>>())?;
    println!("xtask: this machine, with which others are compared");
    let references = references()?;

    // Programs run while cargo builds others.
    let rows: Vec<Row> = thread::scope(|scope| {
        let mut threads = Vec::new();
        for processor in &chosen {
            let toolchain = processor.toolchain(build_std);
            let count = if exhaustive && processor.count == SOME { ALL } else { processor.count };
            for features in processor.features {
                let (toolchain, reference) = (toolchain.clone(), &references[&count]);
                threads.push(scope.spawn(move || processor.row(features, count, toolchain, reference)));
            }
        }
        let of_panic = |_| ("the thread that ran it panicked".to_owned(), false);
        threads.into_iter().map(|thread| thread.join().unwrap_or_else(of_panic)).collect()
    });
    println!("\n{}", COLUMNS.replace(',', " | "));
    rows.iter().for_each(|row| println!("{}", line(row)));
    let failed = rows.iter().filter(|(_, is_same)| !is_same).count();
    if failed > 0 {
        return Err(format!("{failed} of {} programs differ or did not run", rows.len()));
    }
    if record {
        let lines: String = rows.iter().map(|(record, _)| format!("{record}\n")).collect();
        write(RECORD, format!("{COLUMNS}\n{lines}"))?;
    }
    Ok(())
}

/// The processors of these names, or all but the interpreter.
fn chosen(names: &[String]) -> Result<Vec<Processor>, String> {
    let mut all = processors();
    if let Some(unknown) = names.iter().find(|name| !all.iter().any(|p| p.name == *name)) {
        let known: Vec<String> = all.iter().map(|p| format!("`{}`", p.name)).collect();
        return Err(format!("no processor `{unknown}`; there are {}", known.join(", ")));
    }
    all.retain(|p| if names.is_empty() { p.name != MIRI } else { names.iter().any(|name| name == p.name) });
    Ok(all)
}

/// This machine's output for each number of inputs. Its digests of all are the released ones.
fn references() -> Result<BTreeMap<usize, String>, String> {
    let here = &processors()[0];
    let run = |count| Ok((count, output(&mut here.command("std", count, ""))?));
    let references = [ALL, SOME, FEW].into_iter().map(run).collect::<Result<BTreeMap<_, _>, String>>()?;
    let file = "vectors/digests.csv";
    let text = fs::read_to_string(repository().join(file)).map_err(|error| format!("{file}: {error}"))?;
    let released: Vec<&str> = text.lines().skip(1).collect();
    let computed = values(&references[&ALL]);
    // Two of the four digests are released.
    let is_released = |row: &str| released.iter().any(|line| row.rsplitn(3, ',').last() == Some(*line));
    if let Some(row) = computed.iter().find(|row| !is_released(row)) {
        return Err(format!("{} differs from its released digests, on this machine", name(row)));
    }
    if released.len() == computed.len() {
        return Ok(references);
    }
    Err(format!("{} codecs have released digests, the program has {}", released.len(), computed.len()))
}

/// The rows, codec and digests, of the functions of single vectors in a program's output.
fn values(printed: &str) -> BTreeSet<&str> {
    printed.lines().filter_map(|line| line.strip_prefix("values,")).collect()
}

fn name(row: &str) -> &str {
    row.split(',').next().unwrap_or_default()
}

/// The levels of slices and the number of digests that a program printed, if all are those of the reference, none is missing
/// and the levels are these.
fn compare(printed: &str, reference: &str, levels: &str) -> Result<(String, usize), String> {
    let known = values(reference);
    let mut ways: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for line in printed.lines() {
        let (way, row) = line.split_once(',').ok_or_else(|| format!("the program printed `{line}`"))?;
        ways.entry(way).or_default().insert(row);
    }
    let found = ways.keys().copied().filter(|way| *way != "values").collect::<Vec<_>>().join(" ");
    if !levels.is_empty() && found != levels {
        return Err(format!("slices at levels {found}; not {levels}"));
    }
    for way in ["values", "Baseline"] {
        let codecs = ways.get(way).map_or(0, BTreeSet::len);
        if codecs != known.len() {
            return Err(format!("{way}: {codecs} codecs, not {}", known.len()));
        }
    }
    let rows = || ways.iter().flat_map(|(way, rows)| rows.iter().map(move |row| (way, row)));
    let differing = rows().filter(|(_, row)| !known.contains(*row));
    let differing: Vec<String> = differing.map(|(way, row)| format!("{} ({way})", name(row))).collect();
    if differing.is_empty() {
        return Ok((found, rows().count()));
    }
    Err(format!("other bits: {}", differing.join(", ")))
}

const COLUMNS: &str = "processor,target,unitvec,compiler,run by,slices,inputs,digests";

/// A line of the record, with the fault in the place of the levels where there is one, and whether all digests are the same.
type Row = (String, bool);

fn line((record, is_same): &Row) -> String {
    format!("{}: {}", if *is_same { "same bits" } else { "FAIL" }, record.replace(',', " | "))
}

impl Processor {
    /// The toolchain with the target's standard library: the one that runs this if rustup has the library for it, or else the
    /// one that has its sources.
    fn toolchain(&self, build_std: bool) -> Result<&'static str, String> {
        let has = |program, arguments: &[&str]| output(Command::new(program).args(arguments)).is_ok();
        if self.name == MIRI {
            // Nothing to build: Miri interprets. It comes with a nightly.
            let has_miri = has("rustup", &["component", "add", "--toolchain", "nightly", "miri", "rust-src"]);
            let remedy = "no Miri: rustup toolchain install nightly --component miri,rust-src";
            return has_miri.then_some("nightly").ok_or_else(|| remedy.to_owned());
        }
        if !build_std && (self.target == NATIVE || has("rustup", &["target", "add", self.target])) {
            return Ok("");
        }
        let has_sources = has("rustup", &["which", "rustc", "--toolchain", WITH_SOURCES]);
        let remedy = || format!("no {WITH_SOURCES}: `cargo xtask spirv` installs it");
        has_sources.then_some(WITH_SOURCES).ok_or_else(remedy)
    }

    fn row(&self, features: &str, count: usize, toolchain: Result<&str, String>, reference: &str) -> Row {
        let compiler =
            toolchain.as_ref().map_or_else(|_| String::new(), |of| version(&mut tool("rustc", of), "-V"));
        let levels = if features == "libm" { "Baseline" } else { self.levels };
        let printed = toolchain.and_then(|of| output(&mut self.command(features, count, of)));
        let outcome = printed.and_then(|printed| compare(&printed, reference, levels));
        let is_same = outcome.is_ok();
        let (levels, digests) = outcome.unwrap_or_else(|fault| (fault, 0));
        let Self { name, target, .. } = self;
        let by = self.run_by();
        let row = (format!("{name},{target},{features},{compiler},{by},{levels},{count},{digests}"), is_same);
        println!("xtask: {}", line(&row));
        row
    }

    /// Cargo, which builds the program and runs it.
    fn command(&self, features: &str, count: usize, toolchain: &str) -> Command {
        let mut cargo = tool("cargo", toolchain);
        cargo.args(if self.name == MIRI { &["miri", "run"][..] } else { &["run"] });
        if toolchain == WITH_SOURCES {
            cargo.arg("-Zbuild-std=std,panic_abort");
        }
        cargo.args(["--quiet", "--package", "unitvec-processors", "--no-default-features"]);
        let folder = format!("target/processors/{features}{}", self.instructions);
        cargo.args(["--features", features, "--target", self.target, "--target-dir", &folder]);
        cargo.arg("--").arg(count.to_string()).current_dir(repository());
        let target = self.target.to_uppercase().replace('-', "_");
        let linker = if self.linker == "rust-lld" { rust_lld() } else { self.linker.clone() };
        cargo.env(format!("CARGO_TARGET_{target}_LINKER"), linker).env("CARGO_PROFILE_DEV_DEBUG", "false");
        if !self.runner.is_empty() {
            cargo.env(format!("CARGO_TARGET_{target}_RUNNER"), &self.runner);
        }
        if !self.instructions.is_empty() {
            cargo.env("RUSTFLAGS", format!("-Ctarget-feature={}", self.instructions));
        }
        cargo
    }

    /// The version of the emulator, or the model of this machine's processor.
    fn run_by(&self) -> String {
        if self.name == MIRI {
            return version(tool("cargo", "nightly").arg("miri"), "--version");
        }
        if let Some(runner) = self.runner.split(' ').next().filter(|runner| !runner.is_empty()) {
            return version(&mut Command::new(runner), "--version");
        }
        let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = text.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
        model.unwrap_or("this machine").replace(',', " ")
    }
}

/// A program of a toolchain, or of the one that runs this where the name is empty. The variables that cargo sets for that one
/// rustup would take for the choice.
fn tool(program: &str, toolchain: &str) -> Command {
    let mut command = Command::new(program);
    if !toolchain.is_empty() {
        command.arg(format!("+{toolchain}")).env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO");
    }
    command
}

/// The linker of WebAssembly that comes with the compiler that runs this, or LLVM's.
fn rust_lld() -> String {
    let root = output(Command::new("rustc").args(["--print", "sysroot"])).unwrap_or_default();
    let path = Path::new(root.trim()).join("lib/rustlib").join(NATIVE).join("bin/rust-lld");
    if path.exists() { path.to_string_lossy().into_owned() } else { "wasm-ld".to_owned() }
}

/// A program's version by its own account, up to the date or the packager's part.
fn version(command: &mut Command, option: &str) -> String {
    let text = output(command.arg(option)).unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    line.split(" (").next().unwrap_or_default().replace(',', " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str = "values,a,1,2,3,4\nvalues,b,5,6,7,8\nBaseline,a,1,2,3,4\nBaseline,b,5,6,7,8\n";

    #[test]
    fn other_and_missing_bits_are_named() {
        for levels in ["Baseline", ""] {
            assert_eq!(compare(PRINTED, PRINTED, levels), Ok(("Baseline".to_owned(), 4)));
        }
        for (printed, levels, named) in [
            (PRINTED.replace("values,b,5,6,7,8", "values,b,5,6,7,9"), "Baseline", "b (values)"),
            (PRINTED.replace("Baseline,a,1", "Baseline,a,0"), "Baseline", "a (Baseline)"),
            ("values,a,1,2,3,4\n".to_owned(), "", "values: 1 codecs, not 2"),
            (PRINTED.to_owned(), "Avx2 Baseline", "Avx2"),
            (String::new(), "", "values: 0 codecs"),
            ("killed".to_owned(), "", "killed"),
        ] {
            let error = compare(&printed, PRINTED, levels).unwrap_err();
            assert!(error.contains(named), "{error}");
        }
    }

    #[test]
    fn unknown_names_are_refused() {
        assert!(chosen(&["vax".to_owned()]).err().unwrap_or_default().contains("`s390x`"));
        assert_eq!(chosen(&["s390x".to_owned()]).map(|found| found.len()), Ok(1));
        assert_eq!(chosen(&[]).map(|found| found.len()), Ok(processors().len() - 1));
    }
}
