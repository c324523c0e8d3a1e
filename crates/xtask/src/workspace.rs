//! The repository's folders, and the running of other programs.

use crate::child::{self, Spent, words};
use anyhow::{Context, Result, bail};
use std::fmt::Display;
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

/// The folders of this repository, and where programs write.
#[derive(Clone)]
pub(crate) struct Workspace {
    pub(crate) root: PathBuf,
    /// Cargo's target folder.
    pub(crate) target: PathBuf,
    /// The file for what programs and steps write; without one they write to the screen.
    log: Option<PathBuf>,
    /// How long a program may run before it is ended.
    pub(crate) deadline: Duration,
    /// Whether clippy looks at what Cargo compiles; as a step of its own, it compiles all libraries once more.
    pub(crate) lints: bool,
    /// The processor time of the programs that have run.
    pub(crate) spent: Spent,
}

/// How the wasm is compiled.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// As it is published: smallest and fastest.
    Shipped,
    /// In a fifth of the time, for work on the page: larger and slower.
    Draft,
}

impl Kind {
    /// The folder of the built site.
    pub(crate) fn folder(self, workspace: &Workspace) -> PathBuf {
        match self {
            Self::Shipped => workspace.root.join("dist"),
            Self::Draft => workspace.target.join("site"),
        }
    }
}

impl Workspace {
    /// Finds the folders. Cargo knows the target folder, which can be configured in many ways.
    pub(crate) fn find() -> Result<Self> {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let root = root.ancestors().nth(2).context("xtask is not in crates/")?.to_owned();
        let (deadline, spent) = (Duration::MAX, Spent::default());
        let mut workspace = Self { target: PathBuf::new(), root, log: None, deadline, lints: false, spent };
        let target = workspace.metadata()?["target_directory"].as_str().context("cargo names no target folder")?.into();
        workspace.target = target;
        Ok(workspace)
    }

    /// What `cargo metadata` says about the crates of this repository.
    pub(crate) fn metadata(&self) -> Result<serde_json::Value> {
        let text = output(&mut self.cargo(["metadata", "--no-deps", "--format-version=1"]))?;
        Ok(serde_json::from_str(&text)?)
    }

    /// The same folders for a step: programs write to a new file, are ended after a deadline, and their processor time is
    /// summed anew.
    pub(crate) fn for_step(&self, file: PathBuf, deadline: Duration) -> Result<Self> {
        crate::files::write(&file, "")?;
        Ok(Self { log: Some(file), deadline, spent: Spent::default(), ..self.clone() })
    }

    pub(crate) fn www(&self) -> PathBuf {
        self.root.join("www")
    }

    /// The command `cargo` with these words, in the root folder.
    pub(crate) fn cargo<'a>(&self, words: impl IntoIterator<Item = &'a str>) -> Command {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        command.args(words).current_dir(&self.root);
        if self.lints {
            // As `cargo clippy -- -D warnings` does it, but with code for the tests to run.
            let driver = PathBuf::from(command.get_program()).with_file_name("clippy-driver");
            command.env("RUSTC_WORKSPACE_WRAPPER", driver).env("CLIPPY_ARGS", "-Dwarnings__CLIPPY_HACKERY__");
        }
        command
    }

    /// Runs a program to its end.
    pub(crate) fn run(&self, command: &mut Command) -> Result<()> {
        if let Some(mut log) = self.open()? {
            writeln!(log, "$ {}", words(command))?;
            command.stdout(log.try_clone()?).stderr(log);
        }
        let status = child::status(command, self.deadline, &self.spent)?;
        if !status.success() {
            bail!("`{}` failed ({status})", words(command));
        }
        Ok(())
    }

    /// Runs a program to its end, and returns its standard output. What it writes else is in the error.
    pub(crate) fn output(&self, command: &mut Command) -> Result<String> {
        child::output(command, self.deadline, &self.spent)
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
    child::output(command, Duration::MAX, &Spent::default())
}
