//! Links, pipes, signals and odd names, as a program in scripts gets them. Each ends in the right file or in one line,
//! and leaves nothing behind.

#![cfg(target_os = "linux")]

use crate::faults::assert_fails;
use std::ffi::OsStr;
use std::fs::{self, DirEntry, File};
use std::io::{Read, Seek, SeekFrom, Write};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use unitvec_tests::program::{command, raw, stderr};
use unitvec_tests::repository;

/// Two vectors, and their codes in [`CODEC`].
const VECTORS: [f32; 6] = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
const CODES: [u8; 4] = [0; 4];
const CODEC: &str = "oct16";

fn floats() -> Vec<u8> {
    raw(&VECTORS)
}

/// A folder with an input, `in.f32`.
fn folder() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join("in.f32");
    fs::write(&input, floats()).unwrap();
    (folder, input)
}

fn encode(input: &Path, output: &Path) -> Command {
    let mut command = command(["encode", "--codec", CODEC]);
    command.args([input, output]);
    command
}

fn assert_encodes(command: &mut Command) -> Output {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    output
}

fn count(folder: &TempDir) -> usize {
    fs::read_dir(folder.path()).unwrap().count()
}

fn make_fifo(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// Waits for something, a minute at most.
fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let deadline = Instant::now() + Duration::from_secs(60);
    while !is_so() {
        assert!(Instant::now() < deadline, "{what}: not within a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn send(signal: &str, child: &Child) {
    // The shell's own, since a bare machine may not have the program.
    let kill = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status().unwrap();
    assert!(kill.success());
}

/// The most memory that a running program had, in bytes.
fn peak_memory(child: &Child) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() * 1024
}

/// A link stays a link, and its target is replaced, as with `cp`; a link of links too. A link to nothing, and one to itself,
/// are refused, as by `cp`: nobody named the file that would come to be.
#[test]
fn output_to_a_link() {
    let (folder, input) = folder();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("elsewhere")).unwrap();
    for (link, target) in
        [("link", "elsewhere/codes"), ("link of links", "link"), ("dangling", "absent"), ("loop", "loop")]
    {
        symlink(target, path(link)).unwrap();
    }
    for link in ["link", "link of links"] {
        fs::write(path("elsewhere/codes"), b"before").unwrap();
        assert_encodes(&mut encode(&input, &path(link)));
        assert!(path(link).is_symlink());
        assert_eq!(fs::read(path("elsewhere/codes")).unwrap(), CODES);
    }
    for link in ["dangling", "loop"] {
        assert_fails(&mut encode(&input, &path(link)), 1, &[link, "link to nothing"]);
        assert!(path(link).is_symlink());
    }
    assert_eq!((count(&folder), fs::read_dir(path("elsewhere")).unwrap().count()), (6, 1));
}

/// The output is the input by its own name, by another way there, by a link and by a hard link; all stay as they were.
#[test]
fn output_equal_to_input() {
    let (folder, input) = folder();
    let path = |name: &str| folder.path().join(name);
    symlink("in.f32", path("link")).unwrap();
    fs::hard_link(&input, path("hard")).unwrap();
    for out in ["in.f32", "../here/in.f32", "link", "hard"] {
        let here = folder.path().file_name().unwrap().to_str().unwrap();
        let out = path(&out.replace("here", here));
        assert_fails(&mut encode(&input, &out), 2, &["is the input"]);
        assert_fails(&mut encode(&out, &input), 2, &["is the input"]);
    }
    assert_eq!((fs::read(&input).unwrap(), count(&folder)), (floats(), 3));
}

/// Through named pipes on both sides, in any kind of portions; a mesh from a pipe is known by its first bytes.
#[test]
fn fifos() {
    let ply =
        b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float nx\nproperty float ny\nproperty float nz\n\
        end_header\n0 0 1\n0 0 1\n";
    for content in [floats(), ply.to_vec()] {
        let (folder, _) = folder();
        let [from, to] = ["from", "to"].map(|name| folder.path().join(name));
        make_fifo(&from);
        make_fifo(&to);
        let mut running = encode(&from, &to).stderr(Stdio::piped()).spawn().unwrap();
        let reader = std::thread::spawn(move || fs::read(to).unwrap());
        let mut pipe = File::options().write(true).open(&from).unwrap();
        content.chunks(5).for_each(|part| pipe.write_all(part).unwrap());
        drop(pipe);
        assert_eq!(reader.join().unwrap(), CODES);
        assert!(running.wait().unwrap().success());
        assert_eq!(count(&folder), 3);
    }
}

/// A glTF file that names a pipe or a device as its buffer neither waits for it nor reads it without end.
#[test]
fn buffers_that_are_no_files() {
    let (folder, _) = folder();
    let gltf = folder.path().join("a.gltf");
    make_fifo(&folder.path().join("pipe"));
    symlink("/dev/zero", folder.path().join("zeros")).unwrap();
    for name in ["pipe", "zeros", "."] {
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":99999999999,"uri":"{name}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":3,
            "type":"VEC3","min":[0,0,0],"max":[0,0,0]}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}]}}"#
        );
        fs::write(&gltf, text).unwrap();
        assert_fails(&mut encode(&gltf, &folder.path().join("out")), 1, &["a.gltf", "it is no file"]);
    }
    assert_eq!(count(&folder), 4);
}

/// A file that is cut while the program reads it gives an error, not fewer codes. The program waits for room in a pipe
/// until the file is cut.
#[test]
fn a_file_that_shrinks() {
    let (folder, input) = folder();
    let file = File::options().write(true).open(&input).unwrap();
    file.set_len(12 << 23).unwrap();
    let mut running =
        encode(&input, Path::new("-")).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut codes = running.stdout.take().unwrap();
    codes.read_exact(&mut [0; 2]).unwrap();
    file.set_len(12 << 21).unwrap();
    std::thread::spawn(move || codes.read_to_end(&mut Vec::new()));
    let output = running.wait_with_output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("in.f32") && said.contains("shorter while it was read"), "{said}");
    assert_eq!(count(&folder), 1);
}

/// Names in no encoding work, on both sides and in errors, and control characters do not reach the terminal.
#[test]
fn names_that_are_not_utf_8() {
    let (folder, input) = folder();
    let path = |name: &[u8]| folder.path().join(OsStr::from_bytes(name));
    let (odd, out) = (path(b"in \xff\n\x1b[31m.f32"), path(b"out \xff"));
    fs::rename(&input, &odd).unwrap();
    assert_encodes(&mut encode(&odd, &out));
    assert_eq!(fs::read(&out).unwrap(), CODES);
    let mut error = command(["error", "--json", "-"]);
    assert!(error.arg(&odd).output().unwrap().status.success());
    File::options().append(true).open(&odd).unwrap().write_all(b"x").unwrap();
    assert_fails(&mut encode(&odd, &out), 1, &["in \u{fffd}\\n\\u{1b}[31m.f32"]);
    assert_eq!((fs::read(&out).unwrap(), count(&folder)), (CODES.to_vec(), 2));
    let mut modules = encode(&odd, &out);
    modules.args(["--backend", "rust"]).env("UNITVEC_SPIRV", path(b"modules \xff"));
    assert_fails(&mut modules, 1, &["modules \u{fffd}", "manifest.json"]);
}

/// 100 GB, of which none is on the disk.
const HUGE: u64 = 100_000_000_000 / 12 * 12;

fn sparse(folder: &TempDir, name: &str, head: &[u8], length: u64) -> PathBuf {
    let path = folder.path().join(name);
    let mut file = File::create(&path).unwrap();
    file.write_all(head).unwrap();
    file.seek(SeekFrom::Start(0)).unwrap();
    file.set_len(length).unwrap();
    path
}

/// Faults in 100 GB are reported at once: a length that no elements have, and a file that is no mesh.
#[test]
fn huge_files_that_fail() {
    let (folder, _) = folder();
    let out = folder.path().join("out");
    let cut = sparse(&folder, "cut.f32", b"", HUGE + 5);
    let started = Instant::now();
    assert_fails(&mut encode(&cut, &out), 1, &["cut.f32", "5 bytes of another"]);
    let mut decode = command(["decode", "--codec", "oct24"]);
    assert_fails(decode.args([&cut, &out]), 1, &["cut.f32", "of another"]);
    for (name, head) in [
        ("a.obj", "v 0 0 0\n"),
        ("a.ply", "ply\nformat ascii 1.0\n"),
        ("a.gltf", "{\"asset\""),
        ("a.glb", "glTF"),
    ] {
        let mesh = sparse(&folder, name, head.as_bytes(), HUGE);
        assert_fails(&mut encode(&mesh, &out), 1, &[name]);
    }
    // Reading them would take minutes.
    assert!(started.elapsed() < Duration::from_secs(30), "{:?}", started.elapsed());
    assert_eq!(count(&folder), 6);
}

/// 100 GB stream through in the memory of a few chunks; interrupted, the program leaves nothing.
#[test]
fn huge_files_stream() {
    let (folder, _) = folder();
    let input = sparse(&folder, "huge.f32", b"", HUGE);
    let out = folder.path().join("out");
    let mut running = encode(&input, &out).spawn().unwrap();
    let process = running.id();
    let written = || {
        let counts = fs::read_to_string(format!("/proc/{process}/io")).unwrap();
        let count = counts.lines().find_map(|line| line.strip_prefix("wchar: "));
        count.unwrap().parse::<u64>().unwrap()
    };
    // Eight chunks of 12 MiB.
    wait_until("eight chunks", || written() >= 16 << 20);
    let peak = peak_memory(&running);
    assert!(peak < 100 << 20, "{peak} bytes of memory");
    send("TERM", &running);
    assert_eq!(running.wait().unwrap().code(), Some(130));
    assert_eq!(count(&folder), 2);
}

/// The readers' promise, for the program: a mesh of 20 MB takes four times its size more than a small one.
#[test]
fn memory_of_meshes() {
    const VERTICES: usize = 1_500_000;
    const FEW: usize = 50_000;
    let (folder, _) = folder();
    let head = |count: usize| {
        format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty float x\nproperty float y\n\
            property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let ply = |count: usize| [head(count).as_bytes(), &vec![0; 12 * count], &[3], &[0; 12]].concat();
    let obj = |count: usize| format!("{}f 1 1 1\n", "v 1.25 2 0.5\n".repeat(count)).into_bytes();
    let peak = |name: &str, content: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, content).unwrap();
        let mut running =
            encode(&path, Path::new("-")).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        // The mesh is read before the first code is written.
        running.stdout.as_mut().unwrap().read_exact(&mut [0; 2]).unwrap();
        let peak = peak_memory(&running);
        running.kill().unwrap();
        running.wait().unwrap();
        peak
    };
    // The codes of the small ones do not fit a pipe either, so that the program is still there to be asked.
    for (name, small, large) in [("a.ply", ply(FEW), ply(VERTICES)), ("a.obj", obj(FEW), obj(VERTICES))] {
        let (chunks, whole) = (peak(name, &small), peak(name, &large));
        let most = chunks + 4 * large.len() as u64;
        println!("{name}: {} bytes, {chunks} bytes of memory for a small one, {whole} for all", large.len());
        assert!(whole <= most, "{name}: {whole} bytes of memory, over {most}");
    }
}

/// Each signal that asks a program to end leaves the file that was there, and nothing else.
#[test]
fn signals() {
    for signal in ["TERM", "INT", "HUP"] {
        let (folder, _) = folder();
        let out = folder.path().join("out");
        fs::write(&out, b"before").unwrap();
        let mut running = encode(Path::new("-"), &out).stdin(Stdio::piped()).spawn().unwrap();
        // Written by half: the end never comes.
        let mut stdin = running.stdin.take().unwrap();
        stdin.write_all(&floats()).unwrap();
        let open = PathBuf::from(format!("/proc/{}/fd", running.id()));
        // The output has no name yet: the kernel shows it by its folder.
        let is_output =
            |entry: DirEntry| entry.path().read_link().is_ok_and(|to| to.starts_with(folder.path()));
        wait_until("an output", || fs::read_dir(&open).unwrap().flatten().any(is_output));
        send(signal, &running);
        let status = running.wait().unwrap();
        assert_eq!((status.code(), status.signal()), (Some(130), None), "{signal}");
        assert_eq!((fs::read(out).unwrap(), count(&folder)), (b"before".to_vec(), 2), "{signal}");
    }
}

/// A reader that has seen enough, of the standard output or of a named pipe, is no fault.
#[test]
fn readers_that_leave() {
    let (folder, input) = folder();
    File::options().write(true).open(&input).unwrap().set_len(12 << 20).unwrap();
    let fifo = folder.path().join("fifo");
    make_fifo(&fifo);
    let bunny = repository().join("host/mesh/data/bunny.obj");
    let mut normals = command(["normals"]);
    normals.args([&bunny, Path::new("-")]);
    let mut decode = command(["decode", "--codec", CODEC]);
    decode.args([&input, Path::new("/dev/stdout")]);
    for mut program in [encode(&input, Path::new("-")), decode, normals, command(["codecs", "--json", "-"])] {
        let mut running = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(running.stdout.take());
        assert_ends_quietly(running);
    }
    let running = encode(&input, &fifo).stderr(Stdio::piped()).spawn().unwrap();
    File::open(&fifo).unwrap().read_exact(&mut [0]).unwrap();
    assert_ends_quietly(running);
}

fn assert_ends_quietly(running: Child) {
    let output = running.wait_with_output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{:?}: {}", output.status, stderr(&output));
}

/// A device without room, as a file and as the standard output.
#[test]
fn a_full_device() {
    let (folder, input) = folder();
    assert_fails(&mut encode(&input, Path::new("/dev/full")), 1, &["/dev/full"]);
    for mut program in [encode(&input, Path::new("-")), command(["codecs"])] {
        program.stdout(File::options().write(true).open("/dev/full").unwrap());
        assert_fails(&mut program, 1, &["cannot write the standard output"]);
    }
    assert_eq!(count(&folder), 1);
}

/// A folder is no input, no output, and none of the other files that are named; endless input is no report of costs, and no
/// module.
#[test]
fn folders_and_devices_for_files() {
    let (folder, input) = folder();
    let here = folder.path();
    symlink("/dev/zero", here.join("manifest.json")).unwrap();
    assert_fails(
        &mut encode(&input, &here.join("absent/out")),
        1,
        &["there is no folder", "absent; make it"],
    );
    for (costs, words) in [(here, "cannot read"), (Path::new("/dev/zero"), "/dev/zero")] {
        assert_fails(command(["choose", "--max-error", "1", "--costs"]).arg(costs), 1, &[words]);
    }
    assert_fails(command(["conform"]).arg(here), 1, &["cannot read"]);
    for (modules, words) in
        [(input.as_path(), ["in.f32", "manifest.json"]), (here, ["manifest.json", "it is no file"])]
    {
        let mut encode = encode(&input, &here.join("out"));
        assert_fails(encode.args(["--backend", "rust", "--spirv"]).arg(modules), 1, &words);
    }
    assert_eq!(count(&folder), 2);
}
