//! Normals and frames back into meshes: `write`, and `decode --into`.

use super::beside::{check_ending, write_beside};
use super::many::{each, pairs};
use super::summary::{Options, Summary};
use super::{Buffers, dtype, is_mesh, write_output};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_catalogue::Element;
use unitvec_files::Output;
use unitvec_host::input::{Elements, Input, Kind};
use unitvec_host::raw::Dtype;
use unitvec_host::stream::{Named, read_next};
use unitvec_host::{Error, Result};
use unitvec_mesh::Reach;
use unitvec_mesh::edit::{Attribute, Change, Edited, edit};

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    from: From,
    /// Kind of raw floats: f64, f16, or a big-endian one such as f32be; f32 if not given.
    #[arg(long, value_name = "KIND", value_parser = dtype())]
    dtype: Option<Dtype>,
    #[command(flatten)]
    buffers: Buffers,
    #[command(flatten)]
    summary: Options,
    /// Mesh file: .obj, .ply, .gltf, .glb.
    mesh: PathBuf,
    /// Output file, of the same format, - for the standard output; or a folder that exists.
    out: PathBuf,
}

/// The elements that are written.
#[derive(Args)]
#[group(required = true, multiple = false)]
struct From {
    /// Normals: raw floats, three each, a NumPy array, or a mesh.
    #[arg(long, value_name = "FILE")]
    normals: Option<PathBuf>,
    /// Frames, seven floats each: normals, tangents and handedness, for glTF.
    #[arg(long, value_name = "FILE")]
    frames: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let From { normals, frames } = &arguments.from;
    let from = frames.as_ref().map(|path| (path, Element::Frame));
    let from = from.or_else(|| normals.as_ref().map(|path| (path, Element::Vector)));
    let (path, element) =
        from.ok_or_else(|| Error::Usage("name what is written: --normals FILE or --frames FILE".into()))?;
    let reach = arguments.buffers.reach();
    let kind = Kind { raw: false, dtype: arguments.dtype, reach };
    let pairs = pairs_into(path, &arguments.mesh, &arguments.out)?;
    each(&arguments.summary, &pairs, &arguments.out, |path, out| {
        let output = Output::create_binary(out)?;
        let to_stdout = output.is_stdout();
        let Elements { mut floats, count, .. } = Elements::open(path, element, kind)?;
        let mut fill = |elements: &mut [f32], before| {
            read_next(&mut Named::new(path, &mut floats), element, elements, before)
        };
        let source = Source { path, count, fill: &mut fill };
        let (mut written, edited) = put(&arguments.mesh, element, reach, source)?;
        write_beside(&edited.files, &arguments.mesh, out, &mut written.warnings)?;
        write_output(output, &edited.bytes)?;
        let Written { count, warnings } = written;
        Ok((Summary::of_writing(None, element, count, warnings), to_stdout))
    })?;
    Ok(ExitCode::SUCCESS)
}

/// What is written into a mesh, with its output: OUT, or a file of the mesh's name in the folder OUT.
pub fn pairs_into(from: &Path, mesh: &Path, out: &Path) -> Result<Vec<(PathBuf, PathBuf)>> {
    let pairs = pairs(&[mesh.to_owned()], out, is_mesh, None)?;
    pairs.iter().try_for_each(|(_, out)| check_ending(mesh, out))?;
    Ok(pairs.into_iter().map(|(_, out)| (from.to_owned(), out)).collect())
}

/// Elements that go into a mesh.
pub struct Source<'a> {
    /// The file that they come from.
    pub path: &'a Path,
    /// Their number, where it is known.
    pub count: Option<u64>,
    /// Fills a buffer with as many of the next elements as there are, after so many before; returns their number.
    pub fill: &'a mut dyn FnMut(&mut [f32], u64) -> Result<usize>,
}

/// What [`put`] wrote.
pub struct Written {
    /// The number of elements.
    pub count: u64,
    /// Vectors that were left as they are, in words.
    pub warnings: Vec<String>,
}

/// Puts elements in the place of a mesh's normals or frames, or of the rotations of splats, which are as many, in the order of
/// [`unitvec_mesh::parse`].
pub fn put(mesh: &Path, element: Element, reach: Reach, source: Source<'_>) -> Result<(Written, Edited)> {
    let Source { path, count, fill } = source;
    let (mut wanted, mut given, mut failed) = (0, 0, None);
    let mut next = |elements: &mut [f32]| {
        wanted += (elements.len() / element.floats()) as u64;
        if failed.is_none() {
            match fill(elements, given) {
                Ok(count) => given += count as u64,
                Err(error) => failed = Some(error),
            }
        }
    };
    let mut normals = |_, part, vectors: &mut [[f32; 3]]| {
        if part == Attribute::Normal {
            next(vectors.as_flattened_mut());
        }
    };
    let edited = match element {
        Element::Frame => {
            let mut change = |_, frames: &mut [[f32; 7]]| next(frames.as_flattened_mut());
            Input::open(mesh)?.parse(|p, f, b, r| edit(p, f, b, r, Change::Frames(&mut change)), reach)?
        }
        Element::Vector => {
            Input::open(mesh)?.parse(|p, f, b, r| edit(p, f, b, r, Change::Vectors(&mut normals)), reach)?
        }
        Element::Rotation if mesh.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("obj")) => {
            let mut change = |_, rotations: &mut [[f32; 4]]| next(rotations.as_flattened_mut());
            Input::open(mesh)?.parse(|p, f, b, r| edit(p, f, b, r, Change::Rotations(&mut change)), reach)?
        }
        Element::Rotation => {
            return Err(Error::Usage(format!("{} has rotations, and a mesh has none", path.display())));
        }
    };
    failed.map_or(Ok(()), Err)?;
    // One more shows that a stream goes on.
    given += fill(&mut vec![0.0; element.floats()], given)? as u64;
    let given = count.unwrap_or(given);
    if wanted != given {
        let kind = if element == Element::Vector { "normals" } else { element.plural() };
        let mesh = mesh.display();
        let or_more = if count.is_none() && given > wanted { " or more" } else { "" };
        return Err(Error::Usage(format!(
            "{mesh} has {wanted} {kind} of its own, and {} {given}{or_more}; take what `unitvec encode` or \
             `unitvec normals` made of this mesh",
            path.display()
        )));
    }
    // Of normals alone, tangents stay where they are.
    let warnings = edited.warnings.clone();
    Ok((Written { count: wanted, warnings }, edited))
}
