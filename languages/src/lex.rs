//! Text to tokens. Comments and blank lines go with the token that follows them.

use crate::Error;

/// The kind of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A name or keyword.
    Word,
    /// A number, with its suffix.
    Number,
    /// An operator or bracket.
    Sign,
    /// A whole line from `#` on.
    Directive,
    /// The end of the file.
    End,
}

/// A token and its place.
#[derive(Clone, Debug)]
pub struct Token<'a> {
    pub kind: Kind,
    pub text: &'a str,
    pub line: usize,
    /// The lines of comment before it, whole; an empty one for blank lines.
    pub lead: Vec<String>,
}

/// Operators of two and three characters, longest first.
const LONG_SIGNS: [&str; 19] = [
    "<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "+=", "-=", "*=", "/=", "|=",
    "&=", "^=",
];

/// The tokens of a file.
pub fn tokens<'a>(file: &str, text: &'a str) -> Result<Vec<Token<'a>>, Error> {
    let mut tokens = Vec::new();
    let mut lead: Vec<String> = Vec::new();
    for (index, whole_line) in text.lines().enumerate() {
        let line = index + 1;
        let mut rest = whole_line.trim();
        if rest.is_empty() && lead.last().is_none_or(|last| !last.is_empty()) {
            lead.push(String::new());
        }
        if rest.starts_with("//") {
            lead.push(rest.to_owned());
            continue;
        }
        while !rest.is_empty() {
            let (kind, length) = first(rest);
            let (text, after) = rest.split_at(length);
            if text.starts_with("//") || text.starts_with("/*") {
                return Err(Error::new(file, line, "a comment has to stand on a line of its own, after //"));
            }
            tokens.push(Token { kind, text, line, lead: std::mem::take(&mut lead) });
            rest = after.trim_start();
        }
    }
    tokens.push(Token { kind: Kind::End, text: "", line: text.lines().count(), lead });
    Ok(tokens)
}

/// The kind and length of the token at the start of a line that is not empty.
fn first(rest: &str) -> (Kind, usize) {
    let of = |is_part: fn(char) -> bool| rest.find(|c| !is_part(c)).unwrap_or(rest.len());
    let start = rest.chars().next().unwrap_or(' ');
    if start == '#' {
        return (Kind::Directive, rest.len());
    }
    if start.is_ascii_digit() || (start == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit())) {
        return (Kind::Number, number(rest));
    }
    if start.is_ascii_alphabetic() || start == '_' {
        return (Kind::Word, of(|c| c.is_ascii_alphanumeric() || c == '_'));
    }
    if rest.starts_with("//") || rest.starts_with("/*") {
        return (Kind::Sign, 2);
    }
    let long = LONG_SIGNS.iter().find(|sign| rest.starts_with(**sign));
    (Kind::Sign, long.map_or(start.len_utf8(), |sign| sign.len()))
}

/// The length of the number at the start: digits, letters, points, and a sign after an exponent.
fn number(rest: &str) -> usize {
    let is_hexadecimal = rest.starts_with("0x");
    let mut previous = ' ';
    let end = rest.find(|c: char| {
        let is_sign_of_exponent = !is_hexadecimal && previous == 'e' && (c == '-' || c == '+');
        previous = c;
        !(c.is_ascii_alphanumeric() || c == '.' || is_sign_of_exponent)
    });
    end.unwrap_or(rest.len())
}
