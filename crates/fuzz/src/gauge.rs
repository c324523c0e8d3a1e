//! What an execution takes, and whether that is too much.

use crate::ALLOCATOR;
use lsystem::Progress;
use lsystem::syntax::Meter;
use std::time::{Duration, Instant};

/// Bytes that one instance in the page may hold.
const MEMORY: usize = 256 << 20;

/// Watches one execution of a target.
#[derive(Debug)]
pub struct Gauge {
    /// Bytes that were held before.
    before: usize,
    /// Bytes that may be held at most.
    memory: usize,
    /// The most units of work that a step spent.
    work: u64,
    /// The units of work of all steps.
    total: u64,
    /// The slowest step or call.
    slowest: (&'static str, Duration),
    /// How far the execution came, by name.
    reached: Vec<&'static str>,
}

/// Work units of one step, as in the page.
pub(crate) const WORK: usize = 16_384;

impl Gauge {
    pub(crate) fn new() -> Self {
        ALLOCATOR.reset_peak_usage();
        let before = ALLOCATOR.current_usage();
        Self { before, memory: MEMORY, work: 0, total: 0, slowest: ("", Duration::ZERO), reached: vec![] }
    }

    /// Allows so many bytes more, for pixels.
    pub(crate) fn allow(&mut self, bytes: usize) {
        self.memory += bytes;
    }

    /// A synchronous call.
    pub(crate) fn call<T>(&mut self, name: &'static str, call: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let value = call();
        let time = start.elapsed();
        if time > self.slowest.1 {
            self.slowest = (name, time);
        }
        value
    }

    /// A step with a share of work: what it spends is at most one piece more.
    pub(crate) fn charge(&mut self, name: &'static str, share: u64, spent: u64) {
        self.work = self.work.max(spent);
        self.total += spent;
        assert!(spent <= share.max(1) + Meter::PIECE, "work: a step of {name} with {share} units spent {spent}");
    }

    /// Goes on to the end in steps with this share of work; `step` also says what it has spent.
    pub(crate) fn steps(&mut self, name: &'static str, share: usize, mut step: impl FnMut() -> (Progress, u64)) {
        loop {
            let (progress, spent) = self.call(name, &mut step);
            self.charge(name, share as u64, spent);
            if progress == Progress::Done {
                return;
            }
        }
    }

    /// Notes that an execution came so far.
    pub(crate) fn reach(&mut self, name: &'static str) {
        if !self.reached.contains(&name) {
            self.reached.push(name);
        }
    }

    /// How far it came.
    pub(crate) fn reached(&self) -> &[&'static str] {
        &self.reached
    }

    /// The slowest step or call, and its time.
    #[must_use]
    pub fn slowest(&self) -> (&'static str, Duration) {
        self.slowest
    }

    /// The most units of work that a step spent.
    #[must_use]
    pub fn work(&self) -> u64 {
        self.work
    }

    /// The units of work of all steps.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.total
    }

    /// Bytes held at most, beyond those before.
    #[must_use]
    pub fn peak(&self) -> usize {
        ALLOCATOR.peak_usage().saturating_sub(self.before)
    }

    /// Looks whether it was too much.
    pub(crate) fn check(&self) -> Result<(), String> {
        let (peak, most) = (self.peak() >> 20, self.memory >> 20);
        if peak <= most { Ok(()) } else { Err(format!("memory: {peak} MiB were held, {most} may be")) }
    }
}
