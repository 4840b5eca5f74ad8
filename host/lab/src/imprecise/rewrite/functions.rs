//! The functions by which a rewritten module computes.

use super::globals::{Body, Type};
use crate::imprecise::Model;
use crate::imprecise::model::{QUOTIENT_ULP, ROOT_STEPS, ROOT_ULP};
use rspirv::spirv::{GLOp, Op, Word};

/// A function of floats that stands in for an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// `a / b`
    Divide,
    /// The square root.
    SquareRoot,
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
            Self::SquareRoot | Self::Flush => &[Type::Float],
            Self::ConvertSigned => &[Type::Int],
            Self::ConvertUnsigned => &[Type::Uint],
        }
    }

    /// True where the model has a function in the operation's place, flushing apart.
    pub fn is_changed_by(self, model: Model) -> bool {
        match self {
            Self::Divide | Self::SquareRoot => !model.divides_exactly(),
            Self::Add | Self::Subtract | Self::Multiply | Self::ConvertSigned | Self::ConvertUnsigned => {
                !model.rounds_to_nearest()
            }
            Self::Flush => model == Model::Flush,
        }
    }
}

/// Appends the instructions of a function to its body; the result is what it returns.
pub fn build(function: Function, model: Model, seed: u32, parameters: &[Word], body: &mut Body<'_>) -> Word {
    match (function, parameters) {
        (Function::Divide, &[a, b]) => quotient(body, model, seed, a, b),
        (Function::SquareRoot, &[x]) => square_root(body, model, seed, x),
        (Function::Add, &[a, b]) => truncated_sum(body, a, b),
        (Function::Subtract, &[a, b]) => {
            let negated = body.float(Op::FNegate, &[b]);
            truncated_sum(body, a, negated)
        }
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

fn quotient(body: &mut Body<'_>, model: Model, seed: u32, a: Word, b: Word) -> Word {
    let rounded = body.float(Op::FDiv, &[a, b]);
    let most = body.int_constant(QUOTIENT_ULP);
    let (a, b) = (body.bits(a), body.bits(b));
    let is_down = matches!(model, Model::Down | Model::DownUp);
    let ulp = ulp(body, model, is_down, seed, &[a, b], most);
    moved(body, rounded, ulp)
}

fn square_root(body: &mut Body<'_>, model: Model, seed: u32, x: Word) -> Word {
    let rounded = body.extended(Type::Float, GLOp::Sqrt, &[x]);
    let bits = body.bits(rounded);
    let mask = body.uint_constant(SIGNIFICAND);
    let significand = body.uint(Op::BitwiseAnd, &[bits, mask]);
    let (mut most, one, none) = (body.int_constant(ROOT_ULP), body.int_constant(1), body.int_constant(0));
    for step in ROOT_STEPS {
        let step = body.uint_constant(step.to_bits() & SIGNIFICAND);
        let is_reached = body.bool(Op::UGreaterThanEqual, &[significand, step]);
        let more = body.int(Op::Select, &[is_reached, one, none]);
        most = body.int(Op::IAdd, &[most, more]);
    }
    let operand = body.bits(x);
    let is_down = matches!(model, Model::Down | Model::UpDown);
    let ulp = ulp(body, model, is_down, seed, &[operand], most);
    moved(body, rounded, ulp)
}

/// The number of ULP, at most `most`, by which the result of an operation on these operands, as bits, is moved.
fn ulp(body: &mut Body<'_>, model: Model, is_down: bool, seed: u32, operands: &[Word], most: Word) -> Word {
    match model {
        Model::Bits => {
            let hash = hash(body, seed, operands);
            let (one, sixteen) = (body.int_constant(1), body.uint_constant(16));
            // The upper half of the hash, scaled to 0..=2 most.
            let choices = body.int(Op::IAdd, &[most, most]);
            let choices = body.int(Op::IAdd, &[choices, one]);
            let half = body.uint(Op::ShiftRightLogical, &[hash, sixteen]);
            let half = body.int(Op::Bitcast, &[half]);
            let scaled = body.int(Op::IMul, &[half, choices]);
            let choice = body.int(Op::ShiftRightArithmetic, &[scaled, sixteen]);
            body.int(Op::ISub, &[choice, most])
        }
        _ if is_down => body.int(Op::SNegate, &[most]),
        _ => most,
    }
}

/// A hash of words in the manner of MurmurHash3's finaliser, which spreads every bit over all.
fn hash(body: &mut Body<'_>, seed: u32, words: &[Word]) -> Word {
    let mut hash = body.uint_constant(seed);
    for word in words {
        hash = body.uint(Op::BitwiseXor, &[hash, *word]);
        for (shift, factor) in [(16, 0x85eb_ca6b), (13, 0xc2b2_ae35), (16, 1)] {
            let (shift, factor) = (body.uint_constant(shift), body.uint_constant(factor));
            let shifted = body.uint(Op::ShiftRightLogical, &[hash, shift]);
            hash = body.uint(Op::BitwiseXor, &[hash, shifted]);
            hash = body.uint(Op::IMul, &[hash, factor]);
        }
    }
    hash
}

/// `x` moved away from zero by a number of ULP, or toward it if that is negative. Zero, denormals, infinities and NaN stay as
/// they are. Upward, a number stops at the next power of two: the ULP are those below it.
fn moved(body: &mut Body<'_>, x: Word, ulp: Word) -> Word {
    let bits = body.bits(x);
    let (exponent, significand) = (body.uint_constant(EXPONENT), body.uint_constant(SIGNIFICAND));
    let (zero, one) = (body.int_constant(0), body.uint_constant(1));
    let of_bits = body.uint(Op::BitwiseAnd, &[bits, exponent]);

    let ulp_bits = body.uint(Op::Bitcast, &[ulp]);
    let sum = body.uint(Op::IAdd, &[bits, ulp_bits]);
    let of_sum = body.uint(Op::BitwiseAnd, &[sum, exponent]);
    let is_other = body.bool(Op::INotEqual, &[of_bits, of_sum]);
    let is_up = body.bool(Op::SGreaterThan, &[ulp, zero]);
    let is_beyond = body.bool(Op::LogicalAnd, &[is_other, is_up]);
    let last = body.uint(Op::BitwiseOr, &[bits, significand]);
    let power_of_two = body.uint(Op::IAdd, &[last, one]);
    let moved = body.uint(Op::Select, &[is_beyond, power_of_two, sum]);

    let is_normal = body.is_normal(bits);
    let result = body.uint(Op::Select, &[is_normal, moved, bits]);
    body.float(Op::Bitcast, &[result])
}

/// The sum rounded toward zero: the float below the rounded sum where that is too large. Knuth's TwoSum has the exact error.
fn truncated_sum(body: &mut Body<'_>, a: Word, b: Word) -> Word {
    let sum = body.float(Op::FAdd, &[a, b]);
    let of_b = body.float(Op::FSub, &[sum, a]);
    let of_a = body.float(Op::FSub, &[sum, of_b]);
    let error_b = body.float(Op::FSub, &[b, of_b]);
    let error_a = body.float(Op::FSub, &[a, of_a]);
    let error = body.float(Op::FAdd, &[error_a, error_b]);
    let (sum_bits, error_bits, sign) = (body.bits(sum), body.bits(error), body.uint_constant(SIGN));
    let signs = body.uint(Op::BitwiseXor, &[sum_bits, error_bits]);
    let signs = body.uint(Op::BitwiseAnd, &[signs, sign]);
    let (none, zero) = (body.uint_constant(0), body.float_constant(0.0));
    let is_opposite = body.bool(Op::INotEqual, &[signs, none]);
    let is_inexact = body.bool(Op::FOrdNotEqual, &[error, zero]);
    let is_too_large = body.bool(Op::LogicalAnd, &[is_opposite, is_inexact]);
    one_less_if(body, is_too_large, sum_bits)
}

/// The product rounded toward zero. Dekker's product of the significands, which cannot overflow, has the exact error. Where
/// a factor or the product is no normal number, the product is rounded to nearest.
fn truncated_product(body: &mut Body<'_>, a: Word, b: Word) -> Word {
    let product = body.float(Op::FMul, &[a, b]);
    let bits = body.bits(product);
    let mut is_too_large = body.is_normal(bits);
    let [(a, a_high, a_low), (b, b_high, b_low)] = [a, b].map(|factor| {
        let bits = body.bits(factor);
        let is_normal = body.is_normal(bits);
        is_too_large = body.bool(Op::LogicalAnd, &[is_too_large, is_normal]);
        halves_of_significand(body, bits)
    });
    let rounded = body.float(Op::FMul, &[a, b]);
    let mut error = body.float(Op::FMul, &[a_high, b_high]);
    error = body.float(Op::FSub, &[error, rounded]);
    for (a, b) in [(a_high, b_low), (a_low, b_high), (a_low, b_low)] {
        let part = body.float(Op::FMul, &[a, b]);
        error = body.float(Op::FAdd, &[error, part]);
    }
    let zero = body.float_constant(0.0);
    let is_negative = body.bool(Op::FOrdLessThan, &[error, zero]);
    is_too_large = body.bool(Op::LogicalAnd, &[is_too_large, is_negative]);
    one_less_if(body, is_too_large, bits)
}

/// The significand of a float, from 1 to 2, and two floats of 12 bits each whose sum it is.
fn halves_of_significand(body: &mut Body<'_>, bits: Word) -> (Word, Word, Word) {
    let (mask, one, upper) =
        (body.uint_constant(SIGNIFICAND), body.uint_constant(ONE), body.uint_constant(!0xfff));
    let significand = body.uint(Op::BitwiseAnd, &[bits, mask]);
    let significand = body.uint(Op::BitwiseOr, &[significand, one]);
    let high = body.uint(Op::BitwiseAnd, &[significand, upper]);
    let [significand, high] = [significand, high].map(|bits| body.float(Op::Bitcast, &[bits]));
    let low = body.float(Op::FSub, &[significand, high]);
    (significand, high, low)
}

/// The float with these bits, or the next toward zero.
fn one_less_if(body: &mut Body<'_>, condition: Word, bits: Word) -> Word {
    let (one, none) = (body.uint_constant(1), body.uint_constant(0));
    let less = body.uint(Op::Select, &[condition, one, none]);
    let bits = body.uint(Op::ISub, &[bits, less]);
    body.float(Op::Bitcast, &[bits])
}

/// An integer as float, rounded toward zero: without the bits below the first 24.
fn truncated_unsigned(body: &mut Body<'_>, x: Word) -> Word {
    let highest = body.extended(Type::Int, GLOp::FindUMsb, &[x]);
    let (kept, none, all) = (body.int_constant(23), body.int_constant(0), body.uint_constant(u32::MAX));
    let dropped = body.int(Op::ISub, &[highest, kept]);
    let is_some = body.bool(Op::SGreaterThan, &[dropped, none]);
    let dropped = body.int(Op::Select, &[is_some, dropped, none]);
    let mask = body.uint(Op::ShiftLeftLogical, &[all, dropped]);
    let exact = body.uint(Op::BitwiseAnd, &[x, mask]);
    body.float(Op::ConvertUToF, &[exact])
}

fn truncated_signed(body: &mut Body<'_>, x: Word) -> Word {
    let none = body.int_constant(0);
    let is_negative = body.bool(Op::SLessThan, &[x, none]);
    let negated = body.int(Op::SNegate, &[x]);
    let magnitude = body.int(Op::Select, &[is_negative, negated, x]);
    let magnitude = body.uint(Op::Bitcast, &[magnitude]);
    let converted = truncated_unsigned(body, magnitude);
    let negated = body.float(Op::FNegate, &[converted]);
    body.float(Op::Select, &[is_negative, negated, converted])
}

fn flushed(body: &mut Body<'_>, x: Word) -> Word {
    let bits = body.bits(x);
    let (exponent, sign, none) =
        (body.uint_constant(EXPONENT), body.uint_constant(SIGN), body.uint_constant(0));
    let of_bits = body.uint(Op::BitwiseAnd, &[bits, exponent]);
    let is_small = body.bool(Op::IEqual, &[of_bits, none]);
    let zero = body.uint(Op::BitwiseAnd, &[bits, sign]);
    let flushed = body.uint(Op::Select, &[is_small, zero, bits]);
    body.float(Op::Bitcast, &[flushed])
}

impl Body<'_> {
    fn float(&mut self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Float, opcode, operands)
    }

    fn uint(&mut self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Uint, opcode, operands)
    }

    fn int(&mut self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Int, opcode, operands)
    }

    fn bool(&mut self, opcode: Op, operands: &[Word]) -> Word {
        self.add(Type::Bool, opcode, operands)
    }

    fn bits(&mut self, x: Word) -> Word {
        self.uint(Op::Bitcast, &[x])
    }

    fn uint_constant(&mut self, value: u32) -> Word {
        self.constant(Type::Uint, value)
    }

    fn int_constant(&mut self, value: u32) -> Word {
        self.constant(Type::Int, value)
    }

    fn float_constant(&mut self, value: f32) -> Word {
        self.constant(Type::Float, value.to_bits())
    }

    fn is_normal(&mut self, bits: Word) -> Word {
        let (exponent, none) = (self.uint_constant(EXPONENT), self.uint_constant(0));
        let of_bits = self.uint(Op::BitwiseAnd, &[bits, exponent]);
        let is_not_small = self.bool(Op::INotEqual, &[of_bits, none]);
        let is_finite = self.bool(Op::INotEqual, &[of_bits, exponent]);
        self.bool(Op::LogicalAnd, &[is_not_small, is_finite])
    }
}
