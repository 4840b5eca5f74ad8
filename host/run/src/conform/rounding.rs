use crate::Result;
use crate::backend::Backend;
use serde::{Deserialize, Serialize};
use unitvec_catalogue::{AnyCodec, Element, find};

/// A device's rounding of the sum of a number and 1.5 2^23, by which encoders find the nearest whole number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rounding {
    /// Rounds to the nearest whole number, which the codes and error bounds of this library rely on.
    Nearest,
    /// Down, as where sums are truncated: codes are up to a step off instead of half a step.
    Down,
    /// Rounds otherwise, or the kernel does not work at all.
    Other,
}

/// The codec that is looked at, and the largest integer of its components: a vector whose L1 norm is that lies on its square
/// at its own x and y.
const CODEC: &str = "oct16";
const M: f32 = 127.0;

/// Quarters of a step beyond whole numbers, of either sign: far enough from halves for a division that is some ULP off.
const POSITIONS: [[f32; 2]; 4] = [[40.25, 20.75], [-40.25, 20.75], [40.25, -20.75], [-40.25, -20.75]];

impl Rounding {
    /// Determines the rounding of a backend's device from encoded vectors.
    ///
    /// # Errors
    /// Any error of the backend.
    pub fn of(backend: &mut dyn Backend) -> Result<Self> {
        let format: &'static AnyCodec = find(CODEC)?;
        debug_assert_eq!(format.element, Element::Vector);
        let vectors = POSITIONS.map(|[x, y]| [x, y, M - x.abs() - y.abs()]);
        let mut codes = [0; 2 * POSITIONS.len()];
        backend.encode(format, vectors.as_flattened(), &mut codes)?;
        let found =
            |round: fn(f32) -> f32| POSITIONS.as_flattened().iter().map(move |x| round(*x) as i8 as u8);
        Ok(if found(f32::round).eq(codes) {
            Self::Nearest
        } else if found(f32::floor).eq(codes) {
            Self::Down
        } else {
            Self::Other
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::Cpu;

    /// Encodes as a device whose sums are rounded by this function.
    struct Rounds(fn(f32) -> f32);

    impl Backend for Rounds {
        fn encode(&mut self, _: &AnyCodec, elements: &[f32], codes: &mut [u8]) -> Result<()> {
            for (v, code) in elements.chunks_exact(3).zip(codes.chunks_exact_mut(2)) {
                code.copy_from_slice(&[v[0], v[1]].map(|x| (self.0)(x) as i8 as u8));
            }
            Ok(())
        }

        fn decode(&mut self, _: &AnyCodec, _: &[u8], _: &mut [f32]) -> Result<()> {
            Ok(())
        }
    }

    #[test]
    fn each_way_of_rounding_is_told_from_the_others() {
        assert_eq!(Rounding::of(&mut Cpu).unwrap(), Rounding::Nearest);
        assert_eq!(Rounding::of(&mut Rounds(f32::round_ties_even)).unwrap(), Rounding::Nearest);
        assert_eq!(Rounding::of(&mut Rounds(f32::floor)).unwrap(), Rounding::Down);
        assert_eq!(Rounding::of(&mut Rounds(f32::ceil)).unwrap(), Rounding::Other);
        assert_eq!(Rounding::of(&mut Rounds(|_| 0.0)).unwrap(), Rounding::Other);
    }
}
