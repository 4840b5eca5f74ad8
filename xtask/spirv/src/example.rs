//! `examples/rust-gpu`: a shader crate as users have it, compiled as they would.

use crate::compile::{RUST_GPU, TARGET};
use anyhow::{Context, Result, bail};
use cargo_gpu_install::install::Install;
use cargo_gpu_install::spirv_builder::ModuleResult;
use spirv_tools::TargetEnv;
use spirv_tools::val::{self, Validator};
use std::path::Path;

/// Builds the example and validates the module.
pub fn check(repository: &Path) -> Result<()> {
    let folder = repository.join("examples/rust-gpu");
    eprintln!("spirv: compiling {}", folder.display());
    let mut install = Install::from_shader_crate(folder.clone());
    install.spirv_builder_version = Some(RUST_GPU.to_owned());
    let backend = install.run().context("rust-gpu could not be installed")?;
    let compiled = backend
        .to_spirv_builder(&folder, TARGET)
        .release(true)
        .deny_warnings(true)
        .target_dir_path(repository.join("target/spirv-example").display().to_string())
        .build()
        .context("rust-gpu could not compile examples/rust-gpu")?;
    let ModuleResult::SingleModule(path) = compiled.module else {
        bail!("rust-gpu made several modules of examples/rust-gpu");
    };
    let words = crate::compile::words(&path)?;
    val::create(Some(TargetEnv::Vulkan_1_1))
        .validate(&words, None)
        .context("spirv-val of examples/rust-gpu")?;
    println!("spirv: examples/rust-gpu compiles, and spirv-val takes it");
    Ok(())
}
