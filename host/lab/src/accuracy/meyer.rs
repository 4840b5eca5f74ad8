//! Table 1 of Meyer et al. 2010 (*On Floating-Point Normal Vectors*): error bounds, and the largest errors found.

use crate::Result;
use glam::{DVec3, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};
use unitvec::angle_deg;
use unitvec_catalogue::{AnyCodec, Domain, find};
use unitvec_run::backend::{Backend, round_trip};
use unitvec_run::sampling;

/// A method of Meyer's table.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// The method's name in the table.
    pub name: &'static str,
    /// The distance of samples in the domain at a number of bits: the table's first row.
    pub spacing: fn(f64) -> f64,
    /// The largest error in radians at a spacing, to first order.
    first_order: fn(f64) -> f64,
    /// The same without an approximation, where the paper has it: equations 3, 5 to 8 and 10.
    exact: Option<fn(f64) -> f64>,
    /// The family of codecs that implement it: identifiers are this, the bits, and the suffix.
    family: &'static str,
    suffix: &'static str,
}

/// Widths of the table.
pub const WIDTHS: [u32; 4] = [16, 24, 32, 48];

/// The methods, in the table's order.
///
/// FPNV, three floats, stands twice. The table's formula has cells of 2 2^(-b/3), which is fixed point with b / 3 bits;
/// its figure for 48 bits, 4.60e-4, follows from eq. 3, sqrt(2) / 3 2^-m, with the m = 10 bits of a half float.
///
/// The bounds take a coordinate's bits to be any number, whole or not. Where PP's b - 1 or SPP's and CM's b - 3 bits are
/// odd, one coordinate has sqrt(2) times the bound's step and the other 1 / sqrt(2) times, and the error of both is
/// sqrt(5) / 2 times the bound, or the square root of that for PP. At 48 bits the decoded vector's own rounding to f32
/// (5.6e-8 radians) comes on top, and PP and SPP cannot be told from their neighbours' codes by an f32 input: see their
/// module's docs.
///
/// SC stands twice too: the table prints twice what eq. 5, sqrt(2) / 2 pi epsilon, gives with the table's own epsilon,
/// 2^(-(b-1)/2). Ours are sqrt(5) / 2 above eq. 5, since a step of phi is twice one of theta.
///
/// Eq. 7, of SPP, has a root too many in print, by which it exceeds 1: the inner one is of 192 alone.
pub const METHODS: [Method; 9] = [
    Method {
        name: "FPNV",
        spacing: |b| 2.0 * (-b / 3.0).exp2(),
        first_order: floats,
        exact: Some(exact_floats),
        family: "fpnv",
        suffix: "",
    },
    Method {
        name: "FPNV_half",
        spacing: |_| 2f64.powi(-11),
        first_order: floats,
        exact: Some(exact_floats),
        family: "float",
        suffix: "",
    },
    Method {
        name: "PP",
        spacing: |b| 2.0 * scale(b - 1.0),
        first_order: |e| 2f64.powf(0.25) * e.sqrt(),
        exact: Some(|e| (1.0 - e / SQRT_2).acos()),
        family: "pp",
        suffix: "",
    },
    Method {
        name: "SPP",
        spacing: |b| SQRT_2 * scale(b - 3.0),
        first_order: |e| 1.5f64.sqrt() * e,
        exact: Some(|e| {
            let root = (4.0 + 192f64.sqrt() * e - 6.0 * e * e).sqrt();
            (2.0 / 3.0 - e / 3f64.sqrt() + root / 6.0).acos()
        }),
        family: "spp",
        suffix: "",
    },
    Method {
        name: "SC",
        spacing: |b| scale(b - 1.0),
        first_order: |e| SQRT_2 * PI * e,
        exact: None,
        family: "spherical",
        suffix: "",
    },
    Method {
        name: "SC_eq5",
        spacing: |b| scale(b - 1.0),
        first_order: |e| FRAC_1_SQRT_2 * PI * e,
        exact: Some(|e| (0.5 * PI * e).cos().powi(2).acos()),
        family: "spherical",
        suffix: "",
    },
    Method {
        name: "CM",
        spacing: |b| 2.0 * scale(b - 3.0),
        first_order: |e| FRAC_1_SQRT_2 * e,
        exact: Some(|e| (2.0 / (2.0 * e * e + 4.0).sqrt()).acos()),
        family: "cube",
        suffix: "",
    },
    Method {
        name: "ONV_domain",
        spacing: |b| 2.0 * scale(b),
        first_order: |e| 1.5 * SQRT_2 * e,
        exact: Some(|e| (2.0 / (2.0 + 9.0 * e * e)).sqrt().acos()),
        family: "oct",
        suffix: "",
    },
    Method {
        name: "ONV_range",
        spacing: |b| 2.0 * scale(b),
        first_order: |e| SQRT_2 * e,
        exact: None,
        family: "oct",
        suffix: "p",
    },
];

fn scale(bits: f64) -> f64 {
    (-bits / 2.0).exp2()
}

fn floats(spacing: f64) -> f64 {
    2.0 * SQRT_2 / 3.0 * spacing
}

fn exact_floats(spacing: f64) -> f64 {
    let square = 9.0 + 12.0 * spacing + 12.0 * spacing * spacing;
    (1.0 - 8.0 * spacing * spacing / square).sqrt().acos()
}

impl Method {
    /// Bound of the error in radians at a number of bits, to first order: the table's second row.
    pub fn bound(&self, bits: f64) -> f64 {
        (self.first_order)((self.spacing)(bits))
    }

    /// The same by the method's equation, where the paper has one.
    pub fn exact_bound(&self, bits: f64) -> Option<f64> {
        self.exact.map(|exact| exact((self.spacing)(bits)))
    }

    /// The codec that implements the method at this width, if the catalogue has one.
    pub fn codec(&self, bits: u32) -> Option<&'static AnyCodec> {
        let id = match self.name {
            "FPNV" | "FPNV_half" if bits == 48 => "float16x3".to_owned(),
            _ => format!("{}{bits}{}", self.family, self.suffix),
        };
        find(&id).ok()
    }
}

/// Random directions of the first step, at most.
const RANDOM: usize = 500_000;
/// Directions around each known worst place, at most.
const AROUND: usize = 20_000;
/// Directions that the second step starts from.
const STARTS: usize = 64;
/// Neighbours of each direction that a round of the second step tries.
const NEIGHBOURS: usize = 64;
/// Rounds of the second step; each halves the distance of the neighbours every fourth round.
const ROUNDS: i32 = 40;

/// The largest error found, in degrees, and the direction that has it.
///
/// The search tries random directions and those within a few cells of where a mapping is stretched most: octant
/// middles, axes, face and edge middles of the cube, the equator: `count` of each at most, so that who asks for few waits for
/// few. It then moves the worst by steps from two cells down.
///
/// # Errors
/// Any error of the backend.
pub fn worst_error(
    backend: &mut dyn Backend,
    codec: &AnyCodec,
    count: usize,
    seed: u64,
) -> Result<(f64, [f32; 3])> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    // Side of a cell if all were equal.
    let cell = (4.0 * PI / 2f64.powi(codec.bits as i32)).sqrt();
    let mut first: Vec<[f32; 3]> =
        sampling::random_directions(codec.domain, seed).take(RANDOM.min(count)).collect();
    for place in known_places(&mut random) {
        let reach = (4.0 * cell).min(1.0);
        first.extend((0..AROUND.min(count)).map(|_| moved(place, reach, codec.domain, &mut random)));
    }
    let mut best = errors(backend, codec, &first)?;
    keep_worst(&mut best);
    for round in 0..ROUNDS {
        let reach = 2.0 * cell * 0.5f64.powi(round / 4);
        let neighbours: Vec<[f32; 3]> = best
            .iter()
            .flat_map(|(_, v)| std::iter::repeat_n(*v, NEIGHBOURS))
            .map(|v| moved(v, reach, codec.domain, &mut random))
            .collect();
        best.extend(errors(backend, codec, &neighbours)?);
        keep_worst(&mut best);
    }
    Ok(best[0])
}

/// The largest error, in degrees, of vectors along `v` as far off unit length as codecs take for it: up to 2^-21.
///
/// # Errors
/// Any error of the backend.
pub fn worst_length(backend: &mut dyn Backend, codec: &AnyCodec, v: [f32; 3]) -> Result<f64> {
    let lengths = [-4, -3, -2, -1, 0, 1, 2, 3, 4].map(|steps| 1.0 + steps as f32 * f32::EPSILON);
    let errors = errors(backend, codec, &lengths.map(|length| v.map(|c| length * c)))?;
    Ok(errors.into_iter().fold(0.0, |worst, (error, _)| worst.max(error)))
}

/// Octant middles, axes, edge middles, and some of the equator.
fn known_places(random: &mut impl Rng) -> Vec<[f32; 3]> {
    let mut places = Vec::new();
    for n in 0..27 {
        let place = [n % 3, n / 3 % 3, n / 9].map(|c| c as f32 - 1.0);
        if place != [0.0; 3] {
            places.push(place);
        }
    }
    places.extend((0..8).map(|_| {
        let angle: f64 = random.random_range(0.0..2.0 * PI);
        [angle.cos() as f32, angle.sin() as f32, 0.0]
    }));
    places
}

/// A direction up to about `reach` radians from `v`, in the domain.
fn moved(v: [f32; 3], reach: f64, domain: Domain, random: &mut impl Rng) -> [f32; 3] {
    let v = Vec3::from(v).as_dvec3();
    let by = DVec3::from_array(std::array::from_fn(|_| random.random_range(-reach..reach)));
    let w = v / v.length() + by;
    let [x, y, z] = (w / w.length()).as_vec3().to_array();
    if domain == Domain::Hemisphere { [x, y, z.abs()] } else { [x, y, z] }
}

fn errors(backend: &mut dyn Backend, codec: &AnyCodec, vectors: &[[f32; 3]]) -> Result<Vec<(f64, [f32; 3])>> {
    let mut errors = Vec::with_capacity(vectors.len());
    let floats = vectors.as_flattened().iter().copied();
    let vector = |v: &[f32]| [v[0], v[1], v[2]];
    round_trip(backend, codec, floats, vectors.len(), |v, decoded| {
        errors.push((angle_deg(vector(v), vector(decoded)), vector(v)));
    })?;
    Ok(errors)
}

/// Keeps the [`STARTS`] worst, the worst first.
fn keep_worst(errors: &mut Vec<(f64, [f32; 3])>) {
    // Sorting all of the first step's million would take a fifth of the search.
    if errors.len() > STARTS {
        let mut degrees: Vec<f64> = errors.iter().map(|(error, _)| *error).collect();
        let (_, least, _) = degrees.select_nth_unstable_by(STARTS - 1, |a, b| b.total_cmp(a));
        errors.retain(|(error, _)| error.total_cmp(least).is_ge());
    }
    errors.sort_by(|a, b| b.0.total_cmp(&a.0));
    errors.truncate(STARTS);
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitvec_run::backend::Cpu;

    /// The second row of the table, as printed, follows from the first and the equations; SC is as the table has it.
    #[test]
    fn bounds_are_the_printed_formulas() {
        for bits in [16f64, 24.0, 32.0] {
            let printed = [
                32f64.sqrt() / 3.0 * (bits / 6.0).exp2(),
                SQRT_2 / 3.0 * (bits / 2.0 - 10.0).exp2(),
                (1.0 + bits / 4.0).exp2(),
                2.0 * 6f64.sqrt(),
                2.0 * PI,
                PI,
                4.0,
                3.0 * SQRT_2,
                2.0 * SQRT_2,
            ];
            for (method, printed) in METHODS.iter().zip(printed) {
                let ratio = method.bound(bits) / (printed * scale(bits));
                assert!((ratio - 1.0).abs() < 1e-12, "{}: {ratio}", method.name);
            }
        }
    }

    /// The equations are the angles of the vectors that they are derived from, and first order is their limit.
    #[test]
    fn equations_are_the_angles_of_cells() {
        let angle = |a: DVec3, b: DVec3| a.cross(b).length().atan2(a.dot(b));
        // On the sphere, of x and y: PP's cell ends at the equator, SPP's at the diagonal.
        let lifted = |x: f64, y: f64| DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt());
        for e in [0.1, 0.01] {
            let (third, diagonal) = (1.0 / 3.0, 1.0 / 3f64.sqrt());
            let inside = 0.5f64.sqrt() - 0.5 * e;
            let (sin, cos) = (0.5 * PI * e).sin_cos();
            let expected = [
                angle(DVec3::splat(0.5 + 0.5 * e), DVec3::new(0.5 + e, 0.5, 0.5)),
                angle(lifted(inside, inside), DVec3::new(1.0, 1.0, 0.0)),
                angle(lifted(diagonal - 0.5 * e, diagonal - 0.5 * e), DVec3::ONE),
                angle(DVec3::X, DVec3::new(cos * cos, cos * sin, sin)),
                angle(DVec3::Z, DVec3::new(0.5 * e, 0.5 * e, 1.0)),
                angle(DVec3::splat(third), DVec3::new(third + 0.5 * e, third + 0.5 * e, third - e)),
            ];
            let methods = ["FPNV", "PP", "SPP", "SC_eq5", "CM", "ONV_domain"];
            for (name, expected) in methods.into_iter().zip(expected) {
                let method = METHODS.iter().find(|method| method.name == name).unwrap();
                let ratio = (method.exact.unwrap())(e) / expected;
                assert!((ratio - 1.0).abs() < 1e-9, "{name}: {ratio}");
                let tiny = 1e-5;
                let limit = (method.exact.unwrap())(tiny) / (method.first_order)(tiny);
                assert!((limit - 1.0).abs() < 1e-4, "{name}: {limit}");
            }
        }
    }

    /// The third row of the table, worked out by Meyer et al. for 48 bits.
    #[test]
    fn bounds_at_48_bits_are_the_published_ones() {
        let published = [
            None,
            Some(4.60e-4),
            Some(4.88e-4),
            Some(2.92e-7),
            Some(3.74e-7),
            // Eq. 5: half of that.
            Some(1.87e-7),
            Some(2.38e-7),
            Some(2.53e-7),
            Some(1.69e-7),
        ];
        for (method, published) in METHODS.iter().zip(published) {
            if let Some(published) = published {
                let ratio = method.bound(48.0) / published;
                assert!((ratio - 1.0).abs() < 3e-3, "{}: {ratio}", method.name);
            }
        }
    }

    /// The search comes to within 0.5 % of the bound, and not above, where the bound is tight: in the octant's middle.
    #[test]
    fn the_search_finds_the_worst_place_of_oct16p() {
        let method = METHODS.iter().find(|method| method.name == "ONV_range").unwrap();
        let (found, _) = worst_error(&mut Cpu, method.codec(16).unwrap(), 1_000_000, 1).unwrap();
        // Meyer's cell is 2 2^(-b/2); ours, 1 / 127, is a little larger.
        let bound = method.bound(16.0).to_degrees() * 128.0 / 127.0;
        assert!(found > 0.995 * bound && found < bound, "{found} of {bound}");
    }
}
