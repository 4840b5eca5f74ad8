//! FXC, Microsoft's compiler of HLSL for Direct3D 11. A small Windows program, built here, calls it under Wine and runs its
//! modules by Wine's Direct3D, which takes them to OpenGL.

use crate::cases::COUNT;
use crate::job::Job;
use crate::tally::Tally;
use crate::{Result, told, tool, whole};
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use unitvec_run::shader::{Edition, Language};
use unitvec_vulkan::{GROUP, WORKGROUP};

const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/fxc/run.c");

/// The words before the version in the library.
const TITLE: &[u8] = b"Microsoft (R) HLSL Shader Compiler ";

/// D3DCOMPILE_OPTIMIZATION_LEVEL3, as release builds have it.
const OPTIMISED: u32 = 1 << 15;

/// Advice on the speed of best_fit.hlsl is no fault: a loop is unrolled, and an integer division is slow.
const HEAD: &str = "#pragma warning(disable : 3550 3556)\n";

/// Jobs for one process: their input is in memory twice.
const AT_ONCE: usize = 32;

/// The compiler and the program that calls it, with a screen, without which Wine has no OpenGL.
pub struct Fxc {
    library: PathBuf,
    folder: PathBuf,
    screen: Child,
    display: String,
}

impl Fxc {
    /// Builds the program in the folder, and starts the screen.
    pub fn new(library: &Path, folder: &Path) -> Result<Self> {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        // Wine's settings take no relative paths.
        let whole = |path: &Path| path.canonicalize().map_err(|error| format!("{}: {error}", path.display()));
        let (library, folder) = (whole(library)?, whole(folder)?);
        let mut compiler = Command::new("x86_64-w64-mingw32-gcc");
        compiler.args(["-O1", "-Wall", "-Wextra", "-Werror", "-o"]).arg(folder.join("run.exe"));
        tool::output(compiler.args([SOURCE, "-ld3d11"])).map_err(with_packages)?;
        let screen = Command::new("Xvfb")
            .args(["-displayfd", "1"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| with_packages(format!("Xvfb cannot be started: {error}")))?;
        let mut fxc = Self { library, folder, screen, display: String::new() };
        let mut number = String::new();
        if let Some(output) = fxc.screen.stdout.take() {
            BufReader::new(output).read_line(&mut number).map_err(told)?;
        }
        if number.trim().is_empty() {
            return Err("Xvfb does not start: type `Xvfb -displayfd 1` to see why".to_owned());
        }
        fxc.display = format!(":{}", number.trim());
        // Makes the prefix where there is none, which is not silent.
        let output = fxc.wine("wine").args(["wineboot", "--init"]).output();
        let output = output.map_err(|error| with_packages(format!("wine cannot be started: {error}")))?;
        let failed =
            || with_packages(format!("wineboot, which makes Wine's folder, ended with {}", output.status));
        output.status.success().then_some(fxc).ok_or_else(failed)
    }

    /// A program of Wine's.
    fn wine(&self, program: &str) -> Command {
        let mut wine = Command::new(program);
        wine.env("WINEPREFIX", self.folder.join("prefix")).env("WINEDEBUG", "-all");
        // No menus, and neither .NET nor a browser, which a new prefix would ask for.
        wine.env("WINEDLLOVERRIDES", "d3dcompiler_47=n;winemenubuilder.exe,mscoree,mshtml=");
        wine.env("DISPLAY", &self.display);
        wine
    }

    /// The compiler's name and version.
    pub fn name(&self) -> Result<String> {
        let library =
            fs::read(&self.library).map_err(|error| format!("{}: {error}", self.library.display()))?;
        Ok(format!("FXC {}", version(&library).ok_or("the library of FXC has no version")?))
    }

    /// The name of what runs its modules.
    pub fn driver(&self) -> Result<String> {
        let said = tool::output(self.wine("wine").arg("--version"))?;
        let version = said.split_whitespace().next().unwrap_or_default().trim_start_matches("wine-");
        Ok(format!("Wine {version} on llvmpipe"))
    }

    /// Compiles and runs. Warnings are errors.
    pub fn run(&self, jobs: &[Job<'_>], tally: &mut Tally) -> Result<()> {
        jobs.chunks(AT_ONCE).try_for_each(|jobs| self.run_some(jobs, tally))
    }

    fn run_some(&self, jobs: &[Job<'_>], tally: &mut Tally) -> Result<()> {
        let mut wine = self.wine("wine");
        wine.arg(self.folder.join("run.exe")).arg(windows(&self.library));
        wine.arg(windows(&whole::folder(Language::Hlsl, Edition::Plain)));
        wine.arg(COUNT.div_ceil(GROUP * WORKGROUP).to_string());
        tool::converse(&mut wine, jobs.iter().flat_map(request).collect(), |output| {
            let mut output = BufReader::new(output);
            for job in jobs {
                let (said, words) = reply(&mut output)
                    .map_err(|error| format!("{}: no answer from FXC: {error}", job.case.name()))?;
                tally.add(job.case, if said.is_empty() { Ok(words) } else { Err(said) })?;
            }
            Ok(())
        })
    }
}

impl Drop for Fxc {
    fn drop(&mut self) {
        // Wine's programs would complain of a lost screen. All of them may have ended by themselves.
        let _ = self.wine("wineserver").arg("--kill").output();
        let _ = self.screen.kill();
        let _ = self.screen.wait();
    }
}

/// An error, and the packages whose lack is its likely cause.
fn with_packages(error: String) -> String {
    format!("{error}; FXC needs the packages wine64, wine, xvfb and gcc-mingw-w64-x86-64")
}

/// A path for Windows: Wine's drive Z has all files.
fn windows(path: &Path) -> String {
    format!("Z:{}", path.display()).replace('/', "\\")
}

/// The version that a library of FXC says of itself.
fn version(library: &[u8]) -> Option<String> {
    let at = library.windows(TITLE.len()).position(|bytes| bytes == TITLE)? + TITLE.len();
    let version = library[at..].iter().take_while(|byte| byte.is_ascii_digit() || **byte == b'.');
    Some(version.map(|byte| char::from(*byte)).collect())
}

/// A kernel as the program reads it.
fn request(job: &Job<'_>) -> Vec<u8> {
    let (text, case) = (format!("{HEAD}{}", job.text), job.case);
    let [input, expected] = [&case.input[..], &case.expected].map(size_of_val::<[u32]>);
    let head = [text.len() as u32, input as u32, expected as u32, OPTIMISED];
    [bytemuck::cast_slice(&head), text.as_bytes(), bytemuck::cast_slice(&case.input)].concat()
}

/// The answer of the program: words in the compiler's language, and the kernel's output.
fn reply(answer: &mut impl Read) -> std::io::Result<(String, Vec<u32>)> {
    let mut sizes = [0u32; 2];
    answer.read_exact(bytemuck::cast_slice_mut(&mut sizes))?;
    let mut said = vec![0; sizes[0] as usize];
    answer.read_exact(&mut said)?;
    let mut words = vec![0u32; sizes[1] as usize / size_of::<u32>()];
    answer.read_exact(bytemuck::cast_slice_mut(&mut words))?;
    Ok((String::from_utf8_lossy(&said).into_owned(), words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_is_that_of_the_library() {
        let library = [b"\0...", TITLE, b"6.3.9600.16384\0more"].concat();
        assert_eq!(version(&library).as_deref(), Some("6.3.9600.16384"));
        assert_eq!(version(b"no compiler"), None);
    }

    #[test]
    fn replies_are_read_whole_or_not_at_all() {
        let bytes = [&[2u8, 0, 0, 0, 8, 0, 0, 0][..], b"hm", &[1, 0, 0, 0, 2, 0, 0, 0]].concat();
        assert_eq!(reply(&mut &bytes[..]).unwrap(), ("hm".to_owned(), vec![1, 2]));
        assert!(reply(&mut &bytes[..bytes.len() - 1]).is_err());
    }

    #[test]
    fn paths_are_those_of_wine() {
        assert_eq!(windows(Path::new("/a b/c.dll")), "Z:\\a b\\c.dll");
    }
}
