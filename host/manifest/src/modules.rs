//! The SPIR-V modules that the kernels run from: those inside the program, or a folder of them.
//!
//! Drivers take SPIR-V for valid, and may crash on what is not. So a folder's modules have to be those inside the program,
//! unless the caller trusts them; that its own manifest vouches for them says nothing of who wrote both.

use crate::{self as manifest, Manifest, Module, Table};
use std::borrow::Cow;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::OnceLock;
use unitvec_files::{one_line, read_start};

/// A folder of modules with its manifest.
pub struct Modules {
    folder: Folder,
    is_trusted: bool,
    /// In a box, so that modules are small to move.
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
    /// A kernel that measures cannot be read.
    #[error("kernel {} cannot be read ({source}); `cargo xtask spirv --cost` builds it", .path.display())]
    NoCostKernel {
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
    /// A file is not the one that is inside the program.
    #[error(
        "SPIR-V module file {} is not the program's: its SHA-256 differs; `cargo xtask spirv` rebuilds it, and --trust runs it \
         as it is",
        .path.display()
    )]
    Unknown {
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
    /// The modules in `folder`, as far as they are those inside the program; or the latter.
    ///
    /// # Errors
    /// [`Error::Missing`] or [`Error::BadManifest`].
    pub fn open(folder: Option<&Path>) -> Result<Self, Error> {
        Self::of(Folder(folder.map(Path::to_owned)), false)
    }

    /// The modules in `folder`, whatever they are. The caller answers for their validity.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_trusted(folder: &Path) -> Result<Self, Error> {
        Self::of(Folder(Some(folder.to_owned())), true)
    }

    fn of(folder: Folder, is_trusted: bool) -> Result<Self, Error> {
        let text = folder.read(manifest::FILE_NAME)?;
        let manifest = serde_json::from_slice(&text).map_err(|error| Error::BadManifest {
            path: folder.shown(manifest::FILE_NAME),
            reason: one_line(error),
        })?;
        Ok(Self { folder, is_trusted, manifest })
    }

    /// What the modules are.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The module that has the kernel as an entry point, `oct16_encode`, once it is found to be the program's.
    ///
    /// # Errors
    /// [`Error::NotListed`], [`Error::Missing`] or [`Error::Unknown`].
    pub fn load(&self, kernel: &str) -> Result<Cow<'static, [u8]>, Error> {
        let Module { file, .. } = self.module(kernel)?;
        self.read_checked(file, |program| Ok(&program.module(kernel)?.sha256))
    }

    /// A table, once it is found to be the program's.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn table(&self, file: &str) -> Result<Cow<'static, [u8]>, Error> {
        let Table { file, .. } = self.listed_table(file)?;
        self.read_checked(file, |program| Ok(&program.listed_table(file)?.sha256))
    }

    fn read_checked(
        &self,
        file: &str,
        sha256: impl FnOnce(&Self) -> Result<&String, Error>,
    ) -> Result<Cow<'static, [u8]>, Error> {
        let bytes = self.folder.read(file)?;
        let is_known = || Ok(manifest::sha256_hex(&bytes) == *sha256(Self::program()?)?);
        match self.is_trusted || is_known()? {
            true => Ok(bytes),
            false => Err(Error::Unknown { path: self.folder.shown(file) }),
        }
    }

    /// Those inside the program.
    fn program() -> Result<&'static Self, Error> {
        static PROGRAM: OnceLock<Modules> = OnceLock::new();
        match PROGRAM.get() {
            Some(modules) => Ok(modules),
            None => {
                let modules = Self::open(None)?;
                Ok(PROGRAM.get_or_init(|| modules))
            }
        }
    }

    fn module(&self, kernel: &str) -> Result<&Module, Error> {
        let has_kernel = |module: &&Module| module.entry_points.iter().any(|entry| entry.name == kernel);
        self.manifest.modules.iter().find(has_kernel).ok_or_else(|| self.not_listed(kernel))
    }

    fn listed_table(&self, file: &str) -> Result<&Table, Error> {
        self.manifest.tables.iter().find(|table| table.file == file).ok_or_else(|| self.not_listed(file))
    }

    fn not_listed(&self, name: &str) -> Error {
        Error::NotListed { folder: self.folder.shown(""), kernel: name.to_owned() }
    }
}

/// The kernel of this name that measures arithmetic, from a folder that `cargo xtask spirv --cost` wrote. The caller answers for
/// its validity.
///
/// # Errors
/// [`Error::NoCostKernel`].
pub fn cost_kernel(folder: &Path, name: &str) -> Result<Vec<u8>, Error> {
    let file = format!("{name}.spv");
    read_inside(folder, &file).map_err(|source| Error::NoCostKernel { path: folder.join(file), source })
}

/// A folder of modules; without a path, the one inside the program.
struct Folder(Option<PathBuf>);

impl Folder {
    fn read(&self, file: &str) -> Result<Cow<'static, [u8]>, Error> {
        let content = match &self.0 {
            Some(folder) => read_inside(folder, file).map(Cow::Owned),
            None => {
                unitvec_shaders::spirv(file).map(Cow::Borrowed).ok_or_else(|| io::ErrorKind::NotFound.into())
            }
        };
        content.map_err(|source| Error::Missing { path: self.shown(file), source })
    }

    /// The path that messages give for a file; `spirv` for the folder inside the program.
    fn shown(&self, file: &str) -> PathBuf {
        self.0.as_deref().unwrap_or(Path::new("spirv")).join(one_line(file))
    }
}

/// Reads a file of a folder. Its name is the manifest's word, so it may be no device, no pipe, and nowhere else; nor are
/// modules, manifests and tables of more than 64 MiB.
fn read_inside(folder: &Path, file: &str) -> io::Result<Vec<u8>> {
    const MOST: u64 = 1 << 26;
    match Path::new(file).components().all(|part| matches!(part, Component::Normal(_))) {
        true => read_start(&folder.join(file), MOST),
        false => Err(io::Error::other("it is no file of this folder")),
    }
}
