//! `cargo xtask conform --drivers`: `unitvec conform` on every Vulkan driver of this machine, each by itself.

pub mod debian;

use crate::{cache, take, write};
pub use debian::newer_radv;
use debian::{PACKAGED, Packaged, files_of};
use std::collections::HashSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The folders where Vulkan's loader looks for drivers' files.
const FOLDERS: &str = include_str!("../../../host/lab/data/icd_folders.txt");

/// The files of drivers that browsers bring along.
const OF_BROWSERS: [&str; 2] =
    ["/usr/lib/chromium/vk_swiftshader_icd.json", "/opt/google/chrome/vk_swiftshader_icd.json"];

/// Variables that name drivers' files to the loader.
const VARIABLES: [&str; 3] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"];

/// The source of the docs' table of drivers.
const RECORD: &str = "docs/data/drivers.tsv";

/// Names the file of a newer RADV than the system's to the tests that renew costs.
pub const NEWER_RADV: &str = "UNITVEC_NEWER_RADV_ICD";

/// The fetched drivers, for the hash of the record's inputs.
pub fn versions() -> String {
    format!("{PACKAGED:?}")
}

pub struct Options {
    fetch: bool,
    record: bool,
    /// Arguments of `unitvec conform`.
    others: Vec<String>,
}

impl Options {
    /// `None` where the arguments have no `--drivers`.
    pub fn of(arguments: &[String]) -> Result<Option<Self>, String> {
        let mut others = arguments.to_vec();
        let [drivers, fetch, record] =
            ["--drivers", "--fetch", "--record"].map(|option| take(&mut others, option));
        if !drivers {
            return Ok(None);
        }
        let given = |names: &[&str]| {
            others.iter().find(|argument| names.contains(&argument.split('=').next().unwrap_or_default()))
        };
        if let Some(argument) = given(&["--device", "imprecise", "pipeline", "--json", "--summary"]) {
            return Err(format!("--drivers runs one driver after the other, and takes no {argument}"));
        }
        if let Some(argument) = given(&["--codec", "--count", "--seed"]).filter(|_| record) {
            return Err(format!("--record keeps what all codecs do, and takes no {argument}"));
        }
        Ok(Some(Self { fetch, record, others }))
    }
}

/// A driver that was looked for, and its outcome.
struct Row {
    /// The driver's file, or the package that it was fetched from.
    origin: String,
    outcome: Outcome,
}

#[derive(Debug, PartialEq)]
enum Outcome {
    /// The names and the values that `unitvec conform --summary` wrote, a line each, and whether it passed.
    Ran { summary: String, passed: bool },
    /// A word, and the reason. Some drivers may be missing.
    NotRun { word: &'static str, reason: String, is_failure: bool },
}

/// The need for a driver to run.
#[derive(Clone, Copy, PartialEq)]
enum Duty {
    /// The driver has to run if it has a device.
    OfDevice,
    /// The driver has to run.
    Always,
    /// The driver need not run.
    Never,
}

/// A driver that is there.
struct Driver {
    origin: String,
    icd: PathBuf,
    /// The command that starts `unitvec`.
    launcher: Vec<OsString>,
    duty: Duty,
}

/// Runs `unitvec conform` on all drivers, and ends in a table of them.
pub fn run(options: &Options, unitvec: &Path) -> Result<(), String> {
    let cache = cache("drivers")?;
    // Drivers are fetched before any runs: a network that fails is known at once.
    let packaged: Vec<_> =
        PACKAGED.iter().map(|driver| from_package(driver, &cache, options.fetch)).collect();
    let drivers = installed().into_iter().map(Ok).chain(packaged);
    let run = |driver: Driver| {
        let outcome = driver.run(unitvec, &options.others, &cache);
        Row { origin: driver.origin, outcome }
    };
    let rows: Vec<Row> = drivers.map(|driver| driver.map_or_else(|row| row, run)).collect();
    print!("\n{}\n", table(&rows));
    verdict(&rows)?;
    if options.record {
        write(RECORD, record(&rows))?;
    }
    Ok(())
}

fn from_package(driver: &Packaged, cache: &Path, fetch: bool) -> Result<Driver, Row> {
    let duty = if driver.is_newer { Duty::Never } else { Duty::Always };
    let missing = |reason, is_failure| Row {
        origin: driver.title(),
        outcome: Outcome::NotRun { word: "not run", reason, is_failure },
    };
    if fetch {
        let is_needed = duty == Duty::Always && driver.refusal_here().is_none();
        driver.fetch(cache).map_err(|reason| missing(reason, is_needed))?;
    }
    let icd = driver.icd(cache);
    if !icd.is_file() {
        return Err(missing("not fetched: --fetch does".to_owned(), false));
    }
    let origin = driver.version(cache).unwrap_or_else(|| driver.title());
    Ok(Driver { origin, icd, launcher: driver.launcher(cache), duty })
}

/// The drivers that Vulkan's loader would find, and those of browsers.
fn installed() -> Vec<Driver> {
    let home = std::env::var_os("HOME").map(|home| Path::new(&home).join(".local/share/vulkan/icd.d"));
    let folders: Vec<PathBuf> = FOLDERS.lines().map(PathBuf::from).chain(home).collect();
    let named: Vec<OsString> = VARIABLES.iter().filter_map(std::env::var_os).collect();
    let mut files: Vec<PathBuf> = named.iter().flat_map(std::env::split_paths).collect();
    files.extend(OF_BROWSERS.iter().map(PathBuf::from).filter(|path| path.is_file()));
    let driver = |icd: PathBuf| {
        let (origin, launcher) = (icd.display().to_string(), Vec::new());
        Driver { origin, icd, launcher, duty: Duty::OfDevice }
    };
    found(&folders, files).into_iter().map(driver).collect()
}

/// The drivers' files of the folders, and those named besides, each once.
fn found(folders: &[PathBuf], named: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = folders.iter().flat_map(|folder| files_of(folder, "json")).collect();
    files.sort();
    files.extend(named);
    let mut known = HashSet::new();
    files.retain(|path| known.insert(path.canonicalize().unwrap_or_else(|_| path.clone())));
    files
}

impl Driver {
    fn run(&self, unitvec: &Path, arguments: &[String], cache: &Path) -> Outcome {
        println!("\nxtask: {}", self.origin);
        if let Err(reason) = self.probe(unitvec) {
            return Outcome::NotRun { word: "no device", reason, is_failure: self.duty == Duty::Always };
        }
        let summary = cache.join(format!("summary-{}.tsv", std::process::id()));
        let mut conform = self.unitvec(unitvec);
        conform.args(["conform", "--validate", "--summary"]).arg(&summary).args(arguments);
        let ended = match conform.status() {
            Ok(status) => status,
            Err(error) => return self.did_not_run(format!("it cannot be started: {error}")),
        };
        let told = fs::read_to_string(&summary);
        // Left there, it would speak for a later driver that ends without one.
        if let Err(error) = told.as_ref().map_or(Ok(()), |_| fs::remove_file(&summary)) {
            return self.did_not_run(format!("{} cannot be removed: {error}", summary.display()));
        }
        match told.ok().filter(|text| text.lines().count() == 2) {
            Some(summary) => Outcome::Ran { summary, passed: ended.success() },
            None => self.did_not_run(format!("conform ended with {ended}")),
        }
    }

    fn did_not_run(&self, reason: String) -> Outcome {
        Outcome::NotRun { word: "not run", reason, is_failure: self.duty != Duty::Never }
    }

    /// Tests that the driver has a device.
    fn probe(&self, unitvec: &Path) -> Result<(), String> {
        let mut devices = self.unitvec(unitvec);
        devices.arg("devices").env("VK_LOADER_DEBUG", "error").stdin(Stdio::null());
        let output = devices.output().map_err(|error| format!("it cannot be started: {error}"))?;
        if output.status.success() { Ok(()) } else { Err(reason(&String::from_utf8_lossy(&output.stderr))) }
    }

    /// `unitvec` where this driver is the only one.
    fn unitvec(&self, unitvec: &Path) -> Command {
        let mut words = self.launcher.iter().map(OsString::as_os_str).chain([unitvec.as_os_str()]);
        let mut command = Command::new(words.next().unwrap_or_default());
        command.args(words);
        for name in VARIABLES.iter().chain(&["UNITVEC_DEVICE"]) {
            command.env_remove(name);
        }
        // Older loaders know the second name only.
        command.env("VK_DRIVER_FILES", &self.icd).env("VK_ICD_FILENAMES", &self.icd);
        command
    }
}

/// The reason for no device: the first error of Vulkan's loader, without its function's name, or the program's.
fn reason(said: &str) -> String {
    let of_loader = said.lines().find_map(|line| Some(line.split_once("ERROR:")?.1));
    let line = of_loader.or_else(|| said.lines().last()).unwrap_or_default();
    let words: Vec<&str> = line.split_whitespace().skip_while(|word| word.ends_with(':')).collect();
    words.join(" ")
}

/// Figures of a driver that ran, by their names in `unitvec conform --summary`.
const FIGURES: [&str; 4] = ["codecs", "vectors", "codes", "mismatches"];

fn table(rows: &[Row]) -> String {
    let line = |word: &str, figures: [&str; 4], last: &str| {
        let figures = figures.map(|figure| format!("{figure:>11}")).concat();
        format!("{word:<9}{figures}  {last}\n")
    };
    let mut text = line("", FIGURES, "driver; device; where from");
    for Row { origin, outcome } in rows {
        text += &match outcome {
            Outcome::Ran { summary, passed } => {
                let field = |name| value(summary, name);
                let last = format!("{}; {}; {origin}", field("driver"), field("device"));
                line(if *passed { "PASS" } else { "FAIL" }, FIGURES.map(field), &last)
            }
            Outcome::NotRun { word, reason, .. } => line(word, ["-"; 4], &format!("{origin}: {reason}")),
        };
    }
    text
}

/// The value of this name in a summary.
fn value<'a>(summary: &'a str, name: &str) -> &'a str {
    let (names, values) = summary.split_once('\n').unwrap_or_default();
    let mut fields = names.split('\t').zip(values.trim_end_matches('\n').split('\t'));
    fields.find(|(other, _)| *other == name).map_or("?", |(_, value)| value)
}

/// The drivers that ran, below the names of the fields.
fn record(rows: &[Row]) -> String {
    let mut text = String::new();
    for Row { origin, outcome } in rows {
        let Outcome::Ran { summary, .. } = outcome else { continue };
        let (names, values) = summary.split_once('\n').unwrap_or_default();
        if text.is_empty() {
            text = format!("origin\t{names}\n");
        }
        text += &format!("{origin}\t{}\n", values.trim_end_matches('\n'));
    }
    text
}

/// Fails where a driver differs, where one did not run that has to, and where none ran at all.
fn verdict(rows: &[Row]) -> Result<(), String> {
    let of = |is: fn(&Outcome) -> bool| -> Vec<&str> {
        rows.iter().filter(|row| is(&row.outcome)).map(|row| row.origin.as_str()).collect()
    };
    let different = of(|outcome| matches!(outcome, Outcome::Ran { passed: false, .. }));
    let missing = of(|outcome| matches!(outcome, Outcome::NotRun { is_failure: true, .. }));
    let ran = of(|outcome| matches!(outcome, Outcome::Ran { .. })).len();
    let faults = [("conform fails on ", different), ("not run: ", missing)];
    let faults = faults.into_iter().filter(|(_, origins)| !origins.is_empty());
    let mut faults: Vec<String> =
        faults.map(|(what, origins)| what.to_owned() + &origins.join(", ")).collect();
    if ran == 0 {
        faults.push("no driver ran".to_owned());
    }
    if !faults.is_empty() {
        return Err(faults.join("; "));
    }
    println!("xtask: {ran} drivers agree to the bit; {} not run", rows.len() - ran);
    Ok(())
}

#[cfg(test)]
mod tests;
