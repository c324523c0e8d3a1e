//! Feeds random inputs to the targets. `cargo xtask fuzz` runs it.

use anyhow::{Context, Result};
use lsystem_fuzz::{Options, Target, replay, shrink, supervise, work};

fn main() -> Result<()> {
    let options = Options::read();
    if options.list {
        println!("{}", Target::names().join("\n"));
        return Ok(());
    }
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
