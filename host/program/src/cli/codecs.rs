use super::table::{self, Layout, left, right};
use super::{print, to_json};
use clap::Args;
use std::process::ExitCode;
use unitvec_catalogue::{
    CATALOGUE, CodecInfo, Coding, Domain, Element, FRAMES, Format, FrameInfo, Operation,
};
use unitvec_host::Result;

#[derive(Args)]
pub struct Arguments {
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    wide: table::Wide,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    print(&if arguments.json { to_json(&entries()) } else { tables(arguments.wide.columns()?) })
}

/// A row of `--json`: what the catalogue says, and the names to call.
#[derive(serde::Serialize)]
struct Entry {
    element: Element,
    #[serde(flatten)]
    codec: Codec,
    /// Entry point of the encoding kernel, and name of the GLSL function.
    encode_function: String,
    /// Entry point of the decoding kernel, and name of the GLSL function.
    decode_function: String,
}

#[derive(serde::Serialize)]
#[serde(untagged)]
enum Codec {
    Vector(&'static CodecInfo),
    Frame(&'static FrameInfo),
}

fn entries() -> Vec<Entry> {
    let entry = |format: Format, codec: Codec| Entry {
        element: format.element,
        codec,
        encode_function: format.function(Operation::Encode),
        decode_function: format.function(Operation::Decode),
    };
    let vectors = CATALOGUE.iter().map(|codec| entry(codec.format(), Codec::Vector(codec)));
    vectors.chain(FRAMES.iter().map(|codec| entry(codec.format(), Codec::Frame(codec)))).collect()
}

fn yes(flag: bool) -> &'static str {
    if flag { "yes" } else { "no" }
}

fn tables(columns: Option<usize>) -> String {
    let vectors = Layout::new(
        vec![
            left("codec", 20),
            left("survey", 19).rank(5),
            right("bits", 4),
            right("bytes", 5),
            left("domain", 7).apart(),
            right("max error (deg)", 15),
            left("unit", 5).apart().rank(3),
            left("axes", 5).rank(4),
            left("stable", 6).rank(6),
            left("Vulkan format", 35).rank(1),
            left("GLSL", 19).rank(2),
        ],
        columns,
    );
    let frames = Layout::new(
        vec![
            left("codec of frames", 20),
            right("bits", 4),
            right("bytes", 5),
            right("max normal error (deg)", 22).apart(),
            right("max tangent error (deg)", 23),
            left("Vulkan format", 35).apart().rank(1),
            left("GLSL", 19).rank(2),
        ],
        columns,
    );
    let mut text = vectors.heading();
    for codec in CATALOGUE {
        let domain = match codec.domain {
            Domain::Sphere => "sphere",
            Domain::Hemisphere => "z >= 0",
        };
        text += &vectors.line(&[
            &codec.id,
            &codec.survey_name,
            &codec.bits,
            &codec.bytes,
            &domain,
            &format_args!("{:.7}", codec.max_error_deg),
            &yes(codec.is_unit),
            &yes(codec.exact_axes),
            &yes(codec.stable_across_devices),
            &codec.vk_format.unwrap_or("-"),
            &codec.glsl_file(),
        ]);
    }
    text.push('\n');
    text += &frames.heading();
    for codec in FRAMES {
        text += &frames.line(&[
            &codec.id,
            &codec.bits,
            &codec.bytes,
            &format_args!("{:.7}", codec.max_normal_error_deg),
            &format_args!("{:.7}", codec.max_tangent_error_deg),
            &codec.vk_format,
            &codec.glsl_file(),
        ]);
    }
    text + &table::left_out(&[&vectors, &frames])
}
