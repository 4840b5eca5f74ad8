//! The order of codecs by the look of a mirror, and by their errors (figure 8).

use super::Number;
use super::camera::{Camera, shot};
use super::compare::{mean, mean_where, rank_correlation};
use crate::{Material, Normals, OBJECTS, Result, SIDES, Seen, View};
use image::RgbImage;
use unitvec_catalogue::{AnyCodec, Domain, vectors};
use unitvec_run::backend::Cpu;
use unitvec_run::measure::measure;

/// Directions that mean errors are measured over.
const MEASURED: usize = 200_000;

/// The objects that turn in all directions: each shows so many normals that chance evens out. The panel and the faceted body
/// show a few cells of a code each.
const CURVED: [&str; 3] = ["bunny", "teapot", "bumpy sphere"];

fn is_curved(seen: &Option<Seen>) -> bool {
    let name = seen.and_then(|seen| OBJECTS.get(seen.object as usize - 1));
    name.is_some_and(|name| CURVED.contains(name))
}

/// The mean error of the normals of some pixels, degrees.
fn error_shown<'a>(seen: impl Iterator<Item = &'a Option<Seen>>) -> f64 {
    let seen = seen.flatten();
    mean(seen.map(|seen| unitvec::angle_deg(seen.normal.to_array(), seen.decoded.to_array())))
}

/// The bumpy sphere as a mirror, from all sides.
fn sides(camera: &mut dyn Camera, normals: Normals) -> Result<Vec<RgbImage>> {
    (0..SIDES).map(|side| camera.picture(&shot(normals, Material::Mirror, View::Side(side)))).collect()
}

/// The rank correlation of the mirror's differences with the errors, for all codecs of 16 bits: on a sphere that is
/// seen from all sides, and in the scene, whose normals are spread otherwise than the sphere's.
pub fn ranks(camera: &mut dyn Camera, float: &RgbImage) -> Result<Vec<Number>> {
    const BITS: u32 = 16;
    let taken = |normals| shot(normals, Material::Mirror, View::Scene);
    let curved: Vec<bool> = camera.surface(&taken(Normals::Float))?.iter().map(is_curved).collect();
    let all = vec![true; curved.len()];
    let float_sides = sides(camera, Normals::Float)?;
    let is_asked = |codec: &&AnyCodec| codec.bits == BITS && codec.domain == Domain::Sphere && codec.is_unit;
    let (mut numbers, mut pairs) = (Vec::new(), [const { Vec::new() }; 4]);
    for codec in vectors().iter().filter(is_asked) {
        let error = measure(&mut Cpu, codec, Domain::Sphere, MEASURED, 1)?.normal.mean_deg();
        let coded_sides = sides(camera, Normals::Codec(codec))?;
        // The sky around the sphere does not differ.
        let around =
            mean(float_sides.iter().zip(&coded_sides).map(|(float, coded)| mean_where(&all, float, coded)));
        let picture = camera.picture(&taken(Normals::Codec(codec)))?;
        let (whole, on_curved) = (mean_where(&all, float, &picture), mean_where(&curved, float, &picture));
        let seen = camera.surface(&taken(Normals::Codec(codec)))?;
        let error_seen = error_shown(seen.iter().filter(|seen| is_curved(seen)));
        let found = [(error, around), (error_seen, on_curved), (error, on_curved), (error, whole)];
        pairs.iter_mut().zip(found).for_each(|(pairs, pair)| pairs.push(pair));
        for (what, value) in [("of a sphere", around), ("on the scene's curved bodies", on_curved)] {
            numbers.push(Number::new(format!("{}, mirror, mean difference {what}", codec.id), value));
        }
    }
    let names = [
        "of a sphere from all sides with the mean error over the sphere",
        "on the scene's curved bodies with the mean error of their normals",
        "on the scene's curved bodies with the mean error over the sphere",
        "of the whole scene with the mean error over the sphere",
    ];
    let correlation = |(name, pairs): (&str, &Vec<(f64, f64)>)| {
        let name = format!(
            "rank correlation of the mirror's mean difference {name}, {} codecs of {BITS} bits",
            pairs.len()
        );
        Number::new(name, rank_correlation(pairs))
    };
    numbers.extend(names.into_iter().zip(&pairs).map(correlation));
    Ok(numbers)
}
