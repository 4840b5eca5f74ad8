//! Makes the tile of blue noise for dithered codes, the same bytes on every machine:
//! `cargo run --release -p unitvec-bench --bin blue_noise > shaders/blue_noise_64x64.rg8`.
//!
//! Source: Ulichney 1993, "The void-and-cluster method for dither array generation". Each channel orders the texels so that at any
//! length the first ones lie evenly; a texel's byte is its rank divided by 16. So every byte occurs equally often, and two
//! offsets made of them are uniform.

use std::io::Write;

const SIDE: usize = 64;
const TEXELS: usize = SIDE * SIDE;

/// The width, in texels, of a texel's contribution to the crowding around it: Ulichney's.
const SIGMA: f64 = 1.5;

/// Texels that are set, and how crowded each place is by them. Whole numbers, so that nothing depends on rounding.
struct Pattern {
    weights: Vec<u64>,
    crowding: Vec<u64>,
    set: Vec<bool>,
}

impl Pattern {
    fn new() -> Self {
        let across = |i: usize| i.min(SIDE - i) as f64;
        let weight =
            |x: f64, y: f64| ((-(x * x + y * y) / (2.0 * SIGMA * SIGMA)).exp() * 2f64.powi(36)) as u64;
        let weights = (0..TEXELS).map(|i| weight(across(i % SIDE), across(i / SIDE))).collect();
        Self { weights, crowding: vec![0; TEXELS], set: vec![false; TEXELS] }
    }

    /// Sets a texel, or clears it if it is set.
    fn flip(&mut self, texel: usize) {
        let add = !self.set[texel];
        self.set[texel] = add;
        for (place, crowding) in self.crowding.iter_mut().enumerate() {
            let x = (place % SIDE + SIDE - texel % SIDE) % SIDE;
            let y = (place / SIDE + SIDE - texel / SIDE) % SIDE;
            let weight = self.weights[y * SIDE + x];
            *crowding = if add { *crowding + weight } else { *crowding - weight };
        }
    }

    /// The set texel that is most crowded.
    fn tightest_cluster(&self) -> usize {
        (0..TEXELS).filter(|&i| self.set[i]).max_by_key(|&i| self.crowding[i]).unwrap_or_default()
    }

    /// The texel that is not set and least crowded.
    fn largest_void(&self) -> usize {
        (0..TEXELS).filter(|&i| !self.set[i]).min_by_key(|&i| self.crowding[i]).unwrap_or_default()
    }
}

/// A tenth of the texels, spread evenly from a random start.
fn start(seed: u64) -> Pattern {
    let mut pattern = Pattern::new();
    let mut state = seed;
    for _ in 0..TEXELS / 10 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let texel = (state >> 33) as usize % TEXELS;
        if !pattern.set[texel] {
            pattern.flip(texel);
        }
    }
    loop {
        let cluster = pattern.tightest_cluster();
        pattern.flip(cluster);
        let void = pattern.largest_void();
        pattern.flip(void);
        if void == cluster {
            return pattern;
        }
    }
}

/// The bytes of a channel.
fn channel(seed: u64) -> Vec<u8> {
    let mut pattern = start(seed);
    let mut ranks = vec![0; TEXELS];
    let first: Vec<usize> = (0..TEXELS).filter(|&i| pattern.set[i]).collect();
    for rank in (0..first.len()).rev() {
        let cluster = pattern.tightest_cluster();
        pattern.flip(cluster);
        ranks[cluster] = rank;
    }
    for texel in &first {
        pattern.flip(*texel);
    }
    // Where more than half are set, the largest void is the tightest cluster of unset texels.
    for rank in first.len()..TEXELS {
        let void = pattern.largest_void();
        pattern.flip(void);
        ranks[void] = rank;
    }
    ranks.into_iter().map(|rank| (rank * 256 / TEXELS) as u8).collect()
}

fn main() -> std::io::Result<()> {
    let (first, second) = (channel(1), channel(2));
    let texels: Vec<u8> = first.into_iter().zip(second).flat_map(|(r, g)| [r, g]).collect();
    std::io::stdout().write_all(&texels)
}
