//! Every fault ends in one clear line and status 1 or 2, without a panic and without partial output.

use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use unitvec_catalogue::vectors;
use unitvec_mesh::BUNNY;
use unitvec_tests::program::{command, stderr};
use unitvec_tests::{copy_modules, replace_module};

/// Runs to the end and checks that the failure is one line that contains `words`, with this status. Returns the line.
pub fn assert_fails(command: &mut Command, status: i32, words: &[&str]) -> String {
    let output = command.output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(status), "{text}");
    assert_eq!(text.lines().count(), 1, "{text}");
    assert!(text.starts_with("unitvec: ") && !text.contains("panicked"), "{text}");
    for word in words {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
    text
}

/// A folder's files, hidden ones too, with their contents.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let named = |file: std::fs::DirEntry| {
        (file.file_name().into_string().unwrap(), std::fs::read(file.path()).unwrap())
    };
    let mut all: Vec<_> = files.map(named).collect();
    all.sort();
    all
}

/// Runs a command line in a folder of these files, sorted by name; it fails, and leaves all of them as they were and nothing
/// else. Settings of the environment may stand before the command, as for a shell.
pub fn fails(files: &[(&str, &[u8])], line: &str, status: i32, words: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    let is_setting = |word: &&&str| word.contains('=') && !word.starts_with('-');
    let all: Vec<&str> = line.split(' ').collect();
    let settings = all.iter().take_while(|word| is_setting(word)).count();
    let mut command = command(&all[settings..]);
    command.envs(all[..settings].iter().filter_map(|word| word.split_once('='))).current_dir(folder.path());
    let text = assert_fails(&mut command, status, words);
    let before: Vec<_> = files.iter().map(|(name, content)| ((*name).to_owned(), content.to_vec())).collect();
    assert_eq!(contents(folder.path()), before, "{line}");
    text
}

/// A vector of zeros.
const ZERO: &[(&str, &[u8])] = &[("in.bin", &[0; 12])];

#[test]
fn no_vulkan() {
    let loader = ["libno-such-loader.so", "apt-get install libvulkan1"];
    fails(&[], "UNITVEC_VULKAN_LOADER=libno-such-loader.so conform", 1, &loader);
    for command in ["conform", "devices"] {
        let line = format!("VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json {command}");
        fails(&[], &line, 1, &["no Vulkan device", "apt-get install mesa-vulkan-drivers"]);
    }
    for name in ["voodoo2", "99"] {
        fails(&[], &format!("conform --device {name}"), 2, &[name, "there are: 0: llvmpipe"]);
    }
}

/// A width that does not exist gets a suggestion.
#[test]
fn unknown_codecs() {
    fails(ZERO, "encode --codec oct17 in.bin out", 2, &["`oct17`", "oct16p", "unitvec codecs"]);
    let cubes = vectors().iter().map(|codec| codec.id).filter(|id| id.starts_with("cube"));
    let cubes = format!("did you mean {}?", cubes.collect::<Vec<_>>().join(", "));
    for (id, words) in [
        ("oct17", "`oct17`"),
        ("cube17", &cubes),
        ("frame16", "did you mean frame32, frame64?"),
        ("oct-16_p", "did you mean oct16p?"),
        ("Draco10", "did you mean draco:10?"),
        ("zzz", "`unitvec codecs` lists them all"),
    ] {
        fails(&[], &format!("conform --codec {id}"), 2, &[words]);
    }
}

/// Cut within an element, at the start or after millions: nothing is left, and a file of that name stays as it was.
#[test]
fn truncated_input() {
    let cut = |content: &[u8], line: &str, words: &[&str]| {
        fails(&[("in.bin", content), ("out", b"precious")], line, 1, words)
    };
    for length in [1, 11, 13, 12 * ((1 << 20) + 3) + 4] {
        let left = format!("{} bytes of another", length % 12);
        cut(&vec![0; length], "encode --codec oct32 in.bin out", &["in.bin", &left]);
    }
    let frame = ["1 whole frames of 28 bytes", "12 bytes of another"];
    cut(&[0; 28 + 12], "encode --codec frame64 in.bin out", &frame);
    let codes = ["in.bin", "3 whole codes of 3 bytes", "1 bytes"];
    cut(&[0; 10], "decode --codec oct24 in.bin out", &codes);
}

/// Meshes and other inputs that are missing, damaged or of another kind: their names, what they are, and the remedy.
#[test]
fn inputs_that_cannot_be_encoded() {
    let noise = b"f 1 2 \xff\xfe\n{[";
    let bare = br#"{"asset":{"version":"2.0"}}"#;
    for (name, content, codec, status, words) in [
        ("points.obj", &b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"[..], "oct16", 1, &["points.obj", "faces"][..]),
        ("far.obj", b"v 0 0 0\nf 1 1 3\n", "oct16", 1, &["far.obj uses vertex 2"]),
        ("nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "oct16", 1, &["nan.obj"]),
        ("noise.obj", noise, "oct16", 1, &["noise.obj"]),
        ("noise.ply", noise, "oct16", 1, &["noise.ply"]),
        ("noise.gltf", noise, "oct16", 1, &["noise.gltf"]),
        ("noise.glb", noise, "oct16", 1, &["noise.glb"]),
        ("bare.gltf", bare, "frame32", 1, &["bare.gltf", "a normal and a tangent", ".glb"]),
        ("bunny.obj", BUNNY, "frame32", 1, &["bunny.obj", "a normal and a tangent", ".glb"]),
        ("a.fbx", &[0; 24], "oct16", 2, &["a.fbx", ".glb", ".f32", "add --raw"]),
        ("a.vrm", &[0; 24], "oct16", 2, &["a.vrm", ".glb", ".f32", "add --raw"]),
        ("bin", &[0; 24], "oct16", 2, &["bin", ".glb", ".f32", "add --raw"]),
        ("a.oct16", &[0; 24], "oct16", 2, &["a.oct16", ".glb", ".f32", "add --raw"]),
    ] {
        let files = [(name, content)];
        fails(&files, &format!("encode --codec {codec} {name} out"), status, words);
        match name.starts_with("noise") {
            true => fails(&files, &format!("conform {name}"), 1, words),
            false if status == 2 => fails(&files, &format!("normals {name} out"), 1, &[name, ".glb"]),
            false => String::new(),
        };
    }
    for name in ["absent.bin", "absent.obj"] {
        fails(&[], &format!("encode --codec oct16 {name} out"), 1, &[name]);
    }
}

/// Text is not taken for raw floats: a mesh from a pipe that no first bytes identify, or one named as raw floats.
#[test]
fn text_instead_of_floats() {
    // The text is as long as three vectors.
    let files: &[(&str, &[u8])] = &[("mesh.bin", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\n\n\n\n")];
    let words = ["mesh.bin is text", ".obj", "add --raw"];
    fails(files, "encode --codec oct16 mesh.bin out", 2, &words);
    fails(files, "error mesh.bin", 2, &["mesh.bin is text"]);
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("mesh.bin");
    std::fs::write(&mesh, files[0].1).unwrap();
    let encode = |arguments: &[&str]| {
        let mut command = command([&["encode", "--codec", "oct16"], arguments].concat());
        command.current_dir(folder.path());
        command
    };
    let mut piped = encode(&["-", "out"]);
    assert_fails(piped.stdin(std::fs::File::open(&mesh).unwrap()), 2, &["- is text"]);
    assert!(encode(&["--raw", "mesh.bin", "out"]).status().unwrap().success());
    assert!(encode(&["-", "out"]).status().unwrap().success());
}

/// Compressed geometry gets the way to decompress it, and no message ends in two marks.
#[test]
fn gltf_extensions_that_are_not_read() {
    for (extension, remedy) in [
        ("KHR_draco_mesh_compression", "`gltf-transform copy "),
        ("EXT_meshopt_compression", "`gltf-transform copy "),
        ("KHR_meshopt_compression", "export it without compression"),
        ("KHR_gaussian_splatting_compression_spz_2", "compressed by SPZ"),
        ("KHR_of_the_future", "export it again"),
    ] {
        let content = format!(r#"{{"asset":{{"version":"2.0"}},"extensionsRequired":["{extension}"]}}"#);
        let files = [("a.gltf", content.as_bytes())];
        let text = fails(&files, "encode --codec oct16 a.gltf out", 1, &["a.gltf", extension, remedy]);
        assert!(!text.contains(";;"), "{text}");
    }
}

/// All files are looked for before any is measured, and the standard input cannot be read twice.
#[test]
fn files_to_measure() {
    // The first file would fail as soon as it is read to its end.
    fails(&[("cut.bin", &[0; 13])], "error cut.bin absent.bin", 1, &["absent.bin"]);
    fails(&[], "error - -", 2, &["name it once"]);
}

#[test]
fn columns_that_are_no_number() {
    for columns in ["0", "-1", "wide", "99999999999999999999"] {
        fails(&[], &format!("UNITVEC_COLUMNS={columns} codecs"), 2, &[columns, "UNITVEC_COLUMNS"]);
    }
}

/// A mesh, by another name too, is no codes.
#[test]
fn a_mesh_to_decode() {
    for content in [&b"glTF\x02\0\0\0"[..], b"ply\nformat", b"{\"asset\":{}}"] {
        let words = ["codes is a mesh", "unitvec encode", "--raw"];
        fails(&[("codes", content)], "decode --codec oct16 codes out", 2, &words);
    }
    let words = ["is a mesh", "unitvec encode"];
    fails(&[("bunny.obj", BUNNY)], "decode --codec oct16 bunny.obj out", 2, &words);
}

/// The output never takes the place of the input, nor of a file with a mesh's name.
#[test]
fn meshes_are_not_overwritten() {
    let files = [("a.bin", &[0; 12][..]), ("a.obj", BUNNY), ("b.obj", BUNNY)];
    for line in [
        "encode --codec=oct24 a.obj a.obj",
        "encode --codec=oct24 a.obj b.obj",
        "encode --codec=oct24 a.bin a.bin",
        "decode --codec=oct24 a.bin b.obj",
        "normals --quiet a.obj b.obj",
    ] {
        fails(&files, line, 2, &["another name"]);
    }
}

/// Root may write to a read-only folder, so for root it is one that nobody can make files in.
#[test]
fn a_read_only_output_folder() {
    let folder = tempfile::tempdir().unwrap();
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).unwrap();
    let mut permissions = locked.metadata().unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&locked, permissions).unwrap();
    let is_root = std::fs::write(locked.join("probe"), b"").is_ok();
    let output = if is_root { PathBuf::from("/proc/self/out") } else { locked.join("out") };
    let output = output.to_str().unwrap();
    fails(ZERO, &format!("encode --codec oct16 in.bin {output}"), 1, &["cannot write", output]);
    let conform =
        command(["conform", "--codec", "oct16", "--count", "10", "--json", output]).output().unwrap();
    assert_eq!(conform.status.code(), Some(1));
    assert!(stderr(&conform).contains("cannot write"));
}

/// A copy of the modules, in which that of `oct16` is changed.
fn modules(change: impl FnOnce(&mut Vec<u8>)) -> TempDir {
    let copy = tempfile::tempdir().unwrap();
    copy_modules(copy.path());
    let module = copy.path().join("kernels/oct16.spv");
    let mut bytes = std::fs::read(&module).unwrap();
    change(&mut bytes);
    std::fs::write(module, bytes).unwrap();
    copy
}

/// Encoding with modules from this folder fails with these words.
fn modules_fail(modules: &TempDir, options: &str, words: &[&str]) {
    let folder = modules.path().display();
    let line = format!("encode --codec oct16 --backend rust --spirv {folder}{options} in.bin out");
    fails(ZERO, &line, 1, words);
}

/// A module of the user's runs where it is trusted, whatever hash the manifest has for it. That its own manifest has
/// the hash is no reason to run it.
#[test]
fn a_module_of_the_users() {
    // The generator's number, which means nothing: another module that does the same.
    let modules = modules(|bytes| bytes[8] ^= 1);
    let bytes = std::fs::read(modules.path().join("kernels/oct16.spv")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.bin"), [0; 12]).unwrap();
    for is_listed in [false, true] {
        if is_listed {
            replace_module(modules.path(), "kernels/oct16.spv", &bytes);
        }
        modules_fail(&modules, "", &["kernels/oct16.spv", "not the program's", "--trust"]);
        let mut trusted = command(["encode", "--codec=oct16", "--backend=rust", "--trust", "in.bin", "out"]);
        let trusted = trusted.arg("--spirv").arg(modules.path()).current_dir(folder.path()).output().unwrap();
        assert!(trusted.status.success(), "{}", stderr(&trusted));
        assert_eq!(std::fs::read(folder.path().join("out")).unwrap(), [0; 2]);
    }
    let nothing_to_trust = "encode --codec oct16 --backend rust --trust in.bin out";
    fails(ZERO, nothing_to_trust, 2, &["--spirv", "name their folder"]);
}

/// Names in a manifest do not lead out of its folder.
#[test]
fn modules_elsewhere() {
    let modules = modules(|_| ());
    let manifest = modules.path().join("manifest.json");
    let text = std::fs::read_to_string(&manifest).unwrap();
    for name in ["../oct16.spv", "/dev/zero", "kernels"] {
        std::fs::write(&manifest, text.replace("kernels/oct16.spv", name)).unwrap();
        modules_fail(&modules, " --trust", &[name, "it is no file"]);
    }
}

#[test]
fn a_corrupted_module() {
    let modules = modules(|bytes| {
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
    });
    modules_fail(&modules, "", &["kernels/oct16.spv", "SHA-256 differs", "cargo xtask spirv", "--trust"]);
}

#[test]
fn a_missing_module() {
    let modules = modules(|_| ());
    std::fs::remove_file(modules.path().join("kernels/oct16.spv")).unwrap();
    modules_fail(&modules, "", &["kernels/oct16.spv", "cargo xtask spirv"]);
    std::fs::remove_file(modules.path().join("manifest.json")).unwrap();
    modules_fail(&modules, "", &["manifest.json", "cargo xtask spirv"]);
    std::fs::write(modules.path().join("manifest.json"), b"{").unwrap();
    modules_fail(&modules, "", &["manifest.json", "cargo xtask spirv"]);
}

/// A module with another entry point or cut short does not reach the driver, though it is trusted. (That
/// a cut at any word is found is shown beside the check, in the host.)
#[test]
fn a_module_of_something_else() {
    for cut in [false, true] {
        let modules = modules(|bytes| bytes.truncate(bytes.len() / 8 * 4));
        let file = if cut { "kernels/oct16.spv" } else { "kernels/oct32.spv" };
        let bytes = std::fs::read(modules.path().join(file)).unwrap();
        replace_module(modules.path(), "kernels/oct16.spv", &bytes);
        modules_fail(&modules, " --trust", &["oct16_encode", "is not a module"]);
    }
}

/// What clap finds takes several lines.
#[test]
fn a_wrong_command_line() {
    for (line, words) in [
        ("", "Usage: unitvec"),
        ("encode", "--codec <ID>"),
        ("frobnicate", "frobnicate"),
        ("conform --count -3", "-3"),
        ("conform --count 0", "--count"),
        ("conform --count 18446744073709551615", "--count"),
        ("error --json a.obj b.obj", "the name of an input"),
        ("codecs --json", "--json <FILE>"),
        ("shader", "--language <LANGUAGE>"),
        ("shader --language cg", "possible values: glsl, hlsl, wgsl"),
        ("shader --language hlsl --function oct17_encode", "oct16_encode, oct18_encode; `unitvec"),
    ] {
        let output = command(line.split_whitespace()).output().unwrap();
        let text = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        assert!(text.contains(words) && !text.contains("panicked"), "{line}: {text}");
    }
}

#[test]
fn options_that_do_not_go_together() {
    for options in ["--device 0", "--validate", "--spirv .", "--trust"] {
        fails(ZERO, &format!("encode --codec oct16 {options} in.bin out"), 2, &["--backend rust"]);
    }
    for (line, words) in [
        ("accuracy --json - --csv -", &["--csv -"][..]),
        ("schema devices", &["`devices` writes no JSON", "conform pipeline"]),
        ("shader --language hlsl --exact", &["HLSL has no exact edition", "leave --exact out"]),
        ("shader --language hlsl --codec oct17", &["oct17"]),
    ] {
        fails(&[], line, 2, words);
    }
}
