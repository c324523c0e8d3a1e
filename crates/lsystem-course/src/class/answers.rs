//! Answers to exercises in tables with a column of links.

use crate::exercise::Exercise;
use lsystem_base::say;
use lsystem_files::{Link, read_link, read_link_within};
use lsystem_syntax::Definition;

/// The most cells of a row that are read.
const MAX_CELLS: usize = 1000;
/// The most links of a row: twice as many as a package has exercises.
const MAX_LINKS: usize = 200;
/// The most bytes of an answer's link, and of what it unpacks to: more than the longest rules.
const MAX_LINK: usize = 1 << 16;
/// The most cells in which the link of an exercise is looked for.
const MAX_LOOKS: usize = 1000;
/// The most characters of a name.
const MAX_NAME: usize = 200;

/// An answer to an exercise. Of a whole class, only the links are kept, and each is read when it is marked.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Whose answer it is in the table, or where the answer stands.
    pub name: String,
    /// The name that the link gives, which anybody may write.
    pub by: String,
    /// The text or file that was handed in.
    pub given: Handed,
}

/// The form of an answer that was handed in.
#[derive(Clone, Debug)]
pub enum Handed {
    /// A link.
    Link(String),
    /// A system in a file.
    System(Box<Definition>),
    /// Nothing that can be marked, and why.
    Nothing(String),
}

impl Answer {
    /// The link, if it is one.
    #[must_use]
    pub fn link(&self) -> Option<&str> {
        match &self.given {
            Handed::Link(link) => Some(link),
            Handed::System(_) | Handed::Nothing(_) => None,
        }
    }

    /// The system of the student in an answer to this exercise, or why there is none.
    pub(super) fn student(&self, exercise: &str) -> Result<Definition, String> {
        let link = match &self.given {
            Handed::Link(text) => read_short(text).unwrap_or_default(),
            Handed::System(student) => return Ok((**student).clone()),
            Handed::Nothing(why) => return Err(why.clone()),
        };
        match veiled(&link) {
            Some(other) if other != exercise => Err(say!("an answer to another exercise")),
            _ => match link.problems.into_iter().next() {
                Some(problem) if link.definition == Definition::default() => Err(problem.message),
                _ => Ok(link.definition),
            },
        }
    }
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
    let links = cells(text).flatten().filter(|cell| cell.contains('='));
    links.take(MAX_LOOKS).find_map(|cell| veiled(&read_link(cell.trim())?))
}

/// The answer in a row of a table: of its links, the one to this exercise, or else the first. Its name is the first cell
/// beside the link, or else `name`. A package of several exercises keeps an answer to each; those to others are no
/// answers here.
fn of_row(cells: &[String], name: &str, exercise: &str) -> Option<Answer> {
    let key = Exercise::key(exercise);
    let (mut count, mut chosen, mut is_sure) = (0, None, false);
    for (at, text) in cells.iter().enumerate().flat_map(|(at, cell)| links(cell).map(move |text| (at, text))) {
        let Some(link) = read_short(&text) else { continue };
        count += 1;
        if count > MAX_LINKS {
            break;
        }
        if link.other("k").is_some_and(|other| other != key) {
            continue;
        }
        is_sure = link.other("k").is_some() || link.other("x") == Some(exercise);
        if is_sure || chosen.is_none() {
            chosen = Some((at, text, short(link.other("by").unwrap_or_default())));
        }
        if is_sure {
            break;
        }
    }
    let (at, text, by) = chosen?;
    let other = cells.iter().enumerate().find(|(other, cell)| *other != at && !cell.trim().is_empty());
    let name = other.map_or(name.to_owned(), |(_, cell)| short(cell));
    let given = match !is_sure && count > MAX_LINKS {
        true => Handed::Nothing(say!("more than {} links in one row", MAX_LINKS)),
        false => Handed::Link(text),
    };
    Some(Answer { name, by, given })
}

/// The texts in a cell that may be links: one, or the lines of what a package keeps.
fn links(cell: &str) -> impl Iterator<Item = String> {
    (0..).zip(cell.trim().split("\n#v=")).map(|(number, part)| match number {
        0 => part.trim().to_owned(),
        _ => format!("#v={}", part.trim()),
    })
}

/// Reads a link of an answer: no student may take the memory and the time of the others.
fn read_short(text: &str) -> Option<Link> {
    read_link_within(text, MAX_LINK, MAX_LINK)
}

/// The beginning of a name.
fn short(name: &str) -> String {
    name.trim().chars().take(MAX_NAME).collect()
}

fn veiled(link: &Link) -> Option<String> {
    link.other("x").map(str::to_owned)
}

/// A cell of a table while it is read.
#[derive(Default)]
struct Cell {
    text: String,
    /// Whether there is more than white space.
    has_words: bool,
    /// Whether there is a `#`, with which links begin.
    has_hash: bool,
}

impl Cell {
    fn push(&mut self, c: char) {
        self.has_words |= !c.is_whitespace();
        self.has_hash |= c == '#';
        self.text.push(c);
    }
}

/// The cells of a table by rows (RFC 4180), at most [`MAX_CELLS`] in each. Cells are separated by commas, semicolons or
/// tabs outside of quotes; those in a link without quotes belong to the link.
fn cells(text: &str) -> impl Iterator<Item = Vec<String>> {
    let mut rest = text.trim_start_matches('\u{feff}').chars().peekable();
    core::iter::from_fn(move || {
        rest.peek()?;
        let (mut row, mut cell, mut quoted) = (Vec::new(), Cell::default(), false);
        let end = |row: &mut Vec<String>, cell: &mut Cell| {
            let cell = core::mem::take(cell);
            if row.len() < MAX_CELLS {
                row.push(cell.text);
            }
        };
        while let Some(c) = rest.next() {
            match c {
                '"' if quoted && rest.next_if_eq(&'"').is_some() => cell.push('"'),
                '"' if quoted || !cell.has_words => quoted = !quoted,
                '\n' if !quoted => break,
                ',' | ';' if !quoted && !cell.has_hash => end(&mut row, &mut cell),
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
            let student = answer.student("abc").unwrap();
            assert_eq!((answer.name.as_str(), student.iterations), ("Ada", 2), "{row:?}");
        }
        assert!(of_row(&["#v=1&k=00000000&n=1".to_owned()], "", "abc").is_none());
        assert!(of_row(&["#v=1&x=def&n=1".to_owned()], "", "abc").unwrap().student("abc").is_err());
    }
    #[test]
    fn the_share_of_an_answer_is_bounded() {
        let packed = |text: &str| format!("#v=1&z={}", lsystem_files::packed::pack(text.as_bytes()));
        let why = |cell: String| of_row(&[cell], "", "abc").unwrap().student("abc").unwrap_err();
        assert!(why(packed(&format!("rules={}", "F".repeat(MAX_LINK)))).contains("larger"));
        assert!(why(format!("#v=1&axiom={}", "F".repeat(MAX_LINK))).contains("longer"));
        assert!(why("#v=1&n=2\n".repeat(MAX_LINKS + 1)).contains("more than 200 links"));
        let long = of_row(&[format!("#v=1&n=2&by={}", "A".repeat(9999))], &"B".repeat(9999), "abc").unwrap();
        assert_eq!((long.name.len(), long.by.len()), (9999, MAX_NAME));
        assert_eq!(long.student("abc").unwrap().iterations, 2);
    }
}
