//! What is compiled.

use crate::Result;
use crate::cases::Case;
use unitvec_host::shader::{Language, kernel};

/// A text to compile, and the case that it is for.
pub struct Job<'a> {
    pub case: &'a Case,
    pub text: String,
}

/// What takes the words that a case gave, or what went wrong.
pub type Each<'a> = &'a mut dyn FnMut(&Case, Result<Vec<u32>>) -> Result<()>;

/// Editions of a language's functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Edition {
    Plain,
    Exact,
}

impl std::fmt::Display for Edition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Plain => "plain",
            Self::Exact => "exact",
        })
    }
}

/// Whole shaders, one of each case: the codec's text as people get it, and a kernel.
pub fn jobs(cases: &[Case], language: Language, edition: Edition) -> Result<Vec<Job<'_>>> {
    cases.iter().map(|case| Ok(Job { case, text: text(case, language, edition)? })).collect()
}

fn text(case: &Case, language: Language, edition: Edition) -> Result<String> {
    let functions = functions(case, language, edition)?;
    let kernel = kernel::kernel(language, case.format, case.operation);
    Ok(format!("{}{functions}{kernel}", kernel::head(language).unwrap_or_default()))
}

/// The functions of a codec.
pub fn functions(_case: &Case, language: Language, edition: Edition) -> Result<String> {
    let folder = std::env::var("UNITVEC_TRIAL").unwrap_or_default();
    let path = format!("{folder}/{language:?}.{edition}").to_lowercase();
    Ok(std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}")))
}
