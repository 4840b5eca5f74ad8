//! The archives unpacked and run where nothing else is installed: their results are those of the program built for this machine.

use super::{AARCH64, GLIBC, Platform, X86_64};
use crate::{output, repository, run as run_command};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Commands that need no device. `wrote` names what they write.
const LINES: [&str; 12] = [
    "codecs",
    "normals bunny.obj normals.bin",
    "encode --codec oct24p bunny.obj codes.uvec",
    "encode --codec ico32 --raw normals.bin codes.ico32",
    "encode --codec frame64 torus.glb codes.frame64",
    "decode codes.uvec decoded.npy",
    "decode --codec frame64 codes.frame64 frames.bin",
    "error --codec oct24p --codec ico24 bunny.obj --json -",
    "accuracy --count 1000",
    "choose --max-error 0.05 --json -",
    "shader --language msl --codec oct24p",
    "link --stubs glsl",
];

/// The command that needs a device, which is nowhere here.
const WITHOUT_DEVICE: &str = "devices";

/// Takes all files out of an archive.
const UNPACK: &str = include_str!("../unpack.py");

/// Standard output of each line, and each written file.
type Results = BTreeMap<String, Vec<u8>>;

/// A program to run, in a folder of its own.
struct Trial {
    folder: PathBuf,
    /// The program, and what starts it.
    words: Vec<String>,
    variables: Vec<(&'static str, PathBuf)>,
}

/// Checks the sums, and runs each archive's program beside `native`.
pub fn run(platforms: &[Platform], archives: &Path, scratch: &Path, native: &Path) -> Result<(), String> {
    run_command(Command::new("sha256sum").args(["--check", "--quiet", "SHA256SUMS"]).current_dir(archives))?;
    let words = vec![native.display().to_string()];
    let expected = Trial { folder: emptied(scratch, "native")?, words, variables: Vec::new() }.results()?;
    for platform in platforms {
        let folder = emptied(scratch, platform.name)?;
        let archive = archives.join(platform.archive());
        run_command(Command::new("python3").args(["-c", UNPACK]).arg(&archive).arg("*").arg(&folder))?;
        let program = folder.join(platform.folder()).join(platform.program);
        let trial = Trial::of(platform, folder, &program)?;
        let outcome = trial.compare(&expected).and_then(|()| trial.refuses());
        outcome.map_err(|reason| format!("{}: {reason}", platform.name))?;
        let size = |file: &Path| fs::metadata(file).map_or(0.0, |of| of.len() as f64 / 1e6);
        let (packed, unpacked) = (size(&archive), size(&program));
        let ran = LINES.len();
        println!(
            "xtask: {}: {packed:.1} MB, the program {unpacked:.1} MB; {ran} commands give the same bytes",
            platform.name
        );
    }
    Ok(())
}

impl Trial {
    /// A trial where nothing is installed: in an empty root, in an emulator, or under Wine.
    fn of(platform: &Platform, folder: PathBuf, program: &Path) -> Result<Self, String> {
        if platform.is_linux() {
            let versions = output(Command::new("readelf").args(["--wide", "--version-info"]).arg(program))?;
            let newest =
                newest_glibc(&versions).ok_or("the program needs no glibc, and so cannot load Vulkan")?;
            if newest > GLIBC {
                return Err(format!(
                    "{} needs glibc {}.{}, not {}.{}",
                    platform.name, newest.0, newest.1, GLIBC.0, GLIBC.1
                ));
            }
        }
        let path = program.display().to_string();
        let (words, variables) = if platform.name == X86_64.name {
            let inside = Path::new("/").join(program.strip_prefix(&folder).unwrap_or(program));
            (chroot(&folder, program, &inside)?, Vec::new())
        } else if platform.name == AARCH64.name {
            (["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu", &path].map(str::to_owned).to_vec(), Vec::new())
        } else {
            let variables =
                vec![("WINEPREFIX", crate::wine::prefix()?), ("WINEDEBUG", PathBuf::from("-all"))];
            (["wine", &path].map(str::to_owned).to_vec(), variables)
        };
        Ok(Self { folder, words, variables })
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]).args(line.split(' ')).current_dir(&self.folder).stdin(Stdio::null());
        command.envs(self.variables.iter().map(|(name, value)| (name, value)));
        command
    }

    fn results(&self) -> Result<Results, String> {
        for mesh in ["bunny.obj", "torus.glb"] {
            let from = repository().join("host/mesh/data").join(mesh);
            fs::copy(&from, self.folder.join(mesh))
                .map_err(|error| format!("{}: {error}", from.display()))?;
        }
        let mut results = Results::new();
        for line in LINES {
            let run = self.command(line).output().map_err(|error| format!("{}: {error}", self.words[0]))?;
            if !run.status.success() {
                let said = String::from_utf8_lossy(&run.stderr).trim().to_owned();
                return Err(format!("`{line}` ended with {}: {said}", run.status));
            }
            results.insert(line.to_owned(), run.stdout);
            if let Some(file) = written(line) {
                let bytes = fs::read(self.folder.join(file)).map_err(|error| format!("`{line}`: {error}"))?;
                results.insert(file.to_owned(), bytes);
            }
        }
        Ok(results)
    }

    fn compare(&self, expected: &Results) -> Result<(), String> {
        let results = self.results()?;
        let other = results.iter().filter(|(name, bytes)| expected.get(*name) != Some(bytes));
        let other: Vec<String> = other.map(|(name, _)| format!("`{name}`")).collect();
        let text = other.join(", ");
        if other.is_empty() { Ok(()) } else { Err(format!("other bytes than on this machine: {text}")) }
    }

    /// Fails unless the command that needs a device says in one line what to install.
    fn refuses(&self) -> Result<(), String> {
        let run = self.command(WITHOUT_DEVICE).output().map_err(|error| error.to_string())?;
        let said = String::from_utf8_lossy(&run.stderr);
        let is_told = said.lines().count() == 1 && said.contains("install");
        if run.status.code() == Some(1) && is_told {
            return Ok(());
        }
        Err(format!("`{WITHOUT_DEVICE}` without a device ended with {} and said: {said}", run.status))
    }
}

/// The file that a line writes: its last word.
fn written(line: &str) -> Option<&str> {
    let writes = ["normals", "encode", "decode"].iter().any(|command| line.starts_with(command));
    line.rsplit(' ').next().filter(|_| writes)
}

/// The command that runs the program in a root that holds, beside its archive, the C library only.
fn chroot(root: &Path, program: &Path, inside: &Path) -> Result<Vec<String>, String> {
    let libraries = output(Command::new("ldd").arg(program))?;
    for library in libraries.split_whitespace().filter(|word| word.starts_with('/')) {
        let copy = root.join(library.trim_start_matches('/'));
        let copied = copy.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::copy(library, &copy));
        copied.map_err(|error| format!("{}: {error}", copy.display()))?;
    }
    // A user's own namespace lets anybody; where there is none, root may.
    let has_namespaces = output(Command::new("unshare").args(["--map-root-user", "true"])).is_ok();
    let prefix = if has_namespaces { &["unshare", "--map-root-user", "chroot"][..] } else { &["chroot"] };
    let paths = [root, inside].map(|path| path.display().to_string());
    Ok(prefix.iter().map(|word| (*word).to_owned()).chain(paths).collect())
}

/// The newest version of glibc that a program needs, by what readelf prints.
fn newest_glibc(printed: &str) -> Option<(u32, u32)> {
    let versions = printed.split_whitespace().filter_map(|word| word.strip_prefix("GLIBC_"));
    let parsed = versions.filter_map(|version| {
        let mut numbers = version.split('.').map(str::parse);
        Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
    });
    parsed.max()
}

fn emptied(scratch: &Path, name: &str) -> Result<PathBuf, String> {
    let folder = scratch.join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_version_counts() {
        let printed = "  0x0010:   Name: GLIBC_2.9  Flags: none\n  0x0020:   Name: GLIBC_2.17  Flags: none\n GLIBC_2.3.4 GLIBC_PRIVATE";
        assert_eq!(newest_glibc(printed), Some((2, 17)));
        assert_eq!(newest_glibc("Name: GCC_3.0"), None);
    }

    #[test]
    fn written_files_are_compared() {
        let files: Vec<_> = LINES.iter().filter_map(|line| written(line)).collect();
        assert_eq!(
            files,
            ["normals.bin", "codes.uvec", "codes.ico32", "codes.frame64", "decoded.npy", "frames.bin"]
        );
    }
}
