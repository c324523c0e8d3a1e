//! `lsys mark`: answers to an exercise, marked.

mod page;

use crate::answers::{Answer, answers, exercise};
use crate::pending::Pending;
use crate::{CommandFailure, print};
use lsystem::Definition;
use lsystem::course::{Exercise, Grade, Marker};
use lsystem::derive::Tally;
use lsystem::syntax::visible;
use std::io::{self, Write};
use std::path::Path;

/// A marked answer.
struct Marked {
    answer: Answer,
    /// `None` if there is nothing to mark.
    mark: Option<Grade>,
    /// The remark in the table.
    words: String,
    /// The differences from the target, for pages: a PNG.
    picture: Vec<u8>,
}

/// Marks answers and prints a table; writes a page to `html` if it is given.
///
/// # Errors
/// [`CommandFailure::Words`] if the exercise is damaged, or a file cannot be read or written.
pub(crate) fn mark(wanted: &str, words: &[String], csv: bool, html: Option<&Path>) -> Result<(), CommandFailure> {
    let (exercise, veiled) = exercise(wanted)?;
    let mut marker = Marker::new(exercise).map_err(|errors| {
        let errors: Vec<String> = errors.iter().map(lsystem::Diagnostic::message).collect();
        CommandFailure::Words(format!("the exercise cannot be drawn: {}", errors.join(" ")))
    })?;
    let mut marked = Vec::new();
    for word in words {
        for answer in answers(word, &veiled)? {
            marked.push(marked_by(&mut marker, answer, html.is_some()));
        }
    }
    if let Some(path) = html {
        let text = page::page(marker.exercise(), &marked);
        let page = Pending::write(path, |out| out.write_all(text.as_bytes())).and_then(Pending::commit);
        page.map_err(|error| CommandFailure::io(path.display(), &error))?;
    }
    print(|out| if csv { write_csv(out, &marked) } else { write_table(out, &marked) })
}

fn marked_by(marker: &mut Marker, answer: Answer, with_picture: bool) -> Marked {
    match &answer.student {
        Err(words) => Marked { words: words.clone(), mark: None, picture: Vec::new(), answer },
        Ok(student) => {
            // A whole system in a file has the given rules, too.
            let student = &Definition { rules: marker.exercise().own_rules(&student.rules), ..student.clone() };
            let mark = marker.mark(student);
            let picture = if with_picture { page::picture(&marker.overlay()) } else { Vec::new() };
            let words = said(marker, student, &mark);
            Marked { words, mark: Some(mark), picture, answer }
        }
    }
}

/// The sentence that explains a mark to the student.
fn said(marker: &Marker, student: &Definition, mark: &Grade) -> String {
    if let Some(error) = mark.errors.first() {
        return error.message();
    }
    let hint = if mark.is_solved { None } else { marker.hint(student) };
    [mark.words.as_str(), hint.as_deref().unwrap_or_default()].join(" ").trim_end().to_owned()
}

impl Marked {
    fn is_solved(&self) -> bool {
        self.mark.as_ref().is_some_and(|mark| mark.is_solved)
    }

    /// The agreement in percent.
    fn percent(&self) -> String {
        self.mark.as_ref().map(Grade::percent).unwrap_or_default()
    }

    fn symbols(&self) -> String {
        self.mark.as_ref().map(|mark| mark.symbols.to_string()).unwrap_or_default()
    }
}

fn write_table(out: &mut dyn Write, marked: &[Marked]) -> io::Result<()> {
    let widest = marked.iter().map(|marked| marked.answer.name.chars().count()).max().unwrap_or(0).clamp(4, 40);
    writeln!(out, "{:widest$}  solved  agrees  symbols  remark", "name")?;
    for one in marked {
        let solved = if one.is_solved() { "yes" } else { "no" };
        let percent = one.percent();
        let name = visible(&one.answer.name);
        writeln!(out, "{name:widest$}  {solved:6} {percent:>7} {:>8}  {}", one.symbols(), visible(&one.words))?;
    }
    let solved = marked.iter().filter(|one| one.is_solved()).count();
    writeln!(out, "{solved} of {} solved.", marked.len())
}

fn write_csv(out: &mut dyn Write, marked: &[Marked]) -> io::Result<()> {
    writeln!(out, "name,solved,agreement_percent,symbols,target_segments,own_segments,remark,link")?;
    for one in marked {
        let count = |count: &Option<Tally>| count.as_ref().map(Tally::to_string).unwrap_or_default();
        let [target, own] = one.mark.as_ref().map(|mark| mark.segments.each_ref().map(count)).unwrap_or_default();
        let solved = if one.is_solved() { "yes" } else { "no" };
        let percent = one.percent();
        let link = one.answer.link.as_deref().unwrap_or_default();
        let row =
            [&one.answer.name, solved, percent.trim_end_matches(" %"), &one.symbols(), &target, &own, &one.words, link];
        writeln!(out, "{}", row.map(quoted).join(","))?;
    }
    Ok(())
}

/// A cell of a table. Spreadsheets take texts that begin like a formula for one; a quote before it keeps them texts.
fn quoted(text: &str) -> String {
    let guard = if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { "'" } else { "" };
    match text.contains([',', '"', '\n', '\r', ';']) || !guard.is_empty() {
        true => format!("\"{guard}{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// The parts of an exercise's head for a page.
fn title_of(exercise: &Exercise) -> &str {
    if exercise.title.is_empty() { "Exercise" } else { &exercise.title }
}
