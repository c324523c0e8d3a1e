//! The search for the rules of a picture.

use crate::drawn::{Drawn, keep};
use crate::family::{Family, MAX_SYMBOLS, families};
use crate::hull::{Fit, Hulls, System, Target};
use crate::lattice::Lattices;
use crate::overlay::FOUND;
use crate::picture::Picture;
use crate::source::Sources;
use crate::strokes::{NEAR, Strokes};
use crate::successors::Symbol;
use crate::{Found, Searched, Share};
use lsystem_base::word;
use std::sync::Arc;

/// The most derivation steps.
const MAX_STEPS: u32 = 12;
/// The number of systems that a family tries before the next family's turn.
const SHARE: u64 = 256;
/// The length of the shortest lines, in pixels, where the number of derivation steps is not known: what shorter ones draw
/// is as well seen after fewer steps.
const SHORTEST: f64 = 1.0;
/// The number of systems that are tried between two questions whether the search is over.
const UNASKED: u64 = 16;

/// The known properties of a picture's system.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Letters, turns and branches.
    pub axiom: String,
    /// In degrees.
    pub angle: f64,
    /// The first headings to try, in degrees counter-clockwise from the right.
    pub headings: Vec<f64>,
    /// The numbers of derivation steps to try, in ascending order.
    pub steps: Vec<u32>,
    /// The letters that draw, if they are known.
    pub draws: Option<String>,
}

/// A search for the rules of a picture, in steps. It can be dropped at any time.
///
/// Each family of systems is searched by itself, with one symbol more in each round, so its shortest systems are found
/// first.
#[derive(Clone, Debug)]
pub struct PictureSearch {
    picture: Arc<Picture>,
    /// The picture as seen with each heading.
    targets: Vec<Target>,
    known: Known,
    families: Vec<Family>,
    sources: Sources,
    hulls: Hulls,
    /// The successors of the present system.
    words: Vec<Vec<Symbol>>,
    kept: Vec<Drawn>,
    /// The family that is searched now, and how many systems are left before the next one's turn.
    turn: (usize, u64),
    share: Share,
}

impl PictureSearch {
    /// A search that tries its share of the systems.
    ///
    /// # Errors
    /// Why this cannot be searched.
    pub fn new(picture: Arc<Picture>, known: Known, share: Share) -> Result<Self, &'static str> {
        Self::sharing(&mut Lattices::default(), picture, known, share)
    }

    /// As [`PictureSearch::new`], with the lattices that other searches on the same picture have, too.
    pub(crate) fn sharing(
        lattices: &mut Lattices,
        picture: Arc<Picture>,
        known: Known,
        share: Share,
    ) -> Result<Self, &'static str> {
        if !(known.angle >= 0.01 && known.angle <= 360.0 && known.headings.iter().all(|heading| heading.is_finite())) {
            return Err(word!("an angle from 0.01 to 360 degrees is expected"));
        }
        if known.steps.is_empty() || known.steps.iter().any(|&n| n == 0 || n > MAX_STEPS) {
            return Err(word!("1 to 12 derivation steps are expected"));
        }
        let targets =
            known.headings.iter().map(|&heading| Target::new(&picture, known.angle, heading)).collect::<Vec<_>>();
        let Some(first) = targets.first() else { return Err(word!("a first heading is expected")) };
        let mut families = families(&known.axiom, first.headings.order())?;
        if let Some(draws) = &known.draws {
            families.retain(|family| family.letters.iter().all(|(letter, drawn, _)| *drawn == draws.contains(*letter)));
            if families.is_empty() {
                return Err(word!("the letters that draw are expected to be in the axiom, or F or G"));
            }
        }
        let sources = Sources::new(&targets, &families, share, lattices);
        Ok(Self {
            picture,
            targets,
            known,
            families,
            sources,
            hulls: Hulls::default(),
            words: Vec::new(),
            kept: Vec::new(),
            turn: (0, 0),
            share,
        })
    }

    /// Tries about `systems` systems, or fewer that are like the picture: those are more work.
    pub fn step(&mut self, systems: u64) -> Searched {
        self.advance(systems, &mut { systems }, &|| false);
        if self.is_done() { Searched::All } else { Searched::More }
    }

    pub(crate) fn is_done(&self) -> bool {
        self.sources.is_done() && self.families.iter().all(|family| family.round > MAX_SYMBOLS)
    }

    /// The number of systems tried by this search and by those that run in parallel with it.
    pub(crate) fn tried(&self) -> u64 {
        self.families.iter().map(|family| family.tried).sum()
    }

    /// Tries at most so many systems, and ends where the work is done: in which order systems are tried does not depend
    /// on it. It ends early once `is_over` says so.
    pub(crate) fn advance(&mut self, systems: u64, work: &mut u64, is_over: &dyn Fn() -> bool) {
        self.read(work, is_over);
        for number in 0..systems {
            if number % UNASKED == 0 && is_over() {
                return;
            }
            if self.turn.1 == 0 {
                let open = self.families.iter().enumerate().filter(|(_, family)| family.round <= MAX_SYMBOLS);
                let Some((at, _)) = open.min_by_key(|(_, family)| family.tried * family.rank) else { return };
                self.turn = (at, SHARE);
            }
            let at = self.turn.0;
            self.families[at].advance();
            self.turn.1 = if self.families[at].round > MAX_SYMBOLS { 0 } else { self.turn.1 - 1 };
            let spent = match self.share.contains(self.families[at].tried) {
                true => self.test(at, is_over),
                false => 0,
            };
            *work = work.saturating_sub(1 + spent);
            if *work == 0 {
                return;
            }
        }
    }

    /// Reads successors off the picture for some milliseconds: of curves and of plants. Returns whether there is more to
    /// read.
    pub(crate) fn read(&mut self, work: &mut u64, is_over: &dyn Fn() -> bool) -> bool {
        for _ in 0..2 {
            if is_over() {
                return true;
            }
            let (picture, steps) = (&self.picture, &self.known.steps);
            if let Some((family, word)) = self.sources.advance(picture, &self.families, steps) {
                let words = self.families[family].successors(&word);
                *work = work.saturating_sub(self.compare(family, &words, is_over));
            }
        }
        !self.sources.is_done()
    }

    /// The systems that draw the picture or nearly do, best first.
    #[must_use]
    pub fn found(&self) -> &[Drawn] {
        &self.kept
    }

    /// The extent of the search: each family, and the number of symbols up to which its successors were tried.
    #[must_use]
    pub fn searched(&self) -> Vec<(String, usize)> {
        self.families.iter().map(|family| (family.name.clone(), family.round - 1)).collect()
    }

    /// Compares the present system of a family with the picture. The work beyond that for a system that is unlike it.
    fn test(&mut self, at: usize, is_over: &dyn Fn() -> bool) -> u64 {
        let mut words = std::mem::take(&mut self.words);
        let work = if self.families[at].set_successors(&mut words) { self.compare(at, &words, is_over) } else { 0 };
        self.words = words;
        work
    }

    /// Compares the system of a family that has these successors with the picture. The work is as for a test.
    fn compare(&mut self, at_family: usize, words: &[Vec<Symbol>], is_over: &dyn Fn() -> bool) -> u64 {
        let family = &self.families[at_family];
        let system = System { alphabet: family.alphabet, axiom: &family.axiom, words, draws: &family.draws };
        let (targets, picture) = (&self.targets, &self.picture);
        let mut best: Option<(f64, u32, usize, Fit)> = None;
        let mut work = 0;
        let shortest = if self.known.steps.len() > 1 { SHORTEST } else { 0.0 };
        self.hulls.search(targets, system, &self.known.steps, |hulls, n, at, fit| {
            // Strokes on much ink take long.
            if is_over() || fit.unit < shortest {
                return;
            }
            let target = &targets[at];
            let Some(strokes) = Strokes::on_ink(system, hulls, n, target, picture, fit) else { return };
            work += strokes.work(fit, picture);
            let agreement = strokes.agreement(target, picture, fit);
            if best.is_none_or(|(most, ..)| agreement > most) {
                best = Some((agreement, n, at, fit));
            }
        });
        let Some((agreement, n, at, fit)) = best else { return work };
        let text = |word: &[Symbol]| word.iter().map(|&symbol| family.character(symbol)).collect::<String>();
        let is_constant = |at: usize| words[at] == [at as Symbol];
        // A curve may do without the mirror image.
        let used = family.used(words);
        let rules = (0..words.len())
            .filter(|&at| used[at] && !is_constant(at))
            .map(|at| (family.letters[at].0, text(&words[at])))
            .collect();
        let letters = family.letters.iter().zip(&used);
        let draws = letters.filter(|((_, draws, _), used)| *draws && **used).map(|((letter, ..), _)| *letter).collect();
        let axiom = self.known.axiom.clone();
        let (angle, heading) = (self.known.angle, self.known.headings[at]);
        let found = Found { rules, n };
        let mut drawn = Drawn { axiom, found, draws, angle, heading, agreement, named: None };
        if agreement >= FOUND {
            work += drawn.confirm(&targets[at], picture, fit);
        }
        keep(&mut self.kept, drawn);
        if agreement < NEAR {
            return work;
        }
        // Half as many lines of twice the length draw the same.
        if let Some(halved) = family.halved(words) {
            work += self.compare(at_family, &halved, is_over);
        }
        work
    }
}
