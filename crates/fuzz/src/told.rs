//! A language that no one speaks: all texts of the core pass through it, so that words which are still English in a
//! message were never told in the language of the reader.

use lsystem::base::words;

/// Words without which no English sentence is made.
const ENGLISH: [&str; 12] =
    ["the", "this", "is", "are", "must", "cannot", "there", "has", "have", "which", "needs", "read"];

const VOWELS: [(char, char); 5] = [('a', 'á'), ('e', 'ë'), ('i', 'ï'), ('o', 'ö'), ('u', 'û')];

/// Lets the core speak this language, for all targets.
pub(crate) fn speak() {
    words::set_reader(|text, _| Some(accented(text)));
}

/// A text with other vowels, but for code and places of arguments.
fn accented(text: &str) -> String {
    let (mut is_code, mut is_hole) = (false, false);
    let letter = |c: char| VOWELS.iter().find(|(own, _)| *own == c).map_or(c, |&(_, other)| other);
    text.chars()
        .map(|c| {
            match c {
                '`' => is_code = !is_code,
                '{' | '}' if !is_code => is_hole = c == '{',
                _ => {}
            }
            if is_code || is_hole { c } else { letter(c) }
        })
        .collect()
}

/// Checks a message: all its words are told, and all its arguments stand in it. What it quotes may have any words.
pub(crate) fn check(message: &str) {
    assert!(!message.is_empty());
    let quoted: String = message.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    let plain = quoted.split(|c: char| !c.is_alphanumeric()).find(|word| ENGLISH.contains(word));
    assert!(plain.is_none(), "the word {} is in no catalogue: {message}", plain.unwrap_or_default());
    assert!(!quoted.contains("{}") && !quoted.contains("{0}"), "an argument is missing: {message}");
}

/// Checks a diagnostic and its hint.
pub(crate) fn check_diagnostic(diagnostic: &lsystem::Diagnostic) {
    check(&diagnostic.message);
    diagnostic.hint.iter().for_each(|hint| check(hint));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn english_words_are_noticed_but_for_quoted_ones() {
        check(&accented("There is no function `this`"));
        assert!(std::panic::catch_unwind(|| check("There is no function `x`")).is_err());
        assert!(std::panic::catch_unwind(|| check("Nö füncün {}")).is_err());
    }
}
