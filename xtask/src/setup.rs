//! Installs what building and running needs, where it is missing.

use std::fs;
use std::process::{Command, Stdio};

/// A Debian package and what it is for.
struct Package {
    name: &'static str,
    purpose: &'static str,
}

const PACKAGES: [Package; 10] = [
    Package { name: "libvulkan1", purpose: "the Vulkan loader" },
    Package { name: "mesa-vulkan-drivers", purpose: "lavapipe, Vulkan on the CPU" },
    Package { name: "vulkan-validationlayers", purpose: "Vulkan validation in tests" },
    Package { name: "spirv-tools", purpose: "spirv-val in tests" },
    Package { name: "glslang-tools", purpose: "GLSL ES validation in tests" },
    Package { name: "cmake", purpose: "building glslang" },
    Package { name: "ninja-build", purpose: "building glslang" },
    Package { name: "g++", purpose: "building glslang" },
    Package { name: "python3", purpose: "building glslang" },
    Package { name: "git", purpose: "building glslang" },
];

/// Installs the packages that are missing, as root or through sudo without a password; else says what to type.
pub fn run() -> Result<(), String> {
    if !has_apt() {
        println!("xtask: no apt-get here; besides Rust this needs {}", needs());
        return Ok(());
    }
    let missing: Vec<&str> =
        PACKAGES.iter().map(|package| package.name).filter(|name| !is_installed(name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    println!("xtask: installing {}", missing.join(" "));
    let prefix: &[&str] = if is_root() {
        &[]
    } else if succeeds("sudo", &["-n", "true"]) {
        &["sudo", "-n"]
    } else {
        return Err(format!(
            "these packages are missing; type this and run the command again:\n  \
             sudo apt-get update && sudo apt-get install -y {}",
            missing.join(" ")
        ));
    };
    apt_get(prefix, &["update", "-qq"])?;
    let mut install = vec!["install", "-y", "-qq", "--no-install-recommends"];
    install.extend(&missing);
    apt_get(prefix, &install)
}

fn needs() -> String {
    PACKAGES.map(|package| format!("{} ({})", package.name, package.purpose)).join(", ")
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

fn apt_get(prefix: &[&str], arguments: &[&str]) -> Result<(), String> {
    let words: Vec<&str> =
        prefix.iter().copied().chain(["env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]).collect();
    let status = Command::new(words[0]).args(&words[1..]).args(arguments).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        _ => Err(format!("`apt-get {}` failed; its message is above", arguments.join(" "))),
    }
}
