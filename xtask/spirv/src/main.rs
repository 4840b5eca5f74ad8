//! `cargo xtask spirv [--check]`: builds `spirv/*.spv` and their manifest from `shader-crate` with rust-gpu.
//!
//! rust-gpu's own optimiser run folds chains of float operations, so it is turned off; the modules get NoContraction
//! on every float result first and are optimised after that, before and after branches become selects.

mod blocks;
mod decorate;
mod exit;
mod select;

use anyhow::{Context, Result, anyhow, bail, ensure};
use cargo_gpu_install::install::Install;
use cargo_gpu_install::spirv_builder::ModuleResult;
use rayon::prelude::*;
use rspirv::binary::Assemble;
use spirv_tools::opt::{Optimizer, Passes};
use spirv_tools::val::Validator;
use spirv_tools::{TargetEnv, opt, val};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};
use unitvec_host::catalogue::{Element, Format, Operation, best_fit_table, formats};
use unitvec_host::manifest::{self, Binding, Manifest, Module, PushConstant, Table};
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

/// Paths in `spirv/` and contents of its files, manifests included.
fn build(repository: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let table: Vec<u8> = best_fit_table().iter().flat_map(|word| word.to_le_bytes()).collect();
    let tables = vec![Table {
        file: manifest::BEST_FIT_TABLE.to_owned(),
        layout: "words of four lengths of one byte, the best alone lowest; column and row are 640 mid / max and 640 min / max \
                 of a direction's magnitudes, rounded down; word 4 (g (2 g + 1) + row) + column, g = column / 4 rounded \
                 down; to be bound as u32 words, little endian"
            .to_owned(),
        sha256: manifest::sha256_hex(&table),
    }];
    let mut files = BTreeMap::from([(manifest::BEST_FIT_TABLE.to_owned(), table)]);
    let (mut modules, mut cost_modules) = (Vec::new(), Vec::new());
    let compiled = compile(repository)?;
    eprintln!("spirv: optimising {} modules", compiled.len());
    let finished = compiled.into_par_iter().map(|(entry_point, path)| {
        let words = finish(&read_words(&path)?).with_context(|| format!("entry point {entry_point}"))?;
        let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        Ok((entry_point, bytes))
    });
    for (entry_point, bytes) in finished.collect::<Result<BTreeMap<String, Vec<u8>>>>()? {
        if let Some(kernel) = cost_kernel(&entry_point) {
            let module = describe_cost(&kernel, &entry_point, &bytes)?;
            files.insert(format!("{}/{}", manifest::COST_FOLDER, module.file), bytes);
            cost_modules.push(module);
        } else {
            let module = describe(&entry_point, &bytes)?;
            files.insert(module.file.clone(), bytes);
            modules.push(module);
        }
    }
    let kernels = 2 * formats().count();
    ensure!(modules.len() == kernels + 1, "{} modules for {} codecs", modules.len(), formats().count());
    ensure!(cost_modules.len() == kernels + 2, "{} cost modules", cost_modules.len());
    let sources_sha256 = manifest::sources_sha256(repository)?;
    let cost_manifest = format!("{}/{}", manifest::COST_FOLDER, manifest::FILE_NAME);
    for (name, modules, tables) in
        [(manifest::FILE_NAME.to_owned(), modules, tables), (cost_manifest, cost_modules, Vec::new())]
    {
        let manifest = Manifest {
            rust_gpu: RUST_GPU.to_owned(),
            target: TARGET.to_owned(),
            sources_sha256: sources_sha256.clone(),
            modules,
            tables,
        };
        files.insert(name, (serde_json::to_string_pretty(&manifest)? + "\n").into_bytes());
    }
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

/// Decorates, flattens, optimises and validates a module.
fn finish(words: &[u32]) -> Result<Vec<u32>> {
    let mut module = parse(words)?;
    decorate::no_contraction(&mut module);
    let mut module = parse(&optimize(&module.assemble())?)?;
    select::for_branches(&mut module)?;
    exit::at_conditions(&mut module);
    let words = optimize(&module.assemble())?;
    decorate::check_no_contraction(&parse(&words)?)?;
    val::create(Some(TargetEnv::Vulkan_1_2)).validate(&words, None).context("spirv-val")?;
    Ok(words)
}

fn parse(words: &[u32]) -> Result<rspirv::dr::Module> {
    rspirv::dr::load_words(words).map_err(|error| anyhow!("rspirv cannot parse the module: {error}"))
}

fn optimize(words: &[u32]) -> Result<Vec<u32>> {
    let mut optimizer = opt::create(Some(TargetEnv::Vulkan_1_2));
    optimizer
        .register_performance_passes()
        .register_pass(Passes::StripDebugInfo)
        .register_pass(Passes::StripNonSemanticInfo)
        .register_pass(Passes::EliminateDeadConstant)
        .register_pass(Passes::CompactIds);
    let mut print = |message| eprintln!("spirv-opt: {message:?}");
    let optimized = optimizer.optimize(words, &mut print, None).context("spirv-opt")?;
    Ok(optimized.as_words().to_vec())
}

/// `oct16_encode` of `kernels::oct16::encode_cost`, the entry point that measures it; `None` of others.
fn cost_kernel(entry_point: &str) -> Option<String> {
    let (module, direction) = entry_point.strip_suffix("_cost")?.rsplit_once("::")?;
    let codec = module.rsplit("::").next()?;
    Some(format!("{codec}_{direction}"))
}

fn find_kernel(kernel: &str) -> Option<(Format, Operation)> {
    formats()
        .flat_map(|codec| [(codec, Operation::Encode), (codec, Operation::Decode)])
        .find(|(codec, direction)| codec.function(*direction) == kernel)
}

fn describe(entry_point: &str, bytes: &[u8]) -> Result<Module> {
    let (codec, direction, bindings) = if entry_point == manifest::DECODE_BY_TABLE {
        let mut bindings = bindings(2, Element::Vector, Operation::Decode);
        let content = "table: the decoded vectors, of three f32, of the codes 0 to 65535";
        bindings.push(Binding { content: content.to_owned(), ..table_binding() });
        (None, Operation::Decode, bindings)
    } else {
        let (codec, direction) = find_kernel(entry_point)
            .with_context(|| format!("entry point {entry_point} belongs to no codec of the catalogue"))?;
        let mut bindings = bindings(codec.bytes, codec.element, direction);
        if codec.encodes_by_table && direction == Operation::Encode {
            bindings.push(Binding { table: Some(manifest::BEST_FIT_TABLE.to_owned()), ..table_binding() });
        }
        (Some(codec.id.to_owned()), direction, bindings)
    };
    Ok(Module {
        file: format!("{entry_point}.spv"),
        codec,
        direction,
        entry_point: entry_point.to_owned(),
        workgroup_size: [64, 1, 1],
        vectors_per_invocation: 4,
        bindings,
        push_constants: vec![constant(0, "number of vectors")],
        sha256: manifest::sha256_hex(bytes),
    })
}

fn describe_cost(kernel: &str, entry_point: &str, bytes: &[u8]) -> Result<Module> {
    let is_baseline = kernel.starts_with("baseline_");
    let codec = find_kernel(kernel).map(|(codec, _)| codec);
    ensure!(is_baseline || codec.is_some(), "cost kernel {kernel} belongs to no codec of the catalogue");
    let direction = if kernel.ends_with("_encode") { Operation::Encode } else { Operation::Decode };
    let input = match direction {
        Operation::Encode => "three f32 a vector, packed",
        Operation::Decode => "codes of three words, of which the first two count",
    };
    let mut bindings =
        vec![binding(0, "read", input, Some(12)), binding(1, "write", "sum of the results", Some(4))];
    if direction == Operation::Encode && codec.is_some_and(|codec| codec.encodes_by_table) {
        bindings.push(Binding { table: Some(manifest::BEST_FIT_TABLE.to_owned()), ..table_binding() });
    }
    Ok(Module {
        file: format!("{kernel}.spv"),
        codec: codec.map(|codec| codec.id.to_owned()),
        direction,
        entry_point: entry_point.to_owned(),
        workgroup_size: [64, 1, 1],
        vectors_per_invocation: 1,
        bindings,
        push_constants: vec![constant(0, "number of vectors"), constant(4, "repetitions of each")],
        sha256: manifest::sha256_hex(bytes),
    })
}

fn constant(offset: u32, content: &str) -> PushConstant {
    PushConstant { offset, r#type: "u32".to_owned(), content: content.to_owned() }
}

fn bindings(code_bytes: usize, element: Element, direction: Operation) -> Vec<Binding> {
    let content = match element {
        Element::Vector => "three f32 a vector, packed",
        Element::Frame => "seven f32 a frame (normal, tangent, handedness), packed",
    };
    let elements = (content, element.bytes() as u32);
    let codes = ("codes, little endian, packed", code_bytes as u32);
    let ((read, read_bytes), (written, written_bytes)) = match direction {
        Operation::Encode => (elements, codes),
        Operation::Decode => (codes, elements),
    };
    vec![binding(0, "read", read, Some(read_bytes)), binding(1, "write", written, Some(written_bytes))]
}

fn table_binding() -> Binding {
    binding(2, "read", "table", None)
}

fn binding(binding: u32, access: &str, content: &str, bytes_per_vector: Option<u32>) -> Binding {
    Binding { binding, access: access.to_owned(), content: content.to_owned(), bytes_per_vector, table: None }
}

/// Paths, in the folder, of the files in it and in the folder of cost kernels.
fn spirv_files(folder: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for part in ["", manifest::COST_FOLDER] {
        let folder = folder.join(part);
        for entry in fs::read_dir(&folder).with_context(|| format!("reading {}", folder.display()))? {
            let entry = entry?;
            if entry.file_type()?.is_file() {
                let path = Path::new(part).join(entry.file_name());
                names.push(path.to_string_lossy().into_owned());
            }
        }
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
    fs::create_dir_all(folder.join(manifest::COST_FOLDER))?;
    for (name, content) in files {
        output::write_file(&folder.join(name), content)?;
    }
    for name in spirv_files(folder)?.into_iter().filter(|name| !files.contains_key(name)) {
        fs::remove_file(folder.join(&name)).with_context(|| format!("removing spirv/{name}"))?;
    }
    println!("spirv: {} files written", files.len());
    Ok(())
}
