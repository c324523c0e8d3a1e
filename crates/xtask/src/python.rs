//! `cargo xtask python`: the files that the Python package carries beside its own.

use crate::workspace::{Kind, Workspace};
use crate::{build, files, notices};
use anyhow::Result;
use fs_err as fs;

/// The page of the widget.
const PAGE: &str = "embed.html";
/// The platform whose libraries the notices name. Those of other platforms are the same.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// Builds the page, and makes the package ready for `maturin build`.
pub(crate) fn python(workspace: &Workspace) -> Result<()> {
    build::build(workspace, Kind::Shipped, None)?;
    prepare(workspace)?;
    println!("ready for `maturin build`: {}", workspace.root.join("crates/lsystem-python").display());
    Ok(())
}

/// Copies the licences and, if it is built, the page. Without a page, the widget needs an address.
pub(crate) fn prepare(workspace: &Workspace) -> Result<()> {
    let package = workspace.root.join("crates/lsystem-python");
    for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
        files::write(&package.join(licence), fs::read(workspace.root.join(licence))?)?;
    }
    let carried = notices::notices(workspace, &["lsystem-python", "lsystem-wasm"], TARGET, false)?;
    files::write(&package.join("NOTICES.txt"), carried)?;
    let page = Kind::Shipped.folder(workspace).join(PAGE);
    if page.is_file() {
        files::write(&package.join("python/lsystem_playground").join(PAGE), fs::read(page)?)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_package_carries_the_notices_of_what_it_is_compiled_from() -> Result<()> {
        let workspace = Workspace::find()?;
        prepare(&workspace)?;
        let carried = fs::read_to_string(workspace.root.join("crates/lsystem-python/NOTICES.txt"))?;
        assert!(["pyo3 ", "wasm-bindgen ", "libm "].iter().all(|name| carried.contains(name)), "{carried}");
        Ok(())
    }
}
