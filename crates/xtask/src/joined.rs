//! The served page with its styles in one file and its modules in another: a tenth of the requests for separate files.

use crate::esbuild::Bundler;
use crate::files;
use crate::one_file::Tag;
use anyhow::{Context, Result};
use std::path::Path;

/// The licence of the library in `video.js`, in `www`, and its name on the site.
const LICENCE: [&str; 2] = ["node_modules/mediabunny/LICENSE", "video.LICENSE.txt"];

/// Copies the licence of the library that the site carries.
pub(crate) fn write_licence(www: &Path, site: &Path) -> Result<()> {
    let [from, to] = LICENCE;
    files::write(&site.join(to), files::read(&www.join(from))?)
}

/// Writes `page.js`, the scripts that it imports and `page.css` into the folder of the site, and makes the page load
/// them. Returns the names of the scripts that the page runs from the start.
pub(crate) fn join(site: &Path, page: &str, bundler: &(dyn Bundler + Sync)) -> Result<Vec<String>> {
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
                    text.push_str(HEAD);
                }
                text.push_str(line.trim_start());
                text.push('\n');
            }
        }
    }
    let scripts = bundler.split(entry.with_context(|| format!("{page} has no module"))?)?;
    scripts.iter().try_for_each(|(name, text)| files::write(&site.join(name), text))?;
    let first = scripts.iter().find(|(name, _)| name == SCRIPT).context("no script is the page's")?;
    let imported = imports(&first.1);
    let preloads: String =
        imported.iter().map(|name| format!("<link rel=\"modulepreload\" href=\"{name}\">\n")).collect();
    files::write(&site.join("page.css"), bundler.styles(&styles)?)?;
    files::write(&file, text.replace(HEAD, &format!("{preloads}{HEAD}")))?;
    Ok([vec![SCRIPT.to_owned()], imported].concat())
}

/// The page's script.
const SCRIPT: &str = "page.js";
/// The page's styles and script.
const HEAD: &str = "<link rel=\"stylesheet\" href=\"page.css\">\n<script type=\"module\" src=\"page.js\"></script>\n";

/// The scripts that a minified script imports from the start.
fn imports(script: &str) -> Vec<String> {
    let names = ["from\"./", "import\"./"].into_iter().flat_map(|begin| script.split(begin).skip(1));
    names.filter_map(|rest| rest.split_once('"')).map(|(name, _)| name.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct NameBundler;

    impl Bundler for NameBundler {
        fn module(&self, _: &str) -> Result<String> {
            unreachable!("the page is split")
        }

        fn split(&self, entry: &str) -> Result<Vec<(String, String)>> {
            let page = format!("import{{a}}from\"./chunk-1.js\";import(\"./late.js\");{entry}");
            Ok(vec![("chunk-1.js".to_owned(), "chunk".to_owned()), ("page.js".to_owned(), page)])
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
        assert_eq!(join(site, "index.html", &NameBundler).unwrap(), ["page.js", "chunk-1.js"]);
        let expected = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<script src=\"early.js\"></script>\n\
                        <link rel=\"modulepreload\" href=\"chunk-1.js\">\n<link rel=\"stylesheet\" href=\"page.css\">\n<script type=\"module\" src=\"page.js\"></script>\n</head>\n<p>\n";
        assert_eq!(files::read_text(&site.join("index.html")).unwrap(), expected);
        assert_eq!(files::read_text(&site.join("page.css")).unwrap(), "a.css b.css");
        assert!(files::read_text(&site.join("page.js")).unwrap().ends_with(";a.js"));
        assert_eq!(files::read_text(&site.join("chunk-1.js")).unwrap(), "chunk");
        files::write(&site.join("index.html"), "</head>\n").unwrap();
        assert!(join(site, "index.html", &NameBundler).is_err());
    }
}
