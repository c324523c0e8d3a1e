//! Answers to exercises in tables with a column of links.

use crate::exercise::Exercise;
use lsystem_base::say;
use lsystem_files::{Link, read_link};
use lsystem_syntax::Definition;

/// The most cells of a row that are read.
const MAX_CELLS: usize = 1000;

/// An answer to an exercise.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Whose answer it is in the table, or where the answer stands.
    pub name: String,
    /// The name that the link gives, which anybody may write.
    pub by: String,
    /// The link, if it is one.
    pub link: Option<String>,
    /// The answer, or why there is none.
    pub student: Result<Definition, String>,
}

/// The answers to an exercise in a text: links one on each line, or a table with links in its cells. `exercise` is the
/// value of `x` in their links; `name` names answers without a name.
pub fn answers<'a>(text: &'a str, name: &'a str, exercise: &'a str) -> impl Iterator<Item = Answer> + 'a {
    let is_table = cells(text).nth(1).is_some();
    cells(text).zip(1..).filter_map(move |(cells, row)| {
        let name = if is_table { say!("{}, row {}", name, row) } else { name.to_owned() };
        of_row(&cells, &name, exercise)
    })
}

/// The value of `x` in the first link of an exercise in a text.
#[must_use]
pub fn exercise_in(text: &str) -> Option<String> {
    cells(text).flatten().find_map(|cell| veiled(&read_link(cell.trim())?))
}

/// The answer in a row of a table: of its links, the one to this exercise, or else the first. Its name is the first cell
/// beside the link, or else `name`. A package of several exercises keeps an answer to each; those to others are no
/// answers here.
fn of_row(cells: &[String], name: &str, exercise: &str) -> Option<Answer> {
    let key = Exercise::key(exercise);
    let links = cells.iter().enumerate().flat_map(|(at, cell)| links(cell).map(move |(text, link)| (at, text, link)));
    let mut links: Vec<_> = links.filter(|(.., link)| link.other("k").is_none_or(|other| other == key)).collect();
    let is_here = |link: &Link| link.other("k").is_some() || link.other("x") == Some(exercise);
    let chosen = links.iter().position(|(.., link)| is_here(link)).unwrap_or_default();
    let (at, text, link) = (chosen < links.len()).then(|| links.swap_remove(chosen))?;
    let other = cells.iter().enumerate().find(|(other, cell)| *other != at && !cell.trim().is_empty());
    let name = other.map_or(name, |(_, cell)| cell.trim()).to_owned();
    let by = link.other("by").unwrap_or_default().trim().to_owned();
    let student = match veiled(&link) {
        Some(other) if other != exercise => Err(say!("an answer to another exercise")),
        _ => match link.problems.first() {
            Some(problem) if link.definition == Definition::default() => Err(problem.message.clone()),
            _ => Ok(link.definition),
        },
    };
    Some(Answer { name, by, link: Some(text), student })
}

/// The links in a cell: one, or the lines of what a package keeps.
fn links(cell: &str) -> impl Iterator<Item = (String, Link)> {
    let parts = (0..).zip(cell.trim().split("\n#v=")).map(|(number, part)| match number {
        0 => part.trim().to_owned(),
        _ => format!("#v={}", part.trim()),
    });
    parts.filter_map(|text| Some((text.clone(), read_link(&text)?)))
}

fn veiled(link: &Link) -> Option<String> {
    link.other("x").map(str::to_owned)
}

/// The cells of a table by rows (RFC 4180), at most [`MAX_CELLS`] in each. Cells are separated by commas, semicolons or
/// tabs outside of quotes; those in a link without quotes belong to the link.
fn cells(text: &str) -> impl Iterator<Item = Vec<String>> {
    let mut rest = text.trim_start_matches('\u{feff}').chars().peekable();
    core::iter::from_fn(move || {
        rest.peek()?;
        let (mut row, mut cell, mut quoted) = (Vec::new(), String::new(), false);
        let end = |row: &mut Vec<String>, cell: &mut String| {
            let cell = core::mem::take(cell);
            if row.len() < MAX_CELLS {
                row.push(cell);
            }
        };
        while let Some(c) = rest.next() {
            match c {
                '"' if quoted && rest.peek() == Some(&'"') => cell.extend(rest.next()),
                '"' if quoted || cell.trim().is_empty() => quoted = !quoted,
                '\n' if !quoted => break,
                ',' | ';' if !quoted && !cell.contains('#') => end(&mut row, &mut cell),
                '\t' if !quoted => end(&mut row, &mut cell),
                c => cell.push(c),
            }
        }
        end(&mut row, &mut cell);
        Some(row)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read() {
        let rows: Vec<_> = cells(
            "name,link\r\n\"Lovelace, A.\",\"#v=1&palette=ff0000,00ff00\"\nNoether;#v=1&palette=ff0000,00ff00\nGermain\t\"a \"\"b\"\"\"",
        )
        .collect();
        assert_eq!(rows[1], ["Lovelace, A.", "#v=1&palette=ff0000,00ff00"]);
        assert_eq!(rows[2], ["Noether", "#v=1&palette=ff0000,00ff00"]);
        assert_eq!(rows[3], ["Germain", "a \"b\""]);
        assert_eq!(of_row(&rows[1], "x", "").unwrap().name, "Lovelace, A.");
        assert!(of_row(&rows[0], "x", "").is_none());
        // The name in a link does not replace the one in the table.
        let row = ["7", "Lovelace", "#v=1&by=Noether"].map(str::to_owned);
        let answer = of_row(&row, "x", "").unwrap();
        assert_eq!((answer.name.as_str(), answer.by.as_str()), ("7", "Noether"));
        assert_eq!(of_row(&row[2..], "answers, row 3", "").unwrap().name, "answers, row 3");
    }

    #[test]
    fn answers_of_packages_are_found_by_their_exercise() {
        let key = Exercise::key("abc");
        assert_eq!(key, "352441c2", "a published check sum");
        let state = format!("l-system 1 at=0\n#v=1&k=00000000&n=1\r\n#v=1&k={key}&mark=solved&n=2\n#v=1&k=own&n=3");
        for row in [
            vec!["Ada".to_owned(), state],
            vec!["Ada".to_owned(), "#v=1&k=00000000&n=1".to_owned(), format!("#v=1&k={key}&n=2")],
            vec!["Ada".to_owned(), "#v=1&x=def&n=1".to_owned(), "#v=1&x=abc&n=2".to_owned()],
        ] {
            let answer = of_row(&row, "", "abc").unwrap();
            assert_eq!((answer.name.as_str(), answer.student.unwrap().iterations), ("Ada", 2), "{row:?}");
        }
        assert!(of_row(&["#v=1&k=00000000&n=1".to_owned()], "", "abc").is_none());
        assert!(of_row(&["#v=1&x=def&n=1".to_owned()], "", "abc").unwrap().student.is_err());
    }
}
