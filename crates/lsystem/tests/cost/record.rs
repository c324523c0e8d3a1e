//! The check and the record of the largest steps.

#![allow(dead_code, reason = "a phase may need only some of this")]

use lsystem::base::Meter;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// The units of work of a step, as in the page.
pub(crate) const SHARE: u64 = 16_384;

/// By entry point: the largest step and the largest total, with the names of their systems.
static LARGEST: Mutex<BTreeMap<&'static str, [(u64, String); 2]>> = Mutex::new(BTreeMap::new());

/// The cost of one run of an entry point.
pub(crate) struct Record {
    entry: &'static str,
    what: String,
    largest: u64,
    total: u64,
}

impl Record {
    pub(crate) fn new(entry: &'static str, what: &str, n: u32) -> Self {
        Self { entry, what: format!("{what}, n = {n}"), largest: 0, total: 0 }
    }

    /// Adds a step.
    ///
    /// # Panics
    /// If the step exceeds its share by more than a piece.
    pub(crate) fn step(&mut self, share: u64, spent: u64) {
        let most = share.saturating_add(Meter::PIECE);
        assert!(spent <= most, "{} of {}: a step of {spent} units, at most {most}", self.entry, self.what);
        assert!(spent > 0, "{} of {}: a step that counts nothing", self.entry, self.what);
        self.largest = self.largest.max(spent);
        self.total += spent;
    }

    /// Adds a call that is not resumable.
    pub(crate) fn call(&mut self, spent: u64) {
        self.largest = self.largest.max(spent);
        self.total += spent;
    }

    /// Ends the run.
    ///
    /// # Panics
    /// If the run has taken more than `most` units.
    pub(crate) fn finish(self, most: u64) {
        let Self { entry, what, largest, total } = self;
        assert!(total <= most, "{entry} of {what}: {total} units, at most {most}");
        let mut all = LARGEST.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let known = all.entry(entry).or_default();
        let mut news = false;
        for (known, value) in known.iter_mut().zip([largest, total]) {
            if value > known.0 {
                *known = (value, what.clone());
                news = true;
            }
        }
        if news {
            let [(largest, of_step), (total, of_total)] = known;
            println!("{entry:16} step {largest:>9} ({of_step}), total {total:>12} ({of_total})");
        }
    }
}
