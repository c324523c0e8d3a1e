//! The text form of anvaka's L-system page, and links of that page.
//!
//! ```text
//! axiom: X
//! rules:
//!   X => F+[X]
//! depth: 4
//! angle: 25
//! actions:
//!   F => draw(10)
//!   + => rotate(-90)
//! ```
//!
//! The turtle starts to the right. `rotate` turns to the left by degrees. Without other actions F draws 10, f moves 10,
//! and + and - turn by the angle, which is 60 if it is missing; the depth is 5 if it is missing. Of several rules for a
//! symbol the last one counts.
//!
//! The page turns about the fixed axes of space: `rotate` about z, which points to the reader, `rotateX` and `rotateY`
//! about the others. Turns about one axis alone are turns of our turtle: about z in the plane, about another axis pitches.

use crate::MAX_ENTRIES;
use crate::draft::{Draft, production};
use crate::rules::split_rule;
use crate::source::{Lines, Source};
use core::ops::Range;
use lsystem_base::{decimal, number::number, say};
use lsystem_syntax::{Grammar, Module, Production, look_alike};
use std::collections::{BTreeMap, HashMap, HashSet};

/// The keys, in lower case. All other keys have no effect on that page.
const KEYS: &str =
    "axiom, start, rules, production rules, actions, depth, angle, width, color, stepsperframe, direction, position";

/// Keys that only this page has.
const OWN: [&str; 5] = ["depth", "actions", "stepsperframe", "direction", "position"];

/// What this page removes from values, because it separates keys and values.
const SEPARATORS: [&str; 5] = ["->", "=>", ":", "=", "→"];

/// The address of the page, and the parameter of its links that holds a text.
const ADDRESS: &str = "anvaka.github.io/lsystem";
const CODE: &str = "code=";

/// The key and the value of a line such as `axiom: X`.
fn key(line: &str) -> Option<(String, &str)> {
    let (key, value) = line.split_once(':')?;
    let key = key.trim().to_ascii_lowercase();
    KEYS.split(", ").any(|known| known == key).then_some((key, value.trim()))
}

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let keys: Vec<(String, &str)> = text.lines().filter_map(key).collect();
    let has = |names: &[&str]| keys.iter().any(|(key, _)| names.contains(&key.as_str()));
    let header =
        keys.iter().any(|(key, value)| matches!(key.as_str(), "rules" | "production rules") && value.is_empty());
    let (is_own, has_arrow) = (has(&OWN), text.contains("=>"));
    if header && (has(&["axiom", "start"]) && (is_own || has_arrow) || is_own && has_arrow) {
        return Some(vec![system(source)]);
    }
    if has(&["axiom", "start"]) { None } else { links(source) }
}

/// The systems in all links of the page in a text; `None` if there is no such link.
fn links<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let mut drafts = Vec::new();
    let mut behind = 0;
    for (at, _) in source.text.match_indices(ADDRESS) {
        if at < behind {
            continue;
        }
        let is_end = |c: char| c.is_whitespace() || matches!(c, '"' | '\'' | '<' | '>' | '`');
        let rest = &source.text[at..];
        let address = &rest[..rest.find(is_end).unwrap_or(rest.len())];
        let scheme = source.text[..at].rsplit(|c: char| is_end(c) || c == '(').next().unwrap_or_default();
        behind = at + address.len();
        let Some((_, code)) = address.split_once(CODE) else { continue };
        let code = code.split(['&', '#']).next().unwrap_or_default();
        // In Markdown, an address ends at the parenthesis that closes it.
        let code = code.find(')').filter(|end| !code[..*end].contains('(')).map_or(code, |end| &code[..end]);
        drafts.push(link(source, at - scheme.len()..source.place(code)?.end, code));
        if drafts.len() > MAX_ENTRIES {
            break;
        }
    }
    (!drafts.is_empty()).then_some(drafts)
}

/// The system in a link: `code` is its encoded text.
fn link<'a>(source: Source<'a>, span: Range<usize>, code: &str) -> Draft<'a> {
    let mut draft = Draft::new(source, "", source.line_of(span.start));
    draft.covers(span.clone());
    match decoded(code) {
        Some(text) => {
            draft.read(span.clone(), say!("the system in the link"));
            let lines = Lines::new(&text);
            draft.adopt(system(Source::new(&text, &lines)), &span);
        }
        None => draft.refuse_at(span, say!("The link is damaged or cut off")),
    }
    draft
}

/// A percent-encoded text; `None` if it is damaged. A plus sign is a blank where the writer escaped `:` or `+`.
fn decoded(text: &str) -> Option<String> {
    let has_blanks = ["%3A", "%3a", "%2B", "%2b"].iter().any(|escape| text.contains(escape));
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(if byte == b'+' && has_blanks { b' ' } else { byte });
            continue;
        }
        let mut digit = || char::from(rest.next()?).to_digit(16);
        let (high, low) = (digit()?, digit()?);
        bytes.push((high * 16 + low) as u8);
    }
    String::from_utf8(bytes).ok()
}

/// An axis of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Axis {
    X,
    Y,
    Z,
}

/// What a symbol does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Act {
    Draw(f64),
    Move(f64),
    Push,
    Pop,
    /// By degrees, counter-clockwise for a reader who looks against the axis.
    Rotate(Axis, f64),
    /// Turns by the angle of the system.
    Left,
    Right,
    Nothing,
}

/// The parts of a system while it is read.
#[derive(Debug)]
struct Parts<'a> {
    axiom: Vec<char>,
    /// Productions with their lines, and the place of the last one by its symbol.
    rules: Vec<(Production, &'a str)>,
    by_symbol: HashMap<char, usize>,
    /// Acts with the text that gives them.
    acts: BTreeMap<char, (Act, &'a str)>,
    angle: f64,
    direction: [f64; 3],
    /// The text that gives the direction.
    direction_text: &'a str,
}

/// The section of a text that a line stands in.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    None,
    Rules,
    Actions,
}

/// Reads a whole text.
fn system<'a>(source: Source<'a>) -> Draft<'a> {
    let mut draft = Draft::new(source, "", 1);
    draft.covers(0..source.text.len());
    draft.definition.step = LENGTH;
    (draft.definition.iterations, draft.has_iterations) = (5, true);
    draft.others = Some("");
    let usual = [
        ('F', Act::Draw(LENGTH)),
        ('f', Act::Move(LENGTH)),
        ('+', Act::Left),
        ('-', Act::Right),
        ('[', Act::Push),
        (']', Act::Pop),
    ];
    let mut parts = Parts {
        axiom: Vec::new(),
        rules: Vec::new(),
        by_symbol: HashMap::new(),
        acts: usual.into_iter().map(|(symbol, act)| (symbol, (act, ""))).collect(),
        angle: 60.0,
        direction: [1.0, 0.0, 0.0],
        direction_text: "",
    };
    let mut section = Section::None;
    for line in source.text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some(comment) = line.strip_prefix("//") {
            if draft.definition.name.is_empty() {
                draft.definition.name = comment.trim().chars().take(200).collect();
                draft.read(draft.place(line), say!("the name"));
            } else {
                draft.pass(draft.place(line));
            }
        } else if let Some((key, value)) = key(line) {
            section = setting(&key, value, line, &mut parts, &mut draft);
            if !value.is_empty() && section != Section::None {
                draft.refuse_at(draft.place(line), say!("A rule or an action must stand on a line of its own"));
            }
        } else {
            section = one_of(section, line, &mut parts, &mut draft);
        }
    }
    finish(parts, &mut draft);
    draft
}

/// Reads a line with a key, and returns the section that begins with it.
fn setting<'a>(key: &str, value: &'a str, line: &'a str, parts: &mut Parts<'a>, draft: &mut Draft<'a>) -> Section {
    let place = draft.place(line);
    match key {
        "axiom" | "start" => {
            parts.axiom = word(value, draft);
            draft.read(place, say!("axiom {}", parts.axiom.iter().collect::<String>()));
        }
        "depth" => {
            // That page takes the number at the start, and goes on while the depth is not reached.
            let depth = leading_number(value).map_or_else(|| value.to_owned(), |(n, _)| number(libm::ceil(n.max(0.0))));
            draft.iterations(draft.source.line_of(place.start), &depth);
            draft.read(place, format!("n {}", draft.definition.iterations));
        }
        "angle" => match leading_number(value) {
            Some((angle, rest)) => {
                parts.angle = angle;
                draft.read(place.clone(), say!("angle {}", number(angle)));
                if !matches!(rest.trim(), "" | "°" | "deg" | "degrees") {
                    draft.note_at(place, say!("That page reads only the number at the start"));
                }
            }
            None => draft.refuse_at(place, say!("The angle is not a number")),
        },
        "direction" | "position" => match vector(value) {
            Some([x, y, z]) if key == "position" => {
                draft.definition.start = [x, y];
                draft.read(place, say!("start {}, {}", number(x), number(y)));
                if z != 0.0 {
                    draft.note_at(draft.place(value), say!("The drawing is not moved along z"));
                }
            }
            Some(direction) => {
                (parts.direction, parts.direction_text) = (direction, value);
                draft.read(place, say!("the heading"));
            }
            None => draft.refuse_at(draft.place(line), say!("The {} must be two or three numbers", key)),
        },
        "rules" | "production rules" => {
            draft.pass(place);
            return Section::Rules;
        }
        "actions" => {
            draft.pass(place);
            return Section::Actions;
        }
        _ => draft.note_at(place, say!("This is not carried over")),
    }
    Section::None
}

/// Reads a rule or an action, and returns the section of the next line: an unknown key ends a section.
fn one_of<'a>(section: Section, line: &'a str, parts: &mut Parts<'a>, draft: &mut Draft<'a>) -> Section {
    let place = draft.place(line);
    let Some((from, to)) = split_rule(line) else {
        draft.refuse_at(place, say!("This line cannot be read"));
        return section;
    };
    let mut letters = from.chars();
    let symbol = letters.next().filter(|_| letters.next().is_none());
    let symbol = symbol.map(|symbol| look_alike(symbol).unwrap_or(symbol));
    match (section, symbol) {
        (Section::None, _) => draft.note_at(place, say!("This key has no effect on that page")),
        (_, None) if line.split_once(':').is_some_and(|(key, _)| key.chars().all(char::is_alphanumeric)) => {
            draft.note_at(place, say!("This key has no effect on that page"));
            return Section::None;
        }
        (_, None) => draft.refuse_at(place, say!("The left side must be one symbol")),
        (Section::Rules, Some(symbol)) => {
            let successor = word(to, draft);
            draft.read(place.clone(), format!("{symbol} -> {}", successor.iter().collect::<String>()));
            if let Some(old) = parts.by_symbol.insert(symbol, parts.rules.len())
                && let Some((_, old)) = parts.rules.get(old)
            {
                draft.note_at(draft.place(old), say!("A later rule for the same symbol replaces this one"));
            }
            parts.rules.push((production(symbol, successor), line));
        }
        (Section::Actions, Some(symbol)) => match action(to) {
            Some(Act::Nothing) => {
                draft.note_at(place, say!("The colour is not carried over"));
                parts.acts.insert(symbol, (Act::Nothing, line));
            }
            Some(act) => {
                draft.read(place, say!("what {} does", symbol));
                let rest = to.split_once(')').map_or("", |(_, rest)| rest.trim().trim_end_matches(';'));
                if !rest.is_empty() {
                    draft.note_at(draft.place(rest), say!("That page reads only the first call of an action"));
                }
                parts.acts.insert(symbol, (act, line));
            }
            None => draft.refuse_at(place, say!("This action cannot be read")),
        },
    }
    section
}

/// A word without white space and without what that page removes.
fn word(text: &str, draft: &mut Draft<'_>) -> Vec<char> {
    let mut symbols = Vec::new();
    let mut rest = text;
    while let Some(ch) = rest.chars().next() {
        if let Some(separator) = SEPARATORS.iter().find(|separator| rest.starts_with(**separator)) {
            let place = draft.place(&rest[..separator.len()]);
            draft.note_at(place, say!("That page leaves this out of words"));
            rest = &rest[separator.len()..];
            continue;
        }
        let (own, behind) = rest.split_at(ch.len_utf8());
        symbols.extend(draft.symbols(own));
        rest = behind;
    }
    symbols
}

/// The number at the start of a text, and the rest; as on that page.
fn leading_number(text: &str) -> Option<(f64, &str)> {
    if let Some(value) = decimal::read(text).filter(|value| value.is_finite()) {
        return Some((value, ""));
    }
    let sign = usize::from(text.starts_with(['-', '+']));
    let more = |c: char| !c.is_ascii_digit() && c != '.';
    let (own, rest) = text.split_at(text[sign..].find(more).map_or(text.len(), |end| sign + end));
    let value = decimal::read(own.trim_start_matches('+').trim_end_matches('.'))?;
    value.is_finite().then_some((value, rest))
}

/// A vector of two or three numbers.
fn vector(text: &str) -> Option<[f64; 3]> {
    let mut found = [0.0; 3];
    let mut count = 0;
    for part in text.trim_matches(['[', ']', '(', ')', ' ']).split(',') {
        *found.get_mut(count)? = leading_number(part.trim())?.0;
        count += 1;
    }
    (count >= 2).then_some(found)
}

/// The act for an action such as `rotate(90)`.
fn action(text: &str) -> Option<Act> {
    let (name, rest) = text.split_once('(')?;
    let (arguments, _) = rest.split_once(')')?;
    let argument = arguments.split(',').next().unwrap_or_default().trim();
    let value = leading_number(argument).map(|(value, _)| value);
    let length = if argument.is_empty() { Some(LENGTH) } else { value };
    match name.trim() {
        "draw" => length.map(Act::Draw),
        "move" => length.map(Act::Move),
        "push" => Some(Act::Push),
        "pop" => Some(Act::Pop),
        "rotateX" => value.map(|angle| Act::Rotate(Axis::X, angle)),
        "rotateY" => value.map(|angle| Act::Rotate(Axis::Y, angle)),
        name if name.starts_with("rotate") => value.map(|angle| Act::Rotate(Axis::Z, angle)),
        "setColor" | "setColour" | "color" => Some(Act::Nothing),
        _ => None,
    }
}

/// The usual length of a step.
const LENGTH: f64 = 10.0;

/// Translates the acts, with the direction, and the grammar.
fn finish<'a>(parts: Parts<'a>, draft: &mut Draft<'a>) {
    let Parts { axiom, rules, by_symbol, acts, angle, direction, direction_text } = parts;
    let mut axiom: Vec<Module> = axiom.into_iter().map(Module::from).collect();
    if let Some((first, line)) = rules.first().filter(|_| axiom.is_empty()) {
        axiom.push(Module::from(first.predecessor.symbol));
        let why = say!("There is no axiom; as on that page, the symbol of the first rule is taken");
        draft.note_at(draft.place(line), why);
    }
    let mut grammar = Grammar { axiom, ..Grammar::default() };
    let is_last = |at: usize, rule: &Production| by_symbol.get(&rule.predecessor.symbol) == Some(&at);
    let kept = rules.into_iter().enumerate().filter(|(at, (rule, _))| is_last(*at, rule));
    grammar.productions = kept.map(|(_, (rule, _))| rule).collect();
    let symbols: HashSet<char> = grammar.made().map(|module| module.symbol).collect();
    let used = acts.iter().filter(|(symbol, _)| symbols.contains(symbol));
    let turns = used.filter_map(|(_, (act, text))| match act {
        Act::Rotate(axis, by) if *by != 0.0 => Some((*axis, *text)),
        Act::Left | Act::Right if angle != 0.0 => Some((Axis::Z, *text)),
        _ => None,
    });
    let turns: Vec<(Axis, &str)> = turns.collect();
    let axis = turns.first().map_or(Axis::Z, |turn| turn.0);
    let in_space = turns.iter().find(|turn| turn.0 != Axis::Z).map_or(direction_text, |turn| turn.1);
    if turns.iter().any(|turn| turn.0 != axis) {
        let why = say!(
            "This turns about a fixed axis of space, and other symbols about another one; our turtle turns about \
                   its own axes"
        );
        return draft.refuse_at(draft.place(in_space), why);
    }
    let [x, y, z] = direction;
    let (flat, whole) = (libm::hypot(x, y), libm::hypot(libm::hypot(x, y), z));
    // The part of a step that a reader sees who looks along z.
    let mut seen = 1.0;
    let mut pitch = 0.0;
    match axis {
        Axis::Z if flat == 0.0 => {
            let why = say!("The turtle goes along z, where all turns about z leave it; nothing is drawn in the plane");
            return draft.refuse_at(draft.place(direction_text), why);
        }
        Axis::Z if z != 0.0 => {
            seen = flat / whole;
            let why = say!("The drawing also rises along z; it is drawn as it looks against z");
            draft.note_at(draft.place(direction_text), why);
        }
        Axis::Z => {}
        // A turn of the heading towards z, where the turtle's up points, or away from it.
        Axis::X if x == 0.0 && z == 0.0 && y != 0.0 => pitch = y.signum(),
        Axis::Y if y == 0.0 && z == 0.0 && x != 0.0 => pitch = x.signum(),
        // Turns about the heading itself have no effect.
        Axis::X if y == 0.0 && z == 0.0 && x != 0.0 => {}
        Axis::Y if x == 0.0 && z == 0.0 && y != 0.0 => {}
        Axis::X | Axis::Y => {
            let why = say!(
                "This turns about a fixed axis of space, to which the direction is oblique; our turtle turns about \
                       its own axes"
            );
            return draft.refuse_at(draft.place(in_space), why);
        }
    }
    draft.definition.heading = libm::round(libm::atan2(y, x).to_degrees() * 1e9) / 1e9;
    draft.definition.angle = angle;
    draft.definition.step = rounded(LENGTH * seen);
    for (symbol, (act, _)) in acts {
        draft.meaning(symbol, words(act, seen, pitch));
    }
    draft.grammar(&grammar);
}

/// A number without the noise of its last digits.
fn rounded(value: f64) -> f64 {
    libm::round(value * 1e9) / 1e9
}

/// The words for an act. Lengths are multiplied by `seen`; turns about another axis than z are pitches in the direction
/// of the sign of `pitch`, or nothing for 0.
fn words(act: Act, seen: f64, pitch: f64) -> String {
    let length = |word: &str, length: f64| match length {
        LENGTH => word.to_owned(),
        _ => format!("{word} {}", number(rounded(length * seen))),
    };
    let turn = |left: &str, right: &str, by: f64| match by {
        0.0 => String::new(),
        _ if by < 0.0 => format!("{right} {}", number(-by)),
        _ => format!("{left} {}", number(by)),
    };
    match act {
        Act::Draw(by) => length("draw", by),
        Act::Move(by) => length("move", by),
        Act::Push => "open branch".into(),
        Act::Pop => "close branch".into(),
        Act::Rotate(Axis::Z, by) => turn("turn left", "turn right", by),
        Act::Rotate(_, by) => turn("pitch up", "pitch down", by * pitch),
        Act::Left => "turn left".into(),
        Act::Right => "turn right".into(),
        Act::Nothing => String::new(),
    }
}

#[cfg(test)]
mod tests;
