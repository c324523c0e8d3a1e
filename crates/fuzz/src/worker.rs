//! The worker: tries one input after the other, and reports to the supervisor.

use crate::clock::process_time;
use crate::input::{Current, Input, Inputs};
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
        Worker::new(options, target).run()?;
    }
    Ok(())
}

struct Worker<'a> {
    options: &'a Options,
    target: &'static Target,
    /// By place of the fault: the length of the shortest input.
    found: BTreeMap<String, usize>,
    /// The slowest inputs: processor time, number, and slowest call.
    slowest: Vec<(Duration, u64, &'static str)>,
    /// By point: the number of inputs that reached it.
    reached: BTreeMap<&'static str, u64>,
    /// The most bytes in use.
    peak: usize,
    /// The most units of work in one step.
    work: u64,
}

impl<'a> Worker<'a> {
    fn new(options: &'a Options, target: &'static Target) -> Self {
        Self { options, target, found: BTreeMap::new(), slowest: vec![], reached: BTreeMap::new(), peak: 0, work: 0 }
    }

    fn run(&mut self) -> Result<()> {
        let Options { seed, from, executions, findings, .. } = self.options;
        let mut current = Current::new(findings, self.target)?;
        let start = Instant::now();
        if !self.options.patient {
            watch();
        }
        let inputs = Inputs::of(self.target, *seed)?;
        let mut input = Input::default();
        let mut number = *from;
        while number - from < *executions && self.options.time.is_none_or(|time| start.elapsed() < time) {
            inputs.fill(number, &mut input);
            current.note(number)?;
            let began = begin();
            let (gauge, outcome) = once(self.target, &mut input.source());
            let time = process_time() - began;
            self.peak = self.peak.max(gauge.peak());
            self.work = self.work.max(gauge.work());
            for &name in gauge.reached() {
                *self.reached.entry(name).or_default() += 1;
            }
            self.rank(time, number, gauge.slowest().0);
            if let Err(message) = outcome {
                self.keep(&message, &input, number)?;
            }
            number += 1;
        }
        SINCE.store(u64::MAX, Ordering::Relaxed);
        println!("done {} {} {}", number - from, self.peak >> 10, self.work);
        for (name, count) in &self.reached {
            println!("reached {count} {name}");
        }
        for (time, number, name) in &self.slowest {
            println!("slowest {} {number} {name}", time.as_millis());
        }
        Ok(())
    }

    /// Adds an input to the slowest three.
    fn rank(&mut self, time: Duration, number: u64, name: &'static str) {
        self.slowest.push((time, number, name));
        self.slowest.sort_by_key(|entry| core::cmp::Reverse(entry.0));
        self.slowest.truncate(3);
    }

    /// Keeps the shortest input of every fault.
    fn keep(&mut self, message: &str, input: &Input, number: u64) -> Result<()> {
        let place = place(message).to_owned();
        let size = input.bytes.len();
        let shortest = self.found.get(&place).copied().unwrap_or(usize::MAX);
        if size < shortest {
            let path = keep(self.options, self.target, &place, input)?;
            if shortest == usize::MAX {
                let first = message.lines().next().unwrap_or_default();
                println!("finding {number} {} {first}", path.display());
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
