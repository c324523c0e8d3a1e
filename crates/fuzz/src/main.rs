//! Feeds random inputs to the targets. `cargo xtask fuzz` runs it.

use anyhow::{Context, Result};
use lsystem_fuzz::{Options, Target, replay, shrink, supervise, work};
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    if std::env::args().nth(1).is_some_and(|word| word == "--list") {
        println!("{}", Target::names().join("\n"));
        return Ok(());
    }
    let options = Options::read(std::env::args().skip(1))?;
    if options.worker {
        return work(&options);
    }
    let Some(path) = &options.input else { return supervise(&options) };
    let target = options.targets.first().context("--input needs a target")?;
    if options.shrink {
        let bytes = shrink(target, &std::fs::read(path).with_context(|| format!("reading {}", path.display()))?);
        std::fs::write(path, bytes).with_context(|| format!("writing {}", path.display()))?;
    }
    replay(target, path)
}
