//! Other programs: run to their end, or ended after the deadline, and the processor time that they took.

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::fs::File;
use std::io::{Read as _, Seek as _};
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use wait4::Wait4 as _;

/// How often a running program is looked at.
const PAUSE: Duration = Duration::from_millis(10);

/// Processor time, of the user and of the system. Clones share one sum.
#[derive(Clone, Default)]
pub(crate) struct Spent(Arc<Mutex<Duration>>);

impl Spent {
    pub(crate) fn total(&self) -> Duration {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn add(&self, time: Duration) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) += time;
    }
}

/// Runs a program to its end. One that is still running after the deadline is ended, which is an error.
pub(crate) fn status(command: &mut Command, deadline: Duration, spent: &Spent) -> Result<ExitStatus> {
    let mut child = command.spawn().with_context(|| format!("starting `{}`", words(command)))?;
    let start = Instant::now();
    loop {
        if let Some(ended) = child.try_wait4()? {
            spent.add(ended.rusage.utime + ended.rusage.stime);
            return Ok(ended.status);
        }
        if start.elapsed() > deadline {
            child.kill()?;
            child.wait()?;
            bail!("`{}` has not ended in {} s, and was stopped", words(command), deadline.as_secs());
        }
        thread::sleep(PAUSE);
    }
}

/// Runs a program to its end and returns its standard output. The error contains all that the program wrote.
pub(crate) fn output(command: &mut Command, deadline: Duration, spent: &Spent) -> Result<String> {
    // Files and not pipes: who holds the end of a pipe after the program has ended would be waited for.
    let [mut out, mut err] = [tempfile::tempfile()?, tempfile::tempfile()?];
    command.stdin(Stdio::null()).stdout(out.try_clone()?).stderr(err.try_clone()?);
    let ended = status(command, deadline, spent);
    let [out, err] = [read(&mut out)?, read(&mut err)?];
    let status = ended.with_context(|| format!("{out}{err}"))?;
    if !status.success() {
        bail!("`{}` failed ({status})\n{out}{err}", words(command));
    }
    Ok(out)
}

fn read(file: &mut File) -> Result<String> {
    let mut bytes = vec![];
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The command line for messages, without the program's folder and without quotes.
pub(crate) fn words(command: &Command) -> String {
    let program = PathBuf::from(command.get_program());
    let name = program.file_name().unwrap_or(OsStr::new("?"));
    let words: Vec<_> = [name].into_iter().chain(command.get_args()).map(OsStr::to_string_lossy).collect();
    words.join(" ")
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn what_hangs_is_ended_by_name() {
        let mut hangs = Command::new("sh");
        hangs.args(["-c", "echo begun; exec sleep 600"]);
        let error = output(&mut hangs, Duration::from_millis(300), &Spent::default()).unwrap_err();
        let error = format!("{error:#}");
        assert!(error.contains("begun") && error.contains("sleep 600` has not ended"), "{error}");
    }

    #[test]
    fn processor_time_is_summed() {
        let spent = Spent::default();
        let mut works = Command::new("sh");
        works.args(["-c", "i=0; while [ $i -lt 20000 ]; do i=$((i + 1)); done; echo $i"]);
        assert_eq!(output(&mut works, Duration::MAX, &spent.clone()).unwrap(), "20000\n");
        assert!(spent.total() > Duration::ZERO);
        let mut fails = Command::new("sh");
        fails.args(["-c", "echo no >&2; exit 3"]);
        assert!(output(&mut fails, Duration::MAX, &spent).unwrap_err().to_string().contains("no\n"));
    }
}
