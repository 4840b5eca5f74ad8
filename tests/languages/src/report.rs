//! The results, for the screen and for the docs.

use crate::cases::{RANDOM, SPECIAL};
use crate::tally::Tally;
use crate::{Result, told};
use serde::Serialize;
use std::path::Path;
use unitvec_files::write_file;
use unitvec_lab::imprecise::Outcome;
use unitvec_run::shader::{Edition, Language};

/// A compiler and a driver.
pub struct Subject {
    pub language: Language,
    pub edition: Edition,
    /// Name and version.
    pub compiler: String,
    pub driver: String,
    pub mode: Mode,
}

/// Steps beside compiling and running.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mode {
    /// No further step.
    Usual,
    /// The compiler may take arithmetic for that of real numbers.
    FastMath,
    /// Code that calls the stubs is linked with the library.
    Linked,
    /// Code is compiled, and there is nothing to run it on.
    Compiled,
}

/// The promise about results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Promise {
    /// Results equal the CPU's, to the bit.
    Equal,
    /// Results are within the codec's error bound: see [`crate::tally::Bounds`].
    Bounded,
    /// Any results but the CPU's: a compiler that changes nothing would show nothing.
    None,
    /// Nothing ran.
    Compiled,
}

impl Subject {
    pub fn new(language: Language, edition: Edition, compiler: &str) -> Self {
        let (compiler, driver) = (compiler.to_owned(), String::new());
        Self { language, edition, compiler, driver, mode: Mode::Usual }
    }

    pub fn mode(self, mode: Mode) -> Self {
        Self { mode, ..self }
    }

    /// GLSL, HLSL and MSL have means of their own to keep arithmetic as it is written, where the compiler heeds them.
    pub fn promise(&self) -> Promise {
        let has_means = matches!(self.language, Language::Glsl | Language::Hlsl | Language::Msl);
        match (self.edition, self.mode) {
            (_, Mode::Compiled) => Promise::Compiled,
            // The library's arithmetic is marked as exact.
            (Edition::Exact, _) | (_, Mode::Linked) => Promise::Equal,
            (Edition::Plain, Mode::FastMath) => Promise::None,
            (Edition::Plain, Mode::Usual) if has_means => Promise::Equal,
            (Edition::Plain, Mode::Usual) => Promise::Bounded,
        }
    }

    fn edition(&self) -> &'static str {
        match self.edition {
            Edition::Plain => "plain",
            Edition::Exact => "exact",
        }
    }

    fn options(&self) -> &'static str {
        match self.mode {
            Mode::FastMath => "fast math",
            Mode::Linked => "linked",
            Mode::Usual | Mode::Compiled => "",
        }
    }
}

/// The results of one compiler.
pub struct Row {
    pub subject: Subject,
    pub tally: Tally,
    pub seconds: f64,
}

/// A line of the record.
#[derive(Serialize)]
struct Record<'a> {
    language: &'a str,
    edition: &'a str,
    compiler: &'a str,
    options: &'a str,
    driver: &'a str,
    kernels: usize,
    /// The number of random inputs for each kernel.
    random: usize,
    special: usize,
    codes_differ: u64,
    special_differ: u64,
    /// Largest error of a random element whose code differs, as a part of the codec's bound.
    error: String,
    elements_differ: u64,
    /// Largest difference of a component, in 2^-24.
    component: String,
    /// Largest angle between a decoded vector and the CPU's, as a part of the codec's error bound.
    angle: String,
    promise: Promise,
}

impl Row {
    /// The objections to the row, in words.
    fn objections(&self) -> Vec<String> {
        let mut objections = self.tally.faults.clone();
        match self.subject.promise() {
            Promise::Equal => objections.extend(self.tally.differing.clone()),
            Promise::Bounded => objections.extend(self.tally.out_of_bounds.clone()),
            Promise::None if self.tally.differing.is_empty() => {
                objections.push("nothing differs: the options do not make the compiler hostile".to_owned());
            }
            Promise::None | Promise::Compiled => {}
        }
        objections
    }

    fn record(&self) -> Record<'_> {
        let Self { subject, tally, .. } = self;
        let Outcome { codes_differ, special_differ, error, elements_differ, component_ulp, .. } =
            tally.outcome;
        let is_run = subject.mode != Mode::Compiled;
        Record {
            language: subject.language.name(),
            edition: subject.edition(),
            compiler: &subject.compiler,
            options: subject.options(),
            driver: &subject.driver,
            kernels: tally.kernels,
            random: if is_run { RANDOM } else { 0 },
            special: if is_run { SPECIAL } else { 0 },
            codes_differ,
            special_differ,
            error: number(error),
            elements_differ,
            component: number(component_ulp),
            angle: number(tally.angle),
            promise: subject.promise(),
        }
    }

    /// Languages in their order, plain editions first; compilers and drivers by name.
    pub fn order(&self) -> impl Ord + use<> {
        let Subject { language, edition, compiler, driver, mode, .. } = &self.subject;
        (*language, compiler.clone(), *mode, driver.clone(), *edition)
    }

    /// Formats the row for the screen.
    pub fn told(&self) -> String {
        const SHOWN: usize = 12;
        let record = self.record();
        let objections = self.objections();
        let verdict = if objections.is_empty() { "PASS" } else { "FAIL" };
        let subject = [record.language, record.edition, record.compiler, record.options, record.driver];
        let subject = subject.iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(", ");
        let mut text = format!(
            "{verdict} {subject}: {} kernels, {} + {} codes differ (error {} of the bound), {} vectors differ (components {} \
             2^-24, angle {} of the bound); {:.0} s\n",
            record.kernels,
            record.codes_differ,
            record.special_differ,
            record.error,
            record.elements_differ,
            record.component,
            record.angle,
            self.seconds
        );
        for objection in objections.iter().take(SHOWN) {
            let lines: Vec<&str> =
                objection.lines().map(str::trim).filter(|line| !line.is_empty()).take(4).collect();
            text += &format!("     {}\n", lines.join(" "));
        }
        if objections.len() > SHOWN {
            text += &format!("     and {} more\n", objections.len() - SHOWN);
        }
        text
    }
}

/// Two digits.
fn number(value: f64) -> String {
    if value == 0.0 || value >= 10.0 { format!("{value:.0}") } else { format!("{value:.2}") }
}

/// A driver's name and version, without the words that each implementation adds.
pub fn short_driver(told: &str) -> String {
    if told.to_lowercase().contains("swiftshader") {
        return "SwiftShader".to_owned();
    }
    match told.split_once("Mesa ").and_then(|(_, version)| version.split([' ', '-']).next()) {
        Some(version) => format!("lavapipe of Mesa {version}"),
        None => told.replace(',', " "),
    }
}

/// All verdicts, a line each.
pub fn table(rows: &[Row]) -> String {
    let mut text = String::from("        codes + special  vectors  compiler\n");
    for row in rows {
        let record = row.record();
        let verdict = if row.objections().is_empty() { "PASS" } else { "FAIL" };
        let parts = [record.language, record.edition, record.compiler, record.options, record.driver];
        let subject = parts.iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join(", ");
        let (codes, special, vectors) = (record.codes_differ, record.special_differ, record.elements_differ);
        text += &format!("{verdict}  {codes:>8} {special:>8} {vectors:>8}  {subject}\n");
    }
    text
}

/// Fails where any promise was not kept.
pub fn verdict(rows: &[Row]) -> Result<()> {
    let failed = rows.iter().filter(|row| !row.objections().is_empty()).count();
    if rows.is_empty() {
        return Err("nothing ran".to_owned());
    }
    if failed == 0 { Ok(()) } else { Err(format!("{failed} of {} compilers and drivers fail", rows.len())) }
}

/// Writes all rows, for the docs.
pub fn record(rows: &[Row], path: &Path) -> Result<()> {
    write_csv(rows.iter().map(Row::record), path)
}

/// Writes a line for each: a whole file, or none.
pub fn write_csv(lines: impl Iterator<Item = impl Serialize>, path: &Path) -> Result<()> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.serialize(line).map_err(told)?;
    }
    write_file(path, &writer.into_inner().map_err(told)?).map_err(told)
}

/// The version of a package in Cargo.lock.
pub fn locked(package: &str) -> String {
    let lock = include_str!("../../../Cargo.lock");
    let name = format!("name = \"{package}\"\nversion = \"");
    let version = lock.split(&name).nth(1).and_then(|rest| rest.split('"').next());
    version.unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drivers_are_named_alike() {
        for (told, name) in [
            ("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", "lavapipe of Mesa 22.3.6"),
            ("llvmpipe: Mesa 25.0.7-2~bpo12+1 (LLVM 15.0.6) 0.0.1", "lavapipe of Mesa 25.0.7"),
            ("google swiftshader", "SwiftShader"),
            ("ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device), SwiftShader driver)", "SwiftShader"),
        ] {
            assert_eq!(short_driver(told), name);
        }
    }

    #[test]
    fn promises_are_those_of_the_docs() {
        let promise = |language, edition, mode| Subject::new(language, edition, "").mode(mode).promise();
        assert_eq!(promise(Language::Hlsl, Edition::Plain, Mode::Usual), Promise::Equal);
        assert_eq!(promise(Language::Hlsl, Edition::Plain, Mode::Compiled), Promise::Compiled);
        assert_eq!(promise(Language::Msl, Edition::Plain, Mode::Usual), Promise::Equal);
        assert_eq!(promise(Language::Msl, Edition::Plain, Mode::FastMath), Promise::None);
        assert_eq!(promise(Language::Msl, Edition::Exact, Mode::FastMath), Promise::Equal);
        assert_eq!(promise(Language::Slang, Edition::Plain, Mode::Linked), Promise::Equal);
        for language in [Language::Wgsl, Language::Slang, Language::GlslEs, Language::Godot] {
            assert_eq!(promise(language, Edition::Plain, Mode::Usual), Promise::Bounded);
            assert_eq!(promise(language, Edition::Exact, Mode::Usual), Promise::Equal);
        }
    }

    /// A compiler that was asked to take liberties and takes none proves nothing of the exact edition.
    #[test]
    fn a_hostile_compiler_has_to_differ() {
        let subject = Subject::new(Language::Msl, Edition::Plain, "").mode(Mode::FastMath);
        let mut row = Row { subject, tally: Tally::default(), seconds: 0.0 };
        assert_eq!(row.objections().len(), 1);
        row.tally.differing.push("oct32_encode".to_owned());
        assert!(row.objections().is_empty());
    }

    /// A failure to serialise leaves the file as it was.
    #[test]
    fn a_record_is_written_whole_or_not_at_all() {
        let path = std::env::temp_dir().join(format!("unitvec-{}-record.csv", std::process::id()));
        write_csv([("a", 1), ("b", 2)].iter(), &path).unwrap();
        let uneven = [vec!["a"], vec!["b", "c"]];
        assert!(write_csv(uneven.iter(), &path).is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "a,1\nb,2\n");
        std::fs::remove_file(&path).unwrap();
    }

    #[test]
    fn versions_come_from_the_lock() {
        assert!(locked("wgpu").starts_with("30."), "{}", locked("wgpu"));
        assert_eq!(locked("no-such-package"), "");
    }
}
