//! `cargo xtask monkey`: random actions on the page and on embedded drawings, in a real browser.

use crate::workspace::Workspace;
use crate::{build, page};
use anyhow::{Result, bail};

/// The options of the script: `--seed`, `--minutes`, `--actions`, `--verbose`.
pub(crate) struct MonkeyOptions(Vec<String>);

impl MonkeyOptions {
    pub(crate) fn read<'a>(words: impl Iterator<Item = &'a str>) -> Result<Self> {
        let mut options = vec![];
        let mut words = words.peekable();
        while let Some(word) = words.next() {
            options.push(word.to_owned());
            match (word, words.peek()) {
                ("--verbose", _) => {}
                ("--seed" | "--actions", Some(value)) if value.parse::<u32>().is_ok() => {}
                ("--minutes", Some(value)) if value.parse::<f64>().is_ok_and(|minutes| minutes > 0.0) => {}
                _ => bail!("usage: cargo xtask monkey [--minutes M] [--seed S [--actions N]] [--verbose]"),
            }
            if word != "--verbose" {
                options.extend(words.next().map(str::to_owned));
            }
        }
        Ok(Self(options))
    }

    /// The short run of the thorough tests, always with the same seed.
    pub(crate) fn one_minute() -> Self {
        Self(["--minutes", "1", "--seed", "1"].map(str::to_owned).to_vec())
    }
}

/// Builds the page and runs the monkey on it.
pub(crate) fn monkey(workspace: &Workspace, options: &MonkeyOptions) -> Result<()> {
    build::build(workspace)?;
    run(workspace, options)
}

/// Runs the monkey on the built page.
pub(crate) fn run(workspace: &Workspace, options: &MonkeyOptions) -> Result<()> {
    page::script(workspace, "test/monkey/monkey.mjs", &options.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &str) -> Result<Vec<String>> {
        MonkeyOptions::read(words.split_whitespace()).map(|options| options.0)
    }

    #[test]
    fn passes_on_what_the_script_knows() {
        assert!(read("").unwrap().is_empty());
        assert_eq!(read("--minutes 0.5 --verbose --seed 7").unwrap(), ["--minutes", "0.5", "--verbose", "--seed", "7"]);
        assert_eq!(read("--seed 7 --actions 12").unwrap(), ["--seed", "7", "--actions", "12"]);
        for wrong in ["--minutes", "--minutes none", "--minutes -1", "--seed 1.5", "--seed", "7", "--fast"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
