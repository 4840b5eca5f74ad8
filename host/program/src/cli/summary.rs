//! What `encode`, `decode`, `normals`, `write` and `snap` say when they are done.

use super::run::Json;
use super::{counted, tell, to_json};
use clap::Args;
use serde::Serialize;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use unitvec_catalogue::{AnyCodec, Domain, Element, Measure};
use unitvec_files::shown;
use unitvec_host::Result;
use unitvec_host::input::FileName;
use unitvec_host::stream::{Counts, keeps_lengths};
use unitvec_mesh::{Part, mesh_count};

#[derive(Args)]
pub struct Options {
    /// Do not print the line of counts to the standard error; warnings stay.
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    json: Json,
}

impl Options {
    /// Fails where the JSON would replace one of these files.
    pub fn spare(&self, pairs: &[(PathBuf, PathBuf)]) -> Result<()> {
        self.json.spare(pairs.iter().flat_map(|(input, out)| [input, out]))
    }

    /// Prints what was read from one file, one of `all`, and written to the other, which is the standard output or not.
    pub fn told<S: Told>(
        &self,
        summary: S,
        files: [&Path; 2],
        all: usize,
        to_stdout: bool,
    ) -> (Report<S>, bool) {
        let [input, output] = files.map(FileName::from);
        let name = if all > 1 { format!("{input}: ") } else { String::new() };
        if !self.quiet && !self.json.is_to_stdout() {
            for line in summary.lines() {
                // Where the standard error is closed, the exit status has to do.
                let _ = writeln!(std::io::stderr(), "{}", shown(format!("{name}{line}")));
            }
        }
        for words in summary.warnings().iter().filter(|_| !self.json.is_to_stdout()) {
            tell(format_args!("warning: {input}: {words}"));
        }
        (Report { input, output, summary }, to_stdout)
    }

    /// Writes the JSON, where it is asked for: a list where OUT is a folder.
    pub fn write<S: Told>(&self, done: Vec<(Report<S>, bool)>, out: &Path) -> Result<()> {
        if !self.json.is_wanted() {
            return Ok(());
        }
        let to_stdout = done.iter().any(|(_, to_stdout)| *to_stdout);
        let mut reports: Vec<_> = done.into_iter().map(|(report, _)| report).collect();
        let one = if out.is_dir() { None } else { reports.pop() };
        let json = to_json(&one.map_or(Reports::Many(reports), |one| Reports::One(Box::new(one))));
        if to_stdout && self.json.is_to_stdout() {
            let written = write!(std::io::stderr(), "{json}");
            let name = Path::new("the standard error");
            return Ok(written.map_err(|source| unitvec_files::Error::writing(name, source))?);
        }
        self.json.write_text(&json)
    }
}

/// The warning of vectors below the equator.
pub const UPPER_ONLY: &str = "the codec is for z >= 0 only: take one for all directions, such as oct32p";

/// What is told of an input when it is done.
pub trait Told: Serialize {
    /// The lines for the standard error.
    fn lines(&self) -> Vec<String>;

    /// What is lost, in words.
    fn warnings(&self) -> &[String];
}

impl Told for Summary {
    fn lines(&self) -> Vec<String> {
        vec![self.line()]
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }
}

/// What was converted: of one input, or, where OUT is a folder, of each.
#[derive(Serialize, schemars::JsonSchema)]
#[schemars(rename = "Reports")]
#[serde(untagged)]
pub enum Reports<S = Summary> {
    /// One input, and a file.
    One(Box<Report<S>>),
    /// Inputs whose outputs are in a folder.
    Many(Vec<Report<S>>),
}

/// What was converted. Counts that do not apply are absent.
#[derive(Serialize, schemars::JsonSchema)]
#[schemars(rename = "Report")]
pub struct Report<S = Summary> {
    /// The file that was read; - is the standard input.
    input: FileName,
    /// The file that was written; - is the standard output.
    output: FileName,
    #[serde(flatten)]
    summary: S,
}

/// What was converted.
#[derive(Serialize, schemars::JsonSchema)]
pub struct Summary {
    /// Codec; absent for `normals` and `write`.
    #[serde(skip_serializing_if = "Option::is_none")]
    codec: Option<&'static str>,
    /// What was counted.
    element: Element,
    /// Vectors or frames.
    count: u64,
    /// Vectors, or normals of frames, without a usable direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    without_direction: Option<u64>,
    /// The place of the first of them, counted from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    first_without_direction: Option<u64>,
    /// Tangents of frames without a usable direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    tangents_without_direction: Option<u64>,
    /// The place of the first of these tangents, counted from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    first_tangent_without_direction: Option<u64>,
    /// The least and the greatest length of vectors, or normals of frames, that have a direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    lengths: Option<[f64; 2]>,
    /// What the floats seem to be instead, what the codec loses of them, and that tangents were generated.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
    /// Vectors with z < 0, which a codec of the hemisphere moved up to z = 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    below_equator: Option<u64>,
    /// True where the codec stores a length, or components as given, clamped; absent where nothing was encoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    keeps_lengths: Option<bool>,
    /// Computed normals without a direction, in whose place `normals` wrote +Z.
    #[serde(rename = "written_as_z", skip_serializing_if = "Option::is_none")]
    filled: Option<u64>,
    /// Vectors without a direction that `encode --null` stored as null; absent where there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    stored_as_null: Option<u64>,
    #[serde(flatten)]
    mesh: Option<MeshSummary>,
    #[serde(skip)]
    measure: Measure,
}

/// The mesh that was read.
#[derive(Serialize, schemars::JsonSchema)]
struct MeshSummary {
    /// Meshes of the file.
    meshes: usize,
    /// Primitives, in the order of their vectors or frames.
    parts: Vec<Part>,
}

impl From<Vec<Part>> for MeshSummary {
    fn from(parts: Vec<Part>) -> Self {
        Self { meshes: mesh_count(&parts), parts }
    }
}

impl Summary {
    fn new(element: Element, count: u64) -> Self {
        Self {
            codec: None,
            element,
            count,
            without_direction: None,
            first_without_direction: None,
            tangents_without_direction: None,
            first_tangent_without_direction: None,
            lengths: None,
            warnings: Vec::new(),
            below_equator: None,
            keeps_lengths: None,
            filled: None,
            stored_as_null: None,
            mesh: None,
            measure: Measure::Angle,
        }
    }

    /// The counts that elements of this kind have.
    fn of_elements(element: Element, counts: Counts) -> Self {
        let tangents = Some(counts.no_tangent).filter(|_| element == Element::Frame);
        Self {
            without_direction: Some(counts.no_direction.count),
            first_without_direction: counts.no_direction.first,
            tangents_without_direction: tangents.map(|tangents| tangents.count),
            first_tangent_without_direction: tangents.and_then(|tangents| tangents.first),
            lengths: counts.lengths,
            warnings: counts.suspicion.map(|suspicion| suspicion.to_string()).into_iter().collect(),
            ..Self::new(element, counts.elements)
        }
    }

    /// The summary of `unitvec encode`.
    pub fn of_encoding(format: &AnyCodec, counts: Counts, parts: Option<Vec<Part>>) -> Self {
        let measure = format.measure();
        let has_length = measure == Measure::Relative;
        let greatest = if has_length { greatest_length(format) } else { 1.0 };
        let is_clamped =
            keeps_lengths(format) && counts.lengths.is_some_and(|[_, most]| most > 1.01 * greatest);
        let is_lost = 2 * (counts.no_direction.count - counts.nulls) > counts.elements;
        let clamped = if has_length {
            "some are longer than the codec can store, and get its greatest length"
        } else {
            "the codec clamps components to 1: normalise the vectors first"
        };
        let lost = [
            (is_lost && !has_length, "most of them have no direction"),
            (counts.below > 0, UPPER_ONLY),
            (is_clamped, clamped),
        ];
        let lost = lost.into_iter().filter(|(is_lost, _)| *is_lost).map(|(_, words)| words.to_owned());
        let mut summary = Self::of_elements(format.element, counts.clone());
        summary.warnings.extend(lost);
        Self {
            codec: Some(format.id),
            below_equator: (format.domain == Domain::Hemisphere).then_some(counts.below),
            keeps_lengths: Some(keeps_lengths(format)),
            stored_as_null: Some(counts.nulls).filter(|nulls| *nulls > 0),
            mesh: parts.map(MeshSummary::from),
            measure,
            ..summary
        }
    }

    /// The summary of what was written into a mesh, decoded where a codec is given.
    pub fn of_writing(codec: Option<&AnyCodec>, element: Element, count: u64, warnings: Vec<String>) -> Self {
        Self { codec: codec.map(|codec| codec.id), warnings, ..Self::new(element, count) }
    }

    /// The summary of `unitvec normals`, which filled so many normals with +Z.
    pub fn of_export(element: Element, counts: Counts, parts: Vec<Part>, filled: u64) -> Self {
        Self { filled: Some(filled), mesh: Some(parts.into()), ..Self::of_elements(element, counts) }
    }

    /// The summary with one more warning, if there is one.
    pub fn noting(mut self, note: Option<String>) -> Self {
        self.warnings.extend(note);
        self
    }

    fn line(&self) -> String {
        let mut line = counted(self.count, self.element.plural());
        if let Some(mesh) = &self.mesh {
            line += &format!(" from {}", counted(mesh.meshes as u64, "meshes"));
        }
        if let Some(count) = self.without_direction {
            let of =
                if self.element == Element::Frame { counted(count, "normals") } else { count.to_string() };
            // Writing to a String cannot fail.
            let stored = self.stored(count, self.first_without_direction);
            let _ = write!(line, ", {of} without a direction{stored}");
        }
        if let Some(count) = self.tangents_without_direction {
            let what = if self.filled.is_some() {
                "as in the file"
            } else {
                "stored as a perpendicular to the normal"
            };
            let stored = self.placed(what, self.first_tangent_without_direction);
            let _ = write!(line, ", {} without a direction{stored}", counted(count, "tangents"));
        }
        if let Some(count) = self.below_equator {
            let moved = if count > 0 { " (moved up to it)" } else { "" };
            let _ = write!(line, ", {count} below the equator{moved}");
        }
        if let Some([least, most]) = self.lengths {
            line += &format!(", lengths {} to {}", length(least), length(most));
        }
        if self.keeps_lengths == Some(true) && self.measure != Measure::Relative {
            line += ", components stored as given, clamped";
        }
        if let Some(mesh) = self.mesh.as_ref().filter(|_| self.element == Element::Vector) {
            line += &format!(", normals computed from faces: {}", computed(&mesh.parts));
        }
        line
    }

    /// What became of the vectors or normals without a direction.
    fn stored(&self, count: u64, first: Option<u64>) -> String {
        let (some, written, rest) = match (self.filled, self.stored_as_null) {
            (Some(filled), _) => (filled, "written as +Z", "as in the file"),
            (None, _) if self.element == Element::Rotation => (0, "", "stored as the identity"),
            (None, _) if self.measure == Measure::Relative => {
                (0, "", "stored as zero or, infinite ones, with the greatest length")
            }
            (None, nulls) => (nulls.unwrap_or(0), "stored as null", "stored as +Z"),
        };
        let what = match some {
            0 => rest.to_owned(),
            some if some < count => format!("{some} {written}, {} {rest}", count - some),
            _ => written.to_owned(),
        };
        self.placed(&what, first)
    }

    /// What became of elements, and the place of the first of them; nothing where there are none.
    fn placed(&self, what: &str, first: Option<u64>) -> String {
        let Some(first) = first else { return String::new() };
        let parts = self.mesh.iter().flat_map(|mesh| &mesh.parts);
        let mut parts =
            parts.filter(|part| (part.first..part.first + part.count).contains(&(first as usize)));
        let place = parts.next().filter(|part| part.name.is_some() || part.mesh + part.primitive > 0);
        let place = place.map_or_else(String::new, |part| format!(", in {}", part.place()));
        format!(" ({what}; the first is number {first}{place})")
    }
}

/// The length of the vectors of a code of ones, the longest of a codec of vectors with a length.
fn greatest_length(format: &AnyCodec) -> f64 {
    let v: [f32; 3] = format.decode_one([u32::MAX; 2]);
    v.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt()
}

/// A length with four decimals, or four digits where it is far from 1.
fn length(length: f64) -> String {
    if (1e-3..1e4).contains(&length) { format!("{length:.4}") } else { format!("{length:.3e}") }
}

fn computed(parts: &[Part]) -> String {
    match parts.iter().filter(|part| part.computed).count() {
        0 => "no".to_owned(),
        all if all == parts.len() => "yes".to_owned(),
        some => format!("in {some} of {} primitives", parts.len()),
    }
}
