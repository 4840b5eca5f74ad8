use crate::MEASURED;
use crate::costs::{GENERATIONS, GPUS, Line};
use std::path::PathBuf;

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of choosing. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
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

/// Words in the names of other makers' GPUs.
const MAKERS: [(&str, &[&str]); 6] = [
    (
        "NVIDIA",
        &["nvidia", "geforce", "rtx", "gtx", "quadro", "turing", "ampere", "ada", "hopper", "blackwell"],
    ),
    ("Intel", &["intel", "arc", "iris", "uhd"]),
    ("Apple", &["apple", "m1", "m2", "m3", "m4", "m5"]),
    ("Qualcomm", &["qualcomm", "adreno"]),
    ("Arm", &["arm", "mali", "immortalis"]),
    ("Imagination", &["imagination", "powervr"]),
];

/// The maker of a GPU, if it is not AMD.
fn maker(name: &str) -> Option<&'static str> {
    let name = name.to_lowercase();
    let words: Vec<&str> = name.split(|c: char| !c.is_ascii_alphanumeric()).collect();
    // `rtx4090` is a word of `rtx`.
    let is_of = |(_, known): &&(_, &[&str])| {
        let is_known = |word: &&str| {
            known.contains(word) || known.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit()))
        };
        words.iter().any(is_known)
    };
    MAKERS.iter().find(is_of).map(|(maker, _)| *maker)
}

fn unknown(name: &str) -> String {
    let known = GENERATIONS.map(|one| format!("{} ({}: {})", one.name, one.gpu, one.series));
    let others = GPUS.iter().filter(|gpu| gpu.line != Line::Radeon);
    let others: Vec<String> =
        others.map(|gpu| format!("{} ({}: {})", gpu.name, gpu.title, gpu.series)).collect();
    let advice = match maker(name) {
        Some(maker) => format!(
            "name one near to {maker}'s, or measure yours by `unitvec bench device --device NAME --json FILE`, in a build with \
             --features glsl, and name the file after --costs"
        ),
        None => format!(
            "--costs takes a report of another AMD GPU, by `unitvec bench compiler --gpu {name} --json FILE`, or of a GPU that is \
             here, by `unitvec bench compiler --device NAME --json FILE`"
        ),
    };
    format!(
        "no costs of a GPU `{name}` ship with the program; --gpu takes {}, {}, {}; {advice}",
        known.join(", "),
        others.join(", "),
        measured()
    )
}

/// The devices that were measured: `H200 or lavapipe`.
fn measured() -> String {
    MEASURED.map(|(name, _)| name).join(" or ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_makers_are_known_and_amd_is_none() {
        for (name, of) in [
            ("RTX 4090", Some("NVIDIA")),
            ("rtx4090", Some("NVIDIA")),
            ("intel arc a770", Some("Intel")),
            ("Apple M2", Some("Apple")),
            ("m3", Some("Apple")),
            ("mali-g610", Some("Arm")),
            ("Radeon RX 6800", None),
            ("FirePro M4000", None),
            ("vega10", None),
        ] {
            assert_eq!(maker(name), of, "{name}");
        }
    }
}
