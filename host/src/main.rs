//! The program `unitvec`.

mod cli;

use clap::Parser;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::Arguments::parse().run() {
        Ok(code) => code,
        Err(unitvec_host::Error::ReaderGone) => ExitCode::SUCCESS,
        Err(error) => {
            // Where the standard error is closed, the exit status has to do.
            let _ = writeln!(std::io::stderr(), "unitvec: {error}");
            ExitCode::from(if error.is_usage() { 2 } else { 1 })
        }
    }
}
