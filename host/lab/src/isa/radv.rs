//! Mesa's RADV driver without a GPU: with RADV_FORCE_FAMILY it stands in for any AMD GPU that it knows, and compiles
//! for it. The code cannot be run.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use unitvec_choose::costs::GENERATIONS;

/// The folders where Vulkan's loader looks for drivers; `cargo xtask conform --drivers` looks there too.
const FOLDERS: &str = include_str!("../../data/icd_folders.txt");

/// RADV that cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No folder has its file.
    #[error(
        "Mesa's driver RADV, whose compiler --gpu asks, is not installed: there is no radeon_icd*.json in {}; install it \
         (Debian: apt-get install mesa-vulkan-drivers) or name its file with --driver or UNITVEC_RADV_ICD",
        FOLDERS.trim_end().replace('\n', ", ")
    )]
    NotInstalled,
    /// The named file does not exist.
    #[error("cannot read the driver file {}: {source}; --driver and UNITVEC_RADV_ICD take the path of a radeon_icd*.json", .path.display())]
    NoSuchDriver {
        /// The file's path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// The driver does not know the GPU.
    #[error(
        "the driver {} does not know the GPU `{gpu}`; these versions of Mesa know these: {}; name the file of a newer one with --driver or UNITVEC_RADV_ICD",
        .driver.display(), known()
    )]
    UnknownGpu {
        /// The GPU's name.
        gpu: String,
        /// The driver's file.
        driver: PathBuf,
    },
    /// The driver does not start.
    #[error("the driver {} cannot be used: {reason}", .driver.display())]
    Unusable {
        /// The driver's file.
        driver: PathBuf,
        /// The reason why the driver does not start.
        reason: String,
    },
    /// This program cannot be started again.
    #[error("cannot run this program again with the driver's environment: {0}")]
    NotStarted(io::Error),
}

/// The GPUs that each version of Mesa knows.
fn known() -> String {
    let known =
        GENERATIONS.map(|generation| format!("{} ({}) {}", generation.gpu, generation.name, generation.mesa));
    known.join(", ")
}

/// The environment in which Vulkan has one device: RADV's stand-in for a GPU.
pub struct Radv {
    gpu: String,
    driver: PathBuf,
}

impl Radv {
    /// Prepares for a GPU by its code name, `navi21`, or by its generation, `rdna2`; with the driver in this file, or
    /// the system's.
    /// # Errors
    /// [`Error::NotInstalled`] or [`Error::NoSuchDriver`].
    pub fn new(gpu: &str, driver: Option<&Path>) -> Result<Self, Error> {
        let driver = match driver {
            Some(path) => {
                let found = path.canonicalize();
                found.map_err(|source| Error::NoSuchDriver { path: path.to_owned(), source })?
            }
            None => {
                let folders: Vec<PathBuf> = FOLDERS.lines().map(PathBuf::from).collect();
                installed(&folders).ok_or(Error::NotInstalled)?
            }
        };
        Ok(Self { gpu: unitvec_choose::costs::code_name(gpu), driver })
    }

    /// True where this process has the environment.
    pub fn is_here(&self) -> bool {
        self.environment().iter().all(|(name, value)| std::env::var_os(name).as_ref() == Some(value))
    }

    /// The command that runs this program again, with the same arguments, in the environment and without
    /// UNITVEC_DEVICE.
    ///
    /// # Errors
    /// [`Error::UnknownGpu`], [`Error::Unusable`] or [`Error::NotStarted`].
    pub fn command(&self) -> Result<Command, Error> {
        self.probe()?;
        let mut command = self.here()?;
        command.args(std::env::args_os().skip(1));
        Ok(command)
    }

    /// A driver that does not know the GPU ends the process, so another process has to ask it.
    fn probe(&self) -> Result<(), Error> {
        let output = self.here()?.arg("devices").stdin(Stdio::null()).output().map_err(Error::NotStarted)?;
        let said = String::from_utf8_lossy(&output.stderr);
        let driver = self.driver.clone();
        let reason = if !output.status.success() {
            if said.contains("Unknown family") {
                return Err(Error::UnknownGpu { gpu: self.gpu.clone(), driver });
            }
            said.lines().last().unwrap_or("it ends the program").trim_start_matches("unitvec: ")
        } else if String::from_utf8_lossy(&output.stdout).contains("RADV") {
            return Ok(());
        } else {
            "it is not RADV"
        };
        Err(Error::Unusable { driver, reason: reason.to_owned() })
    }

    fn here(&self) -> Result<Command, Error> {
        let mut command = Command::new(std::env::current_exe().map_err(Error::NotStarted)?);
        command.envs(self.environment()).env_remove("UNITVEC_DEVICE");
        Ok(command)
    }

    /// The variables. Older loaders know the first name of the driver's file, newer ones the second as well.
    pub fn environment(&self) -> [(&'static str, OsString); 3] {
        let driver = self.driver.as_os_str();
        [
            ("VK_ICD_FILENAMES", driver.to_owned()),
            ("VK_DRIVER_FILES", driver.to_owned()),
            ("RADV_FORCE_FAMILY", OsString::from(&self.gpu)),
        ]
    }
}

/// RADV's file in the first of the folders that has one, with this processor's first.
fn installed(folders: &[PathBuf]) -> Option<PathBuf> {
    let name = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let in_folder = |folder: &PathBuf| {
        let files = std::fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
        let is_radv = |path: &PathBuf| name(path).starts_with("radeon_icd") && name(path).ends_with(".json");
        files.filter(is_radv).min_by_key(|path| (!name(path).contains(std::env::consts::ARCH), path.clone()))
    };
    folders.iter().find_map(in_folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The driver of this processor is found in the first folder that has any, and none where there is none.
    #[test]
    fn the_installed_driver_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let folders = ["empty", "missing", "full"].map(|name| folder.path().join(name));
        std::fs::create_dir(&folders[0]).unwrap();
        std::fs::create_dir(&folders[2]).unwrap();
        let own = folders[2].join(format!("radeon_icd.{}.json", std::env::consts::ARCH));
        for path in [&own, &folders[2].join("radeon_icd.arc.json"), &folders[2].join("lvp_icd.json")] {
            std::fs::write(path, "{}").unwrap();
        }
        assert_eq!(installed(&folders), Some(own));
        assert_eq!(installed(&folders[..2]), None);
    }
}
