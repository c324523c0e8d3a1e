//! The systems that a search keeps.

use crate::hull::{Fit, Target};
use crate::picture::Picture;
use crate::strokes::Strokes;
use crate::{Found, printed};
use lsystem_base::Limits;
use lsystem_drawing::{Plane, draw};
use lsystem_syntax::{Definition, Dialect};
use std::iter::once;

/// The least agreement of a system that counts as found: it draws the picture or nearly so, and the search may end.
pub const FOUND: f64 = 0.985;
/// Of systems that draw the picture, those whose agreement is less than the best one's by at least this come after the
/// others, however short they are.
const AS_GOOD: f64 = 0.005;
/// The most systems that are kept.
const MAX_KEPT: usize = 20;
/// The most segments of a drawing that is drawn again to confirm a system.
const MAX_CONFIRMED: u64 = 100_000;

/// A system that draws the picture, or nearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// The axiom.
    pub axiom: String,
    /// Its rules and the number of derivation steps.
    pub found: Found,
    /// The letters that draw.
    pub draws: String,
    /// In degrees.
    pub angle: f64,
    /// The first heading, in degrees counter-clockwise from the right.
    pub heading: f64,
    /// How much of the ink agrees, from 0 to 1.
    pub agreement: f64,
}

impl Drawn {
    /// Whether the system draws the same picture: each has no ink more than a pixel beside that of the other, at a size of
    /// 512 pixels. Less is nearly the same, however little of the ink differs: small parts may be others.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.agreement >= 1.0
    }

    /// The agreement in percent, rounded down to a tenth, so that 100.0 is the same picture.
    #[must_use]
    pub fn percent(&self) -> f64 {
        (self.agreement * 1000.0 + 1e-9).floor() / 10.0
    }

    /// The system as a definition that draws the picture.
    #[must_use]
    pub fn definition(&self) -> Definition {
        let usual = |letter: char| !Dialect::default().actions(letter).is_empty();
        let letters =
            self.axiom.chars().chain(self.found.rules.iter().flat_map(|(from, to)| once(*from).chain(to.chars())));
        let mut letters: Vec<char> = letters.filter(char::is_ascii_alphabetic).collect();
        letters.sort_unstable();
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

    /// Measures the agreement once more, with the drawing of the definition, unless that has too many segments.
    pub(crate) fn confirm(&mut self, target: &Target, picture: &Picture, fit: Fit) {
        let limits = Limits { segments: MAX_CONFIRMED, ..Limits::default() };
        let Some(system) = lsystem_drawing::System::new(&self.definition()).0 else {
            self.agreement = 0.0;
            return;
        };
        let Ok(drawing) = draw::<Plane>(&system, self.found.n, &limits) else { return };
        if drawing.segment_count() <= u128::from(MAX_CONFIRMED) {
            let segments = drawing.segments().map(|segment| [segment.from, segment.to]);
            self.agreement = Strokes::of_segments(segments, target).agreement(target, picture, fit);
        }
    }
}

/// Adds a system to those that are kept, best first.
pub(crate) fn keep(kept: &mut Vec<Drawn>, drawn: Drawn) {
    let is_same = |other: &Drawn| {
        let names = |drawn: &Drawn| (drawn.axiom.clone(), drawn.found.clone(), drawn.draws.clone());
        names(other) == names(&drawn) && other.angle == drawn.angle
    };
    if kept.iter().any(is_same) {
        return;
    }
    kept.push(drawn);
    let best = kept.iter().map(|drawn| drawn.agreement).fold(0.0, f64::max);
    kept.sort_by(|a, b| {
        let found = |drawn: &Drawn| drawn.agreement >= FOUND && drawn.agreement > best - AS_GOOD;
        let by_size = a.found.symbols().cmp(&b.found.symbols());
        let by_agreement = b.agreement.total_cmp(&a.agreement);
        let order = if found(a) { by_size.then(by_agreement) } else { by_agreement.then(by_size) };
        found(b).cmp(&found(a)).then(order).then_with(|| a.found.text().cmp(&b.found.text()))
    });
    kept.truncate(MAX_KEPT);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_systems_come_first_if_they_are_as_good() {
        let mut kept = Vec::new();
        for (successor, agreement) in [("FFF+F", 1.0), ("F+F", 0.986), ("F[+F]F", 0.998), ("FF", 0.9)] {
            let found = Found { rules: vec![('F', successor.to_owned())], n: 4 };
            let (axiom, draws) = ("F".to_owned(), "F".to_owned());
            keep(&mut kept, Drawn { axiom, found, draws, angle: 60.0, heading: 90.0, agreement });
        }
        let order: Vec<&str> = kept.iter().map(|drawn| drawn.found.rules[0].1.as_str()).collect();
        assert_eq!(order, ["FFF+F", "F[+F]F", "F+F", "FF"]);
    }
}
