//! Notations that other parts of the library write: LaTeX, and TikZ's library `lindenmayersystems`.

use super::Refusal;
use super::source::Source;
use lsystem_files::{FileOptions, collect, write_tikz_library};
use lsystem_syntax::Diagnostic;

pub(super) fn latex(source: &Source<'_>) -> Result<String, Refusal> {
    Ok(lsystem_files::latex(source.definition, &source.system))
}

pub(super) fn tikz(source: &Source<'_>) -> Result<String, Refusal> {
    let options = FileOptions { title: source.definition.label().to_owned(), ..FileOptions::default() };
    let written = collect::<String, _>(|sink| write_tikz_library(source.definition, &source.system, &options, sink));
    written.map(|(text, _)| text).map_err(|problem: Diagnostic| Refusal(problem.message))
}
