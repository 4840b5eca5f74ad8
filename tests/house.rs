//! The house: which rooms import which, and how large they are.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use unitvec_tests::{files, repository};

/// Lines of the largest crate, without its unit tests. A larger one has rooms that want walls: see ARCHITECTURE.md.
const MOST_LINES: usize = 15_300;

/// The folders of the sources of all crates but the tests, each with its name.
fn crates() -> Vec<(String, PathBuf)> {
    let host = fs::read_dir(repository().join("host")).unwrap();
    let host = host.map(|entry| format!("host/{}", entry.unwrap().file_name().to_string_lossy()));
    let others =
        ["shader-crate", "catalogue", "oracle", "languages", "c", "python", "bench", "xtask", "xtask/spirv"];
    let names = others.into_iter().map(str::to_owned).chain(host);
    let crates: Vec<_> = names.map(|name| (repository().join(&name).join("src"), name)).collect();
    let crates = crates.into_iter().filter(|(source, _)| source.is_dir());
    crates.map(|(source, name)| (name, source)).collect()
}

/// Code without comments.
fn code(file: &Path) -> String {
    let text = fs::read_to_string(file).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// The first names of the paths that begin with `crate::`, of those in braces all.
fn imported(code: &str) -> BTreeSet<String> {
    let name = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found = BTreeSet::new();
    for path in code.split("crate::").skip(1) {
        let Some(list) = path.strip_prefix('{') else {
            found.insert(name(path));
            continue;
        };
        let mut depth = 0;
        let mut start = true;
        for (at, char) in list.char_indices() {
            match char {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => start = true,
                c if start && !c.is_whitespace() => {
                    found.insert(name(&list[at..]));
                    start = false;
                }
                _ => {}
            }
        }
    }
    found
}

/// The imports between a crate's rooms: the folders and files right below its sources.
fn arrows(source: &Path) -> BTreeMap<String, BTreeSet<String>> {
    let room = |path: &Path| {
        let first = path.strip_prefix(source).unwrap().components().next().unwrap();
        first.as_os_str().to_string_lossy().trim_end_matches(".rs").to_owned()
    };
    let files = files(source, &[".rs"]);
    let rooms: BTreeSet<String> = files.iter().map(|file| room(file)).collect();
    let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in &files {
        let from = room(file);
        let to = imported(&code(file)).into_iter().filter(|name| rooms.contains(name) && *name != from);
        arrows.entry(from.clone()).or_default().extend(to);
    }
    arrows
}

/// A way from a room back to it.
fn circle(arrows: &BTreeMap<String, BTreeSet<String>>, start: &str) -> Option<Vec<String>> {
    let mut ways = vec![vec![start.to_owned()]];
    let mut seen = BTreeSet::new();
    while let Some(way) = ways.pop() {
        for next in way.last().and_then(|room| arrows.get(room)).into_iter().flatten() {
            if next == start {
                return Some(way);
            }
            if seen.insert(next.clone()) {
                ways.push([&way[..], std::slice::from_ref(next)].concat());
            }
        }
    }
    None
}

/// No room of a crate imports one that imports it. Between crates cargo holds the same.
#[test]
fn no_import_runs_in_a_circle() {
    for (name, source) in crates() {
        let arrows = arrows(&source);
        let circles = arrows.keys().filter_map(|room| circle(&arrows, room));
        assert_eq!(circles.collect::<Vec<_>>(), Vec::<Vec<String>>::new(), "{name}");
    }
}

/// A circle is found, also one that leads through a list of imports.
#[test]
fn a_circle_is_found() {
    let names = imported("use crate::{a::{self, x}, b, Error}; crate::c::d()");
    assert_eq!(names, ["Error", "a", "b", "c"].map(str::to_owned).into());
    let to = |rooms: &[&str]| rooms.iter().map(|room| (*room).to_owned()).collect::<BTreeSet<_>>();
    let arrows = BTreeMap::from([
        ("a".to_owned(), to(&["b"])),
        ("b".to_owned(), to(&["c"])),
        ("c".to_owned(), to(&["a"])),
        ("d".to_owned(), to(&["a"])),
    ]);
    assert_eq!(circle(&arrows, "a").map(|way| way.len()), Some(3));
    assert_eq!(circle(&arrows, "d"), None);
}

#[test]
fn no_crate_is_too_large() {
    for (name, source) in crates() {
        let lines = |file: &PathBuf| {
            let text = fs::read_to_string(file).unwrap();
            text.lines().take_while(|line| *line != "mod tests {").count()
        };
        let lines: usize = files(&source, &[".rs"]).iter().map(lines).sum();
        assert!(lines <= MOST_LINES, "{name} has {lines} lines");
    }
}

/// The rule of divisions, for who breaks it.
const RULE: &str = "GPUs round quotients and roots badly: call quotient, signed_quotient, over, reciprocal, root or inverse_root \
    (in GLSL with unitvec_ before), and ratio for constants of Rust. `/` is for integers over a literal and for two literals";

/// Divisors that are integers, and constants where they are used: the numbers of codes in a part of a lattice.
const INTEGERS: [&str; 6] =
    ["lattice.face()", "lattice.line()", "radix", "(radix * radix", "points", "line_length"];

/// The functions of GLSL that divide: those of the rule, of which some are only parts, quotients of snorms, which the exact
/// edition multiplies, and one of integers.
const DIVIDING: &str = "unitvec_quotient unitvec_signed_quotient unitvec_over unitvec_reciprocal unitvec_root \
    unitvec_inverse_root unitvec_snorm_quotient unitvec_snorm_reciprocal";

/// True where a line of code takes a root, or divides other than as the rule allows.
fn divides(line: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let is_literal = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    let line = line.split("//").next().unwrap_or_default();
    let has_quotient = line.match_indices('/').any(|(at, _)| {
        let (left, right) = (line[..at].trim_end(), line[at + 1..].trim_start());
        let left = &left[left.rfind(|c| !is_part(c)).map_or(0, |before| before + 1)..];
        let is_integer = INTEGERS.iter().any(|divisor| right.starts_with(divisor));
        let right = &right[..right.find(|c| !is_part(c)).unwrap_or(right.len())];
        !(is_integer || is_literal(right) && (is_literal(left) || !right.contains('.')))
    });
    has_quotient || line.contains("sqrt(") || line.contains(".recip()")
}

#[test]
fn floats_are_divided_in_one_place() {
    let sources = repository().join("shader-crate/src");
    // The last two compute in float64, on the CPU alone.
    let own = [
        "arith/divide.rs",
        "arith/exact.rs",
        "arith/elementary.rs",
        "arith/bare.rs",
        "wrap/morton.rs",
        "wrap/smallest.rs",
    ]
    .map(|file| sources.join(file));
    let folders =
        ["arith", "dither", "families", "wrap"].map(|folder| files(&sources.join(folder), &[".rs"]));
    let rust = folders
        .into_iter()
        .flatten()
        .chain(["frame.rs", "quat.rs", "formats.rs"].map(|file| sources.join(file)));
    let glsl = files(&repository().join("glsl/unitvec"), &[".glsl"]);
    let mut found = Vec::new();
    for file in rust.filter(|file| !own.contains(file)).chain(glsl) {
        let text = fs::read_to_string(&file).unwrap();
        let shipped = text.split("\n#[cfg(test)]\nmod ").next().unwrap();
        let mut may_divide = false;
        for (number, line) in shipped.lines().enumerate() {
            if let Some((head, _)) = line.split_once('(').filter(|_| !line.starts_with([' ', '/', '#'])) {
                let name = head.rsplit(' ').next().unwrap();
                may_divide = name.starts_with("unitvec_exact_")
                    || DIVIDING.split(' ').any(|own| name.starts_with(own));
            }
            if divides(line) && !may_divide {
                found.push(format!("{}:{}: {}", file.display(), number + 1, line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "{RULE}:\n{}", found.join("\n"));
}

#[test]
fn divisions_are_found() {
    for line in ["x / m", "a / 3.0", "1.0 / m", "x /= 2.0", "let y = x.sqrt();", "1.0 / sqrt(x)", "(x) / (2)"]
    {
        assert!(divides(line), "{line}");
    }
    for line in ["bits / 2u", "(bits - 2) / 2", "1.0 / 4096.0", "// a / b", "over(m, b) // m / b"] {
        assert!(!divides(line), "{line}");
    }
}
