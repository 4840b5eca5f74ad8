//! The icosahedral codecs against their definition, [`unitvec_tests::oracle::ico`], the bound of hexagonal cells and the
//! survey's table 1.

use glam::Vec3;
use unitvec::Listed;
use unitvec::{Codec, Ico16, Ico24, Ico32};
use unitvec_tests::oracle::{self, Ico, Summary, angle_deg, ico, round_trip_error_deg, widen};
use unitvec_tests::sampling::{self, Rng, near_octant_middles, near_planes, sphere};

/// By how much the point that encoding chooses may be further off than the nearest, in radians: the rounding of the encoder
/// and the decoder, and the encoder's taking the distance between neighbours for constant, which counts at 16 bits alone.
fn slack(bits: u32) -> f64 {
    2f64.powi(-21) + if bits == 16 { 5e-5 } else { 0.0 }
}

/// Modules of tests, one for each codec: its type, the least mean and maximal error of all of the survey's codecs with as
/// many bits, and its own mean and maximum in parts of the bound's.
macro_rules! codecs {
    ($($module:ident: $codec:ty, $mean:literal, $max:literal, $bound_mean:literal, $bound_max:literal;)*) => {$(
        mod $module {
            use super::*;

            /// Every code (2^21 at 24 bits, 2^20 at 32) and those around the ends of rows and blocks decode to the
            /// oracle's direction to 1 ULP, to unit length to 2 ULP, with high bits ignored; no component is -0.
            #[test]
            fn decodes_as_the_oracle() {
                let bits = <$codec>::BITS;
                oracle::assert_decodes::<$codec, Ico>(codes(bits, 1).chain(ends(bits)));
                for code in codes(bits, 1).chain(ends(bits)) {
                    let v = <$codec>::decode(code).to_array();
                    assert!(v.iter().all(|t| t.to_bits() != (-0f32).to_bits()), "{code:#x} gives {v:?}");
                }
            }

            /// The same codes, decoded, encoded and decoded, give the first vector, exactly.
            #[test]
            fn round_trip_is_stable() {
                oracle::assert_stable::<$codec>(codes(<$codec>::BITS, 2).chain(ends(<$codec>::BITS)));
            }

            /// Each of these codes comes back as itself, but for the six that stand for an apex once more and those
            /// past the last one: no two stand for the same lattice point.
            #[test]
            fn a_point_has_one_code() {
                let bits = <$codec>::BITS;
                let (n, _) = ico::lattice(bits);
                for code in codes(bits, 2).chain(ends(bits)) {
                    let again = <$codec>::encode(<$codec>::decode(code));
                    let is_apex = i64::from(code) < ico::octants(bits) && i64::from(code) % (n * (n + 2)) == n + 1;
                    if code > ico::last(bits) {
                        assert_eq!(again, ico::last(bits), "{code:#x}");
                    } else {
                        assert_eq!(again == code, !is_apex, "{code:#x} comes back as {again:#x}");
                    }
                }
            }

            /// 2 * 10^5 directions and 10^5 near faces' sides, vertices and middles get the lattice point nearest in angle
            /// of all around, or one that is no further off than by what arithmetic adds.
            #[test]
            fn encodes_the_nearest() {
                let bits = <$codec>::BITS;
                let directions = sphere(3, 200_000)
                    .chain(near_planes(4, 30_000))
                    .chain(near_octant_middles(5, 20_000, 0.01))
                    .chain(near_sides(6, 50_000));
                let excess = directions.map(|v| {
                    let least = angle_deg(widen(v), ico::nearest(widen(v), bits));
                    let excess = round_trip_error_deg::<$codec>(v) - least;
                    assert!(excess <= slack(bits).to_degrees(), "{v:?} is {excess:e} degrees further off than {least}");
                    excess
                });
                let excess = Summary::of(excess);
                println!("{}: {excess:?} of {:e}", <$codec>::NAME, slack(bits).to_degrees());
            }

            /// The mean over 10^6 directions is below that of all of the survey's codecs of as many bits, and in parts
            /// of the bound's as stated, to three standard errors; so is the maximum.
            #[test]
            fn errors_are_less_than_the_surveys() {
                let bound = ico::bound_deg(<$codec>::BITS);
                let ours = Summary::of(sphere(7, 1_000_000).map(round_trip_error_deg::<$codec>));
                let (mean, max) = (ours.mean / bound.mean, ours.max / bound.max);
                println!("{}: {ours:?}, of the bound's {mean:.5} and {max:.5}", <$codec>::NAME);
                let three_standard_errors = 3.0 * 0.37 / 1000.0;
                assert!(ours.mean < $mean * (1.0 + three_standard_errors) && ours.max < $max);
                assert!((mean / $bound_mean - 1.0).abs() < three_standard_errors, "{mean}");
                assert!(max < $bound_max, "{max}");
            }

            /// The circumcentres of neighbouring lattice points all over the faces (each at 16 bits, else 10^5 of each
            /// orientation and those at the vertices, the middles and the sides) are as far off as the largest of
            /// the circumcircles, to what arithmetic adds, and no further: the maximum, as stated.
            #[test]
            fn maximum_is_at_circumcentres() {
                let bits = <$codec>::BITS;
                let (bound, mut exact, mut worst) = (ico::bound_deg(bits).max, 0f64, 0f64);
                for corners in triangles(bits, 8) {
                    let (centre, radius) = ico::circumcircle(corners);
                    exact = exact.max(radius);
                    for v in around(centre, slack(bits)) {
                        worst = worst.max(round_trip_error_deg::<$codec>(v));
                    }
                }
                println!("{}: {worst:.7}, exact {exact:.7}: of the bound {:.5}", <$codec>::NAME, worst / bound);
                assert!(worst > exact * 0.999 && worst < exact + slack(bits).to_degrees());
                assert!(worst < $bound_max * bound && worst < $max);
                assert!(worst <= f64::from(<$codec>::MAX_ERROR_DEG));
                assert!(f64::from(<$codec>::MAX_ERROR_DEG) < exact + 2.0 * slack(bits).to_degrees());
            }

            /// All triangles of neighbouring lattice points are acute: so no point is further from all of these than
            /// the centre of the largest circumcircle.
            #[test]
            fn triangles_are_acute() {
                for corners in triangles(<$codec>::BITS, 9) {
                    let squares: [f64; 3] = std::array::from_fn(|k| {
                        angle_deg(corners[(k + 1) % 3], corners[(k + 2) % 3]).powi(2)
                    });
                    let greatest = squares.into_iter().fold(0.0, f64::max);
                    assert!(squares.iter().sum::<f64>() > 2.02 * greatest, "{corners:?}");
                }
            }

            /// Mirrored at x = 0, y = 0 or z = 0, a direction decodes to the decoded vector's image, exactly, but for
            /// directions in the plane; with x, y and z turned, within rounding or to one as near.
            #[test]
            fn symmetric() {
                let directions = || sphere(10, 100_000).chain(near_planes(11, 50_000));
                let mirrors: [fn(Vec3) -> Vec3; 3] = [
                    |v| Vec3::new(-v.x, v.y, v.z),
                    |v| Vec3::new(v.x, -v.y, v.z),
                    |v| Vec3::new(v.x, v.y, -v.z),
                ];
                for image in mirrors {
                    oracle::assert_commutes::<$codec>(directions(), image);
                }
                for v in directions() {
                    let turned = Vec3::new(v.y, v.z, v.x);
                    let off = round_trip_error_deg::<$codec>(turned) - round_trip_error_deg::<$codec>(v);
                    assert!(off.abs() <= 2.0 * slack(<$codec>::BITS).to_degrees(), "{v:?} and {turned:?} differ by {off}");
                }
            }

            /// The six axes come back exactly, and the twelve vertices within rounding.
            #[test]
            fn keeps_the_axes_and_vertices() {
                oracle::assert_keeps::<$codec>(&sampling::AXES);
                for vertex in ico::vertices() {
                    let error = round_trip_error_deg::<$codec>(narrow(vertex));
                    assert!(error < 1e-5, "{vertex:?} is {error} off");
                }
            }
        }
    )*};
}

codecs! {
    ico16: Ico16, 0.30351, 0.56178, 1.0141, 1.035;
    ico24: Ico24, 0.01895, 0.03504, 1.0030, 1.015;
    ico32: Ico32, 0.00119, 0.00246, 1.0021, 1.0185;
}

/// All codes of 16 bits; of 24, every eighth.
fn codes(bits: u32, seed: u64) -> Box<dyn Iterator<Item = u32>> {
    let step = if bits == 24 { 8 } else { 1 };
    Box::new(sampling::codes(bits, seed, 1 << 20).step_by(step))
}

/// Codes of the first and last rows of blocks, those at the ends of rows and where the second face begins, and the last.
fn ends(bits: u32) -> impl Iterator<Item = u32> {
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
    let last = i64::from(ico::last(bits));
    ends.chain([last, last + 1, (1 << bits) - 1]).map(|code| code as u32)
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
        narrow(oracle::normalize(std::array::from_fn(|axis| {
            (0..3).map(|k| weights[k] * face[k][axis]).sum()
        })))
    })
}

fn narrow(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|t| t as f32))
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
    assert_eq!(Ico16::decode(81), Ico16::decode(3 * 80 * 82 + 80));
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
    assert_eq!(Ico16::decode(64_007), Ico16::decode(0xffff));
}
