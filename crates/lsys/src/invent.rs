//! `lsys surprise` and `lsys breed`: new systems as JSON.

use crate::cli::Changes;
use crate::import::write;
use crate::{CommandFailure, input, print, say};
use lsystem::base::counted;
use lsystem::invent::{breed, surprise};
use lsystem::write_json;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// A seed that is hardly ever the same.
fn any_seed() -> u32 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.subsec_nanos() ^ time.as_secs() as u32)
}

/// Prints a new system. Its name has the seed.
///
/// # Errors
/// [`CommandFailure`] if nobody reads it.
pub(crate) fn print_surprise(seed: Option<u32>) -> Result<(), CommandFailure> {
    let (made, _) = surprise(seed.unwrap_or_else(any_seed));
    print(|out| out.write_all(write_json(&made).as_bytes()))
}

/// Writes children of the systems in `files` into the folder `to`.
///
/// # Errors
/// [`CommandFailure::Said`] if a file has errors; [`CommandFailure::Words`] if nothing can be bred or written.
pub(crate) fn breed_into(files: &[PathBuf], seed: Option<u32>, count: u32, to: &Path) -> Result<(), CommandFailure> {
    std::fs::create_dir_all(to).map_err(|error| CommandFailure::io(to.display(), &error))?;
    let parents = files.iter().map(|file| Ok(input::read(file, &Changes::default(), &mut say)?.definition));
    let parents = parents.collect::<Result<Vec<_>, CommandFailure>>()?;
    let seed = seed.unwrap_or_else(any_seed);
    let children = breed(&parents, seed, count as usize);
    if children.is_empty() {
        return Err(CommandFailure::Words(say!("no child of these systems has anything to show")));
    }
    for (number, child) in (1..).zip(&children) {
        let mut child = child.clone();
        child.name = format!("{}-{seed}-{number}", child.name);
        write(&child, &to.join(format!("child-{number}.json"))).map_err(CommandFailure::Words)?;
    }
    print(|out| {
        let told =
            counted!(children.len(), "{} child in {}, seed {}", "{} children in {}, seed {}", to.display(), seed);
        writeln!(out, "{told}")
    })
}
