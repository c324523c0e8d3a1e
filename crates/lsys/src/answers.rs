//! Answers to exercises: links, systems in files, and tables with a column of links.

use crate::{CommandFailure, input};
use lsystem::course::{Exercise, MAX_OUTPUT};
use lsystem::files::{Link, read_link};
use lsystem::syntax::message::grouped;
use lsystem::{Definition, read_file};
use std::path::Path;

/// The most answers in a table.
const MOST: usize = 100_000;
/// The most cells of a row that are read.
const MAX_CELLS: usize = 1000;

/// An answer to an exercise.
pub(crate) struct Answer {
    /// Whose answer it is in the table, or where the answer stands.
    pub(crate) name: String,
    /// The name that the link gives, which anybody may write.
    pub(crate) by: String,
    /// The link, if it is one.
    pub(crate) link: Option<String>,
    /// The answer, or why there is none.
    pub(crate) student: Result<Definition, String>,
}

/// Reads an exercise: a link, or a file that contains one.
///
/// # Errors
/// [`CommandFailure::Words`] if there is no exercise or it is damaged. The second value is the exercise as written in
/// the link.
pub(crate) fn exercise(word: &str) -> Result<(Exercise, String), CommandFailure> {
    let text = if is_link(word) { word.to_owned() } else { input::text_of(Path::new(word))? };
    let link = cells(&text).flatten().find_map(|cell| veiled(&read_link(cell.trim())?));
    let Some(veiled) = link else {
        return Err(CommandFailure::Words(format!("{word}: there is no link of an exercise (with x=...)")));
    };
    match Exercise::read(&veiled) {
        Ok(exercise) => Ok((exercise, veiled)),
        Err(wrong) => Err(CommandFailure::Words(format!("the exercise {wrong}"))),
    }
}

/// The answers that one word of the command line names.
///
/// # Errors
/// [`CommandFailure::Words`] if the word is no link, and no file that can be read.
pub(crate) fn answers(word: &str, exercise: &str) -> Result<Vec<Answer>, CommandFailure> {
    if is_link(word) {
        return Ok(of_row(&[word.to_owned()], "link", exercise).into_iter().collect());
    }
    let path = Path::new(word);
    let bytes = input::output_of(path).map_err(|error| CommandFailure::io(word, &error))?;
    let refused = |why: String| Err(CommandFailure::Words(format!("{word}: {why}")));
    let name = path.file_stem().map_or(word.into(), |name| name.to_string_lossy()).into_owned();
    if let Ok(text) = core::str::from_utf8(&bytes) {
        if text.len() > MAX_OUTPUT {
            return refused(format!("longer than {} MiB, which is not read", MAX_OUTPUT >> 20));
        }
        let is_table = cells(text).nth(1).is_some();
        let found = cells(text).zip(1..).filter_map(|(cells, row)| {
            let name = if is_table { format!("{name}, row {row}") } else { name.clone() };
            of_row(&cells, &name, exercise)
        });
        let found: Vec<Answer> = found.take(MOST + 1).collect();
        if found.len() > MOST {
            return refused(format!("more than {} answers", grouped(&MOST.to_string())));
        }
        if !found.is_empty() {
            return Ok(found);
        }
    }
    let student = read_file(&bytes).definition.ok_or_else(|| "this is no system and no link".to_owned());
    Ok(vec![Answer { name, by: String::new(), link: None, student }])
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
        Some(other) if other != exercise => Err("an answer to another exercise".to_owned()),
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

fn is_link(word: &str) -> bool {
    word.starts_with("http:") || word.starts_with("https:") || word.starts_with("file:") || word.starts_with('#')
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
