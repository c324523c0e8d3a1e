//! Progress bars on standard error for long work. There are none if standard error is not a terminal.

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use lsystem::base::words::said;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// All bars, one below the other.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// The time after which a bar appears.
const PATIENCE: Duration = Duration::from_millis(400);

/// A progress bar. Dropping the bar clears its line.
pub(crate) struct DelayedBar {
    bar: ProgressBar,
    start: Instant,
    is_shown: bool,
}

impl DelayedBar {
    /// A bar for work named `label`, of `total` parts. Without a total, the bar shows the time.
    pub(crate) fn new(label: &'static str, total: Option<u64>) -> Self {
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        let bar = bar.with_message(said(label)).with_style(style(total.is_some()));
        Self { bar, start: Instant::now(), is_shown: false }
    }

    /// Records that `done` parts are done.
    pub(crate) fn at(&mut self, done: u64) {
        if !self.is_shown && self.start.elapsed() >= PATIENCE {
            self.is_shown = true;
            BARS.add(self.bar.clone());
        }
        self.bar.set_position(done);
    }
}

impl Drop for DelayedBar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
        BARS.remove(&self.bar);
    }
}

/// Calls `write` while all bars are hidden.
pub(crate) fn beside_bars<T>(write: impl FnOnce() -> T) -> T {
    BARS.suspend(write)
}

fn template(has_total: bool) -> &'static str {
    if has_total { "{msg} [{bar:30}] {percent:>3} %" } else { "{msg}: {elapsed}" }
}

fn style(has_total: bool) -> ProgressStyle {
    let style = ProgressStyle::with_template(template(has_total));
    style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("## ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn templates_are_valid() {
        assert!([true, false].iter().all(|&has_total| ProgressStyle::with_template(template(has_total)).is_ok()));
    }

    #[test]
    fn bars_end_with_their_work() {
        let mut progress = DelayedBar::new("work", Some(2));
        progress.at(1);
        assert!(!progress.is_shown);
        progress.start -= PATIENCE;
        progress.at(2);
        assert!(progress.is_shown);
        let bar = progress.bar.clone();
        drop(progress);
        assert!(bar.is_finished());
    }
}
