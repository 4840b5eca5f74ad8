use super::{print, to_json};
use clap::Args;
use std::fmt::Write;
use std::process::ExitCode;
use unitvec_host::Result;
use unitvec_host::catalogue::{CATALOGUE, Domain};

#[derive(Args)]
pub struct Arguments {
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    print(&if arguments.json { to_json(&CATALOGUE) } else { table() })
}

fn table() -> String {
    let mut text = format!(
        "{:<11} {:<11} {:>4} {:>5}  {:<10} {:>14}  {:<22} {}\n",
        "codec", "survey", "bits", "bytes", "domain", "max error (deg)", "Vulkan format", "GLSL"
    );
    for codec in CATALOGUE {
        let domain = match codec.domain {
            Domain::Sphere => "sphere",
            Domain::Hemisphere => "z >= 0",
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:<11} {:<11} {:>4} {:>5}  {domain:<10} {:>14.5}  {:<22} {}",
            codec.id,
            codec.survey_name,
            codec.bits,
            codec.bytes,
            codec.max_error_deg,
            codec.vk_format.unwrap_or("-"),
            codec.glsl_file
        );
    }
    text
}
