//! Installs the missing packages for building and running.

use crate::output;
use std::fs;
use std::process::{Command, Stdio};
use std::thread::{self, JoinHandle};

/// Debian packages, each with its purpose.
type Packages = &'static [(&'static str, &'static str)];

/// The packages that the build links: small ones, so that compiling starts soon.
const TO_BUILD: Packages = &[
    ("g++", "linking shaderc; programs in C and C++ in tests"),
    ("libshaderc-dev", "compiling GLSL"),
    ("glslang-dev", "libraries that libshaderc-dev does not contain"),
    ("spirv-tools", "libraries that libshaderc-dev does not contain; spirv-val in tests"),
];

/// The packages for building shaderc, where the distribution has no `libshaderc-dev` and `glslang-dev`.
const TO_BUILD_FROM_SOURCE: [&str; 6] = ["g++", "spirv-tools", "cmake", "ninja-build", "python3", "git"];

/// The packages that the programs need once they are built: drivers and all their dependencies.
const TO_RUN: Packages = &[
    ("libvulkan1", "the Vulkan loader"),
    ("mesa-vulkan-drivers", "lavapipe, Vulkan on the CPU"),
    ("vulkan-validationlayers", "Vulkan validation in tests"),
    ("glslang-tools", "GLSL ES validation in tests"),
    ("cmake", "the CMake package of the C library in tests"),
    ("make", "building with CMake in tests"),
    ("libegl1", "OpenGL without a window in tests"),
    ("libgl1-mesa-dri", "llvmpipe, OpenGL on the CPU, in tests"),
    ("python3", "clients of the kernels and of OpenGL in tests"),
];

/// Packages that are being installed while cargo builds.
#[must_use]
pub struct Pending(Option<JoinHandle<Result<(), String>>>);

impl Pending {
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
    let needs = TO_BUILD.iter().chain(TO_RUN).map(|(name, purpose)| format!("{name} ({purpose})"));
    if !has_apt(&needs.collect::<Vec<_>>().join(", ")) {
        return Ok(Pending(None));
    }
    let (to_run, mut to_build) = (missing(names(TO_RUN)), missing(to_build()));
    if to_build.is_empty() && to_run.is_empty() {
        return Ok(Pending(None));
    }
    let prefix = privilege(&[&to_build[..], &to_run].concat())?;
    println!("xtask: apt-get update");
    apt_get(prefix, &["update", "-qq"])?;
    // apt-get may not have known any package before the update.
    if to_build.iter().any(|name| !is_available(name)) {
        to_build = missing(TO_BUILD_FROM_SOURCE.to_vec());
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
pub fn packages(names: &[&str]) -> Result<(), String> {
    if !has_apt(&names.join(", ")) {
        return Ok(());
    }
    let missing = missing(names.to_vec());
    if missing.is_empty() {
        return Ok(());
    }
    let prefix = privilege(&missing)?;
    println!("xtask: installing {}", missing.join(" "));
    apt_get(prefix, &["update", "-qq"])?;
    install(prefix, &missing)
}

/// True where there is apt-get; elsewhere it prints what is needed.
fn has_apt(needs: &str) -> bool {
    let has_apt = succeeds("apt-get", &["--version"]) && succeeds("dpkg-query", &["--version"]);
    if !has_apt {
        println!("xtask: no apt-get here; install the equivalents of these Debian packages: {needs}");
    }
    has_apt
}

fn names(packages: Packages) -> Vec<&'static str> {
    packages.iter().map(|(name, _)| *name).collect()
}

/// The build's packages: the tools for building shaderc where apt-get knows other packages but not its library.
fn to_build() -> Vec<&'static str> {
    let has_shaderc = TO_BUILD.iter().all(|(name, _)| is_installed(name) || is_available(name));
    if has_shaderc || !is_available("g++") { names(TO_BUILD) } else { TO_BUILD_FROM_SOURCE.to_vec() }
}

fn missing(mut packages: Vec<&str>) -> Vec<&str> {
    packages.retain(|name| !is_installed(name));
    packages
}

/// The prefix that runs a command as root: none, or `sudo -n`. If neither works, the command to type.
fn privilege(missing: &[&str]) -> Result<&'static [&'static str], String> {
    if is_root() {
        Ok(&[])
    } else if succeeds("sudo", &["-n", "true"]) {
        Ok(&["sudo", "-n"])
    } else {
        Err(format!(
            "these packages are missing; type this and run the command again:\n  \
             sudo apt-get update && sudo apt-get install -y --no-install-recommends {}",
            missing.join(" ")
        ))
    }
}

fn is_installed(package: &str) -> bool {
    let mut query = Command::new("dpkg-query");
    output(query.args(["--show", "--showformat=${db:Status-Status}", package]))
        .is_ok_and(|is| is == "installed")
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
    output(Command::new(program).args(arguments)).is_ok()
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
