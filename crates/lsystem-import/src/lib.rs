//! Systems in the notations of other programs, of papers and of web pages.
//!
//! [`import`] recognises a notation by its content and translates each system in the text into a [`Definition`] in our
//! own notation. A reader never guesses in silence: every part of the text that is not carried over is a [`Remark`]
//! with its line. If a part changes the drawing and cannot be expressed, the system is refused. Every definition of the
//! result compiles.
//!
//! Each notation has one file or folder. Work and memory grow in proportion to the text, and a text has at most [`MAX_TEXT`]
//! bytes. `docs/imports.md` lists what each reader reads, notes and refuses.
//!
//! ```
//! let found = lsystem_import::import("Koch {\n  Angle 6\n  Axiom F\n  F=F+F--F+F\n}").unwrap();
//! assert_eq!((found.notation, &*found.entries[0].name), ("Fractint", "Koch"));
//! let koch = found.entries[0].definition.as_ref().unwrap();
//! assert_eq!((&*koch.rules, koch.angle), ("F -> F+F--F+F", 60.0));
//! ```

mod account;
mod angle;
mod anvaka;
mod assembly;
mod branches;
mod cpfg;
mod decode;
mod draft;
mod fractint;
mod houdini;
mod labelled;
mod link;
mod mapped;
mod objects;
mod own;
mod phrases;
mod prose_words;
mod racket;
mod rules;
mod source;
mod statements;
mod tikz;
mod tokens;
mod unread;
mod value;
mod vocabulary;
mod wrappings;
pub mod write;

#[cfg(test)]
mod tests;

pub use account::{Fate, Part};

use account::{Mark, account};
use core::ops::Range;
use draft::Draft;
use lsystem_base::number::number;
use lsystem_base::words::said;
use lsystem_base::{MAX_ITERATIONS, MAX_TEXT, say, word};
use lsystem_files::text_of;
use lsystem_syntax::Definition;
use mapped::Mapped;
use source::{Lines, Source};
use std::borrow::Cow;
use wrappings::{Fence, Peeled};

/// All systems of a text in another notation.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The name of the notation, such as `Fractint`.
    pub notation: &'static str,
    /// The systems in the order of the text; at least one.
    pub entries: Vec<Entry>,
    /// What became of every byte of the text, in order.
    pub account: Vec<Part>,
}

/// One system of a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The name in the text; empty if the text gives none.
    pub name: String,
    /// The system, which compiles without errors; `None` if it is refused.
    pub definition: Option<Definition>,
    /// The parts that were not carried over, and why.
    pub remarks: Vec<Remark>,
}

/// A part of a text that was not carried over as it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// The line in the text, from 1.
    pub line: usize,
    /// An excerpt of the text; may be empty.
    pub text: String,
    /// The part that was not carried over, and why.
    pub message: String,
    /// Whether the system is refused for this reason.
    pub refused: bool,
    /// The place in the text, in bytes; empty if the remark is about no part of it.
    pub span: Range<usize>,
}

/// The most systems that are read from one text. A reader stops after one more.
pub(crate) const MAX_ENTRIES: usize = 1024;

/// The name of our own notation in JSON, which `lsystem_files::read_file` reads with places in the file.
pub const OWN_JSON: &str = word!("our own JSON");

/// A reader: the drafts of all systems in a text, or `None` if the text is in another notation.
type Reader = for<'a> fn(Source<'a>) -> Option<Vec<Draft<'a>>>;

/// All readers by the name of the notation. The first reader that recognises a text reads it.
const READERS: &[(&str, Reader)] = &[
    (OWN_JSON, own::read),
    (word!("a link"), link::read),
    (word!("our own notation"), labelled::read),
    ("LaTeX", unread::latex),
    ("TikZ", tikz::read),
    ("L+C", unread::l_plus_c),
    ("cpfg", cpfg::read_cpfg),
    ("L-Py", cpfg::read_lpy),
    ("Houdini", houdini::read),
    ("Fractint", fractint::read),
    ("Racket", racket::read),
    (word!("GroIMP’s XL"), unread::xl),
    (word!("a program"), objects::read),
    (word!("anvaka’s page"), anvaka::read),
    (word!("a description"), statements::read),
    (word!("a link"), link::read_within),
];

/// Reads all systems of a text that another program or a person wrote in another notation. Returns `None` if no
/// notation is recognised, and for texts longer than [`MAX_TEXT`].
#[must_use]
pub fn import(text: &str) -> Option<Imported> {
    if text.len() > MAX_TEXT {
        return None;
    }
    // Old line ends of one byte become new ones of one byte, so that places stay.
    let text: &str = &if text.contains('\r') { with_line_ends(text) } else { Cow::Borrowed(text) };
    let Found { notation, mut entries, marks } = Reading::new(text).read(text, 0, false)?;
    if entries.len() > MAX_ENTRIES {
        entries.truncate(MAX_ENTRIES);
        if let Some(last) = entries.last_mut() {
            let message = say!("Only the first {} systems are read", MAX_ENTRIES);
            last.remarks.push(Remark { line: 1, text: String::new(), message, refused: false, span: 0..0 });
        }
    }
    let marks = marks.into_iter().filter(|(at, _)| *at < MAX_ENTRIES).collect();
    Some(Imported { notation, entries, account: account(text.len(), marks) })
}

/// The systems of a text, and the marks on it by system.
struct Found {
    notation: &'static str,
    entries: Vec<Entry>,
    marks: Vec<(usize, Mark)>,
}

/// Reads what is inside the wrappings of texts, as long as the work stays in proportion to the first one.
struct Reading {
    /// How many bytes may still be read once more.
    left: usize,
}

impl Reading {
    /// Wrappings inside one another are taken off this many times.
    const DEEPEST: usize = 3;
    /// The inside of a wrapping is read again, and so is what stands around it: each byte twice for each wrapping. Of a long
    /// text, only the outermost wrappings are sure to be taken off, because all readers look at each byte.
    const MOST_OFTEN: usize = 2 * Self::DEEPEST;
    const MAX_BYTES: usize = 100_000;

    fn new(text: &str) -> Self {
        Self { left: (Self::MOST_OFTEN * text.len()).min(Self::MAX_BYTES).max(2 * text.len()) }
    }

    /// Reads a text: what is inside its wrappings, or else the text itself.
    fn read(&mut self, text: &str, depth: usize, is_rest: bool) -> Option<Found> {
        let lines = Lines::new(text);
        let mut inside = |inner: &Mapped, is_rest| {
            self.left = self.left.checked_sub(inner.text.len())?;
            Some(inner.moved(self.read(&inner.text, depth + 1, is_rest)?, &lines))
        };
        let found = match wrappings::peel(text, is_rest) {
            _ if depth == Self::DEEPEST => None,
            Peeled::Nothing => None,
            Peeled::Whole(inner) => inside(&inner, false),
            Peeled::Parts(parts) => parts.iter().filter_map(|part| inside(part, false)).reduce(Found::and),
            Peeled::Fenced(fences) => {
                let mut read = |fence: &Fence| inside(&wrappings::part(text, fence.inside.clone()), false);
                let mut found: Vec<Option<Found>> = fences.iter().map(&mut read).collect();
                // Blocks that hold no system belong to the text around.
                let passed = fences.iter().zip(&found).flat_map(|(Fence { whole, inside }, found)| match found {
                    Some(_) => vec![whole.clone()],
                    None if text[whole.start..].trim_start().starts_with(['`', '~']) => {
                        vec![whole.start..inside.start, inside.end..whole.end]
                    }
                    None => Vec::new(),
                });
                let rest = inside(&wrappings::without(text, passed), true);
                if rest.is_none() {
                    // What stands before a block is about it, or else what stands behind.
                    for (at, found) in
                        found.iter_mut().enumerate().filter_map(|(at, found)| Some((at, found.as_mut()?)))
                    {
                        let before = at.checked_sub(1).map_or(0, |before| fences[before].whole.end);
                        found.join(text, before..fences[at].whole.start);
                        if at + 1 == fences.len() {
                            found.join(text, fences[at].whole.end..text.len());
                        }
                    }
                }
                match (found.into_iter().flatten().reduce(Found::and), rest) {
                    (Some(found), Some(rest)) => Some(found.unite(rest)),
                    (found, rest) => found.or(rest),
                }
            }
        };
        let found = found.or_else(|| plain(text, &lines));
        // A program may state its system in comments alone.
        let is_refused = |found: &Found| found.entries.iter().all(|entry| entry.definition.is_none());
        if found.as_ref().is_none_or(is_refused)
            && let Some(comments) = wrappings::comments(text)
            && let Some(left) = self.left.checked_sub(comments.text.len())
            && let Some(read) = plain(&comments.text, &Lines::new(&comments.text)).filter(|read| !is_refused(read))
        {
            self.left = left;
            return Some(comments.moved(read, &lines));
        }
        found
    }
}

impl Found {
    /// So many systems of blocks are looked for in the text around.
    const MAX_COMPARED: usize = 32;

    fn and(mut self, other: Self) -> Self {
        let before = self.entries.len();
        self.entries.extend(other.entries);
        self.marks.extend(other.marks.into_iter().map(|(at, mark)| (before + at, mark)));
        self
    }

    /// Adds the systems of a text around. One that is a system of this text said again adds only what that one lacks.
    fn unite(mut self, other: Self) -> Self {
        let own = self.entries.len();
        let mut places = Vec::new();
        for entry in other.entries {
            let same = self.entries[..own.min(Self::MAX_COMPARED)].iter().position(|known| known.is_also(&entry));
            if let Some(same) = same {
                let known = &mut self.entries[same];
                let (no_angle, no_iterations) = entry.lacks();
                let said = entry.definition.as_ref();
                known.complete(
                    said.map(|said| said.angle).filter(|_| !no_angle),
                    said.map(|said| said.iterations).filter(|_| !no_iterations),
                );
            } else {
                self.entries.push(entry);
            }
            places.push(same.unwrap_or(self.entries.len() - 1));
        }
        let marks = other.marks.into_iter().filter_map(|(at, mark)| Some((*places.get(at)?, mark)));
        self.marks.extend(marks);
        self
    }

    /// Completes systems without an angle or a number of iterations by what a part of the text around says.
    fn join(&mut self, text: &str, place: Range<usize>) {
        if !self.entries.iter().any(|entry| entry.lacks() != (false, false)) {
            return;
        }
        let part = wrappings::part(text, place);
        let (angle, n) = statements::beside(&part.text);
        for (at, entry) in self.entries.iter_mut().enumerate() {
            let (joined_angle, joined_n) =
                entry.complete(angle.as_ref().map(|angle| angle.value), n.as_ref().map(|n| n.value));
            let angle = angle.as_ref().filter(|_| joined_angle).map(|a| (&a.span, say!("angle {}", number(a.value))));
            let n = n.as_ref().filter(|_| joined_n).map(|n| (&n.span, format!("n {}", n.value)));
            for (span, words) in angle.into_iter().chain(n) {
                self.marks.push((at, Mark { span: part.span(span), fate: Fate::Read, words }));
            }
        }
    }
}

impl Entry {
    /// Whether the text gave no angle, and no number of iterations.
    fn lacks(&self) -> (bool, bool) {
        let has = |message: &str| self.remarks.iter().any(|remark| remark.message == message);
        let n = self.definition.as_ref().map_or(0, |definition| definition.iterations);
        (has(&said(assembly::NO_ANGLE)), has(&draft::chosen_iterations(n)))
    }

    /// Whether another entry says the same system, as far as both say it.
    fn is_also(&self, other: &Self) -> bool {
        let (Some(own), Some(their)) = (&self.definition, &other.definition) else { return false };
        let plain = |text: &str| text.replace(' ', "");
        let is_lacking = self.lacks().0 || other.lacks().0;
        plain(&own.axiom) == plain(&their.axiom)
            && plain(&own.rules) == plain(&their.rules)
            && (is_lacking || own.angle == their.angle)
    }

    /// Takes over an angle and a number of iterations where the text gave none; which of them it took.
    fn complete(&mut self, angle: Option<f64>, n: Option<u32>) -> (bool, bool) {
        let lacks = self.lacks();
        let Some(definition) = &mut self.definition else { return (false, false) };
        let joined = (angle.filter(|_| lacks.0), n.filter(|n| lacks.1 && *n <= MAX_ITERATIONS));
        let chosen = draft::chosen_iterations(definition.iterations);
        definition.angle = joined.0.unwrap_or(definition.angle);
        definition.iterations = joined.1.unwrap_or(definition.iterations);
        let is_said = |message: &str| {
            joined.0.is_some() && message == said(assembly::NO_ANGLE) || joined.1.is_some() && message == chosen
        };
        self.remarks.retain(|remark| !is_said(&remark.message));
        (joined.0.is_some(), joined.1.is_some())
    }
}

/// Reads a text without wrappings.
fn plain(text: &str, lines: &Lines) -> Option<Found> {
    let source = Source::new(text, lines);
    READERS.iter().find_map(|&(notation, read)| {
        let drafts = read(source).filter(|drafts| !drafts.is_empty())?;
        let mut found = Found { notation, entries: Vec::new(), marks: Vec::new() };
        for (at, draft) in drafts.into_iter().take(MAX_ENTRIES + 1).enumerate() {
            let (entry, marks) = draft.finish();
            found.entries.push(entry);
            found.marks.extend(marks.into_iter().map(|mark| (at, mark)));
        }
        Some(found)
    })
}

/// The text with `\n` for every `\r` that no `\n` follows.
fn with_line_ends(text: &str) -> Cow<'_, str> {
    let mut before_end = text.chars().skip(1).chain([' ']).map(|next| next == '\n');
    let ends = |ch: char, before: bool| if ch == '\r' && !before { '\n' } else { ch };
    text.chars().map(|ch| ends(ch, before_end.next().unwrap_or_default())).collect()
}

/// Reads all systems of a file, as [`import`] does. Characters that are not UTF-8, as in old comments, are replaced.
/// Returns `None` for pictures and for texts of no known notation.
#[must_use]
pub fn import_file(bytes: &[u8]) -> Option<Imported> {
    import(&text_of(bytes)?)
}
