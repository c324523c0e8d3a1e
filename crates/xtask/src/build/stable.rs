//! Addresses for pages elsewhere that stay when the files of the site change: `v1/l-system.js` and `v1/embed.html`, with
//! `v1/exercise.html` and `v1/film.html`, into which the element turns.
//!
//! Version 1 is what docs/embedding.md describes. A change that breaks it gets a folder `v2/`, and `v1/` stays.

use crate::{files, one_file};
use anyhow::Result;
use fs_err as fs;
use std::path::Path;

/// The folder.
const FOLDER: &str = "v1";
/// The pages, which lead to those of the site.
const PAGES: [&str; 3] = ["embed.html", "exercise.html", "film.html"];
const SCRIPT: &str = "l-system.js";

/// Writes the folder. The script is a copy, since it looks for the pages in its own folder.
pub(super) fn write(site: &Path) -> Result<()> {
    let folder = site.join(FOLDER);
    files::write(&folder.join(SCRIPT), fs::read(site.join(SCRIPT))?)?;
    PAGES.iter().try_for_each(|name| files::write(&folder.join(name), page(name)))
}

/// A page that leads to the page of the same name one folder up, with the drawing in the hash.
fn page(name: &str) -> String {
    let script = format!("location.replace('../{name}' + location.search + location.hash);");
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {}; base-uri 'none'\">\n\
         <meta name=\"robots\" content=\"noindex\">\n<title>L-system</title>\n<script>{script}</script>\n\
         <noscript>This drawing needs JavaScript and WebAssembly, which are switched off here.</noscript>\n</html>\n",
        one_file::hash(&script)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_of_version_1_stay() {
        let site = tempfile::tempdir().unwrap();
        files::write(&site.path().join("l-system.js"), "element()").unwrap();
        write(site.path()).unwrap();
        // Pages elsewhere name these files: names are only added.
        for name in ["l-system.js", "embed.html", "exercise.html", "film.html"] {
            assert!(site.path().join("v1").join(name).is_file(), "{name}");
        }
        let page = fs::read_to_string(site.path().join("v1/embed.html")).unwrap();
        let script = page.split_once("<script>").unwrap().1.split_once("</script>").unwrap().0;
        assert!(script.contains("'../embed.html' + location.search + location.hash"), "{script}");
        assert!(page.contains(&one_file::hash(script)), "{page}");
    }
}
