//! The results, for the screen and for the docs.

use crate::cases::SPECIAL;
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

    /// GLSL, HLSL, MSL and C++ have means of their own to keep arithmetic as it is written, where the compiler heeds them.
    pub fn promise(&self) -> Promise {
        let has_means =
            matches!(self.language, Language::Glsl | Language::Hlsl | Language::Msl | Language::Cpp);
        match (self.edition, self.mode) {
            (_, Mode::Compiled) => Promise::Compiled,
            // The library's arithmetic is marked as exact.
            (Edition::Exact, _) | (_, Mode::Linked) => Promise::Equal,
            (Edition::Plain, Mode::FastMath) => Promise::None,
            (Edition::Plain, Mode::Usual) if has_means => Promise::Equal,
            (Edition::Plain, Mode::Usual) => Promise::Bounded,
        }
    }

    /// Compiler, options and driver, by the language and its edition.
    fn parts(&self) -> [&str; 5] {
        let edition = match self.edition {
            Edition::Plain => "plain",
            Edition::Exact => "exact",
        };
        let options = match self.mode {
            Mode::FastMath => "fast math",
            Mode::Linked => "linked",
            Mode::Usual | Mode::Compiled => "",
        };
        [self.language.name(), edition, &self.compiler, options, &self.driver]
    }

    fn told(&self) -> String {
        self.parts().into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
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
pub struct Record<'a> {
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

    /// The line of the record for the docs.
    pub fn record(&self) -> Record<'_> {
        let Self { subject, tally, .. } = self;
        let Outcome { codes_differ, special_differ, error, elements_differ, component_ulp, .. } =
            tally.outcome;
        let [language, edition, compiler, options, driver] = subject.parts();
        Record {
            language,
            edition,
            compiler,
            options,
            driver,
            kernels: tally.kernels,
            random: tally.random,
            special: if tally.random > 0 { SPECIAL } else { 0 },
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

    fn verdict(&self) -> &'static str {
        if self.objections().is_empty() { "PASS" } else { "FAIL" }
    }

    /// Formats the row for the screen.
    pub fn told(&self) -> String {
        const SHOWN: usize = 12;
        let Record {
            codes_differ, special_differ, error, elements_differ, component, angle, kernels, ..
        } = self.record();
        let mut text = format!(
            "{} {}: {kernels} kernels, {codes_differ} + {special_differ} codes differ (error {error} of the bound), \
             {elements_differ} vectors differ (components {component} 2^-24, angle {angle} of the bound); {:.0} s\n",
            self.verdict(),
            self.subject.told(),
            self.seconds
        );
        let objections = self.objections();
        for objection in objections.iter().take(SHOWN) {
            let lines = objection.lines().map(str::trim).filter(|line| !line.is_empty()).take(4);
            text += &format!("     {}\n", lines.collect::<Vec<_>>().join(" "));
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
        let Outcome { codes_differ, special_differ, elements_differ, .. } = row.tally.outcome;
        let counts = format!("{codes_differ:>8} {special_differ:>8} {elements_differ:>8}");
        text += &format!("{}  {counts}  {}\n", row.verdict(), row.subject.told());
    }
    text
}

/// Fails where any promise was not kept.
pub fn verdict(rows: &[Row]) -> Result<()> {
    let failed = rows.iter().filter(|row| row.verdict() == "FAIL").count();
    if rows.is_empty() {
        return Err("nothing ran".to_owned());
    }
    if failed == 0 { Ok(()) } else { Err(format!("{failed} of {} compilers and drivers fail", rows.len())) }
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
