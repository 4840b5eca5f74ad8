//! The program `unitvec`.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::Arguments::parse().run() {
        Ok(code) => code,
        Err(error) => {
            eprintln!("unitvec: {error}");
            ExitCode::from(if error.is_usage() { 2 } else { 1 })
        }
    }
}
