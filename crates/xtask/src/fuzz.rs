//! `cargo xtask fuzz`: random inputs for the core.

use crate::workspace::{Workspace, output};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The options of the command.
#[derive(clap::Args)]
pub(crate) struct FuzzOptions {
    /// The targets; all if none is named
    targets: Vec<String>,
    /// The time for all targets together
    #[arg(long, default_value_t = 1.0)]
    minutes: f64,
    #[arg(long)]
    seed: Option<String>,
    /// Try a single input again
    #[arg(long)]
    input: Option<PathBuf>,
    /// Make the single input smaller first
    #[arg(long, requires = "input")]
    shrink: bool,
    /// Let libFuzzer choose inputs by the code that they reach (needs a C++ compiler)
    #[arg(long)]
    guided: bool,
}

/// Fuzzes the named targets or all, or tries a single input.
pub(crate) fn fuzz(workspace: &Workspace, mut options: FuzzOptions) -> Result<()> {
    let program = build(workspace)?;
    if let Some(input) = options.input {
        let mut command = Command::new(&program);
        command.args(&options.targets).arg("--input").arg(input).args(options.shrink.then_some("--shrink"));
        return workspace.run(&mut command);
    }
    if options.targets.is_empty() {
        options.targets = output(Command::new(&program).arg("--list"))?.lines().map(str::to_owned).collect();
    }
    let seconds = 60.0 * options.minutes / options.targets.len() as f64;
    if options.guided {
        return guided(workspace, &options.targets, seconds);
    }
    // The program tries as many targets at the same time.
    let seconds = seconds * std::thread::available_parallelism().map_or(1, |cores| cores.get().min(2)) as f64;
    let mut command = Command::new(&program);
    command.args(&options.targets).args(["--seconds", &seconds.to_string()]);
    command.args(options.seed.iter().flat_map(|seed| ["--seed", seed]));
    command.arg("--findings").arg(workspace.target.join("fuzz/findings"));
    workspace.run(&mut command)
}

/// The short run of the tests, always with the same inputs; thirty times as many where it is thorough.
pub(crate) fn short(workspace: &Workspace, program: &Path, is_thorough: bool) -> Result<()> {
    let mut command = Command::new(program);
    command.args(is_thorough.then_some(["--times", "30"]).into_iter().flatten());
    workspace.run(command.args(["--short", "--patient", "--findings"]).arg(workspace.target.join("fuzz/findings")))
}

/// Builds the program and returns its path.
fn build(workspace: &Workspace) -> Result<PathBuf> {
    workspace.run(&mut workspace.cargo(["build", "--quiet", "--profile=fuzz", "--package=lsystem-fuzz"]))?;
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
fn guided(workspace: &Workspace, targets: &[String], seconds: f64) -> Result<()> {
    let host = output(Command::new("rustc").args(["--print=host-tuple"]))?;
    let host = host.trim();
    // With `--target`, Cargo compiles build scripts without the counters, which they could not link.
    let what = ["build", "--quiet", "--profile=fuzz", "--package=lsystem-fuzz", "--bin=guided", "--features=guided"];
    let folder = workspace.target.join("fuzz/guided");
    let mut command = workspace.cargo(what);
    command.args(["--target", host, "--target-dir"]).arg(&folder);
    workspace.run(command.env("CARGO_ENCODED_RUSTFLAGS", COVERAGE.join("\u{1f}")))?;
    let program = folder.join(host).join("fuzz/guided");
    let findings = workspace.target.join("fuzz/findings");
    let mut failed = vec![];
    for target in targets {
        println!("\n=== {target}");
        let corpus = workspace.target.join("fuzz/corpus").join(target);
        fs_err::create_dir_all(&corpus)?;
        fs_err::create_dir_all(&findings)?;
        let mut command = Command::new(&program);
        command.arg(&corpus).arg(format!("-artifact_prefix={}/{target}-", findings.display()));
        command.arg(format!("-max_total_time={}", seconds.ceil()));
        command.args(["-max_len=4096", "-rss_limit_mb=3072", "-print_final_stats=1", "-verbosity=0"]);
        if workspace.run(command.env("LSYSTEM_FUZZ", target)).is_err() {
            failed.push(target.as_str());
        }
    }
    if failed.is_empty() {
        return Ok(());
    }
    bail!("failed: {}; to repeat one: `cargo xtask fuzz TARGET --input FILE`", failed.join(", "))
}
