//! `cargo xtask monkey`: random actions on the page and on embedded drawings, in a real browser.

use crate::workspace::Workspace;
use crate::{build, page};
use anyhow::Result;

/// The options of the script.
#[derive(clap::Args)]
pub(crate) struct MonkeyOptions {
    #[arg(long)]
    minutes: Option<f64>,
    /// Equal seeds give equal actions
    #[arg(long)]
    seed: Option<u32>,
    #[arg(long, requires = "seed")]
    actions: Option<u32>,
    /// Print every action
    #[arg(long)]
    verbose: bool,
}

impl MonkeyOptions {
    /// The short run of the thorough tests, always with the same seed.
    pub(crate) fn one_minute() -> Self {
        Self { minutes: Some(1.0), seed: Some(1), actions: None, verbose: false }
    }

    fn words(&self) -> Vec<String> {
        let option = |name: &str, value: Option<String>| value.map(|value| [name.to_owned(), value]);
        let options = [
            option("--minutes", self.minutes.map(|minutes| minutes.to_string())),
            option("--seed", self.seed.map(|seed| seed.to_string())),
            option("--actions", self.actions.map(|actions| actions.to_string())),
        ];
        options.into_iter().flatten().flatten().chain(self.verbose.then(|| "--verbose".to_owned())).collect()
    }
}

/// Builds the page and runs the monkey on it.
pub(crate) fn monkey(workspace: &Workspace, options: &MonkeyOptions) -> Result<()> {
    build::build(workspace, build::Kind::Shipped, None)?;
    run(workspace, options)
}

/// Runs the monkey on the built page.
pub(crate) fn run(workspace: &Workspace, options: &MonkeyOptions) -> Result<()> {
    page::script(workspace, "test/monkey/monkey.mjs", &options.words())
}
