//! What symbols do, in words: `+ means turn right`, `0: draw a line segment`, `[: push position and angle`.

use crate::angle::angle;
use crate::vocabulary::{Key, rows, rows_within};
use lsystem_base::number::number;

/// The actions that a phrase names, in the words of custom symbols, and the angle of its turns.
pub(super) fn actions(phrase: &str) -> Option<(Vec<&'static str>, Option<f64>)> {
    let lower = phrase.to_lowercase();
    let mut found = Vec::new();
    let mut turn = None;
    // In the order of their places: `push position and angle, turn left 45 degrees`.
    for part in
        lower.split([',', ';', '&']).flat_map(|part| part.split(" and then ")).flat_map(|part| part.split(" then "))
    {
        let rows = rows_within(part);
        let has = |key| rows.has(key);
        let left = has(Key::Left);
        let right = has(Key::Right) && !left;
        let angle = angle_in(part);
        let turns = has(Key::Turn) || angle.is_some();
        let action = match () {
            () if has(Key::Push) => "open branch",
            () if has(Key::Pop) => "close branch",
            () if has(Key::PitchDown) => "pitch down",
            () if has(Key::PitchUp) => "pitch up",
            () if has(Key::RollLeft) || has(Key::Roll) && left => "roll left",
            () if has(Key::RollRight) || has(Key::Roll) && right => "roll right",
            () if has(Key::Round) && !has(Key::Pitch) && !has(Key::Roll) => "turn round",
            () if left && turns => "turn left",
            () if right && turns => "turn right",
            () if has(Key::NoLine) || has(Key::Move) && !DRAWING.iter().any(|word| contains(part, word)) => "move",
            () if has(Key::Draw) => "draw",
            () => continue,
        };
        if action.starts_with("turn ") && action != "turn round" && turn.is_none() {
            turn = angle;
        }
        found.push(action);
    }
    if found.is_empty() && rows_within(&lower).has(Key::Nothing) {
        return Some((found, None));
    }
    (!found.is_empty()).then_some((found, turn))
}

/// The parts of a phrase that says what two symbols do: `push / pop state`, `turn left and right by 30°`.
pub(super) fn pair(phrase: &str) -> Option<(String, String)> {
    let (one, other) =
        ["/", " and ", " or ", ", ", " und ", " et ", " y "].iter().find_map(|sign| phrase.split_once(sign))?;
    let (first, angle) = actions(one)?;
    let opposite = |action: &str| match action {
        "open branch" => "close branch",
        "turn left" => "turn right",
        "turn right" => "turn left",
        "pitch down" => "pitch up",
        "pitch up" => "pitch down",
        "roll left" => "roll right",
        "roll right" => "roll left",
        _ => "",
    };
    // `turn left / right`: the second part lacks the first word.
    let verb = one.split_whitespace().next().unwrap_or_default();
    [other.to_owned(), format!("{verb} {other}")].into_iter().find_map(|other| {
        let (second, degrees) = actions(&other)?;
        let fits = first.len() == 1 && second.len() == 1 && opposite(first[0]) == second[0];
        let angle =
            degrees.filter(|_| angle.is_none()).map_or(String::new(), |degrees| format!(" {}°", number(degrees)));
        fits.then(|| (format!("{one}{angle}"), other))
    })
}

/// Words beside `move` that say that a line is drawn.
const DRAWING: [&str; 4] = ["draw", "drawing", "line", "zeichne"];

/// Whether a text contains a word as a whole.
fn contains(text: &str, word: &str) -> bool {
    text.split(|c: char| !c.is_alphanumeric()).any(|own| own == word)
}

/// The first number of a phrase as an angle.
fn angle_in(phrase: &str) -> Option<f64> {
    let at = phrase.find(|c: char| c.is_ascii_digit() || c == 'π')?;
    angle(&phrase[at..]).ok().map(|(degrees, ..)| degrees)
}

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
        let is_connector = rows(token).has(Key::Connector) || matches!(token, "->" | "→" | "=" | ":" | "-" | "–");
        if is_connector && !found.is_empty()
            || matches!(&*token.to_lowercase(), "the" | "symbol" | "symbols" | "letter" | "where" | "here" | "letters")
        {
            connected |= !found.is_empty() && !matches!(token, "and" | "or" | "und" | "the" | "symbol" | "letter");
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
            // In `[ / ]: push / pop`, the middle one only joins.
            if let [_, '/', _] = found[..] {
                found.remove(1);
            }
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
