//! Packages of others in the lock files.

use super::Measured;
use crate::files;
use crate::workspace::Workspace;
use anyhow::Result;
use fs_err as fs;
use serde_json::Value;

/// The number of packages in each lock file.
pub(super) fn packages(workspace: &Workspace) -> Result<Measured> {
    let root = &workspace.root;
    let is_searched =
        |path: &std::path::Path| !["node_modules", "target", "dist", ".git"].iter().any(|name| path.ends_with(name));
    let mut rows = Measured::new();
    for file in files::list(root, is_searched)? {
        let name = file.strip_prefix(root)?.to_string_lossy().replace('\\', "/");
        let count = if file.ends_with("Cargo.lock") {
            fs::read_to_string(&file)?.lines().filter(|line| line.starts_with("source = ")).count()
        } else if file.ends_with("package-lock.json") {
            let lock: Value = serde_json::from_slice(&fs::read(&file)?)?;
            lock["packages"].as_object().map_or(0, |packages| packages.len().saturating_sub(1))
        } else {
            continue;
        };
        rows.insert(name, count as f64);
    }
    Ok(rows)
}
