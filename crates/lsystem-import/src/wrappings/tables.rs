//! Tables: rows of Markdown, and lines with separators whose first one names the columns. A row becomes labelled lines.

use super::lines;
use crate::mapped::Mapped;
use crate::vocabulary::{Key, key};
use core::ops::Range;

/// A line that parts the rows of a table from what stands around: a system ends there.
pub(crate) const END: &str = "\u{c}\n";

/// The text with its tables as labelled lines; `None` if it has none.
pub(super) fn tables(text: &str) -> Option<Mapped> {
    let first = text.lines().find(|line| !line.trim().is_empty())?;
    let names = |sign: &char| Head::new(first, &cells(first, 0, *sign)).is_of_systems;
    let sign = [';', '\t', ','].into_iter().find(names).unwrap_or('|');
    let mut inner = Mapped::default();
    let mut has_rows = false;
    // The names of the columns, and the row that has them if a line of dashes follows.
    let (mut head, mut before): (Option<Head>, Option<Vec<Range<usize>>>) = (None, None);
    for (place, line) in lines(text) {
        let (bare, lead) = (line.trim(), line.len() - line.trim_start().len());
        let inside = if sign == '|' { bare.strip_prefix('|') } else { Some(bare).filter(|bare| !bare.is_empty()) };
        let Some(inside) = inside else {
            head = head.filter(|_| sign != '|');
            before = None;
            inner.copy(text, place);
            continue;
        };
        let start = place.start + lead + bare.len() - inside.len();
        let own = cells(inside.strip_suffix('|').filter(|_| sign == '|').unwrap_or(inside), start, sign);
        let is_rule = bare.contains('-') && bare.chars().all(|c| matches!(c, '|' | '-' | ':' | ' '));
        match &head {
            Some(head) => {
                has_rows = true;
                row(text, head, &own, &mut inner);
            }
            None if is_rule => head = before.take().map(|own| Head::new(text, &own)),
            None if sign != '|' => head = Some(Head::new(text, &own)),
            None => {
                inner.copy(text, place);
                before = Some(own);
            }
        }
    }
    has_rows.then(|| inner.end(text.len()))
}

/// The names of the columns, and what they mean.
struct Head {
    names: Vec<String>,
    keys: Vec<Option<Key>>,
    is_of_systems: bool,
}

impl Head {
    fn new(text: &str, cells: &[Range<usize>]) -> Self {
        let name = |cell: &Range<usize>| text[cell.clone()].trim_matches(['*', '_', '`', ' ']).to_owned();
        let names: Vec<String> = cells.iter().map(name).collect();
        let keys: Vec<Option<Key>> = names.iter().map(|name| key(name)).collect();
        let has = |wanted: Key| keys.contains(&Some(wanted));
        let is_of_systems = has(Key::Axiom) && (has(Key::Rules) || has(Key::Rule));
        Self { is_of_systems, names, keys }
    }
}

/// The places of the cells of a line, without white space and quotes around them.
fn cells(line: &str, start: usize, sign: char) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let (mut from, mut quoted, mut span) = (0, false, false);
    for (at, ch) in line.char_indices().chain([(line.len(), sign)]) {
        quoted ^= ch == '"' && sign != '|';
        span ^= ch == '`' && sign == '|' && line[at + 1..].contains('`') | span;
        let ends = ch == sign && !quoted && !span && !line[..at].ends_with('\\') || at == line.len();
        if ends {
            let own = &line[from..at];
            let around = |c: char| c.is_whitespace() || c == '"' && sign != '|';
            let lead = own.len() - own.trim_start_matches(around).len();
            found.push(start + from + lead..start + from + lead + own.trim_matches(around).len());
            from = (at + ch.len_utf8()).min(line.len());
        }
    }
    found
}

/// Adds a row: a system if the columns are those of one, else a label and its value.
fn row(text: &str, head: &Head, own: &[Range<usize>], inner: &mut Mapped) {
    let (Some(first), Some(last)) = (own.first(), own.last()) else { return };
    if head.is_of_systems {
        inner.push(first.start, END);
        for ((cell, name), _) in own.iter().zip(&head.names).zip(&head.keys).filter(|(_, key)| key.is_some()) {
            inner.push(cell.start, &format!("{name}: "));
            inner.copy(text, cell.clone());
            inner.push(cell.end, "\n");
        }
        inner.push(last.end, END);
    } else if let [label, value] = own {
        inner.copy(text, label.clone());
        inner.push(label.end, ": ");
        inner.copy(text, value.clone());
        inner.push(value.end, "\n");
    } else {
        inner.copy(text, first.start..last.end);
        inner.push(last.end, "\n");
    }
}
