//! The program as tests start it: in English, without input.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The repository's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The command `lsys` in a folder.
pub fn command(folder: impl AsRef<Path>, words: impl IntoIterator<Item: AsRef<OsStr>>) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lsys"));
    command.env("LC_ALL", "C").args(words).current_dir(folder).stdin(Stdio::null());
    command
}

/// Runs `lsys` in a folder with the words of a line.
pub fn output(folder: &Path, line: &str) -> Output {
    command(folder, line.split(' ')).output().expect("lsys starts")
}

/// Runs a command. Returns the exit code, standard output and standard error.
pub fn outputs(command: &mut Command) -> (Option<i32>, String, String) {
    let Output { status, stdout, stderr } = command.output().expect("lsys starts");
    let [out, error] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).expect("UTF-8"));
    (status.code(), out, error)
}

/// Runs a command. Returns the exit code and all that is printed.
pub fn printed(command: &mut Command) -> (Option<i32>, String) {
    let (code, out, error) = outputs(command);
    (code, out + &error)
}
