//! Files for papers: figures, and systems typeset as in books.

mod bibtex;
mod facts;
mod figure;
mod latex;
mod markdown;
mod pdf;
mod tex;
mod tikz;
mod tikz_library;

pub use bibtex::bibtex;
pub use latex::{LATEX_START, latex};
pub use markdown::markdown;
pub(crate) use pdf::write_pdf;
pub(crate) use tikz::write_tikz;
pub use tikz_library::write_tikz_library;
