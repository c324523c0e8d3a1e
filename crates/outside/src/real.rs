//! What `lsys` exports, in the programs that it is for: `real.py`, which takes a minute and more packages.

use crate::asked::Asked;
use crate::{Options, output};
use anyhow::{Result, anyhow};
use std::process::Command;

pub(crate) fn ask(options: &Options, asked: &mut Asked<'_>) -> Result<()> {
    let mut command = Command::new(asked.programs.python());
    command
        .arg(options.scripts().join("real.py"))
        .arg(&options.lsys)
        .args([&options.root, &options.folder.join("real")]);
    for line in output(&mut command)?.lines() {
        let mut parts = line.splitn(3, '\t');
        let (Some(what), Some(by), Some(found)) = (parts.next(), parts.next(), parts.next()) else {
            return Err(anyhow!("real.py tells {line}"));
        };
        if let Some(missing) = found.strip_prefix("skipped: ") {
            println!("not checked: {what}: {missing}");
            continue;
        }
        let found = match found.strip_prefix("WRONG: ") {
            Some(wrong) => Err(anyhow!("{wrong}")),
            None => Ok(found.to_owned()),
        };
        asked.note(format!("{what}, {by}"), "the program itself", found);
    }
    Ok(())
}
