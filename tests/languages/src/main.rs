//! The codecs in every shading language, by its compilers: compiled, run, and compared with the CPU. `cargo xtask test
//! --languages` fetches the compilers and runs this.

mod barriers;
mod cases;
mod cpp;
mod fxc;
mod job;
mod linked;
mod report;
mod spirv;
mod tally;
mod tool;
mod vulkan;
mod web;
mod wgpu;
mod whole;

use cases::Case;
use clap::Parser;
use job::Job;
use report::{Mode, Row, Subject};
use spirv::Compiler;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;
use tally::Tally;
use unitvec_catalogue::{CODECS, find};
use unitvec_link as link;
use unitvec_run::conform::widest_of_each_series;
use unitvec_run::shader::{Edition, Language};
use unitvec_vulkan::DeviceChoice;
use vulkan::Vulkan;

/// A result with an error in words.
type Result<T> = std::result::Result<T, String>;

/// An error in words.
fn told(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// The compilers' paths. Compilers without a path do not run.
#[derive(Parser)]
struct Options {
    /// libdxcompiler.so
    #[arg(long)]
    dxc: Option<PathBuf>,
    /// d3dcompiler_47.dll, which Wine runs
    #[arg(long)]
    fxc: Option<PathBuf>,
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
    /// Runs MSL by clang, and C++ by clang and GCC
    #[arg(long)]
    clang: bool,
    /// Compiles C++ for Windows by MinGW
    #[arg(long)]
    mingw: bool,
    /// nvcc, which compiles C++ as CUDA
    #[arg(long)]
    nvcc: Option<PathBuf>,
    /// Runs the kernels of --nvcc, on the GPU of this machine
    #[arg(long)]
    cuda: bool,
    /// ptxas of CUDA 11, beside whose folder are its headers: clang compiles C++ as CUDA
    #[arg(long)]
    ptxas: Option<PathBuf>,
    /// Compiles C++ as HIP by hipcc
    #[arg(long)]
    hip: bool,
    /// Runs WGSL by wgpu
    #[arg(long)]
    wgpu: bool,
    /// Folder for what is built
    #[arg(long)]
    scratch: PathBuf,
    /// File to write the results to
    #[arg(long)]
    record: Option<PathBuf>,
    /// Writes what barriers cost on the device of this process to a file, and does nothing else
    #[arg(long, requires = "dxc", requires = "slang")]
    barriers: Option<PathBuf>,
    /// Only these codecs
    #[arg(long)]
    codec: Vec<String>,
    /// Only the widest codec of each series
    #[arg(long, conflicts_with = "codec")]
    widest: bool,
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
    if let (Some(path), Some(dxc), Some(slang)) = (&options.barriers, &options.dxc, &options.slang) {
        let cases = cases_of(barriers::CODECS.iter().copied())?;
        return barriers::record(&cases, &dxc_to_spirv(dxc), slang, path);
    }
    let mut cases = if options.widest {
        cases::cases(&widest_of_each_series())
    } else if options.codec.is_empty() {
        cases::cases(&CODECS.iter().collect::<Vec<_>>())
    } else {
        cases_of(options.codec.iter().map(String::as_str))
    }?;
    cases.extend(cases.first().map(Case::with_all_files));
    let rows = Rows { cases: &cases, rows: Mutex::default() };
    // Clients of the web wait half of the time.
    thread::scope(|scope| {
        scope.spawn(|| rows.of_clients(options));
        rows.of_libraries(options);
    });
    let mut rows = rows.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    rows.sort_by_key(Row::order);
    println!("\n{}", report::table(&rows));
    // Failures are recorded too: a test reports them.
    if let Some(path) = &options.record {
        report::write_csv(rows.iter().map(Row::record), path)?;
    }
    report::verdict(&rows)
}

/// The cases of the codecs with these identifiers.
fn cases_of<'a>(ids: impl Iterator<Item = &'a str>) -> Result<Vec<Case>> {
    cases::cases(&ids.map(|id| find(id).map_err(told)).collect::<Result<Vec<_>>>()?)
}

fn dxc<'a>(library: &'a Path, arguments: &'static [&'static str]) -> Compiler<'a> {
    let folder = whole::folder(Language::Hlsl, Edition::Plain);
    Compiler { script: "dxc.py", library, folder, arguments }
}

fn dxc_to_spirv(library: &Path) -> Compiler<'_> {
    dxc(library, &["-spirv", "-fspv-target-env=vulkan1.1"])
}

fn slang_to_spirv(library: &Path, edition: Edition) -> Compiler<'_> {
    Compiler { script: "slang.py", library, folder: whole::folder(Language::Slang, edition), arguments: &[] }
}

const EDITIONS: [Edition; 2] = [Edition::Plain, Edition::Exact];

/// The compilers' results so far.
struct Rows<'a> {
    cases: &'a [Case],
    rows: Mutex<Vec<Row>>,
}

impl Rows<'_> {
    /// Compilers whose code this program runs, or starts.
    fn of_libraries(&self, options: &Options) {
        if let Some(library) = &options.dxc {
            self.hlsl(library);
        }
        if let Some(library) = &options.fxc {
            self.fxc(library, &options.scratch.join("fxc"));
        }
        if let Some(library) = &options.slang {
            self.slang(library);
        }
        if options.wgpu {
            self.wgpu();
        }
        if options.clang {
            self.msl(&options.scratch.join("msl"));
            self.cpp(&options.scratch.join("cpp"));
        }
        if options.mingw {
            let name = format!("{} for Windows", compiler_name(MINGW));
            self.checked(&name, MINGW.as_ref(), &[&cpp::GNU, &["-std=c++11", "-fsyntax-only"]], options);
        }
        if let Some(ptxas) = &options.ptxas {
            let root = |up: usize| ptxas.ancestors().nth(up).unwrap_or(ptxas).display();
            let cuda =
                [format!("--cuda-path={}", root(2)), format!("-isystem{}/cuda_runtime/include", root(3))];
            let arguments = [&cpp::CUDA_BY_CLANG[..], &[&cuda[0], &cuda[1]]];
            self.checked(
                &format!("{} for CUDA", compiler_name("clang++")),
                "clang++".as_ref(),
                &arguments,
                options,
            );
        }
        if options.hip {
            let version = tool::output(Command::new("hipcc").args([cpp::HIP_GPU, "-dumpversion"]));
            let name = format!("clang {} for HIP", version.unwrap_or_default().trim());
            self.checked(&name, "hipcc".as_ref(), &[&cpp::HIP], options);
        }
        if let Some(nvcc) = options.nvcc.as_deref().or(options.cuda.then_some("nvcc".as_ref())) {
            self.cuda(nvcc, options);
        }
    }

    /// Programs that compile and run by themselves.
    fn of_clients(&self, options: &Options) {
        for (addon, icd) in
            options.dawn.iter().flat_map(|addon| options.icd.iter().map(move |icd| (addon, icd)))
        {
            let (addon, icd, said) = (addon.clone(), icd.clone(), options.scratch.join("dawn.log"));
            self.browse(&web::Client::Dawn { addon, icd, said }, Language::Wgsl);
        }
        if let Some(root) = &options.chromium {
            for (language, script) in [
                (Language::Wgsl, "webgpu"),
                (Language::GlslEs, "webgl"),
                // Godot's text is GLSL ES without the parts that Godot lacks.
                (Language::Godot, "webgl"),
            ] {
                let (root, profile) = (root.clone(), options.scratch.join("profile"));
                self.browse(&web::Client::Chromium { root, script, profile }, language);
            }
        }
    }

    fn hlsl(&self, library: &Path) {
        for edition in EDITIONS {
            self.library(Subject::new(Language::Hlsl, edition, "DXC"), &dxc_to_spirv(library));
            // Not validated: the library that does is Windows'.
            let subject = Subject::new(Language::Hlsl, edition, "DXC to DXIL").mode(Mode::Compiled);
            self.library(subject, &dxc(library, &["-Vd"]));
        }
        // Optimised, the stubs would be gone.
        let linked = Subject::new(Language::Hlsl, Edition::Plain, "DXC").mode(Mode::Linked);
        self.library(linked, &dxc(library, &["-spirv", "-fcgl", "-fspv-target-env=vulkan1.1"]));
    }

    fn fxc(&self, library: &Path, folder: &Path) {
        let fxc = fxc::Fxc::new(library, folder);
        for edition in EDITIONS {
            self.add(Subject::new(Language::Hlsl, edition, "FXC"), |subject, jobs, tally| {
                let fxc = fxc.as_ref().map_err(Clone::clone)?;
                (subject.compiler, subject.driver) = (fxc.name()?, fxc.driver()?);
                fxc.run(jobs, tally)
            });
        }
    }

    fn slang(&self, library: &Path) {
        for edition in EDITIONS {
            self.library(Subject::new(Language::Slang, edition, "Slang"), &slang_to_spirv(library, edition));
        }
        let linked = Subject::new(Language::Slang, Edition::Plain, "Slang").mode(Mode::Linked);
        self.library(linked, &slang_to_spirv(library, Edition::Plain));
    }

    /// Compiles by a library, and runs the modules where there is something to run them on.
    fn library(&self, subject: Subject, compiler: &Compiler<'_>) {
        self.add(subject, |subject, jobs, tally| {
            let is_linked = subject.mode == Mode::Linked;
            let finished =
                |module: Vec<u8>| if is_linked { link::link(&module).map_err(told) } else { Ok(module) };
            let is_run = subject.mode != Mode::Compiled;
            let mut vulkan = is_run.then(|| Vulkan::new(&lavapipe())).transpose()?;
            let version = compiler.compile(jobs, &mut |case, module| match &mut vulkan {
                Some(vulkan) => {
                    tally.add(case, module.and_then(finished).and_then(|module| vulkan.run(&module, case)))
                }
                None => {
                    tally.add_compiled(case, module);
                    Ok(())
                }
            })?;
            subject.compiler = format!("{} {version}", subject.compiler);
            subject.driver = vulkan.map_or_else(String::new, |vulkan| vulkan.driver());
            Ok(())
        });
    }

    fn wgpu(&self) {
        let name = format!("wgpu {}", report::locked("wgpu"));
        for edition in EDITIONS {
            self.add(Subject::new(Language::Wgsl, edition, &name), |subject, jobs, tally| {
                let device = wgpu::Wgpu::new("llvmpipe")?;
                subject.driver = device.driver().to_owned();
                device.run(jobs, tally)
            });
        }
    }

    fn browse(&self, client: &web::Client, language: Language) {
        for edition in EDITIONS {
            self.add(Subject::new(language, edition, &client.name()), |subject, jobs, tally| {
                subject.driver = web::run(client, jobs, tally)?;
                Ok(())
            });
        }
    }

    fn msl(&self, scratch: &Path) {
        let name = compiler_name("clang++");
        for (edition, mode) in [
            (Edition::Plain, Mode::Usual),
            (Edition::Plain, Mode::FastMath),
            (Edition::Exact, Mode::FastMath),
        ] {
            let subject = Subject::new(Language::Msl, edition, &name).mode(mode);
            let hostile: &[&str] = if mode == Mode::FastMath { &cpp::HOSTILE } else { &[] };
            let options = [&cpp::GNU[..], &cpp::MSL, hostile];
            self.compiled(subject, "clang++".as_ref(), &options, Some(cases::RANDOM), scratch);
        }
    }

    fn cpp(&self, scratch: &Path) {
        for program in ["g++", "clang++"] {
            for edition in EDITIONS {
                let subject = Subject::new(Language::Cpp, edition, &compiler_name(program));
                self.compiled(
                    subject,
                    program.as_ref(),
                    &[&cpp::GNU, &cpp::FUSING],
                    Some(cpp::MANY),
                    scratch,
                );
            }
        }
    }

    fn cuda(&self, nvcc: &Path, options: &Options) {
        let release = tool::output(Command::new(nvcc).arg("--version")).unwrap_or_default();
        let release = release.split("release ").nth(1).and_then(|rest| rest.split(',').next());
        let name = format!("nvcc {}", release.unwrap_or_default());
        if !options.cuda {
            return self.checked(&name, nvcc, &[&cpp::CUDA, &cpp::ASSEMBLED], options);
        }
        for edition in EDITIONS {
            let mut subject = Subject::new(Language::Cpp, edition, &name);
            subject.driver = "CUDA".to_owned();
            let scratch = options.scratch.join("cuda");
            self.compiled(subject, nvcc, &[&cpp::CUDA, &["-arch=native"]], Some(cpp::MANY), &scratch);
        }
    }

    /// Compiles C++ that nothing here runs.
    fn checked(&self, name: &str, program: &Path, arguments: &[&[&str]], options: &Options) {
        for edition in EDITIONS {
            let subject = Subject::new(Language::Cpp, edition, name).mode(Mode::Compiled);
            self.compiled(subject, program, arguments, None, &options.scratch.join("checked"));
        }
    }

    /// Compiles MSL or C++, and runs it over so many random inputs.
    fn compiled(
        &self,
        subject: Subject,
        program: &Path,
        options: &[&[&str]],
        random: Option<usize>,
        scratch: &Path,
    ) {
        let compiler = cpp::Compiler { program, options, language: subject.language, random };
        let edition = subject.edition;
        self.add(subject, |_, jobs, tally| cpp::run(compiler, edition, scratch, jobs, tally));
    }

    fn add(
        &self,
        mut subject: Subject,
        run: impl FnOnce(&mut Subject, &[Job<'_>], &mut Tally) -> Result<()>,
    ) {
        let started = Instant::now();
        let mut tally = Tally::default();
        let jobs = match subject.mode {
            Mode::Linked => Ok(linked::jobs(self.cases, subject.language)),
            _ => job::jobs(self.cases, subject.language, subject.edition),
        };
        let outcome = jobs.and_then(|jobs| run(&mut subject, &jobs, &mut tally));
        if let Err(error) = outcome {
            tally.faults.insert(0, error);
        }
        subject.driver = report::short_driver(&subject.driver);
        let row = Row { subject, tally, seconds: started.elapsed().as_secs_f64() };
        print!("{}", row.told());
        self.rows.lock().unwrap_or_else(PoisonError::into_inner).push(row);
    }
}

/// The compiler of C++ for Windows.
const MINGW: &str = "x86_64-w64-mingw32-g++";

/// A compiler's name and version.
fn compiler_name(program: &str) -> String {
    let version = tool::output(Command::new(program).arg("-dumpversion")).unwrap_or_default();
    format!("{} {}", if program.contains("clang") { "clang" } else { "GCC" }, version.trim())
}

/// The device that SPIR-V runs on.
fn lavapipe() -> DeviceChoice {
    DeviceChoice::Named("lavapipe".to_owned())
}
