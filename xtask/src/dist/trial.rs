//! The archives, unpacked and run where nothing is installed: their results are those of the program built for this machine.

use super::{GLIBC, Platform};
use crate::windows::Wine;
use crate::{at, cache, emptied, output, repository, run as run_command};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Commands that need no device. The last word of those that write is the file.
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

/// The command that needs a device, and there is none.
const OF_DEVICES: &str = "devices";

/// What each line printed, and each file.
type Results = BTreeMap<String, Vec<u8>>;

/// A folder, and the command that starts the program there.
struct Trial {
    folder: PathBuf,
    words: Vec<String>,
    wine: Option<Wine>,
}

/// Checks the sums, and runs each archive's program beside `native`.
pub fn run(platforms: &[Platform], archives: &Path, scratch: &Path, native: &Path) -> Result<(), String> {
    run_command(Command::new("sha256sum").args(["--check", "--quiet", "SHA256SUMS"]).current_dir(archives))?;
    let here = Trial {
        folder: emptied(scratch.join("here"))?,
        words: vec![native.display().to_string()],
        wine: None,
    };
    let expected = here.results()?;
    for platform in platforms {
        let (folder, archive) = (emptied(scratch.join(platform.name))?, archives.join(platform.archive()));
        let mut unpack = Command::new("python3");
        unpack.args(["-c", include_str!("../unpack.py")]).arg(&archive).arg("*");
        run_command(unpack.arg(&folder))?;
        let program = folder.join(platform.folder()).join(platform.program());
        let tried = Trial::of(platform, folder, &program).and_then(|trial| trial.compare(&expected));
        tried.map_err(|reason| format!("{}: {reason}", platform.name))?;
        let size = |file: &Path| fs::metadata(file).map_or(0.0, |of| of.len() as f64 / 1e6);
        let (packed, unpacked) = (size(&archive), size(&program));
        println!(
            "xtask: {}: {packed:.1} MB, the program {unpacked:.1} MB; {} commands give this machine's bytes",
            platform.name,
            LINES.len()
        );
    }
    Ok(())
}

impl Trial {
    /// An empty root for this machine's processor, an emulator for the other, or Wine.
    fn of(platform: &Platform, folder: PathBuf, program: &Path) -> Result<Self, String> {
        let path = program.display().to_string();
        let mut wine = None;
        let words = match platform.name {
            "linux-x86_64" => chroot(&folder, program)?,
            "linux-aarch64" => {
                ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu", &path].map(str::to_owned).to_vec()
            }
            _ => {
                wine = Some(Wine::new(cache("windows")?)?);
                // Wine has a loader of its own.
                ["env", "UNITVEC_VULKAN_LOADER=none.dll", "wine", &path].map(str::to_owned).to_vec()
            }
        };
        if platform.is_linux() {
            let versions = output(Command::new("readelf").args(["--wide", "--version-info"]).arg(program))?;
            match newest_glibc(&versions) {
                Some(newest) if newest <= GLIBC => {}
                other => return Err(format!("the program needs glibc {other:?}, not {GLIBC:?} at most")),
            }
        }
        Ok(Self { folder, words, wine })
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]).args(line.split(' ')).current_dir(&self.folder).stdin(Stdio::null());
        if let Some(wine) = &self.wine {
            wine.set(&mut command);
        }
        command
    }

    fn results(&self) -> Result<Results, String> {
        for mesh in ["bunny.obj", "torus.glb"] {
            let from = repository().join("host/mesh/data").join(mesh);
            fs::copy(&from, self.folder.join(mesh)).map_err(at(&from))?;
        }
        let mut results = Results::new();
        for line in LINES {
            let run = self.command(line).output().map_err(at(Path::new(&self.words[0])))?;
            if !run.status.success() {
                let said = String::from_utf8_lossy(&run.stderr);
                return Err(format!("`{line}` ended with {}: {}", run.status, said.trim()));
            }
            results.insert(line.to_owned(), run.stdout);
            if let Some(file) = written(line) {
                let path = self.folder.join(file);
                results.insert(file.to_owned(), fs::read(&path).map_err(at(&path))?);
            }
        }
        Ok(results)
    }

    /// Fails unless the results are the expected ones, and the command that needs a device says in one line what to install.
    fn compare(&self, expected: &Results) -> Result<(), String> {
        let results = self.results()?;
        let differ = results.iter().filter(|(name, bytes)| expected.get(*name) != Some(bytes));
        let differ: Vec<String> = differ.map(|(name, _)| format!("`{name}`")).collect();
        if !differ.is_empty() {
            return Err(format!("not this machine's bytes: {}", differ.join(", ")));
        }
        let run = self.command(OF_DEVICES).output().map_err(at(Path::new(&self.words[0])))?;
        let said = String::from_utf8_lossy(&run.stderr);
        if run.status.code() == Some(1) && said.lines().count() == 1 && said.contains("install") {
            return Ok(());
        }
        Err(format!("`{OF_DEVICES}` without a device ended with {} and said: {said}", run.status))
    }
}

/// The file that a line writes.
fn written(line: &str) -> Option<&str> {
    let writes = ["normals", "encode", "decode"].iter().any(|command| line.starts_with(command));
    line.rsplit(' ').next().filter(|_| writes)
}

/// The command that runs the program in a root that holds the C library and the unpacked archive, and nothing else.
fn chroot(root: &Path, program: &Path) -> Result<Vec<String>, String> {
    let libraries = output(Command::new("ldd").arg(program))?;
    for library in libraries.split_whitespace().filter(|word| word.starts_with('/')) {
        let copy = root.join(library.trim_start_matches('/'));
        let made = copy.parent().map_or(Ok(()), fs::create_dir_all);
        made.and_then(|()| fs::copy(library, &copy)).map_err(at(&copy))?;
    }
    // Anybody may in a namespace of users; where there are none, root may.
    let has_namespaces = output(Command::new("unshare").args(["--map-root-user", "true"])).is_ok();
    let prefix = if has_namespaces { "unshare --map-root-user chroot" } else { "chroot" };
    let inside = Path::new("/").join(program.strip_prefix(root).unwrap_or(program));
    let paths = [root, &inside].map(|path| path.display().to_string());
    Ok(prefix.split(' ').map(str::to_owned).chain(paths).collect())
}

/// The newest version of glibc that a program needs, by what readelf prints.
fn newest_glibc(printed: &str) -> Option<(u32, u32)> {
    let versions = printed.split_whitespace().filter_map(|word| word.strip_prefix("GLIBC_"));
    let numbers = versions.map(|version| version.split('.').filter_map(|number| number.parse().ok()));
    numbers.filter_map(|mut of| Some((of.next()?, of.next()?))).max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_version_counts() {
        let printed =
            "0x10:   Name: GLIBC_2.9  Flags: none\n 0x20: Name: GLIBC_2.17 GLIBC_2.3.4 GLIBC_PRIVATE";
        assert_eq!(newest_glibc(printed), Some((2, 17)));
        assert_eq!(newest_glibc("Name: GCC_3.0"), None);
    }
}
