//! `unitvec bench compiler`.

use super::bench::Measured;
use super::run::{CODECS_LEFT, Live, Screen};
use super::table::{Column, left, right};
use super::{counted, number, variable, write_chart};
use clap::Args;
use std::fmt::{Display, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::Operation;
use unitvec_choose::costs::{Report, Row, Source};
use unitvec_host::{Error, Result};
use unitvec_lab::isa;
use unitvec_lab::isa::pareto;
use unitvec_lab::isa::radv;
use unitvec_lab::isa::radv::Radv;
use unitvec_run::glsl;
use unitvec_vulkan::{DeviceInfo, Inspector};

#[derive(Args)]
pub struct Arguments {
    /// Ask the compiler of Mesa's driver RADV for an AMD GPU, which need not be there. A code name as RADV has it (navi21), or a
    /// generation (gcn4, gcn5, rdna2, rdna3, rdna4). Without it, the compiler of --device, whose driver has to have
    /// VK_KHR_pipeline_executable_properties.
    #[arg(long, value_name = "NAME")]
    gpu: Option<String>,
    /// With --gpu: the file of the RADV to ask, radeon_icd*.json, instead of the system's; or the variable UNITVEC_RADV_ICD.
    #[arg(long, value_name = "FILE", requires = "gpu")]
    driver: Option<PathBuf>,
    /// Draw a chart of the bounds of the codecs' errors against their costs, as SVG.
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    #[command(flatten)]
    measured: Measured,
}

impl Arguments {
    /// The driver's environment, where it is asked for.
    fn radv(&self) -> Result<Option<Radv>> {
        let Some(gpu) = &self.gpu else { return Ok(None) };
        let driver = self.driver.clone().or_else(|| variable("UNITVEC_RADV_ICD").map(PathBuf::from));
        Ok(Some(Radv::new(gpu, driver.as_deref())?))
    }
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let (measured, run) = (&arguments.measured, &arguments.measured.run);
    // It says so before another process begins.
    glsl::Compiler::new()?;
    if let Some(radv) = arguments.radv()? {
        if run.vulkan.names_device() {
            return Err(Error::Usage("--gpu and --device both name a device; leave one out".to_owned()));
        }
        if !radv.is_here() {
            let status = radv.command()?.status().map_err(radv::Error::NotStarted)?;
            let code = status.code().and_then(|code| u8::try_from(code).ok());
            return Ok(code.map_or(ExitCode::FAILURE, ExitCode::from));
        }
    }
    let is_quiet = measured.outputs.take_stdout(&run.json)?;
    let chosen = run.formats()?;
    let live = Live::new(Some(chosen.len() as u64), CODECS_LEFT, is_quiet);
    let mut screen = Screen::new(columns(), &run.wide, live)?;
    let instance = run.vulkan.instance()?;
    let inspector = Inspector::open(&instance, &run.vulkan.choice())?;
    let report = isa::measure(&inspector, &run.vulkan.modules()?, &chosen, |format| {
        screen.live.name(format.id);
        screen.live.advance(1);
    })?;
    drop(inspector);
    screen.finish(instance.validation_messages());

    measured.write(&report.rows, &report.to_json(), &markdown(&report))?;
    if let Some(path) = &arguments.chart {
        write_chart(path, pareto::svg(&report))?;
    }
    screen.head(&legend(&report.device))?;
    let line = |row| screen.line(&cells(&report, row).each_ref().map(|cell| cell as &dyn Display));
    screen.live.print(|| report.rows.iter().map(line).collect())?;
    screen.end(&summary(&report))
}

fn legend(device: &DeviceInfo) -> String {
    format!(
        "compiler: driver {} for {}; nothing was run\n\
         T: inverse throughput, cycles of a compute unit's busiest part for 64 invocations of four vectors; / oct32: T as a \
         multiple of that of oct32's kernel from GLSL\n\
         vector / v: vector instructions a vector; registers: vector \
         registers; / glsl: instructions as a multiple of those of the kernel from GLSL\n\
         -: not told by the driver, or not to be worked out\n\n",
        device.driver, device.name,
    )
}

fn columns() -> Vec<Column> {
    vec![
        left("codec", 20),
        left("", 6),
        left("source", 8),
        right("T", 5),
        right("/\noct32", 5).rank(1),
        right("vector\n/ v", 6).rank(3),
        right("instruc-\ntions", 8),
        right("/\nglsl", 5).rank(2),
        right("regis-\nters", 6).rank(4),
        right("latency", 7).rank(6),
        right("bytes", 6).rank(5),
    ]
}

fn cells(report: &Report, row: &Row) -> [String; 11] {
    let integer = |value: Option<u64>| value.map_or_else(|| "-".to_owned(), |value| value.to_string());
    [
        row.textbook.clone().unwrap_or_else(|| row.id.clone()),
        row.operation.to_string(),
        row.source.to_string(),
        integer(row.inverse_throughput),
        number(report.ratio_to_oct32(row), 2),
        number(row.vector_instructions, 1),
        integer(row.instructions),
        number(report.ratio_to_glsl(row), 2),
        integer(row.vector_registers),
        integer(row.latency),
        integer(row.code_bytes),
    ]
}

fn markdown(report: &Report) -> String {
    let mut text = format!(
        "{}, {}.\n\n| codec | operation | source | T | T / oct32 | vector instructions a vector | instructions | instructions / \
         glsl | vector registers | latency | bytes |\n|{}\n",
        report.device.name,
        report.device.driver,
        "---|".repeat(11)
    );
    for row in &report.rows {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "| {} |", cells(report, row).join(" | "));
    }
    text
}

/// Where the kernels from Rust have more instructions than those from GLSL: the worst few.
fn summary(report: &Report) -> String {
    const SHOWN: usize = 6;
    let of_rust = report.rows.iter().filter(|row| row.source == Source::Rust);
    let mut longer: Vec<(&Row, f64)> = of_rust
        .filter_map(|row| Some((row, report.ratio_to_glsl(row).filter(|ratio| *ratio > 1.02)?)))
        .collect();
    longer.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut named: Vec<String> = longer
        .iter()
        .take(SHOWN)
        .map(|(row, ratio)| format!("{} {} {ratio:.2}", row.id, row.operation))
        .collect();
    if longer.len() > SHOWN {
        named.push(format!("{} more", longer.len() - SHOWN));
    }
    let verdict = if named.is_empty() { "none".to_owned() } else { named.join(", ") };
    let is_counted = |row: &&Row| (row.source, row.operation) == (Source::Glsl, Operation::Encode);
    format!(
        "\nbench compiler: {}; instructions of SPIR-V from Rust above 1.02 of those from GLSL: {verdict}\n",
        counted(report.rows.iter().filter(is_counted).count() as u64, "codecs")
    )
}
