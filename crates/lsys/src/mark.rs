//! `lsys mark`: answers to an exercise, marked.

mod page;

pub(crate) use page::escaped;

use crate::answers::{answers, class};
use crate::pending::Pending;
use crate::progress::DelayedBar;
use crate::{CommandFailure, print};
use lsystem::base::words::said;
use lsystem::base::{say, word};
use lsystem::course::{Answer, Exercise, Marked};
use lsystem::syntax::visible;
use std::io::{self, Write};
use std::path::Path;

/// Marks answers and prints a table; writes a page to `html` if it is given.
///
/// # Errors
/// [`CommandFailure::Words`] if the exercise is damaged, or a file cannot be read or written.
pub(crate) fn mark(wanted: &str, words: &[String], csv: bool, html: Option<&Path>) -> Result<(), CommandFailure> {
    let mut class = class(wanted)?;
    let mut all = Vec::new();
    for word in words {
        all.extend(answers(word, class.veiled())?);
    }
    let mut bar = DelayedBar::new(word!("answers"), Some(all.len() as u64));
    let (mut marked, mut pictures) = (Vec::new(), Vec::new());
    for answer in all {
        let one = class.mark(answer);
        if html.is_some() {
            pictures.push(one.grade.as_ref().map(|_| page::picture(&class.picture())).unwrap_or_default());
        }
        marked.push(one);
        bar.at(marked.len() as u64);
    }
    drop(bar);
    if let Some(path) = html {
        let text = page::page(class.exercise(), &marked, &pictures);
        let page = Pending::write(path, |out| out.write_all(text.as_bytes())).and_then(Pending::commit);
        page.map_err(|error| CommandFailure::io(path.display(), &error))?;
    }
    print(|out| if csv { out.write_all(class.csv(&marked).as_bytes()) } else { write_table(out, &marked) })
}

fn write_table(out: &mut dyn Write, marked: &[Marked]) -> io::Result<()> {
    let widest = |of: fn(&Answer) -> &String, head: &str| {
        let widest = marked.iter().map(|one| visible(of(&one.answer)).chars().count()).max().unwrap_or(0);
        widest.max(head.chars().count()).min(40.max(head.chars().count()))
    };
    let heads = [word!("name"), word!("by"), word!("solved"), word!("agrees"), word!("symbols"), word!("remark")];
    let [name, by, solved_head, agrees, symbols, remark] = heads.map(said);
    let (widest, signed) = (widest(|answer| &answer.name, &name), widest(|answer| &answer.by, &by));
    let columns = [(&solved_head, 6), (&agrees, 6), (&symbols, 7)].map(|(head, least)| head.chars().count().max(least));
    let [wide, percents, counts] = columns;
    writeln!(
        out,
        "{name:widest$}  {by:signed$}  {solved_head:wide$}  {agrees:percents$}  {symbols:counts$}  {remark}"
    )?;
    let (percents, counts) = (percents + 1, counts + 1);
    for one in marked {
        let solved = if one.is_solved() { say!("yes") } else { say!("no") };
        let percent = one.percent();
        let (name, by) = (visible(&one.answer.name), visible(&one.answer.by));
        writeln!(
            out,
            "{name:widest$}  {by:signed$}  {solved:wide$} {percent:>percents$} {:>counts$}  {}",
            one.symbols(),
            visible(&one.words())
        )?;
    }
    let solved = marked.iter().filter(|one| one.is_solved()).count();
    writeln!(out, "{}", say!("{} of {} solved.", solved, marked.len()))
}

/// The parts of an exercise's head for a page.
fn title_of(exercise: &Exercise) -> String {
    if exercise.title.is_empty() { say!("Exercise") } else { exercise.title.clone() }
}
