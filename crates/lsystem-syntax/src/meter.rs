//! Counted work: what a step may do, and what it has done.
//!
//! Every loop whose length depends on input charges the meter that it is handed, and stops soon after the meter is
//! spent. Between two looks at the meter there is at most [`Meter::PIECE`] of work, so no step takes much longer than
//! its caller allowed, whatever the input.

/// The work of one step.
///
/// A unit is the work of handling one symbol, one item of a block or one corner of a hull: 10 to 100 nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meter {
    share: u64,
    spent: u64,
}

impl Meter {
    /// The most units that one piece of work may take: a step may exceed its share by this much, and no more.
    pub const PIECE: u64 = 1 << 17;

    /// A meter for a step that may do `share` units of work, at least one.
    #[must_use]
    pub fn new(share: u64) -> Self {
        Self { share: share.max(1), spent: 0 }
    }

    /// Counts work. Charge what a loop is about to do before it starts, or each round as it ends.
    pub fn charge(&mut self, units: u64) {
        self.spent = self.spent.saturating_add(units);
    }

    /// Whether the step must end.
    #[must_use]
    pub fn is_spent(&self) -> bool {
        self.spent >= self.share
    }

    /// The units that may still be spent.
    #[must_use]
    pub fn left(&self) -> u64 {
        self.share.saturating_sub(self.spent)
    }

    /// The units spent so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_meter_counts_up_to_its_share_and_beyond() {
        let mut meter = Meter::new(10);
        meter.charge(9);
        assert_eq!((meter.is_spent(), meter.left(), meter.spent()), (false, 1, 9));
        meter.charge(5);
        assert_eq!((meter.is_spent(), meter.left(), meter.spent()), (true, 0, 14));
        meter.charge(u64::MAX);
        assert_eq!(meter.spent(), u64::MAX);
        assert!(!Meter::new(0).is_spent());
    }
}
