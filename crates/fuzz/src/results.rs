//! What executions of a target came to. A worker writes lines of JSON, and the supervisor adds them up.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The results of some executions.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct Results {
    pub(crate) executions: u64,
    /// The most memory in use, in KiB.
    pub(crate) peak: usize,
    /// The most units of work in one step.
    pub(crate) work: u64,
    /// By point: the number of inputs that reached it.
    pub(crate) reached: BTreeMap<String, u64>,
    /// The slowest inputs: milliseconds of processor time, number, and slowest call.
    pub(crate) slowest: Vec<(u64, u64, String)>,
    /// The messages of faults, by file.
    pub(crate) findings: BTreeMap<String, String>,
}

impl Results {
    pub(crate) fn add(&mut self, more: Self) {
        self.executions += more.executions;
        self.peak = self.peak.max(more.peak);
        self.work = self.work.max(more.work);
        more.reached.into_iter().for_each(|(name, count)| *self.reached.entry(name).or_default() += count);
        self.slowest.extend(more.slowest);
        self.slowest.sort_by(|a, b| b.cmp(a));
        self.slowest.truncate(3);
        self.findings.extend(more.findings);
    }
}
