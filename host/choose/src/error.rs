use crate::costs::GENERATIONS;
use std::path::PathBuf;

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of choosing. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The mean errors cannot be measured.
    #[error(transparent)]
    Run(#[from] unitvec_run::Error),
    /// No costs on this GPU ship with the program.
    #[error("{}", unknown(.0))]
    UnknownGpu(String),
    /// Costs to choose by that are not a report of `unitvec bench`.
    #[error("{} is not a report of `unitvec bench --json`: {reason}", .path.display())]
    BadCosts {
        /// The file's path.
        path: PathBuf,
        /// The parser's message.
        reason: String,
    },
}

fn unknown(name: &str) -> String {
    let known = GENERATIONS.map(|generation| format!("{} ({})", generation.name, generation.gpu));
    format!(
        "no costs of a GPU `{name}` ship with the program; --gpu takes {} or lavapipe; --costs takes a report of another AMD \
         GPU, by `unitvec bench compiler --gpu {name} --json FILE`, or of a GPU that is here, by `unitvec bench compiler --device \
         NAME --json FILE`",
        known.join(", ")
    )
}
