//! Each package as its users get it: built and tested from its `.crate`, outside the repository.

use crate::{cargo, run as run_command};
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// The published libraries for everybody, in the order of the dependencies.
const LIBRARIES: [&str; 5] =
    ["unitvec", "unitvec-languages", "unitvec-shaders", "unitvec-oracle", "unitvec-catalogue"];

/// The program, and before it the libraries that it consists of.
const PROGRAM: &str = "unitvec-files unitvec-vulkan unitvec-manifest unitvec-mesh unitvec-texture unitvec-run \
    unitvec-choose unitvec-lab unitvec-render unitvec-link unitvec-host";

/// All published packages.
pub fn names() -> impl Iterator<Item = &'static str> {
    LIBRARIES.into_iter().chain(PROGRAM.split(' '))
}

/// Packages, unpacks and tests all of them, in a temporary folder.
pub fn run() -> Result<(), String> {
    let folder = std::env::temp_dir().join(format!("unitvec-packages-{}", std::process::id()));
    let unpacked = Unpacked { folder };
    let outcome = unpacked.unpack().and_then(|()| unpacked.check());
    let removed = fs::remove_dir_all(&unpacked.folder).map_err(|error| error.to_string());
    outcome.and(removed)
}

struct Unpacked {
    folder: PathBuf,
}

impl Unpacked {
    fn unpack(&self) -> Result<(), String> {
        let target = self.folder.join("package");
        fs::create_dir_all(&target).map_err(|error| format!("{}: {error}", target.display()))?;
        let mut package = cargo(&["package", "--no-verify", "--allow-dirty"]);
        package.args(names().flat_map(|name| ["--package", name])).arg("--target-dir").arg(&target);
        run_command(&mut package)?;
        names().try_for_each(|name| {
            let file = target.join("package").join(format!("{}.crate", versioned(name)));
            run_command(Command::new("tar").arg("xzf").arg(file).arg("-C").arg(&self.folder))
        })
    }

    fn check(&self) -> Result<(), String> {
        for name in LIBRARIES {
            println!("xtask: {name}, its own tests");
            run_command(&mut self.cargo(name, "test"))?;
        }
        println!("xtask: unitvec with the newest dependencies");
        run_command(&mut self.cargo("unitvec", "update"))?;
        run_command(self.cargo("unitvec", "test").args(["--features", "rayon"]))?;
        println!("xtask: unitvec with the oldest dependencies");
        fs::remove_file(self.path("unitvec").join("Cargo.lock")).map_err(|error| error.to_string())?;
        // The option has been unstable for years, and the compiler is the same with and without the variable.
        let mut oldest = self.cargo("unitvec", "generate-lockfile");
        run_command(oldest.arg("-Zdirect-minimal-versions").env("RUSTC_BOOTSTRAP", "1"))?;
        run_command(self.cargo("unitvec", "test").args(["--features", "rayon"]))?;
        println!("xtask: unitvec without std");
        self.without_std()?;
        println!("xtask: the program, installed without a GLSL compiler");
        self.installed()?;
        // With the dependencies that were installed, the newest, whose builds these tests take over. The libraries' own tests would
        // build most packages again, with other features.
        println!("xtask: the program's own tests");
        run_command(&mut self.cargo("unitvec-host", "update"))?;
        run_command(self.cargo("unitvec-host", "test").arg("--release"))
    }

    /// Builds for a target without any std, with the compiler that `cargo xtask spirv` installs: it has core's sources.
    fn without_std(&self) -> Result<(), String> {
        let mut build = Command::new("cargo");
        build
            .args(["+nightly-2026-07-03", "build", "-Zbuild-std=core,compiler_builtins"])
            .args(["--no-default-features", "--features", "libm", "--target", "x86_64-unknown-none"])
            .arg("--target-dir")
            .arg(self.folder.join("target"))
            // Cargo sets these for what it runs, and rustup would take them for the choice of a compiler.
            .env_remove("RUSTUP_TOOLCHAIN")
            .env_remove("CARGO")
            .current_dir(self.path("unitvec"));
        run_command(&mut build)
            .map_err(|error| format!("{error}; `cargo xtask spirv` installs that compiler"))
    }

    /// Runs `cargo install` and its program: CPU and Rust's SPIR-V agree, and commands that need the GLSL say so.
    fn installed(&self) -> Result<(), String> {
        let root = self.folder.join("installed");
        let mut install = self.cargo("unitvec-host", "install");
        run_command(install.args(["--path", "."]).arg("--root").arg(&root))?;
        let program = root.join("bin/unitvec");
        run_command(Command::new(&program).args(["conform", "--device", "lavapipe", "--codec", "oct16"]))?;
        let encode = "encode --backend glsl --device lavapipe --codec oct16 /dev/null -";
        for line in [encode, "bench device --device lavapipe", "bench compiler --gpu rdna2"] {
            let output = Command::new(&program).args(line.split(' ')).output();
            let output = output.map_err(|error| error.to_string())?;
            let message = String::from_utf8_lossy(&output.stderr);
            let is_told = message.lines().count() == 1
                && message.contains("cargo install --path host/program --features glsl");
            if output.status.success() || !output.stdout.is_empty() || !is_told {
                let status = output.status;
                return Err(format!(
                    "without a GLSL compiler `{line}` ended with {status} and said: {message}"
                ));
            }
        }
        Ok(())
    }

    /// Cargo in a package. The other packages are patched in by path, since they are not published yet.
    fn cargo(&self, name: &str, command: &str) -> Command {
        let mut cargo = cargo(&[command]);
        cargo.current_dir(self.path(name)).env("CARGO_TARGET_DIR", self.folder.join("target"));
        for other in names().filter(|other| *other != name) {
            let patch = format!("patch.crates-io.{other}.path={:?}", self.path(other));
            cargo.args(["--config", &patch]);
        }
        // Some tests go through thousands of codes.
        cargo.args(["--config", "profile.dev.opt-level=1", "--config", "profile.dev.debug=false"]);
        cargo
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(versioned(name))
    }
}

/// A package's name with its version, which is that of all.
fn versioned(name: &str) -> String {
    format!("{name}-{}", env!("CARGO_PKG_VERSION"))
}
