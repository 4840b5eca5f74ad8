//! The codecs in every shading language, by its compilers: compiled, run, and compared with the CPU. `cargo xtask test
//! --languages` fetches the compilers and runs this.

mod cases;
mod job;
mod metal;
mod report;
mod spirv;
mod tally;
mod tool;
mod vulkan;
mod web;
mod wgpu;

use cases::Case;
use clap::Parser;
use job::{Each, Job};
use report::{Row, Subject};
use spirv::Compiler;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use tally::Tally;
use unitvec_host::catalogue::{find_format, formats};
use unitvec_host::vulkan::DeviceChoice;
use unitvec_languages::{Edition, Language, Library};
use vulkan::Vulkan;

/// A result with what went wrong in words.
type Result<T> = std::result::Result<T, String>;

/// An error in words.
fn told(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// Where the compilers are. What is not given is not run.
#[derive(Parser)]
struct Options {
    /// libdxcompiler.so
    #[arg(long)]
    dxc: Option<PathBuf>,
    /// libslang-compiler.so
    #[arg(long)]
    slang: Option<PathBuf>,
    /// Dawn's addon to Node.js
    #[arg(long)]
    dawn: Option<PathBuf>,
    /// Files of Vulkan drivers that Dawn is run on
    #[arg(long)]
    icd: Vec<PathBuf>,
    /// Folder with Chromium in usr/lib/chromium
    #[arg(long)]
    chromium: Option<PathBuf>,
    /// Runs MSL, by clang
    #[arg(long)]
    clang: bool,
    /// Runs WGSL by wgpu
    #[arg(long)]
    wgpu: bool,
    /// Folder for what is built
    #[arg(long)]
    scratch: PathBuf,
    /// File to write the results to
    #[arg(long)]
    record: Option<PathBuf>,
    /// Only these codecs
    #[arg(long)]
    codec: Vec<String>,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("unitvec-language-tests: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<()> {
    let formats = if options.codec.is_empty() {
        formats().collect()
    } else {
        options.codec.iter().map(|id| find_format(id).map_err(told)).collect::<Result<Vec<_>>>()?
    };
    let cases = cases::cases(&formats).map_err(told)?;
    let mut rows = Rows {
        library: Library::parse(unitvec_shaders::glsl).map_err(told)?,
        cases: &cases,
        rows: Vec::new(),
    };
    if let Some(library) = &options.dxc {
        rows.hlsl(library);
    }
    if let Some(library) = &options.slang {
        rows.slang(library);
    }
    if options.wgpu {
        rows.wgpu();
    }
    if let Some(addon) = &options.dawn {
        rows.dawn(addon, &options.icd);
    }
    if let Some(root) = &options.chromium {
        rows.chromium(root, &options.scratch);
    }
    if options.clang {
        rows.msl(&options.scratch);
    }
    let rows = rows.rows;
    print!("{}", report::table(&rows));
    report::verdict(&rows)?;
    match &options.record {
        Some(path) => report::record(&rows, path),
        None => Ok(()),
    }
}

const EDITIONS: [Edition; 2] = [Edition::Plain, Edition::Exact];

/// What came of the compilers so far.
struct Rows<'a> {
    library: Library,
    cases: &'a [Case],
    rows: Vec<Row>,
}

impl Rows<'_> {
    fn hlsl(&mut self, library: &Path) {
        let compiler = |arguments| Compiler { script: "dxc.py", library, arguments };
        let subject = Subject::new(Language::Hlsl, Edition::Plain, "DXC");
        self.spirv(subject, &compiler(&["-spirv", "-fspv-target-env=vulkan1.1"]));
        let subject = Subject::new(Language::Hlsl, Edition::Plain, "DXC to DXIL").only_compiled();
        self.spirv(subject, &compiler(&[]));
    }

    fn slang(&mut self, library: &Path) {
        for edition in EDITIONS {
            let compiler = Compiler { script: "slang.py", library, arguments: &[] };
            self.spirv(Subject::new(Language::Slang, edition, "Slang"), &compiler);
        }
    }

    fn spirv(&mut self, subject: Subject, compiler: &Compiler<'_>) {
        self.add(subject, |subject, jobs, each| {
            let mut vulkan = if subject.is_run { Some(Vulkan::new(&lavapipe())?) } else { None };
            subject.driver = vulkan.as_ref().map(Vulkan::driver).unwrap_or_default();
            let version = compiler.run(vulkan.as_mut(), jobs, each)?;
            subject.compiler = format!("{} {version}", subject.compiler);
            Ok(())
        });
    }

    fn wgpu(&mut self) {
        let name = format!("wgpu {}", report::locked("wgpu"));
        for edition in EDITIONS {
            self.add(Subject::new(Language::Wgsl, edition, &name), |subject, jobs, each| {
                let device = wgpu::Wgpu::new("llvmpipe")?;
                subject.driver = device.driver().to_owned();
                device.run(jobs, each)
            });
        }
    }

    fn dawn(&mut self, addon: &Path, icds: &[PathBuf]) {
        for icd in icds {
            let client = web::Client::Dawn { addon: addon.to_owned(), icd: icd.clone() };
            self.browse(&client, Language::Wgsl, "Dawn");
        }
    }

    fn chromium(&mut self, root: &Path, scratch: &Path) {
        for (language, script) in [(Language::Wgsl, "webgpu"), (Language::GlslEs, "webgl")] {
            let (root, profile) = (root.to_owned(), scratch.join("profile"));
            self.browse(&web::Client::Chromium { root, script, profile }, language, "Chromium");
        }
    }

    fn browse(&mut self, client: &web::Client, language: Language, name: &str) {
        for edition in EDITIONS {
            self.add(Subject::new(language, edition, name), |subject, jobs, each| {
                subject.driver = web::run(client, jobs, each)?;
                Ok(())
            });
        }
    }

    fn msl(&mut self, scratch: &Path) {
        let hostile = &metal::HOSTILE[..];
        for (edition, options) in
            [(Edition::Plain, &[][..]), (Edition::Plain, hostile), (Edition::Exact, hostile)]
        {
            let mut subject = Subject::new(Language::Msl, edition, "clang");
            subject.is_hostile = !options.is_empty();
            self.add(subject, |_, jobs, each| metal::run(options, &scratch.join("msl"), jobs, each));
        }
    }

    /// Runs all cases.
    fn add(
        &mut self,
        mut subject: Subject,
        run: impl FnOnce(&mut Subject, &[Job<'_>], Each<'_>) -> Result<()>,
    ) {
        let started = Instant::now();
        let mut tally = Tally::default();
        let outcome = job::jobs(&self.library, self.cases, subject.language, subject.edition)
            .and_then(|jobs| run(&mut subject, &jobs, &mut |case, result| tally.add(case, result)));
        if let Err(error) = outcome {
            tally.faults.insert(0, error);
        }
        let row = Row { subject, tally, seconds: started.elapsed().as_secs_f64() };
        println!("{}", row.line());
        self.rows.push(row);
    }
}

/// The device that SPIR-V runs on.
fn lavapipe() -> DeviceChoice {
    DeviceChoice::Named("lavapipe".to_owned())
}
