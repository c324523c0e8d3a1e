//! The worker: tries one input after the other, and reports to the supervisor.

use crate::clock::process_time;
use crate::input::{Current, Input, Inputs};
use crate::results::Results;
use crate::shrink::place;
use crate::{ALLOCATOR, Options, Target, once, told};
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The processor time after which an input counts as hanging.
const HANG: Duration = Duration::from_secs(10);
/// The bytes at which the program ends itself, before the machine runs out of memory.
const TOO_MUCH: usize = 3 << 30;
/// The exit code after an input hangs.
pub(crate) const EXIT_HANG: i32 = 3;
/// The exit code after an input uses too much memory.
pub(crate) const EXIT_MEMORY: i32 = 4;

/// Tries inputs until the time or number in the options is reached. Prints findings, and at the end the resources used,
/// as lines on standard output.
///
/// # Errors
/// Files that cannot be read or written.
pub fn work(options: &Options) -> Result<()> {
    told::speak();
    for target in &options.targets {
        Worker { options, target, found: BTreeMap::new() }.run()?;
    }
    Ok(())
}

struct Worker<'a> {
    options: &'a Options,
    target: &'static Target,
    /// By place of the fault: the length of the shortest input.
    found: BTreeMap<String, usize>,
}

impl Worker<'_> {
    fn run(&mut self) -> Result<()> {
        let Options { seed, from, executions, findings, .. } = self.options;
        let mut current = Current::new(findings, self.target)?;
        let start = Instant::now();
        if !self.options.patient {
            watch();
        }
        let inputs = Inputs::of(self.target, *seed)?;
        let mut input = Input::default();
        let (mut number, mut results) = (*from, Results::default());
        while number - from < *executions && self.options.time.is_none_or(|time| start.elapsed() < time) {
            inputs.fill(number, &mut input);
            current.note(number)?;
            let began = begin();
            let (gauge, outcome) = once(self.target, &mut input.source());
            let time = process_time() - began;
            results.add(Results {
                executions: 1,
                peak: gauge.peak() >> 10,
                work: gauge.work,
                reached: gauge.reached.iter().map(|&name| (name.to_owned(), 1)).collect(),
                slowest: vec![(time.as_millis() as u64, number, gauge.slowest.0.to_owned())],
                findings: BTreeMap::new(),
            });
            if let Err(message) = outcome {
                self.keep(&message, &input)?;
            }
            number += 1;
        }
        SINCE.store(u64::MAX, Ordering::Relaxed);
        println!("{}", serde_json::to_string(&results)?);
        Ok(())
    }

    /// Keeps the shortest input of every fault.
    fn keep(&mut self, message: &str, input: &Input) -> Result<()> {
        let place = place(message).to_owned();
        let size = input.bytes.len();
        let shortest = self.found.get(&place).copied().unwrap_or(usize::MAX);
        if size < shortest {
            let path = keep(self.options, self.target, &place, input)?;
            if shortest == usize::MAX {
                let first = message.lines().next().unwrap_or_default();
                let findings = [(path.display().to_string(), first.to_owned())].into();
                println!("{}", serde_json::to_string(&Results { findings, ..Results::default() })?);
            }
            self.found.insert(place, size);
        }
        Ok(())
    }
}

/// Writes an input that fails to a file. Returns the file's path.
pub(crate) fn keep(options: &Options, target: &Target, place: &str, input: &Input) -> Result<PathBuf> {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    let name: String = place.rsplit("src/").next().unwrap_or(place).chars().map(plain).take(60).collect();
    // The bytes of a committed system's choices go into another file beside it.
    let (ending, bytes) = match &input.system {
        Some(system) => ("json", lsystem::write_json(system).into_bytes()),
        None => ("bin", input.bytes.clone()),
    };
    let path = options.findings.join(format!("{}-{name}.{ending}", target.name));
    std::fs::write(&path, bytes).with_context(|| format!("writing {}", path.display()))?;
    if input.system.is_some() {
        let beside = path.with_extension("bytes");
        std::fs::write(&beside, &input.bytes).with_context(|| format!("writing {}", beside.display()))?;
    }
    Ok(path)
}

/// The start of the present execution, in milliseconds of processor time.
static SINCE: AtomicU64 = AtomicU64::new(u64::MAX);

/// Notes the start of an execution, and returns it in processor time.
pub(crate) fn begin() -> Duration {
    let now = process_time();
    SINCE.store(now.as_millis() as u64, Ordering::Relaxed);
    now
}

/// Ends the process when an input hangs or uses too much memory. The supervisor then continues after that input.
pub fn watch() {
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_millis(20));
            let since = Duration::from_millis(SINCE.load(Ordering::Relaxed));
            if process_time().saturating_sub(since) > HANG {
                std::process::exit(EXIT_HANG);
            }
            if ALLOCATOR.current_usage() > TOO_MUCH {
                std::process::exit(EXIT_MEMORY);
            }
        }
    });
}
