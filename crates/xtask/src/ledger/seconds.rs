//! Processor seconds of the steps of the last whole test that began without compiled files, in seconds of one machine.
//!
//! Machines differ, and a busy one is slower. So every step also times a fixed piece of work, and all seconds are
//! multiplied by how much faster that work was on the machine on which the limits were set.

use super::Measured;
use crate::files;
use crate::workspace::{Workspace, output};
use anyhow::{Context, Result, ensure};
use fs_err as fs;
use sha2::{Digest, Sha256};
use std::io::{BufRead as _, BufReader};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use wait4::Wait4 as _;

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

fn file(workspace: &Workspace, name: &str) -> PathBuf {
    workspace.target.join("test").join(name)
}

const TEST: &str = "spent.txt";
const SERVE: &str = "spent-serve.txt";

/// Keeps the processor times of the steps. `samples` are times of the fixed piece of work during the run.
pub(crate) fn keep(workspace: &Workspace, steps: &[(&str, Duration)], samples: Vec<Duration>) -> Result<()> {
    keep_in(TEST, workspace, steps, samples)
}

fn keep_in(name: &str, workspace: &Workspace, steps: &[(&str, Duration)], mut samples: Vec<Duration>) -> Result<()> {
    samples.sort();
    let typical = samples.get(samples.len() / 2).copied().unwrap_or(REFERENCE);
    let scale = REFERENCE.as_secs_f64() / typical.as_secs_f64();
    let lines = steps.iter().map(|(name, time)| format!("{:.1} {name}\n", time.as_secs_f64() * scale));
    files::write(&file(workspace, name), lines.collect::<String>())
}

/// The times of the test's steps; none if there was no such run.
pub(super) fn of_test(workspace: &Workspace) -> Result<Measured> {
    kept(TEST, workspace)
}

/// The time of [`serve()`]; none if it has not been measured here.
pub(super) fn of_serve(workspace: &Workspace) -> Result<Measured> {
    kept(SERVE, workspace)
}

fn kept(name: &str, workspace: &Workspace) -> Result<Measured> {
    let text = fs::read_to_string(file(workspace, name)).unwrap_or_default();
    let rows = text.lines().map(|line| {
        let (seconds, name) = line.split_once(' ').context("a time without a step")?;
        Ok((name.to_owned(), seconds.parse()?))
    });
    rows.collect()
}

/// Serves a clone of the last commit that has nothing compiled, until it prints its address, and keeps the processor time.
pub(super) fn serve(workspace: &Workspace) -> Result<()> {
    let folder = tempfile::tempdir()?;
    let clone = folder.path().join("clone");
    output(Command::new("git").arg("clone").arg("--quiet").arg(&workspace.root).arg(&clone))?;
    let sample = sample();
    let mut serving = Command::new("cargo")
        .args(["xtask", "serve"])
        .current_dir(&clone)
        .env("CARGO_TARGET_DIR", folder.path().join("target"))
        .stdout(Stdio::piped())
        .spawn()?;
    let lines = BufReader::new(serving.stdout.take().context("a program without output")?).lines();
    let is_served = lines.map_while(Result::ok).any(|line| line.starts_with("http://"));
    // What has ended counts: the compilers until now, not those that go on with the tools.
    serving.kill()?;
    let spent = serving.wait4()?.rusage;
    ensure!(is_served, "the clone was not served");
    keep_in(SERVE, workspace, &[("serve", spent.utime + spent.stime)], vec![sample])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_one_machine() {
        let mut workspace = Workspace::find().unwrap();
        let folder = tempfile::tempdir().unwrap();
        workspace.target = folder.path().to_owned();
        assert!(of_test(&workspace).unwrap().is_empty());
        let seconds = |seconds| Duration::from_secs(seconds);
        keep(&workspace, &[("a step", seconds(8)), ("b", seconds(2))], vec![REFERENCE * 2; 3]).unwrap();
        assert_eq!(of_test(&workspace).unwrap(), [("a step".to_owned(), 4.0), ("b".to_owned(), 1.0)].into());
    }
}
