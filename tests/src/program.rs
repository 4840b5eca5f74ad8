//! The program `unitvec`, run as a user runs it.

use crate::repository;
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;

/// Path of the program, built first in the profile of the tests.
///
/// # Panics
/// If it does not build.
pub fn path() -> &'static Path {
    static PATH: OnceLock<PathBuf> = OnceLock::new();
    let name = format!("unitvec{}", std::env::consts::EXE_SUFFIX);
    PATH.get_or_init(|| build(&["--bin", "unitvec"]).join(name))
}

/// Builds the program, and what these arguments add, in the profile of the tests; returns the output's folder.
///
/// # Panics
/// If it does not build.
pub fn build(arguments: &[&str]) -> PathBuf {
    let test = std::env::current_exe().unwrap_or_else(|error| panic!("{error}"));
    // A test is target/<profile>/deps/<test>.
    let folder =
        test.ancestors().nth(2).unwrap_or_else(|| panic!("{} has no profile folder", test.display()));
    let mut build = Command::new(env!("CARGO"));
    // Every build includes these packages, as that of `cargo xtask conform` does, so that all have the same features.
    build.args(["build", "--quiet", "--package", "unitvec-tests", "--package", "unitvec-host"]);
    build.args(arguments).current_dir(repository());
    if cfg!(feature = "glsl") {
        build.args(["--features", "unitvec-tests/glsl"]);
    }
    if folder.ends_with("release") {
        build.arg("--release");
    }
    let status = build.status().unwrap_or_else(|error| panic!("{error}"));
    assert!(status.success(), "{arguments:?} do not build");
    folder.to_owned()
}

/// A command that runs the program on lavapipe, with no UNITVEC_* setting of the caller's.
pub fn command<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Command {
    let mut command = Command::new(path());
    command.args(arguments).stdin(Stdio::null());
    for name in ["UNITVEC_COLUMNS", "UNITVEC_SPIRV", "UNITVEC_VULKAN_LOADER"] {
        command.env_remove(name);
    }
    command.env("UNITVEC_DEVICE", "lavapipe");
    command
}

/// Floats as the program reads them.
pub fn raw(floats: &[f32]) -> Vec<u8> {
    floats.iter().flat_map(|float| float.to_le_bytes()).collect()
}

/// Runs the program to its end.
///
/// # Panics
/// If it cannot be started.
pub fn run<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    command(arguments).output().unwrap_or_else(|error| panic!("{error}"))
}

/// Runs the program with `input` as its standard input.
///
/// # Panics
/// If it cannot be started or does not take its input.
pub fn run_with_input<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>, input: &[u8]) -> Output {
    let mut child = command(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap_or_else(|error| panic!("{error}"));
    let mut stdin = child.stdin.take().unwrap_or_else(|| panic!("no standard input"));
    std::thread::scope(|scope| {
        scope.spawn(move || stdin.write_all(input));
        child.wait_with_output().unwrap_or_else(|error| panic!("{error}"))
    })
}

/// The one line with which a run has ended, with this status.
///
/// # Panics
/// If it has ended otherwise.
pub fn refusal(output: &Output, status: i32) -> String {
    let said = stderr(output);
    assert_eq!((output.status.code(), said.lines().count()), (Some(status), 1), "{said}");
    said
}

/// Standard error as text.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}
