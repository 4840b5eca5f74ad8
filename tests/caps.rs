//! Caps, unequal precision, and codes in the order of their regions.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use unitvec::glam::Vec3;
use unitvec::wrap::dense::DEFAULT_RATIO;
use unitvec::wrap::morton::{Cone, from_morton, to_morton};
use unitvec::wrap::{Cap, Dense, smallest_cap};
use unitvec::{
    Codec, Domain, EaOct16, EaOct24, EaOct32, HemiOctPrecise16, Listed, Oct32, OctPrecise16, OctPrecise32,
    angle_deg,
};
use unitvec_oracle::{cross, dot, length, normalize};
use unitvec_run::sampling::special_vectors;
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::{AXES, Rng, sphere, usable};
use unitvec_tests::tested::{narrow, widen};

/// An axis that is none of the coordinates'.
const AXIS: [f32; 3] = [0.36, 0.48, -0.8];

/// What `f32` adds to an error: 2^-21 radians, in degrees.
const ROUNDING_DEG: f64 = 180.0 / PI / (1 << 21) as f64;

/// The half-angles of caps, in degrees.
const ANGLES: [f64; 6] = [0.1, 1.0, 10.0, 30.0, 90.0, 110.0];

/// A unit vector at this angle from `axis`, both in `f64`.
fn at_angle(rng: &mut Rng, axis: [f64; 3], angle: f64) -> [f64; 3] {
    let side = if axis[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let first = normalize(cross(axis, side));
    let (second, turn) = (cross(axis, first), rng.range(0.0, TAU));
    let (sine, cosine) = angle.sin_cos();
    std::array::from_fn(|i| axis[i] * cosine + sine * (first[i] * turn.cos() + second[i] * turn.sin()))
}

/// Directions that fill a zone about an axis evenly, from one angle to another, in radians.
fn zone(seed: u64, count: usize, axis: [f64; 3], [from, to]: [f64; 2]) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| {
        // 1 - cos = 2 sin^2 of half the angle keeps small angles.
        let part = rng.range((0.5 * from).sin().powi(2), (0.5 * to).sin().powi(2));
        narrow(at_angle(&mut rng, axis, 2.0 * part.sqrt().asin()))
    })
}

/// Directions of a cap: all over it, and half of them at its rim.
fn in_cap(seed: u64, count: usize, axis: [f64; 3], angle: f64) -> impl Iterator<Item = Vec3> {
    // `f32` leaves those at the rim inside.
    let rim = angle * (1.0 - 1e-3);
    zone(seed, count / 2, axis, [0.0, rim]).chain(zone(seed + 1, count / 2, axis, [rim * 0.98, rim]))
}

/// The half-angle of the part of a codec that a cap of half-angle a fills.
fn filled<C: Listed>(a: f64) -> f64 {
    match C::DOMAIN {
        Domain::Hemisphere => FRAC_PI_2,
        Domain::Sphere if a <= TAU / 3.0 => TAU / 3.0,
        Domain::Sphere => PI,
    }
}

/// The most that the equal-area map from the cap of half-angle b to that of half-angle a lengthens, by differences of
/// `sin(angle / 2) sin(b / 2) = sin(image / 2) sin(a / 2)` along the radius and the circles' lengths across.
fn most_lengthening(a: f64, b: f64) -> f64 {
    let angle = |image: f64| 2.0 * ((0.5 * image).sin() * (0.5 * a).sin() / (0.5 * b).sin()).asin();
    let places = (0..1000).map(|i| b * (f64::from(i) + 0.5) / 1000.0).chain([b - 1e-6]);
    places.fold(0f64, |most, image| {
        let along = (angle(image + 1e-6) - angle(image - 1e-6)) / 2e-6;
        most.max(along).max(angle(image).sin() / image.sin())
    })
}

/// Errors keep to the stated bound, which is the codec's times the most that the map lengthens, and come near it: to 60
/// % of it at least, though the codec's worst direction need not be at the rim.
fn assert_cap_bounded<C: Listed>(angle_in_deg: f64) {
    let (axis, angle) = (normalize(AXIS.map(f64::from)), angle_in_deg.to_radians());
    let cap = Cap::<C>::new(AXIS, angle as f32);
    let bound = f64::from(cap.max_error_deg());
    let lengthened = f64::from(C::MAX_ERROR_DEG) * most_lengthening(angle, filled::<C>(angle));
    // Beyond the rim a sphere's codec lengthens a little more: by tan(30 degrees) e.
    let beyond = 1.0 + 1.2 * f64::from(C::MAX_ERROR_DEG).to_radians() * 3f64.sqrt().recip();
    assert!(
        (lengthened * 0.99999..lengthened * beyond + 2.0 * ROUNDING_DEG).contains(&bound),
        "{} {angle_in_deg}: {bound} {lengthened}",
        C::NAME
    );
    let errors = in_cap(3, 60_000, axis, angle).map(|v| angle_deg(v, cap.decode::<Vec3>(cap.encode(v))));
    let most = errors.fold(0f64, f64::max);
    assert!(most <= bound, "{} {angle_in_deg}: {most} of {bound}", C::NAME);
    assert!(most >= 0.6 * (bound - ROUNDING_DEG), "{} {angle_in_deg}: {most} of {bound}", C::NAME);
}

#[test]
fn caps_keep_their_bound() {
    for angle in ANGLES {
        assert_cap_bounded::<OctPrecise16>(angle);
        assert_cap_bounded::<HemiOctPrecise16>(angle);
        assert_cap_bounded::<OctPrecise32>(angle);
    }
    assert_cap_bounded::<OctPrecise16>(180.0);
}

/// The map is Lambert's, to the rounding of `f32`: azimuths are kept, and sines of half angles scaled, both ways.
#[test]
fn the_map_is_lamberts() {
    let axis = normalize(AXIS.map(f64::from));
    for angle in ANGLES.map(f64::to_radians) {
        let cap = Cap::<HemiOctPrecise16>::new(AXIS, angle as f32);
        let [ax, ay, az, _] = cap.to_array();
        let z = widen(Vec3::new(ax, ay, az));
        for v in in_cap(5, 2000, axis, angle) {
            let image = widen(cap.image(v));
            let from_axis = angle_deg(Vec3::new(ax, ay, az), v).to_radians();
            let scaled = 2.0
                * ((0.5 * from_axis).sin() * FRAC_PI_2.mul_add(0.5, 0.0).sin() / (0.5 * angle).sin()).asin();
            let off = image[0].hypot(image[1]).atan2(image[2]) - scaled;
            assert!(off.abs() < 2e-6 + 1e-7 / angle, "{angle} {v}: {off}");
            let back = cap.of_image(narrow(normalize(image)));
            assert!(angle_deg(v, back) < ROUNDING_DEG + 3e-5 * angle, "{angle} {v}: {back}");
        }
        assert!((length(z) - 1.0).abs() <= LENGTH_ROUNDING);
    }
}

/// A cap of 30 degrees, in the mean: with a hemisphere's codec 0.27 of the error of the sphere's codec of as many bits.
/// With the sphere's codec, 1.23 of the area's root, which an isotropic map would reach.
#[test]
fn the_mean_falls_with_the_area() {
    fn mean<C: Listed>(angle: f64) -> f64 {
        let (axis, cap) = (normalize(AXIS.map(f64::from)), Cap::<C>::new(AXIS, angle as f32));
        let errors =
            zone(7, 100_000, axis, [0.0, angle]).map(|v| angle_deg(v, cap.decode::<Vec3>(cap.encode(v))));
        errors.sum::<f64>() / 1e5
    }
    let (whole, area) = (mean::<OctPrecise16>(PI), (PI / 12.0).sin());
    let by_sphere = mean::<OctPrecise16>(PI / 6.0) / whole;
    let by_hemisphere = mean::<HemiOctPrecise16>(PI / 6.0) / whole;
    assert!((by_hemisphere / 0.2685 - 1.0).abs() < 0.01, "{by_hemisphere}");
    assert!((by_sphere / (1.227 * area) - 1.0).abs() < 0.01, "{by_sphere}");
}

/// All codes decode to unit vectors of the cap, and come back, those beyond the rim within the error; directions
/// outside get the nearest of the rim, and those without any the axis.
fn assert_cap_total<C: Listed<Code = u32>>(angle: f64) {
    let cap = Cap::<C>::new(AXIS, angle.to_radians() as f32);
    let [ax, ay, az, _] = cap.to_array();
    let axis = Vec3::new(ax, ay, az);
    for code in 0..1u32 << 16 {
        let v: Vec3 = cap.decode(code);
        assert!((length(widen(v)) - 1.0).abs() <= LENGTH_ROUNDING, "{code:#x}: {v}");
        assert!(v.to_array().iter().all(|c| c.to_bits() != 1 << 31), "{code:#x}: {v}");
        assert!(angle_deg(axis, v) <= angle + ROUNDING_DEG * 4.0, "{code:#x}: {v}");
        let again: Vec3 = cap.decode(cap.encode(v));
        let is_inside = angle_deg(axis, v) < angle - 4.0 * ROUNDING_DEG;
        assert!(again == v || !is_inside, "{} {angle}: {code:#x}", C::NAME);
        assert!(angle_deg(again, v) <= f64::from(cap.max_error_deg()), "{} {angle}: {code:#x}", C::NAME);
    }
    for v in sphere(11, 20_000).filter(|v| angle_deg(axis, *v) > angle) {
        let across = normalize(cross(cross(widen(axis), widen(v)), widen(axis)));
        let (sine, cosine) = angle.to_radians().sin_cos();
        let rim: [f64; 3] = std::array::from_fn(|i| f64::from(axis[i]) * cosine + across[i] * sine);
        let back: Vec3 = cap.decode(cap.encode(v));
        assert!(angle_deg(narrow(rim), back) <= f64::from(cap.max_error_deg()), "{v}: {back}");
    }
    for v in special_vectors().into_iter().filter(|v| usable((*v).into()) == Some(false)) {
        assert_eq!(cap.decode::<Vec3>(cap.encode(v)), axis, "{v:?}");
    }
    assert_eq!(cap.decode::<Vec3>(cap.encode(axis * 3.0)), axis);
    let _: Vec3 = cap.decode(cap.encode(-axis));
}

#[test]
fn caps_are_total_and_stable() {
    for angle in [1.0, 30.0, 90.0, 110.0] {
        assert_cap_total::<OctPrecise16>(angle);
        assert_cap_total::<HemiOctPrecise16>(angle);
    }
    assert_cap_total::<OctPrecise16>(180.0);
    let of = |angle| Cap::<OctPrecise16>::new([0.0; 3], angle).to_array();
    assert_eq!([of(f32::NAN), of(f32::INFINITY), of(4.0)], [of(core::f32::consts::PI); 3]);
    assert_eq!(of(-1.0), of(1.0 / 4096.0));
}

/// Axes and their opposites come back to the bit, at any length, and so in a cap of the whole sphere.
#[test]
fn axes_are_exact() {
    for axis in AXES.into_iter().chain(sphere(13, 1000)) {
        let (cap, dense) =
            (Cap::<OctPrecise16>::new(axis, 4.0), Dense::<OctPrecise16>::new(axis, DEFAULT_RATIO));
        let [x, y, z, _] = cap.to_array();
        let unit = Vec3::new(x, y, z);
        for v in [unit, Vec3::ZERO - unit] {
            assert_eq!(cap.decode::<Vec3>(cap.encode(v * 3.0)), v);
            assert_eq!(dense.decode::<Vec3>(dense.encode(v * 3.0)), v);
        }
    }
}

/// The smallest cap of all that two or three directions hold, by trial of all; its half-angle in radians.
fn smallest_of_all(points: &[[f64; 3]]) -> f64 {
    let angle = |a, b| angle_deg(narrow(a), narrow(b)).to_radians();
    let mut axes = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            axes.push([0, 1, 2].map(|k| a[k] + b[k]));
            for c in &points[j + 1..] {
                let normal = cross([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
                axes.extend([normal, normal.map(|x| -x)]);
            }
        }
    }
    let most = |axis| points.iter().fold(0f64, |most, p| most.max(angle(normalize(axis), *p)));
    axes.into_iter().map(most).fold(PI, f64::min)
}

/// The cap holds every direction, and none is smaller: against all caps of sets of few, and on circles, whose cap is
/// known.
#[test]
fn the_smallest_cap_is_the_smallest() {
    let holds = |points: &[Vec3], (axis, angle): ([f32; 3], f32)| {
        points.iter().all(|p| angle_deg(axis, *p).to_radians() <= f64::from(angle))
    };
    let mut rng = Rng::new(17);
    for n in 0..400 {
        let axis = widen(sphere(100 + n, 1).next().unwrap());
        let wide = [1e-3, 0.1, 1.0, 1.5][n as usize % 4];
        let points: Vec<Vec3> = zone(500 + n, 2 + n as usize % 9, axis, [0.0, wide]).collect();
        let found = smallest_cap(&points);
        let best = smallest_of_all(&points.iter().map(|p| normalize(widen(*p))).collect::<Vec<_>>());
        assert!(holds(&points, found), "{points:?}: {found:?}");
        assert!(f64::from(found.1) <= best + 5e-7, "{points:?}: {found:?} {best}");
    }
    for angle in [0.01, 0.7, 1.4] {
        let on_circle = (0..5000).map(|_| narrow(at_angle(&mut rng, normalize(AXIS.map(f64::from)), angle)));
        let points: Vec<Vec3> = on_circle.collect();
        let found = smallest_cap(&points);
        assert!(holds(&points, found) && (f64::from(found.1) - angle).abs() < 5e-7, "{found:?}");
        assert!(angle_deg(found.0, AXIS).to_radians() < 1e-6, "{found:?}");
    }
    let whole: Vec<Vec3> = sphere(19, 500).collect();
    assert!(holds(&whole, smallest_cap(&whole)));
    assert_eq!(smallest_cap::<[f32; 3]>(&[]), ([0.0, 0.0, 1.0], 0.0));
    assert_eq!(smallest_cap(&[[f32::NAN; 3], [0.0; 3], [0.0, 2.0, 0.0]]).0, [0.0, 1.0, 0.0]);
}

/// The mean and the largest error in front and behind.
fn halves(round_trip: impl Fn(Vec3) -> Vec3, axis: [f64; 3]) -> [f64; 4] {
    let [mut front, mut behind] = [[0.0, FRAC_PI_2], [FRAC_PI_2, PI]].map(|half| {
        let errors = zone(23, 100_000, axis, half).map(|v| angle_deg(v, round_trip(v)));
        errors.fold([0.0, 0f64], |[mean, most], error| [mean + error / 1e5, most.max(error)])
    });
    // The border's neighbourhood has the largest errors.
    for (half, [from, to]) in [(&mut front, [-0.02, 0.0]), (&mut behind, [0.0, 0.02])] {
        let errors =
            zone(29, 100_000, axis, [FRAC_PI_2 + from, FRAC_PI_2 + to]).map(|v| angle_deg(v, round_trip(v)));
        half[1] = errors.fold(half[1], f64::max);
    }
    [front[0], behind[0], front[1], behind[1]]
}

/// The trade that the docs tell is what is measured, within 1 % in the mean; no error is 1 % above the largest, which
/// is of 20 times as many directions, and some is within 10 % of it.
#[test]
fn density_trades_as_documented() {
    let (axis, docs) = (normalize(AXIS.map(f64::from)), include_str!("../shader-crate/src/wrap/dense.rs"));
    let mut rows = 0;
    for line in docs.lines().filter(|line| line.starts_with("//! | `")) {
        let cells: Vec<&str> = line[5..].split('|').map(str::trim).collect();
        let dense = cells[1].parse().ok().map(|ratio| Dense::<OctPrecise16>::new(AXIS, ratio));
        let measured = match (cells[0], dense) {
            ("`oct16p`", None) => halves(|v| OctPrecise16::decode(OctPrecise16::encode(v)), axis),
            ("`oct16p`", Some(dense)) => halves(|v| dense.decode(dense.encode(v)), axis),
            (other, _) => panic!("{other}"),
        };
        println!("{} {} {measured:.4?}", cells[0], cells[1]);
        for (n, told) in cells[2..6].iter().map(|cell| cell.parse::<f64>().unwrap()).enumerate() {
            let range = [0.99..1.01, 0.99..1.01, 0.9..1.01, 0.9..1.01][n].clone();
            assert!(range.contains(&(measured[n] / told)), "{line}: {measured:.4?}");
        }
        rows += 1;
    }
    assert_eq!(rows, 7);
}

/// Both bounds hold, and are the closed forms: `sqrt(r)`, and in front, away from the border, `(r + 1) / (2 sqrt r)`.
#[test]
fn density_keeps_its_bounds() {
    let axis = normalize(AXIS.map(f64::from));
    for ratio in [1.0, 2.0, 4.0, 16.0, 64.0] {
        let dense = Dense::<OctPrecise16>::new(AXIS, ratio);
        let (root, e) = (f64::from(ratio).sqrt(), f64::from(OctPrecise16::MAX_ERROR_DEG));
        let [whole, front] = [dense.max_error_deg(), dense.max_front_error_deg()].map(f64::from);
        assert!(
            (whole / (e * root) - 1.0).abs() < 1e-4
                && (front / (e * (root + 1.0 / root) / 2.0) - 1.0).abs() < 1e-4
        );
        let error = |v: Vec3| angle_deg(v, dense.decode::<Vec3>(dense.encode(v)));
        let border = FRAC_PI_2 - front.to_radians();
        let zones = [
            ([0.0, border], front),
            ([border * 0.97, border], front),
            ([0.0, PI], whole),
            ([1.5, 1.65], whole),
        ];
        for (n, (zone_of, bound)) in zones.into_iter().enumerate() {
            let most = zone(31, 60_000, axis, zone_of).map(error).fold(0f64, f64::max);
            assert!(most <= bound, "{ratio} {n}: {most} of {bound}");
            assert!(n != 3 || ratio > 16.0 || most > 0.7 * bound, "{ratio}: {most} of {bound}");
        }
    }
}

/// Every code decodes to a unit vector and comes back; the map is continuous at its border; r = 1 is the codec.
#[test]
fn density_is_total_stable_and_continuous() {
    for ratio in [1.0, DEFAULT_RATIO, 64.0] {
        let dense = Dense::<OctPrecise16>::new(AXIS, ratio);
        for code in 0..1u32 << 16 {
            let v: Vec3 = dense.decode(code);
            assert!((length(widen(v)) - 1.0).abs() <= LENGTH_ROUNDING, "{code:#x}: {v}");
            assert_eq!(dense.decode::<Vec3>(dense.encode(v)), v, "{ratio}: {code:#x}");
        }
        let front = zone(37, 2000, normalize(AXIS.map(f64::from)), [FRAC_PI_2 - 1e-6, FRAC_PI_2 + 1e-6]);
        for v in front {
            let z = 1.0 - 2.0 * f64::from(ratio) / (f64::from(ratio) + 1.0);
            assert!((f64::from(dense.image(v).z) - z).abs() < 4e-6, "{ratio} {v}: {}", dense.image(v));
        }
    }
    let plain = Dense::<Oct32>::new([0.0, 0.0, 1.0], f32::NAN);
    for v in sphere(41, 10_000) {
        assert!(angle_deg(plain.image(v), v) < 4.0 * ROUNDING_DEG, "{v}");
        assert!(dot(widen(plain.of_image(v)), widen(v)) > 0.9999);
    }
}

/// Places are codes again, at every width, and every pattern has the vector of its place's code.
#[test]
fn places_are_codes() {
    fn check<C: Codec<Code = u32>>(to: fn(u32) -> u32, from: fn(u32) -> u32, code: u32) {
        let (place, vector) = (to(code), C::decode::<[f32; 3]>(code));
        assert_eq!(C::decode::<[f32; 3]>(from(place)), vector, "{code:#x}");
        assert_eq!(to(from(place)), place, "{code:#x}");
    }
    let mut rng = Rng::new(43);
    for code in (0..1 << 16).chain((0..50_000).map(|_| rng.bits() as u32)) {
        check::<EaOct16>(to_morton::<16>, from_morton::<16>, code & 0xffff);
        check::<EaOct24>(to_morton::<24>, from_morton::<24>, code & 0xff_ffff);
        check::<EaOct32>(to_morton::<32>, from_morton::<32>, code);
    }
}

/// The codes of a prefix have the area that their number is of all, and their vectors are near each other: for all 256
/// prefixes of 8 bits. The area is counted by even directions, 400 to a cell.
#[test]
fn prefixes_are_cells_of_equal_area() {
    let mut count = [0u32; 256];
    let mut middle = [[0f64; 3]; 256];
    let place = |v: Vec3| (to_morton::<16>(EaOct16::encode(v)) >> 8) as usize;
    for v in sphere(47, 256 * 400) {
        let at = place(v);
        count[at] += 1;
        middle[at] = [0, 1, 2].map(|i| middle[at][i] + f64::from(v[i]));
    }
    // Five standard deviations, and the row of codes that is not in use: 1/16 of a cell, in either direction.
    assert!(count.iter().all(|n| (270..=555).contains(n)), "{count:?}");
    // A cell is 2 / 16 of the square's width, and half a diagonal long at most, twice as much from its mean direction.
    let most = 2.0 * 3.24 * 2f64.sqrt() / 16.0 * 180.0 / PI;
    for v in sphere(53, 20_000) {
        assert!(angle_deg(narrow(middle[place(v)]), v) < most, "{v}");
    }
}

/// Ranges of cones, in order and apart, have all codes inside, by trial of all of 16 bits; at the level of codes others
/// are within 2.2 degrees of the rim, which is the bound of a cell of one code.
#[test]
fn cones_have_all_their_codes() {
    let codes = 0..1u32 << 16;
    let placed: Vec<(u32, Vec3)> = codes.map(|code| (to_morton::<16>(code), EaOct16::decode(code))).collect();
    let mut rng = Rng::new(59);
    for (n, axis) in AXES.into_iter().chain(sphere(61, 9)).enumerate() {
        let half_angle = [0.0, 0.02, 0.3, 1.5, 3.0][n % 5] * rng.range(0.5, 1.0);
        let off: Vec<f64> =
            placed.iter().map(|(_, v)| angle_deg(axis, *v) - half_angle.to_degrees()).collect();
        for levels in [0, 3, 6, 99] {
            let ranges: Vec<_> = Cone::<16>::new(axis, half_angle as f32, levels).collect();
            assert!(ranges.windows(2).all(|pair| pair[0].end() + 1 < *pair[1].start()), "{ranges:?}");
            let mut is_in = vec![false; 1 << 16];
            ranges.into_iter().flatten().for_each(|place| is_in[place as usize] = true);
            for ((place, v), off) in placed.iter().zip(&off) {
                let is_in = is_in[*place as usize];
                assert!(is_in || *off > 0.0, "{axis} {half_angle} {levels}: {v}");
                assert!(!is_in || levels < 8 || *off < 2.2, "{axis} {half_angle} {levels}: {v} {off}");
            }
        }
    }
    let all: Vec<_> = Cone::<32>::new([0.0; 3], f32::NAN, 4).collect();
    assert_eq!(all, [0..=u32::MAX]);
}
