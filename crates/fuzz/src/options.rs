//! What the program is asked to do.

use crate::Target;
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::time::Duration;

/// How to use the program.
const USAGE: &str = "\
usage: lsystem-fuzz [TARGET ...] [--seconds S | --executions N] [--seed N] [--findings FOLDER] [--patient] [--short]
       lsystem-fuzz TARGET --input FILE [--shrink]

  --seconds S      for each target, 10 unless given; or
  --executions N   as many for each target
  --seed N         the inputs, 1 unless given
  --findings F     where inputs that fail are kept
  --patient        no input is taken to hang
  --short          the committed inputs, and some thousand random ones: always the same
  --input FILE     one input: bytes, or a system as JSON
  --shrink         finds a smaller input that fails alike
";

/// What the program is asked to do.
#[derive(Clone, Debug)]
pub struct Options {
    /// The targets.
    pub targets: Vec<&'static Target>,
    /// For each target.
    pub(crate) time: Option<Duration>,
    /// For each target, at most.
    pub(crate) executions: u64,
    pub(crate) seed: u64,
    /// The number of the first input.
    pub(crate) from: u64,
    pub(crate) findings: PathBuf,
    /// Whether no input is taken to hang.
    pub(crate) patient: bool,
    /// Whether it is the short run of the tests.
    pub(crate) short: bool,
    /// A single input to try.
    pub input: Option<PathBuf>,
    /// Whether to make it smaller.
    pub shrink: bool,
    /// Whether another process of this program watches over this one.
    pub worker: bool,
}

impl Options {
    /// Reads the program's arguments.
    ///
    /// # Errors
    /// Where they have no meaning.
    pub fn read(words: impl IntoIterator<Item = String>) -> Result<Self> {
        let mut options = Self {
            targets: vec![],
            time: None,
            executions: u64::MAX,
            seed: 1,
            from: 0,
            findings: PathBuf::from("target/fuzz"),
            patient: false,
            short: false,
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
                "--input" => options.input = Some(value()?.into()),
                "--short" => options.short = true,
                "--patient" => options.patient = true,
                "--shrink" => options.shrink = true,
                "--worker" => options.worker = true,
                name => match Target::named(name) {
                    Some(target) => options.targets.push(target),
                    None => bail!("there is no target `{name}`; there are {}\n\n{USAGE}", Target::names().join(", ")),
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
