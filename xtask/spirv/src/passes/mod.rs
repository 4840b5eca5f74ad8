//! From rust-gpu's modules to those that are shipped.
//!
//! Each kernel gets a specialization constant for its division, and NoContraction on every float result, and is optimised;
//! branches become selects, some instructions one, and
//! loops end at their condition; then the kernels of a codec join in one module, which is optimised once more. The functions
//! of the library are made likewise of entry points, and join in one module that exports them.

mod blocks;
mod combine;
mod decorate;
mod divide;
mod exit;
mod export;
mod features;
mod globals;
mod join;
mod select;
#[cfg(test)]
mod snippet;

use anyhow::{Context, Result, anyhow};
use rayon::prelude::*;
use rspirv::binary::Assemble;
use rspirv::dr::Module;
use spirv_tools::opt::{Optimizer, Passes};
use spirv_tools::val::Validator;
use spirv_tools::{TargetEnv, opt, val};
use unitvec_link::Signature;

pub use divide::FAST;

const ENVIRONMENT: TargetEnv = TargetEnv::Vulkan_1_1;

/// Vulkan takes no module with linkage.
const LIBRARY_ENVIRONMENT: TargetEnv = TargetEnv::Universal_1_3;

/// One module of kernels that are compiled each to a module of its own, with these names for entry points.
pub fn run(kernels: Vec<(String, Vec<u32>)>) -> Result<Vec<u32>> {
    let kernels =
        kernels.iter().map(|(name, words)| kernel(name, words, false).with_context(|| name.clone()));
    let module = join::join(kernels.collect::<Result<_>>()?)?;
    let words = optimize(&module.assemble())?;
    decorate::check_no_contraction(&parse(&words)?)?;
    val::create(Some(ENVIRONMENT)).validate(&words, None).context("spirv-val")?;
    Ok(words)
}

/// The library of functions that are compiled each as the entry point of a module.
pub fn library(functions: Vec<(Signature, Vec<u32>)>) -> Result<Vec<u32>> {
    let functions = functions.into_par_iter().map(|(signature, words)| {
        let named = || signature.name.clone();
        let mut module = kernel("function", &words, true).with_context(named)?;
        export::function(&mut module).with_context(named)?;
        Ok((signature, module))
    });
    let library = export::library(functions.collect::<Result<_>>()?)?;
    let mut optimizer = opt::create(Some(LIBRARY_ENVIRONMENT));
    optimizer.register_pass(Passes::EliminateDeadConstant).register_pass(Passes::CompactIds);
    let words = optimized(&optimizer, &library.assemble())?;
    decorate::check_no_contraction(&parse(&words)?)?;
    val::create(Some(LIBRARY_ENVIRONMENT)).validate(&words, None).context("spirv-val")?;
    Ok(words)
}

fn kernel(name: &str, words: &[u32], is_library: bool) -> Result<Module> {
    let mut module = parse(words)?;
    join::name_entry_point(&mut module, name)?;
    features::remove(&mut module);
    divide::choose(&mut module, is_library)?;
    decorate::no_contraction(&mut module);
    let mut module = parse(&optimize(&module.assemble())?)?;
    while divide::fold(&mut module)? {
        module = parse(&optimize(&module.assemble())?)?;
    }
    select::for_branches(&mut module)?;
    combine::instructions(&mut module)?;
    exit::at_conditions(&mut module);
    Ok(module)
}

fn parse(words: &[u32]) -> Result<Module> {
    rspirv::dr::load_words(words).map_err(|error| anyhow!("rspirv cannot parse the module: {error}"))
}

fn optimize(words: &[u32]) -> Result<Vec<u32>> {
    let mut optimizer = opt::create(Some(ENVIRONMENT));
    optimizer
        .register_performance_passes()
        .register_pass(Passes::StripDebugInfo)
        .register_pass(Passes::StripNonSemanticInfo)
        .register_pass(Passes::EliminateDeadConstant)
        .register_pass(Passes::CompactIds);
    optimized(&optimizer, words)
}

fn optimized(optimizer: &impl Optimizer, words: &[u32]) -> Result<Vec<u32>> {
    let mut print = |message| eprintln!("spirv-opt: {message:?}");
    let optimized = optimizer.optimize(words, &mut print, None).context("spirv-opt")?;
    Ok(optimized.as_words().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rspirv::spirv::Op;

    /// Two kernels with a branch each become one module without one.
    #[test]
    fn kernels_become_one_valid_module() {
        let lines =
            snippet::one_arm("%11 = OpFAdd %float %7 %f1", "%12 = OpPhi %float %7 %5 %11 %21 OpStore %6 %12");
        let words = snippet::module(&lines).assemble();
        let module = run(vec![("encode".to_owned(), words.clone()), ("decode".to_owned(), words)]).unwrap();
        let module = parse(&module).unwrap();
        assert_eq!(module.entry_points.len(), 2);
        let kernels = module.functions.iter().map(|function| function.blocks.len());
        assert_eq!(kernels.collect::<Vec<_>>(), [1, 1]);
        let opcodes = snippet::opcodes(&module);
        assert_eq!(opcodes.iter().filter(|opcode| **opcode == Op::Select).count(), 2);
    }

    #[test]
    fn errors_name_the_kernel() {
        let error = run(vec![("oct16_encode".to_owned(), vec![0; 5])]).unwrap_err();
        assert!(format!("{error:#}").starts_with("oct16_encode: rspirv cannot parse"), "{error:#}");
    }
}
