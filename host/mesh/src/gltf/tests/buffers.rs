//! Where the bytes of buffers lie.

use super::*;

/// The standard input has no folder in which a buffer could lie, so none is looked for in the current one.
#[test]
fn external_buffers_of_the_standard_input() {
    let document = json(WITH_NORMALS, r#","uri":"Cargo.toml""#);
    let error = parse(Path::new("-"), document.as_bytes(), Reach::Folder).unwrap_err().to_string();
    assert!(error.contains("Cargo.toml") && error.contains("name the .gltf file"), "{error}");
}

/// The buffer is found as a data URI, padded or not, and in a file whose name is percent-encoded.
#[test]
fn external_buffers() {
    let folder = tempfile::tempdir().unwrap();
    let encoded = base64::engine::general_purpose::STANDARD.encode([cube_buffer(), vec![0]].concat());
    std::fs::write(folder.path().join("the cube.bin"), cube_buffer()).unwrap();
    let data = "data:application/octet-stream;base64,";
    for uri in [
        format!("{data}{encoded}"),
        format!("{data}{}", encoded.trim_end_matches('=')),
        "the%20cube.bin".into(),
    ] {
        let path = folder.path().join("a.gltf");
        std::fs::write(&path, json(WITH_NORMALS, &format!(r#","uri":"{uri}""#))).unwrap();
        assert_eq!(crate::read(&path).unwrap().normals, cube_normals());
    }
}

/// Of a file that several buffers name, as far as the longest goes, and of a document whose other buffers are absent: only
/// buffers that are used are read.
#[test]
fn buffers_are_read_once_and_if_used() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.bin"), cube_buffer()).unwrap();
    let document = json(WITHOUT_NORMALS, r#","uri":"a.bin""#)
        .replace(
            r#""buffers":["#,
            r#""buffers":[{"byteLength":9,"uri":"absent.bin"},{"byteLength":96,"uri":"./a.bin"},"#,
        )
        .replace(r#""buffer":0"#, r#""buffer":2"#)
        .replacen(r#""buffer":2"#, r#""buffer":1"#, 1);
    let path = folder.path().join("a.gltf");
    let file =
        load(&path, document.as_bytes(), Reach::Folder, &[Semantic::Positions, Semantic::Normals]).unwrap();
    assert_eq!(file.size, document.len() + cube_buffer().len());
    assert_eq!(file.buffers.iter().map(|buffer| buffer.len()).collect::<Vec<_>>(), [0, 392, 392]);
    assert_close(&parse(&path, document.as_bytes(), Reach::Folder).unwrap().normals, &cube_normals());
}

/// A buffer outside the file's folder is read where that is allowed, and not else, however its URI is written.
#[test]
fn buffers_outside_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    std::fs::write(folder.path().join("a.bin"), cube_buffer()).unwrap();
    for uri in ["../a.bin", "%2e%2e/a.bin", "./../a.bin", "../inner/../a.bin"] {
        let (path, document) = (inner.join("a.gltf"), json(WITH_NORMALS, &format!(r#","uri":"{uri}""#)));
        let read = |reach| parse(&path, document.as_bytes(), reach);
        let error = read(Reach::Folder).unwrap_err().to_string();
        assert!(error.contains("leaves the folder"), "{error}");
        assert_eq!(read(Reach::Anywhere).unwrap().normals, cube_normals());
    }
}

/// The chunk of a GLB is its first buffer, and no other.
#[test]
fn the_chunk_is_the_first_buffer() {
    let document = json(WITH_NORMALS, "")
        .replace(r#""buffers":["#, r#""buffers":[{"byteLength":392},"#)
        .replacen(r#""buffer":0,"byteOffset":96"#, r#""buffer":1,"byteOffset":96"#, 1);
    let result = read(&glb(&document, Some(&cube_buffer())));
    assert!(matches!(result, Err(MeshError::MissingBuffer { buffer: 1, .. })), "{result:?}");
    assert!(is_parse(&read(&glb(&json(WITH_NORMALS, "").replace("2.0", "3.0"), Some(&cube_buffer())))));
}

/// Each way in which a buffer can be missing names the buffer.
#[test]
fn missing_buffers() {
    let uris = [
        "absent.bin",
        "/etc/hostname",
        "http://example.org/a.bin",
        "data:,abc",
        "data:;base64,*",
        "data:;base64,AA",
    ];
    for uri in uris {
        let result = read(json(WITH_NORMALS, &format!(r#","uri":"{uri}""#)).as_bytes());
        assert!(matches!(result, Err(MeshError::MissingBuffer { buffer: 0, .. })), "{uri}: {result:?}");
    }
    for blob in [None, Some(&cube_buffer()[..100])] {
        let result = read(&glb(&json(WITH_NORMALS, ""), blob));
        assert!(matches!(result, Err(MeshError::MissingBuffer { buffer: 0, .. })));
    }
}
