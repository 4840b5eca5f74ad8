//! The projections without rounding: GLSL has Rust's bits, and both are those of the oracle, written from the papers.

use super::floats::{Project, pairs, vectors};
use super::{assert_same_bits, assert_same_words};
use unitvec::azimuthal::{self, Concentric, Ellipse, Eqarea, Eqdist, Plain, Stereo};
use unitvec::glam::{UVec3, Vec2, Vec3};
use unitvec::{cylindrical, eaoct, hemioct, oct, soct, spherical, uoct};
use unitvec_oracle::azimuthal as azimuthal64;
use unitvec_oracle::{
    Cylindrical, EaOct, HemiOct, Oct, Oracle, Spherical, angle_deg, join_halves, length, normalize,
    soct as soct64,
};
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::{near_planes, sphere};
use unitvec_tests::tested::{Tested, widen};

/// A projection in Rust and in the oracle. A pair has 0 as its third; others have the hemisphere there.
pub struct Projection {
    name: &'static str,
    /// The file of its functions.
    pub file: &'static str,
    is_pair: bool,
    project: fn([f32; 3]) -> [f32; 3],
    unproject: fn([f32; 3]) -> Vec3,
    project_unorm: fn([f32; 3]) -> [f32; 3],
    unproject_unorm: fn([f32; 3]) -> Vec3,
    position: fn([f64; 3]) -> [f64; 2],
    direction: fn([f64; 2]) -> [f64; 3],
}

fn pair(e: [f32; 3]) -> Vec2 {
    Vec2::new(e[0], e[1])
}

macro_rules! of_pairs {
    ($name:literal, $family:ident, $oracle:ty) => {
        Projection {
            name: $name,
            file: concat!($name, ".glsl"),
            is_pair: true,
            project: |v| $family::project(v.into()).extend(0.0).to_array(),
            unproject: |e| $family::unproject(pair(e)),
            project_unorm: |v| $family::project_unorm(v.into()).extend(0.0).to_array(),
            unproject_unorm: |e| $family::unproject_unorm(pair(e)),
            position: <$oracle>::position,
            direction: <$oracle>::direction,
        }
    };
}

macro_rules! of_disks {
    ($name:literal, $projection:ident, $map:ident, $of:ident, $by:ident) => {
        Projection {
            name: $name,
            file: "azimuthal.glsl",
            is_pair: false,
            project: |v| azimuthal::project::<$projection, $map>(v.into()).to_array(),
            unproject: |e| azimuthal::unproject::<$projection, $map>(e.into()),
            project_unorm: |v| azimuthal::project_unorm::<$projection, $map>(v.into()).to_array(),
            unproject_unorm: |e| azimuthal::unproject_unorm::<$projection, $map>(e.into()),
            position: azimuthal64::Azimuthal::<{ azimuthal64::$of }, { azimuthal64::$by }>::position,
            direction: azimuthal64::Azimuthal::<{ azimuthal64::$of }, { azimuthal64::$by }>::direction,
        }
    };
}

/// All projections.
pub const PROJECTIONS: [Projection; 15] = [
    of_pairs!("oct", oct, Oct),
    of_pairs!("eaoct", eaoct, EaOct),
    of_pairs!("hemioct", hemioct, HemiOct),
    of_pairs!("spherical", spherical, Spherical),
    of_pairs!("cylindrical", cylindrical, Cylindrical),
    Projection {
        name: "soct",
        file: "soct.glsl",
        is_pair: false,
        project: |v| soct::project(v.into()).to_array(),
        unproject: |e| soct::unproject(e.into()),
        project_unorm: |v| soct::project_unorm(v.into()).to_array(),
        unproject_unorm: |e| soct::unproject_unorm(e.into()),
        position: |v| soct64::position(v).0,
        direction: HemiOct::direction,
    },
    of_disks!("stereo", Stereo, Plain, STEREO, PLAIN),
    of_disks!("stereo_concentric", Stereo, Concentric, STEREO, CONCENTRIC),
    of_disks!("stereo_ellipse", Stereo, Ellipse, STEREO, ELLIPSE),
    of_disks!("eqarea", Eqarea, Plain, EQAREA, PLAIN),
    of_disks!("eqarea_concentric", Eqarea, Concentric, EQAREA, CONCENTRIC),
    of_disks!("eqarea_ellipse", Eqarea, Ellipse, EQAREA, ELLIPSE),
    of_disks!("eqdist", Eqdist, Plain, EQDIST, PLAIN),
    of_disks!("eqdist_concentric", Eqdist, Concentric, EQDIST, CONCENTRIC),
    of_disks!("eqdist_ellipse", Eqdist, Ellipse, EQDIST, ELLIPSE),
];

impl Projection {
    /// The names of its functions: to the square and back, on [-1, 1] and on [0, 1].
    pub fn functions(&self) -> [String; 4] {
        let name = self.name;
        [
            format!("float32x3_to_{name}"),
            format!("{name}_to_float32x3"),
            format!("float32x3_to_{name}_unorm"),
            format!("{name}_unorm_to_float32x3"),
        ]
    }

    /// The calls for [`assert_same_bits`], one for each function.
    fn calls(&self) -> [String; 4] {
        let [to, from, to_unorm, from_unorm] = self.functions();
        if self.is_pair {
            let of_pair = |name: String| format!("vec3({name}(v), 0.0)");
            [of_pair(to), format!("{from}(v.xy)"), of_pair(to_unorm), format!("{from_unorm}(v.xy)")]
        } else {
            [to, from, to_unorm, from_unorm].map(|name| format!("{name}(v)"))
        }
    }

    /// The direction of a position on the square and, but for pairs, its hemisphere, in `f64`.
    fn direction(&self, e: [f64; 3]) -> [f64; 3] {
        let beyond = e[0].hypot(e[1]);
        let is_disk = ["stereo", "eqarea", "eqdist"].contains(&self.name);
        let scale = if is_disk && beyond > 1.0 { 1.0 / beyond } else { 1.0 };
        let [x, y, z] = normalize((self.direction)([e[0] * scale, e[1] * scale]));
        [x, y, if !self.is_pair && e[2] >= 0.5 { -z } else { z }]
    }
}

/// Points of the square of all kinds, with a third of all kinds.
fn points() -> Vec<[f32; 3]> {
    let thirds = [0.0, 1.0, 1.0 / 3.0, 2.0 / 3.0, f32::NAN, -1.0];
    pairs().into_iter().enumerate().map(|(n, [x, y, _])| [x, y, thirds[n % 6]]).collect()
}

/// Projections agree for any vectors, and for any points.
#[test]
fn projections_in_glsl_have_the_bits_of_rust() {
    let (vectors, points) = (vectors(), points());
    for group in PROJECTIONS.chunks(5) {
        let (mut projected, mut unprojected) = (Vec::new(), Vec::new());
        for projection in group {
            let [to, from, to_unorm, from_unorm] = projection.calls();
            projected.extend([(to, projection.project), (to_unorm, projection.project_unorm)]);
            unprojected.extend([(from, projection.unproject), (from_unorm, projection.unproject_unorm)]);
        }
        assert_same_bits(&projected, &vectors);
        assert_same_bits(&unprojected, &points);
    }
}

/// A function of three floats.
type OfFloats = fn([f32; 3]) -> Vec3;

/// The precise functions and listing 5 agree, too.
#[test]
fn precise_values_and_bytes_in_glsl_have_the_bits_of_rust() {
    let (vectors, pairs) = (vectors(), pairs());
    let precise: [(&str, u32, Project); 13] = [
        ("oct", 4, oct::project_precise::<4>),
        ("oct", 10, oct::project_precise::<10>),
        ("oct", 16, oct::project_precise::<16>),
        ("oct", 24, oct::project_precise::<24>),
        ("oct", 32, oct::project_precise::<32>),
        ("eaoct", 16, eaoct::project_precise::<16>),
        ("eaoct", 24, eaoct::project_precise::<24>),
        ("eaoct", 32, eaoct::project_precise::<32>),
        ("uoct", 16, uoct::project_precise::<16>),
        ("uoct", 20, uoct::project_precise::<20>),
        ("uoct", 32, uoct::project_precise::<32>),
        ("hemioct", 16, hemioct::project_precise::<16>),
        ("hemioct", 32, hemioct::project_precise::<32>),
    ];
    let precise = precise.map(|(family, bits, in_rust)| {
        let call = format!("vec3(float32x3_to_{family}n_precise(v, {bits}), 0.0)");
        (call, move |v: [f32; 3]| in_rust(v.into()).extend(0.0))
    });
    assert_same_bits(&precise, &vectors);
    let listings: [(String, OfFloats); 4] = [
        ("snorm12x2_to_unorm8x3(v.xy)".into(), |f| oct::snorm12x2_to_unorm8x3(pair(f))),
        ("vec3(unorm8x3_to_snorm12x2(v), 0.0)".into(), |u| oct::unorm8x3_to_snorm12x2(u.into()).extend(0.0)),
        ("vec3(octn_to_unorm(v.xy, 20), 0.0)".into(), |f| oct::to_unorm::<20>(pair(f)).extend(0.0)),
        ("vec3(unorm_to_octn(v.xy, 20), 0.0)".into(), |u| oct::from_unorm::<20>(pair(u)).extend(0.0)),
    ];
    assert_same_bits(&listings, &pairs);
    let bits: Vec<[u32; 3]> = pairs.iter().map(|f| f.map(f32::to_bits)).collect();
    let to_bytes = |w: [u32; 3]| oct::snorm12x2_to_uint8x3(pair(w.map(f32::from_bits))).to_array();
    assert_same_words(&[("snorm12x2_to_uint8x3(v.xy)".to_owned(), to_bytes)], &bits);
    let bytes: Vec<[u32; 3]> = bits.iter().map(|w| to_bytes(*w)).collect();
    for (input, bytes) in pairs.iter().zip(&bytes) {
        let parts = oct::snorm12x2_to_unorm8x3(pair(*input));
        assert_eq!(parts.to_array(), bytes.map(|byte| byte as f32 / 255.0), "{input:?}");
    }
    let call = "uvec3(floatBitsToUint(uint8x3_to_snorm12x2(w)), 0u)".to_owned();
    let from_bytes = |w| {
        let e = oct::uint8x3_to_snorm12x2(UVec3::from_array(w));
        [e.x.to_bits(), e.y.to_bits(), 0]
    };
    assert_same_words(&[(call, from_bytes)], &[bytes, bits].concat());
}

/// Listing 4 in the plain form: shifts and masks of integers, as in docs/formats.md, for every pair of snorm12.
#[test]
fn bytes_are_those_of_listing_4() {
    for code in 0..1u32 << 24 {
        let bytes = UVec3::new(code & 255, (code >> 8) & 255, code >> 16);
        let [u, v] = [bytes.x << 4 | bytes.y >> 4, (bytes.y & 15) << 8 | bytes.z];
        if u < 4095 && v < 4095 {
            let f = oct::uint8x3_to_snorm12x2(bytes);
            assert_eq!(f, (Vec2::new(u as f32, v as f32) - 2047.0) / 2047.0);
            assert_eq!(oct::snorm12x2_to_uint8x3(f), bytes);
        }
    }
}

/// The distance from the exact position on the square, and in degrees from the direction. The ellipse's corners, where
/// its way back to the square has a pole, and a cylinder's poles move more in one of the two.
const POSITION: f64 = 6e-7;
const DEGREES: f64 = 4e-5;

/// A position near the exact one, or one of the same direction: a fold has several of these.
#[test]
fn projections_are_the_oracles() {
    for projection in PROJECTIONS {
        for v in sphere(41, 20_000).chain(near_planes(42, 20_000)) {
            let v = if projection.name == "hemioct" { Vec3::new(v.x, v.y, v.z.abs()) } else { v };
            let e = (projection.project)(v.to_array()).map(f64::from);
            let exact = (projection.position)(widen(v));
            let is_near = (0..2).all(|i| (e[i] - exact[i]).abs() <= POSITION);
            let off = angle_deg(projection.direction(e), normalize(widen(v)));
            assert!(is_near || off <= DEGREES, "{} of {v}: {e:?} for {exact:?}", projection.name);
            assert!(e.iter().all(|c| c.abs() <= 1.0 + LENGTH_ROUNDING), "{} of {v}: {e:?}", projection.name);
            assert!(
                projection.is_pair || e[2] == f64::from(u8::from(v.z < 0.0)),
                "{} of {v}",
                projection.name
            );
        }
    }
}

/// Unit vectors, of any point: that of the clamped one.
#[test]
fn points_have_the_oracles_directions() {
    for projection in PROJECTIONS {
        for e in points() {
            let decoded = widen((projection.unproject)(e));
            assert!(
                (length(decoded) - 1.0).abs() <= 1.5 * LENGTH_ROUNDING,
                "{} of {e:?}: {decoded:?}",
                projection.name
            );
            let clamp = |x: f32| f64::from(x.clamp(-1.0, 1.0));
            let [x, y] = if e[0].is_nan() || e[1].is_nan() { [0.0; 2] } else { [clamp(e[0]), clamp(e[1])] };
            let expected = projection.direction([x, y, f64::from(e[2])]);
            let off = angle_deg(decoded, expected);
            assert!(off <= DEGREES, "{} of {e:?}: {decoded:?}, expected {expected:?}", projection.name);
            assert!(projection.name != "hemioct" || decoded[2] >= 0.0, "{e:?}: {decoded:?}");
        }
    }
}

/// The result is the direction, on [-1, 1] and on [0, 1]. Near a cylinder's pole a rounding of z is its square root.
#[test]
fn directions_come_back() {
    for projection in PROJECTIONS {
        for v in sphere(43, 20_000) {
            let v = if projection.name == "hemioct" { Vec3::new(v.x, v.y, v.z.abs()) } else { v };
            let most = if projection.name == "cylindrical" { 0.03 } else { 1e-4 };
            let of = |back: Vec3| angle_deg(widen(back), normalize(widen(v)));
            let v = v.to_array();
            let off = of((projection.unproject)((projection.project)(v)));
            let off_unorm = of((projection.unproject_unorm)((projection.project_unorm)(v)));
            assert!(off.max(off_unorm) <= most, "{} of {v:?}: {off}, {off_unorm}", projection.name);
        }
    }
}

/// The claim of docs/formats.md on the codes in formats: projections that are linear on the codec's lattice give the
/// fast codec's code, or another one of the same direction, but for at most 3 in 1000; others give other codes.
#[test]
fn formats_hold_the_codes_that_the_docs_say() {
    let cases = [
        ("oct", 16, true),
        ("oct", 32, true),
        ("hemioct", 16, true),
        ("hemioct", 32, true),
        ("cylindrical", 16, true),
        ("cylindrical", 32, true),
        ("eaoct", 16, false),
        ("eaoct", 32, false),
        ("spherical", 16, false),
        ("spherical", 32, false),
    ];
    for (name, bits, is_the_codecs) in cases {
        let projection = PROJECTIONS.iter().find(|projection| projection.name == name).unwrap();
        let codec = Tested::find(&format!("{name}{bits}"));
        let m = f64::from(unitvec::arith::snorm_max(bits / 2));
        let differs = |v: &Vec3| {
            let e = (projection.project)(v.to_array());
            let held = [e[0], e[1]].map(|x| (f64::from(x) * m).round_ties_even() as i64);
            codec.decode(join_halves(held, bits)) != codec.decode(codec.encode(*v))
        };
        let vectors =
            sphere(45, 50_000).map(|v| if name == "hemioct" { Vec3::new(v.x, v.y, v.z.abs()) } else { v });
        let in_1000 = vectors.filter(differs).count() as f64 / 50.0;
        assert!(
            if is_the_codecs { in_1000 <= 3.0 } else { in_1000 > 50.0 },
            "{name}{bits}: {in_1000} in 1000"
        );
    }
}

/// The octahedron and 10 bits a component with the sign in two bits, as VK_FORMAT_A2B10G10R10_UNORM_PACK32 holds them.
#[test]
fn soct_fits_ten_ten_ten_two() {
    let bound = 1.5f64.sqrt().atan2(1023.0 / 2.0).to_degrees();
    for v in sphere(44, 50_000) {
        let e = soct::project_unorm(v);
        let held = Vec3::new(
            (e.x * 1023.0).round() / 1023.0,
            (e.y * 1023.0).round() / 1023.0,
            (e.z * 3.0).round() / 3.0,
        );
        let off = angle_deg(widen(soct::unproject_unorm(held)), normalize(widen(v)));
        assert!(off <= bound, "{v}: {off} degrees");
    }
}
