//! `unitvec bench compiler`.

use super::bench::Reported;
use super::run::{CODECS_LEFT, Live, Screen};
use super::table::{Column, left, right};
use super::{counted, number, variable, write_chart};
use clap::Args;
use std::fmt::{Display, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use unitvec_catalogue::{AnyCodec, Operation};
use unitvec_choose::costs::{KernelKind, Line, Report, Row, Source, find_gpu};
use unitvec_host::{Error, Result};
use unitvec_lab::isa;
use unitvec_lab::isa::pareto;
use unitvec_lab::isa::stand_in::StandIn;
use unitvec_manifest::modules::Modules;
use unitvec_run::glsl;
use unitvec_vulkan::{DeviceInfo, Inspector};

#[derive(Args)]
pub struct Arguments {
    /// Ask the compiler for a GPU that need not be there: for AMD's that of Mesa's driver RADV, by a code name as RADV has it
    /// (navi21) or a generation (gcn4, gcn5, rdna2, rdna3, rdna4); for those of other makers that docs/costs.md lists (dg2, sm_86,
    /// a730) the compilers that `cargo xtask renew costs` builds. Without it, the compiler of --device, whose driver has to have
    /// VK_KHR_pipeline_executable_properties.
    #[arg(long, value_name = "NAME")]
    gpu: Option<String>,
    /// With --gpu: the file of the driver to ask instead; for AMD's GPUs radeon_icd*.json, or the variable UNITVEC_RADV_ICD.
    #[arg(long, value_name = "FILE", requires = "gpu")]
    driver: Option<PathBuf>,
    /// Kernels: of one element an invocation, with aligned reads and writes, or of four, as they ship.
    #[arg(long, value_enum, value_name = "KIND", default_value_t = KernelKind::One)]
    kernel: KernelKind,
    /// Draw a chart of the bounds of the codecs' errors against their costs, as SVG.
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    #[command(flatten)]
    reported: Reported,
}

impl Arguments {
    /// The environment of the driver for a GPU.
    fn stand_in(&self, gpu: &str) -> Result<StandIn> {
        let is_radeon = find_gpu(gpu).is_none_or(|gpu| gpu.line == Line::Radeon);
        let radv = variable("UNITVEC_RADV_ICD").filter(|_| is_radeon).map(PathBuf::from);
        Ok(StandIn::new(gpu, self.driver.clone().or(radv).as_deref())?)
    }
}

pub fn run(arguments: &Arguments) -> Result<ExitCode> {
    let (reported, run) = (&arguments.reported, &arguments.reported.run);
    // It says so before another process begins.
    glsl::Compiler::new()?;
    let gpu = arguments.gpu.as_deref();
    if gpu.is_some() && run.vulkan.names_device() {
        return Err(Error::Usage("--gpu and --device both name a device; leave one out".to_owned()));
    }
    let nvidia = gpu.and_then(find_gpu).filter(|gpu| gpu.line == Line::Nvidia);
    if nvidia.is_some() && (arguments.kernel == KernelKind::Four || arguments.driver.is_some()) {
        return Err(Error::Usage(
            "NVIDIA's compiler is asked about kernels of one element, without a driver; leave out --kernel four and --driver"
                .to_owned(),
        ));
    }
    if let Some(gpu) = gpu.filter(|_| nvidia.is_none()) {
        let stand_in = arguments.stand_in(gpu)?;
        if !stand_in.is_here() {
            return Ok(stand_in.run()?);
        }
    }
    let is_quiet = reported.outputs.take_stdout(&run.json)?;
    let chosen = run.formats()?;
    let live = Live::new(Some(chosen.len() as u64), CODECS_LEFT, is_quiet);
    let mut screen = Screen::new(columns(arguments.kernel), &run.wide, live)?;
    let modules = run.vulkan.modules()?;
    let done = |format: &AnyCodec| {
        screen.live.name(format.id);
        screen.live.advance(1);
    };
    let (report, messages) = match nvidia {
        Some(gpu) => (isa::nvidia::measure(gpu, &modules, &chosen, done)?, Vec::new()),
        None => asked(arguments, &modules, &chosen, done)?,
    };
    screen.finish(messages);

    let table = table(&report);
    reported.write(&table, &report.to_json(), &markdown(&report, &table))?;
    if let Some(path) = &arguments.chart {
        write_chart(path, pareto::svg(&report))?;
    }
    screen.head(&legend(&report))?;
    let line =
        |cells: &Vec<String>| screen.line(&cells.iter().map(|cell| cell as &dyn Display).collect::<Vec<_>>());
    screen.live.print(|| table.iter().skip(1).map(line).collect())?;
    screen.end(&summary(&report))
}

/// The report of the compiler in the driver of a Vulkan device, and the messages of the validation layer.
fn asked(
    arguments: &Arguments,
    modules: &Modules,
    chosen: &[&'static AnyCodec],
    done: impl Fn(&'static AnyCodec) + Sync,
) -> Result<(Report, Vec<String>)> {
    let vulkan = &arguments.reported.run.vulkan;
    let instance = vulkan.instance()?;
    let inspector = Inspector::open(&instance, &vulkan.choice())?;
    let report = isa::measure(&inspector, modules, chosen, arguments.kernel, done)?;
    // A stand-in's device cannot be destroyed: that of VideoCore waits for its queue, and ends the process.
    if arguments.gpu.is_some() {
        std::mem::forget(inspector);
    }
    Ok((report, instance.validation_messages()))
}

fn legend(report: &Report) -> String {
    let DeviceInfo { driver, name, .. } = &report.device;
    let figures = match report.kernel {
        KernelKind::One => {
            "instructions: those of one element, beyond a kernel that adds the components that it reads; / oct32, / glsl: as \
             multiples of those of oct32's kernel, of the codec's own, from GLSL\n\
             width: invocations that an instruction serves; classes: instructions by the driver's words, nothing subtracted\n"
        }
        _ => {
            "T: inverse throughput, cycles of a compute unit's busiest part for 64 invocations of four vectors; / oct32: T as a \
             multiple of that of oct32's kernel from GLSL\n\
             vector / v: vector instructions a vector; / glsl: instructions as a multiple of those of the kernel from GLSL\n"
        }
    };
    format!(
        "compiler: driver {driver} for {name}; nothing was run\n{figures}registers: vector registers; -: not told by the driver, \
         or not to be worked out\n\n"
    )
}

fn columns(kernel: KernelKind) -> Vec<Column> {
    let mut columns = vec![left("codec", 20), left("", 6), left("source", 8)];
    columns.extend(match kernel {
        KernelKind::One => vec![
            right("instruc-\ntions", 8),
            right("/\noct32", 6),
            right("/\nglsl", 5).rank(1),
            right("regis-\nters", 6).rank(2),
            right("spills", 6).rank(3),
            right("width", 5).rank(4),
            right("bytes", 6).rank(5),
            left("classes", 48).rank(6),
        ],
        _ => vec![
            right("T", 5),
            right("/\noct32", 5).rank(1),
            right("vector\n/ v", 6).rank(3),
            right("instruc-\ntions", 8),
            right("/\nglsl", 5).rank(2),
            right("regis-\nters", 6).rank(4),
            right("latency", 7).rank(6),
            right("bytes", 6).rank(5),
        ],
    });
    columns
}

fn cells(report: &Report, row: &Row) -> Vec<String> {
    let integer = |value: Option<u64>| value.map_or_else(|| "-".to_owned(), |value| value.to_string());
    let name = row.textbook.clone().unwrap_or_else(|| row.id.clone());
    let mut cells = vec![name, row.operation.to_string(), row.source.to_string()];
    let (to_oct32, to_glsl) = (number(report.ratio_to_oct32(row), 2), number(report.ratio_to_glsl(row), 2));
    let (registers, bytes) = (integer(row.vector_registers), integer(row.code_bytes));
    cells.extend(match report.kernel {
        KernelKind::One => {
            let classes: Vec<String> =
                row.classes.iter().map(|(class, count)| format!("{class} {count}")).collect();
            let beyond = number(report.beyond_idle(row), 0);
            let [spills, width] = [row.spills, row.width].map(integer);
            vec![beyond, to_oct32, to_glsl, registers, spills, width, bytes, classes.join(", ")]
        }
        _ => {
            let [throughput, instructions, latency] =
                [row.inverse_throughput, row.instructions, row.latency].map(integer);
            let vector = number(row.vector_instructions, 1);
            vec![throughput, to_oct32, vector, instructions, to_glsl, registers, latency, bytes]
        }
    });
    cells
}

/// The rows under titles.
fn table(report: &Report) -> Vec<Vec<String>> {
    let title = |column: &Column| Some(column.title()).filter(|title| !title.is_empty());
    let titles = columns(report.kernel).iter().map(|one| title(one).unwrap_or("operation".into())).collect();
    std::iter::once(titles).chain(report.rows.iter().map(|row| cells(report, row))).collect()
}

fn markdown(report: &Report, table: &[Vec<String>]) -> String {
    let mut text = format!("{}, {}.\n\n", report.device.name, report.device.driver);
    for (at, cells) in table.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "| {} |", cells.join(" | "));
        if at == 0 {
            let _ = writeln!(text, "|{}", "---|".repeat(cells.len()));
        }
    }
    text
}

/// Where the kernels from Rust have more instructions than those from GLSL: the worst few.
fn summary(report: &Report) -> String {
    const SHOWN: usize = 6;
    let is_counted = |row: &&Row| (row.source, row.operation) == (Source::Glsl, Operation::Encode);
    let codecs = counted(report.rows.iter().filter(is_counted).count() as u64, "codecs");
    if report.kernel == KernelKind::One {
        return format!("\nbench compiler: {codecs} on {}\n", report.subject());
    }
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
    format!(
        "\nbench compiler: {codecs}; instructions of SPIR-V from Rust above 1.02 of those from GLSL: {verdict}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use unitvec_vulkan::DeviceKind;

    /// Rows make CSV whether a driver tells classes or not.
    #[test]
    fn rows_with_classes_are_as_long_as_others() {
        let device = DeviceInfo {
            index: 0,
            name: "a".to_owned(),
            kind: DeviceKind::Discrete,
            driver: "b".to_owned(),
            api_version: "none".to_owned(),
        };
        let without = Row::new("oct32", Operation::Encode, Source::Glsl);
        let classes = BTreeMap::from([("alu".to_owned(), 3), ("send".to_owned(), 2)]);
        let rows = vec![Row { classes, spills: Some(0), ..without.clone() }, without];
        let table = table(&Report::new(device, KernelKind::One, rows));
        assert_eq!(table[0][..3], ["codec", "operation", "source"]);
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("rows.csv");
        crate::cli::write_separated(&file, &table, b',').unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        assert_eq!(text.lines().count(), 3);
        assert!(text.contains("\"alu 3, send 2\""), "{text}");
    }
}
