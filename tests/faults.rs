//! Every fault ends in one clear line and status 1 or 2, without a panic and without partial output.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use unitvec_catalogue::vectors;
use unitvec_tests::program::{command, stderr};
use unitvec_tests::{copy_modules, replace_module, repository};

/// Runs to the end and checks that the failure is one line that contains `words`, with this status.
fn assert_fails(command: &mut Command, status: i32, words: &[&str]) -> Output {
    let output = command.output().unwrap();
    let text = stderr(&output);
    assert_eq!(output.status.code(), Some(status), "{text}");
    assert_eq!(text.lines().count(), 1, "{text}");
    assert!(text.starts_with("unitvec: ") && !text.contains("panicked"), "{text}");
    for word in words {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
    output
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn file(folder: &TempDir, name: &str, content: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    path
}

fn encode(codec: &str, input: &Path, output: &Path) -> Command {
    let mut command = command(["encode", "--codec", codec]);
    command.args([input, output]);
    command
}

/// Names in a folder, hidden ones too.
fn names(folder: &TempDir) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn no_vulkan_loader() {
    let mut conform = command(["conform"]);
    conform.env("UNITVEC_VULKAN_LOADER", "libno-such-loader.so");
    assert_fails(&mut conform, 1, &["libno-such-loader.so", "apt-get install libvulkan1"]);
}

#[test]
fn no_device() {
    for subcommand in ["conform", "devices"] {
        let mut without_drivers = command([subcommand]);
        without_drivers
            .env("VK_ICD_FILENAMES", "/nonexistent.json")
            .env("VK_DRIVER_FILES", "/nonexistent.json");
        assert_fails(&mut without_drivers, 1, &["no Vulkan device", "apt-get install mesa-vulkan-drivers"]);
    }
}

#[test]
fn unknown_device() {
    for name in ["voodoo2", "99"] {
        let arguments = ["conform", "--device", name];
        assert_fails(&mut command(arguments), 2, &[name, "there are: 0: llvmpipe"]);
    }
}

#[test]
fn unknown_codec() {
    let folder = folder();
    let input = file(&folder, "in.bin", &[0; 12]);
    assert_fails(
        &mut encode("oct17", &input, &folder.path().join("out")),
        2,
        &["`oct17`", "oct16p", "unitvec codecs"],
    );
    assert_fails(&mut command(["conform", "--codec", "oct17"]), 2, &["`oct17`"]);
    assert_eq!(names(&folder), ["in.bin"]);
}

/// Cut within an element, at the start or after millions: nothing is left, and a file of that name stays as it was.
#[test]
fn truncated_input() {
    let folder = folder();
    let output = file(&folder, "out", b"precious");
    for length in [1, 11, 13, 12 * ((1 << 20) + 3) + 4] {
        let input = file(&folder, "in.bin", &vec![0; length]);
        let left = (length % 12).to_string();
        assert_fails(
            &mut encode("oct32", &input, &output),
            1,
            &["in.bin", &format!("{left} bytes of another")],
        );
    }
    let input = file(&folder, "in.bin", &[0; 28 + 12]);
    let frame = ["1 whole frames of 28 bytes", "12 bytes of another"];
    assert_fails(&mut encode("frame64", &input, &output), 1, &frame);
    let codes = file(&folder, "codes", &[0; 10]);
    let mut decode = command(["decode", "--codec", "oct24"]);
    assert_fails(decode.args([&codes, &output]), 1, &["codes", "3 whole codes of 3 bytes", "1 bytes"]);
    assert_eq!(names(&folder), ["codes", "in.bin", "out"]);
    assert_eq!(std::fs::read(output).unwrap(), b"precious");
}

#[test]
fn missing_input() {
    let folder = folder();
    for name in ["absent.bin", "absent.obj", "."] {
        let input = folder.path().join(name);
        assert_fails(
            &mut encode("oct16", &input, &folder.path().join("out")),
            1,
            &[folder.path().to_str().unwrap()],
        );
    }
    assert!(names(&folder).is_empty());
}

#[test]
fn a_mesh_with_no_faces() {
    let folder = folder();
    let input = file(&folder, "points.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    assert_fails(&mut encode("oct16", &input, &folder.path().join("out")), 1, &["points.obj", "faces"]);
    assert_eq!(names(&folder), ["points.obj"]);
}

#[test]
fn a_mesh_with_a_nan_position() {
    let folder = folder();
    let input = file(&folder, "nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_fails(&mut encode("oct16", &input, &folder.path().join("out")), 1, &["nan.obj"]);
    assert_eq!(names(&folder), ["nan.obj"]);
}

#[test]
fn a_mesh_that_is_none() {
    let folder = folder();
    for name in ["noise.obj", "noise.ply", "noise.gltf", "noise.glb"] {
        let input = file(&folder, name, b"f 1 2 \xff\xfe\n{[");
        assert_fails(&mut encode("oct16", &input, &folder.path().join("out")), 1, &[name]);
        assert_fails(&mut command(["conform".as_ref(), input.as_os_str()]), 1, &[name]);
    }
}

/// A file that is neither a mesh nor named as raw floats is refused with the remedy.
#[test]
fn a_file_of_an_unknown_kind() {
    let folder = folder();
    for name in ["a.fbx", "a.vrm", "bin", "a.oct16"] {
        let input = file(&folder, name, &[0; 24]);
        let output = folder.path().join("out");
        assert_fails(&mut encode("oct16", &input, &output), 2, &[name, ".glb", ".f32", "add --raw"]);
        assert_fails(
            &mut command(["normals".as_ref(), input.as_os_str(), output.as_os_str()]),
            1,
            &[name, ".glb"],
        );
        std::fs::remove_file(input).unwrap();
    }
    assert!(names(&folder).is_empty());
}

/// Text is not taken for raw floats: a mesh from a pipe that no first bytes identify, or one named as raw floats.
#[test]
fn text_instead_of_floats() {
    let folder = folder();
    // The text is as long as three vectors.
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\n\n\n\n";
    let input = file(&folder, "mesh.bin", obj);
    let output = folder.path().join("out");
    assert_fails(&mut encode("oct16", &input, &output), 2, &["mesh.bin is text", ".obj", "add --raw"]);
    assert_fails(&mut command(["error".as_ref(), input.as_os_str()]), 2, &["mesh.bin is text"]);
    let mut piped = encode("oct16", Path::new("-"), &output);
    assert_fails(piped.stdin(std::fs::File::open(&input).unwrap()), 2, &["- is text"]);
    assert_eq!(names(&folder), ["mesh.bin"]);
    assert!(encode("oct16", &input, &output).arg("--raw").output().unwrap().status.success());
    assert!(encode("oct16", Path::new("-"), &output).output().unwrap().status.success());
}

/// All files are looked for before any is measured, and the standard input cannot be read twice.
#[test]
fn files_to_measure() {
    let folder = folder();
    let cut = file(&folder, "cut.bin", &[0; 13]);
    let absent = folder.path().join("absent.bin");
    // The first file would fail as soon as it is read to its end.
    assert_fails(command(["error"]).args([&cut, &absent]), 1, &["absent.bin"]);
    assert_fails(&mut command(["error", "-", "-"]), 2, &["name it once"]);
}

#[test]
fn columns_that_are_no_number() {
    for columns in ["0", "-1", "wide", "99999999999999999999"] {
        assert_fails(command(["codecs"]).env("UNITVEC_COLUMNS", columns), 2, &[columns, "UNITVEC_COLUMNS"]);
    }
}

/// A mesh by another name is no codes either.
#[test]
fn a_mesh_to_decode() {
    let folder = folder();
    for content in [&b"glTF\x02\0\0\0"[..], b"ply\nformat", b"{\"asset\":{}}"] {
        let input = file(&folder, "codes", content);
        let mut decode = command(["decode", "--codec", "oct16"]);
        let words = ["codes is a mesh", "unitvec encode", "--raw"];
        assert_fails(decode.args([&input, &folder.path().join("out")]), 2, &words);
    }
    assert_eq!(names(&folder), ["codes"]);
}

/// Compressed geometry gets the way to decompress it, and no message ends in two marks.
#[test]
fn gltf_extensions_that_are_not_read() {
    let folder = folder();
    for (extension, remedy) in [
        ("KHR_draco_mesh_compression", "`gltf-transform copy "),
        ("EXT_meshopt_compression", "`gltf-transform copy "),
        ("KHR_meshopt_compression", "export it without compression"),
        ("KHR_of_the_future", "export it again"),
    ] {
        let content = format!(r#"{{"asset":{{"version":"2.0"}},"extensionsRequired":["{extension}"]}}"#);
        let input = file(&folder, "a.gltf", content.as_bytes());
        let mut encode = encode("oct16", &input, &folder.path().join("out"));
        let output = assert_fails(&mut encode, 1, &["a.gltf", extension, remedy]);
        assert!(!stderr(&output).contains(";;"), "{}", stderr(&output));
    }
}

/// A mesh without tangents, or in a format that has none, does not give frames.
#[test]
fn a_mesh_without_tangents() {
    let folder = folder();
    let bare = r#"{"asset":{"version":"2.0"}}"#;
    let inputs = [file(&folder, "bare.gltf", bare.as_bytes()), repository().join("host/mesh/data/bunny.obj")];
    for input in inputs {
        let name = input.file_name().unwrap().to_str().unwrap();
        let mut encode = encode("frame32", &input, &folder.path().join("out"));
        assert_fails(&mut encode, 1, &[name, "a normal and a tangent", ".glb"]);
    }
    assert_eq!(names(&folder), ["bare.gltf"]);
}

/// Root may write to a read-only folder, so for root it is one that nobody can make files in.
#[test]
fn a_read_only_output_folder() {
    let folder = folder();
    let input = file(&folder, "in.bin", &[0; 12]);
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).unwrap();
    let mut permissions = locked.metadata().unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&locked, permissions).unwrap();
    let is_root = std::fs::write(locked.join("probe"), b"").is_ok();
    let output = if is_root { PathBuf::from("/proc/self/out") } else { locked.join("out") };
    assert_fails(&mut encode("oct16", &input, &output), 1, &["cannot write", output.to_str().unwrap()]);
    let mut conform = command(["conform", "--codec", "oct16", "--count", "10", "--json"]);
    let failed = conform.arg(&output).output().unwrap();
    assert_eq!(failed.status.code(), Some(1));
    assert!(stderr(&failed).contains("cannot write"));
}

#[test]
fn a_full_disk() {
    let folder = folder();
    let input = file(&folder, "in.bin", &[0; 12]);
    assert_fails(&mut encode("oct16", &input, Path::new("/dev/full")), 1, &["cannot write /dev/full"]);
}

/// Interrupted or terminated while it writes, the program removes its own output, and leaves the earlier file.
#[test]
fn an_interrupted_run() {
    for signal in ["-INT", "-TERM"] {
        let folder = folder();
        let output = file(&folder, "out", b"before");
        let mut waiting = encode("oct16", Path::new("-"), &output).stdin(Stdio::piped()).spawn().unwrap();
        // Open until it has ended: at the end of its input the program would succeed.
        let _stdin = waiting.stdin.take();
        let deadline = Instant::now() + Duration::from_secs(60);
        while names(&folder).len() < 2 {
            assert!(Instant::now() < deadline, "no temporary file within a minute");
            std::thread::sleep(Duration::from_millis(10));
        }
        // The shell's own, since a bare machine may not have the program.
        let kill = format!("kill {signal} {}", waiting.id());
        let kill = Command::new("sh").args(["-c", &kill]).status().unwrap();
        assert!(kill.success());
        assert_eq!(waiting.wait().unwrap().code(), Some(130));
        assert_eq!(names(&folder), ["out"]);
        assert_eq!(std::fs::read(&output).unwrap(), b"before");
    }
}

fn copy_of_the_modules() -> TempDir {
    let copy = folder();
    copy_modules(copy.path());
    copy
}

/// Encoding with modules from this folder fails with these words.
fn assert_modules_fail(modules: &TempDir, words: &[&str]) {
    assert_fails_with_modules(modules, &[], words);
}

fn assert_fails_with_modules(modules: &TempDir, options: &[&str], words: &[&str]) {
    let folder = folder();
    let input = file(&folder, "in.bin", &[0; 12]);
    assert_fails(&mut encode_with(modules, options, &input, &folder.path().join("out")), 1, words);
    assert_eq!(names(&folder), ["in.bin"]);
}

fn encode_with(modules: &TempDir, options: &[&str], input: &Path, output: &Path) -> Command {
    let mut command = encode("oct16", input, output);
    command.args(["--backend", "rust", "--spirv"]).arg(modules.path()).args(options);
    command
}

/// A module of the user's runs where it is trusted, whatever hash the manifest has for it. That its own manifest has
/// the hash is no reason to run it.
#[test]
fn a_module_of_the_users() {
    let modules = copy_of_the_modules();
    let mut bytes = std::fs::read(modules.path().join("kernels/oct16.spv")).unwrap();
    // The generator's number, which means nothing: another module that does the same.
    bytes[8] ^= 1;
    std::fs::write(modules.path().join("kernels/oct16.spv"), &bytes).unwrap();
    let folder = folder();
    let (input, output) = (file(&folder, "in.bin", &[0; 12]), folder.path().join("out"));
    for is_listed in [false, true] {
        if is_listed {
            replace_module(modules.path(), "kernels/oct16.spv", &bytes);
        }
        assert_modules_fail(&modules, &["kernels/oct16.spv", "not the program's", "--trust"]);
        let trusted = encode_with(&modules, &["--trust"], &input, &output).output().unwrap();
        assert!(trusted.status.success(), "{}", stderr(&trusted));
        assert_eq!(std::fs::read(&output).unwrap(), [0; 2]);
    }
    let mut nothing_to_trust = encode("oct16", &input, &output);
    let options = ["--backend", "rust", "--trust"];
    assert_fails(nothing_to_trust.args(options), 2, &["--spirv", "name their folder"]);
}

/// Names in a manifest do not lead out of its folder.
#[test]
fn modules_elsewhere() {
    let modules = copy_of_the_modules();
    let manifest = modules.path().join("manifest.json");
    let text = std::fs::read_to_string(&manifest).unwrap();
    for name in ["../oct16.spv", "/dev/zero", "kernels"] {
        std::fs::write(&manifest, text.replace("kernels/oct16.spv", name)).unwrap();
        assert_fails_with_modules(&modules, &["--trust"], &[name, "it is no file"]);
    }
}

#[test]
fn a_corrupted_module() {
    let modules = copy_of_the_modules();
    let path = modules.path().join("kernels/oct16.spv");
    let mut bytes = std::fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    assert_modules_fail(&modules, &["kernels/oct16.spv", "SHA-256 differs", "cargo xtask spirv", "--trust"]);
}

#[test]
fn a_missing_module() {
    let modules = copy_of_the_modules();
    std::fs::remove_file(modules.path().join("kernels/oct16.spv")).unwrap();
    assert_modules_fail(&modules, &["kernels/oct16.spv", "cargo xtask spirv"]);
    std::fs::remove_file(modules.path().join("manifest.json")).unwrap();
    assert_modules_fail(&modules, &["manifest.json", "cargo xtask spirv"]);
    std::fs::write(modules.path().join("manifest.json"), b"{").unwrap();
    assert_modules_fail(&modules, &["manifest.json", "cargo xtask spirv"]);
}

#[test]
fn a_wrong_command_line() {
    for arguments in [&["encode"][..], &["frobnicate"], &["conform", "--count", "-3"], &[]] {
        let output = command(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(!stderr(&output).contains("panicked"));
    }
}

#[test]
fn options_that_do_not_go_together() {
    let folder = folder();
    let input = file(&folder, "in.bin", &[0; 12]);
    for option in [&["--device", "0"][..], &["--validate"], &["--spirv", "."], &["--trust"]] {
        let mut on_cpu = encode("oct16", &input, &folder.path().join("out"));
        assert_fails(on_cpu.args(option), 2, &["--backend rust"]);
    }
    let bunny = repository().join("host/mesh/data/bunny.obj");
    let mut decode = command(["decode", "--codec", "oct16"]);
    assert_fails(decode.args([&bunny, &folder.path().join("out")]), 2, &["is a mesh", "unitvec encode"]);
    assert_fails(&mut command(["accuracy", "--json", "-", "--csv", "-"]), 2, &["--csv -"]);
    for count in ["0", "18446744073709551615"] {
        assert_eq!(command(["conform", "--count", count]).output().unwrap().status.code(), Some(2));
    }
    assert_eq!(names(&folder), ["in.bin"]);
}

/// A codec's name in the survey's spelling, or a width that does not exist, gets a suggestion.
#[test]
fn unknown_codecs_get_suggestions() {
    assert_fails(&mut command(["conform", "--codec", "oct16P"]), 2, &["did you mean oct16p?"]);
    let cubes = vectors().iter().map(|codec| codec.id).filter(|id| id.starts_with("cube"));
    let cubes = format!("did you mean {}?", cubes.collect::<Vec<_>>().join(", "));
    assert_fails(&mut command(["conform", "--codec", "cube17"]), 2, &[&cubes]);
    assert_fails(&mut command(["conform", "--codec", "frame16"]), 2, &["did you mean frame32, frame64?"]);
    assert_fails(&mut command(["conform", "--codec", "zzz"]), 2, &["`unitvec codecs` lists them all"]);
}

/// A module with another entry point or cut short does not reach the driver, though it is trusted. (That
/// a cut at any word is found is shown beside the check, in the host.)
#[test]
fn a_module_of_something_else() {
    for cut in [false, true] {
        let modules = copy_of_the_modules();
        let file = if cut { "kernels/oct16.spv" } else { "kernels/oct32.spv" };
        let mut bytes = std::fs::read(modules.path().join(file)).unwrap();
        if cut {
            bytes.truncate(bytes.len() / 8 * 4);
        }
        replace_module(modules.path(), "kernels/oct16.spv", &bytes);
        assert_fails_with_modules(&modules, &["--trust"], &["oct16_encode", "is not a module"]);
    }
}

/// The output never takes the place of the input, nor of a file with a mesh's name. Both stay as they were.
#[test]
fn meshes_are_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let bunny = std::fs::read(repository().join("host/mesh/data/bunny.obj")).unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [mesh, other, raw] = ["a.obj", "b.obj", "a.bin"].map(path);
    for file in [&mesh, &other] {
        std::fs::write(file, &bunny).unwrap();
    }
    std::fs::write(&raw, [0; 12]).unwrap();
    for arguments in [
        ["encode", "--codec=oct24", &mesh, &mesh],
        ["encode", "--codec=oct24", &mesh, &other],
        ["encode", "--codec=oct24", &raw, &raw],
        ["decode", "--codec=oct24", &raw, &other],
        ["normals", "--quiet", &mesh, &other],
    ] {
        let output = unitvec_tests::program::run(arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), said.lines().count()), (Some(2), 1), "{arguments:?}: {said}");
        assert!(said.contains("another name"), "{said}");
    }
    assert!([mesh, other].iter().all(|file| std::fs::read(file).unwrap() == bunny));
    assert_eq!(std::fs::read(raw).unwrap(), [0; 12]);
}

/// `unitvec shader` names unknown words, and features that a language does not have.
#[test]
fn wrong_languages_are_told() {
    // Clap prints these words.
    for (arguments, word) in [
        (&["shader"][..], "--language <LANGUAGE>"),
        (&["shader", "--language", "cg"], "possible values: glsl, hlsl, wgsl"),
    ] {
        let output = command(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(word), "{}", stderr(&output));
    }
    let exact = ["shader", "--language", "hlsl", "--exact"];
    assert_fails(&mut command(exact), 2, &["HLSL has no exact edition", "leave --exact out"]);
    assert_fails(&mut command(["shader", "--language", "hlsl", "--codec", "oct17"]), 2, &["oct17"]);
}
