//! Archives of the program for people without Rust: built, packed with the licences of all that is in them, and tried where
//! nothing else is installed.

mod licences;
mod trial;

use crate::{cache, cargo, output, program, repository, run as run_command, setup, target};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The oldest C library that the programs for Linux run with: Rust's own library needs it too.
const GLIBC: (u32, u32) = (2, 17);

/// The packages that build, pack and try the programs.
const PACKAGES: [&str; 9] = [
    "python3-venv",
    "ca-certificates",
    "binutils",
    "g++",
    "gcc-mingw-w64-x86-64",
    "wine",
    "wine64",
    "qemu-user",
    "libc6-arm64-cross",
];

/// zig links for old C libraries, and cargo-zigbuild has cargo call it. pip refuses files of other hashes.
const ZIG: &str = include_str!("zig.txt");

/// Packs a folder.
const PACK: &str = include_str!("pack.py");

const README: &str = include_str!("readme.md");

/// A system that the program is built for.
struct Platform {
    name: &'static str,
    target: &'static str,
    /// The program's file.
    program: &'static str,
    /// How it is called in its folder.
    called: &'static str,
    /// The kind of archive, by its ending.
    ending: &'static str,
    needs: &'static str,
}

const X86_64: Platform = Platform {
    name: "linux-x86_64",
    target: "x86_64-unknown-linux-gnu",
    program: "unitvec",
    called: "./unitvec",
    ending: "tar.gz",
    needs: "Linux with glibc 2.17 (2012) or newer",
};
const AARCH64: Platform = Platform { name: "linux-aarch64", target: "aarch64-unknown-linux-gnu", ..X86_64 };
const WINDOWS: Platform = Platform {
    name: "windows-x86_64",
    target: "x86_64-pc-windows-gnu",
    program: "unitvec.exe",
    called: r".\unitvec",
    ending: "zip",
    needs: "Windows 10 or newer",
};
const PLATFORMS: [Platform; 3] = [X86_64, AARCH64, WINDOWS];

/// `cargo xtask dist [NAME...]`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let chosen = chosen(arguments)?;
    setup::packages(&PACKAGES)?;
    let (zig, native) = (zig()?, program()?);
    // Nothing of another run is taken for one of this.
    let _ = fs::remove_dir_all(target()?.join("dist"));
    let (folder, scratch) = (cache("dist")?, cache("dist-scratch")?);
    for platform in &chosen {
        platform.pack(&platform.build(&zig)?, &zig, &scratch, &folder)?;
    }
    let archives: Vec<String> = chosen.iter().map(Platform::archive).collect();
    let sums = output(Command::new("sha256sum").args(&archives).current_dir(&folder))?;
    fs::write(folder.join("SHA256SUMS"), sums).map_err(|error| format!("SHA256SUMS: {error}"))?;
    trial::run(&chosen, &folder, &scratch, &native)?;
    println!("xtask: the archives and SHA256SUMS are in {}", folder.display());
    Ok(())
}

/// The platforms of these names, or all.
fn chosen(names: &[String]) -> Result<Vec<Platform>, String> {
    if let Some(unknown) = names.iter().find(|name| !PLATFORMS.iter().any(|known| known.name == *name)) {
        let known = PLATFORMS.map(|known| known.name).join(", ");
        return Err(format!("no platform `{unknown}`; there are {known}"));
    }
    let is_chosen = |known: &Platform| names.is_empty() || names.iter().any(|name| name == known.name);
    Ok(PLATFORMS.into_iter().filter(is_chosen).collect())
}

/// The environment of zig, with its programs in `bin`; fetched where it is missing.
fn zig() -> Result<PathBuf, String> {
    let folder = cache("zig")?;
    let (fetched, wanted) = (folder.join("fetched.txt"), folder.join("wanted.txt"));
    if fs::read_to_string(&fetched).is_ok_and(|text| text == ZIG) {
        return Ok(folder);
    }
    println!("xtask: fetching zig and cargo-zigbuild, 100 MB");
    run_command(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&folder))?;
    fs::write(&wanted, ZIG).map_err(|error| format!("{}: {error}", wanted.display()))?;
    let mut pip = Command::new(folder.join("bin/pip"));
    pip.args(["install", "--quiet", "--no-deps", "--require-hashes", "--only-binary=:all:", "--requirement"]);
    run_command(pip.arg(&wanted))?;
    // A fetch that was interrupted leaves no file of this name.
    fs::rename(&wanted, &fetched).map_err(|error| format!("{}: {error}", fetched.display()))?;
    Ok(folder)
}

impl Platform {
    fn is_linux(&self) -> bool {
        self.ending == "tar.gz"
    }

    /// The name of the archive's only folder.
    fn folder(&self) -> String {
        format!("unitvec-{VERSION}-{}", self.name)
    }

    fn archive(&self) -> String {
        format!("{}.{}", self.folder(), self.ending)
    }

    /// Builds the program as it is released, without a compiler of GLSL, which would need C++.
    fn build(&self, zig: &Path) -> Result<PathBuf, String> {
        println!("xtask: building for {}, which takes minutes", self.name);
        output(Command::new("rustup").args(["target", "add", self.target]))?;
        let (build, glibc) = if self.is_linux() {
            ("zigbuild", format!(".{}.{}", GLIBC.0, GLIBC.1))
        } else {
            ("build", String::new())
        };
        let mut cargo = cargo(&[build, "--release", "--locked", "--package=unitvec-host", "--bin=unitvec"]);
        cargo.arg(format!("--target={}{glibc}", self.target));
        // Names of this machine's folders are no part of the program.
        let folders = [(repository(), "/unitvec"), (cargo_home()?, "/cargo")];
        let folders = folders.map(|(from, to)| format!("--remap-path-prefix={}={to}", from.display()));
        cargo.env("CARGO_ENCODED_RUSTFLAGS", folders.join("\x1f"));
        cargo.env("CARGO_PROFILE_RELEASE_STRIP", "symbols");
        cargo.env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", "x86_64-w64-mingw32-gcc");
        let path = env::var_os("PATH").unwrap_or_default();
        let path = env::join_paths([zig.join("bin")].into_iter().chain(env::split_paths(&path)));
        run_command(cargo.env("PATH", path.map_err(|error| error.to_string())?))?;
        Ok(target()?.join(self.target).join("release").join(self.program))
    }

    /// Packs the program with its README and licences.
    fn pack(&self, program: &Path, zig: &Path, scratch: &Path, to: &Path) -> Result<(), String> {
        let folder = scratch.join(self.folder());
        let _ = fs::remove_dir_all(&folder);
        let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
        fs::create_dir_all(&folder).map_err(failed)?;
        let own = ["LICENSE-MIT", "LICENSE-APACHE"].map(|name| (repository().join(name), name));
        let rust = (licences::of_rust()?, "LICENSES-RUST.html");
        for (from, name) in [(program.to_owned(), self.program), rust].into_iter().chain(own) {
            fs::copy(&from, folder.join(name)).map_err(|error| format!("{}: {error}", from.display()))?;
        }
        fs::write(folder.join("LICENSES-LIBRARIES.txt"), licences::of(self, zig)?).map_err(failed)?;
        fs::write(folder.join("README.md"), self.readme()).map_err(failed)?;
        let archive = to.join(self.archive());
        run_command(Command::new("python3").args(["-c", PACK]).args([&folder, &archive]).arg(self.program))
    }

    fn readme(&self) -> String {
        let named =
            [("VERSION", VERSION), ("PLATFORM", self.name), ("PROGRAM", self.called), ("NEEDS", self.needs)];
        named.into_iter().fold(README.to_owned(), |text, (name, value)| text.replace(name, value))
    }
}

/// The folder in which cargo keeps the sources of dependencies.
fn cargo_home() -> Result<PathBuf, String> {
    let home = || env::var_os("HOME").map(|home| Path::new(&home).join(".cargo"));
    let found = env::var_os("CARGO_HOME").map(PathBuf::from).or_else(home);
    found.ok_or_else(|| "neither CARGO_HOME nor HOME says where cargo keeps sources".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::strings;

    #[test]
    fn unknown_platforms_are_refused() {
        assert!(chosen(&strings(&["plan9"])).err().unwrap().contains("linux-aarch64"));
        assert_eq!(
            chosen(&strings(&["linux-aarch64"])).unwrap()[0].archive().split('-').next_back(),
            Some("aarch64.tar.gz")
        );
        assert_eq!(chosen(&[]).map(|found| found.len()), Ok(PLATFORMS.len()));
    }

    #[test]
    fn fetched_programs_are_pinned() {
        for line in ZIG.lines() {
            let (_, sum) =
                line.split_once("==").and_then(|(_, of)| of.split_once(" --hash=sha256:")).unwrap();
            assert!(sum.len() == 64 && sum.chars().all(|c| c.is_ascii_hexdigit()), "{line}");
        }
    }

    #[test]
    fn a_readme_has_no_placeholders() {
        for platform in PLATFORMS {
            let text = platform.readme();
            let left =
                ["VERSION", "PLATFORM", "PROGRAM", "NEEDS"].into_iter().find(|name| text.contains(name));
            assert_eq!(left, None);
            assert!(text.contains(&format!("glibc {}.{} ", GLIBC.0, GLIBC.1)) == platform.is_linux());
        }
    }
}
