//! A row of bytes as a source of choices.

use arbitrary::Unstructured;
use lsystem::Definition;

/// Choices that are read from bytes. After the end of the bytes, every choice is the first one, so that every row of
/// bytes is an input and short rows are simple inputs.
#[derive(Debug)]
pub(crate) struct Source<'a> {
    bytes: Unstructured<'a>,
    /// A system that targets use instead of a random one.
    pub(crate) given: Option<Definition>,
    /// Whether to print the input.
    pub(crate) is_shown: bool,
}

impl<'a> Source<'a> {
    /// A source at the start of `bytes`.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes: Unstructured::new(bytes), given: None, is_shown: false }
    }

    /// A number below `n`, which is at least 1.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        self.bytes.int_in_range(0..=n - 1).unwrap_or(0)
    }

    /// A number in `low..=high`.
    pub(crate) fn between(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high - low + 1)
    }

    /// True once in `n` times; false after the end of the bytes.
    pub(crate) fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    /// One element of `these`.
    pub(crate) fn pick<T: Copy>(&mut self, these: &[T]) -> T {
        these[self.below(these.len())]
    }

    /// One of the words of `text`, which spaces divide.
    pub(crate) fn pick_word<'t>(&mut self, text: &'t str) -> &'t str {
        self.pick(&text.split(' ').collect::<Vec<_>>())
    }

    /// A number of `usual`, or once in `n` times any.
    pub(crate) fn usual(&mut self, n: usize, usual: &[f64]) -> f64 {
        if self.once_in(n) { self.number() } else { self.pick(usual) }
    }

    /// How often something is repeated: once, or once in `n` times one of `these`.
    pub(crate) fn times(&mut self, n: usize, these: &[usize]) -> usize {
        if self.once_in(n) { self.pick(these) } else { 1 }
    }

    /// Prints something of an input that is tried alone.
    pub(crate) fn show(&self, text: core::fmt::Arguments<'_>) {
        if self.is_shown {
            println!("{text}");
        }
    }

    /// One character of `text`.
    pub(crate) fn pick_char(&mut self, text: &str) -> char {
        let number = self.below(text.chars().count());
        text.chars().nth(number).unwrap_or('F')
    }

    /// A place before or behind a character of `text`.
    pub(crate) fn place(&mut self, text: &str) -> usize {
        text.floor_char_boundary(self.below(text.len() + 1))
    }

    /// Any 32 bits.
    pub(crate) fn word(&mut self) -> u32 {
        self.bytes.int_in_range(0..=u32::MAX).unwrap_or(0)
    }

    /// A uniform number in `0.0..1.0`.
    pub(crate) fn part(&mut self) -> f64 {
        f64::from(self.word()) / (f64::from(u32::MAX) + 1.0)
    }

    /// Any `f64`, also NaN and infinities; mostly a number at a limit of some range.
    pub(crate) fn number(&mut self) -> f64 {
        match self.below(8) {
            0 => self.pick(&ROUND),
            1..=3 => self.pick_word(EXTREME).parse().unwrap_or_default(),
            4 => f64::from_bits(u64::from(self.word()) << 32 | u64::from(self.word())),
            5 => self.between(0, 2000) as f64 - 1000.0,
            6 => self.part(),
            _ => (self.part() - 0.5) * libm::pow(10.0, self.between(0, 60) as f64 - 30.0),
        }
    }

    /// The next `most` bytes, or fewer at the end.
    pub(crate) fn bytes(&mut self, most: usize) -> &'a [u8] {
        let count = most.min(self.bytes.len());
        self.bytes.bytes(count).unwrap_or_default()
    }
}

const ROUND: [f64; 8] = [0.0, 1.0, 2.0, 0.5, -1.0, 10.0, 100.0, 3.0];
const EXTREME: &str = "-0 NaN inf -inf 1.7976931348623157e308 -1.7976931348623157e308 2.2250738585072014e-308 5e-324 \
    2.220446049250313e-16 1e-9 -1e-9 1e9 -1e9 1e-300 1e300 1e18 1e25 4294967296 9007199254740993 1e6 -1e6 0.999999 \
    1.000001 255.5";
