//! The output of a program, compared with a generation of a system: its string, or its segments.
//!
//! The comparison names the first difference. Before that it looks for the usual reasons: another generation, rules
//! applied one after another instead of all at once, a picture that is turned, mirrored, or in another order.

mod messages;
mod segments;
mod string;

use crate::compiled::compiled;
use lsystem_base::say;
use lsystem_base::{Limits, MAX_ITERATIONS};
use lsystem_derive::Tally;
use lsystem_files::read_segments;
use lsystem_syntax::{Definition, Diagnostic};

/// The most bytes of an output that is read.
pub const MAX_OUTPUT: usize = 16 << 20;
/// The most segments of an output, and of a generation that is compared with segments.
const MAX_SEGMENTS: usize = 250_000;
/// Generations up to this many steps away are compared, too.
const NEAR: u32 = 20;
/// The same, where the symbols of a generation cannot be counted without deriving it.
const NEAR_UNCOUNTED: u32 = 2;
/// The limits of a generation that is derived or drawn as a whole: what the page can hold beside the output.
const LIMITS: Limits =
    Limits { symbols: 16 << 20, modules: 2 << 20, segments: 500_000, work: 16 << 20, memory: 96 << 20 };

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The kind of output that was recognised.
    pub output: Output,
    /// The generation that was asked for.
    pub generation: u32,
    /// The number of symbols or segments of the generation; `None` if it is unknown or too large to compare.
    pub expected: Option<u128>,
    /// The number of symbols or segments in the output.
    pub found: u64,
    /// The result.
    pub verdict: Verdict,
}

/// The kinds of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// A string of symbols.
    Text,
    /// Segments of an SVG picture.
    Svg,
    /// Segments of a table.
    Table,
}

/// Whether an output is right, and the difference if not.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The output is right: the same string, or the same segments in the same order up to place and size.
    Same,
    /// The same segments in another order, or with repeats. The picture is right.
    Reordered,
    /// The same segments, but the picture is turned by this many degrees counter-clockwise, after it was mirrored left
    /// to right if `is_mirrored`.
    Placed {
        /// 0, 90, 180 or 270.
        degrees: u32,
        /// Whether the picture is mirrored.
        is_mirrored: bool,
    },
    /// The output is another generation.
    Generation(u32),
    /// The string that results if the rules are applied one after another in each step, instead of all at once.
    OneAfterAnother,
    /// The strings differ.
    Symbol(SymbolDifference),
    /// The segments differ, first at this place (0-based). Each is given as written: the expected one in model units,
    /// the found one as in the output. `None` where the segments end.
    Segment {
        /// The 0-based number of the segment.
        index: u64,
        /// The segment of the system.
        expected: Option<[[f64; 3]; 2]>,
        /// The segment of the output.
        found: Option<[[f64; 3]; 2]>,
    },
    /// The output cannot be read, for this reason.
    Unreadable(String),
    /// The system has errors, or the generation is too large.
    Failed(Vec<Diagnostic>),
}

/// The first difference of two strings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SymbolDifference {
    /// The number of equal symbols before the difference.
    pub index: u64,
    /// The last equal symbols before it.
    pub before: String,
    /// The symbols expected from here on; empty at the end.
    pub expected: String,
    /// The symbols found from here on; empty at the end.
    pub found: String,
    /// The generation (1-based) and the production that made the expected symbol, if a production made it and all
    /// symbols can be counted.
    pub made_by: Option<(u32, String)>,
}

impl Check {
    /// Whether the output is right: the same string, or the same picture.
    #[must_use]
    pub fn is_right(&self) -> bool {
        matches!(self.verdict, Verdict::Same | Verdict::Reordered)
    }
}

/// Compares what a program printed with the generation that a definition asks for.
///
/// An SVG picture and a table of coordinates are compared as segments, up to place and size and within their rounding.
/// Any other text is compared as a string. White space in it does not count, unless white space is a symbol of the
/// system.
///
/// The work grows in proportion to the output and the generation. Outputs of more than 16 MiB or 250,000 segments are
/// not read, and at most 16 million symbols are derived that are not in the output.
#[must_use]
pub fn check(definition: &Definition, output: &str) -> Check {
    let generation = definition.iterations;
    let refused = |output, verdict| Check { output, generation, expected: None, found: 0, verdict };
    if output.len() > MAX_OUTPUT {
        let reason = say!("the output has more than {} MiB", MAX_OUTPUT >> 20);
        return refused(Output::Text, Verdict::Unreadable(reason));
    }
    let system = match compiled(definition) {
        Ok(system) => system,
        Err(errors) => return refused(Output::Text, Verdict::Failed(errors)),
    };
    // A string may begin with `<`, which is a symbol.
    let is_xml = output.trim_start_matches('\u{feff}').trim_start().starts_with('<');
    let read = if is_xml && !output.contains("<svg") { None } else { read_segments(output, MAX_SEGMENTS) };
    match read {
        Some(Ok(file)) => segments::check(&system, generation, &file),
        Some(Err(error)) => {
            refused(if is_xml { Output::Svg } else { Output::Table }, Verdict::Unreadable(error.to_string()))
        }
        None => string::check(&system, generation, output),
    }
}

/// The generations near `n`, nearest first, that may have `found` symbols or segments. `count` counts those of a
/// generation, if that is possible.
fn candidates(n: u32, found: u64, count: impl Fn(u32) -> Option<Tally>) -> impl Iterator<Item = u32> {
    let near = (1..=NEAR).flat_map(move |step| [n.checked_sub(step), n.checked_add(step)]).flatten();
    near.filter(move |&other| {
        other <= MAX_ITERATIONS
            && match count(other) {
                Some(count) => count == Tally::from(found),
                None => other.abs_diff(n) <= NEAR_UNCOUNTED,
            }
    })
}
