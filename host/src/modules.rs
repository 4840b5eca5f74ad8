//! The SPIR-V modules that the kernels run from: those inside the program, or a folder of them.

use crate::catalogue::{CodecInfo, Direction};
use crate::manifest::{self, Manifest};
use include_dir::{Dir, include_dir};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::{fs, io};

static EMBEDDED: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../spirv");

/// A folder of modules with its manifest.
pub struct Modules {
    folder: Option<PathBuf>,
    manifest: Manifest,
}

/// A folder of modules that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read.
    #[error("SPIR-V module file {} cannot be read ({source}); `cargo xtask spirv` builds it", .path.display())]
    Missing {
        /// Its path.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// The manifest is not one.
    #[error("{} is not a manifest of SPIR-V modules ({reason}); `cargo xtask spirv` builds it", .path.display())]
    BadManifest {
        /// Its path.
        path: PathBuf,
        /// What the parser says.
        reason: String,
    },
    /// A file is not the one that the manifest describes.
    #[error(
        "SPIR-V module file {} is corrupted: its SHA-256 is not the manifest's; `cargo xtask spirv` rebuilds it",
        .path.display()
    )]
    Corrupted {
        /// Its path.
        path: PathBuf,
    },
    /// The manifest has no module for this kernel.
    #[error("the manifest in {} lists no module for {kernel}; `cargo xtask spirv` rebuilds it", .folder.display())]
    NotListed {
        /// The manifest's folder.
        folder: PathBuf,
        /// Kernel sought: `oct16_encode`.
        kernel: String,
    },
}

impl Modules {
    /// The modules in `folder`, or those inside the program.
    ///
    /// # Errors
    /// [`Error::Missing`] or [`Error::BadManifest`].
    pub fn open(folder: Option<&Path>) -> Result<Self, Error> {
        let folder = folder.map(Path::to_owned);
        let path = shown(folder.as_deref(), manifest::FILE_NAME);
        let text = read(folder.as_deref(), manifest::FILE_NAME)?;
        let manifest = serde_json::from_slice(&text)
            .map_err(|error| Error::BadManifest { path, reason: error.to_string() })?;
        Ok(Self { folder, manifest })
    }

    /// What the modules are.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The module of a kernel, once its SHA-256 is found to be the manifest's.
    ///
    /// # Errors
    /// [`Error::NotListed`], [`Error::Missing`] or [`Error::Corrupted`].
    pub fn load(&self, codec: &CodecInfo, direction: Direction) -> Result<Cow<'static, [u8]>, Error> {
        let module = self
            .manifest
            .modules
            .iter()
            .find(|module| module.codec == codec.id && module.direction == direction)
            .ok_or_else(|| Error::NotListed {
                folder: shown(self.folder.as_deref(), ""),
                kernel: codec.function(direction),
            })?;
        let bytes = read(self.folder.as_deref(), &module.file)?;
        if manifest::sha256_hex(&bytes) != module.sha256 {
            return Err(Error::Corrupted { path: shown(self.folder.as_deref(), &module.file) });
        }
        Ok(bytes)
    }
}

fn read(folder: Option<&Path>, file: &str) -> Result<Cow<'static, [u8]>, Error> {
    let content = match folder {
        Some(folder) => fs::read(folder.join(file)).map(Cow::Owned),
        None => EMBEDDED
            .get_file(file)
            .map(|file| Cow::Borrowed(file.contents()))
            .ok_or_else(|| io::ErrorKind::NotFound.into()),
    };
    content.map_err(|source| Error::Missing { path: shown(folder, file), source })
}

/// The path that messages give for a file of this folder; `spirv` for the one inside the program.
fn shown(folder: Option<&Path>, file: &str) -> PathBuf {
    folder.unwrap_or(Path::new("spirv")).join(file)
}
