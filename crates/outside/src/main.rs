//! `cargo xtask outside`: every kind of file that `lsys` writes is opened with a program of other people, which has to
//! find the figures that `lsys` tells.
//!
//! - `outside check ROOT FOLDER LSYS` makes and checks the files. ROOT is the repository, FOLDER is for files and for
//!   Python's libraries, and LSYS is the program.
//! - `outside wheel ROOT FOLDER LSYS` does the same, compiles the Python package for a wheel, which is installed, and runs
//!   exports in the programs that they are for ([`real`]).
//! - `outside plots ROOT FOLDER LSYS` prints plots of `lsys` beside those of vpype.
//!
//! `lsys` makes files of a few systems ([`made`]). The checks ask programs for figures of these files and compare them
//! ([`plane`], [`paper`], [`space`], [`prints`], [`film`], [`data`]). The Python package is
//! tested beside them ([`python`]). Node.js and Python libraries are installed
//! ([`programs`]); a program of the system that is missing is named as not checked.

mod asked;
mod data;
mod film;
mod made;
mod paper;
mod plane;
mod plots;
mod prints;
mod programs;
mod python;
mod real;
mod space;

use anyhow::{Context, Result, bail};
use asked::Asked;
use clap::Parser;
use made::Made;
use programs::Programs;
use std::path::PathBuf;
use std::process::Command;
use std::thread;

/// What to do, and where.
#[derive(Parser)]
struct Options {
    what: What,
    /// The repository
    root: PathBuf,
    /// The folder for files and for Python's libraries
    folder: PathBuf,
    /// The program
    lsys: PathBuf,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum What {
    Check,
    /// The same, with the Python package in a wheel.
    Wheel,
    Plots,
}

impl Options {
    /// The file of a system of `data_in`.
    fn source(&self, system: &str) -> PathBuf {
        self.root.join("data_in").join(format!("{system}.json"))
    }

    /// The folder of this crate, with the scripts and the lists of libraries.
    fn scripts(&self) -> PathBuf {
        self.root.join("crates/outside")
    }
}

fn main() -> Result<()> {
    let options = Options::parse();
    match options.what {
        What::Check | What::Wheel => check(&options),
        What::Plots => plots::compare(&options),
    }
}

/// Makes the files, and checks them all. Fails at the end if a check did.
fn check(options: &Options) -> Result<()> {
    let programs = Programs::get(options)?;
    let made = Made::new(options)?;
    let mut asked = Asked::new(&programs);
    let (right, wrong) = thread::scope(|scope| -> Result<_> {
        let package = scope.spawn(|| python::check(options, programs.python()));
        plane::ask(&made, &mut asked)?;
        paper::ask(&made, &mut asked)?;
        space::ask(&made, &mut asked)?;
        if let What::Wheel = options.what {
            prints::ask(&made, &mut asked)?;
        }
        film::ask(&made, &mut asked)?;
        data::ask(&made, &mut asked)?;
        if matches!(options.what, What::Wheel) {
            real::ask(options, &mut asked)?;
        }
        asked.finish(|| package.join().unwrap_or_else(|_| bail!("the tests of the package panicked")))
    })?;
    programs.missing().iter().for_each(|line| println!("not checked: {line}"));
    println!("{right} outputs are read as `lsys` tells");
    if wrong > 0 {
        bail!("{wrong} outputs are read otherwise than `lsys` tells");
    }
    Ok(())
}

/// Runs a program to its end, and returns its standard output. The error contains all that the program wrote.
fn output(command: &mut Command) -> Result<String> {
    let output = command.output().with_context(|| format!("starting {command:?}"))?;
    if !output.status.success() {
        let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        bail!("{command:?} failed ({})\n{out}{err}", output.status);
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// Fails with a message unless two numbers differ by at most `most`.
fn near(what: &str, found: f64, told: f64, most: f64) -> Result<()> {
    // A number that is no number is not near.
    if (found - told).abs() <= most {
        return Ok(());
    }
    bail!("{what}: found {found}, told {told}")
}

/// Fails with a message unless two values are equal.
#[allow(clippy::needless_pass_by_value, reason = "callers compare values that they have just made")]
fn equal<T: PartialEq + core::fmt::Debug>(what: &str, found: T, told: T) -> Result<()> {
    if found == told {
        return Ok(());
    }
    bail!("{what}: found {found:?}, told {told:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_no_numbers_are_not_near() {
        assert!(near("a length", 1.0, 1.01, 0.02).is_ok());
        assert!(near("a length", 1.0, 1.03, 0.02).is_err());
        assert!(near("a length", f64::NAN, 1.0, 1.0).is_err());
    }
}
