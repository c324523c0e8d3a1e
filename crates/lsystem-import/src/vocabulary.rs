//! The words of all readers: one table of meanings, `vocabulary.txt`, with the words of many languages.

use std::collections::HashMap;
use std::sync::LazyLock;

/// A row of the table. The first ones are parts of a system, which labels, keys, columns and options name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    Axiom,
    /// All rules.
    Rules,
    /// One rule, whose predecessor may stand in the key.
    Rule,
    LeftAngle,
    RightAngle,
    Angle,
    Heading,
    Iterations,
    Name,
    /// By how much `>` and `<` change lengths.
    LengthFactor,
    Ignore,
    /// The length of a step, which changes only the size.
    Step,
    /// What symbols do.
    Meanings,
    Weight,
    Successor,
    Predecessor,
    Turn,
    Left,
    Right,
    Push,
    Pop,
    PitchDown,
    PitchUp,
    RollLeft,
    RollRight,
    Roll,
    Pitch,
    Round,
    NoLine,
    Move,
    Draw,
    Nothing,
    Connector,
    Arrow,
    Filler,
    Numbers,
    AddsRule,
    AddsToList,
    SetsAxiom,
    SetsAngle,
    Runs,
    Harmless,
    Code,
    Degrees,
    Radians,
    Turns,
    /// Words of cpfg, the last row.
    Cpfg,
}

/// The rows of labels, in the order of the table.
const LABELS: [Key; 13] = [
    Key::Axiom,
    Key::Rules,
    Key::Rule,
    Key::LeftAngle,
    Key::RightAngle,
    Key::Angle,
    Key::Heading,
    Key::Iterations,
    Key::Name,
    Key::LengthFactor,
    Key::Ignore,
    Key::Step,
    Key::Meanings,
];

/// The rows of a word or of all words of a phrase, as bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Rows(u64);

impl Rows {
    pub(super) fn has(self, key: Key) -> bool {
        self.0 & (1 << key as u32) != 0
    }
}

/// The rows by word, folded; and the words of each row as they stand.
struct Table {
    rows: HashMap<String, Rows>,
    words: Vec<Vec<&'static str>>,
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let mut table = Table { rows: HashMap::new(), words: Vec::new() };
    for line in include_str!("vocabulary.txt").lines().filter(|line| !line.starts_with('#') && !line.is_empty()) {
        match line.strip_prefix("  ").and_then(|line| line.split_once(' ')) {
            None => table.words.push(Vec::new()),
            Some((_, words)) => {
                let row = table.words.len().saturating_sub(1);
                for word in words.split(", ") {
                    table.rows.entry(fold(word)).or_default().0 |= 1 << row;
                    table.words[row].push(word);
                }
            }
        }
    }
    table
});

/// Names of characters in LaTeX and HTML.
static SIGNS: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| {
    let lines = include_str!("signs.txt").lines().filter_map(|line| line.split_once(' '));
    let plain = |sign| match sign {
        "blank" => " ",
        "line" => "\n",
        "nothing" => "",
        sign => sign,
    };
    lines.flat_map(|(sign, names)| names.split(", ").map(move |name| (name, plain(sign)))).collect()
});

/// The character that a command of LaTeX or an entity of HTML stands for.
pub(super) fn sign(name: &str) -> Option<&'static str> {
    SIGNS.get(name).copied()
}

/// A word without capitals, blanks and signs.
fn fold(word: &str) -> String {
    word.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The words of a row, as the table has them.
pub(super) fn words(key: Key) -> &'static [&'static str] {
    TABLE.words.get(key as usize).map_or(&[], Vec::as_slice)
}

/// The rows that have a word.
pub(super) fn rows(word: &str) -> Rows {
    TABLE.rows.get(&fold(word)).copied().unwrap_or_default()
}

/// The rows that have a word of a phrase, or up to three words that stand together.
pub(super) fn rows_within(phrase: &str) -> Rows {
    let words: Vec<&str> = phrase.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let mut found = Rows::default();
    for at in 0..words.len() {
        for length in 1..=3.min(words.len() - at) {
            found.0 |= rows(&words[at..at + length].concat()).0;
        }
        // Chinese and Japanese have no blanks between words.
        let letters: Vec<char> = words[at].chars().take(200).collect();
        if letters.iter().any(|c| *c > '\u{2e7f}') {
            for (from, length) in (0..letters.len()).flat_map(|from| (1..=4).map(move |length| (from, length))) {
                found.0 |= letters.get(from..from + length).map_or(0, |part| rows(&String::from_iter(part)).0);
            }
        }
    }
    found
}

/// The part of a system that a key, a variable or a label names.
pub(super) fn key(name: &str) -> Option<Key> {
    let word = fold(name);
    let found = TABLE.rows.get(&word).copied().unwrap_or_default();
    if let Some(key) = LABELS.into_iter().find(|key| found.has(*key)) {
        return Some(key);
    }
    if word.len() > 30 {
        return None;
    }
    // Parts of longer names: `kochAxiom`, `axiom_text`, `num_rules` not.
    let counts =
        ["num", "count", "number", "max", "min", "is", "has", "total"].iter().any(|part| word.starts_with(part));
    if counts {
        return None;
    }
    let ends = |parts: &[&str]| parts.iter().any(|part| word.ends_with(part));
    if ends(&["axiom"]) || word.starts_with("axiom") {
        return Some(Key::Axiom);
    }
    if ends(&["productionrules", "rules", "productions"]) || word.starts_with("rules") && word.len() < 8 {
        return Some(Key::Rules);
    }
    let numbered = |stem: &str| {
        word.strip_prefix(stem).is_some_and(|rest| rest.chars().count() <= 2 && rest.chars().all(char::is_alphanumeric))
    };
    if numbered("rule") || numbered("production") || word.strip_suffix("rule").is_some_and(|rest| rest.len() == 1) {
        return Some(Key::Rule);
    }
    if ends(&["turnangle", "turningangle"]) {
        return Some(Key::Angle);
    }
    if ends(&["iterations", "generations"]) {
        return Some(Key::Iterations);
    }
    None
}

/// Whether a word for an angle may name another one than that of turns.
pub(super) fn is_vague(word: &str) -> bool {
    ["rotation", "turn", "degrees", "alpha", "α", "phi", "φ"].contains(&&*fold(word))
}

/// The letter of a key such as `ruleF`, `rule_a` or `F_rule`, as it stands there.
pub(super) fn letter_of(key: &str) -> Option<char> {
    let lower = key.to_ascii_lowercase();
    let stem = ["rules", "rule", "production"].iter().find(|stem| lower.starts_with(**stem));
    let rest = match stem {
        Some(stem) => key.get(stem.len()..)?,
        None => key.get(..lower.find("rule")?)?,
    };
    let mut letters = rest.trim_matches('_').chars();
    let letter = letters.next().filter(|letter| letter.is_alphabetic())?;
    letters.next().is_none().then_some(letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_row() {
        assert_eq!((TABLE.words.len(), words(Key::Cpfg)[0]), (Key::Cpfg as usize + 1, "lsystem"));
        for (word, expected) in [
            ("Startwort", Key::Axiom),
            ("turn_angle", Key::Angle),
            ("количество итераций", Key::Iterations),
            ("規則", Key::Rules),
        ] {
            assert_eq!(key(word), Some(expected), "{word}");
        }
        assert!(LABELS.iter().enumerate().all(|(at, key)| *key as usize == at));
        assert!(words(Key::Numbers)[2] == "three" && rows("Successor").has(Key::Successor));
        let turns = rows_within("turn counter-clockwise by 30");
        assert!(turns.has(Key::Turn) && turns.has(Key::Left) && rows_within("向左转").has(Key::Left));
    }
}
