//! Angles between a vector and points beside it, compared in f32.

use crate::arith::{dot, max};
use crate::direction::l1_norm;
use glam::Vec3;

/// The square of the tangent of an angle as a fraction, whose denominator is 0 from a right angle on.
#[derive(Clone, Copy)]
pub(super) struct Turn(f32, f32);

impl Turn {
    /// An angle that none is greater than.
    const RIGHT: Self = Self(f32::MAX, 0.0);

    /// The angle by which a vector turns when it is moved by less than a right angle: of the squares of both lengths, and their
    /// product. Of short moves, it tells those apart that differ by 2^-23 of the vector's length.
    #[inline(always)]
    pub(super) fn of(length: f32, square: f32, part: f32) -> Self {
        let along = length + part;
        Self(square * length - part * part, along * along)
    }

    /// The angle by which a vector turns when it is moved.
    #[inline(always)]
    pub(super) fn by(v: Vec3, by: Vec3) -> Self {
        let length = dot(v, v);
        Self::of(length, dot(by, by), max(dot(by, v), -length))
    }

    #[inline(always)]
    pub(super) fn is_less(self, than: Self) -> bool {
        self.0 * than.1 < than.0 * self.1
    }

    /// True where the squared tangents, times the denominators of both, differ by less than `part`.
    #[cfg(not(target_family = "wasm"))]
    #[inline(always)]
    pub(super) fn is_about(self, other: Self, part: f32) -> bool {
        (self.0 * other.1 - other.0 * self.1).abs() < part
    }
}

/// The nearest of some points, and the angle to it.
#[derive(Clone, Copy)]
pub(super) struct Best<P> {
    pub(super) point: P,
    pub(super) turn: Turn,
}

impl<P> Best<P> {
    /// A point that every other is nearer than.
    #[inline(always)]
    pub(super) fn none(point: P) -> Self {
        Self { point, turn: Turn::RIGHT }
    }

    /// This point, if it is nearer.
    #[inline(always)]
    pub(super) fn or(self, point: P, turn: Turn) -> Self {
        if turn.is_less(self.turn) { Self { point, turn } } else { self }
    }
}

/// A usable vector as one of this length, whose direction is rounded by 2^-23 and less.
#[inline(always)]
pub(super) fn of_length(v: Vec3, length: f32) -> Vec3 {
    let v = v * (1.0 / l1_norm(v));
    v * (length / dot(v, v).sqrt())
}
