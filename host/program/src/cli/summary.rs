//! What `encode`, `decode` and `normals` say when they are done.

use super::run::Json;
use super::{counted, to_json};
use clap::Args;
use serde::Serialize;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use unitvec_catalogue::{AnyCodec, Domain, Element};
use unitvec_host::Result;
use unitvec_host::stream::{Counts, keeps_lengths};
use unitvec_mesh::{Part, mesh_count};

#[derive(Args)]
pub struct Options {
    /// Do not print the line of counts to the standard error.
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    json: Json,
}

impl Options {
    /// Prints what was read from one file and written to the other, which is the standard output or not.
    pub fn print(&self, summary: Summary, files: [&Path; 2], to_stdout: bool) -> Result<()> {
        // Where the standard error is closed, the exit status has to do.
        if !self.quiet && !self.json.is_to_stdout() {
            let _ = writeln!(std::io::stderr(), "{}", summary.line());
        }
        let [input, output] = files.map(|path| path.display().to_string());
        let report = Report { input, output, summary };
        if to_stdout && self.json.is_to_stdout() {
            let _ = write!(std::io::stderr(), "{}", to_json(&report));
            return Ok(());
        }
        self.json.write(&report)
    }
}

/// What was converted. Counts that do not apply are absent.
#[derive(Serialize, schemars::JsonSchema)]
pub struct Report {
    /// The file that was read; - is the standard input.
    input: String,
    /// The file that was written; - is the standard output.
    output: String,
    #[serde(flatten)]
    summary: Summary,
}

/// What was converted.
#[derive(Serialize, schemars::JsonSchema)]
pub struct Summary {
    /// Codec; absent for `normals`.
    #[serde(skip_serializing_if = "Option::is_none")]
    codec: Option<&'static str>,
    /// What was counted.
    element: Element,
    /// Vectors or frames.
    count: u64,
    /// Vectors, or normals of frames, without a usable direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    without_direction: Option<u64>,
    /// Tangents of frames without a usable direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    tangents_without_direction: Option<u64>,
    /// Vectors with z < 0, which a codec of the hemisphere moved up to z = 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    below_equator: Option<u64>,
    /// True where the codec stores components as given, clamped; absent where nothing was encoded.
    #[serde(skip_serializing_if = "Option::is_none")]
    keeps_lengths: Option<bool>,
    /// Computed normals without a direction, in whose place `normals` wrote +Z.
    #[serde(rename = "written_as_z", skip_serializing_if = "Option::is_none")]
    filled: Option<u64>,
    #[serde(flatten)]
    mesh: Option<MeshSummary>,
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
            tangents_without_direction: None,
            below_equator: None,
            keeps_lengths: None,
            filled: None,
            mesh: None,
        }
    }

    /// Of `unitvec encode`.
    pub fn of_encoding(format: &AnyCodec, counts: Counts, parts: Option<Vec<Part>>) -> Self {
        Self {
            codec: Some(format.id),
            without_direction: Some(counts.no_direction),
            tangents_without_direction: (format.element == Element::Frame).then_some(counts.no_tangent),
            below_equator: (format.domain == Domain::Hemisphere).then_some(counts.below),
            keeps_lengths: Some(keeps_lengths(format)),
            mesh: parts.map(MeshSummary::from),
            ..Self::new(format.element, counts.elements)
        }
    }

    /// Of `unitvec decode`.
    pub fn of_decoding(format: &AnyCodec, count: u64) -> Self {
        Self { codec: Some(format.id), ..Self::new(format.element, count) }
    }

    /// Of `unitvec normals`, which filled so many normals with +Z.
    pub fn of_export(element: Element, counts: Counts, parts: Vec<Part>, filled: u64) -> Self {
        Self {
            without_direction: Some(counts.no_direction),
            tangents_without_direction: (element == Element::Frame).then_some(counts.no_tangent),
            filled: Some(filled),
            mesh: Some(parts.into()),
            ..Self::new(element, counts.elements)
        }
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
            let _ = write!(line, ", {of} without a direction{}", self.stored(count));
        }
        if let Some(count) = self.tangents_without_direction {
            let stored = match (count, self.filled) {
                (0, _) => "",
                (_, None) => " (stored as a perpendicular to the normal)",
                (_, Some(_)) => " (as in the file)",
            };
            let _ = write!(line, ", {} without a direction{stored}", counted(count, "tangents"));
        }
        if let Some(count) = self.below_equator {
            let moved = if count > 0 { " (moved up to it)" } else { "" };
            let _ = write!(line, ", {count} below the equator{moved}");
        }
        if self.keeps_lengths == Some(true) {
            line += ", components stored as given, clamped";
        }
        if let Some(mesh) = self.mesh.as_ref().filter(|_| self.element == Element::Vector) {
            line += &format!(", normals computed from faces: {}", computed(&mesh.parts));
        }
        line
    }

    /// What became of the vectors or normals without a direction.
    fn stored(&self, count: u64) -> String {
        match self.filled {
            _ if count == 0 => String::new(),
            Some(0) => " (as in the file)".to_owned(),
            Some(filled) if filled < count => {
                format!(" ({filled} written as +Z, {} as in the file)", count - filled)
            }
            Some(_) => " (written as +Z)".to_owned(),
            None => " (stored as +Z)".to_owned(),
        }
    }
}

fn computed(parts: &[Part]) -> String {
    match parts.iter().filter(|part| part.computed).count() {
        0 => "no".to_owned(),
        all if all == parts.len() => "yes".to_owned(),
        some => format!("in {some} of {} primitives", parts.len()),
    }
}
