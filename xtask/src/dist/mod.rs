//! Archives of the program for people without Rust: built, packed with the licences of all that is in them, and tried where
//! nothing else is installed.

mod licences;
mod trial;

use crate::windows::GCC;
use crate::{at, cache, cargo, emptied, output, program, repository, run as run_command, setup, target};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The oldest C library that the programs for Linux run with. Rust's own library needs it too.
const GLIBC: (u32, u32) = (2, 17);

/// Debian's packages that build, pack and try the programs.
const PACKAGES: &str =
    "python3-pip ca-certificates binutils gcc-mingw-w64-x86-64 wine wine64 qemu-user libc6-arm64-cross";

/// zig links for old C libraries, and cargo-zigbuild has cargo call it. pip refuses files of other hashes.
const ZIG: &str = include_str!("zig.txt");

/// A system that the program is built for.
struct Platform {
    name: &'static str,
    target: &'static str,
}

const PLATFORMS: [Platform; 3] = [
    Platform { name: "linux-x86_64", target: "x86_64-unknown-linux-gnu" },
    Platform { name: "linux-aarch64", target: "aarch64-unknown-linux-gnu" },
    Platform { name: "windows-x86_64", target: "x86_64-pc-windows-gnu" },
];

/// `cargo xtask dist [NAME...]`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let chosen = chosen(arguments)?;
    setup::packages(&PACKAGES.split(' ').collect::<Vec<_>>())?;
    let (zig, native) = (zig()?, program()?);
    // No archive of another run is taken for one of this.
    let (folder, scratch) = (emptied(target()?.join("dist"))?, cache("dist-scratch")?);
    for platform in &chosen {
        let program = platform.build(&zig)?;
        platform.pack(&program, &zig, &scratch, &folder)?;
    }
    let archives = chosen.iter().map(Platform::archive);
    let sums = output(Command::new("sha256sum").args(archives).current_dir(&folder))?;
    fs::write(folder.join("SHA256SUMS"), sums).map_err(at(&folder))?;
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

/// The folder of zig and cargo-zigbuild, fetched where they are missing.
fn zig() -> Result<PathBuf, String> {
    let (folder, list) = (cache("zig")?, repository().join("xtask/src/dist/zig.txt"));
    // A fetch that was interrupted leaves no such file.
    let fetched = folder.join("fetched.txt");
    if fs::read_to_string(&fetched).is_ok_and(|text| text == ZIG) {
        return Ok(folder);
    }
    println!("xtask: fetching zig and cargo-zigbuild, 100 MB");
    let mut pip = Command::new("python3");
    pip.args(["-m", "pip", "install", "--quiet", "--upgrade", "--no-deps", "--only-binary=:all:"]);
    pip.env("PIP_ROOT_USER_ACTION", "ignore");
    run_command(pip.args(["--require-hashes", "--requirement"]).arg(&list).arg("--target").arg(&folder))?;
    fs::copy(&list, &fetched).map_err(at(&fetched))?;
    Ok(folder)
}

impl Platform {
    fn is_linux(&self) -> bool {
        self.name.starts_with("linux")
    }

    fn program(&self) -> &'static str {
        if self.is_linux() { "unitvec" } else { "unitvec.exe" }
    }

    /// The name of the archive's only folder.
    fn folder(&self) -> String {
        format!("unitvec-{VERSION}-{}", self.name)
    }

    fn archive(&self) -> String {
        format!("{}.{}", self.folder(), if self.is_linux() { "tar.gz" } else { "zip" })
    }

    /// Builds the program as it is released, without a compiler of GLSL, which would need C++.
    fn build(&self, zig: &Path) -> Result<PathBuf, String> {
        println!("xtask: building for {}, which takes minutes", self.name);
        output(Command::new("rustup").args(["target", "add", self.target]))?;
        let mut build = if self.is_linux() {
            let mut build = Command::new(zig.join("bin/cargo-zigbuild"));
            build.arg("zigbuild").current_dir(repository());
            build.arg(format!("--target={}.{}.{}", self.target, GLIBC.0, GLIBC.1));
            build
        } else {
            cargo(&["build", "--target", self.target])
        };
        build.args(["--release", "--locked", "--package=unitvec-host", "--bin=unitvec"]);
        build.arg("--target-dir").arg(target()?).env("CARGO_ZIGBUILD_ZIG_PATH", zig.join("ziglang/zig"));
        build.env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", GCC);
        // The date of linking is no part of the program, nor are the names of this machine's folders.
        build.env("SOURCE_DATE_EPOCH", "315532800");
        let folders = [(repository(), "/unitvec"), (cargo_home()?, "/cargo")];
        let folders = folders.map(|(from, to)| format!("--remap-path-prefix={}={to}", from.display()));
        build
            .env("CARGO_ENCODED_RUSTFLAGS", folders.join("\x1f"))
            .env("CARGO_PROFILE_RELEASE_STRIP", "symbols");
        run_command(&mut build)?;
        Ok(target()?.join(self.target).join("release").join(self.program()))
    }

    /// Packs the program with its README and licences.
    fn pack(&self, program: &Path, zig: &Path, scratch: &Path, to: &Path) -> Result<(), String> {
        let folder = emptied(scratch.join(self.folder()))?;
        let own = ["LICENSE-MIT", "LICENSE-APACHE"].map(|name| (repository().join(name), name));
        let others = [(program.to_owned(), self.program()), (licences::of_rust()?, "LICENSES-RUST.html")];
        for (from, name) in own.into_iter().chain(others) {
            fs::copy(&from, folder.join(name)).map_err(at(&from))?;
        }
        let readme = include_str!("readme.md").replace("VERSION", VERSION).replace("PLATFORM", self.name);
        for (name, text) in [("README.md", readme), ("LICENSES-LIBRARIES.txt", licences::of(self, zig)?)] {
            fs::write(folder.join(name), text).map_err(at(&folder))?;
        }
        let mut pack = Command::new("python3");
        pack.args(["-c", include_str!("pack.py")]).arg(&folder).arg(to.join(self.archive()));
        run_command(pack.arg(self.program()))
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
            chosen(&strings(&["windows-x86_64"])).unwrap()[0].archive().split_once("-win").unwrap().1,
            "dows-x86_64.zip"
        );
        assert_eq!(chosen(&[]).map(|found| found.len()), Ok(PLATFORMS.len()));
    }
}
