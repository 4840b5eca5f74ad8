//! Files through the codecs of `unitvec`: the library of the program of that name.
//!
//! * [`input`] and [`stream`]: vectors, frames and codes of files, chunk by chunk.
//! * [`raw`]: raw floats of any kind, and NumPy's arrays.
//! * [`container`]: codes with a header.
//! * [`loss`]: errors over the vectors of files; [`fit`]: the formats that they are in.

#![deny(unsafe_code)]

pub mod container;
mod error;
pub mod fit;
pub mod input;
pub mod loss;
pub mod raw;
pub mod stream;

pub use error::{Error, Result};
