//! Models of devices where Vulkan allows several results.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A device's arithmetic. Whatever a model does not name is as on the CPU.
///
/// Source: Vulkan specification, appendix "Vulkan Environment for SPIR-V", "Precision of Individual Operations" and
/// "Denormalized values".
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    ValueEnum,
    schemars::JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// All quotients and square roots are too large, by as much as the specification allows.
    Up,
    /// All quotients and square roots are too small, by as much.
    Down,
    /// Quotients are too large and square roots too small, by as much: so is the inverse of a length too large.
    UpDown,
    /// Quotients are too small and square roots too large, by as much.
    DownUp,
    /// Quotients and square roots are off by a number of ULP that the bits of the operands and the seed choose, either way
    /// and at most by as much.
    Bits,
    /// Denormals are flushed to zero, of their sign, before and after every operation.
    Flush,
    /// Sums, products and conversions to float are rounded toward zero, which the specification allows as well.
    Truncate,
    /// Quotients and reciprocal roots are 12 ULP off, to the side that the operands' bits choose. The specification does not
    /// allow that: exact kernels put as much right.
    Far,
    /// The device as it is: kernels are not rewritten.
    Own,
}

impl Model {
    /// All models of rewritten kernels.
    pub const ALL: [Self; 8] = [
        Self::Up,
        Self::Down,
        Self::UpDown,
        Self::DownUp,
        Self::Bits,
        Self::Flush,
        Self::Truncate,
        Self::Far,
    ];

    /// True where the specification allows such a device.
    pub fn is_conformant(self) -> bool {
        self != Self::Far
    }

    /// True where sums are rounded to nearest, which encoders rely on: `unitvec conform` refuses a device that does not.
    pub fn rounds_to_nearest(self) -> bool {
        self != Self::Truncate
    }

    /// True for models that round quotients and square roots as the CPU does.
    pub fn divides_exactly(self) -> bool {
        matches!(self, Self::Flush | Self::Truncate)
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // No value is skipped.
        f.write_str(self.to_possible_value().as_ref().map_or("", |value| value.get_name()))
    }
}

/// ULP by which [`Model::Far`] moves results.
pub const FAR_ULP: u32 = 12;

/// ULP by which [`Model::Up`] moves a quotient that is rounded to nearest: it may be off by 2.5 ULP, and half a ULP is
/// spent already.
pub const QUOTIENT_ULP: u32 = 2;

/// ULP by which a reciprocal root is moved: the specification's bound, beside the roundings of root and quotient.
pub const INVERSE_ROOT_ULP: u32 = 2;

/// The bound for square roots whose significand is 1 or more. They may be off as `1 / inversesqrt(x)` is: by 2 ULP of
/// the inverse and 2.5 ULP of the quotient. The inverse of a root with the significand s has the significand 2 / s, so
/// that 2 ULP of the inverse change the root by s^2 ULP, which is 1 at least. Half a ULP is spent already.
pub const ROOT_ULP: u32 = 3;

/// Significands s from which a square root may be off by one ULP more: s^2 reaches 2, and 3.
pub const ROOT_STEPS: [f32; 2] = [std::f32::consts::SQRT_2, 1.732_050_9];
