use super::{print, to_json};
use clap::Args;
use std::fmt::Write;
use std::process::ExitCode;
use unitvec_host::Result;
use unitvec_host::catalogue::{CATALOGUE, CodecInfo, Direction, Domain};

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
    #[serde(flatten)]
    codec: &'static CodecInfo,
    /// Entry point of the encoding kernel, and name of the GLSL function.
    encode_function: String,
    /// Entry point of the decoding kernel, and name of the GLSL function.
    decode_function: String,
}

fn entries() -> Vec<Entry> {
    let entry = |codec: &'static CodecInfo| Entry {
        codec,
        encode_function: codec.function(Direction::Encode),
        decode_function: codec.function(Direction::Decode),
    };
    CATALOGUE.iter().map(entry).collect()
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
    text
}
