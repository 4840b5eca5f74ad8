//! The tables of README, docs and module docs.

use super::accuracy::{self, Errors};
use super::{
    costs, devices, dither, drivers, imprecise, languages, markdown_table, pictures, processors, projected,
    slices, textbook,
};
use std::path::PathBuf;
use unitvec_catalogue::{AnyCodec, CODECS, Domain, find, frames, vectors};
use unitvec_choose::RECOMMENDED;
use unitvec_lab::accuracy::{Table, covering_bound_deg};
use unitvec_tests::{files, repository};

/// The table of this name, if there is one.
pub fn table(name: &str) -> Option<String> {
    let (kind, rest) = name.split_once(' ').unwrap_or((name, ""));
    Some(match kind {
        "which" => which(false, |codec| format!("`{}`", codec.id)),
        "which-type" => which(true, |codec| format!("[`{}`]", codec.rust_type)),
        "families" => families(),
        "codecs" => codecs(rest),
        "frames" => codecs_of_frames(),
        "bound" => bound(),
        "errors" => errors(rest),
        "costs" => costs::table(rest),
        "costs-device" => costs::device(),
        "costs-compilers" => costs::compilers(),
        "costs-exact" => costs::exact(),
        "dither" => dither::table(),
        "dither-costs" => dither::cost_table(),
        "dither-keys" => dither::key_table(),
        "dither-pictures" => pictures::dither(),
        "devices" => devices::table(),
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

/// The codecs that are recommended: all, or one of each row's.
fn which(is_whole: bool, name: fn(&AnyCodec) -> String) -> String {
    let rows = RECOMMENDED.iter().flat_map(|row| {
        let shown = if is_whole { row.codecs } else { row.short() };
        shown.iter().enumerate().map(move |(index, id)| {
            let (purpose, codec) = (if index == 0 { row.purpose } else { "" }, find(id).unwrap());
            let (errors, costs) = (all_errors_of(codec), costs::both(id));
            format!("{purpose} | {} | {} | {errors} | {costs}", name(codec), codec.bits)
        })
    });
    markdown_table("for | codec | bits | mean / max error, degrees | cost: encode / decode", rows)
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
    let has_two = |codec: &&AnyCodec| !["snorm", "unorm", "float", "best_fit"].contains(&codec.family);
    let all: Vec<(String, &AnyCodec)> =
        vectors().iter().filter(has_two).map(|codec| (family(codec.id), codec)).collect();
    let of = |key: &str, bits: u32| {
        let found = all.iter().find(|(other, codec)| other == key && codec.bits / 2 * 2 == bits)?;
        Some(errors_of(found.1.id))
    };
    let firsts =
        all.iter().enumerate().filter(|(at, (key, _))| all[..*at].iter().all(|(other, _)| other != key));
    let rows = firsts.filter_map(|(_, (key, codec))| {
        let cells = [of(key, 16)?, of(key, 24)?, of(key, 32)?].join(" | ");
        let (path, subject) = module(codec.family);
        Some(format!("`{key}` | [{subject}](../{}) | {cells}", path.display()))
    });
    markdown_table("identifier | family | 16 bits | 24 bits | 32 bits", rows)
}

/// The published errors of a codec: mean and maximum.
fn published(codec: &AnyCodec) -> Option<String> {
    let tables = [Table::Three, Table::One].into_iter().filter(|table| table.domain() == codec.domain);
    let mut rows = tables.flat_map(Table::published);
    let row = rows.find(|row| row.name == codec.survey_name)?;
    Some(format!("{} / {}", row.mean_error_deg, row.max_error_deg))
}

/// The format's name, without the beginning that all have.
fn vk_format(codec: &AnyCodec) -> &str {
    codec.vk_format.unwrap_or_default().trim_start_matches("VK_FORMAT_")
}

/// Names, formats and errors of the codecs of vectors.
fn codecs(rows: &str) -> String {
    let shown = vectors().iter().filter(|codec| is_shown(rows, codec.id)).map(|codec| {
        let AnyCodec { id, rust_type, bits, bytes, .. } = codec;
        let published = published(codec);
        let name = if published.is_some() { codec.survey_name } else { "" };
        let (format, errors, published) = (vk_format(codec), errors_of(id), published.unwrap_or_default());
        let bound = degrees(codec.max_error_deg().into());
        format!(
            "`{id}` | `{rust_type}` | {name} | {bits} | {bytes} | {format} | {errors} | {bound} | {published}"
        )
    });
    let titles = "codec | Rust type | survey's name | bits | bytes | Vulkan format | mean / max | bound | survey: mean / max";
    markdown_table(titles, shown)
}

/// Every codec of frames.
fn codecs_of_frames() -> String {
    let rows = frames().iter().map(|codec| {
        let AnyCodec { id, rust_type, bits, bytes, .. } = codec;
        let errors = parts(codec)
            .map(|(part, bound)| format!("{} | {}", mean_and_max(accuracy::of(id, part)), degrees(bound)));
        let errors = errors.collect::<Vec<_>>().join(" | ");
        let (format, costs) = (vk_format(codec), costs::both(id));
        format!("`{id}` | `{rust_type}` | {bits} | {bytes} | {format} | {errors} | {costs}")
    });
    let titles = "codec | Rust type | bits | bytes | Vulkan format | normal: mean / max | bound | tangent: mean / max | bound | cost: \
                  encode / decode";
    markdown_table(titles, rows)
}

/// The decoded parts of a codec, each with its bound.
fn parts(codec: &AnyCodec) -> impl Iterator<Item = (&'static str, f64)> {
    let bounds = codec.max_errors_deg.iter().map(|bound| f64::from(*bound));
    codec.element.directions().iter().copied().zip(bounds)
}

/// The error that no code can beat, and how far above it some are.
fn bound() -> String {
    let ids = ["icoN", "fibN", "eaoctNp", "latlongNd", "octNp", "octN"];
    let rows = [16, 24, 32].map(|bits: u32| {
        let (mean, max) = covering_bound_deg(bits, Domain::Sphere);
        let cells = ids.map(|id| {
            let [mean, max] = accuracy::over_bound(find(&id.replace('N', &bits.to_string())).unwrap());
            format!("{mean:.3} / {max:.3}")
        });
        format!("{bits} | {} | {}", mean_and_max(Errors { mean, max }), cells.join(" | "))
    });
    let titles = ids.map(|id| format!("`{id}`")).join(" | ");
    markdown_table(&format!("bits | the bound: mean / max, degrees | {titles}"), rows)
}

/// The errors of a module's codecs.
fn errors(module: &str) -> String {
    let codecs = CODECS.iter().filter(|codec| codec.family == module);
    let rows = codecs.flat_map(|codec| {
        parts(codec).map(|(part, bound)| {
            let Errors { mean, max } = accuracy::of(codec.id, part);
            let of = if part == "direction" { String::new() } else { format!(", {part}") };
            format!("`{}`{of} | {} | {} | {}", codec.id, degrees(mean), degrees(max), degrees(bound))
        })
    });
    markdown_table("degrees | mean | max | bound", rows)
}
