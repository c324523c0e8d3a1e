//! Processor seconds of the steps of the last whole test that began without compiled files, in seconds of one machine.
//!
//! Machines differ, and a busy one is slower. So every step also times a fixed piece of work, and all seconds are
//! multiplied by how much faster that work was on the machine on which the limits were set.

use super::Measured;
use crate::files;
use crate::workspace::Workspace;
use anyhow::{Context, Result};
use fs_err as fs;
use sha2::{Digest, Sha256};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The fixed piece of work: the SHA-256 of as many zero bytes.
const WORK: usize = 16 << 20;
/// The time of [`WORK`] on the machine of the limits.
const REFERENCE: Duration = Duration::from_micros(11_000);

/// The time of the fixed piece of work now.
pub(crate) fn sample() -> Duration {
    let bytes = vec![0; WORK];
    let start = Instant::now();
    std::hint::black_box(Sha256::digest(&bytes));
    start.elapsed()
}

fn file(workspace: &Workspace) -> PathBuf {
    workspace.target.join("test/spent.txt")
}

/// Keeps the processor times of the steps. `samples` are times of the fixed piece of work during the run.
pub(crate) fn keep(workspace: &Workspace, steps: &[(&str, Duration)], mut samples: Vec<Duration>) -> Result<()> {
    samples.sort();
    let typical = samples.get(samples.len() / 2).copied().unwrap_or(REFERENCE);
    let scale = REFERENCE.as_secs_f64() / typical.as_secs_f64();
    let lines = steps.iter().map(|(name, time)| format!("{:.1} {name}\n", time.as_secs_f64() * scale));
    files::write(&file(workspace), lines.collect::<String>())
}

/// The kept times; none if there was no such run.
pub(super) fn measured(workspace: &Workspace) -> Result<Measured> {
    let text = fs::read_to_string(file(workspace)).unwrap_or_default();
    let rows = text.lines().map(|line| {
        let (seconds, name) = line.split_once(' ').context("a time without a step")?;
        Ok((name.to_owned(), seconds.parse()?))
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_one_machine() {
        let mut workspace = Workspace::find().unwrap();
        let folder = tempfile::tempdir().unwrap();
        workspace.target = folder.path().to_owned();
        assert!(measured(&workspace).unwrap().is_empty());
        let seconds = |seconds| Duration::from_secs(seconds);
        keep(&workspace, &[("a step", seconds(8)), ("b", seconds(2))], vec![REFERENCE * 2; 3]).unwrap();
        assert_eq!(measured(&workspace).unwrap(), [("a step".to_owned(), 4.0), ("b".to_owned(), 1.0)].into());
    }
}
