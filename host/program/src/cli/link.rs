use super::{print, write_output};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_files::Output;
use unitvec_files::read_small;
use unitvec_host::{Error, Result};
use unitvec_link as link;
use unitvec_link::stubs;

#[derive(Args)]
pub struct Arguments {
    /// Print the stubs that shaders of this language include, and link nothing.
    #[arg(long, value_enum, value_name = "LANGUAGE", conflicts_with_all = ["module", "output"])]
    stubs: Option<stubs::Language>,
    /// SPIR-V module that calls stubs, - for the standard input.
    #[arg(required_unless_present = "stubs")]
    module: Option<PathBuf>,
    /// Linked module, - for the standard output. A file is replaced only once the new one is complete.
    #[arg(short, long, value_name = "FILE", required_unless_present = "stubs")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    match (arguments.stubs, &arguments.module, &arguments.output) {
        (None, Some(module), Some(out)) => link(module, out),
        (Some(language), ..) => print(&stubs::text(language)),
        // clap lets nothing else through.
        _ => Err(Error::Usage("name a module and, by -o, the linked one".to_owned())),
    }
}

fn link(path: &Path, out: &Path) -> Result<ExitCode> {
    let module = read_small(path)?;
    let output = Output::create_binary(out)?;
    let linked = link::link(&module).map_err(|error| Error::Link { path: path.to_owned(), error })?;
    write_output(output, &linked)?;
    Ok(ExitCode::SUCCESS)
}
