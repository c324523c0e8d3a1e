//! What a derivation step did with each module of a word, in as little memory as can be.

use core::ops::Range;

/// By module: what became of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Choices {
    low: Vec<u8>,
    /// What does not fit in one byte; empty where everything does.
    high: Vec<u16>,
    wide: bool,
}

/// What became of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// No production rewrites it.
    Stayed,
    /// It was cut off.
    Cut,
    /// It was replaced by this production.
    Made(usize),
}

impl Choice {
    fn code(self) -> usize {
        match self {
            Self::Stayed => 0,
            Self::Cut => 1,
            Self::Made(production) => production + 2,
        }
    }
}

impl Choices {
    /// Room for choices among so many productions.
    pub(super) fn new(productions: usize) -> Self {
        Self { wide: Choice::Made(productions).code() > usize::from(u8::MAX), ..Self::default() }
    }

    /// Room for choices of the same kind.
    pub(super) fn emptied(&self) -> Self {
        Self { wide: self.wide, ..Self::default() }
    }

    pub(super) fn push(&mut self, choice: Choice) {
        let code = choice.code();
        self.low.push(code as u8);
        if self.wide {
            // A text has far fewer than 2^24 productions.
            self.high.push((code >> 8) as u16);
        }
    }

    /// Notes `count` modules that stay.
    pub(super) fn keep(&mut self, count: usize) {
        self.low.resize(self.low.len() + count, 0);
        if self.wide {
            self.high.resize(self.low.len(), 0);
        }
    }

    /// That of the module at `place`; what was not noted stayed.
    pub(super) fn get(&self, place: usize) -> Choice {
        let high = self.high.get(place).map_or(0, |&high| usize::from(high) << 8);
        match self.low.get(place).map_or(0, |&low| usize::from(low) | high) {
            0 => Choice::Stayed,
            1 => Choice::Cut,
            code => Choice::Made(code - 2),
        }
    }

    /// Takes what was noted for that of the modules in `runs`; others of the `length` modules were cut off.
    pub(super) fn spread(&mut self, runs: &[Range<usize>], length: usize) {
        let noted = core::mem::replace(self, self.emptied());
        let mut places = 0..;
        for run in runs {
            (self.low.len()..run.start).for_each(|_| self.push(Choice::Cut));
            places.by_ref().take(run.len()).for_each(|place| self.push(noted.get(place)));
        }
        (self.low.len()..length).for_each(|_| self.push(Choice::Cut));
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        (self.low.len() + 2 * self.high.len()) as u64
    }
}
