use super::run::Json;
use super::table::{self, Layout, left, right};
use clap::Args;
use std::fmt::Display;
use std::process::ExitCode;
use unitvec::interop::{FRAMES, ROTATIONS, ROWS, RotationFormat};
use unitvec_catalogue::{AnyCodec, CODECS, Domain, WRAPPED, frames, rotations, vectors};
use unitvec_host::Result;

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    json: Json,
    #[command(flatten)]
    wide: table::Wide,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let columns = arguments.wide.columns()?;
    arguments.json.write_or_print(&CODECS.as_slice(), || tables(columns))
}

fn yes(flag: bool) -> &'static str {
    if flag { "yes" } else { "no" }
}

fn tables(columns: Option<usize>) -> String {
    let of_vectors = Layout::new(
        vec![
            left("codec", 20),
            left("survey", 19).rank(5),
            right("bits", 4),
            right("bytes", 5),
            left("domain", 7).apart(),
            right("bound (deg)", 15),
            left("unit", 5).apart().rank(3),
            left("axes", 5).rank(4),
            left("stable", 6).rank(6),
            left("Vulkan format", 35).rank(1),
            left("GLSL", 19).rank(2),
        ],
        columns,
    );
    let mut text = of_vectors.heading();
    for codec in vectors() {
        let domain = match codec.domain {
            Domain::Sphere => "sphere",
            Domain::Hemisphere => "z >= 0",
        };
        text += &of_vectors.line(&[
            &codec.id,
            &codec.survey_name,
            &codec.bits,
            &codec.bytes,
            &domain,
            &format_args!("{:.7}", codec.max_error_deg()),
            &yes(codec.is_unit),
            &yes(codec.exact_axes),
            &yes(codec.stable_across_devices),
            &codec.vk_format.unwrap_or("-"),
            &codec.glsl_file(),
        ]);
    }
    let of_frames =
        of_others("codec of frames", &[("normal bound (deg)", 22), ("tangent bound (deg)", 23)], columns);
    let of_rotations = of_others("codec of rotations", &[("bound (deg)", 22)], columns);
    let of_wrapped = of_others("axes, lengths", &[("bound (deg)", 22)], columns);
    for (layout, codecs) in [(&of_frames, frames()), (&of_rotations, rotations()), (&of_wrapped, &WRAPPED)] {
        text += &format!("\n{}", layout.heading());
        text.extend(codecs.iter().map(|codec| line_of_other(layout, codec)));
    }
    let rotation = |RotationFormat { name, widths: [least, most], .. }: &RotationFormat| match least < most {
        true => format!("{name}:{least}-{most}"),
        false => (*name).to_owned(),
    };
    let frames = FRAMES.iter().map(|format| format.name.to_owned());
    let names = ROWS.iter().map(ToString::to_string).chain(frames).chain(ROTATIONS.iter().map(rotation));
    let names = names.collect::<Vec<_>>().join(", ");
    let words = format!("\nformats of other software, for encode, decode, error and snap: {names}\n");
    // A list has no columns to show: lines of a length that is easy to read, on any terminal.
    let wrapped = table::wrapped(&words, "    ", Some(columns.map_or(100, |columns| columns.min(100))));
    text + &wrapped + &table::left_out(&[&of_vectors, &of_frames, &of_rotations, &of_wrapped])
}

/// The columns of codecs of other elements than vectors, with these bounds.
fn of_others(title: &'static str, bounds: &[(&'static str, usize)], columns: Option<usize>) -> Layout {
    let mut all = vec![left(title, 20), right("bits", 4), right("bytes", 5)];
    let bounds = bounds.iter().enumerate().map(|(at, (title, width))| match at {
        0 => right(title, *width).apart(),
        _ => right(title, *width),
    });
    all.extend(bounds);
    all.extend([left("Vulkan format", 35).apart().rank(1), left("GLSL", 19).rank(2)]);
    Layout::new(all, columns)
}

/// The line of a codec in [`of_others`].
fn line_of_other(layout: &Layout, codec: &AnyCodec) -> String {
    let bounds: Vec<String> = codec.max_errors_deg.iter().map(|bound| format!("{bound:.7}")).collect();
    let (format, file) = (codec.vk_format.unwrap_or("-"), codec.glsl_file());
    let mut cells: Vec<&dyn Display> = vec![&codec.id, &codec.bits, &codec.bytes];
    cells.extend(bounds.iter().map(|bound| bound as &dyn Display));
    cells.extend([&format as &dyn Display, &file]);
    layout.line(&cells)
}
