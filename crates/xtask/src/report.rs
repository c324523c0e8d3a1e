//! Steps with names, times and results: one line a step, a bar where a step is long. What a step writes goes to a file of
//! its own, which is printed if the step fails.

use crate::ledger::seconds;
use crate::workspace::Workspace;
use anyhow::{Error, Result, anyhow, bail};
use fs_err as fs;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The number of slowest tests that are printed at the end.
const SLOWEST: usize = 10;

/// How long a program of a step may run: more than ten times as long as any does. It only ends what hangs.
const DEADLINE: Duration = Duration::from_mins(40);

/// The steps so far. Steps may run side by side.
pub(crate) struct Report {
    start: Instant,
    deadline: Duration,
    /// The folder of the files that steps write.
    folder: PathBuf,
    bars: MultiProgress,
    done: Mutex<Done>,
}

/// A step that has ended.
struct Step {
    name: String,
    time: Duration,
    /// The processor time of its programs.
    spent: Duration,
    error: Option<Error>,
}

#[derive(Default)]
struct Done {
    steps: Vec<Step>,
    /// Times of a fixed piece of work.
    samples: Vec<Duration>,
    tests: Vec<(Duration, String)>,
    skipped: Vec<String>,
}

impl Report {
    /// A report whose steps write into a folder of this name in Cargo's target folder.
    pub(crate) fn new(workspace: &Workspace, folder: &str) -> Self {
        Self {
            start: Instant::now(),
            deadline: DEADLINE,
            folder: workspace.target.join(folder),
            bars: MultiProgress::new(),
            done: Mutex::default(),
        }
    }

    /// The same report, for steps that may take ten times as long if it is patient.
    pub(crate) fn patient(self, is_patient: bool) -> Self {
        Self { deadline: if is_patient { DEADLINE * 10 } else { DEADLINE }, ..self }
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
        let sample = seconds::sample();
        let start = Instant::now();
        let file = self.folder.join(format!("{}.txt", name.replace(|letter: char| !letter.is_alphanumeric(), "-")));
        let workspace = workspace.for_step(file.clone(), self.deadline);
        let error =
            workspace.as_ref().map_or_else(|error| Some(anyhow!("{error:#}")), |workspace| step(workspace, &bar).err());
        let spent = workspace.map_or(Duration::ZERO, |workspace| workspace.spent.total());
        let time = start.elapsed();
        bar.finish_and_clear();
        if error.is_some() {
            self.say(&fs::read_to_string(&file).unwrap_or_default());
            self.say(&format!("{} contains this, too", file.display()));
        }
        let step = Step { name: name.to_owned(), time, spent, error };
        self.say(&step.line());
        let is_right = step.error.is_none();
        let mut done = self.lock();
        done.steps.push(step);
        done.samples.push(sample);
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

    /// Keeps the processor times of the steps so far for the ledger.
    pub(crate) fn keep(&self, workspace: &Workspace) -> Result<()> {
        let done = self.lock();
        let steps: Vec<_> = done.steps.iter().map(|step| (step.name.as_str(), step.spent)).collect();
        seconds::keep(workspace, &steps, done.samples.clone())
    }

    /// Lists all steps and the slowest tests, and fails if a step did.
    pub(crate) fn finish(self) -> Result<()> {
        let total = self.start.elapsed();
        let Done { steps, mut tests, skipped, .. } = self.done.into_inner().unwrap_or_else(PoisonError::into_inner);
        tests.sort_by(|a, b| b.cmp(a));
        if !tests.is_empty() {
            println!("\n=== slowest tests");
            tests.iter().take(SLOWEST).for_each(|(time, name)| println!("{:7.1} s  {name}", time.as_secs_f64()));
        }
        if !skipped.is_empty() {
            println!("\n=== skipped");
            skipped.iter().for_each(|what| println!("{what}"));
        }
        println!("\n=== summary: time, processor time");
        steps.iter().for_each(|step| println!("{}", step.line()));
        let spent = steps.iter().map(|step| step.spent).sum();
        println!("{}", Step { name: "all".to_owned(), time: total, spent, error: None }.line());
        let failed = steps.iter().filter(|step| step.error.is_some()).count();
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

impl Step {
    fn line(&self) -> String {
        let [time, spent] = [self.time, self.spent].map(|time| time.as_secs_f64());
        let end = self.error.as_ref().map_or(String::new(), |error| format!("   FAILED: {error:#}"));
        format!("{time:7.1} s {spent:7.1} s  {}{end}", self.name)
    }
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
        let (time, spent) = (Duration::from_millis(1234), Duration::from_secs(2));
        let step = Step { name: "two".to_owned(), time, spent, error: Some(error) };
        assert_eq!(step.line(), "    1.2 s     2.0 s  two   FAILED: outer: inner");
    }
}
