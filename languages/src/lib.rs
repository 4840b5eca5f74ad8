//! The GLSL includes of `unitvec` in other shading languages: HLSL, WGSL, Slang, MSL, GLSL ES and Godot's,
//! and WGSL as modules for naga_oil and in WESL.
//!
//! A [`Library`] parses the includes once. [`Library::folder`] gives all of them in another language, with their functions,
//! names and comments; [`Library::excerpt`] only some functions and what they need; [`Library::flat`] the families in GLSL
//! without any include.
//!
//! ```
//! use unitvec_languages::{Edition, Language, Library};
//!
//! // The includes of `unitvec` are in the crate `unitvec-shaders`: `Library::parse(unitvec_shaders::glsl)`.
//! let library = Library::parse(|path| match path {
//!     "unitvec/unitvec.glsl" => Some("#include \"half.glsl\"\n"),
//!     "unitvec/half.glsl" => Some("float half_of(float x) {\n    return 0.5 * x;\n}\n"),
//!     _ => None,
//! })?;
//! let text = library.excerpt(&["half_of"], Language::Wgsl, Edition::Plain)?;
//! assert!(text.contains("fn half_of(x: f32) -> f32 {"));
//! # Ok::<(), unitvec_languages::Error>(())
//! ```
//!
//! The parser takes the part of GLSL that the includes use, and refuses everything else, with file and line. There is
//! no intermediate representation: the text that a person wrote stays, so that it can be read and compared with its
//! source.

mod flat;
mod language;
mod lex;
mod parse;
mod print;
mod syntax;
mod wrap;

pub use language::{EXACT, Edition, Language, UnknownLanguage};

use parse::{Declared, parse};
use print::Printer;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use syntax::{File, Item, ItemKind};

/// A file that cannot be put into other languages, or a function that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// A file is missing.
    #[error("there is no file glsl/unitvec/{0}")]
    NoFile(String),
    /// A line has something that the includes do not use.
    #[error("glsl/unitvec/{file}:{line}: {what}")]
    Refused {
        /// Its name: `oct.glsl`.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// The reason.
        what: String,
    },
    /// No file declares this function.
    #[error("no file of glsl/unitvec declares the function {0}")]
    NoFunction(String),
    /// A name that the language reserves.
    #[error("glsl/unitvec/{file}: {language} keeps the name `{name}` for itself; give it another")]
    Reserved {
        /// File that uses it.
        file: String,
        /// The language.
        language: Language,
        /// The name.
        name: String,
    },
}

impl Error {
    fn new(file: &str, line: usize, what: &str) -> Self {
        Self::Refused { file: file.to_owned(), line, what: what.to_owned() }
    }
}

/// The file that includes all families, in their order.
const ALL: &str = "unitvec.glsl";

/// The includes, parsed.
#[derive(Debug)]
pub struct Library {
    /// The files, each after those that it needs.
    files: Vec<File>,
    declared: Declared,
}

impl Library {
    /// Parses all includes. `source` gives the text of a file of `glsl/`, as `unitvec_shaders::glsl` does.
    ///
    /// # Errors
    /// [`Error::NoFile`] or [`Error::Refused`].
    pub fn parse<'a>(source: impl Fn(&str) -> Option<&'a str>) -> Result<Self, Error> {
        let mut library = Self { files: Vec::new(), declared: Declared::default() };
        let text =
            |name: &str| source(&format!("unitvec/{name}")).ok_or_else(|| Error::NoFile(name.to_owned()));
        let all = parse(ALL, text(ALL)?, &mut library.declared)?;
        for family in includes(&all) {
            let file = parse(family, text(family)?, &mut library.declared)?;
            if let Some(missing) = includes(&file).find(|needed| library.files().all(|name| name != *needed))
            {
                return Err(Error::new(family, 1, &format!("{ALL} has to include {missing} before it")));
            }
            library.files.push(file);
        }
        library.files.push(all);
        Ok(library)
    }

    fn items(&self) -> impl Iterator<Item = &Item> {
        self.files.iter().flat_map(|file| &file.items)
    }

    /// The names of the files in GLSL, each after those that it needs: `oct.glsl`.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|file| file.name.as_str())
    }

    /// A file's name in another language: `oct.hlsl`. `None` for the file that includes all, where the language has no
    /// way to include.
    pub fn file_name(&self, name: &str, language: Language) -> Option<String> {
        let is_possible = name != ALL || language.has_include() || language == Language::Slang;
        is_possible.then(|| format!("{}.{}", name.trim_end_matches(".glsl"), language.extension()))
    }

    /// A whole file in another language.
    ///
    /// # Errors
    /// [`Error::NoFile`], or [`Error::Reserved`].
    pub fn file(&self, name: &str, language: Language, edition: Edition) -> Result<String, Error> {
        let file = self.files.iter().find(|file| file.name == name);
        let file = file.ok_or_else(|| Error::NoFile(name.to_owned()))?;
        let mut printer = Printer::new(language, edition, &self.declared);
        printer.file(file)?;
        Ok(printer.finish())
    }

    /// All files in a language, by their paths in its folder: `oct.wesl`, `exact/oct.wesl`.
    ///
    /// # Errors
    /// [`Error::Reserved`].
    pub fn folder(&self, language: Language) -> Result<BTreeMap<String, String>, Error> {
        let mut texts = BTreeMap::new();
        for edition in language.editions() {
            for file in self.files() {
                if let Some(name) = self.file_name(file, language) {
                    let path = format!("{}{name}", edition.folder());
                    texts.insert(path, self.file(file, language, *edition)?);
                }
            }
        }
        Ok(texts)
    }

    /// These functions and all that they need, without heads of files, guards and includes.
    ///
    /// # Errors
    /// [`Error::NoFunction`], or [`Error::Reserved`].
    pub fn excerpt(&self, functions: &[&str], language: Language, edition: Edition) -> Result<String, Error> {
        let is_declared = |name: &str| {
            self.items()
                .any(|item| matches!(&item.kind, ItemKind::Function(function) if function.name == name))
        };
        if let Some(unknown) = functions.iter().find(|name| !is_declared(name)) {
            return Err(Error::NoFunction((*unknown).to_owned()));
        }
        let needed = self.closure(functions.to_vec(), language, edition);
        let mut printer = Printer::new(language, edition, &self.declared);
        printer.prelude();
        for file in &self.files {
            for item in file.items.iter().filter(|item| is_needed(item, &needed)) {
                printer.excerpted(file, item)?;
            }
        }
        Ok(printer.finish())
    }

    /// The paragraph on input and layout in the head of a function's file, as a comment in another language.
    ///
    /// # Errors
    /// [`Error::NoFunction`].
    pub fn layout(&self, function: &str, language: Language) -> Result<String, Error> {
        let declares = |file: &&File| file.items.iter().any(|item| item.kind.name() == Some(function));
        let file = self.files.iter().find(declares);
        let file = file.ok_or_else(|| Error::NoFunction(function.to_owned()))?;
        let mut printer = Printer::new(language, Edition::Plain, &self.declared);
        printer.layout(file);
        Ok(printer.finish())
    }

    /// The names that these names need, themselves included.
    fn closure<'a>(
        &'a self,
        mut open: Vec<&'a str>,
        language: Language,
        edition: Edition,
    ) -> BTreeSet<&'a str> {
        let by_name: HashMap<&str, &Item> =
            self.items().filter_map(|item| Some((item.kind.name()?, item))).collect();
        let mut needed = BTreeSet::new();
        while let Some(name) = open.pop() {
            let Some(item) = by_name.get(name) else { continue };
            if needed.insert(name) {
                open.extend(item.kind.names_used(&|condition| language.written().branch(edition, condition)));
            }
        }
        needed
    }
}

fn is_needed(item: &Item, needed: &BTreeSet<&str>) -> bool {
    match &item.kind {
        ItemKind::Precise(_) | ItemKind::Precision(_) => true,
        kind => kind.name().is_some_and(|name| needed.contains(name)),
    }
}

fn includes(file: &File) -> impl Iterator<Item = &str> {
    file.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Include { file, .. } => Some(file.as_str()),
        _ => None,
    })
}
