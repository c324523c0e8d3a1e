//! Records of one derivation step for each module of a word, in one byte or three bytes per module.

/// By module: its record.
#[derive(Clone, Debug, Default)]
pub(super) struct Choices {
    low: Vec<u8>,
    /// The upper 16 bits of the codes; empty if all codes fit in one byte.
    high: Vec<u16>,
    wide: bool,
}

/// The record of a module in one derivation step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// The module stayed: no production applied.
    Stayed,
    /// The module was cut off.
    Cut,
    /// The module was replaced by this production.
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
    /// An empty list for codes of this many productions.
    pub(super) fn new(productions: usize) -> Self {
        Self { wide: Choice::Made(productions).code() > usize::from(u8::MAX), ..Self::default() }
    }

    /// An empty list for codes of the same size.
    pub(super) fn emptied(&self) -> Self {
        Self { wide: self.wide, ..Self::default() }
    }

    pub(super) fn push(&mut self, choice: Choice) {
        let code = choice.code();
        self.low.push(code as u8);
        if self.wide {
            // 24 bits suffice: a text has far fewer than 2^24 productions.
            self.high.push((code >> 8) as u16);
        }
    }

    /// Records `count` modules that stay.
    pub(super) fn keep(&mut self, count: usize) {
        self.low.resize(self.low.len() + count, 0);
        if self.wide {
            self.high.resize(self.low.len(), 0);
        }
    }

    /// The record of the module at `place`. A module without a record stayed.
    pub(super) fn get(&self, place: usize) -> Choice {
        let high = self.high.get(place).map_or(0, |&high| usize::from(high) << 8);
        match self.low.get(place).map_or(0, |&low| usize::from(low) | high) {
            0 => Choice::Stayed,
            1 => Choice::Cut,
            code => Choice::Made(code - 2),
        }
    }

    /// Records `count` modules that were cut off.
    pub(super) fn cut(&mut self, count: usize) {
        self.low.resize(self.low.len() + count, Choice::Cut.code() as u8);
        if self.wide {
            self.high.resize(self.low.len(), 0);
        }
    }

    /// The number of records.
    pub(super) fn len(&self) -> usize {
        self.low.len()
    }

    /// The bytes of the records of this many modules.
    pub(super) fn bytes_of(&self, modules: usize) -> u64 {
        modules as u64 * if self.wide { 3 } else { 1 }
    }

    /// Reserves memory for the records of this many modules.
    pub(super) fn reserve(&mut self, modules: usize) {
        self.low.reserve_exact(modules);
        if self.wide {
            self.high.reserve_exact(modules);
        }
    }

    /// The bytes of the list's memory.
    pub(super) fn bytes(&self) -> u64 {
        (self.low.capacity() + 2 * self.high.capacity()) as u64
    }
}
