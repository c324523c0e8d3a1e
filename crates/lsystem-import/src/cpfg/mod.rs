//! The L-system files of cpfg, and those of L-Py.
//!
//! ```text
//! lsystem: 1                 Axiom: A
//! #define r 0.9              derivation length: 4
//! derivation length: 5       production:
//! axiom: A(1)                A --> F[+A]-A
//! A(s) : s > 0.1 --> F(s)[+A(s*r)]
//! homomorphism
//! F(s) --> !(0.1)F(s)
//! endlsystem
//! ```
//!
//! The rules are nearly in our notation. Names of several letters become single symbols. Macros are replaced, except
//! those that are constants. Decompositions are written into the successors, and the values of assignments in place of
//! their names. Numbers that code changes at every step become parameters. Other code and includes are refused. The
//! angle, the surfaces and the functions of cpfg stand in other files, which may follow in the same text
//! (`companions.rs`).

mod arithmetic;
mod assignments;
mod choices;
mod clean;
mod code;
mod companions;
mod decomposition;
mod every_step;
mod expressions;
mod file;
mod function_file;
mod lpy;
mod macros;
mod nurbs;
mod parts;
mod python;
mod recursion;
mod statements;
mod surface_file;
mod symbols;
#[cfg(test)]
mod tests;
mod translate;

pub(super) use file::read as read_cpfg;
pub(super) use function_file::function_file;
pub(super) use lpy::read as read_lpy;
pub(super) use surface_file::surface_file;

use crate::source::Source;
use core::ops::Range;

/// The notation of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Cpfg,
    LPy,
}

/// The places of slices of the text without comments, which are those of the text itself.
#[derive(Clone, Copy)]
struct Places<'c>(Source<'c>);

impl<'c> Places<'c> {
    fn text(&self) -> &'c str {
        self.0.text
    }

    /// The place of a slice; empty at the start for another text.
    fn of(&self, part: &str) -> Range<usize> {
        self.0.place(part).unwrap_or_default()
    }

    /// The place of a slice; `otherwise` for another text.
    fn or(&self, part: &str, otherwise: &Range<usize>) -> Range<usize> {
        self.0.place(part).unwrap_or_else(|| otherwise.clone())
    }
}
