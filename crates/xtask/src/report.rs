//! Steps with names, times and results: one line a step, a bar where a step is long. What a step writes goes to a file of
//! its own, which is printed if the step fails.

use crate::workspace::Workspace;
use anyhow::{Error, Result, bail};
use fs_err as fs;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The number of slowest tests that are printed at the end.
const SLOWEST: usize = 10;

/// The steps so far. Steps may run side by side.
pub(crate) struct Report {
    start: Instant,
    /// The folder of the files that steps write.
    folder: PathBuf,
    bars: MultiProgress,
    done: Mutex<Done>,
}

#[derive(Default)]
struct Done {
    steps: Vec<(String, Duration, Option<Error>)>,
    tests: Vec<(Duration, String)>,
    skipped: Vec<String>,
}

impl Report {
    /// A report whose steps write into a folder of this name in Cargo's target folder.
    pub(crate) fn new(workspace: &Workspace, folder: &str) -> Self {
        Self {
            start: Instant::now(),
            folder: workspace.target.join(folder),
            bars: MultiProgress::new(),
            done: Mutex::default(),
        }
    }

    /// Runs a step and prints its name and time. A failure is kept for the end, so that one run shows all failures.
    /// Returns whether the step succeeded.
    pub(crate) fn step(
        &self,
        workspace: &Workspace,
        name: &str,
        step: impl FnOnce(&Workspace, &ProgressBar) -> Result<()>,
    ) -> bool {
        let bar = self.bars.add(ProgressBar::new_spinner().with_message(name.to_owned()));
        bar.set_style(style("{spinner} {msg} {elapsed}"));
        bar.enable_steady_tick(Duration::from_millis(250));
        let start = Instant::now();
        let file = self.folder.join(format!("{}.txt", name.replace(|letter: char| !letter.is_alphanumeric(), "-")));
        let error = workspace.logging_to(file.clone()).and_then(|workspace| step(&workspace, &bar)).err();
        let time = start.elapsed();
        bar.finish_and_clear();
        if error.is_some() {
            self.say(&fs::read_to_string(&file).unwrap_or_default());
            self.say(&format!("{} contains this, too", file.display()));
        }
        self.say(&line(name, time, error.as_ref()));
        let is_right = error.is_none();
        self.lock().steps.push((name.to_owned(), time, error));
        is_right
    }

    /// Notes the time of a test or of a group of tests.
    pub(crate) fn time(&self, test: &str, time: Duration) {
        self.lock().tests.push((time, test.to_owned()));
    }

    /// Notes what does not run, and why.
    pub(crate) fn skip(&self, what: String) {
        self.lock().skipped.push(what);
    }

    /// Prints a line above the bars.
    fn say(&self, text: &str) {
        self.bars.suspend(|| println!("{text}"));
    }

    fn lock(&self) -> MutexGuard<'_, Done> {
        self.done.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lists all steps and the slowest tests, and fails if a step did.
    pub(crate) fn finish(self) -> Result<()> {
        let total = self.start.elapsed();
        let Done { steps, mut tests, skipped } = self.done.into_inner().unwrap_or_else(PoisonError::into_inner);
        tests.sort_by(|a, b| b.cmp(a));
        if !tests.is_empty() {
            println!("\n=== slowest tests");
            tests.iter().take(SLOWEST).for_each(|(time, name)| println!("{}", line(name, *time, None)));
        }
        if !skipped.is_empty() {
            println!("\n=== skipped");
            skipped.iter().for_each(|what| println!("{what}"));
        }
        println!("\n=== summary");
        for (name, time, error) in &steps {
            println!("{}", line(name, *time, error.as_ref()));
        }
        println!("{}", line("all", total, None));
        let failed = steps.iter().filter(|step| step.2.is_some()).count();
        println!("{} passed, {failed} failed", steps.len() - failed);
        if failed > 0 {
            bail!("{failed} of {} steps failed", steps.len());
        }
        Ok(())
    }
}

/// A bar for a step with this number of parts.
pub(crate) fn measure(bar: &ProgressBar, parts: usize) {
    bar.set_style(style("{bar:20} {pos}/{len} {msg} {elapsed}"));
    bar.set_length(parts as u64);
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn line(name: &str, time: Duration, error: Option<&Error>) -> String {
    let seconds = time.as_secs_f64();
    let end = error.map_or(String::new(), |error| format!("   FAILED: {error:#}"));
    format!("{seconds:7.1} s  {name}{end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goes_on_after_a_failure_and_fails_at_the_end() {
        let mut workspace = Workspace::find().unwrap();
        let folder = tempfile::tempdir().unwrap();
        workspace.target = folder.path().to_owned();
        let report = Report::new(&workspace, "logs");
        assert!(report.step(&workspace, "one", |_, _| Ok(())));
        assert!(!report.step(&workspace, "step two", |workspace, _| {
            workspace.say("how it went");
            bail!("no luck")
        }));
        assert!(report.step(&workspace, "three", |_, _| Ok(())));
        assert_eq!(fs::read_to_string(folder.path().join("logs/step-two.txt")).unwrap(), "how it went\n");
        assert_eq!(report.finish().unwrap_err().to_string(), "1 of 3 steps failed");
    }

    #[test]
    fn says_what_failed() {
        let error = anyhow::anyhow!("inner").context("outer");
        let text = line("two", Duration::from_millis(1234), Some(&error));
        assert_eq!(text, "    1.2 s  two   FAILED: outer: inner");
    }
}
