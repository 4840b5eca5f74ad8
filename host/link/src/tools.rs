//! SPIRV-Tools' programs.

use super::library::library_for;
use super::{Error, imports, parse};
use std::fs;
use std::path::Path;
use std::process::Command;
use unitvec_files::one_line;

/// An engine's module, linked with the library: without unused parts, optimised and validated.
///
/// # Errors
/// [`Error`].
pub fn link(spirv: &[u8]) -> Result<Vec<u8>, Error> {
    let (module, names) = imports::imports(parse(spirv)?)?;
    let folder = tempfile::tempdir()?;
    unitvec_files::remember(folder.path());
    let [engine, library, linked, optimised] =
        ["engine.spv", "unitvec.spv", "linked.spv", "optimised.spv"].map(|name| folder.path().join(name));
    fs::write(&engine, module.bytes())?;
    fs::write(&library, library_for(&module, &names)?)?;
    let environment = format!("spv1.{}", module.version.to_le_bytes()[1]);
    run("spirv-link", &[], &[&engine, &library, Path::new("-o"), &linked])?;
    // These passes do what HLSL's front-ends leave to the optimiser where they do not inline.
    let of_environment = format!("--target-env={environment}");
    let arguments = [of_environment.as_str(), "--legalize-hlsl", "-O"];
    run("spirv-opt", &arguments, &[&linked, Path::new("-o"), &optimised])?;
    // Layouts are the engine's affair, and its device's.
    run("spirv-val", &["--target-env", &environment, "--scalar-block-layout"], &[&optimised])?;
    let linked = fs::read(&optimised)?;
    unitvec_files::forget(folder.path());
    Ok(linked)
}

fn run(tool: &'static str, arguments: &[&str], files: &[&Path]) -> Result<(), Error> {
    let output = Command::new(tool)
        .args(arguments)
        .args(files)
        .output()
        .map_err(|source| Error::NoTool { tool, source })?;
    if output.status.success() {
        return Ok(());
    }
    let said =
        [output.stderr, output.stdout].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    let said = if said.trim().is_empty() { output.status.to_string() } else { said };
    Err(Error::Refused { tool, said: one_line(said) })
}
