//! `cargo xtask mutants`: checks that the tests detect changes of the core's code. `.cargo/mutants.toml` chooses the
//! changes and the tests.

use crate::tools;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use fs_err as fs;
use serde_json::Value;
use std::process::Command;

/// The version of cargo-mutants. Another version may have other mutants, so results would not be comparable.
const VERSION: &str = "27.1.0";
/// The default sample, one mutant in 40: less than an hour.
const SAMPLE: &str = "0/40";

/// Runs cargo-mutants with `words`, and prints the number of mutants that the tests have caught.
pub(crate) fn mutants(workspace: &Workspace, words: &[String]) -> Result<()> {
    let words = arguments(words.iter().map(String::as_str));
    let tool = tools::cargo_tool(workspace, "mutants", VERSION)?;
    let folder = workspace.target.join("mutants");
    let mut command = Command::new(tool);
    command.arg("mutants").args(&words).arg("--output").arg(&folder).current_dir(&workspace.root);
    // Few cases, the same every time: an important change shows in most of them.
    command.env("PROPTEST_RNG_SEED", "1").env("LSYSTEM_CASES", "40");
    if words.iter().any(|word| word == "--list" || word == "--help") {
        return workspace.run(&mut command);
    }
    fs::create_dir_all(&folder)?;
    let status = command.status().context("starting cargo-mutants")?;
    // 2: some mutants were missed. 3: some tests timed out.
    if !matches!(status.code(), Some(0 | 2 | 3)) {
        bail!("cargo-mutants failed ({status}); its log is in {}", folder.display());
    }
    let outcomes = fs::read(folder.join("mutants.out/outcomes.json"))?;
    println!("{}", summary(&serde_json::from_slice(&outcomes)?)?);
    Ok(())
}

/// The words for cargo-mutants: with the default sample, unless the words choose mutants or contain `--all`.
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
    // Each shard has the same mutants every time, from all files.
    words.extend(["--sharding=round-robin", "--no-shuffle", "--colors=never"].map(str::to_owned));
    // A baseline run would test only the changed crates and fail, because the named tests are in another crate.
    // Timeouts (in seconds) stop mutants that loop.
    words.extend(["--baseline=skip", "--timeout=120", "--build-timeout=900"].map(str::to_owned));
    words
}

/// The result in words.
fn summary(outcomes: &Value) -> Result<String> {
    let count = |name: &str| outcomes[name].as_u64().with_context(|| format!("cargo-mutants reports no `{name}`"));
    let (caught, timeout, missed) = (count("caught")?, count("timeout")?, count("missed")?);
    let viable = caught + timeout + missed;
    let share = (caught + timeout) as f64 * 100.0 / viable.max(1) as f64;
    Ok(format!(
        "{viable} mutants that compile: {caught} caught, {timeout} timed out, {missed} missed; {share:.1} % killed \
         ({} did not compile)",
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
