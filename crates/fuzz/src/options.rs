//! The options of the program.
use crate::Target;
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::time::Duration;

/// The usage text.
const USAGE: &str = "\
usage: lsystem-fuzz [TARGET ...] [--seconds S | --executions N] [--seed N] [--findings FOLDER] [--jobs N]
                    [--patient] [--short [--times N]]
       lsystem-fuzz TARGET --input FILE [--shrink]

  --seconds S      the time for each target (default 10); or
  --executions N   the number of inputs for each target
  --seed N         the seed of the inputs (default 1)
  --findings F     the folder for inputs that fail
  --jobs N         the number of targets that are tried at the same time (default 2, or the number of cores if smaller);
                   each may hold 3 GiB
  --patient        do not stop inputs that hang
  --short          the committed inputs and some thousand random ones, always the same
  --times N        that many times as many random ones in the short run
  --input FILE     one input: bytes, or a system as JSON
  --shrink         find a smaller input with the same fault
";

/// The options of the program.
#[derive(Clone, Debug)]
pub struct Options {
    /// The targets to run.
    pub targets: Vec<&'static Target>,
    /// The time for each target.
    pub(crate) time: Option<Duration>,
    /// The most inputs for each target.
    pub(crate) executions: u64,
    pub(crate) seed: u64,
    /// The number of the first input.
    pub(crate) from: u64,
    pub(crate) findings: PathBuf,
    /// Whether to let inputs that hang continue.
    pub(crate) patient: bool,
    /// The number of targets that are tried at the same time.
    pub(crate) jobs: usize,
    /// Whether this is the short run of the tests.
    pub(crate) short: bool,
    /// How many times the short run's number of random inputs to try.
    pub(crate) times: u64,
    /// A single input to try.
    pub input: Option<PathBuf>,
    /// Whether to make the single input smaller.
    pub shrink: bool,
    /// Whether this process is a worker of a supervisor.
    pub worker: bool,
}

impl Options {
    /// Reads the program's arguments.
    ///
    /// # Errors
    /// A message about wrong usage.
    pub fn read(words: impl IntoIterator<Item = String>) -> Result<Self> {
        let mut options = Self {
            targets: vec![],
            time: None,
            executions: u64::MAX,
            seed: 1,
            from: 0,
            findings: PathBuf::from("target/fuzz"),
            patient: false,
            jobs: std::thread::available_parallelism().map_or(1, |cores| cores.get().min(2)),
            short: false,
            times: 1,
            input: None,
            shrink: false,
            worker: false,
        };
        let mut words = words.into_iter();
        while let Some(word) = words.next() {
            let mut value = || words.next().with_context(|| format!("`{word}` needs a value\n\n{USAGE}"));
            match word.as_str() {
                "--seconds" => options.time = Some(Duration::from_secs_f64(value()?.parse()?)),
                "--executions" => options.executions = value()?.parse()?,
                "--seed" => options.seed = value()?.parse()?,
                "--from" => options.from = value()?.parse()?,
                "--findings" => options.findings = value()?.into(),
                "--jobs" => options.jobs = value()?.parse()?,
                "--times" => options.times = value()?.parse()?,
                "--input" => options.input = Some(value()?.into()),
                "--short" => options.short = true,
                "--patient" => options.patient = true,
                "--shrink" => options.shrink = true,
                "--worker" => options.worker = true,
                name => match Target::named(name) {
                    Some(target) => options.targets.push(target),
                    None => {
                        bail!("there is no target `{name}`; the targets are {}\n\n{USAGE}", Target::names().join(", "))
                    }
                },
            }
        }
        if options.time.is_none() && !options.short && options.executions == u64::MAX {
            options.time = Some(Duration::from_secs(10));
        }
        if options.targets.is_empty() {
            options.targets = Target::all().collect();
        }
        Ok(options)
    }
}
