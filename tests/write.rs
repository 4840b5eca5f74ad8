//! `unitvec write` and `decode --into`: files whose vectors are others, and in which nothing else is.

use crate::faults::fails;
use crate::snap::{containers, frames, obj, succeeds, write};
use unitvec_catalogue::{AnyCodec, Element, find};
use unitvec_tests::program::{raw, run_with_input, stderr};

/// The frames as they come back: a codec of vectors has the normals alone.
fn decoded(codec: &AnyCodec) -> Vec<[f32; 7]> {
    let decode = |mut frame: [f32; 7]| {
        match codec.element {
            Element::Frame => frame = codec.decode_one(codec.encode_one(frame)),
            Element::Vector | Element::Rotation => {
                let normal: [f32; 3] = codec.decode_one(codec.encode_one([frame[0], frame[1], frame[2]]));
                frame[..3].copy_from_slice(&normal);
            }
        }
        frame
    };
    frames().into_iter().map(decode).collect()
}

/// Codes go back into the mesh that they were made of, which becomes the same container of the decoded vectors, to the byte;
/// so do these as floats.
#[test]
fn decoded_vectors_go_back() {
    for make in containers() {
        let files = make(&frames());
        let (name, is_gltf) = (files[0].0, files[0].0.starts_with("a.gl"));
        for (id, kind) in [("oct16p", "normals"), ("frame32", "frames")] {
            if kind == "frames" && !is_gltf {
                continue;
            }
            let folder = tempfile::tempdir().unwrap();
            write(&folder.path().join("in"), &files);
            for out in ["out", "raw"] {
                std::fs::create_dir(folder.path().join(out)).unwrap();
            }
            for line in [
                format!("encode --codec {id} in/{name} codes.uvec"),
                format!("decode --into in/{name} codes.uvec out/{name}"),
                "decode codes.uvec floats.npy".to_owned(),
                format!("write in/{name} --{kind} floats.npy raw"),
            ] {
                succeeds(folder.path(), &line);
            }
            for (name, expected) in make(&decoded(find(id).unwrap())) {
                for out in ["out", "raw"] {
                    let read = std::fs::read(folder.path().join(out).join(name)).unwrap();
                    assert!(read == expected, "{id} {out}/{name}: {}", String::from_utf8_lossy(&read));
                }
            }
        }
    }
}

/// Another number of vectors, with both numbers; outputs that would replace something; formats without tangents.
#[test]
fn refusals() {
    let mesh = obj(&frames()).remove(0).1;
    let [floats, codes, quats] = [raw(&[0.6; 42 * 3]), vec![0; 41 * 2], vec![0; 40 * 4]];
    let files: [(&str, &[u8]); 4] =
        [("a.obj", &mesh), ("codes", &codes), ("f.f32", &floats), ("quats", &quats)];
    for (line, status, words) in [
        ("write a.obj --normals f.f32 b.obj", 2, ["a.obj has 40 normals", "f.f32 42"]),
        ("decode --codec oct16 --into a.obj codes b.obj", 2, ["a.obj has 40 normals", "codes 41"]),
        ("decode --codec quat32 --into a.obj quats b.obj", 2, ["quats has rotations", "a mesh has none"]),
        ("write a.obj --normals f.f32 a.obj", 2, ["a.obj is the input", "another name"]),
        ("write a.obj --normals f.f32 b.ply", 2, ["b.ply", "the same ending"]),
        ("decode --codec oct16 --into a.obj codes codes b.obj", 2, ["--into", "one mesh"]),
        ("write a.obj --frames f.f32 b.obj", 1, ["a normal and a tangent", ".glb"]),
    ] {
        fails(&files, line, status, &words);
    }
    // A stream that goes on is not read to its end.
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &obj(&frames()));
    let [input, out] = ["a.obj", "b.obj"].map(|name| folder.path().join(name).display().to_string());
    let more = raw(&[0.6; 50 * 3]);
    let output = run_with_input(["write", &input, "--normals", "-", &out], &more);
    assert!(stderr(&output).contains("- 41 or more"), "{}", stderr(&output));
}
