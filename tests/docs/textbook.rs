//! Functions in common use beside the codecs, as `docs/data/textbook.csv` has them.

use super::accuracy::{self, Errors};
use super::costs::rdna2;
use super::markdown_table;
use super::tables::mean_and_max;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use unitvec_catalogue::{Element, Operation, find};
use unitvec_choose::costs::{Row, Source};
use unitvec_lab::textbook::{TEXTBOOK, Textbook};

/// The sources of a row's functions: the textbook, or the codec in its place.
pub const SOURCES: [&str; 2] = ["textbook", "unitvec"];

/// The columns of figures.
#[cfg(feature = "glsl")]
pub const FIGURES: [&str; 6] =
    ["same_codes", "mean_deg", "max_deg", "tangent_mean_deg", "tangent_max_deg", "nan_per_million"];

/// The columns of inputs, by the kind of input, and their headings; the last is for codes.
pub const INPUTS: [(&str, &str); 9] = [
    ("zero", "zero"),
    ("nan", "NaN"),
    ("infinity", "infinity"),
    ("signed_zeros", "0 and -0"),
    ("minus_z", "(0, 0, -1)"),
    ("long", "1e20 long"),
    ("short", "1e-20 long"),
    ("denormal", "denormals"),
    ("codes", "decoding any code"),
];

/// The committed file, by identifier, source and column.
static RECORDED: LazyLock<BTreeMap<[String; 3], String>> = LazyLock::new(|| {
    let rows = super::recorded::<BTreeMap<String, String>>("textbook.csv").into_iter();
    let cells = rows.flat_map(|row| {
        let key = |column: String| [row["id"].clone(), row["source"].clone(), column];
        row.clone().into_iter().map(|(column, value)| (key(column), value)).collect::<Vec<_>>()
    });
    cells.collect()
});

/// A committed cell.
pub fn cell(id: &str, source: &str, column: &str) -> &'static str {
    let found = RECORDED.get(&[id, source, column].map(str::to_owned));
    found.unwrap_or_else(|| {
        panic!("{id}, {source}, {column} is not in docs/data/textbook.csv: cargo xtask renew textbook")
    })
}

/// A committed number of a textbook's functions.
pub fn number(id: &str, column: &str) -> f64 {
    cell(id, "textbook", column).parse().unwrap()
}

/// The errors of a textbook's functions: of directions or normals, and of tangents.
fn errors(textbook: &Textbook) -> [Option<Errors>; 2] {
    let of = |mean, max| Errors { mean: number(textbook.id, mean), max: number(textbook.id, max) };
    let is_frame = textbook.format().unwrap().element == Element::Frame;
    [Some(of("mean_deg", "max_deg")), is_frame.then(|| of("tangent_mean_deg", "tangent_max_deg"))]
}

/// The errors of a codec: of directions or normals, and of tangents.
fn errors_of_codec(id: &str) -> [Option<Errors>; 2] {
    let mut errors = find(id).unwrap().element.directions().iter().map(|part| accuracy::of(id, part));
    [errors.next(), errors.next()]
}

fn joined(errors: [Option<Errors>; 2]) -> String {
    match errors {
        [Some(normal), Some(tangent)] => {
            format!("normal {}, tangent {}", mean_and_max(normal), mean_and_max(tangent))
        }
        [errors, _] => errors.map(mean_and_max).unwrap_or_default(),
    }
}

/// Inverse throughput on RDNA 2 of the textbook's kernel and of the codec's, from GLSL.
fn costs(textbook: &Textbook, operation: Operation) -> String {
    let after = rdna2().row(textbook.codec, operation, Source::Glsl).and_then(|row| row.inverse_throughput);
    let told =
        [throughput(textbook.id, operation), after].map(|t| t.map_or("-".to_owned(), |t| t.to_string()));
    told.join(" → ")
}

/// Inverse throughput on RDNA 2 of a textbook's kernel.
pub fn throughput(id: &str, operation: Operation) -> Option<u64> {
    let is_it = |row: &&Row| row.operation == operation && row.textbook.as_deref() == Some(id);
    rdna2().rows.iter().find(is_it)?.inverse_throughput
}

/// Three components of 8 bits against two of `oct`, with fewer bits and with as many.
pub fn components() -> String {
    let of = |id: &str| accuracy::of(id, "direction");
    let told = |id: &str| format!("`{id}`, {}", mean_and_max(of(id)));
    let times = |id: &str| (of("snorm8x3").mean / of(id).mean).round();
    let [fast, precise, three] = ["oct18", "oct18p", "snorm8x3"].map(of);
    assert!(
        (fast.mean / three.mean - 1.0).abs() < 0.02 && precise.mean < three.mean && precise.max < three.max
    );
    format!(
        "x, y and z of 8 bits each ({}) are met by 9:9 ({}; {}). They have {} times the mean error of 10:10 ({}), and {} times \
         that of 12:12, which takes as many bits ({}).\n",
        told("snorm8x3"),
        told("oct18"),
        told("oct18p"),
        times("oct20"),
        told("oct20"),
        times("oct24"),
        told("oct24")
    )
}

/// The inputs that come back wrong, by their results. A vector that is too short or too long to count as a direction
/// may be +Z.
fn faults(textbook: &Textbook, source: &str) -> String {
    let mut faults: Vec<(&str, Vec<&str>)> = Vec::new();
    for (column, heading) in INPUTS.iter().take(INPUTS.len() - 1) {
        let outcome = cell(textbook.id, source, column);
        // +Z is right for vectors without a direction.
        let is_short = !["minus_z", "long", "signed_zeros"].contains(column);
        if ["right", "outside"].contains(&outcome) || (outcome == "+Z" && is_short) {
            continue;
        }
        match faults.iter_mut().find(|(other, _)| *other == outcome) {
            Some((_, headings)) => headings.push(heading),
            None => faults.push((outcome, vec![heading])),
        }
    }
    let told = faults.iter().map(|(outcome, headings)| format!("{}: {outcome}", headings.join(", ")));
    let told: Vec<String> = told.collect();
    told.join("; ")
}

/// The functions that readers have, and their replacements.
pub fn table() -> String {
    let titles = "what you have | what you get: include, call | old codes stay | T encode | T decode | mean / max error, degrees \
                  | bad input | finer in as many bytes";
    let rows = TEXTBOOK.iter().map(|textbook| {
        let nan = number(textbook.id, "nan_per_million");
        let nan = if nan > 0.0 { format!(", NaN for {nan} in a million") } else { String::new() };
        let finer =
            textbook.finer.map_or_else(String::new, |id| format!("`{id}`: {}", joined(errors_of_codec(id))));
        format!(
            "`{}`: {} | `{}`: `{}` | {} | {} | {} | {}{nan} → {} | {} | {finer}",
            textbook.id,
            textbook.title,
            find(textbook.codec).unwrap().glsl_file(),
            textbook.codec,
            cell(textbook.id, "textbook", "same_codes"),
            costs(textbook, Operation::Encode),
            costs(textbook, Operation::Decode),
            joined(errors(textbook)),
            joined(errors_of_codec(textbook.codec)),
            [faults(textbook, "textbook"), faults(textbook, "unitvec")].join(" → ").trim_end_matches(" → "),
        )
    });
    markdown_table(titles, rows)
}

/// The results for vectors that have no direction or no unit length, and for codes that encoders never write.
pub fn input_table() -> String {
    let headings = INPUTS.map(|(_, heading)| heading).join(" | ");
    let rows = TEXTBOOK.iter().flat_map(|textbook| {
        SOURCES.into_iter().zip([textbook.id, textbook.codec]).map(|(source, id)| {
            let cells = INPUTS.map(|(column, _)| cell(textbook.id, source, column)).join(" | ");
            format!("`{id}`, {source} | {cells}")
        })
    });
    markdown_table(&format!("| {headings}"), rows)
}

/// The claims of docs/textbook.md in words, besides those that `textbook::errors_are_the_surveys` holds: sphere maps
/// decode some of their codes to NaN, diamond frames lose the tangent, and no textbook is finer than the codec in its
/// place. Ours give +Z for zero, NaN and infinity throughout.
#[test]
fn what_textbooks_do() {
    assert!(number("spheremap16", "nan_per_million") > 2000.0 && number("spheremap32", "max_deg") > 5.0);
    assert!(number("frame32", "tangent_max_deg") > 179.0);
    // sign(0) is 0: random directions never meet it; -Z, and all that lies below an axis, do.
    assert_eq!(cell("oct_sign32", "textbook", "minus_z"), "+Z");
    assert_eq!(cell("oct_sign32", "textbook", "signed_zeros"), "off by 45°");
    for Textbook { id, codec, .. } in TEXTBOOK {
        assert!(number(id, "mean_deg") > 0.995 * errors_of_codec(codec)[0].unwrap().mean, "{id}");
        assert_ne!(cell(id, "textbook", "nan"), "+Z", "{id}");
        for column in ["zero", "nan", "infinity"] {
            assert_eq!(cell(id, "unitvec", column), "+Z", "{id}");
        }
    }
}
