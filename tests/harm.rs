//! Names, streams and limits that mean harm: nothing obeys a file's text, no input is replaced, and nothing is left behind.
//! (`fuzz` has the files whose contents do.)

#![cfg(unix)]

use crate::faults::assert_fails;
use std::ffi::OsStr;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::process::{Command, Stdio};
use unitvec_mesh::BUNNY;
use unitvec_tests::names;
use unitvec_tests::program::{self, command, raw, stderr, stdout};

/// Escape sequences and line breaks, as a name of a file can have them.
const NAME: &str = "a\u{1b}[31m\u{9b}2J\r\nb";

/// Runs the program. Nothing that it prints is a control character but the ends of lines, of which there are as many as
/// expected on the standard output and error.
fn assert_tame(command: &mut Command, lines: [usize; 2]) -> String {
    let output = command.output().unwrap();
    let texts = [stdout(&output), stderr(&output)];
    for (text, lines) in texts.iter().zip(lines) {
        assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
        assert_eq!(text.lines().count(), lines, "{text:?}");
    }
    texts.concat()
}

/// Names of files and of meshes, in tables, counts, warnings and errors.
#[test]
fn terminals_do_not_obey_names() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str], lines: [usize; 2]| {
        assert_tame(command(arguments).current_dir(folder.path()), lines);
    };
    let [mesh, raw, bad] = [".obj", ".f32", "c.ply"].map(|ending| format!("{NAME}{ending}"));
    std::fs::write(folder.path().join(&mesh), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    std::fs::write(folder.path().join(&raw), [100.0f32; 300].map(f32::to_le_bytes).concat()).unwrap();
    std::fs::write(folder.path().join(&bad), format!("ply\nformat ascii 1.0\nelement {NAME} 9\n")).unwrap();
    // A legend, the headings, a row for each file and codec, and one for both files, a warning, and a line on computed normals.
    run(&["error", "--codec", "oct16", &mesh, &raw], [7, 0]);
    run(&["encode", "--codec", "oct16", &mesh, "out"], [0, 1]);
    run(&["encode", "--codec", "oct16", &raw, "out"], [0, 2]);
    run(&["encode", "--codec", "oct16", &bad, "out"], [0, 1]);
    // The command line, where it is quoted, and a setting of the environment.
    let refused = stderr(&command(["error".to_owned(), format!("--{NAME}")]).output().unwrap());
    let mut help = command(["encode", "--help"]);
    let help = stdout(&help.env("UNITVEC_DEVICE", NAME).output().unwrap());
    for text in [&refused, &help] {
        assert!(text.contains("--help") && text.chars().all(|c| c == '\n' || !c.is_control()), "{text:?}");
    }
    let mut json = command(["error", "--codec", "oct16", "--json", "-", &mesh]);
    let json = stdout(&json.current_dir(folder.path()).output().unwrap());
    assert!(json.contains(r"\u009b") && json.chars().all(|c| c == '\n' || !c.is_control()), "{json:?}");
    let folder_of_both = folder.path().join(NAME);
    std::fs::create_dir(&folder_of_both).unwrap();
    run(&["encode", "--codec", "oct16", &mesh, &bad, NAME], [0, 3]);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"meshes":[{{"name":"{}","primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}}]}}"#,
        NAME.chars().map(|c| format!("\\u{:04x}", c as u32)).collect::<String>()
    );
    std::fs::write(folder.path().join("a.gltf"), json).unwrap();
    // The counts, with the name of the mesh, and a warning: its points have no faces.
    run(&["encode", "--codec", "oct16", "a.gltf", "out"], [0, 2]);
}

/// The device of a report of costs is named in a legend.
#[test]
fn terminals_do_not_obey_reports() {
    let folder = tempfile::tempdir().unwrap();
    let report =
        std::fs::read(unitvec_tests::repository().join("host/choose/data/costs_navi21.json")).unwrap();
    let mut report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    let choose = |lines| {
        let mut choose = command(["choose", "--max-error", "0.05", "--costs", "costs.json"]);
        assert_tame(choose.current_dir(folder.path()), [lines, 0])
    };
    let path = folder.path().join("costs.json");
    std::fs::write(&path, report.to_string()).unwrap();
    let lines = stdout(&command(["choose", "--max-error", "0.05"]).output().unwrap()).lines().count();
    choose(lines);
    report["device"]["name"] = NAME.into();
    std::fs::write(&path, report.to_string()).unwrap();
    assert!(choose(lines).contains(r"a\u{1b}[31m\u{9b}2J\r\nb"));
}

/// Names that are no text keep their bytes in JSON.
#[test]
fn names_of_any_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let name = OsStr::from_bytes(b"a\xff.obj");
    std::fs::write(folder.path().join(name), BUNNY).unwrap();
    let bytes = serde_json::json!(name.as_bytes());
    let report = |arguments: &[&str], after: &[&str]| -> serde_json::Value {
        let mut command = command(arguments);
        let output = command.arg(name).args(after).current_dir(folder.path()).output().unwrap();
        serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {}", stderr(&output)))
    };
    let measured = report(&["error", "--codec", "oct16", "--json", "-"], &[]);
    assert_eq!([&measured["rows"][0]["file"], &measured["computed"][0]], [&bytes, &bytes]);
    let encoded = report(&["encode", "--codec", "oct16", "--json", "-"], &["out"]);
    assert_eq!((&encoded["input"], &encoded["output"]), (&bytes, &"out".into()));
}

/// A stream that was redirected to a file is that file: it is not read and written at once.
#[test]
fn standard_streams_are_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x");
    std::fs::write(&path, [0; 24]).unwrap();
    let words = ["another name"];
    let mut encode = command(["encode", "--codec", "oct16", "--raw", "-", "x"]);
    assert_fails(encode.current_dir(folder.path()).stdin(File::open(&path).unwrap()), 2, &words);
    let append = OpenOptions::new().append(true).open(&path).unwrap();
    let mut decode = command(["decode", "--codec", "oct16", "--raw", "x", "-"]);
    assert_fails(decode.current_dir(folder.path()).stdout(append), 2, &words);
    assert_eq!((std::fs::read(&path).unwrap(), names(folder.path())), (vec![0; 24], vec!["x".to_owned()]));
    // Two files are two files.
    let mut encode = command(["encode", "--codec", "oct16", "--raw", "-", "y"]);
    let output = encode.current_dir(folder.path()).stdin(File::open(&path).unwrap()).output();
    assert!(output.unwrap().status.success());
}

/// A file that the run has read or written is not replaced: a buffer of a glTF file, a report of costs, codes by another name of
/// their folder; nor is JSON written among codes.
#[test]
fn files_in_use_are_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let floats = [[0.0f32, 0.0, 1.0]; 3].concat();
    let json = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"a.dat"}],"bufferViews":[{"buffer":0,
        "byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0}}]}]}"#;
    let costs =
        std::fs::read(unitvec_tests::repository().join("host/choose/data/costs_navi21.json")).unwrap();
    let files = [
        ("a.gltf", json.as_bytes().to_vec()),
        ("a.dat", raw(&floats)),
        ("costs.json", costs),
        ("a.vrm", b"glTF".to_vec()),
    ];
    for (name, content) in &files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    for line in [
        "normals a.gltf a.dat",
        "error a.gltf --json ./a.dat",
        "choose --bits 16 --costs costs.json --json ./costs.json",
        "encode --codec oct16 --raw a.dat h --json /proc/self/cwd/h",
    ] {
        let _ = std::fs::remove_file(folder.path().join("h"));
        let output = command(line.split(' ')).current_dir(folder.path()).output().unwrap();
        assert!(matches!(output.status.code(), Some(1 | 2)), "{line}: {}", stderr(&output));
        let said = stderr(&output);
        assert!(said.lines().last().unwrap().contains("another name"), "{line}: {said}");
    }
    for (name, content) in &files {
        assert!(std::fs::read(folder.path().join(name)).unwrap() == *content, "{name}");
    }
    assert_eq!(std::fs::read(folder.path().join("h")).unwrap().len(), 6);
    let out = File::create(folder.path().join("o")).unwrap();
    let mut both = command("encode -q --codec oct16 --raw a.dat - --json /dev/stdout".split(' '));
    let both = both.current_dir(folder.path()).stdout(out).output().unwrap();
    assert!(stderr(&both).starts_with('{') && both.status.success());
    assert_eq!(std::fs::read(folder.path().join("o")).unwrap().len(), 6);
}

/// An array from a pipe that ends before its header says so is no whole array.
#[test]
fn arrays_that_are_cut() {
    let array = [&unitvec_host::raw::Npy::new("<f4", 3, 3).to_bytes()[..], &[0; 24]].concat();
    let output = program::run_with_input(["error", "--codec", "oct16", "-"], &array);
    assert!(program::refusal(&output, 1).contains("ends after 2 of 3"));
}

/// A reader that goes away takes the text with it, and not the JSON or the exit status.
#[test]
fn readers_that_leave_cost_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str| {
        let mut running = command(line.split(' '));
        let running = running.current_dir(folder.path()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut running = running.spawn().unwrap();
        drop(running.stdout.take());
        running.wait().unwrap().code()
    };
    assert_eq!(run("choose --bits 16 --json c.json"), Some(0));
    assert!(folder.path().join("c.json").exists());
    assert_eq!(run("choose --bits 1 --max-error 0.0001"), Some(1));
}

/// What is printed fails on a full disk, help and version too.
#[test]
fn a_full_standard_output() {
    for arguments in
        [&["--version"][..], &["--help"], &["codecs"], &["schema", "error"], &["codecs", "--json", "-"]]
    {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        assert_fails(command(arguments).stdout(full), 1, &["the standard output", "No space left"]);
    }
}

/// Limits of the shell for files and for memory, and a program that is killed: each leaves the folder as it was.
#[test]
fn limits_leave_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let shell = |limit: &str, arguments: &str| {
        let program = program::path().display();
        let mut shell = Command::new("sh");
        shell
            .arg("-c")
            .arg(format!("ulimit {limit} && exec '{program}' {arguments}"))
            .current_dir(folder.path());
        shell
    };
    std::fs::write(folder.path().join("in.f32"), vec![0; 12 << 20]).unwrap();
    std::fs::write(folder.path().join("out"), b"precious").unwrap();
    let before = names(folder.path());
    let text =
        assert_fails(&mut shell("-f 8", "encode --codec oct16 in.f32 out"), 1, &["out: File too large"]);
    assert!(!text.contains(".unitvec-"), "{text}");
    let output = shell("-v 60000", "encode --codec oct16 in.f32 out").output().unwrap();
    assert!(!output.status.success());
    let mut endless = command(["encode", "--codec", "oct16", "-", "out"]);
    let mut endless = endless.current_dir(folder.path()).stdin(Stdio::piped()).spawn().unwrap();
    let mut stdin = endless.stdin.take().unwrap();
    // Once it has taken more than a pipe holds, it is at work.
    stdin.write_all(&vec![0; 4 << 20]).unwrap();
    endless.kill().unwrap();
    endless.wait().unwrap();
    assert_eq!(names(folder.path()), before);
    assert_eq!(std::fs::read(folder.path().join("out")).unwrap(), b"precious");
}
