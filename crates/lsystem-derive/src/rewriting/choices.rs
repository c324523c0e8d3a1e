//! What a derivation step did with each module of a word, in as little memory as can be.

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

    /// Notes `count` modules that were cut off.
    pub(super) fn cut(&mut self, count: usize) {
        self.low.resize(self.low.len() + count, Choice::Cut.code() as u8);
        if self.wide {
            self.high.resize(self.low.len(), 0);
        }
    }

    /// How many modules have been noted.
    pub(super) fn len(&self) -> usize {
        self.low.len()
    }

    /// The bytes that the choices of so many modules take.
    pub(super) fn bytes_of(&self, modules: usize) -> u64 {
        modules as u64 * if self.wide { 3 } else { 1 }
    }

    /// Makes room for the choices of so many modules.
    pub(super) fn reserve(&mut self, modules: usize) {
        self.low.reserve_exact(modules);
        if self.wide {
            self.high.reserve_exact(modules);
        }
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        (self.low.capacity() + 2 * self.high.capacity()) as u64
    }
}
