//! The division of a search among several that run in parallel.

/// The part of the systems that one search tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// The 0-based index of the search.
    pub index: u64,
    /// The number of searches that run in parallel, at least 1.
    pub count: u64,
}

impl Share {
    /// The share of a search without others.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Whether the system with this number is in the share.
    pub(crate) fn contains(self, number: u64) -> bool {
        number % self.count.max(1) == self.index
    }
}
