//! Random choices that a seed decides.

/// A sequence of random numbers: SplitMix64 (Steele, Lea and Flood, 2014).
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 up to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A number from `low` up to `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }

    /// A number from `low` up to `high` with two digits after the point.
    pub(crate) fn rounded(&mut self, low: f64, high: f64) -> f64 {
        libm::round(100.0 * self.between(low, high)) / 100.0
    }

    /// A whole number from `low` to `high`, both included.
    pub(crate) fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.unit() * (high - low + 1) as f64) as usize
    }

    /// One of a list.
    pub(crate) fn one<T: Copy, const N: usize>(&mut self, list: [T; N]) -> T {
        list[self.whole(0, N - 1)]
    }

    /// True with this probability.
    pub(crate) fn chance(&mut self, part: f64) -> bool {
        self.unit() < part
    }
}
