//! State of records: hashes of files, and the lock that has those of each record when it was last renewed.

use super::records::{Record, Source};
use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fmt, fs, str};

/// The file of all hashes, in the repository's root.
pub const LOCK: &str = "records.lock";

/// The file's first lines.
const HEAD: &str = "\
# What `cargo xtask renew` made or ran, and of what; it writes this file. In a conflict take either side and renew again.
# record, date, hash of its inputs, hash of its files, why it was adopted and not renewed
";

/// The files of the repository that git tracks or would track, by their paths from its root.
pub struct Repository {
    pub root: PathBuf,
    pub files: Vec<String>,
}

impl Repository {
    pub fn open(root: &Path) -> Result<Self, String> {
        let list = ["ls-files", "--cached", "--others", "--exclude-standard", "-z"];
        let output = Command::new("git").args(list).current_dir(root).output();
        let output = output.map_err(|error| format!("git cannot be started: {error}"))?;
        let text = String::from_utf8_lossy(&output.stdout);
        let files: BTreeSet<&str> = text.split('\0').filter(|file| root.join(file).is_file()).collect();
        if files.is_empty() {
            return Err(format!("git ls-files: {}", String::from_utf8_lossy(&output.stderr)));
        }
        Ok(Self { root: root.to_owned(), files: files.into_iter().map(str::to_owned).collect() })
    }

    /// The files that match one of the patterns.
    pub fn matching<'a>(&'a self, patterns: &'a str) -> impl Iterator<Item = &'a str> {
        self.files.iter().map(String::as_str).filter(move |file| matches(patterns, file))
    }

    /// A hash of the record's inputs and one of its files.
    pub fn hashes(&self, record: &Record) -> Result<Hashes, String> {
        let inputs = self.hash(record.inputs.iter().copied().flatten(), |file| !record.makes(file))?;
        Ok(Hashes { inputs, outputs: self.hash(record.outputs, |_| true)? })
    }

    fn hash<'a>(
        &self,
        sources: impl IntoIterator<Item = &'a Source>,
        counts: impl Fn(&str) -> bool,
    ) -> Result<u64, String> {
        // FNV-1a. It finds accidental changes, which is all that it is for, and needs no package. Lengths keep two
        // sequences of texts apart.
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let mut add = |bytes: &[u8]| {
            let length = (bytes.len() as u64).to_le_bytes();
            let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
            hash = length.iter().chain(bytes).fold(hash, mix);
        };
        for source in sources {
            let (pattern, part): (_, fn(&str) -> String) = match source {
                Source::Bytes(pattern) => (pattern, str::to_owned),
                Source::Code(pattern) => (pattern, code),
                Source::Parts(pattern) => (pattern, parts),
                Source::Versions(versions) => {
                    add(versions().as_bytes());
                    continue;
                }
            };
            for file in self.matching(pattern).filter(|file| counts(file)) {
                let bytes = fs::read(self.root.join(file)).map_err(|error| format!("{file}: {error}"))?;
                let part = str::from_utf8(&bytes).map(|text| part(&text.replace('\r', "")).into_bytes());
                let part = part.unwrap_or(bytes);
                if !part.is_empty() {
                    add(file.as_bytes());
                    add(&part);
                }
            }
        }
        Ok(hash)
    }
}

/// True where one of the patterns is the path, with anything in the place of each `*`, and none after a `!` is.
pub fn matches(patterns: &str, path: &str) -> bool {
    let excluded = |one: &str| one.strip_prefix('!').is_some_and(|pattern| is_like(pattern, path));
    patterns.split(' ').any(|pattern| is_like(pattern, path)) && !patterns.split(' ').any(excluded)
}

fn is_like(pattern: &str, path: &str) -> bool {
    match pattern.split_once('*') {
        Some((head, rest)) => path.strip_prefix(head).is_some_and(|tail| {
            (0..=tail.len()).any(|at| tail.get(at..).is_some_and(|tail| is_like(rest, tail)))
        }),
        None => pattern == path,
    }
}

/// The lines of Rust or of a shader that are neither empty nor comments.
fn code(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The text between the markers of generated parts, with the markers.
fn parts(text: &str) -> String {
    let parts = text.split("<!-- generated: ").skip(1).filter_map(|part| part.split("<!-- end -->").next());
    parts.collect()
}

/// The hashes of a record's inputs and of its files.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hashes {
    pub inputs: u64,
    pub outputs: u64,
}

/// The date and the hashes of a record's last renewal.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub date: String,
    pub hashes: Hashes,
    /// The reason why the files were taken for current without being made again; empty where they were made.
    pub adopted: String,
}

/// The entries of [`LOCK`], by the records' names.
#[derive(Debug, Default, PartialEq)]
pub struct Lock(pub BTreeMap<String, Entry>);

impl Lock {
    pub fn read(root: &Path) -> Result<Self, String> {
        match fs::read_to_string(root.join(LOCK)) {
            Ok(text) => Self::parse(&text),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Self::default()),
            Err(error) => Err(format!("{LOCK}: {error}")),
        }
    }

    pub fn parse(text: &str) -> Result<Self, String> {
        let entry = |line: &str| {
            let mut fields = line.splitn(5, ' ');
            let mut field = || fields.next().unwrap_or_default().to_owned();
            let (name, date) = (field(), field());
            let [inputs, outputs] = [field(), field()].map(|hash| u64::from_str_radix(&hash, 16));
            let wrong = |_| format!("{LOCK} has the line `{line}`: `cargo xtask renew` writes the file");
            let hashes = Hashes { inputs: inputs.map_err(wrong)?, outputs: outputs.map_err(wrong)? };
            Ok((name, Entry { date, hashes, adopted: field() }))
        };
        let lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
        lines.map(entry).collect::<Result<_, _>>().map(Self)
    }

    /// Writes the file whole or not at all.
    pub fn write(&self, root: &Path) -> Result<(), String> {
        let (path, part) = (root.join(LOCK), root.join(format!("{LOCK}.part")));
        let written = fs::write(&part, self.to_string()).and_then(|()| fs::rename(&part, &path));
        written.map_err(|error| format!("{}: {error}", path.display()))
    }

    /// The entry of a record that is current; else why it is stale. Fails where a file cannot be read.
    pub fn current(
        &self,
        repository: &Repository,
        record: &Record,
    ) -> Result<Result<&Entry, String>, String> {
        let Some(entry) = self.0.get(record.name) else {
            return Ok(Err(format!("{LOCK} does not have it")));
        };
        let hashes = repository.hashes(record)?;
        Ok(if entry.hashes.inputs != hashes.inputs {
            Err(format!("its inputs changed since {}", entry.date))
        } else if entry.hashes.outputs != hashes.outputs {
            Err(format!("its files are not those of {}: `renew` did not write them", entry.date))
        } else {
            Ok(entry)
        })
    }
}

impl fmt::Display for Lock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(HEAD)?;
        for (name, Entry { date, hashes, adopted }) in &self.0 {
            let line = format!("{name} {date} {:016x} {:016x} {adopted}", hashes.inputs, hashes.outputs);
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::renew::records::RECORDS;

    #[test]
    fn stars_stand_for_anything() {
        for path in ["shaders/wgsl/oct.wgsl", "shaders/a/b/c"] {
            assert!(matches("shaders/*/*", path));
        }
        assert!(!matches("shaders/*/*", "shaders/README.md") && !matches("a*.rs", "a/b.glsl"));
        assert!(matches("host/*link/*.rs", "host/link/src/lib.rs") && matches("é*", "éé"));
        assert!(matches("a* !*/b", "a/c") && !matches("a* !*/b", "a/b"));
        assert!(matches("a b*", "a") && matches("a b*", "bc") && !matches("a b*", "ac"));
    }

    #[test]
    fn comments_and_empty_lines_are_no_code() {
        let before = "//! Docs.\nfn one() {\n    // Why.\n    1\n}\n";
        assert_eq!(code(before), code("fn one() {\n\n    1 \n}\n/// Other docs.\n"));
        assert_ne!(code(before), code(&before.replace("    1", "    2")));
    }

    #[test]
    fn only_generated_parts_count() {
        let text = |prose: &str, cell: &str| {
            format!("{prose}\n<!-- generated: t -->\n{cell}\n<!-- end -->\n{prose}")
        };
        assert_eq!(parts(&text("a", "1")), parts(&text("b", "1")));
        assert_ne!(parts(&text("a", "1")), parts(&text("a", "2")));
        assert_eq!(parts("prose"), "");
    }

    #[test]
    fn a_lock_is_read_as_it_is_written() {
        let entry = |adopted: &str| Entry {
            date: "2026-11-23".into(),
            hashes: Hashes { inputs: 1, outputs: u64::MAX },
            adopted: adopted.into(),
        };
        let lock = Lock([("b".into(), entry("")), ("a".into(), entry("files moved"))].into());
        let text = lock.to_string();
        assert_eq!(Lock::parse(&text), Ok(lock));
        assert!(text.ends_with(
            "\na 2026-11-23 0000000000000001 ffffffffffffffff files moved\nb 2026-11-23 0000000000000001 ffffffffffffffff\n"
        ));
        assert!(Lock::parse("a 2026-11-23\n").unwrap_err().contains("a 2026-11-23"));
    }

    /// A record is stale when its inputs have changed, and when its files have, and current when all is back.
    #[test]
    fn changes_make_records_stale() {
        let record = Record {
            outputs: &[Source::Bytes("out")],
            inputs: &[&[Source::Code("*.rs")]],
            ..*RECORDS.first().unwrap()
        };
        let root = crate::tests::folder("records");
        let files = ["a.rs", "b.rs", "out"].map(str::to_owned).to_vec();
        let repository = Repository { root: root.clone(), files };
        let write = |texts: [&str; 3]| {
            let files = repository.files.iter().zip(texts);
            files.for_each(|(file, text)| fs::write(root.join(file), text).unwrap());
        };
        let why = |lock: &Lock| lock.current(&repository, &record).unwrap().err().unwrap_or_default();
        write(["1\n", "", "1"]);
        let mut lock = Lock::default();
        assert!(why(&lock).contains("does not have it"));
        let (date, adopted, hashes) = (String::new(), String::new(), repository.hashes(&record).unwrap());
        lock.0.insert(record.name.to_owned(), Entry { date, hashes, adopted });
        for (texts, told) in [
            (["// One.\n\n1\n", "", "1"], ""),
            (["2\n", "", "1"], "inputs changed"),
            (["1\n", "1\n", "1"], "inputs changed"),
            (["1\n", "", "2"], "did not write them"),
            (["1\n", "", "1"], ""),
        ] {
            write(texts);
            let why = why(&lock);
            assert!(why.contains(told) && told.is_empty() == why.is_empty(), "{texts:?}: {why}");
        }
        fs::remove_dir_all(&root).unwrap();
    }
}
