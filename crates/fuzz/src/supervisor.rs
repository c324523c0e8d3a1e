//! The supervisor: runs workers, continues after a worker that dies, and prints the findings.

use crate::input::{Current, Input, Inputs};
use crate::worker::{EXIT_HANG, EXIT_MEMORY, keep};
use crate::{Options, Target};
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
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
            let results = Results::of(options, target)?;
            // All at once, because other targets print at the same time.
            print!("{}", results.text(target));
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

/// The results of one target.
#[derive(Default)]
struct Results {
    executions: u64,
    time: Duration,
    /// The most memory in use, in KiB.
    peak: u64,
    /// The most units of work in one step.
    work: u64,
    /// By point: the number of inputs that reached it.
    reached: BTreeMap<String, u64>,
    /// The slowest inputs: milliseconds, and the rest of the worker's line.
    slowest: Vec<(u64, String)>,
    /// The messages of faults, by file.
    findings: BTreeMap<String, String>,
}

impl Results {
    fn of(options: &Options, target: &'static Target) -> Result<Self> {
        let mut results = Self::default();
        let start = Instant::now();
        let mut from = options.from;
        let most = match options.short {
            true => Inputs::of(target, options.seed)?.committed() + options.times * target.short,
            false => options.executions,
        };
        let least = Inputs::of(target, options.seed)?.committed() + LEAST;
        loop {
            let done = from - options.from;
            // Slow targets get more time, so that each tries some inputs.
            let share = if done < least { MAX_SHARES } else { 1 };
            let time = options.time.map(|time| (time * share).saturating_sub(start.elapsed()));
            let left = if share > 1 && options.time.is_some() { least.min(most) } else { most }.saturating_sub(done);
            if left == 0 || time.is_some_and(|time| time.is_zero()) {
                break;
            }
            let (status, output) = run(options, target, from, time, left)?;
            let before = results.executions;
            results.read(&output);
            if status.success() {
                from += results.executions - before;
                continue;
            }
            let number = Current::read(&options.findings, target).context("a worker ended before its first input")?;
            results.add_crash(options, target, number, status)?;
            results.executions += number + 1 - from;
            from = number + 1;
        }
        results.time = start.elapsed();
        Ok(results)
    }

    /// Reads the output of a worker.
    fn read(&mut self, output: &str) {
        for line in output.lines() {
            let words: Vec<&str> = line.splitn(4, ' ').collect();
            let number = |at: usize| words.get(at).and_then(|word| word.parse::<u64>().ok()).unwrap_or(0);
            match words.first().copied() {
                Some("done") => {
                    self.executions += number(1);
                    self.peak = self.peak.max(number(2));
                    self.work = self.work.max(number(3));
                }
                Some("reached") => *self.reached.entry(words[2..].join(" ")).or_default() += number(1),
                Some("slowest") => self.slowest.push((number(1), words[2..].join(" "))),
                Some("finding") if words.len() == 4 => {
                    self.findings.entry(words[2].to_owned()).or_insert_with(|| words[3].to_owned());
                }
                _ => eprintln!("{line}"),
            }
        }
    }

    /// Adds a finding for the input that ended a worker, and writes the input to a file.
    fn add_crash(&mut self, options: &Options, target: &'static Target, number: u64, status: ExitStatus) -> Result<()> {
        let kind = match status.code() {
            Some(EXIT_HANG) => "hang",
            Some(EXIT_MEMORY) => "memory beyond all limits",
            _ => "abort",
        };
        let mut input = Input::default();
        Inputs::of(target, options.seed)?.fill(number, &mut input);
        let path = keep(options, target, &format!("{kind}-{number}"), &input)?;
        self.findings.insert(path.display().to_string(), format!("{kind} ({status})"));
        Ok(())
    }

    fn text(&self, target: &Target) -> String {
        let mut text = String::new();
        let seconds = self.time.as_secs_f64().max(1e-3);
        let rate = self.executions as f64 / seconds;
        let Self { executions, peak, work, .. } = self;
        let name = target.name;
        text += &format!(
            "{name:12} {executions:>10} executions {rate:>9.0} /s   {seconds:>5.1} s   peak {peak:>6} KiB   most work {work:>8}\n"
        );
        let reached: Vec<String> = self.reached.iter().map(|(name, count)| format!("{name} {count}")).collect();
        if !reached.is_empty() {
            text += &format!("             reached: {}\n", reached.join(", "));
        }
        let mut slowest = self.slowest.clone();
        slowest.sort();
        let slowest: Vec<String> = slowest.iter().rev().take(3).map(|(ms, name)| format!("{ms} ms ({name})")).collect();
        text += &format!("             slowest inputs: {}\n", slowest.join(", "));
        for (path, message) in &self.findings {
            let word = if is_known(message) { "known" } else { "FOUND" };
            text += &format!("  {word} {message}\n        cargo xtask fuzz {} --input {path}\n", target.name);
        }
        text
    }
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
