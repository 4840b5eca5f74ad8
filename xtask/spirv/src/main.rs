//! `cargo xtask spirv [--check | --cost | --example]`: builds `spirv/` (modules, table and manifest) from `shader-crate` with
//! rust-gpu, and the modules of the renderer from `host/render/shaders`. `--render` leaves the former out. `--cost` builds the
//! kernels that measure arithmetic instead, into `target/spirv-cost`, where `unitvec bench` takes them.

mod compile;
mod describe;
mod example;
mod kernel;
mod passes;
mod render;

use anyhow::{Context, Result, bail, ensure};
use kernel::Kernel;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs};
use unitvec_catalogue::{CODECS, Operation, best_fit_table};
use unitvec_link as link;
use unitvec_manifest::{self as manifest, Manifest};

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
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let repository = here.ancestors().nth(2).context("xtask/spirv has no repository around it")?;
    let (mut check, mut only_render) = (false, false);
    for argument in env::args().skip(1) {
        match argument.as_str() {
            "--check" => check = true,
            "--render" => only_render = true,
            "--cost" => return replace(repository, COST_FOLDER, &cost_kernels(repository)?),
            "--example" => return example::check(repository),
            other => {
                bail!(
                    "unknown argument {other:?}; usage: cargo xtask spirv [--check] [--render] | --cost | --example"
                )
            }
        }
    }
    let finish = if check { compare } else { replace };
    if !only_render {
        finish(repository, "spirv", &build(repository)?)?;
    }
    finish(repository, render::FOLDER, &render::build(repository)?)?;
    if check && !only_render { example::check(repository) } else { Ok(()) }
}

/// Where the kernels lie that measure. They are not committed: they are built where somebody measures.
const COST_FOLDER: &str = "target/spirv-cost";

/// Names in [`COST_FOLDER`] and contents of its files: two kernels of every codec, and the two baselines.
fn cost_kernels(repository: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let compiler = compile::Compiler::install(repository.join("shader-crate"))?;
    let kernels = compiler.kernels(compile::COST_KERNELS)?;
    eprintln!("spirv: optimising {} kernels that measure", kernels.len());
    let files: BTreeMap<_, _> =
        modules(kernels)?.into_iter().map(|module| (module.file, module.bytes)).collect();
    let functions =
        CODECS.iter().flat_map(|format| Operation::ALL.map(|operation| format.function(operation)));
    let baselines = Operation::ALL.map(|operation| format!("baseline_{operation}"));
    for name in functions.chain(baselines) {
        ensure!(files.contains_key(&format!("{name}_cost.spv")), "no kernel measures {name}");
    }
    Ok(files)
}

/// Paths in `spirv/` and contents of its files, the manifest included.
fn build(repository: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let compiler = compile::Compiler::install(repository.join("shader-crate"))?;
    let kernels = compiler.kernels(compile::KERNELS)?;
    let codecs = CODECS.len();
    ensure!(kernels.len() == 2 * codecs + 2, "{} kernels for {codecs} codecs", kernels.len());
    eprintln!("spirv: optimising {} kernels", kernels.len());
    let modules = modules(kernels)?;
    let library = library(&compiler)?;

    let table = bytes(best_fit_table());
    let mut manifest = Manifest {
        schema: manifest::SCHEMA.to_owned(),
        vulkan: "1.1".to_owned(),
        spirv: "1.3".to_owned(),
        capabilities: vec!["Shader".to_owned()],
        features: Vec::new(),
        rust_gpu: compile::RUST_GPU.to_owned(),
        target: compile::TARGET.to_owned(),
        interfaces: BTreeMap::new(),
        library: describe::library(&library),
        modules: Vec::new(),
        tables: vec![describe::table(&table)],
    };
    let mut files = BTreeMap::from([
        (manifest::BEST_FIT_TABLE.to_owned(), table),
        (manifest::SCHEMA.to_owned(), manifest::schema().into_bytes()),
        (link::LIBRARY.to_owned(), library),
    ]);
    for Built { file, kernels, bytes } in modules {
        for (name, interface) in kernels.iter().map(describe::interface) {
            let named = manifest.interfaces.entry(name).or_insert_with(|| interface.clone());
            ensure!(*named == interface, "{file}: two interfaces have one name");
        }
        manifest.modules.push(describe::module(&file, &kernels, &bytes));
        files.insert(file, bytes);
    }
    let text = serde_json::to_string_pretty(&manifest)? + "\n";
    files.insert(manifest::FILE_NAME.to_owned(), text.into_bytes());
    Ok(files)
}

/// The module of all codecs' functions.
fn library(compiler: &compile::Compiler) -> Result<Vec<u8>> {
    let mut compiled = compiler.named(compile::LIBRARY)?;
    let mut functions = Vec::new();
    for (format, operation) in CODECS.iter().flat_map(|format| Operation::ALL.map(|each| (format, each))) {
        let name = format.function(operation);
        let words = compiled.remove(&name).with_context(|| format!("the library lacks {name}"))?;
        functions.push((link::Signature::of(format, operation), words));
    }
    ensure!(compiled.is_empty(), "{:?} belong to no codec of the catalogue", compiled.keys());
    eprintln!("spirv: optimising {} functions", functions.len());
    Ok(bytes(&passes::library(functions).context(link::LIBRARY)?))
}

/// The words of a module, or of a table, in its file.
fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// A module as it is shipped.
struct Built {
    /// Path in `spirv/`.
    file: String,
    /// Its kernels, the encoder first.
    kernels: Vec<Kernel>,
    bytes: Vec<u8>,
}

/// The modules of these kernels, by path.
fn modules(kernels: Vec<(Kernel, Vec<u32>)>) -> Result<Vec<Built>> {
    let mut parts: BTreeMap<String, Vec<(Kernel, Vec<u32>)>> = BTreeMap::new();
    for (kernel, words) in kernels {
        parts.entry(kernel.file()).or_default().push((kernel, words));
    }
    let finished = parts.into_par_iter().map(|(file, mut parts)| {
        parts.sort_by_key(|(kernel, _)| kernel.operation);
        let (kernels, modules): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
        let named = kernels.iter().map(|kernel| kernel.name.clone()).zip(modules);
        let words = passes::run(named.collect()).with_context(|| file.clone())?;
        Ok(Built { file, kernels, bytes: bytes(&words) })
    });
    finished.collect()
}

/// Paths, in `folder`, of the files in it and in the folders below, but for what says that they are generated.
fn files_in(folder: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| format!("reading {}", folder.display()))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type()?.is_dir() {
            names.extend(files_in(&entry.path())?.iter().map(|file| format!("{name}/{file}")));
        } else if name != "README.md" {
            names.push(name);
        }
    }
    Ok(names)
}

fn compare(repository: &Path, folder: &str, files: &BTreeMap<String, Vec<u8>>) -> Result<()> {
    let path = repository.join(folder);
    let mut differing: Vec<String> =
        files_in(&path)?.into_iter().filter(|name| !files.contains_key(name)).collect();
    for (name, content) in files {
        if fs::read(path.join(name)).ok().as_ref() != Some(content) {
            differing.push(name.clone());
        }
    }
    ensure!(
        differing.is_empty(),
        "{} files in {folder}/ differ from a fresh build; `cargo xtask spirv` rewrites them: {}",
        differing.len(),
        differing.join(", ")
    );
    println!("spirv: {} files of {folder}/ reproduced byte for byte", files.len());
    Ok(())
}

/// Writes the files, then removes all others.
fn replace(repository: &Path, folder: &str, files: &BTreeMap<String, Vec<u8>>) -> Result<()> {
    for (name, content) in files {
        let path = repository.join(folder).join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).with_context(|| format!("creating {}", parent.display()))?;
        }
        unitvec_files::write_file(&path, content)?;
    }
    let path = repository.join(folder);
    for name in files_in(&path)?.into_iter().filter(|name| !files.contains_key(name)) {
        fs::remove_file(path.join(&name)).with_context(|| format!("removing {folder}/{name}"))?;
    }
    let bytes: usize = files.values().map(Vec::len).sum();
    println!("spirv: {} files of {folder}/ written, {} KiB", files.len(), bytes / 1024);
    Ok(())
}
