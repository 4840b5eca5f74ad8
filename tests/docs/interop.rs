//! The errors of formats of other software, and what ran beside them, as docs/interop.md has them.

use super::tables::degrees;
use super::{markdown_table, recorded, slices};
use glam::{Mat3, Quat, Vec3};
use std::collections::BTreeMap;
use unitvec::interop::{FRAMES, Format, ROTATIONS, ROWS, RotationFormat};
use unitvec::{Frame, Frame32, Frame64, FrameCodec, Quat32, RotationCodec, angle_deg, rotation_angle_deg};
use unitvec_run::measure::ErrorStats;
use unitvec_run::sampling::random_rotations;
use unitvec_tests::directions::sphere;
use unitvec_tests::repository;

/// The formats of the table: the widths that their software takes by default, and the least and the greatest.
fn formats() -> impl Iterator<Item = Format> {
    let is_shown = |format: &Format| {
        let (row, bits) = (format.row(), format.component_bits());
        !row.has_widths() || row.widths.contains(&bits) || [8, 10, 12].contains(&bits)
    };
    Format::all().filter(is_shown)
}

/// Mean and largest angle, in degrees.
fn summary(errors: impl Iterator<Item = f64>) -> [f64; 2] {
    let errors: ErrorStats = errors.collect();
    [errors.mean_deg(), errors.max_deg()]
}

/// Frames with these normals: tangents are perpendicular to them, and random.
fn frames(normals: impl Iterator<Item = Vec3>) -> Vec<Frame> {
    let pairs = normals.zip(sphere(73, 1 << 17));
    pairs.map(|(normal, other)| Frame { normal, tangent: normal.cross(other), handedness: 1.0 }).collect()
}

/// Errors of the normal, then of the tangent.
fn of_frames(frames: &[Frame], trip: &Trip) -> [f64; 4] {
    let [n, t] = [
        summary(frames.iter().map(|frame| angle_deg(frame.normal, trip(*frame).normal))),
        summary(frames.iter().map(|frame| angle_deg(frame.tangent, trip(*frame).tangent))),
    ];
    [n[0], n[1], t[0], t[1]]
}

/// A frame, encoded and decoded.
type Trip = Box<dyn Fn(Frame) -> Frame>;

/// The formats of rotations of the table, as [`formats`] are those of vectors.
fn rotation_formats() -> impl Iterator<Item = RotationFormat> {
    let is_shown = |format: &RotationFormat| {
        let [least, most] = format.widths;
        least == most || [8, 10, 12, 16].contains(&format.component_bits)
    };
    RotationFormat::all().filter(is_shown)
}

/// The rotation that turns X to a frame's tangent and Z to its normal, encoded and decoded, as a frame of the same
/// handedness.
fn as_rotation(frame: Frame, trip: impl Fn([f32; 4]) -> [f32; 4]) -> Frame {
    let (normal, tangent) = (frame.normal.normalize(), frame.tangent.normalize());
    let turned = Mat3::from_cols(tangent, normal.cross(tangent), normal);
    let decoded = Quat::from_array(trip(Quat::from_mat3(&turned).to_array())).normalize();
    Frame { normal: decoded * Vec3::Z, tangent: decoded * Vec3::X, handedness: frame.handedness }
}

/// A split of the bits of a frame: its name, what it is, its bits, and the trip.
fn splits() -> Vec<(&'static str, &'static str, u32, Trip)> {
    let ours: [(_, _, _, Trip); 2] = [
        ("frame32", "11 + 11, angle 9, sign", 32, Box::new(|frame| Frame32::decode(Frame32::encode(frame)))),
        ("frame64", "21 + 21, angle 21, sign", 64, Box::new(|frame| Frame64::decode(Frame64::encode(frame)))),
    ];
    let others = FRAMES.map(|format| -> (_, _, _, Trip) {
        let trip = Box::new(move |frame| format.decode(format.encode(frame)));
        (format.name, format.source, format.bits, trip)
    });
    let smallest = RotationFormat::named("smallest3:10").unwrap();
    let rotations: [(_, _, _, Trip); 2] = [
        (
            "smallest3:10 frame",
            "a rotation, 10 + 10 + 10 + 2; handedness beside it",
            32,
            Box::new(move |frame| as_rotation(frame, |q| smallest.decode(smallest.encode(q)))),
        ),
        (
            "quat32 frame",
            "a rotation; handedness beside it",
            32,
            Box::new(|frame| as_rotation(frame, |q| Quat32::decode(Quat32::encode(q)))),
        ),
    ];
    ours.into_iter().chain(others).chain(rotations).collect()
}

/// Errors of the same splits on the mesh of Kapoulkine's article, "Quantizing tangent frames" (2026): normal, then tangent.
const KAPOULKINE: [(&str, [f64; 4]); 3] = [
    ("frame32", [0.0272, 0.1136, 0.1775, 0.3588]),
    ("frame32-signed", [0.0444, 0.1371, 0.0954, 0.2149]),
    ("smallest3:10 frame", [0.0632, 0.2046, 0.0640, 0.1988]),
];

/// Measures what the docs state.
#[test]
#[ignore = "`cargo xtask renew errors` runs it"]
fn measure() {
    let mut text = String::from("format,mean_a,max_a,mean_b,max_b\n");
    let mut write = |name: &str, numbers: [f64; 4]| {
        text += &format!("{name}{}\n", numbers.map(|number| format!(",{number:.6e}")).concat());
    };
    for format in formats() {
        let error = |format: Format| {
            summary(sphere(71, 1 << 18).map(|v| angle_deg(v, format.decode::<[f32; 3]>(format.encode(v)))))
        };
        let [plain, nearest] = [error(format.plain()), error(format)];
        write(&format.to_string(), [plain[0], plain[1], nearest[0], nearest[1]]);
    }
    for format in rotation_formats() {
        let count = if format.name == "gltf-quat16" { 1 << 13 } else { 1 << 17 };
        let error = |format: RotationFormat| {
            let rotations = random_rotations(74).take(count);
            summary(rotations.map(|q| rotation_angle_deg(q, format.decode(format.encode(q)))))
        };
        let [plain, nearest] = [error(format.plain()), error(format)];
        write(&format.to_string(), [plain[0], plain[1], nearest[0], nearest[1]]);
    }
    let bunny = unitvec_mesh::read(&repository().join("host/mesh/data/bunny.obj")).unwrap().normals;
    let [random, bunny] =
        [frames(sphere(72, 1 << 17)), frames(bunny.into_iter().map(|normal| Vec3::from(normal).normalize()))];
    for (name, _, _, trip) in splits() {
        write(name, of_frames(&random, &trip));
        write(&format!("bunny {name}"), of_frames(&bunny, &trip));
    }
    unitvec_files::write_file(&repository().join("docs/data/interop.csv"), text.as_bytes()).unwrap();
}

fn measured() -> BTreeMap<String, [f64; 4]> {
    let rows = recorded::<(String, f64, f64, f64, f64)>("interop.csv").into_iter();
    rows.map(|(name, a, b, c, d)| (name, [a, b, c, d])).collect()
}

/// The table of errors in docs/interop.md.
pub fn table() -> String {
    let errors = measured();
    let rows = formats().map(|format| {
        let [a, b, c, d] = errors[&format.to_string()].map(degrees);
        let bound = degrees(format.max_error_deg().into());
        // Of 2 bits there is no loop over several vectors.
        let times = if format.component_bits() > 2 { slices::times(format.row().name) } else { "-".into() };
        let sizes = format!("{} | {}", format.bits(), format.bytes());
        format!("`{format}` | {sizes} | {a} / {b} | {c} / {d} | {bound} | {times}")
    });
    let titles =
        "format | bits | bytes | plain: mean / max, degrees | nearest: mean / max | bound | time to encode";
    markdown_table(titles, rows)
}

/// The table of errors of formats of rotations.
pub fn of_rotations() -> String {
    let errors = measured();
    let rows = rotation_formats().map(|format| {
        let [a, b, c, d] = errors[&format.to_string()].map(degrees);
        let bound = degrees(format.max_error_deg().into());
        format!("`{format}` | {} | {} | {a} / {b} | {c} / {d} | {bound}", format.bits(), format.bytes())
    });
    markdown_table("format | bits | bytes | plain: mean / max, degrees | nearest: mean / max | bound", rows)
}

/// The table of the layouts and sources of formats of rotations.
pub fn sources_of_rotations() -> String {
    let rows = ROTATIONS
        .iter()
        .map(|row| format!("`{}` | {} | {} | {}", row.name, row.layout, row.zero, row.source));
    markdown_table(
        "format | layout, low bits first | the original's answer to a quaternion of length 0 | source",
        rows,
    )
}

/// The table of layouts and sources.
pub fn sources() -> String {
    let rows = ROWS.iter().map(|row| {
        let null = row.null.map_or("-".to_owned(), |null| format!("{null:#x}"));
        format!("`{row}` | {} | {} | {null} | {}", row.layout, row.zero, row.source)
    });
    markdown_table(
        "format | layout, low bits first | the original's answer to a zero vector | null code | source",
        rows,
    )
}

/// The table of frames.
pub fn of_tangents() -> String {
    let errors = measured();
    let cells = |errors: [f64; 4]| {
        let [a, b, c, d] = errors.map(degrees);
        format!("{a} / {b} | {c} / {d}")
    };
    let rows = splits().into_iter().map(|(name, what, bits, _)| {
        let theirs = KAPOULKINE.iter().find(|row| row.0 == name);
        let theirs = theirs.map_or_else(|| "- | -".to_owned(), |(_, errors)| cells(*errors));
        let [random, bunny] = [name, &format!("bunny {name}")].map(|name| cells(errors[name]));
        format!("`{name}` | {bits} | {what} | {random} | {bunny} | {theirs}")
    });
    let titles = "format | bits | what | random: normal, degrees | tangent | bunny: normal | tangent | \
         Kapoulkine's mesh: normal | tangent";
    markdown_table(titles, rows)
}

/// A difference between the program and an original: of codes as integers, of decoded numbers as they are.
type Outside = (String, String, String, u64, u64, f64, f64);

/// The table of what originals made of the same directions and codes.
pub fn outside() -> String {
    let rows = recorded::<Outside>("interop_outside.csv").into_iter();
    let rows = rows.map(|(format, what, original, cases, differing, most, allowed)| {
        assert!(most <= allowed, "{format}: {most}");
        format!("`{format}` | {what} | {original} | {cases} | {differing} | {most} | {allowed}")
    });
    markdown_table(
        "format | operation | original | cases | that differ | greatest difference | allowed",
        rows,
    )
}

/// The table of tools that ran after `unitvec snap`.
pub fn tools() -> String {
    let rows =
        csv::Reader::from_path(repository().join("docs/data/interop_tools.csv")).unwrap().into_records();
    let rows = rows.map(|row| {
        let row = row.unwrap();
        let [command, plain, snapped, nearest] = [1, 4, 6, 8].map(|at| &row[at]);
        let [plain_max, snapped_max, nearest_max] = [5, 7, 9].map(|at| &row[at]);
        let sizes = format!("{} / {} | {} / {}", &row[10], &row[11], &row[13], &row[14]);
        format!("`{command}` | {plain} / {plain_max} | {snapped} / {snapped_max} | {nearest} / {nearest_max} | {sizes}")
    });
    let titles =
        "command | plain: mean / max, degrees | after snap | nearest codes | bytes / with zstd | after snap";
    markdown_table(titles, rows)
}
