//! The formats of other software: nearest codes, the originals' published values, names, slices.

use glam::{DVec3, Vec3};
use unitvec::interop::{
    FRAMES, Format, FrameFormat, RotationFormat, UnknownFormat, decode_angle, encode_angle,
};
use unitvec::slice::Strided;
use unitvec::slice::machine::Level;
use unitvec::{Frame, angle_deg, interop};
use unitvec_catalogue::{find, find_any, formats};
use unitvec_oracle::turn_deg;
use unitvec_tests::checks::POSITION_ROUNDING;
use unitvec_tests::directions::{near_planes, sphere};

fn directions(seed: u64, count: usize) -> impl Iterator<Item = Vec3> {
    sphere(seed, count).chain(near_planes(seed + 1, count))
}

fn named(name: &str) -> Format {
    Format::named(name).unwrap()
}

/// The angle between a direction and a code's vector, by an encoder.
fn error(format: Format, v: Vec3) -> f64 {
    angle_deg(v, format.decode::<Vec3>(format.encode(v)))
}

/// True for formats that store x, y and z, and not a point of a square.
fn is_of_components(format: Format) -> bool {
    format.row().name.starts_with("gltf")
}

/// The codes of all points of a format of up to 16 bits: with lanes those of all numbers.
fn all_codes(format: Format) -> Option<Vec<u64>> {
    let most = (1 << (format.component_bits() - 1)) - 1;
    let numbers = move || (-most..=most).flat_map(move |x: i64| (-most..=most).map(move |y| [x, y]));
    match format.row().name {
        _ if format.component_bits() > 8 => None,
        "meshopt-oct" => {
            Some(numbers().map(|[x, y]| (x & 255 | (y & 255) << 8 | most << 16) as u64).collect())
        }
        "meshopt-oct16" => {
            Some(numbers().map(|[x, y]| (x & 65535 | (y & 65535) << 16 | most << 32) as u64).collect())
        }
        _ => (format.bits() <= 16).then(|| (0..1 << format.bits()).collect()),
    }
}

/// No code of up to 16 bits is nearer than the one chosen, by trial of all; what the rounding of the position in f32 adds
/// apart.
#[test]
fn no_code_is_nearer() {
    for format in Format::all() {
        let Some(codes) = all_codes(format) else { continue };
        let all: Vec<Vec3> = codes.iter().map(|code| format.decode::<Vec3>(*code).normalize()).collect();
        // Where meshoptimizer's numbers, rounded twice, come out two steps apart.
        let near_vertices = sphere(43, 1000).map(|v| Vec3::new(v.x * 0.03, v.y, v.z * 0.03));
        for v in directions(41, 60).chain(near_vertices) {
            let best = all.iter().copied().reduce(|a, b| if b.dot(v) > a.dot(v) { b } else { a }).unwrap();
            let slack = 2.0 * turn_deg(POSITION_ROUNDING);
            assert!(error(format, v) <= angle_deg(v, best) + slack, "{format}: {v:?}");
        }
    }
}

/// The codecs for GPUs write the codes of the formats that have their lattices, also on borders of cells.
#[test]
fn codecs_write_the_codes_of_formats() {
    let pairs =
        [("uoct16p", "nanite:8"), ("uoct20p", "nanite:10"), ("uoct24p", "cycles:12"), ("uoct32p", "godot4")];
    for (codec, format) in pairs {
        let (codec, format) = (find(codec).unwrap(), named(format));
        let on_borders = sphere(54, 20_000).map(|v| (v * 8.0).round() / 8.0).filter(|v| *v != Vec3::ZERO);
        for v in directions(55, 100_000).chain(on_borders) {
            let [low, _] = codec.encode_one(v.to_array());
            assert_eq!(format.encode(v), u64::from(low), "{format}: {v:?}");
        }
    }
}

/// No code of Unity's tetrahedra is nearer, on any face.
#[test]
fn no_code_on_another_face_is_nearer() {
    let format = named("hdrp-tetra");
    let all: Vec<Vec3> = (0..1 << 22).map(|code| format.decode(code)).collect();
    for v in sphere(53, 40).chain([Vec3::new(-0.867_113_9, -0.015_283_504, -0.497_875_42)]) {
        let best = all.iter().copied().reduce(|a, b| if b.dot(v) > a.dot(v) { b } else { a }).unwrap();
        assert!(error(format, v) <= angle_deg(v, best) + 1e-4, "{v:?}");
    }
}

/// In each format the nearest code is within the bound, and no further off than the plain one.
#[test]
fn the_nearest_is_within_its_bound_and_beats_the_plain() {
    for format in Format::all() {
        // Positions on the square are rounded to 2^-21 of its side.
        let slack = 2.0 * turn_deg(POSITION_ROUNDING);
        let mut sums = [0.0; 2];
        for v in directions(42, if is_of_components(format) { 50 } else { 2000 }) {
            let [nearest, plain] = [format, format.plain()].map(|format| error(format, v));
            assert!(nearest <= plain + slack, "{format}: {v:?}: {nearest} and {plain}");
            assert!(nearest <= f64::from(format.max_error_deg()), "{format}: {v:?}: {nearest}");
            sums = [sums[0] + nearest, sums[1] + plain];
        }
        assert!(sums[0] <= sums[1], "{format}: {sums:?}");
    }
}

/// Every code of up to 16 bits, and a sample of others, decodes to a finite vector that encodes to a code of the same; with
/// decoders of integers to one of the same direction within the error that these have.
#[test]
fn decoded_codes_come_back() {
    for format in Format::all() {
        let step = ((1u64 << format.bits().min(63)) / (1 << 12)) | 1;
        // Tetrahedra have points beyond the disc of a face, whose vectors lie on another.
        let is_any = |name: &&str| format.row().name.starts_with(name);
        let rounds = is_of_components(format) || ["meshopt", "hdrp-tetra"].iter().any(is_any);
        for code in (0..1 << 12).map(|i| i * step) {
            let decoded: Vec3 = format.decode(code);
            assert!(decoded.is_finite(), "{format}: {code:x}");
            let again: Vec3 = format.decode(format.encode(decoded));
            assert!(again == decoded || rounds, "{format}: {code:x}: {decoded} and {again}");
        }
    }
}

/// What has no direction gets the code of +Z, and no input a code that stands for no vector, also near the pole's opposite.
#[test]
fn any_input_gets_a_code_and_none_the_null_code() {
    for format in Format::all() {
        for v in [[0.0; 3], [f32::NAN, 1.0, 0.0], [f32::INFINITY, 0.0, 0.0], [1e-30; 3]] {
            assert_eq!(format.encode(v), format.encode([0.0, 0.0, 1.0]), "{format}: {v:?}");
            let plain: Vec3 = format.decode(format.plain().encode(v));
            assert!(plain.is_finite());
        }
        let near_minus_z = sphere(43, 500).map(|v| Vec3::new(v.x * 1e-3, v.y * 1e-3, -1.0));
        for v in near_minus_z.chain(directions(44, if is_of_components(format) { 20 } else { 500 })) {
            assert_ne!(Some(format.encode(v)), format.null(), "{format}: {v:?}");
            assert_ne!(Some(format.plain().encode(v)), format.plain().null(), "{format}: {v:?}");
        }
        // Of any length.
        for v in sphere(52, 50).map(|v| v.normalize()) {
            for scale in [2f32.powi(70), 2f32.powi(-60)] {
                assert_eq!(format.encode(v * scale), format.encode(v), "{format}: {v:?}");
            }
        }
    }
}

/// Slices and strided data have the codes and vectors of single ones, at each level of instructions.
#[test]
fn slices_are_single_vectors() {
    for format in Format::all() {
        let special = [
            Vec3::ZERO,
            -Vec3::Z,
            Vec3::NAN,
            Vec3::new(-1e-20, 1e-18, 1e26),
            Vec3::new(1e-27, -1e-18, -1e14),
        ];
        // Near the pole's opposite, which all corners of the square stand for.
        let far = directions(46, 20).map(|v| v * 0.05 - Vec3::Z);
        let vectors: Vec<Vec3> = directions(45, 40).chain(far).chain(special).collect();
        for format in [format, format.plain()] {
            let bytes = format.bytes();
            let expected: Vec<u8> = vectors
                .iter()
                .flat_map(|v| format.encode(*v).to_le_bytes().into_iter().take(bytes))
                .collect();
            let mut codes = vec![0; expected.len()];
            let mut decoded = vec![Vec3::ZERO; vectors.len()];
            for level in Level::available() {
                format.encode_slice_at(level, &vectors, &mut codes).unwrap();
                assert_eq!(codes, expected, "{format}");
                format.decode_slice_at(level, &codes, &mut decoded).unwrap();
            }
            let single: Vec<Vec3> = vectors.iter().map(|v| format.decode(format.encode(*v))).collect();
            assert_eq!(decoded, single, "{format}");
            let (mut spread, stride) = (vec![7; vectors.len() * (bytes + 1)], bytes + 1);
            let from: &[u8] = bytemuck::cast_slice(&vectors);
            let from = Strided { bytes: from, offset: 0, stride: 12 };
            format.encode_strided(from, Strided { bytes: &mut spread, offset: 0, stride }).unwrap();
            assert!(
                spread
                    .chunks(stride)
                    .zip(expected.chunks(bytes))
                    .all(|(a, b)| a[..bytes] == *b && a[bytes] == 7)
            );
            let mut back = vec![0; 12 * vectors.len()];
            let to = Strided { bytes: &mut back[..], offset: 0, stride: 12 };
            format.decode_strided(Strided { bytes: &spread, offset: 0, stride }, to).unwrap();
            assert_eq!(back, bytemuck::cast_slice::<_, u8>(&decoded), "{format}");
        }
        assert!(format.encode_slice(&vectors, &mut [0]).is_err());
    }
}

/// What the original makes of a snapped vector is never farther off than what it makes of the vector, and where it rounds or
/// truncates each number, as near as the nearest code.
#[test]
fn snapped_vectors_are_written_as_the_nearest_code() {
    // Unity moves z off the equator, OpenVDB truncates on edges; tetrahedra and components choose among more points than the
    // original.
    let inexact = ["hdrp-oct24", "openvdb", "hdrp-tetra", "gltf-snorm8", "gltf-snorm16"];
    for format in Format::all() {
        for v in directions(46, 1000) {
            let plain = |v: Vec3| format.decode::<Vec3>(format.plain().encode(v));
            let [before, after] = [plain(v), plain(format.snap(v))].map(|written| angle_deg(v, written));
            assert!(after <= before, "{format}: {v:?}: {after} and {before}");
            let is_nearest = after <= error(format, v) + 2.0 * turn_deg(POSITION_ROUNDING);
            // Nanite compares cosines in f32, which tell codes apart up to 9 bits.
            let is_fine = format.row().name == "nanite" && format.component_bits() > 9;
            let is_exempt = is_fine || inexact.contains(&format.row().name);
            assert!(is_nearest || is_exempt, "{format}: {v:?}: {after}");
        }
    }
}

/// Values that the projects publish: Cesium's Specs/Core/AttributeCompressionSpec.js and the texts of 3D Tiles, the unit
/// tests of bevy_mesh, meshoptimizer's demo/tests.cpp, and axes of OpenVDB.
#[test]
fn published_values() {
    let encoded = [
        ("tiles3d-oct16", [0.0, 0.0, 1.0], 0x8080),
        ("tiles3d-oct16", [0.0, 0.0, -1.0], 0xffff),
        ("tiles3d-oct16", [0.0, 1.0, 0.0], 0xff80),
        ("tiles3d-oct32", [0.0, 1.0, 0.0], 0xffff_8000),
        ("tiles3d-oct32", [1.0, 0.0, 0.0], 0x8000_ffff),
        ("bevy", [1.0, 0.0, 0.0], 0x0000_7fff),
        ("bevy", [0.0, 1.0, 0.0], 0x7fff_0000),
        ("bevy", [0.0, 0.0, -1.0], 0x7fff_7fff),
        ("meshopt-oct:8", [1.0, 0.0, 0.0], 0x007f_007f),
        ("meshopt-oct:8", [0.0, -1.0, 0.0], 0x007f_8100),
        ("meshopt-oct:8", [std::f32::consts::FRAC_1_SQRT_2, 0.0, 0.707_168], 0x007f_003f),
        ("meshopt-oct16:12", [0.0, -1.0, 0.0], 0x07ff_f801_0000),
        ("godot4", [0.0, 0.0, 1.0], 0x7fff_7fff),
        ("openvdb", [1.0, 0.0, 0.0], 0x00ff),
        ("openvdb", [0.0, 1.0, 0.0], 0x007e),
        ("openvdb", [-1.0, 0.0, 0.0], 0x80ff),
        ("draco:8", [1.0, 0.0, 0.0], 0x7f7f),
    ];
    for (name, v, code) in encoded {
        assert_eq!(named(name).plain().encode(v), code, "{name}: {v:?}");
    }
    // Integers that decoders give, in parts of the largest.
    let decoded = [
        ("meshopt-oct:8", 0x007f_0100, [0.0, 1.0, 127.0], 127.0),
        ("meshopt-oct:8", 0x017f_bb00, [0.0, -97.0, 82.0], 127.0),
        ("meshopt-oct:8", 0x007f_01ff, [-1.0, 1.0, 127.0], 127.0),
        ("meshopt-oct:8", 0x017f_820e, [1.0, -126.0, -15.0], 127.0),
        ("meshopt-oct16:12", 0x07ff_0001_0000, [0.0, 16.0, 32767.0], 32767.0),
        ("meshopt-oct16:12", 0x07ff_074e_0000, [0.0, 32621.0, 3088.0], 32767.0),
        ("meshopt-oct16:12", 0x07ff_0001_07e1, [32764.0, 16.0, 471.0], 32767.0),
        ("meshopt-oct16:12", 0x07ff_0514_000e, [307.0, 28541.0, 16093.0], 32767.0),
    ];
    for (name, code, v, most) in decoded {
        assert_eq!(named(name).decode::<[f32; 3]>(code), v.map(|c: f32| c / most), "{name}: {code:x}");
    }
    assert_eq!(named("tiles3d-oct16").decode::<Vec3>(0), -Vec3::Z);
    assert_eq!(named("draco:8").decode::<Vec3>(0x007f), -Vec3::Z);
}

/// glTF's validator takes the nearest codes for unit vectors.
#[test]
fn gltf_vectors_are_valid() {
    for name in ["gltf-snorm8", "gltf-snorm16"] {
        // The rounded point of this one is too long.
        for v in directions(47, 100).chain([Vec3::new(77.5006, 75.5006, 66.5005)]) {
            let length = named(name).decode::<Vec3>(named(name).encode(v)).as_dvec3().length();
            assert!((length - 1.0).abs() <= 0.00674, "{name}: {v:?}: {length}");
        }
    }
}

/// Of all points of glTF's lattices that the validator takes, none in the 5 by 5 around the ray of each plane is nearer than the
/// code's, by the cross product in float64.
#[test]
fn no_valid_gltf_vector_is_nearer() {
    for (name, most) in [("gltf-snorm8", 127i32), ("gltf-snorm16", 32767)] {
        // Near the diagonal all planes' points are off alike, and the nearest of a plane is not that which rounding gives.
        let beside_diagonal = [[0.45, 0.4], [-0.45, 0.4], [0.45, -0.4], [-0.45, -0.4], [-0.19, 0.19]]
            .map(|[y, z]| Vec3::new(18918.0, 18918.0 + y, z - 18918.0));
        for v in directions(49, 20).chain(beside_diagonal) {
            let code = named(name).encode(v);
            let of_lane = |n: i32| match most {
                127 => f64::from((code >> (8 * n)) as i8),
                _ => f64::from((code >> (16 * n)) as i16),
            };
            let v = v.as_dvec3().normalize();
            let off = |w: DVec3| w.normalize().cross(v).length();
            let found = off(DVec3::new(of_lane(0), of_lane(1), of_lane(2)));
            let axis = v.abs().max_position();
            for k in most / 2..=most {
                let at = (v * (f64::from(k) / v[axis].abs())).round();
                for n in 0..25 {
                    let mut point = at;
                    point[(axis + 1) % 3] += f64::from(n % 5 - 2);
                    point[(axis + 2) % 3] += f64::from(n / 5 - 2);
                    let deviation = point.length() / f64::from(most) - 1.0;
                    let is_point = deviation.abs() < 0.00674 && point.abs().max_element() <= f64::from(most);
                    assert!(!is_point || off(point) > found - 1e-14, "{name}: {v}: {point}");
                }
            }
        }
    }
}

/// Midway between two of glTF's points, where f32 does not tell which is nearer, slices have the codes of single vectors.
#[test]
fn slices_of_gltf_bytes_are_single_vectors_between_points() {
    let format = named("gltf-snorm8");
    let midway = |(i, v): (usize, Vec3)| {
        let point = (v.normalize() * 127.0).round();
        let step = Vec3::new((i % 3) as f32, (i / 3 % 3) as f32, (i / 9 % 3) as f32) - 1.0;
        point.normalize() + (point + step).normalize()
    };
    let vectors: Vec<Vec3> = sphere(51, 50_000).enumerate().map(midway).collect();
    let mut codes = vec![[0; 4]; vectors.len()];
    format.encode_slice(&vectors, codes.as_flattened_mut()).unwrap();
    for (v, code) in vectors.iter().zip(codes) {
        assert_eq!(u64::from(u32::from_le_bytes(code)), format.encode(*v), "{v}");
    }
}

/// A random frame: a normal and a tangent perpendicular to it.
fn frames(count: usize) -> impl Iterator<Item = Frame> {
    let pairs = directions(48, count).zip(sphere(50, 2 * count));
    pairs.enumerate().map(|(i, (normal, other))| {
        let tangent = normal.cross(other);
        Frame { normal, tangent, handedness: if i % 3 == 0 { -1.0 } else { 1.0 } }
    })
}

/// Frames come back within the bounds, with their handedness, and twice the same.
#[test]
fn frames_come_back_within_their_bounds() {
    for format in FRAMES {
        let [most_normal, most_tangent] = format.max_errors_deg().map(f64::from);
        for frame in frames(2000) {
            let code = format.encode(frame);
            assert!(format.bits == 64 || code >> format.bits == 0, "{}: {code:x}", format.name);
            let decoded = format.decode(code);
            let errors = [angle_deg(frame.normal, decoded.normal), angle_deg(frame.tangent, decoded.tangent)];
            assert!(
                errors[0] <= most_normal && errors[1] <= most_tangent,
                "{}: {frame:?}: {errors:?}",
                format.name
            );
            assert_eq!(decoded.handedness, frame.handedness, "{}", format.name);
            assert!(
                decoded.normal.is_normalized() && decoded.tangent.is_normalized(),
                "{}: {frame:?}",
                format.name
            );
            let again = format.decode(format.encode(decoded));
            assert_eq!(
                (again.normal, again.handedness),
                (decoded.normal, decoded.handedness),
                "{}",
                format.name
            );
            // A direction on the edge of a pair's square is no point of the opposite edge where y holds the handedness.
            let turned = angle_deg(again.tangent, decoded.tangent);
            assert!(
                again == decoded || format.bits == 64 && turned <= most_tangent,
                "{}: {frame:?}",
                format.name
            );
        }
        for frame in [
            Frame::new([0.0; 3], [f32::NAN; 3], f32::NAN),
            Frame::new([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], -1.0),
        ] {
            let decoded = format.decode(format.encode(frame));
            assert!(decoded.normal.is_finite() && decoded.tangent.is_finite(), "{}", format.name);
        }
    }
}

/// A tangent of length 0 stays so in the format for it; and bevy_mesh's own tests of tangents, as it stores them.
#[test]
fn tangents_of_other_software() {
    let format = FrameFormat::named("frame32-or-zero").unwrap();
    let frame = Frame::new([0.0, 0.6, 0.8], [0.0; 3], -1.0);
    let decoded = format.decode(format.encode(frame));
    assert_eq!((decoded.tangent, decoded.handedness), (Vec3::ZERO, -1.0));

    let beside = |bits| angle_deg(Vec3::X, decode_angle(Vec3::Z, encode_angle(Vec3::Z, Vec3::X, bits), bits));
    assert!((1..=16).all(|bits| beside(bits) <= 180.0 / f64::from(1 << bits)));
    assert_eq!(encode_angle(Vec3::Z, Vec3::NAN, 40), 0);

    let bevy = FrameFormat::named("bevy-frame").unwrap();
    let third = Vec3::new(1.0, 2.0, 3.0).normalize();
    let tangents = [
        (Vec3::X, -1.0, [1.0, -0.5]),
        (Vec3::Y, -1.0, [0.0, -1.0]),
        (-Vec3::Z, 1.0, [1.0, 1.0]),
        (-Vec3::Z, -1.0, [1.0, -1.0]),
        (third, 1.0, [1.0 / 6.0, 2.0 / 3.0]),
    ];
    for (tangent, handedness, expected) in tangents {
        let code = bevy.encode(Frame { normal: Vec3::Z, tangent, handedness }) >> 32;
        let stored = [code as i16, (code >> 16) as i16].map(|i| f32::from(i) / 32767.0);
        let off = (stored[0] - expected[0]).abs().max((stored[1] - expected[1]).abs());
        assert!(off < 2.0 / 32767.0, "{tangent}: {stored:?}");
    }
}

#[test]
fn names_are_found_and_others_explained() {
    for format in Format::all() {
        let catalogued = find_any(&format.to_string()).unwrap();
        assert_eq!((Format::named(&format.to_string()), catalogued.format()), (Ok(format), Some(format)));
        assert_eq!(catalogued.plain().unwrap().format(), Some(format.plain()));
        let (vector, mut code) = ([0.36, 0.48, -0.8], [0; 8]);
        catalogued.encode_cpu(&vector, &mut code[..format.bytes()]).unwrap();
        assert_eq!(u64::from_le_bytes(code), format.encode(vector), "{format}");
    }
    assert_eq!(formats().len(), 2 * (Format::all().count() + RotationFormat::all().count()) + FRAMES.len());
    assert!(find("draco:10").is_err() && find_any("oct32p").is_ok());
    let width = |name| matches!(Format::named(name), Err(UnknownFormat::Bits { .. }));
    assert!(
        ["draco", "draco:1", "draco:17", "draco:x", "draco:", "bevy:16", "godot4:"].into_iter().all(width)
    );
    let unknown = Format::named("darco:10\n").unwrap_err().to_string();
    assert!(unknown.contains("`darco:10\\n`") && unknown.contains("draco:2-16"), "{unknown}");
    let width = find_any("draco:40").unwrap_err().to_string();
    assert_eq!(width, "draco has 2 to 16 bits; name a number of them, as draco:16");
    assert!(interop::ROWS.iter().all(|row| !row.source.is_empty() && !row.layout.is_empty()));
}
