//! Runs the codecs of `unitvec` on the CPU and on Vulkan devices, and shows that they agree.
//!
//! * [`backend`]: the ways to run a codec, behind one trait. Kernels can be rewritten before they run.
//! * [`glsl`] and [`shader`]: kernels from GLSL, and from the shading languages made of it.
//! * [`conform`]: shows that the backends agree. [`sampling`] and [`measure`] make its inputs and errors.
//! * [`workers`]: the threads that codecs run on.

#![deny(unsafe_code)]

pub mod backend;
pub mod conform;
mod error;
pub mod glsl;
pub mod measure;
pub mod sampling;
pub mod shader;
pub mod workers;

pub use error::{Error, Result};
