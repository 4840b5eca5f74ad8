//! Expressions, each with its type.

use super::{Parsed, Parser};
use crate::lex::{Kind, Token};
use crate::syntax::{Expr, ExprKind, Parameter, Scalar, Type};

/// The function that only newer versions of GLSL have.
const BITFIELD_EXTRACT: &str = "bitfieldExtract";

/// GLSL's functions that the includes use, and how many arguments each takes.
const BUILT_IN: [(&str, usize); 10] = [
    ("abs", 1),
    ("floor", 1),
    ("sqrt", 1),
    ("inversesqrt", 1),
    ("max", 2),
    ("min", 2),
    ("clamp", 3),
    ("floatBitsToUint", 1),
    ("uintBitsToFloat", 1),
    (BITFIELD_EXTRACT, 3),
];

impl Parser<'_> {
    pub(super) fn expression(&mut self) -> Parsed<Expr> {
        let condition = self.binary(0)?;
        if !self.took("?") {
            return Ok(condition);
        }
        let then = self.expression()?;
        self.expect(":")?;
        let otherwise = self.expression()?;
        if condition.ty != Type::BOOL || then.ty != otherwise.ty {
            return Err(self.error("`?:` takes a bool and two of one type"));
        }
        let ty = then.ty.clone();
        Ok(Expr { kind: ExprKind::Select(Box::new(condition), Box::new(then), Box::new(otherwise)), ty })
    }

    fn binary(&mut self, least: usize) -> Parsed<Expr> {
        let mut left = self.unary()?;
        while let Some(level) = precedence(self.peek().text).filter(|level| *level >= least) {
            if self.peek().kind != Kind::Sign {
                break;
            }
            let operator = self.take().text.to_owned();
            let right = self.binary(level + 1)?;
            let ty = self.type_of(&operator, &left.ty, &right.ty)?;
            left = Expr { kind: ExprKind::Binary(operator, Box::new(left), Box::new(right)), ty };
        }
        Ok(left)
    }

    /// The type of `left operator right`.
    pub(super) fn type_of(&self, operator: &str, left: &Type, right: &Type) -> Parsed<Type> {
        let (Type::Value(a, m), Type::Value(b, n)) = (left, right) else {
            return Err(self.error(&format!("`{operator}` takes scalars and vectors")));
        };
        let is_shift = ["<<", ">>"].contains(&operator);
        let fits = match operator {
            "&&" | "||" => (a, b, m, n) == (&Scalar::Bool, &Scalar::Bool, &1, &1),
            "<" | ">" | "<=" | ">=" => a == b && (m, n) == (&1, &1),
            "==" | "!=" => left == right,
            "<<" | ">>" => *b != Scalar::Float && (m == n || *n == 1),
            _ => a == b && (m == n || *m == 1 || *n == 1),
        };
        if !fits {
            return Err(self.error(&format!("`{operator}` needs operands of one type")));
        }
        let is_comparison = ["&&", "||", "<", ">", "<=", ">=", "==", "!="].contains(&operator);
        Ok(match (is_comparison, is_shift) {
            (true, _) => Type::BOOL,
            (_, true) => left.clone(),
            _ => Type::Value(*a, *m.max(n)),
        })
    }

    fn unary(&mut self) -> Parsed<Expr> {
        if !["-", "!", "~"].contains(&self.peek().text) {
            return self.postfix();
        }
        let operator = self.take().text.to_owned();
        let operand = self.postfix()?;
        let fits = match (operator.as_str(), &operand.ty) {
            ("-", Type::Value(scalar, _)) => [Scalar::Float, Scalar::Int].contains(scalar),
            ("~", Type::Value(scalar, _)) => [Scalar::Uint, Scalar::Int].contains(scalar),
            (_, ty) => *ty == Type::BOOL,
        };
        if !fits {
            return Err(self.error(&format!("`{operator}` does not take this type")));
        }
        let ty = operand.ty.clone();
        Ok(Expr { kind: ExprKind::Unary(operator, Box::new(operand)), ty })
    }

    pub(super) fn postfix(&mut self) -> Parsed<Expr> {
        let mut expr = self.primary()?;
        loop {
            if self.took(".") {
                let name = self.word("a component")?;
                let ty = self.member(&expr.ty, &name)?;
                expr = Expr { kind: ExprKind::Member(Box::new(expr), name), ty };
            } else if self.took("[") {
                let index = self.of_type(&Type::INT)?;
                self.expect("]")?;
                let (Type::Array(scalar, _) | Type::Value(scalar, 2..)) = expr.ty else {
                    return Err(self.error("only arrays and vectors have elements"));
                };
                expr = Expr {
                    kind: ExprKind::Index(Box::new(expr), Box::new(index)),
                    ty: Type::Value(scalar, 1),
                };
            } else {
                return Ok(expr);
            }
        }
    }

    fn member(&self, ty: &Type, name: &str) -> Parsed<Type> {
        let found = match ty {
            Type::Struct(declared) => self.declared.structs.get(declared).and_then(|declared| {
                declared.fields.iter().find(|(_, field)| field == name).map(|(ty, _)| ty.clone())
            }),
            Type::Value(scalar, 2..) if name.len() <= 4 && name.chars().all(|c| "xyzw".contains(c)) => {
                Some(Type::Value(*scalar, name.len()))
            }
            _ => None,
        };
        found.ok_or_else(|| self.error(&format!("there is no `{name}` in this")))
    }

    fn primary(&mut self) -> Parsed<Expr> {
        let Token { kind, text, .. } = self.take();
        match kind {
            Kind::Number => {
                number(text).ok_or_else(|| self.error(&format!("`{text}` is no number of the includes")))
            }
            Kind::Sign if text == "(" => {
                let inner = self.expression()?;
                self.expect(")")?;
                let ty = inner.ty.clone();
                Ok(Expr { kind: ExprKind::Parentheses(Box::new(inner)), ty })
            }
            Kind::Word if ["true", "false"].contains(&text) => {
                Ok(Expr { kind: ExprKind::Bool(text == "true"), ty: Type::BOOL })
            }
            Kind::Word if self.is("(") => self.call(text),
            Kind::Word => match self.variable(text) {
                Some((ty, _)) => Ok(Expr { kind: ExprKind::Name(text.to_owned()), ty }),
                None => Err(self.error(&format!("`{text}` is not declared"))),
            },
            _ => {
                self.next = self.next.saturating_sub(1);
                Err(self.wanted("an expression"))
            }
        }
    }

    fn call(&mut self, name: &str) -> Parsed<Expr> {
        let may_be_struct = std::mem::take(&mut self.may_be_struct);
        let arguments = self.listed(Self::expression)?;
        if let Some((returns, parameters)) = self.declared.functions.get(name).cloned() {
            self.check(name, &parameters, &arguments)?;
            return Ok(Expr { kind: ExprKind::Call(name.to_owned(), arguments), ty: returns });
        }
        if let Some(declared) = self.declared.structs.get(name) {
            if !may_be_struct {
                return Err(self.error("a struct is made only where a variable is declared"));
            }
            let fields = declared.fields.iter().map(|(ty, _)| ty);
            if !fields.eq(arguments.iter().map(|argument| &argument.ty)) {
                return Err(self.error(&format!("`{name}` has fields of other types")));
            }
            return Ok(Expr { kind: ExprKind::Construct(arguments), ty: Type::Struct(name.to_owned()) });
        }
        if let Some(ty) = Type::named(name) {
            return self.constructed(name, ty, arguments);
        }
        if let Some((_, count)) = BUILT_IN.iter().find(|(built_in, _)| *built_in == name) {
            if arguments.len() != *count || (name == BITFIELD_EXTRACT && !self.in_version) {
                return Err(self.error(&format!("`{name}` cannot be called so here")));
            }
            let ty = built_in_type(name, &arguments)
                .ok_or_else(|| self.error(&format!("`{name}` does not take these types")))?;
            return Ok(Expr { kind: ExprKind::BuiltIn(name.to_owned(), arguments), ty });
        }
        if name == "UNITVEC_BEST_FIT_TABLE" {
            return Ok(Expr { kind: ExprKind::Macro(name.to_owned(), arguments), ty: Type::UINT });
        }
        Err(self.error(&format!("`{name}` is not among the functions that the includes use")))
    }

    fn check(&mut self, name: &str, parameters: &[Parameter], arguments: &[Expr]) -> Parsed<()> {
        let types = parameters.iter().map(|parameter| &parameter.ty);
        if !types.eq(arguments.iter().map(|argument| &argument.ty)) {
            return Err(self.error(&format!("`{name}` takes other types")));
        }
        for (_, argument) in parameters.iter().zip(arguments).filter(|(parameter, _)| parameter.is_out) {
            let ExprKind::Name(variable) = &argument.kind else {
                return Err(self.error(&format!("`{name}` needs a variable here")));
            };
            self.assigned.push(variable.clone());
        }
        Ok(())
    }

    fn constructed(&self, name: &str, ty: Type, arguments: Vec<Expr>) -> Parsed<Expr> {
        let Type::Value(scalar, size) = ty else {
            return Err(self.error(&format!("`{name}` cannot be made")));
        };
        let components: usize = arguments.iter().map(|argument| argument.ty.size()).sum();
        let is_conversion = arguments.len() == 1 && (components == 1 || components == size);
        let of_one_type =
            arguments.iter().all(|argument| matches!(argument.ty, Type::Value(other, _) if other == scalar));
        if !(is_conversion || (of_one_type && components == size)) {
            return Err(
                self.error(&format!("`{name}` takes {size} components of its own type, or one to convert"))
            );
        }
        Ok(Expr { kind: ExprKind::Construct(arguments), ty: Type::Value(scalar, size) })
    }
}

/// The type that a function of GLSL returns, where its arguments fit.
fn built_in_type(name: &str, arguments: &[Expr]) -> Option<Type> {
    let first = &arguments.first()?.ty;
    let Type::Value(scalar, size) = first else { return None };
    let fits =
        arguments.iter().all(|argument| argument.ty == *first || argument.ty == Type::Value(*scalar, 1));
    match name {
        "floatBitsToUint" => Some(Type::Value(Scalar::Uint, *size)),
        "uintBitsToFloat" => Some(Type::Value(Scalar::Float, *size)),
        _ => fits.then(|| first.clone()),
    }
}

/// A number as the includes write them: `12`, `12u`, `0x1fu`, `1.5`, `1.5e-3`, `1e38`.
fn number(text: &str) -> Option<Expr> {
    let all = |text: &str, is_digit: fn(char) -> bool| !text.is_empty() && text.chars().all(is_digit);
    let is_decimal =
        |text: &str| all(text, |c| c.is_ascii_digit()) && (text == "0" || !text.starts_with('0'));
    let whole = text.strip_suffix('u').unwrap_or(text);
    let is_hexadecimal = whole
        .strip_prefix("0x")
        .is_some_and(|digits| all(digits, |c| c.is_ascii_digit() || ('a'..='f').contains(&c)));
    let ty = if is_hexadecimal || is_decimal(whole) {
        if text.ends_with('u') { Type::UINT } else { Type::INT }
    } else {
        let (significand, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let (before, after) = significand.split_once('.').unwrap_or((significand, "0"));
        let exponent = exponent.strip_prefix('-').unwrap_or(exponent);
        let is_float = is_decimal(before) && all(after, |c| c.is_ascii_digit()) && is_decimal(exponent);
        is_float.then_some(Type::FLOAT)?
    };
    Some(Expr { kind: ExprKind::Number(text.to_owned()), ty })
}

/// The level at which an operator of two operands binds, as in C.
pub fn precedence(operator: &str) -> Option<usize> {
    let levels: [&[&str]; 9] = [
        &["||"],
        &["&&"],
        &["|"],
        &["^"],
        &["&"],
        &["==", "!="],
        &["<", ">", "<=", ">="],
        &["<<", ">>"],
        &["+", "-"],
    ];
    let found = levels.iter().position(|level| level.contains(&operator));
    found.or_else(|| ["*", "/", "%"].contains(&operator).then_some(levels.len()))
}

/// The variable that an expression is, or is a part of.
pub fn root(expr: &Expr) -> Option<&str> {
    match &expr.kind {
        ExprKind::Name(name) => Some(name),
        ExprKind::Member(of, _) | ExprKind::Index(of, _) => root(of),
        _ => None,
    }
}
