//! Options and output that the runs over codecs share.

use super::table::{Column, Layout, Wide, left_out, wrapped};
use super::{Vulkan, chosen_formats, is_mesh, print, status_after_validation, tell, to_json};
use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::Duration;
use unitvec_catalogue::AnyCodec;
use unitvec_files::{is_same_file, is_stdout, shown};
use unitvec_host::input::{RAW_ENDINGS, has_ending};
use unitvec_host::{Error, Result};
use unitvec_vulkan::{Device, DeviceInfo};

/// The option `--json`, which all commands with a result have.
#[derive(Args)]
pub struct Json {
    /// Write the result as JSON as well; - for the standard output, instead of the text. `unitvec schema COMMAND` describes
    /// it.
    #[arg(long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(not_an_input))]
    json: Option<PathBuf>,
}

/// Refuses the name of a mesh or of raw floats: with FILE forgotten, it would be an input's, which the JSON would replace.
fn not_an_input(path: PathBuf) -> Result<PathBuf, String> {
    if is_mesh(&path) || has_ending(&path, &RAW_ENDINGS) || has_ending(&path, &["npy", "uvec"]) {
        return Err("it has the name of an input; give a file.json, or - for the standard output".to_owned());
    }
    Ok(path)
}

impl Json {
    /// Fails where the JSON would replace one of these files.
    pub fn spare<'a>(&self, files: impl IntoIterator<Item = &'a PathBuf>) -> Result<()> {
        let Some(json) = self.json.as_deref().filter(|path| *path != Path::new("-")) else { return Ok(()) };
        // Outputs that do not exist yet are compared by their names.
        let absolute = |path: &Path| std::path::absolute(path).ok();
        let is_json = |file: &Path| absolute(file) == absolute(json) || is_same_file(file, json);
        match files.into_iter().any(|file| is_json(file)) {
            true => Err(Error::Usage(format!(
                "{} is an input or output; give the JSON another name",
                json.display()
            ))),
            false => Ok(()),
        }
    }

    /// True where there is JSON to be written.
    pub fn is_wanted(&self) -> bool {
        self.json.is_some()
    }

    /// True where the JSON goes to the standard output, by whatever name.
    pub fn is_to_stdout(&self) -> bool {
        self.json.as_deref().is_some_and(is_stdout)
    }

    /// Writes the report, where it is asked for.
    pub fn write(&self, report: &impl Serialize) -> Result<()> {
        if self.is_wanted() { self.write_text(&to_json(report)) } else { Ok(()) }
    }

    /// Writes a report that is JSON already.
    pub fn write_text(&self, json: &str) -> Result<()> {
        self.json.as_ref().map_or(Ok(()), |path| Ok(unitvec_files::write_file(path, json.as_bytes())?))
    }

    /// Prints the report to the standard output where it is to go there, else the text, and writes the report to its file, also
    /// where nobody reads the text.
    pub fn write_or_print(&self, report: &impl Serialize, text: impl FnOnce() -> String) -> Result<ExitCode> {
        if !self.is_to_stdout() {
            unless_unread(print(&text()))?;
        }
        self.write(report)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// What was printed to a reader that has gone away is no failure: the run's files and its exit status are still wanted.
fn unless_unread(printed: Result<ExitCode>) -> Result<()> {
    match printed {
        Err(Error::Files(unitvec_files::Error::ReaderGone)) => Ok(()),
        printed => printed.map(drop),
    }
}

/// The file of the rows of a run.
#[cfg(feature = "lab")]
#[derive(Args)]
pub struct Outputs {
    /// Write the rows as CSV as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

#[cfg(feature = "lab")]
impl Outputs {
    /// True where the JSON or the CSV goes to the standard output. Both fail.
    pub fn take_stdout(&self, json: &Json) -> Result<bool> {
        let is_csv = self.csv.as_deref() == Some(Path::new("-"));
        if json.is_to_stdout() && is_csv {
            return Err(Error::Usage(
                "--json - and --csv - cannot share the standard output; give one a file".to_owned(),
            ));
        }
        Ok(json.is_to_stdout() || is_csv)
    }

    /// Writes the rows, where they are asked for.
    pub fn write<T: Serialize>(&self, rows: &[T]) -> Result<()> {
        self.csv.as_ref().map_or(Ok(()), |path| super::write_separated(path, rows, b','))
    }
}

/// Which codecs, on which device, and where the outcome goes.
#[derive(Args)]
pub struct Run {
    /// Codecs to run, as `unitvec codecs` lists them: oct16,oct32p. All of them if not given.
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    pub codec: Vec<String>,
    #[command(flatten)]
    pub json: Json,
    #[command(flatten)]
    pub wide: Wide,
    #[command(flatten)]
    pub vulkan: Vulkan,
}

impl Run {
    pub fn formats(&self) -> Result<Vec<&'static AnyCodec>> {
        chosen_formats(&self.codec)
    }
}

/// A bar of progress on the standard error, and the lines above it; where that is no terminal, a line now and then.
pub struct Live {
    bar: ProgressBar,
    is_quiet: bool,
    /// The second of the next line.
    next: AtomicU64,
}

impl Live {
    /// Runs that are done sooner show no bar.
    const DELAY: Duration = Duration::from_secs(1);

    /// Seconds between two lines where there is no terminal.
    const LINES: u64 = 10;

    /// A bar with this template, over so much work if that is known. `is_quiet` where a report takes the standard output.
    pub fn new(work: Option<u64>, template: &str, is_quiet: bool) -> Self {
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::with_draw_target(work, ProgressDrawTarget::hidden()).with_style(style);
        Self { bar, is_quiet, next: AtomicU64::new(Self::LINES) }
    }

    /// The bar, which is shown once its run has taken a while.
    fn bar(&self) -> &ProgressBar {
        if self.bar.is_hidden() && self.bar.elapsed() >= Self::DELAY {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        let seconds = self.bar.elapsed().as_secs();
        if self.bar.is_hidden() && seconds >= self.next.load(Relaxed) {
            self.next.store(seconds + Self::LINES, Relaxed);
            let (done, name) = (self.bar.position(), self.bar.message());
            let of = self.bar.length().map_or_else(String::new, |length| format!(" of {length}"));
            let colon = if name.is_empty() { "" } else { ": " };
            tell(format_args!("{name}{colon}{done}{of} done in {seconds} s"));
        }
        &self.bar
    }

    /// Shows that so much more work is done.
    pub fn advance(&self, done: u64) {
        self.bar().inc(done);
    }

    /// Shows that so much work is done in all.
    pub fn reach(&self, done: u64) {
        self.bar().set_position(done);
    }

    /// Shows a name or some words beside the bar.
    pub fn name(&self, words: impl Into<String>) {
        self.bar().set_message(shown(words.into()));
    }

    /// Prints above the bar, unless a report takes the standard output.
    pub fn print(&self, text: impl FnOnce() -> String) -> Result<()> {
        if self.is_quiet {
            return Ok(());
        }
        let mut printed = Ok(ExitCode::SUCCESS);
        self.bar.suspend(|| printed = print(&text()));
        unless_unread(printed)
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// The table of a run, which grows above the bar, and its last words.
pub struct Screen {
    pub live: Live,
    table: Layout,
    columns: Option<usize>,
    messages: Vec<String>,
}

impl Screen {
    /// An empty table with these columns.
    pub fn new(columns: Vec<Column>, wide: &Wide, live: Live) -> Result<Self> {
        let width = wide.columns()?;
        Ok(Self { live, table: Layout::new(columns, width), columns: width, messages: Vec::new() })
    }

    pub fn head(&self, legend: &str) -> Result<()> {
        self.live.print(|| wrapped(legend, "    ", self.columns) + &self.table.heading())
    }

    pub fn row(&self, id: &str, lines: impl FnOnce() -> String) -> Result<()> {
        self.live.name(id);
        self.live.print(lines)
    }

    /// A line of the table: a cell for each column, shown or not.
    pub fn line(&self, cells: &[&dyn Display]) -> String {
        self.table.line(cells)
    }

    /// Whether there is room for a column.
    #[cfg(feature = "lab")]
    pub fn shows(&self, column: usize) -> bool {
        self.table.shows(column)
    }

    /// A remark below a row of the table.
    pub fn note(&self, words: &str) -> String {
        wrapped(&format!("    {words}\n"), "        ", self.columns)
    }

    /// Prints a paragraph within or below the table.
    #[cfg(feature = "lab")]
    pub fn say(&self, words: &str, indent: &str) -> Result<()> {
        self.live.print(|| wrapped(words, indent, self.columns))
    }

    /// Closes the device, which nothing else holds, and keeps the validation layer's messages.
    pub fn close(&mut self, device: Arc<Device>) -> DeviceInfo {
        let (info, messages) = close(device);
        self.finish(messages);
        info
    }

    /// Removes the bar, and keeps the validation layer's messages.
    pub fn finish(&mut self, messages: Vec<String>) {
        self.live.finish();
        self.messages = messages;
    }

    /// Prints the last words, below the number of columns that were left out; fails for messages of the validation layer.
    pub fn end(self, words: &str) -> Result<ExitCode> {
        self.live.finish();
        self.live.print(|| wrapped(words, "", self.columns) + &left_out(&[&self.table]))?;
        Ok(status_after_validation(&self.messages))
    }

    /// Ends a comparison with its verdict: what agreed, or why it fails.
    pub fn verdict(self, command: &str, outcome: Result<String, String>) -> Result<ExitCode> {
        let outcome = match self.messages.len() {
            0 => outcome,
            1 => Err("1 message of the validation layer".to_owned()),
            count => Err(format!("{count} messages of the validation layer")),
        };
        let words = match &outcome {
            Ok(agreed) => format!("\n{command}: PASS: {agreed}\n"),
            Err(reason) => format!("\n{command}: FAIL: {reason}\n"),
        };
        let status = self.end(&words)?;
        Ok(if outcome.is_ok() { status } else { ExitCode::FAILURE })
    }
}

/// The template of bars that count work.
pub const PERCENT: &str = "{msg:<20} {wide_bar} {percent}%, {eta} left";

/// The template of bars that count codecs.
#[cfg(feature = "lab")]
pub const CODECS_LEFT: &str = "{msg:<20} {wide_bar} {pos} of {len} codecs, {eta} left";

/// Closes a device that nothing else holds; returns the messages of the validation layer, which may also speak of objects that
/// outlive their device.
pub fn close(device: Arc<Device>) -> (DeviceInfo, Vec<String>) {
    let (info, instance) = (device.info().clone(), device.instance().clone());
    drop(device);
    (info, instance.validation_messages())
}
