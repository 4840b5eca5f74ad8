//! NVIDIA's compiler of CUDA, which has no driver: kernels of one element, from the SPIR-V that Vulkan drivers get. NVIDIA's
//! own compiler of SPIR-V is in its driver alone, and needs its GPU.

use super::stand_in::{Error, compilers};
use super::{KernelKind, Report, Row, cuda, one, sources};
use crate::Result;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::process::Command;
use unitvec_catalogue::AnyCodec;
use unitvec_choose::costs::Gpu;
use unitvec_manifest::modules::Modules;
use unitvec_vulkan::{DeviceInfo, DeviceKind};

/// Options as drivers of Vulkan compile: quotients and roots within some units in the last place, no subnormal numbers.
const OPTIONS: [&str; 7] =
    ["-O3", "-std=c++17", "-cubin", "-ftz=true", "-prec-div=false", "-prec-sqrt=false", "-w"];

/// Kernels of a file: nvcc takes longer for large ones.
const PART: usize = 60;

/// The programs of CUDA.
struct Toolkit(PathBuf);

/// Compiles the kernels of these codecs for an NVIDIA GPU; `done` receives each codec that is translated.
///
/// # Errors
/// [`Error::NotBuilt`] without the compiler; any error of compiling.
pub fn measure(
    gpu: &Gpu,
    modules: &Modules,
    formats: &[&'static AnyCodec],
    done: impl Fn(&'static AnyCodec) + Sync,
) -> Result<Report> {
    let toolkit = Toolkit::find(gpu)?;
    let kernels: Result<Vec<Vec<one::Kernel>>> = formats
        .par_iter()
        .map(|format| {
            let kernels = one::of_codec(format)?;
            done(format);
            Ok(kernels)
        })
        .collect();
    let kernels: Vec<one::Kernel> = kernels?.into_iter().flatten().chain(one::idle(formats)?).collect();
    let rows: Result<Vec<Vec<Row>>> =
        kernels.par_chunks(PART).map(|part| Ok(toolkit.rows(gpu, part)?)).collect();
    let device = DeviceInfo {
        index: 0,
        name: format!("{} ({})", gpu.title, gpu.name),
        kind: DeviceKind::Discrete,
        driver: toolkit.version()?,
        api_version: "none".to_owned(),
    };
    let rows = rows?.into_iter().flatten().collect();
    let sources = sources(modules, formats, KernelKind::One)?;
    Ok(Report { sources, ..Report::new(device, KernelKind::One, rows) })
}

impl Toolkit {
    fn find(gpu: &Gpu) -> Result<Self, Error> {
        let folder = compilers().join("nvidia/nvidia/cu13");
        let missing = |_| Error::NotBuilt { gpu: gpu.name.to_owned(), folder: folder.clone() };
        folder.join("bin/nvdisasm").canonicalize().map_err(missing)?;
        Ok(Self(folder.canonicalize().map_err(missing)?))
    }

    /// The output of a program, on both channels.
    fn output(&self, program: &str, arguments: &[&str], folder: &Path) -> Result<String, Error> {
        let path = self.0.join("bin").join(program);
        let output =
            Command::new(&path).args(arguments).current_dir(folder).output().map_err(Error::NotStarted)?;
        let said = [output.stdout, output.stderr].concat();
        let said = String::from_utf8_lossy(&said).into_owned();
        if output.status.success() {
            return Ok(said);
        }
        let reason = said.lines().find(|line| line.contains("error")).unwrap_or("it fails").to_owned();
        Err(Error::Unusable { driver: path, reason })
    }

    fn version(&self) -> Result<String, Error> {
        let said = self.output("ptxas", &["--version"], Path::new("."))?;
        let version = said.lines().find_map(|line| line.split_once(", V")?.1.split_whitespace().next());
        Ok(format!("NVIDIA ptxas {}", version.unwrap_or("of unknown version")))
    }

    /// The rows of some kernels, compiled in one file.
    fn rows(&self, gpu: &Gpu, kernels: &[one::Kernel]) -> Result<Vec<Row>, Error> {
        let mut text = cuda::HEADER.to_owned();
        for (at, kernel) in kernels.iter().enumerate() {
            let refused = |reason| Error::Unusable { driver: self.0.join("bin/nvcc"), reason };
            text += &cuda::kernel(&kernel.module, &format!("k{at}")).map_err(|what| {
                refused(format!("{} {}: no CUDA for {what}", kernel.row.id, kernel.row.operation))
            })?;
        }
        let folder = tempfile::tempdir().map_err(Error::NotStarted)?;
        std::fs::write(folder.path().join("k.cu"), text).map_err(Error::NotStarted)?;
        let arch = format!("-arch={}", gpu.name);
        let arguments = [&OPTIONS[..], &[&arch, "-Xptxas", "-v", "-o", "k.cubin", "k.cu"]].concat();
        let said = self.output("nvcc", &arguments, folder.path())?;
        let listing = self.output("nvdisasm", &["-c", "k.cubin"], folder.path())?;
        let (resources, classes) = (resources(&said), classes(&listing));
        Ok(kernels
            .iter()
            .enumerate()
            .map(|(at, kernel)| {
                let name = format!("k{at}");
                let classes = classes.get(name.as_str()).cloned().unwrap_or_default();
                let (registers, spills) = resources.get(name.as_str()).copied().unzip();
                Row {
                    instructions: (!classes.is_empty()).then(|| classes.values().sum()),
                    vector_registers: registers,
                    spills,
                    classes,
                    ..kernel.row.clone()
                }
            })
            .collect())
    }
}

/// Registers, and bytes of those that are kept in memory, by kernel, as ptxas tells them.
fn resources(said: &str) -> HashMap<&str, (u64, u64)> {
    let number = |line: &str, after: &str, before: &str| -> Option<u64> {
        line.split(before).next()?.rsplit(after).next()?.trim().parse().ok()
    };
    let (mut found, mut name, mut spills) = (HashMap::new(), "", 0);
    for line in said.lines() {
        if line.contains("entry function") {
            name = line.split('\'').nth(1).unwrap_or_default();
        } else if line.contains("spill stores") {
            spills = number(line, ",", "bytes spill stores").unwrap_or(0);
        } else if let Some(registers) =
            line.contains("Used ").then(|| number(line, "Used", "registers")).flatten()
        {
            found.insert(name, (registers, spills));
        }
    }
    found
}

/// Instructions by the unit that runs them, of each kernel, by nvdisasm's listing.
fn classes(listing: &str) -> HashMap<&str, BTreeMap<String, u64>> {
    let (mut found, mut name): (HashMap<&str, BTreeMap<String, u64>>, _) = (HashMap::new(), "");
    for line in listing.lines() {
        if let Some(kernel) = line.trim_start().strip_prefix(".text.") {
            name = kernel.trim_end_matches(':');
        } else if let Some(class) = instruction(line).and_then(class) {
            *found.entry(name).or_default().entry(class.to_owned()).or_default() += 1;
        }
    }
    found
}

/// The name of the instruction in a line such as `/*0010*/ @!P0 FADD.FTZ R0, R1, R2 ;`.
fn instruction(line: &str) -> Option<&str> {
    let text = line.trim_start().strip_prefix("/*")?.split_once("*/")?.1.trim_start();
    let text = if text.starts_with('@') { text.split_once(' ')?.1.trim_start() } else { text };
    let name = text.split([' ', '.', ';']).next()?;
    name.starts_with(|c: char| c.is_ascii_uppercase()).then_some(name)
}

/// The unit of an instruction, where it computes: `None` for one that fills the kernel's end.
fn class(name: &str) -> Option<&'static str> {
    const MEMORY: &str = "LDG STG LDC LDCU LD ST LDS STS LDL STL";
    const CONTROL: &str = "BRA EXIT BSSY BSYNC BREAK CALL RET WARPSYNC S2R S2UR CS2R BRX JMP";
    const FMA: &str = "FADD FMUL FFMA IMAD FADD2 FMUL2 FFMA2";
    const SPECIAL: &str = "MUFU I2F F2I FRND F2F POPC FLO F2IP I2I BREV";
    let is_of = |names: &str| names.split(' ').any(|one| one == name);
    Some(match name {
        "NOP" => return None,
        _ if is_of(MEMORY) || name.starts_with("ULDC") => "memory",
        _ if is_of(CONTROL) => "control",
        _ if is_of(FMA) => "fma",
        _ if is_of(SPECIAL) => "special",
        _ if name.starts_with('U') || name == "R2UR" => "uniform",
        _ => "alu",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Listings and reports as the tools write them.
    #[test]
    fn what_the_tools_say_is_read() {
        let listing = ".text.k0:\n  /*0000*/                   LDC R1, c[0x0][0x28] ;\n  /*0010*/              @!P0 FADD.FTZ R0, R2, R3 ;\n  \
                       /*0020*/ MUFU.RCP R4, R0 ;\n.L_x_0:\n  /*0030*/ BRA `(.L_x_0);\n  /*0040*/ NOP;\n";
        let found = &classes(listing)["k0"];
        let expected = [("memory", 1), ("fma", 1), ("special", 1), ("control", 1)];
        assert_eq!(*found, expected.map(|(name, count)| (name.to_owned(), count)).into());
        let said = "ptxas info    : Compiling entry function 'k0' for 'sm_86'\nptxas info    : Function properties for k0\n    \
                    0 bytes stack frame, 8 bytes spill stores, 8 bytes spill loads\nptxas info    : Used 24 registers, 368 bytes cmem[0]\n";
        assert_eq!(resources(said)["k0"], (24, 8));
    }
}
