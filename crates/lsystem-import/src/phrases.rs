//! What symbols do, in words: `+ means turn right`, `0: draw a line segment`, `[: push position and angle`.

use crate::angle::angle;

/// The actions that a phrase names, in the words of custom symbols, and the angle of its turns.
pub(super) fn actions(phrase: &str) -> Option<(Vec<&'static str>, Option<f64>)> {
    let lower = phrase.to_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| contains(&lower, word));
    let mut found = Vec::new();
    let mut turn = None;
    // In the order of their places: `push position and angle, turn left 45 degrees`.
    for part in
        lower.split([',', ';', '&']).flat_map(|part| part.split(" and then ")).flat_map(|part| part.split(" then "))
    {
        let has = |words: &[&str]| words.iter().any(|word| contains(part, word));
        let turns = has(&[
            "turn", "turns", "rotate", "rotates", "rotation", "drehe", "drehen", "tourner", "tourne", "girar", "gira",
        ]);
        let left = has(&[
            "left",
            "counterclockwise",
            "counter-clockwise",
            "anticlockwise",
            "anti-clockwise",
            "ccw",
            "links",
            "gauche",
            "izquierda",
        ]);
        let right = has(&["right", "clockwise", "cw", "rechts", "droite", "derecha"]) && !left;
        let action = if has(&["push", "save", "store", "remember", "speichern", "sauvegarder", "empiler", "guardar"]) {
            "open branch"
        } else if has(&[
            "pop",
            "restore",
            "return to",
            "recall",
            "go back to",
            "wiederherstellen",
            "restaurer",
            "dépiler",
        ]) {
            "close branch"
        } else if has(&["pitch down"]) {
            "pitch down"
        } else if has(&["pitch up"]) {
            "pitch up"
        } else if has(&["roll left"]) || has(&["roll"]) && left {
            "roll left"
        } else if has(&["roll right"]) || has(&["roll"]) && right {
            "roll right"
        } else if has(&["turn around", "turn round", "reverse", "turn back", "180"]) && !has(&["pitch", "roll"]) {
            "turn round"
        } else if left && (turns || angle_in(part).is_some()) {
            "turn left"
        } else if right && (turns || angle_in(part).is_some()) {
            "turn right"
        } else if has(&["without drawing", "without line", "pen up", "no line", "don't draw", "not draw"])
            || has(&["move", "moves", "bewege", "avancer sans"]) && !has(&["draw", "drawing", "line", "zeichne"])
        {
            "move"
        } else if has(&[
            "draw",
            "draws",
            "drawing",
            "forward",
            "line",
            "segment",
            "zeichne",
            "zeichnen",
            "vorwärts",
            "avancer",
            "avance",
            "dessiner",
            "dibujar",
            "avanzar",
            "adelante",
        ]) {
            "draw"
        } else {
            continue;
        };
        if action.starts_with("turn ") && action != "turn round" && turn.is_none() {
            turn = angle_in(part);
        }
        found.push(action);
    }
    if found.is_empty()
        && has(&[
            "nothing",
            "no action",
            "ignore",
            "ignored",
            "placeholder",
            "not drawn",
            "no effect",
            "do not draw",
            "control",
            "nichts",
            "rien",
            "nada",
        ])
    {
        return Some((found, None));
    }
    (!found.is_empty()).then_some((found, turn))
}

/// Whether a text contains a word or words as a whole.
fn contains(text: &str, words: &str) -> bool {
    text.match_indices(words).any(|(at, _)| {
        let part = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        !part(text[..at].chars().next_back()) && !part(text[at + words.len()..].chars().next())
    })
}

/// The first number of a phrase as an angle.
fn angle_in(phrase: &str) -> Option<f64> {
    let at = phrase.find(|c: char| c.is_ascii_digit() || c == 'π')?;
    angle(&phrase[at..]).ok().map(|(degrees, ..)| degrees)
}

/// Words between symbols and what they do.
const CONNECTORS: [&str; 40] = [
    "and",
    "or",
    "both",
    "mean",
    "means",
    "is",
    "are",
    "stands",
    "stand",
    "for",
    "denotes",
    "denote",
    "represents",
    "represent",
    "symbol",
    "symbols",
    "the",
    "letter",
    "letters",
    "variables",
    "variable",
    "character",
    "characters",
    "command",
    "constants",
    "where",
    "here",
    "with",
    "to",
    "->",
    "→",
    "=",
    ":",
    "-",
    "–",
    "und",
    "bedeutet",
    "bedeuten",
    "signifie",
    "significa",
];

/// Longer words are no symbols, in bytes.
const LONGEST: usize = 100;

/// The symbols at the start of a sentence, and the place where what they do begins; `None` if it begins with other words.
pub(super) fn symbols(sentence: &str) -> Option<(Vec<char>, usize)> {
    let mut found: Vec<char> = Vec::new();
    let mut at = 0;
    let mut connected = false;
    loop {
        let rest = &sentence[at..];
        let rest_at = at + rest.len() - rest.trim_start().len();
        let rest = rest.trim_start();
        let near = &rest[..rest.floor_char_boundary(LONGEST)];
        let end = near.find(char::is_whitespace).unwrap_or(near.len());
        // A longer list is no sentence.
        if end == 0 || found.len() > 20 {
            return None;
        }
        if end == near.len() && near.len() < rest.len() {
            return (!found.is_empty() && connected).then_some((found, rest_at));
        }
        let token = &rest[..end];
        let bare = token.trim_matches(['"', '\'', '`', '“', '”', '‘', '’', '*', '•']);
        let bare = bare.strip_prefix('(').filter(|bare| bare.chars().count() > 1).unwrap_or(bare);
        let own = bare.strip_suffix([',', ':', '=', '/', ';', ')']).filter(|own| !own.is_empty()).unwrap_or(bare);
        let own = own.trim_matches(['"', '\'', '`', '“', '”', '‘', '’', '*']);
        let mut letters = if own.is_empty() { token.chars() } else { own.chars() };
        let (first, second) = (letters.next(), letters.next());
        if CONNECTORS.contains(&&*token.to_lowercase()) && !found.is_empty()
            || matches!(&*token.to_lowercase(), "the" | "symbol" | "symbols" | "letter" | "where" | "here" | "letters")
        {
            connected |= !matches!(token, "and" | "or" | "und" | "the" | "symbol" | "letter");
        } else if let (Some(first), None) = (first, second)
            && !connected
        {
            found.push(first);
            connected |= bare.ends_with([':', '=']) && bare.chars().count() > 1;
        } else if let Some((head, tail)) = own.split_once(['/', ',', '|'])
            && head.chars().count() == 1
            && tail.chars().count() == 1
            && !connected
        {
            found.extend(head.chars().chain(tail.chars()));
        } else {
            return (!found.is_empty() && connected).then_some((found, rest_at));
        }
        at = rest_at + end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meanings() {
        for (sentence, expected) in [
            ("+ means turn right", Some(("+", "turn right", None))),
            ("A and B both mean draw forward", Some(("AB", "draw", None))),
            ("B mean move forward", Some(("B", "move", None))),
            ("0: draw a line segment ending in a leaf", Some(("0", "draw", None))),
            ("[: push position and angle, turn left 45 degrees", Some(("[", "open branch, turn left", Some(45.0)))),
            ("]: pop position and angle, turn right by 45°", Some(("]", "close branch, turn right", Some(45.0)))),
            ("X: no action", Some(("X", "", None))),
            ("\"F\", \"G\" : move forward while drawing", Some(("FG", "draw", None))),
            ("− → turn left 60°", Some(("−", "turn left", Some(60.0)))),
            ("A plant is drawn", None),
            ("It is nice", None),
        ] {
            let found = symbols(sentence).and_then(|(symbols, at)| {
                let (actions, angle) = actions(&sentence[at..])?;
                Some((symbols.into_iter().collect::<String>(), actions.join(", "), angle))
            });
            let expected = expected.map(|(symbols, actions, angle)| (symbols.to_owned(), actions.to_owned(), angle));
            assert_eq!(found, expected, "{sentence}");
        }
    }
}
