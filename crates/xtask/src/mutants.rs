//! `cargo xtask mutants`: whether the tests notice when the core's code is changed. What is changed and which tests run
//! stands in `.cargo/mutants.toml`.

use crate::files;
use crate::workspace::{Workspace, output, run};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

/// The release of cargo-mutants whose list of mutants the figures are about.
const VERSION: &str = "27.1.0";
/// One mutant in so many is tried without further words: less than an hour's work.
const SAMPLE: &str = "0/40";

/// Runs cargo-mutants with `words`, and says how many mutants the tests have caught.
pub(crate) fn mutants<'a>(workspace: &Workspace, words: impl Iterator<Item = &'a str>) -> Result<()> {
    let words = arguments(words);
    let tool = tool(workspace)?;
    let folder = workspace.target.join("mutants");
    let mut command = Command::new(tool);
    command.arg("mutants").args(&words).arg("--output").arg(&folder).current_dir(&workspace.root);
    // The same cases every time, and few: a change that matters shows in most of them.
    command.env("PROPTEST_RNG_SEED", "1").env("LSYSTEM_CASES", "40");
    if words.iter().any(|word| word == "--list" || word == "--help") {
        return run(&mut command);
    }
    std::fs::create_dir_all(&folder)?;
    let status = command.status().context("starting cargo-mutants")?;
    // 2: some were missed. 3: some had to be ended.
    if !matches!(status.code(), Some(0 | 2 | 3)) {
        bail!("cargo-mutants failed ({status}); its log is in {}", folder.display());
    }
    let outcomes = files::read(&folder.join("mutants.out/outcomes.json"))?;
    println!("{}", summary(&serde_json::from_slice(&outcomes)?)?);
    Ok(())
}

/// The words for cargo-mutants: the usual sample unless another one, some files or `--all` is asked for.
fn arguments<'a>(words: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut words: Vec<String> = words.map(str::to_owned).collect();
    let chooses = |word: &String| {
        let names =
            ["--shard", "--file", "-f", "--re", "-F", "--in-diff", "-D", "--list", "--all", "--iterate", "--help"];
        names.iter().any(|name| word == name || word.starts_with(&format!("{name}=")))
    };
    if !words.iter().any(chooses) {
        words.extend(["--shard".to_owned(), SAMPLE.to_owned()]);
    }
    words.retain(|word| word != "--all");
    // Each shard has mutants of all files, the same every time.
    words.extend(["--sharding=round-robin", "--no-shuffle", "--colors=never"].map(str::to_owned));
    // A baseline run would test the changed crates alone, and fail: the named tests are in another crate. Timeouts are in
    // seconds, and end mutants that loop.
    words.extend(["--baseline=skip", "--timeout=120", "--build-timeout=900"].map(str::to_owned));
    words
}

/// The tool at its version: as it is installed, or else installed into Cargo's target folder.
fn tool(workspace: &Workspace) -> Result<OsString> {
    let own = workspace.target.join("tools");
    let local = own.join("bin").join(format!("cargo-mutants{}", std::env::consts::EXE_SUFFIX));
    for program in [local.as_os_str(), "cargo-mutants".as_ref()] {
        if is_right(program) {
            return Ok(program.to_owned());
        }
    }
    println!("installing cargo-mutants {VERSION} into {}, once", own.display());
    let install = ["install", "cargo-mutants", "--locked", "--version", VERSION, "--root"];
    run(workspace.cargo(install).arg(&own)).with_context(|| {
        format!("cargo-mutants {VERSION} is missing: `cargo install cargo-mutants --locked --version {VERSION}`")
    })?;
    Ok(local.into_os_string())
}

fn is_right(program: impl AsRef<Path>) -> bool {
    let version = output(Command::new(program.as_ref().as_os_str()).args(["mutants", "--version"]));
    version.is_ok_and(|version| version.split_whitespace().last() == Some(VERSION))
}

/// The figure in words.
fn summary(outcomes: &Value) -> Result<String> {
    let count = |name: &str| outcomes[name].as_u64().with_context(|| format!("cargo-mutants tells no `{name}`"));
    let (caught, timeout, missed) = (count("caught")?, count("timeout")?, count("missed")?);
    let viable = caught + timeout + missed;
    let share = (caught + timeout) as f64 * 100.0 / viable.max(1) as f64;
    Ok(format!(
        "{viable} mutants that compile: {caught} caught, {timeout} ended after their time, {missed} missed; {share:.1} % \
         killed ({} did not compile)",
        count("unviable")?
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_sample_is_tried_unless_something_is_chosen() {
        let of = |line: &str| arguments(line.split_whitespace()).join(" ");
        let fixed =
            "--sharding=round-robin --no-shuffle --colors=never --baseline=skip --timeout=120 --build-timeout=900";
        assert_eq!(of(""), format!("--shard {SAMPLE} {fixed}"));
        assert_eq!(of("--jobs 2"), format!("--jobs 2 --shard {SAMPLE} {fixed}"));
        assert_eq!(of("--shard 3/9"), format!("--shard 3/9 {fixed}"));
        assert_eq!(of("--file=a.rs"), format!("--file=a.rs {fixed}"));
        assert_eq!(of("--all"), fixed);
    }

    #[test]
    fn the_share_counts_what_compiles() {
        let outcomes = json!({"caught": 6, "timeout": 1, "missed": 3, "unviable": 5});
        let words = summary(&outcomes).unwrap();
        assert!(
            words.starts_with("10 mutants that compile: 6 caught") && words.contains("70.0 % killed (5 "),
            "{words}"
        );
        assert!(summary(&json!({})).is_err());
    }
}
