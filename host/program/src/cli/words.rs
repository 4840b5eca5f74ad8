//! The order of the words on a command line.

use clap::error::{ContextKind, ContextValue};
use clap::{Arg, Command, Error};
use std::ffi::OsString;

/// `--out-dir OUT`, of other programs, as `-o OUT/`: what ends with a separator is a folder, and is made if need be. Its value and
/// that of `--output` may follow `=`.
fn with_folder(words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut may_be_option = true;
    let words = words.into_iter().flat_map(|word| {
        may_be_option &= word != "--";
        match word.to_str().and_then(|word| word.split_once('=')) {
            Some((option @ ("--output" | "--out-dir"), value)) if may_be_option => {
                vec![option.into(), value.into()]
            }
            _ => vec![word],
        }
    });
    let mut words: Vec<OsString> = words.collect();
    let at = words.iter().take_while(|word| *word != "--").position(|word| word == "--out-dir");
    if let Some([option, folder]) = at.and_then(|at| words.get_mut(at..at + 2)) {
        *option = "-o".into();
        folder.push("/");
    }
    words
}

/// The words with a subcommand's options before its files, which may stand in any order. Of `IN... OUT` clap takes the last file
/// before an option for OUT, and refuses the next. `-o OUT` and `--output OUT`, of other programs, become the last file.
pub fn options_first(program: &Command, words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut words = with_folder(words).into_iter();
    let mut first: Vec<_> = words.by_ref().take(2).collect();
    let command = first.get(1).and_then(|name| program.find_subcommand(name));
    let Some(command) = command.filter(|command| command.get_positionals().count() > 1) else {
        return first.into_iter().chain(words).collect();
    };
    let is_output = |word: &str| ["-o", "--output"].contains(&word) && !takes_value(command, &word[1..]);
    let (mut files, mut output) = (Vec::new(), None);
    while let Some(word) = words.next() {
        let text = word.to_string_lossy();
        match text.strip_prefix('-') {
            None | Some("") => files.push(word),
            Some("-") => {
                files.push(word);
                files.extend(words.by_ref());
            }
            // A second one is for clap to refuse.
            Some(_) if output.is_none() && is_output(&text) => {
                output = words.next();
                first.extend(output.is_none().then_some(word));
            }
            Some(option) => {
                let takes_next = takes_value(command, option);
                first.push(word);
                if takes_next {
                    first.extend(words.next());
                }
            }
        }
    }
    first.extend(files.into_iter().chain(output));
    first
}

/// The error with OUT for what is missing, where one file is there: clap takes that for OUT, and says that IN is missing.
pub fn with_output(mut error: Error) -> Error {
    let usage = error.get(ContextKind::Usage).map(ToString::to_string).unwrap_or_default();
    let Some(ContextValue::Strings(missing)) = error.get(ContextKind::InvalidArg) else { return error };
    if usage.contains("<OUT>") && !missing.iter().any(|one| one == "<OUT>") {
        let named = |one: &String| if one.ends_with(">...") { "<OUT>".to_owned() } else { one.clone() };
        let missing = missing.iter().map(named).collect();
        error.insert(ContextKind::InvalidArg, ContextValue::Strings(missing));
    }
    error
}

/// True where the word after an option is its value; `option` is without its first dash.
fn takes_value(command: &Command, option: &str) -> bool {
    let has_value = |is_it: &dyn Fn(&Arg) -> bool| {
        command.get_arguments().any(|one| is_it(one) && one.get_action().takes_values())
    };
    let is_long = |name: &str, one: &Arg| {
        one.get_long() == Some(name) || one.get_all_aliases().is_some_and(|names| names.contains(&name))
    };
    match option.strip_prefix('-') {
        Some(name) => has_value(&|one| is_long(name, one)),
        // Of short options in one word, the first with a value takes what follows it there.
        None => {
            let mut letters = option.chars();
            letters.any(|letter| has_value(&|one| one.get_short() == Some(letter)))
                && letters.next().is_none()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{Arguments, parsed};
    use clap::CommandFactory;

    fn ordered(line: &str) -> String {
        let words = line.split(' ').map(OsString::from);
        let ordered = options_first(&Arguments::command(), words);
        ordered.join(" ".as_ref()).into_string().unwrap_or_default()
    }

    #[test]
    fn options_may_stand_anywhere() {
        for (line, expected) in [
            (
                "unitvec encode a.obj --codec oct16 b.obj -q out",
                "unitvec encode --codec oct16 -q a.obj b.obj out",
            ),
            (
                "unitvec encode a.obj --format=oct16 out --json -",
                "unitvec encode --format=oct16 --json - a.obj out",
            ),
            ("unitvec encode - --format oct16 -", "unitvec encode --format oct16 - -"),
            ("unitvec encode a --codec oct16 -- -b out", "unitvec encode --codec oct16 a -- -b out"),
            ("unitvec snap a.obj -o out b.obj --for oct16p", "unitvec snap --for oct16p a.obj b.obj out"),
            ("unitvec write a.obj --normals n --output -", "unitvec write --normals n a.obj -"),
            ("unitvec texture a.png --out-dir maps b.png", "unitvec texture a.png b.png maps/"),
            ("unitvec compare a.obj --out-dir pages", "unitvec compare a.obj -o pages/"),
            ("unitvec decode a b --out-dir=c=d", "unitvec decode a b c=d/"),
            ("unitvec decode --output=c a", "unitvec decode a c"),
            ("unitvec decode a -- --out-dir b", "unitvec decode a -- --out-dir b"),
            ("unitvec decode a -- --output=b", "unitvec decode a -- --output=b"),
            ("unitvec decode a --out-dir", "unitvec decode --out-dir a"),
            ("unitvec decode a -o", "unitvec decode -o a"),
            ("unitvec decode a -o b -o c", "unitvec decode -o a c b"),
            ("unitvec compare a b -o c --codec oct16", "unitvec compare a b -o c --codec oct16"),
            ("unitvec decode a --codec", "unitvec decode --codec a"),
            // Of commands with one file or none, and of what is no command, the order stays.
            ("unitvec compare a.obj --codec oct16", "unitvec compare a.obj --codec oct16"),
            ("unitvec conform --codec oct16 kernels", "unitvec conform --codec oct16 kernels"),
            ("unitvec --version", "unitvec --version"),
            ("unitvec", "unitvec"),
        ] {
            assert_eq!(ordered(line), expected);
        }
    }

    #[test]
    fn a_missing_output_is_named() {
        for (line, missing) in [
            ("unitvec encode a.obj --codec oct16", "  <OUT>\n"),
            ("unitvec encode --codec oct16", "  <IN>...\n  <OUT>\n"),
            ("unitvec snap a.obj", "  --for <ID>\n  <OUT>\n"),
            ("unitvec write a.obj --normals n", "  <OUT>\n"),
            ("unitvec compare --codec oct16", "  <MESH>...\n"),
        ] {
            let error = parsed(line.split(' ').map(OsString::from)).err().map(|error| error.to_string());
            let error = error.unwrap_or_default();
            assert!(error.contains(&format!("not provided:\n{missing}\nUsage")), "{line}: {error}");
        }
    }
}
