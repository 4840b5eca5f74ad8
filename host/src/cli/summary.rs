//! What `encode`, `decode` and `normals` say when they are done.

use super::{print, to_json};
use clap::Args;
use serde::Serialize;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use unitvec_host::Result;
use unitvec_host::catalogue::{self, Domain, Element, Format};
use unitvec_host::mesh::{Part, mesh_count};
use unitvec_host::stream::Counts;

#[derive(Args)]
pub struct Options {
    /// Do not print the line of counts to the standard error.
    #[arg(long, short)]
    quiet: bool,
    /// Print the counts as JSON instead of the line, and of a mesh where each primitive begins: to the standard output, or
    /// to the standard error if OUT is the standard output.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Prints what was read from `input` and written to `output`.
    pub fn print(&self, summary: &Summary, input: &Path, output: &Path) -> Result<()> {
        let json = |summary| {
            let [input, output] = [input, output].map(|path| path.display().to_string());
            to_json(&Report { input, output, summary })
        };
        match (self.json, self.quiet) {
            // Where the standard error is closed, the exit status has to do.
            (true, _) if output == Path::new("-") => {
                let _ = write!(std::io::stderr(), "{}", json(summary));
            }
            (true, _) => drop(print(&json(summary))?),
            (false, true) => {}
            (false, false) => {
                let _ = writeln!(std::io::stderr(), "{}", summary.line());
            }
        }
        Ok(())
    }
}

#[derive(Serialize)]
struct Report<'a> {
    input: String,
    output: String,
    #[serde(flatten)]
    summary: &'a Summary,
}

/// What was converted.
#[derive(Serialize)]
pub struct Summary {
    #[serde(skip_serializing_if = "Option::is_none")]
    codec: Option<&'static str>,
    element: Element,
    count: u64,
    /// Of vectors or of normals.
    #[serde(skip_serializing_if = "Option::is_none")]
    without_direction: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tangents_without_direction: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    below_equator: Option<u64>,
    #[serde(skip)]
    keeps_lengths: bool,
    #[serde(flatten)]
    mesh: Option<MeshSummary>,
}

/// Where the vectors of a mesh come from.
#[derive(Serialize)]
pub struct MeshSummary {
    meshes: usize,
    /// Computed normals that are +Z for want of a direction.
    #[serde(rename = "computed_without_direction")]
    pub filled: u64,
    parts: Vec<Part>,
}

impl MeshSummary {
    /// Of a mesh of these parts, in which so many computed normals were filled with +Z.
    pub fn new(parts: Vec<Part>, filled: u64) -> Self {
        Self { meshes: mesh_count(&parts), filled, parts }
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
            keeps_lengths: false,
            mesh: None,
        }
    }

    /// Of `unitvec encode`.
    pub fn of_encoding(format: Format, counts: Counts, mesh: Option<MeshSummary>) -> Self {
        let is_raw =
            catalogue::find(format.id).is_ok_and(|codec| !codec.is_unit && codec.family != "best_fit");
        Self {
            codec: Some(format.id),
            without_direction: Some(counts.no_direction),
            tangents_without_direction: (format.element == Element::Frame).then_some(counts.no_tangent),
            below_equator: (format.domain == Domain::Hemisphere).then_some(counts.below),
            keeps_lengths: is_raw,
            mesh,
            ..Self::new(format.element, counts.elements)
        }
    }

    /// Of `unitvec decode`.
    pub fn of_decoding(format: Format, count: u64) -> Self {
        Self { codec: Some(format.id), ..Self::new(format.element, count) }
    }

    /// Of `unitvec normals`.
    pub fn of_export(element: Element, counts: Counts, mesh: MeshSummary) -> Self {
        Self {
            without_direction: Some(counts.no_direction),
            tangents_without_direction: (element == Element::Frame).then_some(counts.no_tangent),
            mesh: Some(mesh),
            ..Self::new(element, counts.elements)
        }
    }

    fn line(&self) -> String {
        let mut line = counted(self.count, self.element.plural());
        if let Some(mesh) = &self.mesh {
            line += &format!(" from {}", counted(mesh.meshes as u64, "meshes"));
        }
        if let Some(count) = self.without_direction {
            let of = if self.element == Element::Frame { "normals " } else { "" };
            // Writing to a String cannot fail.
            let _ = write!(line, ", {count} {of}without a direction{}", self.stored(count));
        }
        if let Some(count) = self.tangents_without_direction {
            let stored = match (count, self.codec) {
                (0, _) => "",
                (_, Some(_)) => " (stored as a perpendicular to the normal)",
                (_, None) => " (as in the file)",
            };
            let _ = write!(line, ", {count} tangents without a direction{stored}");
        }
        if let Some(count) = self.below_equator {
            let moved = if count > 0 { " (moved up to it)" } else { "" };
            let _ = write!(line, ", {count} below the equator{moved}");
        }
        if self.keeps_lengths {
            line += ", components stored as given, clamped";
        }
        if let Some(mesh) = self.mesh.as_ref().filter(|_| self.element == Element::Vector) {
            line += &format!(", normals computed from faces: {}", computed(&mesh.parts));
        }
        line
    }

    /// What became of the vectors or normals without a direction.
    fn stored(&self, count: u64) -> String {
        let filled = self.mesh.as_ref().map_or(0, |mesh| mesh.filled);
        match (self.codec, count - filled) {
            _ if count == 0 => String::new(),
            (Some(_), _) | (None, 0) => " (stored as +Z)".to_owned(),
            (None, _) if filled == 0 => " (as in the file)".to_owned(),
            (None, own) => format!(" ({filled} stored as +Z, {own} as in the file)"),
        }
    }
}

/// `1 vector`, `2 meshes`.
fn counted(count: u64, plural: &str) -> String {
    let singular = plural.strip_suffix("es").filter(|word| word.ends_with("sh"));
    let singular = singular.or(plural.strip_suffix('s')).unwrap_or(plural);
    format!("{count} {}", if count == 1 { singular } else { plural })
}

fn computed(parts: &[Part]) -> String {
    match parts.iter().filter(|part| part.computed).count() {
        0 => "no".to_owned(),
        all if all == parts.len() => "yes".to_owned(),
        some => format!("in {some} of {} primitives", parts.len()),
    }
}
