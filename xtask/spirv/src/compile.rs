//! rust-gpu's part: a shader crate to one module for each entry point.

use crate::kernel::{Kernel, name_of_path};
use anyhow::{Context, Result, bail};
use cargo_gpu_install::install::{Install, InstalledBackend};
use cargo_gpu_install::spirv_builder::{ModuleResult, SpirvBuilder};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// rust-gpu's name of Vulkan 1.1.
pub const TARGET: &str = "spirv-unknown-vulkan1.1";

/// Version of rust-gpu.
pub const RUST_GPU: &str = "0.10.0";

/// The features of `shader-crate` that have the shipped kernels, and those that measure. rust-gpu holds a copy of all that it
/// compiles for each entry point, so memory and time grow with the square of what is compiled at once.
pub const KERNELS: &str = "kernels";
pub const COST_KERNELS: &str = "cost-kernels";

/// The feature that has the library's functions, each an entry point.
pub const LIBRARY: &str = "library";

/// rust-gpu, and the crate that it compiles.
pub struct Compiler {
    backend: InstalledBackend,
    shader_crate: PathBuf,
}

impl Compiler {
    /// Installs rust-gpu, if it is not there, for a crate in this folder.
    pub fn install(shader_crate: PathBuf) -> Result<Self> {
        eprintln!("spirv: installing rust-gpu {RUST_GPU}, if it is not there (takes minutes the first time)");
        let mut install = Install::from_shader_crate(shader_crate.clone());
        // Named here, since cargo-gpu does not see a `spirv-std` that is behind a feature.
        install.spirv_builder_version = Some(RUST_GPU.to_owned());
        let backend = install.run().context(
            "rust-gpu could not be installed: it needs rustup and the nightly toolchain named in README.md",
        )?;
        Ok(Self { backend, shader_crate })
    }

    /// Compiles the kernels of `unitvec` behind a feature to the words of a module each, not optimised.
    pub fn kernels(&self, feature: &str) -> Result<Vec<(Kernel, Vec<u32>)>> {
        let compiled = self.compile(feature)?.into_iter();
        compiled.map(|(entry_point, words)| Ok((Kernel::of_entry_point(&entry_point)?, words))).collect()
    }

    /// Compiles what is behind a feature to a module for each entry point, not optimised, by the name of the entry point's module
    /// and its own.
    pub fn named(&self, feature: &str) -> Result<BTreeMap<String, Vec<u32>>> {
        let compiled = self.compile(feature)?.into_iter();
        Ok(compiled.map(|(entry_point, words)| (name_of_path(&entry_point), words)).collect())
    }

    /// The settings of all builds.
    pub fn builder(&self) -> SpirvBuilder {
        self.backend.to_spirv_builder(&self.shader_crate, TARGET).release(true).deny_warnings(true)
    }

    /// The names of the entry points behind a feature, and the words of the module of each.
    fn compile(&self, feature: &str) -> Result<Vec<(String, Vec<u32>)>> {
        eprintln!("spirv: compiling the {feature} of {}", self.shader_crate.display());
        let compiled = self
            .builder()
            .multimodule(true)
            .shader_crate_default_features(false)
            .shader_crate_features([feature.to_owned()])
            // rust-gpu's own run of the optimiser folds chains of float operations.
            .extra_arg("--no-spirv-opt")
            .target_dir_path("target/spirv-build")
            .build()
            .with_context(|| format!("rust-gpu could not compile {}", self.shader_crate.display()))?;
        match compiled.module {
            ModuleResult::MultiModule(modules) => {
                modules.into_iter().map(|(entry, path)| Ok((entry, words(&path)?))).collect()
            }
            ModuleResult::SingleModule(path) => bail!("rust-gpu made one module, {}", path.display()),
        }
    }
}

/// The words of a module's file.
pub fn words(path: &Path) -> Result<Vec<u32>> {
    let bytes = fs::read(path).with_context(|| format!("reading {}", path.display()))?;
    Ok(bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect())
}
