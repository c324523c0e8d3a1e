//! The check of the sizes of the shipped wasms against the committed limits.

use crate::build::Kind;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;
use fs_err as fs;
use std::fmt;
use std::io::Write;

/// The size of a file in bytes, raw and compressed by gzip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FileSize {
    raw: usize,
    gzip: usize,
}

/// Compares the wasms in `dist/` with the committed limits and prints both.
pub(crate) fn check(workspace: &Workspace) -> Result<()> {
    let file = "crates/lsystem-wasm/size-limit.txt";
    let limits = fs::read_to_string(workspace.root.join(file))?;
    for name in limits.lines().filter_map(|line| line.split_once(".wasm:")).map(|(name, _)| format!("{name}.wasm")) {
        let size = measure(&fs::read(Kind::Shipped.folder(workspace).join(&name))?)?;
        let limit = read(&limits, &name).with_context(|| format!("in {file}"))?;
        workspace.say(format_args!("{name}: {size}; limit {limit}"));
        if size.raw > limit.raw || size.gzip > limit.gzip {
            bail!("{name} is larger than its limit: make it smaller, or raise the limit in {file} and give the reason");
        }
    }
    Ok(())
}

fn measure(bytes: &[u8]) -> Result<FileSize> {
    let mut encoder = GzEncoder::new(vec![], Compression::best());
    encoder.write_all(bytes)?;
    Ok(FileSize { raw: bytes.len(), gzip: encoder.finish()?.len() })
}

/// Reads the line `name: N raw, N gzip`; `#` starts a comment line.
fn read(text: &str, name: &str) -> Result<FileSize> {
    let line = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'));
    let number = |unit| {
        let mut parts = line?.split(',').filter_map(|part| part.trim().split_once(' '));
        parts.find(|(_, its)| *its == unit)?.0.parse().ok()
    };
    match (number("raw"), number("gzip")) {
        (Some(raw), Some(gzip)) => Ok(FileSize { raw, gzip }),
        _ => bail!("there is no line `{name}: N raw, N gzip`"),
    }
}

impl fmt::Display for FileSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes, {} with gzip", self.raw, self.gzip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_limits() {
        let text = "# why\na: 20 raw, 10 gzip\nb: 4 gzip, 5 raw\nc: 3 raw\n";
        assert_eq!(read(text, "a").unwrap(), FileSize { raw: 20, gzip: 10 });
        assert_eq!(read(text, "b").unwrap(), FileSize { raw: 5, gzip: 4 });
        for wrong in ["c", "d", ""] {
            assert!(read(text, wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn measures_both() {
        let size = measure(&[7; 10_000]).unwrap();
        assert_eq!(size.raw, 10_000);
        assert!((20..200).contains(&size.gzip), "{size}");
    }
}
