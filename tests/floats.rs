//! Raw floats of other kinds than f32, NumPy's arrays, codes with a header, several files and folders.

use crate::faults::assert_fails;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};
use unitvec_mesh::BUNNY;
use unitvec_tests::names;
use unitvec_tests::program::{command, run_with_input, stderr};

/// Vectors of unit length to within a half's precision, each with a negative component.
fn vectors() -> Vec<[f64; 3]> {
    let turns = (0..100).map(|k| f64::from(k) * 0.37);
    turns.map(|turn| [turn.cos() * 0.8, turn.sin() * 0.8, -0.6]).collect()
}

fn bytes(f: impl Fn(f64) -> Vec<u8>) -> Vec<u8> {
    vectors().into_iter().flatten().flat_map(f).collect()
}

fn f32s() -> Vec<u8> {
    bytes(|c| (c as f32).to_le_bytes().into())
}

/// Runs a line in a folder; the standard error.
fn said(folder: &Path, line: &str) -> String {
    let output = command(line.split(' ')).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{line}: {}", stderr(&output));
    stderr(&output)
}

/// A NumPy array as NumPy's manual (numpy.lib.format, version 1.0) lays it out.
fn array(descr: &str, order: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let text = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}");
    let text = format!("{text:<117}\n");
    [&b"\x93NUMPY\x01\x00"[..], &118u16.to_le_bytes(), text.as_bytes(), data].concat()
}

/// Floats of each kind, raw and as arrays, give the codes of their nearest f32.
#[test]
fn every_kind_of_float_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let codes = |line: &str| {
        said(folder.path(), &format!("encode --codec oct24p {line} out"));
        fs::read(at("out")).unwrap()
    };
    let half = |c: f64| half::f16::from_f64(c);
    fs::write(at("f32.bin"), f32s()).unwrap();
    fs::write(at("half.bin"), bytes(|c| half(c).to_f32().to_le_bytes().into())).unwrap();
    let [expected, of_halves] = ["f32.bin", "half.bin"].map(codes);
    for (name, descr, data) in [
        ("f32", "<f4", f32s()),
        ("f64", "<f8", bytes(|c| c.to_le_bytes().into())),
        ("f64be", ">f8", bytes(|c| c.to_be_bytes().into())),
        ("f32be", ">f4", bytes(|c| (c as f32).to_be_bytes().into())),
        ("f16", "<f2", bytes(|c| half(c).to_le_bytes().into())),
        ("f16be", ">f2", bytes(|c| half(c).to_be_bytes().into())),
    ] {
        let expected = if name.starts_with("f16") { &of_halves } else { &expected };
        fs::write(at("a.raw"), &data).unwrap();
        assert_eq!(codes(&format!("--dtype {name} a.raw")), *expected, "{name}");
        fs::write(at("a.npy"), array(descr, "False", "(100, 3)", &data)).unwrap();
        assert_eq!(codes("a.npy"), *expected, "{descr}");
        fs::write(at("a.npy"), array(descr, "False", "(4, 25, 3)", &data)).unwrap();
        assert_eq!(codes("a.npy"), *expected, "{descr}");
        // Without its kind, each but the first is warned of, and by its name.
        fs::write(at("a.bin"), &data).unwrap();
        if data.len() % 12 == 0 {
            let told = said(folder.path(), "encode --codec oct24p a.bin out");
            assert_eq!(
                told.contains(&format!("is --dtype {name} missing?")),
                name != "f32",
                "{name}: {told}"
            );
        }
    }
    let cut = run_with_input(["encode", "--codec", "oct24p", "--dtype", "f64", "-", "-"], &[0; 25]);
    assert!(stderr(&cut).contains("ends within a float"), "{}", stderr(&cut));
}

/// Unit vectors by other layouts are named; lengths are told, and the place of the first vector that has none.
#[test]
fn other_layouts_are_suspected() {
    let planes: Vec<u8> =
        (0..3).flat_map(|c| vectors().into_iter().flat_map(move |v| (v[c] as f32).to_le_bytes())).collect();
    for (data, words) in [
        (bytes(|c| ((c * 0.5 + 0.5) as f32).to_le_bytes().into()), "biased to 0..1"),
        (bytes(|c| (c.abs() as f32 * 3.0).to_le_bytes().into()), "no component is negative"),
        (planes, "interleave"),
    ] {
        let told = stderr(&run_with_input(["encode", "--codec", "oct16", "-", "-"], &data));
        assert!(told.contains("unitvec: warning: -: ") && told.contains(words), "{words}: {told}");
        let table = run_with_input(["error", "--codec", "oct16", "-"], &data);
        assert!(String::from_utf8_lossy(&table.stdout).contains(words), "{words}");
    }
    let array = array("<f8", "False", "(100, 3)", &bytes(|c| (c * 0.5 + 0.5).to_le_bytes().into()));
    for (codec, data, words) in [
        ("oct16", array, "biased to 0..1"),
        ("oct16", bytes(|c| ((c * 1e-9) as f32).to_le_bytes().into()), "far from 1"),
        ("oct16", vec![0; 120], "most of them have no direction"),
        ("hemioct16", f32s(), "the codec is for z >= 0 only"),
        ("snorm8x3", bytes(|c| ((c * 7.0) as f32).to_le_bytes().into()), "clamps"),
    ] {
        let told = stderr(&run_with_input(["encode", "-q", "--codec", codec, "-", "-"], &data));
        assert!(told.starts_with("unitvec: warning: -: ") && told.contains(words), "{words}: {told}");
    }
    let lost = [&f32s()[..120], &[0; 12], &f32s()[..12]].concat();
    let told = stderr(&run_with_input(["encode", "--codec", "oct16", "-", "-"], &lost));
    let expected = "12 vectors, 1 without a direction (stored as +Z; the first is number 10), lengths 1.0000 to 1.0000\n";
    assert_eq!(told, expected);
}

/// An array that cannot be taken, and what to save instead.
#[test]
fn arrays_that_are_refused() {
    let data = f32s();
    for (content, words) in [
        (array("<f4", "True", "(100, 3)", &data), "ascontiguousarray"),
        (array("<i4", "False", "(100, 3)", &data), "astype(numpy.float32)"),
        (array("<f4", "False", "(300,)", &data), "shape is [300]"),
        (array("<f4", "False", "(99, 3)", &data), "its header is of 99 vectors, and there are 100"),
        (array("<f4", "False", "(18446744073709551615, 2, 3)", &data), "shape is"),
        (b"\x93NUMPY\x01\x00\xff\xffnothing".to_vec(), "no array"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a.npy"), content).unwrap();
        let mut encode = command(["encode", "--codec", "oct16", "a.npy", "out"]);
        assert_fails(encode.current_dir(folder.path()), 1, &["a.npy", words]);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}

/// A header tells the codec; other codecs, damage and a cut are errors, and leave nothing. Arrays come back as they were.
#[test]
fn codes_with_a_header() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("in.f32"), f32s()).unwrap();
    said(folder.path(), "encode --codec oct24p in.f32 plain");
    said(folder.path(), "encode --codec oct24P in.f32 a.uvec");
    said(folder.path(), "decode --codec oct24p plain plain.f32");
    said(folder.path(), "decode a.uvec told.f32");
    said(folder.path(), "decode a.uvec told.npy");
    let [plain, codes, expected, told, npy] =
        ["plain", "a.uvec", "plain.f32", "told.f32", "told.npy"].map(|name| fs::read(at(name)).unwrap());
    assert_eq!(told, expected);
    assert_eq!(npy, array("<f4", "False", "(100, 3)", &expected));
    std::os::unix::fs::symlink("in.f32", at("linked")).unwrap();
    // The layout, read by itself.
    let length = u64::from_le_bytes(codes[8..16].try_into().unwrap()) as usize;
    let header: Value = serde_json::from_slice(&codes[16..16 + length]).unwrap();
    assert_eq!((&codes[..8], &codes[16 + length..]), (&b"unitvec\0"[..], &plain[..]));
    assert_eq!((16 + length) % 64, 0);
    let hash = unitvec_manifest::sha256_hex(&plain);
    let json = serde_json::json!({"version": 1, "codec": "oct24p", "bytes": 3, "count": 100, "sha256": hash});
    assert_eq!(header, json);
    let changed =
        |at: usize, byte: u8| codes[..at].iter().chain(&[byte]).chain(&codes[at + 1..]).copied().collect();
    for (content, line, status, words) in [
        (codes.clone(), "decode --codec oct24 b.uvec out", 2, "codes of oct24p, not of oct24"),
        (changed(codes.len() - 1, 255), "decode b.uvec out", 1, "not those that its header is of"),
        (changed(17, b'x'), "decode b.uvec out", 1, "its header is damaged"),
        (changed(27, b'9'), "decode b.uvec out", 1, "its version is 9"),
        (codes[..codes.len() - 3].to_vec(), "decode b.uvec out", 1, "of 100 codes, and there are 99"),
        (codes.clone(), "encode --codec oct16 b.uvec out", 2, "b.uvec is neither a mesh"),
        (codes.clone(), "decode b.uvec b2.uvec", 2, "has the name of codes"),
        (plain.clone(), "decode --codec oct24p b.uvec out", 2, "no header"),
        (codes.clone(), "decode plain out", 2, "does not tell its codec"),
        (codes.clone(), "decode --json plain --codec oct24p plain out", 2, "is an input or output"),
        (codes.clone(), "encode --codec oct16 --json ./out in.f32 out", 2, "is an input or output"),
        (codes.clone(), "error --json linked in.f32", 2, "is an input or output"),
        (codes.clone(), "encode --codec oct16 in.f32 o.bin", 2, "the name of raw floats"),
        (codes.clone(), "decode --codec oct24p told.npy out", 1, "no codes of 3 bytes"),
    ] {
        fs::write(at("b.uvec"), content).unwrap();
        assert_fails(command(line.split(' ')).current_dir(folder.path()), status, &[words]);
        assert!(!at("out").exists(), "{line}");
    }
    // Codes as arrays: one integer each, or bytes where no integer has so many.
    for (codec, shape, descr) in [("oct32", "(100,)", "<u4"), ("oct24p", "(100, 3)", "|u1")] {
        said(folder.path(), &format!("encode --codec {codec} in.f32 codes.npy"));
        said(folder.path(), &format!("encode --codec {codec} in.f32 raw"));
        let raw = fs::read(at("raw")).unwrap();
        assert_eq!(fs::read(at("codes.npy")).unwrap(), array(descr, "False", shape, &raw));
        said(folder.path(), &format!("decode --codec {codec} codes.npy back.f32"));
        let wrong = "decode --codec oct48 codes.npy out";
        assert_fails(command(wrong.split(' ')).current_dir(folder.path()), 1, &["codes.npy"]);
    }
}

/// Several files, and the meshes of folders, go into a folder; nothing is overwritten by another input.
#[test]
fn several_files_and_folders() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir_all(at("meshes/below")).unwrap();
    fs::create_dir(at("codes")).unwrap();
    fs::write(at("meshes/below/a.obj"), BUNNY).unwrap();
    fs::write(at("meshes/b.obj"), BUNNY).unwrap();
    fs::write(at("meshes/notes.txt"), "no mesh").unwrap();
    fs::write(at("c.obj"), BUNNY).unwrap();
    let told = said(folder.path(), "encode --codec oct16 --json all.json c.obj meshes codes");
    assert!(told.lines().count() == 3 && told.contains("meshes/below/a.obj: 1839 vectors"), "{told}");
    let all: Value = serde_json::from_slice(&fs::read(at("all.json")).unwrap()).unwrap();
    assert_eq!(all.as_array().unwrap().len(), 3);
    assert_eq!(names(&at("codes")), ["a.uvec", "b.uvec", "c.uvec"]);
    said(folder.path(), "decode codes codes");
    assert_eq!(fs::metadata(at("codes/c.f32")).unwrap().len(), 1839 * 12);
    fs::write(at("meshes/a.glb"), "no mesh").unwrap();
    for command_line in ["encode --codec oct32", "normals"] {
        let line = format!("{command_line} --json all.json meshes/a.glb c.obj codes");
        let output = command(line.split(' ')).current_dir(folder.path()).output().unwrap();
        assert!(
            output.status.code() == Some(1) && stderr(&output).contains("1 of 2 inputs failed"),
            "{line}"
        );
    }
    fs::remove_file(at("meshes/a.glb")).unwrap();
    for (line, words) in [
        ("encode --codec oct16 c.obj meshes none", "none is none"),
        ("encode --codec oct16 c.obj c.obj codes", "would both become"),
        ("encode --codec oct16 codes codes", "no file in the folder codes"),
        ("encode --codec oct16 --dtype f64 c.obj out", "leave --dtype out"),
    ] {
        assert_fails(command(line.split(' ')).current_dir(folder.path()), 2, &[words]);
    }
}

/// Where the standard error is no terminal, a long run says every ten seconds how far it is.
#[test]
fn a_long_run_reports_without_a_terminal() {
    use std::io::{BufRead, BufReader, Write};
    let mut child = command(["encode", "--codec", "oct16", "-", "/dev/null"]);
    child.stdin(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let mut child = child.spawn().unwrap();
    let (mut input, started) = (child.stdin.take().unwrap(), Instant::now());
    let chunk = [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63].repeat(1 << 20);
    input.write_all(&chunk).unwrap();
    std::thread::sleep(Duration::from_secs(11));
    input.write_all(&chunk).unwrap();
    drop(input);
    let mut line = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
    assert!(line.starts_with("unitvec: ") && line.contains("done in 1"), "{line} {:?}", started.elapsed());
    assert!(child.wait().unwrap().success());
}
