//! Jobs for the compilers.

use crate::cases::Case;
use crate::{Result, told, whole};
use unitvec_run::shader::{Edition, Language, kernel, text};

/// A text to compile, and the case that it is for.
pub struct Job<'a> {
    pub case: &'a Case,
    pub text: String,
}

/// Whole shaders, one of each case: the output of `unitvec shader` for the function, or all files, and a kernel.
pub fn jobs(cases: &[Case], language: Language, edition: Edition) -> Result<Vec<Job<'_>>> {
    let head = kernel::head(language).unwrap_or_default();
    let whole = |case: &Case| -> Result<String> {
        let functions = if case.has_all_files {
            whole::text(language, edition)?
        } else {
            let function = case.format.function(case.operation);
            text(&[function], language, edition, "unitvec shader").map_err(told)?
        };
        Ok(format!("{head}{functions}{}", kernel::kernel(language, case.format, case.operation)))
    };
    cases.iter().map(|case| Ok(Job { case, text: whole(case)? })).collect()
}
