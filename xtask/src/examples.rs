//! Builds the examples and runs them, and opens the report in a browser.

use crate::drivers::debian::CHROMIUM;
use crate::{built, cache, cargo, program, repository, run as run_command, take};
use std::fs::File;
use std::path::Path;
use std::process::Command;

const WGPU: [&str; 2] = ["--package", "unitvec-example-wgpu"];

/// Runs the program on wgpu with its tests, and opens the page for browsers and the report. `--all` fails where there is no browser.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let mut others = arguments.to_vec();
    let needs_all = take(&mut others, "--all") || std::env::var_os("CI").is_some();
    if let Some(other) = others.first() {
        return Err(format!("unknown argument `{other}`; there is --all"));
    }
    built(cargo(&["test"]).args(WGPU))?;
    let cache = cache("drivers")?;
    // Drivers complain without such a folder.
    run_command(cargo(&["run"]).args(WGPU).env("XDG_RUNTIME_DIR", std::env::temp_dir()))?;
    match CHROMIUM.fetch(&cache) {
        Ok(()) => {
            page(&CHROMIUM.root(&cache))?;
            report(&CHROMIUM.root(&cache))
        }
        Err(reason) if needs_all => Err(format!("examples/web and the report cannot be opened: {reason}")),
        Err(reason) => {
            eprintln!("xtask: NOT RUN: examples/web, the report: {reason}");
            Ok(())
        }
    }
}

/// Opens the page in the Chromium of this folder.
fn page(chromium: &Path) -> Result<(), String> {
    let mut check = Command::new("python3");
    check.arg(repository().join("examples/web/check.py"));
    run_command(with_chromium(&mut check, chromium))
}

/// Opens the output of `unitvec report`, and holds its choices against `unitvec choose`.
fn report(chromium: &Path) -> Result<(), String> {
    let folder = cache("report")?;
    let [report, of_sheets] = ["report.html", "sheets.html"].map(|name| folder.join(name));
    let unitvec = program()?;
    run_command(Command::new(&unitvec).args(["report", "--out"]).arg(&report))?;
    let mut without_device = Command::new(&unitvec);
    without_device.args(["report", "--no-device", "--count", "100", "--figures"]);
    run_command(without_device.arg(repository().join("docs/figures")).arg("--out").arg(&of_sheets))?;
    let mut chosen = Vec::new();
    for (option, domain) in [("--choose", &[][..]), ("--hemisphere", &["--hemisphere"])] {
        let path = folder.join(format!("{}.json", option.trim_start_matches('-')));
        let file =
            File::create(&path).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        let mut choose = Command::new(&unitvec);
        run_command(choose.args(["choose", "--max-error", "0.1", "--json", "-"]).args(domain).stdout(file))?;
        chosen.extend([option.into(), path.into_os_string()]);
    }
    for (page, screenshots) in [(&report, folder.clone()), (&of_sheets, folder.join("sheets"))] {
        let mut check = Command::new("python3");
        check.arg(repository().join("tests/report/browser.py")).args(&chosen);
        check.arg("--screenshots").arg(screenshots).arg(page);
        run_command(with_chromium(&mut check, chromium))?;
    }
    Ok(())
}

/// Adds the arguments that the scripts find Chromium by.
fn with_chromium<'a>(check: &'a mut Command, chromium: &Path) -> &'a mut Command {
    let libraries = chromium.join("usr/lib/x86_64-linux-gnu");
    check.arg(chromium.join("usr/lib/chromium/chromium")).arg(&libraries).arg(libraries.join("pulseaudio"))
}
