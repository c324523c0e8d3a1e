//! `cargo xtask outside`: every kind of file that `lsys` writes is opened with a program of other people, which has to
//! find the figures that `lsys` tells.
//!
//! `lsys` makes files of a few systems ([`made`]). The checks ask programs for figures of these files and compare them
//! ([`plane`], [`paper`], [`space`], [`film`], [`data`]). Node.js and Python libraries are installed
//! ([`programs`]); a program of the system that is missing is named as not checked.

mod asked;
mod bench;
mod data;
mod film;
mod made;
mod paper;
mod plane;
mod programs;
mod space;

use crate::workspace::Workspace;
use anyhow::{Result, bail};
use asked::Asked;
pub(crate) use bench::bench;
use made::Made;
use programs::Programs;
use std::path::Path;

/// Makes the files by the program `lsys`, and checks them all. Fails at the end if a check did.
pub(crate) fn check(workspace: &Workspace, lsys: &Path) -> Result<()> {
    let programs = Programs::get(workspace)?;
    let made = Made::new(workspace, lsys)?;
    let mut asked = Asked::new(&programs);
    plane::ask(&made, &mut asked)?;
    paper::ask(&made, &mut asked)?;
    space::ask(&made, &mut asked)?;
    film::ask(&made, &mut asked)?;
    data::ask(&made, &mut asked)?;
    let (right, wrong) = asked.finish(workspace)?;
    programs.missing().iter().for_each(|line| workspace.say(format_args!("not checked: {line}")));
    workspace.say(format_args!("{right} outputs are read as `lsys` tells"));
    if wrong > 0 {
        bail!("{wrong} outputs are read otherwise than `lsys` tells");
    }
    Ok(())
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
