//! Projections, whose numbers the hardware rounds, instead of a codec's functions.

use super::storage::Storage;
use crate::catalogue::AnyCodec;
use unitvec::azimuthal::{self, Ellipse, Eqarea};
use unitvec::glam::Vec3;
use unitvec::{cylindrical, eaoct, hemioct, oct, soct, spherical};

/// A projection of the shaders, and the same on the CPU.
#[derive(Debug)]
pub struct Projection {
    /// Its module's name: `oct_snorm`, `oct_unorm`, `oct16p_snorm`.
    pub name: &'static str,
    /// The family in the names of its functions.
    family: &'static str,
    kind: Kind,
    pub(super) storage: Storage,
    project: fn(Vec3) -> Vec3,
    unproject: fn(Vec3) -> Vec3,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Snorm,
    Unorm,
    /// On the lattice of a codec of these bits, by precise rounding.
    Precise(u32),
}

/// A row of [`PROJECTIONS`] of two numbers.
macro_rules! pair {
    ($name:literal, $family:literal, $kind:expr, $project:expr, $unproject:expr) => {
        Projection {
            name: $name,
            family: $family,
            kind: $kind,
            storage: Storage::Pair,
            project: |v| $project(v).extend(0.0),
            unproject: |e| $unproject(e.truncate()),
        }
    };
}

/// One of two numbers, and of 0 or 1.
macro_rules! pair_and_bit {
    ($name:literal, $family:literal, $kind:expr, $project:expr, $unproject:expr) => {
        Projection {
            name: $name,
            family: $family,
            kind: $kind,
            storage: Storage::PairAndBit,
            project: $project,
            unproject: $unproject,
        }
    };
}

/// All that the shaders have. Of the azimuthal families one stands for all, which differ in what [`unitvec`] computes alone.
pub const PROJECTIONS: &[Projection] = &[
    pair!("oct_snorm", "oct", Kind::Snorm, oct::project, oct::unproject),
    pair!("oct_unorm", "oct", Kind::Unorm, oct::project_unorm, oct::unproject_unorm),
    pair!("oct16p_snorm", "oct", Kind::Precise(16), oct::project_precise::<16>, oct::unproject),
    pair!("oct32p_snorm", "oct", Kind::Precise(32), oct::project_precise::<32>, oct::unproject),
    pair!("hemioct_snorm", "hemioct", Kind::Snorm, hemioct::project, hemioct::unproject),
    pair!("hemioct_unorm", "hemioct", Kind::Unorm, hemioct::project_unorm, hemioct::unproject_unorm),
    pair!("eaoct_snorm", "eaoct", Kind::Snorm, eaoct::project, eaoct::unproject),
    pair!("eaoct_unorm", "eaoct", Kind::Unorm, eaoct::project_unorm, eaoct::unproject_unorm),
    pair!("eaoct16p_snorm", "eaoct", Kind::Precise(16), eaoct::project_precise::<16>, eaoct::unproject),
    pair!("eaoct32p_snorm", "eaoct", Kind::Precise(32), eaoct::project_precise::<32>, eaoct::unproject),
    pair!("spherical_snorm", "spherical", Kind::Snorm, spherical::project, spherical::unproject),
    pair!("spherical_unorm", "spherical", Kind::Unorm, spherical::project_unorm, spherical::unproject_unorm),
    pair!("cylindrical_snorm", "cylindrical", Kind::Snorm, cylindrical::project, cylindrical::unproject),
    pair!(
        "cylindrical_unorm",
        "cylindrical",
        Kind::Unorm,
        cylindrical::project_unorm,
        cylindrical::unproject_unorm
    ),
    pair_and_bit!("soct_snorm", "soct", Kind::Snorm, soct::project, soct::unproject),
    pair_and_bit!("soct_unorm", "soct", Kind::Unorm, soct::project_unorm, soct::unproject_unorm),
    pair_and_bit!(
        "eqarea_ellipse_snorm",
        "eqarea_ellipse",
        Kind::Snorm,
        azimuthal::project::<Eqarea, Ellipse>,
        azimuthal::unproject::<Eqarea, Ellipse>
    ),
    pair_and_bit!(
        "eqarea_ellipse_unorm",
        "eqarea_ellipse",
        Kind::Unorm,
        azimuthal::project_unorm::<Eqarea, Ellipse>,
        azimuthal::unproject_unorm::<Eqarea, Ellipse>
    ),
];

impl Projection {
    /// The one of a name; `None` where there is none.
    pub fn find(name: &str) -> Option<&'static Self> {
        PROJECTIONS.iter().find(|projection| projection.name == name)
    }

    /// The projection that a codec of two snorm rounds; `None` for other codecs, and for those of no projection.
    pub fn of(format: &AnyCodec) -> Option<&'static Self> {
        if !matches!(Storage::of(format), Storage::Snorm8x2 | Storage::Snorm16x2) {
            return None;
        }
        [format.id, format.family].iter().find_map(|name| Self::find(&format!("{name}_snorm")))
    }

    /// Its numbers of a vector, on the CPU; the third is alpha's.
    pub fn project(&self, v: [f32; 3]) -> [f32; 3] {
        (self.project)(v.into()).to_array()
    }

    /// The unit vector of its numbers, on the CPU.
    pub fn unproject(&self, e: [f32; 3]) -> [f32; 3] {
        (self.unproject)(e.into()).to_array()
    }

    /// True of numbers on [0, 1].
    pub fn is_unorm(&self) -> bool {
        self.kind == Kind::Unorm
    }

    /// True where it has a third number, for alpha.
    pub fn has_bit(&self) -> bool {
        self.storage == Storage::PairAndBit
    }

    /// The bits of the only format that its numbers are made for, if they are.
    pub fn precise_bits(&self) -> Option<u32> {
        match self.kind {
            Kind::Precise(bits) => Some(bits),
            Kind::Snorm | Kind::Unorm => None,
        }
    }

    /// Its functions in GLSL, by the macro that names them.
    pub(super) fn macros(&self) -> Vec<(&'static str, String)> {
        let Self { family, kind, .. } = self;
        let unorm = if *kind == Kind::Unorm { "_unorm" } else { "" };
        let decode = ("DECODE", format!("{family}{unorm}_to_float32x3"));
        match kind {
            Kind::Snorm | Kind::Unorm => vec![("ENCODE", format!("float32x3_to_{family}{unorm}")), decode],
            Kind::Precise(bits) => vec![
                ("ENCODE", format!("float32x3_to_{family}n_precise")),
                ("PRECISE_BITS", bits.to_string()),
                decode,
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{CODECS, find};

    #[test]
    fn codecs_of_two_snorm_have_their_projection() {
        let named = |id: &str| Projection::of(find(id).unwrap()).map(|projection| projection.name);
        assert_eq!(named("oct16"), Some("oct_snorm"));
        assert_eq!(named("oct32p"), Some("oct32p_snorm"));
        assert_eq!(named("eaoct16p"), Some("eaoct16p_snorm"));
        assert_eq!(named("hemioct32"), Some("hemioct_snorm"));
        // Three bytes; no projection; another format.
        assert_eq!([named("oct24"), named("xyonly16"), named("spherical16")], [None; 3]);
        assert_eq!(CODECS.iter().filter(|format| Projection::of(format).is_some()).count(), 12);
    }

    /// A vector comes back, and numbers lie in the range of their kind.
    #[test]
    fn projections_come_back() {
        let v = [0.48, -0.6, 0.64];
        for projection in PROJECTIONS {
            let e = projection.project(v);
            let least = if projection.is_unorm() { 0.0 } else { -1.0 };
            assert!(e.iter().all(|x| (least..=1.0).contains(x)), "{}: {e:?}", projection.name);
            let back = projection.unproject(e);
            let off = (0..3).map(|at| (back[at] - v[at]).abs()).fold(0.0, f32::max);
            assert!(off < 0.02, "{}: {back:?}", projection.name);
            assert!(projection.has_bit() || e[2] == 0.0);
        }
    }
}
