//! Answers to exercises: links, systems in files, and tables with a column of links.

use crate::{CommandFailure, input};
use lsystem::base::say;
use lsystem::base::words::grouped;
use lsystem::course::{Answer, ClassMarker, Handed, MAX_OUTPUT, answers as in_text, exercise_in};
use lsystem::read_file;
use std::path::Path;

/// The most answers in a table.
const MAX: usize = 100_000;

/// Reads an exercise: a link, or a file that contains one.
///
/// # Errors
/// [`CommandFailure::Words`] if there is no exercise, or it is damaged or cannot be drawn.
pub(crate) fn class(word: &str) -> Result<ClassMarker, CommandFailure> {
    let text = if is_link(word) { word.to_owned() } else { input::text_of(Path::new(word))? };
    let Some(veiled) = exercise_in(&text) else {
        return Err(CommandFailure::Words(say!("{}: there is no link of an exercise (with x=...)", word)));
    };
    ClassMarker::new(veiled).map_err(|wrong| CommandFailure::Words(say!("the exercise {}", wrong)))
}

/// The answers that one word of the command line names.
///
/// # Errors
/// [`CommandFailure::Words`] if the word is no link, and no file that can be read.
pub(crate) fn answers(word: &str, exercise: &str) -> Result<Vec<Answer>, CommandFailure> {
    if is_link(word) {
        return Ok(in_text(word, "link", exercise).collect());
    }
    let path = Path::new(word);
    let bytes = input::output_of(path).map_err(|error| CommandFailure::io(word, &error))?;
    let refused = |why: String| Err(CommandFailure::Words(format!("{word}: {why}")));
    let name = path.file_stem().map_or(word.into(), |name| name.to_string_lossy()).into_owned();
    if let Ok(text) = core::str::from_utf8(&bytes) {
        if text.len() > MAX_OUTPUT {
            return refused(say!("longer than {} MiB, which is not read", MAX_OUTPUT >> 20));
        }
        let found: Vec<Answer> = in_text(text, &name, exercise).take(MAX + 1).collect();
        if found.len() > MAX {
            return refused(say!("more than {} answers", grouped(&MAX.to_string())));
        }
        if !found.is_empty() {
            return Ok(found);
        }
    }
    let nothing = || Handed::Nothing(say!("this is no system and no link"));
    let given = read_file(&bytes).definition.map_or_else(nothing, |student| Handed::System(Box::new(student)));
    Ok(vec![Answer { name, by: String::new(), given }])
}

fn is_link(word: &str) -> bool {
    word.starts_with("http:") || word.starts_with("https:") || word.starts_with("file:") || word.starts_with('#')
}
