//! The tables of README, docs and module docs.

use super::accuracy::{self, Errors};
use super::{
    costs, dither, drivers, files, imprecise, languages, pictures, processors, projected, slices, textbook,
};
use std::collections::BTreeMap;
use std::path::PathBuf;
use unitvec_catalogue::{AnyCodec, Domain, find, frames, vectors};
use unitvec_choose::RECOMMENDED;
use unitvec_lab::accuracy::{Table, covering_bound_deg};
use unitvec_tests::repository;

/// The table of this name, if there is one.
pub fn table(name: &str) -> Option<String> {
    let (kind, rest) = name.split_once(' ').unwrap_or((name, ""));
    Some(match kind {
        "which" => which(false, |id| format!("`{id}`")),
        "which-type" => which(true, |id| format!("[`{}`]", type_of(id))),
        "families" => families(),
        "codecs" => codecs(rest),
        "frames" => codecs_of_frames(),
        "bound" => bound(),
        "errors" => errors(rest),
        "costs" => costs::table(rest),
        "costs-device" => costs::device(),
        "costs-compilers" => costs::compilers(),
        "dither" => dither::table(),
        "dither-costs" => dither::cost_table(),
        "dither-keys" => dither::key_table(),
        "dither-pictures" => pictures::dither(),
        "drivers" => drivers::table(),
        "imprecise" => imprecise::table(rest),
        "languages" => languages::table(),
        "languages-barriers" => languages::barriers(),
        "processors" => processors::table(),
        "projected" => projected::table(),
        "slices" => slices::table(rest),
        "textbook" => textbook::table(),
        "textbook-input" => textbook::input_table(),
        "slices-machine" => slices::machine(),
        _ => return None,
    })
}

/// True where a table has a row of this codec: all codecs, or with `recommended` those of the table of recommendations.
pub fn is_shown(rows: &str, id: &str) -> bool {
    assert!(["", "recommended"].contains(&rows), "no table of {rows} codecs");
    rows.is_empty() || RECOMMENDED.iter().any(|row| row.codecs.contains(&id))
}

/// Three digits; decimals where those do not take too many zeros.
pub fn degrees(error: f64) -> String {
    if error < 5e-4 {
        return format!("{error:.2e}");
    }
    let decimals = (2 - error.log10().floor() as i32).max(0) as usize;
    format!("{error:.decimals$}")
}

pub fn mean_and_max(errors: Errors) -> String {
    format!("{} / {}", degrees(errors.mean), degrees(errors.max))
}

/// Mean and maximum of a codec of vectors.
fn errors_of(id: &str) -> String {
    mean_and_max(accuracy::of(id, "direction"))
}

/// The error that the bound allows no direction to exceed.
fn bound_of(codec: &AnyCodec) -> String {
    degrees(f64::from(codec.max_error_deg()))
}

fn type_of(id: &str) -> &'static str {
    find(id).unwrap().rust_type
}

fn which(is_whole: bool, name: impl Fn(&str) -> String) -> String {
    let mut text = String::from(
        "| for | codec | bits | mean / max error, degrees | cost: encode / decode |\n|---|---|---|---|---|\n",
    );
    for row in RECOMMENDED {
        let shown = if is_whole { row.codecs } else { row.short() };
        for (index, id) in shown.iter().enumerate() {
            let purpose = if index == 0 { row.purpose } else { "" };
            let codec = find(id).unwrap();
            let (bits, errors) = (codec.bits, all_errors_of(codec));
            text += &format!("| {purpose} | {} | {bits} | {errors} | {} |\n", name(id), costs::both(id));
        }
    }
    text
}

/// Mean and maximum of a codec, with the part of each where there are several.
fn all_errors_of(codec: &AnyCodec) -> String {
    let of = |part: &&str| mean_and_max(accuracy::of(codec.id, part));
    match codec.element.directions() {
        [one] => of(one),
        several => several.iter().map(|part| format!("{part} {}", of(part))).collect::<Vec<_>>().join(", "),
    }
}

/// The identifier with N in place of its first number.
pub fn family(id: &str) -> String {
    let start = id.find(|c: char| c.is_ascii_digit()).unwrap_or(id.len());
    let rest = id[start..].trim_start_matches(|c: char| c.is_ascii_digit());
    format!("{}N{rest}", &id[..start])
}

/// The file of a family's module, and the subject of its docs: the words before the colon.
fn module(family: &str) -> (PathBuf, String) {
    let folder = repository().join("shader-crate/src/families");
    let names = [format!("/{family}.rs"), format!("/{family}/mod.rs")];
    let is_it = |path: &PathBuf| names.iter().any(|name| path.to_string_lossy().ends_with(name));
    let found = files(&folder, &[".rs"]).into_iter().find(is_it);
    let path = found.unwrap_or_else(|| panic!("no file for {family}"));
    let text = std::fs::read_to_string(&path).unwrap();
    let subject = text.trim_start_matches("//! ").split([':', '\n']).next().unwrap_or_default().to_owned();
    (path.strip_prefix(repository()).unwrap().to_owned(), subject)
}

/// Families with two parameters at 16, 24 and 32 bits, `soctN` with a bit more: one row each.
fn families() -> String {
    let mut rows: BTreeMap<usize, (String, &AnyCodec, [Option<String>; 3])> = BTreeMap::new();
    let mut order = Vec::new();
    for codec in
        vectors().iter().filter(|codec| !["snorm", "unorm", "float", "best_fit"].contains(&codec.family))
    {
        let key = family(codec.id);
        let index = order.iter().position(|other| *other == key).unwrap_or_else(|| {
            order.push(key.clone());
            order.len() - 1
        });
        let (.., cells) = rows.entry(index).or_insert((key, codec, [None, None, None]));
        if let Some(column) = [16, 24, 32].iter().position(|bits| codec.bits / 2 * 2 == *bits) {
            cells[column] = Some(errors_of(codec.id));
        }
    }
    let mut text =
        String::from("| identifier | family | 16 bits | 24 bits | 32 bits |\n|---|---|---|---|---|\n");
    for (key, codec, cells) in rows.into_values() {
        if let [Some(first), Some(second), Some(third)] = cells {
            let (path, subject) = module(codec.family);
            text +=
                &format!("| `{key}` | [{subject}](../{}) | {first} | {second} | {third} |\n", path.display());
        }
    }
    text
}

/// The published errors of a codec: mean and maximum.
fn published(codec: &AnyCodec) -> Option<String> {
    let tables = [Table::Three, Table::One].into_iter().filter(|table| table.domain() == codec.domain);
    let mut rows = tables.flat_map(Table::published);
    let row = rows.find(|row| row.name == codec.survey_name)?;
    Some(format!("{} / {}", row.mean_error_deg, row.max_error_deg))
}

/// Names, formats and errors of the codecs of vectors.
fn codecs(rows: &str) -> String {
    let mut text = String::from(
        "| codec | Rust type | survey's name | bits | bytes | Vulkan format | mean / max | bound | survey: mean / max |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for codec in vectors().iter().filter(|codec| is_shown(rows, codec.id)) {
        let format = codec.vk_format.map_or("", |format| format.trim_start_matches("VK_FORMAT_"));
        let published = published(codec);
        let name = if published.is_some() { codec.survey_name } else { "" };
        text += &format!(
            "| `{}` | `{}` | {name} | {} | {} | {format} | {} | {} | {} |\n",
            codec.id,
            codec.rust_type,
            codec.bits,
            codec.bytes,
            errors_of(codec.id),
            bound_of(codec),
            published.unwrap_or_default(),
        );
    }
    text
}

/// Every codec of frames.
fn codecs_of_frames() -> String {
    let mut text = String::from(
        "| codec | Rust type | bits | bytes | Vulkan format | normal: mean / max | bound | tangent: mean / max | bound | cost: \
         encode / decode |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for codec in frames() {
        text += &format!(
            "| `{}` | `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n",
            codec.id,
            codec.rust_type,
            codec.bits,
            codec.bytes,
            codec.vk_format.unwrap_or_default().trim_start_matches("VK_FORMAT_"),
            mean_and_max(accuracy::of(codec.id, "normal")),
            degrees(f64::from(codec.max_errors_deg[0])),
            mean_and_max(accuracy::of(codec.id, "tangent")),
            degrees(f64::from(codec.max_errors_deg[1])),
            costs::both(codec.id)
        );
    }
    text
}

/// The error that no code can beat, and how far above it some are.
fn bound() -> String {
    let ids = ["icoN", "fibN", "eaoctNp", "latlongNd", "octNp", "octN"];
    let mut text = String::from("| bits | the bound: mean / max, degrees |");
    ids.iter().for_each(|id| text += &format!(" `{id}` |"));
    text += &format!("\n|---|---|{}\n", "---|".repeat(ids.len()));
    for bits in [16, 24, 32] {
        let (mean, max) = covering_bound_deg(bits, Domain::Sphere);
        text += &format!("| {bits} | {} |", mean_and_max(Errors { mean, max }));
        for id in ids {
            let codec = find(&id.replace('N', &bits.to_string())).unwrap();
            let [mean, max] = accuracy::over_bound(codec);
            text += &format!(" {mean:.3} / {max:.3} |");
        }
        text.push('\n');
    }
    text
}

/// The errors of a module's codecs.
fn errors(module: &str) -> String {
    if module == "frame" {
        return frame_rows();
    }
    let mut text = String::from("| degrees | mean | max | bound |\n|---|---|---|---|\n");
    for codec in vectors().iter().filter(|codec| codec.family == module) {
        let Errors { mean, max } = accuracy::of(codec.id, "direction");
        text += &format!("| `{}` | {} | {} | {} |\n", codec.id, degrees(mean), degrees(max), bound_of(codec));
    }
    text
}

fn frame_rows() -> String {
    let mut text = String::from("| degrees | mean | max | bound |\n|---|---|---|---|\n");
    for codec in frames() {
        for (part, bound) in codec.element.directions().iter().zip(codec.max_errors_deg) {
            let Errors { mean, max } = accuracy::of(codec.id, part);
            text += &format!(
                "| `{}`, {part} | {} | {} | {} |\n",
                codec.id,
                degrees(mean),
                degrees(max),
                degrees(f64::from(*bound))
            );
        }
    }
    text
}
