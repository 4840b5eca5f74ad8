//! The SPIR-V modules that the kernels run from: those inside the program, or a folder of them.

use crate::manifest::{self, Manifest, Module};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A folder of modules with its manifest.
pub struct Modules {
    folder: Folder,
    /// In a box, since [`KernelSource`](crate::backend::KernelSource) has modules beside a compiler that is small.
    manifest: Box<Manifest>,
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
        let folder = Folder(folder.map(Path::to_owned));
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

    /// The module that has the kernel as an entry point, `oct16_encode`, once its SHA-256 is found to be the manifest's.
    ///
    /// # Errors
    /// [`Error::NotListed`], [`Error::Missing`] or [`Error::Corrupted`].
    pub fn load(&self, kernel: &str) -> Result<Cow<'static, [u8]>, Error> {
        let has_kernel = |module: &&Module| module.entry_points.iter().any(|entry| entry.name == kernel);
        let module = self.manifest.modules.iter().find(has_kernel).ok_or_else(|| self.not_listed(kernel))?;
        self.folder.read_checked(&module.file, &module.sha256)
    }

    /// A table, once its SHA-256 is found to be the manifest's.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn table(&self, file: &str) -> Result<Cow<'static, [u8]>, Error> {
        let table = self.manifest.tables.iter().find(|table| table.file == file);
        self.folder.read_checked(file, &table.ok_or_else(|| self.not_listed(file))?.sha256)
    }

    fn not_listed(&self, name: &str) -> Error {
        Error::NotListed { folder: self.folder.shown(""), kernel: name.to_owned() }
    }
}

/// A folder of modules; without a path, the one inside the program.
struct Folder(Option<PathBuf>);

impl Folder {
    fn read(&self, file: &str) -> Result<Cow<'static, [u8]>, Error> {
        let content = match &self.0 {
            Some(folder) => fs::read(folder.join(file)).map(Cow::Owned),
            None => {
                unitvec_shaders::spirv(file).map(Cow::Borrowed).ok_or_else(|| io::ErrorKind::NotFound.into())
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
        self.0.as_deref().unwrap_or(Path::new("spirv")).join(file)
    }
}
