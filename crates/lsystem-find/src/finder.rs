//! The search for the rules of a picture, of whose system some properties are known.

use crate::angles::suggested;
use crate::drawn::{Drawn, keep};
use crate::lattice::Lattices;
use crate::overlay::FOUND;
use crate::{Known, Named, Picture, PictureSearch, Question, Searched, Share};
use lsystem_base::say;
use lsystem_base::sorted;
use lsystem_base::words::shown;
use lsystem_drawing::System;
use std::collections::VecDeque;
use std::sync::Arc;

/// The first headings that are tried where none is known, in degrees.
const HEADINGS: [f64; 5] = [90.0, 0.0, 60.0, 45.0, 30.0];
/// The numbers of derivation steps that are tried where theirs is not known.
const STEPS: [u32; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
/// The axioms that are tried at every angle where none is known.
const AXIOMS: [&str; 2] = ["F", "X"];
/// The fewest and the most sides of polygons that are tried as axioms.
const SIDES: [usize; 2] = [3, 6];
/// The number of systems that a search tries before the next search's turn.
const SHARE: u64 = 2048;
/// How often rules are read off the picture for each of the most usual axioms, with the likeliest angle, before systems are
/// enumerated. Plants of textbooks are found within fifty times.
const READS: u64 = 96;
/// The number of these axioms.
const READ_AXIOMS: usize = AXIOMS.len();
/// The work of reading once, in systems whose hulls are tried.
const READ: u64 = 1024;
/// The work of drawing a system with a name, in systems whose hulls are tried.
const NAMED: u64 = 32;

/// A search for the rules of a picture, in steps. It can be dropped at any time.
///
/// Each axiom with each angle is searched by itself; the more usual ones get more of the work.
#[derive(Clone, Debug)]
pub struct Finder {
    picture: Arc<Picture>,
    question: Question,
    share: Share,
    /// The systems with names that are still to be tried, each after some steps.
    named: VecDeque<(Arc<Named>, Arc<System>, u32)>,
    searches: Vec<Part>,
    /// The searches that read rules off the picture before systems are enumerated, and how often each still does.
    reads: VecDeque<(usize, u64)>,
    steps: Vec<u32>,
    kept: Vec<Drawn>,
    /// The work of the picture that is still to be counted.
    owed: u64,
    /// The search that goes on now, and how many systems are left before the next one's turn.
    turn: (usize, u64),
}

/// The search of one axiom with one angle.
#[derive(Clone, Debug)]
struct Part {
    axiom: String,
    angle: f64,
    search: PictureSearch,
    /// The rank of the axiom and the angle: 0 for the most usual ones.
    rank: u64,
}

impl Finder {
    /// A search that tries its share of the systems.
    ///
    /// # Errors
    /// Why this cannot be searched.
    pub fn new(picture: &Arc<Picture>, question: &Question, share: Share) -> Result<Self, &'static str> {
        let headings = question.heading.map_or(HEADINGS.to_vec(), |heading| vec![heading]);
        let angles = question.angle.map_or_else(
            || {
                let closed = question.axiom.as_deref().and_then(closing_angle);
                let other = suggested(picture, &headings).into_iter().filter(|&angle| Some(angle) != closed);
                closed.into_iter().chain(other).collect()
            },
            |angle| vec![angle],
        );
        let steps = question.n.map_or(STEPS.to_vec(), |n| vec![n]);
        let (mut searches, mut lattices) = (Vec::new(), Lattices::default());
        for (&angle, usual) in angles.iter().zip(1..) {
            let axioms = question.axiom.clone().map_or_else(|| axioms(angle), |axiom| vec![axiom]);
            for (axiom, rank) in axioms.into_iter().zip(1..) {
                let (headings, steps, draws) = (headings.clone(), steps.clone(), question.draws.clone());
                let known = Known { axiom: axiom.clone(), angle, headings, steps, draws };
                let search = PictureSearch::sharing(&mut lattices, picture.clone(), known, share)?;
                searches.push(Part { axiom, angle, search, rank: rank * usual });
            }
        }
        let (picture, question) = (picture.clone(), question.clone());
        let owed = picture.work / share.count;
        // The searches of the likeliest angle come first.
        let reads = (0..searches.len().min(READ_AXIOMS)).map(|at| (at, READS)).collect();
        let (named, kept) = (VecDeque::new(), Vec::new());
        Ok(Self { picture, question, share, named, searches, reads, steps, kept, owed, turn: (0, 0) })
    }

    /// Tries systems with names before all others: each after its own number of steps first, and after others then. Those
    /// that are not what is known are left out. All parallel searches are given the same systems, and share them.
    pub fn try_first(&mut self, systems: impl IntoIterator<Item = Named>) {
        let own: Vec<(Arc<Named>, Arc<System>)> = (systems.into_iter().zip(0_u64..))
            .filter(|(_, number)| self.share.contains(*number))
            .filter_map(|(named, _)| named.compiled(&self.question).map(|system| (Arc::new(named), Arc::new(system))))
            .collect();
        let usual = |named: &Named, n: u32| named.definition.iterations == n;
        let steps = |named: &Named| match self.question.n {
            Some(n) => vec![n],
            None => STEPS.into_iter().chain([named.definition.iterations]).collect(),
        };
        for is_usual in [true, false] {
            for (named, system) in &own {
                let mut steps = steps(named);
                sorted::sort(&mut steps);
                steps.dedup();
                let steps = steps.into_iter().filter(|&n| usual(named, n) == is_usual);
                self.named.extend(steps.map(|n| (named.clone(), system.clone(), n)));
            }
        }
    }

    /// Tries about `systems` systems, or fewer that are like the picture: those are more work.
    pub fn step(&mut self, systems: u64) -> Searched {
        self.step_until(systems, &|| false)
    }

    /// As [`Finder::step`], but ends early once `is_over` says so, which is asked after each piece of work. Where a step
    /// ends early, the systems that were tried depend on when.
    pub fn step_until(&mut self, systems: u64, is_over: &dyn Fn() -> bool) -> Searched {
        let paid = systems.min(self.owed);
        self.owed -= paid;
        let mut work = systems - paid;
        while work > 0 && !is_over() {
            if let Some((named, system, n)) = self.named.pop_front() {
                let (drawn, spent) = named.drawn(&system, n, &self.picture);
                drawn.into_iter().for_each(|drawn| keep(&mut self.kept, drawn));
                work = work.saturating_sub(NAMED + spent);
                continue;
            }
            if self.is_same() {
                // Shorter rules are enumerated.
                self.reads.clear();
            }
            if let Some((at, left)) = self.reads.pop_front() {
                let search = &mut self.searches[at].search;
                if search.read(&mut work, is_over) && left > 1 {
                    self.reads.push_back((at, left - 1));
                }
                search.found().iter().for_each(|drawn| keep(&mut self.kept, drawn.clone()));
                work = work.saturating_sub(READ);
                continue;
            }
            if self.turn.1 == 0 {
                let open = self.searches.iter().enumerate().filter(|(_, part)| !part.search.is_done());
                let Some((at, _)) = open.min_by_key(|(_, part)| part.search.tried() * part.rank) else {
                    return Searched::All;
                };
                self.turn = (at, SHARE);
            }
            let search = &mut self.searches[self.turn.0].search;
            let before = search.tried();
            search.advance(self.turn.1.min(work), &mut work, is_over);
            let tried = search.tried() - before;
            // A search that has no more systems may still have plants and curves.
            work = if tried == 0 { work.saturating_sub(SHARE) } else { work };
            self.turn.1 = if tried == 0 { 0 } else { self.turn.1 - tried };
            for drawn in search.found() {
                keep(&mut self.kept, drawn.clone());
            }
        }
        Searched::More
    }

    /// The number of systems tried by all parallel searches, if each is as far as this one. Equal numbers stand for
    /// equal systems.
    #[must_use]
    pub fn tried(&self) -> u64 {
        self.searches.iter().map(|part| part.search.tried()).sum()
    }

    /// The systems that draw the picture or nearly do, best first.
    #[must_use]
    pub fn found(&self) -> &[Drawn] {
        &self.kept
    }

    /// Whether a system draws the picture or nearly so.
    #[must_use]
    pub fn is_found(&self) -> bool {
        self.kept.first().is_some_and(|drawn| drawn.agreement >= FOUND)
    }

    /// Whether a system draws the same picture.
    #[must_use]
    pub fn is_same(&self) -> bool {
        self.kept.first().is_some_and(Drawn::is_same)
    }

    /// The extent of the search, in words.
    #[must_use]
    pub fn searched(&self) -> String {
        merged(&[self]).1
    }
}

/// The axioms that are tried with an angle, the most usual ones first.
fn axioms(angle: f64) -> Vec<String> {
    let turns = 360.0 / angle;
    let mut axioms = AXIOMS.map(str::to_owned).to_vec();
    // Smaller angles are refused by the search.
    if turns <= 36_000.0 && (turns - turns.round()).abs() < 1e-9 {
        let turns = turns.round() as usize;
        let sides = (SIDES[0]..=SIDES[1]).rev().filter(|&sides| turns.is_multiple_of(sides));
        axioms.extend(sides.map(|sides| vec!["F"; sides].join(&"+".repeat(turns / sides))));
    }
    axioms
}

/// The angle that closes a polygon, such as `F-F-F-F`, whose corners have equal turns.
fn closing_angle(axiom: &str) -> Option<f64> {
    let sides = axiom.trim_matches(['+', '-']).split(['+', '-']).filter(|side| !side.is_empty()).count();
    let corners: Vec<&str> =
        axiom.split(|at: char| at.is_ascii_alphabetic()).filter(|turns| !turns.is_empty()).collect();
    let corner = corners.last()?;
    let is_regular = axiom.trim_matches(['+', '-']).split(corner).filter(|side| side.len() == 1).count() == sides;
    (sides >= SIDES[0] && is_regular).then(|| 360.0 / (sides * corner.len()) as f64)
}

/// The merged result of searches that ran in parallel: the systems that draw the picture, or the closest ones if none
/// does, best first; and the extent of all searches together, in words.
#[must_use]
pub fn merged(finders: &[&Finder]) -> (Vec<Drawn>, String) {
    let mut kept = Vec::new();
    finders.iter().flat_map(|finder| finder.found()).for_each(|drawn| keep(&mut kept, drawn.clone()));
    let is_found = kept.first().is_some_and(|drawn: &Drawn| drawn.agreement >= FOUND);
    kept.retain(|drawn| !is_found || drawn.agreement >= FOUND);
    (kept, searched(finders))
}

/// Up to how many symbols all searches have searched each family. An angle counts from its first search on.
fn searched(finders: &[&Finder]) -> String {
    let Some(first) = finders.first() else { return say!("nothing") };
    // For each axiom its families, with the symbols that were searched with all angles that were begun.
    let mut axioms: Vec<(&str, Vec<(String, usize)>)> = Vec::new();
    let mut angles: Vec<f64> = Vec::new();
    for (at, part) in first.searches.iter().enumerate() {
        let searches = || finders.iter().filter_map(|finder| finder.searches.get(at));
        if searches().any(|part| part.search.tried() == 0) {
            continue;
        }
        if !angles.contains(&part.angle) {
            angles.push(part.angle);
        }
        for part in searches() {
            let families = part.search.searched();
            match axioms.iter_mut().find(|(axiom, _)| *axiom == part.axiom) {
                Some((_, least)) => {
                    least.iter_mut().zip(families).for_each(|(least, (_, most))| least.1 = least.1.min(most));
                }
                None => axioms.push((&part.axiom, families)),
            }
        }
    }
    let list = |values: Vec<String>| values.join(", ");
    let families = |(axiom, families): &(&str, Vec<(String, usize)>)| {
        let families: Vec<String> =
            families.iter().map(|(name, most)| say!("{} up to {} symbols", name, most)).collect();
        say!("from {}: {}", axiom, families.join("; "))
    };
    let words: Vec<String> = axioms.iter().map(families).collect();
    let angles = list(angles.iter().map(|angle| format!("{}°", shown(&angle.to_string()))).collect());
    let steps = list(first.steps.iter().map(u32::to_string).collect());
    if words.is_empty() { say!("nothing yet") } else { say!("angle {}; n = {}: {}", angles, steps, words.join("; ")) }
}
