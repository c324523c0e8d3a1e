//! Steps with names, times and results.

use anyhow::{Error, Result, bail};
use std::time::{Duration, Instant};

/// The steps so far.
#[derive(Default)]
pub(crate) struct StepReport {
    steps: Vec<(String, Duration, Option<Error>)>,
}

impl StepReport {
    /// Runs a step and prints its name and time. A failure is kept for the end, so that one run shows all failures.
    /// Returns whether the step succeeded.
    pub(crate) fn step(&mut self, name: &str, step: impl FnOnce() -> Result<()>) -> bool {
        println!("\n=== {name}");
        let start = Instant::now();
        let error = step().err();
        let time = start.elapsed();
        println!("{}", line(name, time, error.as_ref()));
        self.steps.push((name.to_owned(), time, error));
        self.steps.last().is_some_and(|step| step.2.is_none())
    }

    /// Lists all steps, and fails if one did.
    pub(crate) fn finish(self) -> Result<()> {
        let total = self.steps.iter().map(|step| step.1).sum();
        let failed = self.steps.iter().filter(|step| step.2.is_some()).count();
        println!("\n=== summary");
        for (name, time, error) in &self.steps {
            println!("{}", line(name, *time, error.as_ref()));
        }
        println!("{}", line("all", total, None));
        if failed > 0 {
            bail!("{failed} of {} steps failed", self.steps.len());
        }
        Ok(())
    }
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
        let mut report = StepReport::default();
        assert!(report.step("one", || Ok(())));
        assert!(!report.step("two", || bail!("no luck")));
        assert!(report.step("three", || Ok(())));
        assert_eq!(report.finish().unwrap_err().to_string(), "1 of 3 steps failed");
    }

    #[test]
    fn says_what_failed() {
        let error = anyhow::anyhow!("inner").context("outer");
        let text = line("two", Duration::from_millis(1234), Some(&error));
        assert_eq!(text, "    1.2 s  two   FAILED: outer: inner");
    }
}
