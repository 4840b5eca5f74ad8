//! Files through the codecs of `unitvec`: the library of the program of that name.
//!
//! * [`input`] and [`stream`]: vectors, frames and codes of files, chunk by chunk.
//! * [`loss`]: errors over the vectors of files.

#![deny(unsafe_code)]

mod error;
pub mod input;
pub mod loss;
pub mod stream;

pub use error::{Error, Result};
