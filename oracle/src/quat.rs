//! Rotations: four charts of the unit quaternions up to sign, each a cube with a body-centred lattice.

/// The widths: bits of a code, and n, the steps from face to face of a chart's cube.
pub const WIDTHS: [(u32, i64); 4] = [(24, 126), (32, 810), (48, 32_766), (64, 1_310_718)];

/// The steps from face to face at a number of bits.
pub fn steps(bits: u32) -> i64 {
    WIDTHS.iter().find(|width| width.0 == bits).expect("a width of the family").1
}

/// A lattice point of a chart: its coordinates in half steps from the middle, -n to n, all even or all odd as n and n + 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point {
    /// The component that is 1, of x, y, z and w.
    pub chart: usize,
    /// The half steps along the three components that follow, in cyclic order.
    pub halves: [i64; 3],
}

/// The component beside a largest one of 1, for a place u of -1 to 1 in a chart.
pub fn warp(u: f64) -> f64 {
    u * (23.0 + 9.0 * u * u) / 32.0
}

/// The slope of [`warp`].
pub fn slope(u: f64) -> f64 {
    (23.0 + 27.0 * u * u) / 32.0
}

/// The place of a component of -1 to 1: the real root of a cubic that increases, by Newton's method from outside.
pub fn unwarp(x: f64) -> f64 {
    (0..60).fold(x.signum(), |u, _| u - (warp(u) - x) / slope(u))
}

/// The point that a code stands for.
pub fn point(code: u64, bits: u32) -> Point {
    let n = steps(bits);
    let field = |at: u32, width: u32| (code >> at) & ((1 << width) - 1);
    let (low, radix) = match bits {
        24 => (7, 1),
        32 => (2, 203),
        48 => (15, 1),
        _ => (18, 5),
    };
    let above = field(3 * low, bits - 3 * low);
    let of_chart = (above / (radix * radix * radix)).min(7);
    let grid = (of_chart % 2) as i64;
    let along = |k: u32| {
        let whole = (((above / radix.pow(k)) % radix) << low) | field(k * low, low);
        2 * (whole as i64).min(n - grid) + grid - n
    };
    Point { chart: (of_chart / 2) as usize, halves: [along(0), along(1), along(2)] }
}

/// The unit quaternion x, y, z, w of a point, its component of the chart positive.
pub fn quaternion(point: Point, bits: u32) -> [f64; 4] {
    let mut q = [0.0; 4];
    q[point.chart] = 1.0;
    for (k, half) in (1..).zip(point.halves) {
        q[(point.chart + k) % 4] = warp(half as f64 / steps(bits) as f64);
    }
    unit(q)
}

/// The unit quaternion of a code.
pub fn decode(code: u64, bits: u32) -> [f64; 4] {
    quaternion(point(code, bits), bits)
}

/// The nearest of the lattice points around a rotation, in its own chart, and its angle of rotation from it in degrees.
pub fn nearest(q: [f64; 4], bits: u32) -> (Point, f64) {
    let n = steps(bits);
    let chart = (0..4).max_by(|&a, &b| q[a].abs().total_cmp(&q[b].abs())).unwrap_or(3);
    let place = [1, 2, 3].map(|k| unwarp(q[(chart + k) % 4] / q[chart]) * n as f64);
    let mut best = (Point { chart, halves: [0; 3] }, f64::INFINITY);
    // Three points of each grid along each coordinate.
    for grid in 0..2 {
        let first = place.map(|p| 2 * ((p - (n + grid) as f64) / 2.0).round() as i64 + n + grid);
        for [a, b, c] in neighbours() {
            let halves = [first[0] + 2 * a, first[1] + 2 * b, first[2] + 2 * c];
            let point = Point { chart, halves };
            if halves.iter().all(|half| half.abs() <= n) {
                let angle = angle_deg(q, quaternion(point, bits));
                if angle < best.1 {
                    best = (point, angle);
                }
            }
        }
    }
    best
}

fn neighbours() -> impl Iterator<Item = [i64; 3]> {
    (0..27).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1])
}

/// The angle of the rotation from one to another, in degrees, of unit quaternions of either sign. Its sine and cosine are those
/// of half the chords, so that it is exact for small angles.
pub fn angle_deg(a: [f64; 4], b: [f64; 4]) -> f64 {
    let chord = |sign: f64| (0..4).map(|i| (a[i] - sign * b[i]).powi(2)).sum::<f64>().sqrt();
    let (minus, plus) = (chord(1.0), chord(-1.0));
    (4.0 * minus.min(plus).atan2(minus.max(plus))).to_degrees()
}

/// A quaternion at unit length.
pub fn unit(q: [f64; 4]) -> [f64; 4] {
    let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    q.map(|c| c / length)
}

/// The greatest distance of a rotation from the nearest of the three lattice points that the encoder compares, in degrees of
/// rotation, to first order in the step, about the place u of a chart.
///
/// About there the lattice is one of the plane, where `d . G d` is the square of the length of a way of d steps. Let d, its
/// components from 0 to 1/2 by symmetry, lead from the corner to the rotation. To the first middle it is `d - 1/2`, to the other
/// `d - 1/2` too but for the least component, which is `d + 1/2`. The differences of the three squares are linear in d: each
/// is the least in a polytope, and the square, which is convex, is largest at one of that polytope's vertices.
pub fn largest_cell_deg(u: [f64; 3], bits: u32) -> f64 {
    let (x, s) = (u.map(warp), u.map(slope));
    let square_of_x: f64 = x.iter().map(|c| c * c).sum();
    let mut largest = 0.0f64;
    for signs in 0..4 {
        let sign = [1.0, if signs & 1 == 0 { 1.0 } else { -1.0 }, if signs & 2 == 0 { 1.0 } else { -1.0 }];
        let along = [0, 1, 2].map(|i| sign[i] * x[i] * s[i]);
        let form = |a: [f64; 3], b: [f64; 3]| {
            let product: f64 = (0..3).map(|i| s[i] * s[i] * a[i] * b[i]).sum();
            (1.0 + square_of_x) * product - dot(along, a) * dot(along, b)
        };
        for least in 0..3 {
            largest = largest.max(largest_of_three(form, least));
        }
    }
    let radius = largest.sqrt() / (1.0 + square_of_x) * 2.0 / steps(bits) as f64;
    (2.0 * radius).to_degrees()
}

/// The largest of the least of the three squares, where component `least` of d is the least.
fn largest_of_three(form: impl Fn([f64; 3], [f64; 3]) -> f64, least: usize) -> f64 {
    let middle = [0.5; 3];
    let mut other = middle;
    other[least] = -0.5;
    let square = |from: [f64; 3], d: [f64; 3]| {
        let way = [0, 1, 2].map(|i| d[i] - from[i]);
        form(way, way)
    };
    let of_all = |d: [f64; 3]| square([0.0; 3], d).min(square(middle, d)).min(square(other, d));
    // Planes `a . d = b`: two points are as near, or a face of the part of the cube where the component is the least.
    let axis = |i: usize| std::array::from_fn(|k| f64::from(u8::from(i == k)));
    let halfway = |p: [f64; 3], q: [f64; 3]| {
        let way = [0, 1, 2].map(|i| q[i] - p[i]);
        ([0, 1, 2].map(|i| 2.0 * form(axis(i), way)), form(q, q) - form(p, p))
    };
    let [j, k] = [(least + 1) % 3, (least + 2) % 3];
    let below = |j: usize| ([0, 1, 2].map(|i| axis(j)[i] - axis(least)[i]), 0.0);
    let planes: [([f64; 3], f64); 8] = [
        (axis(least), 0.0),
        below(j),
        below(k),
        (axis(j), 0.5),
        (axis(k), 0.5),
        halfway([0.0; 3], middle),
        halfway([0.0; 3], other),
        halfway(middle, other),
    ];
    let is_inside = |d: [f64; 3]| {
        let slack = 1e-9;
        d[least] >= -slack && [j, k].iter().all(|&i| d[i] >= d[least] - slack && d[i] <= 0.5 + slack)
    };
    let mut largest = 0.0f64;
    for (a, p) in planes.iter().enumerate() {
        for (b, q) in planes.iter().enumerate().skip(a + 1) {
            for r in &planes[b + 1..] {
                if let Some(d) = common_point([p, q, r]).filter(|d| is_inside(*d)) {
                    largest = largest.max(of_all(d));
                }
            }
        }
    }
    largest
}

/// The point that three planes share, by Cramer's rule.
fn common_point([(a, p), (b, q), (c, r)]: [&([f64; 3], f64); 3]) -> Option<[f64; 3]> {
    let cross = |a: &[f64; 3], b: &[f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let volume = dot(*a, bc);
    (volume.abs() > 1e-12).then(|| [0, 1, 2].map(|i| (p * bc[i] + q * ca[i] + r * ab[i]) / volume))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}
