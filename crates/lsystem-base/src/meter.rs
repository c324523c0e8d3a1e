//! Counted work: the budget of a step and the part that is spent.
//!
//! Every loop whose length depends on input charges its meter and stops soon after the meter is spent. At most
//! [`Meter::PIECE`] units of work lie between two checks, so that no input makes a step much longer than its budget.

/// The work of one step.
///
/// A unit is the work of handling one symbol, one item of a block or one corner of a hull: 10 to 100 nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meter {
    share: u64,
    spent: u64,
}

impl Meter {
    /// The most units of one piece of work: a step exceeds its share by at most this.
    pub const PIECE: u64 = 1 << 17;

    /// A meter for a step of `share` units of work, at least 1.
    #[must_use]
    pub fn new(share: u64) -> Self {
        Self { share: share.max(1), spent: 0 }
    }

    /// Counts work. Charge a loop before it starts, or each of its rounds at the end of the round.
    pub fn charge(&mut self, units: u64) {
        self.spent = self.spent.saturating_add(units);
    }

    /// Whether the step must end.
    #[must_use]
    pub fn is_spent(&self) -> bool {
        self.spent >= self.share
    }

    /// The units that are left.
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
