//! With the feature `glsl`: links what the system's shaderc leaves out, and says so where there is none.
//!
//! Upstream's `libshaderc_combined.a` holds all of glslang and SPIRV-Tools. Debian's does not: its packages
//! `glslang-dev` and `spirv-tools` have the rest, in libraries that differ from version to version.

use std::env;
use std::path::{Path, PathBuf};

/// Newer glslangs have fewer.
const LEFT_OUT: [&str; 9] = [
    "glslang",
    "HLSL",
    "MachineIndependent",
    "GenericCodeGen",
    "OGLCompiler",
    "OSDependent",
    "SPIRV",
    "SPIRV-Tools-opt",
    "SPIRV-Tools",
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for variable in ["SHADERC_LIB_DIR", "VULKAN_SDK"] {
        println!("cargo::rerun-if-env-changed={variable}");
    }
    let has = |feature: &str| env::var_os(format!("CARGO_FEATURE_{feature}")).is_some();
    if !has("GLSL") || has("GLSL_FROM_SOURCE") {
        return;
    }
    let folders = folders();
    let is_in = |folder: &Path, name: &str| folder.join(format!("lib{name}.a")).is_file();
    let Some(folder) = folders.iter().find(|folder| is_in(folder, "shaderc_combined")) else {
        println!(
            "cargo::warning=no libshaderc_combined.a on this machine: shaderc is built from source, which takes \
             minutes; on Debian, `apt-get install libshaderc-dev glslang-dev spirv-tools` saves them"
        );
        return;
    };
    println!("cargo::rustc-link-search=native={}", folder.display());
    for name in LEFT_OUT.iter().filter(|name| is_in(folder, name)) {
        // Whole, since what needs them stands behind them on the linker's command line, and GNU ld does not look back.
        println!("cargo::rustc-link-lib=static:+whole-archive={name}");
    }
    if env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-link-lib=stdc++");
    }
}

/// Where the `shaderc-sys` crate looks for libraries, so that both take the same.
fn folders() -> Vec<PathBuf> {
    if let Some(folder) = env::var_os("SHADERC_LIB_DIR") {
        return vec![folder.into()];
    }
    if let Some(sdk) = env::var_os("VULKAN_SDK") {
        return vec![Path::new(&sdk).join("lib")];
    }
    let architecture = match env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_default() {
        x86 if x86 == "x86" => "i386".to_owned(),
        other => other,
    };
    let multiarch = format!("/usr/lib/{architecture}-linux-gnu");
    [multiarch.as_str(), "/usr/lib64", "/usr/lib", "/usr/local/lib"].map(PathBuf::from).to_vec()
}
