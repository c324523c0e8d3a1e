//! The options of the program.
use crate::Target;
use clap::Parser;
use std::path::PathBuf;
use std::time::Duration;

/// Feeds random inputs to the targets.
#[derive(Clone, Debug, Parser)]
#[command(name = "lsystem-fuzz")]
pub struct Options {
    /// The targets; all if none is named
    #[arg(value_parser = target)]
    pub targets: Vec<&'static Target>,
    /// The time for each target in seconds; 10 if no number of inputs is given
    #[arg(long = "seconds", value_parser = |text: &str| text.parse().map(Duration::from_secs_f64))]
    pub(crate) time: Option<Duration>,
    /// The number of inputs for each target
    #[arg(long, default_value_t = u64::MAX, hide_default_value = true)]
    pub(crate) executions: u64,
    /// The seed of the inputs
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// The number of the first input
    #[arg(long, default_value_t = 0)]
    pub(crate) from: u64,
    /// The folder for inputs that fail
    #[arg(long, default_value = "target/fuzz")]
    pub(crate) findings: PathBuf,
    /// Let inputs that hang continue
    #[arg(long)]
    pub(crate) patient: bool,
    /// The number of targets that are tried at the same time; each may hold 3 GiB
    #[arg(long, default_value_t = std::thread::available_parallelism().map_or(1, |cores| cores.get().min(2)))]
    pub(crate) jobs: usize,
    /// The committed inputs and some thousand random ones, always the same
    #[arg(long)]
    pub(crate) short: bool,
    /// How many times the short run's number of random inputs to try
    #[arg(long, default_value_t = 1)]
    pub(crate) times: u64,
    /// One input: bytes, or a system as JSON
    #[arg(long)]
    pub input: Option<PathBuf>,
    /// Find a smaller input with the same fault
    #[arg(long)]
    pub shrink: bool,
    /// This process is a worker of a supervisor
    #[arg(long, hide = true)]
    pub worker: bool,
    /// Print the names of the targets
    #[arg(long)]
    pub list: bool,
}

fn target(name: &str) -> Result<&'static Target, String> {
    Target::named(name).ok_or_else(|| format!("the targets are {}", Target::names().join(", ")))
}

impl Options {
    /// The program's arguments.
    #[must_use]
    pub fn read() -> Self {
        let mut options = Self::parse();
        if options.time.is_none() && !options.short && options.executions == u64::MAX {
            options.time = Some(Duration::from_secs(10));
        }
        if options.targets.is_empty() {
            options.targets = Target::all().collect();
        }
        options
    }
}
