//! The formats of other software that vectors already are in.

use crate::Result;
use crate::stream::{self, Input};
use std::collections::BTreeSet;
use unitvec::angle_deg;
use unitvec::interop::Format;
use unitvec_catalogue::Element;
use unitvec_mesh::has_direction;

/// Different vectors that tell formats apart: few, such as the sides of a cube, are points of many.
const ENOUGH: usize = 64;

/// The angle, in degrees, up to which a vector counts as a decoded one: decoders round, and files store floats. A random
/// vector is as near to a code of 32 bits once in a thousand.
const ROUNDING_DEG: f64 = 5e-5;

/// Parts of a step up to which a component counts as a whole number.
const ROUNDING_STEPS: f32 = 0.01;

/// The formats all of whose decoders give the vectors seen so far.
pub struct Fit {
    formats: Vec<Format>,
    seen: BTreeSet<[u32; 3]>,
}

impl Default for Fit {
    fn default() -> Self {
        let mut formats: Vec<Format> = Format::all().collect();
        formats.sort_by_key(|format| format.bits());
        Self { formats, seen: BTreeSet::new() }
    }
}

impl Fit {
    /// The formats of all vectors of an input.
    ///
    /// # Errors
    /// The errors of [`stream::for_each_chunk`].
    pub fn of(input: Input<'_>) -> Result<Self> {
        let mut fit = Self::default();
        let mut see = |vectors: &[f32], _| {
            fit.see(vectors);
            Ok(())
        };
        stream::for_each_chunk(input, Element::Vector, &mut see)?;
        Ok(fit)
    }

    /// Drops the formats that some of these vectors, of three floats each, are not of.
    pub fn see(&mut self, vectors: &[f32]) {
        let vectors = vectors.chunks_exact(3).map(|v| [v[0], v[1], v[2]]);
        for v in vectors.filter(|v| has_direction(*v)) {
            let bits = v.map(f32::to_bits);
            if self.formats.is_empty() || self.seen.contains(&bits) {
                continue;
            }
            if self.seen.len() < ENOUGH {
                self.seen.insert(bits);
            }
            self.formats.retain(|format| is_point(*format, v));
        }
    }

    /// Their names, those of the fewest bits first; none where too few different vectors were seen.
    pub fn names(&self) -> Vec<String> {
        let formats = self.formats.iter().filter(|_| self.seen.len() == ENOUGH);
        formats.map(ToString::to_string).collect()
    }

    /// The names of those of the fewest bits.
    pub fn least(&self) -> Vec<String> {
        let is_least = |format: &&Format| format.bits() == self.formats[0].bits();
        let count = self.formats.iter().take_while(is_least).count();
        self.names().into_iter().take(count).collect()
    }
}

/// True where the format's decoder gives this vector, but for the length, which decoded components keep.
fn is_point(format: Format, v: [f32; 3]) -> bool {
    if format.row().name.starts_with("gltf-snorm") {
        // Of 16 bits some code is near any vector.
        let most = ((1 << (format.component_bits() - 1)) - 1) as f32;
        return v.iter().all(|c| (c * most - (c * most).round()).abs() < ROUNDING_STEPS);
    }
    angle_deg(v, format.decode::<[f32; 3]>(format.encode(v))) < ROUNDING_DEG
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_catalogue::Domain;
    use unitvec_run::sampling::random_directions;

    /// Vectors that a format's plain encoder wrote are found to be of it, and random ones of none.
    #[test]
    fn formats_are_found() {
        let vectors: Vec<[f32; 3]> = random_directions(Domain::Sphere, 29).take(500).collect();
        let names = |vectors: &[[f32; 3]]| {
            let mut fit = Fit::default();
            vectors.chunks(100).for_each(|vectors| fit.see(vectors.as_flattened()));
            fit.names()
        };
        assert!(names(&vectors).is_empty());
        for format in Format::all().filter(|format| format.component_bits() > 4) {
            let decoded: Vec<[f32; 3]> =
                vectors.iter().map(|v| format.decode(format.plain().encode(*v))).collect();
            assert!(names(&decoded).contains(&format.to_string()), "{format}: {:?}", names(&decoded));
            assert!(names(&decoded[..ENOUGH - 1]).is_empty());
        }
    }
}
