//! The systems that a search keeps.

use crate::hull::{Fit, Target};
use crate::overlay::{FOUND, LIMITS, MAX_SEGMENTS, NOT_THE_SAME, judged};
use crate::picture::Picture;
use crate::strokes::{NEAR, Strokes};
use crate::{Found, printed};
use lsystem_base::sorted;
use lsystem_drawing::{Plane, draw};
use lsystem_syntax::{Definition, Dialect};
use std::cmp::Reverse;
use std::iter::once;
use std::sync::Arc;

/// Of systems that draw the picture, those whose agreement is less than the best one's by at least this come after the
/// others, however short they are.
const AS_GOOD: f64 = 0.005;
/// The most systems that are kept.
const MAX_KEPT: usize = 20;
/// More turns in a row than this are unusual in a successor.
const MAX_TURNS: usize = 2;
/// The rank of a successor that is written in another way than usual: all usual ones of its length come before it.
const UNUSUAL: usize = 1000;

/// A system with its name, given by the caller.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// In words, such as "Koch curve".
    pub name: String,
    /// The system. Its style does not matter.
    pub definition: Definition,
}

/// A system that draws the picture, or nearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The axiom.
    pub axiom: String,
    /// Its rules and the number of derivation steps. A system with a name has its rules in [`Drawn::definition`] only,
    /// because they may be of any kind.
    pub found: Found,
    /// The letters that draw.
    pub draws: String,
    /// In degrees.
    pub angle: f64,
    /// The first heading, in degrees counter-clockwise from the right.
    pub heading: f64,
    /// How much of the ink agrees, from 0 to 1; 1 only if [`Drawn::is_same`].
    pub agreement: f64,
    /// The system with a name that this is, if a search was given such systems.
    pub named: Option<Arc<Named>>,
}

impl Drawn {
    /// Whether the system draws the same picture: the skeletons of both agree within a stroke width in both directions, and
    /// nothing is left over. Less is nearly the same, however little of the ink differs: small parts may be others.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.agreement >= 1.0
    }

    /// The agreement in percent, rounded down to a tenth, so that 100.0 is the same picture.
    #[must_use]
    pub fn percent(&self) -> f64 {
        (self.agreement * 1000.0 + 1e-9).floor() / 10.0
    }

    /// The rules in our notation, one on each line.
    #[must_use]
    pub fn rules(&self) -> String {
        self.named.as_ref().map_or_else(|| self.found.text(), |named| named.definition.rules.clone())
    }

    /// The number of symbols of all rules, with their predecessors.
    #[must_use]
    pub fn symbols(&self) -> usize {
        let of_line = |line: &str| without_spaces(line).chars().count().saturating_sub("->".len());
        let of_text = |text: &str| text.lines().filter(|line| line.contains("->")).map(of_line).sum();
        self.named.as_ref().map_or_else(|| self.found.symbols(), |named| of_text(&named.definition.rules))
    }

    /// Two systems with equal keys are the same system.
    #[must_use]
    pub fn key(&self) -> String {
        let mut lines: Vec<String> = self.rules().lines().map(without_spaces).collect();
        lines.retain(|line| !line.is_empty());
        sorted::sort(&mut lines);
        let (axiom, mut draws) = (without_spaces(&self.axiom), self.draws.chars().collect::<Vec<_>>());
        sorted::sort(&mut draws);
        let draws: String = draws.into_iter().filter(|&at| axiom.contains(at) || self.rules().contains(at)).collect();
        format!("{axiom} {} {} {draws} {}", lines.join(" "), self.angle, self.found.n)
    }

    /// The rank among systems that agree as well, smallest first. Systems with names come first, then those that are
    /// written as books do: no successor begins or ends with a turn, or has many turns in a row. Of these, few symbols and
    /// few steps come first.
    #[must_use]
    pub fn rank(&self) -> usize {
        if self.named.is_some() {
            return 0;
        }
        let is_turn = |symbol: char| symbol == '+' || symbol == '-';
        let is_usual = |(_, word): &(char, String)| {
            let runs = word.split(|symbol| !is_turn(symbol)).map(str::len);
            !word.starts_with(is_turn) && !word.ends_with(is_turn) && runs.max().unwrap_or(0) <= MAX_TURNS
        };
        let unusual = self.found.rules.iter().filter(|rule| !is_usual(rule)).count();
        1 + unusual * UNUSUAL + self.found.symbols() + self.found.n as usize
    }

    /// The system as a definition that draws the picture.
    #[must_use]
    pub fn definition(&self) -> Definition {
        if let Some(named) = &self.named {
            return Definition { iterations: self.found.n, ..named.definition.clone() };
        }
        let usual = |letter: char| !Dialect::default().actions(letter).is_empty();
        let letters =
            self.axiom.chars().chain(self.found.rules.iter().flat_map(|(from, to)| once(*from).chain(to.chars())));
        let mut letters: Vec<char> = letters.filter(char::is_ascii_alphabetic).collect();
        sorted::sort(&mut letters);
        letters.dedup();
        let line = |&letter: &char| match (self.draws.contains(letter), usual(letter)) {
            (true, _) if !['F', 'G'].contains(&letter) => Some(format!("{letter}: draw")),
            (false, true) => Some(format!("{letter}: nothing")),
            _ => None,
        };
        Definition {
            axiom: printed(&self.axiom),
            rules: self.found.text(),
            iterations: self.found.n,
            angle: self.angle,
            heading: self.heading,
            overrides: letters.iter().filter_map(line).collect::<Vec<_>>().join("\n"),
            ..Definition::default()
        }
    }

    /// Measures the agreement once more, with the drawing of the definition. A drawing with too many segments is not called
    /// the same. Returns the work in systems that are unlike the picture.
    pub(crate) fn confirm(&mut self, target: &Target, picture: &Picture, fit: Fit) -> u64 {
        let Ok(system) = lsystem_drawing::System::new(&self.definition()) else {
            self.agreement = 0.0;
            return 0;
        };
        self.agreement = self.agreement.min(NOT_THE_SAME);
        let Ok(drawing) = draw::<Plane>(&system, self.found.n, &LIMITS) else { return 0 };
        if drawing.segment_count() > u128::from(MAX_SEGMENTS) {
            return 0;
        }
        let segments = drawing.segments().map(|segment| [segment.from, segment.to]);
        let strokes = Strokes::of_segments(segments, target.first, fit.unit);
        self.agreement = judged(&strokes, target.first, picture, fit).0;
        strokes.work(fit, picture) + picture.sheet.work()
    }

    /// The order of systems, best first: the same picture, nearly the same, and less like it.
    fn order(&self, best: f64) -> impl Ord + use<> {
        let is_found = self.agreement >= FOUND && self.agreement > best - AS_GOOD;
        // The bits of positive numbers are in the order of the numbers.
        let agreement = Reverse(self.agreement.max(0.0).to_bits());
        let (rank, text) = (self.rank(), self.rules());
        let (first, second) = if is_found { (Reverse(0), Some(rank)) } else { (agreement, None) };
        (!self.is_same(), !is_found, first, second, agreement, rank, text)
    }
}

/// Adds a system to those that are kept, best first. If none is near the picture, the nearest one is kept.
pub(crate) fn keep(kept: &mut Vec<Drawn>, mut drawn: Drawn) {
    let key = drawn.key();
    if let Some(at) = kept.iter().position(|other| other.key() == key) {
        // A search may place the same rules more exactly. The name stays with them.
        let other = kept.remove(at);
        let name = other.named.clone().or_else(|| drawn.named.clone());
        let is_better = drawn.agreement > other.agreement;
        drawn = Drawn { named: name, ..if is_better { drawn } else { other } };
    }
    kept.push(drawn);
    let best = kept.iter().map(|drawn| drawn.agreement).fold(0.0, f64::max);
    sorted::sort_by_key(kept, |drawn| drawn.order(best));
    let near = kept.iter().filter(|drawn| drawn.agreement >= NEAR).count();
    kept.truncate(near.clamp(1, MAX_KEPT));
}

pub(crate) fn without_spaces(text: &str) -> String {
    text.chars().filter(|symbol| !symbol.is_whitespace()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_systems_come_first_if_they_are_as_good() {
        let mut kept = Vec::new();
        for (successor, agreement) in [("FFF+F", 1.0), ("F+F", 0.986), ("F[+F]F", 0.998), ("FF", 0.9)] {
            keep(&mut kept, drawn(successor, 4, agreement));
        }
        let order: Vec<&str> = kept.iter().map(|drawn| drawn.found.rules[0].1.as_str()).collect();
        assert_eq!(order, ["FFF+F", "F[+F]F", "F+F", "FF"]);
    }

    fn drawn(successor: &str, n: u32, agreement: f64) -> Drawn {
        let found = Found { rules: vec![('F', successor.to_owned())], n };
        let (axiom, draws) = ("F".to_owned(), "F".to_owned());
        Drawn { axiom, found, draws, angle: 60.0, heading: 90.0, agreement, named: None }
    }

    #[test]
    fn rules_as_books_write_them_come_first() {
        let systems = [("+++F+F", 8), ("F+F--F+F", 4), ("F-F++F-F-", 4), ("F+F----F+F", 4), ("F-F++F-F", 8)];
        let mut kept = Vec::new();
        systems.iter().for_each(|&(successor, n)| keep(&mut kept, drawn(successor, n, 1.0)));
        let order: Vec<_> = kept.iter().map(|drawn| (drawn.found.rules[0].1.as_str(), drawn.found.n)).collect();
        assert_eq!(order, [("F+F--F+F", 4), ("F-F++F-F", 8), ("F-F++F-F-", 4), ("+++F+F", 8), ("F+F----F+F", 4)]);
        // A name comes before all, and stands for the same system without one.
        let definition =
            Definition { rules: "F -> F-F++F-F".to_owned(), axiom: "F".to_owned(), ..drawn("F", 8, 1.0).definition() };
        let named =
            Drawn { named: Some(Arc::new(Named { name: "Koch curve".to_owned(), definition })), ..drawn("", 8, 1.0) };
        keep(&mut kept, named.clone());
        assert_eq!((kept.len(), kept[0].named.is_some()), (5, true));
        keep(&mut kept, drawn("F-F++F-F", 8, 1.0));
        assert_eq!((kept.len(), kept[0].symbols(), kept[0].rules()), (5, 9, "F -> F-F++F-F".to_owned()));
    }
}
