//! `examples/rust-gpu`: a shader crate as users have it, compiled as they would.

use crate::compile::{Compiler, words};
use anyhow::{Context, Result, bail};
use cargo_gpu_install::spirv_builder::ModuleResult;
use spirv_tools::TargetEnv;
use spirv_tools::val::{self, Validator};
use std::path::Path;

/// Builds the example and validates the module.
pub fn check(repository: &Path) -> Result<()> {
    eprintln!("spirv: compiling examples/rust-gpu");
    let builder = Compiler::install(repository.join("examples/rust-gpu"))?.builder();
    let target = repository.join("target/spirv-example").display().to_string();
    let compiled =
        builder.target_dir_path(target).build().context("rust-gpu could not compile examples/rust-gpu")?;
    let ModuleResult::SingleModule(path) = compiled.module else {
        bail!("rust-gpu made several modules of examples/rust-gpu");
    };
    let words = words(&path)?;
    val::create(Some(TargetEnv::Vulkan_1_1))
        .validate(&words, None)
        .context("spirv-val of examples/rust-gpu")?;
    println!("spirv: examples/rust-gpu compiles, and spirv-val takes it");
    Ok(())
}
