//! Installs the missing packages for building and running.

use std::fs;
use std::process::{Command, Stdio};
use std::thread::{self, JoinHandle};

/// A Debian package and its purpose.
#[derive(Clone, Copy)]
struct Package {
    name: &'static str,
    purpose: &'static str,
}

/// The packages that the build links: small ones, so that compiling starts soon.
const TO_BUILD: [Package; 4] = [
    Package { name: "g++", purpose: "linking shaderc; programs in C and C++ in tests" },
    Package { name: "libshaderc-dev", purpose: "compiling GLSL" },
    Package { name: "glslang-dev", purpose: "libraries that libshaderc-dev does not contain" },
    Package {
        name: "spirv-tools",
        purpose: "libraries that libshaderc-dev does not contain; spirv-val in tests",
    },
];

/// The packages in place of `libshaderc-dev` and `glslang-dev` where the distribution has no such packages.
const TO_BUILD_FROM_SOURCE: [Package; 6] = [
    TO_BUILD[0],
    TO_BUILD[3],
    Package { name: "cmake", purpose: "building shaderc" },
    Package { name: "ninja-build", purpose: "building shaderc" },
    Package { name: "python3", purpose: "building shaderc" },
    Package { name: "git", purpose: "building shaderc" },
];

/// The packages that the programs need once they are built: drivers and all their dependencies.
const TO_RUN: [Package; 5] = [
    Package { name: "libvulkan1", purpose: "the Vulkan loader" },
    Package { name: "mesa-vulkan-drivers", purpose: "lavapipe, Vulkan on the CPU" },
    Package { name: "vulkan-validationlayers", purpose: "Vulkan validation in tests" },
    Package { name: "glslang-tools", purpose: "GLSL ES validation in tests" },
    Package { name: "python3", purpose: "a client of the kernels in tests" },
];

/// Packages that are being installed while cargo builds.
#[must_use]
pub struct Pending(Option<JoinHandle<Result<(), String>>>);

impl Pending {
    /// Waits for the installation.
    pub fn finish(self) -> Result<(), String> {
        let Some(thread) = self.0 else { return Ok(()) };
        if !thread.is_finished() {
            println!("xtask: waiting for apt-get");
        }
        thread.join().unwrap_or_else(|_| Err("the thread that ran apt-get panicked".to_owned()))
    }
}

/// Installs all that is missing.
pub fn run() -> Result<(), String> {
    begin()?.finish()
}

/// Installs the build's packages, as root or through sudo without a password, or prints the command to type; then
/// begins to install those for running.
pub fn begin() -> Result<Pending, String> {
    if !has_apt() {
        let needs =
            TO_BUILD.iter().chain(&TO_RUN).map(|package| format!("{} ({})", package.name, package.purpose));
        println!(
            "xtask: no apt-get here; install the equivalents of these Debian packages: {}",
            needs.collect::<Vec<_>>().join(", ")
        );
        return Ok(Pending(None));
    }
    let to_run = missing(&TO_RUN);
    let mut to_build = missing(to_build());
    if to_build.is_empty() && to_run.is_empty() {
        return Ok(Pending(None));
    }
    let Some(prefix) = privilege() else { return Err(to_type(&[to_build, to_run].concat())) };
    println!("xtask: apt-get update");
    apt_get(prefix, &["update", "-qq"])?;
    // apt-get may not have known any package before the update.
    if to_build.iter().any(|name| !is_available(name)) {
        to_build = missing(&TO_BUILD_FROM_SOURCE);
        println!(
            "xtask: this distribution has no shaderc to link: it is built from source, which takes minutes"
        );
    }
    if !to_build.is_empty() {
        println!("xtask: installing {}", to_build.join(" "));
        install(prefix, &to_build)?;
    }
    if to_run.is_empty() {
        return Ok(Pending(None));
    }
    println!("xtask: installing {} in the background", to_run.join(" "));
    Ok(Pending(Some(thread::spawn(move || install(prefix, &to_run)))))
}

/// Installs missing packages, as root or through sudo without a password, or prints the command to type.
pub fn packages(names: &[&'static str]) -> Result<(), String> {
    if !has_apt() {
        println!(
            "xtask: no apt-get here; install the equivalents of these Debian packages: {}",
            names.join(", ")
        );
        return Ok(());
    }
    let missing: Vec<&str> = names.iter().copied().filter(|name| !is_installed(name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let Some(prefix) = privilege() else { return Err(to_type(&missing)) };
    println!("xtask: installing {}", missing.join(" "));
    apt_get(prefix, &["update", "-qq"])?;
    install(prefix, &missing)
}

/// The command that installs the missing packages.
fn to_type(missing: &[&str]) -> String {
    format!(
        "these packages are missing; type this and run the command again:\n  \
         sudo apt-get update && sudo apt-get install -y --no-install-recommends {}",
        missing.join(" ")
    )
}

/// The build's packages: the tools for building shaderc where apt-get knows other packages but not its library.
fn to_build() -> &'static [Package] {
    let has_shaderc = TO_BUILD.iter().all(|package| is_installed(package.name) || is_available(package.name));
    if has_shaderc || !is_available("g++") { &TO_BUILD } else { &TO_BUILD_FROM_SOURCE }
}

fn missing(packages: &[Package]) -> Vec<&'static str> {
    packages.iter().map(|package| package.name).filter(|name| !is_installed(name)).collect()
}

/// The prefix that runs a command as root: none, or `sudo -n`. `None` if neither works.
fn privilege() -> Option<&'static [&'static str]> {
    if is_root() {
        Some(&[])
    } else if succeeds("sudo", &["-n", "true"]) {
        Some(&["sudo", "-n"])
    } else {
        None
    }
}

fn has_apt() -> bool {
    succeeds("apt-get", &["--version"]) && succeeds("dpkg-query", &["--version"])
}

fn is_installed(package: &str) -> bool {
    Command::new("dpkg-query")
        .args(["--show", "--showformat=${db:Status-Status}", package])
        .output()
        .is_ok_and(|output| output.stdout == b"installed")
}

fn is_available(package: &str) -> bool {
    succeeds("apt-cache", &["show", package])
}

/// True where this process's effective user is root, by the kernel's own account.
fn is_root() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let uids = status.lines().find_map(|line| line.strip_prefix("Uid:"));
    uids.and_then(|uids| uids.split_whitespace().nth(1)) == Some("0")
}

fn succeeds(program: &str, arguments: &[&str]) -> bool {
    Command::new(program)
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

fn install(prefix: &[&str], packages: &[&str]) -> Result<(), String> {
    let mut arguments = vec!["install", "-y", "-qq", "--no-install-recommends"];
    arguments.extend(packages);
    apt_get(prefix, &arguments)
}

/// Runs apt-get; its output is shown where it fails.
fn apt_get(prefix: &[&str], arguments: &[&str]) -> Result<(), String> {
    let words: Vec<&str> =
        prefix.iter().copied().chain(["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]).collect();
    let command = format!("apt-get {}", arguments.join(" "));
    let output = Command::new(words[0])
        .args(&words[1..])
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("`{command}` cannot be started: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Err(format!("`{command}` failed:\n{}{}", text(&output.stdout), text(&output.stderr)))
}
