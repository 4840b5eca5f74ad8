//! The program `unitvec`.

mod cli;

use clap::Parser;
use std::io::Write;
use std::process::ExitCode;

/// The status that shells report for a program that an interrupt ended.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    // Without a handler an interrupted run leaves its temporary file, and does no other harm.
    let _ = ctrlc::set_handler(|| {
        unitvec_files::remove_unfinished();
        std::process::exit(INTERRUPTED);
    });
    match cli::Arguments::parse().run() {
        Ok(code) => code,
        Err(unitvec_host::Error::Files(unitvec_files::Error::ReaderGone)) => ExitCode::SUCCESS,
        Err(error) => {
            // Where the standard error is closed, the exit status suffices.
            let _ = writeln!(std::io::stderr(), "unitvec: {}", printable(&error.to_string()));
            ExitCode::from(if error.is_usage() { 2 } else { 1 })
        }
    }
}

/// One line of text for a terminal: names of files may have control characters, and those of others escape sequences.
fn printable(text: &str) -> String {
    let escaped =
        |char: char| if char.is_control() { char.escape_default().to_string() } else { char.to_string() };
    text.chars().map(escaped).collect()
}
