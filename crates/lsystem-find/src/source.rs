//! Successors read off the picture, an addition to the enumeration of all words.

use crate::curve::CurveSearch;
use crate::family::Family;
use crate::growth::GrowthSearch;
use crate::hull::Target;
use crate::lattice::{LatticeSearch, Lattices};
use crate::picture::Picture;
use crate::share::Share;
use crate::successors::{Advance, Symbol};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// A search that reads successors off the picture, in steps.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// A plant of a family that is not begun yet, as seen with a heading: its beginning is work, too.
    Seed(usize, Box<Target>),
    /// A plant of a family, grown on the ink.
    Growth(usize, Box<GrowthSearch>),
    /// The lattice of the picture, as seen with a heading.
    Lattice(Arc<Mutex<LatticeSearch>>),
    /// A curve of a family.
    Curve(usize, Box<CurveSearch>),
}

/// All sources. A source of curves and a source of plants alternate; each runs to its end before the next one of its
/// kind.
#[derive(Clone, Debug)]
pub(crate) struct Sources([VecDeque<Source>; 2]);

impl Sources {
    /// Of the searches that run in parallel, each takes its share of the sources.
    pub(crate) fn new(targets: &[Target], families: &[Family], share: Share, lattices: &mut Lattices) -> Self {
        let lattices: Vec<Source> = lattices.of(targets).into_iter().map(Source::Lattice).collect();
        let mut plants = Vec::new();
        for (at, _) in families.iter().enumerate().filter(|(_, family)| GrowthSearch::is_for(family)) {
            plants.extend(targets.iter().map(|target| Source::Seed(at, Box::new(target.clone()))));
        }
        let own = |all: Vec<Source>| {
            let own = all.into_iter().zip(0_u64..).filter(|(_, number)| share.contains(*number));
            own.map(|(source, _)| source).collect()
        };
        Self([own(lattices), own(plants)])
    }

    pub(crate) fn is_done(&self) -> bool {
        self.0.iter().all(VecDeque::is_empty)
    }

    /// Does a few milliseconds of work. Returns a successor that may draw the picture, with the index of its family.
    pub(crate) fn advance(
        &mut self,
        picture: &Arc<Picture>,
        families: &[Family],
        steps: &[u32],
    ) -> Option<(usize, Vec<Symbol>)> {
        self.0.rotate_left(1);
        let own = &mut self.0[1];
        while let Some(Source::Seed(at, target)) = own.front() {
            let growth = GrowthSearch::new(picture, &families[*at], target, steps);
            let growth = growth.map(|growth| Source::Growth(*at, Box::new(growth)));
            own.pop_front();
            growth.into_iter().for_each(|growth| own.push_front(growth));
        }
        let source = own.front_mut()?;
        let (family, advance) = match source {
            Source::Seed(..) => return None,
            Source::Growth(family, growth) => (*family, growth.advance()),
            Source::Curve(family, curve) => (*family, curve.advance()),
            Source::Lattice(search) => {
                let mut search = search.lock().unwrap_or_else(PoisonError::into_inner);
                search.advance(picture);
                let (is_done, lattice) = (search.is_done(), search.found());
                drop(search);
                if is_done {
                    own.pop_front();
                }
                if let Some(lattice) = lattice {
                    let is_first = |at: &usize| families[..*at].iter().all(|one| one.letters != families[*at].letters);
                    // The last one comes to the front: the first family.
                    for at in (0..families.len()).rev().filter(is_first) {
                        let curve = CurveSearch::new(&lattice, &families[at], steps);
                        curve.into_iter().for_each(|curve| own.push_front(Source::Curve(at, Box::new(curve))));
                    }
                }
                return None;
            }
        };
        match advance {
            Advance::More => None,
            Advance::Word(word) => Some((family, word)),
            Advance::Done => {
                own.pop_front();
                None
            }
        }
    }
}
