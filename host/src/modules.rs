//! The SPIR-V modules that the kernels run from: those inside the program, or a folder of them.

use crate::manifest::{self, Manifest};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A folder of modules with its manifest.
pub struct Modules {
    folder: Folder,
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
    /// The manifest has no module for this kernel, or no such table.
    #[error("the manifest in {} does not list {kernel}; `cargo xtask spirv` rebuilds it", .folder.display())]
    NotListed {
        /// The manifest's folder.
        folder: PathBuf,
        /// Kernel sought, `oct16_encode`, or a table's file.
        kernel: String,
    },
}

impl Modules {
    /// The modules in `folder`, or those inside the program.
    ///
    /// # Errors
    /// [`Error::Missing`] or [`Error::BadManifest`].
    pub fn open(folder: Option<&Path>) -> Result<Self, Error> {
        Self::open_part(folder, "")
    }

    /// The kernels that measure arithmetic, of the modules in `folder` or of those inside the program.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_cost(folder: Option<&Path>) -> Result<Self, Error> {
        Self::open_part(folder, manifest::COST_FOLDER)
    }

    fn open_part(folder: Option<&Path>, part: &'static str) -> Result<Self, Error> {
        let folder = Folder { root: folder.map(Path::to_owned), part };
        let text = folder.read(manifest::FILE_NAME)?;
        let manifest = serde_json::from_slice(&text).map_err(|error| Error::BadManifest {
            path: folder.shown(manifest::FILE_NAME),
            reason: error.to_string(),
        })?;
        Ok(Self { folder, manifest })
    }

    /// What the modules are.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The module of a kernel, `oct16_encode`, once its SHA-256 is found to be the manifest's, and its entry point.
    ///
    /// # Errors
    /// [`Error::NotListed`], [`Error::Missing`] or [`Error::Corrupted`].
    pub fn load(&self, kernel: &str) -> Result<(Cow<'static, [u8]>, &str), Error> {
        let file = format!("{kernel}.spv");
        let module =
            self.manifest.modules.iter().find(|module| module.file == file).ok_or_else(|| {
                Error::NotListed { folder: self.folder.shown(""), kernel: kernel.to_owned() }
            })?;
        Ok((self.folder.read_checked(&file, &module.sha256)?, &module.entry_point))
    }

    /// A table, once its SHA-256 is found to be the manifest's.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn table(&self, file: &str) -> Result<Cow<'static, [u8]>, Error> {
        let table = self
            .manifest
            .tables
            .iter()
            .find(|table| table.file == file)
            .ok_or_else(|| Error::NotListed { folder: self.folder.shown(""), kernel: file.to_owned() })?;
        self.folder.read_checked(file, &table.sha256)
    }
}

/// A part of a folder of modules; without a root, of the one inside the program.
struct Folder {
    root: Option<PathBuf>,
    part: &'static str,
}

impl Folder {
    fn read(&self, file: &str) -> Result<Cow<'static, [u8]>, Error> {
        let content = match &self.root {
            Some(root) => fs::read(root.join(self.part).join(file)).map(Cow::Owned),
            None => {
                let path =
                    if self.part.is_empty() { file.to_owned() } else { format!("{}/{file}", self.part) };
                unitvec_shaders::spirv(&path).map(Cow::Borrowed).ok_or_else(|| io::ErrorKind::NotFound.into())
            }
        };
        content.map_err(|source| Error::Missing { path: self.shown(file), source })
    }

    fn read_checked(&self, file: &str, sha256: &str) -> Result<Cow<'static, [u8]>, Error> {
        let bytes = self.read(file)?;
        if manifest::sha256_hex(&bytes) == sha256 {
            Ok(bytes)
        } else {
            Err(Error::Corrupted { path: self.shown(file) })
        }
    }

    /// The path that messages give for a file; `spirv` for the folder inside the program.
    fn shown(&self, file: &str) -> PathBuf {
        self.root.as_deref().unwrap_or(Path::new("spirv")).join(self.part).join(file)
    }
}
