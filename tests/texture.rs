//! `unitvec texture`: what it says of maps, and what it refuses.

use base64::Engine;
use serde_json::{Value, json};
use std::path::Path;
use unitvec_catalogue::find;
use unitvec_oracle::angle_deg;
use unitvec_tests::program::{refusal, run, stderr};
use unitvec_texture::{NormalMap, picture, read};

const SIDE: u32 = 24;

/// A png of 16 bits of the normals of waves with y up the image; in object space, of all directions.
fn png(path: &Path, is_object: bool, alpha: Option<Vec<f32>>) -> Vec<[f32; 3]> {
    let at = |i: u32| [f64::from(i % SIDE), f64::from(i / SIDE)];
    let normal = |[x, row]: [f64; 2]| {
        let (a, b) = (0.3 * x - 0.2 * row, 0.2 * x + 0.35 * row);
        let z = if is_object { (x - 11.5) * 0.1 } else { 1.0 };
        let v = [-0.3 * a.cos() + 0.2 * b.sin(), -0.2 * a.cos() - 0.35 * b.sin(), z];
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| (c / length) as f32)
    };
    let vectors = (0..SIDE * SIDE).map(|i| normal(at(i))).collect();
    let file = picture::write(&NormalMap { width: SIDE, height: SIDE, vectors, alpha }, 16).unwrap();
    std::fs::write(path, &file).unwrap();
    read(path, &file, None).unwrap().map.vectors
}

/// The JSON of a command on files in a folder.
fn json_of(folder: &Path, line: &str) -> Value {
    let words = line.split(' ').map(|word| match word.contains('.') {
        true => folder.join(word).into_os_string(),
        false => word.into(),
    });
    let output = run(words.chain(["--json".into(), "-".into()]));
    assert!(output.status.success(), "{line}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_summary_is_of_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let (vectors, codec) = (png(&folder.path().join("in.png"), false, None), find("hemioct16").unwrap());
    let error = |v: &[f32; 3]| {
        let decoded: [f32; 3] = codec.decode_one(codec.encode_one(*v));
        angle_deg(v.map(f64::from), decoded.map(f64::from))
    };
    let errors: Vec<f64> = vectors.iter().map(error).collect();
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let max = errors.iter().copied().fold(0.0, f64::max);
    // Back again, the ktx2 names its codec and y; the dds needs to be told the codec, and its y is guessed.
    for (line, told, is_guessed) in [
        ("in.png --codec hemioct16 a.ktx2", json!(["tangent", 0, "up", 1, "ktx2 of R8G8_SNORM"]), true),
        (
            "in.png --codec hemioct16 --unorm --mips --flip-y a.dds",
            json!(["tangent", 0, "down", 5, "dds of R8G8_UNORM"]),
            true,
        ),
        ("a.ktx2 b.png", json!(["tangent", 0, "up", 1, "png of 16 bits"]), false),
        ("--from hemioct16 --bits 8 a.dds b.png", json!(["tangent", 0, "down", 1, "png of 8 bits"]), true),
    ] {
        let found = json_of(folder.path(), &format!("texture {line}"));
        let keys = ["space", "below_equator", "y", "levels", "written"];
        assert_eq!((json!(keys.map(|key| &found[key])), found["y_correlation"].is_f64()), (told, is_guessed));
        let expected = if line.contains("b.png") { [0.0, 0.0] } else { [mean, max] };
        // A biased byte is off by up to asin(sqrt(3) / 255).
        let slack = if line.contains("--bits") { 0.39 } else { 0.002 };
        for (name, expected) in ["mean_deg", "max_deg"].into_iter().zip(expected) {
            assert!((found[name].as_f64().unwrap() - expected).abs() < slack, "{line}: {found}");
        }
    }
    let row = &json_of(folder.path(), "error --codec hemioct16 in.png")["rows"][0];
    assert_eq!(row["count"], SIDE * SIDE);
    assert!((row["mean_deg"].as_f64().unwrap() - mean).abs() < 1e-5, "{row}");
}

#[test]
fn files_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    png(&folder.path().join("in.png"), false, None);
    for line in [
        "--codec hemioct16 --compress bc5 --heat heat.png --roughness rough.ktx2 a.ktx2",
        "--codec hemioct24 --mips --roughness alpha a.ktx2",
        "--roughness rough.png a.png",
    ] {
        json_of(folder.path(), &format!("texture in.png {line}"));
    }
    let size = |name: &str| image::image_dimensions(folder.path().join(name)).unwrap();
    // The levels of 24, 12, 6, 3 and 1 texels, side by side, and their number in the header of a ktx2.
    assert_eq!([size("heat.png"), size("rough.png")], [(SIDE, SIDE), (46, SIDE)]);
    assert_eq!(std::fs::read(folder.path().join("rough.ktx2")).unwrap()[40], 5);
}

/// A folder of maps becomes a folder of textures, each of its map's name, and one that is broken does not stop the others.
#[test]
fn a_folder_of_maps() {
    let folder = tempfile::tempdir().unwrap();
    let [maps, out] = ["maps", "out"].map(|name| folder.path().join(name));
    std::fs::create_dir_all(maps.join("below")).unwrap();
    std::fs::create_dir(&out).unwrap();
    for name in ["a.b.png", "a.c.png", "below/d.png"] {
        png(&maps.join(name), false, None);
    }
    std::fs::write(maps.join("notes.txt"), "not taken").unwrap();
    let converted = |more: &[&str]| {
        let words = [&["texture", "--json", "-", "--codec", "hemioct16"], more].concat();
        run(words.iter().map(Into::into).chain([&maps, &out].map(|path| path.clone().into_os_string())))
    };
    let all = converted(&["--ending", "dds"]);
    assert!(all.status.success(), "{}", stderr(&all));
    let all: Value = serde_json::from_slice(&all.stdout).unwrap();
    let written =
        |one: &Value| Path::new(one["output"].as_str().unwrap()).file_name().map(|name| name.to_owned());
    let names: Vec<_> = all.as_array().unwrap().iter().filter_map(written).collect();
    assert_eq!(names, ["a.b.dds", "a.c.dds", "d.dds"]);
    let by_itself = folder.path().join("single.dds");
    json_of(folder.path(), "texture maps/a.b.png --codec hemioct16 single.dds");
    assert_eq!(std::fs::read(out.join("a.b.dds")).unwrap(), std::fs::read(by_itself).unwrap());

    // A folder that is named as one is made.
    for named in ["--out-dir made.d", "made.d/below/"] {
        json_of(folder.path(), &format!("texture maps/a.b.png --codec hemioct16 {named}"));
    }
    assert!(
        ["a.b.ktx2", "below/a.b.ktx2"].iter().all(|name| folder.path().join("made.d").join(name).is_file())
    );

    std::fs::write(maps.join("a.c.png"), b"\x89PNG\r\n\x1a\n").unwrap();
    let some = converted(&[]);
    assert!(
        !some.status.success() && stderr(&some).contains("a.c.png") && stderr(&some).contains("1 of 3"),
        "{}",
        stderr(&some)
    );
    assert!(out.join("a.b.ktx2").exists() && !out.join("a.c.ktx2").exists());
    // Files beside the output are of one input.
    let heat = folder.path().join("heat.png");
    assert!(
        stderr(&converted(&["--heat", heat.to_str().unwrap()])).contains("each by itself") && !heat.exists()
    );
}

#[test]
fn maps_that_a_codec_cannot_hold() {
    let folder = tempfile::tempdir().unwrap();
    let [object, alpha] = ["object.png", "alpha.png"].map(|name| folder.path().join(name));
    png(&object, true, None);
    png(&alpha, false, Some(vec![0.5; (SIDE * SIDE) as usize]));
    let dropped = json_of(folder.path(), "texture alpha.png --codec hemioct16 a.ktx2");
    assert!(dropped["warnings"][0].as_str().unwrap().contains("hemioct24"), "{dropped}");
    assert_eq!(json_of(folder.path(), "texture alpha.png --codec hemioct24 a.ktx2").get("warnings"), None);
    let out = folder.path().join("x.ktx2");
    for (arguments, words) in [
        (&["--codec", "hemioct16"][..], "take oct16p"),
        (&[], "--codec has to name"),
        (&["--codec", "ico16", "--unorm"], "two SNORM channels"),
        (&["--codec", "ico16", "--compress", "bc5"], "hemioct16"),
        (&["--codec", "oct16", "--mips", "--roughness", "alpha"], "channel to spare"),
        (&["--codec", "oct16", "--from", "oct16"], "leave --from out"),
        (&["--codec", "frame32"], "frames"),
    ] {
        let command =
            ["texture"].iter().chain(arguments).map(Into::into).chain([object.clone(), out.clone()]);
        let output = run(command);
        let said = refusal(&output, output.status.code().unwrap());
        assert!(said.contains(words), "{said}");
    }
    assert!(!out.exists());
}

/// A flat map as a palette of one colour: a byte of it stands for 1909, more than of any picture without a palette.
#[test]
fn a_map_of_indices() {
    /// 256 x 256 texels of (128, 128, 255), an index of one bit each.
    const FLAT: &str = "iVBORw0KGgoAAAANSUhEUgAAAQAAAAEAAQMAAABmvDolAAAAA1BMVEWAgP9QzlGcAAAAH0lEQVR42u3BAQ0AAADCoPdPbQ43oAAAAAAA\
        AAAAvg0hAAABYOSdlwAAAABJRU5ErkJggg==";
    let file = base64::engine::general_purpose::STANDARD.decode(FLAT).unwrap();
    let map = read(Path::new("flat.png"), &file, None).unwrap().map;
    let length = (2.0 + 255.0 * 255.0_f64).sqrt();
    let expected = [1.0, 1.0, 255.0].map(|c: f64| c / length);
    assert_eq!(map.vectors.len(), 256 * 256);
    assert!(map.vectors.iter().all(|v| angle_deg(v.map(f64::from), expected) < 1e-5));
    assert!(read(Path::new("cut.png"), &file[..70], None).is_err());
}
