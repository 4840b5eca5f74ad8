//! Builds the examples and runs them, and opens the report in a browser.

use crate::drivers::debian::CHROMIUM;
use crate::languages::{target, unpacked};
use crate::{cargo, run as run_command, setup};
use std::fs;
use std::path::Path;
use std::process::Command;

const WGPU: [&str; 2] = ["--package", "unitvec-example-wgpu"];

/// Runs the program on wgpu with its tests, and opens the page for browsers and the report. `--all` fails where there is no browser.
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
        Ok(()) => {
            page(repository, &CHROMIUM.root(&cache))?;
            report(repository, &CHROMIUM.root(&cache))
        }
        Err(reason) if needs_all => Err(format!("examples/web and the report cannot be opened: {reason}")),
        Err(reason) => {
            eprintln!("xtask: NOT RUN: examples/web, the report: {reason}");
            Ok(())
        }
    }
}

/// Opens the page in the Chromium of this folder.
fn page(repository: &Path, chromium: &Path) -> Result<(), String> {
    let mut check = Command::new("python3");
    check.arg(repository.join("examples/web/check.py"));
    run_command(with_chromium(&mut check, chromium))
}

/// Opens the output of `unitvec report`, and holds its choices against `unitvec choose`.
fn report(repository: &Path, chromium: &Path) -> Result<(), String> {
    let folder = target(repository)?.join("report");
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let [report, of_sheets] = ["report.html", "sheets.html"].map(|name| folder.join(name));
    let unitvec = |arguments: &[&str]| {
        let mut command = cargo(&["run", "--quiet", "--package", "unitvec-host", "--bin", "unitvec", "--"]);
        command.args(arguments);
        command
    };
    run_command(unitvec(&["report", "--out"]).arg(&report))?;
    let sheets = repository.join("docs/figures");
    let mut without_device = unitvec(&["report", "--no-device", "--count", "100", "--figures"]);
    run_command(without_device.arg(sheets).arg("--out").arg(&of_sheets))?;
    let mut chosen = Vec::new();
    for (option, domain) in [("--choose", &[][..]), ("--hemisphere", &["--hemisphere"])] {
        let path = folder.join(format!("{}.json", option.trim_start_matches('-')));
        let file =
            fs::File::create(&path).map_err(|error| format!("cannot write {}: {error}", path.display()))?;
        run_command(unitvec(&["choose", "--max-error", "0.1", "--json", "-"]).args(domain).stdout(file))?;
        chosen.extend([option.into(), path.into_os_string()]);
    }
    for (page, screenshots) in [(&report, folder.clone()), (&of_sheets, folder.join("sheets"))] {
        let mut check = Command::new("python3");
        check.arg(repository.join("tests/report/browser.py")).args(&chosen);
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
