//! Tokens to the tree of a file. Everything that the includes do not use is refused, with file and line.

mod expr;

pub use expr::precedence;
use expr::root;

use crate::Error;
use crate::language::EXACT;
use crate::lex::{Kind, Token, tokens};
use crate::syntax::{
    Block, Condition, Constant, Declaration, Expr, ExprKind, File, Function, Item, ItemKind, Lead, Parameter,
    Statement, StatementKind, Struct, Type,
};
use std::collections::HashMap;

/// The top-level declarations of the files so far.
#[derive(Debug, Default)]
pub struct Declared {
    pub functions: HashMap<String, (Type, Vec<Parameter>)>,
    pub structs: HashMap<String, Struct>,
    pub constants: HashMap<String, Type>,
    /// The file of each name.
    pub homes: HashMap<String, String>,
}

/// The macro in place of `precise`.
pub const PRECISE: &str = "UNITVEC_PRECISE";

/// Parses a file, and adds its declarations.
pub fn parse(name: &str, text: &str, declared: &mut Declared) -> Result<File, Error> {
    let tokens = tokens(name, text)?;
    let mut parser = Parser {
        file: name,
        tokens,
        next: 0,
        declared,
        scopes: Vec::new(),
        assigned: Vec::new(),
        returns: Type::Void,
        in_version: false,
        may_be_struct: false,
    };
    parser.file()
}

struct Parser<'a> {
    file: &'a str,
    tokens: Vec<Token<'a>>,
    next: usize,
    declared: &'a mut Declared,
    /// Variables of the function at hand: their type, and whether they are precise.
    scopes: Vec<HashMap<String, (Type, bool)>>,
    assigned: Vec<String>,
    /// The return type of the function at hand.
    returns: Type,
    /// True where a newer version of GLSL is certain.
    in_version: bool,
    /// True at the start of a variable's initial value, which may be a struct.
    may_be_struct: bool,
}

type Parsed<T> = Result<T, Error>;

impl<'a> Parser<'a> {
    fn peek(&self) -> &Token<'a> {
        &self.tokens[self.next]
    }

    fn ahead(&self, by: usize) -> &'a str {
        self.tokens.get(self.next + by).map_or("", |token| token.text)
    }

    fn take(&mut self) -> Token<'a> {
        let token = self.tokens[self.next].clone();
        // The end stays.
        self.next = (self.next + 1).min(self.tokens.len() - 1);
        token
    }

    fn is(&self, text: &str) -> bool {
        self.peek().text == text && self.peek().kind != Kind::End
    }

    fn took(&mut self, text: &str) -> bool {
        let is_it = self.is(text);
        if is_it {
            self.take();
        }
        is_it
    }

    fn expect(&mut self, text: &str) -> Parsed<Token<'a>> {
        if self.is(text) { Ok(self.take()) } else { Err(self.wanted(&format!("`{text}`"))) }
    }

    fn wanted(&self, what: &str) -> Error {
        let found = match self.peek() {
            Token { kind: Kind::End, .. } => "the end of the file".to_owned(),
            token => format!("`{}`", token.text),
        };
        self.error(&format!("{what} should stand in place of {found}"))
    }

    fn error(&self, what: &str) -> Error {
        Error::new(self.file, self.peek().line, what)
    }

    fn word(&mut self, what: &str) -> Parsed<String> {
        match self.peek().kind {
            Kind::Word => Ok(self.take().text.to_owned()),
            _ => Err(self.wanted(what)),
        }
    }

    /// Parts in parentheses, with commas between them.
    fn listed<T>(&mut self, part: impl Fn(&mut Self) -> Parsed<T>) -> Parsed<Vec<T>> {
        self.expect("(")?;
        let mut parts = Vec::new();
        while !self.took(")") {
            parts.push(part(self)?);
            if !self.is(")") {
                self.expect(",")?;
            }
        }
        Ok(parts)
    }

    /// The file: comment, guard, declarations.
    fn file(&mut self) -> Parsed<File> {
        let guard = self.peek().text.strip_prefix("#ifndef ").filter(|name| name.ends_with("_GLSL"));
        let guard = guard.filter(|name| self.ahead(1) == format!("#define {name}")).map(str::to_owned);
        let mut head = std::mem::take(&mut self.tokens[self.next].lead);
        if guard.is_some() {
            self.take();
            self.take();
        } else if let Some(blank) = head.iter().position(String::is_empty) {
            self.tokens[self.next].lead = head.split_off(blank);
        }
        while head.last().is_some_and(String::is_empty) {
            head.pop();
        }
        let mut items = Vec::new();
        while self.peek().kind != Kind::End && !(guard.is_some() && self.is("#endif")) {
            items.push(self.item()?);
        }
        let tail = std::mem::take(&mut self.tokens[self.next].lead);
        if guard.is_some() {
            self.expect("#endif")?;
        }
        if self.peek().kind != Kind::End {
            return Err(self.wanted("the end of the file"));
        }
        let has_comment = |token: &&Token<'_>| token.lead.iter().any(|line| !line.is_empty());
        if let Some(token) = self.tokens.iter().find(has_comment) {
            let what = "a comment has to stand before a declaration or a statement";
            return Err(Error::new(self.file, token.line, what));
        }
        Ok(File { name: self.file.to_owned(), head, items, tail })
    }

    fn item(&mut self) -> Parsed<Item> {
        let lead = self.lead();
        let kind = match (self.peek().kind, self.peek().text) {
            (Kind::Directive, text)
                if text.starts_with("#include") && lead.iter().any(|line| !line.is_empty()) =>
            {
                return Err(self.error("a comment has to stand before a declaration or a statement"));
            }
            (Kind::Directive, _) => self.directive()?,
            (_, "precision") => self.precision()?,
            (_, "struct") => ItemKind::Struct(self.structure()?),
            (_, "const") => ItemKind::Constant(self.constant()?),
            _ => ItemKind::Function(self.function()?),
        };
        Ok(Item { lead, kind })
    }

    fn lead(&mut self) -> Lead {
        std::mem::take(&mut self.tokens[self.next].lead)
    }

    fn directive(&mut self) -> Parsed<ItemKind> {
        if self.is("#ifndef UNITVEC_PRECISE") {
            let mut lines = Vec::new();
            let mut depth = 0;
            loop {
                let line = self.take();
                depth += i32::from(line.text.starts_with("#if")) - i32::from(line.text == "#endif");
                if line.kind != Kind::Directive {
                    return Err(self.wanted("a directive"));
                }
                lines.push(line.text.to_owned());
                if depth == 0 {
                    return Ok(ItemKind::Precise(lines));
                }
            }
        }
        let is_guarded = self.peek().text.starts_with("#ifndef ");
        if is_guarded {
            self.take();
        }
        let file = self.peek().text.strip_prefix("#include \"").and_then(|rest| rest.strip_suffix('"'));
        let Some(file) = file.map(str::to_owned) else {
            return Err(self.error(&format!("what is `{}` for?", self.peek().text)));
        };
        self.take();
        if is_guarded {
            self.expect("#endif")?;
        }
        Ok(ItemKind::Include { file, is_guarded })
    }

    fn precision(&mut self) -> Parsed<ItemKind> {
        let mut words = Vec::new();
        while !self.is(";") {
            words.push(self.word("a precision")?);
        }
        self.expect(";")?;
        Ok(ItemKind::Precision(words.join(" ")))
    }

    fn structure(&mut self) -> Parsed<Struct> {
        self.expect("struct")?;
        let name = self.new_name()?;
        self.expect("{")?;
        let mut fields = Vec::new();
        while !self.took("}") {
            let field = (self.type_name()?, self.word("a field's name")?);
            if field.1.ends_with(|c: char| c.is_ascii_digit()) {
                return Err(self.error("naga_oil refuses fields whose names end in a digit"));
            }
            fields.push(field);
            self.expect(";")?;
        }
        self.expect(";")?;
        let declared = Struct { name: name.clone(), fields };
        self.declared.structs.insert(name, declared.clone());
        Ok(declared)
    }

    fn constant(&mut self) -> Parsed<Constant> {
        self.expect("const")?;
        let (ty, name) = (self.type_name()?, self.new_name()?);
        self.expect("=")?;
        let value = self.declared_value(&ty)?;
        self.expect(";")?;
        self.declared.constants.insert(name.clone(), ty.clone());
        Ok(Constant { ty, name, value })
    }

    /// A name of the top level that no other file has taken.
    fn new_name(&mut self) -> Parsed<String> {
        let name = self.word("a name")?;
        if self.declared.homes.insert(name.clone(), self.file.to_owned()).is_some() {
            return Err(self.error(&format!("`{name}` is declared twice")));
        }
        Ok(name)
    }

    fn type_name(&mut self) -> Parsed<Type> {
        let word = self.peek().text;
        let ty = Type::named(word)
            .or_else(|| self.declared.structs.contains_key(word).then(|| Type::Struct(word.to_owned())));
        match ty {
            Some(ty) => {
                self.take();
                Ok(ty)
            }
            None => Err(self.wanted("a type")),
        }
    }

    fn function(&mut self) -> Parsed<Function> {
        let (returns, name) = (self.type_name()?, self.new_name()?);
        let parameters = self.listed(|parser| {
            let is_out = parser.took("out");
            Ok(Parameter { ty: parser.type_name()?, name: parser.word("a parameter's name")?, is_out })
        })?;
        let scope =
            parameters.iter().map(|parameter| (parameter.name.clone(), (parameter.ty.clone(), false)));
        self.scopes = vec![scope.collect()];
        self.assigned.clear();
        self.returns = returns.clone();
        let body = self.block()?;
        let assigned = std::mem::take(&mut self.assigned);
        self.declared.functions.insert(name.clone(), (returns.clone(), parameters.clone()));
        Ok(Function { returns, name, parameters, body, assigned })
    }

    /// Statements in braces, or one without.
    fn block(&mut self) -> Parsed<Block> {
        let first_line = self.tokens[self.next.saturating_sub(1)].line;
        self.scopes.push(HashMap::new());
        let has_braces = self.took("{");
        let mut statements = Vec::new();
        while !(has_braces && self.is("}")) {
            statements.push(self.statement()?);
            if !has_braces {
                break;
            }
        }
        let last = if has_braces { self.expect("}")? } else { self.tokens[self.next - 1].clone() };
        self.scopes.pop();
        Ok(Block { statements, is_one_line: last.line == first_line, has_braces })
    }

    fn statement(&mut self) -> Parsed<Statement> {
        let lead = self.lead();
        let kind = match (self.peek().kind, self.peek().text) {
            (Kind::End, _) => return Err(self.wanted("`}`")),
            (Kind::Directive, _) => self.alternative()?,
            (_, "if") => self.condition()?,
            (_, "for") => self.counted()?,
            (_, "while") => {
                self.take();
                let condition = self.in_parentheses()?;
                StatementKind::While { condition, body: self.block()? }
            }
            _ => {
                let kind = self.simple()?;
                self.expect(";")?;
                kind
            }
        };
        Ok(Statement { lead, kind })
    }

    fn alternative(&mut self) -> Parsed<StatementKind> {
        let directive = self.peek().text.to_owned();
        let condition = match directive.strip_prefix("#ifdef ") {
            Some(EXACT) => Condition::Exact(directive),
            Some(_) => Condition::Macro(directive),
            None if directive.starts_with("#if __VERSION__ >= ") => Condition::Version(directive),
            None => return Err(self.error(&format!("what is `{directive}` for?"))),
        };
        self.take();
        self.in_version = matches!(condition, Condition::Version(_));
        let then = self.statements_to("#else")?;
        self.in_version = false;
        let otherwise = self.statements_to("#endif")?;
        Ok(StatementKind::Alternative { condition, then, otherwise })
    }

    /// The statements before a directive, which is taken too.
    fn statements_to(&mut self, end: &str) -> Parsed<Vec<Statement>> {
        let mut statements = Vec::new();
        while !self.took(end) {
            statements.push(self.statement()?);
        }
        Ok(statements)
    }

    fn in_parentheses(&mut self) -> Parsed<Expr> {
        self.expect("(")?;
        let condition = self.of_type(&Type::BOOL)?;
        self.expect(")")?;
        Ok(condition)
    }

    fn condition(&mut self) -> Parsed<StatementKind> {
        self.expect("if")?;
        let condition = self.in_parentheses()?;
        let then = self.block()?;
        if self.is("else") {
            return Err(self.error("`else` is not among what the includes use"));
        }
        Ok(StatementKind::If { condition, then })
    }

    fn counted(&mut self) -> Parsed<StatementKind> {
        self.expect("for")?;
        self.expect("(")?;
        self.scopes.push(HashMap::new());
        let part = |parser: &mut Self| Ok(Box::new(Statement { lead: Lead::new(), kind: parser.simple()? }));
        let start = part(self)?;
        self.expect(";")?;
        let condition = self.of_type(&Type::BOOL)?;
        self.expect(";")?;
        let step = part(self)?;
        self.expect(")")?;
        let body = self.block()?;
        self.scopes.pop();
        Ok(StatementKind::For { start, condition, step, body })
    }

    /// A statement without its semicolon.
    fn simple(&mut self) -> Parsed<StatementKind> {
        let word = self.peek().text;
        if word == "return" {
            self.take();
            let returns = self.returns.clone();
            return Ok(StatementKind::Return(self.of_type(&returns)?));
        }
        let is_type = Type::named(word).is_some() || self.declared.structs.contains_key(word);
        let is_declaration = [PRECISE, "const"].contains(&word)
            || (is_type && self.tokens.get(self.next + 1).is_some_and(|token| token.kind == Kind::Word));
        if is_declaration {
            return self.declaration().map(StatementKind::Declare);
        }
        let target = self.postfix()?;
        let operator = self.peek().text.to_owned();
        if !operator.ends_with('=') || ["==", "<=", ">=", "!="].contains(&operator.as_str()) {
            return Ok(StatementKind::Call(target));
        }
        self.take();
        let value = self.expression()?;
        let with = operator.trim_end_matches('=');
        let is_of_type = if with.is_empty() || ["|", "&", "^"].contains(&with) {
            value.ty == target.ty
        } else {
            self.type_of(with, &target.ty, &value.ty)? == target.ty
        };
        if !is_of_type || ["<<", ">>"].contains(&with) {
            return Err(self.error("both sides of an assignment have to be of one type"));
        }
        if matches!(&target.kind, ExprKind::Member(of, name) if of.ty.size() > 1 && name.len() > 1) {
            return Err(self.error("components are assigned to one by one"));
        }
        let name = root(&target).ok_or_else(|| self.error("this cannot be assigned to"))?.to_owned();
        let is_precise = self.variable(&name).is_some_and(|(_, is_precise)| is_precise);
        self.assigned.push(name);
        Ok(StatementKind::Assign { target, operator, value, is_precise })
    }

    fn declaration(&mut self) -> Parsed<Declaration> {
        let is_precise = self.took(PRECISE);
        let is_constant = self.took("const");
        let mut ty = self.type_name()?;
        let name = self.word("a variable's name")?;
        if self.took("[") {
            let (Type::Value(scalar, 1), Ok(length)) = (&ty, self.take().text.parse()) else {
                return Err(self.error("arrays have a number of scalars"));
            };
            ty = Type::Array(*scalar, length);
            self.expect("]")?;
        }
        let value = if self.took("=") { Some(self.declared_value(&ty)?) } else { None };
        if self.is(",") {
            return Err(self.error("each variable needs a declaration of its own"));
        }
        if let Some(scope) = self.scopes.last_mut() {
            scope.insert(name.clone(), (ty.clone(), is_precise));
        }
        Ok(Declaration { is_precise, is_constant, ty, name, value })
    }

    /// The initial value of a variable of this type.
    fn declared_value(&mut self, ty: &Type) -> Parsed<Expr> {
        self.may_be_struct = matches!(ty, Type::Struct(_));
        self.of_type(ty)
    }

    /// An expression that must have this type: the includes do not use GLSL's implicit conversions.
    fn of_type(&mut self, ty: &Type) -> Parsed<Expr> {
        let line = self.peek().line;
        let expr = self.expression()?;
        if expr.ty != *ty {
            return Err(Error::new(self.file, line, "this is of another type, and needs a conversion"));
        }
        Ok(expr)
    }

    fn variable(&self, name: &str) -> Option<(Type, bool)> {
        let local = self.scopes.iter().rev().find_map(|scope| scope.get(name)).cloned();
        local.or_else(|| self.declared.constants.get(name).map(|ty| (ty.clone(), false)))
    }
}
