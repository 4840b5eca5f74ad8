//! Axes, directions of the plane and vectors with a length.

use glam::{Vec2, Vec3};
use half::f16;
use serde_json::Value;
use unitvec::codec::RawCode;
use unitvec::*;
use unitvec_oracle::{Summary, length};
use unitvec_run::sampling::special_vectors;
use unitvec_tests::checks::LENGTH_ROUNDING;
use unitvec_tests::directions::{AXES, Rng, near_octant_middles, near_planes, sphere, usable};
use unitvec_tests::program::{self, refusal, run, run_with_input, stderr, stdout};
use unitvec_tests::tested::widen;

/// The code as one number.
fn number<C: Codec>(v: Vec3) -> u64 {
    let [low, high] = C::encode_vec3(v).to_words();
    u64::from(low) | u64::from(high) << 32
}

fn decoded<C: Codec>(code: u64) -> Vec3 {
    C::decode_vec3(C::Code::from_words([code as u32, (code >> 32) as u32]))
}

fn round_trip<C: Codec>(v: Vec3) -> Vec3 {
    decoded::<C>(number::<C>(v))
}

/// Vectors of all kinds, in the plane z = 0 too.
fn vectors(seed: u64) -> impl Iterator<Item = Vec3> {
    let special = special_vectors().into_iter().map(Vec3::from_array);
    let equator = sphere(seed + 9, 20_000).map(|v| v.truncate().extend(0.0));
    special.chain(equator).chain(sphere(seed, 40_000)).chain(near_planes(seed, 40_000))
}

/// The angle between axes.
fn axes_apart(a: Vec3, b: Vec3) -> f64 {
    let angle = angle_deg(a, b);
    angle.min(180.0 - angle)
}

/// v, -v, the decoded vector and its opposite have one code, so that no two codes that encoders write are of one axis.
/// The error is within the bound.
#[test]
fn an_axis_has_one_code() {
    fn check<C: Codec>() {
        for v in vectors(61) {
            let (code, back) = (number::<C>(v), round_trip::<C>(v));
            assert_eq!([-v, back, -back].map(number::<C>), [code; 3], "{v:?}");
            assert!(usable(v) != Some(true) || axes_apart(v, back) <= f64::from(C::MAX_ERROR_DEG), "{v:?}");
            assert!(usable(v) != Some(false) || code == number::<C>(Vec3::Z), "{v:?}");
        }
        assert_eq!(AXES.map(round_trip::<C>), AXES.map(Vec3::abs));
    }
    check::<Axial16>();
    check::<Axial24>();
    check::<Axial32>();
}

/// Every code comes back as the code of its axis. Of 255^2 points of the hemisphere's square, half of the border is
/// left out.
#[test]
fn all_axes_of_16_bits() {
    let is_written = |code: &u64| {
        let v = decoded::<Axial16>(*code);
        let end = round_trip::<Axial16>(v);
        let first = [end.z, end.x, end.y].into_iter().find(|t| *t != 0.0).unwrap();
        assert!((end == v || end == -v) && first > 0.0, "{code:#x}: {v:?}, {end:?}");
        number::<Axial16>(v) == *code
    };
    assert_eq!((0..1 << 16).filter(is_written).count(), 255 * 255 - 4 * 127);
}

/// No code of 16 bits is nearer, near the equator either; mean and maximum are stated, and lie below oct16p's.
#[test]
fn axes_get_the_nearest_code() {
    let all: Vec<Vec3> = (0..1 << 16).map(decoded::<Axial16>).collect();
    let error = |v| axes_apart(v, round_trip::<Axial16>(v));
    for v in sphere(63, 200).chain(near_planes(64, 200)) {
        let nearest = all.iter().map(|&other| axes_apart(v, other)).fold(f64::INFINITY, f64::min);
        assert!(error(v) - nearest < 1e-4, "{v:?}: {} and {nearest}", error(v));
    }
    let mean = Summary::of(sphere(65, 400_000).map(error)).mean;
    let max = Summary::of(near_octant_middles(77, 100_000, 0.01).map(error)).max;
    let of_oct = Summary::of(sphere(65, 400_000).map(|v| angle_deg(v, round_trip::<OctPrecise16>(v))));
    assert!((mean - 0.239).abs() < 5e-4 && (max - 0.552).abs() < 1e-3, "{mean}, {max}");
    assert!(mean < 0.77 * of_oct.mean && max < 0.89 * of_oct.max, "{of_oct:?}");
}

/// Slices, bare codes and null codes serve the wrappers.
#[test]
fn wrappers_are_codecs() {
    let vectors: Vec<Vec3> = sphere(66, 100).chain([Vec3::ZERO, Vec3::NAN]).collect();
    let (mut bytes, mut back) = (vec![0; vectors.len() * 6], vec![Vec3::ONE; vectors.len()]);
    slice::encode_slice::<Vector48>(&vectors, &mut bytes).unwrap();
    slice::decode_slice::<Vector48>(&bytes, &mut back).unwrap();
    assert_eq!(back, vectors.iter().map(|v| Code::<Vector48>::encode(*v).decode()).collect::<Vec<Vec3>>());
    assert_eq!(round_trip::<OrNull<Axial16>>(Vec3::ZERO), Vec3::ZERO);
    assert_eq!(round_trip::<OrNull<Axial16>>(-Vec3::Y), Vec3::Y);
}

/// The smaller of the angles between a vector's and another, in degrees.
fn degrees_apart(v: Vec2, degrees: f64) -> f64 {
    let turn = (f64::from(v.y).atan2(f64::from(v.x)).to_degrees() - degrees).rem_euclid(360.0);
    turn.min(360.0 - turn)
}

/// The angle of a code in degrees. Of the diamond it is that of the polynomial of `arith`, in float64.
fn place_deg(code: u32, bits: u32, is_equal: bool) -> f64 {
    let quarters = f64::from(code) / f64::from(1u32 << (bits - 2));
    let v = 2.0 * quarters.fract() - 1.0;
    let w = v * (3225.0 + v * v * (624.0 + v * v * 247.0)) / 4096.0;
    let place = 90.0 * quarters.floor() + 45.0 + w.atan().to_degrees();
    assert!((place - 90.0 * quarters).abs() < 0.0434, "{code}: {place}");
    if is_equal { 90.0 * quarters } else { place }
}

/// Codes are at their places and come back; errors keep to the bound, which is near that of the best code, and their
/// mean is half of it. Axes and diagonals are exact, with zeros of any kind. Vectors without a direction get the code
/// of +X.
#[test]
fn directions_of_the_plane() {
    fn check<const BITS: u32, const EQUAL: bool>() {
        let (encode, decode) = (Angle::<BITS, EQUAL>::encode::<Vec2>, Angle::<BITS, EQUAL>::decode::<Vec2>);
        for code in 0..1u32 << BITS {
            let v = decode(code | 0xffff_0000);
            assert!(degrees_apart(v, place_deg(code, BITS, EQUAL)) < 1.5e-5, "{code:#x}: {v:?}");
            assert!((length(widen(v.extend(0.0))) - 1.0).abs() <= LENGTH_ROUNDING, "{code:#x}: {v:?}");
            assert!(!v.to_array().map(f32::to_bits).contains(&(-0f32).to_bits()), "{code:#x}: {v:?}");
            assert_eq!(encode(v), code, "{v:?}");
        }
        let quarter = 1 << (BITS - 2);
        for (n, axis) in (0..).zip([Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y]) {
            let zeros = [0.0, -0.0, 1e-40, -1e-40].map(|zero| encode(axis + zero * axis.perp().abs()));
            assert_eq!((zeros, decode(n * quarter)), ([n * quarter; 4], axis));
            let diagonal = decode(n * quarter + quarter / 2);
            assert_eq!(encode(axis + axis.perp()), n * quarter + quarter / 2);
            assert_eq!(diagonal.x.abs(), diagonal.y.abs());
        }
        let none = [0.0, -0.0, 1e-40, -1e-40, 1e-30, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
        for v in none.into_iter().flat_map(|x| [[x, 0.0], [-0.0, x], [x, -x], [f32::NAN, x]]) {
            assert_eq!(encode(v.into()), 0, "{v:?}");
        }

        let (best, bound) = (180.0 / f64::from(1u32 << BITS), f64::from(Angle::<BITS, EQUAL>::MAX_ERROR_DEG));
        let mut rng = Rng::new(67);
        let errors = Summary::of((0..200_000).map(|_| {
            let degrees = rng.range(0.0, 360.0);
            let (sin, cos) = degrees.to_radians().sin_cos();
            let v = Vec2::new(cos as f32, sin as f32) * 2f32.powi((rng.bits() % 120) as i32 - 60);
            degrees_apart(decode(encode(v)), degrees)
        }));
        assert!(errors.max <= bound && errors.max >= 0.999 * best, "{errors:?}, {bound}");
        assert!(bound <= best * if EQUAL { 1.0 } else { 1.0067 } + 3e-5, "{bound}, {best}");
        assert!((errors.mean / (0.5 * best) - 1.0).abs() < 0.01, "{errors:?}");
    }
    check::<8, false>();
    check::<8, true>();
    check::<12, false>();
    check::<12, true>();
    check::<16, false>();
    check::<16, true>();
}

/// The exact length of step i of S to the octave, from `2^L` on.
fn step<const S: u32, const L: i32>(i: u64) -> f64 {
    (f64::from(L) + i as f64 / f64::from(S)).exp2()
}

/// Every length is the power of two that the module states, to 4e-7, and comes back with its direction. Along the axes
/// whole powers are exact. Lengths beyond the range, zero, infinity and NaN are what the module says.
#[test]
fn lengths_are_powers_of_two_and_clamped() {
    fn check<C: Codec, W: RawCode, const B: u32, const S: u32, const L: i32>() {
        let code = number::<WithLength<C, W, B, S, L>>;
        let back = decoded::<WithLength<C, W, B, S, L>>;
        let (mut rng, most) = (Rng::new(68), (1u64 << B) - 2);
        for i in 0..=most {
            let v = back((i + 1) << C::BITS | rng.bits() >> (64 - C::BITS));
            assert!((length(widen(v)) / step::<S, L>(i) - 1.0).abs() < 4e-7, "{i}: {v:?}");
            assert_eq!((back(code(v)), code(v) >> C::BITS), (v, i + 1));
        }
        for exponent in L..=L + (most / u64::from(S)) as i32 {
            assert_eq!(
                AXES.map(|v| back(code(v * 2f32.powi(exponent)))),
                AXES.map(|v| v * 2f32.powi(exponent))
            );
        }
        for v in sphere(70, 1000) {
            let with = |i: u64| (i + 1) << C::BITS | number::<C>(v);
            let greatest = step::<S, L>(most).log2().ceil() as i32;
            assert_eq!(code(v * (0.47 * 2f32.powi(L))), 0, "{v:?}");
            assert_eq!([L - 1, L].map(|exponent| code(v * 2f32.powi(exponent))), [with(0); 2], "{v:?}");
            assert_eq!(
                [greatest, 63, 64, 100, 127].map(|e| code(v * 2f32.powi(e))),
                [with(most); 5],
                "{v:?}"
            );
        }
        for v in vectors(69).filter(|v| !v.is_finite() || v.abs().max_element() < 2f32.powi(L - 3)) {
            assert_eq!(code(v) >> C::BITS, if v.is_nan() || v.is_finite() { 0 } else { most + 1 }, "{v:?}");
        }
        assert_eq!(([code(Vec3::ZERO), code(Vec3::NAN)], back(0)), ([0; 2], Vec3::ZERO));
        let infinite = Vec3::new(3.0, f32::NEG_INFINITY, f32::MAX);
        assert!(angle_deg(back(code(infinite)), Vec3::new(0.0, -1.0, 1.0)) <= f64::from(C::MAX_ERROR_DEG));
    }
    check::<OctPrecise24, u32, 8, 8, -16>();
    check::<OctPrecise20, u32, 12, 128, -16>();
    check::<OctPrecise32, [u32; 2], 16, 2048, -16>();
    check::<OctPrecise22, [u32; 2], 17, 2048, -30>();
}

/// Vectors in random directions, of lengths from 2^-13 to 2^15 whose logarithm is uniform.
fn long_and_short(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    let mut rng = Rng::new(seed);
    sphere(seed + 1, count).map(move |v| v * rng.range(-13.0, 15.0).exp2() as f32)
}

/// The signed analogue of R9G9B9E5 (Khronos Data Format 1.3, 10.3.1): a sign and 8 bits a component, 5 bits of exponent
/// with the bias 15. A component is a whole multiple of `2^(exponent - 15 - 8)`.
fn shared_exponent(v: Vec3) -> Vec3 {
    let largest = v.abs().max_element();
    let of = |exponent: i32| 2f32.powi(exponent - 23);
    let exponent = (largest.log2().floor() as i32 + 16).clamp(0, 31);
    let exponent = exponent + i32::from((largest / of(exponent)).round() > 255.0);
    (v / of(exponent)).round() * of(exponent)
}

/// Relative errors keep to the bounds, and are those of the module's table; lengths are rounded to the nearest step.
#[test]
fn relative_errors_are_those_stated() {
    fn check(round_trip: impl Fn(Vec3) -> Vec3, stated: [f64; 2], bound: f32) {
        let Summary { mean, max } = Summary::of(long_and_short(71, 400_000).map(|v| {
            let (a, b) = (widen(v), widen(round_trip(v)));
            length([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / length(a)
        }));
        let off = [mean / stated[0] - 1.0, max / stated[1] - 1.0].map(f64::abs);
        assert!(off[0] < 0.005 && off[1] < 0.05 && max <= f64::from(bound), "{mean} {max}, {bound}");
    }
    fn check_lengths<C: Codec, W: RawCode, const B: u32, const S: u32, const L: i32>(stated: [f64; 2]) {
        for v in long_and_short(72, 100_000) {
            let steps = (length(widen(v)).log2() - f64::from(L)) * f64::from(S);
            let i = (number::<WithLength<C, W, B, S, L>>(v) >> C::BITS) as f64 - 1.0;
            assert!((i - steps).abs() <= 0.504, "{v:?}: {i}, {steps}");
        }
        let bound = WithLength::<C, W, B, S, L>::MAX_RELATIVE_ERROR;
        check(round_trip::<WithLength<C, W, B, S, L>>, stated, bound);
    }
    check_lengths::<OctPrecise24, u32, 8, 8, -16>([0.0217, 0.0443]);
    check_lengths::<OctPrecise20, u32, 12, 128, -16>([0.00204, 0.00378]);
    check_lengths::<OctPrecise32, [u32; 2], 16, 2048, -16>([8.95e-5, 0.000175]);
    check(shared_exponent, [0.00225, 0.00637], 1.0);
    check(|v| v.to_array().map(|t| f16::from_f32(t).to_f32()).into(), [0.000191, 0.000545], 1.0);
}

fn raw(vectors: &[Vec3]) -> Vec<u8> {
    program::raw(bytemuck::cast_slice(vectors))
}

/// Vectors of any length, with those that have no direction or are out of the range.
fn of_any_length() -> Vec<Vec3> {
    let out = [0.0, -0.0, 1e-9, 1e9, f32::NAN, f32::INFINITY].map(|x| Vec3::new(0.0, x, 0.0));
    long_and_short(76, 5000).chain(out).collect()
}

/// The program's codes and vectors have the bits of the library's functions: in files that tell their codec, in arrays of
/// NumPy, in streams.
#[test]
fn the_program_has_wrapped_codecs() {
    fn check<C: Codec>(id: &str) {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        let vectors = of_any_length();
        let codes = |vectors: &[Vec3]| -> Vec<u8> {
            vectors.iter().flat_map(|v| number::<C>(*v).to_le_bytes()[..C::BYTES].to_vec()).collect()
        };
        let decoded: Vec<Vec3> = vectors.iter().map(|v| round_trip::<C>(*v)).collect();
        let succeeds = |arguments: &[&str]| assert!(run(arguments).status.success(), "{arguments:?}");
        let made = run_with_input(["encode", "--codec", id, "-", "-"], &raw(&vectors)).stdout;
        assert!(made == codes(&vectors), "{id}");
        assert!(run_with_input(["decode", "--codec", id, "-", "-"], &made).stdout == raw(&decoded), "{id}");
        std::fs::write(path("a.f32"), raw(&vectors)).unwrap();
        succeeds(&["encode", "--codec", id, &path("a.f32"), &path("b.uvec")]);
        succeeds(&["decode", &path("b.uvec"), &path("c.npy")]);
        succeeds(&["encode", "--codec", id, &path("c.npy"), &path("d.npy")]);
        for (file, bytes) in
            [("b.uvec", codes(&vectors)), ("c.npy", raw(&decoded)), ("d.npy", codes(&decoded))]
        {
            assert!(std::fs::read(path(file)).unwrap().ends_with(&bytes), "{id}: {file}");
        }
        assert!(run(["decode", "--codec", id, &path("d.npy"), "-"]).stdout == raw(&decoded), "{id}");
        let listed = stdout(&run(["codecs"]));
        let is_it = |line: &&str| line.split_whitespace().take(2).eq([id, &C::BITS.to_string()]);
        assert!(listed.lines().any(|line| is_it(&line)), "{listed}");
    }
    check::<Axial16>("axial16");
    check::<Axial24>("axial24");
    check::<Axial32>("axial32");
    check::<Vector32>("vector32");
    check::<Vector48>("vector48");
}

/// `unitvec error` measures axes by the angle between axes, and vectors with a length by `|d - v| / |v|`, within the bounds;
/// files beside their originals, too, and codecs of directions beside those.
#[test]
fn the_program_measures_axes_and_lengths() {
    fn relative(v: Vec3, d: Vec3) -> f64 {
        let (v, d) = (widen(v), widen(d));
        length([v[0] - d[0], v[1] - d[1], v[2] - d[2]]) / length(v)
    }
    fn check<C: Codec>(id: &str, unit: &str, bound: f32, error: fn(Vec3, Vec3) -> f64, left_out: usize) {
        let folder = tempfile::tempdir().unwrap();
        let paths = ["a.f32", "b.f32"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
        let vectors: Vec<Vec3> = long_and_short(77, 5000).chain([Vec3::ZERO, Vec3::NAN]).collect();
        let decoded: Vec<Vec3> = vectors.iter().map(|v| round_trip::<C>(*v)).collect();
        std::fs::write(&paths[0], raw(&vectors)).unwrap();
        std::fs::write(&paths[1], raw(&decoded)).unwrap();
        let both = format!("{id},oct32p");
        let arguments = ["error", "--json", "-", "--codec", &both, "--original", &paths[0], &paths[1]];
        let report: Value = serde_json::from_slice(&run(arguments).stdout).unwrap();
        let named = |name: &str| report["rows"].as_array().unwrap().iter().find(|row| row["id"] == name);
        let of = |name: &str, f: fn(Vec3) -> Vec3| {
            let exact = if left_out == 1 && f(Vec3::ZERO) == Vec3::ZERO { 1 } else { 0 };
            let errors = vectors[..5000].iter().map(|v| error(*v, f(*v))).chain(vec![0.0; exact]);
            let (expected, row) = (Summary::of(errors), named(name).unwrap());
            let counts = [&row["count"], &row["left_out"]].map(|count| count.as_u64().unwrap() as usize);
            assert_eq!(counts, [5000 + exact, 2 - exact], "{row}");
            let found = ["mean", "max"].map(|what| row[format!("{what}_{unit}")].as_f64().unwrap());
            let off = [found[0] / expected.mean - 1.0, found[1] / expected.max - 1.0];
            assert!(off.iter().all(|off| off.abs() < 1e-6), "{expected:?}, {row}");
            found
        };
        let [_, max] = of(id, round_trip::<C>);
        assert!(max <= f64::from(bound) && max > 0.8 * f64::from(bound), "{id}: {max}, {bound}");
        of("oct32p", round_trip::<OctPrecise32>);
        of("as it is", round_trip::<C>);
        assert_eq!(report["warnings"], serde_json::json!([]), "{id}");
    }
    check::<Axial16>("axial16", "deg", Axial16::MAX_ERROR_DEG, axes_apart, 2);
    check::<Axial24>("axial24", "deg", Axial24::MAX_ERROR_DEG, axes_apart, 2);
    check::<Vector32>("vector32", "relative", Vector32::MAX_RELATIVE_ERROR, relative, 1);
    check::<Vector48>("vector48", "relative", Vector48::MAX_RELATIVE_ERROR, relative, 1);
}

/// What wrapped codecs are not for is refused in a line, and what is lost is told.
#[test]
fn the_program_tells_what_wrapped_codecs_are_for() {
    for (line, words) in [
        ("encode --codec axial12 a.f32 b", "did you mean axial16, axial24, axial32?"),
        ("encode --codec vector32 --backend rust a.f32 b", "the CPU alone encodes vector32"),
        ("encode --codec vector32 --null a.f32 b", ", vector32, vector48; of formats"),
        ("error --codec axial16,vector32 a.f32", "one after the other"),
        ("snap --for axial16 a.obj b.obj", "axial16 is not for directions"),
        ("conform --codec axial16", "it is for `encode`, `decode` and `error` alone"),
    ] {
        let said = refusal(&run(line.split(' ')), 2);
        assert!(said.contains(words), "{line}: {said}");
    }
    let told = |vectors: &[Vec3]| {
        stderr(&run_with_input(["encode", "--codec", "vector32", "-", "-"], &raw(vectors)))
    };
    let line = "3 vectors, 2 without a direction (stored as zero or, infinite ones, with the greatest length; the first is \
                number 1), lengths 1.000e-6 to 9.0000\n";
    assert_eq!(told(&[Vec3::X * 9.0, Vec3::ZERO, Vec3::Y * 1e-6]), line);
    assert_eq!(told(&[Vec3::X * 900.0]), "1 vector, 0 without a direction, lengths 900.0000 to 900.0000\n");
    assert!(told(&[Vec3::X * 7e4]).contains("longer than the codec can store"));
}

/// GLSL gives Rust's bits, for vectors of all kinds and any codes.
#[cfg(feature = "glsl")]
#[test]
fn wrappers_in_glsl_have_the_bits_of_rust() {
    use crate::glsl::assert_same_words;
    type Beside = WithLength<OctPrecise20, u32, 10, 32, -20>;
    type Encode = fn(Vec3) -> u32;
    type Decode = fn([u32; 3]) -> Vec3;
    let encoders: [(&str, Encode); 11] = [
        ("axial16_encode(v)", Axial16::encode_vec3),
        ("axial24_encode(v)", Axial24::encode_vec3),
        ("axial32_encode(v)", Axial32::encode_vec3),
        ("angle8_encode(v.xy)", |v| Angle8::encode(v.truncate())),
        ("angle16_encode(v.xy)", |v| Angle16::encode(v.truncate())),
        ("eqangle8_encode(v.xy)", |v| EqualAngle8::encode(v.truncate())),
        ("eqangle16_encode(v.xy)", |v| EqualAngle16::encode(v.truncate())),
        ("vector32_encode(v)", Vector32::encode_vec3),
        ("vector48_encode(v).x", |v| Vector48::encode_vec3(v)[0]),
        ("vector48_encode(v).y", |v| Vector48::encode_vec3(v)[1]),
        ("code_of_length(v, 10u, 32u, -20)", |v| Beside::encode_vec3(v) >> 20),
    ];
    let of_words = |w: [u32; 3]| Vec3::from_array(w.map(f32::from_bits));
    let calls = encoders
        .map(|(call, f)| (format!("uvec3({call}, 0u, 0u)"), move |w: [u32; 3]| [f(of_words(w)), 0, 0]));
    let words: Vec<_> =
        vectors(73).chain(long_and_short(74, 20_000)).map(|v| v.to_array().map(f32::to_bits)).collect();
    assert_same_words(&calls, &words);

    let decoders: [(&str, Decode); 10] = [
        ("axial16_decode(w.x)", |w| Axial16::decode(w[0])),
        ("axial24_decode(w.x)", |w| Axial24::decode(w[0])),
        ("axial32_decode(w.x)", |w| Axial32::decode(w[0])),
        ("vec3(angle8_decode(w.x), 0.0)", |w| Angle8::decode::<Vec2>(w[0]).extend(0.0)),
        ("vec3(angle16_decode(w.x), 0.0)", |w| Angle16::decode::<Vec2>(w[0]).extend(0.0)),
        ("vec3(eqangle8_decode(w.x), 0.0)", |w| EqualAngle8::decode::<Vec2>(w[0]).extend(0.0)),
        ("vec3(eqangle16_decode(w.x), 0.0)", |w| EqualAngle16::decode::<Vec2>(w[0]).extend(0.0)),
        ("vector32_decode(w.x)", |w| Vector32::decode(w[0])),
        ("vector48_decode(w.xy)", |w| Vector48::decode([w[0], w[1]])),
        ("vec3(0.0, 0.0, length_of_code(w.x, 10u, 32u, -20))", |w| Beside::decode(w[0] << 20)),
    ];
    let calls = decoders.map(|(call, f)| {
        (format!("floatBitsToUint({call})"), move |w: [u32; 3]| f(w).to_array().map(f32::to_bits))
    });
    let mut rng = Rng::new(75);
    let random = (0..60_000).map(|_| [(); 3].map(|()| rng.bits() as u32));
    assert_same_words(&calls, &(0..1 << 16).map(|n| [n, n, n]).chain(random).collect::<Vec<_>>());
}
