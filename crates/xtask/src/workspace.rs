//! The repository's folders, and the running of other programs.

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::fmt::Display;
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::Command;

/// The folders of this repository, and where programs write.
#[derive(Clone)]
pub(crate) struct Workspace {
    pub(crate) root: PathBuf,
    /// Cargo's target folder.
    pub(crate) target: PathBuf,
    /// The file for what programs and steps write; without one they write to the screen.
    log: Option<PathBuf>,
}

impl Workspace {
    /// Finds the folders. Cargo knows the target folder, which can be configured in many ways.
    pub(crate) fn find() -> Result<Self> {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let root = root.ancestors().nth(2).context("xtask is not in crates/")?.to_owned();
        let mut workspace = Self { target: PathBuf::new(), root, log: None };
        let target = workspace.metadata()?["target_directory"].as_str().context("cargo names no target folder")?.into();
        workspace.target = target;
        Ok(workspace)
    }

    /// What `cargo metadata` says about the crates of this repository.
    pub(crate) fn metadata(&self) -> Result<serde_json::Value> {
        let text = output(&mut self.cargo(["metadata", "--no-deps", "--format-version=1"]))?;
        Ok(serde_json::from_str(&text)?)
    }

    /// The same folders; programs write to a new file.
    pub(crate) fn logging_to(&self, file: PathBuf) -> Result<Self> {
        crate::files::write(&file, "")?;
        Ok(Self { log: Some(file), ..self.clone() })
    }

    pub(crate) fn www(&self) -> PathBuf {
        self.root.join("www")
    }

    /// The command `cargo` with these words, in the root folder.
    pub(crate) fn cargo<'a>(&self, words: impl IntoIterator<Item = &'a str>) -> Command {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        command.args(words).current_dir(&self.root);
        command
    }

    /// Runs a program to its end.
    pub(crate) fn run(&self, command: &mut Command) -> Result<()> {
        if let Some(mut log) = self.open()? {
            writeln!(log, "$ {}", words(command))?;
            command.stdout(log.try_clone()?).stderr(log);
        }
        let status = command.status().with_context(|| format!("starting `{}`", words(command)))?;
        if !status.success() {
            bail!("`{}` failed ({status})", words(command));
        }
        Ok(())
    }

    /// Runs a program to its end, and returns its standard output. Its errors go where programs write.
    pub(crate) fn output(&self, command: &mut Command) -> Result<String> {
        if let Some(log) = self.open()? {
            command.stderr(log);
        } else {
            command.stderr(std::process::Stdio::inherit());
        }
        let output = command.output().with_context(|| format!("starting `{}`", words(command)))?;
        if !output.status.success() {
            bail!("`{}` failed ({})", words(command), output.status);
        }
        Ok(String::from_utf8(output.stdout)?)
    }

    /// Writes a line where programs write.
    pub(crate) fn say(&self, line: impl Display) {
        match self.open() {
            Ok(Some(mut log)) => _ = writeln!(log, "{line}"),
            _ => println!("{line}"),
        }
    }

    fn open(&self) -> Result<Option<File>> {
        let open = |file: &PathBuf| {
            let opened = OpenOptions::new().append(true).create(true).open(file);
            opened.with_context(|| format!("writing {}", file.display()))
        };
        self.log.as_ref().map(open).transpose()
    }
}

/// Runs a program to its end and returns its standard output. The error contains all that the program wrote.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    let output = command.output().with_context(|| format!("starting `{}`", words(command)))?;
    if !output.status.success() {
        let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        bail!("`{}` failed ({})\n{out}{err}", words(command), output.status);
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// The command line for messages, without the program's folder and without quotes.
fn words(command: &Command) -> String {
    let program = PathBuf::from(command.get_program());
    let name = program.file_name().unwrap_or(OsStr::new("?"));
    let words: Vec<_> = [name].into_iter().chain(command.get_args()).map(OsStr::to_string_lossy).collect();
    words.join(" ")
}
