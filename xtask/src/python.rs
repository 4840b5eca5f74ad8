//! The Python package as users get it: built from its source archive outside the repository, installed into new
//! environments under `target/python`, and tested there beside the program `unitvec`.

use crate::{cache, emptied, program, repository, run as run_command, setup};
use std::env;
use std::path::Path;
use std::process::Command;

/// Interpreters to test, in a list as of `PATH`; without it `python3`.
const INTERPRETERS: &str = "UNITVEC_PYTHON";

/// The versions of NumPy that each interpreter is tested with: the last before 2, where it has one, and the newest.
const NUMPY: [&str; 2] = ["numpy<2", "numpy"];

/// The examples that run, and what they need besides the wheel. Those of Ray and Spark need half a gigabyte more, and Java.
const EXAMPLES: [(&str, &str); 5] = [
    ("dask_zarr", "dask[array,distributed]"),
    ("xarray_winds", "xarray"),
    ("parquet", "pyarrow"),
    ("duckdb_udf", "duckdb"),
    ("polars_udf", "polars"),
];

/// Rows of each example.
const ROWS: &str = "20000";

/// What it takes from PyPI.
const REQUIREMENTS: &str = "python/requirements.txt";

/// `cargo xtask python`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let all = arguments == ["--all"];
    if let Some(unknown) = arguments.first().filter(|_| !all) {
        return Err(format!("python takes no {unknown}"));
    }
    setup::packages(&["python3", "python3-venv"])?;
    let (folder, unitvec) = (cache("python")?, program()?);
    let named = env::var(INTERPRETERS).unwrap_or_else(|_| "python3".to_owned());
    let interpreters: Vec<_> = env::split_paths(&named).collect();
    let [first, ..] = &interpreters[..] else {
        return Err(format!("{INTERPRETERS} names no interpreter"));
    };
    let wheel = build(&folder, first)?;
    for (interpreter, numpy) in interpreters.iter().flat_map(|it| NUMPY.map(|numpy| (it, numpy))) {
        println!("xtask: {} with {numpy}", interpreter.display());
        test(&folder, interpreter, numpy, &wheel, &unitvec, all)?;
    }
    Ok(())
}

/// Builds the source archive, and from it the wheel.
fn build(folder: &Path, interpreter: &Path) -> Result<String, String> {
    let [tools, archives] = ["tools", "dist"].map(|name| folder.join(name));
    let pip = environment(&tools, interpreter)?;
    run_command(Command::new(&pip).args(["-q", "install", "-r"]).arg(repository().join(REQUIREMENTS)))?;
    let archives = emptied(archives)?;
    let mut source = Command::new(tools.join("bin/maturin"));
    run_command(
        source.args(["sdist", "-m", "python/Cargo.toml", "-o"]).arg(&archives).current_dir(repository()),
    )?;
    let archive = only(&archives, "tar.gz")?;
    run_command(
        Command::new(tools.join("bin/mypy"))
            .args(["--strict", "unitvec/__init__.py"])
            .current_dir(repository().join("python")),
    )?;
    println!("xtask: builds the wheel from {archive}");
    let mut wheel = Command::new(&pip);
    wheel.args(["-q", "wheel", "--no-deps", "--wheel-dir"]).arg(&archives).arg(archive);
    // Anew: cargo goes by the times of files, and those of an archive are always the same.
    wheel.env("CARGO_TARGET_DIR", emptied(folder.join("cargo"))?).current_dir(env::temp_dir());
    run_command(&mut wheel)?;
    only(&archives, "whl")
}

/// Installs the wheel into a new environment, and runs the tests and the README there.
fn test(
    folder: &Path,
    interpreter: &Path,
    numpy: &str,
    wheel: &str,
    unitvec: &Path,
    all: bool,
) -> Result<(), String> {
    let new = emptied(folder.join("environment"))?;
    let pip = environment(&new, interpreter)?;
    if run_command(Command::new(&pip).args(["-q", "install", "--only-binary=:all:", numpy])).is_err() {
        println!("xtask: LEFT OUT: this interpreter has no {numpy}");
        return Ok(());
    }
    let install =
        |wheel: &str| run_command(Command::new(&pip).args(["-q", "install", numpy, wheel, "pytest"]));
    let has_zarr = install(&format!("{wheel}[zarr,numcodecs]")).is_ok();
    if !has_zarr {
        println!("xtask: LEFT OUT: this interpreter has no Zarr 3.1");
        install(wheel)?;
    }
    let python = new.join("bin/python");
    let tests = repository().join("python");
    let count = if all { "1000000" } else { "16384" };
    // From elsewhere, so that Python takes the installed package.
    run_command(
        Command::new(&python).args(["-m", "doctest"]).arg(tests.join("README.md")).current_dir(&new),
    )?;
    let mut pytest = Command::new(&python);
    pytest
        .args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "--import-mode=importlib"])
        .arg(tests.join("tests"));
    pytest.env("UNITVEC_PROGRAM", unitvec).env("UNITVEC_COUNT", count).current_dir(&new);
    run_command(&mut pytest)?;
    if has_zarr && NUMPY.ends_with(&[numpy]) { examples(&pip, &python, &new) } else { Ok(()) }
}

/// Installs what the examples need, and runs each.
fn examples(pip: &Path, python: &Path, folder: &Path) -> Result<(), String> {
    run_command(Command::new(pip).args(["-q", "install"]).args(EXAMPLES.map(|(_, packages)| packages)))?;
    EXAMPLES.iter().try_for_each(|(name, _)| {
        let path = repository().join(format!("python/examples/{name}.py"));
        run_command(Command::new(python).arg(path).arg(ROWS).current_dir(folder))
    })
}

/// Makes an environment. Returns its pip.
pub fn environment(folder: &Path, interpreter: &Path) -> Result<std::path::PathBuf, String> {
    run_command(Command::new(interpreter).args(["-m", "venv"]).arg(folder))?;
    Ok(folder.join("bin/pip"))
}

/// The one file in a folder with this ending.
fn only(folder: &Path, ending: &str) -> Result<String, String> {
    let files = folder.read_dir().map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths = files.flatten().map(|file| file.path().display().to_string());
    paths.find(|path| path.ends_with(ending)).ok_or_else(|| format!("{}: no {ending}", folder.display()))
}
