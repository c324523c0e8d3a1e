//! What an execution takes, and whether that is too much.

use crate::ALLOCATOR;
use lsystem::Progress;
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
    /// Work units of the page between two looks at the clock.
    slowest: (&'static str, Duration),
    /// Whether a system was made, drawn and so on, by name: what fuzzing reaches.
    reached: Vec<&'static str>,
}

/// Work units of one step, as in the page.
pub(crate) const WORK: usize = 16_384;

impl Gauge {
    pub(crate) fn new() -> Self {
        ALLOCATOR.reset_peak_usage();
        let before = ALLOCATOR.current_usage();
        Self { before, memory: MEMORY, slowest: ("", Duration::ZERO), reached: vec![] }
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

    /// Goes on to the end in steps of the page's size.
    pub(crate) fn steps(&mut self, name: &'static str, mut step: impl FnMut() -> Progress) {
        while self.call(name, &mut step) == Progress::More {}
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
