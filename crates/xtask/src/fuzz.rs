//! `cargo xtask fuzz`: random inputs for the core.

use crate::workspace::{Workspace, output, run};
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::process::Command;

/// The options of the command.
#[derive(Debug, Default, PartialEq)]
struct FuzzOptions<'a> {
    targets: Vec<&'a str>,
    /// The time for all targets together.
    minutes: Option<f64>,
    seed: Option<&'a str>,
    input: Option<&'a str>,
    shrink: bool,
    guided: bool,
}

impl<'a> FuzzOptions<'a> {
    fn read(mut words: impl Iterator<Item = &'a str>) -> Result<Self> {
        let mut options = Self::default();
        while let Some(word) = words.next() {
            let mut value = || words.next().with_context(|| format!("`{word}` needs a value"));
            match word {
                "--minutes" => options.minutes = Some(value()?.parse().context("`--minutes` needs a number")?),
                "--seed" => options.seed = Some(value()?),
                "--input" => options.input = Some(value()?),
                "--shrink" => options.shrink = true,
                "--guided" => options.guided = true,
                word if word.starts_with('-') => bail!("unknown option `{word}`"),
                target => options.targets.push(target),
            }
        }
        Ok(options)
    }
}

/// Fuzzes the named targets or all, or tries a single input.
pub(crate) fn fuzz<'a>(workspace: &Workspace, words: impl Iterator<Item = &'a str>) -> Result<()> {
    let mut options = FuzzOptions::read(words)?;
    let program = build(workspace)?;
    if let Some(input) = options.input {
        let mut command = Command::new(&program);
        command.args(&options.targets).args(["--input", input]).args(options.shrink.then_some("--shrink"));
        return run(&mut command);
    }
    let names = output(Command::new(&program).arg("--list"))?;
    if options.targets.is_empty() {
        options.targets = names.lines().collect();
    }
    let seconds = 60.0 * options.minutes.unwrap_or(1.0) / options.targets.len() as f64;
    if options.guided {
        return guided(workspace, &options.targets, seconds);
    }
    let mut command = Command::new(&program);
    command.args(&options.targets).args(["--seconds", &seconds.to_string()]);
    command.args(options.seed.map(|seed| ["--seed", seed]).into_iter().flatten());
    command.arg("--findings").arg(workspace.target.join("fuzz/findings"));
    run(&mut command)
}

/// The short run of the tests, always with the same inputs.
pub(crate) fn short(workspace: &Workspace) -> Result<()> {
    let mut command = Command::new(build(workspace)?);
    run(command.args(["--short", "--patient", "--findings"]).arg(workspace.target.join("fuzz/findings")))
}

/// Builds the program and returns its path.
fn build(workspace: &Workspace) -> Result<PathBuf> {
    run(&mut workspace.cargo(["build", "--quiet", "--profile=fuzz", "--package=lsystem-fuzz"]))?;
    Ok(workspace.target.join("fuzz/lsystem-fuzz").with_extension(std::env::consts::EXE_EXTENSION))
}

/// Options of the stable compiler for LLVM's counters of edges and comparisons, which libFuzzer reads.
const COVERAGE: [&str; 6] = [
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
    // The counters of one module must stay together.
    "-Ccodegen-units=1",
];

/// Lets libFuzzer choose the inputs, for some seconds per target. libFuzzer keeps inputs that reach new code for the
/// next run, and writes a failing input to a file.
fn guided(workspace: &Workspace, targets: &[&str], seconds: f64) -> Result<()> {
    let host = output(Command::new("rustc").args(["--print=host-tuple"]))?;
    let host = host.trim();
    // With `--target`, Cargo compiles build scripts without the counters, which they could not link.
    let what = ["build", "--quiet", "--profile=fuzz", "--package=lsystem-fuzz", "--bin=guided", "--features=guided"];
    let folder = workspace.target.join("fuzz/guided");
    run(workspace
        .cargo(what)
        .args(["--target", host])
        .arg("--target-dir")
        .arg(&folder)
        .env("CARGO_ENCODED_RUSTFLAGS", COVERAGE.join("\u{1f}")))?;
    let program = folder.join(host).join("fuzz/guided");
    let findings = workspace.target.join("fuzz/findings");
    let mut failed = vec![];
    for &target in targets {
        println!("\n=== {target}");
        let corpus = workspace.target.join("fuzz/corpus").join(target);
        std::fs::create_dir_all(&corpus).with_context(|| format!("creating {}", corpus.display()))?;
        std::fs::create_dir_all(&findings).with_context(|| format!("creating {}", findings.display()))?;
        let mut command = Command::new(&program);
        command.arg(&corpus).arg(format!("-artifact_prefix={}/{target}-", findings.display()));
        command.arg(format!("-max_total_time={}", seconds.ceil()));
        command.args(["-max_len=4096", "-timeout=10", "-rss_limit_mb=3072", "-print_final_stats=1", "-verbosity=0"]);
        if run(command.env("LSYSTEM_FUZZ", target)).is_err() {
            failed.push(target);
        }
    }
    if failed.is_empty() {
        return Ok(());
    }
    bail!("failed: {}; to repeat one: `cargo xtask fuzz TARGET --input FILE`", failed.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options() {
        let read = |words: &'static [&'static str]| FuzzOptions::read(words.iter().copied());
        let options = read(&["json", "--minutes", "2.5", "--guided"]).unwrap();
        assert_eq!((options.targets, options.minutes, options.guided), (vec!["json"], Some(2.5), true));
        assert!(read(&["--minutes"]).is_err() && read(&["--minutes", "x"]).is_err() && read(&["--what"]).is_err());
    }
}
