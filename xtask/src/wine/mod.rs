//! Wine, set up so that programs in Rust run.

use crate::{cache, repository, run as run_command};
use std::path::PathBuf;
use std::process::Command;

/// The folder that Wine keeps its Windows in, with the library that Wine of Debian 12 lacks.
pub fn prefix() -> Result<PathBuf, String> {
    let prefix = cache("wine")?;
    let system = prefix.join("drive_c/windows/system32");
    let library = system.join("bcryptprimitives.dll");
    if !library.is_file() {
        println!("xtask: Wine makes its folder, which takes a minute");
        let mut boot = Command::new("wine");
        run_command(boot.args(["wineboot", "--init"]).env("WINEPREFIX", &prefix).env("WINEDEBUG", "-all"))?;
        let mut gcc = Command::new("x86_64-w64-mingw32-gcc");
        gcc.args(["-shared", "-o"]).arg(&library).arg(repository().join("xtask/src/wine/bcryptprimitives.c"));
        run_command(gcc.arg("-ladvapi32"))?;
    }
    Ok(prefix)
}
