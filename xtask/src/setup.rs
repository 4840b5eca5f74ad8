//! Installs the missing packages for building and running.

use crate::output;
use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// The Debian packages that the build links, with C++ for tests: small ones, so that compiling starts soon. `libshaderc-dev` lacks
/// libraries that the last two have.
const TO_BUILD: [&str; 4] = ["g++", "libshaderc-dev", "glslang-dev", "spirv-tools"];

/// The packages for building shaderc, where the distribution has no `libshaderc-dev` and `glslang-dev`.
const TO_BUILD_FROM_SOURCE: [&str; 6] = ["g++", "spirv-tools", "cmake", "ninja-build", "python3", "git"];

/// The packages that the programs need once they are built: drivers and all their dependencies, and tools of tests.
const TO_RUN: [&str; 9] = [
    "libvulkan1",
    "mesa-vulkan-drivers",
    "vulkan-validationlayers",
    "glslang-tools",
    "cmake",
    "make",
    "libegl1",
    "libgl1-mesa-dri",
    "python3",
];

/// Package managers of other systems, Fedora, Arch, macOS and Windows, and their commands.
const MANAGERS: [(&str, &str); 4] = [
    ("dnf", "sudo dnf install"),
    ("pacman", "sudo pacman -S --needed"),
    ("brew", "brew install"),
    ("winget", "winget install"),
];

/// The names of Debian's packages for each of these managers; empty where the system has the same without it, or cannot.
const NAMES: &[(&str, [&str; 4])] = &[
    ("g++", ["gcc-c++", "gcc", "", ""]),
    ("spirv-tools", ["spirv-tools", "spirv-tools", "spirv-tools", "KhronosGroup.VulkanSDK"]),
    ("cmake", ["cmake", "cmake", "cmake", "Kitware.CMake"]),
    ("ninja-build", ["ninja-build", "ninja", "ninja", "Ninja-build.Ninja"]),
    ("python3", ["python3", "python", "python", "Python.Python.3.13"]),
    ("git", ["git", "git", "git", "Git.Git"]),
    ("libvulkan1", ["vulkan-loader", "vulkan-icd-loader", "vulkan-loader", ""]),
    ("mesa-vulkan-drivers", ["mesa-vulkan-drivers", "vulkan-swrast", "molten-vk", ""]),
    (
        "vulkan-validationlayers",
        ["vulkan-validation-layers", "vulkan-validation-layers", "vulkan-validationlayers", ""],
    ),
    ("glslang-tools", ["glslang", "glslang", "glslang", ""]),
    ("make", ["make", "make", "", ""]),
    ("libegl1", ["mesa-libEGL", "libglvnd", "", ""]),
    ("libgl1-mesa-dri", ["mesa-dri-drivers", "mesa", "", ""]),
];

/// Programs that build shaderc where there is no library to link; one of each set.
const BUILDS_SHADERC: [&[&str]; 4] = [&["c++"], &["cmake"], &["git"], &["python3", "python"]];

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
    if !has_apt() {
        tell(&[&TO_BUILD_FROM_SOURCE[..], &TO_RUN].concat());
        return Ok(Pending(None));
    }
    let (to_run, mut to_build) = (missing(TO_RUN.to_vec()), missing(to_build()));
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
    if !has_apt() {
        tell(names);
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

/// True where there is apt-get, and so all that it installs.
pub fn has_apt() -> bool {
    is_there("apt-get") && is_there("dpkg-query")
}

/// Prints, once, how these Debian packages are installed here.
fn tell(packages: &[&str]) {
    static TOLD: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let text = elsewhere(is_there, packages);
    let mut told = TOLD.lock().unwrap_or_else(PoisonError::into_inner);
    if !told.contains(&text) {
        println!("xtask: no apt-get here, and nothing is installed. {text}");
        told.push(text);
    }
}

/// The command that installs these Debian packages on a system without apt-get, that has these programs.
fn elsewhere(has: impl Fn(&str) -> bool, packages: &[&str]) -> String {
    let manager = MANAGERS.iter().position(|(program, _)| has(program));
    let name = |package: &&str| {
        let names = NAMES.iter().find(|(debian, _)| debian == package).map(|(_, names)| names);
        names.zip(manager).map(|(names, manager)| names[manager])
    };
    let (known, unknown): (Vec<&str>, Vec<&str>) = packages.iter().partition(|it| name(it).is_some());
    let named: BTreeSet<&str> = known.iter().filter_map(name).filter(|name| !name.is_empty()).collect();
    let mut text = match manager {
        Some(manager) if !named.is_empty() => {
            format!("What is needed comes by: {} {}. ", MANAGERS[manager].1, Vec::from_iter(named).join(" "))
        }
        _ => String::new(),
    };
    if !unknown.is_empty() {
        text += &format!("It needs the equivalents of these Debian packages: {}", unknown.join(", "));
    }
    text.trim_end().to_owned()
}

/// The programs that are missing to build with the feature `glsl`; none where apt-get brings its libraries, or these variables
/// of shaderc's build name them.
pub fn missing_for_glsl() -> Vec<&'static str> {
    let names_library = |name| std::env::var_os(name).is_some();
    if has_apt() || names_library("SHADERC_LIB_DIR") || names_library("VULKAN_SDK") {
        return Vec::new();
    }
    // Visual C++ is on no path: cargo finds it as Rust's linker.
    missing_of(|program| is_there(program) || cfg!(windows) && program == "c++")
}

fn missing_of(has: impl Fn(&str) -> bool) -> Vec<&'static str> {
    BUILDS_SHADERC.iter().filter(|names| !names.iter().any(|name| has(name))).map(|names| names[0]).collect()
}

pub fn is_there(program: &str) -> bool {
    succeeds(program, &["--version"])
}

/// The build's packages: the tools for building shaderc where apt-get knows other packages but not its library.
fn to_build() -> Vec<&'static str> {
    let has_shaderc = TO_BUILD.iter().all(|name| is_installed(name) || is_available(name));
    if has_shaderc || !is_available("g++") { TO_BUILD.to_vec() } else { TO_BUILD_FROM_SOURCE.to_vec() }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(manager: &str) -> String {
        elsewhere(|program| program == manager, &[&TO_BUILD_FROM_SOURCE[..], &TO_RUN].concat())
    }

    #[test]
    fn each_system_is_told_its_command() {
        assert_eq!(
            of("dnf"),
            "What is needed comes by: sudo dnf install cmake gcc-c++ git glslang make mesa-dri-drivers mesa-libEGL \
             mesa-vulkan-drivers ninja-build python3 spirv-tools vulkan-loader vulkan-validation-layers."
        );
        assert_eq!(
            of("pacman"),
            "What is needed comes by: sudo pacman -S --needed cmake gcc git glslang libglvnd make mesa ninja python \
             spirv-tools vulkan-icd-loader vulkan-swrast vulkan-validation-layers."
        );
        assert_eq!(
            of("brew"),
            "What is needed comes by: brew install cmake git glslang molten-vk ninja python spirv-tools \
             vulkan-loader vulkan-validationlayers."
        );
        assert_eq!(
            of("winget"),
            "What is needed comes by: winget install Git.Git KhronosGroup.VulkanSDK Kitware.CMake \
             Ninja-build.Ninja Python.Python.3.13."
        );
        assert!(
            of("emerge").starts_with("It needs the equivalents of these Debian packages: g++, spirv-tools")
        );
    }

    #[test]
    fn packages_that_only_debian_has_are_named() {
        let told = elsewhere(|program| program == "dnf", &["git", "qemu-user"]);
        assert!(told.contains("install git. It") && told.ends_with("Debian packages: qemu-user"), "{told}");
        let brew = elsewhere(|program| program == "brew", &["qemu-user"]);
        assert!(brew.starts_with("It needs"), "{brew}");
    }

    #[test]
    fn glsl_is_left_out_without_its_tools() {
        assert_eq!(missing_of(|program| program != "cmake"), ["cmake"]);
        assert_eq!(missing_of(|program| program == "python"), ["c++", "cmake", "git"]);
        assert!(missing_of(|program| program != "python3").is_empty());
    }
}
