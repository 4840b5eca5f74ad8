//! Every generated or recorded file: its inputs, and the command that makes it again.
//!
//! Inputs are what decides a record: arithmetic, texts and the versions of tools that this repository names; not the whole
//! program, whose messages would make hours of runs stale. Code that only writes a record is no input where a test
//! compares the file with it each time: `cargo xtask renew NAME` renews it after a change there.

use super::state::matches;
use crate::{
    built, cache, cargo, compilers, conform, drivers, integration, interop, languages, npm, processors,
    program, python, repository, run, shaders, spirv, web, windows, write,
};
use std::ffi::OsString;
use std::fs;
use std::process::{Command, Stdio};

/// A part of a hash's input: files by patterns, which are paths with `*` for anything, but for those after a `!`; or versions.
#[derive(Clone, Copy)]
pub enum Source {
    /// Files, whole.
    Bytes(&'static str),
    /// Files without comments and empty lines.
    Code(&'static str),
    /// The generated parts of files.
    Parts(&'static str),
    /// Versions of linked, fetched or run tools.
    Versions(fn() -> String),
}
use Source::{Bytes, Code, Parts, Versions};

/// The groups of records. While one of the files is stale, tests fail; stale runs are repeated by `.ci/run`. Nobody looks at
/// timings, which differ from machine to machine and are renewed by name only.
pub const GROUPS: [&str; 3] = ["files", "runs", "timings"];

/// A set of files, or a run, that is renewed at once.
pub struct Record {
    pub name: &'static str,
    pub outputs: &'static [Source],
    /// The record's sources, for people.
    pub from: &'static str,
    pub inputs: &'static [&'static [Source]],
    /// One of [`GROUPS`].
    pub group: &'static str,
    /// The time that it takes on 2 cores, when everything is built.
    pub minutes: u32,
    /// Requirements that a machine may lack: the record is left stale then. Empty where `cargo xtask setup` suffices.
    pub needs: &'static str,
    pub renew: fn() -> Result<(), String>,
}

impl Record {
    /// True where the record has this file as a whole.
    pub fn makes(&self, file: &str) -> bool {
        self.outputs.iter().any(|output| matches!(output, Bytes(pattern) if matches(pattern, file)))
    }
}

/// The crate on the CPU.
const CRATE: &[Source] = &[Code("shader-crate/src/*.rs")];
/// The codecs, and what modules are compiled from: slices and formats of other software are for CPUs, and call them.
const CODECS: &[Source] =
    &[Code("shader-crate/src/*.rs !shader-crate/src/slice/*.rs !shader-crate/src/interop/*.rs")];
/// The arithmetic on GPUs, as compiled. Code of the CPU that the modules do not have is left to conform and the digests, which
/// hold both together on every run.
const KERNELS: &[Source] = &[Bytes("spirv/kernels/*")];
/// Kernels in other shading languages, and what compiles them in this program.
const OTHER_LANGUAGES: &[Source] =
    &[Code("shaders/*/* host/run/src/shader/*.rs"), Versions(|| locked(&["naga", "shaderc"]))];
const GLSL: &[Source] = &[Code("glsl/unitvec/* glsl/kernels/*")];
const RENDER: &[Source] = &[Bytes("host/render/shaders/rust/Cargo.*"), Code("host/render/shaders/rust/*.rs")];
/// The programs that build and describe the modules. The comments of the manifest's types are in its schema.
const SPIRV_BUILD: &[Source] = &[
    Bytes("shader-crate/Cargo.toml"),
    Code("xtask/spirv/src/*.rs"),
    Bytes("xtask/spirv/Cargo.toml"),
    Code("catalogue/src/*.rs"),
    Bytes("host/manifest/src/*.rs"),
    Code("host/link/src/*.rs"),
    Versions(|| {
        locked(&["glam", "libm", "rspirv", "spirv-builder", "spirv-std", "spirv-tools", "spirv-tools-sys"])
    }),
];

/// The defaults of most records.
const FILE: Record = Record {
    name: "",
    outputs: &[],
    from: "",
    inputs: &[],
    group: "files",
    minutes: 1,
    needs: "",
    renew: || Ok(()),
};

const RUN: Record = Record { group: "runs", ..FILE };

/// All records, each after those among its inputs.
pub static RECORDS: &[Record] = &[
    Record {
        name: "modules",
        outputs: &[Bytes("spirv/*")],
        from: "`shader-crate/` by rust-gpu and `xtask/spirv/`",
        inputs: &[CODECS, SPIRV_BUILD],
        minutes: 12,
        needs: "rustup, which installs rust-gpu's nightly",
        renew: || spirv(&[]),
        ..RUN
    },
    Record {
        name: "render-modules",
        outputs: &[Bytes("host/render/shaders/spirv/*")],
        from: "the renderer's shaders in Rust, the same way",
        inputs: &[CODECS, SPIRV_BUILD, RENDER],
        needs: "rustup, which installs rust-gpu's nightly",
        renew: || spirv(&["--render".to_owned()]),
        ..RUN
    },
    Record {
        name: "rust-gpu-example",
        from: "`examples/rust-gpu/` with rust-gpu: a build that leaves no file",
        inputs: &[
            CODECS,
            &[Bytes("examples/rust-gpu/Cargo.* shader-crate/Cargo.toml"), Code("examples/rust-gpu/*.rs")],
        ],
        needs: "rustup, which installs rust-gpu's nightly",
        renew: || spirv(&["--example".to_owned()]),
        ..RUN
    },
    Record {
        name: "shaders",
        outputs: &[Bytes("shaders/*/* glsl/flat/*")],
        from: "`glsl/unitvec/`; of stubs for linking, the list and the version",
        // Comments are carried over.
        inputs: &[&[
            Bytes("glsl/unitvec/*"),
            Code("languages/src/*.rs shader-crate/src/list.rs"),
            Bytes("host/link/src/stubs.rs"),
            Versions(|| locked(&["unitvec"])),
        ]],
        renew: || {
            shaders(&[])?;
            bless(&["docs::stubs::stubs_are_current"])
        },
        ..FILE
    },
    Record {
        name: "vectors",
        outputs: &[Bytes("vectors/digests.csv vectors/*.json")],
        from: "codecs that are new to the list; what is there never changes",
        // Files of codecs that have one are compared with the arithmetic by tests, and never written.
        inputs: &[&[Code("shader-crate/src/list.rs")]],
        renew: || {
            bless(&["digests::codes_are_the_released_ones", "porting::test_vectors_are_the_released_ones"])
        },
        ..FILE
    },
    Record {
        name: "c",
        outputs: &[Bytes("c/src/codecs.rs c/include/unitvec.h")],
        from: "the list and its bounds, `c/src/`, `c/cbindgen.toml`",
        // Comments are in the header.
        inputs: &[CRATE, &[Bytes("c/src/*.rs c/cbindgen.toml")]],
        renew: || bless(&["c_abi::text::sources_and_header_are_renewed"]),
        ..FILE
    },
    Record {
        name: "blue-noise",
        outputs: &[Bytes("shaders/blue_noise_64x64.rg8")],
        from: "`bench/src/blue_noise.rs`",
        inputs: &[&[Code("bench/src/blue_noise.rs")]],
        minutes: 2,
        renew: || {
            let program = ["run", "--release", "--package", "unitvec-bench", "--bin", "blue_noise"];
            write_output(&mut cargo(&program), "shaders/blue_noise_64x64.rg8")
        },
        ..FILE
    },
    Record {
        name: "errors",
        outputs: &[Bytes(
            "catalogue/data/accuracy.csv docs/data/dither.csv docs/data/interop.csv docs/data/projected.csv",
        )],
        from: "the codecs, plain, dithered and as projections, on the CPU",
        // The search for the worst direction, and the sample, decide the last digits.
        inputs: &[
            CRATE,
            &[
                Code("host/lab/src/accuracy/meyer.rs host/run/src/sampling/*.rs"),
                Bytes("shaders/blue_noise_64x64.rg8"),
            ],
        ],
        minutes: 3,
        renew: || {
            bless(&[
                "docs::accuracy::measure",
                "docs::dither::measure",
                "docs::interop::measure",
                "docs::projected::measure",
            ])
        },
        ..FILE
    },
    Record {
        name: "blocks",
        outputs: &[Bytes("docs/data/blocks.csv")],
        from: "normal maps in compressed blocks, on the CPU",
        inputs: &[
            CODECS,
            &[Code("host/lab/src/accuracy/blocks.rs host/texture/src/pair.rs host/texture/src/block/*.rs")],
        ],
        minutes: 2,
        renew: || unitvec(&["accuracy", "--table", "blocks", "--csv", "docs/data/blocks.csv"]),
        ..FILE
    },
    Record {
        name: "textbook",
        outputs: &[Bytes("docs/data/textbook.csv")],
        from: "`glsl/textbook/` on lavapipe, and the codecs",
        inputs: &[CODECS, &[Code("glsl/textbook/*")]],
        renew: || bless(&["textbook::measure"]),
        ..FILE
    },
    Record {
        name: "costs",
        outputs: &[Bytes(
            "host/choose/data/costs_gfx* host/choose/data/costs_navi* host/choose/data/costs_polaris* host/choose/data/costs_vega* host/choose/data/counted.csv catalogue/data/costs.csv docs/data/dither_costs.json docs/data/stages/* docs/data/gpus/*",
        )],
        from: "the modules and the GLSL, by the compilers of Mesa's drivers and of CUDA",
        inputs: &[
            KERNELS,
            GLSL,
            &[Code(
                "glsl/textbook/* tests/isa/dithered/kernel.comp tests/isa/stages/*.rs host/lab/src/isa/one* host/lab/src/isa/kernel.cuh host/lab/src/isa/cuda.rs host/lab/src/isa/nvidia.rs xtask/src/compilers.rs",
            )],
        ],
        minutes: 20,
        needs: "Debian 12 on amd64, for RADV of Mesa 22.3; it builds Mesa 25.0 and fetches CUDA's compiler",
        renew: || {
            // Any RADV that knows the newest generations serves; without one named, that of Debian's backports is fetched.
            let newer = match std::env::var_os(drivers::NEWER_RADV) {
                Some(file) => file,
                None => drivers::newer_radv(&cache("drivers")?)?.into(),
            };
            let tests = [
                "isa::compiled::renew",
                "isa::gpus::compiled::renew",
                "isa::dithered::compiled::renew",
                "isa::stages::compiled::renew",
            ];
            let compilers = compilers::build()?.into_os_string();
            by_tests(&tests, &[(drivers::NEWER_RADV, newer), ("UNITVEC_COMPILERS", compilers)])?;
            bless(&["isa::gpus::the_shares_are_current", "docs::costs::the_catalogue_is_current"])
        },
        ..FILE
    },
    Record {
        name: "lavapipe",
        outputs: &[Bytes("host/choose/data/costs_lavapipe.json")],
        from: "a row for each codec of the list; times of the modules on lavapipe, with nothing else running",
        // A new codec needs its row. Other changes of the modules are no reason to measure on whatever machine this is.
        inputs: &[&[Code("shader-crate/src/list.rs")]],
        minutes: 5,
        renew: || {
            spirv(&["--cost".to_owned()])?;
            let json = "host/choose/data/costs_lavapipe.json";
            unitvec(&["bench", "--device", "lavapipe", "--cost-kernels", "target/spirv-cost", "--json", json])
        },
        ..FILE
    },
    Record {
        name: "slices",
        outputs: &[Bytes("docs/data/slices.json")],
        from: "times of slices on the CPU, beside other crates",
        // The arithmetic counts only where all slices share it: a new codec has no row.
        inputs: &[&[Code("shader-crate/src/slice/*.rs shader-crate/src/arith/*.rs bench/benches/*.rs")]],
        group: "timings",
        minutes: 6,
        renew: || {
            run(&mut cargo(&["bench", "--package", "unitvec-bench"]))?;
            let summary = ["run", "--package", "unitvec-bench", "--bin", "summary"];
            write_output(&mut cargo(&summary), "docs/data/slices.json")
        },
        ..FILE
    },
    Record {
        name: "agreement",
        from: "CPU, modules, GLSL, HLSL and WGSL on lavapipe: a run of `conform --exhaustive`, which leaves no file",
        inputs: &[CODECS, &[Code("shader-crate/src/slice/*.rs")], KERNELS, GLSL, OTHER_LANGUAGES],
        minutes: 5,
        renew: || conform(&["--exhaustive".to_owned()]),
        ..RUN
    },
    Record {
        name: "imprecise",
        outputs: &[Bytes("docs/data/imprecise.csv")],
        from: "the modules, GLSL, HLSL and WGSL, rewritten for devices that round badly",
        inputs: &[KERNELS, GLSL, OTHER_LANGUAGES, &[Code("host/lab/src/imprecise/*.rs")]],
        minutes: 42,
        renew: || {
            let file = repository().join("docs/data/imprecise.csv").display().to_string();
            conform(&["imprecise", "--seeds", "8", "--csv", &file].map(str::to_owned))
        },
        ..RUN
    },
    Record {
        name: "drivers",
        outputs: &[Bytes("docs/data/drivers.tsv")],
        from: "the modules and the GLSL on other Vulkan drivers",
        inputs: &[KERNELS, GLSL, &[Versions(drivers::versions)]],
        minutes: 15,
        needs: "Debian 12 on amd64, whose packages of drivers it fetches",
        renew: || conform(&["--drivers", "--fetch", "--record"].map(str::to_owned)),
        ..RUN
    },
    Record {
        name: "languages",
        outputs: &[Bytes("docs/data/languages.csv docs/data/barriers.csv")],
        from: "`shaders/` by the compilers of all languages",
        inputs: &[
            OTHER_LANGUAGES,
            &[
                Code("tests/languages/src/*.rs"),
                Bytes("tests/languages/src/fxc/*.c tests/languages/src/cpp/* tests/languages/src/python/*"),
                Bytes("tests/languages/src/web/*"),
                Versions(languages::versions),
            ],
        ],
        minutes: 7,
        needs: "Debian 12 on amd64, and 680 MB of compilers, which it fetches",
        renew: || languages::run(&["--languages".to_owned(), "--record".to_owned()]),
        ..RUN
    },
    Record {
        name: "processors",
        outputs: &[Bytes("docs/data/processors.csv")],
        from: "the codecs on other processors, by qemu and Node.js",
        inputs: &[
            CRATE,
            &[Code("tests/processors/*.rs tests/processors/*.mjs"), Versions(processors::versions)],
        ],
        minutes: 10,
        needs: "Debian's cross compilers, qemu and Node.js, which it installs",
        renew: || processors::run(&["--record".to_owned()]),
        ..RUN
    },
    Record {
        name: "windows",
        from: "libraries and program under Wine, checked for macOS: a run that leaves no file",
        // The places where systems differ, and the arithmetic.
        inputs: &[
            CRATE,
            &[
                Code(
                    "host/files/src/*.rs host/vulkan/src/instance.rs host/vulkan/src/device.rs host/program/src/main.rs",
                ),
                Code("xtask/src/windows.rs xtask/src/windows/*"),
                Versions(|| locked(&["ash", "ctrlc", "libloading", "tempfile"])),
            ],
        ],
        minutes: 10,
        needs: "Debian's MinGW, Wine and lavapipe, which it installs, and rustup",
        renew: || windows::run(&[]),
        ..RUN
    },
    Record {
        name: "interop",
        outputs: &[Bytes("docs/data/interop_outside.csv docs/data/interop_tools.csv")],
        from: "formats of other software beside that software, and its tools after `unitvec snap`",
        inputs: &[&[
            Code("shader-crate/src/interop/*.rs host/mesh/src/edit/*.rs tests/interop/outside.mjs"),
            Code("host/program/src/cli/convert.rs host/program/src/cli/snap.rs"),
            Bytes("tests/interop/package-lock.json host/mesh/data/bunny.obj"),
            Versions(|| format!("{:?}", interop::DRACO)),
        ]],
        minutes: 2,
        needs: "Linux on amd64, npm, which it installs, and 300 MB of packages, which it fetches",
        renew: || interop::run(&["--record".to_owned()]),
        ..RUN
    },
    Record {
        name: "python",
        from: "the Python package from its archive, its tests, and the program beside it: a run that leaves no file",
        inputs: &[
            CRATE,
            &[
                Code("catalogue/src/*.rs python/src/*.rs"),
                Bytes(
                    "python/*.py python/Cargo.toml python/pyproject.toml python/README.md python/requirements.txt",
                ),
            ],
        ],
        minutes: 4,
        needs: "Linux, Python 3.9 or newer, and packages of PyPI, which it fetches",
        renew: || python::run(&[]),
        ..RUN
    },
    Record {
        name: "npm",
        outputs: &[Bytes("docs/data/web_engines.csv")],
        from: "the npm package from its archive, its tests, and the program beside it; its materials in engines",
        inputs: &[
            CRATE,
            &[
                Code("catalogue/src/*.rs npm/src/*.rs xtask/npm/src/*.rs"),
                Code(
                    "npm/unitvec/*.js npm/tests/*.js npm/tests/engines/*.js shaders/glsl-es/* shaders/wgsl/*",
                ),
                Bytes(
                    "npm/Cargo.toml npm/package-lock.json npm/package.json npm/README.md npm/tsconfig.json",
                ),
            ],
        ],
        minutes: 4,
        needs: "Debian 12 on amd64, npm and Chromium, which it fetches, and rustup",
        renew: || npm::run(&["--record".to_owned()]),
        ..RUN
    },
    Record {
        name: "web",
        outputs: &[Bytes("docs/web/*")],
        from: "the page of `web/`, its tests in Chromium, and pictures of it",
        inputs: &[
            CRATE,
            &[
                Code("web/*js npm/src/*.rs npm/unitvec/core.js"),
                Code("host/choose/examples/page.rs shaders/glsl-es/* shaders/wgsl/*"),
                Bytes("web/index.html web/style.css web/package-lock.json host/choose/data/costs_*"),
            ],
        ],
        minutes: 4,
        needs: "Debian 12 on amd64, npm and Chromium, which it fetches, and rustup",
        renew: || web::run(&["--record".to_owned()]),
        ..RUN
    },
    Record {
        name: "web-sizes",
        outputs: &[Bytes("docs/data/web_sizes.csv")],
        from: "GLB files with normals in several formats, loaded in three.js and Babylon.js, with nothing else running",
        inputs: &[&[Code("npm/benchmarks/*.js npm/unitvec/*.js")]],
        group: "timings",
        minutes: 8,
        needs: "what `npm` needs",
        renew: npm::sizes,
    },
    Record {
        name: "figures",
        outputs: &[Bytes("docs/figures/* docs/figures/dark/*")],
        from: "the codecs, the costs and the renderer, on lavapipe",
        // The inputs that the pictures show. Tests draw them again, and so hold them to the rest of the renderer.
        inputs: &[
            KERNELS,
            &[
                Bytes("host/render/shaders/spirv/*"),
                Code("host/render/src/figures/*.rs"),
                Bytes("host/choose/data/costs_*"),
            ],
        ],
        minutes: 2,
        renew: || {
            unitvec(&["figures", "--small", "--device", "lavapipe", "--out", "docs/figures"])?;
            let shown = "1,dither,rotations,caps,filtering";
            let dark = ["figures", "--small", "--dark", "--device", "lavapipe", "--out", "docs/figures/dark"];
            unitvec(&[&dark[..], &["--only", shown]].concat())
        },
        ..FILE
    },
    Record {
        name: "tables",
        outputs: &[
            Parts("README.md CONTRIBUTING.md docs/*.md shader-crate/src/*.rs"),
            Bytes("docs/*.svg shader-crate/facts.rs host/mesh/data/torus.glb"),
        ],
        from: "the list, all data above, and this table",
        inputs: &[
            CRATE,
            &[
                Code("catalogue/src/recommended.rs"),
                Bytes("catalogue/data/* docs/data/* host/choose/data/costs_* docs/figures/figures.json"),
            ],
        ],
        renew: || {
            super::write_contributing()?;
            bless(&[
                "docs::generated_parts_are_current",
                "docs::tables::facts_are_current",
                "docs::accuracy::the_chart_is_current",
                "docs::costs::the_chart_is_current",
                "docs::torus::the_mesh_is_the_formulas",
            ])
        },
        ..FILE
    },
];

/// The packages of these names in `Cargo.lock`.
fn locked(names: &[&str]) -> String {
    let lock = fs::read_to_string(repository().join("Cargo.lock")).unwrap_or_default();
    let name = |package: &str| package.trim_start().lines().next().unwrap_or_default().to_owned();
    let is_named = |package: &&str| names.iter().any(|known| name(package) == format!("name = \"{known}\""));
    lock.split("[[package]]").filter(is_named).collect()
}

/// Makes tests of the integration program write the files that they compare, or measure the figures that others compare.
fn bless(tests: &[&str]) -> Result<(), String> {
    by_tests(tests, &[("BLESS", "1".into())])
}

fn by_tests(tests: &[&str], variables: &[(&str, OsString)]) -> Result<(), String> {
    built(&mut integration(&["--no-run"]))?;
    // Tests that measure are ignored otherwise.
    let mut command = integration(&["--", "--exact", "--nocapture", "--include-ignored"]);
    run(command.args(tests).envs(variables.iter().map(|(name, value)| (name, value))))
}

/// Runs `unitvec` in the repository's root.
fn unitvec(arguments: &[&str]) -> Result<(), String> {
    run(Command::new(program()?).args(arguments).current_dir(repository()))
}

/// Writes what a command prints to a file of the repository, if it succeeds.
fn write_output(command: &mut Command, file: &str) -> Result<(), String> {
    let output = command.stderr(Stdio::inherit()).output().map_err(|error| format!("{file}: {error}"))?;
    if !output.status.success() {
        return Err(format!("what prints {file} ended with {}", output.status));
    }
    write(file, output.stdout)
}
