//! The functions by which a rewritten module computes.

use super::globals::{Body, Type};
use crate::imprecise::Model;
use crate::imprecise::model::{FAR_ULP, INVERSE_ROOT_ULP, QUOTIENT_ULP, ROOT_STEPS, ROOT_ULP};
use rspirv::spirv::{GLOp, Op, Word};

/// A function of floats that stands in for an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// `a / b`
    Divide,
    /// The square root.
    SquareRoot,
    /// 1 over the square root.
    InverseRoot,
    /// `a + b`
    Add,
    /// `a - b`
    Subtract,
    /// `a * b`
    Multiply,
    /// A signed integer as float.
    ConvertSigned,
    /// An unsigned integer as float.
    ConvertUnsigned,
    /// Zero for a denormal, else the operand.
    Flush,
}

impl Function {
    /// The types of its operands.
    pub fn parameters(self) -> &'static [Type] {
        match self {
            Self::Divide | Self::Add | Self::Subtract | Self::Multiply => &[Type::Float, Type::Float],
            Self::SquareRoot | Self::InverseRoot | Self::Flush => &[Type::Float],
            Self::ConvertSigned => &[Type::Int],
            Self::ConvertUnsigned => &[Type::Uint],
        }
    }

    /// True where the model has a function in the operation's place, flushing apart.
    pub fn is_changed_by(self, model: Model) -> bool {
        match self {
            Self::SquareRoot if model == Model::Far => false,
            Self::Divide | Self::SquareRoot | Self::InverseRoot => !model.divides_exactly(),
            Self::Add | Self::Subtract | Self::Multiply | Self::ConvertSigned | Self::ConvertUnsigned => {
                !model.rounds_to_nearest()
            }
            Self::Flush => model == Model::Flush,
        }
    }
}

/// Appends the instructions of a function to its body; the result is what it returns.
pub fn build(function: Function, model: Model, seed: u32, parameters: &[Word], body: &Body<'_>) -> Word {
    match (function, parameters) {
        (Function::Divide, &[a, b]) => quotient(body, model, seed, [a, b], QUOTIENT_ULP),
        (Function::InverseRoot, &[x]) => {
            let root = body.extended(Type::Float, GLOp::Sqrt, &[x]);
            quotient(body, model, seed, [body.float_constant(1.0), root], INVERSE_ROOT_ULP)
        }
        (Function::SquareRoot, &[x]) => square_root(body, model, seed, x),
        (Function::Add, &[a, b]) => truncated_sum(body, a, b),
        (Function::Subtract, &[a, b]) => truncated_sum(body, a, body.float(Op::FNegate, &[b])),
        (Function::Multiply, &[a, b]) => truncated_product(body, a, b),
        (Function::ConvertSigned, &[x]) => truncated_signed(body, x),
        (Function::ConvertUnsigned, &[x]) => truncated_unsigned(body, x),
        (_, parameters) => flushed(body, parameters[0]),
    }
}

const SIGN: u32 = 0x8000_0000;
const EXPONENT: u32 = 0x7f80_0000;
const SIGNIFICAND: u32 = 0x007f_ffff;
const ONE: u32 = 0x3f80_0000;

fn quotient(body: &Body<'_>, model: Model, seed: u32, [a, b]: [Word; 2], most: u32) -> Word {
    let is_down = matches!(model, Model::Down | Model::DownUp);
    let operands = [body.bits(a), body.bits(b)];
    let most = if model == Model::Far { FAR_ULP } else { most };
    let ulp = ulp(body, model, is_down, seed, &operands, body.int_constant(most));
    moved(body, body.float(Op::FDiv, &[a, b]), ulp)
}

fn square_root(body: &Body<'_>, model: Model, seed: u32, x: Word) -> Word {
    let rounded = body.extended(Type::Float, GLOp::Sqrt, &[x]);
    let significand = body.uint(Op::BitwiseAnd, &[body.bits(rounded), body.uint_constant(SIGNIFICAND)]);
    let mut most = body.int_constant(ROOT_ULP);
    for step in ROOT_STEPS {
        let step = body.uint_constant(step.to_bits() & SIGNIFICAND);
        let is_reached = body.bool(Op::UGreaterThanEqual, &[significand, step]);
        let more = body.int(Op::Select, &[is_reached, body.int_constant(1), body.int_constant(0)]);
        most = body.int(Op::IAdd, &[most, more]);
    }
    let is_down = matches!(model, Model::Down | Model::UpDown);
    moved(body, rounded, ulp(body, model, is_down, seed, &[body.bits(x)], most))
}

/// The number of ULP, at most `most`, by which the result of an operation on these operands, as bits, is moved.
fn ulp(body: &Body<'_>, model: Model, is_down: bool, seed: u32, operands: &[Word], most: Word) -> Word {
    match model {
        Model::Bits => {
            // The upper half of a hash, scaled to 0..=2 most.
            let sixteen = body.uint_constant(16);
            let half = body.uint(Op::ShiftRightLogical, &[hash(body, seed, operands), sixteen]);
            let choices = body.int(Op::IAdd, &[body.int(Op::IAdd, &[most, most]), body.int_constant(1)]);
            let scaled = body.int(Op::IMul, &[body.int(Op::Bitcast, &[half]), choices]);
            body.int(Op::ISub, &[body.int(Op::ShiftRightArithmetic, &[scaled, sixteen]), most])
        }
        Model::Far => {
            let is_down = body.int(Op::Bitcast, &[hash(body, seed, operands)]);
            let is_down = body.bool(Op::SLessThan, &[is_down, body.int_constant(0)]);
            body.int(Op::Select, &[is_down, body.int(Op::SNegate, &[most]), most])
        }
        _ if is_down => body.int(Op::SNegate, &[most]),
        _ => most,
    }
}

/// A hash of words in the manner of MurmurHash3's finaliser, which spreads every bit over all.
fn hash(body: &Body<'_>, seed: u32, words: &[Word]) -> Word {
    let mut hash = body.uint_constant(seed);
    for word in words {
        hash = body.uint(Op::BitwiseXor, &[hash, *word]);
        for (shift, factor) in [(16, 0x85eb_ca6b), (13, 0xc2b2_ae35), (16, 1)] {
            let shifted = body.uint(Op::ShiftRightLogical, &[hash, body.uint_constant(shift)]);
            hash = body.uint(Op::BitwiseXor, &[hash, shifted]);
            hash = body.uint(Op::IMul, &[hash, body.uint_constant(factor)]);
        }
    }
    hash
}

/// `x` moved away from zero by a number of ULP, or toward it if that is negative. Zero, denormals, infinities and NaN stay as
/// they are. Upward, a number stops at the next power of two: the ULP are those below it.
fn moved(body: &Body<'_>, x: Word, ulp: Word) -> Word {
    let bits = body.bits(x);
    let exponent = |bits| body.uint(Op::BitwiseAnd, &[bits, body.uint_constant(EXPONENT)]);
    let sum = body.uint(Op::IAdd, &[bits, body.uint(Op::Bitcast, &[ulp])]);
    let is_other = body.bool(Op::INotEqual, &[exponent(bits), exponent(sum)]);
    let is_up = body.bool(Op::SGreaterThan, &[ulp, body.int_constant(0)]);
    let is_beyond = body.bool(Op::LogicalAnd, &[is_other, is_up]);
    let last = body.uint(Op::BitwiseOr, &[bits, body.uint_constant(SIGNIFICAND)]);
    let power_of_two = body.uint(Op::IAdd, &[last, body.uint_constant(1)]);
    let moved = body.uint(Op::Select, &[is_beyond, power_of_two, sum]);
    let result = body.uint(Op::Select, &[body.is_normal(bits), moved, bits]);
    body.float(Op::Bitcast, &[result])
}

/// The sum rounded toward zero: the float below the rounded sum where that is too large. Knuth's TwoSum has the exact error.
fn truncated_sum(body: &Body<'_>, a: Word, b: Word) -> Word {
    let sum = body.float(Op::FAdd, &[a, b]);
    let of_b = body.float(Op::FSub, &[sum, a]);
    let of_a = body.float(Op::FSub, &[sum, of_b]);
    let error_b = body.float(Op::FSub, &[b, of_b]);
    let error_a = body.float(Op::FSub, &[a, of_a]);
    let error = body.float(Op::FAdd, &[error_a, error_b]);
    let signs = body.uint(Op::BitwiseXor, &[body.bits(sum), body.bits(error)]);
    let signs = body.uint(Op::BitwiseAnd, &[signs, body.uint_constant(SIGN)]);
    let is_opposite = body.bool(Op::INotEqual, &[signs, body.uint_constant(0)]);
    let is_inexact = body.bool(Op::FOrdNotEqual, &[error, body.float_constant(0.0)]);
    let is_too_large = body.bool(Op::LogicalAnd, &[is_opposite, is_inexact]);
    one_less_if(body, is_too_large, body.bits(sum))
}

/// The product rounded toward zero. Dekker's product of the significands, which cannot overflow, has the exact error. Where
/// a factor or the product is no normal number, the product is rounded to nearest.
fn truncated_product(body: &Body<'_>, a: Word, b: Word) -> Word {
    let bits = body.bits(body.float(Op::FMul, &[a, b]));
    let factors = [a, b].map(|factor| body.bits(factor));
    let both = |a, b| body.bool(Op::LogicalAnd, &[a, b]);
    let are_normal = factors.iter().fold(body.is_normal(bits), |all, bits| both(all, body.is_normal(*bits)));
    let [(a, a_high, a_low), (b, b_high, b_low)] = factors.map(|bits| halves_of_significand(body, bits));
    let rounded = body.float(Op::FMul, &[a, b]);
    let mut error = body.float(Op::FSub, &[body.float(Op::FMul, &[a_high, b_high]), rounded]);
    for (a, b) in [(a_high, b_low), (a_low, b_high), (a_low, b_low)] {
        error = body.float(Op::FAdd, &[error, body.float(Op::FMul, &[a, b])]);
    }
    let is_negative = body.bool(Op::FOrdLessThan, &[error, body.float_constant(0.0)]);
    one_less_if(body, both(are_normal, is_negative), bits)
}

/// The significand of a float, from 1 to 2, and two floats of 12 bits each whose sum it is.
fn halves_of_significand(body: &Body<'_>, bits: Word) -> (Word, Word, Word) {
    let significand = body.uint(Op::BitwiseAnd, &[bits, body.uint_constant(SIGNIFICAND)]);
    let significand = body.uint(Op::BitwiseOr, &[significand, body.uint_constant(ONE)]);
    let high = body.uint(Op::BitwiseAnd, &[significand, body.uint_constant(!0xfff)]);
    let [significand, high] = [significand, high].map(|bits| body.float(Op::Bitcast, &[bits]));
    (significand, high, body.float(Op::FSub, &[significand, high]))
}

/// The float with these bits, or the next toward zero.
fn one_less_if(body: &Body<'_>, condition: Word, bits: Word) -> Word {
    let less = body.uint(Op::Select, &[condition, body.uint_constant(1), body.uint_constant(0)]);
    body.float(Op::Bitcast, &[body.uint(Op::ISub, &[bits, less])])
}

/// An integer as float, rounded toward zero: without the bits below the first 24.
fn truncated_unsigned(body: &Body<'_>, x: Word) -> Word {
    let highest = body.extended(Type::Int, GLOp::FindUMsb, &[x]);
    let (kept, none) = (body.int_constant(23), body.int_constant(0));
    let dropped = body.int(Op::ISub, &[highest, kept]);
    let is_some = body.bool(Op::SGreaterThan, &[dropped, none]);
    let dropped = body.int(Op::Select, &[is_some, dropped, none]);
    let mask = body.uint(Op::ShiftLeftLogical, &[body.uint_constant(u32::MAX), dropped]);
    body.float(Op::ConvertUToF, &[body.uint(Op::BitwiseAnd, &[x, mask])])
}

fn truncated_signed(body: &Body<'_>, x: Word) -> Word {
    let is_negative = body.bool(Op::SLessThan, &[x, body.int_constant(0)]);
    let magnitude = body.int(Op::Select, &[is_negative, body.int(Op::SNegate, &[x]), x]);
    let converted = truncated_unsigned(body, body.uint(Op::Bitcast, &[magnitude]));
    body.float(Op::Select, &[is_negative, body.float(Op::FNegate, &[converted]), converted])
}

fn flushed(body: &Body<'_>, x: Word) -> Word {
    let bits = body.bits(x);
    let exponent = body.uint(Op::BitwiseAnd, &[bits, body.uint_constant(EXPONENT)]);
    let is_small = body.bool(Op::IEqual, &[exponent, body.uint_constant(0)]);
    let zero = body.uint(Op::BitwiseAnd, &[bits, body.uint_constant(SIGN)]);
    body.float(Op::Bitcast, &[body.uint(Op::Select, &[is_small, zero, bits])])
}

impl Body<'_> {
    fn float(&self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Float, opcode, operands)
    }

    fn uint(&self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Uint, opcode, operands)
    }

    fn int(&self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Int, opcode, operands)
    }

    fn bool(&self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Bool, opcode, operands)
    }

    fn bits(&self, x: Word) -> Word {
        self.uint(Op::Bitcast, &[x])
    }

    fn uint_constant(&self, value: u32) -> Word {
        self.constant(Type::Uint, value)
    }

    fn int_constant(&self, value: u32) -> Word {
        self.constant(Type::Int, value)
    }

    fn float_constant(&self, value: f32) -> Word {
        self.constant(Type::Float, value.to_bits())
    }

    fn is_normal(&self, bits: Word) -> Word {
        let exponent = self.uint_constant(EXPONENT);
        let of_bits = self.uint(Op::BitwiseAnd, &[bits, exponent]);
        let is_not_small = self.bool(Op::INotEqual, &[of_bits, self.uint_constant(0)]);
        let is_finite = self.bool(Op::INotEqual, &[of_bits, exponent]);
        self.bool(Op::LogicalAnd, &[is_not_small, is_finite])
    }
}
