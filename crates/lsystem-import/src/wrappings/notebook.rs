//! Notebooks of Jupyter: the text of their cells.

use crate::mapped::Mapped;

/// The cells with programs as one text, and those with words as another one. `None` if a text is no notebook.
pub(super) fn cells(text: &str) -> Option<Vec<Mapped>> {
    if !text.trim_start().starts_with('{') || !text.contains("\"cells\"") {
        return None;
    }
    let behind = |name: &'static str| {
        text.match_indices(name).filter_map(move |(at, _)| {
            let rest = text[at + name.len()..].trim_start().strip_prefix(':')?.trim_start();
            Some(text.len() - rest.len())
        })
    };
    let kinds = behind("\"cell_type\"").map(|at| text[at..].starts_with("\"code\""));
    let (mut code, mut words) = (Mapped::default(), Mapped::default());
    for (is_code, at) in kinds.zip(behind("\"source\"")) {
        source(text, at, if is_code { &mut code } else { &mut words });
    }
    let parts = [code, words].into_iter().filter(|part| !part.text.is_empty());
    let parts: Vec<Mapped> = parts.map(|part| part.end(text.len())).collect();
    (!parts.is_empty()).then_some(parts)
}

/// Adds the source of a cell: a string or a list of strings of JSON.
fn source(text: &str, mut at: usize, into: &mut Mapped) {
    let is_list = text[at..].starts_with('[');
    at += usize::from(is_list);
    loop {
        let rest = text[at..].trim_start_matches([' ', '\t', '\r', '\n', ',']);
        at = text.len() - rest.len();
        if !rest.starts_with('"') {
            break;
        }
        at = string(text, at + 1, into);
        if !is_list {
            break;
        }
    }
    into.push(at, "\n");
}

/// Adds the string that begins at a place; the place behind it.
fn string(text: &str, mut at: usize, into: &mut Mapped) -> usize {
    while let Some(ch) = text[at..].chars().next() {
        let rest = &text[at..];
        match ch {
            '"' => return at + 1,
            '\\' => {
                let (sign, length) = escape(&rest[1..]);
                into.push(at, sign.encode_utf8(&mut [0; 4]));
                at += 1 + length;
            }
            _ => {
                into.copy(text, at..at + ch.len_utf8());
                at += ch.len_utf8();
            }
        }
    }
    at
}

/// The character of an escape behind its backslash, and its length.
fn escape(rest: &str) -> (char, usize) {
    match rest.chars().next() {
        Some('n') => ('\n', 1),
        Some('t') => ('\t', 1),
        Some('u') => {
            let code = rest.get(1..5).and_then(|digits| u32::from_str_radix(digits, 16).ok());
            code.and_then(char::from_u32).map_or((' ', 1), |sign| (sign, 5))
        }
        Some(sign) => (sign, sign.len_utf8()),
        None => (' ', 0),
    }
}
