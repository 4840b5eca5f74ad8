//! Edited meshes, and the files beside them.

use super::is_mesh;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Component, Path};
use unitvec_files::{Output, check_unused, is_stdout, note_read};
use unitvec_host::input::Input;
use unitvec_host::{Error, Result};
use unitvec_mesh::Reach;
use unitvec_mesh::edit::{Beside, sources};

/// Refuses an output that has the name of another format than the input.
pub fn check_ending(input: &Path, out: &Path) -> Result<()> {
    let [of_input, of_out] =
        [input, out].map(|path| path.extension().map(|ending| ending.to_ascii_lowercase()));
    match is_mesh(input) && is_mesh(out) && of_input != of_out {
        true => Err(Error::Usage(format!(
            "{} would have the format of {}; give it the same ending",
            out.display(),
            input.display()
        ))),
        false => Ok(()),
    }
}

/// Notes an input and the files that it names as read. One that cannot be read is told of when its turn comes.
pub fn note_sources(input: &Path) {
    note_read(input);
    if input.is_file() {
        let named = Input::open(input).and_then(|input| {
            input.parse(|path, format, bytes, _| sources(path, format, bytes), Reach::Folder)
        });
        named.unwrap_or_default().iter().for_each(|source| note_read(source));
    }
}

/// Writes the buffers that were changed to the folder of OUT, and copies other files that it lacks. Fails before anything is
/// written where that would replace a file that the run reads.
pub fn write_beside(files: &[Beside], input: &Path, out: &Path, warnings: &mut Vec<String>) -> Result<()> {
    files.iter().for_each(|file| note_read(&file.source));
    check_unused(out).map_err(|source| unitvec_files::Error::writing(out, source))?;
    let is_file = |path: &Path| path.metadata().map_or(true, |metadata| metadata.is_file());
    let has_folder = !is_stdout(out) && is_file(out);
    let is_below = |file: &Beside| file.name.components().all(|part| matches!(part, Component::Normal(_)));
    for file in files.iter().filter(|file| file.start.is_some()) {
        let (target, name) = (out.with_file_name(&file.name), file.name.display());
        let obstacle = match () {
            () if !is_below(file) => "lies outside of the folder of",
            () if !has_folder => "cannot lie beside the output of",
            () if check_unused(&target).is_err() => {
                "would replace a file that this run reads or has written, from"
            }
            () if target.exists() && !out.exists() => "would replace a file that is there already, from",
            () => continue,
        };
        let words = format!(
            "the buffer {name} {obstacle} {}; name an OUT in another folder, or take a .glb",
            input.display()
        );
        return Err(Error::Usage(words));
    }
    for file in files.iter().filter(|_| has_folder) {
        let target = out.with_file_name(&file.name);
        match target.exists() && file.start.is_none() {
            true => {}
            false if is_below(file) => copy(file, &target)?,
            false => warnings.push(format!("{} is not copied, and not there from OUT", file.name.display())),
        }
    }
    Ok(())
}

/// Copies a file, with what was changed at its start.
fn copy(file: &Beside, target: &Path) -> Result<()> {
    let start = file.start.as_deref().unwrap_or_default();
    let reading = |source| unitvec_files::Error::reading(&file.source, source);
    let writing = |source| unitvec_files::Error::writing(target, source);
    let mut source = File::open(&file.source).map_err(reading)?;
    source.seek(SeekFrom::Start(start.len() as u64)).map_err(reading)?;
    if let Some(folder) = target.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(writing)?;
    }
    let mut output = Output::create(target)?;
    output.write_all(start).and_then(|()| io::copy(&mut source, &mut output)).map_err(writing)?;
    Ok(output.finish()?)
}
