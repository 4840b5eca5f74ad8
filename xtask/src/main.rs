//! `cargo xtask`: set-up, conform, test, spirv, shaders, examples, processors, windows, interop, python, npm, web, renew, packages
//! and dist, each ending in a clear verdict.
//!
//! No dependencies, so that it starts at once on a fresh machine.

mod compilers;
mod dist;
mod drivers;
mod examples;
mod interop;
mod languages;
mod npm;
mod packages;
mod processors;
mod python;
mod renew;
mod setup;
#[cfg(test)]
mod tests;
mod web;
mod windows;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::OnceLock;
use std::time::Instant;
use std::{env, fs, io};

const USAGE: &str = include_str!("usage.txt");

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let Some((command, rest)) = arguments.split_first() else {
        eprint!("{USAGE}");
        return ExitCode::from(2);
    };
    let started = Instant::now();
    let outcome = match command.as_str() {
        "conform" => conform(rest),
        "test" if rest.iter().any(|argument| argument == "--languages") => languages::run(rest),
        "test" => test(rest),
        "setup" => setup::run(),
        "spirv" => spirv(rest),
        "shaders" => shaders(rest),
        "examples" => examples::run(rest),
        "processors" => processors::run(rest),
        "windows" => windows::run(rest),
        "interop" => interop::run(rest),
        "python" => python::run(rest),
        "npm" => npm::run(rest),
        "web" => web::run(rest),
        "renew" => renew::run(rest),
        "dist" => dist::run(rest),
        "packages" => setup::run().and_then(|()| packages::run()),
        "help" | "--help" | "-h" => {
            print!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        unknown => {
            eprintln!("xtask: unknown command `{unknown}`\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let seconds = started.elapsed().as_secs();
    match outcome {
        Ok(()) => {
            println!("xtask {command}: PASS ({seconds} s)");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("xtask {command}: FAIL ({seconds} s): {reason}");
            ExitCode::FAILURE
        }
    }
}

/// All commands build with the same features, so that cargo does not build dependencies twice. GLSL is left out where it cannot
/// be compiled.
fn features() -> &'static [&'static str] {
    static FEATURES: OnceLock<&[&str]> = OnceLock::new();
    FEATURES.get_or_init(|| match &setup::missing_for_glsl()[..] {
        [] => &["--features", "unitvec-tests/glsl"],
        missing => {
            println!("xtask: GLSL and HLSL are left out: shaderc is built by {}", missing.join(", "));
            &[]
        }
    })
}

fn conform(arguments: &[String]) -> Result<(), String> {
    let of_drivers = drivers::Options::of(arguments)?;
    let unitvec = program()?;
    if let Some(options) = of_drivers {
        return drivers::run(&options, &unitvec);
    }
    let is_chosen = env::var_os("UNITVEC_DEVICE").is_some()
        || arguments.iter().any(|argument| argument.starts_with("--device"));
    let devices = |validate: &[&str]| match setup::has_apt() {
        true => Ok("llvmpipe".to_owned()),
        false => output(Command::new(&unitvec).arg("devices").args(validate)),
    };
    let options = options(is_chosen, devices);
    // A subcommand comes first.
    run(Command::new(&unitvec).arg("conform").args(arguments).args(options))
}

/// The options of `conform`: validation, and lavapipe unless a device is chosen. Where Debian's packages are not installed it goes
/// on without what `unitvec devices` lacks, and says so.
fn options(is_chosen: bool, devices: impl Fn(&[&str]) -> Result<String, String>) -> Vec<&'static str> {
    let mut options = Vec::new();
    match devices(&["--validate"]) {
        Err(reason) if reason.contains("validation layer") => eprintln!("xtask: NOT VALIDATED: {reason}"),
        _ => options.push("--validate"),
    }
    if !is_chosen {
        match devices(&[]) {
            Ok(list) if !list.contains("llvmpipe") => {
                println!("xtask: no lavapipe here: the best device is taken, which has a star:\n{list}");
            }
            _ => options.extend(["--device", "lavapipe"]),
        }
    }
    options
}

/// Builds `unitvec`, and installs its requirements.
fn program() -> Result<PathBuf, String> {
    let packages = ["--package", "unitvec-host", "--package", "unitvec-tests"];
    built(cargo(&["build", "--bin", "unitvec"]).args(packages).args(features()))?;
    Ok(target()?.join("debug/unitvec"))
}

/// Builds by this command, and installs the requirements meanwhile.
fn built(command: &mut Command) -> Result<(), String> {
    let pending = setup::begin()?;
    println!("xtask: building; the first build takes minutes");
    let built = run(command);
    pending.finish().and(built)
}

/// The folder that cargo builds in: xtask lies in `debug` below it.
fn target() -> Result<PathBuf, String> {
    let here = env::current_exe().map_err(|error| format!("cannot tell where xtask lies: {error}"))?;
    Ok(here.ancestors().nth(2).map_or_else(|| repository().join("target"), Path::to_owned))
}

/// A folder below that of cargo, made where it is missing.
fn cache(name: &str) -> Result<PathBuf, String> {
    let folder = target()?.join(name);
    fs::create_dir_all(&folder).map_err(at(&folder))?;
    Ok(folder)
}

/// A new, empty folder.
fn emptied(folder: PathBuf) -> Result<PathBuf, String> {
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(at(&folder))?;
    Ok(folder)
}

/// Names the file in an error.
fn at(file: &Path) -> impl Fn(io::Error) -> String {
    let file = file.display().to_string();
    move |error| format!("{file}: {error}")
}

fn test(arguments: &[String]) -> Result<(), String> {
    let mut others = arguments.to_vec();
    let [exhaustive, fuzz] = ["--exhaustive", "--fuzz"].map(|option| take(&mut others, option));
    let left_out = [
        "--exclude=xtask-spirv",
        "--exclude=xtask-header",
        "--exclude=unitvec-bench",
        "--exclude=unitvec-language-tests",
        "--exclude=unitvec-example-wgpu",
        "--exclude=unitvec-python",
        "--exclude=unitvec-wasm",
        "--exclude=xtask-npm",
    ];
    let all = || {
        let mut command = cargo(&["test", "--workspace"]);
        command.args(left_out).args(features());
        command
    };
    let of_cargo: Vec<_> = others.iter().take_while(|argument| *argument != "--").collect();
    if of_cargo.iter().any(|argument| ["--no-run", "--doc"].contains(&argument.as_str())) {
        setup::run()?;
    } else {
        built(all().arg("--no-run").args(of_cargo))?;
    }
    run(all().args(others))?;
    if fuzz {
        println!("xtask: 10^6 mutated files; UNITVEC_FUZZ and UNITVEC_FUZZ_SEED give other numbers");
        let count = env::var_os("UNITVEC_FUZZ").unwrap_or_else(|| "1000000".into());
        run(integration(&["--", "--nocapture", "fuzz::"]).env("UNITVEC_FUZZ", count))?;
    }
    if exhaustive {
        println!("xtask: all 2^32 codes of each 32-bit codec, 1 to 3 minutes a codec on 2 cores");
        run(&mut integration(&["--", "--ignored", "--nocapture", "exhaustive::"]))?;
    }
    Ok(())
}

/// The tests of all packages together, in one program.
fn integration(arguments: &[&str]) -> Command {
    let mut command = cargo(&["test", "--package", "unitvec-tests", "--test", "unitvec"]);
    command.args(features()).args(arguments);
    command
}

fn spirv(arguments: &[String]) -> Result<(), String> {
    println!("xtask: the first run compiles the shader compiler's C++ tools, a few minutes");
    if arguments != ["--example"] {
        run(&mut cargo(&["test", "--quiet", "--package", "xtask-spirv"]))?;
    }
    run(cargo(&["run", "--package", "xtask-spirv", "--"]).args(arguments))
}

fn shaders(arguments: &[String]) -> Result<(), String> {
    let write = ["run", "--quiet", "--package", "unitvec-languages", "--example", "shaders", "--"];
    run(cargo(&write).args(arguments))
}

/// Takes an option out of the arguments. True if it was there.
fn take(arguments: &mut Vec<String>, option: &str) -> bool {
    let before = arguments.len();
    arguments.retain(|argument| argument != option);
    arguments.len() < before
}

/// The cargo that runs this, in the repository's root.
fn cargo(arguments: &[&str]) -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments).current_dir(repository());
    command
}

/// Writes a file of the repository.
fn write(file: &str, text: impl AsRef<[u8]>) -> Result<(), String> {
    fs::write(repository().join(file), text).map_err(at(Path::new(file)))
}

fn repository() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

fn run(command: &mut Command) -> Result<(), String> {
    let program = command.get_program().to_string_lossy().into_owned();
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{program} ended with {status}")),
        Err(error) => Err(format!("{program} cannot be started: {error}")),
    }
}

/// A command's output, or the last lines of its errors.
fn output(command: &mut Command) -> Result<String, String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.stdin(Stdio::null()).output();
    let output = output.map_err(|error| format!("{program} cannot be started: {error}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    let said: Vec<&str> = errors.lines().filter(|line| !line.trim().is_empty()).collect();
    let last = said[said.len().saturating_sub(3)..].join("; ");
    Err(format!("{program} ended with {}: {last}", output.status))
}
