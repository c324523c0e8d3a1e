//! The size of the shipped wasm, and the limit that somebody has agreed to.

use crate::files;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::fmt;
use std::io::Write;

/// Bytes, as they are and as hosts send them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Size {
    raw: usize,
    gzip: usize,
}

/// Compares `dist/lsystem.wasm` with the committed limit and says how they stand.
pub(crate) fn check(workspace: &Workspace) -> Result<()> {
    let size = measure(&files::read(&workspace.dist().join("lsystem.wasm"))?)?;
    let file = "crates/lsystem-wasm/size-limit.txt";
    let limit = read(&files::read_text(&workspace.root.join(file))?).with_context(|| format!("in {file}"))?;
    println!("lsystem.wasm: {size}; limit {limit}");
    if size.raw > limit.raw || size.gzip > limit.gzip {
        bail!("lsystem.wasm has outgrown its limit: make it smaller, or raise the limit in {file} and say why");
    }
    Ok(())
}

fn measure(bytes: &[u8]) -> Result<Size> {
    let mut encoder = GzEncoder::new(vec![], Compression::best());
    encoder.write_all(bytes)?;
    Ok(Size { raw: bytes.len(), gzip: encoder.finish()?.len() })
}

/// Reads lines of `raw N` and `gzip N`; `#` starts a comment line.
fn read(text: &str) -> Result<Size> {
    let number = |name| {
        let mut lines = text.lines().filter_map(|line| line.split_once(' '));
        let value = lines.find(|(first, _)| *first == name).and_then(|(_, value)| value.trim().parse().ok());
        value.with_context(|| format!("there is no line `{name} N`"))
    };
    Ok(Size { raw: number("raw")?, gzip: number("gzip")? })
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes, {} with gzip", self.raw, self.gzip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_limits() {
        assert_eq!(read("# why\nraw 20\ngzip 10\n").unwrap(), Size { raw: 20, gzip: 10 });
        assert!(read("raw 20\n").is_err());
        assert!(read("raw 20\ngzip ten\n").is_err());
    }

    #[test]
    fn measures_both() {
        let size = measure(&[7; 10_000]).unwrap();
        assert_eq!(size.raw, 10_000);
        assert!((20..200).contains(&size.gzip), "{size}");
    }
}
