//! The hexagonal cube codecs: one code a point, the choice of the point, the bound, layout.

use glam::Vec3;
use unitvec::{Codec, HexCube16};
use unitvec_oracle::ico::bound_deg;
use unitvec_oracle::{Summary, angle_deg, hexcube, normalize};
use unitvec_tests::checks::{assert_bounded, assert_commutes, assert_decodes, assert_stable};
use unitvec_tests::directions::{Rng, near_diagonals, near_planes, sphere};
use unitvec_tests::expected::symmetries;
use unitvec_tests::tested::{Tested, narrow, widen};

/// The error in degrees that the rounding of the encoder and the decoder adds.
const ROUNDING: f64 = 1.5e-5;

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

/// The chosen point is the nearest of the face, or farther off by 10 % of the covering bound at most. Beside the edges, the
/// other face can have a much nearer one. This adds to the mean 1.2e-4 of the bound at most; with the points over the edges,
/// 4e-4 at 16 bits.
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
        println!("{}: of the face {of_face:?}, of all {of_all:?}", codec.id);
        assert!(
            of_face.max <= 0.1 + ROUNDING / radius && of_face.mean <= 1.2e-4,
            "{}: {of_face:?}",
            codec.id
        );
        assert!(of_all.mean <= if bits == 16 { 4e-4 } else { 1e-4 }, "{}: {of_all:?}", codec.id);
    }
}

/// The largest error is the farthest of three kinds of corners that the docs derive: each is reached, and no direction
/// exceeds the bound that follows.
#[test]
fn errors_reach_the_derived_bound_and_no_further() {
    for codec in Tested::family("hexcube") {
        let mut rng = Rng::new(8);
        let corners = [0, 1, 2].map(|kind| farthest_corner(kind, codec.bits));
        for (derived, corner) in corners {
            let aside = 0.01 * derived.to_radians();
            let beside = (0..3000).map(|_| narrow(normalize(corner.map(|t| t + rng.range(-aside, aside)))));
            let worst = Summary::of(beside.map(|v| codec.error_deg(v))).max;
            println!("{}: {worst:.7} of {derived:.7} at {corner:?}", codec.id);
            assert!(worst > 0.995 * derived, "{}: {worst} of {derived}", codec.id);
        }
        let derived = corners.map(|(error, _)| error).into_iter().fold(0.0, f64::max);
        let bound = f64::from(codec.max_error_deg());
        assert!((derived + ROUNDING..1.01 * derived).contains(&bound), "{}: {bound} for {derived}", codec.id);
        let directions = sphere(9, 500_000).chain(near_diagonals(10, 1_000_000));
        assert_bounded(&codec, Summary::of(directions.map(|v| codec.error_deg(v))).max);
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

/// The other points of a corner, in half columns and rows from its first: of one inside a face, on the edge u = 1 and on
/// the edge v = 1.
const OTHERS: [&[[i64; 2]]; 3] = [&[[2, 0], [1, 1]], &[[-1, 1]], &[[2, 0]]];

/// The way from a corner's first point to the corner, in half columns and rows: there the encoder, at u and v, finds the
/// corner's points equally near, by the square `(x - s r)^2 + q r^2` for x columns and r pairs of rows.
fn corner(kind: usize, of: &hexcube::Lattice, uv: [f64; 2]) -> [f64; 2] {
    let [u, v] = uv.map(|t| 8.0 / 25.0 * t);
    let (s, q) = (9.19 * u * v, (0.5332 - u) * (5.082 + 17.14 * v));
    let [to_u, to_v] = [of.edges[0] - of.columns as f64, of.edges[1] - of.rows as f64];
    let inside = (s * s + q - 1.0) / (2.0 * q);
    let on_u = ((1.0 + s) * (to_u + (1.0 + s) / 2.0) + q / 2.0) / (q + s * (1.0 + s));
    [[1.0 + s * inside, inside], [to_u, on_u], [1.0 + s * to_v, to_v]][kind]
}

/// The largest error in degrees at corners of a kind, and the unit vector of that corner: of all at 16 bits, else of some
/// that lie close to one another.
fn farthest_corner(kind: usize, bits: u32) -> (f64, [f64; 3]) {
    let of = hexcube::lattice(bits);
    let line =
        |last: i64, end: bool| (if end { last } else { 0 }..=last).step_by(last as usize / 500 * 2 + 1);
    let firsts = line(of.columns, kind == 1).flat_map(|i| line(of.rows, kind == 2).map(move |j| [i, j]));
    let mut farthest = (0.0, [0.0; 3]);
    for [i, j] in firsts {
        let points = || OTHERS[kind].iter().chain(&[[0, 0]]).map(|way| [i + way[0], j + way[1]]);
        if points().all(|point| of.has(point)) {
            let mut uv = [i as f64 / of.edges[0], j as f64 / of.edges[1]];
            for _ in 0..4 {
                let [x, y] = corner(kind, &of, uv);
                uv = [(i as f64 + x) / of.edges[0], (j as f64 + y) / of.edges[1]];
            }
            let v = hexcube::direction(4, uv);
            let error = Summary::of(points().map(|point| angle_deg(v, hexcube::point(4, point, bits)))).max;
            farthest = if error > farthest.0 { (error, v) } else { farthest };
        }
    }
    farthest
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
