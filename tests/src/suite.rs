//! The tests of every codec in the list: a function a property. A codec's differences from the others are in
//! [`expected`].

use crate::checks::{assert_bounded, assert_commutes, assert_decodes, assert_is_code_of, assert_stable};
use crate::directions::{AXES, Rng, any_vector, hemisphere, near_planes, sphere};
use crate::expected;
use crate::tested::{Tested, narrow, portions, widen};
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use unitvec::direction::{MAX_NORM, MIN_NORM, is_usable, l1_norm};
use unitvec_catalogue::Domain;
use unitvec_oracle::{Summary, angle_deg, normalize};
use unitvec_run::sampling::special_vectors;

/// Calls the macro `callback` with the names of the suite's functions.
#[macro_export]
macro_rules! for_each_property {
    ($callback:ident! { $($first:tt)* }) => {
        $callback! {
            $($first)*
            decodes_as_the_oracle, round_trip_is_stable, other_devices_vectors_come_back, symmetric, keeps_the_axes, errors_are_the_expected_ones,
            takes_anything, norms_end_where_the_contract_says, length_does_not_matter, denormals_count_as_zero,
            errors_are_the_oracles, null_code_is_never_written, null_code_is_for_no_direction
        }
    };
}

/// Codecs of at most this many bits are tested over all their codes, wider ones over a part: every third or ninth code, so that
/// every value of each half of a code is among them. `cargo xtask test --exhaustive` takes the others too.
const EVERY_CODE: u32 = 20;

/// Uniform directions of the codec's domain.
fn uniform(codec: &Tested, seed: u64, count: usize) -> Box<dyn Iterator<Item = Vec3>> {
    match codec.domain {
        Domain::Sphere => Box::new(sphere(seed, count)),
        Domain::Hemisphere => Box::new(hemisphere(seed, count)),
    }
}

/// 10^6 of them, the same for all codecs.
fn million(domain: Domain) -> &'static [Vec3] {
    static SPHERE: LazyLock<Vec<Vec3>> = LazyLock::new(|| sphere(5, 1_000_000).collect());
    static HEMISPHERE: LazyLock<Vec<Vec3>> = LazyLock::new(|| hemisphere(5, 1_000_000).collect());
    if domain == Domain::Sphere { &SPHERE } else { &HEMISPHERE }
}

/// Directions all over the sphere, and near the coordinate planes and axes: the same for all codecs.
fn directions(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    type Made = BTreeMap<(u64, usize), Arc<[Vec3]>>;
    static MADE: Mutex<Made> = Mutex::new(BTreeMap::new());
    let make = || sphere(seed, count).chain(near_planes(seed + 1, count / 2).map(Vec3::normalize)).collect();
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let made = made.entry((seed, count)).or_insert_with(make).clone();
    (0..made.len()).map(move |i| made[i])
}

/// Codes decode to the reference's vectors, to unit length to 2 ULP where the codec promises it, without -0, and the
/// bits above the code do not count.
pub fn decodes_as_the_oracle(codec: &Tested) {
    let codes = codec.codes(1, EVERY_CODE);
    assert_decodes(codec, codes, expected::settled_share(codec));
}

/// Codes, and those of directions, decoded, encoded and decoded, give the first vector, exactly.
pub fn round_trip_is_stable(codec: &Tested) {
    let codes = codec.codes(2, EVERY_CODE);
    if expected::is_stable(codec) {
        let of_directions = portions(directions(3, 200_000)).flat_map(|vectors| codec.encode_all(&vectors));
        assert_stable(codec, codes.chain(of_directions));
        return;
    }
    // Half of them: without the table to look up, the best lengths take microseconds to find.
    for code in codes.step_by(2) {
        let once = codec.decode(code);
        let once = if once == Vec3::ZERO { Vec3::Z } else { once };
        assert_bounded(codec, codec.error_deg(once));
    }
}

/// Vectors decoded on a device that divides less exactly come back the same: each component up to 4 ULP off, more than
/// division within 2.5 ULP and the product after it make. Codes of 48 bits and more have no such room. Nor do codes at
/// the sextants' borders: in `parallel.rs` only the component is off that a square root gives.
pub fn other_devices_vectors_come_back(codec: &Tested) {
    if !expected::is_stable(codec) || codec.bits >= 48 || codec.family == "parallel" {
        return;
    }
    let mut rng = Rng::new(11);
    let mut moved = |c: f32| c * (1.0 + ((rng.bits() % 3) as f32 - 1.0) * 4.0 * f32::EPSILON);
    for codes in portions(codec.codes(12, 16)) {
        let decoded = codec.decode_all(&codes);
        let off: Vec<Vec3> = decoded.iter().map(|v| Vec3::from_array(v.to_array().map(&mut moved))).collect();
        let back = codec.decode_all(&codec.encode_all(&off));
        for (i, code) in codes.iter().enumerate() {
            assert_eq!(back[i], decoded[i], "{}: {code:#x} comes back as another of {:?}", codec.id, off[i]);
        }
    }
}

/// The image of a direction comes back as the image of the direction's decoded vector.
pub fn symmetric(codec: &Tested) {
    assert_commutes(codec, directions(4, 100_000), expected::symmetries(codec));
}

/// The axes come back exactly where the codec promises it, and not all of them where it says that they do not; -Z as +Z
/// on a hemisphere.
pub fn keeps_the_axes(codec: &Tested) {
    let axes = if codec.domain == Domain::Sphere { &AXES[..] } else { &AXES[..5] };
    let lost: Vec<Vec3> = axes
        .iter()
        .copied()
        // CrytekBFN returns the direction, at the length of its cell.
        .filter(|&axis| match codec.id {
            "crytek_bfn24" => codec.error_deg(axis) > 0.0,
            _ => codec.round_trip(axis) != axis,
        })
        .collect();
    assert_eq!(lost.is_empty(), codec.exact_axes, "{}: {lost:?}", codec.id);
    if codec.domain == Domain::Hemisphere {
        assert_eq!(codec.encode(Vec3::NEG_Z), codec.encode(Vec3::Z), "{}", codec.id);
    }
}

/// Mean and maximum over 10^6 directions are those in [`expected::errors`]; they keep to the codec's own bound, also
/// next to the coordinate planes.
pub fn errors_are_the_expected_ones(codec: &Tested) {
    let ours = Summary::of(codec.errors_deg(million(codec.domain).iter().copied()));
    println!("{}: {ours:?}, at most {}, {:?}", codec.id, codec.max_error_deg(), expected::errors(codec));
    assert_bounded(codec, ours.max);
    assert!(
        ours.max >= expected::part_of_the_bound(codec) * f64::from(codec.max_error_deg()),
        "{}: {ours:?}",
        codec.id
    );
    let planes = near_planes(6, 200_000).map(Vec3::normalize);
    let planes = planes.filter(|v| codec.domain == Domain::Sphere || v.z >= 0.0);
    assert_bounded(codec, Summary::of(codec.errors_deg(planes)).max);
    if let Some(expected) = expected::errors(codec) {
        let [below, above] = expected.mean_within;
        let mean = ours.mean / expected.mean - 1.0;
        assert!((-below..=above).contains(&mean), "{}: {ours:?} for {expected:?}: {mean}", codec.id);
        assert!(ours.max <= expected.max, "{}: {ours:?} for {expected:?}", codec.id);
    }
}

/// Zeros, denormals, infinities, NaN, huge and tiny numbers, and any bit patterns taken as floats. In a slice they have the codes
/// that they have alone.
pub fn takes_anything(codec: &Tested) {
    let mut rng = Rng::new(7);
    let any = (0..100_000).map(|i| any_vector(&mut rng, i % 2 == 0));
    for vectors in portions(special_vectors().into_iter().map(Vec3::from_array).chain(any)) {
        for (code, v) in codec.encode_all(&vectors).into_iter().zip(vectors) {
            assert_eq!(codec.encode(v), code, "{}: {v:?} in a slice", codec.id);
            assert_is_code_of(codec, v, code, f64::from(codec.max_error_deg()));
        }
    }
}

/// The range of usable L1 norms is exactly [2^-64, 2^100).
pub fn norms_end_where_the_contract_says(codec: &Tested) {
    for axis in [Vec3::X, Vec3::NEG_Y] {
        for norm in [MIN_NORM.next_down(), MAX_NORM] {
            assert_eq!(codec.encode(axis * norm), codec.encode(Vec3::Z), "{}: {axis} {norm:e}", codec.id);
        }
        for norm in [MIN_NORM, MAX_NORM.next_down()].into_iter().filter(|_| codec.is_directional()) {
            assert_eq!(codec.encode(axis * norm), codec.encode(axis), "{}: {axis} {norm:e}", codec.id);
        }
    }
}

/// Scaled by a power of two within the range of usable norms, a vector keeps its code, unless its components are stored as
/// they are.
pub fn length_does_not_matter(codec: &Tested) {
    for v in directions(8, 1000).filter(|_| codec.is_directional()) {
        // Vectors below a hemisphere may be too short on its rim.
        let v = narrow(normalize(codec.reference.domain(widen(v))));
        let code = codec.encode(v);
        for exponent in -63..=98 {
            assert_eq!(codec.encode(v * 2f32.powi(exponent)), code, "{}: {v:?} 2^{exponent}", codec.id);
        }
    }
}

/// Components that are -0 or a denormal count as +0, however small the vector, and beside a tie between two steps too: it is
/// not left to a device's treatment of them. Where an octahedron is unfolded, their sign may choose between two points of
/// the square's border, which decode to the same vector.
pub fn denormals_count_as_zero(codec: &Tested) {
    let flush = |c: f32| if c.is_subnormal() || c == 0.0 { 0.0 } else { c };
    let flushed = |v: [f32; 3]| v.map(flush);
    let odd = special_vectors()
        .into_iter()
        .chain(ties(codec))
        .filter(|v| v.map(f32::to_bits) != flushed(*v).map(f32::to_bits));
    let is_unfolded = codec.id.starts_with("oct") || codec.id.starts_with("eaoct");
    let mut count = 0;
    for v in odd {
        let [code, expected] = [v, flushed(v)].map(|v| codec.encode(Vec3::from_array(v)));
        let is_mirrored = is_unfolded && codec.decode(code) == codec.decode(expected);
        assert!(code == expected || is_mirrored, "{}: {v:?} {code:x?} {expected:x?}", codec.id);
        count += 1;
    }
    assert!(count > 10_000);
}

/// Points of the coordinate planes halfway between two lattice points, with a denormal or -0 for the third component, at
/// length 1 and next to the least usable one.
fn ties(codec: &Tested) -> impl Iterator<Item = [f32; 3]> {
    let m = ((1u64 << (codec.bits / 2 - 1).min(23)) - 1) as f32;
    let tiny =
        [-0.0, -1e-40, f32::from_bits(1), f32::MIN_POSITIVE.next_down(), -f32::MIN_POSITIVE.next_down()];
    let mut rng = Rng::new(9);
    (0..2000).flat_map(move |i| {
        let along = (rng.range(0.0, f64::from(m)) as f32).floor() + 0.5;
        let scale = if i % 2 == 0 { 1.0 / m } else { 2.0 * MIN_NORM / m };
        let sign = if rng.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let (a, b, t) = (sign * along * scale, (m - along) * scale, tiny[i % tiny.len()]);
        [[t, a, b], [a, t, b], [a, b, t], [t, t, b]]
    })
}

/// The mean error is that of exact arithmetic, to 1 %.
pub fn errors_are_the_oracles(codec: &Tested) {
    if expected::is_finer_than_f32(codec) {
        return;
    }
    let pairs: Vec<[f64; 2]> = uniform(codec, 10, 5_000)
        .map(|v| [codec.error_deg(v), angle_deg(widen(v), codec.reference.round_trip(widen(v)))])
        .collect();
    let [ours, exact] = [0, 1].map(|i| Summary::of(pairs.iter().map(|pair| pair[i])).mean);
    assert!((ours / exact - 1.0).abs() <= 0.01, "{}: {ours} and {exact}", codec.id);
}

/// No vector gets the null code. Where there is none, every code comes back, so that there is no room for one.
pub fn null_code_is_never_written(codec: &Tested) {
    let codes = codec.codes(13, EVERY_CODE).step_by(if codec.family == "best_fit" { 8 } else { 1 });
    let decoded = portions(codes).map(|codes| (codec.decode_all(&codes), codes));
    let Ok(null) = codec.null() else {
        let mut again = decoded.map(|(vectors, codes)| (codec.encode_all(&vectors), codes));
        return assert!(again.all(|(again, codes)| again == codes), "{}: has room", codec.id);
    };
    let mut rng = Rng::new(14);
    let any = (0..100_000).map(|i| any_vector(&mut rng, i % 2 == 0)).chain(directions(15, 100_000));
    for vectors in portions(any).chain(decoded.map(|(vectors, _)| vectors)) {
        for (code, v) in codec.encode_all(&vectors).into_iter().zip(vectors) {
            assert_ne!(code, null.code, "{}: {v:?}", codec.id);
        }
    }
}

/// Vectors without a direction get the null code and come back as zeros, whatever the bits above the code. All others
/// have their codes and vectors.
pub fn null_code_is_for_no_direction(codec: &Tested) {
    let Ok(null) = codec.null() else { return };
    for v in special_vectors() {
        let code = codec.encode(v.into());
        let is_null = !is_usable(l1_norm(v.into()));
        let expected = if is_null { null.code } else { code };
        assert_ne!(code, null.code, "{}: {v:?}", codec.id);
        let mut bytes = code.to_le_bytes();
        assert_eq!(null.put(&v, &mut bytes[..codec.bytes]), Ok(is_null.into()));
        assert_eq!(u64::from_le_bytes(bytes), expected, "{}: {v:?}", codec.id);
        let decoded = codec.decode(expected).to_array();
        let mut cleared = decoded;
        null.clear(&(expected | !codec.mask()).to_le_bytes()[..codec.bytes], &mut cleared).unwrap();
        assert_eq!(cleared, if is_null { [0.0; 3] } else { decoded }, "{}: {v:?}", codec.id);
    }
}
