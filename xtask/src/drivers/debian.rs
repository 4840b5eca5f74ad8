//! Drivers, and programs with one, out of Debian's packages, unpacked into a folder: nothing is installed, and nobody need be
//! root.

use crate::output;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use std::{env, fs, io, thread};

/// A driver that Debian has packages of.
#[derive(Debug)]
pub struct Packaged {
    name: &'static str,
    package: &'static str,
    /// The library's place in the package.
    library: &'static str,
    /// Archives and suites of all fetched packages. The last has the driver.
    suites: &'static [(&'static str, &'static str)],
    /// True if all dependencies are fetched too, down to the C library.
    has_dependencies: bool,
    /// True if the driver is of a newer release than the others, and so takes the C library that was fetched. The machine may be
    /// unable to run it.
    pub is_newer: bool,
}

const LAVAPIPE: Packaged = Packaged {
    name: "lavapipe",
    package: "mesa-vulkan-drivers",
    library: "usr/lib/x86_64-linux-gnu/libvulkan_lvp.so",
    suites: &[("debian", "bookworm-backports")],
    has_dependencies: false,
    is_newer: false,
};

/// The packages that `--fetch` fetches.
pub const PACKAGED: [Packaged; 3] = [
    LAVAPIPE,
    Packaged {
        name: "SwiftShader",
        package: "chromium-common",
        library: "usr/lib/chromium/libvk_swiftshader.so",
        suites: &[("debian-security", "bookworm-security")],
        ..LAVAPIPE
    },
    Packaged {
        suites: &[("debian", "trixie"), ("debian", "trixie-backports")],
        has_dependencies: true,
        is_newer: true,
        ..LAVAPIPE
    },
];

/// A browser, with the SwiftShader of the same name among the drivers.
pub const CHROMIUM: Packaged = Packaged {
    name: "Chromium",
    package: "chromium",
    library: "usr/lib/chromium/chromium",
    suites: &[("debian", "bookworm"), ("debian-security", "bookworm-security")],
    has_dependencies: true,
    ..LAVAPIPE
};

/// The release that the drivers that are not newer need the libraries of.
const RELEASE: &str = "bookworm";
const SERVER: &str = "http://deb.debian.org";
const KEYRING: &str = "/usr/share/keyrings/debian-archive-keyring.gpg";
const TRIES: u64 = 3;

impl Packaged {
    /// The driver and its suite.
    pub fn title(&self) -> String {
        format!("{} of {}", self.name, self.suite().1)
    }

    /// The driver's file for Vulkan's loader.
    pub fn icd(&self, cache: &Path) -> PathBuf {
        self.folder(cache).join("icd.json")
    }

    /// The folder in the place of the system's root.
    pub fn root(&self, cache: &Path) -> PathBuf {
        self.folder(cache).join("unpacked")
    }

    /// The driver's version: its package and the package's version. The file is there once all of the driver is.
    pub fn version(&self, cache: &Path) -> Option<String> {
        fs::read_to_string(self.folder(cache).join("version")).ok()
    }

    /// The command that starts a program with the libraries that were fetched with the driver.
    pub fn launcher(&self, cache: &Path) -> Vec<OsString> {
        if !self.is_newer {
            return Vec::new();
        }
        let libraries = self.root(cache).join("usr/lib/x86_64-linux-gnu");
        vec![libraries.join("ld-linux-x86-64.so.2").into(), "--library-path".into(), libraries.into()]
    }

    pub fn fetch(&self, cache: &Path) -> Result<(), String> {
        if self.version(cache).is_some() {
            return Ok(());
        }
        self.refusal_here().map_or(Ok(()), Err)?;
        println!("xtask: fetching {}", self.title());
        let mut outcome = self.try_fetch(&self.folder(cache));
        for tries in 1..TRIES {
            if outcome.is_err() {
                thread::sleep(Duration::from_secs(5 * tries));
                outcome = self.try_fetch(&self.folder(cache));
            }
        }
        outcome.map_err(|reason| self.not_fetched(&reason))
    }

    /// The reason why it cannot be fetched on this machine.
    pub fn refusal_here(&self) -> Option<String> {
        self.refusal(&fs::read_to_string("/etc/os-release").unwrap_or_default(), env::consts::ARCH)
    }

    fn not_fetched(&self, reason: &str) -> String {
        let (archive, suite) = self.suite();
        format!(
            "{} cannot be fetched from {SERVER}/{archive} {suite} ({TRIES} tries): {reason}; check the network and apt's \
             settings of proxies, and run this again",
            self.package
        )
    }

    /// The reason why it cannot be fetched on a system of this /etc/os-release.
    fn refusal(&self, os_release: &str, architecture: &str) -> Option<String> {
        let value = |key| os_release.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
        if architecture != "x86_64" || value("ID") != Some("debian") {
            return Some("fetching needs Debian's apt-get on amd64".to_owned());
        }
        let release = value("VERSION_CODENAME").unwrap_or("unknown");
        (!self.is_newer && release != RELEASE)
            .then(|| format!("it needs the libraries of Debian {RELEASE}, and this is {release}"))
    }

    fn suite(&self) -> (&'static str, &'static str) {
        self.suites[self.suites.len() - 1]
    }

    fn folder(&self, cache: &Path) -> PathBuf {
        cache.join(self.title().replace(' ', "-"))
    }

    fn try_fetch(&self, folder: &Path) -> Result<(), String> {
        let failed = |error: io::Error| format!("{}: {error}", folder.display());
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(failed)?;
        }
        let apt = folder.join("apt");
        let archives = prepare_apt(&apt, &self.sources()).map_err(failed)?;
        let get = |arguments: &[&str]| {
            let mut command = Command::new("apt-get");
            command.env("LC_ALL", "C").env("APT_CONFIG", apt.join("settings"));
            output(command.args(arguments).current_dir(&archives))
        };
        get(&["update"])?;
        if self.has_dependencies {
            let only = ["install", "--yes", "--download-only", "--no-install-recommends"];
            // Programs load Vulkan's loader, which the drivers do not ask for.
            let what = ["--target-release", self.suite().1, self.package, "libvulkan1"];
            get(&[&only[..], &what].concat())?;
        } else {
            get(&["download", self.package])?;
        }
        let root = folder.join("unpacked");
        let mut versions = String::new();
        for package in files_of(&archives, "deb") {
            output(Command::new("dpkg-deb").arg("--extract").arg(&package).arg(&root))?;
            versions += &version_of(&package, self.package).unwrap_or_default();
        }
        if !root.join(self.library).is_file() {
            return Err(format!("the package has no {}", self.library));
        }
        fs::remove_dir_all(&apt).map_err(failed)?;
        fs::write(folder.join("icd.json"), manifest(&format!("unpacked/{}", self.library)))
            .map_err(failed)?;
        fs::write(folder.join("version"), versions).map_err(failed)
    }

    fn sources(&self) -> String {
        let lines = self.suites.iter().map(|(archive, suite)| {
            format!("deb [arch=amd64 signed-by={KEYRING}] {SERVER}/{archive} {suite} main\n")
        });
        lines.collect()
    }
}

/// A driver's file for Vulkan's loader, which takes the path as one from the file's folder.
pub fn manifest(library: &str) -> String {
    let icd = format!(r#"{{"library_path": "./{library}", "api_version": "1.1.0"}}"#);
    format!("{{\"file_format_version\": \"1.0.0\", \"ICD\": {icd}}}\n")
}

/// The file of RADV in Debian's backports, which its package of lavapipe has too. It compiles for GPUs that the system's RADV does
/// not know.
pub fn newer_radv(cache: &Path) -> Result<PathBuf, String> {
    let package = &PACKAGED[0];
    package.fetch(cache)?;
    let file = package.folder(cache).join("radeon_icd.json");
    let written = fs::write(&file, manifest("unpacked/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so"));
    written.map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(file)
}

/// Name and version out of the name of a package's file, where it is the package sought.
fn version_of(path: &Path, package: &str) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let (version, _) = name.strip_prefix(package)?.strip_prefix('_')?.split_once('_')?;
    // A colon cannot stand in these names.
    Some(format!("{package} {}", version.replace("%3a", ":")))
}

/// Makes a folder in the place of the system's for apt-get. Returns the folder in it of fetched packages.
fn prepare_apt(folder: &Path, sources: &str) -> io::Result<PathBuf> {
    let archives = folder.join("var/cache/apt/archives");
    for name in ["etc/apt/apt.conf.d", "etc/apt/preferences.d", "var/lib/apt/lists/partial", "var/lib/dpkg"] {
        fs::create_dir_all(folder.join(name))?;
    }
    fs::create_dir_all(archives.join("partial"))?;
    fs::write(folder.join("etc/apt/sources.list"), sources)?;
    fs::write(folder.join("var/lib/dpkg/status"), "")?;
    fs::write(folder.join("settings"), settings(folder))?;
    Ok(archives)
}

/// The system's settings of proxies and the like, without its hooks, which clean the system's folders up. Unsigned
/// packages are refused, whatever the system allows.
fn settings(folder: &Path) -> String {
    let system = Command::new("apt-config").args(["dump", "Acquire"]).output();
    let mut settings = system.map_or_else(|_| Vec::new(), |output| output.stdout);
    settings.extend(format!("Dir \"{}\";\nAPT::Update::Error-Mode \"any\";\n", folder.display()).bytes());
    for name in ["Insecure", "Weak", "DowngradeToInsecure"] {
        settings.extend(format!("Acquire::Allow{name}Repositories \"false\";\n").bytes());
    }
    String::from_utf8_lossy(&settings).into_owned()
}

/// The files of this ending in a folder, if there is one, in their order.
pub fn files_of(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == ending));
    files.sort();
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOOKWORM: &str = "NAME=\"Debian GNU/Linux\"\nVERSION_CODENAME=bookworm\nID=debian\n";

    #[test]
    fn only_what_the_system_can_run_is_fetched() {
        let trixie = BOOKWORM.replace("bookworm", "trixie");
        let ubuntu = BOOKWORM.replace("ID=debian", "ID=ubuntu");
        for driver in PACKAGED.iter().chain([&CHROMIUM]) {
            assert_eq!(driver.refusal(BOOKWORM, "x86_64"), None, "{}", driver.title());
            assert_eq!(driver.refusal(&trixie, "x86_64").is_none(), driver.is_newer, "{}", driver.title());
            for refused in [driver.refusal(&ubuntu, "x86_64"), driver.refusal(BOOKWORM, "aarch64")] {
                assert!(refused.unwrap().contains("Debian's apt-get on amd64"));
            }
            assert!(driver.refusal("", "x86_64").is_some());
        }
    }

    /// Packages are checked against Debian's keys, whatever the system's apt allows.
    #[test]
    fn nothing_unsigned_is_fetched() {
        for driver in PACKAGED.iter().chain([&CHROMIUM]) {
            let sources = driver.sources();
            assert!(
                sources.lines().all(|line| line.contains("signed-by=/usr/share/keyrings/debian-archive"))
            );
            assert!(!sources.contains("trusted"));
        }
        let settings = settings(Path::new("/nowhere"));
        for name in ["Insecure", "Weak", "DowngradeToInsecure"] {
            let last = settings.lines().rfind(|line| line.contains(&format!("::Allow{name}Repositories")));
            assert!(last.unwrap().ends_with("\"false\";"), "{last:?}");
        }
    }

    #[test]
    fn a_package_tells_its_version() {
        let version = |name| version_of(&Path::new("/a_b").join(name), "mesa-vulkan-drivers");
        let found = version("mesa-vulkan-drivers_1%3a25.0.7-2~bpo12+1_amd64.deb");
        assert_eq!(found.unwrap(), "mesa-vulkan-drivers 1:25.0.7-2~bpo12+1");
        assert_eq!(version("libllvm19_1.deb"), None);
    }

    #[test]
    fn a_failed_fetch_names_the_address_and_the_remedy() {
        let told = PACKAGED[1].not_fetched("no such host");
        for part in
            ["chromium-common", "http://deb.debian.org/debian-security", "no such host", "check the network"]
        {
            assert!(told.contains(part), "{told}");
        }
    }
}
