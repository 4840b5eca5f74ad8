//! Long lines, broken where their brackets are least deep.

/// The longest line of the includes.
pub const WIDTH: usize = 120;

/// Text that a line may be broken before, and how readily: most readily after a comma, and within a product where there is
/// nothing else.
const BEFORE: [(&str, usize); 9] = [
    (" ? ", 1),
    (" : ", 1),
    (" && ", 1),
    (" || ", 1),
    (" + ", 2),
    (" - ", 2),
    (" | ", 2),
    (" & ", 2),
    (" * ", 100),
];
const KINDS: usize = 3;

/// A statement in as many lines as it needs, those after the first further to the right.
pub fn wrapped(indent: usize, text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest = text;
    let mut indent = indent;
    loop {
        let room = WIDTH.saturating_sub(indent);
        let at = if rest.len() > room { break_at(rest, room) } else { None };
        let (line, next) = rest.split_at(at.unwrap_or(rest.len()));
        lines.push(format!("{:indent$}{}", "", line.trim_end()));
        if at.is_none() {
            return lines;
        }
        if lines.len() == 1 {
            indent += 4;
        }
        rest = next.trim_start();
    }
}

/// The place to break a line at: after `=` where all that follows fits a line; else, of the places in the right half where
/// the fewest brackets are open, the last; else one in the left half.
fn break_at(text: &str, room: usize) -> Option<usize> {
    let assigned = text.find(" = ").map(|at| at + 2);
    let fits = |at: &usize| text.len() - at <= room.saturating_sub(4);
    if let Some(at) = assigned.filter(fits) {
        return Some(at);
    }
    let mut depth = 0_usize;
    let mut best: Option<((usize, usize), usize)> = None;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let rest = &text[at..];
        let place = match rest.starts_with(", ") {
            true => Some((0, at + 1)),
            false => BEFORE.iter().find(|(sign, _)| rest.starts_with(sign)).map(|(_, kind)| (*kind, at)),
        };
        if let Some((kind, place)) = place.filter(|(_, place)| *place <= room) {
            let is_early = usize::from(place < room / 2);
            let rank = (is_early, depth * KINDS + kind);
            if best.is_none_or(|(least, _)| rank <= least) {
                best = Some((rank, place));
            }
        }
    }
    best.map(|(_, place)| place)
}
