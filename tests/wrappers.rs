//! Axes, directions of the plane and vectors with a length.

use glam::{Vec2, Vec3};
use half::f16;
use std::collections::HashSet;
use unitvec::codec::RawCode;
use unitvec::wrap::with_length::WithLength;
use unitvec::*;
use unitvec_oracle::{Summary, length};
use unitvec_run::sampling::special_vectors;
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::{AXES, Rng, any_vector, near_octant_middles, near_planes, sphere, usable};
use unitvec_tests::tested::widen;

/// The code as one number.
fn number<C: Codec>(v: Vec3) -> u64 {
    let [low, high] = C::encode_vec3(v).to_words();
    u64::from(low) | u64::from(high) << 32
}

fn decoded<C: Codec>(code: u64) -> Vec3 {
    C::decode_vec3(C::Code::from_words([code as u32, (code >> 32) as u32]))
}

/// Vectors of all kinds, and among them every combination of zeros of both signs, denormals and numbers.
fn vectors(seed: u64) -> impl Iterator<Item = Vec3> {
    let small = [0.0, -0.0, 1e-40, -1e-40, 1e-6, -1e-6, 0.6, -0.8];
    let combined = small
        .into_iter()
        .flat_map(move |x| small.into_iter().flat_map(move |y| small.map(move |z| [x, y, z])));
    let mut rng = Rng::new(seed);
    let any = (0..40_000).map(move |n| any_vector(&mut rng, n % 2 == 0));
    let special = special_vectors().into_iter().chain(combined).map(Vec3::from_array);
    special.chain(any).chain(sphere(seed, 40_000)).chain(near_planes(seed, 40_000))
}

/// The angle between axes.
fn axes_apart(a: Vec3, b: Vec3) -> f64 {
    let angle = angle_deg(a, b);
    angle.min(180.0 - angle)
}

/// v and -v have one code, whatever their zeros' signs are, and an error within the bound.
#[test]
fn both_ends_of_an_axis_have_one_code() {
    fn check<C: Codec>() {
        for v in vectors(61) {
            let code = number::<C>(v);
            assert_eq!(code, number::<C>(-v), "{v:?}");
            match usable(v) {
                Some(true) => {
                    let error = axes_apart(v, decoded::<C>(code));
                    assert!(error <= f64::from(C::MAX_ERROR_DEG), "{v:?}: {error} degrees");
                }
                Some(false) => assert_eq!(code, number::<C>(Vec3::Z), "{v:?}"),
                None => {}
            }
        }
        for v in AXES {
            assert_eq!(decoded::<C>(number::<C>(v)), v.abs());
        }
    }
    check::<Axial16>();
    check::<Axial24>();
    check::<Axial32>();
}

/// Codes of the border of the square, which is the equator, and some others.
fn axial_codes(bits: u32) -> Vec<u64> {
    let half = bits / 2;
    let field = |i: i64| (i & ((1 << half) - 1)) as u64;
    let m = (1i64 << (half - 1)) - 1;
    let mut rng = Rng::new(62);
    let border = (-m..=m).step_by(if bits == 32 { 31 } else { 1 }).chain([-1, 0, 1, m]);
    let border = border.flat_map(|i| [[i, m], [i, -m], [m, i], [-m, i]]);
    let codes = border.map(|[u, v]| field(u) | field(v) << half).collect::<Vec<_>>();
    if bits == 16 {
        (0..1 << 16).collect()
    } else {
        [codes, (0..50_000).map(|_| rng.bits() >> (64 - bits)).collect()].concat()
    }
}

/// Of all codes the decoded axis comes back, of those that encoders write the code too, and no two of these are one axis. All
/// codes of 16 bits: m + 1 points a side of the hemisphere's square, of which half the border and the doubles are left out.
#[test]
fn an_axis_has_one_code() {
    fn check<C: Codec>() {
        let (mut written, mut axes) = (HashSet::new(), HashSet::new());
        for code in axial_codes(C::BITS) {
            let v = decoded::<C>(code);
            let own = number::<C>(v);
            let end = decoded::<C>(own);
            assert!(end == v || end == -v, "{code:#x}: {v:?}, {end:?}");
            assert_eq!(number::<C>(end), own, "{code:#x}");
            let first = if end.z != 0.0 {
                end.z
            } else if end.x != 0.0 {
                end.x
            } else {
                end.y
            };
            assert!(first > 0.0, "{code:#x}: {end:?}");
            if written.insert(own) {
                assert!(axes.insert(end.to_array().map(f32::to_bits)), "{code:#x}: {end:?} twice");
            }
        }
        assert!(C::BITS > 16 || written.len() == 255 * 255 - 4 * 127, "{}", written.len());
    }
    check::<Axial16>();
    check::<Axial24>();
    check::<Axial32>();
}

/// No code of 16 bits is nearer, near the equator either; mean and maximum are those of the module's table, below those of
/// oct16p.
#[test]
fn axes_get_the_nearest_code() {
    let all: Vec<Vec3> = (0..1 << 16).map(decoded::<Axial16>).collect();
    for v in sphere(63, 200).chain(near_planes(64, 200)) {
        let nearest = all.iter().map(|&other| axes_apart(v, other)).fold(f64::INFINITY, f64::min);
        let taken = axes_apart(v, decoded::<Axial16>(number::<Axial16>(v)));
        assert!(taken - nearest < 1e-4, "{v:?}: {taken} and {nearest}");
    }
    let errors = |directions: &mut dyn Iterator<Item = Vec3>| {
        Summary::of(directions.map(|v| axes_apart(v, decoded::<Axial16>(number::<Axial16>(v)))))
    };
    let of_oct =
        sphere(65, 400_000).map(|v| angle_deg(v, decoded::<OctPrecise16>(number::<OctPrecise16>(v))));
    let (of_axes, of_oct) = (errors(&mut sphere(65, 400_000)), Summary::of(of_oct));
    let worst = errors(&mut near_octant_middles(77, 100_000, 0.01)).max;
    println!("{of_axes:?}, {worst} for {of_oct:?}");
    assert!((of_axes.mean - 0.239).abs() < 5e-4 && (worst - 0.552).abs() < 1e-3, "{of_axes:?}, {worst}");
    assert!(of_axes.mean < 0.77 * of_oct.mean && worst < 0.89 * of_oct.max, "{of_oct:?}");
}

/// The slices, null codes and bare codes of codecs serve axes and vectors with a length.
#[test]
fn wrappers_are_codecs() {
    let vectors: Vec<[f32; 3]> =
        sphere(66, 100).map(|v| v.to_array()).chain([[0.0; 3], [f32::NAN; 3]]).collect();
    let mut bytes = vec![0; vectors.len() * 6];
    let mut back = vec![[0.0; 3]; vectors.len()];
    slice::encode_slice::<Vector48>(&vectors, &mut bytes).unwrap();
    slice::decode_slice::<Vector48>(&bytes, &mut back).unwrap();
    let expected = |v: &[f32; 3]| Code::<Vector48>::encode(*v).decode::<[f32; 3]>();
    assert_eq!(back, vectors.iter().map(expected).collect::<Vec<_>>());
    assert_eq!(decoded::<OrNull<Axial16>>(number::<OrNull<Axial16>>(Vec3::ZERO)), Vec3::ZERO);
    assert_eq!(number::<OrNull<Axial16>>(-Vec3::Y), number::<Axial16>(Vec3::Y));
}

/// The direction at so many degrees.
fn at_angle(degrees: f64) -> Vec2 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vec2::new(cos as f32, sin as f32)
}

/// The angle of a vector in degrees, 0 to 360.
fn angle_of(v: Vec2) -> f64 {
    f64::from(v.y).atan2(f64::from(v.x)).to_degrees().rem_euclid(360.0)
}

/// The smaller of the angles between two, in degrees.
fn angles_apart(a: f64, b: f64) -> f64 {
    let turn = (a - b).rem_euclid(360.0);
    turn.min(360.0 - turn)
}

/// Tests of both kinds of angles at three widths.
macro_rules! for_all_angles {
    ($check:ident) => {
        $check::<Angle<8>>(true);
        $check::<Angle<12>>(true);
        $check::<Angle<16>>(true);
        $check::<EqualAngle<8>>(false);
        $check::<EqualAngle<12>>(false);
        $check::<EqualAngle<16>>(false);
    };
}

/// The place of a code: its number of steps, exactly for equal angles. For the diamond the polynomial of the module `frame`, in
/// float64, within 0.0434 degrees of it.
fn place_deg(code: u32, bits: u32, is_diamond: bool) -> f64 {
    let quarters = f64::from(code) / f64::from(1u32 << (bits - 2));
    if !is_diamond {
        return 90.0 * quarters;
    }
    let v = 2.0 * quarters.fract() - 1.0;
    let w = v * (3225.0 + v * v * (624.0 + v * v * 247.0)) / 4096.0;
    let place = 90.0 * quarters.floor() + 45.0 + w.atan().to_degrees();
    assert!((place - 90.0 * quarters).abs() < 0.0434, "{code}: {place}");
    place
}

#[test]
fn angles_decode_to_their_places() {
    fn check<C: AngleCodec>(is_diamond: bool) {
        for code in 0..1u32 << C::BITS {
            let v: Vec2 = C::decode_vec2(code | 0xffff_0000);
            let off = angles_apart(angle_of(v), place_deg(code, C::BITS, is_diamond));
            assert!(off < 1.5e-5, "{code:#x}: {v:?}, {off} degrees");
            assert!((length(widen(v.extend(0.0))) - 1.0).abs() <= LENGTH_ROUNDING, "{code:#x}: {v:?}");
            assert!(v.to_array().iter().all(|t| t.to_bits() != (-0f32).to_bits()), "{code:#x}: {v:?}");
            assert_eq!(C::encode_vec2(v), code, "{v:?}");
        }
        let quarter = 1 << (C::BITS - 2);
        for (n, axis) in (0..).zip([Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y]) {
            assert_eq!((C::encode_vec2(axis), C::decode_vec2(n * quarter)), (n * quarter, axis));
            let diagonal: Vec2 = C::decode_vec2(n * quarter + quarter / 2);
            assert!(diagonal.x.abs() == diagonal.y.abs(), "{diagonal:?}");
            assert_eq!(C::encode_vec2(axis + axis.perp()), n * quarter + quarter / 2);
        }
    }
    for_all_angles!(check);
}

/// Errors keep to the bound, which is near that of the best code, `180 / 2^bits`, and their mean is half of it.
#[test]
fn angles_are_within_half_a_step() {
    fn check<C: AngleCodec>(is_diamond: bool) {
        let (best, bound) = (180.0 / f64::from(1u32 << C::BITS), f64::from(C::MAX_ERROR_DEG));
        let mut rng = Rng::new(67);
        let errors = Summary::of((0..200_000).map(|_| {
            let degrees = rng.range(0.0, 360.0);
            let v = at_angle(degrees) * 2f32.powi((rng.bits() % 120) as i32 - 60);
            angles_apart(angle_of(C::decode_vec2(C::encode_vec2(v))), degrees)
        }));
        println!("{} bits, diamond {is_diamond}: {errors:?} bound {bound} best {best}", C::BITS);
        assert!(errors.max <= bound && errors.max >= 0.999 * best, "{errors:?}, {bound}");
        assert!(bound <= best * if is_diamond { 1.0067 } else { 1.0 } + 3e-5, "{bound}, {best}");
        assert!((errors.mean / (0.5 * best) - 1.0).abs() < 0.01, "{errors:?}");
    }
    for_all_angles!(check);
}

#[test]
fn vectors_of_the_plane_without_a_direction_get_code_0() {
    fn check<C: AngleCodec>(_: bool) {
        let none = [0.0, -0.0, 1e-40, -1e-40, 1e-30, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
        for v in none.into_iter().flat_map(|x| [[x, 0.0], [-0.0, x], [x, -x], [f32::NAN, x]]) {
            assert_eq!(C::encode(v), 0, "{v:?}");
        }
        for zero in [0.0, -0.0, 1e-40, -1e-40] {
            let half = 1 << (C::BITS - 1);
            assert_eq!([[1.0, zero], [-1.0, zero]].map(C::encode::<[f32; 2]>), [0, half]);
            assert_eq!([[zero, 1.0], [zero, -1.0]].map(C::encode::<[f32; 2]>), [half / 2, half / 2 * 3]);
        }
    }
    for_all_angles!(check);
}

/// A codec of vectors with a length, as numbers.
trait Lengths: Codec {
    const DIRECTION_BITS: u32;
    const STEPS: u32;
    const LOW: i32;
    const RELATIVE: f32;

    /// The code of a length, least first.
    fn steps(code: u64) -> u64 {
        code >> Self::DIRECTION_BITS
    }

    /// The length of a code above 0.
    fn exact(steps: u64) -> f64 {
        (f64::from(Self::LOW) + (steps as f64 - 1.0) / f64::from(Self::STEPS)).exp2()
    }
}

impl<C: Codec, W: RawCode, const B: u32, const S: u32, const L: i32> Lengths for WithLength<C, W, B, S, L> {
    const DIRECTION_BITS: u32 = C::BITS;
    const STEPS: u32 = S;
    const LOW: i32 = L;
    const RELATIVE: f32 = Self::MAX_RELATIVE_ERROR;
}

/// Tests of the three formats, and of one whose length is shared by both words.
macro_rules! for_all_lengths {
    ($check:ident) => {
        $check::<Vector32>();
        $check::<VectorBalanced32>();
        $check::<Vector48>();
        $check::<WithLength<OctPrecise22, [u32; 2], 17, 2048, -30>>();
    };
}

/// Every length is the power of two that the module states, to 4e-7, and comes back with its direction. Along the axes whole
/// powers are exact.
#[test]
fn lengths_are_powers_of_two() {
    fn check<C: Lengths>() {
        let (mut rng, most) = (Rng::new(68), (1u64 << (C::BITS - C::DIRECTION_BITS)) - 1);
        for n in (1..=most).step_by(if most > 1 << 16 { 7 } else { 1 }).chain([most]) {
            let code = n << C::DIRECTION_BITS | rng.bits() >> (64 - C::DIRECTION_BITS);
            let v = decoded::<C>(code);
            let ratio = length(widen(v)) / C::exact(n);
            assert!((ratio - 1.0).abs() < 4e-7, "{code:#x}: {v:?}, {ratio}");
            assert_eq!(decoded::<C>(number::<C>(v)), v, "{code:#x}");
            assert_eq!(C::steps(number::<C>(v)), n, "{v:?}");
        }
        for exponent in C::LOW..=C::LOW + ((most - 1) / u64::from(C::STEPS)) as i32 {
            for v in AXES.map(|axis| axis * 2f32.powi(exponent)) {
                assert_eq!(decoded::<C>(number::<C>(v)), v);
            }
        }
    }
    for_all_lengths!(check);
}

/// Zero, NaN and infinity, and lengths beyond the range; the directions of the longest vectors are the codec's.
#[test]
fn lengths_beyond_the_range_are_clamped() {
    fn check<C: Lengths>() {
        let most = (1u64 << (C::BITS - C::DIRECTION_BITS)) - 1;
        let least = C::exact(1) as f32;
        let greatest = C::exact(most) as f32;
        for v in vectors(69).filter(|v| !v.is_finite()) {
            let expected = if v.is_nan() { 0 } else { most };
            assert_eq!(C::steps(number::<C>(v)), expected, "{v:?}");
        }
        for zero in [Vec3::ZERO, -Vec3::ZERO, Vec3::splat(1e-40), Vec3::X * f32::NAN, Vec3::Y * 1e-20] {
            assert_eq!((number::<C>(zero), decoded::<C>(number::<C>(zero))), (0, Vec3::ZERO), "{zero:?}");
        }
        for v in sphere(70, 1000) {
            let direction = number::<C>(v) % (1 << C::DIRECTION_BITS);
            assert_eq!(number::<C>(v * (0.47 * least)), 0);
            for size in [0.5 * least, least] {
                assert_eq!(number::<C>(v * size), 1 << C::DIRECTION_BITS | direction, "{v:?} {size}");
            }
            for exponent in [greatest.log2().ceil() as i32, 63, 64, 100, 127] {
                let code = number::<C>(v * 2f32.powi(exponent));
                assert_eq!(code, most << C::DIRECTION_BITS | direction, "{v:?} {exponent}");
            }
        }
        let infinite = Vec3::new(3.0, f32::NEG_INFINITY, 1e38);
        assert!(angle_deg(decoded::<C>(number::<C>(infinite)), Vec3::new(0.0, -3.4, 1.0)) < 0.3);
        assert_eq!(decoded::<C>(number::<C>(Vec3::Z * f32::INFINITY)).truncate(), Vec2::ZERO);
    }
    for_all_lengths!(check);
}

/// Vectors in random directions, of lengths from 2^-13 to 2^15 whose logarithm is uniform.
fn long_and_short(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    sphere(seed + 1, count).map(move |v| v * rng.range(-13.0, 15.0).exp2() as f32)
}

/// Mean and maximum of `|d - v| / |v|`.
fn relative_errors(of: impl Fn(Vec3) -> Vec3) -> Summary {
    Summary::of(long_and_short(71, 400_000).map(|v| {
        let (a, b) = (widen(v), widen(of(v)));
        length([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / length(a)
    }))
}

/// The signed analogue of R9G9B9E5 (Khronos Data Format 1.3, 10.3.1): a sign and 8 bits a component, 5 bits of exponent with
/// the bias 15. A component is a whole multiple of `2^(exponent - 15 - 8)`.
fn shared_exponent(v: Vec3) -> Vec3 {
    let largest = v.abs().max_element();
    let of = |exponent: i32| 2f32.powi(exponent - 23);
    let exponent = (largest.log2().floor() as i32 + 16).clamp(0, 31);
    let exponent = if (largest / of(exponent)).round() > 255.0 { exponent + 1 } else { exponent };
    (v / of(exponent)).round().clamp(Vec3::splat(-255.0), Vec3::splat(255.0)) * of(exponent)
}

/// The lengths' logarithms are rounded to the nearest step, and the relative errors keep to the bounds and come near: the
/// module's table.
#[test]
fn relative_errors_keep_to_the_bounds() {
    fn check<C: Lengths>() {
        for v in long_and_short(72, 100_000) {
            let steps = (length(widen(v)).log2() - f64::from(C::LOW)) * f64::from(C::STEPS);
            let off = (C::steps(number::<C>(v)) as f64 - 1.0 - steps).abs();
            assert!(off <= 0.504, "{v:?}: {off}");
        }
        let errors = relative_errors(|v| decoded::<C>(number::<C>(v)));
        println!("{} + {}: {errors:?} of {}", C::DIRECTION_BITS, C::BITS - C::DIRECTION_BITS, C::RELATIVE);
        assert!(errors.max <= f64::from(C::RELATIVE), "{errors:?}");
        assert!(errors.max >= 0.9 * f64::from(C::RELATIVE), "{errors:?}, {}", C::RELATIVE);
    }
    for_all_lengths!(check);

    let of = |errors: Summary| [errors.mean, errors.max];
    let table = [
        ([0.0217, 0.0443], of(relative_errors(|v| decoded::<Vector32>(number::<Vector32>(v))))),
        (
            [0.00204, 0.00378],
            of(relative_errors(|v| decoded::<VectorBalanced32>(number::<VectorBalanced32>(v)))),
        ),
        ([0.00225, 0.00637], of(relative_errors(shared_exponent))),
        ([8.95e-5, 0.000175], of(relative_errors(|v| decoded::<Vector48>(number::<Vector48>(v))))),
        (
            [0.000191, 0.000545],
            of(relative_errors(|v| Vec3::from_array(v.to_array().map(|t| f16::from_f32(t).to_f32())))),
        ),
    ];
    for (stated, measured) in table {
        println!("{stated:?} {measured:?}");
    }
    for (stated, measured) in table {
        let off = [0, 1].map(|i| (measured[i] / stated[i] - 1.0).abs());
        assert!(off[0] < 0.005 && off[1] < 0.05, "{stated:?}, {measured:?}");
    }
}

#[cfg(feature = "glsl")]
mod in_glsl {
    use super::*;
    use crate::glsl::assert_same_words;

    /// A length beside another codec, and the same in GLSL.
    type Beside = WithLength<OctPrecise20, u32, 10, 32, -20>;
    const BESIDE: &str = "(code_of_length(v, 10u, 32u, -20) == 0u ? 0u : \
        oct20p_encode(with_reach(v)) | (code_of_length(v, 10u, 32u, -20) << 20u))";

    /// A call of GLSL, and the same in Rust.
    type Function<'a> = (&'a str, fn([u32; 3]) -> [u32; 3]);

    fn check(functions: &[Function], inputs: &[[u32; 3]]) {
        let owned: Vec<_> =
            functions.iter().map(|(call, function)| ((*call).to_owned(), *function)).collect();
        assert_same_words(&owned, inputs);
    }

    fn vector(w: [u32; 3]) -> Vec3 {
        Vec3::from_array(w.map(f32::from_bits))
    }

    fn plane(w: [u32; 3]) -> Vec2 {
        vector(w).truncate()
    }

    fn words(v: Vec3) -> [u32; 3] {
        v.to_array().map(f32::to_bits)
    }

    /// Encoders of vectors of all kinds give the same codes.
    #[test]
    fn wrappers_encode_with_the_bits_of_rust() {
        let inputs: Vec<_> = vectors(73).chain(long_and_short(74, 20_000)).map(words).collect();
        check(
            &[
                ("uvec3(axial16_encode(v), axial24_encode(v), axial32_encode(v))", |w| {
                    let v = vector(w);
                    [Axial16::encode(v), Axial24::encode(v), Axial32::encode(v)]
                }),
                ("uvec3(angle8_encode(v.xy), angle16_encode(v.yz), eqangle8_encode(v.xy))", |w| {
                    let v = vector(w);
                    [Angle8::encode(plane(w)), Angle16::encode([v.y, v.z]), EqualAngle8::encode(plane(w))]
                }),
                ("uvec3(vector32_encode(v), vector32b_encode(v), eqangle16_encode(v.xy))", |w| {
                    let v = vector(w);
                    [Vector32::encode(v), VectorBalanced32::encode(v), EqualAngle16::encode(plane(w))]
                }),
                (&format!("uvec3(vector48_encode(v), {BESIDE})"), |w| {
                    let [low, high] = Vector48::encode(vector(w));
                    [low, high, Beside::encode(vector(w))]
                }),
            ],
            &inputs,
        );
    }

    /// Decoders of any words give the same vectors.
    #[test]
    fn wrappers_decode_with_the_bits_of_rust() {
        let mut rng = Rng::new(75);
        let random = (0..60_000).map(|_| [(); 3].map(|()| rng.bits() as u32));
        let inputs: Vec<_> = (0..1 << 16).map(|n| [n, n << 20, n]).chain(random).collect();
        check(
            &[
                ("floatBitsToUint(axial16_decode(w.x))", |w| words(Axial16::decode(w[0]))),
                ("floatBitsToUint(axial24_decode(w.x))", |w| words(Axial24::decode(w[0]))),
                ("floatBitsToUint(axial32_decode(w.x))", |w| words(Axial32::decode(w[0]))),
                ("floatBitsToUint(vec3(angle8_decode(w.x), 0.0))", |w| {
                    words(Angle8::decode_vec2(w[0]).extend(0.0))
                }),
                ("floatBitsToUint(vec3(angle16_decode(w.x), 0.0))", |w| {
                    words(Angle16::decode_vec2(w[0]).extend(0.0))
                }),
                ("floatBitsToUint(vec3(eqangle8_decode(w.x), 0.0))", |w| {
                    words(EqualAngle8::decode_vec2(w[0]).extend(0.0))
                }),
                ("floatBitsToUint(vec3(eqangle16_decode(w.x), 0.0))", |w| {
                    words(EqualAngle16::decode_vec2(w[0]).extend(0.0))
                }),
                ("floatBitsToUint(vector32_decode(w.x))", |w| words(Vector32::decode(w[0]))),
                ("floatBitsToUint(vector32b_decode(w.x))", |w| words(VectorBalanced32::decode(w[0]))),
                ("floatBitsToUint(vector48_decode(w.xy))", |w| words(Vector48::decode([w[0], w[1]]))),
                (
                    "floatBitsToUint(unitvec_lengthened(oct20_decode(w.x), length_of_code(w.x >> 20u, 10u, 32u, -20)))",
                    |w| words(Beside::decode(w[0])),
                ),
            ],
            &inputs,
        );
    }
}
