use crate::{glsl, shader};
use std::error::Error as StdError;
use unitvec_manifest::modules;

/// A result with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error of a backend. Each message is one line that names the thing and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The codec is unknown.
    #[error(transparent)]
    UnknownCodec(#[from] unitvec_catalogue::UnknownCodec),
    /// A slice function was given the wrong sizes.
    #[error(transparent)]
    LengthMismatch(#[from] unitvec::slice::LengthMismatch),
    /// A Vulkan call failed, or the device lacks something.
    #[error(transparent)]
    Vulkan(#[from] unitvec_vulkan::Error),
    /// A SPIR-V module cannot be used.
    #[error(transparent)]
    Modules(#[from] modules::Error),
    /// GLSL does not compile.
    #[error(transparent)]
    Glsl(#[from] glsl::Error),
    /// A kernel in another shading language does not compile.
    #[error(transparent)]
    Shader(#[from] shader::Error),
    /// A kernel's module cannot be [rewritten](crate::backend::Rewrite).
    #[error(transparent)]
    Rewrite(Box<dyn StdError + Send + Sync>),
}

/// Implements `From` for errors that an error type passes on in a variant, whose own `From` takes them.
#[macro_export]
macro_rules! pass_on_errors {
    ($own:ident::$variant:ident: $($error:ty),* $(,)?) => {$(
        impl From<$error> for $own {
            fn from(error: $error) -> Self {
                Self::$variant(error.into())
            }
        }
    )*};
}

impl Error {
    /// True where the command line is at fault: an unknown codec or device.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::UnknownCodec(_) | Self::Vulkan(unitvec_vulkan::Error::UnknownDevice { .. }))
    }
}
