//! `lsys mark`: answers to an exercise, marked.

mod csv;
mod page;

use crate::answers::{Answer, answers, exercise};
use crate::pending::Pending;
use crate::progress::DelayedBar;
use crate::{CommandFailure, print};
use lsystem::Definition;
use lsystem::course::{Exercise, Grade, Marker};
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
    let mut all = Vec::new();
    for word in words {
        all.extend(answers(word, &veiled)?);
    }
    let mut bar = DelayedBar::new("answers", Some(all.len() as u64));
    let mut marked = Vec::new();
    for answer in all {
        marked.push(marked_by(&mut marker, answer, html.is_some()));
        bar.at(marked.len() as u64);
    }
    drop(bar);
    if let Some(path) = html {
        let text = page::page(marker.exercise(), &marked);
        let page = Pending::write(path, |out| out.write_all(text.as_bytes())).and_then(Pending::commit);
        page.map_err(|error| CommandFailure::io(path.display(), &error))?;
    }
    print(|out| if csv { csv::write(out, &marked) } else { write_table(out, &marked) })
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
    let widest = |of: fn(&Answer) -> &String, head: &str| {
        let widest = marked.iter().map(|one| visible(of(&one.answer)).chars().count()).max().unwrap_or(0);
        widest.clamp(head.len(), 40)
    };
    let (widest, signed) = (widest(|answer| &answer.name, "name"), widest(|answer| &answer.by, "by"));
    writeln!(out, "{:widest$}  {:signed$}  solved  agrees  symbols  remark", "name", "by")?;
    for one in marked {
        let solved = if one.is_solved() { "yes" } else { "no" };
        let percent = one.percent();
        let (name, by) = (visible(&one.answer.name), visible(&one.answer.by));
        writeln!(
            out,
            "{name:widest$}  {by:signed$}  {solved:6} {percent:>7} {:>8}  {}",
            one.symbols(),
            visible(&one.words)
        )?;
    }
    let solved = marked.iter().filter(|one| one.is_solved()).count();
    writeln!(out, "{solved} of {} solved.", marked.len())
}

/// The parts of an exercise's head for a page.
fn title_of(exercise: &Exercise) -> &str {
    if exercise.title.is_empty() { "Exercise" } else { &exercise.title }
}
