//! The program's output on a terminal of 80 columns, the usual width. `UNITVEC_COLUMNS` stands for the terminal.

use unitvec_tests::program::{command, run, stderr, stdout};
use unitvec_tests::repository;

/// The commands that print tables.
fn tables() -> Vec<Vec<&'static str>> {
    let mut commands = vec![
        vec!["codecs"],
        vec!["accuracy", "--count", "10", "--table", "1"],
        vec!["accuracy", "--count", "10", "--table", "3", "--float64"],
        vec!["choose", "--max-error", "0.05"],
        vec!["devices"],
        vec!["conform", "--count", "10", "--codec", "stereo_concentric32", "--codec", "frame64"],
        vec!["error", "host/mesh/data/bunny.obj"],
        vec![
            "error",
            "host/mesh/data/bunny.obj",
            "host/mesh/data/bunny.obj",
            "--codec",
            "stereo_concentric32",
        ],
    ];
    if cfg!(feature = "glsl") {
        commands.push(vec!["bench", "compiler", "--gpu", "navi21", "--codec", "stereo_concentric32"]);
        commands.push(vec!["bench", "--count", "100", "--samples", "1", "--codec", "stereo_concentric32"]);
    }
    commands
}

/// The output of a command on a terminal of so many columns, or to a pipe.
fn printed(arguments: &[&str], columns: Option<usize>) -> String {
    let mut command = command(arguments);
    command.current_dir(repository());
    if let Some(columns) = columns {
        command.env("UNITVEC_COLUMNS", columns.to_string());
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    stdout(&output)
}

fn widest(text: &str) -> usize {
    text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
}

/// Headings and figures: the words of a table, apart from how its lines are broken.
fn words(text: &str) -> Vec<&str> {
    text.split_whitespace().collect()
}

/// No line is wider than the terminal. The last line names, where columns are left out, the option that prints them; with it, and on a terminal that is
/// wide enough, the output is the same as to a pipe.
#[test]
fn wide_prints_what_a_pipe_gets() {
    let is_timed = |arguments: &[&str]| arguments[..2] == ["bench", "--count"];
    for arguments in tables() {
        let (whole, narrow) = (printed(&arguments, None), printed(&arguments, Some(80)));
        assert!(widest(&narrow) <= 80, "{arguments:?}: {} columns\n{narrow}", widest(&narrow));
        if widest(&whole) > 80 && !["devices", "conform"].contains(&arguments[0]) {
            assert!(narrow.lines().last().unwrap().contains("--wide"), "{arguments:?}: {narrow}");
            let wide = printed(&[&arguments[..], &["--wide"]].concat(), Some(80));
            assert!(wide == whole || is_timed(&arguments), "{arguments:?}: {wide}");
            assert!(widest(&wide) > 80);
        } else {
            assert!(words(&narrow) == words(&whole), "{arguments:?}: {narrow}");
        }
        assert!(!whole.contains("--wide"));
        // Others have nothing to leave out.
        if widest(&whole) > 80 {
            let roomy = printed(&arguments, Some(300));
            assert!(roomy == whole || is_timed(&arguments), "{arguments:?}: {roomy}");
        }
    }
}

/// However little room there is, a codec's line has its name, its bits and its errors.
#[test]
fn essential_columns_stay() {
    let codecs = printed(&["codecs"], Some(1));
    let is_there =
        |words: &[&str]| codecs.lines().any(|line| line.split_whitespace().eq(words.iter().copied()));
    assert!(is_there(&["codec", "bits", "bytes", "domain", "bound", "(deg)"]), "{codecs}");
    assert!(is_there(&["oct16p", "16", "2", "sphere", "0.6380581"]), "{codecs}");
    let accuracy = printed(&["accuracy", "--count", "10", "--table", "3"], Some(1));
    assert!(accuracy.lines().any(|line| words(line) == ["codec", "bits", "mean", "max"]), "{accuracy}");
    // The omission of vectors has to be visible.
    let folder = tempfile::tempdir().unwrap();
    let zero = folder.path().join("zero.bin");
    std::fs::write(&zero, [0; 12]).unwrap();
    let left_out = printed(&["error", zero.to_str().unwrap()], Some(1));
    assert!(left_out.lines().any(|line| words(line) == ["file", "codec", "left", "out", "mean", "max"]));
    let error = printed(&["error", "host/mesh/data/bunny.obj"], Some(1));
    assert!(error.lines().any(|line| words(line) == ["file", "codec", "mean", "max"]), "{error}");
}

/// Clap asks COLUMNS where there is no terminal.
#[test]
fn help_fits_80_columns() {
    let all = stdout(&run(["--help"]));
    let (_, commands) = all.split_once("Commands:\n").unwrap();
    let (commands, _) = commands.split_once("\n\n").unwrap();
    // A name begins its line; what continues a line is indented further.
    let names = commands.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names: Vec<&str> = names.filter(|name| !["", "help"].contains(name)).collect();
    assert!(names.len() > 8, "{names:?}");
    for subcommand in names.into_iter().map(|name| vec![name]).chain([vec![]]) {
        for help in ["-h", "--help"] {
            let output = command([&subcommand[..], &[help]].concat()).env("COLUMNS", "80").output().unwrap();
            let text = stdout(&output);
            assert!(text.contains("Usage: unitvec"), "{text}");
            assert!(widest(&text) <= 80, "{subcommand:?}: {} columns\n{text}", widest(&text));
        }
    }
}

/// However many columns there are, none is left out.
#[test]
fn the_widest_terminal() {
    assert_eq!(printed(&["codecs"], Some(usize::MAX)), printed(&["codecs"], None));
}

/// The output on a pseudo-terminal, which is the standard output and has two names more.
#[cfg(target_os = "linux")]
#[test]
fn binary_output_to_a_terminal_is_refused() {
    let program = unitvec_tests::program::path().display();
    for arguments in ["encode --codec oct16", "decode --codec oct16 --raw", "normals"] {
        for name in ["-", "/dev/stdout", "/dev/tty"] {
            let line = format!("'{program}' {arguments} host/mesh/data/bunny.obj {name}");
            let output = std::process::Command::new("script")
                .args(["-qec", &line, "/dev/null"])
                .current_dir(repository())
                .stdin(std::process::Stdio::null())
                .output()
                .unwrap();
            let text = stdout(&output);
            assert_eq!(output.status.code(), Some(2), "{line}: {text}");
            assert!(text.starts_with("unitvec: ") && text.contains("name a file"), "{line}: {text}");
            assert_eq!(text.lines().count(), 1, "{line}: {text}");
        }
    }
}
