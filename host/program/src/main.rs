//! The program `unitvec`.

mod cli;

use std::process::ExitCode;

/// The status that shells report for a program that an interrupt ended.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    // Without a handler an interrupted run leaves its temporary file, and does no other harm.
    let _ = ctrlc::set_handler(|| {
        unitvec_files::remove_unfinished();
        std::process::exit(INTERRUPTED);
    });
    unitvec_files::fail_beyond_limits();
    match cli::run() {
        Ok(code) => code,
        Err(unitvec_host::Error::Files(unitvec_files::Error::ReaderGone)) => ExitCode::SUCCESS,
        Err(error) => {
            cli::tell(&error);
            ExitCode::from(if error.is_usage() { 2 } else { 1 })
        }
    }
}
