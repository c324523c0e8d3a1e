//! Rules as people write them, and the lines of a text.

/// The arrows, longer ones first.
const ARROWS: [&str; 19] = [
    "\\longrightarrow",
    "\\rightarrow",
    "\\mapsto",
    "\\to",
    "--->",
    "-->",
    "==>",
    "->",
    "=>",
    "::=",
    ":=",
    "⟶",
    "→",
    "⇒",
    "⟹",
    "↦",
    "=",
    ":",
    ">",
];

/// Splits a rule at its arrow into the predecessor and the successor, without white space at their ends.
pub(super) fn split_rule(rule: &str) -> Option<(&str, &str)> {
    // The first arrow behind the first character: the first character is a symbol.
    let first = rule.trim_start().chars().next()?;
    let from = rule.len() - rule.trim_start().len() + first.len_utf8();
    let found = rule[from..].char_indices().find_map(|(at, _)| {
        let rest = &rule[from + at..];
        ARROWS.iter().find(|arrow| rest.starts_with(**arrow)).map(|arrow| (from + at, arrow.len()))
    });
    let (at, length) = found?;
    Some((rule[..at].trim(), rule[at + length..].trim()))
}
