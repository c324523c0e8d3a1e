//! The supervisor: runs workers, continues after a worker that dies, and prints the findings.

use crate::input::{Current, Input, Inputs};
use crate::results::Results;
use crate::worker::{EXIT_HANG, EXIT_MEMORY, keep};
use crate::{Options, Target};
use anyhow::{Context, Result, bail};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Tries every target in separate processes, some at the same time.
///
/// # Errors
/// Findings, or a worker that cannot be started.
pub fn supervise(options: &Options) -> Result<()> {
    let folder = &options.findings;
    std::fs::create_dir_all(folder).with_context(|| format!("creating {}", folder.display()))?;
    let queue = Mutex::new(options.targets.iter());
    let next = || queue.lock().ok()?.next().copied();
    let job = || -> Result<usize> {
        let mut found = 0;
        while let Some(target) = next() {
            let start = Instant::now();
            let results = results(options, target, start)?;
            // All at once, because other targets print at the same time.
            print!("{}", text(target, &results, start.elapsed()));
            found += results.findings.values().filter(|message| !is_known(message)).count();
        }
        Ok(found)
    };
    let counts: Result<Vec<usize>> = std::thread::scope(|scope| {
        let jobs: Vec<_> = (0..options.jobs.max(1)).map(|_| scope.spawn(job)).collect();
        jobs.into_iter().map(|job| job.join().unwrap_or_else(|_| bail!("a supervisor panicked"))).collect()
    });
    let found: usize = counts?.into_iter().sum();
    if found > 0 {
        bail!("{found} findings; to repeat one: `cargo xtask fuzz TARGET --input FILE`");
    }
    Ok(())
}

/// The random inputs that every target tries, and how many shares of the time it may take for them.
const LEAST: u64 = 1_000;
const MAX_SHARES: u32 = 8;

/// Known faults that are not mended yet: one part of a message on each line. They are printed, but do not fail a run.
const KNOWN: &str = include_str!("../known.txt");

/// Whether a fault is known.
fn is_known(message: &str) -> bool {
    let mut known = KNOWN.lines().filter(|line| !line.is_empty() && !line.starts_with("# "));
    known.any(|line| message.contains(line))
}

/// Tries the inputs of a target.
fn results(options: &Options, target: &'static Target, start: Instant) -> Result<Results> {
    let mut results = Results::default();
    let mut from = options.from;
    let inputs = Inputs::of(target, options.seed)?;
    let most = match options.short {
        true => inputs.committed() + options.times * target.short,
        false => options.executions,
    };
    let least = inputs.committed() + LEAST;
    loop {
        let done = from - options.from;
        // Slow targets get more time, so that each tries some inputs.
        let share = if done < least { MAX_SHARES } else { 1 };
        let time = options.time.map(|time| (time * share).saturating_sub(start.elapsed()));
        let left = if share > 1 && options.time.is_some() { least.min(most) } else { most }.saturating_sub(done);
        if left == 0 || time.is_some_and(|time| time.is_zero()) {
            return Ok(results);
        }
        let (status, output) = run(options, target, from, time, left)?;
        let before = results.executions;
        for line in output.lines() {
            serde_json::from_str(line).map_or_else(|_| eprintln!("{line}"), |more| results.add(more));
        }
        if status.success() {
            from += results.executions - before;
            continue;
        }
        let number = Current::read(&options.findings, target).context("a worker ended before its first input")?;
        let kind = match status.code() {
            Some(EXIT_HANG) => "hang",
            Some(EXIT_MEMORY) => "memory beyond all limits",
            _ => "abort",
        };
        let mut input = Input::default();
        inputs.fill(number, &mut input);
        let path = keep(options, target, &format!("{kind}-{number}"), &input)?;
        results.findings.insert(path.display().to_string(), format!("{kind} ({status})"));
        results.executions += number + 1 - from;
        from = number + 1;
    }
}

fn text(target: &Target, results: &Results, time: Duration) -> String {
    let Results { executions, peak, work, reached, slowest, findings } = results;
    let (name, seconds) = (target.name, time.as_secs_f64().max(1e-3));
    let rate = *executions as f64 / seconds;
    let mut text = format!(
        "{name:12} {executions:>10} executions {rate:>9.0} /s   {seconds:>5.1} s   peak {peak:>6} KiB   most work {work:>8}\n"
    );
    let reached: Vec<String> = reached.iter().map(|(name, count)| format!("{name} {count}")).collect();
    if !reached.is_empty() {
        text += &format!("             reached: {}\n", reached.join(", "));
    }
    let slowest: Vec<String> = slowest.iter().map(|(ms, number, name)| format!("{ms} ms ({number} {name})")).collect();
    text += &format!("             slowest inputs: {}\n", slowest.join(", "));
    for (path, message) in findings {
        let word = if is_known(message) { "known" } else { "FOUND" };
        text += &format!("  {word} {message}\n        cargo xtask fuzz {name} --input {path}\n");
    }
    text
}

/// Runs a worker from the input `from` on. Returns its exit status and output.
fn run(
    options: &Options,
    target: &Target,
    from: u64,
    time: Option<Duration>,
    executions: u64,
) -> Result<(ExitStatus, String)> {
    let mut command = Command::new(std::env::current_exe().context("finding this program")?);
    command.args(["--worker", target.name, "--seed", &options.seed.to_string(), "--from", &from.to_string()]);
    command.args(["--executions", &executions.to_string()]).arg("--findings").arg(&options.findings);
    if let Some(time) = time {
        command.args(["--seconds", &time.as_secs_f64().to_string()]);
    }
    if options.patient {
        command.arg("--patient");
    }
    let output = command.stderr(Stdio::inherit()).output().context("starting a worker")?;
    Ok((output.status, String::from_utf8_lossy(&output.stdout).into_owned()))
}
