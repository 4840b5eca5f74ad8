use super::{Vulkan, counts, print, status_after_validation, to_json};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use unitvec_host::backend::{Gpu, KernelSource};
use unitvec_host::catalogue::{self, CATALOGUE, CodecInfo, FRAMES, FrameInfo};
use unitvec_host::conform::{self, Options, Report, Row};
use unitvec_host::vulkan::DeviceInfo;
use unitvec_host::{Result, glsl, mesh, output};

#[derive(Args)]
pub struct Arguments {
    /// Codec to run, as `unitvec codecs` lists them; may be given again. All of them if not given.
    #[arg(long, value_name = "ID")]
    codec: Vec<String>,
    /// Random directions for each codec.
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = counts())]
    count: u64,
    /// Seed of the random directions.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Write the report as JSON as well; - for the standard output, instead of the table.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    vulkan: Vulkan,
    /// Meshes whose normals are encoded too (obj, ply, gltf, glb); the Stanford bunny if none is given.
    mesh: Vec<PathBuf>,
}

/// The mesh that ships with the program.
const BUNNY: &[u8] = include_bytes!("../../../tests/data/bunny.obj");

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let (codecs, frames) = chosen_codecs(&arguments.codec)?;
    let options =
        Options { count: arguments.count as usize, seed: arguments.seed, normals: normals(&arguments.mesh)? };
    let device = arguments.vulkan.device()?;
    let mut spirv = Gpu::new(&device, KernelSource::Spirv(arguments.vulkan.modules()?), true)?;
    let mut glsl = Gpu::new(&device, KernelSource::Glsl(glsl::Compiler::new()?), true)?;

    let to_stdout = arguments.json.as_deref() == Some(Path::new("-"));
    if !to_stdout {
        print(&heading(device.info(), &options))?;
    }
    let work: u64 = codecs.iter().map(|codec| conform::work(codec, &options)).sum();
    let bar = progress_bar(work + frames.len() as u64 * conform::frame_work(&options));
    let mut rows = Vec::new();
    let mut finish = |row: Row| -> Result<()> {
        if !to_stdout {
            let mut printed = Ok(ExitCode::SUCCESS);
            bar.suspend(|| printed = print(&line(&row)));
            printed?;
        }
        rows.push(row);
        Ok(())
    };
    for codec in codecs {
        bar.set_message(codec.id);
        finish(conform::run_codec(codec, &options, &mut spirv, &mut glsl, &mut |done| bar.inc(done))?)?;
    }
    for codec in frames {
        bar.set_message(codec.id);
        finish(conform::run_frame(codec, &options, &mut spirv, &mut glsl, &mut |done| bar.inc(done))?)?;
    }
    bar.finish_and_clear();
    // What the layer says of objects that outlive their device counts as well.
    let (info, instance) = (device.info().clone(), device.instance().clone());
    drop((spirv, glsl, device));
    let messages = instance.validation_messages();

    let report = Report { device: info, agreed: rows.iter().all(Row::agrees), rows };
    if let Some(path) = &arguments.json {
        output::write_file(path, to_json(&report).as_bytes())?;
    }
    if !to_stdout {
        print(&verdict(&report, messages.len()))?;
    }
    Ok(status_after_validation(&messages, report.agreed))
}

/// The codecs of vectors and of frames that these are; all if there are none.
fn chosen_codecs(ids: &[String]) -> Result<(Vec<&'static CodecInfo>, Vec<&'static FrameInfo>)> {
    if ids.is_empty() {
        return Ok((CATALOGUE.iter().collect(), FRAMES.iter().collect()));
    }
    let (mut codecs, mut frames) = (Vec::new(), Vec::new());
    for id in ids {
        match catalogue::find_frame(id) {
            Some(frame) => frames.push(frame),
            None => codecs.push(catalogue::find(id)?),
        }
    }
    Ok((codecs, frames))
}

fn normals(meshes: &[PathBuf]) -> Result<Vec<[f32; 3]>> {
    if meshes.is_empty() {
        return Ok(mesh::read_obj(Path::new("bunny.obj"), BUNNY)?.normals);
    }
    let mut normals = Vec::new();
    for path in meshes {
        normals.extend(mesh::read(path)?.normals);
    }
    Ok(normals)
}

fn progress_bar(length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:<20} {wide_bar} {percent}%, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style)
}

fn heading(device: &DeviceInfo, options: &Options) -> String {
    format!(
        "device: {} ({:?}), driver {}, Vulkan {}\n\
         vectors a codec: {} random (seed {}), {} mesh normals, special ones, and all codes of up to 24 bits decoded\n\
         mismatches are against the CPU; ns is device time a vector, SPIR-V from Rust / from GLSL\n\n\
         {:<20} {:>4} {:>10} {:>10}  {:>11} {:>11}  {:>15} {:>15}\n\
         {:<20} {:>4} {:>10} {:>10}  {:>11} {:>11}  {:>15} {:>15}\n",
        device.name,
        device.kind,
        device.driver,
        device.api_version,
        options.count,
        options.seed,
        options.normals.len(),
        "codec",
        "bits",
        "mean",
        "max",
        "encode diff",
        "decode diff",
        "encode ns",
        "decode ns",
        "",
        "",
        "degrees",
        "degrees",
        "rust / glsl",
        "rust / glsl",
        "rust / glsl",
        "rust / glsl",
    )
}

fn line(row: &Row) -> String {
    let pair = |a: u64, b: u64| format!("{a} / {b}");
    let time = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => format!("{a:.3} / {b:.3}"),
        _ => "- / -".to_owned(),
    };
    let (encode, decode, ns) = (&row.encode_mismatches, &row.decode_mismatches, &row.device_ns);
    let mut text = format!(
        "{:<20} {:>4} {:>10.6} {:>10.6}  {:>11} {:>11}  {:>15} {:>15}\n",
        row.id,
        row.bits,
        row.mean_deg,
        row.max_deg,
        pair(encode.spirv, encode.glsl),
        pair(decode.spirv, decode.glsl),
        time(ns.encode_spirv, ns.encode_glsl),
        time(ns.decode_spirv, ns.decode_glsl),
    );
    // Writing to a String cannot fail.
    if let (Some(mean), Some(max)) = (row.tangent_mean_deg, row.tangent_max_deg) {
        let _ = writeln!(text, "{:<25} {mean:>10.6} {max:>10.6}", "  its tangents");
    }
    for example in &row.examples {
        let _ = writeln!(text, "    {example}");
    }
    text
}

fn verdict(report: &Report, validation_messages: usize) -> String {
    if validation_messages > 0 {
        return format!("\nconform: FAIL: {validation_messages} messages of the validation layer\n");
    }
    let (vectors, codes) =
        report.rows.iter().fold((0, 0), |(vectors, codes), row| (vectors + row.vectors, codes + row.codes));
    if report.agreed {
        return format!(
            "\nconform: PASS: CPU, SPIR-V from Rust and SPIR-V from GLSL agree to the bit: {} codecs, {vectors} vectors \
             encoded, {codes} codes decoded\n",
            report.rows.len()
        );
    }
    let failed: Vec<&str> = report.rows.iter().filter(|row| !row.agrees()).map(|row| row.id).collect();
    format!("\nconform: FAIL: the three do not agree for {}\n", failed.join(", "))
}
