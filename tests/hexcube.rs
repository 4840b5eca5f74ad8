//! The hexagonal cube codecs: one code a point, the choice of the point, the bound, layout.

use glam::Vec3;
use unitvec::{Codec, HexCube16};
use unitvec_oracle::ico::{bound_deg, circumcircle};
use unitvec_oracle::{Summary, angle_deg, difference, dot, hexcube};
use unitvec_tests::checks::{assert_bounded, assert_commutes, assert_decodes, assert_stable};
use unitvec_tests::directions::{Rng, near_diagonals, near_planes, sphere};
use unitvec_tests::expected::symmetries;
use unitvec_tests::tested::{Tested, narrow, widen};

/// The error in degrees that the rounding of the encoder and the decoder adds.
const ROUNDING: f64 = 1.5e-5;

/// The radius of the largest circumcircle at many bits, as a multiple of the covering bound.
const LARGEST: f64 = 1.0880;

/// The places of the largest circumcircles of a face.
const LARGEST_AT: f64 = 0.46;

/// Codes at the ends of rows and faces decode to the oracle's direction, and come back.
#[test]
fn ends_of_rows() {
    for codec in Tested::family("hexcube") {
        assert_decodes(&codec, ends(codec.bits), 1.0);
        assert_stable(&codec, ends(codec.bits));
    }
}

/// Each code comes back as itself, but for those past the last one: no two stand for the same point.
#[test]
fn a_point_has_one_code() {
    for codec in Tested::family("hexcube") {
        let last = hexcube::last(codec.bits);
        for code in codec.codes(2, 22).chain(ends(codec.bits)) {
            let again = codec.encode(codec.decode(code));
            assert_eq!(again, code.min(last), "{}: {code:#x}", codec.id);
        }
    }
}

/// Directions near faces' edges come back mirrored where they are.
#[test]
fn edges_are_symmetric() {
    for codec in Tested::family("hexcube") {
        assert_commutes(&codec, near_diagonals(11, 50_000), symmetries(&codec));
    }
}

/// The chosen point is the nearest of the face, or farther off by 7 % of the covering bound at most; in the middles of
/// faces' quadrants, where cells are largest, by 1.5 %. Beside the edges, the other face can have a much nearer one.
/// This adds to the mean 1e-4 of the bound at most; with the points over the edges, 4e-4 at 16 bits.
#[test]
fn encodes_a_near_point() {
    for codec in Tested::family("hexcube") {
        let (bits, radius) = (codec.bits, bound_deg(codec.bits).max);
        let off = |v: Vec3, point: fn([f64; 3], u32) -> [f64; 3]| {
            (codec.error_deg(v) - angle_deg(widen(v), point(widen(v), bits))) / radius
        };
        let edges = near_diagonals(5, 50_000).chain(near_planes(6, 50_000));
        let of_face = Summary::of(edges.chain(sphere(3, 200_000)).map(|v| off(v, hexcube::nearest)));
        let of_all = Summary::of(sphere(4, 200_000).map(|v| off(v, hexcube::nearest_of_all)));
        let largest = Summary::of(around_largest(7, 50_000, 0.02).map(|v| off(v, hexcube::nearest)));
        println!("{}: of the face {of_face:?}, of all {of_all:?}, largest {largest:?}", codec.id);
        let rounding = ROUNDING / radius;
        assert!(of_face.max <= 0.07 + rounding && of_face.mean <= 1e-4, "{}: {of_face:?}", codec.id);
        assert!(of_all.mean <= if bits == 16 { 4e-4 } else { 1e-4 }, "{}: {of_all:?}", codec.id);
        assert!(largest.max <= 0.015 + rounding, "{}: {largest:?}", codec.id);
    }
}

/// The circumcentres of neighbouring points near the largest are as far off as the docs derive, and no further. At 16
/// bits they are not the maximum.
#[test]
fn maximum_is_at_circumcentres() {
    for codec in Tested::family("hexcube") {
        let bits = codec.bits;
        let (mut exact, mut worst) = (0f64, 0f64);
        for corners in around_largest(8, 30_000, 0.02).flat_map(|v| triangles(widen(v), bits)) {
            let (centre, radius) = circumcircle(corners);
            exact = exact.max(radius);
            worst = worst.max(codec.error_deg(narrow(centre)));
        }
        let derived = LARGEST * bound_deg(bits).max;
        println!("{}: {worst:.7}, exact {exact:.7}, derived {derived:.7}", codec.id);
        // A face's edges and the patterns past the last point take some of the area.
        assert!((exact / derived - 1.0).abs() < if bits == 16 { 6e-3 } else { 6e-4 }, "{}", codec.id);
        assert!(worst > 0.999 * exact - ROUNDING && worst < 1.001 * exact + ROUNDING, "{}", codec.id);
        assert_bounded(&codec, worst);
        // To which the edges add.
        assert!(bits == 16 || f64::from(codec.max_error_deg()) < 1.01 * derived, "{}", codec.id);
    }
}

/// Directions on the faces' edges and beside them keep the bound, which at 16 bits is attained there to 2 %.
#[test]
fn edges_are_bounded() {
    for codec in Tested::family("hexcube") {
        let mut rng = Rng::new(9);
        let directions = (0..1_000_000).map(|k| {
            // A few columns in; on the edge itself every other time.
            let beside =
                if k % 2 == 0 { 0.0 } else { rng.unit() / 20.0 * 2f64.powi(8 - codec.bits as i32 / 2) };
            let along = rng.range(-1.0, 1.0);
            let place = if k % 4 < 2 { [1.0 - beside, along] } else { [along, 1.0 - beside] };
            narrow(hexcube::direction((rng.bits() % 6) as usize, place))
        });
        let worst = Summary::of(directions.map(|v| codec.error_deg(v))).max;
        println!("{}: {worst:.7} of {}", codec.id, codec.max_error_deg());
        assert_bounded(&codec, worst);
        assert!(codec.bits != 16 || worst > 0.98 * f64::from(codec.max_error_deg()), "{}: {worst}", codec.id);
    }
}

/// All triangles of neighbouring points are acute: so no direction among them is farther from all of these than the
/// centre of the largest circumcircle.
#[test]
fn triangles_are_acute() {
    for codec in Tested::family("hexcube") {
        for [a, b, c] in sphere(10, 100_000).flat_map(|v| triangles(widen(v), codec.bits)) {
            let corners = [[a, b, c], [b, c, a], [c, a, b]];
            let least = corners.map(|[a, b, c]| dot(difference(b, a), difference(c, a)));
            assert!(least.into_iter().all(|product| product > 0.0), "{}: {a:?} {b:?} {c:?}", codec.id);
        }
    }
}

/// Codes of the first and last rows of faces, those at the ends of all rows, and those past the last.
fn ends(bits: u32) -> impl Iterator<Item = u64> {
    let of = hexcube::lattice(bits);
    // The number of the first point of a row, from 0 to twice `of.rows`.
    let first = move |row: i64| (row * (2 * of.columns + 1) + 1) / 2;
    (0..6).flat_map(move |face| {
        let whole = (0..of.columns).flat_map(move |k| [k, of.points() - 1 - k]);
        let ends = (0..=2 * of.rows).flat_map(move |row| [first(row), first(row + 1) - 1]);
        let last =
            [hexcube::last(bits) as i64 + 1, (1 << bits) - 1].map(move |code| code - face * of.points());
        whole.chain(ends).chain(last).map(move |number| (face * of.points() + number) as u64)
    })
}

/// Unit vectors near the largest cells, by turns in each quadrant of each face.
fn around_largest(seed: u64, count: usize, radius: f64) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |k| {
        let signs = [k & 1, k >> 1 & 1].map(|bit| if bit == 0 { LARGEST_AT } else { -LARGEST_AT });
        narrow(hexcube::direction(k % 6, signs.map(|t| t + rng.range(-radius, radius))))
    })
}

/// The unit vectors of the corners of the two triangles of neighbouring points beside a direction, if the face has
/// them.
fn triangles(v: [f64; 3], bits: u32) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let (of, face) = (hexcube::lattice(bits), hexcube::face_of(v));
    let [x, y] = hexcube::position(v, face, bits).map(|t| t.floor() as i64);
    let [i, j] = [x - (x + y).rem_euclid(2), y];
    let triples = [[[i, j], [i + 2, j], [i + 1, j + 1]], [[i + 2, j], [i + 1, j + 1], [i + 3, j + 1]]];
    triples
        .into_iter()
        .filter(move |points| points.iter().all(|&point| of.has(point)))
        .map(move |points| points.map(|point| hexcube::point(face, point, bits)))
}

/// Faces, rows and columns in their order; the axes in the middles of faces.
#[test]
fn layout() {
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let middles = [0, 1, 2, 3, 4, 5].map(|face| face * 10_905 + 5_452);
    assert_eq!(axes.map(HexCube16::encode_vec3), middles);
    // u is y on the face of x, else x; v is z but for the face of z, where it is y. A row takes 193 half columns.
    let [across, along] = [0.0143, 0.0245];
    assert_eq!(HexCube16::encode(Vec3::new(1.0, across, 0.0)), 5_452 + 1);
    assert_eq!(HexCube16::encode(Vec3::new(1.0, 0.0, along)), 5_452 + 193);
    assert_eq!(HexCube16::encode(Vec3::new(across, 1.0, 0.0)), 2 * 10_905 + 5_452 + 1);
    assert_eq!(HexCube16::encode(Vec3::new(0.0, 1.0, along)), 2 * 10_905 + 5_452 + 193);
    assert_eq!(HexCube16::encode(Vec3::new(across, 0.0, 1.0)), 4 * 10_905 + 5_452 + 1);
    assert_eq!(HexCube16::encode(Vec3::new(0.0, along, 1.0)), 4 * 10_905 + 5_452 + 193);
    // The next row begins half a column to the left, and its first point from the middle to the right is number 97.
    let half = HexCube16::decode_vec3(5_452 + 97);
    assert!(half.y > 0.0 && half.z > 0.0, "{half}");
    assert_eq!(HexCube16::encode(Vec3::new(1.0, -0.999, -0.999)), 0);
    assert_eq!(HexCube16::decode_vec3(0xffff), HexCube16::decode_vec3(65_429));
}
