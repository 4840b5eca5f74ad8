//! `cargo xtask spirv [--check]`: builds `spirv/*.spv` and their manifest from `shader-crate` with rust-gpu.
//!
//! rust-gpu's own optimiser run folds chains of float operations, so it is turned off; the modules get NoContraction
//! on every float result first and are optimised after that.

mod decorate;

use anyhow::{Context, Result, bail, ensure};
use cargo_gpu_install::install::Install;
use cargo_gpu_install::spirv_builder::ModuleResult;
use spirv_tools::opt::{Optimizer, Passes};
use spirv_tools::val::Validator;
use spirv_tools::{TargetEnv, opt, val};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};
use unitvec_host::catalogue::{CATALOGUE, CodecInfo, Direction};
use unitvec_host::manifest::{self, Binding, Manifest, Module, PushConstant};
use unitvec_host::output;

const TARGET: &str = "spirv-unknown-vulkan1.2";
const RUST_GPU: &str = "0.10.0";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("spirv: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    let check = match env::args().skip(1).collect::<Vec<_>>().as_slice() {
        [] => false,
        [flag] if flag == "--check" => true,
        other => bail!("unknown arguments {other:?}; usage: cargo xtask spirv [--check]"),
    };
    let repository = repository()?;
    let files = build(&repository)?;
    let folder = repository.join("spirv");
    if check { compare(&folder, &files) } else { replace(&folder, &files) }
}

fn repository() -> Result<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = here.ancestors().nth(2).context("xtask/spirv has no repository around it")?;
    Ok(root.to_owned())
}

/// File names and contents of `spirv/`, manifest included.
fn build(repository: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let mut files = BTreeMap::new();
    let mut modules = Vec::new();
    for (entry_point, path) in compile(repository)? {
        let words = finish(&read_words(&path)?).with_context(|| format!("entry point {entry_point}"))?;
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let file = format!("{entry_point}.spv");
        modules.push(describe(&file, &entry_point, &bytes)?);
        files.insert(file, bytes);
    }
    ensure!(modules.len() == 2 * CATALOGUE.len(), "{} modules for {} codecs", modules.len(), CATALOGUE.len());
    let manifest = Manifest {
        rust_gpu: RUST_GPU.to_owned(),
        target: TARGET.to_owned(),
        sources_sha256: manifest::sources_sha256(repository)?,
        modules,
    };
    files.insert(
        manifest::FILE_NAME.to_owned(),
        (serde_json::to_string_pretty(&manifest)? + "\n").into_bytes(),
    );
    Ok(files)
}

/// Compiles the kernels; one module an entry point.
fn compile(repository: &Path) -> Result<BTreeMap<String, PathBuf>> {
    let shader_crate = repository.join("shader-crate");
    eprintln!("spirv: installing rust-gpu {RUST_GPU}, if it is not there (takes minutes the first time)");
    let mut install = Install::from_shader_crate(shader_crate.clone());
    // Named here, since cargo-gpu does not see a `spirv-std` that is behind a feature.
    install.spirv_builder_version = Some(RUST_GPU.to_owned());
    let backend = install.run().context(
        "rust-gpu could not be installed: it needs rustup and the nightly toolchain named in README.md",
    )?;
    eprintln!("spirv: compiling {}", shader_crate.display());
    let compiled = backend
        .to_spirv_builder(&shader_crate, TARGET)
        .multimodule(true)
        .release(true)
        .deny_warnings(true)
        .shader_crate_default_features(false)
        .shader_crate_features(["kernels".to_owned()])
        .extra_arg("--no-spirv-opt")
        .target_dir_path("target/spirv-build")
        .build()
        .context("rust-gpu could not compile shader-crate")?;
    match compiled.module {
        ModuleResult::MultiModule(modules) => Ok(modules),
        ModuleResult::SingleModule(path) => bail!("rust-gpu made one module, {}", path.display()),
    }
}

fn read_words(path: &Path) -> Result<Vec<u32>> {
    let bytes = fs::read(path).with_context(|| format!("reading {}", path.display()))?;
    Ok(bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect())
}

/// Decorates, optimises and validates a module.
fn finish(words: &[u32]) -> Result<Vec<u32>> {
    let decorated = decorate::no_contraction(words)?;
    let mut optimizer = opt::create(Some(TargetEnv::Vulkan_1_2));
    optimizer
        .register_performance_passes()
        .register_pass(Passes::StripDebugInfo)
        .register_pass(Passes::StripNonSemanticInfo)
        .register_pass(Passes::EliminateDeadConstant)
        .register_pass(Passes::CompactIds);
    let mut print = |message| eprintln!("spirv-opt: {message:?}");
    let optimized = optimizer.optimize(&decorated, &mut print, None).context("spirv-opt")?;
    let words = optimized.as_words().to_vec();
    decorate::check_no_contraction(&words)?;
    val::create(Some(TargetEnv::Vulkan_1_2)).validate(&words, None).context("spirv-val")?;
    Ok(words)
}

fn describe(file: &str, entry_point: &str, bytes: &[u8]) -> Result<Module> {
    let (codec, direction) = CATALOGUE
        .iter()
        .flat_map(|codec| [(codec, Direction::Encode), (codec, Direction::Decode)])
        .find(|(codec, direction)| codec.function(*direction) == entry_point)
        .with_context(|| format!("entry point {entry_point} belongs to no codec of the catalogue"))?;
    Ok(Module {
        file: file.to_owned(),
        codec: codec.id.to_owned(),
        direction,
        entry_point: entry_point.to_owned(),
        workgroup_size: [64, 1, 1],
        vectors_per_invocation: 4,
        bindings: bindings(codec, direction),
        push_constants: vec![PushConstant {
            offset: 0,
            r#type: "u32".to_owned(),
            content: "number of vectors".to_owned(),
        }],
        sha256: manifest::sha256_hex(bytes),
    })
}

fn bindings(codec: &CodecInfo, direction: Direction) -> Vec<Binding> {
    let vectors = ("three f32 a vector, packed".to_owned(), 12);
    let codes = ("codes, little endian, packed".to_owned(), codec.bytes as u32);
    let (input, output) = match direction {
        Direction::Encode => (vectors, codes),
        Direction::Decode => (codes, vectors),
    };
    let binding = |binding, access: &str, (content, bytes_per_vector)| Binding {
        binding,
        access: access.to_owned(),
        content,
        bytes_per_vector,
    };
    vec![binding(0, "read", input), binding(1, "write", output)]
}

fn spirv_files(folder: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| format!("reading {}", folder.display()))? {
        names.push(entry?.file_name().to_string_lossy().into_owned());
    }
    Ok(names)
}

fn compare(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<()> {
    let mut differing: Vec<String> =
        spirv_files(folder)?.into_iter().filter(|name| !files.contains_key(name)).collect();
    for (name, content) in files {
        if fs::read(folder.join(name)).ok().as_ref() != Some(content) {
            differing.push(name.clone());
        }
    }
    ensure!(
        differing.is_empty(),
        "{} files in spirv/ differ from a fresh build; `cargo xtask spirv` rewrites them: {}",
        differing.len(),
        differing.join(", ")
    );
    println!("spirv: {} files reproduced byte for byte", files.len());
    Ok(())
}

/// Writes the files, then removes modules that are no longer built.
fn replace(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<()> {
    fs::create_dir_all(folder)?;
    for (name, content) in files {
        output::write_file(&folder.join(name), content)?;
    }
    for name in spirv_files(folder)?.into_iter().filter(|name| !files.contains_key(name)) {
        fs::remove_file(folder.join(&name)).with_context(|| format!("removing spirv/{name}"))?;
    }
    println!("spirv: {} files written", files.len());
    Ok(())
}
