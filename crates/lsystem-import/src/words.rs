//! Values behind labels in running text, as in `axiom X, angle 25°, n = 5`.

use lsystem_base::decimal;
use lsystem_syntax::line_of;
use lsystem_syntax::look_alike;

/// Ends a line of a formula. The text itself has no `\r`.
const FORMULA_LINE_END: &str = "\r\n";

/// The line of the text from which [`plain`] made `text`, for a place in `text`; from 1.
pub(super) fn original_line(text: &str, at: usize) -> usize {
    line_of(text, at) - text[..at].matches(FORMULA_LINE_END).count()
}

/// Text in which typographic look-alikes, LaTeX's commands and markup are replaced. Places in the text change, lines do
/// not.
pub(super) fn plain(text: &str) -> String {
    let mut plain: String = text.chars().map(|ch| look_alike(ch).unwrap_or(ch)).collect();
    for (command, meaning) in [
        ("&gt;", ">"),
        ("&lt;", "<"),
        ("\\longrightarrow", "→"),
        ("\\Rightarrow", "→"),
        ("\\rightarrow", "→"),
        ("\\mapsto", "→"),
        ("\\to", "→"),
        ("-->", "→"),
        ("->", "→"),
        ("=>", "→"),
        ("\\omega", "ω"),
        ("\\delta", "δ"),
        ("\\theta", "θ"),
        ("^\\circ", "°"),
        ("^{\\circ}", "°"),
        ("\\circ", "°"),
        ("\\degree", "°"),
        ("\\quad", " "),
        ("\\lbrack", "["),
        ("\\rbrack", "]"),
        ("\\text", ""),
        ("\\mathrm", ""),
        ("\\texttt", ""),
        // The end of a line in a formula, not in the text.
        ("\\\\", FORMULA_LINE_END),
        ("\\,", " "),
        ("\\;", " "),
        ("$", ""),
        ("&", ""),
    ] {
        if plain.contains(command) {
            plain = plain.replace(command, meaning);
        }
    }
    plain
}

/// The text behind the first of some labels, which stand as whole words and may be followed by `:`, `=` or `is`.
pub(super) fn behind<'a>(text: &'a str, labels: &[&str]) -> Option<&'a str> {
    let lower = text.to_ascii_lowercase();
    let mut best: Option<usize> = None;
    for label in labels {
        let mut at = 0;
        while let Some(found) = lower[at..].find(label) {
            let (start, end) = (at + found, at + found + label.len());
            at = end;
            let is_part = |ch: Option<char>| ch.is_some_and(|ch| ch.is_alphanumeric() || ch == '_');
            // Only `axiom` and `angle` are labels without a separator.
            let bare = matches!(*label, "axiom" | "angle" | "order" | "iterations" | "generations");
            let separated = lower[end..].trim_start().starts_with([':', '=']);
            let before = lower[..start].chars().next_back();
            if is_part(before) || is_part(lower[end..].chars().next()) || !(bare || separated) {
                continue;
            }
            best = Some(best.map_or(end, |known| known.min(end)));
            break;
        }
    }
    let rest = text[best?..].trim_start();
    let rest = rest.strip_prefix([':', '=']).or_else(|| rest.strip_prefix("is ")).unwrap_or(rest);
    Some(rest.trim_start())
}

/// The number behind the first of some labels.
pub(super) fn number(text: &str, labels: &[&str]) -> Option<f64> {
    let rest = behind(text, labels)?;
    let rest = rest.trim_start_matches(['(', '{', '~', '≈', ' ']);
    let end = rest.find(|ch: char| !ch.is_ascii_digit() && ch != '.' && ch != '-').unwrap_or(rest.len());
    let digits = rest[..end].trim_end_matches(['.', '-']);
    decimal::read(digits)
}
