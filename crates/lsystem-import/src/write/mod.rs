//! Systems written in the notations of other programs, of papers and of web pages.
//!
//! [`export`] writes a [`Definition`] in a notation of the table [`NOTATIONS`]. A written text draws the same picture as
//! the definition, up to its size and place, or it is refused with the reason. Mere looks, such as colours and widths,
//! may be left out, which [`Written::left_out`] tells.
//!
//! A new notation is one file and one row. `docs/imports.md` lists what each notation can express.

mod anvaka;
mod compare;
mod cpfg;
mod expression;
mod fractint;
mod houdini;
mod inkscape;
mod lpy;
mod object;
mod p5;
mod paper;
mod program;
mod python;
mod queries;
mod source;
mod spelling;
mod symbol_words;
mod text;

#[cfg(test)]
mod tests;

use lsystem_base::words::said;
use lsystem_base::{say, word};
use lsystem_syntax::Definition;
use source::{Need, Source};

/// A notation that systems are written in: a row of [`NOTATIONS`].
#[derive(Debug)]
pub struct Notation {
    /// The name for the program and for scripts.
    pub name: &'static str,
    /// The label on the page.
    pub label: &'static str,
    /// A description, as a noun phrase.
    pub help: &'static str,
    /// The ending of file names, without a dot.
    pub ending: &'static str,
    /// The parts of systems that the notation expresses. A system that needs another part is refused.
    speaks: &'static [Need],
    write: Writer,
}

/// Writes a system that needs nothing but what the notation speaks.
type Writer = fn(&Source<'_>) -> Result<String, Refusal>;

/// A system in another notation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The text, with a line end at its end.
    pub text: String,
    /// The parts of the definition that are not in the text, as sentences. None of them changes the shape, except by
    /// rounding.
    pub left_out: Vec<String>,
}

/// The reason why a system cannot be written in a notation, as a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal(pub String);

impl core::fmt::Display for Refusal {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        out.write_str(&self.0)
    }
}

impl core::error::Error for Refusal {}

impl Refusal {
    fn new(words: impl Into<String>) -> Self {
        Self(words.into())
    }
}

/// All notations, in the order of the page's list.
pub static NOTATIONS: [Notation; 12] = [
    notation("text", "txt", word!("Text"), text::SPEAKS, text::write)
        .help(word!("Labelled lines, as in papers, where our reader makes the same system of them")),
    // The writer refuses by itself.
    notation("latex", "tex", word!("LaTeX"), &Need::ALL, paper::latex)
        .help(word!("Table for a paper, as in The Algorithmic Beauty of Plants")),
    // The writer refuses by itself.
    notation("tikz", "tex", word!("TikZ"), &Need::ALL, paper::tikz)
        .help(word!("Picture by the library lindenmayersystems, in one colour, of at most 100,000 symbols")),
    notation("python", "py", word!("Python turtle"), program::SPEAKS, python::write)
        .help(word!("Program that draws with the standard module turtle")),
    notation("p5", "js", word!("p5.js sketch"), program::SPEAKS, p5::write)
        .help(word!("Sketch that derives and draws, for the editor of p5.js")),
    notation("js", "js", word!("JavaScript object"), object::SPEAKS, object::write).help(word!(
        "Object for JavaScript packages: F and G draw, f moves, + and - turn by one angle, and the first heading is up"
    )),
    notation("fractint", "l", word!("Fractint"), fractint::SPEAKS, fractint::write).help(word!(
        "Entry of a file, of at most 25 rules and lines of 250 characters; without the number of iterations"
    )),
    notation("inkscape", "txt", word!("Inkscape"), &[], inkscape::write).help(word!(
        "Lines for the dialog Extensions > Render > L-system, with headings that its angles reach from upwards"
    )),
    notation("houdini", "txt", word!("Houdini"), houdini::SPEAKS, houdini::write)
        .help(word!("Lines of the L-system node, with numbers as in its own symbols")),
    notation("cpfg", "l", word!("cpfg"), cpfg::SPEAKS, cpfg::write_cpfg)
        .help(word!("File with the angles as numbers; circles only filled")),
    notation("lpy", "lpy", word!("L-Py"), lpy::SPEAKS, lpy::write)
        .help(word!("Arrow rules, and rules of Python with conditions; arithmetic with the functions of Python")),
    notation("anvaka", "txt", word!("anvaka’s page"), &[], anvaka::write)
        .help(word!("Text for anvaka’s page, with one action for each symbol")),
];

const fn notation(
    name: &'static str,
    ending: &'static str,
    label: &'static str,
    speaks: &'static [Need],
    write: Writer,
) -> Notation {
    Notation { name, label, help: "", ending, speaks, write }
}

impl Notation {
    const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    /// The notation with this name, if any.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        NOTATIONS.iter().find(|notation| notation.name == name)
    }

    /// The parts of systems that the notation lacks, as noun phrases.
    pub fn lacks(&self) -> impl Iterator<Item = &'static str> {
        let is_lacking = |need: &&Need| !self.speaks.contains(need);
        // What follows from another part is not listed too.
        let is_first = |need: &&Need| need.basis().is_none_or(|basis| self.speaks.contains(&basis));
        Need::ALL.iter().filter(is_lacking).filter(is_first).map(|need| need.words())
    }
}

impl PartialEq for Notation {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Writes a definition in another notation.
///
/// # Errors
/// The reason why the notation cannot express the definition, or why the definition itself is wrong.
pub fn export(definition: &Definition, notation: &Notation) -> Result<Written, Refusal> {
    let source = Source::new(definition)?;
    if let Some(need) = source.lacking(notation.speaks) {
        return Err(Refusal(say!("{}: {} cannot be expressed", said(notation.label), said(need.words()))));
    }
    let text = (notation.write)(&source)?;
    Ok(Written { text, left_out: source.left_out(notation.name) })
}
