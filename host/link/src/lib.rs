//! Links an engine's SPIR-V with the library of all codecs' functions, [`LIBRARY`].
//!
//! No front-end declares functions of another module. So a shader includes [stubs](stubs::text), functions without a meaning,
//! and calls those; [`imports`] turns the calls into calls of imported functions, and [`link`] resolves them by the tools
//! of SPIRV-Tools.

mod imports;
mod library;
mod signature;
pub mod stubs;
mod tools;
mod words;

pub use signature::{Signature, Type};
use std::io;
pub use tools::link;
use words::{Module, Op};

/// File of the library, in `spirv/`.
pub const LIBRARY: &str = "unitvec.spv";

/// A module that cannot be linked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file is no SPIR-V.
    #[error(
        "it is not SPIR-V ({reason}); compile the shader to SPIR-V first: docs/linking.md has the command lines"
    )]
    NotSpirv {
        /// Why not.
        reason: &'static str,
    },
    /// A version of SPIR-V that is not known.
    #[error("its version of SPIR-V, {major}.{minor}, is not one of 1.0 to 1.6; compile it for one of those")]
    Version {
        /// Version.
        major: u32,
        /// Version.
        minor: u32,
    },
    /// The module is not for graphics APIs.
    #[error(
        "its memory model is not one of shaders (addressing model {addressing}, memory model {memory}); compile it for Vulkan"
    )]
    MemoryModel {
        /// The number of the addressing model.
        addressing: u32,
        /// The number of the memory model.
        memory: u32,
    },
    /// The module calls nothing of the library.
    #[error(
        "it has no stubs of unitvec; include the stubs, call them, and compile with names and without inlining: docs/linking.md \
         has the command lines"
    )]
    NoStubs,
    /// The stubs do not say what version they are of.
    #[error(
        "its stubs do not say their version; include the file that `unitvec link --stubs` prints, unchanged"
    )]
    NoVersion,
    /// The stubs are of another version.
    #[error(
        "its stubs are of unitvec {found}, not {}; compile with those that `unitvec link --stubs` prints",
        stubs::VERSION
    )]
    OtherVersion {
        /// The version that the stubs state.
        found: String,
    },
    /// A stub has other types than its function.
    #[error(
        "its stub of {signature} has other types; include the file that `unitvec link --stubs` prints, unchanged"
    )]
    WrongTypes {
        /// The function, as GLSL declares it.
        signature: String,
    },
    /// The library is not in this program.
    #[error("this program was built without spirv/{LIBRARY}; `cargo xtask spirv` makes it")]
    NoLibrary,
    /// The library in this program is not what it should be.
    #[error("spirv/{LIBRARY} of this program {reason}; `cargo xtask spirv` makes it again, then build anew")]
    BadLibrary {
        /// The fault, in words.
        reason: String,
    },
    /// One of SPIRV-Tools' programs is not there.
    #[error("{tool} cannot be started ({source}); install the Vulkan SDK, or Debian's package spirv-tools")]
    NoTool {
        /// The tool's name.
        tool: &'static str,
        /// Cause.
        source: io::Error,
    },
    /// One of SPIRV-Tools' programs objects.
    #[error("{tool} refuses it: {said}; is it valid, and is {tool} as new as its compiler?")]
    Refused {
        /// The tool's name.
        tool: &'static str,
        /// The tool's message.
        said: String,
    },
    /// A temporary file cannot be used.
    #[error("no temporary file can be written or read: {0}; make room in the folder for temporary files")]
    Temporary(#[from] io::Error),
}

/// A module with calls of imported functions in place of those of stubs, and the names of the functions: for engines that
/// link by themselves.
///
/// # Errors
/// Every [`Error`] about modules.
pub fn imports(spirv: &[u8]) -> Result<(Vec<u8>, Vec<String>), Error> {
    let (module, names) = imports::imports(parse(spirv)?)?;
    Ok((module.bytes(), names))
}

fn parse(spirv: &[u8]) -> Result<Module, Error> {
    let module = Module::parse(spirv).map_err(|reason| Error::NotSpirv { reason })?;
    let [_, minor, major, other] = module.version.to_le_bytes();
    if major != 1 || minor > 6 || module.version & 0xff00_00ff != 0 || other != 0 {
        return Err(Error::Version { major: major.into(), minor: minor.into() });
    }
    memory_model(&module)?;
    Ok(module)
}

/// The addressing model and the memory model, if the library can have the same.
fn memory_model(module: &Module) -> Result<[u32; 2], Error> {
    const LOGICAL: u32 = 0;
    const PHYSICAL_STORAGE_BUFFER_64: u32 = 5348;
    const GLSL450: u32 = 1;
    const VULKAN: u32 = 3;
    match module.all(Op::MemoryModel).next().map(|model| model.operands) {
        Some([addressing @ (LOGICAL | PHYSICAL_STORAGE_BUFFER_64), memory @ (GLSL450 | VULKAN)]) => {
            Ok([*addressing, *memory])
        }
        Some([addressing, memory]) => Err(Error::MemoryModel { addressing: *addressing, memory: *memory }),
        _ => Err(Error::NotSpirv { reason: "it declares no memory model" }),
    }
}
