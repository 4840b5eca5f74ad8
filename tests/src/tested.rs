//! A codec of the list beside its reference: the subject of all tests of codecs.

use crate::directions::Rng;
use glam::Vec3;
use std::ops::Deref;
use std::sync::OnceLock;
use unitvec_catalogue::{AnyCodec, vectors};
use unitvec_oracle::{Oracle, Reference, angle_deg};

/// A codec and its reference. Codes are numbers of 64 bits, the low word first, whatever their width.
#[derive(Clone, Copy, Debug)]
pub struct Tested {
    info: &'static AnyCodec,
    /// The codec once more, in `f64`.
    pub reference: Reference,
    /// The code of +Z.
    pub z: u64,
}

impl Deref for Tested {
    type Target = AnyCodec;

    fn deref(&self) -> &AnyCodec {
        self.info
    }
}

impl Tested {
    /// All codecs.
    ///
    /// # Panics
    /// If the oracle lacks one.
    pub fn all() -> &'static [Self] {
        static ALL: OnceLock<Vec<Tested>> = OnceLock::new();
        ALL.get_or_init(|| vectors().iter().map(Self::new).collect())
    }

    fn new(info: &'static AnyCodec) -> Self {
        let reference = Reference::find(info.id).unwrap_or_else(|| panic!("{} has no oracle", info.id));
        assert_eq!(reference.bits, info.bits, "{}", info.id);
        let mut codec = Self { info, reference, z: 0 };
        codec.z = codec.encode(Vec3::Z);
        codec
    }

    /// The codec with an identifier.
    ///
    /// # Panics
    /// If the list or the oracle does not have it.
    pub fn find(id: &str) -> Self {
        Self::new(unitvec_catalogue::find(id).unwrap_or_else(|error| panic!("{error}")))
    }

    /// The codecs of a family.
    ///
    /// # Panics
    /// If there is none.
    pub fn family(name: &str) -> Vec<Self> {
        Self::which(&format!("of the family {name}"), |codec| codec.family == name)
    }

    /// The codecs whose identifiers are `name`, the width and `suffix`.
    ///
    /// # Panics
    /// If there is none.
    pub fn named(name: &str, suffix: &str) -> Vec<Self> {
        let is_width = |text: &str| !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit());
        let width = |codec: &Self| codec.id.strip_prefix(name)?.strip_suffix(suffix);
        Self::which(&format!("named {name}…{suffix}"), |codec| width(codec).is_some_and(is_width))
    }

    fn which(what: &str, is: impl Fn(&Self) -> bool) -> Vec<Self> {
        let found: Vec<Self> = Self::all().iter().filter(|codec| is(codec)).copied().collect();
        assert!(!found.is_empty(), "no codec is {what}");
        found
    }

    /// The code of a vector.
    pub fn encode(&self, v: Vec3) -> u64 {
        let [low, high] = self.info.encode_one(v.to_array());
        u64::from(low) | (u64::from(high) << 32)
    }

    /// The vector of a code.
    pub fn decode(&self, code: u64) -> Vec3 {
        Vec3::from_array(self.info.decode_one([code as u32, (code >> 32) as u32]))
    }

    /// The codes of vectors, by the slice functions: those of [`encode`](Self::encode), as the suite's `takes_anything` shows,
    /// in a part of the time.
    pub fn encode_all(&self, vectors: &[Vec3]) -> Vec<u64> {
        let elements: Vec<f32> = vectors.iter().flat_map(|v| v.to_array()).collect();
        let mut codes = vec![0; vectors.len() * self.bytes];
        self.encode_here(&elements, &mut codes).unwrap_or_else(|error| panic!("{}: {error}", self.id));
        let word = |code: &[u8]| {
            let mut word = [0; 8];
            word[..code.len()].copy_from_slice(code);
            u64::from_le_bytes(word)
        };
        codes.chunks_exact(self.bytes).map(word).collect()
    }

    /// The vectors of codes, by the slice functions: those of [`decode`](Self::decode), as `assert_decodes` shows for every
    /// code that it takes.
    pub fn decode_all(&self, codes: &[u64]) -> Vec<Vec3> {
        let mut bytes = Vec::with_capacity(codes.len() * self.bytes);
        codes.iter().for_each(|code| bytes.extend_from_slice(&code.to_le_bytes()[..self.bytes]));
        let mut elements = vec![[0.0; 3]; codes.len()];
        self.decode_here(&bytes, elements.as_flattened_mut())
            .unwrap_or_else(|error| panic!("{}: {error}", self.id));
        elements.into_iter().map(Vec3::from_array).collect()
    }

    /// The decoded code of a vector.
    pub fn round_trip(&self, v: Vec3) -> Vec3 {
        self.decode(self.encode(v))
    }

    /// The decoded codes of vectors, by the slice functions.
    pub fn round_trip_all(&self, vectors: &[Vec3]) -> Vec<Vec3> {
        self.decode_all(&self.encode_all(vectors))
    }

    /// The angle in degrees between a direction and its decoded one.
    pub fn error_deg(&self, v: Vec3) -> f64 {
        angle_deg(widen(v), widen(self.round_trip(v)))
    }

    /// [`error_deg`](Self::error_deg) of each direction, by the slice functions.
    pub fn errors_deg(&self, directions: impl Iterator<Item = Vec3>) -> impl Iterator<Item = f64> {
        portions(directions).flat_map(|directions| {
            let decoded = self.round_trip_all(&directions);
            directions.into_iter().zip(decoded).map(|(v, decoded)| angle_deg(widen(v), widen(decoded)))
        })
    }

    /// The angle in degrees between a direction and its code's in `f64`: the error of the choice alone.
    pub fn choice_deg<O: Oracle>(&self, v: Vec3) -> f64 {
        angle_deg(widen(v), O::decode(self.encode(v), self.bits))
    }

    /// True for codecs that store a direction, and not components as they are.
    pub fn is_directional(&self) -> bool {
        self.is_unit || self.family == "best_fit"
    }

    /// True where the encoder takes the best of several candidates.
    pub fn is_precise(&self) -> bool {
        self.id.ends_with('p') && self.is_unit
    }

    /// The mask of the code's bits.
    pub fn mask(&self) -> u64 {
        u64::MAX >> (64 - self.bits)
    }

    /// Codes: every one of up to `every` bits, every third of up to 22, every ninth of up to 25; 2^20 of more bits, half
    /// of them at even distances and half at random. Then [`edges`](Self::edges).
    pub fn codes(&self, seed: u64, every: u32) -> impl Iterator<Item = u64> {
        let stride = match self.bits {
            bits if bits <= every => 1,
            0..=22 => 3,
            23..=25 => 9,
            bits => (1 << (bits - 19)) + 1,
        };
        let (count, random) = if self.bits <= 25 { (1u64 << self.bits, 0) } else { (stride << 19, 1 << 19) };
        let (mut rng, mask) = (Rng::new(seed), self.mask());
        (0..count.div_ceil(stride))
            .map(move |i| i.wrapping_mul(stride) & mask)
            .chain((0..random).map(move |_| rng.bits() & mask))
            .chain(self.edges(seed + 1))
    }

    /// Codes at the edges of whatever the code's two halves are: with both at the ends, the middle and the parts of their
    /// range, on the diamond's edge and the square's border, and around the first and the last code; with each highest bit.
    pub fn edges(&self, seed: u64) -> impl Iterator<Item = u64> {
        let (half, mask) = (self.bits / 2, self.mask());
        let m = (1i64 << (half - 1)) - 1;
        let parts = [0, 1, 2, m / 8, m / 4, m / 3, m / 2, 2 * (m / 3), m - m / 4, m - 2, m - 1, m];
        let near: Vec<i64> = parts.iter().flat_map(|&t| [t, -t, t + 1, -t - 1]).collect();
        let mut rng = Rng::new(seed);
        let mut points: Vec<[i64; 2]> =
            near.iter().flat_map(|&x| near.iter().map(move |&y| [x, y])).collect();
        for _ in 0..4_000 {
            let along = rng.range(-(m as f64), m as f64) as i64;
            let across = m - along.abs();
            points.extend([
                [along, across],
                [along, -across],
                [along, across - 1],
                [along, along],
                [along, 0],
            ]);
            points.extend([[along, m], [along, -m], [m, along], [-m, along], [0, along], [along, 1 - m]]);
        }
        let field = move |i: i64| i as u64 & ((1 << half) - 1);
        let top = 1 << (self.bits - 1);
        let points = points.into_iter().flat_map(move |[x, y]| {
            let code = field(x) | (field(y) << half);
            [code, code ^ top]
        });
        points.chain((0..20_000).flat_map(move |i| [i & mask, mask - (i & mask)]))
    }
}

/// The items in portions for the slice functions.
pub fn portions<T>(mut items: impl Iterator<Item = T>) -> impl Iterator<Item = Vec<T>> {
    std::iter::from_fn(move || {
        let portion: Vec<T> = items.by_ref().take(1 << 12).collect();
        (!portion.is_empty()).then_some(portion)
    })
}

/// A vector in double precision: exact.
pub fn widen(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

/// Rounds each component to the nearest `f32`.
pub fn narrow(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|t| t as f32))
}
