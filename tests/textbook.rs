//! Functions in common use, `glsl/textbook/`, on lavapipe: errors beside the survey's, and results for bad input.

use crate::docs::accuracy;
use crate::docs::textbook::{FIGURES, INPUTS, SOURCES, cell, number};
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::Arc;
use unitvec_catalogue::{AnyCodec, Domain, Element, Operation, find};
use unitvec_lab::accuracy::Table;
use unitvec_lab::accuracy::meyer::worst_error;
use unitvec_lab::textbook::{TEXTBOOK, Textbook, TextbookGpu, best_fit_table};
use unitvec_oracle::best_fit::error_at_length;
use unitvec_run::backend::{Backend, CHUNK, Cpu, round_trip};
use unitvec_run::glsl::Compiler;
use unitvec_run::measure::ElementErrors;
use unitvec_run::sampling::{random_codes, random_elements};
use unitvec_tests::{assert_no_validation_messages, files, lavapipe, repository};
use unitvec_vulkan::Device;

fn gpu(device: &Arc<Device>, textbook: &Textbook) -> TextbookGpu {
    TextbookGpu::new(device, &Compiler::new().unwrap(), textbook, true)
        .unwrap_or_else(|error| panic!("{}: {error}", textbook.id))
}

/// Every entry has its own name, a codec, and functions of that codec's kernel; a finer codec has as many bytes and is
/// finer. No function of the GLSL is left out.
#[test]
fn every_textbook_has_a_codec_and_kernels() {
    let compiler = Compiler::new().unwrap();
    let mut functions = BTreeSet::new();
    for textbook in TEXTBOOK {
        let format = textbook.format().unwrap();
        for operation in Operation::ALL {
            unitvec_lab::textbook::kernel(&compiler, textbook, operation)
                .unwrap_or_else(|error| panic!("{error}"));
            assert!(functions.insert(textbook.function(operation)), "{} stands twice", textbook.id);
        }
        if let Some(finer) = textbook.finer {
            assert_eq!(find(finer).unwrap().bytes, format.bytes, "{}", textbook.id);
            let [own, other] = [textbook.codec, finer].map(|id| accuracy::of(id, "direction"));
            assert!(other.mean < own.mean && other.max < own.max, "{}", textbook.id);
        }
    }
    for path in files(&repository().join("glsl/textbook"), &[""]) {
        let text = std::fs::read_to_string(&path).unwrap();
        let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        for name in words.filter(|word| word.ends_with("_encode") || word.ends_with("_decode")) {
            assert!(functions.contains(name), "{name} is in no row of TEXTBOOK");
        }
        assert!(text.contains("nly to measure"), "{}: the head says what it is for", path.display());
    }
}

/// Directions or frames that the committed errors are measured over, and those that a test takes.
const COUNT: usize = 1_000_000;
const FEW: usize = 30_000;

/// The errors of elements that come back finite, and the number of those that do not.
fn errors(backend: &mut dyn Backend, format: &AnyCodec, count: usize, seed: u64) -> (ElementErrors, usize) {
    let (mut errors, mut lost) = (ElementErrors::default(), 0);
    let elements = random_elements(format.element, format.domain, seed);
    round_trip(backend, format, elements, count, |element, decoded| {
        if decoded.iter().all(|c| c.is_finite()) {
            errors.add(format.element, element, decoded);
        } else {
            lost += 1;
        }
    })
    .unwrap();
    (errors, lost)
}

/// The mean error of elements that one encodes and the other decodes.
fn mean(encoder: &mut dyn Backend, decoder: &mut dyn Backend, format: &AnyCodec) -> f64 {
    let floats = format.element.floats();
    let elements: Vec<f32> = random_elements(format.element, format.domain, 3).take(FEW * floats).collect();
    let (mut codes, mut decoded) = (vec![0; FEW * format.bytes], vec![0.0; elements.len()]);
    encoder.encode(format, &elements, &mut codes).unwrap();
    decoder.decode(format, &codes, &mut decoded).unwrap();
    let mut errors = ElementErrors::default();
    let pairs = elements.chunks_exact(floats).zip(decoded.chunks_exact(floats));
    pairs.for_each(|(element, decoded)| errors.add(format.element, element, decoded));
    errors.normal.mean_deg() + errors.tangent.mean_deg()
}

/// True where each reads the other's codes about as well as its own.
fn has_same_codes(device: &Arc<Device>, textbook: &Textbook) -> bool {
    let format = textbook.format().unwrap();
    let (mut one, mut other) = (gpu(device, textbook), gpu(device, textbook));
    let reads = mean(&mut Cpu, &mut one, format) < 1.05 * mean(&mut Cpu, &mut Cpu, format);
    let is_read = mean(&mut one, &mut Cpu, format) < 1.05 * mean(&mut one, &mut other, format);
    reads && is_read
}

/// The figures of a textbook's functions, in the order of [`FIGURES`]. The maximum of vectors is the largest that a search
/// finds.
fn figures(device: &Arc<Device>, textbook: &Textbook) -> Vec<String> {
    let (format, backend) = (textbook.format().unwrap(), &mut gpu(device, textbook));
    let (errors, lost) = errors(backend, format, COUNT, 1);
    let mut max = errors.normal.max_deg();
    if format.element == Element::Vector {
        // NaN, where the search finds one, does not count here.
        max = max.max(worst_error(backend, format, 1_000_000, 1).unwrap().0);
    }
    let same = if has_same_codes(device, textbook) { "yes" } else { "no" };
    let mut figures = vec![same.into(), format!("{:.6e}", errors.normal.mean_deg()), format!("{max:.6e}")];
    let tangent = match format.element {
        Element::Vector | Element::Rotation => [String::new(), String::new()],
        Element::Frame => [errors.tangent.mean_deg(), errors.tangent.max_deg()].map(|e| format!("{e:.6e}")),
    };
    figures.extend(tangent);
    figures.push((lost * 1_000_000 / COUNT).to_string());
    figures
}

/// The vectors of a column of inputs, and whether they have a direction.
fn inputs(column: &str) -> (bool, Vec<[f32; 3]>) {
    const SIGNS: [f32; 2] = [1.0, -1.0];
    let scaled = |length: f32| {
        let signs = (0..8).map(move |bits| [0, 1, 2].map(|i| SIGNS[(bits >> i) & 1]));
        signs.map(move |[x, y, z]| [0.36 * x * length, 0.48 * y * length, 0.8 * z * length]).collect()
    };
    let replaced = |value: f32| {
        (0..3).map(move |place| [0, 1, 2].map(|i| if i == place { value } else { [0.6, 0.0, 0.8][i] }))
    };
    match column {
        "zero" => (false, vec![[0.0; 3], [-0.0; 3]]),
        "nan" => (false, replaced(f32::NAN).chain([[f32::NAN; 3]]).collect()),
        "infinity" => {
            let one = replaced(f32::INFINITY).chain(replaced(f32::NEG_INFINITY));
            (false, one.chain([[f32::INFINITY; 3]]).collect())
        }
        "signed_zeros" => (true, with_zeros()),
        "minus_z" => (true, vec![[0.0, 0.0, -1.0], [-0.0, 0.0, -1.0], [0.0, -0.0, -1.0], [-0.0, -0.0, -1.0]]),
        "long" => (true, scaled(1e20)),
        "short" => (true, scaled(1e-20)),
        "denormal" => (true, scaled(1e-39)),
        other => panic!("no inputs for {other}"),
    }
}

/// The axes but for -Z, and directions between two axes, with zeros of either sign.
fn with_zeros() -> Vec<[f32; 3]> {
    const PARTS: [f32; 6] = [0.0, -0.0, 0.6, -0.6, 1.0, -1.0];
    let mut found = Vec::new();
    for x in PARTS {
        for y in PARTS {
            for z in PARTS {
                let v = [x, y, z];
                let zeros = v.iter().filter(|c| **c == 0.0).count();
                let is_axis = zeros == 2 && x.abs() + y.abs() + z.abs() == 1.0;
                let is_between = zeros == 1 && v.iter().all(|c| c.abs() != 1.0);
                if (is_axis || is_between) && v != [0.0, 0.0, -1.0] {
                    let length = v.iter().map(|c| c * c).sum::<f32>().sqrt();
                    found.push(v.map(|c| c / length));
                }
            }
        }
    }
    found
}

/// A vector as an element: a frame has a tangent across it, next to an axis.
fn element(format: &AnyCodec, v: [f32; 3]) -> Vec<f32> {
    if format.element == Element::Vector {
        return v.to_vec();
    }
    let n = DVec3::from_array(v.map(f64::from)).normalize_or_zero();
    let axis = if n.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
    let tangent = (axis - axis.dot(n) * n).normalize_or(axis).as_vec3();
    [&v[..], &tangent.to_array(), &[1.0]].concat()
}

/// The name of a decoded element: NaN, an axis, or its normal's components.
fn name(decoded: &[f32]) -> String {
    if decoded.iter().any(|c| !c.is_finite()) {
        return "NaN".into();
    }
    let v = [decoded[0], decoded[1], decoded[2]];
    for (i, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
        for (sign, value) in [("+", 1.0), ("-", -1.0)] {
            let mut direction = [0.0; 3];
            direction[i] = value;
            if unitvec::angle_deg(direction, v) < 1.0 {
                return format!("{sign}{axis}");
            }
        }
    }
    format!("({:.1} {:.1} {:.1})", v[0], v[1], v[2])
}

/// The decoded vectors of inputs, in words.
fn outcome(backend: &mut dyn Backend, format: &AnyCodec, column: &str) -> String {
    let (has_direction, mut vectors) = inputs(column);
    if format.domain == Domain::Hemisphere {
        if column == "minus_z" {
            return "outside".into();
        }
        if has_direction {
            vectors.iter_mut().for_each(|v| v[2] = v[2].abs());
        }
    }
    let elements: Vec<f32> = vectors.iter().flat_map(|v| element(format, *v)).collect();
    let (mut codes, mut decoded) = (vec![0; vectors.len() * format.bytes], vec![0.0; elements.len()]);
    backend.encode(format, &elements, &mut codes).unwrap();
    backend.decode(format, &codes, &mut decoded).unwrap();
    let floats = format.element.floats();
    let pairs: Vec<(&[f32], &[f32])> =
        elements.chunks_exact(floats).zip(decoded.chunks_exact(floats)).collect();
    if has_direction { of_directions(format, &pairs) } else { of_none(&pairs) }
}

fn of_none(pairs: &[(&[f32], &[f32])]) -> String {
    let names: BTreeSet<String> = pairs.iter().map(|(_, decoded)| name(decoded)).collect();
    if names.len() > 2 { "various".into() } else { names.into_iter().collect::<Vec<_>>().join(" or ") }
}

/// Directions are right to a degree, or to the codec's bound where that is more.
fn of_directions(format: &AnyCodec, pairs: &[(&[f32], &[f32])]) -> String {
    let bound = f64::from(format.max_error_deg()).max(1.0);
    let (mut worst, mut wrong, mut nan) = (0.0f64, BTreeSet::new(), false);
    for (element, decoded) in pairs {
        let mut errors = ElementErrors::default();
        errors.add(format.element, element, decoded);
        let error = errors.normal.max_deg().max(errors.tangent.max_deg());
        nan |= decoded.iter().any(|c| !c.is_finite());
        wrong.insert(if error > bound { name(decoded) } else { String::new() });
        worst = worst.max(error);
    }
    let is_one = wrong.len() == 1 && wrong.iter().all(|name| name.starts_with(['+', '-']));
    match (nan, worst > bound) {
        (true, true) => format!("NaN or off by {worst:.0}°"),
        (true, false) => "NaN".into(),
        (false, false) => "right".into(),
        (false, true) if is_one => wrong.into_iter().collect(),
        (false, true) => format!("off by {worst:.0}°"),
    }
}

/// The decoded vectors of all codes of up to 24 bits, in words: unit vectors or not.
fn of_codes(backend: &mut dyn Backend, format: &AnyCodec) -> String {
    let (mut nan, mut least, mut most) = (false, f64::INFINITY, 0.0f64);
    let codes = codes(format);
    let mut decoded = vec![0.0; CHUNK * format.element.floats()];
    for codes in codes.chunks(CHUNK * format.bytes) {
        let decoded = &mut decoded[..codes.len() / format.bytes * format.element.floats()];
        backend.decode(format, codes, decoded).unwrap();
        for element in decoded.chunks_exact(format.element.floats()) {
            for vector in element.chunks_exact(3).take(element.len() / 3) {
                let length = vector.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt();
                nan |= !length.is_finite();
                (least, most) = (least.min(length), most.max(length));
            }
        }
    }
    let lengths = if least > 1.0 - 1e-5 && most < 1.0 + 1e-5 {
        "unit length".to_owned()
    } else {
        format!("{least:.2} to {most:.2} long")
    };
    if nan { format!("{lengths} or NaN") } else { lengths }
}

/// All codes of up to 24 bits; of more, those whose bytes are at the ends of ranges, or one in 37, and random
/// ones.
fn codes(format: &AnyCodec) -> Vec<u8> {
    const ENDS: [u8; 6] = [0x00, 0x01, 0x7f, 0x80, 0x81, 0xff];
    let bytes = format.bytes;
    if bytes <= 3 {
        return (0..1u32 << (8 * bytes))
            .flat_map(|code| code.to_le_bytes().into_iter().take(bytes))
            .collect();
    }
    let every = if bytes > 6 { 37 } else { 1 };
    let ends = (0..6usize.pow(bytes as u32))
        .step_by(every)
        .flat_map(|number| (0..bytes).map(move |i| ENDS[number / 6usize.pow(i as u32) % 6]));
    let random = random_codes(5).take(1 << 18).flat_map(|code| code.to_le_bytes().into_iter().take(bytes));
    ends.chain(random).collect()
}

/// The cells of [`INPUTS`].
fn outcomes(backend: &mut dyn Backend, format: &AnyCodec) -> Vec<String> {
    let of = |(column, _): &(&str, &str)| match *column {
        "codes" => of_codes(backend, format),
        column => outcome(backend, format, column),
    };
    INPUTS.iter().map(of).collect()
}

/// Measures the figures of docs/textbook.md.
#[test]
#[ignore = "`cargo xtask renew textbook` runs it: a minute or two"]
fn measure() {
    let columns = FIGURES.into_iter().chain(INPUTS.map(|(column, _)| column));
    let mut text = format!("id,source,{}\n", columns.collect::<Vec<_>>().join(","));
    let device = lavapipe();
    for textbook in TEXTBOOK {
        let format = textbook.format().unwrap();
        let backend = &mut gpu(&device, textbook);
        let rows = [
            (figures(&device, textbook), outcomes(backend, format)),
            // The errors of codecs are in accuracy.csv.
            (vec![String::new(); FIGURES.len()], outcomes(&mut Cpu, format)),
        ];
        for (source, (figures, outcomes)) in SOURCES.iter().zip(rows) {
            text += &format!("{},{source},{}\n", textbook.id, [figures, outcomes].concat().join(","));
        }
    }
    unitvec_files::write_file(&repository().join("docs/data/textbook.csv"), text.as_bytes()).unwrap();
}

/// The committed figures match the functions: errors to five standard errors of a smaller sample, the rest to the
/// letter.
#[test]
fn committed_figures_are_what_textbooks_do() {
    let device = lavapipe();
    for textbook in TEXTBOOK {
        let format = textbook.format().unwrap();
        let mut backend = gpu(&device, textbook);
        let (fresh, _) = errors(&mut backend, format, FEW, 2);
        for (column, fresh) in [("", fresh.normal), ("tangent_", fresh.tangent)] {
            if fresh.max_deg() > 0.0 {
                let off = (fresh.mean_deg() - number(textbook.id, &format!("{column}mean_deg"))).abs();
                assert!(off < 5.0 * fresh.standard_error_deg(), "{} {column}: {fresh:?}", textbook.id);
                let max = number(textbook.id, &format!("{column}max_deg"));
                assert!(fresh.max_deg() < 1.02 * max, "{} {column}: {fresh:?}", textbook.id);
            }
        }
        let all: [(&str, Vec<String>); 2] =
            [("textbook", outcomes(&mut backend, format)), ("unitvec", outcomes(&mut Cpu, format))];
        for (source, outcomes) in all {
            for ((column, _), fresh) in INPUTS.iter().zip(outcomes) {
                let committed = cell(textbook.id, source, column);
                assert_eq!(
                    committed, fresh,
                    "{}, {source}, {column}: cargo xtask renew textbook",
                    textbook.id
                );
            }
        }
    }
    assert_no_validation_messages(device);
}

/// The table's lengths are those that leave the least error, by the oracle's measure.
#[test]
fn lengths_of_the_table_are_the_best() {
    let table = best_fit_table();
    assert_eq!(table.len(), 1 << 20);
    for index in (0..table.len()).step_by(4099) {
        let middle = |texel: usize| (texel as f64 + 0.5) / 1024.0;
        let (x, y) = (middle(index % 1024), middle(index / 1024));
        let error = |length: u8| error_at_length([1.0, x, x * y], f64::from(length));
        let least = (1..=127).map(error).fold(f64::INFINITY, f64::min);
        assert!(error(table[index]) < least + 1e-7, "{index}: {} leaves more than {least}", table[index]);
    }
}

/// The survey's figures for the same representations, within the noise of two samples of 10^6 and half a unit of the
/// last digit. The survey's maxima are those of a sample: ours lie between them and 3 % above.
#[test]
fn errors_are_the_surveys() {
    let mut compared = BTreeSet::new();
    for textbook in TEXTBOOK {
        let codec = find(textbook.codec).unwrap();
        let table = if codec.domain == Domain::Sphere { Table::One } else { Table::Three };
        let rows = table.published();
        let Some(row) = rows.iter().find(|row| row.name == codec.survey_name && codec.id == textbook.id)
        else {
            continue;
        };
        let [mean, max] = ["mean_deg", "max_deg"].map(|column| number(textbook.id, column));
        // Half a unit of the last of five decimals, and the spread of means over 10^6 directions.
        let mean_is = |factor: f64| (mean - factor * row.mean_error_deg).abs() < 0.5e-5 + 2e-3 * mean;
        let max_is = |factor: f64| {
            max > 0.99 * factor * row.max_error_deg - 0.5e-5
                && max < 1.035 * (factor * row.max_error_deg + 0.5e-5)
        };
        let (mean_factor, max_factor) = departure(textbook.id);
        assert!(mean_is(mean_factor), "{}: mean {mean}, {row:?}", textbook.id);
        assert!(max_is(max_factor), "{}: maximum {max}, {row:?}", textbook.id);
        compared.insert(textbook.id);
    }
    assert_eq!(compared.len(), 15, "{compared:?}");
}

/// The factors by which mean and maximum differ from the survey's, and why.
fn departure(id: &str) -> (f64, f64) {
    match id {
        // Float32 cannot tell the cosines of neighbours of 24 bits apart. That the survey compared more digits is our inference.
        "oct24p" => (1.0355, 1.40),
        "oct32p" => (2.12, 3.0),
        // 254 steps of phi a turn; the survey's maximum is that of 256.
        "spherical16" => (1.0034, 1f64.hypot(2.0) / 1f64.hypot(2.0 * 127.0 / 128.0)),
        // lavapipe's acos, atan, sin and cos.
        "spherical32" => (3.17, 1.45),
        // Points beyond the circle have z = 0 here.
        "xyonly16" => (1.0113, 1.04),
        "xyonly32" => (1.0065, 1.04),
        _ => (1.0, 1.0),
    }
}
