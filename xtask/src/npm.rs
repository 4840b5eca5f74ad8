//! The npm package as users get it: built with and without wide instructions, packed, installed into an empty folder under
//! `target/npm-package`, and tested beside the program `unitvec`, in several versions of Node.js and in Chromium.

use crate::drivers::debian::CHROMIUM;
use crate::{at, cache, cargo, emptied, program, repository, run as run_command, setup, take, target};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// Its folder in that of cargo.
const FOLDER: &str = "npm-package";

const TARGET: &str = "wasm32-unknown-unknown";

/// Instructions on 128 bits, which browsers have had since 2021, Safari since 2023.
const WIDE: &str = "+simd128";

const TESTS: [&str; 3] = ["arrays", "bits", "package"];

/// Versions of Node.js beside the one here, by their names in `package.json`.
const OTHER_NODES: [&str; 2] = ["node-18", "node-newest"];

/// `cargo xtask npm [--build] [--all] [--record]`: the last writes what engines draw to `docs/data/`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let mut others = arguments.to_vec();
    let [build_alone, all, record] = ["--build", "--all", "--record"].map(|option| take(&mut others, option));
    if let Some(unknown) = others.first() {
        return Err(format!("npm takes no {unknown}"));
    }
    // Node.js from elsewhere has npm in it, and Debian's package of npm refuses to be beside it.
    if !setup::is_there("npm") {
        setup::packages(&["nodejs", "npm"])?;
    }
    let folder = repository().join("npm");
    install(&folder)?;
    build(WIDE, &emptied(folder.join("dist"))?)?;
    // npm packs no links, and nothing from outside the folder.
    for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
        let to = folder.join("dist").join(licence);
        fs::copy(repository().join(licence), &to).map_err(at(&to))?;
    }
    run_command(npm(&folder).args(["run", "--silent", "types"]))?;
    if build_alone {
        return Ok(());
    }
    let narrow = emptied(cache(FOLDER)?.join("narrow"))?;
    build("-simd128", &narrow)?;
    test(&folder, &narrow, all, record)
}

/// Builds the module for these instructions, and what calls it.
fn build(instructions: &str, dist: &Path) -> Result<(), String> {
    let _ = run_command(Command::new("rustup").args(["target", "add", TARGET]));
    let mut module = cargo(&["build", "--package", "unitvec-wasm", "--profile", "npm", "--target", TARGET]);
    let flags = format!("-Ctarget-feature={instructions}");
    run_command(module.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", flags))?;
    let module = target()?.join(TARGET).join("npm/unitvec_wasm.wasm");
    run_command(cargo(&["run", "--quiet", "--package", "xtask-npm", "--"]).arg(module).arg(dist))
}

/// Installs what tests and types need, unless it is there.
pub fn install(folder: &Path) -> Result<(), String> {
    let time = |file: &str| fs::metadata(folder.join(file)).and_then(|data| data.modified()).ok();
    // npm writes this file last.
    if time("node_modules/.package-lock.json") > time("package-lock.json") {
        return Ok(());
    }
    run_command(npm(folder).args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]))
}

/// Packs the package, installs the archive into an empty folder, and runs the tests on it.
fn test(folder: &Path, narrow: &Path, all: bool, record: bool) -> Result<(), String> {
    let unitvec = program()?;
    let empty = emptied(cache(FOLDER)?.join("installed"))?;
    run_command(npm(folder).args(["pack", "--silent", "--pack-destination"]).arg(&empty))?;
    let archive = empty.join(format!("unitvec-{}.tgz", env!("CARGO_PKG_VERSION")));
    fs::write(empty.join("package.json"), "{}").map_err(at(&empty))?;
    run_command(npm(&empty).args(["install", "--silent", "--no-audit", "--no-fund"]).arg(archive))?;

    let tests = |node: &Path, names: &[&str]| {
        println!("xtask: {} --test {}", node.display(), names.join(" "));
        let mut tests = Command::new(node);
        tests
            .arg("--test")
            .args(names.iter().map(|name| format!("tests/{name}.test.js")))
            .current_dir(folder);
        tests.env("UNITVEC_PROGRAM", &unitvec).env("UNITVEC_NARROW", narrow).env("UNITVEC_INSTALLED", &empty);
        tests.env("UNITVEC_COUNT", if all { "1000000" } else { "4096" });
        tests
    };
    let here = Path::new("node");
    run_command(tests(here, &TESTS).envs(chromium()?))?;
    run_command(tests(here, &["bits"]).env("UNITVEC_WASM", narrow.join("unitvec.wasm")))?;
    let mut engines = tests(here, &["gltf-codes", "engines", "textures"]);
    run_command(engines.envs(chromium()?).envs(record.then_some(("UNITVEC_RECORD", "1"))))?;
    OTHER_NODES.iter().try_for_each(|name| {
        run_command(&mut tests(&folder.join("node_modules").join(name).join("bin/node"), &TESTS))
    })
}

/// Measures GLB files, and what engines take to load them.
pub fn sizes() -> Result<(), String> {
    run(&["--build".to_owned()])?;
    let mut sizes = Command::new("node");
    sizes.args(["benchmarks/sizes.js", "../docs/data/web_sizes.csv"]).current_dir(repository().join("npm"));
    run_command(sizes.envs(chromium()?))
}

/// The variables by which tests find Chromium; none where there is none.
pub fn chromium() -> Result<Vec<(&'static str, PathBuf)>, String> {
    let cache = cache("drivers")?;
    match CHROMIUM.fetch(&cache) {
        Ok(()) => {
            let root = CHROMIUM.root(&cache);
            let libraries = root.join("usr/lib/x86_64-linux-gnu");
            let both = env::join_paths([libraries.clone(), libraries.join("pulseaudio")]);
            let both = both.map_err(|error| error.to_string())?;
            Ok(vec![
                ("UNITVEC_CHROMIUM", root.join("usr/lib/chromium/chromium")),
                ("UNITVEC_CHROMIUM_LIBRARIES", both.into()),
            ])
        }
        Err(reason) if env::var_os("CI").is_some() => Err(reason),
        Err(reason) => {
            eprintln!("xtask: NOT RUN in a browser: {reason}");
            Ok(Vec::new())
        }
    }
}

fn npm(folder: &Path) -> Command {
    let mut npm = Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" });
    npm.current_dir(folder);
    npm
}
