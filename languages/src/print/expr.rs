//! Expressions.

use super::{BARRIER, Printer, ROUNDED, joined};
use crate::Language;
use crate::parse::precedence;
use crate::syntax::{Expr, ExprKind, Scalar, Type};

/// Levels at which the parts of a text hold together: above those of [`precedence`], which begin at 1 here.
const SELECT: usize = 0;
const UNARY: usize = 20;
const WHOLE: usize = 30;

impl Printer<'_> {
    /// An expression's text.
    pub(super) fn expr(&self, expr: &Expr) -> String {
        self.parts(expr).0
    }

    pub(super) fn list(&self, exprs: &[Expr]) -> String {
        joined(exprs.iter().map(|expr| self.expr(expr)))
    }

    /// An expression's text, in parentheses where it holds together less than `least`.
    fn at_least(&self, expr: &Expr, least: usize) -> String {
        let (text, level) = self.parts(expr);
        if level < least { format!("({text})") } else { text }
    }

    /// An expression's text, and how tightly it holds together.
    fn parts(&self, expr: &Expr) -> (String, usize) {
        if self.needs_barrier(expr) && self.language == Language::Cpp {
            return (format!("{ROUNDED}({})", self.unguarded(expr).0), WHOLE);
        }
        if self.needs_barrier(expr) {
            let barrier = self.spread(BARRIER.to_owned(), &expr.ty);
            return (format!("min({}, {barrier})", self.unguarded(expr).0), WHOLE);
        }
        self.unguarded(expr)
    }

    /// True for sums and products that the exact edition keeps apart from further operations: compilers may otherwise fuse
    /// and reorder. Its quotients and roots are put right, however a device takes them.
    fn needs_barrier(&self, expr: &Expr) -> bool {
        if !(self.has_barriers() && self.in_precise && expr.ty.is_float()) {
            return false;
        }
        match &expr.kind {
            ExprKind::Binary(operator, left, right) if operator == "*" => {
                !is_power_of_two(left) && !is_power_of_two(right)
            }
            ExprKind::Binary(operator, ..) => operator != "/",
            _ => false,
        }
    }

    fn unguarded(&self, expr: &Expr) -> (String, usize) {
        match &expr.kind {
            ExprKind::Number(text) if self.language == Language::Godot && expr.ty.is_float() => {
                in_decimals(text)
            }
            ExprKind::Number(text) => (self.number(text, &expr.ty), WHOLE),
            ExprKind::Bool(value) => (value.to_string(), WHOLE),
            ExprKind::Name(name) if self.pointers.contains(name) => (format!("*{name}"), UNARY),
            ExprKind::Name(name) => (name.clone(), WHOLE),
            ExprKind::Parentheses(inner) => self.parentheses(inner),
            ExprKind::Unary(operator, operand) => {
                (format!("{operator}{}", self.at_least(operand, UNARY)), UNARY)
            }
            ExprKind::Binary(operator, left, right) => self.binary(operator, left, right),
            ExprKind::Select(condition, then, otherwise) => self.select(condition, then, otherwise),
            ExprKind::Call(name, arguments) => (self.call(name, arguments), WHOLE),
            ExprKind::BuiltIn(name, arguments) => (self.built_in(name, arguments, &expr.ty), WHOLE),
            ExprKind::Macro(name, arguments) => (format!("{name}({})", self.list(arguments)), WHOLE),
            ExprKind::Construct(arguments) => self.construct(&expr.ty, arguments),
            ExprKind::Member(of, name) if self.language == Language::Cpp && is_swizzle(of, name) => {
                (format!("{}.{name}()", self.at_least(of, WHOLE)), WHOLE)
            }
            ExprKind::Member(of, name) => (format!("{}.{name}", self.at_least(of, WHOLE)), WHOLE),
            ExprKind::Index(of, index) => {
                (format!("{}[{}]", self.at_least(of, WHOLE), self.expr(index)), WHOLE)
            }
        }
    }

    pub(super) fn number(&self, text: &str, ty: &Type) -> String {
        let is_float = *ty == Type::FLOAT;
        if is_float && matches!(self.language, Language::Msl | Language::Cpp) {
            format!("{text}f")
        } else {
            text.to_owned()
        }
    }

    /// The source's parentheses, unless their content has become a single term.
    fn parentheses(&self, inner: &Expr) -> (String, usize) {
        let (text, level) = self.parts(inner);
        let was_whole = matches!(inner.kind, ExprKind::Name(_) | ExprKind::Number(_));
        if level == WHOLE && !was_whole { (text, WHOLE) } else { (format!("({text})"), WHOLE) }
    }

    fn binary(&self, operator: &str, left: &Expr, right: &Expr) -> (String, usize) {
        let level = precedence(operator).unwrap_or_default() + 1;
        let is_shift = ["<<", ">>"].contains(&operator);
        let (least_left, least_right) = self.least_levels(operator, left, level);
        let mut a = self.at_least(left, least_left);
        let mut b = self.at_least(right, least_right);
        if self.language == Language::Wgsl {
            if is_shift {
                b = self.shift_amount(right, least_right);
            }
            let is_bitwise = is_shift || ["&", "|", "^"].contains(&operator);
            let (size_a, size_b) = (left.ty.size(), right.ty.size());
            if is_bitwise && size_b < size_a {
                let scalar = if is_shift { Scalar::Uint } else { scalar_of(&left.ty) };
                b = self.spread(b, &Type::Value(scalar, size_a));
            } else if is_bitwise && size_a < size_b {
                a = self.spread(a, &right.ty);
            }
        }
        // Godot shifts by numbers of the same kind.
        if self.language == Language::Godot && is_shift && scalar_of(&left.ty) != scalar_of(&right.ty) {
            let ty = Type::Value(scalar_of(&left.ty), right.ty.size());
            b = format!("{}({})", self.type_name(&ty), self.expr(bare(right)));
        }
        let text = format!("{a} {operator} {b}");
        let is_vector_equality = ["==", "!="].contains(&operator) && left.ty.size() > 1;
        if is_vector_equality && !self.language.is_glsl() && self.language != Language::Cpp {
            let all = if operator == "==" { "all" } else { "any" };
            return (format!("{all}({text})"), WHOLE);
        }
        (text, level)
    }

    /// The level at which the operands of an operator must hold together. WGSL wants parentheses wherever its operators
    /// of different kinds meet.
    fn least_levels(&self, operator: &str, left: &Expr, level: usize) -> (usize, usize) {
        if self.language != Language::Wgsl {
            return (level, level + 1);
        }
        let is_same = matches!(&left.kind, ExprKind::Binary(other, ..) if other == operator);
        match operator {
            "<<" | ">>" => (UNARY, UNARY),
            "&" | "|" | "^" => (if is_same { level } else { UNARY }, UNARY),
            // Above the levels of both.
            "&&" | "||" => (if is_same { level } else { 3 }, 3),
            _ => (level, level + 1),
        }
    }

    /// WGSL shifts by unsigned numbers alone.
    fn shift_amount(&self, amount: &Expr, least: usize) -> String {
        match &amount.kind {
            _ if scalar_of(&amount.ty) == Scalar::Uint => self.at_least(amount, least),
            ExprKind::Number(text) => format!("{text}u"),
            ExprKind::Construct(inner) if inner[0].ty == Type::UINT => {
                let text = self.at_least(&inner[0], least);
                if text.starts_with('(') { text } else { format!("({text})") }
            }
            _ => format!("u32({})", self.expr(amount)),
        }
    }

    /// A scalar's text as an operand of a vector's operation.
    fn spread(&self, scalar: String, ty: &Type) -> String {
        let takes_scalars = self.language.is_glsl() || self.language == Language::Hlsl;
        if ty.size() == 1 || (takes_scalars && scalar == BARRIER) {
            return scalar;
        }
        match self.language {
            Language::Slang => format!("({})({scalar})", self.type_name(ty)),
            _ => format!("{}({scalar})", self.type_name(ty)),
        }
    }

    fn select(&self, condition: &Expr, then: &Expr, otherwise: &Expr) -> (String, usize) {
        if self.language == Language::Wgsl {
            let [then, otherwise, condition] = [then, otherwise, condition].map(|part| self.expr(bare(part)));
            return (format!("select({otherwise}, {then}, {condition})"), WHOLE);
        }
        let condition = self.at_least(condition, SELECT + 1);
        (format!("{condition} ? {} : {}", self.expr(then), self.expr(otherwise)), SELECT)
    }

    fn call(&self, name: &str, arguments: &[Expr]) -> String {
        let parameters = self.declared.functions.get(name).map_or(&[][..], |(_, parameters)| parameters);
        let is_out = |index: usize| {
            self.language == Language::Wgsl && parameters.get(index).is_some_and(|parameter| parameter.is_out)
        };
        let arguments = arguments.iter().enumerate().map(|(index, argument)| match &argument.kind {
            ExprKind::Name(name) if is_out(index) && self.pointers.contains(name) => name.clone(),
            _ if is_out(index) => format!("&{}", self.expr(argument)),
            _ => self.expr(argument),
        });
        format!("{name}({})", joined(arguments))
    }

    fn built_in(&self, name: &str, arguments: &[Expr], ty: &Type) -> String {
        match (name, self.language) {
            (_, Language::Cpp) => format!("{name}({})", self.list(arguments)),
            ("floatBitsToUint" | "uintBitsToFloat", language) if !language.is_glsl() => {
                format!("{}({})", self.bit_cast(name, ty), self.expr(&arguments[0]))
            }
            ("inversesqrt", Language::Wgsl) => format!("inverseSqrt({})", self.list(arguments)),
            ("inversesqrt", language) if !language.is_glsl() => format!("rsqrt({})", self.list(arguments)),
            // Scalars beside vectors.
            (_, Language::Wgsl | Language::Msl | Language::Slang) => {
                let spread = arguments.iter().map(|argument| match argument.ty.size() < ty.size() {
                    true => self.spread(self.expr(argument), ty),
                    false => self.expr(argument),
                });
                format!("{name}({})", joined(spread))
            }
            _ => format!("{name}({})", self.list(arguments)),
        }
    }

    /// The function that takes bits for a value of another type.
    fn bit_cast(&self, name: &str, ty: &Type) -> String {
        match self.language {
            Language::Wgsl => format!("bitcast<{}>", self.type_name(ty)),
            Language::Msl => format!("as_type<{}>", self.type_name(ty)),
            _ if name == "floatBitsToUint" => "asuint".to_owned(),
            _ => "asfloat".to_owned(),
        }
    }

    fn construct(&self, ty: &Type, arguments: &[Expr]) -> (String, usize) {
        let name = self.type_name(ty);
        let spreads = arguments.len() == 1 && arguments[0].ty.size() < ty.size();
        if spreads && matches!(self.language, Language::Hlsl | Language::Slang) {
            return match &arguments[0].kind {
                ExprKind::Number(text) => {
                    let components = vec![self.number(text, &arguments[0].ty); ty.size()];
                    (format!("{name}({})", components.join(", ")), WHOLE)
                }
                _ => (format!("({name})({})", self.expr(&arguments[0])), UNARY),
            };
        }
        if self.language == Language::Cpp && matches!(ty, Type::Struct(_)) {
            return (format!("{name}{{{}}}", self.list(arguments)), WHOLE);
        }
        (format!("{name}({})", self.list(arguments)), WHOLE)
    }
}

/// A number for Godot, which hands numbers to drivers with 14 decimals: a number that these do not hold is written as a
/// fraction of a power of two.
fn in_decimals(text: &str) -> (String, usize) {
    let value: f32 = text.parse().unwrap_or_default();
    if format!("{value:.14}").parse() == Ok(value) {
        return (text.to_owned(), WHOLE);
    }
    let exponent = (value.to_bits() >> 23) as i32 - 127;
    let divisor = 2f64.powi(-exponent);
    let level = precedence("/").unwrap_or_default() + 1;
    (format!("{:?} / {divisor:?}", (f64::from(value) * divisor) as f32), level)
}

/// An expression without the parentheses around it.
fn bare(expr: &Expr) -> &Expr {
    match &expr.kind {
        ExprKind::Parentheses(inner) => bare(inner),
        _ => expr,
    }
}

fn scalar_of(ty: &Type) -> Scalar {
    match ty {
        Type::Value(scalar, _) | Type::Array(scalar, _) => *scalar,
        _ => Scalar::Bool,
    }
}

/// True for a member that is several components of a vector.
fn is_swizzle(of: &Expr, name: &str) -> bool {
    matches!(of.ty, Type::Value(..)) && name.len() > 1
}

/// True for a number by which products are exact.
fn is_power_of_two(expr: &Expr) -> bool {
    let ExprKind::Number(text) = &bare(expr).kind else { return false };
    text.parse::<f32>().is_ok_and(|value| value.to_bits() & 0x007f_ffff == 0)
}
