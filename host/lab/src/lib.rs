//! Measures the codecs of `unitvec`.
//!
//! * [`accuracy`]: errors, beside the survey's tables.
//! * [`bench`](mod@bench): costs on a device. [`isa`]: the kernels as compilers of GPUs translate them.
//! * [`textbook`]: functions that people commonly write today, for comparison.
//! * [`imprecise`]: the codecs on devices that round as loosely as Vulkan allows.

#![deny(unsafe_code)]

pub mod accuracy;
pub mod bench;
mod error;
pub mod imprecise;
pub mod isa;
pub mod textbook;

pub use error::{Error, Result};
