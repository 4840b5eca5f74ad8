//! With the feature `glsl`: links the libraries that the system's shaderc leaves out, and says so where there is none.
//!
//! Upstream's `libshaderc_combined.a` holds all of glslang and SPIRV-Tools. Debian's does not: its packages
//! `glslang-dev` and `spirv-tools` have the rest, in libraries that differ from version to version.

use std::env;
use std::path::{Path, PathBuf};

/// Newer glslang versions have fewer libraries.
const LEFT_OUT: &str = "glslang HLSL MachineIndependent GenericCodeGen OGLCompiler OSDependent SPIRV \
    SPIRV-Tools-opt SPIRV-Tools";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for variable in ["SHADERC_LIB_DIR", "VULKAN_SDK"] {
        println!("cargo::rerun-if-env-changed={variable}");
    }
    let has = |feature: &str| env::var_os(format!("CARGO_FEATURE_{feature}")).is_some();
    if !has("GLSL") || has("GLSL_FROM_SOURCE") {
        return;
    }
    let Some(folder) = folder() else { return };
    let has_static = |name: &str| folder.join(format!("lib{name}.a")).is_file();
    if !has_static("shaderc_combined") {
        let has_shared =
            ["libshaderc.so", "libshaderc_shared.so"].iter().any(|name| folder.join(name).is_file());
        if !has_shared {
            println!(
                "cargo::warning=no libshaderc_combined.a in {}: shaderc is built from source, which takes minutes; on \
                 Debian, `apt-get install libshaderc-dev glslang-dev spirv-tools` saves them",
                folder.display()
            );
        }
        return;
    }
    println!("cargo::rustc-link-search=native={}", folder.display());
    for name in LEFT_OUT.split(' ').filter(|name| has_static(name)) {
        // Linked whole: libshaderc_combined comes later on the command line, and GNU ld does not search earlier
        // archives again.
        println!("cargo::rustc-link-lib=static:+whole-archive={name}");
    }
    if env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-link-lib=stdc++");
    }
}

/// The folder that the `shaderc-sys` crate takes libraries from, except that it also asks pkg-config.
fn folder() -> Option<PathBuf> {
    if let Some(folder) = env::var_os("SHADERC_LIB_DIR") {
        return Some(folder.into());
    }
    if let Some(sdk) = env::var_os("VULKAN_SDK") {
        return Some(Path::new(&sdk).join("lib"));
    }
    let architecture = env::var("CARGO_CFG_TARGET_ARCH").unwrap_or_default();
    match env::var("CARGO_CFG_TARGET_OS").unwrap_or_default().as_str() {
        "linux" => {
            let of_debian = if architecture == "x86" { "i386" } else { &architecture };
            let multiarch = format!("/usr/lib/{of_debian}-linux-gnu");
            let lib64 = if architecture == "x86_64" { "/usr/lib64" } else { "/usr/lib" };
            [multiarch.as_str(), lib64, "/usr/lib"].iter().map(PathBuf::from).find(|folder| folder.is_dir())
        }
        "macos" => Some(PathBuf::from("/usr/local/lib")),
        _ => None,
    }
}
