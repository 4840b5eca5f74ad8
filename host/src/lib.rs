//! What runs the codecs of `unitvec`: the CPU, and any Vulkan device with the SPIR-V from Rust or from GLSL.
//!
//! * [`catalogue`]: all codecs by identifier, with their CPU functions.
//! * [`vulkan`]: devices, buffers, kernels; all `unsafe` is there.
//! * [`modules`] and [`glsl`]: where kernels come from; [`manifest`] describes the former.
//! * [`backend`]: the three ways to run a codec, behind one trait.
//! * [`conform`]: shows that they agree. [`sampling`] and [`measure`] make its inputs and errors.
//! * [`imprecise`]: what the codecs do on devices that round as badly as Vulkan allows.
//! * [`textbook`]: what people write today, to measure against.
//! * [`accuracy`]: errors, beside the survey's tables. [`bench`](mod@bench): costs. [`isa`]: what compilers make of the
//!   kernels. [`choose`]: what to take.
//! * [`render`]: a deferred renderer, and whether the codecs go through the graphics pipeline unchanged.
//! * [`figures`]: pictures of all that. [`report`]: a page of all that.
//! * [`loss`]: errors over the vectors of files.
//! * [`link`]: links shaders with the library of functions.
//! * [`input`], [`mesh`], [`stream`] and [`output`]: files in and out.

#![deny(unsafe_code)]

pub mod accuracy;
pub mod backend;
pub mod bench;
pub mod choose;
pub mod conform;
mod error;
pub mod figures;
pub mod glsl;
pub mod imprecise;
pub mod input;
pub mod isa;
pub mod link;
pub mod loss;
pub mod manifest;
pub mod measure;
pub mod mesh;
pub mod modules;
pub mod output;
pub mod render;
pub mod report;
pub mod sampling;
pub mod shader;
pub mod stream;
pub mod textbook;
pub mod vulkan;
mod workers;

pub use error::{Error, Result};
pub use unitvec_catalogue as catalogue;
