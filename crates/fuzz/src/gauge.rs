//! The resources of one execution, and their limits.

use crate::ALLOCATOR;
use crate::clock::thread_time;
use crate::told::check_diagnostic;
use lsystem::base::Meter;
use lsystem::files::{Owner, Sink};
use lsystem::syntax::Halt;
use lsystem::{Diagnostic, Progress};
use std::time::Duration;

/// The most bytes of one instance in the page.
const MEMORY: usize = 256 << 20;

/// The most processor time of one step or call. The page counts on 8 ms for a step. The checks of this build, compiled for
/// debugging, and a slow machine take ten times as long each, so more than this is a loop that nobody has counted.
const TIME: Duration = Duration::from_secs(1);

/// Measures one execution of a target.
#[derive(Debug)]
pub(crate) struct Gauge {
    /// The bytes in use before the execution.
    before: usize,
    /// The most bytes that the execution may use.
    memory: usize,
    /// The most units of work in one step.
    pub(crate) work: u64,
    /// The units of work of all steps.
    pub(crate) total: u64,
    /// The name and the processor time of the slowest step or call.
    pub(crate) slowest: (&'static str, Duration),
    /// The names of the points that the execution reached.
    pub(crate) reached: Vec<&'static str>,
}

/// The units of work of one step, as in the page.
pub(crate) const WORK: usize = 16_384;

impl Gauge {
    pub(crate) fn new() -> Self {
        ALLOCATOR.reset_peak_usage();
        let before = ALLOCATOR.current_usage();
        Self { before, memory: MEMORY, work: 0, total: 0, slowest: ("", Duration::ZERO), reached: vec![] }
    }

    /// Allows more bytes, for pixels.
    pub(crate) fn allow(&mut self, bytes: usize) {
        self.memory += bytes;
    }

    /// Measures a synchronous call that may spend as much work as this many steps of the page: 8 ms each.
    pub(crate) fn long_call<T>(&mut self, name: &'static str, steps: u32, call: impl FnOnce() -> T) -> T {
        let start = thread_time();
        let value = call();
        let (time, most) = (thread_time() - start, steps * Duration::from_millis(8));
        assert!(time <= most, "slow {name}: {time:.1?} of processor time, more than {most:?}");
        value
    }

    /// Measures a synchronous call.
    pub(crate) fn call<T>(&mut self, name: &'static str, call: impl FnOnce() -> T) -> T {
        let start = thread_time();
        let value = call();
        self.took(name, thread_time() - start);
        value
    }

    fn took(&mut self, name: &'static str, time: Duration) {
        if time > self.slowest.1 {
            self.slowest = (name, time);
        }
    }

    /// Records the work of a step, and checks that the step exceeds its share by at most one [`Meter::PIECE`].
    pub(crate) fn charge(&mut self, name: &'static str, share: u64, spent: u64) {
        self.work = self.work.max(spent);
        self.total += spent;
        assert!(spent <= share.max(1) + Meter::PIECE, "work: a step of {name} with {share} units spent {spent}");
    }

    /// Runs all steps of some work with this share of units. `spent` are the units of all its steps so far.
    pub(crate) fn steps<T>(
        &mut self,
        name: &'static str,
        share: usize,
        work: &mut T,
        mut step: impl FnMut(&mut T, usize) -> Progress,
        spent: impl Fn(&T) -> u64,
    ) {
        let mut progress = Progress::More;
        while progress == Progress::More {
            let before = spent(work);
            progress = self.call(name, || step(work, share));
            self.charge(name, share as u64, spent(work) - before);
        }
    }

    /// Writes a file, and measures the work and the time between two calls of its owner, who stops after `parts` calls. The
    /// error is the exceeded limit, or `None` if the file was stopped.
    pub(crate) fn file<T>(
        &mut self,
        name: &'static str,
        parts: usize,
        write: impl FnOnce(&mut Sink<'_>) -> Result<T, Halt>,
    ) -> Result<(Vec<u8>, T), Option<Diagnostic>> {
        let mut owner = GaugedFile { name, since: thread_time(), parts, bytes: vec![], gauge: self };
        match Sink::to(&mut owner, write) {
            Ok(result) => {
                owner.see();
                Ok((owner.bytes, result))
            }
            Err(Halt::Limit(limit)) => {
                check_diagnostic(&limit);
                Err(Some(limit))
            }
            Err(Halt::Stopped) => Err(None),
        }
    }

    /// Records that the execution reached a point.
    pub(crate) fn reach(&mut self, name: &'static str) {
        if !self.reached.contains(&name) {
            self.reached.push(name);
        }
    }

    /// The most bytes in use at a time, beyond those before the execution.
    pub(crate) fn peak(&self) -> usize {
        ALLOCATOR.peak_usage().saturating_sub(self.before)
    }

    /// Checks the memory in use and the time of the slowest call against their limits.
    pub(crate) fn check(&self) -> Result<(), String> {
        let (peak, most) = (self.peak() >> 20, self.memory >> 20);
        if peak > most {
            return Err(format!("memory: {peak} MiB in use, more than {most} MiB"));
        }
        let (name, time) = self.slowest;
        if time > TIME {
            return Err(format!("slow {name}: {time:.1?} of processor time, more than {TIME:?}"));
        }
        Ok(())
    }
}

/// A file in the making.
struct GaugedFile<'a> {
    gauge: &'a mut Gauge,
    name: &'static str,
    /// The processor time at the last call.
    since: Duration,
    /// The number of calls that are left.
    parts: usize,
    bytes: Vec<u8>,
}

impl GaugedFile<'_> {
    /// Records the time since the last call.
    fn see(&mut self) {
        let now = thread_time();
        self.gauge.took(self.name, now - self.since);
        self.since = now;
    }
}

impl Owner for GaugedFile<'_> {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.bytes.extend_from_slice(bytes);
        Ok(())
    }

    fn spent(&mut self, units: u64) -> Result<(), Halt> {
        self.see();
        self.gauge.charge(self.name, WORK as u64, units);
        self.parts = self.parts.checked_sub(1).ok_or(Halt::Stopped)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_calls_are_faults_on_busy_machines_too() {
        let mut gauge = Gauge::new();
        gauge.call("asleep", || std::thread::sleep(TIME + Duration::from_millis(100)));
        assert_eq!(gauge.check(), Ok(()));
        gauge.call("busy", || {
            let start = thread_time();
            while thread_time() - start <= TIME {}
        });
        assert!(gauge.check().is_err_and(|message| message.starts_with("slow busy: 1.0")));
    }
}
