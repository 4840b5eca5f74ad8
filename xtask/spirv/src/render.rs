//! The renderer's modules, from `host/render/shaders/rust`.

use crate::compile::Compiler;
use crate::{bytes, passes};
use anyhow::{Context, Result, ensure};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use unitvec_catalogue::directions;

/// Where they lie.
pub const FOLDER: &str = "host/render/shaders/spirv";

/// The shaders of a module, in their order; also the features of the crate.
const PASSES: [&str; 3] = ["vertex", "gbuffer", "light"];

/// Names in [`FOLDER`] and contents of its files.
pub fn build(repository: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let compiler = Compiler::install(repository.join("host/render/shaders/rust"))?;
    let mut modules: BTreeMap<String, Vec<(String, Vec<u32>)>> = BTreeMap::new();
    for pass in PASSES {
        for (name, words) in compiler.named(pass)? {
            let id = name.strip_suffix(pass).and_then(|id| id.strip_suffix('_'));
            let id = id.with_context(|| format!("the entry point {name} is not called after its pass"))?;
            modules.entry(id.to_owned()).or_default().push((name.clone(), words));
        }
    }
    for codec in directions() {
        ensure!(modules.contains_key(codec.id), "no render shaders for {}", codec.id);
    }
    eprintln!("spirv: optimising {} modules of render shaders", modules.len());
    let finished = modules.into_par_iter().map(|(id, shaders)| {
        let words = passes::run(shaders).with_context(|| id.clone())?;
        Ok((format!("{id}.spv"), bytes(&words)))
    });
    finished.collect()
}
