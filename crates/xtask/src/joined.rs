//! The served page with its styles in one file and its modules in another: a tenth of the requests for separate files.

use crate::build::joined;
use crate::esbuild::Bundler;
use crate::files;
use crate::one_file::Tag;
use anyhow::{Context, Result};
use std::path::Path;
use std::thread;

/// The modules that the page imports when they are first needed: their names on the site, which are those in the import
/// (after `./`), and their files. One of these modules may import another.
const APART: [(&str, &str); 5] = [
    ("dialogs.js", "js/course/dialogs.js"),
    ("finding.js", "js/find/finding.js"),
    ("save-dialog.js", "js/save/save-dialog.js"),
    ("films.js", "js/film/films.js"),
    ("video.js", "js/film/video.js"),
];
/// The licence of the library in `video.js`, in `www`, and its name on the site.
const LICENCE: [&str; 2] = ["node_modules/mediabunny/LICENSE", "video.LICENSE.txt"];

/// Copies the licence of the library that the site carries.
pub(crate) fn write_licence(www: &Path, site: &Path) -> Result<()> {
    let [from, to] = LICENCE;
    files::write(&site.join(to), files::read(&www.join(from))?)
}

/// Writes `page.js` and `page.css` into the folder of the site, and makes the page load them.
pub(crate) fn join(site: &Path, page: &str, bundler: &(dyn Bundler + Sync)) -> Result<()> {
    let file = site.join(page);
    let before = files::read_text(&file)?;
    let mut text = String::new();
    let mut styles = vec![];
    let mut entry = None;
    for line in before.lines() {
        let tag = Tag(line);
        match (tag.name(), tag.attribute("rel"), tag.attribute("href").or(tag.attribute("src"))) {
            ("link", Some("stylesheet"), Some(name)) => styles.push(name),
            ("script", _, Some(name)) if tag.attribute("type") == Some("module") => entry = Some(name),
            _ => {
                if line == "</head>" {
                    text.push_str("<link rel=\"stylesheet\" href=\"page.css\">\n<script type=\"module\" src=\"page.js\"></script>\n");
                }
                text.push_str(line.trim_start());
                text.push('\n');
            }
        }
    }
    let entry = entry.with_context(|| format!("{page} has no module"))?;
    let bundle = |name, file| files::write(&site.join(name), bundler.module(file, &APART.map(|(name, _)| name))?);
    thread::scope(|scope| {
        let threads = APART.map(|(name, file)| scope.spawn(move || bundle(name, file)));
        bundle("page.js", entry)?;
        threads.into_iter().try_for_each(joined)
    })?;
    files::write(&site.join("page.css"), bundler.styles(&styles)?)?;
    files::write(&file, text)
}

#[cfg(test)]
mod tests {
    use super::*;

    struct NameBundler;

    impl Bundler for NameBundler {
        fn module(&self, entry: &str, apart: &[&str]) -> Result<String> {
            Ok(format!("module {entry} without {}", apart.len()))
        }

        fn styles(&self, names: &[&str]) -> Result<String> {
            Ok(names.join(" "))
        }
    }

    #[test]
    fn joins_what_the_page_asks_for() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        let page = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<link rel=\"stylesheet\" href=\"a.css\">\n<link rel=\"stylesheet\" href=\"b.css\">\n\
                    <script src=\"early.js\"></script>\n<script type=\"module\" src=\"a.js\"></script>\n</head>\n<p>\n";
        files::write(&site.join("index.html"), page).unwrap();
        join(site, "index.html", &NameBundler).unwrap();
        let expected = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<script src=\"early.js\"></script>\n\
                        <link rel=\"stylesheet\" href=\"page.css\">\n<script type=\"module\" src=\"page.js\"></script>\n</head>\n<p>\n";
        assert_eq!(files::read_text(&site.join("index.html")).unwrap(), expected);
        assert_eq!(files::read_text(&site.join("page.css")).unwrap(), "a.css b.css");
        assert_eq!(files::read_text(&site.join("page.js")).unwrap(), "module a.js without 5");
        files::write(&site.join("index.html"), "</head>\n").unwrap();
        assert!(join(site, "index.html", &NameBundler).is_err());
    }
}
