//! Mesa's drivers without a GPU, which compile for it; the code cannot be run. RADV stands in for AMD's GPUs by itself, the
//! others with the libraries of Mesa's drm-shim, which no package has.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;
use unitvec_choose::costs::{GENERATIONS, GPUS, Line, code_name, find_gpu};
use unitvec_vulkan::Statistics;

/// The folders where Vulkan's loader looks for drivers; `cargo xtask conform --drivers` looks there too.
const FOLDERS: &str = include_str!("../../data/icd_folders.txt");

/// Names the folder with the compilers that `cargo xtask renew costs` builds.
const COMPILERS: &str = "UNITVEC_COMPILERS";

/// The folder without that variable, from the root of a clone.
const BUILT: &str = "target/compilers";

/// Names the file that takes what the driver says, to the process that it compiles in.
const SAID: &str = "UNITVEC_COMPILER_SAID";

/// A compiler that cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// No folder has RADV's file.
    #[error(
        "Mesa's driver RADV, whose compiler --gpu asks, is not installed: there is no radeon_icd*.json in {}; install it \
         (Debian: apt-get install mesa-vulkan-drivers) or name its file with --driver or UNITVEC_RADV_ICD",
        FOLDERS.trim_end().replace('\n', ", ")
    )]
    NotInstalled,
    /// The compiler has to be built.
    #[error(
        "the compiler for {gpu} is not in {}: in a clone of the repository, `cargo xtask renew costs` puts it into {BUILT}; \
         elsewhere name that folder by {COMPILERS}",
        .folder.display()
    )]
    NotBuilt {
        /// The GPU's name.
        gpu: String,
        /// The folder that was looked in.
        folder: PathBuf,
    },
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

/// The GPUs that each version of Mesa knows, and those of other compilers.
fn known() -> String {
    let known =
        GENERATIONS.map(|generation| format!("{} ({}) {}", generation.gpu, generation.name, generation.mesa));
    let others = GPUS.iter().filter(|gpu| gpu.line != Line::Radeon).map(|gpu| gpu.name);
    format!(
        "{}; compilers that `cargo xtask renew costs` builds: {}",
        known.join(", "),
        others.collect::<Vec<_>>().join(", ")
    )
}

/// The folder with the compilers of other makers.
pub(super) fn compilers() -> PathBuf {
    std::env::var_os(COMPILERS).map_or_else(|| BUILT.into(), PathBuf::from)
}

/// A GPU's driver.
struct Driver {
    /// A word in the name of its device.
    title: &'static str,
    /// Its folder among [`compilers`], with the shim; `None` for the system's, which needs none.
    folder: Option<&'static str>,
    /// The variable that names the GPU, and its value.
    variable: (&'static str, String),
}

impl Driver {
    fn of(gpu: &str) -> Self {
        let known = find_gpu(gpu);
        let value = match known.map_or("", |gpu| gpu.name) {
            "a630" => "630".to_owned(),
            "a730" => "730".to_owned(),
            "g52" => "7212".to_owned(),
            "g610" => "a867".to_owned(),
            _ => code_name(gpu),
        };
        let (title, folder, variable) = match known.map_or(Line::Radeon, |gpu| gpu.line) {
            Line::Intel => ("Intel", Some("intel"), "INTEL_STUB_GPU_PLATFORM"),
            Line::Adreno => ("Turnip", Some("freedreno"), "FD_GPU_ID"),
            Line::Mali => ("Mali", Some("panfrost"), "PAN_GPU_ID"),
            // Its shim stands in for one GPU, and reads no variable.
            Line::VideoCore => ("V3D", Some("broadcom"), "V3D_GPU_ID"),
            // NVIDIA's compiler is no driver of Vulkan.
            Line::Radeon | Line::Nvidia => ("RADV", None, "RADV_FORCE_FAMILY"),
        };
        Self { title, folder, variable: (variable, value) }
    }
}

/// The environment in which Vulkan has one device: a driver's stand-in for a GPU.
pub struct StandIn {
    driver: Driver,
    file: PathBuf,
}

impl StandIn {
    /// Prepares for a GPU by its name, `navi21` or `dg2`, or by its generation, `rdna2`; with the driver in this file, or
    /// the system's, or the one that was built.
    ///
    /// # Errors
    /// [`Error::NotInstalled`], [`Error::NotBuilt`] or [`Error::NoSuchDriver`].
    pub fn new(gpu: &str, file: Option<&Path>) -> Result<Self, Error> {
        let driver = Driver::of(gpu);
        let file = match (file, driver.folder) {
            (Some(path), _) => {
                let found = path.canonicalize();
                found.map_err(|source| Error::NoSuchDriver { path: path.to_owned(), source })?
            }
            (None, Some(folder)) => {
                let (gpu, folder) = (gpu.to_owned(), compilers().join(folder));
                folder.join("icd.json").canonicalize().map_err(|_| Error::NotBuilt { gpu, folder })?
            }
            (None, None) => {
                let folders: Vec<PathBuf> = FOLDERS.lines().map(PathBuf::from).collect();
                installed(&folders).ok_or(Error::NotInstalled)?
            }
        };
        Ok(Self { driver, file })
    }

    /// True where this process has the environment.
    pub fn is_here(&self) -> bool {
        self.environment().iter().all(|(name, value)| std::env::var_os(name).as_ref() == Some(value))
    }

    /// Runs this program again, with the same arguments, in the environment and without UNITVEC_DEVICE. Of what a driver
    /// with a shim says, only the program's own words are shown.
    ///
    /// # Errors
    /// [`Error::UnknownGpu`], [`Error::Unusable`] or [`Error::NotStarted`].
    pub fn run(&self) -> Result<ExitCode, Error> {
        self.probe()?;
        let mut command = here()?;
        command.args(std::env::args_os().skip(1));
        let said = self.prepare(&mut command)?;
        let status = command.status().map_err(Error::NotStarted)?;
        let text = std::fs::read(said.path()).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let own: Vec<&str> = text.lines().filter(|line| line.starts_with("unitvec: ")).collect();
        own.iter().for_each(|line| eprintln!("{line}"));
        match status.code().and_then(|code| u8::try_from(code).ok()) {
            Some(code) => Ok(ExitCode::from(code)),
            None => Err(self.unusable(text.lines().last().unwrap_or("it ends the program"))),
        }
    }

    /// Gives a command the environment. What a driver with a shim says goes to the file, as long as it is held.
    ///
    /// # Errors
    /// [`Error::NotStarted`].
    pub fn prepare(&self, command: &mut Command) -> Result<NamedTempFile, Error> {
        let said = NamedTempFile::new().map_err(Error::NotStarted)?;
        self.set(command);
        if self.driver.folder.is_some() {
            command.env(SAID, said.path()).stderr(said.reopen().map_err(Error::NotStarted)?);
        }
        Ok(said)
    }

    /// A driver that does not know the GPU ends the process, so another process has to ask it.
    fn probe(&self) -> Result<(), Error> {
        let mut command = here()?;
        self.set(&mut command);
        let output = command.arg("devices").stdin(Stdio::null()).output().map_err(Error::NotStarted)?;
        let said = String::from_utf8_lossy(&output.stderr);
        let title = self.driver.title;
        if said.contains("Unknown family") {
            let (gpu, driver) = (self.driver.variable.1.clone(), self.file.clone());
            return Err(Error::UnknownGpu { gpu, driver });
        }
        if !output.status.success() {
            let last = said.lines().last().unwrap_or("it ends the program");
            return Err(self.unusable(last.trim_start_matches("unitvec: ")));
        }
        let is_it = String::from_utf8_lossy(&output.stdout).contains(title);
        if is_it { Ok(()) } else { Err(self.unusable(&format!("it is not {title}"))) }
    }

    fn unusable(&self, reason: &str) -> Error {
        Error::Unusable { driver: self.file.clone(), reason: reason.to_owned() }
    }

    fn set(&self, command: &mut Command) {
        command.envs(self.environment()).env_remove("UNITVEC_DEVICE");
    }

    /// The variables. Older loaders know the first name of the driver's file, newer ones the second as well.
    fn environment(&self) -> Vec<(&'static str, OsString)> {
        let Driver { folder, variable: (variable, value), .. } = &self.driver;
        let file = self.file.as_os_str();
        let mut variables = vec![
            ("VK_ICD_FILENAMES", file.to_owned()),
            ("VK_DRIVER_FILES", file.to_owned()),
            (*variable, value.into()),
        ];
        if folder.is_some() {
            variables.push(("LD_PRELOAD", self.file.with_file_name("shim.so").into()));
            // Mali's driver wants to be asked twice, and tells its statistics apart from Vulkan's.
            variables.push(("PAN_I_WANT_A_BROKEN_VULKAN_DRIVER", "1".into()));
            variables.push(("BIFROST_MESA_DEBUG", "shaderdb".into()));
        }
        variables
    }
}

/// This program.
fn here() -> Result<Command, Error> {
    Ok(Command::new(std::env::current_exe().map_err(Error::NotStarted)?))
}

/// The file of what a driver says in this process, where it is read.
pub struct Said(Option<Mutex<File>>);

impl Said {
    /// The file that the process which [started](StandIn::run) this one reads.
    ///
    /// # Errors
    /// The file cannot be opened.
    pub fn of_process() -> io::Result<Self> {
        Ok(Self(std::env::var_os(SAID).map(File::open).transpose()?.map(Mutex::new)))
    }

    /// Compiles, one at a time, and returns what the driver wrote meanwhile. A file that cannot be read has nothing.
    pub fn during<T>(&self, compile: impl FnOnce() -> T) -> (T, String) {
        let Some(file) = &self.0 else { return (compile(), String::new()) };
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = file.seek(SeekFrom::End(0));
        let compiled = compile();
        let mut said = String::new();
        let _ = file.read_to_string(&mut said);
        (compiled, said)
    }
}

/// The statistics of a stage in the lines of Mali's compiler, numbers and names, summed over the stage's parts, which have
/// these names. Those of its units are cycles, of so many instructions.
pub fn shader_db(said: &str, stages: &[&str]) -> Statistics {
    let mut statistics = Statistics::new();
    let parts = said.lines().filter_map(|line| line.strip_prefix("SHADER-DB: ")?.split_once(" shader: "));
    let own = parts.filter(|(part, _)| stages.iter().any(|stage| part.ends_with(stage)));
    for entry in own.flat_map(|(_, line)| line.split(", ")) {
        let Some((value, name)) = entry.split_once(' ') else { continue };
        let instructions = match name {
            "fma" | "cvt" => 64.0,
            "sfu" => 16.0,
            "arith" => 24.0,
            _ => 1.0,
        };
        let value = value.split(':').next().and_then(|value| value.parse::<f64>().ok());
        *statistics.entry(name.to_owned()).or_default() +=
            (value.unwrap_or(0.0) * instructions).round() as u64;
    }
    statistics
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

    /// Cycles of a unit become its instructions; of spills and fills the former are taken.
    #[test]
    fn lines_of_malis_compiler_are_read() {
        let said = "Unknown ioctl\nSHADER-DB: MESA_SHADER_COMPUTE shader: 207 inst, 40.000000 cycles, 0.687500 fma, 2.500000 sfu, 3:4 spills:fills\n";
        let found = shader_db(said, &["COMPUTE"]);
        let of = |name: &str| found.get(name).copied();
        assert_eq!(
            (of("inst"), of("fma"), of("sfu"), of("spills:fills")),
            (Some(207), Some(44), Some(40), Some(3))
        );
        assert!(shader_db(said, &["VERTEX"]).is_empty());
    }
}
