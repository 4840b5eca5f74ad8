//! Dithered functions by RADV's compiler for RDNA 2: `docs/data/dither_costs.json`, which docs/dither.md shows.
//!
//! The modules that ship have no kernels of dithered functions. These are of the GLSL, in `kernel.comp`, by glslang. They
//! have the form of the shipped kernels, whose costs are in `host/choose/data/`, so that both can be compared.

#[cfg(feature = "glsl")]
mod compiled;

use super::recorded;
use unitvec_choose::costs::Report;

const FILE: &str = "dither_costs.json";

/// The codecs that stand for the others.
pub const CODECS: [&str; 8] =
    ["oct16", "oct16p", "oct24", "oct24p", "hemioct16", "soct17", "eaoct16", "eaoct16p"];

/// The offset's source: nothing computes one that is `given`.
pub const GIVEN: &str = "given";

/// The functions that make offsets, by the names that the kernel has for them.
pub const KEYS: [&str; 4] = ["pixel", "key", "texel", "position"];

/// The codec that they are measured with.
pub const KEYED: &str = "oct16";

/// The identifier of a row: `oct16 dithered, pixel`.
pub fn row_id(codec: &str, key: &str) -> String {
    format!("{codec} dithered, {key}")
}

/// The committed figures.
pub fn committed() -> Report {
    recorded(FILE)
}
