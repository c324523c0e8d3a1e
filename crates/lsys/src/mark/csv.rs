//! Marks as a table for spreadsheets (CSV).

use super::Marked;
use lsystem::derive::Tally;
use std::io::{self, Write};

/// Writes a row for each answer.
///
/// # Errors
/// As the writer.
pub(super) fn write(out: &mut dyn Write, marked: &[Marked]) -> io::Result<()> {
    writeln!(out, "name,by,solved,agreement_percent,symbols,target_segments,own_segments,remark,link")?;
    for one in marked {
        let count = |count: &Option<Tally>| count.as_ref().map(Tally::to_string).unwrap_or_default();
        let [target, own] = one.mark.as_ref().map(|mark| mark.segments.each_ref().map(count)).unwrap_or_default();
        let solved = if one.is_solved() { "yes" } else { "no" };
        let (percent, symbols) = (one.percent(), one.symbols());
        let percent = percent.trim_end_matches(" %");
        let (answer, link) = (&one.answer, one.answer.link.as_deref().unwrap_or_default());
        let row = [&answer.name, &answer.by, solved, percent, &symbols, &target, &own, &one.words, link];
        writeln!(out, "{}", row.map(cell).join(","))?;
    }
    Ok(())
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
