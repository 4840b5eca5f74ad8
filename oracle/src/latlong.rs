//! Numbered patches between circles of latitude.

use super::Oracle;
use super::spherical::{around, at, azimuth, colatitude};
use std::sync::OnceLock;

/// The plain grid. Positions are colatitude and azimuth in half turns.
pub struct LatLong;

impl Oracle for LatLong {
    fn position(v: [f64; 3]) -> [f64; 2] {
        [colatitude(v), azimuth(v)]
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        at(e[0], e[1])
    }

    /// Ring and patch.
    fn unpack(code: u64, bits: u32) -> [i64; 2] {
        let count = 1 << (bits / 2);
        [(code / count % count) as i64, (code % count) as i64]
    }

    fn pack(point: [i64; 2], bits: u32) -> u64 {
        let [ring, patch] = point.map(|i| i as u64);
        (ring << (bits / 2)) + patch
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        let count = 2f64.powi(bits as i32 / 2);
        let [ring, patch] = Self::unpack(code, bits).map(|i| (i as f64 + 0.5) / count);
        at(ring, 2.0 * patch)
    }

    /// The patch that the direction is in.
    fn encode(v: [f64; 3], bits: u32) -> u64 {
        let count = 1 << (bits / 2);
        let [ring, turn] = [colatitude(v), azimuth(v) / 2.0].map(|t| (t * count as f64).floor() as i64);
        Self::pack([ring.min(count - 1), turn.rem_euclid(count)], bits)
    }
}

/// The distances, in rings and patches, of the middle of the code's patch from `v`.
pub fn grid_steps_off(v: [f64; 3], code: u64, bits: u32) -> [f64; 2] {
    let count = 2f64.powi(bits as i32 / 2);
    let [ring, patch] = LatLong::unpack(code, bits).map(|i| i as f64 + 0.5);
    [(colatitude(v) * count - ring).abs(), around(azimuth(v) * count / 2.0, patch, count)]
}

/// Half the diagonal of a patch at the equator, in degrees.
pub fn grid_bound_deg(bits: u32) -> f64 {
    5f64.sqrt() * 90.0 / 2f64.powi(bits as i32 / 2)
}

/// The format of rings, `latlong…d`.
pub struct LatLongD;

/// The rings of a format. The middle of ring i is `i / rings` of a quarter turn from +-Z; `starts[i]` is the index of
/// its first patch.
pub struct Rings {
    /// Rings from pole to equator.
    pub last: usize,
    /// The index of each ring's first patch, and the count of all.
    pub starts: Vec<u32>,
}

/// The definition of the format: bits, rings from pole to equator, and the coefficients of where the rings start.
const FORMATS: [(u32, usize, [f32; 3]); 3] = [
    (16, 113, [0.7756357, -1.244649e-5, 7.392083e-11]),
    (24, 1782, [0.81366533, -5.2502063e-8, 1.2538275e-15]),
    (32, 29225, [0.7753543, -1.8601036e-10, 1.6516002e-20]),
];

/// The starts of the rings of `bits` bits, in `f32`. The crate's linear part, of i - 1/2, rounds to the same starts for
/// every ring.
pub fn rings(bits: u32) -> &'static Rings {
    find_rings(bits).unwrap_or_else(|| panic!("latlong{bits}d is not defined"))
}

/// The rings of `bits` bits, where there is such a format.
pub fn find_rings(bits: u32) -> Option<&'static Rings> {
    static RINGS: [OnceLock<Rings>; FORMATS.len()] = [const { OnceLock::new() }; FORMATS.len()];
    let width = FORMATS.iter().position(|format| format.0 == bits)?;
    let (_, last, a) = FORMATS[width];
    let start = |i: usize| {
        let u = (i as f32 - 0.5) * (i as f32 - 0.5);
        (u * (a[0] + u * (a[1] + u * a[2])) + (0.95 * i as f32 + 0.25)).floor() as u32
    };
    Some(RINGS[width].get_or_init(|| Rings { last, starts: (0..=last + 1).map(start).collect() }))
}

impl Rings {
    /// Patches of ring `i` in a quarter turn.
    pub fn count(&self, i: usize) -> u32 {
        self.starts[i + 1] - self.starts[i]
    }

    /// The greatest angle between the middle of a patch and a corner, in degrees, of all rings: by the haversine.
    pub fn farthest_corner_deg(&self) -> f64 {
        let step = std::f64::consts::FRAC_PI_2 / self.last as f64;
        let corner = |i: usize| {
            let middle = step * i as f64;
            let half_width = std::f64::consts::FRAC_PI_4 / f64::from(self.count(i));
            let to = |edge: f64| {
                let haversine = ((edge - middle) / 2.0).sin().powi(2)
                    + edge.sin() * middle.sin() * (half_width / 2.0).sin().powi(2);
                2.0 * haversine.sqrt().asin()
            };
            to((middle - step / 2.0).max(0.0)).max(to(middle + step / 2.0))
        };
        (0..=self.last).map(corner).fold(0.0, f64::max).to_degrees()
    }

    /// The place of a code's patch: hemisphere, quarter, ring and patch.
    fn place(&self, code: u64, bits: u32) -> (u32, u32, usize, u32) {
        let (unit, code) = (1 << (bits - 3), code as u32);
        let index = code % unit;
        let ring = self.starts.partition_point(|&start| start <= index) - 1;
        (code / unit / 4 % 2, code / unit % 4, ring, index - self.starts[ring])
    }
}

impl Oracle for LatLongD {
    fn position(v: [f64; 3]) -> [f64; 2] {
        LatLong::position(v)
    }

    fn direction(e: [f64; 2]) -> [f64; 3] {
        at(e[0], e[1])
    }

    fn decode(code: u64, bits: u32) -> [f64; 3] {
        let rings = rings(bits);
        let (hemisphere, quarter, ring, patch) = rings.place(code, bits);
        let azimuth = (f64::from(quarter) + f64::from(patch) / f64::from(rings.count(ring))) / 2.0;
        let [x, y, z] = at(ring as f64 / rings.last as f64 / 2.0, azimuth);
        [x, y, if hemisphere == 0 { z } else { -z }]
    }

    /// The patch that the direction is in: rings and patches have their middles on whole numbers.
    fn encode(v: [f64; 3], bits: u32) -> u64 {
        let rings = rings(bits);
        let from_pole = colatitude([v[0], v[1], v[2].abs()]);
        let ring = (from_pole * 2.0 * rings.last as f64).round() as usize;
        let count = rings.count(ring);
        let turn = (azimuth(v) * 2.0 * f64::from(count)).round() as i64;
        let patch = turn.rem_euclid(4 * i64::from(count)) as u32;
        let (quarter, hemisphere) = (patch / count, u32::from(v[2] < 0.0));
        let index = rings.starts[ring] + patch % count;
        u64::from((hemisphere << (bits - 1)) | (quarter << (bits - 3)) | index)
    }
}

/// The distances, in rings and patches, of the middle of the code's patch from `v`. At a pole the patch does not count.
pub fn steps_off(v: [f64; 3], code: u64, bits: u32) -> [f64; 2] {
    let rings = rings(bits);
    let (hemisphere, quarter, ring, patch) = rings.place(code, bits);
    let from_pole = colatitude([v[0], v[1], if hemisphere == 0 { v[2] } else { -v[2] }]);
    let count = f64::from(rings.count(ring));
    let middle = f64::from(quarter) * count + f64::from(patch);
    let patch_off = around(azimuth(v) * 2.0 * count, middle, 4.0 * count);
    [(from_pole * 2.0 * rings.last as f64 - ring as f64).abs(), if ring > 0 { patch_off } else { 0.0 }]
}
