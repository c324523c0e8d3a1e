//! The served page with its styles in one file and its modules in two: half the bytes of many small ones, and a tenth of
//! the requests. The second script comes after the first picture.

use crate::one_file::Tag;
use crate::{bundle, files};
use anyhow::{Context, Result};
use std::path::Path;

/// Writes `page.js`, `later.js` and `page.css` beside a page in the folder of the site, and makes the page ask for them.
pub(crate) fn join(site: &Path, page: &str) -> Result<()> {
    let file = site.join(page);
    let mut text = String::new();
    let mut styles = String::new();
    let mut entry = None;
    for line in files::read_text(&file)?.lines() {
        let tag = Tag(line);
        match (tag.name(), tag.attribute("rel"), tag.attribute("href").or(tag.attribute("src"))) {
            ("link", Some("stylesheet"), Some(name)) => styles.push_str(&files::read_text(&site.join(name))?),
            ("script", _, Some(name)) if tag.attribute("type") == Some("module") => entry = Some(name.to_owned()),
            _ => {
                if line == "</head>" {
                    text.push_str(
                        "<link rel=\"stylesheet\" href=\"page.css\">\n<script src=\"page.js\" defer></script>\n",
                    );
                }
                text.push_str(line.trim_start());
                text.push('\n');
            }
        }
    }
    let entry = entry.with_context(|| format!("{page} has no module"))?;
    let names = ["page.js", "later.js"];
    for (name, script) in names.iter().zip(bundle::bundle_in_two(&site.join(entry), names[1])?) {
        files::write(&site.join(name), bundle::squeezed(&script)?)?;
    }
    files::write(&site.join("page.css"), bundle::squeezed(&styles)?)?;
    files::write(&file, text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joins_what_the_page_asks_for() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        let page = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<link rel=\"stylesheet\" href=\"a.css\">\n<link rel=\"stylesheet\" href=\"b.css\">\n\
                    <script src=\"early.js\"></script>\n<script type=\"module\" src=\"a.js\"></script>\n</head>\n<p>\n";
        for (name, text) in [
            ("index.html", page),
            ("a.css", "a {}\n"),
            ("b.css", "b {}\n"),
            ("a.js", "import './b.js';\nimport('./c.js');\n"),
            ("b.js", "b();\n"),
            ("c.js", "c();\n"),
        ] {
            files::write(&site.join(name), text).unwrap();
        }
        join(site, "index.html").unwrap();
        let expected = "<head>\n<link rel=\"icon\" href=\"a.svg\">\n<script src=\"early.js\"></script>\n\
                        <link rel=\"stylesheet\" href=\"page.css\">\n<script src=\"page.js\" defer></script>\n</head>\n<p>\n";
        assert_eq!(files::read_text(&site.join("index.html")).unwrap(), expected);
        assert_eq!(files::read_text(&site.join("page.css")).unwrap(), "a {}\nb {}\n");
        assert!(files::read_text(&site.join("page.js")).unwrap().contains("b();"));
        assert!(files::read_text(&site.join("later.js")).unwrap().contains("c();"));
        files::write(&site.join("index.html"), "</head>\n").unwrap();
        assert!(join(site, "index.html").is_err());
    }
}
