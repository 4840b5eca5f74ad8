//! The command lines of README and docs run as typed: each page's in a fresh folder, in order.

use crate::cli::cost_kernels;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Stdio};
use unitvec_tests::{files, program, repository};

/// Placeholders, and what stands for them here.
const NAMES: [(&str, &str); 4] =
    [("NAME", "lavapipe"), ("FILE", "out.json"), ("FOLDER", "out"), ("COMMAND", "choose")];

/// Options that make a line short.
const SHORTER: [(&str, &[&str]); 5] = [
    ("unitvec conform", &["--codec oct16", "--count 256"]),
    ("unitvec bench device", &["--codec oct32", "--count 100", "--samples 1"]),
    ("unitvec bench compiler", &["--codec oct32"]),
    ("unitvec figures", &["--only 2", "--small"]),
    ("unitvec compare", &["--side 64", "--samples 1"]),
];

/// Lines that something else runs: how they begin, and what does.
const ELSEWHERE: [(&str, &str); 12] = [
    ("cargo install", "cargo xtask packages"),
    ("cargo xtask spirv --cost", "cargo xtask renew lavapipe; here `cost_kernels` stands for it"),
    ("glslangValidator -V -D", "tests/link.rs"),
    ("unitvec accuracy", "tests/accuracy.rs"),
    ("cargo xtask renew costs", "whoever renews them: it builds drivers for minutes"),
    ("unitvec bench compiler --gpu a730", "cargo xtask renew costs"),
    ("unitvec bench compiler --gpu dg2", "cargo xtask renew costs"),
    ("unitvec bench compiler --device", "tests/isa: drivers that are not RADV's"),
    ("unitvec bench compiler --gpu rdna4", "cargo xtask renew costs: a newer RADV"),
    ("unitvec conform imprecise", "tests/imprecise.rs"),
    ("unitvec figures --only dither", "cargo xtask renew figures"),
    ("unitvec report", "tests/report"),
];

/// The command lines of a page: blocks of no other language, and code in the prose. With a name, text to save under it.
fn steps(page: &str) -> Vec<(Option<String>, String)> {
    let (mut steps, mut block) = (Vec::new(), "");
    for (n, part) in page.split("```").enumerate() {
        if n % 2 == 1 {
            let (language, text) = part.split_once('\n').unwrap();
            if ["", "sh"].contains(&language) {
                let lines = text.lines().map(|line| line.split(" # ").next().unwrap().trim());
                steps.extend(lines.map(|line| (None, line.to_owned())));
            }
            block = text;
            continue;
        }
        for pair in part.split('`').collect::<Vec<_>>().chunks_exact(2) {
            let words: Vec<&str> = pair[1].split_whitespace().collect();
            let code = words.join(" ");
            if pair[0].trim_end().ends_with("ave it as") {
                steps.push((Some(code), block.to_owned()));
            } else if code.starts_with("glslangValidator -V ")
                || matches!(words[..], ["unitvec", next, ..] if next != "=")
            {
                // The name of a command alone, of letters, is no line.
                let is_name = code.chars().all(|c| c.is_ascii_lowercase() || c == ' ');
                steps.push((None, if is_name { code + " --help" } else { code }));
            }
        }
    }
    steps
}

/// The line with names for placeholders, and short.
fn typed(line: &str) -> String {
    let name = |word| NAMES.iter().find(|(name, _)| *name == word).map_or(word, |(_, name)| *name);
    let line = line.split(' ').map(name).collect::<Vec<_>>().join(" ");
    let shorter = SHORTER.iter().find(|(start, _)| line.starts_with(start) && !line.ends_with("--help"));
    let more = shorter.into_iter().flat_map(|(_, more)| *more);
    let lacking = more.filter(|more| !line.contains(more.split(' ').next().unwrap()));
    lacking.fold(line.clone(), |line, more| line + " " + more)
}

/// A folder with all that the repository has, where commands write beside it.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for entry in std::fs::read_dir(repository()).unwrap().map(Result::unwrap) {
        if entry.file_name() != "target" {
            std::os::unix::fs::symlink(entry.path(), folder.path().join(entry.file_name())).unwrap();
        }
    }
    // An engine's plugin has it.
    std::fs::create_dir(folder.path().join("Shaders")).unwrap();
    folder
}

/// Fails unless a line succeeds.
fn run(page: &Path, folder: &Path, line: &str) {
    let programs = [program::path().parent().unwrap().to_owned()];
    let others = std::env::var_os("PATH").unwrap();
    let path = std::env::join_paths(programs.into_iter().chain(std::env::split_paths(&others))).unwrap();
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).current_dir(folder).stdin(Stdio::null());
    let output = shell.env("PATH", path).env("UNITVEC_DEVICE", "lavapipe").output().unwrap();
    assert!(output.status.success(), "{}: {line}\n{}", page.display(), program::stderr(&output));
}

/// Each distinct line runs once, but for those whose output others read.
#[test]
fn command_lines_run() {
    let docs = files(&repository().join("docs"), &[".md"]);
    let readmes = ["README.md", "host/program/README.md"].map(|page| repository().join(page));
    let (mut ran, mut left) = (BTreeSet::new(), BTreeSet::new());
    for page in readmes.iter().chain(&docs) {
        let folder = folder();
        for (name, text) in steps(&std::fs::read_to_string(page).unwrap()) {
            let elsewhere =
                ELSEWHERE.iter().find(|(start, _)| text.starts_with(start) && !text.ends_with("--help"));
            if let Some(name) = name {
                std::fs::write(folder.path().join(name), text).unwrap();
            } else if let Some((start, _)) = elsewhere {
                left.insert(*start);
                if text.ends_with("--cost") {
                    let kernels = folder.path().join("target/spirv-cost");
                    std::fs::create_dir_all(&kernels).unwrap();
                    cost_kernels(&kernels, &["oct32"]);
                }
            } else {
                let line = typed(&text);
                // lavapipe is the device of all lines.
                let words = line.split(' ').filter(|word| !["--device", "lavapipe"].contains(word));
                let is_new = ran.insert(words.map(str::to_owned).collect::<BTreeSet<_>>());
                if is_new || line.starts_with("unitvec encode") || line.starts_with("unitvec normals") {
                    run(page, folder.path(), &line);
                }
            }
        }
    }
    assert!(ran.len() > 40 && left.len() == ELSEWHERE.len(), "{ran:?} {left:?}");
}
