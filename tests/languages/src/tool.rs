//! Programs that compile.

use crate::{Result, told};
use std::io::Write;
use std::process::{ChildStdout, Command, Stdio};

/// Runs a program with `input`, and returns its output.
pub fn converse<T>(
    command: &mut Command,
    input: Vec<u8>,
    read: impl FnOnce(ChildStdout) -> Result<T>,
) -> Result<T> {
    let name = command.get_program().to_string_lossy().into_owned();
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().map_err(|error| format!("{name} cannot be started: {error}"))?;
    let (stdin, stdout) = (child.stdin.take(), child.stdout.take());
    // The code below reports a program that ends too soon.
    let writer = std::thread::spawn(move || stdin.map(|mut stdin| stdin.write_all(&input)));
    let result = stdout.ok_or_else(|| format!("{name} has no output")).and_then(read);
    if result.is_err() {
        // The program may be waiting for a reader.
        let _ = child.kill();
    }
    let status = child.wait().map_err(told)?;
    let _ = writer.join();
    match result {
        Ok(_) if !status.success() => Err(format!("{name} ended with {status}")),
        result => result,
    }
}

/// A program's output, or its error message.
pub fn output(command: &mut Command) -> Result<String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name} cannot be started: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() || !said.is_empty() {
        let lines: Vec<&str> = said.lines().take(5).collect();
        return Err(format!("{name} ended with {}: {}", output.status, lines.join("; ")));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
