//! `unitvec texture`: what it says of maps, and what it refuses.

use serde_json::Value;
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

/// The summary of a run in a folder, as JSON.
fn summary(folder: &Path, line: &str) -> Value {
    let words = line.split(' ').map(|word| match word.contains('.') {
        true => folder.join(word).into_os_string(),
        false => word.into(),
    });
    let output = run(["texture", "--json", "-"].map(Into::into).into_iter().chain(words));
    assert!(output.status.success(), "{line}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_summary_is_of_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let vectors = png(&folder.path().join("in.png"), false, None);
    let codec = find("hemioct16").unwrap();
    let errors: Vec<f64> = vectors
        .iter()
        .map(|v| {
            let decoded: [f32; 3] = codec.decode_one(codec.encode_one(*v));
            angle_deg(v.map(f64::from), decoded.map(f64::from))
        })
        .collect();
    let [mean, max] =
        [errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max)];
    for line in ["in.png --codec hemioct16 a.ktx2", "in.png --codec hemioct16 --unorm --mips --flip-y a.dds"]
    {
        let found = summary(folder.path(), line);
        assert_eq!(
            (&found["space"], &found["below_equator"], &found["filled"]),
            (&"tangent".into(), &0.into(), &0.into())
        );
        for (name, expected) in [("mean_deg", mean), ("max_deg", max)] {
            assert!((found[name].as_f64().unwrap() - expected).abs() < 1e-5, "{line}: {found}");
        }
        assert!(found["y_correlation"].as_f64().unwrap() > 0.9, "{found}");
        let expected = if line.contains("flip") {
            ("down", 5, "dds of R8G8_UNORM")
        } else {
            ("up", 1, "ktx2 of R8G8_SNORM")
        };
        assert_eq!(
            (&found["y"], &found["levels"], &found["written"]),
            (&expected.0.into(), &expected.1.into(), &expected.2.into())
        );
    }
    // Back again: the ktx2 names its codec and y, the dds needs to be told.
    let back = summary(folder.path(), "a.ktx2 b.png");
    assert_eq!(
        (&back["y"], &back["y_correlation"], &back["written"]),
        (&"up".into(), &Value::Null, &"png of 16 bits".into())
    );
    assert!(back["max_deg"].as_f64().unwrap() < 0.002, "{back}");
    summary(folder.path(), "--from hemioct16 --bits 8 a.dds b.png");
    let measured = run(["error", "--codec", "hemioct16", "--json", "-"]
        .iter()
        .map(Into::into)
        .chain([folder.path().join("in.png")]));
    let measured: Value = serde_json::from_slice(&measured.stdout).unwrap();
    assert_eq!(measured["rows"][0]["count"], SIDE * SIDE);
    assert!((measured["rows"][0]["mean_deg"].as_f64().unwrap() - mean).abs() < 1e-5, "{measured}");
}

#[test]
fn files_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    png(&folder.path().join("in.png"), false, None);
    summary(
        folder.path(),
        "in.png --codec hemioct16 --compress bc5 --heat heat.png --roughness rough.ktx2 a.ktx2",
    );
    let size = image::image_dimensions(folder.path().join("heat.png")).unwrap();
    assert_eq!(size, (SIDE, SIDE));
    let file = std::fs::read(folder.path().join("rough.ktx2")).unwrap();
    let reader = std::str::from_utf8(&file[1..7]);
    assert_eq!((reader, file[40]), (Ok("KTX 20"), 5));
    summary(folder.path(), "in.png --codec hemioct24 --mips --roughness alpha a.ktx2");
    summary(folder.path(), "in.png --roughness rough.png a.png");
    // The levels of 24, 12, 6, 3 and 1 texels, side by side.
    assert_eq!(image::image_dimensions(folder.path().join("rough.png")).unwrap(), (46, SIDE));
}

#[test]
fn maps_that_a_codec_cannot_hold() {
    let folder = tempfile::tempdir().unwrap();
    let [object, alpha] = ["object.png", "alpha.png"].map(|name| folder.path().join(name));
    png(&object, true, None);
    png(&alpha, false, Some(vec![0.5; (SIDE * SIDE) as usize]));
    let dropped = summary(folder.path(), "alpha.png --codec hemioct16 a.ktx2");
    assert!(dropped["warnings"][0].as_str().unwrap().contains("hemioct24"), "{dropped}");
    assert_eq!(summary(folder.path(), "alpha.png --codec hemioct24 a.ktx2").get("warnings"), None);
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
