use crate::isa::stand_in;
use unitvec_catalogue::UnknownCodec;
use unitvec_manifest::modules;
use unitvec_run::glsl;

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of a measurement. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A backend failed.
    #[error(transparent)]
    Run(#[from] unitvec_run::Error),
    /// Recorded costs cannot be read.
    #[error(transparent)]
    Choose(#[from] unitvec_choose::Error),
    /// A compiler for a GPU cannot be had.
    #[error(transparent)]
    StandIn(#[from] stand_in::Error),
    /// A kernel cannot be linked with the functions from Rust.
    #[error("kernels from Rust are linked, and cannot be: {0}")]
    Link(#[from] unitvec_link::Error),
    /// There are no kernels to run on imprecise devices.
    #[error("no kernels to rewrite: give some source of kernels")]
    NoKernels,
}

unitvec_run::pass_on_errors!(Error::Run: UnknownCodec, unitvec::slice::LengthMismatch, unitvec_vulkan::Error, modules::Error, glsl::Error);
