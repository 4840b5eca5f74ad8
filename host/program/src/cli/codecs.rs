use super::run::Json;
use super::table::{self, Layout, left, right};
use clap::Args;
use std::process::ExitCode;
use unitvec::interop::{FRAMES, ROTATIONS, ROWS};
use unitvec_catalogue::{CODECS, Domain, frames, rotations, vectors};
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
    let of_frames = Layout::new(
        vec![
            left("codec of frames", 20),
            right("bits", 4),
            right("bytes", 5),
            right("normal bound (deg)", 22).apart(),
            right("tangent bound (deg)", 23),
            left("Vulkan format", 35).apart().rank(1),
            left("GLSL", 19).rank(2),
        ],
        columns,
    );
    let of_rotations = Layout::new(
        vec![
            left("codec of rotations", 20),
            right("bits", 4),
            right("bytes", 5),
            right("bound (deg)", 22).apart(),
            left("Vulkan format", 35).apart().rank(1),
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
    text.push('\n');
    text += &of_frames.heading();
    for codec in frames() {
        text += &of_frames.line(&[
            &codec.id,
            &codec.bits,
            &codec.bytes,
            &format_args!("{:.7}", codec.max_errors_deg[0]),
            &format_args!("{:.7}", codec.max_errors_deg[1]),
            &codec.vk_format.unwrap_or("-"),
            &codec.glsl_file(),
        ]);
    }
    text.push('\n');
    text += &of_rotations.heading();
    for codec in rotations() {
        text += &of_rotations.line(&[
            &codec.id,
            &codec.bits,
            &codec.bytes,
            &format_args!("{:.7}", codec.max_error_deg()),
            &codec.vk_format.unwrap_or("-"),
            &codec.glsl_file(),
        ]);
    }
    let of_others = FRAMES
        .iter()
        .map(|format| format.name)
        .chain(ROTATIONS.iter().map(|format| format.name))
        .map(str::to_owned);
    let names = ROWS.iter().map(ToString::to_string).chain(of_others);
    let names = names.collect::<Vec<_>>().join(", ");
    let words = format!("\nformats of other software, for encode, decode, error and snap: {names}\n");
    // A list has no columns to show: lines of a length that is easy to read, on any terminal.
    let wrapped = table::wrapped(&words, "    ", Some(columns.map_or(100, |columns| columns.min(100))));
    text + &wrapped + &table::left_out(&[&of_vectors, &of_frames, &of_rotations])
}
