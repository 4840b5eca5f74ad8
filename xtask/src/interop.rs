//! The formats of other software beside that software, which comes from npm and PyPI into `target/interop`:
//! `tests/interop/outside.mjs` compares codes and decoders, and runs tools after `unitvec snap`.

use crate::languages::Archive;
use crate::{at, cache, program, repository, run as run_command, setup};
use std::path::Path;
use std::process::Command;
use std::{env, fs};

const SOURCES: &str = "tests/interop";
/// The hashes of all packages of npm.
const LOCK: &str = "package-lock.json";

/// The results of the script, and their places among the docs.
const RESULTS: [(&str, &str); 2] =
    [("codes.csv", "docs/data/interop_outside.csv"), ("tools.csv", "docs/data/interop_tools.csv")];

/// Draco's own command line, which DracoPy carries.
pub const DRACO: Archive = Archive {
    name: "dracopy-2.2.0",
    url: "https://files.pythonhosted.org/packages/f7/52/4e060fc3b1d7acb550d58f6cd6ef2c01d3f05b306d9a4a5207bdbd485106/dracopy-2.2.0-cp311-cp311-manylinux_2_24_x86_64.manylinux_2_28_x86_64.whl",
    sha256: "f7e12ddbc6d0cded9c9bc52d8fa20cd1a85ca90c975920f84bef6b138e8b7e8f",
    members: "*/bin/draco_encoder",
    file: "dracopy-2.2.0.data/data/bin/draco_encoder",
};

/// `cargo xtask interop`; `--record` keeps the results for the docs.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let is_recorded = arguments == ["--record"];
    if let Some(unknown) = arguments.first().filter(|_| !is_recorded) {
        return Err(format!("interop takes no {unknown}"));
    }
    setup::packages(&["curl", "ca-certificates", "python3"])?;
    // Node.js from elsewhere has npm in it, and Debian's package of npm refuses to be beside it.
    if !setup::is_there("npm") {
        setup::packages(&["nodejs", "npm"])?;
    }
    let (folder, unitvec) = (cache("interop")?, program()?);
    let draco = DRACO.fetch(&folder)?;
    run_command(Command::new("chmod").arg("+x").arg(&draco))?;
    install(&folder)?;

    // Tools run on the Node.js among the packages, too.
    let packages = folder.join("node_modules/.bin");
    let folders = [Some(packages.as_path()), draco.parent()].into_iter().flatten().map(Path::to_owned);
    let path = env::var_os("PATH").unwrap_or_default();
    let path = env::join_paths(folders.chain(env::split_paths(&path))).map_err(|error| error.to_string())?;
    let mut script = Command::new(packages.join("node"));
    script.arg("outside.mjs").arg(unitvec).arg(repository().join("host/mesh/data/bunny.obj"));
    run_command(script.env("PATH", path).current_dir(&folder))?;
    for (result, file) in RESULTS.iter().filter(|_| is_recorded) {
        fs::copy(folder.join(result), repository().join(file)).map_err(at(Path::new(file)))?;
    }
    Ok(())
}

/// Copies the script into the folder, and installs the packages there unless the same ones are.
fn install(folder: &Path) -> Result<(), String> {
    let sources = repository().join(SOURCES);
    let lock = |folder: &Path| fs::read(folder.join(LOCK)).ok();
    // npm writes this file last.
    let is_whole = folder.join("node_modules/.package-lock.json").exists();
    let is_installed = is_whole && lock(folder) == lock(&sources);
    for file in ["outside.mjs", "package.json", LOCK] {
        fs::copy(sources.join(file), folder.join(file)).map_err(at(&sources.join(file)))?;
    }
    if is_installed {
        return Ok(());
    }
    println!("xtask: npm installs Cesium, Draco, meshoptimizer and tools of glTF");
    let mut npm = Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" });
    run_command(npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]).current_dir(folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_archive_is_pinned() {
        assert!(DRACO.url.starts_with("https://") && DRACO.url.contains(DRACO.name));
        assert!(DRACO.sha256.len() == 64 && DRACO.sha256.chars().all(|c| c.is_ascii_hexdigit()));
    }
}
