//! Compilers that are libraries of C or C++, which scripts in Python call: Microsoft's of HLSL, and that of Slang.

use crate::cases::Case;
use crate::job::Job;
use crate::{Result, told, tool};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::Command;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/python");

/// The function that takes the module compiled from a case's text.
pub type EachModule<'a> = &'a mut dyn FnMut(&Case, Result<Vec<u8>>) -> Result<()>;

/// A library, and the script that calls it.
pub struct Compiler<'a> {
    pub script: &'static str,
    pub library: &'a Path,
    /// Folder of the files that texts include.
    pub folder: PathBuf,
    pub arguments: &'static [&'static str],
}

impl Compiler<'_> {
    /// Compiles, and hands on the modules. Warnings are errors. Returns the compiler's version.
    pub fn compile(&self, jobs: &[Job<'_>], each: EachModule<'_>) -> Result<String> {
        let texts: Vec<(String, &str)> =
            jobs.iter().map(|job| (job.case.name(), job.text.as_str())).collect();
        let texts = serde_json::to_vec(&texts).map_err(told)?;
        let mut command = Command::new("python3");
        command
            .arg(Path::new(FOLDER).join(self.script))
            .arg(self.library)
            .arg(&self.folder)
            .args(self.arguments);
        command.env("PYTHONDONTWRITEBYTECODE", "1");
        tool::converse(&mut command, texts, |output| {
            let mut lines = BufReader::new(output).lines();
            let mut line = || match lines.next() {
                Some(line) => line.map_err(told),
                None => Err(format!("{} ended too soon", self.script)),
            };
            let version: String = serde_json::from_str(&line()?).map_err(told)?;
            for job in jobs {
                let (_, said, code): (String, String, String) =
                    serde_json::from_str(&line()?).map_err(told)?;
                let is_silent = said.is_empty() && !code.is_empty();
                each(job.case, if is_silent { STANDARD.decode(code).map_err(told) } else { Err(said) })?;
            }
            Ok(version)
        })
    }
}
