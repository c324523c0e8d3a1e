//! The served page with its styles in one file and its modules in a few: a tenth of the requests for separate files.

use crate::esbuild::Bundler;
use crate::html::{self, Parts};
use anyhow::{Context, Result};
use fs_err as fs;
use lol_html::element;
use lol_html::html_content::ContentType;
use std::path::Path;

/// Writes `page.js`, the modules that it imports and `page.css` into the folder of the site, and makes the page load
/// them. Returns the names of the scripts that the page runs from the start.
pub(crate) fn join(site: &Path, page: &str, bundler: &dyn Bundler) -> Result<Vec<String>> {
    let file = site.join(page);
    let parts = Parts::of(&fs::read_to_string(&file)?).with_context(|| format!("in {page}"))?;
    fs::write(site.join("page.css"), bundler.styles(&parts.styles)?)?;
    // The browser asks for all modules at once, and does not wait for one to find the next.
    let mut links = "<link rel=\"stylesheet\" href=\"page.css\">\n".to_owned();
    let imported = bundler.split(&parts.module, "page", site)?;
    for name in &imported {
        links += &format!("<link rel=\"modulepreload\" href=\"{name}\">\n");
    }
    links += "<script type=\"module\" src=\"page.js\"></script>\n";
    let append = element!("head", |head| {
        head.append(&links, ContentType::Html);
        Ok(())
    });
    let text = html::rewrite(&parts.page, [append])?;
    let lines = text.lines().map(str::trim_start).filter(|line| !line.is_empty());
    fs::write(file, lines.map(|line| format!("{line}\n")).collect::<String>())?;
    Ok([vec!["page.js".to_owned()], imported].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    struct NameBundler;

    impl Bundler for NameBundler {
        fn module(&self, _: &str) -> Result<String> {
            anyhow::bail!("the page needs more than one module")
        }

        fn split(&self, entry: &str, name: &str, site: &Path) -> Result<Vec<String>> {
            fs::write(site.join(format!("{name}.js")), format!("module {entry}"))?;
            Ok(vec!["chunk.js".to_owned()])
        }

        fn styles(&self, names: &[String]) -> Result<String> {
            Ok(names.join(" "))
        }
    }

    #[test]
    fn joins_what_the_page_asks_for() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        let page = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<link rel=\"stylesheet\" href=\"a.css\">\n<link rel=\"stylesheet\" href=\"b.css\">\n\
                    <script src=\"early.js\"></script>\n<script type=\"module\" src=\"a.js\"></script>\n</head>\n<p>\n";
        fs::write(site.join("index.html"), page).unwrap();
        assert_eq!(join(site, "index.html", &NameBundler).unwrap(), ["page.js", "chunk.js"]);
        let expected = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<script src=\"early.js\"></script>\n\
                        <link rel=\"stylesheet\" href=\"page.css\">\n\
                        <link rel=\"modulepreload\" href=\"chunk.js\">\n<script type=\"module\" src=\"page.js\"></script>\n</head>\n<p>\n";
        assert_eq!(fs::read_to_string(site.join("index.html")).unwrap(), expected);
        assert_eq!(fs::read_to_string(site.join("page.css")).unwrap(), "a.css b.css");
        assert_eq!(fs::read_to_string(site.join("page.js")).unwrap(), "module a.js");
        fs::write(site.join("index.html"), "</head>\n").unwrap();
        assert!(join(site, "index.html", &NameBundler).is_err());
    }
}
