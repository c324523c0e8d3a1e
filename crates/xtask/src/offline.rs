//! The list of files that the page keeps for offline use. The list becomes the head of the service worker.

use crate::files::{self, hex};
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::path::Path;

const WORKER: &str = "service-worker.js";
/// Files that are useless offline or that repeat the others.
const LEFT_OUT: [&str; 2] = [WORKER, "playground.html"];

/// Completes the service worker in the folder of the site. All other files must be in place.
pub(crate) fn list_files(site: &Path) -> Result<()> {
    let mut hashes = Map::new();
    for file in files::list(site, |_| true)? {
        let path = file.strip_prefix(site)?.to_str().context("a name that is not UTF-8")?.replace('\\', "/");
        if LEFT_OUT.contains(&&*path) {
            continue;
        }
        let hash = files::fingerprint(&file)?;
        // Some hosts serve the first page only at the folder's address.
        hashes.insert(if path == "index.html" { String::new() } else { path }, hash.into());
    }
    let list = Value::Object(hashes).to_string();
    let worker = site.join(WORKER);
    let text = fs::read_to_string(&worker)?;
    // A change of the worker itself makes a new version, too.
    let build = &hex(&Sha256::digest(format!("{list}{text}")))[..16];
    files::write(&worker, format!("const BUILD = \"{build}\";\nconst FILES = {list};\n{text}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_all_files_by_their_hashes() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        for (name, text) in [("index.html", ""), ("page.js", "abc"), ("playground.html", "x"), (WORKER, "work()")] {
            files::write(&site.join(name), text).unwrap();
        }
        list_files(site).unwrap();
        let worker = fs::read_to_string(site.join(WORKER)).unwrap();
        // The first two are published examples of SHA-256.
        let list = "const FILES = {\"\":\"e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855\",\
                    \"page.js\":\"ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad\"};\nwork()";
        assert!(worker.starts_with("const BUILD = \"") && worker.ends_with(list), "{worker}");
        files::write(&site.join(WORKER), "work()").unwrap();
        files::write(&site.join("page.js"), "abd").unwrap();
        list_files(site).unwrap();
        assert_ne!(fs::read_to_string(site.join(WORKER)).unwrap()[..40], worker[..40]);
    }
}
