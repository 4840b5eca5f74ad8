//! Other people's text in messages.

/// Shortens the message of a parser, which may quote the input at length, to one line. A mark at its end is left out, since the
/// sentence goes on.
pub fn one_line(text: impl std::fmt::Display) -> String {
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
    use super::one_line;

    #[test]
    fn messages_of_others_are_one_short_line() {
        assert_eq!(one_line("a\n\tb\u{7f}c; "), "a b c");
        let long = one_line("\u{e9}".repeat(500));
        assert!(long.chars().count() == 203 && long.ends_with("..."), "{long}");
    }
}
