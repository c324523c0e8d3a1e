//! `lsys scorm`: packages of exercises for learning systems.

use crate::answers::class;
use crate::cli::ScormOptions;
use crate::pages::{EXERCISE, Page, STEPS};
use crate::pending::Pending;
use crate::{CommandFailure, language, print};
use lsystem::base::say;
use lsystem::course::{Scorm, ScormPages, scorm_package};
use std::path::Path;

/// Writes a package of exercises, or of the lesson, to the file `to`.
///
/// # Errors
/// [`CommandFailure::Words`] if an exercise is damaged, a page is missing, or the file cannot be written.
pub(crate) fn package(exercises: &[String], to: &Path, options: &ScormOptions) -> Result<(), CommandFailure> {
    let exercises = exercises
        .iter()
        .map(|word| Ok(class(word)?.veiled().to_owned()))
        .collect::<Result<Vec<_>, CommandFailure>>()?;
    let page = |page: Page| page.html(options.pages.as_ref().map(|folder| folder.join(page.name)).as_deref());
    let (steps, exercise) = (page(STEPS)?, page(EXERCISE)?);
    let scorm = Scorm { title: &options.title, exercises: &exercises, standard: options.standard };
    let program = options.pages.as_ref().and_then(|folder| std::fs::read_to_string(folder.join("program.html")).ok());
    let pages =
        ScormPages { steps: &steps, exercise: &exercise, program: program.as_deref(), words: language::page_words() };
    let package = scorm_package(&scorm, &pages).map_err(CommandFailure::Words)?;
    let file = Pending::write(to, |out| out.write_all(&package)).and_then(Pending::commit);
    file.map_err(|error| CommandFailure::io(to.display(), &error))?;
    print(|out| {
        let size = package.len();
        let told = say!("{}, {} bytes. Marks in it can be forged; mark again by: lsys mark", to.display(), size);
        writeln!(out, "{told}")
    })
}
