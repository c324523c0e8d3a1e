//! The exact numbers of symbols and segments, counted when there is nothing else to do.

use crate::pace::{COUNTING, WORK};
use crate::report::Report;
use lsystem::derive::Counter;
use lsystem::{Progress, System};

/// The counters of symbols and segments; no counters for small pictures, which show no counts.
#[derive(Default)]
pub(crate) struct Counts(Option<[Counter; 2]>);

impl Counts {
    /// Counts the symbols and segments of generation `n` for some milliseconds, so that the first report has most counts.
    pub(crate) fn new(system: &System, n: u32) -> Self {
        let mut counters = [system.symbols(n), system.segments(n)];
        for counter in &mut counters {
            counter.step(COUNTING);
        }
        Self(Some(counters))
    }

    pub(crate) fn is_done(&self) -> bool {
        self.0.iter().flatten().all(Counter::is_done)
    }

    /// Continues the first unfinished count. Returns whether a count is new.
    pub(crate) fn step(&mut self) -> bool {
        let unfinished = self.0.iter_mut().flatten().find(|counter| !counter.is_done());
        unfinished.is_some_and(|counter| counter.step(WORK as u64) == Progress::Done)
    }

    /// Copies finished counts into the report.
    pub(crate) fn report(&self, report: &mut Report) {
        let Some([symbols, segments]) = &self.0 else { return };
        for (counter, reported) in [(symbols, &mut report.symbols), (segments, &mut report.segments)] {
            if let Some(count) = counter.count() {
                *reported = Some(count.to_string());
            }
        }
    }

    /// The counter of segments.
    pub(crate) fn segments(&self) -> Option<&Counter> {
        self.0.as_ref().map(|[_, segments]| segments)
    }
}
