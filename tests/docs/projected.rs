//! Errors of directions in formats that the hardware rounds to, as docs/formats.md has them.

use super::markdown_table;
use super::tables::degrees;
use unitvec::azimuthal::{self, Ellipse, Eqarea};
use unitvec::glam::{Vec2, Vec3};
use unitvec::{cylindrical, eaoct, hemioct, oct, soct, spherical};
use unitvec_oracle::{angle_deg, normalize};
use unitvec_tests::directions::sphere;
use unitvec_tests::repository;
use unitvec_tests::tested::widen;

/// A projection, a format, and the decoded vector of a vector through it.
type Row = (&'static str, &'static str, fn(Vec3) -> Vec3);

/// A number on a format's steps: `most` is the integer of 1.
fn held(x: f32, most: f64) -> f32 {
    ((f64::from(x) * most).round_ties_even() / most) as f32
}

fn pair(e: Vec2, most: f64) -> Vec2 {
    Vec2::new(held(e.x, most), held(e.y, most))
}

/// Two components, and a third that is 0 or 1.
fn triple(e: Vec3, most: f64) -> Vec3 {
    Vec3::new(held(e.x, most), held(e.y, most), e.z)
}

const ROWS: [Row; 14] = [
    ("oct", "R8G8_SNORM", |v| oct::unproject(pair(oct::project(v), 127.0))),
    ("oct", "R8G8_UNORM", |v| oct::unproject_unorm(pair(oct::project_unorm(v), 255.0))),
    ("oct", "A2B10G10R10_SNORM_PACK32", |v| oct::unproject(pair(oct::project(v), 511.0))),
    ("oct", "A2B10G10R10_UNORM_PACK32", |v| oct::unproject_unorm(pair(oct::project_unorm(v), 1023.0))),
    ("oct", "R16G16_SNORM", |v| oct::unproject(pair(oct::project(v), 32767.0))),
    ("oct", "R16G16_UNORM", |v| oct::unproject_unorm(pair(oct::project_unorm(v), 65535.0))),
    ("eaoct", "R8G8_SNORM", |v| eaoct::unproject(pair(eaoct::project(v), 127.0))),
    ("eaoct", "R8G8_UNORM", |v| eaoct::unproject_unorm(pair(eaoct::project_unorm(v), 255.0))),
    ("hemioct", "R8G8_UNORM", |v| {
        hemioct::unproject_unorm(pair(hemioct::project_unorm(Vec3::new(v.x, v.y, v.z.abs())), 255.0))
    }),
    ("soct", "A2B10G10R10_UNORM_PACK32", |v| soct::unproject_unorm(triple(soct::project_unorm(v), 1023.0))),
    ("spherical", "R8G8_SNORM", |v| spherical::unproject(pair(spherical::project(v), 127.0))),
    ("spherical", "R8G8_UNORM", |v| spherical::unproject_unorm(pair(spherical::project_unorm(v), 255.0))),
    ("cylindrical", "R8G8_UNORM", |v| {
        cylindrical::unproject_unorm(pair(cylindrical::project_unorm(v), 255.0))
    }),
    ("eqarea_ellipse", "A2B10G10R10_UNORM_PACK32", |v| {
        azimuthal::unproject_unorm::<Eqarea, Ellipse>(triple(
            azimuthal::project_unorm::<Eqarea, Ellipse>(v),
            1023.0,
        ))
    }),
];

/// The error of a vector, in degrees; for a hemisphere, the error of the vector's image in it.
fn off(name: &str, v: Vec3, back: Vec3) -> f64 {
    let v = if name == "hemioct" { Vec3::new(v.x, v.y, v.z.abs()) } else { v };
    angle_deg(widen(back), normalize(widen(v)))
}

/// Mean and largest error, and the largest of the six axes.
fn measured((name, _, trip): Row, count: usize) -> [f64; 3] {
    let (mut sum, mut max) = (0.0, 0f64);
    for v in sphere(71, count) {
        let off = off(name, v, trip(v));
        (sum, max) = (sum + off, max.max(off));
    }
    let axes = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    [sum / count as f64, max, axes.map(|v| off(name, v, trip(v))).fold(0.0, f64::max)]
}

/// Measures what the docs state.
#[test]
#[ignore = "`cargo xtask renew errors` runs it"]
fn measure() {
    let mut text = String::from("projection,format,mean_deg,max_deg,axes_deg\n");
    for row in ROWS {
        let [mean, max, axes] = measured(row, 1 << 20);
        text += &format!("{},{},{mean:.6e},{max:.6e},{axes:.6e}\n", row.0, row.1);
    }
    unitvec_files::write_file(&repository().join("docs/data/projected.csv"), text.as_bytes()).unwrap();
}

/// The committed measurements: mean, maximum and axes, in the order of [`ROWS`].
fn recorded() -> Vec<[f64; 3]> {
    let rows = super::recorded::<(String, String, f64, f64, f64)>("projected.csv").into_iter();
    let rows = rows.zip(ROWS).map(|((name, format, mean, max, axes), row)| {
        assert_eq!((&*name, &*format), (row.0, row.1));
        [mean, max, axes]
    });
    rows.collect()
}

/// The table of docs/formats.md.
pub fn table() -> String {
    let rows = recorded().into_iter().zip(ROWS).map(|([mean, max, axes], (name, format, _))| {
        let axes = if axes < 1e-4 { "0".to_owned() } else { degrees(axes) };
        format!("`{name}` | `{format}` | {} | {} | {axes}", degrees(mean), degrees(max))
    });
    markdown_table("projection | format | mean error | maximum | worst of the axes", rows)
}

/// +Z as the pair of a UNORM of `most` steps next to the middle, by listing 2: `atan(sqrt(2) a / (1 - 2 a))` off with a = 1 / most.
#[test]
fn a_unorm_pair_misses_the_axes_by_half_a_step() {
    for (row, most) in [(1, 255.0), (3, 1023.0), (5, 65535.0)] {
        let a = 1.0 / most;
        let expected = (2f64.sqrt() * a).atan2(1.0 - 2.0 * a).to_degrees();
        let [mean, max, axes] = recorded()[row];
        assert!((axes / expected - 1.0).abs() < 0.02, "{most}: {axes} degrees, expected {expected}");
        // Steps are a little finer than those of the SNORM, which has a code less.
        let [snorm_mean, snorm_max, snorm_axes] = recorded()[row - 1];
        assert!(
            (0.99..1.002).contains(&(mean / snorm_mean)) && (0.97..1.02).contains(&(max / snorm_max)),
            "{most}"
        );
        assert!(snorm_axes < 1e-4, "{most}: {snorm_axes}");
    }
}

/// A smaller sample agrees with the committed measurements.
#[test]
fn projected_errors_are_as_recorded() {
    for (row, committed) in ROWS.into_iter().zip(recorded()) {
        let fresh = measured(row, 20_000);
        let agrees = (fresh[0] / committed[0] - 1.0).abs() < 0.02 && fresh[1] <= 1.01 * committed[1];
        assert!(agrees, "{} in {}: {committed:?} committed, {fresh:?} measured", row.0, row.1);
    }
}
