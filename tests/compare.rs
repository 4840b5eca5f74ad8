//! `unitvec compare`: one whole page, its errors, and the mesh in colours.

use crate::faults::fails;
use crate::snap::succeeds;
use serde_json::Value;
use std::path::Path;
use unitvec::angle_deg;
use unitvec_catalogue::find;
use unitvec_mesh::{FileFormat, Reach, parse};
use unitvec_tests::repository;

/// The mesh, the page and the errors of `unitvec error`, which the page tells, and `--json` has; it loads nothing.
#[test]
fn the_page_has_the_errors_of_error() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(repository().join("host/mesh/data/torus.glb"), folder.path().join("torus.glb")).unwrap();
    let line = "compare --codec oct16,oct24p torus.glb -o page.html --ply heat.ply --json a.json --side 96";
    assert!(succeeds(folder.path(), line).starts_with("compare: page.html, seen from "));
    succeeds(folder.path(), "error --codec oct16,oct24p torus.glb --json b.json");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("a.json"), read("b.json"));
    let (page, errors) = (read("page.html"), serde_json::from_str::<Value>(&read("b.json")).unwrap());
    assert!(page.contains("<h1>torus.glb with normals in codes</h1>"));
    for (row, id) in errors["rows"].as_array().unwrap().iter().zip(["oct16", "oct24p"]) {
        let [mean, max] = ["mean_deg", "max_deg"].map(|key| format!(">{:.6}<", row[key].as_f64().unwrap()));
        let row =
            page.split("<tr>").find(|row| row.starts_with(&format!("<th scope=\"row\">{id}</th>"))).unwrap();
        assert!(row.contains(&mean) && row.contains(&max), "{row}");
    }
    // With floats and two codecs in three materials, three differences of each codec, and their heat maps.
    assert_eq!(page.matches("data:image/png;base64,").count(), 3 * 3 + 3 * 2 + 2);
    for load in ["=\"http", "=\"//", "url(", "@import", "fetch(", "{{", "{%"] {
        assert!(!page.contains(load), "{load}");
    }
    check_heat(folder.path(), errors["rows"][0]["max_deg"].as_f64().unwrap());
}

/// The PLY has the vertices of the mesh, and at each the error of the first codec, of which the greatest has the last colour.
fn check_heat(folder: &Path, max_deg: f64) {
    let read = |name: &str, format| {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        (parse(Path::new(name), format, &bytes, Reach::Folder).unwrap().normals, bytes)
    };
    let (own, _) = read("torus.glb", FileFormat::Gltf);
    let (normals, bytes) = read("heat.ply", FileFormat::Ply);
    assert_eq!(normals, own);
    let end = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let codec = find("oct16").unwrap();
    let mut most = (0.0f64, [0; 3]);
    for (vertex, normal) in bytes[end..].chunks(31).zip(own) {
        let decoded: [f32; 3] = codec.decode_one(codec.encode_one(normal));
        let quality = f64::from(f32::from_le_bytes(vertex[24..28].try_into().unwrap()));
        assert!((quality - angle_deg(normal, decoded)).abs() < 1e-5);
        if quality > most.0 {
            most = (quality, vertex[28..31].try_into().unwrap());
        }
    }
    // Yellow is the end of viridis.
    assert!((most.0 - max_deg).abs() < 1e-5 && most.1[0] > 240 && most.1[2] < 60, "{most:?}");
}

/// Of two squares back to back, one whose normals a code has and one whose normals it has not, the worst view is from the
/// side of the latter.
#[test]
fn the_worst_view_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let square = |z: f32| format!("v -1 -1 {z}\nv 1 -1 {z}\nv 1 1 {z}\nv -1 1 {z}\n");
    let faces = "f 1//1 2//1 3//1 4//1\nf 5//2 6//2 7//2 8//2\n";
    let text = square(0.1) + &square(-0.1) + "vn 0 0 1\nvn 0.31 0.17 -0.9\n" + faces;
    std::fs::write(folder.path().join("a.obj"), text).unwrap();
    let told = succeeds(folder.path(), "compare --codec oct16 a.obj --side 64 --samples 1");
    assert!(told.trim_end().ends_with(",-1"), "{told}");
    let told = succeeds(folder.path(), "compare --codec oct16 a.obj --side 64 --samples 1 --view -1,2,0.5");
    assert!(told.trim_end().ends_with("seen from -1,2,0.5"), "{told}");
}

#[test]
fn refusals() {
    let points: [(&str, &[u8]); 1] = [("a.obj", b"v 0 0 0\nvn 0 0 1\n")];
    for (line, status, words) in [
        ("compare --codec oct16 a.obj", 1, ["a.obj has no faces", "export the mesh with faces"]),
        ("compare --codec frame32 a.obj", 2, ["frame32 is not for directions", "normals"]),
        ("compare --codec oct16 a.obj -o b.ply", 2, ["b.ply is the name of a mesh", "another"]),
        ("compare --codec oct16 a.obj -o - --json -", 2, ["the page and the JSON", "standard output"]),
    ] {
        fails(&points, line, status, &words);
    }
}
