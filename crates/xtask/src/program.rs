//! `cargo xtask program`: the command-line program, with pages inside.

use crate::workspace::{Kind, Workspace};
use crate::{build, files};
use anyhow::Result;
use flate2::{Compression, GzBuilder};
use fs_err as fs;
use std::io::Write as _;
use std::path::Path;

/// The pages in single files that the program carries. `crates/lsys/build.rs` has the same names with `.gz`.
const PAGES: [&str; 3] = ["playground.html", "exercise.html", "package.html"];

/// Builds the page, then the program.
pub(crate) fn program(workspace: &Workspace) -> Result<()> {
    build::build(workspace, Kind::Shipped, None)?;
    let (site, pages) = (Kind::Shipped.folder(workspace), workspace.root.join("crates/lsys/pages"));
    for name in PAGES {
        let (size, packed) = pack(&site.join(name), &pages.join(format!("{name}.gz")))?;
        println!("{name}: {size} bytes, {packed} in the program");
    }
    workspace.run(&mut workspace.cargo(["build", "--release", "--package=lsystem-cli"]))?;
    let program = workspace.target.join("release/lsys").with_extension(std::env::consts::EXE_EXTENSION);
    println!("{}: {} bytes", program.display(), fs::metadata(&program)?.len());
    Ok(())
}

/// Compresses a page. Returns the sizes before and after. An equal file is not written again, so that Cargo has nothing
/// to do.
fn pack(page: &Path, packed: &Path) -> Result<(usize, usize)> {
    let html = fs::read(page)?;
    // Without a time, so that equal pages are equal files.
    let mut encoder = GzBuilder::new().write(vec![], Compression::best());
    encoder.write_all(&html)?;
    let bytes = encoder.finish()?;
    if !fs::read(packed).is_ok_and(|former| former == bytes) {
        files::write(packed, &bytes)?;
    }
    Ok((html.len(), bytes.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::GzDecoder;
    use std::io::Read as _;

    #[test]
    fn equal_pages_are_packed_once() -> Result<()> {
        let folder = tempfile::tempdir()?;
        let [page, packed] = ["a.html", "below/a.html.gz"].map(|name| folder.path().join(name));
        files::write(&page, "<p>".repeat(1000))?;
        let sizes = pack(&page, &packed)?;
        assert_eq!(sizes, (3000, fs::read(&packed)?.len()));
        let mut text = String::new();
        GzDecoder::new(&*fs::read(&packed)?).read_to_string(&mut text)?;
        assert_eq!(text, "<p>".repeat(1000));
        // A read-only file would refuse to be written again.
        let mut permissions = fs::metadata(&packed)?.permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&packed, permissions)?;
        let before = fs::metadata(&packed)?.modified()?;
        assert_eq!(pack(&page, &packed)?, sizes);
        assert_eq!(fs::metadata(&packed)?.modified()?, before);
        Ok(())
    }

    #[test]
    fn the_program_knows_the_same_pages() -> Result<()> {
        let script = fs::read_to_string(Workspace::find()?.root.join("crates/lsys/build.rs"))?;
        let names = PAGES.map(|name| format!("\"{name}.gz\"")).join(", ");
        assert!(script.contains(&format!("[{names}]")), "{script}");
        Ok(())
    }
}
