//! `cargo xtask renew`: writes generated files, and repeats recorded runs, where their inputs have changed.

mod records;
mod state;

use crate::{repository, write};
use records::{GROUPS, RECORDS, Record, Source};
use state::{Entry, Lock, Repository};
use std::fs;
use std::path::Path;
use std::process::Command;

const BEGIN: &str = "<!-- generated: records -->\n";
const END: &str = "<!-- end -->";

/// `cargo xtask renew [NAME...] [--check | --list | --adopt REASON]`.
pub fn run(arguments: &[String]) -> Result<(), String> {
    let (options, mut names): (Vec<&str>, Vec<&str>) =
        arguments.iter().map(String::as_str).partition(|argument| argument.starts_with("--"));
    let root = repository();
    match options[..] {
        [] => renew(&root, chosen(&names)?),
        ["--check"] => check(&root, &chosen(&names)?),
        ["--list"] if names.is_empty() => {
            print!("{}", listed());
            Ok(())
        }
        ["--adopt"] if names.len() > 1 => {
            let reason = names.remove(0);
            adopt(&root, reason, &chosen(&names)?)
        }
        _ => Err("renew [NAME...] [--check | --list], or renew --adopt REASON NAME...".to_owned()),
    }
}

/// A record to renew, and whether it was named, and so is renewed even where it is current.
type Chosen = (&'static Record, bool);

/// The records of these names and groups, or all but timings, in the order of [`RECORDS`].
fn chosen(names: &[&str]) -> Result<Vec<Chosen>, String> {
    let is_record = |name: &str| RECORDS.iter().any(|record| record.name == name);
    if let Some(unknown) = names.iter().find(|name| !GROUPS.contains(name) && !is_record(name)) {
        let known = RECORDS.iter().map(|record| record.name).collect::<Vec<_>>().join(", ");
        return Err(format!("no record `{unknown}`; there are {known}, and files, runs and timings"));
    }
    let groups = if names.is_empty() { &["files", "runs"] } else { names };
    let all = RECORDS.iter().map(|record| (record, names.contains(&record.name)));
    Ok(all.filter(|(record, is_named)| *is_named || groups.contains(&record.group)).collect())
}

/// Renews the stale records among the chosen, those that follow from them, and those named.
fn renew(root: &Path, chosen: Vec<Chosen>) -> Result<(), String> {
    let due = due(&Repository::open(root)?, &Lock::read(root)?, chosen)?;
    if due.is_empty() {
        println!("renew: all is current");
        return Ok(());
    }
    let titles: Vec<&str> = due.iter().map(|(record, _)| record.name).collect();
    println!("renew: {}: at most {} on 2 cores, and the build", titles.join(", "), minutes(&due));
    let mut left = Vec::new();
    for (index, (record, is_named)) in due.iter().enumerate() {
        let (place, files) =
            (format!("renew {}/{} {}", index + 1, due.len(), record.name), Repository::open(root)?);
        if !is_named && Lock::read(root)?.current(&files, record)?.is_ok() {
            println!("{place}: its inputs came out as they were");
            continue;
        }
        println!("{place}, about {}", minutes(&[(record, false)]));
        let before = files.hashes(record)?.inputs;
        match (record.renew)() {
            Ok(()) if Repository::open(root)?.hashes(record)?.inputs == before => note(root, record, "")?,
            Ok(()) => {
                let name = record.name;
                return Err(format!("the inputs of {name} changed while it was renewed: renew again"));
            }
            Err(reason) if record.needs.is_empty() => {
                let remedy = "what was renewed before stays: mend this, then renew again";
                return Err(format!("{}: {reason}; {remedy}", record.name));
            }
            Err(reason) => {
                eprintln!("{place} is left stale: {reason}; it needs {}", record.needs);
                left.push(record.name);
            }
        }
    }
    if left.is_empty() { Ok(()) } else { Err(format!("left stale, see above: {}", left.join(", "))) }
}

/// The chosen records that are named, stale, or made of files that such a record makes.
fn due(files: &Repository, lock: &Lock, chosen: Vec<Chosen>) -> Result<Vec<Chosen>, String> {
    let mut due: Vec<Chosen> = Vec::new();
    for (record, is_named) in chosen {
        let is_stale = lock.current(files, record)?.is_err();
        if is_named || is_stale || due.iter().any(|(other, _)| follows(files, record, other)) {
            due.push((record, is_named));
        }
    }
    Ok(due)
}

/// True where a record is made of files of another.
fn follows(files: &Repository, record: &Record, other: &Record) -> bool {
    let inputs = record.inputs.iter().copied().flatten();
    let patterns = inputs.filter_map(|input| match input {
        Source::Bytes(pattern) | Source::Code(pattern) => Some(*pattern),
        _ => None,
    });
    let is_made = |file: &str| other.makes(file) && !record.makes(file);
    patterns.into_iter().any(|pattern| files.matching(pattern).any(is_made))
}

fn minutes(due: &[Chosen]) -> String {
    match due.iter().map(|(record, _)| record.minutes).sum() {
        1 => "1 minute".to_owned(),
        minutes => format!("{minutes} minutes"),
    }
}

/// Enters a record as it is now, beside what the lock has by now.
fn note(root: &Path, record: &Record, adopted: &str) -> Result<(), String> {
    let output = Command::new("date").args(["-u", "+%F"]).output();
    let date = output.map_err(|error| format!("date cannot be started: {error}"))?.stdout;
    let date = String::from_utf8_lossy(&date).trim().to_owned();
    let (mut lock, hashes) = (Lock::read(root)?, Repository::open(root)?.hashes(record)?);
    lock.0.retain(|name, _| RECORDS.iter().any(|record| record.name == *name));
    lock.0.insert(record.name.to_owned(), Entry { date, hashes, adopted: adopted.to_owned() });
    lock.write(root)
}

/// Prints whether each record is current, and fails where one is not.
fn check(root: &Path, chosen: &[Chosen]) -> Result<(), String> {
    let (files, lock) = (Repository::open(root)?, Lock::read(root)?);
    let mut stale = Vec::new();
    for (record, _) in chosen {
        match lock.current(&files, record)? {
            Ok(Entry { date, adopted, .. }) if adopted.is_empty() => {
                println!("{}: record of these inputs, {date}", record.name);
            }
            Ok(Entry { date, adopted, .. }) => {
                println!("{}: record of these inputs, adopted {date}: {adopted}", record.name);
            }
            Err(reason) => {
                println!("{}: STALE: {reason}", record.name);
                stale.push((*record, false));
            }
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = stale.iter().map(|(record, _)| record.name).collect();
    Err(format!("stale: {0}; renew them in {1}: cargo xtask renew {0}", names.join(" "), minutes(&stale)))
}

/// Takes the files of these records for current, and keeps the reason.
fn adopt(root: &Path, reason: &str, chosen: &[Chosen]) -> Result<(), String> {
    if reason.contains('\n') || !reason.contains(' ') || chosen.iter().any(|(_, is_named)| !is_named) {
        return Err(
            "--adopt takes a reason of several words, then the names of records, not of groups".to_owned()
        );
    }
    chosen.iter().try_for_each(|(record, _)| note(root, record, reason))
}

/// CONTRIBUTING's table.
fn listed() -> String {
    let mut text = String::from(
        "| record | files | of what | group | minutes | what it needs |\n|---|---|---|---|---|---|\n",
    );
    for record in RECORDS {
        let files = record.outputs.iter().filter_map(|output| match output {
            Source::Bytes(patterns) => Some(format!("`{}`", patterns.replace(' ', "`, `"))),
            Source::Parts(patterns) => Some(format!("parts of `{}`", patterns.replace(' ', "`, `"))),
            _ => None,
        });
        let files = files.collect::<Vec<_>>().join(", ");
        let Record { name, from, group, minutes, needs, .. } = record;
        text += &format!("| `{name}` | {files} | {from} | {group} | {minutes} | {needs} |\n")
            .replace("|  |", "| |");
    }
    text
}

/// CONTRIBUTING with its table as it should be, before and after.
fn contributing(root: &Path) -> Result<[String; 2], String> {
    let text = fs::read_to_string(root.join("CONTRIBUTING.md"))
        .map_err(|error| format!("CONTRIBUTING.md: {error}"))?;
    let parts = text.split_once(BEGIN).and_then(|(head, rest)| Some((head, rest.split_once(END)?.1)));
    let (head, tail) = parts.ok_or("CONTRIBUTING.md has no part for the table of records")?;
    let renewed = [head, BEGIN, &listed(), END, tail].concat();
    Ok([text, renewed])
}

fn write_contributing() -> Result<(), String> {
    let [before, after] = contributing(&repository())?;
    if before == after { Ok(()) } else { write("CONTRIBUTING.md", after) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// While a generated file is stale, tests fail; runs are repeated by `.ci/run`.
    #[test]
    fn files_are_current() {
        check(&repository(), &chosen(&["files"]).unwrap()).unwrap();
    }

    #[test]
    fn contributing_lists_the_records() {
        let [before, after] = contributing(&repository()).unwrap();
        assert!(before == after, "`cargo xtask renew tables` writes CONTRIBUTING's table again");
    }

    /// A folder that moves takes its patterns along, or a change there would go unnoticed.
    #[test]
    fn every_pattern_has_a_file() {
        let files = Repository::open(&repository()).unwrap();
        for record in RECORDS {
            for source in record.outputs.iter().chain(record.inputs.iter().copied().flatten()) {
                let (Source::Bytes(patterns) | Source::Code(patterns) | Source::Parts(patterns)) = source
                else {
                    continue;
                };
                for pattern in patterns.split(' ').map(|pattern| pattern.trim_start_matches('!')) {
                    assert!(files.matching(pattern).next().is_some(), "{}: {pattern}", record.name);
                }
            }
        }
    }

    #[test]
    fn records_come_after_what_they_are_made_of() {
        let files = Repository::open(&repository()).unwrap();
        for (index, record) in RECORDS.iter().enumerate() {
            let later = RECORDS[index..].iter().find(|later| follows(&files, record, later));
            assert!(later.is_none(), "{} comes before {}", record.name, later.unwrap().name);
        }
        let names = |names: &[&str]| RECORDS.iter().filter(|r| names.contains(&r.name)).collect::<Vec<_>>();
        let [modules, drivers, tables] = names(&["modules", "drivers", "tables"])[..] else { panic!() };
        assert!(follows(&files, drivers, modules) && follows(&files, tables, drivers));
        assert!(!follows(&files, tables, modules));
    }

    #[test]
    fn what_follows_is_due_and_what_is_named_is_alone() {
        let (files, mut lock) = (Repository::open(&repository()).unwrap(), Lock::default());
        for record in RECORDS.iter().filter(|record| record.name != "drivers") {
            let (date, hashes) = ("2026-11-23".to_owned(), files.hashes(record).unwrap());
            lock.0.insert(record.name.to_owned(), Entry { date, hashes, adopted: String::new() });
        }
        let due = |names: &[&str]| {
            let due = due(&files, &lock, chosen(names).unwrap()).unwrap();
            due.iter().map(|(record, _)| record.name).collect::<Vec<_>>()
        };
        assert_eq!(due(&[]), ["drivers", "tables"]);
        assert_eq!(due(&["runs"]), ["drivers"]);
        assert_eq!(due(&["c", "files"]), ["c"]);
        assert_eq!(due(&["imprecise", "files"]), ["imprecise", "tables"]);
        let unknown = chosen(&["nothing"]).err().unwrap();
        assert!(unknown.contains("`nothing`") && unknown.contains("imprecise"), "{unknown}");
    }

    #[test]
    fn adopting_takes_a_reason_and_names() {
        for (reason, names) in [("moved", &["c"]), ("files moved", &["files"])] {
            let refused = adopt(Path::new("/nowhere"), reason, &chosen(names).unwrap());
            assert!(refused.unwrap_err().contains("reason"), "{reason}");
        }
    }
}
