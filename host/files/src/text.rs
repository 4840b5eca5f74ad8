//! Other people's text, in messages and tables.

use std::fmt::{Display, Write};

/// A text that is not the program's own, such as a file's name, on one line: control characters, which a terminal would
/// obey, are escaped.
pub fn shown(text: impl Display) -> String {
    escaped(text, |_| false)
}

/// Lines in which a terminal finds nothing to obey.
pub fn shown_lines(text: impl Display) -> String {
    escaped(text, |c| c == '\n')
}

fn escaped(text: impl Display, is_kept: fn(char) -> bool) -> String {
    let mut line = String::new();
    for c in text.to_string().chars() {
        match c.is_control() && !is_kept(c) {
            // Writing to a String cannot fail.
            true => drop(write!(line, "{}", c.escape_default())),
            false => line.push(c),
        }
    }
    line
}

/// Shortens the message of a parser, which may quote the input at length, to one line. A mark at its end is left out, since the
/// sentence goes on.
pub fn one_line(text: impl Display) -> String {
    const MAX_CHARS: usize = 200;
    let mut line = String::new();
    let text = text.to_string();
    let words = text.split(|c: char| c.is_whitespace() || c.is_control()).filter(|word| !word.is_empty());
    for (at, char) in words.flat_map(|word| [" ", word]).flat_map(str::chars).skip(1).enumerate() {
        if at == MAX_CHARS {
            return line + "...";
        }
        line.push(char);
    }
    line.truncate(line.trim_end_matches([';', '.', ' ']).len());
    line
}

#[cfg(test)]
mod tests {
    use super::{one_line, shown, shown_lines};

    #[test]
    fn terminals_find_nothing_to_obey() {
        let text = "a\u{1b}[31m\nb\u{9b}2J\r\t\u{e9}";
        assert_eq!(shown(text), r"a\u{1b}[31m\nb\u{9b}2J\r\t".to_owned() + "\u{e9}");
        assert_eq!(shown_lines(text), "a\\u{1b}[31m\nb\\u{9b}2J\\r\\t\u{e9}");
    }

    #[test]
    fn messages_of_others_are_one_short_line() {
        assert_eq!(one_line("a\n\tb\u{7f}c; "), "a b c");
        let long = one_line("\u{e9}".repeat(500));
        assert!(long.chars().count() == 203 && long.ends_with("..."), "{long}");
    }
}
