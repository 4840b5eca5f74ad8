//! Kernels of one element an invocation: `one.comp`.

use super::{Asked, glsl_file};
use crate::Result;
use crate::textbook::TEXTBOOK;
use std::collections::BTreeMap;
use unitvec_catalogue::{AnyCodec, Operation};
use unitvec_choose::costs::{Row, Source, shape};
use unitvec_languages::Edition;
use unitvec_link::{Signature, stubs};
use unitvec_run::glsl::{self, Compiler};
use unitvec_vulkan::{Division, Statistics};

/// The kernel, behind the includes.
pub const KERNEL: &str = include_str!("one.comp");

/// A kernel, and its row without figures.
pub struct Kernel {
    pub row: Row,
    pub module: Vec<u8>,
}

/// The kernels of a codec.
pub fn of_codec(format: &AnyCodec) -> Result<Vec<Kernel>> {
    let (plain, exact) = (Compiler::of(Edition::Plain)?, Compiler::of(Edition::Exact)?);
    let family = glsl_file(format.id);
    let mut kernels = Vec::new();
    for operation in Operation::ALL {
        let own = [(Source::Glsl, &plain), (Source::Exact, &exact)]
            .map(|(source, compiler)| (source, compiler, family.as_str(), format.function(operation), None));
        let textbooks = TEXTBOOK.iter().filter(|textbook| textbook.codec == format.id).map(|textbook| {
            (
                Source::Textbook,
                &plain,
                "textbook/textbook.glsl",
                textbook.function(operation),
                Some(textbook.id),
            )
        });
        kernels.push(linked(format, operation)?);
        for (source, compiler, file, function, textbook) in own.into_iter().chain(textbooks) {
            let module = module(compiler, format, operation, (file, &function), source)?;
            let row = Row { textbook: textbook.map(str::to_owned), ..Row::new(format.id, operation, source) };
            kernels.push(Kernel { row, module });
        }
    }
    Ok(kernels)
}

/// The kernel of the function from Rust, of the library that shaders link.
fn linked(format: &AnyCodec, operation: Operation) -> Result<Kernel> {
    let compiler = Compiler::new()?.unoptimised();
    let function = Signature::of(format, operation).name;
    let mut macros = glsl::macros(format, operation, &function);
    macros.push(("LINKED".to_owned(), "1".to_owned()));
    let text = format!("#version 450\n{}{KERNEL}", stubs::text(stubs::Language::Glsl));
    let module = unitvec_link::link(&compiled(&compiler, &function, &text, &macros)?)?;
    Ok(Kernel { row: Row::new(format.id, operation, Source::Rust), module })
}

/// The kernels without a codec, one for each [`shape`] of these and operation.
pub fn idle(formats: &[&'static AnyCodec]) -> Result<Vec<Kernel>> {
    let compiler = Compiler::new()?;
    let shapes: BTreeMap<String, &AnyCodec> = formats.iter().map(|format| (shape(format), *format)).collect();
    let mut kernels = Vec::new();
    for (shape, format) in &shapes {
        for operation in Operation::ALL {
            let module = module(&compiler, format, operation, ("unitvec/arith.glsl", "idle"), Source::Idle)?;
            kernels.push(Kernel { row: Row::new(shape, operation, Source::Idle), module });
        }
    }
    Ok(kernels)
}

/// The row of a kernel, by the statistics of a driver.
pub fn row(asked: &Asked<'_>, kernel: Kernel) -> Result<Row> {
    let statistics = asked.statistics(Division::Device, &kernel.module, glsl::ENTRY_POINT)?;
    Ok(counted(kernel.row, &statistics))
}

fn module(
    compiler: &Compiler,
    format: &AnyCodec,
    operation: Operation,
    (file, function): (&str, &str),
    source: Source,
) -> Result<Vec<u8>> {
    let text = format!(
        "#version 450\n#extension GL_GOOGLE_include_directive : require\n#include \"table.glsl\"\n#include \"../{file}\"\n{KERNEL}"
    );
    let mut macros = glsl::macros(format, operation, function);
    if source == Source::Idle {
        macros.push(("IDLE".to_owned(), "1".to_owned()));
    }
    compiled(compiler, function, &text, &macros)
}

fn compiled(compiler: &Compiler, function: &str, text: &str, macros: &[(String, String)]) -> Result<Vec<u8>> {
    let compiled = compiler.compile("kernels/one.comp", text, macros);
    Ok(compiled.map_err(|error| glsl::Error::Rejected {
        file: "host/lab/src/isa/one.comp".to_owned(),
        kernel: function.to_owned(),
        error,
    })?)
}

/// Statistics by the names of Mesa's drivers, with the names of classes: those of AMD, Intel, Adreno, and the two of Mali.
const CLASSES: [(&str, &str); 14] = [
    ("VALU", "vector"),
    ("VOPD", "dual"),
    ("SALU", "scalar"),
    ("SEND Count", "send"),
    ("cat1 instructions", "move"),
    ("cat2 instructions", "alu"),
    ("cat3 instructions", "mad"),
    ("cat4 instructions", "sfu"),
    ("NOPs Count", "nop"),
    ("fma", "fma"),
    ("cvt", "cvt"),
    ("sfu", "sfu"),
    ("ls", "memory"),
    ("inst", "all"),
];

/// A row with the figures of a driver's statistics, of a kernel of one element or of a stage.
pub fn counted(row: Row, statistics: &Statistics) -> Row {
    let of = |names: &[&str]| names.iter().find_map(|name| statistics.get(*name).copied());
    let nops = of(&["NOPs Count"]).unwrap_or(0);
    let classes =
        CLASSES.iter().filter_map(|(name, class)| Some(((*class).to_owned(), *statistics.get(*name)?)));
    Row {
        instructions: of(&["VALU", "arith", "inst", "Instruction Count", "Instructions"])
            .map(|count| count.saturating_sub(nops)),
        vector_registers: of(&["VGPRs", "Max live registers", "Registers used"]),
        code_bytes: of(&["Code size", "Code Size"]),
        classes: classes.filter(|(_, count)| *count > 0).collect(),
        spills: of(&["Spilled VGPRs", "Spill Count", "STP Count", "TMU Spills", "spills:fills"]),
        width: of(&["Max dispatch width"]),
        ..row
    }
}
