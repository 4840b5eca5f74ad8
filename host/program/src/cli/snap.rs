use super::beside::{check_ending, note_sources, write_beside};
use super::convert::Meshes;
use super::many::{each, pairs};
use super::summary::{Told, UPPER_ONLY};
use super::{counted, degrees, is_mesh, write_output};
use clap::Args;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Domain, Element, angle_between_parts_deg, find_any, has_direction};
use unitvec_files::Output;
use unitvec_host::input::Input;
use unitvec_host::{Error, Result};
use unitvec_mesh::Reach;
use unitvec_mesh::edit::{Attribute, Change, Edited, edit};

#[derive(Args)]
pub struct Arguments {
    /// Format of other software that the vectors are for, such as draco:10, or a codec, the precise one where there is one:
    /// `unitvec codecs` lists them.
    #[arg(long = "for", value_name = "ID")]
    codec: String,
    #[command(flatten)]
    meshes: Meshes,
    /// Output file, of the same format, - for the standard output; or a folder that exists, which gets a file of the same
    /// name for each mesh. No input is replaced.
    out: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let codec = find_any(&arguments.codec)?;
    codec.expect_directions().map_err(|error| Error::Usage(error.to_string()))?;
    let pairs = pairs(&arguments.meshes.r#in, &arguments.out, is_mesh, None)?;
    for (input, out) in &pairs {
        check_ending(input, out)?;
    }
    if pairs.len() > 1 {
        // No output of one input may replace what another is read from later.
        pairs.iter().for_each(|(input, _)| note_sources(input));
    }
    let reach = arguments.meshes.buffers.reach();
    each(&arguments.meshes.summary, &pairs, &arguments.out, |input, out| one(codec, input, out, reach))?;
    Ok(ExitCode::SUCCESS)
}

/// Moves the vectors of an input. Returns what is told of it, and whether it went to the standard output.
fn one(codec: &'static AnyCodec, input: &Path, out: &Path, reach: Reach) -> Result<(Summary, bool)> {
    let mut tallies = Tallies { codec, plain: codec.plain(), all: BTreeMap::new(), below: 0 };
    let edited = Input::open(input)?.parse(
        |path, format, bytes, reach| match codec.element {
            Element::Vector => {
                let mut change = |mesh, attribute, vectors: &mut [[f32; 3]]| {
                    let part = if attribute == Attribute::Normal { "normal" } else { "tangent" };
                    tallies.snap(mesh, &[part], vectors);
                };
                edit(path, format, bytes, reach, Change::Vectors(&mut change))
            }
            Element::Frame => {
                let parts = codec.element.directions();
                let mut change = |mesh, frames: &mut [[f32; 7]]| tallies.snap(mesh, parts, frames);
                edit(path, format, bytes, reach, Change::Frames(&mut change))
            }
            Element::Rotation => {
                let parts = codec.element.directions();
                let mut change = |mesh, rotations: &mut [[f32; 4]]| tallies.snap(mesh, parts, rotations);
                edit(path, format, bytes, reach, Change::Rotations(&mut change))
            }
        },
        reach,
    )?;
    let output = Output::create_binary(out)?;
    let to_stdout = output.is_stdout();
    let mut summary = tallies.summary(&edited);
    write_beside(&edited.files, input, out, &mut summary.warnings)?;
    write_output(output, &edited.bytes)?;
    Ok((summary, to_stdout))
}

/// Counts and angles of the vectors of a kind in a mesh.
#[derive(Default)]
struct Tally {
    vectors: u64,
    moved: u64,
    /// Sums and maxima of what [`Moved`] has.
    sums: [f64; 3],
    most: [f64; 3],
}

/// The angle by which a vector was moved; of formats of other software also the angles between the vector and what their own
/// encoder makes of it, and makes of the moved one.
type Moved = [f64; 3];

impl Tally {
    fn add(&mut self, angles: Option<Moved>) {
        self.vectors += 1;
        if let Some(angles) = angles {
            self.moved += 1;
            for (i, angle) in angles.into_iter().enumerate() {
                self.sums[i] += angle;
                self.most[i] = self.most[i].max(angle);
            }
        }
    }

    fn angles(&self, kind: usize) -> Option<Angles> {
        let mean_deg = self.sums[kind] / self.moved as f64;
        (self.moved > 0).then_some(Angles { mean_deg, max_deg: self.most[kind] })
    }
}

/// The tallies of a file.
struct Tallies {
    codec: &'static AnyCodec,
    /// The format's own encoder.
    plain: Option<&'static AnyCodec>,
    /// By the mesh and the part.
    all: BTreeMap<(usize, &'static str), Tally>,
    /// Vectors that a codec of the hemisphere moved up to the equator.
    below: usize,
}

impl Tallies {
    /// Moves elements of these parts.
    fn snap<const N: usize>(&mut self, mesh: usize, parts: &[&'static str], elements: &mut [[f32; N]]) {
        if self.codec.domain == Domain::Hemisphere {
            self.below += elements.iter().filter(|element| element[2] < 0.0).count();
        }
        let snapped = elements.par_iter_mut().map(|element| snap(self.codec, self.plain, element));
        for angles in snapped.collect::<Vec<_>>() {
            for (part, angle) in parts.iter().zip(angles) {
                self.all.entry((mesh, *part)).or_default().add(angle);
            }
        }
    }

    fn summary(self, edited: &Edited) -> Summary {
        let row = |((mesh, part), tally): ((usize, &'static str), Tally)| Row {
            mesh,
            name: edited.meshes.get(mesh).cloned().flatten(),
            part,
            vectors: tally.vectors,
            left_alone: tally.vectors - tally.moved,
            moved: tally.angles(0),
            error_before: tally.angles(1).filter(|_| self.plain.is_some()),
            error_after: tally.angles(2).filter(|_| self.plain.is_some()),
        };
        let below = (self.below > 0).then(|| UPPER_ONLY.to_owned());
        let warnings = edited.warnings.iter().cloned().chain(below).collect();
        Summary { codec: self.codec.id, rows: self.all.into_iter().map(row).collect(), warnings }
    }
}

/// Moves the parts of an element by [`AnyCodec::snapped`]. Returns the angles of those that were moved.
fn snap<const N: usize>(
    codec: &AnyCodec,
    plain: Option<&AnyCodec>,
    element: &mut [f32; N],
) -> [Option<Moved>; 2] {
    let original = std::mem::replace(element, codec.snapped(*element));
    let written = |element| plain.map_or(element, |plain| plain.decode_one(plain.encode_one(element)));
    let others = [*element, written(original), written(*element)];
    let mut angles = [None; 2];
    for (part, angle) in angles.iter_mut().enumerate().take(codec.element.directions().len()) {
        let from = codec.element.part(&original, part);
        if !has_direction(from) {
            break;
        }
        *angle =
            Some(others.each_ref().map(|to| angle_between_parts_deg(from, codec.element.part(to, part))));
    }
    angles
}

/// What was moved.
#[derive(Serialize, schemars::JsonSchema)]
pub struct Summary {
    /// Codec.
    codec: &'static str,
    /// A row for each mesh, and for normals and tangents; vectors that meshes share count in the first.
    rows: Vec<Row>,
    /// Vectors that were not moved, or too far.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// The normals, the tangents or the rotations of a mesh.
#[derive(Serialize, schemars::JsonSchema)]
struct Row {
    /// Index of the mesh in the file.
    mesh: usize,
    /// The mesh's name, where a glTF file gives one.
    name: Option<Arc<str>>,
    /// `normal`, `tangent` or `rotation`.
    part: &'static str,
    /// Number of vectors.
    vectors: u64,
    /// Those of them without a usable direction, and tangents of such normals, which stay as they were.
    left_alone: u64,
    /// The angles between the others before and after; null where there are none.
    moved: Option<Angles>,
    /// The errors that the format's own software makes of the original vectors; of formats of other software.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_before: Option<Angles>,
    /// The errors that it makes of the moved ones, from the original vectors.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_after: Option<Angles>,
}

/// Angles in degrees.
#[derive(Serialize, schemars::JsonSchema)]
struct Angles {
    /// Mean.
    mean_deg: f64,
    /// Maximum.
    max_deg: f64,
}

impl Told for Summary {
    fn lines(&self) -> Vec<String> {
        self.rows.iter().map(Row::line).collect()
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }
}

impl Row {
    fn line(&self) -> String {
        let name = self.name.as_ref().map_or_else(String::new, |name| format!(" ({name})"));
        let vectors = counted(self.vectors, &format!("{}s", self.part));
        let words = |Angles { mean_deg, max_deg }: &Angles| {
            format!("{} degrees in the mean, {} at most", degrees(*mean_deg), degrees(*max_deg))
        };
        let moved =
            self.moved.as_ref().map_or_else(String::new, |angles| format!(", moved by {}", words(angles)));
        let moved = match (&self.error_before, &self.error_after) {
            (Some(before), Some(after)) => {
                format!(
                    "{moved}; the format's own encoder is off by {} before, {} now",
                    words(before),
                    words(after)
                )
            }
            _ => moved,
        };
        format!("mesh {}{name}: {vectors}, {} left as they are{moved}", self.mesh, self.left_alone)
    }
}
