//! `unitvec compare`: one whole page, its errors, and the mesh in colours.

use crate::faults::{assert_fails, fails};
use crate::snap::succeeds;
use base64::Engine;
use serde_json::Value;
use std::path::Path;
use unitvec::angle_deg;
use unitvec_catalogue::find;
use unitvec_mesh::{FileFormat, Reach, parse};
use unitvec_tests::program::{command, stderr};
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
    // With floats and two codecs in four materials, four differences of each codec, and their heat maps.
    assert_eq!(page.matches("data:image/png;base64,").count(), 4 * 3 + 4 * 2 + 2);
    for load in ["=\"http", "=\"//", "url(", "@import", "fetch(", "{{", "{%"] {
        assert!(!page.contains(load), "{load}");
    }
    check_heat(folder.path(), errors["rows"][0]["max_deg"].as_f64().unwrap());
}

/// The meshes of a folder have a page each, with their own errors; the JSON has all of them.
#[test]
fn a_folder_of_meshes() {
    let folder = tempfile::tempdir().unwrap();
    let copy = |name: &str, to: &str| {
        std::fs::copy(repository().join("host/mesh/data").join(name), folder.path().join(to)).unwrap()
    };
    for name in ["meshes", "pages"] {
        std::fs::create_dir(folder.path().join(name)).unwrap();
    }
    copy("torus.glb", "meshes/a.b.glb");
    copy("bunny.obj", "meshes/c.obj");
    let line = "compare --codec oct16 meshes -o pages --json a.json --side 64 --samples 1 --view 1,0,0";
    assert_eq!(succeeds(folder.path(), line).lines().count(), 2);
    succeeds(folder.path(), "error --codec oct16 meshes/a.b.glb meshes/c.obj --json b.json");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("a.json"), read("b.json"));
    let errors: Value = serde_json::from_str(&read("a.json")).unwrap();
    let computed = "computed from its faces";
    for (row, (name, lacks)) in errors["rows"].as_array().unwrap().iter().zip([("a.b", false), ("c", true)]) {
        let page = read(&format!("pages/{name}.html"));
        let max = format!(">{:.6}<", row["max_deg"].as_f64().unwrap());
        assert_eq!(page.matches("<th scope=\"row\">oct16</th>").count(), 1);
        assert!(page.contains(&max) && page.contains(computed) == lacks, "{name}: {row}");
    }
    for (mesh, ply, words) in
        [("meshes", "heat.ply", "each by itself"), ("meshes/c.obj", "meshes/c.obj", "is the input")]
    {
        let mut command = command(["compare", "--codec", "oct16", mesh, "-o", "pages", "--ply", ply]);
        assert_fails(command.current_dir(folder.path()), 2, &[ply, words]);
    }
    // A mesh that cannot be measured is told, and the others have their errors as before.
    std::fs::write(folder.path().join("meshes/b.obj"), "v 0 0 0\n").unwrap();
    for (line, written) in [(line, "a.json"), ("error --codec oct16 meshes --json b.json", "b.json")] {
        let output = command(line.split(' ')).current_dir(folder.path()).output().unwrap();
        let told = stderr(&output);
        assert!(
            output.status.code() == Some(1) && told.contains("b.obj has neither normals nor faces"),
            "{told}"
        );
        assert!(told.ends_with("unitvec: 1 of 3 inputs failed; the others are done\n"), "{told}");
        assert_eq!(serde_json::from_str::<Value>(&read(written)).unwrap(), errors);
    }
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

/// A square in glTF with these images, this first material, and a primitive with each of these ends of its attributes: triangles,
/// then a strip. Accessors 3 and 4 are tangents along +X, with signs 1 and -1; the last buffer view, 4, is the picture.
fn textured(material: &str, images: &str, ends: &[&str], picture: &[u8]) -> Vec<u8> {
    let corners = [[-1.0f32, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = corners.iter().flat_map(|[x, y]| [*x, *y, 0.0]);
    let texture = corners.iter().flat_map(|[x, y]| [0.5 + 0.5 * x, 0.5 - 0.5 * y]);
    let tangents = [1.0f32, -1.0].into_iter().flat_map(|sign| [[1.0, 0.0, 0.0, sign]; 4].concat());
    let floats: Vec<u8> = positions.chain(texture).chain(tangents).flat_map(f32::to_le_bytes).collect();
    let indices: Vec<u8> = [0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes).collect();
    let buffer = [&floats[..], &indices, picture].concat();
    let primitive =
        |end: &&str| format!(r#"{{"attributes":{{"POSITION":0,"TEXCOORD_0":1{end}}},"indices":2"#);
    let primitives = ends
        .iter()
        .map(primitive)
        .zip(0..)
        .map(|(all, at)| format!(r#"{all},"material":{at},"mode":{}}}"#, 4 + at));
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"data:;base64,{}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},
        {{"buffer":0,"byteOffset":80,"byteLength":128}},{{"buffer":0,"byteOffset":208,"byteLength":12}},
        {{"buffer":0,"byteOffset":220,"byteLength":{}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}},
        {{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},{{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}},
        {{"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"}},
        {{"bufferView":2,"byteOffset":64,"componentType":5126,"count":4,"type":"VEC4"}}],
        "textures":[{{"source":0}}],"images":[{images}],"materials":[{{{material}}},{{}}],
        "meshes":[{{"primitives":[{}]}}]}}"#,
        buffer.len(),
        base64::engine::general_purpose::STANDARD.encode(&buffer),
        picture.len().max(1),
        primitives.collect::<Vec<_>>().join(",")
    )
    .into_bytes()
}

/// A folder with a normal map, and the page of `compare` on a mesh in it.
struct Mapped(tempfile::TempDir);

impl Mapped {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let waves = repository().join("host/texture/data/waves.png");
        std::fs::copy(waves, folder.path().join("waves.png")).unwrap();
        Self(folder)
    }

    fn page(&self, mesh: &[u8]) -> String {
        let folder = self.0.path();
        std::fs::write(folder.join("a.gltf"), mesh).unwrap();
        succeeds(folder, "compare --codec oct16 a.gltf --side 64 --samples 1 --view 0,0.3,1");
        std::fs::read_to_string(folder.join("compare.html")).unwrap()
    }
}

const NORMAL: &str = r#""normalTexture":{"index":0}"#;
const WAVES: &str = r#"{"uri":"waves.png"}"#;

/// The normal map of a material is shown, under tangents by MikkTSpace: a flat square, whose normal has a code, then shows errors
/// of none, but other pictures than without. What cannot be shown is told.
#[test]
fn normal_maps_are_shown() {
    let folder = Mapped::new();
    let page = |material: &str, images: &str| folder.page(&textured(material, images, &[""], &[]));
    let (plain, mapped) = (page("", ""), page(NORMAL, WAVES));
    let told = "<p>The mesh is shown with its normal texture 0, whose vectors are not in codes.</p>";
    assert!(mapped.contains(told) && !plain.contains("normal texture"));
    let pictures = |page: &str| page.matches("data:image/png;base64,").count();
    assert_eq!(pictures(&plain), pictures(&mapped));
    let no_error = "the mean at its pixels is 0.000000 degrees";
    assert!(mapped.contains(no_error) || mapped.contains("the mean at its pixels is 0 degrees"), "{mapped}");
    assert!(mapped.len() > plain.len() + 1000, "{} {}", mapped.len(), plain.len());
    for (material, images, words) in [
        (NORMAL, r#"{"uri":"none.png"}"#, "cannot read"),
        (NORMAL, r#"{"uri":"../none.png"}"#, "leaves the folder of the file"),
        (NORMAL, r#"{"uri":"a.gltf"}"#, "is no png, jpeg, tga, exr, ktx2 or dds"),
        (NORMAL, r#"{"bufferView":7}"#, "has not the bytes of a picture"),
        (NORMAL, "", "it has no image"),
        (r#""normalTexture":{"index":0,"texCoord":1}"#, WAVES, "lacks its texture coordinates"),
        (r#""normalTexture":{"index":-1}"#, WAVES, "invalid value"),
    ] {
        let page = page(material, images);
        assert!(page.contains("The normal texture ") && page.contains(" is not shown: "), "{words}");
        assert!(page.contains(words), "{words}");
    }
    let shared = folder.page(&textured(NORMAL, WAVES, &["", ""], &[]));
    assert!(shared.contains("is not shown: other materials have the same vertices"));
}

/// A picture in the file's buffer is shown as that in a file of its own, and one in a jpeg is shown. Tangents of the file that are
/// MikkTSpace's change nothing, and those with the other sign do.
#[test]
fn pictures_and_tangents_of_the_file() {
    let folder = Mapped::new();
    let waves = std::fs::read(folder.0.path().join("waves.png")).unwrap();
    let mut jpeg = std::io::Cursor::new(Vec::new());
    let picture = image::load_from_memory(&waves).unwrap().into_rgb8();
    picture.write_to(&mut jpeg, image::ImageFormat::Jpeg).unwrap();
    let shown = |end, images, picture: &[u8]| {
        let page = folder.page(&textured(NORMAL, images, &[end], picture));
        assert!(page.contains("The mesh is shown with its normal texture 0"));
        page
    };
    let in_buffer = r#"{"bufferView":4,"mimeType":"image/png"}"#;
    let own = shown("", WAVES, &[]);
    assert!(shown("", in_buffer, &waves) == own);
    assert!(shown("", in_buffer, jpeg.get_ref()) != own);
    assert!(shown(r#","TANGENT":3"#, WAVES, &[]) == own);
    assert!(shown(r#","TANGENT":4"#, WAVES, &[]) != own);
}

/// `KHR_texture_transform` moves a map: by its whole width, which shows nothing, or else to another place. Coordinates of the second
/// set are taken where it or the material says so.
#[test]
fn texture_coordinates_of_the_material() {
    let folder = Mapped::new();
    let page = |map: &str| {
        let map = format!(r#""normalTexture":{{"index":0{map}}}"#);
        let page = folder.page(&textured(&map, WAVES, &[r#","TEXCOORD_1":1"#], &[]));
        assert!(page.contains("The mesh is shown with its normal texture 0"));
        page
    };
    let moved = |how: &str| page(&format!(r#","extensions":{{"KHR_texture_transform":{{{how}}}}}"#));
    let own = page("");
    assert!(page(r#","texCoord":1"#) == own);
    assert!(moved(r#""offset":[1,-2],"texCoord":1"#) == own);
    for how in [r#""offset":[0.25,0]"#, r#""scale":[2,2]"#, r#""rotation":1.5"#] {
        assert!(moved(how) != own, "{how}");
    }
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
