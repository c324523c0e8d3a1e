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
        let (answer, link) = (&one.answer, one.answer.link.as_deref().unwrap_or_default());
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

/// Whether a spreadsheet may read a text as a formula, after what it may leave out: quotes, white space and characters
/// that are not seen.
fn is_formula(text: &str) -> bool {
    let is_unseen = |c: char| c.is_whitespace() || c.is_control() || "\u{ad}\u{feff}".contains(c);
    let is_format = |c: char| ('\u{200b}'..='\u{200f}').contains(&c) || ('\u{202a}'..='\u{2069}').contains(&c);
    let is_quote = |c: char| "\"'`\u{2018}\u{2019}\u{201c}\u{201d}".contains(c);
    let begins_a_cell = text.starts_with(['\t', '\r', '\n']);
    let seen = text.trim_start_matches(|c| is_unseen(c) || is_format(c) || is_quote(c));
    // With the full-width forms, which some spreadsheets read alike, and the bar of links between programs.
    begins_a_cell
        || seen.starts_with(['=', '+', '-', '@', '|', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}', '\u{ff5c}'])
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
        ] {
            assert!(cell(text).starts_with("\"'"), "{text:?}: {}", cell(text));
        }
        assert_eq!(cell("Ada, \"at\" home"), "\"Ada, \"\"at\"\" home\"");
        for text in ["Ada", "", " Ada", "1-2", "O'Neill=", "'s"] {
            assert_eq!(cell(text), text);
        }
    }
}
