//! Subtractive dither: codes whose errors do not line up in bands, at no more error.
//!
//! Encoder and decoder know a small offset, in steps of the code's lattice. The encoder rounds the position moved by
//! it, and the decoder moves the lattice point back. Over offsets that vary from pixel to pixel, the error that is left
//! is noise in place of steps. See docs/dither.md of the repository for when to use it.
//!
//! ```
//! use unitvec::dither::{Dithered, dither_from_key};
//! use unitvec::{Oct16, angle_deg};
//! use unitvec::glam::Vec3;
//!
//! let (normal, vertex_index) = (Vec3::new(0.6, 0.0, -0.8), 7);
//! // Both sides take the offset from the same key.
//! let code = Oct16::encode_dithered(normal, dither_from_key(vertex_index));
//! let decoded = Oct16::decode_dithered(code, dither_from_key(vertex_index));
//! assert!(angle_deg(normal, decoded) < 1.0);
//! ```
//!
//! * The codes are those of the codec's format: only the decoder must be the dithered one, with the offset of the encoder.
//! * Offset (0, 0) gives the code of the codec's fast encoder, and its decoded vector, exactly.
//! * Components of offsets are clamped to \[-1/2, 1/2\]; NaN counts as 0. A vector without a direction gets the code of +Z.
//! * In `oct`, `hemioct` and `soct` an offset moves x and y (or u and v) on the lattice's square; the moved point is
//!   clamped to the square. In `eaoct` its first component counts rings, from +Z to -Z, the second points on a ring,
//!   from +X towards +Y; the poles are not moved.
//! * The precise encoders take the corner of the moved point's cell that decodes nearest in angle; the one of `eaoct`
//!   chooses among the nearest points of the two rings around it.

mod key;
mod rings;
mod square;

pub use key::{dither_from_key, dither_from_pixel, dither_from_position, dither_from_texel};

use crate::arith::{dot, is_nan, max, min, normalize, scaled_to_one};
use crate::codec::Codec;
use glam::{Vec2, Vec3};

/// A codec with dithered functions.
pub trait Dithered: Codec {
    /// The code of the direction of `v`, its lattice position moved by `offset` steps: components are clamped to
    /// \[-1/2, 1/2\], NaN is 0. A vector without a usable direction gets the code of +Z.
    #[must_use]
    fn encode_dithered(v: Vec3, offset: Vec2) -> Self::Code;

    /// The direction that `code` stands for where it was encoded with this offset, to the bit: another adds up to a step
    /// of error. Any code is valid; the result has unit length to within 3 ULP.
    #[must_use]
    fn decode_dithered(code: Self::Code, offset: Vec2) -> Vec3;
}

/// An offset with its components clamped to \[-1/2, 1/2\]; 0 for NaN.
#[inline(always)]
fn usable(offset: Vec2) -> Vec2 {
    let component = |x: f32| if is_nan(x) { 0.0 } else { min(max(x, -0.5), 0.5) };
    Vec2::new(component(offset.x), component(offset.y))
}

/// The direction of `v`, of this L1 norm, at unit length. Unspecified without a usable direction.
#[inline(always)]
fn unit(v: Vec3, norm: f32) -> Vec3 {
    normalize(scaled_to_one(v, norm))
}

/// A lattice point, and the square of its chord from the direction sought.
#[derive(Clone, Copy)]
struct Candidate {
    point: Vec2,
    chord: f32,
}

impl Candidate {
    /// The lattice point that decodes to `decoded`, as `n` sees it.
    #[inline(always)]
    fn new(point: Vec2, decoded: Vec3, n: Vec3) -> Self {
        let off = decoded - n;
        Self { point, chord: dot(off, off) }
    }

    /// `other` where it is nearer, else `self`.
    #[inline(always)]
    fn or_nearer(self, other: Self) -> Self {
        if other.chord < self.chord { other } else { self }
    }
}
