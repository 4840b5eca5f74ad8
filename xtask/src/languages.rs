//! The compilers of all shading languages: fetched from package registries into `target/languages`, and given to the
//! program of `tests/languages`, which compiles with them, runs the code, and compares.

use crate::drivers::debian::{CHROMIUM, PACKAGED};
use crate::{built, cache, cargo, output, repository, run as run_command, setup, take, target};
use std::ffi::OsString;
use std::fs;
use std::iter;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The file of the results for the docs.
const RECORD: &str = "docs/data/languages.csv";
/// The file of the costs of barriers on a GPU.
const BARRIERS: &str = "docs/data/barriers.csv";

/// The driver that compiles for AMD's GPUs without one, and the GPU.
const RADV: &str = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json";
const GPU: &str = "navi21";

const PACKAGE: [&str; 2] = ["--package", "unitvec-language-tests"];

/// A file of a package registry, and the pattern of the files unpacked from it.
#[derive(Debug)]
pub struct Archive {
    /// Package and version: the name of the folder.
    pub name: &'static str,
    pub url: &'static str,
    pub sha256: &'static str,
    /// Files in it, by a pattern.
    pub members: &'static str,
    /// The file among them that is handed on.
    pub file: &'static str,
}

/// The compiler of HLSL, for Linux: no package has it by itself.
const DXC: Archive = Archive {
    name: "compushady-0.17.5",
    url: "https://files.pythonhosted.org/packages/da/2f/e84188f13e07c444fa8593e6980b9db85c0aea3fde699f509d11bd7ca6c7/compushady-0.17.5.tar.gz",
    sha256: "5052caf9e955d8e7a48e22f536e82b44b72e83af46e824a9e99157c7809de691",
    members: "compushady-0.17.5/compushady/backends/libdxcompiler_x86_64*",
    file: "compushady-0.17.5/compushady/backends/libdxcompiler_x86_64.so.3.7",
};

/// The compiler of HLSL for Direct3D 11, a library for Windows. Qt hands it on.
const FXC: Archive = Archive {
    name: "PyQt5_Qt5-5.15.2",
    url: "https://files.pythonhosted.org/packages/37/97/5d3b222b924fa2ed4c2488925155cd0b03fd5d09ee1cfcf7c553c11c9f66/PyQt5_Qt5-5.15.2-py3-none-win_amd64.whl",
    sha256: "750b78e4dba6bdf1607febedc08738e318ea09e9b10aea9ff0d73073f11f6962",
    members: "PyQt5/Qt5/bin/d3dcompiler_47.dll",
    file: "PyQt5/Qt5/bin/d3dcompiler_47.dll",
};

/// The packages that run it, and build the program that calls it.
pub const FOR_FXC: [&str; 5] = ["wine64", "wine", "xvfb", "gcc-mingw-w64-x86-64", "libgl1-mesa-dri"];

/// The compiler of Slang. Its library serves any Python.
const SLANG: Archive = Archive {
    name: "slangpy-0.43.1",
    url: "https://files.pythonhosted.org/packages/0b/89/917567a889417c87842cea379091cb46b7f4f4000e9fec1b9d25d251c4cf/slangpy-0.43.1-cp311-cp311-manylinux_2_34_x86_64.whl",
    sha256: "965dbbd1d907c90e17027945780146a67c66baf766f3d0b8af3f52ea2c4a8eb9",
    members: "slangpy/libslang-*.so*",
    file: "slangpy/libslang-compiler.so.0.2026.12",
};

/// Dawn, the implementation of WebGPU in Chromium, as an addon to Node.js.
const DAWN: Archive = Archive {
    name: "webgpu-0.6.2",
    url: "https://registry.npmjs.org/webgpu/-/webgpu-0.6.2.tgz",
    sha256: "77a6be6513b9f7c2e94425620ce603efb38cdc5d0393e1b31a1b0c8479330ffd",
    members: "package/dist/linux-x64/*",
    file: "package/dist/linux-x64/dawn.node",
};

/// The compiler of CUDA. The other packages hold its optimiser and headers, in the same folder.
pub const NVCC: [Archive; 4] = [
    Archive {
        name: "nvidia_cuda_nvcc-13.5.37",
        url: "https://files.pythonhosted.org/packages/0b/7d/21c734e63423dc53fb1b1ebbb6dee84e9ccafbeeaa30e9ae07e6fdcdd15b/nvidia_cuda_nvcc-13.5.37-py3-none-manylinux2014_x86_64.manylinux_2_17_x86_64.whl",
        sha256: "f5c4f7ead5d964fb4af42bbf1e6d3ec3c1e6e9d83b53749f691d387e7fcaa3a7",
        members: "nvidia/cu13/*",
        file: "nvidia/cu13/bin/nvcc",
    },
    Archive {
        name: "nvidia_nvvm-13.5.37",
        url: "https://files.pythonhosted.org/packages/23/dc/c7089283bad8e8089825b0cae0898f8a89b5d27bdb2edea5266d259101e1/nvidia_nvvm-13.5.37-py3-none-manylinux2010_x86_64.manylinux_2_12_x86_64.whl",
        sha256: "c41bfa362e407405163f103c2229f0765f8cc2ed7d148b754dc77f228bf7e070",
        members: "nvidia/cu13/*",
        file: "nvidia/cu13/nvvm/bin/cicc",
    },
    Archive {
        name: "nvidia_cuda_crt-13.5.37",
        url: "https://files.pythonhosted.org/packages/d5/ac/fb3ca43f437405ce33bfd8ba64503148fdc9198265f26f8ecd1bd6e76338/nvidia_cuda_crt-13.5.37-py3-none-manylinux2014_x86_64.manylinux_2_17_x86_64.whl",
        sha256: "e898b7f73d3035fa89915a3f7bf3b54a73e90249746111aed295822c4729bb29",
        members: "nvidia/cu13/*",
        file: "nvidia/cu13/include/crt/host_config.h",
    },
    Archive {
        name: "nvidia_cuda_runtime-13.5.37",
        url: "https://files.pythonhosted.org/packages/0b/7c/14b8f5518f8951e9dca57ea80f44f8ea8bcc8671812e6cc38009f3205e57/nvidia_cuda_runtime-13.5.37-py3-none-manylinux2014_x86_64.manylinux_2_17_x86_64.whl",
        sha256: "df2b79a8852f10d1fef8c848489c49eebb5754051bf870202a862831412b179d",
        members: "nvidia/cu13/*",
        file: "nvidia/cu13/include/cuda_runtime.h",
    },
];

/// What clang's mode for CUDA needs of CUDA, of the last version whose headers the clang of Debian 12 takes.
const CUDA_11: [Archive; 2] = [
    Archive {
        name: "nvidia_cuda_nvcc_cu11-11.8.89",
        url: "https://files.pythonhosted.org/packages/fc/10/02e6a5a6864f41f9aa3c7c4d6953e49d71f58c0528d2f0a1eec1ad6c090e/nvidia_cuda_nvcc_cu11-11.8.89-py3-none-manylinux2014_x86_64.whl",
        sha256: "f8e1e995166c884f2f5bf94975d7abb89175363b8712f7f81cd38d0df1b2cd85",
        members: "nvidia/cuda_nvcc/*",
        file: "nvidia/cuda_nvcc/bin/ptxas",
    },
    Archive {
        name: "nvidia_cuda_runtime_cu11-11.8.89",
        url: "https://files.pythonhosted.org/packages/a6/ec/a540f28b31de7bc1ed49eecc72035d4cb77db88ead1d42f7bfa5ae407ac6/nvidia_cuda_runtime_cu11-11.8.89-py3-none-manylinux2014_x86_64.whl",
        sha256: "92d04069a987e1fbc9213f8376d265df0f7bb42617d44f5eda1f496acea7f2d1",
        members: "nvidia/cuda_runtime/*",
        file: "nvidia/cuda_runtime/include/cuda.h",
    },
];

/// The fetched compilers, for the hash of the record's inputs.
pub fn versions() -> String {
    format!("{:?}", (DXC, FXC, SLANG, DAWN, NVCC, CUDA_11, CHROMIUM, PACKAGED, GPU))
}

/// Takes the files that match a pattern out of an archive, of whatever kind.
const UNPACK: &str = include_str!("unpack.py");

struct Options {
    needs_all: bool,
    records: bool,
    /// Arguments of the program.
    others: Vec<String>,
}

impl Options {
    fn of(arguments: &[String]) -> Result<Self, String> {
        let mut others = arguments.to_vec();
        let [_, all, records] = ["--languages", "--all", "--record"].map(|option| take(&mut others, option));
        if records && !others.is_empty() {
            return Err(format!("--record keeps what all codecs do, and takes no {}", others[0]));
        }
        Ok(Self { needs_all: all || records || std::env::var_os("CI").is_some(), records, others })
    }
}

/// Fetches what is missing, builds the program and runs it.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let options = Options::of(arguments)?;
    built(cargo(&["test", "--quiet"]).args(PACKAGE))?;
    run_command(cargo(&["build", "--quiet"]).args(PACKAGE))?;

    let found = Found::all(&cache("languages")?, &cache("drivers")?);
    let is_recorded = options.records && found.missing.is_empty();
    let mut program = found.program()?;
    program.arg("--wgpu").args(&options.others);
    if is_recorded {
        program.args(["--record", RECORD]);
    }
    let outcome = run_command(&mut program);
    for missing in &found.missing {
        eprintln!("xtask: NOT RUN: {missing}");
    }
    outcome?;
    // A run that fails leaves them as they are.
    if is_recorded {
        // The program compiles for a GPU that is not there.
        let mut program = found.program()?;
        program.env("VK_ICD_FILENAMES", RADV).env("VK_DRIVER_FILES", RADV).env("RADV_FORCE_FAMILY", GPU);
        run_command(program.args(["--barriers", BARRIERS]))?;
    }
    if options.needs_all && !found.missing.is_empty() {
        return Err(format!("not all compilers can be had: {}", found.missing.join("; ")));
    }
    Ok(())
}

/// Arguments for the compilers that are there, and the reasons why others are not.
#[derive(Default)]
struct Found {
    arguments: Vec<OsString>,
    missing: Vec<String>,
}

impl Found {
    /// The program, with arguments for the parts that are there.
    fn program(&self) -> Result<Command, String> {
        let mut program = Command::new(target()?.join("debug/unitvec-language-tests"));
        let scratch = cache("languages")?;
        // Drivers complain without such a folder.
        program.env("XDG_RUNTIME_DIR", &scratch).arg("--scratch").arg(scratch).args(&self.arguments);
        program.current_dir(repository());
        Ok(program)
    }

    fn all(languages: &Path, drivers: &Path) -> Self {
        let mut found = Self::default();
        found.missing.extend(setup::packages(&["curl", "ca-certificates", "python3"]).err());
        found.add("DXC", "--dxc", DXC.fetch(languages));
        found.add("FXC", "--fxc", setup::packages(&FOR_FXC).and_then(|()| FXC.fetch(languages)));
        found.add("Slang", "--slang", SLANG.fetch(languages));
        found.option("clang", "--clang", setup::packages(&["clang", "g++"]));
        found.option("MinGW", "--mingw", setup::packages(&["g++-mingw-w64-x86-64"]));
        let [nvcc, others @ ..] = &NVCC;
        found.add("nvcc", "--nvcc", nvcc.fetch_with(others, languages));
        let [cuda, others @ ..] = &CUDA_11;
        found.add("CUDA by clang", "--ptxas", cuda.fetch_with(others, languages));
        found.option("HIP", "--hip", setup::packages(&["hipcc"]));
        found.add("Chromium", "--chromium", CHROMIUM.fetch(drivers).map(|()| CHROMIUM.root(drivers)));
        let node = setup::packages(&["nodejs"]);
        found.add("Dawn", "--dawn", node.and_then(|()| DAWN.fetch(languages)));
        // Dawn refuses the lavapipe of Debian 12.
        for driver in PACKAGED.iter().filter(|driver| !driver.is_newer) {
            found.add(&driver.title(), "--icd", driver.fetch(drivers).map(|()| driver.icd(drivers)));
        }
        found
    }

    fn option(&mut self, title: &str, option: &str, packages: Result<(), String>) {
        match packages {
            Ok(()) => self.arguments.push(option.into()),
            Err(reason) => self.missing.push(format!("{title}: {reason}")),
        }
    }

    fn add(&mut self, title: &str, option: &str, path: Result<PathBuf, String>) {
        match path {
            Ok(path) => self.arguments.extend([option.into(), path.into()]),
            Err(reason) => self.missing.push(format!("{title}: {reason}")),
        }
    }
}

impl Archive {
    /// The file, fetched and unpacked where it is not there yet.
    pub fn fetch(&self, cache: &Path) -> Result<PathBuf, String> {
        self.fetch_with(&[], cache)
    }

    /// [`fetch`](Self::fetch), with other archives in the same folder.
    pub fn fetch_with(&self, others: &[Self], cache: &Path) -> Result<PathBuf, String> {
        if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
            return Err(format!("{} is fetched for Linux on x86-64 only", self.name));
        }
        let folder = cache.join(self.name);
        let file = folder.join(self.file);
        if file.is_file() {
            return Ok(file);
        }
        // The archives are unpacked beside their place, so that the files there are whole.
        let part = cache.join(format!("{}.part", self.name));
        let _ = fs::remove_dir_all(&part);
        iter::once(self).chain(others).try_for_each(|archive| archive.unpack(cache, &part))?;
        let _ = fs::remove_dir_all(&folder);
        fs::rename(&part, &folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        Ok(file)
    }

    /// Fetches the archive, and unpacks it into a folder.
    fn unpack(&self, cache: &Path, folder: &Path) -> Result<(), String> {
        println!("xtask: fetching {}", self.name);
        let archive = cache.join(format!("{}.archive", self.name));
        let mut curl = Command::new("curl");
        curl.args(["--fail", "--silent", "--show-error", "--location", "--retry", "3", "--output"]);
        run_command(curl.arg(&archive).arg(self.url)).map_err(|error| format!("{}: {error}", self.url))?;
        self.check(&archive)?;
        run_command(
            Command::new("python3").args(["-c", UNPACK]).arg(&archive).arg(self.members).arg(folder),
        )?;
        fs::remove_file(&archive).map_err(|error| format!("{}: {error}", archive.display()))?;
        let is_there = folder.join(self.file).is_file();
        if is_there { Ok(()) } else { Err(format!("{} has no {}", self.url, self.file)) }
    }

    /// Fails where the archive is not the expected one.
    fn check(&self, archive: &Path) -> Result<(), String> {
        let mut tool = Command::new(if cfg!(windows) { "certutil" } else { "sha256sum" });
        let printed = output(match cfg!(windows) {
            true => tool.arg("-hashfile").arg(archive).arg("SHA256"),
            false => tool.arg(archive),
        })?;
        // certutil prints lines before and after it.
        let sum = printed.split_whitespace().find(|word| word.len() == self.sha256.len()).unwrap_or_default();
        if sum == self.sha256 {
            return Ok(());
        }
        let _ = fs::remove_file(archive);
        Err(format!("{} has the SHA-256 {sum}, not {}", self.url, self.sha256))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::strings;

    #[test]
    fn only_whole_runs_are_recorded() {
        let options = Options::of(&strings(&["--languages", "--codec", "oct32"])).unwrap();
        assert_eq!((options.records, options.others), (false, strings(&["--codec", "oct32"])));
        assert!(Options::of(&strings(&["--languages", "--record"])).is_ok_and(|o| o.records && o.needs_all));
        let refused = Options::of(&strings(&["--languages", "--record", "--codec", "oct32"]));
        assert!(refused.err().unwrap().contains("--codec"));
    }

    #[test]
    fn archives_are_pinned() {
        for archive in [&DXC, &FXC, &SLANG, &DAWN].into_iter().chain(&NVCC).chain(&CUDA_11) {
            let Archive { name, url, sha256, .. } = archive;
            assert!(url.starts_with("https://") && url.contains(name), "{url}");
            assert!(sha256.len() == 64 && sha256.chars().all(|c| c.is_ascii_hexdigit()), "{sha256}");
        }
    }

    #[test]
    fn another_archive_is_refused() {
        let path = std::env::temp_dir().join(format!("unitvec-xtask-{}-archive", std::process::id()));
        const OF_NOTHING: &str = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        fs::write(&path, "").unwrap();
        assert_eq!(Archive { sha256: OF_NOTHING, ..DAWN }.check(&path), Ok(()));
        let error = DAWN.check(&path).unwrap_err();
        assert!(error.contains(OF_NOTHING) && !path.exists(), "{error}");
    }

    #[test]
    fn what_is_missing_is_told() {
        let mut found = Found::default();
        found.add("Slang", "--slang", Err("no network".to_owned()));
        found.add("DXC", "--dxc", Ok("dxc.so".into()));
        assert_eq!(found.missing, ["Slang: no network"]);
        assert_eq!(found.arguments, ["--dxc", "dxc.so"]);
    }
}
