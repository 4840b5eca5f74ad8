//! Compilers for GPUs that are not there, of other makers than AMD: Mesa's drivers with the libraries of drm-shim, which
//! answer in the kernel's place and which no package has, and NVIDIA's compiler of CUDA. `unitvec bench compiler` finds them in
//! `target/compilers`.

use crate::drivers::debian::{PACKAGED, manifest};
use crate::languages::{Archive, NVCC};
use crate::{at, cache, python, run, setup};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const MESA: Archive = Archive {
    name: "mesa-25.0.7",
    url: "https://deb.debian.org/debian/pool/main/m/mesa/mesa_25.0.7.orig.tar.xz",
    sha256: "592272df3cf01e85e7db300c449df5061092574d099da275d19e97ef0510f8a6",
    members: "mesa-25.0.7/*",
    file: "mesa-25.0.7/meson.build",
};

/// NVIDIA's disassembler.
const NVDISASM: Archive = Archive {
    name: "nvidia_cuda_nvdisasm-13.5.37",
    url: "https://files.pythonhosted.org/packages/64/4a/c84a14209a549d97831a02d111d943f47c995d4d3beaa3416daa3b534abb/nvidia_cuda_nvdisasm-13.5.37-py3-none-manylinux2014_x86_64.manylinux_2_17_x86_64.whl",
    sha256: "d3fdbdd49fa53e2e4aacd3db8259d052bd2b049ececdcb69e92e083c6728e7ca",
    members: "nvidia/cu13/*",
    file: "nvidia/cu13/bin/nvdisasm",
};

/// What Mesa is built with.
const PACKAGES: [&str; 13] = [
    "bison",
    "curl",
    "flex",
    "g++",
    "gcc",
    "glslang-tools",
    "libdrm-dev",
    "libexpat1-dev",
    "pkg-config",
    "python3",
    "python3-venv",
    "xz-utils",
    "zlib1g-dev",
];

/// Programs of Python that build it. Debian 12 has an older meson.
const TOOLS: [&str; 5] =
    ["meson==1.12.1", "ninja==1.13.2", "mako==1.4.3", "pyyaml==6.0.4", "packaging==26.4"];

/// Options of the build: drivers and shims alone, without optimisation, which would take longer than it saves.
const OPTIONS: &str = "--wrap-mode=nodownload -Dbuildtype=plain -Doptimization=0 -Ddebug=false -Db_ndebug=true -Dplatforms= \
    -Dvulkan-drivers=panfrost,freedreno,broadcom -Dgallium-drivers= -Dtools=drm-shim,intel -Dglx=disabled -Degl=disabled \
    -Dgbm=disabled -Dopengl=false -Dgles1=disabled -Dgles2=disabled -Dllvm=disabled -Dintel-rt=disabled -Dvideo-codecs= \
    -Dvalgrind=disabled -Dlibunwind=disabled -Dlmsensors=disabled -Dvulkan-layers= -Dshared-glapi=disabled \
    -Dxmlconfig=disabled -Dzstd=disabled -Dshader-cache=disabled";

/// Folders of drivers, with the shim and the driver that are built; Intel's driver is that of Debian's backports.
const BUILT: [(&str, &str, Option<&str>); 4] = [
    ("intel", "src/intel/tools/libintel_noop_drm_shim.so", None),
    (
        "freedreno",
        "src/freedreno/drm-shim/libfreedreno_noop_drm_shim.so",
        Some("src/freedreno/vulkan/libvulkan_freedreno.so"),
    ),
    (
        "panfrost",
        "src/panfrost/drm-shim/libpanfrost_noop_drm_shim.so",
        Some("src/panfrost/vulkan/libvulkan_panfrost.so"),
    ),
    (
        "broadcom",
        "src/broadcom/drm-shim/libv3d_noop_drm_shim.so",
        Some("src/broadcom/vulkan/libvulkan_broadcom.so"),
    ),
];

const INTEL: &str = "usr/lib/x86_64-linux-gnu/libvulkan_intel.so";

/// The shim of VideoCore does not know two questions of its driver's, which a kernel since Linux 5.17 and 6.8 says yes to.
const ASKED: [&str; 2] = [
    "case DRM_V3D_PARAM_SUPPORTS_PERFMON:",
    "case DRM_V3D_PARAM_SUPPORTS_MULTISYNC_EXT:\n        case DRM_V3D_PARAM_SUPPORTS_CPU_QUEUE:\n        ",
];

/// Builds and fetches what is missing: the folder of all compilers.
pub fn build() -> Result<PathBuf, String> {
    let compilers = cache("compilers")?;
    setup::packages(&PACKAGES)?;
    let [nvcc, others @ ..] = NVCC;
    let others: Vec<Archive> = others.into_iter().chain([NVDISASM]).collect();
    Archive { name: "nvidia", ..nvcc }.fetch_with(&others, &compilers)?;
    if BUILT.iter().any(|(folder, ..)| !compilers.join(folder).join("icd.json").is_file()) {
        mesa(&compilers)?;
    }
    Ok(compilers)
}

fn mesa(compilers: &Path) -> Result<(), String> {
    let source = MESA.fetch(compilers)?.with_file_name("");
    let shim = source.join("src/broadcom/drm-shim/v3d_noop.c");
    let text = fs::read_to_string(&shim).map_err(at(&shim))?;
    let [known, others] = ASKED;
    if !text.contains(others) {
        let text = text.replace(known, &format!("{others}{known}"));
        fs::write(&shim, text).map_err(at(&shim))?;
    }
    let tools = compilers.join("tools");
    let pip = python::environment(&tools, Path::new("python3"))?;
    run(Command::new(pip).args(["-q", "install"]).args(TOOLS))?;
    let build = compilers.join("build");
    let path = [tools.join("bin").into_os_string(), std::env::var_os("PATH").unwrap_or_default()];
    let path = std::env::join_paths(path.iter().flat_map(std::env::split_paths))
        .map_err(|error| error.to_string())?;
    let tool = |name: &str| {
        let mut command = Command::new(tools.join("bin").join(name));
        command.env("PATH", &path);
        command
    };
    if !build.join("build.ninja").is_file() {
        run(tool("meson").arg("setup").args(OPTIONS.split_whitespace()).arg(&build).arg(&source))?;
    }
    let targets = BUILT.iter().flat_map(|(_, shim, driver)| std::iter::once(*shim).chain(*driver));
    run(tool("ninja").arg("-C").arg(&build).args(targets))?;
    let drivers = cache("drivers")?;
    PACKAGED[0].fetch(&drivers)?;
    for (name, shim, driver) in BUILT {
        let folder = compilers.join(name);
        fs::create_dir_all(&folder).map_err(at(&folder))?;
        let driver =
            driver.map_or_else(|| PACKAGED[0].root(&drivers).join(INTEL), |driver| build.join(driver));
        for (from, to) in [(build.join(shim), "shim.so"), (driver, "driver.so")] {
            fs::copy(&from, folder.join(to)).map_err(at(&from))?;
        }
        // The file is there once all of the driver is.
        fs::write(folder.join("icd.json"), manifest("driver.so")).map_err(at(&folder))?;
    }
    Ok(())
}
