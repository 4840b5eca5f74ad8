//! The order of the words on a command line.

use clap::{Arg, Command};
use std::ffi::OsString;

/// The words with a subcommand's options before its files, which may stand in any order. Of `IN... OUT` clap takes the last file
/// before an option for OUT, and refuses the next.
pub fn options_first(program: &Command, words: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut words = words.into_iter();
    let mut first: Vec<_> = words.by_ref().take(2).collect();
    let command = first.get(1).and_then(|name| program.find_subcommand(name));
    let Some(command) = command.filter(|command| command.get_positionals().count() > 1) else {
        return first.into_iter().chain(words).collect();
    };
    let mut files = Vec::new();
    while let Some(word) = words.next() {
        let text = word.to_string_lossy();
        match text.strip_prefix('-') {
            None | Some("") => files.push(word),
            Some("-") => {
                files.push(word);
                files.extend(words.by_ref());
            }
            Some(option) => {
                let takes_next = takes_next(command, option);
                first.push(word);
                if takes_next {
                    first.extend(words.next());
                }
            }
        }
    }
    first.extend(files);
    first
}

/// True where the word after an option is its value; `option` is without its first dash.
fn takes_next(command: &Command, option: &str) -> bool {
    let takes_value = |is_it: &dyn Fn(&Arg) -> bool| {
        command.get_arguments().any(|one| is_it(one) && one.get_action().takes_values())
    };
    let is_long = |name: &str, one: &Arg| {
        one.get_long() == Some(name) || one.get_all_aliases().is_some_and(|names| names.contains(&name))
    };
    match option.strip_prefix('-') {
        Some(name) => takes_value(&|one| is_long(name, one)),
        // Of short options in one word, the first with a value takes what follows it there.
        None => {
            let mut letters = option.chars();
            letters.any(|letter| takes_value(&|one| one.get_short() == Some(letter)))
                && letters.next().is_none()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Arguments;
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
}
