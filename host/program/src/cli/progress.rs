//! Progress on the standard error, where that is a terminal, of runs that take a while.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::Duration;

/// Runs that are done sooner show nothing.
const DELAY: Duration = Duration::from_secs(1);

/// A bar that is not shown yet; `length` is none where it is unknown.
pub fn bar(length: Option<u64>, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::with_draw_target(length, ProgressDrawTarget::hidden()).with_style(style)
}

/// Shows a bar once its run has taken a while.
pub fn show_if_due(bar: &ProgressBar) {
    if bar.is_hidden() && bar.elapsed() >= DELAY {
        bar.set_draw_target(ProgressDrawTarget::stderr());
    }
}
