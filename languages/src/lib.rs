//! The GLSL includes of `unitvec` in other shading languages: HLSL, WGSL, Slang, MSL, GLSL ES, Godot's and
//! C++, and WGSL as modules for naga_oil and in WESL.
//!
//! A [`Library`] parses the includes once. [`Library::folder`] gives all of them in another language, with their functions,
//! names and comments; [`Library::excerpt`] only some [functions](Library::functions) and what they need;
//! [`Library::flat`] the families in GLSL without any include.
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
use print::{Printer, VECTORS};
use std::collections::BTreeMap;
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
    /// No file declares this function for users.
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
    /// The files, each after those that it needs: at least the one that includes all.
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

    fn items(&self) -> impl DoubleEndedIterator<Item = (&File, &Item)> {
        self.files.iter().flat_map(|file| file.items.iter().map(move |item| (file, item)))
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
        if language == Language::Cpp {
            texts.insert(VECTORS.0.to_owned(), VECTORS.1.to_owned());
        }
        Ok(texts)
    }

    /// The functions for users. The names of all others begin with `unitvec_`.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        let functions = self.items().filter(|(_, item)| matches!(item.kind, ItemKind::Function(_)));
        let names = functions.filter_map(|(_, item)| item.kind.name());
        names.filter(|name| !name.starts_with("unitvec_"))
    }

    /// These functions and all that they need, without heads of files and includes.
    ///
    /// What more of the library's functions need comes first, in parts: all that the same of them need. Where the language has a
    /// preprocessor, a guard around each part lets excerpts of one edition stand in one unit, whatever they share. Since an
    /// excerpt has all of a part or nothing, no declaration needs a guard of its own.
    ///
    /// # Errors
    /// [`Error::NoFunction`], or [`Error::Reserved`].
    pub fn excerpt(&self, functions: &[&str], language: Language, edition: Edition) -> Result<String, Error> {
        let names: Vec<&str> = self.functions().collect();
        let user = |name: &str| names.iter().position(|other| *other == name);
        let asked =
            functions.iter().map(|name| user(name).ok_or_else(|| Error::NoFunction((*name).to_owned())));
        let asked: Vec<usize> = asked.collect::<Result<_, _>>()?;
        let parts = self.parts(language, edition, names.len(), usize::MAX, user);
        let needed = parts.iter().filter(|part| asked.iter().any(|user| part.is_for(*user)));
        let mut printer = Printer::new(language, edition, &self.declared);
        printer.excerpt(&self.files[0], needed)?;
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
}

fn includes(file: &File) -> impl Iterator<Item = &str> {
    file.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Include { file, .. } => Some(file.as_str()),
        _ => None,
    })
}
