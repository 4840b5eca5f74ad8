//! The icosahedral codecs: one code a point, nearest points, the bound of hexagonal cells, layout.

use glam::Vec3;
use unitvec::{Codec, Ico16, Ico24, Ico32};
use unitvec_oracle::{Summary, angle_deg, ico, normalize};
use unitvec_tests::checks::{assert_bounded, assert_decodes, assert_stable};
use unitvec_tests::directions::{Rng, near_octant_middles, near_planes, sphere};
use unitvec_tests::tested::{Tested, narrow, widen};

/// The slack in radians of the point that encoding chooses against the nearest: the rounding of the encoder and the
/// decoder, and the encoder's taking the distance between neighbours for constant, which counts at 16 bits alone.
fn slack(bits: u32) -> f64 {
    2f64.powi(-21) + if bits == 16 { 5e-5 } else { 0.0 }
}

/// Codes around the ends of rows and blocks decode to the oracle's direction, and come back.
#[test]
fn ends_of_rows() {
    for codec in Tested::family("ico") {
        assert_decodes(&codec, ends(codec.bits), 1.0);
        assert_stable(&codec, ends(codec.bits));
    }
}

/// Each code comes back as itself, but for the six that stand for an apex once more and those past the last one: no two
/// stand for the same lattice point.
#[test]
fn a_point_has_one_code() {
    for codec in Tested::family("ico") {
        let (bits, (n, _)) = (codec.bits, ico::lattice(codec.bits));
        for code in codec.codes(2, 22).chain(ends(bits)) {
            let again = codec.encode(codec.decode(code));
            let is_apex = (code as i64) < ico::octants(bits) && code as i64 % (n * (n + 2)) == n + 1;
            if code > ico::last(bits) {
                assert_eq!(again, ico::last(bits), "{}: {code:#x}", codec.id);
            } else {
                assert_eq!(again == code, !is_apex, "{}: {code:#x} comes back as {again:#x}", codec.id);
            }
        }
    }
}

/// 2 * 10^5 directions and 10^5 near faces' sides, vertices and middles get the lattice point nearest in angle of all
/// around, or one that is no further off than the arithmetic's error.
#[test]
fn encodes_the_nearest() {
    for codec in Tested::family("ico") {
        let slack = slack(codec.bits).to_degrees();
        let directions = sphere(3, 200_000)
            .chain(near_planes(4, 30_000))
            .chain(near_octant_middles(5, 20_000, 0.01))
            .chain(near_sides(6, 50_000));
        let excess = directions.map(|v| {
            let excess = codec.error_deg(v) - angle_deg(widen(v), ico::nearest(widen(v), codec.bits));
            assert!(excess <= slack, "{}: {v:?} is {excess:e} degrees further off", codec.id);
            excess
        });
        println!("{}: {:?} of {slack:e}", codec.id, Summary::of(excess));
    }
}

/// The circumcentres of neighbouring lattice points all over the faces (each at 16 bits, else 10^5 of each orientation and
/// those at the vertices, the middles and the sides) are as far off as the largest of the circumcircles, to what arithmetic
/// adds, and no further.
#[test]
fn maximum_is_at_circumcentres() {
    for codec in Tested::family("ico") {
        let (bits, bound) = (codec.bits, ico::bound_deg(codec.bits).max);
        let (mut exact, mut worst) = (0f64, 0f64);
        for corners in triangles(bits, 8) {
            let (centre, radius) = ico::circumcircle(corners);
            exact = exact.max(radius);
            for v in around(centre, slack(bits)) {
                worst = worst.max(codec.error_deg(v));
            }
        }
        println!("{}: {worst:.7}, exact {exact:.7}: of the bound {:.5}", codec.id, worst / bound);
        let slack = slack(bits).to_degrees();
        assert!(worst > exact * 0.999 && worst < exact + slack, "{}", codec.id);
        assert_bounded(&codec, worst);
        assert!(f64::from(codec.max_error_deg()) < exact + 2.0 * slack, "{}", codec.id);
    }
}

/// All triangles of neighbouring lattice points are acute: so no point is further from all of these than the centre of the
/// largest circumcircle.
#[test]
fn triangles_are_acute() {
    for codec in Tested::family("ico") {
        for corners in triangles(codec.bits, 9) {
            let squares: [f64; 3] =
                std::array::from_fn(|k| angle_deg(corners[(k + 1) % 3], corners[(k + 2) % 3]).powi(2));
            let greatest = squares.into_iter().fold(0.0, f64::max);
            assert!(squares.iter().sum::<f64>() > 2.02 * greatest, "{}: {corners:?}", codec.id);
        }
    }
}

/// The twelve vertices come back within rounding.
#[test]
fn keeps_the_vertices() {
    for codec in Tested::family("ico") {
        for vertex in ico::vertices() {
            let error = codec.error_deg(narrow(vertex));
            assert!(error < 1e-5, "{}: {vertex:?} is {error} off", codec.id);
        }
    }
}

/// Codes of the first and last rows of blocks, those at the ends of rows and where the second face begins, and the last.
fn ends(bits: u32) -> impl Iterator<Item = u64> {
    let (n, _) = ico::lattice(bits);
    let kinds = [(0, 6, n, n + 2, n + 1), (ico::octants(bits), 4, n - 2, n - 1, n - 2)];
    let ends = kinds.into_iter().flat_map(move |(first, blocks, rows, length, firsts)| {
        (0..blocks).flat_map(move |block| {
            let line = move |row: i64| first + (block * rows + row) * length;
            let whole = [0, 1, rows - 2, rows - 1]
                .into_iter()
                .flat_map(move |row| (0..length).map(move |i| line(row) + i));
            let ends = (0..rows).flat_map(move |row| {
                [0, 1, firsts - row - 1, firsts - row, length - 1].map(|column| line(row) + column)
            });
            whole.chain(ends)
        })
    });
    let last = ico::last(bits) as i64;
    ends.chain([last, last + 1, (1 << bits) - 1]).map(|code| code as u64)
}

/// The unit vectors of triples of neighbouring lattice points, of both orientations, by turns on all faces.
fn triangles(bits: u32, seed: u64) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let (n, _) = ico::lattice(bits);
    let corners: Vec<[i64; 2]> = if bits == 16 {
        let all = move |_| (0..n).flat_map(move |i| (0..n - i).map(move |j| [i, j]));
        (0..7).flat_map(all).collect()
    } else {
        let mut rng = Rng::new(seed);
        let mut any = move |least: i64, most: i64| rng.range(least as f64, most as f64) as i64;
        (0..130_000)
            .map(|k| match k % 13 {
                // A vertex, the middle and a side.
                0 => [any(0, 10), any(0, 10)],
                1 => [n / 3 + any(-n / 50, n / 50), n / 3 + any(-n / 50, n / 50)],
                2 => [any(0, n - 2), any(0, 2)],
                _ => {
                    let [a, b] = [any(0, n), any(0, n)];
                    [a.min(b), (n - a.max(b)).min(n - 1 - a.min(b))]
                }
            })
            .collect()
    };
    corners.into_iter().enumerate().flat_map(move |(k, [i, j])| {
        let at = |[a, b]: [i64; 2]| ico::point(ico::faces()[k % 20], [a, b, n - a - b], bits);
        let lower = [[i, j], [i + 1, j], [i, j + 1]].map(at);
        let upper = (i + j + 2 <= n).then(|| [[i + 1, j + 1], [i + 1, j], [i, j + 1]].map(at));
        [Some(lower), upper].into_iter().flatten()
    })
}

/// A unit vector rounded to `f32`, and some up to `radius` around it.
fn around(v: [f64; 3], radius: f64) -> impl Iterator<Item = Vec3> {
    let nudges = [[0, 0, 0], [3, -3, 2], [-2, 3, -3], [1, 2, -1], [-1, -1, 3], [-3, 0, 1], [0, -2, -2]];
    nudges
        .into_iter()
        .map(move |nudge| narrow(std::array::from_fn(|k| v[k] + f64::from(nudge[k]) / 5.0 * radius)))
}

/// Unit vectors at the sides and vertices of faces.
fn near_sides(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        let face = ico::faces()[(rng.bits() % 20) as usize];
        let small = 0.1f64.powf(rng.range(1.0, 8.0));
        let along = if rng.bits() & 3 == 0 { small * rng.unit() } else { rng.unit() };
        let weights = [1.0 - along, along, rng.range(-1.0, 1.0) * small];
        narrow(normalize(std::array::from_fn(|axis| (0..3).map(|k| weights[k] * face[k][axis]).sum())))
    })
}

/// Rows go from a base to the opposite face's apex, columns from the negative side to the positive one; within octants,
/// both away from the sides.
#[test]
fn layout() {
    // The middles of the bases, in the order of the blocks of 80 rows of 82 codes.
    let bases = [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y];
    for (block, base) in (0..6).zip(bases) {
        assert_eq!(Ico16::encode(base), block * 80 * 82 + 40, "{base}");
    }
    // Around the first: the base from -y to +y, the row next to it on the side of +x, the last of the side of -x.
    let p = 1.618_034;
    assert_eq!(Ico16::encode(Vec3::new(0.0, -1.0, p)), 0);
    assert_eq!(Ico16::encode(Vec3::new(0.0, 1.0, p)), 80);
    assert_eq!(Ico16::encode(Vec3::new(0.01, -0.001, 1.0)), 82 + 39);
    assert_eq!(Ico16::encode(Vec3::new(-0.01, 0.001, 1.0)), 79 * 82 + 2 + 40);
    assert_eq!(Ico16::decode_vec3(81), Ico16::decode_vec3(3 * 80 * 82 + 80));
    // The octants' middles are not lattice points, for 80 is not a multiple of 3.
    let first = 6 * 80 * 82;
    assert_eq!(Ico24::encode(Vec3::Z), 647);
    assert_eq!(Ico32::encode(Vec3::Z), 10362);
    for (block, [y, z]) in (0..4).zip([[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]) {
        let code = Ico16::encode(Vec3::new(1.0, 1.02 * y, 1.03 * z));
        assert_eq!((code - first) / (78 * 79), block, "{code:#x}");
        let other = Ico16::encode(Vec3::new(-1.0, 1.02 * y, 1.03 * z));
        let [row, column] = [(code - first) / 79 % 78, (code - first) % 79];
        let [other_row, other_column] = [(other - first) / 79 % 78, (other - first) % 79];
        assert_eq!([other_row, other_column], [77 - row, row + 1 + column]);
    }
    assert_eq!(Ico16::decode_vec3(64_007), Ico16::decode_vec3(0xffff));
}
