//! Rules as people write them, and the lines of a text.

/// Arrows of rules, longer ones first.
pub(super) const ARROWS: [&str; 15] =
    ["|->", "--->", "==>", "-->", "::=", "->", "=>", ":=", "→", "⟶", "⇒", "⟹", "↦", "➔", "➝"];
/// Arrows of LaTeX.
const COMMANDS: [&str; 4] = ["\\longrightarrow", "\\rightarrow", "\\mapsto", "\\to"];
/// Signs that are arrows where only a rule can stand. The last ones are also of labels and contexts.
const SIGNS: [&str; 3] = ["=", ":", ">"];

/// Splits a rule at its arrow into the predecessor and the successor, without white space at their ends.
pub(super) fn split_rule(rule: &str) -> Option<(&str, &str)> {
    // The first arrow behind the first character: the first character is a symbol.
    let first = rule.trim_start().chars().next()?;
    let from = rule.len() - rule.trim_start().len() + first.len_utf8();
    let first = |signs: &[&str]| {
        rule[from..].char_indices().find_map(|(at, _)| {
            let rest = &rule[from + at..];
            let mut arrows = COMMANDS.iter().chain(&ARROWS).chain(signs);
            arrows.find(|arrow| rest.starts_with(**arrow)).map(|arrow| (from + at, arrow.len()))
        })
    };
    let (at, length) = first(&SIGNS[..1]).or_else(|| first(&SIGNS))?;
    Some((rule[..at].trim(), rule[at + length..].trim()))
}
