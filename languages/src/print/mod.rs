//! The tree as text in a language, in the order and with the comments of the source.

mod comment;
mod expr;
mod function;

use crate::parse::{Declared, PRECISE};
use crate::syntax::{
    Block, Branch, Condition, Constant, Declaration, Expr, ExprKind, File, Item, ItemKind, Part, Statement,
    StatementKind, Struct, Type,
};
use crate::wrap::{WIDTH, wrapped};
use crate::{ALL, EXACT, Edition, Error, Language};
use std::collections::{BTreeMap, BTreeSet};

/// Writes text in a language.
pub struct Printer<'a> {
    language: Language,
    edition: Edition,
    declared: &'a Declared,
    lines: Vec<String>,
    /// Parameters of the function at hand that are pointers in WGSL.
    pointers: Vec<String>,
    /// Names that the function at hand assigns to.
    assigned: Vec<String>,
    /// Set while the right-hand side of a precise variable is printed.
    in_precise: bool,
    /// False in excerpts, whose names are all for their user.
    has_module: bool,
    /// The output kind; `language` is the syntax it is written in.
    asked: Language,
}

/// The exact editions' name for the second operand of the barriers' `min`.
const BARRIER: &str = "UNITVEC_HUGE";

/// The beginning of the names of what only exact editions need.
const OF_EXACT: &str = "unitvec_exact_";

/// The barrier of C++, a function.
const ROUNDED: &str = "unitvec_rounded";

/// The types and functions of GLSL in C++.
pub const VECTORS: (&str, &str) = ("vectors.hpp", include_str!("vectors.hpp"));

const NAMESPACE: &str = "namespace unitvec {";

/// The file that has the barriers, and the arithmetic that all families need.
pub const ARITH: &str = "arith.glsl";

impl<'a> Printer<'a> {
    pub fn new(language: Language, edition: Edition, declared: &'a Declared) -> Self {
        Self {
            language: language.written(),
            edition,
            declared,
            lines: Vec::new(),
            pointers: Vec::new(),
            assigned: Vec::new(),
            in_precise: false,
            has_module: false,
            asked: language,
        }
    }

    /// The text, without blank lines at its ends or next to each other.
    pub fn finish(self) -> String {
        let mut text = String::new();
        let mut is_blank = true;
        for line in self.lines {
            if !(is_blank && line.is_empty()) {
                text += &line;
                text.push('\n');
            }
            is_blank = line.is_empty();
        }
        format!("{}\n", text.trim_end())
    }

    fn line(&mut self, line: impl Into<String>) {
        self.lines.push(line.into());
    }

    /// True where barriers are needed.
    fn has_barriers(&self) -> bool {
        self.language == Language::Cpp || self.edition == Edition::Exact && !self.language.has_precise()
    }

    /// A whole file.
    pub fn file(&mut self, file: &File) -> Result<(), Error> {
        self.has_module = self.language == Language::Slang || self.asked == Language::NagaOil;
        let head = self.head(file);
        self.lines.extend(head);
        self.line("");
        let guard = format!(
            "UNITVEC_{}_{}",
            stem(&file.name).to_uppercase(),
            self.language.extension().to_uppercase()
        );
        let is_guarded =
            file.name != ALL && self.language.has_preprocessor() && self.language != Language::Slang;
        if is_guarded {
            self.open_guard(&guard);
            self.line("");
        }
        if self.asked == Language::NagaOil {
            self.line(format!("#define_import_path unitvec::{}", stem(&file.name)));
        } else if self.has_module {
            let is_all = file.name == ALL;
            self.line(if is_all { "module unitvec;" } else { "implementing unitvec;" });
            self.line("");
        }
        let before_items = self.lines.len();
        if file.name == ARITH {
            self.prelude(true);
        }
        let (includes, others): (Vec<&Item>, Vec<&Item>) =
            file.items.iter().partition(|item| matches!(item.kind, ItemKind::Include { .. }));
        includes.into_iter().try_for_each(|item| self.item(file, item))?;
        let has_namespace = self.language == Language::Cpp && file.name != ALL;
        if has_namespace {
            self.lines.extend([String::new(), NAMESPACE.to_owned(), String::new()]);
        }
        others.into_iter().try_for_each(|item| self.item(file, item))?;
        if self.asked != self.language {
            let imports = self.imports(file, before_items);
            self.lines.splice(before_items..before_items, imports);
        }
        self.comments(0, &file.tail);
        if has_namespace {
            self.lines.extend([String::new(), "}".to_owned()]);
        }
        if is_guarded {
            self.lines.extend([String::new(), "#endif".to_owned()]);
        }
        Ok(())
    }

    /// Imports of the names from other files that the lines from this one on use.
    fn imports(&self, file: &File, from: usize) -> Vec<String> {
        let code = self.lines[from..].iter().filter(|line| !line.trim_start().starts_with("//"));
        let words = code.flat_map(|line| line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'));
        let mut imported: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for word in words {
            let home =
                if word == BARRIER { ARITH } else { self.declared.homes.get(word).unwrap_or(&file.name) };
            if home != file.name {
                imported.entry(home).or_default().insert(word);
            }
        }
        let line = |(home, names): (&str, BTreeSet<&str>)| {
            let names: Vec<&str> = names.into_iter().collect();
            let (home, names) = (stem(home), names.join(", "));
            let text = match self.asked {
                Language::NagaOil => format!("#import unitvec::{home}::{{{names}}}"),
                _ => format!("import super::{home}::{{{names}}};"),
            };
            wrapped(0, &text)
        };
        let mut lines: Vec<String> = imported.into_iter().flat_map(line).collect();
        lines.push(String::new());
        lines
    }

    /// The lines before the first declaration.
    fn prelude(&mut self, is_file: bool) {
        if self.asked == Language::NagaOil && !self.has_module {
            self.lines.extend(["#define_import_path unitvec".to_owned(), String::new()]);
        }
        if self.language == Language::Msl {
            let head = "#include <metal_stdlib>\nusing namespace metal;\n\n// No product and sum in one rounding.\n\
                        #pragma clang fp contract(off)\n\n";
            self.lines.extend(head.lines().map(str::to_owned));
        }
        if self.language == Language::Cpp && is_file {
            self.lines.extend([format!("#include \"{}\"", VECTORS.0), String::new()]);
        } else if self.language == Language::Cpp {
            self.lines.extend(VECTORS.1.lines().map(str::to_owned));
        }
        if self.edition == Edition::Exact && self.language.has_precise() {
            self.lines.extend([format!("#define {EXACT}"), String::new()]);
        }
        if self.has_barriers() && self.language != Language::Cpp {
            // In GLSL ES it stands above the default precision.
            let ty =
                if self.language == Language::GlslEs { "highp float" } else { &self.type_name(&Type::FLOAT) };
            let value = self.constant_text(ty, BARRIER, &self.number("3e38", &Type::FLOAT));
            let why = "// No result is larger, but compilers cannot know: what goes through `min` with it is rounded before.";
            self.lines.extend([why.to_owned(), value, String::new()]);
        }
    }

    /// Parts of the library without heads of files, each in a guard where the language has any.
    pub fn excerpt<'p>(
        &mut self,
        first: &File,
        parts: impl Iterator<Item = &'p Part<'p>>,
    ) -> Result<(), Error> {
        // Editions do not mix: with one prefix, a text would take the other edition's functions without a word.
        let prefix = if self.edition == Edition::Exact { "UNITVEC_ONCE_EXACT_" } else { "UNITVEC_ONCE_" };
        let from = self.lines.len();
        self.prelude(false);
        self.guard_from(from, Some(format!("{prefix}PRELUDE")));
        self.settings(first)?;
        let is_cpp = self.language == Language::Cpp;
        self.lines.extend(is_cpp.then(|| NAMESPACE.to_owned()));
        for part in parts {
            let from = self.lines.len();
            part.items.iter().try_for_each(|(file, item)| self.excerpted(file, item))?;
            self.guard_from(from, part.guard(prefix));
        }
        self.lines.extend(is_cpp.then(|| "}".to_owned()));
        Ok(())
    }

    /// Precisions, which count for what follows, so that each text needs them: those of the library's first file.
    fn settings(&mut self, first: &File) -> Result<(), Error> {
        let is_setting = |item: &&Item| matches!(item.kind, ItemKind::Precision(_) | ItemKind::Precise(_));
        first.items.iter().filter(is_setting).try_for_each(|item| self.excerpted(first, item))
    }

    /// A declaration without its file: only the comment right above it.
    fn excerpted(&mut self, file: &File, item: &Item) -> Result<(), Error> {
        let is_short = item.lead.is_empty();
        if !is_short {
            self.line("");
        }
        let from = item.lead.iter().rposition(String::is_empty).map_or(0, |blank| blank + 1);
        let own = Item { lead: item.lead[from..].to_vec(), kind: item.kind.clone() };
        self.item(file, &own)
    }

    /// A family's file of GLSL with these parts of the library and without any include.
    pub fn flat<'p>(
        &mut self,
        family: &File,
        first: &File,
        parts: impl Iterator<Item = &'p Part<'p>>,
    ) -> Result<(), Error> {
        let source = "// Generated by `cargo xtask shaders` from glsl/unitvec/";
        self.lines
            .extend([format!("{source}{} and what it needs: do not edit.", family.name), "//".to_owned()]);
        self.lines.extend(family.head.iter().cloned());
        self.line("");
        let file_guard = format!("UNITVEC_{}_GLSL", stem(&family.name).to_uppercase());
        self.open_guard(&file_guard);
        self.settings(first)?;
        self.line("");
        for part in parts {
            // What one family alone needs stands in its file's guard.
            let guard = part.guard("UNITVEC_HAS_").filter(|_| part.users.0.0 > 1);
            guard.iter().for_each(|guard| self.open_guard(guard));
            for (file, item) in &part.items {
                if file.name == family.name {
                    self.excerpted(file, item)?;
                } else {
                    self.item(file, &Item { lead: Vec::new(), kind: item.kind.clone() })?;
                }
            }
            self.lines.extend(guard.map(|_| "#endif".to_owned()));
        }
        self.lines.extend([String::new(), "#endif".to_owned()]);
        Ok(())
    }

    /// Puts the lines from this one on into a guard, where the language has any.
    fn guard_from(&mut self, from: usize, guard: Option<String>) {
        let is_guarded = self.language.has_preprocessor() && self.lines.len() > from;
        if let Some(guard) = guard.filter(|_| is_guarded) {
            let own = self.lines.split_off(from).join("\n");
            self.line("");
            self.open_guard(&guard);
            self.lines.extend(own.trim_matches('\n').lines().map(str::to_owned));
            self.lines.extend(["#endif".to_owned(), String::new()]);
        }
    }

    /// Begins what a macro keeps from being there twice.
    fn open_guard(&mut self, guard: &str) {
        self.lines.extend([format!("#ifndef {guard}"), format!("#define {guard}")]);
    }

    fn comments(&mut self, indent: usize, lead: &[String]) {
        for comment in lead {
            let text = self.comment(comment);
            self.line(if text.is_empty() { text } else { format!("{:indent$}{text}", "") });
        }
    }

    fn item(&mut self, file: &File, item: &Item) -> Result<(), Error> {
        let is_of_exact = |name: &str| name.to_ascii_lowercase().starts_with(OF_EXACT);
        let has_no_exact =
            self.language.branch(self.edition, &Condition::Exact(String::new())) == Branch::Otherwise;
        let is_left_out = match &item.kind {
            ItemKind::Precise(_) => self.language != Language::Glsl,
            ItemKind::Precision(_) => !matches!(self.language, Language::Glsl | Language::GlslEs),
            kind => has_no_exact && kind.name().is_some_and(is_of_exact),
        };
        if is_left_out {
            let own = item.lead.iter().rposition(String::is_empty).unwrap_or_default();
            self.comments(0, &item.lead[..own]);
            self.line("");
            return Ok(());
        }
        let taken = item.kind.names_given().into_iter().find(|name| self.language.is_reserved(name));
        if let Some(name) = taken {
            let (file, language, name) = (file.name.clone(), self.language, name.to_owned());
            return Err(Error::Reserved { file, language, name });
        }
        if let ItemKind::Include { file, is_guarded } = &item.kind {
            self.include(file, *is_guarded);
            return Ok(());
        }
        self.comments(0, &item.lead);
        match &item.kind {
            ItemKind::Include { .. } => {}
            ItemKind::Precise(lines) => self.lines.extend(lines.iter().cloned()),
            ItemKind::Precision(words) => self.line(format!("{words};")),
            ItemKind::Constant(constant) => self.constant(constant),
            ItemKind::Struct(declared) => self.structure(declared),
            ItemKind::Function(function) => self.function(function, file),
        }
        Ok(())
    }

    fn include(&mut self, file: &str, is_guarded: bool) {
        let name = self.file_name(file);
        if self.language == Language::Slang {
            if !is_guarded {
                self.line(format!("__include {};", stem(file)));
            }
        } else if self.language == Language::Glsl && is_guarded {
            let guard = format!("#ifndef UNITVEC_{}_GLSL", stem(file).to_uppercase());
            self.lines.extend([guard, format!("#include \"{name}\""), "#endif".to_owned()]);
        } else if self.language.has_include() {
            self.line(format!("#include \"{name}\""));
        }
    }

    /// A file's name in this language.
    fn file_name(&self, file: &str) -> String {
        format!("{}.{}", stem(file), self.language.extension())
    }

    fn constant(&mut self, constant: &Constant) {
        let (ty, value) = (self.type_name(&constant.ty), self.value(&constant.value));
        // An object of a class in the host's memory is none for a GPU.
        if self.language == Language::Cpp && !matches!(constant.ty, Type::Value(_, 1)) {
            return self.line(wrapped(0, &format!("#define {} {value}", constant.name)).join(" \\\n"));
        }
        let text = self.constant_text(&ty, &constant.name, &value);
        self.wrapped(0, &text);
    }

    fn constant_text(&self, ty: &str, name: &str, value: &str) -> String {
        match self.language {
            Language::Wgsl => format!("const {name}: {ty} = {value};"),
            Language::Cpp => format!("constexpr {ty} {name} = {value};"),
            Language::Msl => format!("constant {ty} {name} = {value};"),
            Language::Hlsl | Language::Slang => format!("static const {ty} {name} = {value};"),
            _ => format!("const {ty} {name} = {value};"),
        }
    }

    /// The initial value of a variable: structs are lists in languages whose structs have no constructor.
    fn value(&self, value: &Expr) -> String {
        let has_lists = matches!(self.language, Language::Hlsl | Language::Slang | Language::Msl);
        match &value.kind {
            ExprKind::Construct(arguments) if matches!(value.ty, Type::Struct(_)) && has_lists => {
                format!("{{ {} }}", self.list(arguments))
            }
            _ => self.expr(value),
        }
    }

    fn structure(&mut self, declared: &Struct) {
        self.line(format!("struct {} {{", declared.name));
        for (ty, name) in &declared.fields {
            let ty = self.type_name(ty);
            self.line(match self.language {
                Language::Wgsl => format!("    {name}: {ty},"),
                _ => format!("    {ty} {name};"),
            });
        }
        self.line(if self.language == Language::Wgsl { "}" } else { "};" });
    }

    /// `head { … }`, in one line where the source has it so and there is room.
    fn block(&mut self, indent: usize, head: &str, block: &Block, first: Vec<String>) {
        let one_line =
            self.one_line(head, block).filter(|line| first.is_empty() && indent + line.len() <= WIDTH);
        if let Some(line) = one_line {
            self.line(format!("{:indent$}{line}", ""));
            return;
        }
        self.wrapped(indent, &format!("{head} {{"));
        self.lines.extend(first);
        self.statements(indent + 4, &block.statements);
        self.line(format!("{:indent$}}}", ""));
    }

    /// A block in one line, where the source has it so.
    fn one_line(&mut self, head: &str, block: &Block) -> Option<String> {
        let [Statement { kind, lead }] = block.statements.as_slice() else { return None };
        if !block.is_one_line || !lead.is_empty() {
            return None;
        }
        let text = self.simple(kind)?;
        let has_braces = block.has_braces || self.language == Language::Wgsl;
        Some(if has_braces { format!("{head} {{ {text}; }}") } else { format!("{head} {text};") })
    }

    fn statements(&mut self, indent: usize, statements: &[Statement]) {
        for Statement { lead, kind } in statements {
            self.comments(indent, lead);
            self.statement(indent, kind);
        }
    }

    fn statement(&mut self, indent: usize, kind: &StatementKind) {
        if let Some(text) = self.simple(kind) {
            self.wrapped(indent, &format!("{text};"));
            return;
        }
        match kind {
            StatementKind::If { condition, then: body } | StatementKind::While { condition, body } => {
                let word = if matches!(kind, StatementKind::If { .. }) { "if" } else { "while" };
                let head = format!("{word} {}", self.condition(condition));
                self.block(indent, &head, body, Vec::new());
            }
            StatementKind::For { start, condition, step, body } => {
                let [start, step] = [start, step].map(|part| self.simple(&part.kind).unwrap_or_default());
                let head = format!("for ({start}; {}; {step})", self.expr(condition));
                self.block(indent, &head, body, Vec::new());
            }
            StatementKind::Alternative { condition, then, otherwise } => {
                self.alternative(indent, condition, then, otherwise);
            }
            _ => {}
        }
    }

    fn alternative(
        &mut self,
        indent: usize,
        condition: &Condition,
        then: &[Statement],
        otherwise: &[Statement],
    ) {
        let (Condition::Version(line) | Condition::Exact(line) | Condition::Macro(line)) = condition;
        match self.language.branch(self.edition, condition) {
            Branch::Both => {
                self.line(line);
                self.statements(indent, then);
                self.line("#else");
                self.statements(indent, otherwise);
                self.line("#endif");
            }
            Branch::Then => self.statements(indent, then),
            Branch::Otherwise => self.statements(indent, otherwise),
        }
    }

    fn condition(&self, condition: &Expr) -> String {
        let text = self.expr(condition);
        if self.language == Language::Wgsl { text } else { format!("({text})") }
    }

    /// A statement that has no block, without its semicolon.
    fn simple(&mut self, kind: &StatementKind) -> Option<String> {
        Some(match kind {
            StatementKind::Declare(declaration) => self.declaration(declaration),
            StatementKind::Assign { target, operator, value, is_precise } => {
                self.in_precise = *is_precise;
                let text = self.assignment(target, operator, value);
                self.in_precise = false;
                text
            }
            StatementKind::Call(expr) => self.expr(expr),
            StatementKind::Return(expr) => format!("return {}", self.expr(expr)),
            _ => return None,
        })
    }

    /// In exact editions `a += b` must be `a = min(a + b, …)`.
    fn assignment(&self, target: &Expr, operator: &str, value: &Expr) -> String {
        let to = self.expr(target);
        let compound = operator.strip_suffix('=').filter(|operator| !operator.is_empty());
        match compound {
            Some(operator) if self.has_barriers() && self.in_precise => {
                let sum =
                    ExprKind::Binary(operator.to_owned(), Box::new(target.clone()), Box::new(value.clone()));
                format!("{to} = {}", self.expr(&Expr { kind: sum, ty: target.ty.clone() }))
            }
            _ => format!("{to} {operator} {}", self.expr(value)),
        }
    }

    fn declaration(&mut self, declaration: &Declaration) -> String {
        let Declaration { is_precise, is_constant, ty, name, value } = declaration;
        self.in_precise = *is_precise;
        let value = value.as_ref().map(|value| self.value(value));
        self.in_precise = false;
        let type_name = self.type_name(ty);
        let assigned = value.as_ref().map(|value| format!(" = {value}")).unwrap_or_default();
        if self.language == Language::Wgsl {
            let varies = self.assigned.contains(name) || value.is_none();
            return match (varies, value.is_some()) {
                (true, false) => format!("var {name}: {type_name}"),
                (true, true) => format!("var {name}{assigned}"),
                // With its type: numbers without one are evaluated in more bits.
                (false, _) if *is_constant => format!("const {name}: {type_name}{assigned}"),
                (false, _) => format!("let {name}{assigned}"),
            };
        }
        let prefix = match (self.language, is_precise, is_constant) {
            (Language::Glsl, true, _) => format!("{PRECISE} "),
            (Language::Hlsl, true, _) => "precise ".to_owned(),
            (_, _, true) => "const ".to_owned(),
            _ => String::new(),
        };
        let length = match ty {
            Type::Array(_, length) => format!("[{length}]"),
            _ => String::new(),
        };
        format!("{prefix}{type_name} {name}{length}{assigned}")
    }

    fn type_name(&self, ty: &Type) -> String {
        self.language.type_name(ty)
    }

    fn wrapped(&mut self, indent: usize, text: &str) {
        self.lines.extend(wrapped(indent, text));
    }
}

/// The parts of a list, as text.
fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(", ")
}

/// A file's name without its extension.
fn stem(file: &str) -> &str {
    file.strip_suffix(".glsl").unwrap_or(file)
}

/// True for the functions that are for users: those without the library's prefix, and those that the head of the file
/// names.
fn is_public(name: &str, file: &File) -> bool {
    let is_in_head = || file.head.iter().any(|line| line.contains(&format!("{name}(")));
    !name.starts_with("unitvec_") || is_in_head()
}
