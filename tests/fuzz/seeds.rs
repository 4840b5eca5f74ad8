//! Small valid files of each format, which mutations start from.

use crate::link;
use base64::Engine;
use image::{DynamicImage, ImageFormat, Rgb, RgbImage};
use std::fmt::Write;
use std::io::Cursor;
use unitvec_catalogue::find;
use unitvec_host::container::Header;
use unitvec_host::raw::Npy;
use unitvec_manifest::Manifest;
use unitvec_manifest::modules::Modules;
use unitvec_tests::repository;
use unitvec_texture::block::Compression;
use unitvec_texture::{Coding, NormalMap, Texture};

/// Vertices a side of the grid that all meshes are.
pub const SIDE: usize = 5;

/// The vertices of a grid: position, then normal.
fn vertices(side: usize) -> impl Iterator<Item = [f32; 6]> {
    let at = move |k: usize| [(k % side) as f32, (k / side) as f32, (k % 3) as f32 * 0.25];
    (0..side * side).map(at).map(|[x, y, z]| [x, y, z, 0.6, -0.8, 0.0])
}

/// The faces of a grid, as pairs of triangles.
fn triangles(side: usize) -> impl Iterator<Item = [usize; 3]> {
    let corners = (0..side - 1).flat_map(move |y| (0..side - 1).map(move |x| y * side + x));
    corners.flat_map(move |k| [[k, k + 1, k + side], [k + 1, k + side + 1, k + side]])
}

/// Computed normals; normals of the file, and every kind of index; lines and names of other kinds; texture coordinates.
pub fn obj() -> Vec<Vec<u8>> {
    let mut bare = String::from("# grid\no first\n");
    for [x, y, z, ..] in vertices(SIDE) {
        writeln!(bare, "v {x} {y} {z}").unwrap();
    }
    let mut with_normals = bare.clone();
    for [a, b, c] in triangles(SIDE).map(|triangle| triangle.map(|corner| corner + 1)) {
        writeln!(bare, "f {a} {b} {c}").unwrap();
        writeln!(with_normals, "vn 0.6 -0.8 1e-3\nf {a}/1/{a} {b}//{b} -1").unwrap();
    }
    let others = "\u{feff}mtllib a.mtl\r\ng a b\r\nv 1 0 0 1 1 1\r\nv 0 1 0\r\nv 0 0 1\r\nvt 0 0\r\ns 1\r\nusemtl red\r\n\
        f 1/1 2/1 3/1\r\nf -3 -2 -1 -2\r\nl 1 2\r\n";
    let mut with_texture: String =
        vertices(SIDE).map(|[x, y, z, ..]| format!("v {x} {y} {z}\nvt {x} {y}\n")).collect();
    for [a, b, c] in triangles(SIDE).map(|triangle| triangle.map(|corner| corner + 1)) {
        writeln!(with_texture, "f {a}/{a} {b}/{b} {c}/{c}").unwrap();
    }
    [bare.as_str(), &with_normals, others, &with_texture].map(|text| text.as_bytes().to_vec()).into()
}

/// Number formats of PLY's three encodings.
pub const PLY_FORMATS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// A number of a PLY payload: its text, and its bytes, the lowest first.
type Number = (String, Vec<u8>);

macro_rules! number {
    ($number:expr) => {
        ($number.to_string(), $number.to_le_bytes().to_vec())
    };
}

fn write_number((text, bytes): &Number, format: &str, to: &mut Vec<u8>) {
    match format {
        "ascii" => to.extend(format!("{text} ").bytes()),
        "binary_big_endian" => to.extend(bytes.iter().rev()),
        _ => to.extend(bytes),
    }
}

/// A PLY file: elements, each with its header lines and its rows.
fn ply_of(format: &str, elements: &[(&str, Vec<Vec<Number>>)]) -> Vec<u8> {
    let (mut header, mut payload) = (format!("ply\nformat {format} 1.0\ncomment a grid\n"), Vec::new());
    for (lines, rows) in elements {
        let (name, properties) = lines.split_once('\n').unwrap_or((lines, ""));
        write!(header, "element {name} {}\n{properties}", rows.len()).unwrap();
        for row in rows {
            row.iter().for_each(|number| write_number(number, format, &mut payload));
            if format == "ascii" {
                payload.push(b'\n');
            }
        }
    }
    [header.as_bytes(), b"end_header\n", &payload].concat()
}

const POSITION: &str = "property float x\nproperty float y\nproperty float z\n";

/// Computed normals, with the faces after the vertices and before them; normals of the file, and rotations of splats.
pub fn ply(format: &str) -> Vec<Vec<u8>> {
    let positions: Vec<Vec<Number>> =
        vertices(SIDE).map(|[x, y, z, ..]| [x, y, z].map(|c| number!(c)).to_vec()).collect();
    let doubles =
        vertices(SIDE).map(|[x, y, z, ..]| [x, y, z].map(|c| number!(f64::from(c))).to_vec()).collect();
    let splat = |v: [f32; 6]| v.into_iter().chain([1.0, v[4], v[3], 0.0]).map(|c| number!(c)).collect();
    let splats = vertices(SIDE).map(splat).collect();
    let names = ["nx", "ny", "nz", "rot_0", "rot_1", "rot_2", "rot_3"];
    let names = names.map(|name| format!("property float {name}\n")).concat();
    let face = |counts: &[u8], corners: [Number; 3]| -> Vec<Number> {
        counts.iter().map(|count| number!(count)).chain(corners).collect()
    };
    let faces = triangles(SIDE).map(|corners| face(&[3], corners.map(|corner| number!((corner as i32)))));
    let small = triangles(SIDE).map(|corners| face(&[1, 3], corners.map(|corner| number!((corner as u8)))));
    let (faces, small): (Vec<_>, Vec<_>) = (faces.collect(), small.collect());
    let vertex = format!("vertex\n{POSITION}");
    let face = "face\nproperty list uchar int vertex_indices\n";
    let other =
        ("edge\nproperty list uchar float w\n", vec![vec![number!(2u8), number!(0.5f32), number!(1.5f32)]]);
    let textured = vertices(SIDE).map(|[x, y, z, ..]| [x, y, z, x, y].map(|c| number!(c)).to_vec()).collect();
    let texture = format!("{vertex}property float s\nproperty float t\n");
    vec![
        ply_of(format, &[(&vertex, positions.clone()), (face, faces.clone()), other.clone()]),
        ply_of(format, &[(&texture, textured), (face, faces)]),
        ply_of(
            format,
            &[
                ("face\nproperty uchar flags\nproperty list uchar uchar vertex_index\n", small),
                ("vertex\nproperty double x\nproperty double y\nproperty double z\n", doubles),
            ],
        ),
        ply_of(format, &[other, (&format!("{vertex}{names}"), splats)]),
    ]
}

/// Indices, positions, normals and tangents of a grid, and where each begins.
fn grid_buffer(side: usize) -> (Vec<u8>, [usize; 5]) {
    let mut buffer: Vec<u8> =
        triangles(side).flatten().flat_map(|corner| (corner as u16).to_le_bytes()).collect();
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let mut starts = [0, buffer.len(), 0, 0, 0];
    let parts: [fn([f32; 6]) -> Vec<f32>; 3] =
        [|v| v[..3].to_vec(), |v| v[3..].to_vec(), |v| vec![v[4], v[3], 0.0, 1.0]];
    for (at, part) in parts.into_iter().enumerate() {
        buffer.extend(vertices(side).flat_map(part).flat_map(f32::to_le_bytes));
        starts[at + 2] = buffer.len();
    }
    (buffer, starts)
}

/// A glTF document over [`grid_buffer`].
fn document(primitives: &str, uri: &str) -> String {
    let (_, [start, positions, normals, tangents, end]) = grid_buffer(SIDE);
    let view =
        |from: usize, to: usize| format!(r#"{{"buffer":0,"byteOffset":{from},"byteLength":{}}}"#, to - from);
    let views = [(start, positions), (positions, normals), (normals, tangents), (tangents, end)];
    let views = views.map(|(from, to)| view(from, to)).join(",");
    let (vertices, corners) = (SIDE * SIDE, triangles(SIDE).count() * 3);
    let vector = |view: usize, kind: &str| {
        format!(
            r#"{{"bufferView":{view},"componentType":5126,"count":{vertices},"type":"{kind}","min":[0,0,0],"max":[4,4,1]}}"#
        )
    };
    format!(
        r#"{{"asset":{{"version":"2.0"}},"extensionsUsed":["KHR_mesh_quantization"],"scene":0,"nodes":[{{"mesh":0}}],
        "animations":[{{"name":"a","samplers":[{{"input":2,"output":3,"interpolation":"CUBICSPLINE"}}],
        "channels":[{{"sampler":0,"target":{{"node":0,"path":"rotation"}}}}]}}],
        "meshes":[{{"name":"grid","primitives":[{primitives}]}}],"buffers":[{{"byteLength":{end}{uri}}}],
        "bufferViews":[{views}],"accessors":[
        {{"bufferView":0,"componentType":5123,"count":{corners},"type":"SCALAR"}},{},{},{},
        {{"componentType":5126,"count":{vertices},"type":"VEC3","sparse":{{"count":2,
        "indices":{{"bufferView":0,"componentType":5123}},"values":{{"bufferView":2}}}}}},
        {{"bufferView":1,"componentType":5120,"normalized":true,"count":{vertices},"type":"VEC3"}},
        {{"bufferView":1,"componentType":5126,"count":{vertices},"type":"VEC2"}}]}}"#,
        vector(1, "VEC3"),
        vector(2, "VEC3"),
        vector(3, "VEC4"),
    )
}

/// Computed normals, frames, strips and fans, sparse and quantised normals, texture coordinates, splats.
const PRIMITIVES: [&str; 6] = [
    r#"{"attributes":{"POSITION":1},"indices":0}"#,
    r#"{"attributes":{"POSITION":1,"NORMAL":2,"TANGENT":3},"indices":0}"#,
    r#"{"attributes":{"POSITION":1},"indices":0,"mode":5},{"attributes":{"POSITION":1},"mode":6}"#,
    r#"{"attributes":{"POSITION":1,"NORMAL":4}},{"attributes":{"POSITION":1,"NORMAL":5}}"#,
    r#"{"attributes":{"POSITION":1,"NORMAL":2,"TEXCOORD_0":6},"indices":0}"#,
    r#"{"attributes":{"POSITION":1,"NORMAL":2,"KHR_gaussian_splatting:ROTATION":3},"mode":0}"#,
];

/// The file beside the glTF files, in which some of their buffers lie.
pub const BUFFER_FILE: &str = "grid.bin";

/// Contents of [`BUFFER_FILE`].
pub fn buffer_file() -> Vec<u8> {
    grid_buffer(SIDE).0
}

/// Buffers inside the document and beside it.
pub fn gltf() -> Vec<Vec<u8>> {
    let inside = base64::engine::general_purpose::STANDARD.encode(buffer_file());
    let uris = [BUFFER_FILE.to_owned(), format!("data:;base64,{inside}")];
    let uris = uris.map(|uri| format!(r#","uri":"{uri}""#));
    let documents =
        PRIMITIVES.iter().flat_map(|primitives| uris.each_ref().map(|uri| document(primitives, uri)));
    documents.map(String::into_bytes).collect()
}

/// The documents of [`gltf`] with a binary chunk.
pub fn glb() -> Vec<Vec<u8>> {
    PRIMITIVES.iter().map(|primitives| glb_of(&document(primitives, ""), &buffer_file())).collect()
}

/// A GLB file.
pub fn glb_of(json: &str, bin: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8], pad: u8| {
        let mut data = data.to_vec();
        data.resize(data.len().next_multiple_of(4), pad);
        [&(data.len() as u32).to_le_bytes(), kind.as_slice(), &data].concat()
    };
    let body = [chunk(b"JSON", json.as_bytes(), b' '), chunk(b"BIN\0", bin, 0)].concat();
    [b"glTF".as_slice(), &2u32.to_le_bytes(), &(body.len() as u32 + 12).to_le_bytes(), &body].concat()
}

/// Pictures of colours, with alpha where the format has it as bytes, and of grey.
pub fn picture(format: ImageFormat) -> Vec<Vec<u8>> {
    let side = SIDE as u32;
    let colors = RgbImage::from_fn(side, side, |x, y| Rgb([30 * x as u8, 40 * y as u8, 250]));
    let colors = DynamicImage::from(colors);
    let images = match format {
        ImageFormat::OpenExr => [colors.to_rgb32f().into(), colors.to_rgba32f().into()],
        ImageFormat::Jpeg => [colors.to_rgb8().into(), colors.to_luma8().into()],
        _ => [colors.to_rgba8().into(), colors.to_luma8().into()],
    };
    let saved = |image: DynamicImage| {
        let mut file = Cursor::new(Vec::new());
        image.write_to(&mut file, format).unwrap();
        file.into_inner()
    };
    images.map(saved).into()
}

/// Textures of components, of codes and of blocks.
pub fn textures(write: fn(&Texture) -> unitvec_texture::Result<Vec<u8>>) -> Vec<Vec<u8>> {
    let (side, vectors) = (SIDE as u32, vertices(SIDE).map(|[_, _, _, x, y, z]| [x, -y, z]).collect());
    let map = NormalMap { width: side, height: side, vectors, alpha: None };
    let coding = |id| Coding::of(find(id).unwrap(), false).unwrap();
    let blocks = Coding::compressed(find("oct16").unwrap(), Compression::Bc7).unwrap();
    let file = |(coding, codec): (Coding, Option<&str>)| {
        let levels = vec![coding.pack(&map), vec![0; 2 * coding.format.bytes()]];
        let codec = codec.map(str::to_owned);
        write(&Texture { format: coding.format, width: side, height: side, levels, codec, y: None }).unwrap()
    };
    let codings =
        [(coding("unorm8x3"), None), (coding("hemioct16"), Some("hemioct16")), (blocks, Some("oct16"))];
    codings.map(file).into()
}

/// Raw floats, or codes: anything whose length is that of whole elements.
pub fn raw() -> Vec<Vec<u8>> {
    let floats: Vec<u8> = vertices(SIDE).flatten().flat_map(f32::to_le_bytes).collect();
    let count = floats.len() as u64 / 12;
    let array = [&Npy::new("<f4", count, 3).to_bytes()[..], &floats].concat();
    let format = find("frame64").unwrap();
    let header = Header::new(format, false, None).finish(0, floats.len() as u64 / 8, Default::default());
    vec![Vec::new(), [&header[..], &floats].concat(), array, floats, vec![0x7f; 84]]
}

/// Reports of `unitvec bench device` and `unitvec bench compiler`, cut to a few rows.
pub fn costs() -> Vec<Vec<u8>> {
    let shorter = |name: &str| {
        let report = std::fs::read(repository().join("host/choose/data").join(name)).unwrap();
        let mut report: serde_json::Value = serde_json::from_slice(&report).unwrap();
        let rows = report["rows"].as_array_mut().unwrap();
        rows.retain(|row| ["oct16", "oct32"].contains(&row["id"].as_str().unwrap()));
        rows.truncate(8);
        if let Some(sources) = report.get_mut("sources") {
            *sources = serde_json::json!({ "glsl/unitvec/oct.glsl": "00" });
        }
        serde_json::to_vec(&report).unwrap()
    };
    ["costs_lavapipe.json", "costs_navi21.json"].map(shorter).into()
}

/// The kernel of [`manifest`] and [`module`].
pub const KERNEL: &str = "oct16_encode";

/// The module's place in its folder.
pub const MODULE_FILE: &str = "kernels/oct16.spv";

/// The program's manifest, with the module of one codec.
pub fn manifest() -> Vec<Vec<u8>> {
    let mut manifest: Manifest = Modules::open(None).unwrap().manifest().clone();
    manifest.modules.retain(|module| module.file == MODULE_FILE);
    vec![serde_json::to_vec(&manifest).unwrap(), serde_json::to_vec_pretty(&manifest).unwrap()]
}

/// The module in [`MODULE_FILE`].
pub fn module() -> Vec<Vec<u8>> {
    vec![Modules::open(None).unwrap().load(KERNEL).unwrap().into_owned()]
}

/// Shaders that call stubs, by value and by pointers.
pub fn shader() -> Vec<Vec<u8>> {
    let ids = ["oct16", "oct48", "frame32"];
    let formats = ids.map(|id| find(id).unwrap());
    let shaders = [link::GLSL, link::HLSL].into_iter().flat_map(|front_end| {
        formats.map(|format| link::with_stubs(&front_end, &link::caller(&front_end, &[format]), |text| text))
    });
    shaders.collect()
}
