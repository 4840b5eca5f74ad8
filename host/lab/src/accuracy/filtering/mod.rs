//! What filters do to codes: components blended and then decoded, beside the same blend of the vectors.
//!
//! Three errors are kept apart: that of the map, with components of unbounded precision ([`Channel::Exact`]); that of the
//! channels, with components rounded; and that of texels decoded first and blended then, which is the codec's own.

mod maps;

pub use maps::{Channel, MAPS, Map};

use glam::DVec3;
use maps::Channel::Exact;
use maps::Place;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use unitvec_catalogue::Domain;
use unitvec_oracle::angle_deg;
use unitvec_run::measure::ErrorStats;

/// A texel's vector and its weight. Weights add up to 1.
pub type Tap = (DVec3, f64);

impl Map {
    /// Degrees between the blend of the vectors and the decoded blend of their components. A chart cannot be blended: that of
    /// the most weight is taken, as the nearest texel, or a sign's threshold at half of its range, would give it.
    fn blended_deg(&self, channel: Channel, taps: &[Tap]) -> f64 {
        let (mut at, mut weights) = (DVec3::ZERO, [0.0; 6]);
        for (v, weight) in taps {
            let place = self.stored(*v, channel);
            at += *weight * place.at;
            weights[place.chart] += weight;
        }
        let chart = (1..6).fold(0, |most, next| if weights[next] > weights[most] { next } else { most });
        // A sum of weights may pass 1 by a rounding.
        let at = at.clamp(DVec3::NEG_ONE, DVec3::ONE);
        off_deg(taps, (self.direction)(Place { at, chart }))
    }

    /// Degrees between the blend of the vectors and that of the decoded texels.
    fn decoded_deg(&self, channel: Channel, taps: &[Tap]) -> f64 {
        let decoded = |v: DVec3| (self.direction)(self.stored(v, channel)).normalize();
        off_deg(taps, taps.iter().map(|(v, weight)| *weight * decoded(*v)).sum())
    }

    /// The error in degrees of the midpoint, of exact components, of two neighbours so many degrees apart: the mean over
    /// `count` lines through the middle.
    pub fn midpoint_deg(&self, middle: DVec3, degrees: f64, count: u32) -> f64 {
        let turn = |n: u32| f64::from(n) / f64::from(count) * PI;
        let error =
            |n| self.blended_deg(Exact, &Field::new(self.domain, middle, turn(n), degrees).midpoint());
        (0..count).map(error).sum::<f64>() / f64::from(count)
    }
}

fn off_deg(taps: &[Tap], found: DVec3) -> f64 {
    let blend: DVec3 = taps.iter().map(|(v, weight)| *weight * *v).sum();
    angle_deg(blend.to_array(), found.to_array())
}

/// Directions over a plane of texels, about the one in the middle: a unit along any line through it turns them by `step`.
/// Those below a hemisphere are mirrored into it.
struct Field {
    domain: Domain,
    middle: DVec3,
    axes: [DVec3; 2],
    step: f64,
}

impl Field {
    fn new(domain: Domain, middle: DVec3, turn: f64, degrees: f64) -> Self {
        let ((a, b), (sin, cos)) = (middle.any_orthonormal_pair(), turn.sin_cos());
        Self { domain, middle, axes: [cos * a + sin * b, cos * b - sin * a], step: degrees.to_radians() }
    }

    fn at(&self, x: f64, y: f64) -> DVec3 {
        let way = x * self.axes[0] + y * self.axes[1];
        let (sin, cos) = (self.step * way.length()).sin_cos();
        let v = cos * self.middle + sin * way.normalize_or_zero();
        if self.domain == Domain::Hemisphere { v.with_z(v.z.abs()) } else { v }
    }

    /// A texel of the next mip: the mean of four vectors, made a direction.
    fn coarse(&self, x: f64, y: f64) -> DVec3 {
        let sum: DVec3 = [-0.5, 0.5].iter().flat_map(|i| [-0.5, 0.5].map(|j| self.at(x + i, y + j))).sum();
        sum.normalize()
    }

    fn midpoint(&self) -> Vec<Tap> {
        vec![(self.at(-0.5, 0.0), 0.5), (self.at(0.5, 0.0), 0.5)]
    }

    /// The texels that a sample takes in the square of texels about the middle, and where `level` is not 0 in the next mip.
    fn filtered(&self, [x, y]: [f64; 2], level: f64) -> Vec<Tap> {
        let mut taps = bilinear([x, y], 1.0 - level, |i, j| self.at(i - 0.5, j - 0.5));
        if level > 0.0 {
            // The next mip's texels lie 2 apart, one of them on the middle.
            let place = [x, y].map(|t| (t - 0.5) / 2.0);
            taps.extend(bilinear(place, level, |i, j| self.coarse(2.0 * i, 2.0 * j)));
        }
        taps
    }
}

/// The four texels about a place, which share the weight. Both fractions have 8 bits, as `subTexelPrecisionBits` usually is.
pub fn bilinear([x, y]: [f64; 2], weight: f64, texel: impl Fn(f64, f64) -> DVec3) -> Vec<Tap> {
    let (left, top) = (x.floor(), y.floor());
    let [a, b] = [x - left, y - top].map(in_256);
    let row = |j, share| [(texel(left, top + j), share * (1.0 - a)), (texel(left + 1.0, top + j), share * a)];
    [row(0.0, weight * (1.0 - b)), row(1.0, weight * b)].concat()
}

fn in_256(t: f64) -> f64 {
    (256.0 * t).round() / 256.0
}

/// Which texels a sample blends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sample {
    /// Two, half and half.
    Midpoint,
    /// Four, at a random place between them.
    Bilinear,
    /// Four and four of the next mip.
    Trilinear,
}

/// Where neighbours lie.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Region {
    /// Anywhere in the map's domain.
    Domain,
    /// Across the planes in which maps crease or end, of the axes and between the faces of a cube: half of them near an axis or
    /// a diagonal.
    Edges,
    /// About a middle with z of at least 0.3, as in a normal map.
    Cap,
}

impl Region {
    /// A random middle of neighbours so many degrees apart.
    fn middle(self, random: &mut impl Rng, domain: Domain, degrees: f64) -> DVec3 {
        let low = match (self, domain) {
            (Self::Edges, _) => return across_edge(random, domain, degrees),
            (Self::Cap, _) => 0.3,
            (Self::Domain, Domain::Hemisphere) => 0.0,
            (Self::Domain, Domain::Sphere) => -1.0,
        };
        let (z, turn): (f64, f64) = (random.random_range(low..1.0), random.random_range(0.0..TAU));
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * turn.cos(), radius * turn.sin(), z)
    }
}

/// A point of one of the planes, moved by up to half of the neighbours' distance.
fn across_edge(random: &mut impl Rng, domain: Domain, degrees: f64) -> DVec3 {
    let (axis, mut normal) = (random.random_range(0..3), DVec3::ZERO);
    normal[axis] = 1.0;
    normal[(axis + 1) % 3] = f64::from(random.random_range(-1..=1));
    let (a, b) = normal.normalize().any_orthonormal_pair();
    let turn = random.random_range(0.0..TAU);
    let turn = if random.random() { turn } else { (turn / FRAC_PI_4).round() * FRAC_PI_4 };
    let field = Field::new(domain, turn.cos() * a + turn.sin() * b, random.random_range(0.0..TAU), degrees);
    field.at(random.random_range(0.0..0.5), 0.0)
}

/// Errors of the samples of a map.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Row {
    /// The map: a family's name, or `xyz` for the vector itself.
    pub map: &'static str,
    /// What a channel holds: `exact`, `snorm8`, `unorm10`, `half`.
    pub channel: String,
    /// Where neighbours lie.
    pub region: Region,
    /// Which texels a sample blends.
    pub sample: Sample,
    /// Degrees between neighbours.
    pub apart_deg: f64,
    /// Mean error of components blended and then decoded, degrees, to the same blend of the vectors.
    pub mean_deg: f64,
    /// Maximum of it, degrees.
    pub max_deg: f64,
    /// The share of samples that tear: beyond the error of texels decoded first, they are off by more than twice the distance
    /// of neighbours, in the coarser mip where there are two.
    pub torn: f64,
    /// Mean error of texels decoded and then blended, degrees.
    pub decoded_mean_deg: f64,
    /// Maximum of it, degrees.
    pub decoded_max_deg: f64,
}

/// A map, what its channels hold, where neighbours lie, which of them are blended, and the degrees between them.
pub type Case<'a> = (&'a Map, Channel, Region, Sample, f64);

impl Row {
    /// Measures `count` samples. Of one seed all maps and channels have the same.
    pub fn measure((map, channel, region, sample, apart_deg): Case<'_>, count: usize, seed: u64) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let tear = if sample == Sample::Trilinear { 4.0 * apart_deg } else { 2.0 * apart_deg };
        let (mut blended, mut decoded, mut torn) = (ErrorStats::default(), ErrorStats::default(), 0.0);
        for _ in 0..count {
            let middle = region.middle(&mut random, map.domain, apart_deg);
            let field = Field::new(map.domain, middle, random.random_range(0.0..TAU), apart_deg);
            let [x, y, level] = [(); 3].map(|()| random.random_range(0.0..1.0));
            let taps = match sample {
                Sample::Midpoint => field.midpoint(),
                Sample::Bilinear => field.filtered([x, y], 0.0),
                Sample::Trilinear => field.filtered([x, y], in_256(level)),
            };
            let error = map.blended_deg(channel, &taps);
            let own = if channel == Exact { 0.0 } else { map.decoded_deg(channel, &taps) };
            blended.add(error);
            decoded.add(own);
            torn += if error > own + tear { 1.0 } else { 0.0 };
        }
        let (map, channel, torn) = (map.name, channel.name(), torn / count.max(1) as f64);
        let [mean_deg, decoded_mean_deg] = [&blended, &decoded].map(ErrorStats::mean_deg);
        let [max_deg, decoded_max_deg] = [&blended, &decoded].map(ErrorStats::max_deg);
        Self {
            map,
            channel,
            region,
            sample,
            apart_deg,
            mean_deg,
            max_deg,
            torn,
            decoded_mean_deg,
            decoded_max_deg,
        }
    }
}

/// Degrees between neighbours in the table.
pub const APART: [f64; 6] = [0.1, 0.3, 1.0, 3.0, 10.0, 30.0];

/// Measures a map: its exact components in all regions, what channels hold over the domain.
pub fn measure(map: &Map, count: usize, seed: u64) -> Vec<Row> {
    let mut cases = Vec::new();
    for &channel in map.channels {
        let regions = [Region::Domain, Region::Edges, Region::Cap];
        for region in regions.into_iter().take(if channel == Exact { 3 } else { 1 }) {
            for sample in [Sample::Midpoint, Sample::Bilinear, Sample::Trilinear] {
                cases.extend(APART.map(|apart| (map, channel, region, sample, apart)));
            }
        }
    }
    cases.into_par_iter().map(|case| Row::measure(case, count, seed)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(name: &str) -> &'static Map {
        Map::find(name).unwrap()
    }

    fn measured(name: &str, region: Region, sample: Sample) -> Row {
        Row::measure((map(name), Exact, region, sample, 1.0), 100_000, 1)
    }

    /// The error of the midpoint, of exact components, of (a, y, z) and its mirror image about the axis, for 2 a between them.
    fn across_deg(name: &str, axis: usize, v: [f64; 3]) -> f64 {
        let (a, mut b) = (DVec3::from(v), DVec3::from(v));
        b[axis] = -b[axis];
        map(name).blended_deg(Exact, &[(a.normalize(), 0.5), (b.normalize(), 0.5)])
    }

    /// With h half the distance, the chord's middle is cos h long. Lifted to the sphere, its z of cos h cos t becomes
    /// sqrt(sin^2 h + cos^2 h cos^2 t), at t from the pole, whichever way the neighbours lie: to leading order the error is
    /// h^2 / 2 tan t, at the rim h. The mean of that over z from z0 to 1 is h^2 / 2 (ln((1 + s) / z0) - s) / (1 - z0), with
    /// s = sqrt(1 - z0^2). Vectors have no error.
    #[test]
    fn xy_errs_by_the_height_of_the_chord() {
        let h = 0.5f64.to_radians();
        for (t, turn) in [(0.3f64, 0.0), (1.0, 0.7), (1.5, 1.3)] {
            let middle = DVec3::new(t.sin(), 0.0, t.cos());
            let midpoint = Field::new(Domain::Hemisphere, middle, turn, 1.0).midpoint();
            let error = map("xyonly").blended_deg(Exact, &midpoint).to_radians();
            let lifted = (h.sin().powi(2) + (h.cos() * t.cos()).powi(2)).sqrt().atan2(h.cos() * t.sin());
            assert!((error / (lifted + t - PI / 2.0) - 1.0).abs() < 1e-6, "{t}: {error}");
        }
        let s = 0.91f64.sqrt();
        let mean = (h * h / 2.0 * ((((1.0 + s) / 0.3).ln() - s) / 0.7)).to_degrees();
        let found = measured("xyonly", Region::Cap, Sample::Midpoint).mean_deg;
        assert!((found / mean - 1.0).abs() < 0.01, "{found} {mean}");
        assert!(measured("xyz", Region::Edges, Sample::Trilinear).max_deg < 1e-12);
    }

    /// Across x = 0, at t from the pole, hemioct blends (+-a, y, z) / (a + y + z) to (0, y, a + z): off by a sin t to leading
    /// order. Below the equator oct has both sides at two places of the square's border, and the middle between these on the
    /// equator, however close they are. The seam of angles puts the midpoint on the other side of the axis.
    #[test]
    fn midpoints_across_edges_are_the_formulas() {
        let (a, elevation) = (1e-5f64, 0.6f64.asin());
        for (names, axis, v, expected) in [
            ("hemioct soct oct", 0, [a, 0.8, 0.6], 0.8 * a),
            ("hemioct", 0, [a, 1.0, 0.0], a),
            ("xyonly", 1, [1.0, a, 0.0], a),
            ("oct eaoct", 0, [a, 0.8, -0.6], elevation),
            ("spherical cylindrical", 1, [-0.6, a, 0.8], 2.0 * elevation),
            ("xyonly stereo eqarea eqdist", 0, [a, 0.8, 0.6], 0.0),
        ] {
            for name in names.split(' ') {
                let error = across_deg(name, axis, v).to_radians();
                assert!((error - expected).abs() < 1e-3 * expected + 1e-9, "{name}: {error} {expected}");
            }
        }
    }

    /// Buffon's needle on the sphere: one of length d meets lines of total length L with the probability L d / (2 pi^2). oct
    /// tears along two half circles, the angles along one; maps of the hemisphere nowhere.
    #[test]
    fn shares_of_torn_samples_are_buffons() {
        for (name, half_circles) in [("oct", 2.0), ("eaoct", 2.0), ("cylindrical", 1.0)] {
            let expected = half_circles * PI * 1f64.to_radians() / (2.0 * PI * PI);
            let found = measured(name, Region::Domain, Sample::Midpoint).torn;
            assert!((found / expected - 1.0).abs() < 0.1, "{name}: {found} of {expected}");
        }
        for name in ["xyonly", "hemioct", "soct", "stereo", "eqarea_concentric"] {
            let samples = [Sample::Midpoint, Sample::Bilinear, Sample::Trilinear];
            assert!(
                samples.iter().all(|sample| measured(name, Region::Edges, *sample).torn == 0.0),
                "{name}"
            );
        }
    }
}
