//! Folders whose files appear all at once.

use crate::{Error, Result};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder being written. Its files are written to a temporary folder inside it, and get their names at the end: a run that
/// fails before that leaves the folder as it was.
pub struct Folder {
    path: PathBuf,
    is_new: bool,
    unfinished: Option<TempDir>,
    names: Vec<String>,
    removed: Vec<String>,
}

impl Folder {
    /// Starts to write to the folder of this path, which is made if it does not exist.
    ///
    /// # Errors
    /// [`Error::Write`] where it cannot be made or written to.
    pub fn create(path: &Path) -> Result<Self> {
        let error = |source| Error::writing(path, source);
        let is_new = !path.exists();
        if is_new {
            std::fs::create_dir(path).map_err(error)?;
            crate::remember(path);
        }
        let mut folder =
            Self { path: path.to_owned(), is_new, unfinished: None, names: Vec::new(), removed: Vec::new() };
        // The error's own text names the temporary folder.
        let made = tempfile::Builder::new().prefix(".unitvec-").tempdir_in(path);
        let made = made.map_err(|error| Error::writing(path, error.kind().into()))?;
        crate::remember(made.path());
        folder.unfinished = Some(made);
        Ok(folder)
    }

    /// Adds a file.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&mut self, name: &str, content: &[u8]) -> Result<()> {
        let Some(unfinished) = &self.unfinished else { return Ok(()) };
        let written = std::fs::write(unfinished.path().join(name), content);
        written.map_err(|source| Error::writing(&self.path.join(name), source))?;
        self.names.push(name.to_owned());
        Ok(())
    }

    /// Removes files in the end, those that are there.
    pub fn remove(&mut self, names: Vec<String>) {
        self.removed.extend(names);
    }

    /// Gives all files their names, in place of those that had them, and removes what is to be removed.
    ///
    /// # Errors
    /// [`Error::Write`]; where a folder has one of the names, before anything is changed.
    pub fn finish(mut self) -> Result<()> {
        let Some(unfinished) = self.unfinished.take() else { return Ok(()) };
        if let Some(taken) = self.names.iter().map(|name| self.path.join(name)).find(|path| path.is_dir()) {
            return Err(Error::writing(&taken, std::io::ErrorKind::IsADirectory.into()));
        }
        if self.is_new {
            crate::forget(&self.path);
        }
        for name in &self.names {
            let to = self.path.join(name);
            std::fs::rename(unfinished.path().join(name), &to)
                .map_err(|source| Error::writing(&to, source))?;
        }
        self.is_new = false;
        for path in self.removed.iter().map(|name| self.path.join(name)).filter(|path| path.is_file()) {
            std::fs::remove_file(&path).map_err(|source| Error::writing(&path, source))?;
        }
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        self.unfinished = None;
        if self.is_new {
            // The folder stays where something else has put a file in it.
            let _ = std::fs::remove_dir(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_whole_or_not_at_all() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("figures");
        let mut folder = Folder::create(&path).unwrap();
        folder.write("a.png", b"a").unwrap();
        drop(folder);
        assert!(!path.exists());

        let mut folder = Folder::create(&path).unwrap();
        folder.write("a.png", b"b").unwrap();
        assert!(!path.join("a.png").exists());
        folder.finish().unwrap();
        std::fs::create_dir(path.join("c.png")).unwrap();
        let mut folder = Folder::create(&path).unwrap();
        folder.write("a.png", b"later").unwrap();
        folder.write("c.png", b"c").unwrap();
        folder.remove(vec!["a.png".to_owned()]);
        assert!(folder.finish().is_err());
        assert_eq!(std::fs::read(path.join("a.png")).unwrap(), b"b");
        std::fs::remove_dir(path.join("c.png")).unwrap();
        let names: Vec<_> = path.read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names, ["a.png"]);
        let mut folder = Folder::create(&path).unwrap();
        folder.remove(vec!["a.png".to_owned(), "gone.png".to_owned()]);
        folder.finish().unwrap();
        assert_eq!(path.read_dir().unwrap().count(), 0);
        assert!(Folder::create(&place.path().join("none/figures")).is_err());
    }
}
