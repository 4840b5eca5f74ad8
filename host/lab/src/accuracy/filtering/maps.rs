//! The maps whose components are blended, and what channels hold of these.

use glam::DVec3;
use std::f64::consts::FRAC_PI_4;
use unitvec_catalogue::Domain;
use unitvec_oracle::azimuthal::{Azimuthal, CONCENTRIC, ELLIPSE, EQAREA, EQDIST, PLAIN, STEREO};
use unitvec_oracle::{Cylindrical, EaOct, HemiOct, Oct, Oracle, Spherical, raw};

/// The components of a direction, in [-1, 1], and the number of the chart that they lie in: a hemisphere or the face of a cube.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub at: DVec3,
    pub chart: usize,
}

/// What a channel holds of a component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Channel {
    /// The component itself.
    Exact,
    /// An snorm of so many bits.
    Snorm(u32),
    /// A unorm of so many bits, for [-1, 1].
    Unorm(u32),
    /// A half float.
    Half,
}

impl Channel {
    fn stored(self, x: f64) -> f64 {
        match self {
            Self::Exact => x,
            Self::Snorm(bits) => (x * raw::snorm_max(bits)).round() / raw::snorm_max(bits),
            Self::Unorm(bits) => {
                let half = f64::from((1u32 << bits) - 1) / 2.0;
                ((x + 1.0) * half).round() / half - 1.0
            }
            Self::Half => raw::half(raw::half_code(x.abs())).copysign(x),
        }
    }

    /// `exact`, `snorm8`, `unorm10`, `half`.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase().replace(['(', ')'], "")
    }
}

/// A map of directions to components that hardware can blend.
#[derive(Debug)]
pub struct Map {
    /// The family's name; `xyz` for the vector itself.
    pub name: &'static str,
    /// The directions that it has components for.
    pub domain: Domain,
    /// The channels to measure it in.
    pub channels: &'static [Channel],
    place: fn(DVec3) -> Place,
    pub(super) direction: fn(Place) -> DVec3,
}

use Channel::{Exact, Half, Snorm, Unorm};
const PAIR: &[Channel] = &[Exact, Snorm(8), Snorm(16)];
const WITH_UNORM: &[Channel] = &[Exact, Snorm(8), Snorm(16), Unorm(8), Unorm(10), Unorm(16)];
const WITH_SIGN: &[Channel] = &[Exact, Unorm(10)];

fn flat([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

/// A map to one square.
const fn square<O: Oracle>(name: &'static str, domain: Domain, channels: &'static [Channel]) -> Map {
    let place = |v: DVec3| Place { at: flat(O::position(v.to_array())), chart: 0 };
    Map { name, domain, channels, place, direction: |place| O::direction([place.at.x, place.at.y]).into() }
}

/// A map of (x, y, |z|) to one square, beside the sign of z.
const fn signed<O: Oracle>(name: &'static str) -> Map {
    let place =
        |v: DVec3| Place { at: flat(O::position([v.x, v.y, v.z.abs()])), chart: usize::from(v.z < 0.0) };
    let direction = |place: Place| {
        let v: DVec3 = O::direction([place.at.x, place.at.y]).into();
        if place.chart == 1 { v.with_z(-v.z) } else { v }
    };
    Map { name, domain: Domain::Sphere, channels: WITH_SIGN, place, direction }
}

/// A cube's faces, by number beside the two coordinates.
const fn cube<const WARPED: bool>(name: &'static str) -> Map {
    let place = |v: DVec3| {
        let axis = v.abs().max_position();
        let at = [1, 2].map(|next| v[(axis + next) % 3] / v[axis].abs());
        let at = if WARPED { at.map(|t| t.atan() / FRAC_PI_4) } else { at };
        Place { at: flat(at), chart: 2 * axis + usize::from(v[axis] < 0.0) }
    };
    let direction = |Place { at, chart }: Place| {
        let at = if WARPED { at.map(|t| (FRAC_PI_4 * t).tan()) } else { at };
        let mut v = DVec3::ZERO;
        v[chart / 2] = if chart % 2 == 0 { 1.0 } else { -1.0 };
        (v[(chart / 2 + 1) % 3], v[(chart / 2 + 2) % 3]) = (at.x, at.y);
        v
    };
    Map { name, domain: Domain::Sphere, channels: &[Exact], place, direction }
}

/// The maps whose components hardware can blend. Other codecs number their points, or share words out: no filter takes them.
pub static MAPS: [Map; 19] = [
    Map {
        name: "xyz",
        domain: Domain::Sphere,
        channels: &[Exact, Snorm(8), Snorm(10), Snorm(16), Unorm(8), Half],
        place: |v| Place { at: v, chart: 0 },
        direction: |place| place.at,
    },
    Map {
        name: "xyonly",
        domain: Domain::Hemisphere,
        channels: &[Exact, Snorm(8), Snorm(16), Half],
        place: |v| Place { at: v.with_z(0.0), chart: 0 },
        direction: |place| place.at.with_z((1.0 - place.at.length_squared()).max(0.0).sqrt()),
    },
    square::<HemiOct>("hemioct", Domain::Hemisphere, WITH_UNORM),
    signed::<HemiOct>("soct"),
    square::<Oct>("oct", Domain::Sphere, WITH_UNORM),
    square::<EaOct>("eaoct", Domain::Sphere, PAIR),
    signed::<Azimuthal<STEREO, PLAIN>>("stereo"),
    signed::<Azimuthal<STEREO, CONCENTRIC>>("stereo_concentric"),
    signed::<Azimuthal<STEREO, ELLIPSE>>("stereo_ellipse"),
    signed::<Azimuthal<EQAREA, PLAIN>>("eqarea"),
    signed::<Azimuthal<EQAREA, CONCENTRIC>>("eqarea_concentric"),
    signed::<Azimuthal<EQAREA, ELLIPSE>>("eqarea_ellipse"),
    signed::<Azimuthal<EQDIST, PLAIN>>("eqdist"),
    signed::<Azimuthal<EQDIST, CONCENTRIC>>("eqdist_concentric"),
    signed::<Azimuthal<EQDIST, ELLIPSE>>("eqdist_ellipse"),
    square::<Spherical>("spherical", Domain::Sphere, PAIR),
    square::<Cylindrical>("cylindrical", Domain::Sphere, PAIR),
    cube::<false>("cube"),
    cube::<true>("warpedcube"),
];

impl Map {
    /// The map of a family.
    pub fn find(name: &str) -> Option<&'static Self> {
        MAPS.iter().find(|map| map.name == name)
    }

    /// What a texel holds.
    pub(super) fn stored(&self, v: DVec3, channel: Channel) -> Place {
        let Place { at, chart } = (self.place)(v);
        Place { at: at.map(|x| channel.stored(x)), chart }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Components are stored to half a step, or half a unit in the last place; the ends are exact.
    #[test]
    fn channels_round_to_nearest() {
        let all = [
            (Snorm(8), 1.0 / 127.0),
            (Snorm(16), 1.0 / 32767.0),
            (Unorm(8), 2.0 / 255.0),
            (Half, 2f64.powi(-11)),
        ];
        for (channel, step) in all {
            let off = |x: f64| (channel.stored(x) - x).abs();
            let most = (-1000..=1000).map(|n| off(f64::from(n) / 1000.0)).fold(0.0, f64::max);
            assert!((0.4..0.5 + 1e-9).contains(&(most / step)), "{channel:?}: {most}");
            assert_eq!([-1.0, 1.0].map(off), [0.0; 2], "{channel:?}");
        }
    }
}
