//! Runs workers, goes on where one died, and tells what was found.

use crate::input::{Current, Input, Inputs};
use crate::worker::{HUNG, SWOLLEN, keep};
use crate::{Options, Target};
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Tries every target in processes of their own.
///
/// # Errors
/// Where something was found, or the program cannot be started.
pub fn supervise(options: &Options) -> Result<()> {
    let folder = &options.findings;
    std::fs::create_dir_all(folder).with_context(|| format!("creating {}", folder.display()))?;
    let mut found = 0;
    for target in &options.targets {
        let outcome = Tally::of(options, target)?;
        outcome.print(target);
        found += outcome.findings.values().filter(|message| !is_known(message)).count();
    }
    if found > 0 {
        bail!("{found} findings; to see one again: `cargo xtask fuzz TARGET --input FILE`");
    }
    Ok(())
}

/// Faults that are not mended yet, by what their message holds, a line each: they are told, but do not fail a run.
const KNOWN: &str = include_str!("../known.txt");

/// Whether a fault is known. What took long may have met a busy machine, and is no fault by itself.
fn is_known(message: &str) -> bool {
    let mut known = KNOWN.lines().filter(|line| !line.is_empty() && !line.starts_with("# "));
    message.starts_with("slow ") || known.any(|line| message.contains(line))
}

/// What came of a target.
#[derive(Default)]
struct Tally {
    executions: u64,
    time: Duration,
    /// KiB.
    peak: u64,
    /// The most units of work of a step.
    work: u64,
    reached: BTreeMap<String, u64>,
    /// Milliseconds, and the rest of the line.
    slowest: Vec<(u64, String)>,
    /// By file: what happened.
    findings: BTreeMap<String, String>,
}

impl Tally {
    fn of(options: &Options, target: &'static Target) -> Result<Self> {
        let mut tally = Self::default();
        let start = Instant::now();
        let mut from = options.from;
        let most = match options.short {
            true => Inputs::of(target, options.seed)?.committed() + target.short,
            false => options.executions,
        };
        loop {
            let time = options.time.map(|time| time.saturating_sub(start.elapsed()));
            let left = most.saturating_sub(from - options.from);
            if left == 0 || time.is_some_and(|time| time.is_zero()) {
                break;
            }
            let (status, output) = run(options, target, from, time, left)?;
            tally.read(&output);
            if status.success() {
                break;
            }
            let number = Current::read(&options.findings, target).context("a worker ended before its first input")?;
            tally.died(options, target, number, status)?;
            tally.executions += number + 1 - from;
            from = number + 1;
        }
        tally.time = start.elapsed();
        Ok(tally)
    }

    /// Reads what a worker tells.
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
                _ => println!("{line}"),
            }
        }
    }

    /// Keeps the input that a worker died of.
    fn died(&mut self, options: &Options, target: &'static Target, number: u64, status: ExitStatus) -> Result<()> {
        let kind = match status.code() {
            Some(HUNG) => "hang",
            Some(SWOLLEN) => "memory beyond all limits",
            _ => "abort",
        };
        let mut input = Input::default();
        Inputs::of(target, options.seed)?.fill(number, &mut input);
        let path = keep(options, target, &format!("{kind}-{number}"), &input)?;
        self.findings.insert(path.display().to_string(), format!("{kind} ({status})"));
        Ok(())
    }

    fn print(&self, target: &Target) {
        let seconds = self.time.as_secs_f64().max(1e-3);
        let rate = self.executions as f64 / seconds;
        let Self { executions, peak, work, .. } = self;
        let name = target.name;
        println!("{name:12} {executions:>10} executions {rate:>9.0} /s   peak {peak:>6} KiB   most work {work:>8}");
        let reached: Vec<String> = self.reached.iter().map(|(name, count)| format!("{name} {count}")).collect();
        if !reached.is_empty() {
            println!("             reached: {}", reached.join(", "));
        }
        let mut slowest = self.slowest.clone();
        slowest.sort();
        let slowest: Vec<String> = slowest.iter().rev().take(3).map(|(ms, name)| format!("{ms} ms ({name})")).collect();
        println!("             slowest inputs: {}", slowest.join(", "));
        for (path, message) in &self.findings {
            let word = if is_known(message) { "known" } else { "FOUND" };
            println!("  {word} {message}\n        cargo xtask fuzz {} --input {path}", target.name);
        }
    }
}

/// Runs a worker from the input `from` on; how it ended and what it told.
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
