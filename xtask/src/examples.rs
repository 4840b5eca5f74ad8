//! Builds the examples and runs them.

use crate::drivers::debian::CHROMIUM;
use crate::languages::{target, unpacked};
use crate::{cargo, run as run_command, setup};
use std::path::Path;
use std::process::Command;

const WGPU: [&str; 2] = ["--package", "unitvec-example-wgpu"];

/// Runs the program on wgpu with its tests, and opens the page for browsers. `--all` fails where there is no browser.
pub fn run(repository: &Path, arguments: &[String]) -> Result<(), String> {
    let needs_all = match arguments {
        [] => std::env::var_os("CI").is_some(),
        [option] if option == "--all" => true,
        [other, ..] => return Err(format!("unknown argument `{other}`; there is --all")),
    };
    let pending = setup::begin()?;
    println!("xtask: building; the first build takes minutes");
    let tested = run_command(cargo(&["test"]).args(WGPU));
    pending.finish().and(tested)?;
    let cache = target(repository)?.join("drivers");
    // Drivers complain without such a folder.
    run_command(cargo(&["run"]).args(WGPU).env("XDG_RUNTIME_DIR", std::env::temp_dir()))?;
    match unpacked(&CHROMIUM, &cache) {
        Ok(()) => page(repository, &CHROMIUM.root(&cache)),
        Err(reason) if needs_all => Err(format!("examples/web cannot be run: {reason}")),
        Err(reason) => {
            eprintln!("xtask: NOT RUN: examples/web: {reason}");
            Ok(())
        }
    }
}

/// Opens the page in the Chromium of this folder.
fn page(repository: &Path, chromium: &Path) -> Result<(), String> {
    let libraries = chromium.join("usr/lib/x86_64-linux-gnu");
    let mut check = Command::new("python3");
    check.arg(repository.join("examples/web/check.py"));
    check.arg(chromium.join("usr/lib/chromium/chromium"));
    run_command(check.arg(&libraries).arg(libraries.join("pulseaudio")))
}
