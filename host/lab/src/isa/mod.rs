//! The output of a GPU driver's compiler for the kernels: exact, the same on every machine, and available for GPUs that
//! are not there.

mod cuda;
pub mod nvidia;
mod one;
pub mod pareto;
pub mod stand_in;

use crate::Result;
use crate::textbook::{self, TEXTBOOK, Textbook};
pub use one::counted;
use rayon::prelude::*;
use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, Operation};
pub use unitvec_choose::costs::{KernelKind, Report, Row, Source};
use unitvec_manifest::modules::Modules;
use unitvec_manifest::sha256_hex;
use unitvec_run::glsl;
use unitvec_vulkan::{Division, ImageFormat, Inspector, PipelineOptions, Statistics};

/// A device's compiler, and the file of what its driver says.
pub struct Asked<'a> {
    inspector: &'a Inspector,
    said: stand_in::Said,
}

impl<'a> Asked<'a> {
    /// Asks the compiler of this device.
    ///
    /// # Errors
    /// [`stand_in::Error::NotStarted`] where the process that started this one left no file.
    pub fn new(inspector: &'a Inspector) -> Result<Self> {
        Ok(Self { inspector, said: stand_in::Said::of_process().map_err(stand_in::Error::NotStarted)? })
    }

    /// The device's name.
    pub fn device(&self) -> &str {
        &self.inspector.device().info().name
    }

    /// The statistics of a kernel.
    ///
    /// # Errors
    /// Those of [`Inspector::statistics`].
    pub fn statistics(&self, division: Division, module: &[u8], entry_point: &str) -> Result<Statistics> {
        let (found, said) = self.said.during(|| self.inspector.statistics(division, module, entry_point));
        let mut found = found?;
        found.extend(stand_in::shader_db(&said, &["COMPUTE"]));
        Ok(found)
    }

    /// The statistics of a pipeline's vertex shader and fragment shader.
    ///
    /// # Errors
    /// Those of [`Inspector::stages`].
    pub fn stages(&self, colours: &[ImageFormat], options: &PipelineOptions<'_>) -> Result<[Statistics; 2]> {
        let (found, said) = self.said.during(|| self.inspector.stages(colours, options));
        let mut found = found?;
        // Mali computes positions apart from the vertex shader's other outputs.
        let stages: [&[&str]; 2] = [&["VERTEX", "POSITION", "VARYING"], &["FRAGMENT"]];
        for (statistics, parts) in found.iter_mut().zip(stages) {
            statistics.extend(stand_in::shader_db(&said, parts));
        }
        Ok(found)
    }
}

/// Compiles the kernels of these codecs, from all sources; `done` receives each codec that is finished.
///
/// # Errors
/// Any error of loading and compiling; [`glsl::Error::NotBuiltIn`] without the GLSL compiler.
pub fn measure(
    inspector: &Inspector,
    modules: &Modules,
    formats: &[&'static AnyCodec],
    kernel: KernelKind,
    done: impl Fn(&'static AnyCodec) + Sync,
) -> Result<Report> {
    // glslang starts faster while another one runs.
    let _compiler = glsl::Compiler::new()?;
    let asked = Asked::new(inspector)?;
    let measured: Result<Vec<Vec<Row>>> = formats
        .par_iter()
        .map(|format| {
            let rows = match kernel {
                KernelKind::One => rows(&asked, one::of_codec(format)?)?,
                _ => of_codec(&asked, modules, format)?,
            };
            done(format);
            Ok(rows)
        })
        .collect();
    let idle = if kernel == KernelKind::One { rows(&asked, one::idle(formats)?)? } else { Vec::new() };
    let rows = measured?.into_iter().flatten().chain(idle).collect();
    let device = inspector.device().info().clone();
    Ok(Report { sources: sources(modules, formats, kernel)?, ..Report::new(device, kernel, rows) })
}

fn rows(asked: &Asked<'_>, kernels: Vec<one::Kernel>) -> Result<Vec<Row>> {
    kernels.into_iter().map(|kernel| one::row(asked, kernel)).collect()
}

fn of_codec(asked: &Asked<'_>, modules: &Modules, format: &AnyCodec) -> Result<Vec<Row>> {
    let compiler = glsl::Compiler::new()?;
    let mut rows = Vec::new();
    for operation in Operation::ALL {
        let name = format.function(operation);
        let mut add = |source, module: &[u8], entry_point: &str, textbook: Option<&Textbook>| -> Result<()> {
            let division = if source == Source::Exact { Division::Exact } else { Division::Device };
            let statistics = asked.statistics(division, module, entry_point)?;
            rows.push(row(format.id, operation, source, textbook, &statistics, asked.device()));
            Ok(())
        };
        for source in [Source::Rust, Source::Exact] {
            add(source, &modules.load(&name)?, &name, None)?;
        }
        add(Source::Glsl, &compiler.kernel(format, operation)?, glsl::ENTRY_POINT, None)?;
        for textbook in TEXTBOOK.iter().filter(|textbook| textbook.codec == format.id) {
            let module = textbook::kernel(&compiler, textbook, operation)?;
            add(Source::Textbook, &module, glsl::ENTRY_POINT, Some(textbook))?;
        }
    }
    Ok(rows)
}

/// A row of the driver's statistics of a kernel for the device of this name; [`Source::Textbook`] has a textbook.
pub fn row(
    id: &str,
    operation: Operation,
    source: Source,
    textbook: Option<&Textbook>,
    statistics: &Statistics,
    device: &str,
) -> Row {
    // RADV's names, and that of Intel's drivers for the first.
    let of = |names: &[&str]| names.iter().find_map(|name| statistics.get(*name).copied());
    Row {
        textbook: textbook.map(|textbook| textbook.id.to_owned()),
        instructions: of(&["Instructions", "Instruction Count"]),
        vector_instructions: vector_instructions(statistics, device),
        inverse_throughput: of(&["Inverse Throughput"]),
        latency: of(&["Latency"]),
        vector_registers: of(&["VGPRs"]),
        code_bytes: of(&["Code size"]),
        ..Row::new(id, operation, source)
    }
}

/// Vectors that an invocation takes.
const GROUP: f64 = unitvec_vulkan::GROUP as f64;

/// Vector instructions of a kernel besides those of its vectors: three make the number of the group and compare it, two
/// make addresses of it. Some kernels have one more or less.
const SHARED: f64 = 5.0;

/// Vector instructions a vector: by RADV's own count, which newer versions give; else from the inverse throughput T,
/// where it shows them.
///
/// On RDNA 1 and 2 a wave of 64 takes two cycles for any vector instruction. The compiler counts three quarters of the
/// instructions in the branch of the invocations that have vectors, so that an instruction for each of four vectors
/// adds 4 x 2 x 3/4 = 6 to T, and [`SHARED`], three of which stand before the branch, 3 x 2 + 2 x 2 x 3/4 = 9. On GCN
/// some instructions take four times as long as others: T does not show how many there are. Nor does it where the
/// latency, divided among the waves that run at once, limits the kernel.
fn vector_instructions(statistics: &Statistics, device: &str) -> Option<f64> {
    const RDNA: [&str; 9] =
        ["navi10", "navi12", "navi14", "navi21", "navi22", "navi23", "navi24", "vangogh", "rembrandt"];
    if let Some(count) = statistics.get("VALU") {
        return Some((*count as f64 - SHARED) / GROUP);
    }
    let of = |name: &str| statistics.get(name).map(|value| *value as f64);
    let (throughput, latency) = (of("Inverse Throughput")?, of("Latency")?);
    // A wave of 64 counts as two.
    let waves = of("Subgroups per SIMD")? / 2.0;
    let device = device.to_lowercase();
    let is_known = RDNA.iter().any(|gpu| device.contains(&format!("radv {gpu}")));
    // To hundredths.
    let rounded = || (100.0 * ((throughput - 9.0) / 6.0)).round() / 100.0;
    (is_known && throughput > (latency / waves).ceil()).then(rounded)
}

/// The files that the kernels of these codecs come from, GLSL and modules, as in [`Report::sources`].
///
/// # Errors
/// [`glsl::Error::NoSource`], which would be a fault of this crate.
fn sources(
    modules: &Modules,
    formats: &[&'static AnyCodec],
    kernel: KernelKind,
) -> Result<BTreeMap<String, String>> {
    let half = |sha256: &str| sha256.get(..32).unwrap_or(sha256).to_owned();
    let mut sources = BTreeMap::new();
    for path in unitvec_shaders::glsl_paths().filter(|path| is_source(path, formats)) {
        let text = glsl::source(path)?;
        sources.insert(format!("glsl/{path}"), half(&sha256_hex(text.as_bytes())));
    }
    if kernel == KernelKind::One {
        sources.retain(|path, _| !path.contains("/kernels/"));
        let library = unitvec_shaders::spirv(unitvec_link::LIBRARY).unwrap_or_default();
        for (path, text) in
            [("host/lab/src/isa/one.comp", one::KERNEL.as_bytes()), ("spirv/unitvec.spv", library)]
        {
            sources.insert(path.to_owned(), half(&sha256_hex(text)));
        }
        return Ok(sources);
    }
    for module in &modules.manifest().modules {
        let has = |name: &str| module.entry_points.iter().any(|entry| entry.name == name);
        if formats.iter().any(|format| has(&format.function(Operation::Encode))) {
            sources.insert(format!("spirv/{}", module.file), half(&module.sha256));
        }
    }
    Ok(sources)
}

/// True for GLSL that all codecs share, for textbooks', and for a codec's own.
fn is_source(path: &str, formats: &[&'static AnyCodec]) -> bool {
    const SHARED: &str = "unitvec/arith.glsl kernels/encode.comp kernels/decode.comp kernels/group.glsl \
        kernels/words.glsl kernels/table.glsl";
    SHARED.split(' ').any(|shared| shared == path)
        || path.starts_with("textbook/")
        || formats.iter().any(|format| path == glsl_file(format.id))
}

/// The file in `glsl/` with a codec's functions.
pub fn glsl_file(id: &str) -> String {
    format!("unitvec/{}", unitvec_catalogue::find(id).map_or_else(|_| String::new(), AnyCodec::glsl_file))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statistics(entries: &[(&str, u64)]) -> Statistics {
        entries.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    }

    /// The driver's own count comes first; T gives the count on RDNA 2 where latency is not the limit.
    #[test]
    fn vector_instructions_are_counted_where_that_can_be() {
        let older = [("Inverse Throughput", 183), ("Latency", 989), ("Subgroups per SIMD", 32)];
        let navi21 = "Null hardware (RADV NAVI21)";
        assert_eq!(vector_instructions(&statistics(&older), navi21), Some(29.0));
        assert_eq!(vector_instructions(&statistics(&older), "Null hardware (RADV VEGA10)"), None);
        let bound = [("Inverse Throughput", 38), ("Latency", 600), ("Subgroups per SIMD", 32)];
        assert_eq!(vector_instructions(&statistics(&bound), navi21), None);
        assert_eq!(vector_instructions(&statistics(&[("VALU", 121)]), navi21), Some(29.0));
    }
}
