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
mod text;
mod words;

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
    /// The parts of systems that the notation lacks.
    lacks: &'static [Need],
    write: Writer,
}

/// Writes a system that needs nothing that the notation lacks.
type Writer = fn(&Source<'_>) -> Result<String, Refusal>;

/// A system in another notation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The text, with a line end at its end.
    pub text: String,
    /// The parts of the definition that are not in the text, as sentences. None of them changes the shape.
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

/// Notations of a turtle in the plane for words of plain symbols lack these.
const PLAIN: &[Need] = &[
    Need::Contexts,
    Need::Parameters,
    Need::Chance,
    Need::Variation,
    Need::Images,
    Need::Space,
    Need::BranchLengths,
    Need::Scaling,
    Need::SwappedTurns,
    Need::Polygons,
    Need::Circles,
    Need::Tubes,
    Need::Surfaces,
    Need::Cuts,
    Need::Tropism,
    Need::Growth,
    Need::OpenBranches,
];

/// All notations, in the order of the page's list.
pub static NOTATIONS: [Notation; 12] = [
    Notation {
        name: "text",
        label: word!("Text"),
        help: word!("Labelled lines, as in papers, where our reader makes the same system of them"),
        ending: "txt",
        lacks: &[Need::Surfaces],
        write: text::write,
    },
    Notation {
        name: "latex",
        label: word!("LaTeX"),
        help: word!("Table for a paper, as in The Algorithmic Beauty of Plants"),
        ending: "tex",
        lacks: &[],
        write: paper::latex,
    },
    Notation {
        name: "tikz",
        label: word!("TikZ"),
        help: word!("Picture by the library lindenmayersystems, in one colour, of at most 100,000 symbols"),
        ending: "tex",
        lacks: &[],
        write: paper::tikz,
    },
    Notation {
        name: "python",
        label: word!("Python turtle"),
        help: word!("Program that draws with the standard module turtle"),
        ending: "py",
        lacks: program::LACKS,
        write: python::write,
    },
    Notation {
        name: "p5",
        label: word!("p5.js sketch"),
        help: word!("Sketch that derives and draws, for the editor of p5.js"),
        ending: "js",
        lacks: program::LACKS,
        write: p5::write,
    },
    Notation {
        name: "js",
        label: word!("JavaScript object"),
        help: word!(
            "Object for JavaScript packages: F and G draw, f moves, + and - turn by one angle, and the first heading is up"
        ),
        ending: "js",
        lacks: object::LACKS,
        write: object::write,
    },
    Notation {
        name: "fractint",
        label: word!("Fractint"),
        help: word!(
            "Entry of a file, of at most 25 rules and lines of 250 characters; without the number of iterations"
        ),
        ending: "l",
        lacks: fractint::LACKS,
        write: fractint::write,
    },
    Notation {
        name: "inkscape",
        label: word!("Inkscape"),
        help: word!(
            "Lines for the dialog Extensions > Render > L-system, with headings that its angles reach from upwards"
        ),
        ending: "txt",
        lacks: PLAIN,
        write: inkscape::write,
    },
    Notation {
        name: "houdini",
        label: word!("Houdini"),
        help: word!("Lines of the L-system node, with numbers as in its own symbols"),
        ending: "txt",
        lacks: houdini::LACKS,
        write: houdini::write,
    },
    Notation {
        name: "cpfg",
        label: word!("cpfg"),
        help: word!("File with the angles as numbers; circles only filled"),
        ending: "l",
        lacks: cpfg::LACKS,
        write: cpfg::write_cpfg,
    },
    Notation {
        name: "lpy",
        label: word!("L-Py"),
        help: word!("Arrow rules, and rules of Python with conditions; arithmetic with the functions of Python"),
        ending: "lpy",
        lacks: lpy::LACKS,
        write: lpy::write,
    },
    Notation {
        name: "anvaka",
        label: word!("anvaka’s page"),
        help: word!("Text for anvaka’s page, with one action for each symbol"),
        ending: "txt",
        lacks: PLAIN,
        write: anvaka::write,
    },
];

impl Notation {
    /// The notation with this name, if any.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        NOTATIONS.iter().find(|notation| notation.name == name)
    }

    /// The parts of systems that the notation lacks, as noun phrases.
    pub fn lacks(&self) -> impl Iterator<Item = &'static str> {
        self.lacks.iter().map(|need| need.words())
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
    if let Some(need) = notation.lacks.iter().find(|need| source.needs(**need)) {
        return Err(Refusal(say!("{}: {} cannot be expressed", said(notation.label), said(need.words()))));
    }
    let text = (notation.write)(&source)?;
    Ok(Written { text, left_out: source.left_out(notation.name) })
}
