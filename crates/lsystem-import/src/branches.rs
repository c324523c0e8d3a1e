//! What programs do with symbols: `case '+': right(25)`, `if c == 'F': result += "F+F"`.

use crate::tokens::{Kind, Node};
use crate::value::{Unit, What, arithmetic};
use core::ops::Range;
use lsystem_base::number::number;
use lsystem_base::sorted;

/// What a program does where it compares a symbol.
#[derive(Debug, Default)]
pub(super) struct Branches {
    /// Symbols and actions in the words of custom symbols.
    pub(super) meanings: Vec<(char, String, Range<usize>)>,
    /// Symbols and their successors.
    pub(super) rules: Vec<(char, String, Range<usize>)>,
}

/// The most symbols for which one thing is done.
const MAX: usize = 64;
/// The most parts behind a comparison that belong to it.
const LONGEST: usize = 60;

/// Finds the branches of a program in its parts.
pub(super) fn branches(nodes: &[Node]) -> Branches {
    let mut flat = Vec::new();
    flatten(nodes, &mut flat, 0);
    let mut found = Branches::default();
    // Symbols that wait for what is done with them.
    let mut symbols: Vec<char> = Vec::new();
    let mut start = 0;
    for at in 0..flat.len() {
        let Some(compared) = compared(&flat, at) else { continue };
        if symbols.is_empty() {
            start = flat[at].span.start;
        }
        symbols.extend(compared);
        sorted::sort(&mut symbols);
        symbols.dedup();
        symbols.truncate(MAX);
        let end = (at + 1..flat.len().min(at + LONGEST)).find(|next| self::compared(&flat, *next).is_some());
        let body = &flat[at + 1..end.unwrap_or(flat.len().min(at + LONGEST))];
        // `case 'F': case 'G':`, `c == 'F' || c == 'G'`: what follows is for all of them.
        if end.is_some()
            && body.len() <= 4
            && !body.iter().any(|node| matches!(node.kind, Kind::Text(_) | Kind::Group(..)))
        {
            continue;
        }
        if let Some((actions, end)) = action(body) {
            for symbol in &symbols {
                if !found.meanings.iter().any(|(known, ..)| known == symbol) {
                    found.meanings.push((*symbol, actions.clone(), start..end));
                }
            }
        } else if let Some((word, end)) = successor(body) {
            for symbol in &symbols {
                if !found.rules.iter().any(|(known, ..)| known == symbol) {
                    found.rules.push((*symbol, word.clone(), start..end));
                }
            }
        }
        symbols.clear();
    }
    found
}

/// All parts in order; what stands in a bracket follows it.
fn flatten<'t>(nodes: &'t [Node], flat: &mut Vec<&'t Node>, depth: usize) {
    for node in nodes {
        flat.push(node);
        if let Kind::Group(_, inside) = &node.kind
            && depth < 40
        {
            flatten(inside, flat, depth + 1);
        }
    }
}

/// The symbols that the string at a place is compared with.
fn compared(flat: &[&Node], at: usize) -> Option<Vec<char>> {
    among(flat, at, 8)
}

/// The same; a list of symbols, as in `case 'F', 'G':`, is followed this far back.
fn among(flat: &[&Node], at: usize, left: usize) -> Option<Vec<char>> {
    let text = flat[at].text()?;
    let before = at.checked_sub(1).and_then(|at| flat.get(at))?;
    let mut letters = text.chars();
    let first = letters.next()?;
    let is_one = letters.next().is_none();
    let is_case = before.is("==") || before.is("===") || matches!(before.name(), Some("case" | "when"));
    // `"F": lambda: forward(10)`, `'+': () => ..`, `'F' => ..`
    let next = flat.get(at + 1)?;
    let behind = flat.get(at + 2);
    let is_key = (next.is(":") || next.is("=>"))
        && behind.is_some_and(|node| {
            matches!(node.name(), Some("lambda" | "function" | "async"))
                || matches!(node.kind, Kind::Group('(', _) | Kind::Group('{', _))
        })
        || next.is("=>") && behind.is_some_and(|node| node.name().is_some());
    // `case 'F', 'G':`, `case 'F'.code, 'G'.code:`
    let listed = |back: usize| left > 0 && at >= back && among(flat, at - back, left - 1).is_some();
    let is_listed = || {
        let is_code = at > 2 && flat[at - 2].name() == Some("code");
        (before.is(",") || before.is("|")) && listed(if is_code { 4 } else { 2 })
    };
    if is_one && (is_case || is_key || is_listed()) {
        return Some(vec![first]);
    }
    let is_among = before.name() == Some("in") && text.chars().count() <= 8 && !text.contains(char::is_whitespace);
    is_among.then(|| text.chars().collect())
}

/// The action of the first known call, and the end of that call.
fn action(body: &[&Node]) -> Option<(String, usize)> {
    let mut lifted = false;
    // A place that is gone to, unless something is drawn there.
    let mut moved = None;
    for (at, node) in body.iter().enumerate() {
        let Some(name) = node.name() else { continue };
        let Some(call) = body.get(at + 1).filter(|next| matches!(next.kind, Kind::Group('(', _))) else { continue };
        let inside = call.group().unwrap_or_default();
        let is_negative = inside.first().is_some_and(|node| node.is("-"));
        let turn = |left: bool| {
            let words = if left { "turn left" } else { "turn right" };
            let positive = if is_negative { &inside[1..] } else { inside };
            match arithmetic(positive) {
                What::Number(value, unit) => {
                    let degrees = match unit {
                        Unit::Degrees => value,
                        Unit::Radians => crate::angle::tidy(value.to_degrees()),
                        Unit::Unknown => crate::angle::by_value(value).ok()?.0,
                    };
                    Some((format!("{words} {}", number(degrees)), call.span.end))
                }
                _ => Some((words.to_owned(), call.span.end)),
            }
        };
        let lower = name.to_ascii_lowercase().replace('_', "");
        let found = match lower.as_str() {
            "penup" | "pu" => {
                lifted = true;
                continue;
            }
            "forward" | "fd" | "goforward" | "drawforward" | "moveforward" if lifted => "move",
            "box" | "rect" | "fillrect" | "cylinder" | "forward" | "fd" | "line" | "drawline" | "lineto"
            | "drawforward" | "draw" | "goforward" => "draw",
            "left" | "lt" | "turnleft" | "rotateleft" => return turn(!is_negative),
            "right" | "rt" | "turnright" | "rotateright" => return turn(is_negative),
            // On a canvas y goes down, so positive angles turn right.
            "rotate" => return turn(is_negative),
            "pushmatrix" | "pushstate" | "savestate" => "open branch",
            "popmatrix" | "popstate" | "restorestate" => "close branch",
            // Of a list, only one that keeps states.
            "push" | "save" | "append" if inside.is_empty() || keeps(body, at) => "open branch",
            "pop" | "restore" if inside.is_empty() || keeps(body, at) => "close branch",
            "translate" | "moveto" | "move" => {
                moved = moved.or(Some(call.span.end));
                continue;
            }
            _ => continue,
        };
        return Some((found.to_owned(), call.span.end));
    }
    moved.map(|end| ("move".to_owned(), end))
}

/// Whether the call at a place is one of a stack: `stack.append(..)`.
fn keeps(body: &[&Node], at: usize) -> bool {
    let Some([.., list, dot]) = body.get(..at) else { return false };
    let name = list.name().unwrap_or_default().to_ascii_lowercase();
    dot.is(".") && ["stack", "state", "saved", "branch", "pos"].iter().any(|part| name.contains(part))
}

/// The word that a branch appends, assigns or returns, and its end.
fn successor(body: &[&Node]) -> Option<(String, usize)> {
    let at = body.iter().position(|node| matches!(node.kind, Kind::Text(_)))?;
    let text = body[at].text()?;
    let before = at.checked_sub(1).and_then(|at| body.get(at))?;
    let appends = ["+=", "=", "=>", "->", ":"].iter().any(|mark| before.is(mark)) || before.name() == Some("return");
    let calls = matches!(before.kind, Kind::Group('(', _))
        && at.checked_sub(2).and_then(|at| body.get(at)).and_then(|node| node.name()).is_some_and(|name| {
            matches!(
                &*name.to_ascii_lowercase().replace('_', ""),
                "append" | "push" | "pushstr" | "add" | "write" | "concat"
            )
        });
    ((appends || calls) && !crate::prose_words::is_prose(text)).then(|| (text.to_owned(), body[at].span.end))
}
