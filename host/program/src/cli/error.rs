use super::many::Failed;
use super::run::{Json, Live};
use super::table::{Layout, Wide, left, left_out, right, wrapped};
use super::{Buffers, OpenBackend, Vulkan, check_backend, degrees, dtype, expect, files_of, is_mesh};
use clap::Args;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, Domain, Element, Measure, RECOMMENDED, Recommendation, find, find_any};
use unitvec_files::shown;
use unitvec_host::fit::Fit;
use unitvec_host::input::{Elements, FileName, Kind};
use unitvec_host::loss::{AS_IT_IS, Meter, Quantised, Report, Row, Worst};
use unitvec_host::raw::Dtype;
use unitvec_host::stream::Named;
use unitvec_host::{Error, Result};
use unitvec_run::backend::BackendKind;

#[derive(Args)]
pub struct Arguments {
    /// Codec, or format of other software, as `unitvec codecs` lists them; may be given again: all of vectors, or all of
    /// frames. If none is given, those that the README recommends for vectors in any direction. A format has a row for its
    /// own software's encoder, and one for the nearest codes. One of axes has all measured as axes, one of vectors with a
    /// length all by |d - v| / |v|.
    #[arg(long, visible_alias = "format", value_name = "ID,...", value_delimiter = ',')]
    codec: Vec<String>,
    /// File that FILE was made from, with as many vectors in the same order: measure how far FILE's are from it, and what
    /// codecs make of it: without --codec, the formats that FILE's vectors fit, or else the recommended ones.
    #[arg(long, value_name = "FILE")]
    original: Option<PathBuf>,
    /// What runs the codecs.
    #[arg(long, value_enum, default_value = "cpu")]
    backend: BackendKind,
    /// Kind of raw floats: f64, f16, or a big-endian one such as f32be; f32 if not given.
    #[arg(long, value_name = "KIND", value_parser = dtype())]
    dtype: Option<Dtype>,
    /// Take the files as raw floats, whatever their names and first bytes say.
    #[arg(long)]
    raw: bool,
    #[command(flatten)]
    buffers: Buffers,
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    wide: Wide,
    #[command(flatten)]
    vulkan: Vulkan,
    /// What `unitvec encode` takes: meshes, normal maps (png, jpeg, tga, exr, ktx2, dds), NumPy arrays, raw floats, or
    /// folders, whose meshes are taken; - for the standard input.
    #[arg(required = true)]
    file: Vec<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let columns = arguments.wide.columns()?;
    let kind = Kind { raw: arguments.raw, dtype: arguments.dtype, reach: arguments.buffers.reach() };
    let (made, original) = (&arguments.file[0], arguments.original.as_ref());
    let is_stream = |path: &PathBuf| path.as_os_str() == "-";
    if original
        .is_some_and(|original| arguments.file.len() > 1 || [original, made].into_iter().any(is_stream))
    {
        let words = "--original takes one FILE, and neither may be -: both are read twice";
        return Err(Error::Usage(words.to_owned()));
    }
    let mut ids = arguments.codec.clone();
    if original.is_some() && ids.is_empty() {
        let mut floats = Elements::open(made, Element::Vector, kind)?.floats;
        ids = Fit::of(Named::new(made, &mut floats))?.least();
    }
    let formats = formats(&ids)?;
    formats.iter().try_for_each(|format| check_backend(format, arguments.backend))?;
    let mut meter = Meter::new(formats)?;
    let mut open = OpenBackend::open(arguments.backend, &arguments.vulkan)?;
    if arguments.file.iter().filter(|path| is_stream(path)).count() > 1 {
        return Err(Error::Usage("- can be read once; name it once".to_owned()));
    }
    // What is missing is told before minutes of measuring.
    let files = match original {
        Some(original) => vec![original.clone()],
        None => files_of(&arguments.file, is_mesh)?,
    };
    arguments.json.spare(files.iter().chain(&arguments.file))?;
    files.iter().try_for_each(|path| Elements::check(path, arguments.raw))?;
    let work = Some(files.len() as u64);
    let live = Live::new(work, "{wide_msg} file {pos} of {len}, {elapsed}", true);
    let (mut computed, mut warnings) = (Vec::new(), Vec::new());
    let mut failed = Failed::of(files.len());
    for path in &files {
        live.advance(1);
        let measured = Elements::open(path, meter.element(), kind).and_then(|mut elements| {
            let unit = meter.element().plural();
            let mut read = 0;
            let mut progress = |done| {
                read = done;
                live.name(format!("{}: {done} {unit}", path.display()));
            };
            let backend = open.backend.as_mut();
            let suspicion = meter.measure(backend, Named::new(path, &mut elements.floats), &mut progress)?;
            Ok((elements, suspicion, read))
        });
        let Some((elements, suspicion, read)) = failed.unless(measured)? else { continue };
        // It is in the report by now.
        expect(path, elements.count, read)?;
        if elements.are_computed() {
            computed.push(FileName::from(path.as_path()));
        }
        let suspicion =
            suspicion.filter(|found| found.applies(elements.is_guess)).map(|found| found.to_string());
        let warning = suspicion.or(elements.note);
        warnings.extend(warning.map(|words| shown(format_args!("{}: {words}", path.display()))));
    }
    live.finish();
    if let Some(original) = original {
        warnings.extend(compare(&mut meter, original, made, kind)?);
    }
    let kind = meter.kind();
    let report = Report { computed, warnings, ..meter.report() };
    if !report.rows.is_empty() {
        arguments.json.write_or_print(&report, || text(&report, kind, columns))?;
    }
    let status = open.close();
    failed.end()?;
    Ok(status)
}

/// Measures a file beside its original. Returns a warning where they seem to be of different orders.
fn compare(meter: &mut Meter, original: &Path, made: &Path, kind: Kind) -> Result<Option<String>> {
    /// More than formats of any use lose.
    const FAR_DEG: f64 = 20.0;
    let [mut of_original, mut of_made] =
        [Elements::open(original, meter.element(), kind)?, Elements::open(made, meter.element(), kind)?];
    let [first, second] = [original, made].map(FileName::from);
    if let Some((a, b)) = of_original.count.zip(of_made.count).filter(|(a, b)| a != b) {
        let unit = meter.element().plural();
        return Err(Error::Usage(format!(
            "{second} has {b} {unit}, and {first} {a}: compare files whose vertices were not joined, split or left out"
        )));
    }
    let mean = meter
        .compare(Named::new(original, &mut of_original.floats), Named::new(made, &mut of_made.floats))?;
    let far = if meter.kind() == Measure::Relative { FAR_DEG.to_radians() } else { FAR_DEG };
    let is_far = mean.is_some_and(|mean| mean > far);
    Ok(is_far.then(|| format!("{second} is far from {first}: are its vectors in the same order?")))
}

/// The codecs chosen; else those of the README's table that take any vector.
fn formats(ids: &[String]) -> Result<Vec<&'static AnyCodec>> {
    if !ids.is_empty() {
        let chosen = ids.iter().map(|id| Ok(find_any(id)?)).collect::<Result<Vec<_>>>()?;
        let mut rows = Vec::new();
        for one in chosen.into_iter().flat_map(|one| one.plain().into_iter().chain([one])) {
            if !rows.contains(&one) {
                rows.push(one);
            }
        }
        return Ok(rows);
    }
    let recommended =
        RECOMMENDED.iter().flat_map(Recommendation::short).filter_map(|choice| find(choice.id).ok());
    let is_for_all =
        |format: &&AnyCodec| format.element == Element::Vector && format.domain == Domain::Sphere;
    Ok(recommended.filter(is_for_all).collect())
}

/// Characters of a file's name that a terminal shows.
const SHOWN: usize = 24;

fn text(report: &Report, kind: Measure, columns: Option<usize>) -> String {
    // The total of one file says nothing new.
    let of_codecs = report.rows.iter().filter(|row| row.id != AS_IT_IS).count();
    let totals = report.totals.iter().filter(|_| of_codecs > report.totals.len());
    let rows: Vec<_> = report.rows.iter().chain(totals).map(|row| cells(row, columns)).collect();
    let width = |at: usize| rows.iter().map(|cells| cells[at].chars().count()).max().unwrap_or(0);
    let is_of_frames = report.rows.iter().any(|row| row.part != "vector");
    let leaves_out = report.rows.iter().any(|row| row.left_out > 0);
    let layout = Layout::new(
        vec![
            left("file", width(0)),
            left("codec", width(1)),
            left("of", width(2)).rank(if is_of_frames { 0 } else { 6 }),
            right("bits", width(3)).rank(3),
            right("vectors", width(4)).rank(5),
            right("left out", width(5)).rank(if leaves_out { 0 } else { 4 }),
            right("mean", width(6)).apart(),
            right("median", width(7)).rank(2),
            right("p99", width(8)).rank(1),
            right("max", width(9)),
            left("worst: index, vector", width(10)).apart().rank(7),
        ],
        columns,
    );
    let heading = match kind {
        Measure::Angle => "errors in degrees, over the vectors that have a direction\n",
        Measure::Axis => {
            "errors in degrees, of axes: v and -v are alike, over the vectors that have a direction\n"
        }
        Measure::Relative => {
            "errors |d - v| / |v| of vectors v and the decoded ones, d, over the finite vectors\n"
        }
    };
    let mut text = wrapped(heading, "", columns);
    text += &layout.heading();
    rows.iter().for_each(|cells| text += &layout.line(&cells.each_ref().map(|cell| cell as &dyn Display)));
    for words in &report.warnings {
        text += &wrapped(&format!("warning: {words}\n"), "    ", columns);
    }
    for Quantised { file, formats } in &report.quantised {
        text += &wrapped(&format!("{file}: its vectors fit {}\n", formats.join(", ")), "    ", columns);
    }
    if !report.computed.is_empty() {
        let names: Vec<_> = report.computed.iter().map(FileName::to_string).collect();
        text += &wrapped(&format!("normals computed from faces: {}\n", names.join(", ")), "    ", columns);
    }
    if report.totals.iter().any(|row| find(row.id).is_ok_and(|codec| codec.domain == Domain::Hemisphere)) {
        let words = "hemioct and xyonly take z < 0 as z = 0: that counts as error\n";
        text += &wrapped(words, "    ", columns);
    }
    text + &left_out(&[&layout])
}

fn cells(row: &Row, columns: Option<usize>) -> [String; 11] {
    let sizes = row.errors.as_ref().map(|errors| errors.sizes.map(degrees));
    let [mean, median, p99, max] = sizes.unwrap_or([(); 4].map(|()| "-".to_owned()));
    [
        file(row, columns),
        row.id.to_owned(),
        row.part.to_owned(),
        row.bits.to_string(),
        row.count.to_string(),
        row.left_out.to_string(),
        mean,
        median,
        p99,
        max,
        worst(row),
    ]
}

/// A row's file; the end of a long name on a terminal.
fn file(row: &Row, columns: Option<usize>) -> String {
    let name = row.file.as_ref().map_or_else(|| "all files".to_owned(), FileName::to_string);
    match columns.and_then(|_| name.char_indices().rev().nth(SHOWN)) {
        Some(_) => {
            format!("...{}", &name[name.char_indices().rev().nth(SHOWN - 4).map_or(0, |(at, _)| at)..])
        }
        None => name,
    }
}

/// The worst vector's place and components, with its file where the row is of all.
fn worst(row: &Row) -> String {
    let Some(Worst { file, index, original, .. }) = row.errors.as_ref().map(|errors| &errors.worst) else {
        return "-".to_owned();
    };
    let file = if row.file.is_none() { format!("{file} ") } else { String::new() };
    let components: Vec<String> = original.iter().map(|component| format!("{component:?}")).collect();
    format!("{file}{index}: ({})", components.join(", "))
}
