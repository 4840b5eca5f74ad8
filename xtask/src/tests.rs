//! Helpers of the modules' tests.

use std::fs;
use std::path::PathBuf;

/// Arguments of a command line.
pub fn strings(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

/// An empty folder for a test.
pub fn folder(test: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("unitvec-xtask-{}-{test}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}
