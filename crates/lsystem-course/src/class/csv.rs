//! Marks as a table for spreadsheets (CSV).

use super::Marked;
use lsystem_derive::Tally;

/// A row for each answer. `has_variants`: with the number of each variant.
pub(super) fn csv(marked: &[Marked], has_variants: bool) -> String {
    let head = "name,by,solved,agreement_percent,symbols,target_segments,own_segments,remark,link";
    let mut table = head.to_owned() + if has_variants { ",variant\n" } else { "\n" };
    for one in marked {
        let count = |count: &Option<Tally>| count.as_ref().map(Tally::to_string).unwrap_or_default();
        let [target, own] = one.grade.as_ref().map(|grade| grade.segments.each_ref().map(count)).unwrap_or_default();
        let solved = if one.is_solved() { "yes" } else { "no" };
        let (percent, symbols, words) = (one.percent(), one.symbols(), one.words());
        let percent = percent.trim_end_matches(" %");
        let (answer, link) = (&one.answer, one.answer.link().unwrap_or_default());
        let row = [&answer.name, &answer.by, solved, percent, &symbols, &target, &own, &words, link];
        table += &row.map(cell).join(",");
        if has_variants {
            table += &format!(",{}", one.variant + 1);
        }
        table.push('\n');
    }
    table
}

/// A cell of a table. Spreadsheets take texts that begin like a formula for one; an apostrophe before it keeps them
/// texts.
fn cell(text: &str) -> String {
    let guard = if is_formula(text) { "'" } else { "" };
    match text.contains([',', '"', '\n', '\r', ';']) || !guard.is_empty() {
        true => format!("\"{guard}{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// What formulas begin with, also in the full-width forms that some spreadsheets read alike, and the bar of links between
/// programs.
const SIGNS: [char; 10] = ['=', '+', '-', '@', '|', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}', '\u{ff5c}'];

/// Whether a spreadsheet may read a text as a formula, after what it may leave out: quotes, white space, signs, and letters
/// that are not seen.
fn is_formula(text: &str) -> bool {
    let is_sign = |c: char| !(c.is_ascii_graphic() || c.is_alphanumeric() || SIGNS.contains(&c));
    let seen = text.trim_start_matches(|c| is_sign(c) || "\"'`\u{115f}\u{1160}\u{3164}\u{ffa0}".contains(c));
    text.starts_with(['\t', '\r', '\n']) || seen.starts_with(SIGNS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_no_formulas() {
        for text in [
            "=1",
            "+1",
            "-1",
            "@A",
            "\tA",
            "\rA",
            "\nA",
            "|A",
            "＝1",
            "＋1",
            "－1",
            "＠A",
            " =1",
            "\"=1",
            "' \"+1",
            "\u{200b}=1",
            "\u{fe0f}=1",
            "\u{115f}=1",
            "\u{2800}+1",
            "\u{34f}@A",
        ] {
            assert!(cell(text).starts_with("\"'"), "{text:?}: {}", cell(text));
        }
        assert_eq!(cell("Ada, \"at\" home"), "\"Ada, \"\"at\"\" home\"");
        for text in ["Ada", "", " Ada", "1-2", "O'Neill=", "'s"] {
            assert_eq!(cell(text), text);
        }
    }
}
