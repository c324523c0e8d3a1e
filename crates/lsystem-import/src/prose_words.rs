//! Words of languages beside words of symbols, and the weights of rules.

use lsystem_base::decimal;

/// Whether a text is words of a language, not of symbols.
pub(super) fn is_prose(text: &str) -> bool {
    let mut words = text.split_whitespace().peekable();
    let first = words.next().unwrap_or_default();
    let several = words.peek().is_some();
    core::iter::once(first).chain(words).any(|word| is_language(word, if several { 3 } else { 4 }))
}

/// Whether a word is of a language: letters only, at least three small ones, and this many different letters.
pub(super) fn is_language(word: &str, different: usize) -> bool {
    let word = word.trim_matches(|c: char| !c.is_alphanumeric());
    let word = word.strip_suffix("'s").or_else(|| word.strip_suffix("’s")).unwrap_or(word);
    let small = word.chars().filter(|c| c.is_lowercase()).count();
    small >= 3
        && word.chars().all(|c| c.is_alphabetic() || matches!(c, '-' | '\'' | '’' | '.' | '/'))
        && word.len() < 60
        && lsystem_base::sorted::set(word.chars().filter(|c| c.is_alphabetic())).len() >= different
        // Capitals stand at the start or everywhere.
        && word.chars().skip(1).filter(|c| c.is_uppercase()).count() == 0
}

/// The successor and the weight of a rule's right side: `FF : 0.3`, `FF (30 %)`, `(0.5) FF`, `.33 FF`, `FF 0.5`.
pub(super) fn weighted(to: &str) -> (&str, Option<f64>) {
    let to = to.trim();
    // Behind a colon, a comma or a semicolon.
    if let Some(at) = to.rfind([':', ',', ';', '|'])
        && let Some(weight) = weight(&to[at + 1..])
        && (to[at..].starts_with(':') || to[at + 1..].starts_with(' '))
    {
        return (to[..at].trim_end(), Some(weight));
    }
    // In brackets at the end or at the start.
    for (open, close) in [('(', ')'), ('[', ']'), ('{', '}')] {
        if to.ends_with(close)
            && let Some(at) = to.rfind(open)
            && to[..at].ends_with(char::is_whitespace)
            && let Some(weight) = weight(&to[at + 1..to.len() - 1])
        {
            return (to[..at].trim_end(), Some(weight));
        }
        if to.starts_with(open)
            && let Some(end) = to.find(close)
            && to[end + 1..].starts_with(char::is_whitespace)
            && let Some(weight) = weight(&to[1..end])
        {
            return (to[end + 1..].trim_start(), Some(weight));
        }
    }
    // A number with a point or a percent sign, apart.
    if let Some(at) = to.rfind(char::is_whitespace) {
        let (before, last) = (to[..at].trim_end(), to[at..].trim_start());
        if last == "%"
            && let Some(cut) = before.rfind(char::is_whitespace)
            && let Some(weight) = weight(&to[cut..])
        {
            return (before[..cut].trim_end(), Some(weight));
        }
        if last.contains(['.', '%'])
            && let Some(weight) = weight(last)
        {
            let said = ["with probability", "probability", "prob.", "prob", "weight", "p =", "p=", "@"];
            let before = said.iter().find_map(|word| before.strip_suffix(word)).unwrap_or(before);
            return (before.trim_end_matches([' ', ',']), Some(weight));
        }
    }
    if let Some((head, rest)) = to.split_once(':')
        && head.contains(['.', '%'])
        && !rest.trim().is_empty()
        && let Some(weight) = weight(head)
    {
        return (rest.trim(), Some(weight));
    }
    if let Some(end) = to.find(char::is_whitespace)
        && to[..end].contains(['.', '%'])
        && let Some(weight) = weight(to[..end].trim_end_matches([':', '→']))
    {
        return (to[end..].trim_start(), Some(weight));
    }
    (to, None)
}

/// A symbol with a weight in parentheses: `F(0.6)`.
pub(super) fn weighted_symbol(from: &str) -> (&str, Option<f64>) {
    let inside = from.strip_suffix(')').and_then(|rest| rest.split_once('('));
    match inside.and_then(|(symbol, inside)| Some((symbol, weight(inside).filter(|weight| *weight <= 1.0)?))) {
        Some((symbol, weight)) if symbol.chars().count() == 1 => (symbol, Some(weight)),
        _ => (from, None),
    }
}

/// The successors of a rule's right side, with their weights: one, or alternatives between upright strokes. A stroke that
/// stands between blanks as other symbols do is a symbol.
pub(super) fn alternatives(to: &str, weight: Option<f64>) -> Vec<(&str, Option<f64>)> {
    let found: Vec<(&str, Option<f64>)> = to.split(" | ").map(|part| bare(part, weight)).collect();
    let is_word = |(word, _): &(&str, Option<f64>)| !word.is_empty() && !word.contains([' ', '|']);
    if found.len() > 1 && found.iter().all(is_word) { found } else { vec![bare(to, weight)] }
}

/// A successor without quotes and signs of nothing, and its weight.
fn bare(to: &str, weight: Option<f64>) -> (&str, Option<f64>) {
    let (word, own) = weighted(to);
    let word = word.trim_matches(['"', '`', '“', '”', '\'']).trim();
    (if EMPTY.contains(&word) { "" } else { word }, own.or(weight))
}

/// Signs of an empty successor.
const EMPTY: [&str; 8] = ["ε", "λ", "∅", "ϵ", "epsilon", "*", "\"\"", "''"];

/// A weight: `0.3`, `.3`, `30 %`, `1/3`, `p = 0.3`, `prob. 0.3`.
pub(super) fn weight(text: &str) -> Option<f64> {
    let mut text = text.trim();
    for word in ["probability", "prob.", "prob", "weight", "p"] {
        if let Some(rest) = text.strip_prefix(word) {
            text = rest.trim_start().trim_start_matches(['=', ':', ' ']);
            break;
        }
    }
    let (digits, percent) = match text.strip_suffix('%') {
        Some(digits) => (digits.trim_end(), true),
        None => (text, false),
    };
    let number = |text: &str| {
        let text = text.trim();
        let plain = !text.is_empty() && text.chars().all(|c| c.is_ascii_digit() || c == '.' || c == ',');
        plain.then(|| decimal::read(&text.replace(',', "."))).flatten()
    };
    let value = match digits.split_once('/') {
        Some((over, under)) => number(over)? / number(under)?,
        None => number(digits)?,
    };
    value.is_finite().then_some(if percent { value / 100.0 } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_in_every_usual_place() {
        for (to, expected, weight) in [
            ("F[+F]F : 0.9", "F[+F]F", Some(0.9)),
            ("F[+F]F (90 %)", "F[+F]F", Some(0.9)),
            ("(0.5) FF", "FF", Some(0.5)),
            (".33 F[+F]", "F[+F]", Some(0.33)),
            ("FF 0.5", "FF", Some(0.5)),
            ("FF 30%", "FF", Some(0.3)),
            ("FF 30 %", "FF", Some(0.3)),
            ("FF, p = 1/4", "FF", Some(0.25)),
            ("FF with probability 0.2", "FF", Some(0.2)),
            ("F(0.5)F", "F(0.5)F", None),
            ("F+F", "F+F", None),
            ("A 1", "A 1", None),
            ("F:F", "F:F", None),
        ] {
            assert_eq!(weighted(to), (expected, weight), "{to}");
        }
    }

    #[test]
    fn words_of_languages() {
        for (text, expected) in [
            ("F+F--F", false),
            ("fff F-F", false),
            ("hello", true),
            ("abaab", false),
            ("the rule", true),
            ("FX", false),
            ("aF + bF", false),
            ("XYFXf", false),
        ] {
            assert_eq!(is_prose(text), expected, "{text}");
        }
    }
}
