//! Files of the program `unitvec`: inputs read within bounds, outputs that exist whole or not at all, and other people's text
//! quoted in messages of one line.

#![deny(unsafe_code)]

mod error;
mod folder;
mod input;
mod output;
mod text;
#[cfg(target_os = "linux")]
mod unnamed;
mod used;

pub use error::{Error, Result};
pub use folder::Folder;
pub use input::{add_below, open, read_small, read_start};
pub use output::{Output, fail_beyond_limits, forget, remember, remove_unfinished, write_file};
pub use text::{one_line, shown, shown_lines};
pub use used::{check_unused, is_same_file, is_stdout, note_read};
