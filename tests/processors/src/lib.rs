//! Results of a processor for a codec, as digests: of the codes of fixed vectors and of the vectors of fixed codes, as
//! `vectors/digests.csv` has them, and of more input that is hard to round or has no direction.

use sha2::{Digest, Sha256};

#[path = "../../../host/run/src/sampling/special.rs"]
mod special;

pub use special::{special_frames, special_rotations, special_vectors};

/// Vectors and codes for each of the released digests.
pub const COUNT: usize = 1 << 16;

/// SplitMix64 (Steele, Lea and Flood 2014): small, and the same everywhere.
pub struct Rng(u64);

impl Rng {
    /// A generator whose sequence `seed` determines.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A uniform number of `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A uniform number of `[low, high)`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A number from -1 to 1 with 23 bits after the point: exact.
    fn component(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / 8_388_608.0 - 1.0
    }
}

/// Encodes elements to densely packed little-endian bytes.
pub type Encode<'a, const N: usize> = &'a dyn Fn(&[[f32; N]], &mut [u8]);

/// Decodes such bytes.
pub type Decode<'a, const N: usize> = &'a dyn Fn(&[u8], &mut [[f32; N]]);

/// One way of running a codec of elements of `N` floats.
pub struct Coder<'a, const N: usize> {
    /// The codec's identifier.
    pub id: &'a str,
    /// Significant bits of a code.
    pub bits: u32,
    /// Bytes of a stored code.
    pub bytes: usize,
    /// The codec's encoder.
    pub encode: Encode<'a, N>,
    /// The codec's decoder.
    pub decode: Decode<'a, N>,
}

impl<const N: usize> Coder<'_, N> {
    /// The codec's row of `vectors/digests.csv`, if `count` is [`COUNT`]: so many random vectors encoded, and so many
    /// random codes decoded.
    pub fn released(&self, count: usize) -> String {
        let (mut elements, mut rng) = (vec![[0.0; N]; count], Rng::new(1));
        elements.iter_mut().flatten().for_each(|c| *c = rng.component());
        let codes: Vec<u8> = (0..count * self.bytes).map(|_| rng.bits() as u8).collect();
        format!("{},{},{}", self.id, self.encoded(&elements), self.decoded(&codes))
    }

    /// Digests of these elements and of ties encoded, and of all codes of up to 16 bits decoded. Of each, if `count` is less
    /// than [`COUNT`], about as many.
    pub fn more(&self, count: usize, special: &[[f32; N]]) -> String {
        // An odd step, so that elements of every kind are taken.
        let mut elements: Vec<_> = special.iter().copied().step_by((special.len() / count) | 1).collect();
        elements.extend(ties::<N>(count / 4));
        let codes: Vec<u8> = (0..1u64 << self.bits.min(16))
            .step_by(COUNT / count)
            .flat_map(|code| code.to_le_bytes().into_iter().take(self.bytes))
            .collect();
        format!("{},{}", self.encoded(&elements), self.decoded(&codes))
    }

    fn encoded(&self, elements: &[[f32; N]]) -> String {
        let mut codes = vec![0; elements.len() * self.bytes];
        (self.encode)(elements, &mut codes);
        format!("{:x}", Sha256::digest(&codes))
    }

    fn decoded(&self, codes: &[u8]) -> String {
        let mut elements = vec![[0.0; N]; codes.len() / self.bytes];
        (self.decode)(codes, &mut elements);
        let bytes: Vec<u8> = elements.iter().flatten().flat_map(|c| c.to_bits().to_le_bytes()).collect();
        format!("{:x}", Sha256::digest(bytes))
    }
}

/// Elements whose first three components lie halfway between lattice points of an octahedron with so many steps an edge as
/// codes of 8 to 32 bits have, and as snorm between two steps of theirs.
fn ties<const N: usize>(count: usize) -> impl Iterator<Item = [f32; N]> {
    const STEPS: [u64; 6] = [7, 127, 511, 1023, 2047, 32767];
    let mut rng = Rng::new(2);
    (0..count).map(move |i| {
        let m = 2 * STEPS[i % STEPS.len()];
        let x = rng.bits() % (m + 1);
        let y = rng.bits() % (m + 1 - x);
        let halves = [x, y, m - x - y];
        let scale = if rng.bits() & 1 == 0 { 1.0 } else { m as f32 };
        std::array::from_fn(|i| {
            let sign = if rng.bits() & 1 == 0 { 1.0 } else { -1.0 };
            sign * halves[i % 3] as f32 / scale
        })
    })
}
