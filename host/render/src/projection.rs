//! Projections, whose numbers the hardware rounds, instead of a codec's functions.

use super::storage::Storage;
use unitvec::azimuthal::{self, Ellipse, Eqarea};
use unitvec::glam::Vec3;
use unitvec::{cylindrical, eaoct, hemioct, oct, soct, spherical};
use unitvec_catalogue::AnyCodec;

/// A projection of the shaders, and the same on the CPU.
#[derive(Debug)]
pub struct Projection {
    /// The module's name: `oct_snorm`, `oct_unorm`, `oct16p_snorm`.
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
    /// A position on the lattice of a codec of these bits, by precise rounding.
    Precise(u32),
}

/// A row of [`PROJECTIONS`]: of two numbers, or of two and of 0 or 1.
macro_rules! row {
    (pair $family:literal $suffix:literal, $kind:expr, $project:expr, $unproject:expr) => {
        row!($family $suffix, $kind, Storage::Pair, |v| $project(v).extend(0.0), |e| $unproject(e.truncate()))
    };
    (pair_and_bit $family:literal $suffix:literal, $kind:expr, $project:expr, $unproject:expr) => {
        row!($family $suffix, $kind, Storage::PairAndBit, $project, $unproject)
    };
    ($family:literal $suffix:literal, $kind:expr, $storage:expr, $project:expr, $unproject:expr) => {
        Projection {
            name: concat!($family, $suffix),
            family: $family,
            kind: $kind,
            storage: $storage,
            project: $project,
            unproject: $unproject,
        }
    };
}

/// All projections of the shaders. One azimuthal family stands for all, which differ in [`unitvec`] alone.
pub const PROJECTIONS: &[Projection] = &[
    row!(pair "oct" "_snorm", Kind::Snorm, oct::project, oct::unproject),
    row!(pair "oct" "_unorm", Kind::Unorm, oct::project_unorm, oct::unproject_unorm),
    row!(pair "oct" "16p_snorm", Kind::Precise(16), oct::project_precise::<16>, oct::unproject),
    row!(pair "oct" "32p_snorm", Kind::Precise(32), oct::project_precise::<32>, oct::unproject),
    row!(pair "hemioct" "_snorm", Kind::Snorm, hemioct::project, hemioct::unproject),
    row!(pair "hemioct" "_unorm", Kind::Unorm, hemioct::project_unorm, hemioct::unproject_unorm),
    row!(pair "hemioct" "16p_snorm", Kind::Precise(16), hemioct::project_precise::<16>, hemioct::unproject),
    row!(pair "hemioct" "32p_snorm", Kind::Precise(32), hemioct::project_precise::<32>, hemioct::unproject),
    row!(pair "eaoct" "_snorm", Kind::Snorm, eaoct::project, eaoct::unproject),
    row!(pair "eaoct" "_unorm", Kind::Unorm, eaoct::project_unorm, eaoct::unproject_unorm),
    row!(pair "eaoct" "16p_snorm", Kind::Precise(16), eaoct::project_precise::<16>, eaoct::unproject),
    row!(pair "eaoct" "32p_snorm", Kind::Precise(32), eaoct::project_precise::<32>, eaoct::unproject),
    row!(pair "spherical" "_snorm", Kind::Snorm, spherical::project, spherical::unproject),
    row!(pair "spherical" "_unorm", Kind::Unorm, spherical::project_unorm, spherical::unproject_unorm),
    row!(pair "cylindrical" "_snorm", Kind::Snorm, cylindrical::project, cylindrical::unproject),
    row!(pair "cylindrical" "_unorm", Kind::Unorm, cylindrical::project_unorm, cylindrical::unproject_unorm),
    row!(pair_and_bit "soct" "_snorm", Kind::Snorm, soct::project, soct::unproject),
    row!(pair_and_bit "soct" "_unorm", Kind::Unorm, soct::project_unorm, soct::unproject_unorm),
    row!(
        pair_and_bit "eqarea_ellipse" "_snorm", Kind::Snorm,
        azimuthal::project::<Eqarea, Ellipse>,
        azimuthal::unproject::<Eqarea, Ellipse>
    ),
    row!(
        pair_and_bit "eqarea_ellipse" "_unorm", Kind::Unorm,
        azimuthal::project_unorm::<Eqarea, Ellipse>,
        azimuthal::unproject_unorm::<Eqarea, Ellipse>
    ),
];

impl Projection {
    /// The projection of this name; `None` where there is none.
    pub fn find(name: &str) -> Option<&'static Self> {
        PROJECTIONS.iter().find(|projection| projection.name == name)
    }

    /// The projection that a codec of two snorm rounds; `None` for other codecs, and for those without a projection.
    pub fn of(format: &AnyCodec) -> Option<&'static Self> {
        if !matches!(Storage::of(format), Storage::Snorm8x2 | Storage::Snorm16x2) {
            return None;
        }
        [format.id, format.family].iter().find_map(|name| Self::find(&format!("{name}_snorm")))
    }

    /// The projection's numbers for a vector, on the CPU; the third is for alpha.
    pub fn project(&self, v: [f32; 3]) -> [f32; 3] {
        (self.project)(v.into()).to_array()
    }

    /// The unit vector of its numbers, on the CPU.
    pub fn unproject(&self, e: [f32; 3]) -> [f32; 3] {
        (self.unproject)(e.into()).to_array()
    }

    /// True for numbers on [0, 1].
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

    /// The projection's functions in GLSL, by the macro that names them.
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
    use unitvec_catalogue::{CODECS, find};

    #[test]
    fn codecs_of_two_snorm_have_their_projection() {
        let named = |id: &str| Projection::of(find(id).unwrap()).map(|projection| projection.name);
        assert_eq!(named("oct16"), Some("oct_snorm"));
        assert_eq!(named("oct32p"), Some("oct32p_snorm"));
        assert_eq!(named("eaoct16p"), Some("eaoct16p_snorm"));
        assert_eq!(named("hemioct32"), Some("hemioct_snorm"));
        assert_eq!(named("hemioct32p"), Some("hemioct32p_snorm"));
        // Three bytes; no projection; another format.
        assert_eq!([named("oct24"), named("xyonly16"), named("spherical16")], [None; 3]);
        assert_eq!(CODECS.iter().filter(|format| Projection::of(format).is_some()).count(), 14);
    }
}
