//! What programs do with symbols: `case '+': right(25)`, `if c == 'F': result += "F+F"`.

use crate::tokens::{Kind, Node};
use crate::value::{Unit, What, arithmetic};
use core::ops::Range;
use lsystem_base::{number::number, sorted};

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
        if let Some((symbol, actions, span)) = given(&flat, at) {
            if !found.meanings.iter().any(|(known, ..)| *known == symbol) {
                found.meanings.push((symbol, actions, span));
            }
            continue;
        }
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

/// A symbol that a call, a map or an assignment gives an action: `token("F", Action::Forward(10))`, `"+": turtle.left`.
fn given(flat: &[&Node], at: usize) -> Option<(char, String, Range<usize>)> {
    let text = flat[at].text()?;
    let (mut letters, sign) = (text.chars(), flat.get(at + 1)?);
    let symbol = letters.next().filter(|_| letters.next().is_none())?;
    let is_argument = sign.is(",") && at > 0 && matches!(flat[at - 1].kind, Kind::Group('(', _));
    if !(is_argument || [":", "=>", "="].iter().any(|mark| sign.is(mark))) {
        return None;
    }
    // The last name of a path counts.
    let mut end = at + 2;
    let mut name = flat.get(end)?.name()?;
    while let Some([dot, next]) = flat.get(end + 1..end + 3)
        && (dot.is("::") || dot.is("."))
        && let Some(last) = next.name()
    {
        (name, end) = (last, end + 2);
    }
    let call = flat.get(end + 1).filter(|next| matches!(next.kind, Kind::Group('(', _)) && !next.is_first);
    let place = flat[at].span.start..call.unwrap_or(&flat[end]).span.end;
    let inside = call.and_then(|call| call.group()).unwrap_or_default();
    let turned = |left: bool| turn(inside, left).map(|words| (symbol, words, place.clone()));
    let actions = match verb(name)? {
        // A heading counts as in mathematics.
        "rotate" => return turned(true),
        "turn left" => return turned(true),
        "turn right" => return turned(false),
        "lift" => return None,
        drawn @ ("draw" | "move") => with_length(drawn, inside),
        other => other.to_owned(),
    };
    Some((symbol, actions, place))
}

/// The words for a function of a turtle, in the words of custom symbols.
fn verb(name: &str) -> Option<&'static str> {
    Some(match &*name.to_ascii_lowercase().replace('_', "") {
        "penup" | "pu" => "lift",
        "box" | "rect" | "fillrect" | "cylinder" | "forward" | "fd" | "line" | "drawline" | "lineto"
        | "drawforward" | "draw" | "goforward" => "draw",
        "translate" | "moveto" | "move" => "move",
        "left" | "lt" | "turnleft" | "rotateleft" => "turn left",
        "right" | "rt" | "turnright" | "rotateright" => "turn right",
        "rotate" => "rotate",
        "pushmatrix" | "pushstate" | "savestate" | "push" | "save" | "append" => "open branch",
        "popmatrix" | "popstate" | "restorestate" | "pop" | "restore" => "close branch",
        "nothing" | "noop" => "",
        _ => return None,
    })
}

/// A turn with the angle that a call gives; `None` if it is neither in degrees nor in radians.
fn turn(inside: &[Node], left: bool) -> Option<String> {
    let is_negative = inside.first().is_some_and(|node| node.is("-"));
    // An axis of Unity: `Rotate(Vector3.back * angle)`.
    let axis = inside.iter().find_map(|node| match node.name()? {
        "back" => Some(false),
        "forward" => Some(true),
        _ => None,
    });
    let words = if axis.unwrap_or(left) == is_negative { "turn right" } else { "turn left" };
    let What::Number(value, unit) = arithmetic(if is_negative { &inside[1..] } else { inside }) else {
        return Some(words.to_owned());
    };
    let degrees = match unit {
        Unit::Degrees => value,
        Unit::Radians => crate::angle::tidy(value.to_degrees()),
        Unit::Unknown => crate::angle::by_value(value).ok()?.0,
    };
    Some(format!("{words} {}", number(degrees)))
}

/// A step with the length that a call gives as a number.
fn with_length(action: &str, inside: &[Node]) -> String {
    match arithmetic(inside) {
        What::Number(length, _) if length > 0.0 => format!("{action} {}", number(length)),
        _ => action.to_owned(),
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
        let found = match (verb(name), &*name.to_ascii_lowercase()) {
            (Some("lift"), _) => {
                lifted = true;
                continue;
            }
            (Some("draw"), "forward" | "fd" | "goforward") => with_length(if lifted { "move" } else { "draw" }, inside),
            (Some("draw"), _) => "draw".to_owned(),
            (Some(side @ ("turn left" | "turn right")), _) => {
                return Some((turn(inside, side == "turn left")?, call.span.end));
            }
            // On a canvas y goes down, so positive angles turn right.
            (Some("rotate"), _) => return Some((turn(inside, false)?, call.span.end)),
            // Of a list, only one that keeps states.
            (Some("open branch" | "close branch"), "push" | "save" | "append" | "pop" | "restore")
                if !inside.is_empty() && !keeps(body, at) =>
            {
                continue;
            }
            (Some(branch @ ("open branch" | "close branch")), _) => branch.to_owned(),
            (Some("move"), _) => {
                moved = moved.or(Some(call.span.end));
                continue;
            }
            _ => continue,
        };
        return Some((found, call.span.end));
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
