//! Many inputs, each with its output.

use super::summary::{Options, Told};
use super::{files_of, is_mesh, tell};
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use unitvec_files::is_same_file;
use unitvec_host::{Error, Result};

/// The inputs, those of folders among them, each with its output: OUT, or a file in the folder OUT, of its own name but for
/// the ending. Without an ending, outputs are meshes, and keep their names. An OUT that ends with a separator is made.
pub fn pairs(
    inputs: &[PathBuf],
    out: &Path,
    is_wanted: fn(&Path) -> bool,
    ending: Option<&str>,
) -> Result<Vec<(PathBuf, PathBuf)>> {
    let found = files_of(inputs, is_wanted)?;
    if out.to_string_lossy().ends_with(std::path::is_separator) {
        std::fs::create_dir_all(out).map_err(|source| unitvec_files::Error::writing(out, source))?;
    }
    if let ([input], false) = (inputs, out.is_dir()) {
        if !input.is_dir() {
            check_output(input, out, ending.is_none())?;
            return Ok(vec![(input.clone(), out.to_owned())]);
        }
    }
    if !out.is_dir() {
        let words = format!(
            "several inputs, or a folder, need a folder as OUT, which exists or ends with a slash; {} is none",
            out.display()
        );
        return Err(Error::Usage(words));
    }
    // An output must not replace an input that is yet to be read.
    let places: HashSet<PathBuf> = found.iter().filter_map(|input| input.canonicalize().ok()).collect();
    let mut taken = BTreeMap::new();
    for input in found {
        let out = match ending {
            Some(ending) => out.join(input.file_name().unwrap_or_default()).with_extension(ending),
            None => out.join(input.file_name().unwrap_or_default()),
        };
        check_output(&input, &out, ending.is_none())?;
        if out.canonicalize().is_ok_and(|place| places.contains(&place)) {
            return Err(Error::Usage(format!("{} is an input; name another folder", out.display())));
        }
        if let Some(other) = taken.insert(out.clone(), input.clone()) {
            let [other, input] = [other, input].map(|path| path.display().to_string());
            let words =
                format!("{other} and {input} would both become {}; convert one by itself", out.display());
            return Err(Error::Usage(words));
        }
    }
    Ok(taken.into_iter().map(|(out, input)| (input, out)).collect())
}

/// Refuses an output that would replace the input or, if it is none, what is called a mesh: as where OUT was forgotten after
/// `*.obj`.
fn check_output(input: &Path, out: &Path, of_mesh: bool) -> Result<()> {
    let is_input = is_same_file(input, out);
    if is_input || (is_mesh(out) && !of_mesh) {
        let what = if is_input { "the input" } else { "the name of a mesh" };
        let message = format!("{} is {what}; give the output another name", out.display());
        return Err(Error::Usage(message));
    }
    Ok(())
}

/// Refuses a file beside the output where there are several inputs, which would share it, and one that would replace the input.
pub fn check_beside(beside: &Path, pairs: &[(PathBuf, PathBuf)], of_mesh: bool) -> Result<()> {
    if pairs.len() > 1 {
        let words = format!("{} would be of several inputs; give each by itself", beside.display());
        return Err(Error::Usage(words));
    }
    pairs.iter().try_for_each(|(input, _)| check_output(input, beside, of_mesh))
}

/// Converts each input to its output; `convert` says what is told of it, and whether it went to the standard output. One of
/// several that fails does not stop the others.
pub fn each<S: Told>(
    summary: &Options,
    pairs: &[(PathBuf, PathBuf)],
    out: &Path,
    mut convert: impl FnMut(&Path, &Path) -> Result<(S, bool)>,
) -> Result<()> {
    summary.spare(pairs)?;
    let (mut done, mut failed) = (Vec::new(), Failed::of(pairs.len()));
    for (input, out) in pairs {
        if let Some((one, to_stdout)) = failed.unless(convert(input, out))? {
            done.push(summary.told(one, [input, out], pairs.len(), to_stdout));
        }
    }
    summary.write(done, out)?;
    failed.end()
}

/// How many inputs failed. One of several is told, and does not stop the others.
pub struct Failed {
    failed: usize,
    all: usize,
}

impl Failed {
    /// None of so many inputs.
    pub fn of(all: usize) -> Self {
        Self { failed: 0, all }
    }

    /// What was done with an input; `None` where that failed.
    ///
    /// # Errors
    /// The failure of an only input.
    pub fn unless<T>(&mut self, done: Result<T>) -> Result<Option<T>> {
        match done {
            Err(error) if self.all > 1 => {
                self.failed += 1;
                tell(error);
                Ok(None)
            }
            done => done.map(Some),
        }
    }

    /// # Errors
    /// [`Error::Some`] unless none failed.
    pub fn end(self) -> Result<()> {
        let Self { failed, all } = self;
        if failed == 0 { Ok(()) } else { Err(Error::Some { failed, all }) }
    }
}
