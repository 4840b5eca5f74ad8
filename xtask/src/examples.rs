//! Builds the examples and runs them.

use crate::{cargo, run as run_command, setup};
use std::path::Path;
use std::process::{Command, Stdio};

const WGPU: [&str; 2] = ["--package", "unitvec-example-wgpu"];

/// Runs the program on wgpu with its tests, and opens the page for browsers.
pub fn run(repository: &Path) -> Result<(), String> {
    let pending = setup::begin()?;
    println!("xtask: building; the first build takes minutes");
    let tested = run_command(cargo(&["test"]).args(WGPU));
    pending.finish().and(tested)?;
    run_command(cargo(&["run"]).args(WGPU))?;
    page(repository)
}

/// Without Chromium the page is not opened, which only CI takes for a failure.
fn page(repository: &Path) -> Result<(), String> {
    let is_there = Command::new("chromium").arg("--version").stdout(Stdio::null()).status();
    if is_there.is_ok_and(|status| status.success()) {
        return run_command(Command::new("python3").arg(repository.join("examples/web/check.py")));
    }
    let reason = "examples/web is NOT RUN: there is no `chromium`; install Debian's package of that name";
    if std::env::var_os("CI").is_some() {
        return Err(reason.to_owned());
    }
    eprintln!("xtask: {reason}");
    Ok(())
}
