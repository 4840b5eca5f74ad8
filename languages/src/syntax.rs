//! The tree of a file: the part of GLSL that the includes use, each expression with its type.

use std::cmp::Reverse;

/// Lines of comment before something, whole; an empty one for blank lines.
pub type Lead = Vec<String>;

/// The type of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    Float,
    Uint,
    Int,
    Bool,
}

/// The type of an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    Void,
    /// A scalar (1) or a vector (2 to 4).
    Value(Scalar, usize),
    Struct(String),
    /// An array of scalars, with its length.
    Array(Scalar, usize),
}

impl Type {
    pub const FLOAT: Self = Self::Value(Scalar::Float, 1);
    pub const UINT: Self = Self::Value(Scalar::Uint, 1);
    pub const INT: Self = Self::Value(Scalar::Int, 1);
    pub const BOOL: Self = Self::Value(Scalar::Bool, 1);

    /// The type that a word of GLSL names.
    pub fn named(word: &str) -> Option<Self> {
        Some(match word {
            "void" => Self::Void,
            "float" => Self::FLOAT,
            "uint" => Self::UINT,
            "int" => Self::INT,
            "bool" => Self::BOOL,
            _ => {
                let (scalar, size) = word.split_once("vec")?;
                let scalar = match scalar {
                    "" => Scalar::Float,
                    "u" => Scalar::Uint,
                    "i" => Scalar::Int,
                    "b" => Scalar::Bool,
                    _ => return None,
                };
                Self::Value(scalar, ["2", "3", "4"].iter().position(|other| *other == size)? + 2)
            }
        })
    }

    /// True for a float or a vector of them.
    pub fn is_float(&self) -> bool {
        matches!(self, Self::Value(Scalar::Float, _))
    }

    /// Number of components: 1 for types that are no vectors.
    pub fn size(&self) -> usize {
        match self {
            Self::Value(_, size) => *size,
            _ => 1,
        }
    }
}

/// A file.
#[derive(Clone, Debug)]
pub struct File {
    pub name: String,
    /// The comment that it begins with.
    pub head: Lead,
    pub items: Vec<Item>,
    /// The comment before its last line.
    pub tail: Lead,
}

/// A declaration of a file, with the comment before it.
#[derive(Clone, Debug)]
pub struct Item {
    pub lead: Lead,
    pub kind: ItemKind,
}

#[derive(Clone, Debug)]
pub enum ItemKind {
    /// An `#include` in its guard; without one in the file of all families.
    Include {
        file: String,
        is_guarded: bool,
    },
    /// The definition of `UNITVEC_PRECISE`, in GLSL's words.
    Precise(Vec<String>),
    /// The default precisions, in GLSL's words.
    Precision(String),
    Constant(Constant),
    Struct(Struct),
    Function(Function),
}

impl ItemKind {
    /// The name that it declares.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Constant(constant) => Some(&constant.name),
            Self::Struct(declared) => Some(&declared.name),
            Self::Function(function) => Some(&function.name),
            Self::Include { .. } | Self::Precise(_) | Self::Precision(_) => None,
        }
    }
}

#[derive(Clone, Debug)]
pub struct Constant {
    pub ty: Type,
    pub name: String,
    pub value: Expr,
}

#[derive(Clone, Debug)]
pub struct Struct {
    pub name: String,
    pub fields: Vec<(Type, String)>,
}

#[derive(Clone, Debug)]
pub struct Parameter {
    pub ty: Type,
    pub name: String,
    pub is_out: bool,
}

#[derive(Clone, Debug)]
pub struct Function {
    pub returns: Type,
    pub name: String,
    pub parameters: Vec<Parameter>,
    pub body: Block,
    /// Names that the body assigns to, or hands to an `out` parameter.
    pub assigned: Vec<String>,
}

/// Statements in braces.
#[derive(Clone, Debug)]
pub struct Block {
    pub statements: Vec<Statement>,
    /// True where the file has them in one line with the statement that the braces belong to.
    pub is_one_line: bool,
    /// False for a lone statement without braces.
    pub has_braces: bool,
}

#[derive(Clone, Debug)]
pub struct Statement {
    pub lead: Lead,
    pub kind: StatementKind,
}

#[derive(Clone, Debug)]
pub enum StatementKind {
    Declare(Declaration),
    /// `target operator value`. Precise where the target was declared so.
    Assign {
        target: Expr,
        operator: String,
        value: Expr,
        is_precise: bool,
    },
    Call(Expr),
    Return(Expr),
    If {
        condition: Expr,
        then: Block,
    },
    For {
        start: Box<Statement>,
        condition: Expr,
        step: Box<Statement>,
        body: Block,
    },
    While {
        condition: Expr,
        body: Block,
    },
    /// `#if … #else … #endif`.
    Alternative {
        condition: Condition,
        then: Vec<Statement>,
        otherwise: Vec<Statement>,
    },
}

/// The condition of an alternative, with its line in GLSL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Condition {
    /// A version of GLSL that has a function.
    Version(String),
    /// The exact edition.
    Exact(String),
    /// A macro of the user's.
    Macro(String),
}

/// The part of an alternative that belongs to a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    Both,
    Then,
    Otherwise,
}

/// A variable, or a constant of a function.
#[derive(Clone, Debug)]
pub struct Declaration {
    pub is_precise: bool,
    pub is_constant: bool,
    pub ty: Type,
    pub name: String,
    pub value: Option<Expr>,
}

#[derive(Clone, Debug)]
pub struct Expr {
    pub kind: ExprKind,
    pub ty: Type,
}

#[derive(Clone, Debug)]
pub enum ExprKind {
    Number(String),
    Bool(bool),
    Name(String),
    Parentheses(Box<Expr>),
    Unary(String, Box<Expr>),
    Binary(String, Box<Expr>, Box<Expr>),
    Select(Box<Expr>, Box<Expr>, Box<Expr>),
    /// A function of the library.
    Call(String, Vec<Expr>),
    /// A function of GLSL.
    BuiltIn(String, Vec<Expr>),
    /// A macro that the user defines.
    Macro(String, Vec<Expr>),
    /// A constructor of the expression's type.
    Construct(Vec<Expr>),
    Member(Box<Expr>, String),
    Index(Box<Expr>, Box<Expr>),
}

impl ItemKind {
    /// The names in its declaration: functions, constants and structs of the library, and others. `branch` chooses the
    /// part of an alternative that counts.
    pub fn names_used(&self, branch: &dyn Fn(&Condition) -> Branch) -> Vec<&str> {
        let mut names = Vec::new();
        match self {
            Self::Constant(constant) => {
                constant.ty.add_name(&mut names);
                constant.value.add_names(&mut names);
            }
            Self::Struct(declared) => declared.fields.iter().for_each(|(ty, _)| ty.add_name(&mut names)),
            Self::Function(function) => return function.names_used(branch),
            Self::Include { .. } | Self::Precise(_) | Self::Precision(_) => {}
        }
        names
    }

    /// The names that it declares, those of its parameters, fields and variables included.
    pub fn names_given(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.name().into_iter().collect();
        match self {
            Self::Struct(declared) => names.extend(declared.fields.iter().map(|(_, field)| field.as_str())),
            Self::Function(function) => {
                names.extend(function.parameters.iter().map(|parameter| parameter.name.as_str()));
                add_variables(&function.body.statements, &mut names);
            }
            _ => {}
        }
        names
    }
}

impl Function {
    /// [`ItemKind::names_used`].
    pub fn names_used(&self, branch: &dyn Fn(&Condition) -> Branch) -> Vec<&str> {
        let mut names = Vec::new();
        self.returns.add_name(&mut names);
        self.parameters.iter().for_each(|parameter| parameter.ty.add_name(&mut names));
        add_names(&self.body.statements, branch, &mut names);
        names
    }
}

impl Type {
    fn add_name<'a>(&'a self, names: &mut Vec<&'a str>) {
        if let Self::Struct(name) = self {
            names.push(name);
        }
    }
}

impl Expr {
    fn add_names<'a>(&'a self, names: &mut Vec<&'a str>) {
        self.ty.add_name(names);
        if let ExprKind::Name(name) | ExprKind::Call(name, _) = &self.kind {
            names.push(name);
        }
        self.parts().for_each(|part| part.add_names(names));
    }

    /// The expressions in it.
    fn parts(&self) -> impl Iterator<Item = &Self> {
        let (boxed, listed): ([Option<&Self>; 3], &[Self]) = match &self.kind {
            ExprKind::Number(_) | ExprKind::Bool(_) | ExprKind::Name(_) => ([None; 3], &[]),
            ExprKind::Parentheses(a) | ExprKind::Unary(_, a) | ExprKind::Member(a, _) => {
                ([Some(a), None, None], &[])
            }
            ExprKind::Binary(_, a, b) | ExprKind::Index(a, b) => ([Some(a), Some(b), None], &[]),
            ExprKind::Select(a, b, c) => ([Some(a), Some(b), Some(c)], &[]),
            ExprKind::Call(_, listed)
            | ExprKind::BuiltIn(_, listed)
            | ExprKind::Macro(_, listed)
            | ExprKind::Construct(listed) => ([None; 3], listed),
        };
        boxed.into_iter().flatten().chain(listed)
    }
}

/// The statements of a function, those inside others too, each before those inside it.
fn each<'a>(
    statements: &'a [Statement],
    branch: &dyn Fn(&Condition) -> Branch,
    visit: &mut impl FnMut(&'a StatementKind),
) {
    for Statement { kind, .. } in statements {
        visit(kind);
        match kind {
            StatementKind::If { then: body, .. } | StatementKind::While { body, .. } => {
                each(&body.statements, branch, visit);
            }
            StatementKind::For { start, step, body, .. } => {
                visit(&start.kind);
                visit(&step.kind);
                each(&body.statements, branch, visit);
            }
            StatementKind::Alternative { condition, then, otherwise } => {
                let branch_here = branch(condition);
                if branch_here != Branch::Otherwise {
                    each(then, branch, visit);
                }
                if branch_here != Branch::Then {
                    each(otherwise, branch, visit);
                }
            }
            _ => {}
        }
    }
}

fn add_names<'a>(
    statements: &'a [Statement],
    branch: &dyn Fn(&Condition) -> Branch,
    names: &mut Vec<&'a str>,
) {
    each(statements, branch, &mut |kind| match kind {
        StatementKind::Declare(Declaration { ty, value, .. }) => {
            ty.add_name(names);
            value.iter().for_each(|value| value.add_names(names));
        }
        StatementKind::Assign { target, value, .. } => {
            target.add_names(names);
            value.add_names(names);
        }
        StatementKind::Call(expr) | StatementKind::Return(expr) => expr.add_names(names),
        StatementKind::If { condition, .. }
        | StatementKind::For { condition, .. }
        | StatementKind::While { condition, .. } => condition.add_names(names),
        StatementKind::Alternative { .. } => {}
    });
}

fn add_variables<'a>(statements: &'a [Statement], names: &mut Vec<&'a str>) {
    each(statements, &|_| Branch::Both, &mut |kind| {
        if let StatementKind::Declare(declaration) = kind {
            names.push(&declaration.name);
        }
    });
}

/// The number of users of a part, and which they are. Parts that more users need come first, since others may need them.
pub type Users = Reverse<(usize, Vec<bool>)>;

/// Declarations that the same users need: families, or functions.
pub struct Part<'a> {
    pub users: Users,
    pub items: Vec<(&'a File, &'a Item)>,
}

impl Part<'_> {
    /// True where this user needs it.
    pub fn is_for(&self, user: usize) -> bool {
        self.users.0.1.get(user) == Some(&true)
    }

    /// The macro with this prefix that keeps it from being declared twice.
    pub fn guard(&self, prefix: &str) -> Option<String> {
        let name = self.items.first()?.1.kind.name()?.to_uppercase();
        Some(format!("{prefix}{}", name.trim_start_matches("UNITVEC_")))
    }
}
