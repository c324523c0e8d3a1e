//! Notations that other parts of the library write: LaTeX, and TikZ's library `lindenmayersystems`.

use super::Refusal;
use super::source::Source;
use lsystem_files::{Content, FileOptions, Format, collect};
use lsystem_syntax::Diagnostic;

pub(super) fn latex(source: &Source<'_>) -> Result<String, Refusal> {
    words("latex", source)
}

pub(super) fn tikz(source: &Source<'_>) -> Result<String, Refusal> {
    words("tikz-library", source)
}

fn words(name: &str, source: &Source<'_>) -> Result<String, Refusal> {
    let Some(Content::Words(write)) = Format::named(name).map(|format| format.content) else {
        return Err(Refusal::new("This notation is not available"));
    };
    let options = FileOptions { title: source.definition.label().to_owned(), ..FileOptions::default() };
    let written = collect::<String, _>(|sink| write(source.definition, &source.system, &options, sink));
    written.map(|(text, _)| text).map_err(|problem: Diagnostic| Refusal(problem.message()))
}
