//! The tables of README, docs and module docs.

use super::accuracy::{self, Errors};
use super::{
    blocks, compare, costs, devices, dither, drivers, filtering, formats, imprecise, interop, languages,
    markdown_table, orders, papers, pictures, processors, projected, seen, slices, textbook, web,
};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use unitvec_catalogue::{
    AnyCodec, CODECS, Choice, Domain, Operation, RECOMMENDED, find, frames, rotations, vectors,
};
pub use unitvec_choose::degrees;
use unitvec_lab::accuracy::beyond::rotation_bound_deg;
use unitvec_lab::accuracy::{Published, Table, covering_bound_deg};
use unitvec_tests::{files, repository};

/// The table of this name, if there is one.
pub fn table(name: &str) -> Option<String> {
    let (kind, rest) = name.split_once(' ').unwrap_or((name, ""));
    Some(match kind {
        "which" => which(false, |codec| format!("`{}`", codec.id)),
        "which-all" => which(true, |codec| format!("`{}`", codec.id)),
        "which-type" => which(true, |codec| format!("[`{}`]", codec.rust_type)),
        "costs-rarely" => rarely(),
        "families" => families(),
        "codecs" => codecs(rest),
        "frames" => codecs_of_frames(),
        "rotations" => codecs_of_rotations(),
        "bound" => bound(),
        "nulls" => nulls(),
        "above-survey" => above_survey(),
        "survey-marks" => survey_marks(),
        "components" => textbook::components(),
        "papers" => papers::table(),
        "meyer" => papers::meyer(),
        "blocks" => blocks::table(rest),
        "orders" => orders::table(),
        "related" => papers::related(),
        "errors" => errors(rest),
        "costs" => costs::table(rest),
        "costs-gpus" => costs::gpus(rest),
        "costs-order" => costs::order(),
        "costs-counters" => costs::counters(),
        "costs-rust" => costs::rust(),
        "costs-devices" => costs::devices(),
        "costs-compilers" => costs::compilers(),
        "costs-exact" => costs::exact(),
        "costs-stages" => costs::stages(),
        "filtering-maps" => filtering::of_maps(),
        "filtering-channels" => filtering::of_channels(),
        "formats" => formats::names(),
        "formats-use" => formats::table(),
        "formats-vulkan" => formats::promised(),
        "dither" => dither::table(),
        "dither-costs" => dither::cost_table(),
        "dither-keys" => dither::key_table(),
        "dither-pictures" => pictures::dither(),
        "interop" => interop::table(),
        "interop-sources" => interop::sources(),
        "interop-outside" => interop::outside(),
        "interop-tools" => interop::tools(),
        "interop-frames" => interop::of_tangents(),
        "interop-rotations" => interop::of_rotations(),
        "interop-rotation-sources" => interop::sources_of_rotations(),
        "devices" => devices::table(),
        "drivers" => drivers::table(),
        "imprecise" => imprecise::table(rest),
        "languages" => languages::table(),
        "languages-barriers" => languages::barriers(),
        "processors" => processors::table(),
        "projected" => projected::table(),
        "seen" => seen::table(),
        "slices" => slices::table(rest),
        "textbook" => textbook::table(),
        "textbook-input" => textbook::input_table(),
        "slices-machine" => slices::machine(),
        "web-engines" => web::engines(),
        "web-sizes" => web::sizes(rest),
        _ => return None,
    })
}

/// The macro that the docs of the codecs' types take bits, bytes, bounds and formats from.
fn facts() -> String {
    let rows = CODECS.iter().map(|codec| {
        let parts = codec.element.directions().iter().zip(codec.max_errors_deg);
        let errors: Vec<_> =
            parts.map(|(part, &error)| format!("{part} at most {}° off", degrees(error.into()))).collect();
        let (bits, bytes, s) = (codec.bits, codec.bytes, if codec.bytes == 1 { "" } else { "s" });
        let format = codec.vk_format.map(|format| format!("; {format}")).unwrap_or_default();
        format!(
            "    ({}) => {{ \"{bits} bits in {bytes} byte{s}, {}{format}\" }};\n",
            codec.id,
            errors.join(", ")
        )
    });
    let rows: String = rows.collect();
    format!(
        "// Written by `cargo xtask renew tables`. Not in `src/`, whose code modules are made of.\nmacro_rules! facts {{\n\
         {rows}    ($new:ident) => {{ \"a new codec\" }};\n}}\n"
    )
}

#[test]
fn facts_are_current() {
    compare(&repository().join("shader-crate/facts.rs"), &facts());
}

/// True where a table has a row of this codec: all codecs, or with `recommended` those of the table of recommendations.
pub fn is_shown(rows: &str, id: &str) -> bool {
    assert!(["", "recommended"].contains(&rows), "no table of {rows} codecs");
    rows.is_empty() || find(id).is_ok_and(|codec| codec.recommended_for().next().is_some())
}

pub fn mean_and_max(errors: Errors) -> String {
    format!("{} / {}", degrees(errors.mean), degrees(errors.max))
}

/// Mean and maximum of a codec of vectors.
fn errors_of(id: &str) -> String {
    mean_and_max(accuracy::of(id, "direction"))
}

/// The codecs that are recommended: all, or those of the short table.
fn which(is_whole: bool, name: fn(&AnyCodec) -> String) -> String {
    let rows = RECOMMENDED.iter().flat_map(|row| {
        let shown = if is_whole { row.choices } else { row.short() };
        shown.iter().enumerate().map(move |(index, choice)| {
            let Choice { id, why, .. } = choice;
            let (purpose, codec) = (if index == 0 { row.purpose } else { "" }, find(id).unwrap());
            let (format, seen) = (formats(choice), codec.on_a_mirror().unwrap());
            let (errors, costs) = (all_errors_of(codec), costs::both(id));
            format!(
                "{purpose} | {} | {why} | {format} | {} | {errors} | {seen} | {costs}",
                name(codec),
                codec.bits
            )
        })
    });
    let titles = "for | codec | why | Vulkan format | bits | mean / max, degrees | on a mirror | cost: encode / decode";
    markdown_table(titles, rows)
}

/// The format of a choice, and the one that every device has where that is another.
pub fn formats(choice: &Choice) -> String {
    let mut formats = vec![choice.format, choice.anywhere];
    formats.dedup();
    formats.iter().map(|format| format!("`{format}`")).collect::<Vec<_>>().join(", ")
}

/// The families that have more error than `octNp` at each width up to 32 bits and a dearer decoder, and those of their codecs
/// that at least encode for less.
fn rarely() -> String {
    let families: BTreeSet<String> = vectors().iter().map(|codec| family(codec.id)).collect();
    let titles = "family | max, of `octNp`'s | decode, of `octNp`'s | encode for less than `octNp`";
    markdown_table(titles, families.iter().filter_map(|family| rarely_row(family)))
}

fn rarely_row(key: &str) -> Option<String> {
    let is_like = |codec: &&AnyCodec| codec.is_unit && codec.domain == Domain::Sphere && codec.bits <= 32;
    let family = vectors().iter().filter(|codec| family(codec.id) == key).filter(is_like);
    let pairs = family.filter_map(|codec| Some((codec.id, find(&format!("oct{}p", codec.bits)).ok()?.id)));
    let pairs: Vec<(&str, &str)> = pairs.collect();
    let over = |figure: &dyn Fn(&str) -> f64| -> Vec<f64> {
        pairs.iter().map(|(id, oct)| figure(id) / figure(oct)).collect()
    };
    let mean = over(&|id| accuracy::of(id, "direction").mean);
    let max = over(&|id| accuracy::of(id, "direction").max);
    let [encode, decode] = Operation::ALL.map(|operation| over(&|id| costs::cost(id, operation)));
    let is_worse = [&mean, &max, &decode].into_iter().flatten().all(|ratio| *ratio > 1.0);
    let cheap = pairs.iter().zip(&encode).filter(|(_, ratio)| **ratio < 1.0);
    let cheap = cheap.map(|((id, _), _)| format!("`{id}`")).collect::<Vec<_>>().join(", ");
    let range = |ratios: &[f64]| {
        let [low, high] = [f64::min, f64::max].map(|of| ratios.iter().copied().reduce(of).map(degrees));
        Some(if low == high { low? } else { format!("{} to {}", low?, high?) })
    };
    is_worse.then(|| Some(format!("`{key}` | {} | {} | {cheap}", range(&max)?, range(&decode)?)))?
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
    let Published { mean_error_deg, max_error_deg, mean_flag, max_flag, .. } = row;
    Some(format!("{mean_error_deg:.5}{mean_flag} / {max_error_deg:.5}{max_flag}"))
}

/// The maxima that the survey marks, against ours.
fn survey_marks() -> String {
    let marked = Table::One.published().into_iter().filter(|row| !row.max_flag.is_empty());
    let ratios: Vec<f64> = marked
        .map(|row| accuracy::of(row.codec().unwrap().id, "direction").max / row.max_error_deg)
        .collect();
    let lower: Vec<f64> =
        ratios.iter().map(|ratio| 100.0 * (1.0 - ratio)).filter(|less| *less > 2.0).collect();
    let (least, most) =
        (lower.iter().copied().fold(100.0, f64::min), lower.iter().copied().fold(0.0, f64::max));
    assert!(ratios.iter().all(|ratio| *ratio < 1.035));
    format!(
        "± is the survey's mark: with float64 intermediates or other compiler flags the error was substantially lower. Of the \
         {} maxima with it ours are lower in {}, by {least:.0} to {most:.0} %; the others are within 3 %.\n",
        ratios.len(),
        lower.len()
    )
}

/// The codecs whose largest error by search is more than 4 % above the survey's, which is that of a sample.
fn above_survey() -> String {
    let published = [Table::One, Table::Three].into_iter().flat_map(Table::published);
    let ratio = |row: Published| {
        let id = row.codec()?.id;
        Some((id, accuracy::of(id, "direction").max / row.max_error_deg))
    };
    let mut above: Vec<_> = published.filter_map(ratio).filter(|(_, ratio)| *ratio > 1.04).collect();
    above.sort_by(|a, b| b.1.total_cmp(&a.1));
    let named = above.iter().map(|(id, ratio)| format!("`{id}` ({:.1} %)", 100.0 * (ratio - 1.0)));
    let named: Vec<String> = named.collect();
    format!(
        "The maxima in our tables are by search, which finds more than the survey's sample: over 4 % more for {}.\n",
        named.join(", ")
    )
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
    let bound = degrees(unitvec_oracle::oct::FPNV.to_degrees());
    let floats = format!("none | `[f32; 3]` | float32x3 | 96 | 12 | R32G32B32_SFLOAT |  | {bound} | ");
    let shown = shown.chain([floats]);
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

/// Every codec of rotations, with the errors that no code can beat.
fn codecs_of_rotations() -> String {
    let rows = rotations().iter().map(|codec| {
        let AnyCodec { id, rust_type, bits, bytes, .. } = codec;
        let errors = accuracy::of(id, "rotation");
        let (mean, max) = rotation_bound_deg(*bits);
        let (format, bound) = (vk_format(codec), degrees(codec.max_error_deg().into()));
        format!(
            "`{id}` | `{rust_type}` | {bits} | {bytes} | {format} | {} | {bound} | {} | {:.3} / {:.3} | {}",
            mean_and_max(errors),
            mean_and_max(Errors { mean, max }),
            errors.mean / mean,
            errors.max / max,
            costs::both(id)
        )
    });
    let titles = "codec | Rust type | bits | bytes | Vulkan format | mean / max | bound | the least: mean / max | ratio | cost: encode / \
                  decode";
    markdown_table(titles, rows)
}

/// The decoded parts of a codec, each with its bound.
fn parts(codec: &AnyCodec) -> impl Iterator<Item = (&'static str, f64)> {
    let bounds = codec.max_errors_deg.iter().map(|bound| f64::from(*bound));
    codec.element.directions().iter().copied().zip(bounds)
}

/// The null codes, each with its codecs; last the codecs without one.
fn nulls() -> String {
    let mut codecs: BTreeMap<_, Vec<String>> = BTreeMap::new();
    for codec in vectors() {
        let code = codec.null().map_or(u64::MAX, |null| null.code);
        codecs.entry(code).or_default().push(format!("`{}`", codec.id));
    }
    let code = |code| if code == u64::MAX { "none".to_owned() } else { format!("`{code:#x}`") };
    let rows = codecs.into_iter().map(|(null, codecs)| format!("{} | {}", code(null), codecs.join(", ")));
    markdown_table("null code | codecs", rows)
}

/// The error that no code can beat, and how far above it some are.
fn bound() -> String {
    let ids = ["icoN", "hexcubeN", "fibN", "eaoctNp", "latlongNd", "octNp", "octN"];
    let rows = [16, 24, 32].map(|bits: u32| {
        let (mean, max) = covering_bound_deg(bits, Domain::Sphere);
        let cells = ids.map(|id| {
            let [mean, max] = accuracy::over_bound(find(&id.replace('N', &bits.to_string())).unwrap());
            format!("{mean:.3} / {max:.3}")
        });
        format!("{bits} | {} | {}", mean_and_max(Errors { mean, max }), cells.join(" | "))
    });
    let titles = ids.map(|id| format!("`{id}`")).join(" | ");
    markdown_table(&format!("bits | the least: mean / max, degrees | {titles}"), rows)
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
