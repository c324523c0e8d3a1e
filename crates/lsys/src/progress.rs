//! A progress bar on standard error, for work that takes long enough to wonder.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Shows how much of some work is done, if somebody is looking. Dropping it clears the line.
pub(crate) struct Progress {
    label: String,
    total: u64,
    start: Instant,
    next: Instant,
    looking: bool,
    shown: bool,
}

/// Shorter work needs no bar.
const PATIENCE: Duration = Duration::from_millis(400);
/// As often as the eye follows.
const INTERVAL: Duration = Duration::from_millis(100);
const WIDTH: u64 = 30;

impl Progress {
    /// For work of `total` parts, 0 where that is not known, named `label`.
    pub(crate) fn new(label: &str, total: u64) -> Self {
        let looking = std::io::stderr().is_terminal();
        let start = Instant::now();
        Self { label: label.to_owned(), total, start, next: start + PATIENCE, looking, shown: false }
    }

    /// `done` of the parts are done.
    pub(crate) fn at(&mut self, done: u64) {
        let now = Instant::now();
        if !self.looking || now < self.next {
            return;
        }
        self.next = now + INTERVAL;
        self.shown = true;
        match self.total {
            0 => eprint!("\r{}: {} s", self.label, (now - self.start).as_secs()),
            total => eprint!("\r{}", bar(&self.label, done, total)),
        }
        let _ = std::io::stderr().flush();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown {
            eprint!("\r\x1b[K");
        }
    }
}

fn bar(label: &str, done: u64, total: u64) -> String {
    let share = u128::from(done.min(total)) * u128::from(WIDTH) / u128::from(total);
    let percent = u128::from(done.min(total)) * 100 / u128::from(total);
    let full = share as usize;
    format!("{label} [{}{}] {percent:3} %", "#".repeat(full), " ".repeat(WIDTH as usize - full))
}

#[cfg(test)]
mod tests {
    use super::bar;

    #[test]
    fn bars() {
        assert_eq!(bar("a", 0, 9), format!("a [{}]   0 %", " ".repeat(30)));
        assert_eq!(bar("a", 1, 2), format!("a [{}{}]  50 %", "#".repeat(15), " ".repeat(15)));
        assert_eq!(bar("a", u64::MAX, 2), format!("a [{}] 100 %", "#".repeat(30)));
    }
}
