//! Options and output that the runs over codecs share.

use super::table::Wide;
use super::{Vulkan, chosen_formats, print, progress};
use clap::Args;
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_catalogue::AnyCodec;
use unitvec_host::Result;
use unitvec_vulkan::{Device, DeviceInfo};

/// Which codecs, on which device, and where the outcome goes.
#[derive(Args)]
pub struct Run {
    /// Codecs to run, as `unitvec codecs` lists them: oct16,oct32p. All of them if not given.
    #[arg(long, value_name = "ID,...", value_delimiter = ',')]
    pub codec: Vec<String>,
    /// Write the report as JSON as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    #[command(flatten)]
    pub wide: Wide,
    #[command(flatten)]
    pub vulkan: Vulkan,
}

impl Run {
    /// The codecs.
    pub fn formats(&self) -> Result<Vec<&'static AnyCodec>> {
        chosen_formats(&self.codec)
    }

    /// True where the JSON goes to the standard output.
    pub fn to_stdout(&self) -> bool {
        self.json.as_deref() == Some(Path::new("-"))
    }
}

/// The table of a run while it grows, above a bar of progress.
pub struct Live {
    bar: ProgressBar,
    is_quiet: bool,
}

impl Live {
    /// A bar with this template, over so much work. `is_quiet` where a report takes the standard output.
    pub fn new(work: u64, template: &str, is_quiet: bool) -> Self {
        Self { bar: progress::bar(Some(work), template), is_quiet }
    }

    /// Shows that so much more work is done.
    pub fn advance(&self, done: u64) {
        progress::show_if_due(&self.bar);
        self.bar.inc(done);
    }

    /// Names the codec beside the bar.
    pub fn name(&self, id: &str) {
        progress::show_if_due(&self.bar);
        self.bar.set_message(id.to_owned());
    }

    /// Prints the lines of a codec above the bar.
    pub fn print(&self, id: &str, lines: impl FnOnce() -> String) -> Result<()> {
        self.name(id);
        if self.is_quiet {
            return Ok(());
        }
        let mut printed = Ok(ExitCode::SUCCESS);
        self.bar.suspend(|| printed = print(&lines()));
        printed.map(drop)
    }

    /// Removes the bar.
    pub fn finish(self) {
        self.bar.finish_and_clear();
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
