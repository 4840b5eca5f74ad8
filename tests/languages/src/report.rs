//! The results, for the screen and for the docs.

use crate::tally::Tally;
use crate::{Result, told};
use serde::Serialize;
use std::path::Path;
use unitvec_languages::{Edition, Language};

/// A compiler and a driver.
pub struct Subject {
    pub language: Language,
    pub edition: Edition,
    pub compiler: String,
    pub driver: String,
    /// True where the compiler may take arithmetic for that of real numbers.
    pub is_hostile: bool,
    /// False where there is nothing to run the code on.
    pub is_run: bool,
}

impl Subject {
    pub fn new(language: Language, edition: Edition, compiler: &str) -> Self {
        let (compiler, driver) = (compiler.to_owned(), String::new());
        Self { language, edition, compiler, driver, is_hostile: false, is_run: true }
    }

    pub fn only_compiled(self) -> Self {
        Self { is_run: false, ..self }
    }

    /// True where the results have to be those of the CPU.
    pub fn is_exact(&self) -> bool {
        match self.language {
            Language::Glsl | Language::Hlsl => true,
            Language::Msl => self.edition == Edition::Exact || !self.is_hostile,
            _ => self.edition == Edition::Exact,
        }
    }
}

/// What came of one.
pub struct Row {
    pub subject: Subject,
    pub tally: Tally,
    pub seconds: f64,
}

impl Row {
    fn passed(&self) -> bool {
        self.tally.faults.is_empty() && (!self.subject.is_exact() || self.tally.mismatches() == 0)
    }

    pub fn line(&self) -> String {
        let Subject { language, edition, compiler, driver, .. } = &self.subject;
        let o = &self.tally.outcome;
        let mut text = format!(
            "{} {language:?} {edition:?}, {compiler}, {driver}: {} kernels, codes {} + {}, error {:.6}, vectors {}, 2^-24 {}, {:.2e} deg, {:.1} s",
            if self.passed() { "PASS" } else { "FAIL" },
            self.tally.kernels,
            o.codes_differ,
            o.special_differ,
            o.error,
            o.elements_differ,
            o.component_ulp,
            o.angle_deg,
            self.seconds
        );
        for (name, o) in &self.tally.differing {
            text += &format!(
                "\n    {name}: codes {} + {}, error {:.6}, vectors {}, 2^-24 {}, {:.2e} deg",
                o.codes_differ, o.special_differ, o.error, o.elements_differ, o.component_ulp, o.angle_deg
            );
        }
        for fault in self.tally.faults.iter().take(5) {
            text += &format!("\n    {}", fault.lines().take(3).collect::<Vec<_>>().join(" "));
        }
        text
    }
}

pub fn table(_rows: &[Row]) -> String {
    String::new()
}

pub fn verdict(rows: &[Row]) -> Result<()> {
    let failed = rows.iter().filter(|row| !row.passed()).count();
    if failed == 0 { Ok(()) } else { Err(format!("{failed} of {} fail", rows.len())) }
}

#[derive(Serialize)]
struct Record {}

pub fn record(_rows: &[Row], _path: &Path) -> Result<()> {
    let _ = told("");
    Ok(())
}

/// The version of a package in Cargo.lock.
pub fn locked(package: &str) -> String {
    let lock = include_str!("../../../Cargo.lock");
    let name = format!("name = \"{package}\"\nversion = \"");
    let version = lock.split(&name).nth(1).and_then(|rest| rest.split('"').next());
    version.unwrap_or_default().to_owned()
}
