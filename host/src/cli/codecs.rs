use super::{print, to_json};
use clap::Args;
use std::fmt::Write;
use std::process::ExitCode;
use unitvec_host::Result;
use unitvec_host::catalogue::{
    CATALOGUE, CodecInfo, Coding, Domain, Element, FRAMES, Format, FrameInfo, Operation,
};

#[derive(Args)]
pub struct Arguments {
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    print(&if arguments.json { to_json(&entries()) } else { table() })
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

fn table() -> String {
    let mut text = format!(
        "{:<20} {:<19} {:>4} {:>5}  {:<7} {:>15}  {:<5} {:<5} {:<35} {}\n",
        "codec",
        "survey",
        "bits",
        "bytes",
        "domain",
        "max error (deg)",
        "unit",
        "axes",
        "Vulkan format",
        "GLSL"
    );
    for codec in CATALOGUE {
        let domain = match codec.domain {
            Domain::Sphere => "sphere",
            Domain::Hemisphere => "z >= 0",
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:<20} {:<19} {:>4} {:>5}  {domain:<7} {:>15.7}  {:<5} {:<5} {:<35} {}",
            codec.id,
            codec.survey_name,
            codec.bits,
            codec.bytes,
            codec.max_error_deg,
            yes(codec.is_unit),
            yes(codec.exact_axes),
            codec.vk_format.unwrap_or("-"),
            codec.glsl_file()
        );
    }
    let _ = writeln!(
        text,
        "\n{:<20} {:>4} {:>5}  {:>22} {:>23}  {:<35} GLSL",
        "codec of frames",
        "bits",
        "bytes",
        "max normal error (deg)",
        "max tangent error (deg)",
        "Vulkan format"
    );
    for codec in FRAMES {
        let _ = writeln!(
            text,
            "{:<20} {:>4} {:>5}  {:>22.7} {:>23.7}  {:<35} {}",
            codec.id,
            codec.bits,
            codec.bytes,
            codec.max_normal_error_deg,
            codec.max_tangent_error_deg,
            codec.vk_format,
            codec.glsl_file()
        );
    }
    text
}
