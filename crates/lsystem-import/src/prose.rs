//! Systems in running text, lists and formulas, as in papers, encyclopedias and books.
//!
//! ```text
//! axiom X, angle 25°, rules (X → F+[[X]-X]-F[-FX]+X), (F → FF)
//! ```

use crate::draft::Draft;
use crate::plain::Plain;
use crate::source::Source;
use crate::words::{behind, number, original_line, plain};
use lsystem_base::decimal;

const AXIOM: &[&str] = &["axiom", "start", "initiator", "initial string", "initial word", "initial axiom", "ω", "s0"];
const ANGLE: &[&str] = &["angle", "δ", "delta", "θ", "theta", "turning angle"];
const ITERATIONS: &[&str] =
    &["iterations", "generations", "derivation length", "depth", "order", "recursion", "n", "steps", "level", "levels"];

/// A text with more arrows is no description of a system.
const MOST_RULES: usize = 1000;
/// The most bytes of a rule before its arrow.
const LONGEST_START: usize = 1000;

/// Reads one system: an axiom, and at least one rule with an arrow.
pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    // Objects and markup have readers of their own.
    if text.trim_start().starts_with(['{', '<']) {
        return None;
    }
    let text = &plain(text);
    let rules = rules(text);
    // Without a label, the axiom stands alone on the line before the first rule, as in the captions of ABOP.
    let caption = || caption(text, rules.first()?.0, number(text, ANGLE).is_some());
    let axiom = behind(text, AXIOM).map(symbols).filter(|axiom| !axiom.is_empty()).or_else(caption)?;
    if rules.is_empty() {
        return None;
    }
    let title = text.lines().next().map(str::trim).filter(|line| is_title(line)).unwrap_or("");
    let mut draft = Plain::new(source, title.trim_end_matches([':', '.']), 1);
    draft.start(&axiom);
    let is_plain = rules.iter().all(|(_, predecessor, _)| predecessor.chars().count() == 1);
    if !is_plain {
        // Contexts, parameters and conditions are written as in our own notation, or not at all.
        let lines = text.lines().filter(|line| line.contains('→') || is_constant(line));
        draft.definition().rules = lines.map(str::trim).collect::<Vec<_>>().join("\n");
        draft.definition().axiom.clone_from(&axiom);
    }
    for (at, predecessor, successor) in rules.iter().filter(|_| is_plain) {
        let mut letters = predecessor.chars();
        if let (Some(letter), None) = (letters.next(), letters.next()) {
            let several = rules.iter().filter(|(_, other, _)| other == predecessor).count() > 1;
            draft.produce(letter, successor, several.then_some(1.0));
            if several {
                draft.draft.note(
                    original_line(text, *at),
                    successor,
                    format!("`{letter}` has several rules; each is as likely as the others"),
                );
            }
        }
    }
    match number(text, ANGLE).or_else(|| degrees(text)) {
        Some(angle) => draft.definition().angle = angle,
        None => {
            draft.definition().angle = 90.0;
            draft.draft.note(1, "", "There is no angle; 90° is taken");
        }
    }
    if let Some(iterations) = number(text, ITERATIONS) {
        draft.iterate(iterations);
    }
    for letter in drawing_letters(text) {
        if draft.symbols().contains(&letter) && letter != 'F' {
            draft.draft.meaning(letter, "draw");
        }
    }
    if is_plain {
        draft.draw_something();
    }
    Some(vec![draft.into_draft()])
}

/// Whether a line defines a constant of rules with parameters.
fn is_constant(line: &str) -> bool {
    let Some((name, value)) = line.split_once('=') else { return false };
    let name = name.trim();
    let label = [AXIOM, ANGLE, ITERATIONS].concat().contains(&name.to_ascii_lowercase().as_str());
    !label && !name.is_empty() && name.chars().all(char::is_alphanumeric) && decimal::read(value.trim()).is_some()
}

/// Whether a line is a title: words without an arrow and without a label.
fn is_title(line: &str) -> bool {
    line.chars().filter(|ch| ch.is_alphabetic()).count() > 3
        && !line.contains(['→', '=', '{', ','])
        && behind(line, AXIOM).is_none()
        && behind(line, ANGLE).is_none()
}

/// The first word of a text: symbols up to white space, a comma before a space, or the end of a sentence.
fn symbols(text: &str) -> String {
    let text = text.trim_start_matches(['"', '\'', '`', '“', '{', '<']);
    let line = text.lines().next().unwrap_or("");
    let end = line.find(", ").or_else(|| line.find("; ")).unwrap_or(line.len());
    let word = line[..end].trim_end_matches(['.', ',', ';', '"', '\'', '`', '”', '}', '>', ' ']);
    // An axiom may have blanks between its symbols, but not between words.
    let words: Vec<&str> = word.split_whitespace().collect();
    let short = words.iter().all(|word| word.chars().filter(|ch| ch.is_lowercase()).count() < 3);
    if short { words.concat() } else { words.first().map_or(String::new(), |word| (*word).to_owned()) }
}

/// The axiom of a caption: alone on the line before the first rule.
fn caption(text: &str, first: usize, has_angle: bool) -> Option<String> {
    let before = text[..first].trim_end_matches(|ch| ch != '\n').trim_end();
    let line = before.lines().next_back()?.trim();
    let plain = !line.is_empty() && line.len() <= 200 && !line.contains([' ', '=', ':', '.']);
    (has_angle && plain && line.contains(['F', 'X', 'L', 'A', 'S'])).then(|| line.to_owned())
}

/// The rules: the place of the arrow, the predecessor and the successor.
fn rules(text: &str) -> Vec<(usize, String, String)> {
    let mut rules = Vec::new();
    let arrows: Vec<usize> = text.match_indices('→').map(|(at, _)| at).take(MOST_RULES + 1).collect();
    if arrows.len() > MOST_RULES {
        return rules;
    }
    for (index, &at) in arrows.iter().enumerate() {
        // Equally long for every rule, so that the work stays in proportion to the text.
        let before = &text[text.ceil_char_boundary(at.saturating_sub(LONGEST_START))..at];
        let line = before.rsplit('\n').next().unwrap_or("");
        // The predecessor follows a label, a bracket or a separator.
        let parts = line.rsplit([',', ';', ' ', ':', '{']).filter(|part| !part.trim().is_empty());
        let predecessor = parts.clone().next().unwrap_or("").trim();
        let context = parts.clone().nth(1).is_some_and(|part| matches!(part.trim(), "<" | ">"));
        let predecessor = if context { line.trim() } else { predecessor };
        let opened = predecessor.starts_with('(');
        let predecessor =
            predecessor.trim_start_matches(['(', '"', '\'', '`', '•', '*']).trim_end_matches(['"', '\'', '`']);
        if predecessor.is_empty() {
            continue;
        }
        let from = at + '→'.len_utf8();
        let to = arrows.get(index + 1).copied().unwrap_or(text.len());
        let rest = &text[from..to];
        let rest = rest.split('\n').find(|line| !line.trim().is_empty()).unwrap_or("");
        // In running text a rule ends at its bracket, or at a comma or semicolon before a blank.
        let mut depth = 0_i32;
        let mut end = rest.len();
        for (place, ch) in rest.char_indices() {
            depth += i32::from(ch == '(') - i32::from(ch == ')');
            let behind = &rest[place + ch.len_utf8()..];
            let separates = matches!(ch, ',' | ';') && (behind.starts_with(' ') || behind.is_empty());
            if (ch == ')' && depth < 0 && (opened || line.contains('('))) || separates {
                end = place;
                break;
            }
        }
        let mut successor = rest[..end].trim();
        // The next predecessor may stand on the same line without a comma.
        if end == rest.len() && to < text.len() && !text[from..to].contains('\n') {
            successor = successor.rsplit_once(' ').map_or(successor, |(own, _)| own.trim_end_matches([' ', ',', ';']));
        }
        let successor = successor.trim_matches(['"', '\'', '`']).trim_end_matches(['.', ' ', '}']);
        rules.push((at, predecessor.to_owned(), successor.split_whitespace().collect()));
    }
    rules
}

/// The first number before a sign of degrees.
fn degrees(text: &str) -> Option<f64> {
    let sign = text.find('°').or_else(|| text.find("degrees")).or_else(|| text.find(" deg"))?;
    let digits = text[..sign].trim_end();
    let start = digits
        .rfind(|ch: char| !ch.is_ascii_digit() && ch != '.')
        .map_or(0, |at| at + digits[at..].chars().next().map_or(1, char::len_utf8));
    decimal::read(&digits[start..])
}

/// The letters of `A and B both mean draw forward` and the like.
fn drawing_letters(text: &str) -> Vec<char> {
    let lower = text.to_ascii_lowercase();
    let Some(at) =
        lower.find("draw forward").or_else(|| lower.find("draws forward")).or_else(|| lower.find("draw a line"))
    else {
        return Vec::new();
    };
    let sentence = text[..at].rsplit(['.', '\n']).next().unwrap_or("");
    let words = sentence.split(|ch: char| !ch.is_alphanumeric());
    words.filter_map(|word| word.chars().next().filter(|ch| word.len() == ch.len_utf8() && ch.is_uppercase())).collect()
}
